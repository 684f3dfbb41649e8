/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all containers have in common: life, questions, periodic images. */
#include "domain_kinds.h"
#include <math.h>

packing_domain *packing_domain_retain(packing_domain *domain)
{
  if (domain != NULL)
    atomic_fetch_add_explicit(&domain->holds, 1, memory_order_relaxed);
  return domain;
}

void packing_domain_destroy(packing_domain *domain)
{
  if (domain == NULL ||
      atomic_fetch_sub_explicit(&domain->holds, 1, memory_order_acq_rel) != 1)
    return;
  if (domain->body.ops->release != NULL)
    domain->body.ops->release(&domain->body);
  const packing_allocator allocator = domain->allocator;
  packing_i_free(&allocator, domain);
}

packing_i_domain_body packing_i_domain_body_new(const packing_i_domain_ops *ops, int dim)
{
  packing_i_domain_body body = {
      .ops = ops, .dim = dim, .walls = PACKING_I_NEAR_WALLS, .open_axis = -1};
  body.period = packing_i_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
  return body;
}

static packing_status make(packing_context *context, const packing_i_domain_body *body,
                           packing_domain **domain)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_domain *d = packing_i_alloc(allocator, 1, sizeof *d);
  if (d == NULL)
    return packing_i_nomem(context);
  atomic_init(&d->holds, 1);
  d->allocator = *allocator;
  d->body = *body;
  *domain = d;
  return PACKING_OK;
}

packing_status packing_i_domain_finish(packing_context *context,
                                       const packing_i_domain_body *body,
                                       const char *field, packing_domain **domain)
{
  if (!isnormal(body->volume) || body->volume < 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "the container's volume is %g, beyond what a double can hold",
                          body->volume);
  for (int k = 0; k < body->dim; k++) {
    const double lo = packing_i_component(body->bounds.lo, k);
    const double hi = packing_i_component(body->bounds.hi, k);
    if (!(lo < hi) || !isfinite(hi - lo))
      return packing_i_fail(
          context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
          "the container reaches from %g to %g: its size is lost against "
          "its distance from 0",
          lo, hi);
  }
  return make(context, body, domain);
}

packing_status packing_domain_create_inset(packing_context *context,
                                           packing_domain *domain, double distance,
                                           packing_domain **inset)
{
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  PACKING_I_TRY(packing_i_check_given(context, "inset", inset));
  PACKING_I_TRY(packing_i_check_not_negative(context, "distance", distance));
  if (distance == 0) {
    *inset = packing_domain_retain(domain);
    return PACKING_OK;
  }
  packing_i_domain_body body = domain->body;
  PACKING_I_TRY(body.ops->inset(context, &body, distance));
  if (!(body.volume > 0))
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "distance", PACKING_NO_INDEX,
                          "nothing is left of the %s at %g from its walls",
                          body.ops->name, distance);
  PACKING_I_TRY(make(context, &body, inset));
  if (body.ops->inherit != NULL)
    body.ops->inherit(&(*inset)->body, domain);
  return PACKING_OK;
}

const char *packing_domain_kind(const packing_domain *domain)
{
  return domain->body.ops->name;
}

int packing_domain_dim(const packing_domain *domain)
{
  return domain->body.dim;
}

unsigned packing_domain_periodic(const packing_domain *domain)
{
  return domain->body.periodic;
}

double packing_domain_volume(const packing_domain *domain)
{
  return domain->body.volume;
}

void packing_domain_bounds(const packing_domain *domain, packing_bounds *bounds)
{
  *bounds = domain->body.bounds;
}

double packing_domain_signed_distance(const packing_domain *domain,
                                      const packing_vec3 *point, packing_vec3 *normal)
{
  const double sum = point->x + point->y + point->z;
  if (isnan(sum)) {
    if (normal != NULL)
      *normal = packing_i_vec(0, 0, 0);
    return sum;
  }
  return domain->body.ops->signed_distance(&domain->body, point, normal);
}

int packing_domain_holds(const packing_domain *domain, const packing_vec3 *centre,
                         double r)
{
  const packing_i_domain_ops *ops = domain->body.ops;
  if (ops->holds != NULL)
    return ops->holds(&domain->body, centre, r);
  return ops->signed_distance(&domain->body, centre, NULL) >= r;
}

/* x in [lo, hi), where hi is an image of lo. A point a rounding error below lo comes out at
 * lo, since hi itself is no point of the cell. */
static double wrap(double x, double lo, double hi)
{
  if (x >= lo && x < hi)
    return x;
  double offset = fmod(x - lo, hi - lo);
  if (offset < 0)
    offset += hi - lo;
  const double wrapped = lo + offset;
  return wrapped >= hi ? lo : wrapped;
}

void packing_domain_wrap(const packing_domain *domain, packing_vec3 *point)
{
  const packing_bounds *b = &domain->body.bounds;
  const unsigned periodic = domain->body.periodic;
  if (periodic & PACKING_PERIODIC_X)
    point->x = wrap(point->x, b->lo.x, b->hi.x);
  if (periodic & PACKING_PERIODIC_Y)
    point->y = wrap(point->y, b->lo.y, b->hi.y);
  if (periodic & PACKING_PERIODIC_Z)
    point->z = wrap(point->z, b->lo.z, b->hi.z);
}

packing_vec3 packing_domain_separation(const packing_domain *domain,
                                       const packing_vec3 *a, const packing_vec3 *b)
{
  return packing_i_domain_separation(domain, *a, *b);
}

void packing_i_keep_nearest(packing_i_near_wall near[PACKING_I_NEAR_WALLS], int *count,
                            packing_i_near_wall wall)
{
  if (*count == PACKING_I_NEAR_WALLS) {
    const packing_i_near_wall *last = &near[*count - 1];
    if (wall.distance > last->distance ||
        (wall.distance == last->distance && wall.wall > last->wall))
      return;
    --*count;
  }
  int at = (*count)++;
  for (; at > 0 &&
         (near[at - 1].distance > wall.distance ||
          (near[at - 1].distance == wall.distance && near[at - 1].wall > wall.wall));
       at--)
    near[at] = near[at - 1];
  near[at] = wall;
}

int packing_i_domain_keeps_whole(const packing_domain *domain, const packing_vec3 *centre,
                                 double r)
{
  const packing_i_domain_body *body = &domain->body;
  if (!packing_domain_holds(domain, centre, r))
    return 0;
  return body->open_axis < 0 || packing_i_component(body->bounds.hi, body->open_axis) -
                                        packing_i_component(*centre, body->open_axis) >=
                                    r;
}

packing_status packing_domain_sphere_volume(const packing_domain *domain,
                                            const packing_vec3 *centre, double r,
                                            double tolerance, double *volume,
                                            double *error)
{
  if (domain == NULL || centre == NULL || volume == NULL ||
      !packing_i_vec_finite(*centre) || !isfinite(r) || isnan(tolerance))
    return PACKING_ERR_INVALID;
  if (r <= 0 || !(tolerance > 0 && tolerance < 1))
    return PACKING_ERR_RANGE;
  double v = packing_i_ball_volume(domain->body.dim, r);
  double e = 0;
  if (!packing_i_domain_keeps_whole(domain, centre, r) &&
      domain->body.ops->sphere_volume(&domain->body, centre, r, tolerance, &v, &e))
    return PACKING_ERR_GEOMETRY;
  *volume = v;
  if (error != NULL)
    *error = e;
  return PACKING_OK;
}
