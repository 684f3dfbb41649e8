/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of options that several kinds of containers have. */
#include "domain_kinds.h"

packing_status packing_i_domain_begin(packing_context *context, const void *def,
                                      packing_domain **domain)
{
  PACKING_I_TRY(packing_i_check_given(context, "def", def));
  return packing_i_check_given(context, "domain", domain);
}

packing_status packing_i_domain_check_flat(packing_context *context, const char *field,
                                           double z)
{
  if (z == 0)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "%g must be 0: the container lies in the plane z = 0", z);
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
