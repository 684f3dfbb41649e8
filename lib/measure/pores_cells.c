/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sphere of each cell: tangent to its corners (tangent.c), then held against everything else.
 * The power diagram knows nothing of surfaces, so for unequal spheres another particle may reach
 * into it: of two roots the free one is taken, the smaller if both are; where none is free the
 * void nearby is looked for (pores_settle.c); failing that, the sphere keeps its centre and shrinks
 * to the nearest surface, which leaves a true void and the ways through it, and tells so. Walls
 * shrink likewise. One neighbour query a cell; linear. */
#include "measure/pores_internal.h"
#include "vec.h"

/* The cell with one of its roots for a radius. */
static void try_root(const packing_i_pore_network *n, const packing_i_tangency *t,
                     double radius, packing_i_pore_cell *c)
{
  c->centre = packing_i_tangency_centre(t, radius);
  c->radius = radius;
  c->limit = PACKING_PORE_FREE;
  c->state = PACKING_I_PORE_OUTSIDE;
  const double wall =
      packing_i_vec_finite(c->centre) ? packing_i_pores_wall(n, c->centre) : 0;
  if (!(wall > 0))
    return;
  if (wall < radius * (1 - n->def.tolerance)) {
    c->radius = wall;
    c->limit = PACKING_PORE_BY_WALL;
  }
  const double clear = packing_i_pores_clearance(n, c->centre, c->radius, NULL);
  if (clear < c->radius)
    c->limit = PACKING_PORE_BY_PARTICLE;
  c->radius = clear;
  c->state = clear > 0 ? PACKING_I_PORE_SPHERE : PACKING_I_PORE_CLOSED;
}

/* Spheres before none (states are ordered so), free ones before limited ones, the first before the
 * second. */
static int is_better(const packing_i_pore_cell *a, const packing_i_pore_cell *b)
{
  if (a->state != b->state)
    return a->state < b->state;
  return a->limit == PACKING_PORE_FREE && b->limit != PACKING_PORE_FREE;
}

static void fill_cell(const packing_i_pore_network *n, packing_i_pore_cell *c)
{
  packing_i_corners q;
  double radii[2];
  packing_i_tangency t;
  for (int k = 0; k <= n->dim; k++) {
    q.p[k] = packing_i_pores_copy(n, c->corner[k]);
    q.r[k] = n->r[c->corner[k]];
    q.particle[k] = c->touch[k] = n->particle[c->corner[k]];
  }
  c->height = 0;
  c->moved = 0;
  c->state = PACKING_I_PORE_FLAT;
  if (!packing_i_tangency_set(&t, n->dim + 1, q.p, q.r) || !(t.height > n->def.tolerance))
    return;
  c->height = t.height;
  c->state = PACKING_I_PORE_CLOSED;
  const int count = packing_i_tangency_radii(&t, radii);
  for (int i = 0; i < count; i++) {
    packing_i_pore_cell other = *c;
    try_root(n, &t, radii[i], &other);
    if (i == 0 || is_better(&other, c))
      *c = other;
  }
  if (count > 0 &&
      (c->state == PACKING_I_PORE_CLOSED ||
       (c->state == PACKING_I_PORE_SPHERE && c->limit == PACKING_PORE_BY_PARTICLE)))
    packing_i_pores_settle(n, &q, packing_i_tangency_centre(&t, radii[0]), radii[0], c);
}

static void fill_block(void *arg, size_t block)
{
  packing_i_pore_network *n = arg;
  const size_t end = packing_i_measure_block_end(block, n->cells);
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++)
    fill_cell(n, &n->cell[i]);
}

void packing_i_pores_fill_cells(packing_i_pore_network *n)
{
  packing_i_parallel(n->context, packing_i_measure_blocks(n->cells), fill_block, n);
}
