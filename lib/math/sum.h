/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SUM_H
#define PACKING_SUM_H

#include <math.h>

/* A sum and what rounding left out of it (A. Neumaier, Z. Angew. Math. Mech. 54, 1974, p. 39).
 * Added in a fixed order it is the same for any number of threads. */
typedef struct packing_i_sum {
  double sum;
  double rest;
} packing_i_sum;

static inline void packing_i_sum_add(packing_i_sum *s, double v)
{
  const double t = s->sum + v;
  s->rest += fabs(s->sum) >= fabs(v) ? (s->sum - t) + v : (v - t) + s->sum;
  s->sum = t;
}

static inline double packing_i_sum_value(const packing_i_sum *s)
{
  return s->sum + s->rest;
}

#endif
