/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A container of the user's: a signed distance, positive inside and 1-Lipschitz, and bounds.
 * Volumes come by subdivision (subdivide.c). An inset takes its distance off the user's; it
 * holds the domain it was made from, which alone releases the user's data. */
#include "domain_kinds.h"
#include <math.h>

static double signed_distance(const packing_i_domain_body *body,
                              const packing_vec3 *point, packing_vec3 *normal)
{
  const packing_i_custom *c = &body->as.custom;
  packing_vec3 p = *point;
  if (body->dim == 2)
    p.z = 0;
  return c->signed_distance(c->user, &p, normal) - c->inset;
}

static int near_walls(const packing_i_domain_body *body, const packing_vec3 *point,
                      double reach, packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  packing_i_near_wall nearest = {.wall = 0};
  nearest.distance = signed_distance(body, point, &nearest.normal);
  if (!(nearest.distance < reach))
    return 0;
  near[0] = nearest;
  return 1;
}

packing_status packing_i_custom_volume(packing_context *context,
                                       packing_i_domain_body *body, double tolerance)
{
  const packing_i_tolerance enough = {0, tolerance};
  const packing_vec3 nowhere = {0, 0, 0};
  double volume, error;
  if (packing_i_subdivide_sides(body, &nowhere, 0, enough, PACKING_I_CALLS_FOR_VOLUME,
                                &volume, &error))
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "signed_distance",
                          PACKING_NO_INDEX, "a distance is no number");
  if (error > tolerance * volume)
    return packing_i_fail(context, PACKING_ERR_RANGE, "volume_tolerance",
                          PACKING_NO_INDEX,
                          "the computed volume of %g may be wrong by %g, more than is "
                          "allowed: state the volume, or tighten the bounds",
                          volume, error);
  body->volume = volume;
  return PACKING_OK;
}

packing_status packing_i_custom_inset(packing_context *context,
                                      packing_i_domain_body *body, double d,
                                      double tolerance)
{
  body->volume = 0;
  for (int k = 0; k < body->dim; k++) {
    const double lo = packing_i_component(body->bounds.lo, k) + d;
    const double hi = packing_i_component(body->bounds.hi, k) - d;
    if (!(lo < hi))
      return PACKING_OK;
    packing_i_set_component(&body->bounds.lo, k, lo);
    packing_i_set_component(&body->bounds.hi, k, hi);
  }
  return packing_i_custom_volume(context, body, tolerance);
}

static packing_status inset(packing_context *context, packing_i_domain_body *body,
                            double d)
{
  body->as.custom.inset += d;
  return packing_i_custom_inset(context, body, d, body->as.custom.volume_tolerance);
}

static int sphere_volume(const packing_i_domain_body *body, const packing_vec3 *centre,
                         double r, double tolerance, double *volume, double *error)
{
  const double ball = packing_i_ball_volume(body->dim, r);
  const packing_i_tolerance enough = {fmax(tolerance, 1e-4) * ball, 0};
  return packing_i_subdivide(body, centre, r, enough, PACKING_I_CALLS_FOR_BALL, volume,
                             error);
}

static void inherit(packing_i_domain_body *body, packing_domain *from)
{
  packing_domain *root = from->body.as.custom.root;
  body->as.custom.root = packing_domain_retain(root == NULL ? from : root);
}

static void release(const packing_i_domain_body *body)
{
  const packing_i_custom *c = &body->as.custom;
  if (c->root != NULL)
    packing_domain_destroy(c->root);
  else if (c->release != NULL)
    c->release(c->user);
}

const packing_i_domain_ops packing_i_custom_ops = {
    .name = "custom",
    .reference = "the user's distance; volumes by subdivision",
    .signed_distance = signed_distance,
    .near_walls = near_walls,
    .inset = inset,
    .sphere_volume = sphere_volume,
    .inherit = inherit,
    .release = release,
};

void packing_domain_custom_def_fill(packing_domain_custom_def *def, size_t size)
{
  packing_domain_custom_def defaults = {.dim = 3, .volume_tolerance = 1e-4};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_bounds(packing_context *context,
                                   const packing_domain_custom_def *d)
{
  static const char *const lo[] = {"bounds.lo.x", "bounds.lo.y", "bounds.lo.z"};
  static const char *const hi[] = {"bounds.hi.x", "bounds.hi.y", "bounds.hi.z"};
  PACKING_I_TRY(packing_i_check_point(context, lo, &d->bounds.lo));
  PACKING_I_TRY(packing_i_check_point(context, hi, &d->bounds.hi));
  for (int k = 0; k < d->dim; k++) {
    const double low = packing_i_component(d->bounds.lo, k);
    const double high = packing_i_component(d->bounds.hi, k);
    if (!(low < high) || !isfinite(high - low))
      return packing_i_fail(context, PACKING_ERR_RANGE, hi[k], PACKING_NO_INDEX,
                            "%g must be above %s, %g", high, lo[k], low);
  }
  if (d->dim == 2) {
    PACKING_I_TRY(packing_i_domain_check_flat(context, lo[2], d->bounds.lo.z));
    PACKING_I_TRY(packing_i_domain_check_flat(context, hi[2], d->bounds.hi.z));
  }
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_domain_custom_def *d)
{
  if (d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d must be 2 or 3", d->dim);
  PACKING_I_TRY(check_bounds(context, d));
  PACKING_I_TRY(packing_i_check_not_negative(context, "volume", d->volume));
  PACKING_I_TRY(
      packing_i_check_positive(context, "volume_tolerance", d->volume_tolerance));
  if (d->volume_tolerance >= 1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "volume_tolerance",
                          PACKING_NO_INDEX, "%g must be below 1", d->volume_tolerance);
  return PACKING_OK;
}

/* One question in the middle of the bounds finds the worst mistakes. */
static packing_status probe(packing_context *context, const packing_i_domain_body *body)
{
  packing_vec3 normal = {0, 0, 0};
  const packing_vec3 middle =
      packing_i_scale(packing_i_add(body->bounds.lo, body->bounds.hi), 0.5);
  const double distance = signed_distance(body, &middle, &normal);
  if (isnan(distance) || !packing_i_vec_finite(normal))
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "signed_distance",
                          PACKING_NO_INDEX,
                          "no number in the middle of the bounds, at %g, %g, %g",
                          middle.x, middle.y, middle.z);
  return PACKING_OK;
}

packing_status packing_domain_create_custom(packing_context *context,
                                            const packing_domain_custom_def *def,
                                            packing_domain **domain)
{
  packing_domain_custom_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_custom, release, def, &d));
  if (d.signed_distance == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "signed_distance",
                          PACKING_NO_INDEX, "NULL");
  PACKING_I_TRY(check(context, &d));
  packing_i_domain_body body = packing_i_domain_body_new(&packing_i_custom_ops, d.dim);
  body.bounds = d.bounds;
  body.volume = d.volume;
  body.as.custom = (packing_i_custom){.signed_distance = d.signed_distance,
                                      .release = d.release,
                                      .user = d.user,
                                      .volume_tolerance = d.volume_tolerance};
  PACKING_I_TRY(probe(context, &body));
  if (d.volume == 0)
    PACKING_I_TRY(packing_i_custom_volume(context, &body, d.volume_tolerance));
  if (body.volume == 0)
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "bounds", PACKING_NO_INDEX,
                          "no point in them is inside the container");
  return packing_i_domain_finish(context, &body, "volume", domain);
}
