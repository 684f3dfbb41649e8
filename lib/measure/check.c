/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Views as the measures take them. */
#include "measure/measure_internal.h"
#include "vec.h"
#include "view.h"

packing_status packing_i_measure_view(packing_context *context, const packing_view *view,
                                      packing_view *copy)
{
  if (packing_i_view_read(view, copy))
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_INVALID, "view", PACKING_NO_INDEX,
                        "NULL, not initialised, or x, y or r is missing");
}

int packing_i_measure_is_good(const packing_view *view, size_t i, int flat)
{
  packing_vec3 p = packing_i_view_centre(view, i);
  const double r = packing_i_view_r(view, i);
  if (flat)
    p.z = 0;
  return packing_i_vec_finite(p) && isfinite(r) && r > 0;
}

packing_status packing_i_measure_check(packing_context *context, const packing_view *view,
                                       int flat)
{
  for (size_t i = 0; i < view->count; i++) {
    if (packing_i_measure_is_good(view, i, flat))
      continue;
    const packing_vec3 p = packing_i_view_centre(view, i);
    const double r = packing_i_view_r(view, i);
    if (isfinite(r) && r <= 0)
      return packing_i_fail(context, PACKING_ERR_RANGE, "r", i,
                            "%g of particle %zu must be above 0", r, i);
    const char *field = !isfinite(p.x)            ? "x"
                        : !isfinite(p.y)          ? "y"
                        : !flat && !isfinite(p.z) ? "z"
                                                  : "r";
    return packing_i_fail(context, PACKING_ERR_INVALID, field, i,
                          "of particle %zu is not a finite number", i);
  }
  return PACKING_OK;
}
