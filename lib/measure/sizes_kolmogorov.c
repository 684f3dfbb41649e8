/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The p-value P(D_n >= d) of the two-sided Kolmogorov-Smirnov distance. Three ways, each where it
 * is good (the division follows R. Simard and P. L'Ecuyer, J. Stat. Softw. 39(11), 2011):
 *
 * - n d^2 >= 6: twice one side. Both sides are reached at once with a chance of exp(-6 n d^2) of
 *   that, below 1e-15 here; from d = 1/2 on never. One side is the sum of N. V. Smirnov (1944):
 *   P(D+ >= d) = d sum_j C(n, j) (d + j/n)^(j-1) (1 - d - j/n)^(n-j), j = 0 .. n (1 - d), all
 *   terms positive; linear in n. Beyond n = 1e6 its limit exp(-(6 n d + 1)^2 / (18 n)), to
 *   (n d^2)^2 / n of itself.
 * - n <= 5000: the matrix of Marsaglia, Tsang and Wang (sizes_matrix.c).
 * - beyond: the expansion of W. Pelz and I. J. Good, J. R. Stat. Soc. B 38 (1976), p. 152, whose
 *   next term is O(n^-2): against the matrix it is off by at most 0.06 / n^2, below 3e-9 beyond n = 5000. */
#include "measure/sizes_internal.h"

enum { SIDE_EXACT = 1000000 };

static const double tail_from = 6;
static const double pi = 3.14159265358979323846;

/* log of C(n, j) grows step by step; its sum is compensated, as it reaches n log 2. */
double packing_i_kolmogorov_side(size_t n, double d)
{
  const double count = (double)n;
  packing_i_sum choose = {0, 0}, sum = {0, 0};
  for (size_t j = 0; j < n; j++) {
    const double up = d + (double)j / count, left = 1 - up;
    if (!(left > 0))
      break;
    const double others = (double)(n - j);
    packing_i_sum_add(&sum, exp(packing_i_sum_value(&choose) + others * log(left) +
                                ((double)j - 1) * log(up)));
    packing_i_sum_add(&choose, log(others / ((double)j + 1)));
  }
  return d * packing_i_sum_value(&sum);
}

double packing_i_kolmogorov_side_limit(double n, double d)
{
  const double s = 6 * n * d + 1;
  return exp(-s * s / (18 * n));
}

/* What the terms of the series share: sums over all whole k of exp(-a (k + 1/2)^2) times
 * (pi (k + 1/2))^q, q = 0, 2, 4, 6, and of exp(-a k^2) times (pi k)^q, q = 2, 4, with
 * a = pi^2 / (2 z^2). */
typedef struct series {
  double half[4];
  double whole[2];
} series;

static void sum_series(double z, series *s)
{
  memset(s, 0, sizeof *s);
  for (int k = 0;; k++) {
    const double h2 = pi * pi * (k + 0.5) * (k + 0.5),
                 w2 = pi * pi * (k + 1.0) * (k + 1.0);
    const double h = 2 * exp(-h2 / (2 * z * z)), w = 2 * exp(-w2 / (2 * z * z));
    s->half[0] += h;
    s->half[1] += h * h2;
    s->half[2] += h * h2 * h2;
    s->half[3] += h * h2 * h2 * h2;
    s->whole[0] += w * w2;
    s->whole[1] += w * w2 * w2;
    if (h * h2 * h2 * h2 <= 1e-18 * s->half[3])
      return;
  }
}

double packing_i_kolmogorov_expansion(double n, double z)
{
  const double root = sqrt(pi / 2), z2 = z * z, z3 = z * z2, z4 = z2 * z2, z6 = z3 * z3;
  series s;
  if (z < 0.05) /* below exp(-490) */
    return 0;
  sum_series(z, &s);
  const double k0 = root / z * s.half[0];
  const double k1 = root / (6 * z4) * (s.half[1] - z2 * s.half[0]);
  const double k2 = root / (72 * z3 * z4) *
                        ((6 * z6 + 2 * z4) * s.half[0] + (2 * z4 - 5 * z2) * s.half[1] +
                         (1 - 2 * z2) * s.half[2]) -
                    root / (36 * z3) * s.whole[0];
  const double k3 =
      root / (6480 * z4 * z6) *
          ((5 - 30 * z2) * s.half[3] + (212 * z4 - 60 * z2) * s.half[2] +
           (135 * z4 - 96 * z6) * s.half[1] - (30 * z6 + 90 * z4 * z4) * s.half[0]) +
      root / (216 * z6) * (3 * z2 * s.whole[0] - s.whole[1]);
  const double chance = k0 + k1 / sqrt(n) + k2 / n + k3 / (n * sqrt(n));
  return fmin(fmax(chance, 0), 1);
}

static double tail(size_t n, double d)
{
  const double side = n <= SIDE_EXACT ? packing_i_kolmogorov_side(n, d)
                                      : packing_i_kolmogorov_side_limit((double)n, d);
  return fmin(2 * side, 1);
}

packing_status packing_kolmogorov_p(packing_context *context, size_t count,
                                    double distance, double *p)
{
  double chance = 0;
  PACKING_I_TRY(packing_i_check_given(context, "p", p));
  if (count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "0 numbers, at least 1 is needed");
  if (isnan(distance))
    return packing_i_fail(context, PACKING_ERR_INVALID, "distance", PACKING_NO_INDEX,
                          "not a number");
  if (!(distance >= 0 && distance <= 1))
    return packing_i_fail(context, PACKING_ERR_RANGE, "distance", PACKING_NO_INDEX,
                          "%g is not from 0 to 1", distance);
  const double n = (double)count;
  if (n * distance <= 0.5) { /* no sample is nearer */
    *p = 1;
    return PACKING_OK;
  }
  if (n * distance * distance >= tail_from) {
    *p = tail(count, distance);
    return PACKING_OK;
  }
  if (count <= PACKING_KOLMOGOROV_EXACT)
    PACKING_I_TRY(packing_i_kolmogorov_matrix(context, count, distance, &chance));
  else
    chance = packing_i_kolmogorov_expansion(n, sqrt(n) * distance);
  *p = fmin(fmax(1 - chance, 0), 1);
  return PACKING_OK;
}
