/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The predicates by expansions: differences of coordinates are sums of two doubles, and everything
 * follows without an error. Lengths: 2x2 minors 16, 3x3 minors 192, a lift 28, a product of both
 * 10752, the sum of four 43008; zeros are left out, so lattices need a few components only. */
#include "delaunay/expansion.h"
#include "delaunay/predicates.h"

enum {
  MINOR2 = 16,
  MINOR3 = 192,
  LIFT = 28,
  PRODUCT = 2 * MINOR3 * LIFT,
  SUM = 4 * PRODUCT,
  ROOM = 2 * SUM + 2 * PRODUCT
};

typedef struct row {
  packing_i_expansion x[3];
  double room[3][2];
} row;

typedef struct minor {
  packing_i_expansion e;
  double room[MINOR3];
} minor;

packing_status packing_i_exact_create(packing_context *context, packing_i_exact *exact)
{
  exact->room = packing_i_alloc(packing_i_allocator(context), ROOM, sizeof *exact->room);
  return exact->room == NULL ? packing_i_nomem(context) : PACKING_OK;
}

static void subtract(row *d, const packing_i_delaunay_point *a,
                     const packing_i_delaunay_point *b)
{
  for (int k = 0; k < 3; k++) {
    d->x[k].e = d->room[k];
    packing_i_expansion_set(&d->x[k], packing_i_two_sum(a->x[k], -b->x[k]));
  }
}

/* out = a x - b y or, in general, p + sign * q for two products. */
static void minor2(const row *a, const row *b, packing_i_expansion *out)
{
  double p_room[MINOR2 / 2], q_room[MINOR2 / 2], spare[MINOR2 / 2];
  packing_i_expansion p = {p_room, 0}, q = {q_room, 0};
  packing_i_expansion_multiply(&a->x[0], &b->x[1], &p, spare);
  packing_i_expansion_multiply(&b->x[0], &a->x[1], &q, spare);
  packing_i_expansion_negate(&q);
  packing_i_expansion_add(&p, &q, out);
}

static void minor3(const row *const r[3], packing_i_expansion *out)
{
  double m_room[MINOR2], t_room[4 * MINOR2], spare[4 * MINOR2], sum_room[MINOR3];
  packing_i_expansion sum = {sum_room, 0};
  out->n = 0;
  for (int i = 0; i < 3; i++) {
    packing_i_expansion m = {m_room, 0}, t = {t_room, 0};
    minor2(r[i == 0 ? 1 : 0], r[i == 2 ? 1 : 2], &m);
    packing_i_expansion_multiply(&m, &r[i]->x[2], &t, spare);
    if (i == 1)
      packing_i_expansion_negate(&t);
    sum.n = out->n;
    for (size_t k = 0; k < out->n; k++)
      sum.e[k] = out->e[k];
    packing_i_expansion_add(&sum, &t, out);
  }
}

int packing_i_exact_orient(int dim, const packing_i_delaunay_point *const p[4])
{
  row d[3];
  minor m;
  m.e.e = m.room;
  for (int i = 0; i < dim; i++)
    subtract(&d[i], p[i + 1], p[0]);
  if (dim == 3) {
    const row *const r[3] = {&d[0], &d[1], &d[2]};
    minor3(r, &m.e);
  } else {
    minor2(&d[0], &d[1], &m.e);
  }
  return packing_i_expansion_sign(&m.e);
}

/* out = a + by * b^2, where b has at most 2 components. */
static void add_square(const packing_i_expansion *a, const packing_i_expansion *b, int by,
                       packing_i_expansion *out)
{
  double room[8], spare[8];
  packing_i_expansion square = {room, 0};
  packing_i_expansion_multiply(b, b, &square, spare);
  if (by < 0)
    packing_i_expansion_negate(&square);
  packing_i_expansion_add(a, &square, out);
}

/* |d|^2 + r_q^2 - r_p^2. */
static void lift(const row *d, const packing_i_delaunay_point *p,
                 const packing_i_delaunay_point *q, packing_i_expansion *out)
{
  double room[2][LIFT], r[2] = {q->r, p->r};
  packing_i_expansion s[2] = {{room[0], 0}, {room[1], 0}};
  packing_i_expansion q_r = {&r[0], r[0] != 0}, p_r = {&r[1], r[1] != 0};
  add_square(&s[1], &d->x[0], 1, &s[0]);
  add_square(&s[0], &d->x[1], 1, &s[1]);
  add_square(&s[1], &d->x[2], 1, &s[0]);
  add_square(&s[0], &q_r, 1, &s[1]);
  add_square(&s[1], &p_r, -1, out);
}

int packing_i_exact_side(const packing_i_exact *exact, int dim,
                         const packing_i_delaunay_point *const p[4],
                         const packing_i_delaunay_point *q)
{
  row d[4];
  minor m;
  double lift_room[LIFT];
  packing_i_expansion sum[2] = {{exact->room, 0}, {exact->room + SUM, 0}};
  packing_i_expansion term = {exact->room + 2 * (size_t)SUM, 0}, l = {lift_room, 0};
  m.e.e = m.room;
  for (int i = 0; i <= dim; i++)
    subtract(&d[i], p[i], q);
  for (int i = 0; i <= dim; i++) {
    const row *r[3] = {NULL, NULL, NULL};
    for (int k = 0, n = 0; k <= dim; k++)
      if (k != i)
        r[n++] = &d[k];
    if (dim == 3)
      minor3(r, &m.e);
    else
      minor2(r[0], r[1], &m.e);
    lift(&d[i], p[i], q, &l);
    packing_i_expansion_multiply(&m.e, &l, &term, term.e + PRODUCT);
    if (i % 2 == 1)
      packing_i_expansion_negate(&term);
    packing_i_expansion_add(&sum[i % 2], &term, &sum[(i + 1) % 2]);
  }
  return packing_i_expansion_sign(&sum[(dim + 1) % 2]);
}
