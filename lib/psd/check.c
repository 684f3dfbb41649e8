/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that the defs of several kinds need. */
#include "psd_internal.h"
#include <math.h>

/* Radii between these, and not farther apart than this, keep every moment of -6 .. 9 within
 * the range of doubles. */
static const double least_r = 1e-200, most_r = 1e200, least_ratio = 1e-30;

packing_status packing_i_psd_check_arguments(packing_context *context, const void *def,
                                             packing_psd **psd)
{
  if (def == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "def", PACKING_NO_INDEX, "NULL");
  if (psd == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "psd", PACKING_NO_INDEX, "NULL");
  return PACKING_OK;
}

packing_status packing_i_psd_check_measure(packing_context *context, packing_by by,
                                           int dim)
{
  if (by != PACKING_BY_NUMBER && by != PACKING_BY_MASS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "by", PACKING_NO_INDEX,
                          "%d is neither number nor mass", (int)by);
  if (dim != 2 && dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d is neither 2 nor 3", dim);
  return PACKING_OK;
}

packing_status packing_i_psd_check_span(packing_context *context, const char *field,
                                        double min_r, double max_r)
{
  if (min_r < least_r || max_r > most_r)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "%g is not between %g and %g", min_r < least_r ? min_r : max_r,
                          least_r, most_r);
  if (min_r / max_r < least_ratio)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "sizes from %g to %g span more than 1:%g", min_r, max_r,
                          1 / least_ratio);
  return PACKING_OK;
}

packing_status packing_i_psd_check_cut(packing_context *context, double min_r,
                                       double max_r)
{
  PACKING_I_TRY(packing_i_check_positive(context, "min_r", min_r));
  PACKING_I_TRY(packing_i_check_positive(context, "max_r", max_r));
  if (max_r <= min_r)
    return packing_i_fail(context, PACKING_ERR_RANGE, "max_r", PACKING_NO_INDEX,
                          "%g must be above min_r = %g", max_r, min_r);
  return packing_i_psd_check_span(context, "min_r", min_r, max_r);
}

packing_status packing_i_psd_check_count(packing_context *context, size_t count,
                                         size_t least)
{
  if (count >= least)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                        "%zu entries, at least %zu are needed", count, least);
}

packing_status packing_i_psd_check_entries(packing_context *context, const char *field,
                                           const double *v, size_t count)
{
  if (v == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX, "NULL");
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(v[i]))
      return packing_i_fail(context, PACKING_ERR_INVALID, field, i,
                            "row %zu: %g is not a finite number", i + 1, v[i]);
    if (v[i] <= 0)
      return packing_i_fail(context, PACKING_ERR_RANGE, field, i,
                            "row %zu: %g must be above 0", i + 1, v[i]);
  }
  return PACKING_OK;
}

packing_status packing_i_psd_check_rising(packing_context *context, const char *field,
                                          const double *v, size_t count)
{
  for (size_t i = 1; i < count; i++)
    if (v[i] <= v[i - 1])
      return packing_i_fail(context, PACKING_ERR_RANGE, field, i,
                            "row %zu: %g after %g, must rise", i + 1, v[i], v[i - 1]);
  return PACKING_OK;
}

packing_status packing_i_psd_check_width(packing_context *context, const char *field,
                                         double v, double least, double most)
{
  PACKING_I_TRY(packing_i_check_positive(context, field, v));
  if (v >= least && v <= most)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "%g is not between %g and %g", v, least, most);
}
