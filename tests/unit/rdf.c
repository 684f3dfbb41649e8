/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The radial distribution of lattices, whose shells are known. */
#include "test.h"

enum { BINS = 61 };

typedef struct result {
  packing_rdf_bin bins[BINS];
  packing_rdf_report report;
} result;

static result measure(const packing_rdf_def *def, packing_domain *domain,
                      const packing_view *v)
{
  result r;
  packing_rdf_report_init(&r.report);
  assert_ok(packing_measure_rdf(NULL, def, domain, v, r.bins, BINS, &r.report));
  uint64_t pairs = 0;
  for (size_t k = 0; k < r.report.bins && k < BINS; k++)
    pairs += r.bins[k].count;
  if (r.report.bins <= BINS)
    assert_int_equal(pairs, r.report.pairs);
  return r;
}

static packing_rdf_def options(double r_max, size_t bins)
{
  packing_rdf_def def;
  packing_rdf_def_init(&def);
  def.r_max = r_max;
  def.bins = bins;
  def.in_diameters = 0;
  return def;
}

/* The partners of one centre at a distance, all in the shell that holds it. */
static void assert_shell(const result *r, double distance, double partners)
{
  const double width = r->bins[0].hi;
  const size_t k = (size_t)(distance / width);
  assert_true(r->bins[k].lo <= distance && distance < r->bins[k].hi);
  assert_close((double)r->bins[k].count / (double)r->report.centres, partners, 1e-15);
}

/* A cubic cell of one sphere: r_max is three periods and more. */
static void a_cubic_cell_has_the_shells_of_the_lattice(void **state)
{
  (void)state;
  const double x = 0.5, y = 0.25, z = 0.75, radius = 0.5;
  packing_view v;
  packing_domain *cell = test_box(1, 1, 1, 7);
  packing_view_init_arrays(&v, 1, &x, &y, &z, &radius);
  const packing_rdf_def def = options(3.05, BINS);
  const result r = measure(&def, cell, &v);
  const double shells[10] = {0, 6, 12, 8, 6, 24, 24, 0, 12, 30}; /* of distance^2 */
  double sum = 0;
  for (int k = 1; k < 10; k++) {
    if (shells[k] > 0)
      assert_shell(&r, sqrt(k), shells[k]);
    sum += shells[k];
  }
  assert_int_equal(r.report.pairs, (size_t)sum);
  assert_true(r.report.centres == 1 && r.report.partners == 1);
  assert_true(r.report.density == 1 && r.report.mean_d == 1 && r.report.margin == 0);
  assert_true(r.bins[BINS - 1].cumulative == sum && r.bins[BINS - 1].hi == 3.05);
  assert_true(r.bins[19].cumulative == 0 && r.bins[20].cumulative == 6);
  const double shell = 4 * acos(-1) / 3 * (pow(1.05, 3) - 1);
  assert_close(r.bins[20].g, 6 / shell, 1e-12);
  packing_domain_destroy(cell);
}

/* The same in larger cells and in one that is long and thin. */
static void the_cell_does_not_matter(void **state)
{
  (void)state;
  double x[24], y[24], z[24], r[24];
  packing_view v;
  packing_domain *one = test_box(1, 1, 1, 7), *many = test_box(2, 3, 4, 7);
  for (int i = 0; i < 24; i++) {
    x[i] = i % 2;
    y[i] = i / 2 % 3;
    z[i] = i / 6;
    r[i] = 0.5;
  }
  packing_view_init_arrays(&v, 24, x, y, z, r);
  const packing_rdf_def def = options(3.05, BINS);
  const result b = measure(&def, many, &v);
  v.count = 1;
  const result a = measure(&def, one, &v);
  assert_int_equal(b.report.pairs, 24 * a.report.pairs);
  for (int k = 0; k < BINS; k++) {
    assert_int_equal(b.bins[k].count, 24 * a.bins[k].count);
    assert_near(b.bins[k].g, a.bins[k].g, 1e-12);
    assert_true(b.bins[k].cumulative == a.bins[k].cumulative);
  }
  packing_domain_destroy(one);
  packing_domain_destroy(many);
}

static void discs_have_rings(void **state)
{
  (void)state;
  const double x = 0.5, y = 0.25, z = 5, radius = 0.5;
  packing_view v;
  packing_domain *cell = test_rectangle(1, 1, 3);
  packing_view_init_arrays(&v, 1, &x, &y, &z, &radius);
  const packing_rdf_def def = options(3.05, BINS);
  const result r = measure(&def, cell, &v);
  const double rings[10] = {0, 4, 4, 0, 4, 8, 0, 0, 4, 4};
  for (int k = 1; k < 10; k++)
    if (rings[k] > 0)
      assert_shell(&r, sqrt(k), rings[k]);
  assert_int_equal(r.report.pairs, 28);
  assert_close(r.bins[20].g, 4 / (acos(-1) * (1.05 * 1.05 - 1)), 1e-12);
  packing_domain_destroy(cell);
}

/* A cubic block of side^3 spheres that fills a box with walls. */
static size_t block(int side, double *x, double *y, double *z, double *r)
{
  for (int i = 0; i < side * side * side; i++) {
    x[i] = i % side + 0.5;
    y[i] = i / side % side + 0.5;
    z[i] = i / side / side + 0.5;
    r[i] = 0.5;
  }
  return (size_t)(side * side * side);
}

/* Centres are those that see no wall: their shells are whole. */
static void walls_leave_centres_inside(void **state)
{
  (void)state;
  static double x[1000], y[1000], z[1000], radius[1000];
  packing_view v;
  packing_domain *box = test_box(10, 10, 10, 0);
  packing_view_init_arrays(&v, block(10, x, y, z, radius), x, y, z, radius);
  packing_rdf_def def = options(2.55, 51);
  result r = measure(&def, box, &v);
  assert_close(r.report.margin, 3.05, 1e-15);
  assert_int_equal(r.report.centres, 4 * 4 * 4);
  assert_int_equal(r.report.partners, 1000);
  assert_close(r.report.density, 64 / pow(10 - 6.1, 3), 1e-14);
  assert_shell(&r, 1, 6);
  assert_shell(&r, sqrt(2), 12);
  assert_shell(&r, sqrt(6), 24);
  def.margin = 0;
  r = measure(&def, box, &v);
  assert_int_equal(r.report.centres, 1000);
  assert_true(r.report.density == 1);
  assert_shell(&r, 1, 2 * 3 * 9 * 100 / 1000.0);
  packing_domain_destroy(box);
}

/* An open top bounds the centres; the density is that of all that the walls leave. */
static void an_open_top_bounds_the_centres(void **state)
{
  (void)state;
  static double x[1000], y[1000], z[1000], radius[1000];
  packing_view v;
  packing_domain_box_def box;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&box);
  box.size.x = box.size.y = box.size.z = 10;
  box.periodic = PACKING_PERIODIC_X | PACKING_PERIODIC_Y;
  box.open_top = 1;
  assert_ok(packing_domain_create_box(NULL, &box, &domain));
  packing_view_init_arrays(&v, block(10, x, y, z, radius), x, y, z, radius);
  packing_rdf_def def = options(2.55, 51);
  def.margin = 3;
  const result r = measure(&def, domain, &v);
  assert_int_equal(r.report.centres, 10 * 10 * 4);
  assert_true(r.report.density == 1);
  assert_shell(&r, 1, 6);
  assert_shell(&r, sqrt(6), 24);
  packing_domain_destroy(domain);
}

/* Two components that alternate, as ions of salt. */
static void components_are_told_apart(void **state)
{
  (void)state;
  double x[8], y[8], z[8], radius[8];
  int32_t kind[8];
  packing_view v;
  packing_domain *cell = test_box(2, 2, 2, 7);
  packing_view_init_arrays(&v, block(2, x, y, z, radius), x, y, z, radius);
  for (int i = 0; i < 8; i++)
    kind[i] = (i ^ i / 2 ^ i / 4) & 1 ? 7 : -2;
  packing_rdf_def def = options(1.9, 38);
  def.by = PACKING_RDF_TYPE;
  def.centres = 1; /* that of all without a column */
  def.partners = 1;
  assert_int_equal(measure(&def, cell, &v).report.pairs, 8 * 26);
  v.type.data = v.component.data = kind;
  v.type.stride = v.component.stride = sizeof kind[0];
  for (int by = PACKING_RDF_COMPONENT; by <= PACKING_RDF_TYPE; by++) {
    def.by = (packing_rdf_by)by;
    def.centres = 7;
    def.partners = -2;
    result r = measure(&def, cell, &v);
    assert_true(r.report.centres == 4 && r.report.partners == 4);
    assert_true(r.report.density == 0.5);
    assert_shell(&r, 1, 6);
    assert_shell(&r, sqrt(2), 0);
    assert_shell(&r, sqrt(3), 8);
    def.partners = 7;
    r = measure(&def, cell, &v);
    assert_shell(&r, 1, 0);
    assert_shell(&r, sqrt(2), 12);
    def.partners = 1;
    r = measure(&def, cell, &v);
    assert_true(r.report.partners == 0 && isnan(r.bins[5].g) && r.report.pairs == 0);
    assert_true(r.report.peak == PACKING_NO_INDEX);
  }
  packing_domain_destroy(cell);
}

/* By default radii are in mean diameters. */
static void diameters_are_the_unit(void **state)
{
  (void)state;
  double x[8], y[8], z[8], radius[8];
  packing_view v;
  packing_rdf_def def;
  packing_domain *cell = test_box(2, 2, 2, 7);
  packing_view_init_arrays(&v, block(2, x, y, z, radius), x, y, z, radius);
  for (int i = 0; i < 8; i++)
    radius[i] = i % 2 == 0 ? 0.375 : 0.125; /* mean diameter 0.5 */
  packing_rdf_def_init(&def);
  def.r_max = 4.1;
  def.bins = 41;
  const result r = measure(&def, cell, &v);
  assert_true(r.report.mean_d == 0.5 && r.report.density == 1);
  assert_shell(&r, 2, 6);
  assert_shell(&r, 2 * sqrt(2), 12);
  const double shell = 4 * acos(-1) / 3 * (pow(1.05, 3) - 1);
  assert_close(r.bins[20].g, 6 / shell, 1e-12);
  assert_int_equal(r.report.peak, 28);
  packing_domain_destroy(cell);
}

static void nothing_to_measure_is_no_failure(void **state)
{
  (void)state;
  double x[27], y[27], z[27], radius[27];
  packing_view v;
  packing_domain *box = test_box(3, 3, 3, 0), *cell = test_box(3, 3, 3, 7);
  packing_view_init_arrays(&v, block(3, x, y, z, radius), x, y, z, radius);
  packing_rdf_def def = options(2, 10);
  result r = measure(&def, box, &v);
  assert_true(r.report.centres == 0 && isnan(r.report.density));
  assert_true(isnan(r.bins[3].g) && isnan(r.bins[3].cumulative));
  v.count = 0;
  r = measure(&def, cell, &v);
  assert_true(r.report.centres == 0 && r.report.density == 0 && isnan(r.bins[3].g));
  packing_rdf_def_init(&def);
  r = measure(&def, cell, &v);
  assert_true(r.report.centres == 0 && isnan(r.report.mean_d));
  packing_domain_destroy(box);
  packing_domain_destroy(cell);
}

static void as_many_bins_as_there_is_room_for(void **state)
{
  (void)state;
  double x[8], y[8], z[8], radius[8];
  packing_view v;
  packing_rdf_bin bins[4] = {{0}};
  packing_rdf_report report;
  packing_domain *cell = test_box(2, 2, 2, 7);
  packing_view_init_arrays(&v, block(2, x, y, z, radius), x, y, z, radius);
  packing_rdf_def def = options(1.5, 3);
  packing_rdf_report_init(&report);
  assert_ok(packing_measure_rdf(NULL, &def, cell, &v, NULL, 0, &report));
  assert_true(report.bins == 3 && report.pairs == 8 * 18);
  assert_ok(packing_measure_rdf(NULL, &def, cell, &v, bins, 2, &report));
  assert_true(bins[1].lo == 0.5 && bins[2].hi == 0);
  assert_ok(packing_measure_rdf(NULL, &def, cell, &v, bins, 4, &report));
  assert_true(bins[2].lo == 1 && bins[2].hi == 1.5 && bins[3].hi == 0);
  assert_int_equal(bins[2].count, 8 * 18); /* 1 belongs to [1, 1.5) */
  def.bins = 2000000;                      /* more than the lanes hold together */
  assert_ok(packing_measure_rdf(NULL, &def, cell, &v, bins, 1, &report));
  assert_int_equal(report.pairs, 8 * 18);
  packing_domain_destroy(cell);
}

/* The border of two shells belongs to the outer one, the double below it to the inner one, however
 * division rounds (it does both ways with these 49). */
static void borders_belong_to_the_outer_shell(void **state)
{
  (void)state;
  double x[2] = {0}, y[2] = {0}, z[2] = {0}, radius[2] = {0.01, 0.01};
  packing_view v;
  packing_domain *cell = test_box(4, 4, 4, 7);
  packing_view_init_arrays(&v, 2, x, y, z, radius);
  const packing_rdf_def def = options(1, 49);
  for (int k = 1; k < 49; k++)
    for (int below = 0; below < 2; below++) {
      const double border = k * (1.0 / 49);
      x[1] = below ? nextafter(border, 0) : border;
      const result r = measure(&def, cell, &v);
      assert_int_equal(r.report.pairs, 2);
      assert_int_equal(r.bins[k - below].count, 2);
    }
  packing_domain_destroy(cell);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_cubic_cell_has_the_shells_of_the_lattice),
      cmocka_unit_test(the_cell_does_not_matter),
      cmocka_unit_test(discs_have_rings),
      cmocka_unit_test(walls_leave_centres_inside),
      cmocka_unit_test(an_open_top_bounds_the_centres),
      cmocka_unit_test(components_are_told_apart),
      cmocka_unit_test(diameters_are_the_unit),
      cmocka_unit_test(nothing_to_measure_is_no_failure),
      cmocka_unit_test(borders_belong_to_the_outer_shell),
      cmocka_unit_test(as_many_bins_as_there_is_room_for),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
