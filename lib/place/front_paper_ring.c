/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "front_paper_ring.h"

packing_i_ring_body packing_i_ring_body_of(packing_vec3 p, double r_l, double r,
                                           double unit, double slack)
{
  packing_i_ring_body body = {.t = (r_l + r) / unit};
  body.p = packing_i_vec(p.x / unit, p.y / unit, p.z / unit);
  const double d = packing_i_norm(body.p);
  body.d = d;
  body.a = 0.5 * (1 + (d - body.t) * (d + body.t));
  body.cosine = body.a / d;
  const double sine2 = (1 - body.cosine) * (1 + body.cosine);
  body.sine = sine2 > 0 ? sqrt(sine2) : 0;
  body.slack = slack / unit * body.t;
  return body;
}

int packing_i_ring_of(const packing_i_ring_body *j, packing_i_ring *ring)
{
  const packing_vec3 n = packing_i_vec(j->p.x / j->d, j->p.y / j->d, j->p.z / j->d);
  ring->n = n;
  ring->h = j->cosine;
  ring->w = j->sine;
  if (!(ring->w > 0))
    return 0;
  const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
  const packing_vec3 e = x <= y && x <= z ? packing_i_vec(0, n.z, -n.y)
                         : y <= z         ? packing_i_vec(-n.z, 0, n.x)
                                          : packing_i_vec(n.y, -n.x, 0);
  const double length = packing_i_norm(e);
  ring->e = packing_i_vec(e.x / length, e.y / length, e.z / length);
  ring->f = packing_i_cross(n, ring->e);
  return 1;
}

packing_i_ring packing_i_ring_flat(void)
{
  const packing_i_ring ring = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 0, 1};
  return ring;
}

int packing_i_ring_bounds(const packing_i_ring *ring, const packing_i_ring_body *bodies,
                          size_t count, size_t skip, packing_i_ring_bound *bounds,
                          size_t *bounding)
{
  const packing_vec3 e = packing_i_scale(ring->e, ring->w);
  const packing_vec3 f = packing_i_scale(ring->f, ring->w);
  const packing_vec3 n = packing_i_scale(ring->n, ring->h);
  size_t held = 0;
  for (size_t l = 0; l < count; l++) {
    const packing_i_ring_body *body = &bodies[l];
    const double a = packing_i_dot(e, body->p), b = packing_i_dot(f, body->p);
    const double c = body->a - packing_i_dot(n, body->p), most = c + body->slack;
    if (most * most >= a * a + b * b) {
      if (most > 0 || l == skip)
        continue;
      return 0;
    }
    if (l != skip)
      bounds[held++] = (packing_i_ring_bound){a, b, c, most, l};
  }
  *bounding = held;
  return 1;
}

/* x and y of both ends; rounding may leave the root of a small negative number. */
static void ends_of(const packing_i_ring_bound *bound, double x[2], double y[2])
{
  const double a = bound->a, b = bound->b, c = bound->c, h2 = a * a + b * b;
  const double s2 = h2 - c * c, s = s2 > 0 ? sqrt(s2) : 0, share = 1 / h2;
  x[0] = (a * c - b * s) * share;
  y[0] = (b * c + a * s) * share;
  x[1] = (a * c + b * s) * share;
  y[1] = (b * c - a * s) * share;
}

static int takes(const packing_i_ring_bound *bound, double x, double y)
{
  return bound->a * x + bound->b * y > bound->most;
}

size_t packing_i_ring_ends(const packing_i_ring_body *bodies,
                           const packing_i_ring_bound *bounds, size_t bounding,
                           size_t from, size_t upto, packing_i_ring_end *ends)
{
  size_t found = 0, last = 0; /* the bound that took the last place is tried first */
  for (size_t k = from; k < upto; k++) {
    if (bodies[bounds[k].body].done)
      continue;
    double x[2], y[2];
    unsigned sides = 0;
    ends_of(&bounds[k], x, y);
    for (unsigned side = 0; side < 2; side++) {
      if (last != k && takes(&bounds[last], x[side], y[side]))
        continue;
      size_t l = 0;
      while (l < bounding && (l == k || !takes(&bounds[l], x[side], y[side])))
        l++;
      if (l == bounding)
        sides |= 1U << side;
      else
        last = l;
    }
    if (sides != 0)
      ends[found++] = (packing_i_ring_end){k, sides};
  }
  return found;
}

packing_vec3 packing_i_ring_at(const packing_i_ring *ring,
                               const packing_i_ring_bound *bound, unsigned side)
{
  double x[2], y[2];
  ends_of(bound, x, y);
  const packing_vec3 across = packing_i_add(packing_i_scale(ring->e, x[side - 1]),
                                            packing_i_scale(ring->f, y[side - 1]));
  return packing_i_add(packing_i_scale(ring->n, ring->h),
                       packing_i_scale(across, ring->w));
}

packing_vec3 packing_i_ring_polish(packing_vec3 q, packing_vec3 p_j, double a_j,
                                   packing_vec3 p_k, double a_k)
{
  const packing_vec3 jk = packing_i_cross(p_j, p_k);
  const double det = 2 * packing_i_dot(q, jk);
  const packing_vec3 twice = packing_i_scale(q, 2);
  const packing_vec3 sum = packing_i_add(
      packing_i_scale(jk, packing_i_dot(q, q) - 1),
      packing_i_add(
          packing_i_scale(packing_i_cross(p_k, twice), packing_i_dot(q, p_j) - a_j),
          packing_i_scale(packing_i_cross(twice, p_j), packing_i_dot(q, p_k) - a_k)));
  const packing_vec3 step = packing_i_vec(sum.x / det, sum.y / det, sum.z / det);
  return packing_i_vec_finite(step) ? packing_i_sub(q, step) : q;
}
