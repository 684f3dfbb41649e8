/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "outline.h"
#include <math.h>

enum { ARC = 240, STRAIGHT = 100 };

typedef struct tracer {
  const domain_spec *spec;
  packing_vec3 toward;
  outline_piece piece;
  void *user;
} tracer;

static packing_vec3 between(packing_vec3 a, packing_vec3 b, double t)
{
  return (packing_vec3){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
                        a.z + t * (b.z - a.z)};
}

static void trace_line(const tracer *t, packing_vec3 a, packing_vec3 b)
{
  for (int i = 0; i < STRAIGHT; i++)
    t->piece(t->user, between(a, b, (double)i / STRAIGHT),
             between(a, b, (double)(i + 1) / STRAIGHT));
}

/* Corner k of the box, bit 0 for x, 1 for y, 2 for z. */
static packing_vec3 corner(const domain_spec *s, int k)
{
  return (packing_vec3){s->at.x + (k & 1 ? s->size[0] : 0),
                        s->at.y + (k & 2 ? s->size[1] : 0),
                        s->at.z + (k & 4 ? s->size[2] : 0)};
}

static void trace_box(const tracer *t)
{
  const int corners = t->spec->dim == 2 ? 4 : 8;
  for (int k = 0; k < corners; k++)
    for (int bit = 1; bit < corners; bit <<= 1)
      if (!(k & bit))
        trace_line(t, corner(t->spec, k), corner(t->spec, k | bit));
}

/* centre + r (cos a u + sin a v) */
static packing_vec3 on_circle(packing_vec3 centre, packing_vec3 u, packing_vec3 v,
                              double r, double a)
{
  const double c = r * cos(a), s = r * sin(a);
  return (packing_vec3){centre.x + c * u.x + s * v.x, centre.y + c * u.y + s * v.y,
                        centre.z + c * u.z + s * v.z};
}

static void trace_circle(const tracer *t, packing_vec3 centre, packing_vec3 u,
                         packing_vec3 v, double r)
{
  for (int i = 0; i < ARC; i++)
    t->piece(t->user, on_circle(centre, u, v, r, 2 * M_PI * i / ARC),
             on_circle(centre, u, v, r, 2 * M_PI * (i + 1) / ARC));
}

/* The silhouette of a ball: the great circle facing the viewer. */
static void trace_ball(const tracer *t)
{
  const packing_vec3 n = t->toward;
  const double flat = hypot(n.x, n.y);
  const packing_vec3 u = {-n.y / flat, n.x / flat, 0};
  const packing_vec3 v = {-n.z * u.y, n.z * u.x, n.x * u.y - n.y * u.x};
  trace_circle(t, t->spec->at, u, v, t->spec->size[0]);
}

static void trace_flat_circles(const tracer *t)
{
  const packing_vec3 u = {1, 0, 0}, v = {0, 1, 0};
  trace_circle(t, t->spec->at, u, v, t->spec->size[0]);
  if (t->spec->kind == DOMAIN_ANNULUS)
    trace_circle(t, t->spec->at, u, v, t->spec->size[1]);
}

/* Across and along the axis of a body of revolution. */
typedef struct frame {
  packing_vec3 u, v, w;
} frame;

static frame frame_of(packing_axis axis)
{
  static const packing_vec3 e[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return (frame){e[(axis + 1) % 3], e[(axis + 2) % 3], e[axis]};
}

static double along(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static packing_vec3 on_axis(const tracer *t, const frame *f, double h)
{
  const packing_vec3 at = t->spec->at;
  return (packing_vec3){at.x + h * f->w.x, at.y + h * f->w.y, at.z + h * f->w.z};
}

/* The two lines of a frustum where its normal is square to the line of sight:
 * cos(a) n_u + sin(a) n_v = slope n_w. */
static void trace_silhouette(const tracer *t, const frame *f, const double r[2],
                             const double h[2])
{
  const double nu = along(t->toward, f->u), nv = along(t->toward, f->v);
  const double nw = along(t->toward, f->w), flat = hypot(nu, nv);
  const double c = (r[1] - r[0]) / (h[1] - h[0]) * nw / flat;
  if (!(fabs(c) <= 1))
    return;
  for (int side = -1; side <= 1; side += 2) {
    const double a = atan2(nv, nu) + side * acos(c);
    trace_line(t, on_circle(on_axis(t, f, h[0]), f->u, f->v, r[0], a),
               on_circle(on_axis(t, f, h[1]), f->u, f->v, r[1], a));
  }
}

/* A profile of `count` radii at rising heights, turned about the axis. */
static void trace_revolution(const tracer *t, const double *r, const double *h, int count)
{
  const frame f = frame_of(t->spec->axis);
  for (int k = 0; k < count; k++) {
    trace_circle(t, on_axis(t, &f, h[k]), f.u, f.v, r[k]);
    if (k > 0)
      trace_silhouette(t, &f, r + k - 1, h + k - 1);
  }
}

static void trace_body(const tracer *t)
{
  const double *s = t->spec->size;
  switch (t->spec->kind) {
  case DOMAIN_TUBE:
    trace_revolution(t, (double[]){s[0], s[0]}, (double[]){0, s[2]}, 2);
    trace_revolution(t, (double[]){s[1], s[1]}, (double[]){0, s[2]}, 2);
    break;
  case DOMAIN_CONE:
    trace_revolution(t, (double[]){s[0], s[1]}, (double[]){0, s[2]}, 2);
    break;
  case DOMAIN_SILO:
    trace_revolution(t, (double[]){s[2], s[0], s[0]}, (double[]){0, s[3], s[1]}, 3);
    break;
  default:
    trace_revolution(t, (double[]){s[0], s[0]}, (double[]){0, s[1]}, 2);
  }
}

static void trace_part(void *user, const domain_spec *spec)
{
  tracer t = *(const tracer *)user;
  t.spec = spec;
  switch (spec->kind) {
  case DOMAIN_NONE:
  case DOMAIN_POLYGON: /* its corners are in a file */
  case DOMAIN_MESH:
    break;
  case DOMAIN_BOX:
  case DOMAIN_RECT:
    trace_box(&t);
    break;
  case DOMAIN_SPHERE:
    trace_ball(&t);
    break;
  case DOMAIN_CIRCLE:
  case DOMAIN_ANNULUS:
    trace_flat_circles(&t);
    break;
  default:
    trace_body(&t);
  }
}

void outline_trace(const domain_spec *spec, packing_vec3 toward, outline_piece piece,
                   void *user)
{
  tracer t = {spec, toward, piece, user};
  domain_spec_each(spec, trace_part, &t);
}
