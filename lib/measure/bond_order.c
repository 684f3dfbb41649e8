/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bond order: q_l and w_l of each particle's bonds, and of all bonds together.
 *
 * P. J. Steinhardt, D. R. Nelson, M. Ronchetti, Phys. Rev. B 28 (1983) 784, equations 1.3 to 1.6;
 * averaged over a particle and its neighbours: W. Lechner, C. Dellago, J. Chem. Phys. 129 (2008)
 * 114707, equations 5 and 6. The harmonics of a bond are polynomials of its direction, so no angle is
 * computed. Two rounds: q_lm of each particle, then what needs those of its neighbours. Linear in
 * the bonds, (l + 1)(l + 2) / 2 multiplications each. */
#include "measure/order_internal.h"

/* Sums over the counted particles of one block. */
typedef struct part {
  size_t counted;
  size_t isolated;
  size_t bonds;
  packing_i_sum q;
  packing_i_sum averaged;
  packing_i_sum w;
  packing_i_sum re[PACKING_I_ORDER_L + 1]; /* of all bonds */
  packing_i_sum im[PACKING_I_ORDER_L + 1];
} part;

typedef struct order {
  const packing_neighbours *neighbours;
  packing_i_harmonics harmonics;
  packing_i_wigner wigner;
  double *moments; /* q_lm of each particle: l + 1 real and l + 1 imaginary parts */
  packing_bond_order *local;
  size_t capacity;
  part *parts; /* of each block */
} order;

void packing_bond_order_def_fill(packing_bond_order_def *def, size_t size)
{
  packing_bond_order_def defaults = {0};
  defaults.l = 6;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static size_t degree(const packing_neighbours *n, size_t i)
{
  return n->start[i + 1] - n->start[i];
}

static double *moments_of(const order *o, size_t i)
{
  return o->moments + i * 2 * (size_t)(o->harmonics.l + 1);
}

static void add_moments(const order *o, size_t i, packing_i_moments *sum)
{
  const double *from = moments_of(o, i);
  const int l = o->harmonics.l;
  for (int m = 0; m <= l; m++) {
    sum->re[m] += from[m];
    sum->im[m] += from[l + 1 + m];
  }
}

static void divide(packing_i_moments *c, int l, double by)
{
  for (int m = 0; m <= l; m++) {
    c->re[m] /= by;
    c->im[m] /= by;
  }
}

static void mean_of_bonds(const order *o, size_t i)
{
  const packing_neighbours *n = o->neighbours;
  const int l = o->harmonics.l;
  packing_i_moments q = {{0}, {0}};
  double *to = moments_of(o, i);
  for (size_t k = n->start[i]; k < n->start[i + 1]; k++)
    packing_i_harmonics_add(&o->harmonics, packing_i_bond_vector(n, i, &n->bonds[k]), &q);
  if (degree(n, i) > 0)
    divide(&q, l, (double)degree(n, i));
  memcpy(to, q.re, (size_t)(l + 1) * sizeof *to);
  memcpy(to + l + 1, q.im, (size_t)(l + 1) * sizeof *to);
}

static void fill_moments(void *arg, size_t block)
{
  const order *o = arg;
  const size_t end = packing_i_measure_block_end(block, o->neighbours->count);
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++)
    mean_of_bonds(o, i);
}

static double averaged_order(const order *o, size_t i)
{
  const packing_neighbours *n = o->neighbours;
  const int l = o->harmonics.l;
  packing_i_moments q = {{0}, {0}};
  add_moments(o, i, &q);
  for (size_t k = n->start[i]; k < n->start[i + 1]; k++)
    add_moments(o, n->bonds[k].j, &q);
  divide(&q, l, 1.0 + (double)degree(n, i));
  return sqrt(packing_i_harmonics_square(l, &q));
}

static packing_bond_order order_around(const order *o, size_t i)
{
  packing_bond_order found = {0, 0, 0};
  packing_i_moments q = {{0}, {0}};
  if (degree(o->neighbours, i) == 0)
    return found;
  add_moments(o, i, &q);
  found.q = sqrt(packing_i_harmonics_square(o->harmonics.l, &q));
  found.averaged = averaged_order(o, i);
  found.w = packing_i_wigner_sum(&o->wigner, o->harmonics.l, &q);
  return found;
}

static void add_to_part(part *p, const order *o, size_t i, const packing_bond_order *b)
{
  const size_t bonds = degree(o->neighbours, i);
  const double *q = moments_of(o, i);
  p->counted++;
  p->isolated += (size_t)(bonds == 0);
  p->bonds += bonds;
  packing_i_sum_add(&p->q, b->q);
  packing_i_sum_add(&p->averaged, b->averaged);
  packing_i_sum_add(&p->w, b->w);
  for (int m = 0; m <= o->harmonics.l; m++) {
    packing_i_sum_add(&p->re[m], (double)bonds * q[m]);
    packing_i_sum_add(&p->im[m], (double)bonds * q[o->harmonics.l + 1 + m]);
  }
}

static void measure_block(void *arg, size_t block)
{
  const order *o = arg;
  const size_t end = packing_i_measure_block_end(block, o->neighbours->count);
  part *p = &o->parts[block];
  memset(p, 0, sizeof *p);
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++) {
    const packing_bond_order found = order_around(o, i);
    if (o->neighbours->index[i] < o->capacity)
      o->local[o->neighbours->index[i]] = found;
    if (o->neighbours->counts[i])
      add_to_part(p, o, i, &found);
  }
}

static void merge(packing_i_sum *to, const packing_i_sum *from)
{
  packing_i_sum_add(to, packing_i_sum_value(from));
}

static void merge_parts(const order *o, size_t blocks, part *all)
{
  memset(all, 0, sizeof *all);
  for (size_t b = 0; b < blocks; b++) {
    const part *p = &o->parts[b];
    all->counted += p->counted;
    all->isolated += p->isolated;
    all->bonds += p->bonds;
    merge(&all->q, &p->q);
    merge(&all->averaged, &p->averaged);
    merge(&all->w, &p->w);
    for (int m = 0; m <= o->harmonics.l; m++) {
      merge(&all->re[m], &p->re[m]);
      merge(&all->im[m], &p->im[m]);
    }
  }
}

/* 0 / 0 is the NaN of what has no mean. */
static void conclude(const order *o, const part *all, packing_bond_order_report *report)
{
  const int l = o->harmonics.l;
  const double counted = (double)all->counted;
  packing_i_moments q = {{0}, {0}};
  for (int m = 0; m <= l; m++) {
    q.re[m] = packing_i_sum_value(&all->re[m]);
    q.im[m] = packing_i_sum_value(&all->im[m]);
  }
  divide(&q, l, (double)all->bonds);
  report->counted = all->counted;
  report->isolated = all->isolated;
  report->bonds = all->bonds;
  report->mean = packing_i_sum_value(&all->q) / counted;
  report->mean_averaged = packing_i_sum_value(&all->averaged) / counted;
  report->mean_w = packing_i_sum_value(&all->w) / (double)(all->counted - all->isolated);
  report->whole = sqrt(packing_i_harmonics_square(l, &q));
  report->whole_w =
      all->bonds == 0 ? (double)NAN : packing_i_wigner_sum(&o->wigner, l, &q);
}

static packing_status measure(packing_context *context, order *o,
                              packing_bond_order_report *report)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t count = o->neighbours->count, blocks = packing_i_measure_blocks(count);
  packing_status status = PACKING_OK;
  part all;
  o->parts = packing_i_alloc(allocator, blocks, sizeof *o->parts);
  o->moments = packing_i_alloc(allocator, count,
                               2 * (size_t)(o->harmonics.l + 1) * sizeof *o->moments);
  if (o->parts == NULL || o->moments == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  packing_i_parallel(context, blocks, fill_moments, o);
  packing_i_parallel(context, blocks, measure_block, o);
  merge_parts(o, blocks, &all);
  conclude(o, &all, report);
out:
  packing_i_free(allocator, o->parts);
  packing_i_free(allocator, o->moments);
  return status;
}

static packing_status check_arguments(packing_context *context,
                                      const packing_bond_order_def *d,
                                      const packing_neighbours *neighbours,
                                      const packing_bond_order *local, size_t capacity,
                                      const packing_bond_order_report *report)
{
  if (d->l < 2 || d->l > PACKING_I_ORDER_L || d->l % 2 != 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "l", PACKING_NO_INDEX,
                          "%d, must be even, 2 to %d", d->l, PACKING_I_ORDER_L);
  PACKING_I_TRY(packing_i_check_given(context, "neighbours", neighbours));
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(context, "local", local));
  return packing_i_report_check(context, report);
}

packing_status packing_measure_bond_order(packing_context *context,
                                          const packing_bond_order_def *def,
                                          const packing_neighbours *neighbours,
                                          packing_bond_order *local, size_t capacity,
                                          packing_bond_order_report *report)
{
  packing_bond_order_def d;
  packing_bond_order_report found;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_bond_order, l, def, &d));
  PACKING_I_TRY(check_arguments(context, &d, neighbours, local, capacity, report));
  order o = {0};
  o.neighbours = neighbours;
  o.local = local;
  o.capacity = capacity;
  packing_i_harmonics_init(&o.harmonics, d.l);
  packing_i_wigner_init(&o.wigner, d.l);
  packing_bond_order_report_init(&found);
  PACKING_I_TRY(measure(context, &o, &found));
  return packing_i_report_write(context, report, &found, sizeof found);
}
