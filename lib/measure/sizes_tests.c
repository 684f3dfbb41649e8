/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can the radii be a sample of the law? Kolmogorov-Smirnov (sizes_kolmogorov.c) and chi-square
 * with B bins that end at the quantiles k / B, so that the law fills them alike:
 *
 *   X^2 = sum (placed_k - expected_k)^2 / expected_k, p = Q((B - 1) / 2, X^2 / 2),
 *
 * Q the upper regularised incomplete gamma function. B is 2 N^(2/5) by default (H. B. Mann and
 * A. Wald, Ann. Math. Stat. 13 (1942), p. 306, to a round factor), at most N / 5. An atom of the
 * law may fill several bins: quantiles that fall together end one bin, and what it expects is
 * read off the law. N log N. */
#include "measure/sizes_internal.h"
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_gamma.h>

enum { LEAST_EXPECTED = 5 };

void packing_size_tests_def_fill(packing_size_tests_def *def, size_t size)
{
  packing_size_tests_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* As many as B^5 <= 32 N^2 allows, which no rounding of pow() decides. */
static size_t choose_bins(size_t asked, size_t count)
{
  if (asked > 0)
    return asked;
  const double n = (double)count, limit = 32 * n * n;
  const double most = fmin(n / LEAST_EXPECTED, PACKING_SIZE_TESTS_BINS);
  double bins = 2;
  for (double b = 3; b <= most && b * b * b * b * b <= limit; b++)
    bins = b;
  return (size_t)bins;
}

/* Q(dof / 2, x / 2); where it is below 1e-290 by Chernoff's bound it is 0, as GSL would fail. */
static double chi_square_p(double dof, double x)
{
  gsl_sf_result q;
  const double a = dof / 2, y = x / 2;
  if (y > a && y - a - a * log(y / a) > 668)
    return 0;
  if (gsl_sf_gamma_inc_Q_e(a, y, &q) != GSL_SUCCESS)
    return (double)NAN;
  return q.val;
}

/* The edges between bins are the different quantiles; the last bin has no end. */
static void chi_square(const packing_psd *psd, const packing_i_sizes *sizes, size_t bins,
                       packing_size_tests_report *report)
{
  const double n = (double)sizes->count, last = packing_psd_max_r(psd);
  double asked_before = 0, placed_before = 0, edge_before = 0;
  packing_i_sum sum = {0, 0};
  report->bins = 0;
  for (size_t k = 1; k <= bins; k++) {
    const double at = k == bins ? last
                                : packing_psd_quantile(psd, PACKING_BY_NUMBER,
                                                       (double)k / (double)bins);
    const int end = at >= last;
    const double asked = end ? 1 : packing_psd_cdf(psd, PACKING_BY_NUMBER, at);
    if (at <= edge_before || asked <= asked_before)
      continue;
    const double placed = end ? 1 : packing_i_sizes_upto(sizes, PACKING_BY_NUMBER, at);
    const double expected = n * (asked - asked_before);
    const double excess = n * (placed - placed_before) - expected;
    packing_i_sum_add(&sum, excess * excess / expected);
    report->bins++;
    if (end)
      break;
    edge_before = at;
    asked_before = asked;
    placed_before = placed;
  }
  report->chi_square = report->chi_square_p = (double)NAN;
  if (report->bins < 2)
    return;
  report->chi_square = packing_i_sum_value(&sum);
  report->chi_square_p = chi_square_p((double)report->bins - 1, report->chi_square);
}

static packing_status test_sizes(packing_context *context,
                                 const packing_size_tests_def *d, const packing_psd *psd,
                                 const packing_view *v, packing_size_tests_report *report)
{
  packing_i_sizes sizes;
  packing_status status =
      packing_i_sizes_make(context, &v->r, v->count, psd->dim, &sizes);
  if (status != PACKING_OK)
    goto out;
  report->count = v->count;
  report->ks = packing_i_sizes_distance(&sizes, PACKING_BY_NUMBER, psd);
  status = packing_kolmogorov_p(context, v->count, report->ks, &report->ks_p);
  if (status == PACKING_OK)
    chi_square(psd, &sizes, choose_bins(d->bins, v->count), report);
out:
  packing_i_sizes_free(&sizes);
  return status;
}

packing_status packing_measure_size_tests(packing_context *context,
                                          const packing_size_tests_def *def,
                                          packing_psd *psd, const packing_view *view,
                                          packing_size_tests_report *report)
{
  packing_size_tests_def d;
  packing_view v;
  packing_size_tests_report found;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_size_tests, bins, def, &d));
  if (d.bins == 1 || d.bins > PACKING_SIZE_TESTS_BINS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "bins", PACKING_NO_INDEX,
                          "%zu, must be 2 to %d, or 0", d.bins, PACKING_SIZE_TESTS_BINS);
  PACKING_I_TRY(packing_i_check_given(context, "psd", psd));
  PACKING_I_TRY(packing_i_sizes_view(context, view, &v));
  packing_size_tests_report_init(&found);
  PACKING_I_TRY(test_sizes(context, &d, psd, &v, &found));
  return packing_i_report_write(context, report, &found, sizeof found);
}
