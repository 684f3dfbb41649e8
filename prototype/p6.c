// prototype: halo pockets, outward from centre in a ball of radius RB (no walls), reservoir best fit
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <string.h>
#include <stdint.h>
#include <time.h>
static double now(){struct timespec t;clock_gettime(CLOCK_MONOTONIC,&t);return t.tv_sec+1e-9*t.tv_nsec;}
static uint64_t S=88172645463325252ULL;
static double U(){S^=S<<13;S^=S>>7;S^=S<<17;return (S>>11)*0x1p-53;}
typedef struct{double x,y,z,r;}sp;
static sp*P;static int N,NMAX;
static double RMIN=.7,RMAX=1.3,RREF=.85;static int K=64;static int M=1;
// grid
static int G;static double CE;static int*head,*nxt;static double RB;
static int cellof(double x){int c=(int)((x+RB+4)/CE);return c;}
static void gadd(int i){int a=cellof(P[i].x),b=cellof(P[i].y),c=cellof(P[i].z);int k=(a*G+b)*G+c;nxt[i]=head[k];head[k]=i;}
static int near(double x,double y,double z,double reach0,int*out){ // spheres with dist <= r_l+reach0
  double R=reach0+RMAX;int a0=cellof(x-R),a1=cellof(x+R),b0=cellof(y-R),b1=cellof(y+R),c0=cellof(z-R),c1=cellof(z+R);int n=0;
  if(a0<0)a0=0;if(b0<0)b0=0;if(c0<0)c0=0;if(a1>=G)a1=G-1;if(b1>=G)b1=G-1;if(c1>=G)c1=G-1;
  for(int a=a0;a<=a1;a++)for(int b=b0;b<=b1;b++)for(int c=c0;c<=c1;c++)for(int i=head[(a*G+b)*G+c];i>=0;i=nxt[i]){
    double dx=P[i].x-x,dy=P[i].y-y,dz=P[i].z-z,q=P[i].r+reach0;if(dx*dx+dy*dy+dz*dz<=q*q)out[n++]=i;}
  return n;}
typedef struct{double P[3],Q[3],n[3];double al,be,ga;double ri;}curve;
static int mk(const sp*i,const sp*j,const sp*k,int side,curve*c){
  double ax=j->x-i->x,ay=j->y-i->y,az=j->z-i->z,bx=k->x-i->x,by=k->y-i->y,bz=k->z-i->z;
  double g11=ax*ax+ay*ay+az*az,g22=bx*bx+by*by+bz*bz,g12=ax*bx+ay*by+az*bz,det=g11*g22-g12*g12;
  if(det<1e-9*g11*g22)return 0;
  double a1=.5*(g11+i->r*i->r-j->r*j->r),b1=i->r-j->r,a2=.5*(g22+i->r*i->r-k->r*k->r),b2=i->r-k->r;
  double u=(g22*a1-g12*a2)/det,v=(g11*a2-g12*a1)/det;
  c->P[0]=u*ax+v*bx;c->P[1]=u*ay+v*by;c->P[2]=u*az+v*bz;
  double uq=(g22*b1-g12*b2)/det,vq=(g11*b2-g12*b1)/det;
  c->Q[0]=uq*ax+vq*bx;c->Q[1]=uq*ay+vq*by;c->Q[2]=uq*az+vq*bz;
  double nx=ay*bz-az*by,ny=az*bx-ax*bz,nz=ax*by-ay*bx,l=side/sqrt(det);
  c->n[0]=nx*l;c->n[1]=ny*l;c->n[2]=nz*l;c->ri=i->r;
  c->al=i->r*i->r-(c->P[0]*c->P[0]+c->P[1]*c->P[1]+c->P[2]*c->P[2]);
  c->be=2*(i->r-(c->P[0]*c->Q[0]+c->P[1]*c->Q[1]+c->P[2]*c->Q[2]));
  c->ga=1-(c->Q[0]*c->Q[0]+c->Q[1]*c->Q[1]+c->Q[2]*c->Q[2]);
  return 1;}
static int at(const curve*c,double r,double*o){double s2=c->al+r*(c->be+r*c->ga);if(s2<0)return 0;double s=sqrt(s2);for(int d=0;d<3;d++)o[d]=c->P[d]+c->Q[d]*r+s*c->n[d];return 1;}
// next r > r0 at which A+Br-C s(r) changes sign; INFINITY none
static double rootafter(double A,double B,double C,const curve*c,double r0){
  double qa=B*B-C*C*c->ga,qb=2*A*B-C*C*c->be,qc=A*A-C*C*c->al;
  double best=INFINITY;double D=qb*qb-4*qa*qc;if(D<0)return best;double q=-.5*(qb+(qb>=0?sqrt(D):-sqrt(D)));
  double r1=q/qa,r2=qc/q;
  for(int t=0;t<2;t++){double r=t?r2:r1;if(!(r>r0*(1+1e-12)))continue;double v=A+B*r;if(v*C<0)continue;if(c->al+r*(c->be+r*c->ga)<0)continue;if(r<best)best=r;}
  return best;}
static double reff;
static int interval(const curve*c,const sp*si,int i,int j,int k,const int*nb,int m,double rstart,double*lo,double*hi,double*hh2,double*hh3){
  double r0=rstart,h=1e9,h2=1e9,h3=1e9;
#define EX(x) do{double x_=(x);if(x_<h){h3=h2;h2=h;h=x_;}else if(x_<h2){h3=h2;h2=x_;}else if(x_<h3)h3=x_;}while(0)

  for(int t=0;t<m;t++){int l=nb[t];if(l==i||l==j||l==k)continue;
    double px=P[l].x-si->x,py=P[l].y-si->y,pz=P[l].z-si->z;
    double a=.5*(px*px+py*py+pz*pz+si->r*si->r-P[l].r*P[l].r),b=si->r-P[l].r;
    double A=a-(c->P[0]*px+c->P[1]*py+c->P[2]*pz),B=b-(c->Q[0]*px+c->Q[1]*py+c->Q[2]*pz),C=c->n[0]*px+c->n[1]*py+c->n[2]*pz;
    double s2=c->al+r0*(c->be+r0*c->ga);if(s2<0)s2=0;
    double g=A+B*r0-C*sqrt(s2);
    if(g<-1e-12){double e=rootafter(A,B,C,c,r0);if(!(e<h))return 0;r0=e;double x=rootafter(A,B,C,c,e*(1+1e-9));EX(x);}
    else{double x=rootafter(A,B,C,c,r0);EX(x);}
    if(h<r0)return 0;}
  *lo=r0;*hi=h;*hh2=h2;*hh3=h3;return 1;}
// reservoir: K strata radii kept sorted
static double res[4096];static int ages[4096];
static double quant(double u){return RMIN+(RMAX-RMIN)*u;}
static double strat_next[4096];
static long placed=0,pops=0,news=0,cands=0;
static int resorted_remove(int idx){ // refill: keep stratum of removed? simple: draw new random
  double r=quant((U()));
  // systematic: cycle through strata permuted
  static int perm[4096],pos=0,init=0;if(!init||pos==K){for(int t=0;t<K;t++)perm[t]=t;for(int t=K-1;t>0;t--){int q=U()*(t+1);int w=perm[t];perm[t]=perm[q];perm[q]=w;}pos=0;init=1;}
  r=quant((perm[pos++]+U())/K);
  memmove(res+idx,res+idx+1,(K-1-idx)*sizeof*res);int p=K-1;while(p>0&&res[p-1]>r){res[p]=res[p-1];p--;}res[p]=r;return 0;}
static double potential(double x,double y,double z){return sqrt(x*x+y*y+z*z);}

typedef struct{int i,j,k,side;double key,lo,hi,h2,h3;curve c;int next;int alive;int ver;}pk;
static pk*Q;static int QN,QM,QF=-1;static int*ph;static double DEL=0.5;
typedef struct{double key;int p,ver;}he;
typedef struct{he*h;int n,m;}heap;static heap HK,HS;
static void hpush(heap*H,double key,int p,int ver){if(H->n==H->m){H->m=H->m?2*H->m:1024;H->h=realloc(H->h,H->m*sizeof*H->h);}int c=H->n++;he e={key,p,ver};while(c){int q=(c-1)/2;if(H->h[q].key<=key)break;H->h[c]=H->h[q];c=q;}H->h[c]=e;}
static he hpop(heap*H){he t=H->h[0],l=H->h[--H->n];int c=0;for(;;){int d=2*c+1;if(d>=H->n)break;if(d+1<H->n&&H->h[d+1].key<H->h[d].key)d++;if(H->h[d].key>=l.key)break;H->h[c]=H->h[d];c=d;}if(H->n)H->h[c]=l;return t;}
static double C2=0,C3=0,CAPR=1.5,T=-1;
static double EXPO=1,ETA=0;static int binc[16];static int NB=8;static int binof(double r){int b=(int)((r-RMIN)/(RMAX-RMIN)*NB);return b<0?0:b>=NB?NB-1:b;}
static double score(const pk*p,double*rr){ // gap of best radius
  int a=0,b=K;while(a<b){int q=(a+b)/2;if(res[q]<=p->hi)a=q+1;else b=q;}
  int idx=a-1;if(idx<0||res[idx]<p->lo)return INFINITY;
  *rr=res[idx];double h=p->hi>RMAX*CAPR?RMAX*CAPR:p->hi;double g2=p->h2>RMAX*CAPR?RMAX*CAPR:p->h2;double r_=res[idx],g3=p->h3>RMAX*CAPR?RMAX*CAPR:p->h3;return (h-r_+C2*(g2-r_)+C3*(g3-r_))/(EXPO==0?1:EXPO==1?r_:pow(r_,EXPO))-ETA*((double)binc[binof(r_)]*NB/K-1);}
static long upd=0,rescore=0;
static double GAPW2=0;
static void offer(int x){double r;double sc=score(&Q[x],&r);Q[x].ver++;if(sc<INFINITY)hpush(&HS,sc+GAPW2*Q[x].key,x,Q[x].ver);}
static void add_pockets(int s){
  int nb[512];sp*si=&P[s];int m0=near(si->x,si->y,si->z,si->r+2*RMAX+1e-9,nb);int m=0,mr=0;
  int nbr[512];int all[512];int ma=0;for(int t=0;t<m0;t++)if(nb[t]!=s)all[ma++]=nb[t];
  // update live pockets near
  for(int t=0;t<ma;t++){int l=all[t];int*pp=&ph[l];while(*pp>=0){pk*p=&Q[*pp];int id=*pp;
      if(!p->alive){*pp=p->next;p->next=QF;QF=id;continue;}
      sp*i=&P[l];double px=si->x-i->x,py=si->y-i->y,pz=si->z-i->z;curve*c=&p->c;upd++;
      double a=.5*(px*px+py*py+pz*pz+i->r*i->r-si->r*si->r),b=i->r-si->r;
      double A=a-(c->P[0]*px+c->P[1]*py+c->P[2]*pz),B=b-(c->Q[0]*px+c->Q[1]*py+c->Q[2]*pz),C=c->n[0]*px+c->n[1]*py+c->n[2]*pz;
      double r0=p->lo;double s2=c->al+r0*(c->be+r0*c->ga);if(s2<0)s2=0;double g=A+B*r0-C*sqrt(s2),h=p->hi,h2=p->h2,h3=p->h3;int dead=0;
      if(g<-1e-12){double e=rootafter(A,B,C,c,r0);if(!(e<h))dead=1;else{r0=e;double x=rootafter(A,B,C,c,e*(1+1e-9));EX(x);}}
      else{double x=rootafter(A,B,C,c,r0);EX(x);}
      if(!dead&&(h<r0||h<RMIN||r0>RMAX))dead=1;
      if(dead){p->alive=0;p->ver++;*pp=p->next;p->next=QF;QF=id;continue;}
      if(h!=p->hi||r0!=p->lo||h2!=p->h2||h3!=p->h3){p->lo=r0;p->hi=h;p->h2=h2;p->h3=h3;p->ver++;if(p->key<T)offer(id);}
      pp=&p->next;}}
  for(int t=0;t<ma;t++){int l=all[t];double dx=P[l].x-si->x,dy=P[l].y-si->y,dz=P[l].z-si->z,q=si->r+P[l].r+2*RREF;if(dx*dx+dy*dy+dz*dz<=q*q)nbr[m++]=l;}
  double X[512],Y[512],Z[512],TT[512];
  for(int t=0;t<m;t++){int l=nbr[t];double px=P[l].x-si->x,py=P[l].y-si->y,pz=P[l].z-si->z;X[t]=px;Y[t]=py;Z[t]=pz;
    TT[t]=.5*(px*px+py*py+pz*pz+si->r*si->r-P[l].r*P[l].r)+(si->r-P[l].r)*RREF;}
  double d=si->r+RREF;
  double co[512];int or[512];for(int t=0;t<m;t++){co[t]=TT[t]/(sqrt(X[t]*X[t]+Y[t]*Y[t]+Z[t]*Z[t])*d);or[t]=t;}
  for(int a=1;a<m;a++){int o=or[a];int b=a;while(b>0&&co[or[b-1]]>co[o]){or[b]=or[b-1];b--;}or[b]=o;}
  int lastk=-1;
  for(int aa=0;aa<m;aa++)for(int bb=aa+1;bb<m;bb++){int a=or[aa],b=or[bb];
    int j=nbr[a],k=nbr[b];double dx=X[a]-X[b],dy=Y[a]-Y[b],dz=Z[a]-Z[b],q=P[j].r+P[k].r+2*RREF;if(dx*dx+dy*dy+dz*dz>q*q)continue;
    double g11=X[a]*X[a]+Y[a]*Y[a]+Z[a]*Z[a],g22=X[b]*X[b]+Y[b]*Y[b]+Z[b]*Z[b],g12=X[a]*X[b]+Y[a]*Y[b]+Z[a]*Z[b],det=g11*g22-g12*g12;
    if(det<1e-9*g11*g22)continue;
    double u=(g22*TT[a]-g12*TT[b])/det,v=(g11*TT[b]-g12*TT[a])/det;
    double cx=u*X[a]+v*X[b],cy=u*Y[a]+v*Y[b],cz=u*Z[a]+v*Z[b];double s2=d*d-cx*cx-cy*cy-cz*cz;if(s2<0)continue;
    double l=sqrt(s2/det),nx=(Y[a]*Z[b]-Z[a]*Y[b])*l,ny=(Z[a]*X[b]-X[a]*Z[b])*l,nz=(X[a]*Y[b]-Y[a]*X[b])*l;
    for(int side=1;side>=-1;side-=2){double x=cx+side*nx,y=cy+side*ny,z=cz+side*nz;cands++;int ok=1;
      if(lastk>=0&&lastk!=a&&lastk!=b&&x*X[lastk]+y*Y[lastk]+z*Z[lastk]>TT[lastk]+1e-12)continue;
      for(int tt=0;tt<m;tt++){int t=or[tt];if(t==a||t==b)continue;if(x*X[t]+y*Y[t]+z*Z[t]>TT[t]+1e-12){ok=0;lastk=t;break;}}
      if(!ok)continue;
      double key=potential(x+si->x,y+si->y,z+si->z);if(key>=RB)continue;
      curve c;if(!mk(si,&P[j],&P[k],side,&c))continue;
      double r0=RMIN;double t2=c.al+r0*(c.be+r0*c.ga);
      if(t2<0){double D=c.be*c.be-4*c.ga*c.al;if(D<0)continue;double q=-.5*(c.be+(c.be>=0?sqrt(D):-sqrt(D)));double r1=q/c.ga,r2=c.al/q;double b=INFINITY;if(r1>r0&&r1<b)b=r1;if(r2>r0&&r2<b)b=r2;if(b>RMAX)continue;r0=b*(1+1e-9);}
      double lo,hi,h2,h3;if(!interval(&c,si,s,j,k,all,ma,r0,&lo,&hi,&h2,&h3))continue;if(hi<RMIN||lo>RMAX)continue;
      int id;if(QF>=0){id=QF;QF=Q[id].next;}else{if(QN==QM){QM=QM?2*QM:4096;Q=realloc(Q,QM*sizeof*Q);memset(Q+QN,0,(QM-QN)*sizeof*Q);}id=QN++;}
      pk*p=&Q[id];int ver=p->ver+1;*p=(pk){s,j,k,side,key,lo,hi,h2,h3,c,ph[s],1,ver};ph[s]=id;news++;
      hpush(&HK,key,id,ver);if(key<T)offer(id);else{extern heap HA;hpush(&HA,key,id,0);} // note HK entries keep creation ver; use alive+id check below
      Q[id].side=side; }}
}
static int*gen; 
int main(int ac,char**av){
  NMAX=atoi(av[1]);K=atoi(av[2]);DEL=atof(av[3]);RREF=atof(av[4]);CAPR=atof(av[5]);if(ac>7){RMIN=atof(av[6]);RMAX=atof(av[7]);}if(ac>8)GAPW2=atof(av[8]);if(ac>9)C2=atof(av[9]);if(ac>10)C3=atof(av[10]);if(ac>11)EXPO=atof(av[11]);if(ac>12)ETA=atof(av[12]);
  double r3=(pow(RMAX,4)-pow(RMIN,4))/4/(RMAX-RMIN);RB=cbrt(NMAX*r3/.64);if(RMIN==RMAX){r3=RMIN*RMIN*RMIN;RB=cbrt(NMAX*r3/.6);}
  CE=1.6;G=(int)((2*RB+8)/CE)+2;head=malloc(sizeof(int)*(size_t)G*G*G);memset(head,-1,sizeof(int)*(size_t)G*G*G);
  P=malloc(sizeof(sp)*(NMAX*2+100));nxt=malloc(sizeof(int)*(NMAX*2+100));ph=malloc(sizeof(int)*(NMAX*2+100));memset(ph,-1,sizeof(int)*(NMAX*2+100));
  for(int t=0;t<K;t++)res[t]=quant((t+U())/K);
  for(int t=0;t<K;t++)binc[binof(res[t])]++;double t0=now();double r=(RMIN+RMAX)/2;P[0]=(sp){-r,0,0,r};P[1]=(sp){r,0,0,r};P[2]=(sp){0,sqrt(3)*r,0,r};N=3;
  for(int i=0;i<3;i++)gadd(i);add_pockets(2);
  double kmin=0;
  while(N<NMAX*2){
    // kmin: lowest live pocket
    while(HK.n&&(!Q[HK.h[0].p].alive||Q[HK.h[0].p].key!=HK.h[0].key))hpop(&HK);
    if(!HK.n)break;
    kmin=HK.h[0].key;
    // widen window
    double T2=kmin+DEL;
    if(T2>T){double To=T;T=T2;
      // activate pockets with key in [To,T): scan list via secondary heap copy -> simple: use third heap
      extern heap HA;extern void activate(double,double);activate(To,T);}
    // best by score
    int x=-1;double rr=0;
    while(HS.n){he e=HS.h[0];pk*p=&Q[e.p];if(!p->alive||p->ver!=e.ver){hpop(&HS);continue;}
      double q;double sc=score(p,&q);rescore++;if(sc==INFINITY){hpop(&HS);continue;}
      if(sc+GAPW2*p->key>e.key){hpop(&HS);p->ver++;hpush(&HS,sc+GAPW2*p->key,e.p,p->ver);continue;}
      x=e.p;rr=q;hpop(&HS);break;}
    if(x<0){ // no pocket of the window fits any radius now: drop the lowest
      he e=hpop(&HK);pk*p=&Q[e.p];p->alive=0;p->ver++;continue;}
    pk*p=&Q[x];double o[3];at(&p->c,rr,o);sp*si=&P[p->i];sp n={si->x+o[0],si->y+o[1],si->z+o[2],rr};p->alive=0;p->ver++;
    int a=0;while(res[a]!=rr)a++;binc[binof(rr)]--;double sum0=0;for(int t=0;t<K;t++)sum0+=res[t];resorted_remove(a);double sum1=0;for(int t=0;t<K;t++)sum1+=res[t];binc[binof(sum1-sum0+rr)]++;
    P[N]=n;gadd(N);N++;add_pockets(N-1);
  }
  double t1=now();
  double Ri=RB-3*RMAX,V=0;double mo=0,ov=0;
  for(int i=0;i<N;i++){double d=potential(P[i].x,P[i].y,P[i].z),q=P[i].r;if(d+q<=Ri)V+=4./3*M_PI*q*q*q;else if(d-q<Ri){V+=M_PI*(Ri+q-d)*(Ri+q-d)*(d*d+2*d*q-3*q*q+2*d*Ri+6*q*Ri-3*Ri*Ri)/(12*d);}
    mo+=q;int nb[512];int m=near(P[i].x,P[i].y,P[i].z,q,nb);for(int t=0;t<m;t++)if(nb[t]<i){int l=nb[t];double dx=P[i].x-P[l].x,dy=P[i].y-P[l].y,dz=P[i].z-P[l].z;double g=q+P[l].r-sqrt(dx*dx+dy*dy+dz*dz);if(g>ov)ov=g;}}
  double Rc=RB*.5;double V2=0;for(int i=0;i<N;i++){double d=potential(P[i].x,P[i].y,P[i].z),q=P[i].r;if(d+q<=Rc)V2+=4./3*M_PI*q*q*q;else if(d-q<Rc)V2+=M_PI*(Rc+q-d)*(Rc+q-d)*(d*d+2*d*q-3*q*q+2*d*Rc+6*q*Rc-3*Rc*Rc)/(12*d);}
  double rm=0;for(int t=0;t<K;t++)rm+=res[t]/K;printf("resmean %.3f ",rm);printf("N %d K %d D %.2f ref %.2f cap %.2f: inner %.4f half %.4f shell %.4f mean %.4f t %.2f us/sph %.2f new/N %.1f cand/N %.0f upd/N %.0f resc/N %.0f live %d ov %.1e\n",N,K,DEL,RREF,CAPR,V/(4./3*M_PI*Ri*Ri*Ri),V2/(4./3*M_PI*Rc*Rc*Rc),(V-V2)/(4./3*M_PI*(Ri*Ri*Ri-Rc*Rc*Rc)),mo/N,t1-t0,(t1-t0)/N*1e6,(double)news/N,(double)cands/N,(double)upd/N,(double)rescore/N,QN,ov);
}
heap HA;
void activate(double a,double b){while(HA.n&&HA.h[0].key<b){he e=hpop(&HA);if(Q[e.p].alive&&Q[e.p].key==e.key)offer(e.p);}}
