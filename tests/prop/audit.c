/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Audit and coordination against all pairs, over random packs that overlap. */
#include "test.h"

enum { COUNT = 400, RUNS = 60 };

typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
  packing_domain *domain;
  int dim;
} pack;

/* Run k: its dimension, periodic directions, ratio of sizes (1 to 1000) and density differ. */
static void draw(pack *p, unsigned k)
{
  packing_rng *rng = NULL;
  const double ratio = pow(1000, k % 4 / 3.0), edge = 4 + k % 7;
  double *c[3] = {p->x, p->y, p->z};
  assert_ok(packing_rng_create(NULL, k, PACKING_PURPOSE_USER, 0, &rng));
  p->dim = k % 5 == 0 ? 2 : 3;
  p->domain = p->dim == 2 ? test_rectangle(edge, 1.25 * edge, k % 4)
                          : test_box(edge, 1.25 * edge, 0.75 * edge, k % 8);
  for (size_t i = 0; i < COUNT; i++) {
    const double size[3] = {edge, 1.25 * edge, p->dim == 2 ? 0 : 0.75 * edge};
    for (int a = 0; a < 3; a++)
      c[a][i] = size[a] * packing_rng_uniform(rng);
    p->r[i] = 0.6 * pow(ratio, -packing_rng_uniform(rng));
  }
  packing_rng_destroy(rng);
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
}

static double distance(const pack *p, size_t i, size_t j)
{
  const packing_vec3 a = {p->x[i], p->y[i], p->z[i]}, b = {p->x[j], p->y[j], p->z[j]};
  const packing_vec3 s = packing_domain_separation(p->domain, &a, &b);
  return sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
}

/* The same bits: both decide with the distance in double. */
static void audit_agrees_with_all_pairs(void **state)
{
  (void)state;
  pack p;
  for (unsigned k = 0; k < RUNS; k++) {
    packing_audit_def def;
    packing_audit_report report;
    size_t overlaps = 0, most_i = 0, most_j = 0;
    double most = 0;
    draw(&p, k);
    packing_audit_def_init(&def);
    def.limit = 0.125;
    packing_audit_report_init(&report);
    assert_ok(packing_audit(NULL, &def, p.domain, &p.view, &report));
    for (size_t i = 0; i < COUNT; i++)
      for (size_t j = i + 1; j < COUNT; j++) {
        const double overlap =
            (p.r[i] + p.r[j] - distance(&p, i, j)) / fmin(p.r[i], p.r[j]);
        overlaps += (size_t)(overlap > 0.125);
        if (overlap > most) {
          most = overlap;
          most_i = i;
          most_j = j;
        }
      }
    assert_true(overlaps > 0 && report.overlaps == overlaps);
    assert_true(report.max_overlap == most);
    assert_true(report.max_overlap == test_brute_overlap(p.domain, &p.view));
    assert_true(report.overlap_i == most_i && report.overlap_j == most_j);
    packing_domain_destroy(p.domain);
  }
}

static void protrusion_agrees_with_the_container(void **state)
{
  (void)state;
  pack p;
  for (unsigned k = 0; k < RUNS; k++) {
    packing_audit_report report;
    double most = 0;
    size_t at = PACKING_NO_INDEX, count = 0;
    draw(&p, k);
    packing_audit_report_init(&report);
    assert_ok(packing_audit(NULL, NULL, p.domain, &p.view, &report));
    for (size_t i = 0; i < COUNT; i++) {
      const packing_vec3 c = {p.x[i], p.y[i], p.z[i]};
      const double protrusion =
          (p.r[i] - packing_domain_signed_distance(p.domain, &c, NULL)) / p.r[i];
      count += (size_t)(protrusion > 1e-9);
      if (protrusion > most) {
        most = protrusion;
        at = i;
      }
    }
    assert_true(report.protrusions == count && report.max_protrusion == most &&
                report.protrusion_i == at);
    packing_domain_destroy(p.domain);
  }
}

/* Takes rattlers out by looking at everyone again and again. */
static size_t slow_rattlers(const pack *p, double tolerance, size_t *contacts_left)
{
  static char touch[COUNT][COUNT];
  char gone[COUNT] = {0};
  size_t removed = 0;
  for (size_t i = 0; i < COUNT; i++)
    for (size_t j = 0; j < COUNT; j++)
      touch[i][j] = i != j && distance(p, i, j) - (p->r[i] + p->r[j]) <=
                                  tolerance * (p->r[i] + p->r[j]);
  for (int again = 1; again;) {
    again = 0;
    *contacts_left = 0;
    for (size_t i = 0; i < COUNT; i++) {
      int degree = 0;
      for (size_t j = 0; j < COUNT && !gone[i]; j++)
        degree += touch[i][j] && !gone[j];
      *contacts_left += (size_t)degree;
      if (!gone[i] && degree < p->dim + 1) {
        gone[i] = 1;
        removed++;
        again = 1;
      }
    }
  }
  return removed;
}

static void rattlers_agree_with_the_slow_way(void **state)
{
  (void)state;
  pack p;
  size_t some = 0;
  for (unsigned k = 0; k < RUNS; k++) {
    packing_coordination_def def;
    packing_coordination_report report;
    size_t left = 0;
    draw(&p, k);
    packing_coordination_def_init(&def);
    def.tolerance = 0.05 * (k % 3);
    def.dim = p.dim;
    packing_coordination_report_init(&report);
    assert_ok(packing_measure_coordination(NULL, &def, p.domain, &p.view, &report));
    const size_t removed = slow_rattlers(&p, def.tolerance, &left);
    assert_int_equal(report.rattlers, removed);
    if (removed < COUNT) {
      assert_close(report.mean_no_rattlers, (double)left / (double)(COUNT - removed),
                   1e-15);
      some++;
    } else {
      assert_true(isnan(report.mean_no_rattlers));
    }
    packing_domain_destroy(p.domain);
  }
  assert_true(some > RUNS / 4 && some < RUNS);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(audit_agrees_with_all_pairs),
      cmocka_unit_test(protrusion_agrees_with_the_container),
      cmocka_unit_test(rattlers_agree_with_the_slow_way),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
