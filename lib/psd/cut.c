/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws with one hump, cut to [min_r, max_r]: normal, lognormal, Weibull, gamma, exponential. */
#include "smooth_internal.h"
#include <math.h>

/* A cut that keeps less of the law is taken for a mistake. */
static const double least_kept = 1e-15;

typedef struct cut {
  const packing_i_cut_law *law;
  double log_scale; /* the largest log density in the cut, taken out before exp */
} cut;

double packing_i_psd_unit(double max_r)
{
  int exponent;
  frexp(max_r, &exponent);
  return ldexp(1, exponent);
}

static double density_at(const void *self, double x)
{
  const cut *c = self;
  return exp(c->law->log_density(c->law->parameter, x) - c->log_scale);
}

static double log_weighted(const cut *c, double x, int s)
{
  return c->law->log_density(c->law->parameter, x) - c->log_scale + s * log(x);
}

static double log_largest(const void *self, double lo, double hi, int s)
{
  const cut *c = self;
  const double mode = c->law->mode(c->law->parameter, s);
  const double ends = fmax(log_weighted(c, lo, s), log_weighted(c, hi, s));
  return mode > lo && mode < hi ? fmax(ends, log_weighted(c, mode, s)) : ends;
}

static packing_status keeps_nothing(packing_context *context, double min_r, double max_r)
{
  return packing_i_fail(context, PACKING_ERR_RANGE, "min_r", PACKING_NO_INDEX,
                        "the cut to min_r = %g, max_r = %g keeps less than %g of the law",
                        min_r, max_r, least_kept);
}

packing_status packing_i_cut_create(packing_context *context,
                                    const packing_i_psd_ops *ops,
                                    const packing_i_cut_law *law, packing_by by, int dim,
                                    double min_r, double max_r, packing_psd **psd)
{
  cut c = {law, 0};
  const packing_i_density density = {density_at, log_largest, &c};
  packing_i_smooth_builder b;
  packing_status status = packing_i_smooth_begin(&b, context, ops, by, dim, min_r, max_r);
  if (status != PACKING_OK)
    return status;
  packing_psd *p = &b.smooth->base;
  c.log_scale = log_largest(&c, p->min_x, p->max_x, 0);
  if (!(c.log_scale > -700)) {
    status = keeps_nothing(context, min_r, max_r);
    goto out;
  }
  status = packing_i_smooth_interval(&b, &density, p->min_x, p->max_x);
  if (status != PACKING_OK)
    goto out;
  const int counted =
      by == PACKING_BY_MASS ? dim : 0; /* where the law's own x^0 stands */
  if (!(b.total[counted - PACKING_I_PSD_LEAST_POWER] * exp(c.log_scale) >= least_kept)) {
    status = keeps_nothing(context, min_r, max_r);
    goto out;
  }
  packing_i_smooth_end(&b);
  *psd = p;
  p = NULL;
out:
  packing_psd_destroy(p);
  return status;
}
