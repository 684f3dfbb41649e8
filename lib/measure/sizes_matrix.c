/* SPDX-License-Identifier: GPL-3.0-or-later */
/* P(D_n < d), exact: J. Durbin's matrix as G. Marsaglia, W. W. Tsang and J. Wang use it (J. Stat.
 * Softw. 8(18), 2003). With k = floor(n d) + 1, h = k - n d, m = 2 k - 1,
 *
 *   P = n! / n^n (H^n)[k-1][k-1],
 *   H[i][j] = 1 / (i - j + 1)!, 0 above the first superdiagonal; in the first column
 *   (1 - h^(i+1)) / (i+1)!, in the last row (1 - h^(m-j)) / (m-j)!, in their corner
 *   (1 - 2 h^m + max(0, 2 h - 1)^m) / m!.
 *
 * Only one row of the power is wanted, so the row is carried and the matrix squared: log2(n)
 * squarings of m^3. Powers of two are split off to stay in range, which rounds nothing. The
 * memory is two matrices. */
#include "measure/sizes_internal.h"

/* A number of any size: value 2^exponent. */
typedef struct scaled {
  double value;
  long exponent;
} scaled;

static void normalise(scaled *s)
{
  int e;
  s->value = frexp(s->value, &e);
  s->exponent += e;
}

static double whole_power(double x, size_t q)
{
  double power = 1;
  for (; q > 0; q >>= 1, x *= x)
    if (q & 1)
      power *= x;
  return power;
}

/* Times (i - j + 1)!. */
static double entry(size_t i, size_t j, size_t m, double h)
{
  double v = 1;
  if (j == 0)
    v -= whole_power(h, i + 1);
  if (i == m - 1)
    v -= whole_power(h, m - j);
  if (i == m - 1 && j == 0)
    v += whole_power(fmax(2 * h - 1, 0), m);
  return v;
}

/* The quotients 1 / q! are read off a table kept in `row`, m + 1 long. */
static void fill(double *matrix, double *row, size_t m, double h)
{
  for (size_t q = 0; q <= m; q++)
    row[q] = q < 2 ? 1 : row[q - 1] / (double)q;
  for (size_t i = 0; i < m; i++)
    for (size_t j = 0; j < m; j++)
      matrix[i * m + j] = j > i + 1 ? 0 : entry(i, j, m, h) * row[i + 1 - j];
}

/* to = row matrix. */
static void multiply_row(const double *row, const double *matrix, size_t m, double *to)
{
  for (size_t j = 0; j < m; j++)
    to[j] = 0;
  for (size_t i = 0; i < m; i++) {
    const double v = row[i], *from = matrix + i * m;
    if (v == 0)
      continue;
    for (size_t j = 0; j < m; j++)
      to[j] += v * from[j];
  }
}

/* Divides by the power of two of the entry in the middle, which is the one that is wanted. */
static long rescale(double *v, size_t count, double middle)
{
  int e;
  frexp(middle, &e);
  if (e == 0)
    return 0;
  for (size_t i = 0; i < count; i++)
    v[i] = ldexp(v[i], -e);
  return e;
}

/* (H^n)[k-1][k-1]. */
static scaled middle_of_power(size_t n, size_t m, double *matrix, double *square,
                              double *row, double *next)
{
  const size_t k = (m + 1) / 2;
  long row_exponent = 0, exponent = 0; /* powers of two split off */
  for (size_t j = 0; j < m; j++)
    row[j] = j == k - 1;
  for (;; n >>= 1) {
    if (n & 1) {
      multiply_row(row, matrix, m, next);
      memcpy(row, next, m * sizeof *row);
      row_exponent += exponent + rescale(row, m, row[k - 1]);
    }
    if (n <= 1)
      break;
    for (size_t i = 0; i < m; i++)
      multiply_row(matrix + i * m, matrix, m, square + i * m);
    memcpy(matrix, square, m * m * sizeof *matrix);
    exponent = 2 * exponent + rescale(matrix, m * m, matrix[(k - 1) * m + k - 1]);
  }
  const scaled middle = {row[k - 1], row_exponent};
  return middle;
}

/* Times n! / n^n. */
static double times_factorial(scaled s, size_t n)
{
  for (size_t i = 1; i <= n; i++) {
    s.value *= (double)i / (double)n;
    normalise(&s);
  }
  return s.exponent < -2000 ? 0 : ldexp(s.value, (int)s.exponent);
}

packing_status packing_i_kolmogorov_matrix(packing_context *context, size_t n, double d,
                                           double *chance)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t k = (size_t)((double)n * d) + 1, m = 2 * k - 1;
  packing_status status = PACKING_OK;
  double *matrix = packing_i_alloc(allocator, m * m, sizeof *matrix);
  double *square = packing_i_alloc(allocator, m * m, sizeof *square);
  double *row = packing_i_alloc(allocator, m + 1, sizeof *row);
  double *next = packing_i_alloc(allocator, m, sizeof *next);
  if (matrix == NULL || square == NULL || row == NULL || next == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  fill(matrix, row, m, (double)k - (double)n * d);
  *chance = times_factorial(middle_of_power(n, m, matrix, square, row, next), n);
out:
  packing_i_free(allocator, matrix);
  packing_i_free(allocator, square);
  packing_i_free(allocator, row);
  packing_i_free(allocator, next);
  return status;
}
