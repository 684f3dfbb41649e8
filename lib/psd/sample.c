/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured radii: resampled, or each smoothed by a kernel, r exp(h z) with z standard normal cut
 * to [-3, 3]. As the law counts (by number or by mass) the entries weigh alike and the kernel is
 * that; weighted by x^s a product of independent factors stays one, so the law by number and
 * by mass is entry times kernel, each by number or by mass, and moments multiply.
 *
 * A draw takes one number for the entry and one for the kernel: O(log count). The cdf sums the
 * kernels that cover x, O(count); its inverse bisects that. */
#include "atoms_internal.h"
#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

/* The kernel's reach. */
static const double reach = 3;

typedef struct smoothed {
  packing_i_atoms atoms;
  packing_psd *kernel; /* lognormal about 1, in units of its own */
} smoothed;

static const packing_i_psd_ops resampled_ops = {"sample",
                                                "measured radii",
                                                packing_i_atoms_cdf,
                                                packing_i_atoms_quantile,
                                                packing_i_psd_point,
                                                1,
                                                packing_i_atoms_finish};

static double cdf(const packing_psd *psd, packing_by by, double x)
{
  const smoothed *s = (const smoothed *)psd;
  const double *upto = s->atoms.upto[by == PACKING_BY_MASS];
  const size_t whole =
      packing_i_atoms_count_to(&s->atoms, x / packing_psd_max_r(s->kernel));
  const size_t end =
      packing_i_atoms_count_to(&s->atoms, x / packing_psd_min_r(s->kernel));
  double sum = whole == 0 ? 0 : upto[whole - 1];
  for (size_t i = whole; i < end; i++) {
    const double share = upto[i] - (i == 0 ? 0 : upto[i - 1]);
    sum += share * packing_psd_cdf(s->kernel, by, x / s->atoms.x[i]);
  }
  return sum;
}

static double point(const packing_psd *psd, packing_by by, double u, double v,
                    size_t *component)
{
  const smoothed *s = (const smoothed *)psd;
  *component = 0;
  return packing_i_atoms_quantile(psd, by, v) * packing_psd_quantile(s->kernel, by, u);
}

static void finish(packing_psd *psd)
{
  packing_psd_destroy(((smoothed *)psd)->kernel);
  packing_i_atoms_finish(psd);
}

static const packing_i_psd_ops smoothed_ops = {
    "sample", "measured radii times exp(bandwidth z)",
    cdf,      packing_i_psd_bisect,
    point,    2,
    finish};

void packing_psd_sample_def_fill(packing_psd_sample_def *def, size_t size)
{
  packing_psd_sample_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status create_kernel(packing_context *context,
                                    const packing_psd_sample_def *d, packing_psd **kernel)
{
  packing_psd_lognormal_def law;
  packing_psd_lognormal_def_init(&law);
  law.median_r = 1;
  law.sigma = d->bandwidth;
  law.min_r = exp(-reach * d->bandwidth);
  law.max_r = exp(reach * d->bandwidth);
  law.by = d->by;
  law.dim = d->dim;
  return packing_psd_create_lognormal(context, &law, kernel);
}

/* `r` is sorted. */
static packing_status create_smoothed(packing_context *context,
                                      const packing_psd_sample_def *d, const double *r,
                                      packing_psd **psd)
{
  packing_psd *kernel = NULL;
  packing_i_atoms *atoms;
  const double min_r = r[0] * exp(-reach * d->bandwidth);
  const double max_r = r[d->count - 1] * exp(reach * d->bandwidth);
  PACKING_I_TRY(packing_i_psd_check_span(context, "bandwidth", min_r, max_r));
  PACKING_I_TRY(create_kernel(context, d, &kernel));
  const packing_status status =
      packing_i_atoms_create(context, &smoothed_ops, sizeof(smoothed), d->count, r, NULL,
                             d->by, d->dim, min_r, max_r, &atoms);
  if (status != PACKING_OK) {
    packing_psd_destroy(kernel);
    return status;
  }
  ((smoothed *)atoms)->kernel = kernel;
  for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
    atoms->base.moment[n] *=
        ldexp(kernel->moment[n], (n + PACKING_I_PSD_LEAST_POWER) * kernel->exponent);
  *psd = &atoms->base;
  return PACKING_OK;
}

static packing_status create_resampled(packing_context *context,
                                       const packing_psd_sample_def *d, const double *r,
                                       packing_psd **psd)
{
  packing_i_atoms *atoms;
  PACKING_I_TRY(packing_i_atoms_create(context, &resampled_ops, sizeof *atoms, d->count,
                                       r, NULL, d->by, d->dim, r[0], r[d->count - 1],
                                       &atoms));
  *psd = &atoms->base;
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_psd_sample_def *d)
{
  PACKING_I_TRY(packing_i_psd_check_measure(context, d->by, d->dim));
  PACKING_I_TRY(packing_i_psd_check_count(context, d->count, 1));
  PACKING_I_TRY(packing_i_psd_check_entries(context, "r", d->r, d->count));
  PACKING_I_TRY(packing_i_check_not_negative(context, "bandwidth", d->bandwidth));
  return d->bandwidth == 0
             ? PACKING_OK
             : packing_i_psd_check_width(context, "bandwidth", d->bandwidth, 1e-9, 10);
}

packing_status packing_psd_create_sample(packing_context *context,
                                         const packing_psd_sample_def *def,
                                         packing_psd **psd)
{
  packing_psd_sample_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_sample, dim, def, &d));
  PACKING_I_TRY(check(context, &d));
  const packing_allocator *allocator = packing_i_allocator(context);
  double *r = packing_i_alloc(allocator, d.count, sizeof *r);
  if (r == NULL)
    return packing_i_nomem(context);
  memcpy(r, d.r, d.count * sizeof *r);
  gsl_sort(r, 1, d.count);
  packing_status status = packing_i_psd_check_span(context, "r", r[0], r[d.count - 1]);
  if (status == PACKING_OK)
    status = d.bandwidth > 0 ? create_smoothed(context, &d, r, psd)
                             : create_resampled(context, &d, r, psd);
  packing_i_free(allocator, r);
  return status;
}
