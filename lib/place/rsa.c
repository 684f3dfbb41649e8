/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random sequential addition: options and the choice of method.
 * Campello and Cassares (2016), section 2, step 2. */
#include "rsa_internal.h"
#include <assert.h>
#include <float.h>

int packing_i_rsa_wants(const packing_i_rsa_goal *goal,
                        const packing_placer_report *tally, double next)
{
  if (goal->count != 0 && tally->placed >= goal->count)
    return 0;
  return goal->solid_volume == 0 ||
         tally->solid_volume + 0.5 * next <= goal->solid_volume;
}

double packing_i_rsa_progress(const packing_i_rsa_goal *goal,
                              const packing_placer_report *tally)
{
  double progress = 0;
  if (goal->count != 0)
    progress = (double)tally->placed / (double)goal->count;
  if (goal->solid_volume != 0 && tally->solid_volume / goal->solid_volume > progress)
    progress = tally->solid_volume / goal->solid_volume;
  return progress < 1 ? progress : 1;
}

void packing_rsa_def_fill(packing_rsa_def *def, size_t size)
{
  packing_rsa_def defaults = {0};
  defaults.seed = 1;
  defaults.order = PACKING_ORDER_DRAWN;
  defaults.max_failures = 1000000;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check(packing_context *context, const packing_rsa_def *def)
{
  PACKING_I_TRY(
      packing_i_check_not_negative(context, "volume_fraction", def->volume_fraction));
  if (def->volume_fraction >= 1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "volume_fraction", PACKING_NO_INDEX,
                          "%g must be below 1", def->volume_fraction);
  if (def->order != PACKING_ORDER_DRAWN && def->order != PACKING_ORDER_DESCENDING)
    return packing_i_fail(context, PACKING_ERR_RANGE, "order", PACKING_NO_INDEX,
                          "%d is no order", (int)def->order);
  if (def->order == PACKING_ORDER_DESCENDING && def->count == 0 &&
      def->volume_fraction == 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "order", PACKING_NO_INDEX,
                          "descending needs a count or a volume fraction");
  if (def->max_failures == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "max_failures", PACKING_NO_INDEX,
                          "0 must be at least 1");
  return PACKING_OK;
}

/* Equal sizes in a periodic cell have a known limit: a volume fraction above it is refused at
 * once. A count may exceed it by the scatter of a small cell, sqrt(N) + 1: a cell of one or two
 * can hold one more. */
static packing_status check_limit(const packing_placer *placer,
                                  const packing_rsa_def *def)
{
  const int dim = packing_domain_dim(placer->domain);
  const unsigned all = dim == 2
                           ? PACKING_PERIODIC_X | PACKING_PERIODIC_Y
                           : PACKING_PERIODIC_X | PACKING_PERIODIC_Y | PACKING_PERIODIC_Z;
  if ((packing_domain_periodic(placer->domain) & all) != all)
    return PACKING_OK;
  const double limit =
      dim == 2 ? PACKING_I_RSA_SATURATION_2D : PACKING_I_RSA_SATURATION_3D;
  const double ball = packing_i_ball_volume(dim, packing_psd_max_r(placer->psd));
  const double saturated = limit * placer->domain_volume / ball,
               count = (double)def->count;
  const int counts = count > 0, fills = def->volume_fraction > 0;
  /* Whichever comes first ends the run: one within reach is enough. */
  if ((!counts && !fills) || (counts && count <= saturated + sqrt(saturated) + 1) ||
      (fills && def->volume_fraction <= limit))
    return PACKING_OK;
  const double asked =
      fills ? def->volume_fraction : count * ball / placer->domain_volume;
  return packing_i_fail(
      placer->context, PACKING_ERR_RANGE, fills ? "volume_fraction" : "count",
      PACKING_NO_INDEX,
      "a volume fraction of %.4f is asked; random sequential addition of "
      "equal particles in a large periodic cell saturates at %.4f",
      asked, limit);
}

/* Whether the sizes asked and those in the store are one, of one component. */
static int all_equal(const packing_placer *placer)
{
  const double r = packing_psd_min_r(placer->psd);
  if (packing_psd_max_r(placer->psd) > r || packing_psd_components(placer->psd) > 1)
    return 0;
  for (size_t i = 0; i < placer->particles->count; i++)
    if (placer->particles->r[i] < r || placer->particles->r[i] > r)
      return 0;
  return 1;
}

packing_status packing_rsa_create(packing_context *context, const packing_rsa_def *def,
                                  packing_domain *domain, packing_psd *psd,
                                  packing_particles *particles, packing_placer **placer)
{
  packing_rsa_def d;
  packing_placer *p = NULL;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_rsa, max_failures, def, &d));
  PACKING_I_TRY(check(context, &d));
  PACKING_I_TRY(packing_i_placer_create(context, &packing_i_rsa_mixed_ops, domain, psd,
                                        particles, placer == NULL ? NULL : &p));
  assert(p != NULL);
  packing_i_rsa_goal goal = {d.count, d.volume_fraction * p->domain_volume};
  if (d.volume_fraction > 0 && !(goal.solid_volume > 0))
    goal.solid_volume = DBL_MIN; /* the product underflows; 0 would be no limit */
  packing_status status = packing_i_placer_check_room(p);
  if (status != PACKING_OK)
    goto out;
  if (all_equal(p)) {
    status = check_limit(p, &d);
    if (status != PACKING_OK)
      goto out;
    p->ops = &packing_i_rsa_equal_ops;
    status = packing_i_rsa_equal_start(p, &d, &goal);
  } else {
    status = packing_i_rsa_mixed_start(p, &d, &goal);
  }
out:
  if (status != PACKING_OK) {
    packing_placer_destroy(p);
    return status;
  }
  *placer = p;
  return PACKING_OK;
}
