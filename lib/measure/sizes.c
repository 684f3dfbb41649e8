/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes asked against sizes placed: Kolmogorov-Smirnov distance by number, the same distance of
 * the curves by mass (sizes_steps.c), and the mean relative error of quantiles. N log N. */
#include "measure/sizes_internal.h"

enum { QUANTILES = 20 };

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

static void compare(const packing_psd *psd, const packing_i_sizes *s,
                    packing_sizes_report *report)
{
  report->ks = packing_i_sizes_distance(s, PACKING_BY_NUMBER, psd);
  report->ks_limit = 1.36 / sqrt((double)s->count);
  report->ks_mass = packing_i_sizes_distance(s, PACKING_BY_MASS, psd);
  report->mean_relative_error = quantile_error(psd, s->sorted, s->count);
  report->min_r = s->sorted[0];
  report->max_r = s->sorted[s->count - 1];
  report->mean_r = mean_of(s->sorted, s->count);
}

packing_status packing_measure_sizes(packing_context *context, packing_psd *psd,
                                     const packing_view *view,
                                     packing_sizes_report *report)
{
  packing_view v;
  packing_i_sizes sizes;
  packing_sizes_report found;
  PACKING_I_TRY(packing_i_check_given(context, "psd", psd));
  PACKING_I_TRY(packing_i_sizes_view(context, view, &v));
  packing_sizes_report_init(&found);
  const packing_status status =
      packing_i_sizes_make(context, &v.r, v.count, psd->dim, &sizes);
  if (status == PACKING_OK)
    compare(psd, &sizes, &found);
  packing_i_sizes_free(&sizes);
  if (status != PACKING_OK)
    return status;
  return packing_i_report_write(context, report, &found, sizeof found);
}
