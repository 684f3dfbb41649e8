/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weibull: 1 - exp(-(x / scale)^shape). The likeliest shape k solves
 *
 *   g(k) = sum x^k log x / sum x^k - 1 / k - mean log x = 0,
 *
 * which rises with k (A. C. Cohen, Technometrics 7 (1965), p. 579); by Newton's steps within a
 * bracket; scale = (mean x^k)^(1 / k). Numbers are divided by the largest, so powers are in range. */
#include <math.h>
#include "fit.h"

enum { STEPS = 200 };

typedef struct sums {
  double value, slope, mean_power;
} sums;

static sums at(const double *sorted, size_t count, double mean_log, double k)
{
  const double most = sorted[count - 1];
  double s0 = 0, s1 = 0, s2 = 0;
  for (size_t i = 0; i < count; i++) {
    const double l = log(sorted[i] / most), power = exp(k * l);
    s0 += power;
    s1 += power * l;
    s2 += power * l * l;
  }
  const double ratio = s1 / s0;
  const sums s = {ratio - 1 / k - mean_log, s2 / s0 - ratio * ratio + 1 / (k * k),
                  s0 / (double)count};
  return s;
}

static int fit(const double *sorted, size_t count, double *p)
{
  const double most = sorted[count - 1],
               mean_log = fit_mean_log(sorted, count) - log(most);
  double low = 0, high = INFINITY, k = -1 / mean_log;
  for (int step = 0; step < STEPS; step++) {
    const sums s = at(sorted, count, mean_log, k);
    if (s.value > 0)
      high = k;
    else
      low = k;
    double next = k - s.value / s.slope;
    if (!(next > low && next < high))
      next = isinf(high) ? 2 * low : (low + high) / 2;
    p[0] = most * pow(s.mean_power, 1 / k);
    p[1] = k;
    if (fabs(next - k) <= 1e-13 * k)
      return 1;
    k = next;
  }
  return 0;
}

static double cdf(const double *p, double x)
{
  return x > 0 ? -expm1(-pow(x / p[0], p[1])) : 0;
}

static double log_density(const double *p, double x)
{
  const double l = log(x / p[0]);
  return log(p[1] / p[0]) + (p[1] - 1) * l - exp(p[1] * l);
}

static double draw(const double *p, packing_rng *rng)
{
  return p[0] * pow(-log(packing_rng_uniform_open(rng)), 1 / p[1]);
}

const fit_law fit_weibull = {"weibull", {"scale", "shape"}, 1,   fit,
                             cdf,       log_density,        draw};
