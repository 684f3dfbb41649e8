/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums and products of expansions: Shewchuk's FAST-EXPANSION-SUM and SCALE-EXPANSION with zeros
 * left out. Both need and keep the property that components do not overlap and no three touch
 * ("strongly nonoverlapping"), which rounding to nearest even gives. */
#include "expansion.h"
#include <math.h>
#include <string.h>

static void put(packing_i_expansion *out, double component)
{
  if (component != 0)
    out->e[out->n++] = component;
}

void packing_i_expansion_add(const packing_i_expansion *a, const packing_i_expansion *b,
                             packing_i_expansion *out)
{
  size_t i = 0, j = 0;
  double q = 0;
  out->n = 0;
  while (i < a->n || j < b->n) {
    const int first = j == b->n || (i < a->n && fabs(a->e[i]) < fabs(b->e[j]));
    const packing_i_two s = packing_i_two_sum(q, first ? a->e[i++] : b->e[j++]);
    put(out, s.lo);
    q = s.hi;
  }
  put(out, q);
}

/* out = a * b for one double b. */
static void scale(const packing_i_expansion *a, double b, packing_i_expansion *out)
{
  const packing_i_two b_split = packing_i_two_split(b);
  out->n = 0;
  if (a->n == 0)
    return;
  packing_i_two q = packing_i_two_product_split(a->e[0], b, b_split);
  put(out, q.lo);
  for (size_t i = 1; i < a->n; i++) {
    const packing_i_two p = packing_i_two_product_split(a->e[i], b, b_split);
    const packing_i_two s = packing_i_two_sum(q.hi, p.lo);
    put(out, s.lo);
    q = packing_i_two_sum_sorted(p.hi, s.hi);
    put(out, q.lo);
  }
  put(out, q.hi);
}

/* Sums a * b[k], smallest first. The sum so far and the next one stand in the halves of `spare`
 * that the result leaves free: both together have at most 2 a.n b.n components. */
void packing_i_expansion_multiply(const packing_i_expansion *a,
                                  const packing_i_expansion *b, packing_i_expansion *out,
                                  double *spare)
{
  if (a->n < b->n) {
    const packing_i_expansion *swap = a;
    a = b;
    b = swap;
  }
  out->n = 0;
  for (size_t k = 0; k < b->n; k++) {
    packing_i_expansion so_far = {spare, out->n}, next = {spare + out->n, 0};
    memcpy(spare, out->e, out->n * sizeof *spare);
    scale(a, b->e[k], &next);
    packing_i_expansion_add(&so_far, &next, out);
  }
}
