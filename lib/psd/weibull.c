/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weibull law, cut (W. Weibull, J. Appl. Mech. 18, 1951; Rosin and Rammler 1933 for sieves):
 * F = 1 - exp(-w), w = (x / scale)^k; in u = log x the density is k w exp(-w), greatest times
 * x^s where w = (k + s) / k. */
#include "smooth_internal.h"
#include <math.h>

/* parameter: scale, shape k */
static double log_density(const double *parameter, double x)
{
  const double k = parameter[1], log_w = k * log(x / parameter[0]);
  return log(k) + log_w - exp(log_w);
}

static double mode(const double *parameter, int s)
{
  const double k = parameter[1];
  return k + s <= 0 ? 0 : parameter[0] * pow((k + s) / k, 1 / k);
}

static const packing_i_psd_ops ops = {
    "weibull", "cdf 1 - exp(-(r / scale)^shape); Weibull, J. Appl. Mech. 18 (1951)",
    PACKING_I_SMOOTH_OPS};

void packing_psd_weibull_def_fill(packing_psd_weibull_def *def, size_t size)
{
  packing_psd_weibull_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_psd_create_weibull(packing_context *context,
                                          const packing_psd_weibull_def *def,
                                          packing_psd **psd)
{
  packing_psd_weibull_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_weibull, dim, def, &d));
  PACKING_I_TRY(packing_i_psd_check_measure(context, d.by, d.dim));
  PACKING_I_TRY(packing_i_check_positive(context, "scale_r", d.scale_r));
  PACKING_I_TRY(packing_i_psd_check_width(context, "shape", d.shape, 1e-3, 1e9));
  PACKING_I_TRY(packing_i_psd_check_cut(context, d.min_r, d.max_r));
  const double unit = packing_i_psd_unit(d.max_r);
  const packing_i_cut_law law = {{d.scale_r / unit, d.shape}, log_density, mode};
  return packing_i_cut_create(context, &ops, &law, d.by, d.dim, d.min_r, d.max_r, psd);
}
