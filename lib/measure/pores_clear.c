/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Room around a point: to the nearest surface, and to the wall. */
#include "measure/pores_internal.h"
#include "vec.h"

enum { NEAR = 128 /* particles looked at at once */ };

packing_vec3 packing_i_pores_image(const packing_i_pore_network *n, uint32_t particle,
                                   packing_vec3 at)
{
  packing_vec3 d = packing_i_sub(packing_i_pores_copy(n, particle), at);
  double *const axis[] = {&d.x, &d.y, &d.z};
  for (int a = 0; a < 3; a++)
    if (n->period[a] > 0)
      *axis[a] -= n->period[a] * floor(*axis[a] / n->period[a] + 0.5);
  return packing_i_add(at, d);
}

/* How far a point is from the nearest of particles listed, and which that is. */
static double nearest_surface(const packing_i_pore_network *n, packing_vec3 at,
                              const size_t *list, size_t count, uint32_t *which)
{
  double nearest = INFINITY;
  for (size_t i = 0; i < count; i++) {
    const uint32_t k = (uint32_t)list[i];
    const packing_vec3 p = packing_i_pores_image(n, k, at);
    const double d = packing_i_norm(packing_i_sub(p, at)) - n->r[k];
    if (d >= nearest)
      continue;
    nearest = d;
    *which = k;
  }
  return nearest;
}

double packing_i_pores_clearance(const packing_i_pore_network *n, packing_vec3 centre,
                                 double radius, uint32_t *which)
{
  size_t list[NEAR], count = 0;
  uint32_t nearest = PACKING_I_PORES_NONE;
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
  const double distance =
      nearest_surface(n, centre, list, count < NEAR ? count : NEAR, &nearest);
  if (which != NULL)
    *which = nearest;
  return distance;
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
