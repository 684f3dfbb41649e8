/* SPDX-License-Identifier: GPL-3.0-or-later */
/* U = pairs (a, b) with a > b, ties counting half (H. B. Mann, D. R. Whitney, Ann. Math. Stat. 18
 * (1947), p. 50). Without ties and with at most 50 numbers on each side the law of U is counted:
 * the largest of n + m numbers is an a with chance n / (n + m) and then exceeds all b,
 *
 *   P(n, m, u) = n / (n + m) P(n - 1, m, u - m) + m / (n + m) P(n, m - 1, u),
 *
 * cost n^2 m^2. Beyond, or with ties, the normal law with mean n m / 2 and variance
 * n m / 12 (N + 1 - sum (t^3 - t) / (N (N - 1))), t the sizes of the ties, continuity corrected. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "stat.h"

enum { EXACT = 50 };

/* U, and the sum of t^3 - t. */
static double count_pairs(const double *a, size_t n, const double *b, size_t m,
                          double *ties)
{
  double u = 0;
  size_t i = 0, j = 0;
  *ties = 0;
  while (i < n || j < m) {
    const double x = j >= m || (i < n && a[i] <= b[j]) ? a[i] : b[j];
    size_t in_a = 0, in_b = 0;
    for (; i < n && a[i] == x; i++)
      in_a++;
    for (; j < m && b[j] == x; j++)
      in_b++;
    const double t = (double)(in_a + in_b);
    u += (double)in_a * ((double)(j - in_b) + (double)in_b / 2);
    *ties += t * t * t - t;
  }
  return u;
}

/* P(U <= most). row[k] holds P(n, k, .) for the n at hand; each has n k + 1 values. */
static double chance_up_to(size_t n, size_t m, size_t most)
{
  const size_t length = n * m + 1;
  double *row = program_take((m + 1) * length, sizeof *row), sum = 0;
  for (size_t k = 0; k <= m; k++)
    row[k * length] = 1; /* of no a: U = 0 */
  for (size_t a = 1; a <= n; a++)
    for (size_t b = 1; b <= m; b++) {
      double *here = row + b * length; /* still those of a - 1 */
      const double *left = row + (b - 1) * length, share = (double)a / (double)(a + b);
      for (size_t u = a * b + 1; u-- > 0;)
        here[u] = share * (u >= b ? here[u - b] : 0) + (1 - share) * left[u];
    }
  for (size_t u = 0; u <= most; u++)
    sum += row[m * length + u];
  free(row);
  return sum;
}

static double normal_p(double u, double n, double m, double ties)
{
  const double all = n + m, mean = n * m / 2;
  const double variance = n * m / 12 * (all + 1 - ties / (all * (all - 1)));
  const double off = fmax(fabs(u - mean) - 0.5, 0);
  return variance > 0 ? erfc(off / sqrt(2 * variance)) : 1;
}

stat_mann_whitney stat_mann_whitney_test(const double *a, size_t n, const double *b,
                                         size_t m)
{
  stat_mann_whitney w = {(double)NAN, (double)NAN, 0};
  double ties;
  if (n == 0 || m == 0)
    return w;
  w.u = count_pairs(a, n, b, m, &ties);
  w.exact = ties == 0 && n <= EXACT && m <= EXACT;
  const double all = (double)n * (double)m;
  w.p = w.exact ? fmin(1, 2 * chance_up_to(n, m, (size_t)fmin(w.u, all - w.u)))
                : normal_p(w.u, (double)n, (double)m, ties);
  return w;
}
