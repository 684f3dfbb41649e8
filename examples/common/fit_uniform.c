/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uniform from the smallest to the largest number. */
#include <math.h>
#include "fit.h"

static int fit(const double *sorted, size_t count, double *p)
{
  p[0] = sorted[0];
  p[1] = sorted[count - 1];
  return 1;
}

static double cdf(const double *p, double x)
{
  return fmin(fmax((x - p[0]) / (p[1] - p[0]), 0), 1);
}

static double log_density(const double *p, double x)
{
  (void)x;
  return -log(p[1] - p[0]);
}

static double draw(const double *p, packing_rng *rng)
{
  return p[0] + (p[1] - p[0]) * packing_rng_uniform(rng);
}

const fit_law fit_uniform = {"uniform", {"min", "max"}, 0, fit, cdf, log_density, draw};
