/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Size distributions of pores and constrictions: sorted radii, and the share up to each. */
#include "measure/pores_result.h"

static double weight(const packing_pores *pores, packing_by by, double relative)
{
  if (by == PACKING_BY_NUMBER)
    return 1;
  return pores->report.dim == 2 ? relative * relative : relative * relative * relative;
}

static double total_weight(const packing_pores *pores, packing_by by, const double *radii,
                           size_t count)
{
  packing_i_sum sum = {0, 0};
  for (size_t i = 0; i < count; i++)
    packing_i_sum_add(&sum, weight(pores, by, radii[i] / radii[count - 1]));
  return packing_i_sum_value(&sum);
}

/* The sums are those of total_weight(), so the last share is 1. */
static void fill_passing(const packing_pores *pores, packing_by by, const double *radii,
                         size_t count, size_t capacity, double *passing)
{
  const double total = total_weight(pores, by, radii, count);
  packing_i_sum sum = {0, 0};
  for (size_t i = 0; i < count && i < capacity; i++) {
    packing_i_sum_add(&sum, weight(pores, by, radii[i] / radii[count - 1]));
    passing[i] = packing_i_sum_value(&sum) / total;
  }
}

static packing_status check_sizes(const packing_pores *pores, int part, int by,
                                  size_t capacity, const double *radii,
                                  const size_t *count)
{
  if (part != PACKING_PORES_PORES && part != PACKING_PORES_CONSTRICTIONS)
    return packing_i_fail(pores->context, PACKING_ERR_INVALID, "part", PACKING_NO_INDEX,
                          "%d is no part of a network", part);
  if (by != PACKING_BY_NUMBER && by != PACKING_BY_MASS)
    return packing_i_fail(pores->context, PACKING_ERR_INVALID, "by", PACKING_NO_INDEX,
                          "%d is no kind of share", by);
  if (radii == NULL && capacity > 0)
    return packing_i_fail(pores->context, PACKING_ERR_INVALID, "radii", PACKING_NO_INDEX,
                          "NULL");
  return packing_i_check_given(pores->context, "count", count);
}

packing_status packing_pores_sizes(const packing_pores *pores, packing_pores_part part,
                                   packing_by by, size_t capacity, double *radii,
                                   double *passing, size_t *count)
{
  if (pores == NULL)
    return PACKING_ERR_INVALID;
  PACKING_I_TRY(check_sizes(pores, (int)part, (int)by, capacity, radii, count));
  const double *from = pores->radii[part];
  const size_t total = pores->free[part], some = capacity < total ? capacity : total;
  *count = total;
  if (some == 0)
    return PACKING_OK;
  memcpy(radii, from, some * sizeof *radii);
  if (passing != NULL)
    fill_passing(pores, by, from, total, some, passing);
  return PACKING_OK;
}
