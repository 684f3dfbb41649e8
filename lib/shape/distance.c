/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Directional distance (Perez Morales et al., 3.4.3, equations 4 to 10): the least t >= 0
 * at which a body moved by t v touches another, infinity if it never does.
 *
 * Spheres: w from the fixed to the mobile centre, s the sum of the radii; |w + t v| = s
 * has the roots of A t^2 + B t + C, A = v.v, B = 2 w.v, C = w.w - s^2. The first root
 * counts, where the body comes nearer (B < 0) and the discriminant is not negative; with
 * h^2 = s^2 - |w_perp|^2, what is left of the radii at the closest approach,
 *
 *   t = C / (-w.v + sqrt(A h^2)),
 *
 * in which nothing cancels, neither in the denominator nor, far away, in the
 * discriminant. Departure: where the ray misses, the paper gives the closest approach -B
 * / (2 A), and 0 when the body moves away; both are no contact, and here they are
 * infinity.
 *
 * Walls of built-in containers: wall_distance.c; the rest: march.c. Constant time, but
 * for the rest. */
#include "domain/domain_internal.h"
#include "shape_internal.h"

double packing_i_sphere_distance(packing_vec3 apart, double reach,
                                 const packing_vec3 *direction, int leaving)
{
  const double squared = packing_i_dot(*direction, *direction);
  const double along = packing_i_dot(apart, *direction);
  const packing_vec3 across =
      packing_i_sub(apart, packing_i_scale(*direction, along / squared));
  const double miss = packing_i_norm(across), far = packing_i_norm(apart);
  if (!(miss <= reach))
    return HUGE_VAL;
  const double half = sqrt(squared * ((reach - miss) * (reach + miss)));
  if (leaving)
    return half > along ? (half - along) / squared : HUGE_VAL;
  if (!(along < 0))
    return HUGE_VAL;
  const double room = (far - reach) * (far + reach);
  return room > 0 ? room / (half - along) : 0;
}

/* Spheres around the bodies: while those overlap the bodies may touch. */
static double from_particle(const packing_body *a, const packing_body *b,
                            const packing_vec3 *direction)
{
  const packing_vec3 apart = packing_i_sub(a->centre, b->centre);
  const double reach = a->r + b->r;
  const double to = packing_i_sphere_distance(apart, reach, direction, 1);
  if (!isfinite(to))
    return HUGE_VAL;
  const double from = packing_i_norm(apart) > reach
                          ? packing_i_sphere_distance(apart, reach, direction, 0)
                          : 0;
  return isfinite(from) ? packing_i_march(a, b, direction, from, to) : HUGE_VAL;
}

/* The sphere around a body touches a wall no later than the body. Walls end with the
 * container, or go on above an open top; a few sizes away there is nothing to
 * be touched. */
static double from_wall(const packing_body *a, const packing_body *wall,
                        const packing_vec3 *direction)
{
  packing_body ball = packing_body_sphere(a->centre, a->r);
  double from = 0;
  if (packing_body_wall_gap(&ball, wall->domain, wall->wall, NULL) > 0 &&
      packing_i_wall_distance(&ball, wall, direction, &from) && !isfinite(from))
    return HUGE_VAL;
  packing_bounds bounds;
  packing_domain_bounds(wall->domain, &bounds);
  const double size = packing_i_norm(packing_i_sub(bounds.hi, bounds.lo));
  const double away = packing_i_norm(packing_i_sub(a->centre, bounds.lo));
  return packing_i_march(a, wall, direction, from, from + 4 * (size + away + a->r));
}

double packing_body_distance(const packing_body *a, const packing_body *b,
                             const packing_vec3 *direction)
{
  double distance;
  if (b->domain != NULL) {
    if (a->shape == NULL && packing_i_wall_distance(a, b, direction, &distance))
      return distance;
    return from_wall(a, b, direction);
  }
  const packing_shape *shape = packing_i_pair_shape(a, b);
  if (shape == NULL)
    return packing_i_sphere_distance(packing_i_sub(a->centre, b->centre), a->r + b->r,
                                     direction, 0);
  if (shape->def.distance != NULL)
    return shape->def.distance(shape->def.user, a, b, direction);
  return from_particle(a, b, direction);
}
