/* SPDX-License-Identifier: GPL-3.0-or-later */
/* D = sup |F_a - F_b|. Up to n m = 1e7 the p-value is that among all orders of the n + m numbers,
 * ties as they are: an order is a path from (0, 0) to (n, m), and the share of the paths to (i, j)
 * that have been as far off as D,
 *
 *   A(i, j) = 1 where |i / n - j / m| >= D between two different numbers, else
 *             i / (i + j) A(i - 1, j) + j / (i + j) A(i, j - 1)
 *
 * (J. L. Hodges, Ark. Mat. 3 (1958), p. 469; the complement of his recursion, all terms positive).
 * Beyond, Kolmogorov's limit with n m / (n + m) numbers. Distances are whole numbers of 1 / (n m). */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include "program.h"
#include "stat.h"

static const double exact_up_to = 1e7;

/* The k-th of both samples together ends a group of equal numbers: marked in `ends`, 1 .. n + m.
 * Returns the largest |i m - j n|. */
static uint64_t walk(const double *a, size_t n, const double *b, size_t m,
                     unsigned char *ends)
{
  size_t i = 0, j = 0;
  uint64_t most = 0;
  while (i < n || j < m) {
    const double x = j >= m || (i < n && a[i] <= b[j]) ? a[i] : b[j];
    while (i < n && a[i] == x)
      i++;
    while (j < m && b[j] == x)
      j++;
    const uint64_t left = (uint64_t)i * m, right = (uint64_t)j * n;
    const uint64_t off = left > right ? left - right : right - left;
    most = off > most ? off : most;
    if (ends)
      ends[i + j] = 1;
  }
  return most;
}

static double touching_share(size_t n, size_t m, uint64_t limit,
                             const unsigned char *ends)
{
  double *row = program_take(m + 1, sizeof *row);
  for (size_t i = 0; i <= n; i++)
    for (size_t j = 0; j <= m; j++) {
      const uint64_t left = (uint64_t)i * m, right = (uint64_t)j * n;
      const uint64_t off = left > right ? left - right : right - left;
      const double both = (double)(i + j);
      if (ends[i + j] && off >= limit)
        row[j] = 1;
      else
        row[j] = (i > 0 ? (double)i / both * row[j] : 0) +
                 (j > 0 ? (double)j / both * row[j - 1] : 0);
    }
  const double share = row[m];
  free(row);
  return share;
}

double stat_kolmogorov_limit(double lambda)
{
  double sum = 0;
  if (lambda < 0.2) /* 1 - 1e-12 */
    return 1;
  for (int k = 1; k < 40; k++)
    sum += (k % 2 ? 2 : -2) * exp(-2.0 * k * k * lambda * lambda);
  return fmin(fmax(sum, 0), 1);
}

stat_ks stat_ks_test(const double *a, size_t n, const double *b, size_t m)
{
  stat_ks k = {(double)NAN, (double)NAN, 0};
  const double size = (double)n * (double)m;
  if (n == 0 || m == 0)
    return k;
  k.exact = size <= exact_up_to;
  unsigned char *ends = k.exact ? program_take(n + m + 1, 1) : NULL;
  const uint64_t off = walk(a, n, b, m, ends);
  k.d = (double)off / size;
  k.p = k.exact ? touching_share(n, m, off, ends)
                : stat_kolmogorov_limit(k.d * sqrt(size / (double)(n + m)));
  free(ends);
  return k;
}
