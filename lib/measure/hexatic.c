/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hexatic order of discs: psi = mean over the bonds of exp(i k theta), k = 6 unless asked
 * otherwise (B. I. Halperin, D. R. Nelson, Phys. Rev. Lett. 41, 1978, 121). exp(i k theta) is the
 * k-th power of the bond's direction, so no angle is computed. Linear in the bonds. */
#include "measure/order_internal.h"

enum { FEWEST_FOLD = 2, MOST_FOLD = 12 };

typedef struct part {
  size_t counted;
  size_t isolated;
  size_t exact; /* with as many neighbours as the symmetry has */
  packing_i_sum modulus;
  packing_i_sum re;
  packing_i_sum im;
} part;

typedef struct hexatic {
  const packing_neighbours *neighbours;
  int fold;
  packing_hexatic *local;
  size_t capacity;
  part *parts; /* of each block */
} hexatic;

void packing_hexatic_def_fill(packing_hexatic_def *def, size_t size)
{
  packing_hexatic_def defaults = {0};
  defaults.fold = 6;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static void add_bond(packing_hexatic *sum, packing_vec3 d, int fold)
{
  const double length = sqrt(d.x * d.x + d.y * d.y);
  double re = 1, im = 0;
  if (!(length > 0))
    return;
  const double x = d.x / length, y = d.y / length;
  for (int k = 0; k < fold; k++) {
    const double turned = re * x - im * y;
    im = re * y + im * x;
    re = turned;
  }
  sum->re += re;
  sum->im += im;
}

static packing_hexatic order_around(const hexatic *h, size_t i)
{
  const packing_neighbours *n = h->neighbours;
  packing_hexatic found = {0, 0, 0, n->start[i + 1] - n->start[i]};
  if (found.neighbours == 0)
    return found;
  for (size_t k = n->start[i]; k < n->start[i + 1]; k++)
    add_bond(&found, packing_i_bond_vector(n, i, &n->bonds[k]), h->fold);
  found.re /= (double)found.neighbours;
  found.im /= (double)found.neighbours;
  found.modulus = sqrt(found.re * found.re + found.im * found.im);
  return found;
}

static void measure_block(void *arg, size_t block)
{
  const hexatic *h = arg;
  const size_t end = packing_i_measure_block_end(block, h->neighbours->count);
  part p = {0};
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++) {
    const packing_hexatic found = order_around(h, i);
    if (h->neighbours->index[i] < h->capacity)
      h->local[h->neighbours->index[i]] = found;
    if (!h->neighbours->counts[i])
      continue;
    p.counted++;
    p.isolated += (size_t)(found.neighbours == 0);
    p.exact += (size_t)(found.neighbours == (size_t)h->fold);
    packing_i_sum_add(&p.modulus, found.modulus);
    packing_i_sum_add(&p.re, found.re);
    packing_i_sum_add(&p.im, found.im);
  }
  h->parts[block] = p;
}

/* 0 / 0 is the NaN of what has no mean. */
static void conclude(const hexatic *h, size_t blocks, packing_hexatic_report *report)
{
  packing_i_sum modulus = {0, 0}, re = {0, 0}, im = {0, 0};
  size_t exact = 0;
  for (size_t b = 0; b < blocks; b++) {
    const part *p = &h->parts[b];
    report->counted += p->counted;
    report->isolated += p->isolated;
    exact += p->exact;
    packing_i_sum_add(&modulus, packing_i_sum_value(&p->modulus));
    packing_i_sum_add(&re, packing_i_sum_value(&p->re));
    packing_i_sum_add(&im, packing_i_sum_value(&p->im));
  }
  const double counted = (double)report->counted;
  const double x = packing_i_sum_value(&re) / counted;
  const double y = packing_i_sum_value(&im) / counted;
  report->mean = packing_i_sum_value(&modulus) / counted;
  report->whole = sqrt(x * x + y * y);
  report->share = (double)exact / counted;
}

static packing_status check_arguments(packing_context *context,
                                      const packing_hexatic_def *d,
                                      const packing_neighbours *neighbours,
                                      const packing_hexatic *local, size_t capacity,
                                      const packing_hexatic_report *report)
{
  if (d->fold < FEWEST_FOLD || d->fold > MOST_FOLD)
    return packing_i_fail(context, PACKING_ERR_RANGE, "fold", PACKING_NO_INDEX,
                          "%d, must be %d to %d", d->fold, FEWEST_FOLD, MOST_FOLD);
  PACKING_I_TRY(packing_i_check_given(context, "neighbours", neighbours));
  if (!neighbours->flat)
    return packing_i_fail(
        context, PACKING_ERR_INVALID, "neighbours", PACKING_NO_INDEX,
        "of a pack in three dimensions: hexatic order is that of discs");
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(context, "local", local));
  return packing_i_report_check(context, report);
}

packing_status packing_measure_hexatic(packing_context *context,
                                       const packing_hexatic_def *def,
                                       const packing_neighbours *neighbours,
                                       packing_hexatic *local, size_t capacity,
                                       packing_hexatic_report *report)
{
  packing_hexatic_def d;
  packing_hexatic_report found;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_hexatic, fold, def, &d));
  PACKING_I_TRY(check_arguments(context, &d, neighbours, local, capacity, report));
  hexatic h = {neighbours, d.fold, local, capacity, NULL};
  const size_t blocks = packing_i_measure_blocks(neighbours->count);
  const packing_allocator *allocator = packing_i_allocator(context);
  h.parts = packing_i_alloc(allocator, blocks, sizeof *h.parts);
  if (h.parts == NULL)
    return packing_i_nomem(context);
  packing_i_parallel(context, blocks, measure_block, &h);
  packing_hexatic_report_init(&found);
  conclude(&h, blocks, &found);
  packing_i_free(allocator, h.parts);
  return packing_i_report_write(context, report, &found, sizeof found);
}
