/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_EXPANSION_H
#define PACKING_EXPANSION_H

/* Exact sums and products of doubles: what rounding drops is kept. T. J. Dekker, Numer. Math. 18
 * (1971) 224; D. E. Knuth, Seminumerical Algorithms, 4.2.2; J. R. Shewchuk, Discrete Comput. Geom.
 * 18 (1997) 305. They hold as long as nothing overflows or sinks below the smallest double and
 * a * b + c is not contracted, which the build sees to.
 *
 * An expansion is a sum of doubles that do not overlap, rising in magnitude; its sign is that of
 * the last. Zeros are left out, but for the expansion of zero itself, which has length 0. */

#include <stddef.h>

/* hi + lo, exactly. */
typedef struct packing_i_two {
  double hi;
  double lo;
} packing_i_two;

static inline packing_i_two packing_i_two_sum(double a, double b)
{
  packing_i_two s;
  s.hi = a + b;
  const double b_part = s.hi - a;
  s.lo = (a - (s.hi - b_part)) + (b - b_part);
  return s;
}

/* The same where |a| >= |b| or a = 0. */
static inline packing_i_two packing_i_two_sum_sorted(double a, double b)
{
  packing_i_two s;
  s.hi = a + b;
  s.lo = b - (s.hi - a);
  return s;
}

/* Halves of 26 and 27 bits. */
static inline packing_i_two packing_i_two_split(double a)
{
  const double c = 134217729.0 * a; /* 2^27 + 1 */
  packing_i_two s;
  s.hi = c - (c - a);
  s.lo = a - s.hi;
  return s;
}

static inline packing_i_two packing_i_two_product_split(double a, double b,
                                                        packing_i_two b_split)
{
  const packing_i_two s = packing_i_two_split(a);
  packing_i_two p;
  p.hi = a * b;
  p.lo = s.lo * b_split.lo -
         (((p.hi - s.hi * b_split.hi) - s.lo * b_split.hi) - s.hi * b_split.lo);
  return p;
}

static inline packing_i_two packing_i_two_product(double a, double b)
{
  return packing_i_two_product_split(a, b, packing_i_two_split(b));
}

/* Doubles of twice the length, relative error below 2^-103 each operation (M. Joldes, J.-M. Muller,
 * V. Popescu, ACM Trans. Math. Softw. 44 (2017) 15res, algorithms 6 and 10). */
static inline packing_i_two packing_i_double_add(packing_i_two a, packing_i_two b)
{
  const packing_i_two s = packing_i_two_sum(a.hi, b.hi),
                      t = packing_i_two_sum(a.lo, b.lo);
  const packing_i_two v = packing_i_two_sum_sorted(s.hi, s.lo + t.hi);
  return packing_i_two_sum_sorted(v.hi, t.lo + v.lo);
}

static inline packing_i_two packing_i_double_multiply(packing_i_two a, packing_i_two b)
{
  const packing_i_two p = packing_i_two_product(a.hi, b.hi);
  return packing_i_two_sum_sorted(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline packing_i_two packing_i_double_negate(packing_i_two a)
{
  a.hi = -a.hi;
  a.lo = -a.lo;
  return a;
}

/* An expansion that stands in somebody's memory. */
typedef struct packing_i_expansion {
  double *e;
  size_t n;
} packing_i_expansion;

/* out = a + b, room for a.n + b.n, apart from both. */
void packing_i_expansion_add(const packing_i_expansion *a, const packing_i_expansion *b,
                             packing_i_expansion *out);

/* out = a * b, room for 2 a.n b.n, as is `spare`; apart from all. */
void packing_i_expansion_multiply(const packing_i_expansion *a,
                                  const packing_i_expansion *b, packing_i_expansion *out,
                                  double *spare);

static inline void packing_i_expansion_negate(packing_i_expansion *a)
{
  for (size_t i = 0; i < a->n; i++)
    a->e[i] = -a->e[i];
}

static inline int packing_i_expansion_sign(const packing_i_expansion *a)
{
  return a->n == 0 ? 0 : a->e[a->n - 1] > 0 ? 1 : -1;
}

/* The exact sum of two doubles, or of a two, as an expansion in e[0 .. 1]. */
static inline void packing_i_expansion_set(packing_i_expansion *a, packing_i_two t)
{
  a->n = 0;
  if (t.lo != 0)
    a->e[a->n++] = t.lo;
  if (t.hi != 0)
    a->e[a->n++] = t.hi;
}

#endif
