/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The vector work of the pocket front, once for all instruction sets. Included by
 * front_kernels_*.c, which define
 *   TARGET                 attribute of every function
 *   take_root(v)           replaces eight doubles, none negative, by their roots
 *   mask_bits(m)           bit k set where lane k of a comparison is true
 *   pack(to, v, bits)      the lanes of v whose bits are set, one after the other; a whole vector
 *                          may be written
 *   pack_numbers(to, first, bits)  the same for first, first + 1 ...
 * A vector is eight doubles for all sets; the compiler cuts it to what the machine has. Vectors
 * are handed over by pointer: not all machines have registers for them. */

typedef packing_i_front_vector vector;
typedef packing_i_front_mask mask;

#define WIDTH PACKING_I_FRONT_WIDTH
#define ALL(a) ((vector){(a), (a), (a), (a), (a), (a), (a), (a)})
#define LOAD(p) (*(const vector *)(const void *)(p))
#define STORE(p, v) (*(vector *)(void *)(p) = (v))
/* Where the mask says so a, else b. */
#define SELECT(m, a, b) ((vector)(((m) & (mask)(a)) | (~(m) & (mask)(b))))
#define MIN(a, b) SELECT((a) < (b), (a), (b))
#define MAX(a, b) SELECT((a) < (b), (b), (a))

static const vector lanes = {0, 1, 2, 3, 4, 5, 6, 7};

TARGET static int gather(const packing_i_front_bin *const *bin, const uint32_t *place,
                         size_t count, const packing_vec3 *centre, double reach,
                         packing_i_front_halo *halo)
{
  const vector cx = ALL(centre->x), cy = ALL(centre->y), cz = ALL(centre->z),
               near = ALL(reach);
  size_t n = halo->count;
  for (size_t b = 0; b < count; b++) {
    const vector x = LOAD(bin[b]->x) - cx, y = LOAD(bin[b]->y) - cy,
                 z = LOAD(bin[b]->z) - cz, r = LOAD(bin[b]->r);
    const vector far = r + near;
    const mask within = x * x + y * y + z * z <= far * far;
    const unsigned bits = mask_bits(&within);
    if (bits == 0)
      continue;
    if (n + WIDTH > halo->capacity)
      return 0;
    __builtin_prefetch(bin[b]->pockets); /* they are asked for next */
    pack(halo->x + n, &x, bits);
    pack(halo->y + n, &y, bits);
    pack(halo->z + n, &z, bits);
    pack(halo->r + n, &r, bits);
    pack_numbers(halo->id + n, place[b], bits);
    n += (size_t)__builtin_popcount(bits);
  }
  halo->count = n;
  return 1;
}

TARGET static void bodies(packing_i_front_halo *halo, size_t count, double sphere_r)
{
  const vector own = ALL(sphere_r);
  for (size_t t = 0; t < count; t += WIDTH) {
    const vector x = LOAD(halo->x + t), y = LOAD(halo->y + t), z = LOAD(halo->z + t),
                 r = LOAD(halo->r + t);
    STORE(halo->a + t, ALL(0.5) * ((x * x + y * y + z * z) + (own - r) * (own + r)));
    STORE(halo->b + t, own - r);
  }
}

/* What could be touched at all; the body `plane` first, with the smallest cosine. */
TARGET static void list_caps(const packing_i_front_halo *halo, size_t plane, double r,
                             double distance, packing_i_front_caps *caps)
{
  size_t n = 0;
  if (plane != PACKING_I_FRONT_NO_BODY) {
    caps->cosine[n] = -2;
    caps->order[n++] = (uint32_t)plane;
  }
  const vector out = ALL((double)plane);
  for (size_t t = 0; t < halo->count && n + WIDTH <= caps->capacity; t += WIDTH) {
    const vector x = LOAD(halo->x + t), y = LOAD(halo->y + t), z = LOAD(halo->z + t);
    const vector number = lanes + ALL((double)t);
    const vector square = x * x + y * y + z * z;
    const vector top = LOAD(halo->a + t) + LOAD(halo->b + t) * ALL(r);
    const mask meets = (top * top <= square * ALL(distance * distance)) &
                       (square > ALL(0.0)) & (number < ALL((double)halo->count)) &
                       (number != out);
    const unsigned bits = mask_bits(&meets);
    vector root = square;
    take_root(&root);
    const vector cosine = top / (root * ALL(distance));
    pack(caps->cosine + n, &cosine, bits);
    pack_numbers(caps->order + n, (uint32_t)t, bits);
    n += (size_t)__builtin_popcount(bits);
  }
  caps->count = n;
}

/* Each goes to the place that is the number of those before it. */
TARGET static void caps(const packing_i_front_halo *halo, size_t plane, double r,
                        double distance, packing_i_front_caps *caps)
{
  list_caps(halo, plane, r, distance, caps);
  for (size_t i = 0; i < caps->count; i++) {
    const vector own = ALL(caps->cosine[i]);
    unsigned rank = 0;
    for (size_t t = 0; t < caps->count; t += WIDTH) {
      const vector other = LOAD(caps->cosine + t), number = lanes + ALL((double)t);
      const mask before = ((other < own) | ((other == own) & (number < ALL((double)i)))) &
                          (number < ALL((double)caps->count));
      rank += (unsigned)__builtin_popcount(mask_bits(&before));
    }
    const uint32_t t = caps->order[i];
    const double x = halo->x[t], y = halo->y[t], z = halo->z[t];
    caps->x[rank] = x;
    caps->y[rank] = y;
    caps->z[rank] = z;
    caps->square[rank] = x * x + y * y + z * z;
    caps->top[rank] = halo->a[t] + halo->b[t] * r;
    caps->reach[rank] = halo->r[t] + r;
    caps->halo[rank] = t;
  }
}

/* Pairs of bodies close enough to be touched at once: p, its square and top, then q's. */
enum { BATCH = 64 };
typedef struct batch {
  double column[10][BATCH + WIDTH] __attribute__((aligned(64)));
  uint32_t pair[BATCH + WIDTH]; /* first << 16 | second */
  size_t count;
} batch;

/* With p and q the two bodies, the centre is u p + v q +- w p x q, where u and v solve the two
 * linear equations and w what is left of the distance from the sphere. */
TARGET static void solve(batch *b, double distance,
                         packing_i_front_candidates *candidates)
{
  const vector d2 = ALL(distance * distance), zero = ALL(0.0), padding = ALL(1.0);
  for (unsigned k = 0; k < 10; k++)
    __builtin_memcpy(b->column[k] + b->count, &padding, sizeof padding);
  for (size_t t = 0; t < b->count; t += WIDTH) {
    const vector px = LOAD(b->column[0] + t), py = LOAD(b->column[1] + t),
                 pz = LOAD(b->column[2] + t), pp = LOAD(b->column[3] + t),
                 ptop = LOAD(b->column[4] + t), qx = LOAD(b->column[5] + t),
                 qy = LOAD(b->column[6] + t), qz = LOAD(b->column[7] + t),
                 qq = LOAD(b->column[8] + t), qtop = LOAD(b->column[9] + t);
    const vector pq = px * qx + py * qy + pz * qz;
    const vector nx = py * qz - pz * qy, ny = pz * qx - px * qz, nz = px * qy - py * qx;
    const vector det = nx * nx + ny * ny + nz * nz;
    const vector over = ALL(1.0) / det;
    const vector u = (qq * ptop - pq * qtop) * over, v = (pp * qtop - pq * ptop) * over;
    const vector cx = u * px + v * qx, cy = u * py + v * qy, cz = u * pz + v * qz;
    const vector left = d2 - (cx * cx + cy * cy + cz * cz);
    const mask meets = (left >= zero) & (det > ALL(1e-9) * pp * qq) &
                       (lanes < ALL((double)(b->count - t)));
    unsigned bits = mask_bits(&meets);
    const size_t n = candidates->count, found = (size_t)__builtin_popcount(bits);
    if (n + (size_t)2 * WIDTH > candidates->capacity)
      break;
    vector w = MAX(left, zero) * over;
    take_root(&w);
    const vector side[6] = {cx + w * nx, cy + w * ny, cz + w * nz,
                            cx - w * nx, cy - w * ny, cz - w * nz};
    for (unsigned s = 0; s < 2; s++) {
      const size_t at = n + s * found;
      pack(candidates->x + at, side + (size_t)3 * s, bits);
      pack(candidates->y + at, side + (size_t)3 * s + 1, bits);
      pack(candidates->z + at, side + (size_t)3 * s + 2, bits);
    }
    for (size_t at = n; bits != 0; bits &= bits - 1, at++) {
      const uint32_t pair = b->pair[t + (unsigned)__builtin_ctz(bits)];
      candidates->pair[at] = (pair & 0xffff0000U) | (pair & 0xffff) << 1;
      candidates->pair[at + found] = candidates->pair[at] | 1;
    }
    candidates->count += 2 * found;
  }
  b->count = 0;
}

TARGET static void pairs(const packing_i_front_caps *caps, size_t firsts, double distance,
                         packing_i_front_candidates *candidates)
{
  batch b;
  b.count = 0;
  for (size_t first = 0; first < firsts; first++) {
    const vector p[5] = {ALL(caps->x[first]), ALL(caps->y[first]), ALL(caps->z[first]),
                         ALL(caps->square[first]), ALL(caps->top[first])};
    const vector preach = ALL(caps->reach[first]);
    for (size_t t = (first + 1) / WIDTH * WIDTH; t < caps->count; t += WIDTH) {
      const vector q[5] = {LOAD(caps->x + t), LOAD(caps->y + t), LOAD(caps->z + t),
                           LOAD(caps->square + t), LOAD(caps->top + t)};
      const vector reach = preach + LOAD(caps->reach + t);
      const vector dx = p[0] - q[0], dy = p[1] - q[1], dz = p[2] - q[2];
      const vector number = lanes + ALL((double)t);
      const mask near = (dx * dx + dy * dy + dz * dz <= reach * reach) &
                        (number > ALL((double)first)) &
                        (number < ALL((double)caps->count));
      const unsigned bits = mask_bits(&near);
      if (bits == 0)
        continue;
      for (unsigned k = 0; k < 5; k++) {
        __builtin_memcpy(b.column[k] + b.count, p + k, sizeof *p);
        pack(b.column[5 + k] + b.count, q + k, bits);
      }
      pack_numbers(b.pair + b.count, (uint32_t)first << 16 | (uint32_t)t, bits);
      b.count += (size_t)__builtin_popcount(bits);
      if (b.count > BATCH - WIDTH)
        solve(&b, distance, candidates);
    }
  }
  solve(&b, distance, candidates);
}

TARGET static void sieve(const packing_i_front_caps *caps,
                         packing_i_front_candidates *candidates)
{
  size_t kept = 0;
  for (size_t n = 0; n < candidates->count; n += WIDTH) {
    const vector x = LOAD(candidates->x + n), y = LOAD(candidates->y + n),
                 z = LOAD(candidates->z + n);
    mask free = lanes < ALL((double)(candidates->count - n));
    unsigned bits = mask_bits(&free);
    for (size_t t = 0; t < caps->count && bits != 0; t++) {
      free &= x * ALL(caps->x[t]) + y * ALL(caps->y[t]) + z * ALL(caps->z[t]) <=
              ALL(caps->room[t]);
      bits = mask_bits(&free);
    }
    for (; bits != 0; bits &= bits - 1, kept++) {
      const size_t k = n + (unsigned)__builtin_ctz(bits);
      candidates->x[kept] = candidates->x[k];
      candidates->y[kept] = candidates->y[k];
      candidates->z[kept] = candidates->z[k];
      candidates->pair[kept] = candidates->pair[k];
    }
  }
  candidates->count = kept;
}

/* Room of a body on a curve is u + v r - w s(r), which is 0 where (u + v r)^2 = w^2 s^2(r) and
 * u + v r has w's sign: two roots at most, `*first` <= `*second`, infinite where there is none
 * above r. */
TARGET static inline void exits(const vector *room, const vector s2[3], const vector *r,
                                vector *first, vector *second)
{
  const vector u = room[0], v = room[1], w = room[2];
  const vector zero = ALL(0.0), none = ALL(HUGE_VAL);
  const vector ww = w * w;
  const vector q2 = v * v - ww * s2[2], q1 = ALL(2.0) * u * v - ww * s2[1],
               q0 = u * u - ww * s2[0];
  const vector discriminant = q1 * q1 - ALL(4.0) * q0 * q2;
  vector root = MAX(discriminant, zero);
  take_root(&root);
  const vector sum = ALL(-0.5) * (q1 + SELECT(q1 >= zero, root, -root));
  vector one = sum / q2, two = q0 / sum;
  const vector above = *r * ALL(1 + 1e-12);
  const mask real = discriminant >= zero;
  const mask is_one = real & (one > above) & (one < none) & ((u + v * one) * w >= zero) &
                      (s2[0] + one * (s2[1] + one * s2[2]) >= zero);
  const mask is_two = real & (two > above) & (two < none) & ((u + v * two) * w >= zero) &
                      (s2[0] + two * (s2[1] + two * s2[2]) >= zero);
  one = SELECT(is_one, one, none);
  two = SELECT(is_two, two, none);
  *first = MIN(one, two);
  *second = MAX(one, two);
}

/* 0: r is no exit that counts, nor is any beyond it. */
static inline int meet(packing_i_front_interval *interval, double r)
{
  double *e = interval->exit;
  if (!(r < e[2]))
    return 0;
  if (r < e[1]) {
    e[2] = e[1];
    if (r < e[0]) {
      e[1] = e[0];
      e[0] = r;
    } else {
      e[1] = r;
    }
  } else {
    e[2] = r;
  }
  return 1;
}

TARGET static void interval(const packing_i_front_curve *curve,
                            const packing_i_front_halo *halo, size_t j, size_t k,
                            double r, double cap, double slack,
                            packing_i_front_interval *result)
{
  const vector none = ALL(HUGE_VAL), start = ALL(r);
  const vector s2[3] = {ALL(curve->s2[0]), ALL(curve->s2[1]), ALL(curve->s2[2])};
  const double height2 = curve->s2[0] + r * (curve->s2[1] + r * curve->s2[2]);
  const vector s = ALL(height2 > 0 ? sqrt(height2) : 0);
  const double cap2 = curve->s2[0] + cap * (curve->s2[1] + cap * curve->s2[2]);
  const double top2 =
      curve->s2[2] < 0 && -0.5 * curve->s2[1] / curve->s2[2] < cap
          ? curve->s2[0] - 0.25 * curve->s2[1] * curve->s2[1] / curve->s2[2]
          : cap2;
  const vector most = ALL(sqrt(top2 > height2 ? top2
                               : height2 > 0  ? height2
                                              : 0)),
               end = ALL(cap);
  vector lo = start, e0 = none, e1 = none, e2 = none;
  for (size_t t = 0; t < halo->count; t += WIDTH) {
    const vector x = LOAD(halo->x + t), y = LOAD(halo->y + t), z = LOAD(halo->z + t);
    const vector u =
        LOAD(halo->a + t) -
        (ALL(curve->base.x) * x + ALL(curve->base.y) * y + ALL(curve->base.z) * z);
    const vector v =
        LOAD(halo->b + t) -
        (ALL(curve->slope.x) * x + ALL(curve->slope.y) * y + ALL(curve->slope.z) * z);
    const vector w =
        ALL(curve->side.x) * x + ALL(curve->side.y) * y + ALL(curve->side.z) * z;
    const vector room = u + v * start - w * s;
    const vector number = lanes + ALL((double)t);
    const mask other = (number < ALL((double)halo->count)) & (number != ALL((double)j)) &
                       (number != ALL((double)k));
    /* Up to the cap no body is met where even the largest s leaves room. */
    const vector away = MAX(w, ALL(0.0)) * most;
    const mask meets = ((u + v * start < away) | (u + v * end < away)) & other;
    if (mask_bits(&meets) == 0)
      continue;
    const vector body[3] = {u, v, w};
    vector first, second;
    exits(body, s2, &start, &first, &second);
    const mask blocked = (room < ALL(-slack)) & other;
    lo = MAX(lo, SELECT(blocked, first, start));
    const vector next = SELECT(other, SELECT(blocked, second, first), none);
    const vector a = MAX(e0, next);
    e0 = MIN(e0, next);
    const vector b = MAX(e1, a);
    e1 = MIN(e1, a);
    e2 = MIN(e2, b);
  }
  double lane[4][WIDTH] __attribute__((aligned(64)));
  STORE(lane[0], e0);
  STORE(lane[1], e1);
  STORE(lane[2], e2);
  STORE(lane[3], lo);
  result->lo = r;
  result->exit[0] = result->exit[1] = result->exit[2] = HUGE_VAL;
  for (unsigned n = 0; n < WIDTH; n++) {
    for (unsigned e = 0; e < 3 && meet(result, lane[e][n]); e++)
      ;
    if (lane[3][n] > result->lo)
      result->lo = lane[3][n];
  }
}

TARGET static void bounds(const packing_i_front_curves *c, size_t count)
{
  for (size_t t = 0; t < count; t += WIDTH) {
    const vector x = LOAD(c->x + t), y = LOAD(c->y + t), z = LOAD(c->z + t),
                 r = LOAD(c->lo + t);
    const vector u =
        LOAD(c->a + t) -
        (LOAD(c->base[0] + t) * x + LOAD(c->base[1] + t) * y + LOAD(c->base[2] + t) * z);
    const vector v =
        LOAD(c->b + t) - (LOAD(c->slope[0] + t) * x + LOAD(c->slope[1] + t) * y +
                          LOAD(c->slope[2] + t) * z);
    const vector w =
        LOAD(c->side[0] + t) * x + LOAD(c->side[1] + t) * y + LOAD(c->side[2] + t) * z;
    const vector s2[3] = {LOAD(c->s2[0] + t), LOAD(c->s2[1] + t), LOAD(c->s2[2] + t)};
    const vector height2 = s2[0] + r * (s2[1] + r * s2[2]);
    vector height = MAX(height2, ALL(0.0));
    take_root(&height);
    const vector body[3] = {u, v, w};
    vector first, second;
    exits(body, s2, &r, &first, &second);
    STORE(c->room + t, u + v * r - w * height);
    STORE(c->first + t, first);
    STORE(c->second + t, second);
  }
}
