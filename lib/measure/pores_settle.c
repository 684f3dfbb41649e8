/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a sphere that touches four particles but holds part of a fifth, to an empty one: the nearest
 * sphere that touches the fifth and three of the four and leaves the one it gave up outside is
 * tried next, and so on until nothing is in the way. Its centre is a vertex of the diagram of
 * distances to surfaces (additively weighted, Apollonius), which for unequal spheres is not that of
 * powers; both differ by a few such exchanges. An exchange costs a neighbour query. */
#include "measure/pores_internal.h"
#include "vec.h"

enum { MOST_EXCHANGES = 16 };

typedef struct attempt {
  packing_i_corners q;
  packing_vec3 centre;
  double radius;
  double height;
  double moved; /* distance from the sphere before */
} attempt;

/* Keeps the nearest sphere that touches `q` and not the particle given up. */
static void try_corners(const packing_i_pore_network *n, const packing_i_corners *q,
                        packing_vec3 given_up, double given_up_r, packing_vec3 from,
                        attempt *best)
{
  packing_i_tangency t;
  double radii[2];
  if (!packing_i_tangency_set(&t, n->dim + 1, q->p, q->r) ||
      !(t.height > n->def.tolerance))
    return;
  const int count = packing_i_tangency_radii(&t, radii);
  for (int i = 0; i < count; i++) {
    const packing_vec3 centre = packing_i_tangency_centre(&t, radii[i]);
    const double gap = packing_i_norm(packing_i_sub(centre, given_up)) - given_up_r;
    const double moved = packing_i_norm(packing_i_sub(centre, from));
    if (!(gap >= radii[i] * (1 - n->def.tolerance)) || !(moved < best->moved))
      continue;
    best->q = *q;
    best->centre = centre;
    best->radius = radii[i];
    best->height = t.height;
    best->moved = moved;
  }
}

/* Exchanges one of the corners for particle `other`; 0 where no exchange leaves that one out. */
static int exchange(const packing_i_pore_network *n, attempt *a, uint32_t other)
{
  attempt best = *a;
  best.moved = (double)INFINITY;
  for (int i = 0; i <= n->dim; i++) {
    packing_i_corners q = a->q;
    q.p[i] = packing_i_pores_image(n, other, a->centre);
    q.r[i] = n->r[other];
    q.particle[i] = other;
    try_corners(n, &q, a->q.p[i], a->q.r[i], a->centre, &best);
  }
  if (isinf(best.moved))
    return 0;
  *a = best;
  return 1;
}

static void sort_particles(int count, uint32_t *v)
{
  for (int i = 1; i < count; i++)
    for (int j = i; j > 0 && v[j] < v[j - 1]; j--) {
      const uint32_t lower = v[j];
      v[j] = v[j - 1];
      v[j - 1] = lower;
    }
}

static void take(const packing_i_pore_network *n, const attempt *a,
                 packing_i_pore_cell *c)
{
  const double wall = packing_i_pores_wall(n, a->centre);
  if (!(wall > 0))
    return;
  const int cut = wall < a->radius * (1 - n->def.tolerance);
  c->centre = a->centre;
  c->radius = cut ? wall : a->radius;
  c->limit = cut ? PACKING_PORE_BY_WALL : PACKING_PORE_FREE;
  c->state = PACKING_I_PORE_SPHERE;
  c->height = a->height;
  c->moved = 1;
  for (int k = 0; k <= n->dim; k++)
    c->touch[k] = a->q.particle[k];
  sort_particles(n->dim + 1, c->touch);
}

void packing_i_pores_settle(const packing_i_pore_network *n, const packing_i_corners *q,
                            packing_vec3 centre, double radius, packing_i_pore_cell *c)
{
  attempt a = {*q, centre, radius, 0, 0};
  for (int k = 0; k < MOST_EXCHANGES; k++) {
    uint32_t other = PACKING_I_PORES_NONE;
    if (!packing_i_vec_finite(a.centre))
      return;
    const double clear = packing_i_pores_clearance(n, a.centre, a.radius, &other);
    if (other == PACKING_I_PORES_NONE || clear >= a.radius) {
      take(n, &a, c);
      return;
    }
    if (!exchange(n, &a, other))
      return;
  }
}
