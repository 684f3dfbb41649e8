/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Goodness of fit by Kolmogorov and Smirnov's distance. With parameters fitted to the same sample
 * the distance does not follow Kolmogorov's law (H. W. Lilliefors, J. Am. Stat. Assoc. 62 (1967),
 * p. 399), so p comes from samples drawn from the fitted law and fitted anew (parametric bootstrap:
 * W. Stute, W. Gonzales Manteiga, M. Presedo Quindimil, Metrika 40 (1993), p. 243):
 * p = (1 + as far off as the sample) / (1 + drawn). */
#include "fit.h"
#include <math.h>
#include <stdlib.h>
#include "program.h"
#include "stat.h"

const fit_law *const fit_laws[FIT_LAWS] = {&fit_normal, &fit_lognormal,   &fit_weibull,
                                           &fit_gamma,  &fit_exponential, &fit_uniform,
                                           &fit_cauchy, &fit_chi_square};

double fit_mean(const double *v, size_t count)
{
  double sum = 0;
  for (size_t i = 0; i < count; i++)
    sum += v[i];
  return sum / (double)count;
}

double fit_mean_log(const double *v, size_t count)
{
  double sum = 0;
  for (size_t i = 0; i < count; i++)
    sum += log(v[i]);
  return sum / (double)count;
}

static double distance(const fit_law *law, const double *p, const double *sorted,
                       size_t count)
{
  double most = 0;
  for (size_t i = 0; i < count; i++) {
    const double at = law->cdf(p, sorted[i]);
    most = fmax(
        most, fmax(at - (double)i / (double)count, (double)(i + 1) / (double)count - at));
  }
  return most;
}

static double log_likelihood(const fit_law *law, const double *p, const double *sorted,
                             size_t count)
{
  double sum = 0;
  for (size_t i = 0; i < count; i++)
    sum += law->log_density(p, sorted[i]);
  return sum;
}

/* 1: fitted. */
static int fit(const fit_law *law, const double *sorted, size_t count, double *p,
               double *ks)
{
  if (count < 2 || !(sorted[0] < sorted[count - 1]) ||
      (law->positive && !(sorted[0] > 0)))
    return 0;
  if (!law->fit(sorted, count, p))
    return 0;
  for (int k = 0; k < FIT_PARAMETERS && law->parameters[k]; k++)
    if (!isfinite(p[k]))
      return 0;
  *ks = distance(law, p, sorted, count);
  return 1;
}

/* Where the law stands in the table names its streams. */
static uint32_t purpose_of(const fit_law *law)
{
  uint32_t k = 0;
  while (fit_laws[k] != law)
    k++;
  return PACKING_PURPOSE_USER + k;
}

static int draw_again(const fit_result *r, size_t count, double *sample, packing_rng *rng,
                      size_t *farther, size_t *drawn)
{
  double p[FIT_PARAMETERS] = {0, 0}, ks = 0;
  for (size_t i = 0; i < count; i++)
    sample[i] = r->law->draw(r->p, rng);
  stat_sort(sample, count);
  if (!fit(r->law, sample, count, p, &ks))
    return 0;
  *farther += ks >= r->ks;
  ++*drawn;
  return 1;
}

static int bootstrap(fit_result *r, size_t count, size_t wanted, uint64_t seed,
                     uint64_t stream, fit_progress progress, void *user)
{
  packing_rng *rng = NULL;
  size_t farther = 0;
  int code = 0;
  const packing_status status =
      packing_rng_create(NULL, seed, purpose_of(r->law), stream, &rng);
  if (status != PACKING_OK)
    return program_status(NULL, status, r->law->name);
  double *sample = program_take(count, sizeof *sample);
  for (size_t b = 0; b < wanted && !code; b++) {
    draw_again(r, count, sample, rng, &farther, &r->bootstrap);
    code = progress ? progress(user) : 0;
  }
  if (r->bootstrap > 0)
    r->bootstrap_p = (1 + (double)farther) / (1 + (double)r->bootstrap);
  free(sample);
  packing_rng_destroy(rng);
  return code;
}

int fit_sample(const fit_law *law, const double *sorted, size_t count, size_t wanted,
               uint64_t seed, uint64_t stream, fit_progress progress, void *user,
               fit_result *result)
{
  const double nan = (double)NAN;
  const fit_result none = {.law = law,
                           .p = {nan, nan},
                           .log_likelihood = nan,
                           .ks = nan,
                           .kolmogorov_p = nan,
                           .bootstrap_p = nan};
  *result = none;
  result->fitted = fit(law, sorted, count, result->p, &result->ks);
  if (!result->fitted) {
    *result = none;
    return 0;
  }
  result->log_likelihood = log_likelihood(law, result->p, sorted, count);
  const packing_status status =
      packing_kolmogorov_p(NULL, count, fmin(result->ks, 1), &result->kolmogorov_p);
  if (status != PACKING_OK)
    return program_status(NULL, status, law->name);
  return bootstrap(result, count, wanted, seed, stream, progress, user);
}

/* Whether a fits better than b. */
static int is_better(const fit_result *a, const fit_result *b)
{
  if (a->fitted != b->fitted)
    return a->fitted;
  const double pa = isnan(a->bootstrap_p) ? a->kolmogorov_p : a->bootstrap_p;
  const double pb = isnan(b->bootstrap_p) ? b->kolmogorov_p : b->bootstrap_p;
  return pa != pb ? pa > pb : a->ks < b->ks;
}

void fit_rank(fit_result *results, size_t count)
{
  for (size_t i = 0; i < count; i++) {
    results[i].rank = results[i].fitted != 0;
    for (size_t j = 0; j < count && results[i].fitted; j++)
      results[i].rank +=
          is_better(&results[j], &results[i]) ||
          (j < i && !is_better(&results[i], &results[j]) && results[j].fitted);
  }
}
