/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exponential from 0: 1 - exp(-x / mean). */
#include <math.h>
#include "fit.h"

static int fit(const double *sorted, size_t count, double *p)
{
  p[0] = fit_mean(sorted, count);
  return p[0] > 0;
}

static double cdf(const double *p, double x)
{
  return x > 0 ? -expm1(-x / p[0]) : 0;
}

static double log_density(const double *p, double x)
{
  return -x / p[0] - log(p[0]);
}

static double draw(const double *p, packing_rng *rng)
{
  return -p[0] * log(packing_rng_uniform_open(rng));
}

const fit_law fit_exponential = {"exponential", {"mean", NULL}, 1,   fit,
                                 cdf,           log_density,    draw};
