/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes asked against sizes placed: Kolmogorov-Smirnov distance by number (two-sided, exact for
 * laws with atoms: both sides of every step are looked at), the same distance of the curves by
 * mass, and the mean relative error of quantiles. N log N; where the law's curve is only read
 * off at every 64th size, monotony shows that nothing in between can matter. */
#include "measure/measure_internal.h"
#include "psd/psd_internal.h"
#include "view.h"
#include <gsl/gsl_sort.h>

enum { STRIDE = 64, QUANTILES = 20 };

/* The steps of the placed curve: at radius r[k] it rises from share[k - 1] to share[k]. */
typedef struct steps {
  size_t count;
  const double *r;
  const double *share;
} steps;

static double share_before(const steps *s, size_t k)
{
  return k == 0 ? 0.0 : s->share[k - 1];
}

/* The law's curve just below a radius, so that an atom there is not counted. */
static double law_below(const packing_psd *psd, packing_by by, double r)
{
  return packing_psd_cdf(psd, by, nextafter(r, 0.0));
}

static double larger(double a, double b)
{
  return b > a ? b : a;
}

/* Distance of the curves on both sides of the steps first .. last, at the ends only. */
static double ends_distance(const packing_psd *psd, packing_by by, const steps *s,
                            size_t first, size_t last, double *bound)
{
  const double below = law_below(psd, by, s->r[first]);
  const double above = packing_psd_cdf(psd, by, s->r[last]);
  *bound = larger(s->share[last] - below, above - share_before(s, first));
  return larger(fabs(share_before(s, first) - below), fabs(s->share[last] - above));
}

/* sup |placed - asked|. Between steps the placed curve is level and the law's rises, so the
 * steps decide. */
static double distance(const packing_psd *psd, packing_by by, const steps *s)
{
  double most = 0, bound = 0;
  for (size_t first = 0; first < s->count; first += STRIDE) {
    const size_t left = s->count - first;
    const size_t last = first + (left < STRIDE ? left : STRIDE) - 1;
    most = larger(most, ends_distance(psd, by, s, first, last, &bound));
  }
  for (size_t first = 0; first < s->count; first += STRIDE) {
    const size_t left = s->count - first;
    const size_t last = first + (left < STRIDE ? left : STRIDE) - 1;
    ends_distance(psd, by, s, first, last, &bound);
    for (size_t k = first; k <= last && bound > most; k++) {
      double unused;
      most = larger(most, ends_distance(psd, by, s, k, k, &unused));
    }
  }
  return most;
}

static double mass_of(double r, int dim)
{
  return dim == 2 ? r * r : r * r * r;
}

/* Sorted radii into steps, by number and by mass; equal radii share one. */
static size_t make_steps(const double *sorted, size_t count, int dim, double *r,
                         double *by_number, double *by_mass)
{
  size_t n = 0;
  packing_i_sum mass = {0, 0};
  for (size_t i = 0; i < count; i++) {
    packing_i_sum_add(&mass, mass_of(sorted[i] / sorted[count - 1], dim));
    if (i + 1 < count && sorted[i + 1] == sorted[i])
      continue;
    r[n] = sorted[i];
    by_number[n] = (double)(i + 1) / (double)count;
    by_mass[n++] = packing_i_sum_value(&mass);
  }
  for (size_t k = 0; k < n; k++)
    by_mass[k] /= packing_i_sum_value(&mass);
  return n;
}

/* Mean of (placed - asked) / asked over the quantiles 1/20 .. 19/20. */
static double quantile_error(const packing_psd *psd, const double *sorted, size_t count)
{
  packing_i_sum sum = {0, 0};
  for (size_t k = 1; k < QUANTILES; k++) {
    /* the smallest i with (i + 1) / count >= k / 20, without overflow */
    const size_t whole = count / QUANTILES, rest = count % QUANTILES;
    const size_t i = k * whole + (k * rest + QUANTILES - 1) / QUANTILES - 1;
    const double asked =
        packing_psd_quantile(psd, PACKING_BY_NUMBER, (double)k / QUANTILES);
    packing_i_sum_add(&sum, (sorted[i] - asked) / asked);
  }
  return packing_i_sum_value(&sum) / (QUANTILES - 1);
}

static double mean_of(const double *values, size_t count)
{
  packing_i_sum sum = {0, 0};
  for (size_t i = 0; i < count; i++)
    packing_i_sum_add(&sum, values[i]);
  return packing_i_sum_value(&sum) / (double)count;
}

static packing_status compare(packing_context *context, const packing_psd *psd,
                              const packing_view *v, packing_sizes_report *report)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t count = v->count;
  packing_status status = PACKING_OK;
  double *sorted = packing_i_alloc(allocator, count, sizeof *sorted);
  double *r = packing_i_alloc(allocator, count, sizeof *r);
  double *by_number = packing_i_alloc(allocator, count, sizeof *by_number);
  double *by_mass = packing_i_alloc(allocator, count, sizeof *by_mass);
  if (sorted == NULL || r == NULL || by_number == NULL || by_mass == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  for (size_t i = 0; i < count; i++)
    sorted[i] = packing_i_view_r(v, i);
  gsl_sort(sorted, 1, count);
  const size_t n = make_steps(sorted, count, psd->dim, r, by_number, by_mass);
  const steps numbers = {n, r, by_number}, masses = {n, r, by_mass};
  report->ks = distance(psd, PACKING_BY_NUMBER, &numbers);
  report->ks_limit = 1.36 / sqrt((double)count);
  report->ks_mass = distance(psd, PACKING_BY_MASS, &masses);
  report->mean_relative_error = quantile_error(psd, sorted, count);
  report->min_r = sorted[0];
  report->max_r = sorted[count - 1];
  report->mean_r = mean_of(sorted, count);
out:
  packing_i_free(allocator, sorted);
  packing_i_free(allocator, r);
  packing_i_free(allocator, by_number);
  packing_i_free(allocator, by_mass);
  return status;
}

/* Only radii matter here: centres may be anything. */
static packing_status check_radii(packing_context *context, const packing_view *v)
{
  if (v->count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "view", PACKING_NO_INDEX,
                          "0 particles, at least 1 is needed");
  for (size_t i = 0; i < v->count; i++) {
    const double r = packing_i_view_r(v, i);
    if (!isfinite(r))
      return packing_i_fail(context, PACKING_ERR_INVALID, "r", i,
                            "%g of particle %zu is not a finite number", r, i);
    if (!(r > 0))
      return packing_i_fail(context, PACKING_ERR_RANGE, "r", i,
                            "%g of particle %zu must be above 0", r, i);
  }
  return PACKING_OK;
}

packing_status packing_measure_sizes(packing_context *context, packing_psd *psd,
                                     const packing_view *view,
                                     packing_sizes_report *report)
{
  packing_view v;
  packing_sizes_report found;
  if (psd == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "psd", PACKING_NO_INDEX, "NULL");
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  PACKING_I_TRY(check_radii(context, &v));
  packing_sizes_report_init(&found);
  PACKING_I_TRY(compare(context, psd, &v, &found));
  return packing_i_report_write(context, report, &found, sizeof found);
}
