/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Signs of determinants in three stages: doubles with an error bound, doubles of twice the length
 * with another, exact expansions (exact.c).
 *
 * With u = 2^-53 each operation is off by a factor (1 + d), |d| <= u; nothing overflows or
 * underflows, since coordinates are at most 1 and multiples of 2^-199 (delaunay.c). The permanent
 * sums what the determinant sums, with absolute values. A term of the determinant of differences
 * passes at most 8 roundings (a difference, product and difference of 2x2, product of 3x3, two
 * sums, and the difference and product of the third factor), so |error| <= 9 u permanent: bound
 * 2^-49 = 16 u. A term of side() passes those, 6 of the lift, one product and 3 sums: at most
 * 18 u / (1 - 18 u): bound 2^-48 = 32 u. The computed permanent is off by no more than as many u,
 * which the margins cover. In the second stage an operation is off by at most 2^-103 and a term
 * passes fewer than 20: bound 2^-92. (Shewchuk's stage A, with rounder numbers.) */
#include "delaunay/predicates.h"
#include "delaunay/expansion.h"
#include <math.h>

static const double ORIENT_BOUND = 0x1p-49;
static const double SIDE_BOUND = 0x1p-48;
static const double LONG_SIDE_BOUND = 0x1p-92;

/* A value, and the same with all signs made positive. */
typedef struct sum {
  double value;
  double permanent;
} sum;

static sum minor2(const double a[3], const double b[3])
{
  const double p = a[0] * b[1], q = b[0] * a[1];
  const sum s = {p - q, fabs(p) + fabs(q)};
  return s;
}

static sum minor3(const double a[3], const double b[3], const double c[3])
{
  const sum bc = minor2(b, c), ac = minor2(a, c), ab = minor2(a, b);
  const sum s = {a[2] * bc.value - b[2] * ac.value + c[2] * ab.value,
                 fabs(a[2]) * bc.permanent + fabs(b[2]) * ac.permanent +
                     fabs(c[2]) * ab.permanent};
  return s;
}

static int sign(double v)
{
  return v > 0 ? 1 : -1;
}

static void subtract(const packing_i_delaunay_point *a, const packing_i_delaunay_point *b,
                     double d[3])
{
  for (int k = 0; k < 3; k++)
    d[k] = a->x[k] - b->x[k];
}

int packing_i_delaunay_orient(int dim, const packing_i_delaunay_point *const p[4])
{
  double d[3][3] = {{0}};
  for (int i = 0; i < dim; i++)
    subtract(p[i + 1], p[0], d[i]);
  const sum s = dim == 3 ? minor3(d[0], d[1], d[2]) : minor2(d[0], d[1]);
  if (fabs(s.value) > ORIENT_BOUND * s.permanent)
    return sign(s.value);
  return s.permanent == 0 ? 0 : packing_i_exact_orient(dim, p);
}

/* |d|^2 - r_p^2 + r_q^2. */
static sum lift(const double d[3], const packing_i_delaunay_point *p,
                const packing_i_delaunay_point *q)
{
  const double d2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const double w = (q->r - p->r) * (q->r + p->r);
  const sum s = {d2 + w, d2 + fabs(w)};
  return s;
}

static void add_term(sum *s, double by, const sum *a, const sum *b)
{
  s->value += by * (a->value * b->value);
  s->permanent += a->permanent * b->permanent;
}

static sum side3(const double d[4][3], const sum l[4])
{
  const sum m01 = minor2(d[0], d[1]), m02 = minor2(d[0], d[2]), m03 = minor2(d[0], d[3]),
            m12 = minor2(d[1], d[2]), m13 = minor2(d[1], d[3]), m23 = minor2(d[2], d[3]);
  const double z[4] = {d[0][2], d[1][2], d[2][2], d[3][2]};
  const double a[4] = {fabs(z[0]), fabs(z[1]), fabs(z[2]), fabs(z[3])};
  const sum m[4] = {{z[1] * m23.value - z[2] * m13.value + z[3] * m12.value,
                     a[1] * m23.permanent + a[2] * m13.permanent + a[3] * m12.permanent},
                    {z[0] * m23.value - z[2] * m03.value + z[3] * m02.value,
                     a[0] * m23.permanent + a[2] * m03.permanent + a[3] * m02.permanent},
                    {z[0] * m13.value - z[1] * m03.value + z[3] * m01.value,
                     a[0] * m13.permanent + a[1] * m03.permanent + a[3] * m01.permanent},
                    {z[0] * m12.value - z[1] * m02.value + z[2] * m01.value,
                     a[0] * m12.permanent + a[1] * m02.permanent + a[2] * m01.permanent}};
  sum s = {0, 0};
  for (int i = 0; i < 4; i++)
    add_term(&s, i % 2 == 0 ? 1 : -1, &l[i], &m[i]);
  return s;
}

static sum side2(const double d[4][3], const sum l[4])
{
  const sum m[3] = {minor2(d[1], d[2]), minor2(d[0], d[2]), minor2(d[0], d[1])};
  sum s = {0, 0};
  for (int i = 0; i < 3; i++)
    add_term(&s, i % 2 == 0 ? 1 : -1, &l[i], &m[i]);
  return s;
}

typedef struct long_row {
  packing_i_two x[3];
  packing_i_two lift;
} long_row;

static void long_row_set(long_row *row, const packing_i_delaunay_point *p,
                         const packing_i_delaunay_point *q)
{
  row->lift = packing_i_double_multiply(packing_i_two_sum(q->r, -p->r),
                                        packing_i_two_sum(q->r, p->r));
  for (int k = 0; k < 3; k++) {
    row->x[k] = packing_i_two_sum(p->x[k], -q->x[k]);
    row->lift =
        packing_i_double_add(row->lift, packing_i_double_multiply(row->x[k], row->x[k]));
  }
}

static packing_i_two long_minor2(const long_row *a, const long_row *b)
{
  return packing_i_double_add(
      packing_i_double_multiply(a->x[0], b->x[1]),
      packing_i_double_negate(packing_i_double_multiply(b->x[0], a->x[1])));
}

static packing_i_two long_minor3(const long_row *a, const long_row *b, const long_row *c)
{
  const packing_i_two bc = packing_i_double_multiply(a->x[2], long_minor2(b, c)),
                      ac = packing_i_double_multiply(b->x[2], long_minor2(a, c)),
                      ab = packing_i_double_multiply(c->x[2], long_minor2(a, b));
  return packing_i_double_add(packing_i_double_add(bc, packing_i_double_negate(ac)), ab);
}

static packing_i_two long_side(int dim, const packing_i_delaunay_point *const p[4],
                               const packing_i_delaunay_point *q)
{
  static const int others[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
  long_row row[4] = {{{{0, 0}}, {0, 0}}};
  packing_i_two s = {0, 0};
  for (int i = 0; i <= dim; i++)
    long_row_set(&row[i], p[i], q);
  for (int i = 0; i <= dim; i++) {
    const long_row *a = &row[others[i][0]], *b = &row[others[i][1]],
                   *c = &row[others[i][2] % (dim + 1)];
    const packing_i_two m = dim == 3 ? long_minor3(a, b, c) : long_minor2(a, b);
    const packing_i_two t = packing_i_double_multiply(row[i].lift, m);
    s = packing_i_double_add(s, i % 2 == 0 ? t : packing_i_double_negate(t));
  }
  return s;
}

int packing_i_delaunay_side(const packing_i_exact *exact, int dim,
                            const packing_i_delaunay_point *const p[4],
                            const packing_i_delaunay_point *q)
{
  double d[4][3] = {{0}};
  sum l[4] = {{0, 0}};
  for (int i = 0; i <= dim; i++) {
    subtract(p[i], q, d[i]);
    l[i] = lift(d[i], p[i], q);
  }
  const sum s =
      dim == 3 ? side3((const double(*)[3])d, l) : side2((const double(*)[3])d, l);
  if (fabs(s.value) > SIDE_BOUND * s.permanent)
    return sign(s.value);
  if (s.permanent == 0)
    return 0;
  const packing_i_two t = long_side(dim, p, q);
  if (fabs(t.hi) > LONG_SIDE_BOUND * s.permanent)
    return sign(t.hi);
  return packing_i_exact_side(exact, dim, p, q);
}
