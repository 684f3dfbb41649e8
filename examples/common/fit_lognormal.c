/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lognormal: the logarithms are normal with mean log(median) and standard deviation sigma. */
#include <math.h>
#include "fit.h"

static int fit(const double *sorted, size_t count, double *p)
{
  const double mean = fit_mean_log(sorted, count);
  double squares = 0;
  for (size_t i = 0; i < count; i++)
    squares += (log(sorted[i]) - mean) * (log(sorted[i]) - mean);
  p[0] = exp(mean);
  p[1] = sqrt(squares / (double)count);
  return p[0] > 0 && p[1] > 0;
}

static double cdf(const double *p, double x)
{
  return x > 0 ? erfc(log(p[0] / x) / (p[1] * M_SQRT2)) / 2 : 0;
}

static double log_density(const double *p, double x)
{
  const double z = log(x / p[0]) / p[1];
  return -z * z / 2 - log(p[1] * x) - log(2 * M_PI) / 2;
}

static double draw(const double *p, packing_rng *rng)
{
  return p[0] * exp(p[1] * packing_rng_normal(rng));
}

const fit_law fit_lognormal = {"lognormal", {"median", "sigma"}, 1,   fit,
                               cdf,         log_density,         draw};
