/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Normal: the mean, and the standard deviation with divisor n. */
#include <math.h>
#include "fit.h"

static int fit(const double *sorted, size_t count, double *p)
{
  double squares = 0;
  p[0] = fit_mean(sorted, count);
  for (size_t i = 0; i < count; i++)
    squares += (sorted[i] - p[0]) * (sorted[i] - p[0]);
  p[1] = sqrt(squares / (double)count);
  return p[1] > 0;
}

static double cdf(const double *p, double x)
{
  return erfc((p[0] - x) / (p[1] * M_SQRT2)) / 2;
}

static double log_density(const double *p, double x)
{
  const double z = (x - p[0]) / p[1];
  return -z * z / 2 - log(p[1]) - log(2 * M_PI) / 2;
}

static double draw(const double *p, packing_rng *rng)
{
  return p[0] + p[1] * packing_rng_normal(rng);
}

const fit_law fit_normal = {"normal", {"mean", "sd"}, 0, fit, cdf, log_density, draw};
