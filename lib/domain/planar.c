/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Box and rectangle: an interval along each axis, with a wall, an open top or a periodic
 * border at either end. Everything in constant time. */
#include "domain_kinds.h"
#include <math.h>

static packing_status check(packing_context *context, int dim,
                            const packing_i_planar_def *def)
{
  static const char *const corner[] = {"corner.x", "corner.y", "corner.z"};
  PACKING_I_TRY(packing_i_check_point(context, corner, &def->corner));
  if (dim == 2)
    PACKING_I_TRY(packing_i_domain_check_flat(context, "corner.z", def->corner.z));
  for (int k = 0; k < dim; k++)
    PACKING_I_TRY(packing_i_check_positive(context, def->size_fields[k],
                                           packing_i_component(def->size, k)));
  if (def->periodic >= 1u << dim)
    return packing_i_fail(context, PACKING_ERR_RANGE, "periodic", PACKING_NO_INDEX,
                          "%u names a direction that the container does not have",
                          def->periodic);
  PACKING_I_TRY(packing_i_check_switch(context, "open_top", def->open_top));
  if (def->open_top && def->periodic & 1u << (dim - 1))
    return packing_i_fail(context, PACKING_ERR_INVALID, "open_top", PACKING_NO_INDEX,
                          "the direction of the top is periodic");
  return PACKING_OK;
}

/* Axis k of the body; an axis beyond `dim` has neither walls nor borders. */
static void set_axis(packing_i_domain_body *body, int k, double corner, double size,
                     unsigned periodic, int open)
{
  packing_i_planar *p = &body->as.planar;
  p->wall_lo[k] = p->cut_lo[k] = -HUGE_VAL;
  p->wall_hi[k] = p->cut_hi[k] = HUGE_VAL;
  if (k >= body->dim)
    return;
  packing_i_set_component(&body->bounds.lo, k, corner);
  packing_i_set_component(&body->bounds.hi, k, corner + size);
  if (periodic & 1u << k) {
    packing_i_set_component(&body->period, k, (corner + size) - corner);
    return;
  }
  p->wall_lo[k] = p->cut_lo[k] = corner;
  p->cut_hi[k] = corner + size;
  if (!open)
    p->wall_hi[k] = corner + size;
}

packing_status packing_i_planar_create(packing_context *context,
                                       const packing_i_domain_ops *ops, int dim,
                                       const packing_i_planar_def *def,
                                       packing_domain **domain)
{
  PACKING_I_TRY(check(context, dim, def));
  packing_i_domain_body body = packing_i_domain_body_new(ops, dim);
  body.periodic = def->periodic;
  body.open_axis = def->open_top ? dim - 1 : -1;
  body.volume = 1;
  for (int k = 0; k < 3; k++) {
    set_axis(&body, k, packing_i_component(def->corner, k),
             packing_i_component(def->size, k), def->periodic, k == body.open_axis);
    if (k < dim)
      body.volume *= packing_i_component(def->size, k);
  }
  return packing_i_domain_finish(context, &body, "size", domain);
}

const packing_i_planar *packing_i_domain_planar(const packing_domain *domain)
{
  return domain->body.ops->signed_distance == packing_i_planar_signed_distance
             ? &domain->body.as.planar
             : NULL;
}

/* Distance to the nearer end of axis k, and the direction away from it. */
static double to_end(const packing_i_planar *p, int k, double x, double *away)
{
  const double low = x - p->wall_lo[k];
  const double high = p->wall_hi[k] - x;
  *away = low <= high ? 1 : -1;
  return low <= high ? low : high;
}

/* Outside: the corner or edge of the ends that the point lies beyond. */
static double outside(const double distance[3], const double away[3],
                      packing_vec3 *normal)
{
  double beyond[3];
  int count = 0, last = 0;
  for (int k = 0; k < 3; k++) {
    beyond[k] = distance[k] < 0 ? -distance[k] : 0;
    if (beyond[k] > 0) {
      count++;
      last = k;
    }
  }
  /* Beyond one end only: no square root, so that nothing is lost. */
  const double length =
      count == 1
          ? beyond[last]
          : sqrt(beyond[0] * beyond[0] + beyond[1] * beyond[1] + beyond[2] * beyond[2]);
  if (normal != NULL)
    *normal = packing_i_vec(away[0] * beyond[0] / length, away[1] * beyond[1] / length,
                            away[2] * beyond[2] / length);
  return -length;
}

double packing_i_planar_signed_distance(const packing_i_domain_body *body,
                                        const packing_vec3 *point, packing_vec3 *normal)
{
  double distance[3], away[3];
  int nearest = 0;
  for (int k = 0; k < 3; k++) {
    distance[k] = to_end(&body->as.planar, k, packing_i_component(*point, k), &away[k]);
    if (distance[k] < distance[nearest])
      nearest = k;
  }
  if (distance[nearest] < 0)
    return outside(distance, away, normal);
  if (normal != NULL) {
    *normal = packing_i_vec(0, 0, 0);
    if (isfinite(distance[nearest]))
      packing_i_set_component(normal, nearest, away[nearest]);
  }
  return distance[nearest];
}

int packing_i_planar_holds(const packing_i_domain_body *body, const packing_vec3 *centre,
                           double r)
{
  const packing_i_planar *p = &body->as.planar;
  return centre->x - p->wall_lo[0] >= r && p->wall_hi[0] - centre->x >= r &&
         centre->y - p->wall_lo[1] >= r && p->wall_hi[1] - centre->y >= r &&
         centre->z - p->wall_lo[2] >= r && p->wall_hi[2] - centre->z >= r;
}

int packing_i_planar_near_walls(const packing_i_domain_body *body,
                                const packing_vec3 *point, double reach,
                                packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_i_planar *p = &body->as.planar;
  const double x[3] = {point->x, point->y, point->z};
  int count = 0;
  for (int k = 0; k < 3; k++) {
    const double distance[2] = {x[k] - p->wall_lo[k], p->wall_hi[k] - x[k]};
    for (int side = 0; side < 2; side++)
      if (distance[side] < reach) {
        packing_i_near_wall *wall = &near[count++];
        *wall = (packing_i_near_wall){.distance = distance[side], .wall = 2 * k + side};
        packing_i_set_component(&wall->normal, k, side == 0 ? 1 : -1);
      }
  }
  return count;
}

packing_status packing_i_planar_inset(packing_context *context,
                                      packing_i_domain_body *body, double d)
{
  (void)context;
  packing_i_planar *p = &body->as.planar;
  body->volume = 1;
  for (int k = 0; k < body->dim; k++) {
    double lo = packing_i_component(body->bounds.lo, k);
    double hi = packing_i_component(body->bounds.hi, k);
    p->wall_lo[k] += d;
    p->wall_hi[k] -= d;
    if (isfinite(p->wall_lo[k]))
      lo = p->cut_lo[k] = p->wall_lo[k];
    if (isfinite(p->wall_hi[k]))
      hi = p->cut_hi[k] = p->wall_hi[k];
    packing_i_set_component(&body->bounds.lo, k, lo);
    packing_i_set_component(&body->bounds.hi, k, hi);
    body->volume *= hi > lo ? hi - lo : 0;
  }
  return PACKING_OK;
}
