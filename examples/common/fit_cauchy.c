/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cauchy: 1/2 + atan((x - location) / scale) / pi. With weights w = 1 / (1 + z^2), z the distance
 * from the location in scales, the likeliest have location = sum w x / sum w and scale^2 =
 * sum w (x - location)^2 / sum w, steps of which never lower the likelihood (J. T. Kent, D. E.
 * Tyler, Y. Vardi, Commun. Stat. Simul. Comput. 23 (1994), p. 441). From five numbers on there is
 * but one maximum unless half of them are equal (J. B. Copas, Biometrika 62 (1975), p. 701). */
#include <math.h>
#include "fit.h"
#include "stat.h"

enum { STEPS = 2000 };

static void step(const double *v, size_t count, double *p)
{
  double all = 0, sum = 0, squares = 0;
  for (size_t i = 0; i < count; i++) {
    const double z = (v[i] - p[0]) / p[1], w = 1 / (1 + z * z);
    all += w;
    sum += w * (v[i] - p[0]);
  }
  const double location = p[0] + sum / all;
  for (size_t i = 0; i < count; i++) {
    const double z = (v[i] - p[0]) / p[1], w = 1 / (1 + z * z);
    squares += w * (v[i] - location) * (v[i] - location);
  }
  p[0] = location;
  p[1] = sqrt(squares / all);
}

/* From the median and half the distance of the quartiles. */
static int fit(const double *sorted, size_t count, double *p)
{
  const double range = sorted[count - 1] - sorted[0];
  p[0] = stat_median(sorted, count);
  p[1] = (sorted[3 * count / 4] - sorted[count / 4]) / 2;
  if (!(p[1] > 0))
    p[1] = range / 4;
  for (int k = 0; k < STEPS; k++) {
    const double before[] = {p[0], p[1]};
    step(sorted, count, p);
    if (!(p[1] > 1e-9 * range)) /* half of the numbers are equal */
      return 0;
    if (fabs(p[0] - before[0]) + fabs(p[1] - before[1]) <= 1e-12 * p[1])
      return 1;
  }
  return 0;
}

static double cdf(const double *p, double x)
{
  return 0.5 + atan((x - p[0]) / p[1]) / M_PI;
}

static double log_density(const double *p, double x)
{
  const double z = (x - p[0]) / p[1];
  return -log(M_PI * p[1]) - log1p(z * z);
}

static double draw(const double *p, packing_rng *rng)
{
  return p[0] + p[1] * tan(M_PI * (packing_rng_uniform_open(rng) - 0.5));
}

const fit_law fit_cauchy = {"cauchy", {"location", "scale"}, 0,   fit,
                            cdf,      log_density,           draw};
