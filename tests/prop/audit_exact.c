/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The audit against extended precision: overlaps and gaps of a unit in the last place, and packs
 * in which nothing touches. */
#include "test.h"
#include <float.h>

enum { COUNT = 150, RUNS = 60 };

typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
  packing_domain *domain;
} pack;

typedef struct twin {
  long double gap; /* smallest, relative to the smaller radius */
  size_t i, j;
  size_t sure;   /* overlap by more than the limit, whatever rounding does */
  size_t unsure; /* within rounding of the limit */
} twin;

static packing_audit_report audit(packing_domain *domain, const packing_view *view,
                                  double limit)
{
  packing_audit_def def;
  packing_audit_report r;
  packing_audit_def_init(&def);
  def.limit = limit;
  packing_audit_report_init(&r);
  assert_ok(packing_audit(NULL, &def, domain, view, &r));
  return r;
}

static long double nearest(long double d, long double period)
{
  return d - period * roundl(d / period);
}

/* What rounding may change in (d - r_i - r_j) / min(r_i, r_j): three roundings of the square's
 * terms, half of them after the root, and those of the differences. */
static long double rounding(long double sum, long double least, long double extent)
{
  return (4 * sum + extent) * DBL_EPSILON / least;
}

static void judge(const pack *p, const double *edge, unsigned periodic, double limit,
                  twin *t)
{
  for (size_t i = 0; i < COUNT; i++)
    for (size_t j = i + 1; j < COUNT; j++) {
      long double d[3] = {(long double)p->x[j] - p->x[i], (long double)p->y[j] - p->y[i],
                          (long double)p->z[j] - p->z[i]};
      for (int a = 0; a < 3; a++)
        if (periodic & 1U << a)
          d[a] = nearest(d[a], edge[a]);
      const long double sum = (long double)p->r[i] + p->r[j],
                        least = fmin(p->r[i], p->r[j]),
                        gap = (sqrtl(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - sum) /
                              least,
                        error = rounding(sum, least, edge[0] + edge[1] + edge[2]);
      if (gap < t->gap) {
        t->gap = gap;
        t->i = i;
        t->j = j;
      }
      t->sure += (size_t)(-gap > limit + error);
      t->unsure += (size_t)(fabsl(-gap - limit) <= error);
    }
}

/* Run k: periodic directions, sizes and density differ; from packed (every sphere overlaps) to
 * lone (the closest ten thousand radii apart). */
static void draw(pack *p, unsigned k, double *edge)
{
  packing_rng *rng = NULL;
  double *c[3] = {p->x, p->y, p->z};
  const double ratio = pow(100, k % 3 / 2.0), size = pow(10, -(double)(k % 6));
  assert_ok(packing_rng_create(NULL, k, PACKING_PURPOSE_USER, 0, &rng));
  for (int a = 0; a < 3; a++)
    edge[a] = 4 + packing_rng_uniform(rng);
  for (size_t i = 0; i < COUNT; i++) {
    for (int a = 0; a < 3; a++)
      c[a][i] = edge[a] * packing_rng_uniform(rng);
    p->r[i] = 0.6 * size * pow(ratio, -packing_rng_uniform(rng));
  }
  packing_rng_destroy(rng);
  p->domain = test_box(edge[0], edge[1], edge[2], k % 8);
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
}

static void overlaps_and_gaps_agree_to_rounding(void **state)
{
  (void)state;
  size_t apart = 0, far = 0;
  for (unsigned k = 0; k < RUNS; k++) {
    pack p;
    double edge[3];
    twin t = {HUGE_VALL, 0, 0, 0, 0};
    draw(&p, k, edge);
    const packing_audit_report r = audit(p.domain, &p.view, 0.125);
    judge(&p, edge, k % 8, 0.125, &t);
    const long double sum = (long double)p.r[t.i] + p.r[t.j],
                      least = fmin(p.r[t.i], p.r[t.j]);
    assert_near(
        r.min_gap, (double)t.gap,
        (double)rounding(sum + fabsl(t.gap) * least, least, edge[0] + edge[1] + edge[2]));
    assert_true(r.gap_i == t.i && r.gap_j == t.j);
    assert_true(r.max_overlap == fmax(0, 0 - r.min_gap));
    assert_true(r.overlap_i == (r.min_gap < 0 ? r.gap_i : PACKING_NO_INDEX));
    assert_in_range(r.overlaps, t.sure, t.sure + t.unsure);
    apart += (size_t)(r.min_gap > 0);
    far += (size_t)(r.min_gap > 100);
    packing_domain_destroy(p.domain);
  }
  assert_true(apart > RUNS / 4 && apart < RUNS && far > 4);
}

/* Pythagorean quadruples: distances exact in double, of every length; radii that touch exactly,
 * or miss it by a unit in the last place. */
static void a_unit_in_the_last_place_decides(void **state)
{
  (void)state;
  static const double d[][4] = {
      {3, 4, 0, 5},  {1, 2, 2, 3},  {2, 3, 6, 7},   {1, 4, 8, 9}, {4, 4, 7, 9},
      {2, 6, 9, 11}, {6, 6, 7, 11}, {8, 9, 12, 17}, {0, 0, 1, 1}, {12, 15, 16, 25}};
  for (size_t k = 0; k < sizeof d / sizeof d[0]; k++)
    for (int e = -30; e <= 30; e += 15) {
      const double length = ldexp(d[k][3], e), r = ldexp(0.375 * d[k][3], e);
      double x[2] = {0, ldexp(d[k][0], e)}, y[2] = {0, ldexp(-d[k][1], e)},
             z[2] = {0, ldexp(d[k][2], e)}, radius[2] = {r, length - r};
      packing_view v;
      packing_view_init_arrays(&v, 2, x, y, z, radius);
      packing_audit_report a = audit(NULL, &v, 0);
      assert_true(a.passed == 1 && a.min_gap == 0 && a.max_overlap == 0);
      assert_true(a.overlap_i == PACKING_NO_INDEX && a.gap_i == 0 && a.gap_j == 1);
      radius[1] =
          nextafter(length - r, HUGE_VAL); /* 0.625 d: its steps fit into the sum's */
      const double sum = r + radius[1];
      a = audit(NULL, &v, 0);
      assert_true(a.max_overlap == (sum - length) / r && a.min_gap == 0 - a.max_overlap);
      assert_int_equal(a.passed, sum == length);
      radius[1] = nextafter(length - r, 0);
      a = audit(NULL, &v, 0);
      assert_true(a.passed == 1 && a.min_gap == (length - (r + radius[1])) / r);
      radius[1] = length - r + 2 * (nextafter(length, HUGE_VAL) - length);
      a = audit(NULL, &v, 0);
      assert_true(a.passed == 0 && a.overlaps == 1 && a.overlap_i == 0);
      assert_true(a.max_overlap == 2 * (nextafter(length, HUGE_VAL) - length) / r);
      a = audit(NULL, &v, a.max_overlap);
      assert_true(a.passed == 1 && a.overlaps == 0);
    }
}

static void a_gap_to_an_own_image_counts(void **state)
{
  (void)state;
  double x[2] = {0.5, 3}, y[2] = {1, 1}, z[2] = {1, 1}, r[2] = {0.25, 0.5};
  packing_view v;
  packing_domain *cell = test_box(7, 1.125, 40, 7);
  packing_view_init_arrays(&v, 2, x, y, z, r);
  packing_audit_report a = audit(cell, &v, 0);
  assert_true(a.min_gap == 0.25 && a.gap_i == 1 && a.gap_j == 1 && a.passed == 1);
  v.count = 1;
  a = audit(cell, &v, 0);
  assert_true(a.min_gap == 2.5 && a.gap_i == 0 && a.gap_j == 0);
  a = audit(NULL, &v, 0);
  assert_true(isinf(a.min_gap) && a.gap_i == PACKING_NO_INDEX);
  v.count = 0;
  a = audit(cell, &v, 0);
  assert_true(isinf(a.min_gap) && a.gap_j == PACKING_NO_INDEX);
  packing_domain_destroy(cell);
}

/* Two spheres at the ends of the world. */
static void the_farthest_gap_is_found(void **state)
{
  (void)state;
  double x[2] = {-1e140, 1e140}, y[2] = {0, 0}, z[2] = {0, 0}, r[2] = {1e-100, 2};
  packing_view v;
  packing_view_init_arrays(&v, 2, x, y, z, r);
  const packing_audit_report a = audit(NULL, &v, 0);
  assert_close(a.min_gap, 2e240, 1e-14);
  assert_true(a.passed == 1 && a.gap_i == 0 && a.gap_j == 1);
}

/* Of equal gaps the lowest pair. */
static void of_equal_gaps_the_lowest_pair_is_named(void **state)
{
  (void)state;
  double x[6], y[6] = {0}, z[6] = {0}, r[6];
  packing_view v;
  for (int i = 0; i < 6; i++) {
    x[i] = 5 - i; /* numbered backwards */
    r[i] = 0.4375;
  }
  packing_view_init_arrays(&v, 6, x, y, z, r);
  const packing_audit_report a = audit(NULL, &v, 0);
  assert_true(a.min_gap == 0.125 / 0.4375 && a.gap_i == 0 && a.gap_j == 1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(overlaps_and_gaps_agree_to_rounding),
      cmocka_unit_test(a_unit_in_the_last_place_decides),
      cmocka_unit_test(a_gap_to_an_own_image_counts),
      cmocka_unit_test(the_farthest_gap_is_found),
      cmocka_unit_test(of_equal_gaps_the_lowest_pair_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
