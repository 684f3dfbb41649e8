/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gaps between bodies (Perez Morales et al., equation 1): positive apart, 0 in outer
 * contact, negative where the insides overlap.
 *
 *   spheres, discs   |c_1 - c_2| - (r_1 + r_2), the same to the bit when they are swapped
 *   wall             the distance of the centre from the wall, less the radius
 *   other shapes     the shape's own functions
 *
 * Constant time; containers of many walls search for the one of a number. */
#include "domain/domain_internal.h"
#include "shape_internal.h"

/* The wall of a number among those within reach; NULL: it is not. *count: of how many. */
static const packing_i_near_wall *wall_within(const packing_domain *domain, int wall,
                                              const packing_vec3 *point, double reach,
                                              packing_i_near_wall *near, int *count)
{
  *count = packing_i_domain_near_walls(domain, point, reach, near);
  for (int i = 0; i < *count; i++)
    if (near[i].wall == wall)
      return &near[i];
  return NULL;
}

/* Whether all walls are told at once: a handful, in constant time. */
static int is_plain(const packing_domain *domain)
{
  return packing_i_domain_planar(domain) != NULL ||
         packing_i_domain_round(domain) != NULL || packing_i_domain_axis(domain) >= 0;
}

/* Distance from one of the container's walls. Containers with walls without number tell
 * the nearest few within reach, and the search costs more the farther it goes: it begins
 * within a few radii and ends when it has been everywhere, or other walls are nearer. */
static double numbered_wall(const packing_body *a, const packing_domain *domain, int wall,
                            packing_vec3 *normal)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_i_near_wall *found = NULL;
  const packing_bounds *b = &domain->body.bounds;
  const double everywhere = packing_i_norm(packing_i_sub(b->hi, b->lo));
  int count = 0;
  double reach = is_plain(domain) ? HUGE_VAL : 4 * a->r;
  for (;;) {
    found = wall_within(domain, wall, &a->centre, reach, near, &count);
    if (found != NULL || count == PACKING_I_NEAR_WALLS || reach > everywhere)
      break;
    reach *= 8;
  }
  if (normal != NULL)
    *normal = found == NULL ? packing_i_vec(0, 0, 0) : found->normal;
  return found == NULL ? HUGE_VAL : found->distance;
}

double packing_body_wall_gap(const packing_body *a, const packing_domain *domain,
                             int wall, packing_vec3 *normal)
{
  if (a->shape != NULL)
    return a->shape->def.clearance(a->shape->def.user, a, domain, wall, normal);
  if (wall < 0)
    return packing_domain_signed_distance(domain, &a->centre, normal) - a->r;
  return numbered_wall(a, domain, wall, normal) - a->r;
}

double packing_body_gap(const packing_body *a, const packing_body *b)
{
  if (b->domain != NULL)
    return packing_body_wall_gap(a, b->domain, b->wall, NULL);
  if (a->domain != NULL)
    return packing_body_wall_gap(b, a->domain, a->wall, NULL);
  const packing_shape *shape = packing_i_pair_shape(a, b);
  if (shape != NULL)
    return shape->def.gap(shape->def.user, a, b);
  return packing_i_norm(packing_i_sub(a->centre, b->centre)) - (a->r + b->r);
}

int packing_body_overlap(const packing_body *a, const packing_body *b)
{
  if (a->domain == NULL && b->domain == NULL) {
    const packing_shape *shape = packing_i_pair_shape(a, b);
    if (shape != NULL && shape->def.overlap != NULL)
      return shape->def.overlap(shape->def.user, a, b) != 0;
  }
  return packing_body_gap(a, b) < 0;
}

double packing_body_clearance(const packing_body *a, const packing_domain *domain,
                              packing_vec3 *normal)
{
  return packing_body_wall_gap(a, domain, -1, normal);
}
