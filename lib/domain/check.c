/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of options that several kinds of containers have. */
#include "domain_kinds.h"

packing_status packing_i_domain_check_given(packing_context *context, const char *field,
                                            const void *pointer)
{
  if (pointer != NULL)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX, "NULL");
}

packing_status packing_i_domain_begin(packing_context *context, const void *def,
                                      packing_domain **domain)
{
  PACKING_I_TRY(packing_i_domain_check_given(context, "def", def));
  return packing_i_domain_check_given(context, "domain", domain);
}

packing_status packing_i_domain_check_point(packing_context *context,
                                            const char *const fields[3],
                                            const packing_vec3 *point)
{
  for (int k = 0; k < 3; k++)
    PACKING_I_TRY(
        packing_i_check_finite(context, fields[k], packing_i_component(*point, k)));
  return PACKING_OK;
}

packing_status packing_i_domain_check_flat(packing_context *context, const char *field,
                                           double z)
{
  if (z == 0)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "%g must be 0: the container lies in the plane z = 0", z);
}

packing_status packing_i_domain_check_open_top(packing_context *context, int open_top)
{
  if (open_top == 0 || open_top == 1)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, "open_top", PACKING_NO_INDEX,
                        "%d must be 0 or 1", open_top);
}

packing_status packing_i_domain_check_ring(packing_context *context, double inner,
                                           double outer)
{
  PACKING_I_TRY(packing_i_check_positive(context, "inner_radius", inner));
  PACKING_I_TRY(packing_i_check_positive(context, "outer_radius", outer));
  if (inner < outer)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, "outer_radius", PACKING_NO_INDEX,
                        "%g must be above inner_radius, %g", outer, inner);
}
