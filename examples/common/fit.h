/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_FIT_H
#define EXAMPLES_FIT_H

/* Laws fitted to samples by maximum likelihood, each in a file of its own, and how well they fit.
 * They need GSL's error handler off. */

#include <packing/packing.h>

enum { FIT_PARAMETERS = 2, FIT_LAWS = 8 };

/* A law with its parameters p. Numbers below the law's ends have cdf 0. */
typedef struct fit_law {
  const char *name;
  const char *parameters[FIT_PARAMETERS]; /* names; NULL: fewer */
  int positive;                           /* 1: of numbers above 0 only */
  /* The likeliest parameters of sorted numbers, of which at least two differ. 0: none found. */
  int (*fit)(const double *sorted, size_t count, double *p);
  double (*cdf)(const double *p, double x);
  double (*log_density)(const double *p, double x);
  double (*draw)(const double *p, packing_rng *rng);
} fit_law;

extern const fit_law fit_normal, fit_lognormal, fit_weibull, fit_gamma, fit_exponential,
    fit_uniform, fit_cauchy, fit_chi_square;

/* All of them. */
extern const fit_law *const fit_laws[FIT_LAWS];

/* What came of one. */
typedef struct fit_result {
  const fit_law *law;
  int fitted; /* 0: the law has no such numbers; the rest is unknown */
  double p[FIT_PARAMETERS];
  double log_likelihood;
  double ks; /* distance of the sample from the law */
  double
      kolmogorov_p; /* as if the law had been known beforehand: too large, but what tables of
       fits (as the paper's) often give */
  size_t bootstrap; /* samples drawn from the law and fitted anew */
  double
      bootstrap_p; /* share of these at least as far from their own fit, itself counted in;
       NaN of none */
  size_t rank;     /* 1 fits best; 0: not fitted */
} fit_result;

/* Called after each sample; not 0 stops. */
typedef int (*fit_progress)(void *user);

/* Fits one law to sorted numbers and judges it. Streams are named by `seed`, the law and
 * `stream`. Not 0: stopped, or memory is out (3). */
int fit_sample(const fit_law *law, const double *sorted, size_t count, size_t bootstrap,
               uint64_t seed, uint64_t stream, fit_progress progress, void *user,
               fit_result *result);

/* Gives the ranks: by the p-value (of the bootstrap, where there is one), then by the distance. */
void fit_rank(fit_result *results, size_t count);

/* Means that several laws need. */
double fit_mean(const double *v, size_t count);
double fit_mean_log(const double *v, size_t count);

/* The x with psi(x) = y, psi being the digamma function. */
double fit_inverse_digamma(double y);

/* A draw of the gamma law of scale 1. */
double fit_draw_gamma(double shape, packing_rng *rng);

#endif
