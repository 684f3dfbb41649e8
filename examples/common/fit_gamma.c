/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gamma: density x^(k-1) exp(-x / scale). The likeliest shape k solves
 * log k - psi(k) = log mean - mean log; Newton's steps on 1 / k from T. P. Minka's start ("Estimating
 * a gamma distribution", 2002); scale = mean / k. Draws: G. Marsaglia, W. W. Tsang, ACM Trans.
 * Math. Softw. 26 (2000), p. 363. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_psi.h>
#include <math.h>
#include "fit.h"

enum { STEPS = 100 };

static double digamma(double x)
{
  gsl_sf_result r;
  return gsl_sf_psi_e(x, &r) ? (double)NAN : r.val;
}

static double trigamma(double x)
{
  gsl_sf_result r;
  return gsl_sf_psi_n_e(1, x, &r) ? (double)NAN : r.val;
}

static int fit(const double *sorted, size_t count, double *p)
{
  const double mean = fit_mean(sorted, count);
  const double s = log(mean) - fit_mean_log(sorted, count);
  double k = (3 - s + sqrt((s - 3) * (s - 3) + 24 * s)) / (12 * s);
  if (!(s > 0))
    return 0;
  for (int step = 0; step < STEPS; step++) {
    const double off = log(k) - digamma(k) - s;
    const double next = 1 / (1 / k + off / (k * k * (1 / k - trigamma(k))));
    const int done = fabs(next - k) <= 1e-12 * k;
    k = next;
    if (done)
      break;
  }
  p[0] = mean / k;
  p[1] = k;
  return k > 0;
}

static double cdf(const double *p, double x)
{
  return x > 0 ? gsl_cdf_gamma_P(x, p[1], p[0]) : 0;
}

static double log_density(const double *p, double x)
{
  gsl_sf_result log_gamma;
  if (gsl_sf_lngamma_e(p[1], &log_gamma))
    return (double)NAN;
  return (p[1] - 1) * log(x / p[0]) - x / p[0] - log_gamma.val - log(p[0]);
}

static double draw(const double *p, packing_rng *rng)
{
  return p[0] * fit_draw_gamma(p[1], rng);
}

/* Below shape 1 by the gamma law of shape + 1 times u^(1 / shape). */
double fit_draw_gamma(double shape, packing_rng *rng)
{
  const double whole = shape < 1 ? shape + 1 : shape;
  const double d = whole - 1.0 / 3, c = 1 / sqrt(9 * d);
  for (;;) {
    const double x = packing_rng_normal(rng), v = pow(1 + c * x, 3);
    const double u = packing_rng_uniform_open(rng);
    if (v > 0 && log(u) < x * x / 2 + d * (1 - v + log(v)))
      return shape < 1 ? d * v * pow(packing_rng_uniform_open(rng), 1 / shape) : d * v;
  }
}

/* Newton's steps from Minka's start, which overshoots nowhere as psi is concave. */
double fit_inverse_digamma(double y)
{
  double x = y >= -2.22 ? exp(y) + 0.5 : -1 / (y - digamma(1));
  for (int step = 0; step < STEPS; step++) {
    const double next = x - (digamma(x) - y) / trigamma(x);
    const int done = fabs(next - x) <= 1e-13 * x;
    x = next;
    if (done)
      break;
  }
  return x;
}

const fit_law fit_gamma = {"gamma", {"scale", "shape"}, 1, fit, cdf, log_density, draw};
