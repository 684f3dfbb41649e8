/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sphere of each cell: tangent to its corners (tangent.c), then held against everything else.
 * The power diagram knows nothing of surfaces, so for unequal spheres another particle may reach
 * into it: of two roots the free one is taken, the smaller if both are; where none is free the
 * sphere keeps its centre and shrinks to the nearest surface, which leaves a true void and the
 * ways through it, and tells so. Walls count likewise. One neighbour query a cell; linear. */
#include "measure/pores_internal.h"
#include "vec.h"

enum { NEAR = 128 /* particles looked at at once */ };

/* How far a point is from the nearest of particles listed; those of a periodic cell by their
 * nearest images. */
static double nearest_surface(const packing_i_pore_network *n, packing_vec3 at,
                              const size_t *list, size_t count)
{
  double nearest = INFINITY;
  for (size_t i = 0; i < count; i++) {
    const size_t k = list[i];
    packing_vec3 d = packing_i_sub(packing_i_pores_copy(n, (uint32_t)k), at);
    double *const axis[] = {&d.x, &d.y, &d.z};
    for (int a = 0; a < 3; a++)
      if (n->period[a] > 0)
        *axis[a] -= n->period[a] * floor(*axis[a] / n->period[a] + 0.5);
    nearest = fmin(nearest, packing_i_norm(d) - n->r[k]);
  }
  return nearest;
}

double packing_i_pores_clearance(const packing_i_pore_network *n, packing_vec3 centre,
                                 double radius)
{
  size_t list[NEAR], count = 0;
  const packing_vec3 at = packing_i_add(centre, n->origin);
  double reach = radius * (1 - n->def.tolerance), clear = 0;
  PACKING_IGNORE(packing_grid_near(n->grid, &at, reach, list, NEAR, &count));
  if (count == 0)
    return radius;
  for (int halvings = 0; count > NEAR && halvings < 64; halvings++) {
    const double middle =
        clear + (reach - clear) / 2; /* nothing is nearer than `clear` */
    PACKING_IGNORE(packing_grid_near(n->grid, &at, middle, list, NEAR, &count));
    if (count == 0)
      clear = middle;
    else
      reach = middle;
    if (count == 0)
      PACKING_IGNORE(packing_grid_near(n->grid, &at, reach, list, NEAR, &count));
  }
  return nearest_surface(n, centre, list, count < NEAR ? count : NEAR);
}

double packing_i_pores_wall(const packing_i_pore_network *n, packing_vec3 centre)
{
  const packing_vec3 at = packing_i_add(centre, n->origin);
  if (n->domain != NULL)
    return packing_domain_signed_distance(n->domain, &at, NULL);
  const double x = fmin(at.x - n->box.lo.x, n->box.hi.x - at.x),
               y = fmin(at.y - n->box.lo.y, n->box.hi.y - at.y),
               z = fmin(at.z - n->box.lo.z, n->box.hi.z - at.z);
  return fmin(fmin(x, y), n->dim == 2 ? (double)INFINITY : z) > 0 ? (double)INFINITY : 0;
}

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
  const double clear = packing_i_pores_clearance(n, c->centre, c->radius);
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
  packing_vec3 p[4];
  double r[4], radii[2];
  packing_i_tangency t;
  for (int k = 0; k <= n->dim; k++) {
    p[k] = packing_i_pores_copy(n, c->corner[k]);
    r[k] = n->r[c->corner[k]];
  }
  c->height = 0;
  c->state = PACKING_I_PORE_FLAT;
  if (!packing_i_tangency_set(&t, n->dim + 1, p, r) || !(t.height > n->def.tolerance))
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
