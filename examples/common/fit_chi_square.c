/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chi-square with any number nu > 0 of degrees of freedom, which sets its scale too: the gamma law
 * of shape nu / 2 and scale 2. The likeliest solves psi(nu / 2) = mean log(x / 2). */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include "fit.h"

static int fit(const double *sorted, size_t count, double *p)
{
  p[0] = 2 * fit_inverse_digamma(fit_mean_log(sorted, count) - M_LN2);
  return p[0] > 0;
}

static double cdf(const double *p, double x)
{
  return x > 0 ? gsl_cdf_chisq_P(x, p[0]) : 0;
}

static double log_density(const double *p, double x)
{
  gsl_sf_result log_gamma;
  if (gsl_sf_lngamma_e(p[0] / 2, &log_gamma))
    return (double)NAN;
  return (p[0] / 2 - 1) * log(x / 2) - x / 2 - log_gamma.val - M_LN2;
}

static double draw(const double *p, packing_rng *rng)
{
  return 2 * fit_draw_gamma(p[0] / 2, rng);
}

const fit_law fit_chi_square = {"chi-square", {"dof", NULL}, 1,   fit,
                                cdf,          log_density,   draw};
