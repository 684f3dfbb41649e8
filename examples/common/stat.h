/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_STAT_H
#define EXAMPLES_STAT_H

/* Tests of statistics, each in a file of its own that names formula and source. Samples are
 * finite; what a sample is too small for is NaN. They need GSL's error handler off. */

#include <stddef.h>

/* A sample in figures. */
typedef struct stat_summary {
  double
      n; /* numbers in it; need not be whole where it is worked out of an error of the mean */
  double mean;
  double sd; /* of a sample (divisor n - 1) */
} stat_summary;

stat_summary stat_summarise(const double *values, size_t count);

/* Standard error of the mean, and half the 95 % confidence interval by Student's law. */
double stat_standard_error(const stat_summary *s);
double stat_confidence95(const stat_summary *s);

/* The middle of sorted numbers. */
double stat_median(const double *sorted, size_t count);

/* Sorts in place, rising. */
void stat_sort(double *values, size_t count);

/* Welch's t of two samples with unequal variances, two-sided. */
typedef struct stat_welch {
  double t; /* above 0: the first mean is larger */
  double dof;
  double p;
} stat_welch;

stat_welch stat_welch_test(const stat_summary *a, const stat_summary *b);

/* Mann and Whitney's U of two samples, two-sided. Both sorted. */
typedef struct stat_mann_whitney {
  double u; /* pairs in which the first sample's number is larger, ties half */
  double p;
  int exact; /* 1: of all orders; 0: normal law, ties and continuity corrected */
} stat_mann_whitney;

stat_mann_whitney stat_mann_whitney_test(const double *a, size_t n, const double *b,
                                         size_t m);

/* Kolmogorov and Smirnov's distance of two samples. Both sorted. */
typedef struct stat_ks {
  double d;
  double p;
  int exact; /* 1: of all orders, ties as they are; 0: the limit law */
} stat_ks;

stat_ks stat_ks_test(const double *a, size_t n, const double *b, size_t m);

/* P(sup >= lambda) of Kolmogorov's limit law. */
double stat_kolmogorov_limit(double lambda);

/* One-way analysis of variance. */
typedef struct stat_anova {
  double f;
  double between, within; /* degrees of freedom */
  double p;
} stat_anova;

stat_anova stat_anova_test(const stat_summary *samples, size_t count);

/* Dixon's Q (r10) of the end that lies farther off. */
enum { STAT_DIXON_LEAST = 3, STAT_DIXON_MOST = 30, STAT_DIXON_LEVELS = 3 };
extern const double stat_dixon_levels[STAT_DIXON_LEVELS]; /* .90, .95, .99 */

typedef struct stat_dixon {
  double q;
  double suspect; /* the number at that end */
  double p;       /* chance of such a Q at either end, at most */
  double critical[STAT_DIXON_LEVELS];
} stat_dixon;

stat_dixon stat_dixon_test(const double *sorted, size_t count);

/* P(Q > q) of one given end of `count` normal numbers. */
double stat_dixon_side(size_t count, double q);

#endif
