/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exponential law, cut: in u = log x the density is y exp(-y) with y = x / scale, greatest times
 * x^s at y = 1 + s. */
#include "smooth_internal.h"
#include <math.h>

/* parameter: scale */
static double log_density(const double *parameter, double x)
{
  const double y = x / parameter[0];
  return log(y) - y;
}

static double mode(const double *parameter, int s)
{
  return (1 + s) * parameter[0];
}

static const packing_i_psd_ops ops = {"exponential", "density ~ exp(-r / scale)",
                                      PACKING_I_SMOOTH_OPS};

void packing_psd_exponential_def_fill(packing_psd_exponential_def *def, size_t size)
{
  packing_psd_exponential_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_psd_create_exponential(packing_context *context,
                                              const packing_psd_exponential_def *def,
                                              packing_psd **psd)
{
  packing_psd_exponential_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_exponential, dim, def, &d));
  PACKING_I_TRY(packing_i_psd_check_measure(context, d.by, d.dim));
  PACKING_I_TRY(packing_i_check_positive(context, "scale_r", d.scale_r));
  PACKING_I_TRY(packing_i_psd_check_cut(context, d.min_r, d.max_r));
  const double unit = packing_i_psd_unit(d.max_r);
  const packing_i_cut_law law = {{d.scale_r / unit, 0}, log_density, mode};
  return packing_i_cut_create(context, &ops, &law, d.by, d.dim, d.min_r, d.max_r, psd);
}
