/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Normal law of mean m and standard deviation sd, cut. In u = log x its density times x^s is
 * greatest where x^2 - m x - (s + 1) sd^2 = 0 (the larger root; the smaller is a minimum). */
#include "smooth_internal.h"
#include "vec.h"
#include <math.h>

/* parameter: m, sd */
static double log_density(const double *parameter, double x)
{
  const double z = (x - parameter[0]) / parameter[1];
  return log(x) - z * z / 2 - log(parameter[1]) - log(2 * PACKING_I_PI) / 2;
}

static double mode(const double *parameter, int s)
{
  const double m = parameter[0], sd = parameter[1];
  const double square = m * m + 4 * (s + 1) * sd * sd;
  return square < 0 ? 0 : (m + sqrt(square)) / 2;
}

static const packing_i_psd_ops ops = {"normal", "density ~ exp(-((r - mean) / sd)^2 / 2)",
                                      PACKING_I_SMOOTH_OPS};

void packing_psd_normal_def_fill(packing_psd_normal_def *def, size_t size)
{
  packing_psd_normal_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_psd_create_normal(packing_context *context,
                                         const packing_psd_normal_def *def,
                                         packing_psd **psd)
{
  packing_psd_normal_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_normal, dim, def, &d));
  PACKING_I_TRY(packing_i_psd_check_measure(context, d.by, d.dim));
  PACKING_I_TRY(packing_i_check_finite(context, "mean_r", d.mean_r));
  PACKING_I_TRY(packing_i_check_positive(context, "sd_r", d.sd_r));
  PACKING_I_TRY(packing_i_psd_check_cut(context, d.min_r, d.max_r));
  PACKING_I_TRY(
      packing_i_psd_check_width(context, "sd_r", d.sd_r, d.max_r * 1e-9, d.max_r * 1e9));
  const double unit = packing_i_psd_unit(d.max_r);
  const packing_i_cut_law law = {{d.mean_r / unit, d.sd_r / unit}, log_density, mode};
  return packing_i_cut_create(context, &ops, &law, d.by, d.dim, d.min_r, d.max_r, psd);
}
