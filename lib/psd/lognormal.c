/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lognormal law, cut: log r is normal of mean log(median) and standard deviation sigma. Weighted
 * by x^s it is lognormal again, about median exp(s sigma^2). */
#include "smooth_internal.h"
#include "vec.h"
#include <math.h>

/* parameter: log of the median, sigma */
static double log_density(const double *parameter, double x)
{
  const double z = (log(x) - parameter[0]) / parameter[1];
  return -z * z / 2 - log(parameter[1]) - log(2 * PACKING_I_PI) / 2;
}

static double mode(const double *parameter, int s)
{
  return exp(parameter[0] + s * parameter[1] * parameter[1]);
}

static const packing_i_psd_ops ops = {
    "lognormal", "density ~ exp(-(log(r / median) / sigma)^2 / 2) / r",
    PACKING_I_SMOOTH_OPS};

void packing_psd_lognormal_def_fill(packing_psd_lognormal_def *def, size_t size)
{
  packing_psd_lognormal_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_psd_create_lognormal(packing_context *context,
                                            const packing_psd_lognormal_def *def,
                                            packing_psd **psd)
{
  packing_psd_lognormal_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_lognormal, dim, def, &d));
  PACKING_I_TRY(packing_i_psd_check_measure(context, d.by, d.dim));
  PACKING_I_TRY(packing_i_check_positive(context, "median_r", d.median_r));
  PACKING_I_TRY(packing_i_psd_check_width(context, "sigma", d.sigma, 1e-9, 1e3));
  PACKING_I_TRY(packing_i_psd_check_cut(context, d.min_r, d.max_r));
  const double unit = packing_i_psd_unit(d.max_r);
  const packing_i_cut_law law = {{log(d.median_r / unit), d.sigma}, log_density, mode};
  return packing_i_cut_create(context, &ops, &law, d.by, d.dim, d.min_r, d.max_r, psd);
}
