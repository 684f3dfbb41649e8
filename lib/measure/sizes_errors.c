/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors between two curves: MAE, MSE, RMAE, MRE of section 5.4 and Tables 10 and 11 of the
 * advancing-front paper (Perez Morales et al.), with e = asked - placed:
 *
 *   MAE = mean |e|, MSE = mean e^2, RMAE = mean |e| / asked, MRE = mean e / asked.
 *
 * The paper divides by 7 where Table 10 has 9 points and Table 11 has 13 (of which the last four
 * are missing in its sums); here each mean is over what it sums. Linear time. */
#include "measure/measure_internal.h"
#include <packing/sizes.h>

typedef struct sums {
  packing_i_sum absolute, squared, relative_absolute, relative;
  size_t relative_count;
} sums;

static void add_point(sums *s, double asked, double placed)
{
  const double e = asked - placed;
  packing_i_sum_add(&s->absolute, fabs(e));
  packing_i_sum_add(&s->squared, e * e);
  if (!(asked > 0))
    return;
  packing_i_sum_add(&s->relative_absolute, fabs(e) / asked);
  packing_i_sum_add(&s->relative, e / asked);
  s->relative_count++;
}

static packing_status check_entries(packing_context *context, const char *field,
                                    const double *v, size_t count)
{
  PACKING_I_TRY(packing_i_check_given(context, field, v));
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(v[i]))
      return packing_i_fail(context, PACKING_ERR_INVALID, field, i,
                            "entry %zu: %g is not a finite number", i, v[i]);
    if (v[i] < 0)
      return packing_i_fail(context, PACKING_ERR_RANGE, field, i,
                            "entry %zu: %g must not be negative", i, v[i]);
  }
  return PACKING_OK;
}

/* 0 / 0, where no point has anything asked, is the NaN that the report promises. */
static double mean_of(const packing_i_sum *sum, size_t count)
{
  return packing_i_sum_value(sum) / (double)count;
}

packing_status packing_measure_curve_errors(packing_context *context, size_t count,
                                            const double *asked, const double *placed,
                                            packing_curve_errors_report *report)
{
  packing_curve_errors_report found;
  sums s = {{0, 0}, {0, 0}, {0, 0}, {0, 0}, 0};
  if (count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "0 points, at least 1 is needed");
  PACKING_I_TRY(check_entries(context, "asked", asked, count));
  PACKING_I_TRY(check_entries(context, "placed", placed, count));
  for (size_t i = 0; i < count; i++)
    add_point(&s, asked[i], placed[i]);
  packing_curve_errors_report_init(&found);
  found.mae = mean_of(&s.absolute, count);
  found.mse = mean_of(&s.squared, count);
  found.rmae = mean_of(&s.relative_absolute, s.relative_count);
  found.mre = mean_of(&s.relative, s.relative_count);
  found.relative_count = s.relative_count;
  return packing_i_report_write(context, report, &found, sizeof found);
}
