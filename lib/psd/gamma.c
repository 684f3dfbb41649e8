/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gamma law, cut: in u = log x the density is (x / scale)^k exp(-x / scale) / Gamma(k), greatest
 * times x^s at x = (k + s) scale. With y = x / (k scale) its log is k (log y - y + 1) plus a
 * constant, a form that keeps its digits for large shapes k. */
#include "smooth_internal.h"
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_log.h>
#include <math.h>

/* log y - y + 1 */
static double bend(double y)
{
  gsl_sf_result result;
  if (y < 0.5 || y > 2 || gsl_sf_log_1plusx_mx_e(y - 1, &result) != GSL_SUCCESS)
    return log(y) - y + 1;
  return result.val;
}

/* parameter: scale, shape k, the constant k log k - k - log Gamma(k) */
static double log_density(const double *parameter, double x)
{
  const double k = parameter[1];
  return k * bend(x / (k * parameter[0])) + parameter[2];
}

static double mode(const double *parameter, int s)
{
  return (parameter[1] + s) * parameter[0];
}

static const packing_i_psd_ops ops = {"gamma", "density ~ r^(shape - 1) exp(-r / scale)",
                                      PACKING_I_SMOOTH_OPS};

void packing_psd_gamma_def_fill(packing_psd_gamma_def *def, size_t size)
{
  packing_psd_gamma_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_psd_create_gamma(packing_context *context,
                                        const packing_psd_gamma_def *def,
                                        packing_psd **psd)
{
  packing_psd_gamma_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_gamma, dim, def, &d));
  PACKING_I_TRY(packing_i_psd_check_measure(context, d.by, d.dim));
  PACKING_I_TRY(packing_i_check_positive(context, "scale_r", d.scale_r));
  PACKING_I_TRY(packing_i_psd_check_width(context, "shape", d.shape, 1e-3, 1e9));
  PACKING_I_TRY(packing_i_psd_check_cut(context, d.min_r, d.max_r));
  gsl_sf_result log_gamma;
  gsl_sf_lngamma_e(d.shape, &log_gamma); /* cannot fail in this range */
  const double unit = packing_i_psd_unit(d.max_r);
  const packing_i_cut_law law = {
      {d.scale_r / unit, d.shape, d.shape * log(d.shape) - d.shape - log_gamma.val},
      log_density,
      mode};
  return packing_i_cut_create(context, &ops, &law, d.by, d.dim, d.min_r, d.max_r, psd);
}
