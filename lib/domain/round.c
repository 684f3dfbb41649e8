/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sphere, circle and annulus: distances from a centre, balls cut by lenses (lens.c). All in
 * constant time. */
#include "domain_kinds.h"
#include <float.h>
#include <math.h>

static void derive(packing_i_domain_body *body)
{
  const packing_i_round *s = &body->as.round;
  const double wide = s->outer, deep = body->dim == 3 ? s->outer : 0;
  body->bounds.lo = packing_i_sub(s->centre, packing_i_vec(wide, wide, deep));
  body->bounds.hi = packing_i_add(s->centre, packing_i_vec(wide, wide, deep));
  body->volume = 0;
  if (s->outer > s->inner)
    body->volume = body->dim == 3
                       ? packing_i_ball_volume(3, s->outer)
                       : PACKING_I_PI * (s->outer - s->inner) * (s->outer + s->inner);
}

packing_status packing_i_round_create(packing_context *context,
                                      const packing_i_domain_ops *ops, int dim,
                                      const packing_i_round *def, packing_domain **domain)
{
  static const char *const centre[] = {"centre.x", "centre.y", "centre.z"};
  PACKING_I_TRY(packing_i_check_point(context, centre, &def->centre));
  if (dim == 2)
    PACKING_I_TRY(packing_i_domain_check_flat(context, "centre.z", def->centre.z));
  packing_i_domain_body body = packing_i_domain_body_new(ops, dim);
  body.as.round = *def;
  derive(&body);
  return packing_i_domain_finish(context, &body, "centre", domain);
}

const packing_i_round *packing_i_domain_round(const packing_domain *domain)
{
  return domain->body.ops->signed_distance == packing_i_round_signed_distance
             ? &domain->body.as.round
             : NULL;
}

static double radius_of(const packing_i_domain_body *body, const packing_vec3 *point,
                        packing_vec3 *radial)
{
  packing_vec3 v = packing_i_sub(*point, body->as.round.centre);
  if (body->dim == 2)
    v.z = 0;
  const double rho = packing_i_norm(v);
  *radial =
      rho > 0 ? packing_i_vec(v.x / rho, v.y / rho, v.z / rho) : packing_i_vec(1, 0, 0);
  return rho;
}

double packing_i_round_signed_distance(const packing_i_domain_body *body,
                                       const packing_vec3 *point, packing_vec3 *normal)
{
  const packing_i_round *s = &body->as.round;
  packing_vec3 radial;
  const double rho = radius_of(body, point, &radial);
  const double outer = s->outer - rho;
  const double inner = s->inner > 0 ? rho - s->inner : HUGE_VAL;
  if (normal != NULL)
    *normal = packing_i_scale(radial, outer <= inner ? -1 : 1);
  return outer <= inner ? outer : inner;
}

int packing_i_round_near_walls(const packing_i_domain_body *body,
                               const packing_vec3 *point, double reach,
                               packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_i_round *s = &body->as.round;
  packing_vec3 radial;
  const double rho = radius_of(body, point, &radial);
  int count = 0;
  if (s->outer - rho < reach)
    near[count++] = (packing_i_near_wall){s->outer - rho, packing_i_scale(radial, -1), 0};
  if (s->inner > 0 && rho - s->inner < reach)
    near[count++] = (packing_i_near_wall){rho - s->inner, radial, 1};
  return count;
}

packing_status packing_i_round_inset(packing_context *context,
                                     packing_i_domain_body *body, double d)
{
  (void)context;
  packing_i_round *s = &body->as.round;
  s->outer -= d;
  if (s->inner > 0)
    s->inner += d;
  derive(body);
  return PACKING_OK;
}

int packing_i_round_sphere_volume(const packing_i_domain_body *body,
                                  const packing_vec3 *centre, double r, double tolerance,
                                  double *volume, double *error)
{
  (void)tolerance;
  const packing_i_round *s = &body->as.round;
  packing_vec3 radial;
  const double d = radius_of(body, centre, &radial);
  double v = packing_i_lens(body->dim, r, s->outer, d);
  if (s->inner > 0)
    v -= packing_i_lens(body->dim, r, s->inner, d);
  *volume = v > 0 ? v : 0;
  *error = 64 * DBL_EPSILON * packing_i_ball_volume(body->dim, r);
  return 0;
}
