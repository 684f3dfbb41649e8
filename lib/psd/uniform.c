/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Radii uniform in [a, b]. Weighted by x^e the density is a power law, and with q = e + 1,
 * u = log(x / a), U = log(b / a)
 *
 *   cdf(x) = (x^q - a^q) / (b^q - a^q) = expm1(q u) / expm1(q U)      (q = 0: u / U),
 *
 * a form without cancellation for a narrow band (b - a << a) as well as for a wide one. */
#include "psd_internal.h"
#include <gsl/gsl_math.h>
#include <math.h>

typedef struct uniform_law {
  packing_psd base;
  double span; /* U */
} uniform_law;

static int power_of(const packing_psd *psd, packing_by by)
{
  return packing_i_psd_number_exponent(psd->by, psd->dim) +
         (by == PACKING_BY_MASS ? psd->dim : 0) + 1;
}

static double log_ratio(const packing_psd *psd, double x)
{
  return log1p((x - psd->min_x) / psd->min_x);
}

static double cdf(const packing_psd *psd, packing_by by, double x)
{
  const uniform_law *law = (const uniform_law *)psd;
  const int q = power_of(psd, by);
  const double u = log_ratio(psd, x);
  return q == 0 ? u / law->span : expm1(q * u) / expm1(q * law->span);
}

static double quantile(const packing_psd *psd, packing_by by, double p)
{
  const uniform_law *law = (const uniform_law *)psd;
  const int q = power_of(psd, by);
  if (q == 1)
    return psd->min_x + p * (psd->max_x - psd->min_x);
  const double u = q == 0 ? p * law->span : log1p(p * expm1(q * law->span)) / q;
  return psd->min_x + psd->min_x * expm1(u);
}

static const packing_i_psd_ops ops = {
    "uniform", "density constant in r", cdf, quantile, packing_i_psd_point, 1, NULL};

/* Integral of x^e over [a, b]. */
static double integral(const uniform_law *law, int e)
{
  const int q = e + 1;
  return q == 0 ? law->span : gsl_pow_int(law->base.min_x, q) * expm1(q * law->span) / q;
}

void packing_psd_uniform_def_fill(packing_psd_uniform_def *def, size_t size)
{
  packing_psd_uniform_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_psd_create_uniform(packing_context *context,
                                          const packing_psd_uniform_def *def,
                                          packing_psd **psd)
{
  packing_psd_uniform_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_uniform, dim, def, &d));
  PACKING_I_TRY(packing_i_psd_check_measure(context, d.by, d.dim));
  PACKING_I_TRY(packing_i_psd_check_cut(context, d.min_r, d.max_r));
  uniform_law *law = (uniform_law *)packing_i_psd_new(context, &ops, sizeof *law, d.by,
                                                      d.dim, d.min_r, d.max_r);
  if (law == NULL)
    return PACKING_ERR_NOMEM;
  law->span = log_ratio(&law->base, law->base.max_x);
  const int e = packing_i_psd_number_exponent(d.by, d.dim);
  for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
    law->base.moment[n] =
        integral(law, e + n + PACKING_I_PSD_LEAST_POWER) / integral(law, e);
  *psd = &law->base;
  return PACKING_OK;
}
