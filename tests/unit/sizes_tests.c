/* SPDX-License-Identifier: GPL-3.0-or-later */
/* p-values of Kolmogorov-Smirnov and chi-square, and mixtures component by component. */
#include "psds.h"

enum { N = 2000 };

static double kolmogorov_p(size_t count, double distance)
{
  double p = -1;
  assert_ok(packing_kolmogorov_p(NULL, count, distance, &p));
  return p;
}

static packing_view view_of(const double *r, size_t count)
{
  packing_view v;
  packing_view_init_arrays(&v, count, r, r, r, r);
  return v;
}

static packing_size_tests_report test_sizes(packing_psd *psd, const double *r,
                                            size_t count, size_t bins)
{
  const packing_view v = view_of(r, count);
  packing_size_tests_def def;
  packing_size_tests_report report;
  packing_size_tests_def_init(&def);
  packing_size_tests_report_init(&report);
  def.bins = bins;
  assert_ok(packing_measure_size_tests(NULL, &def, psd, &v, &report));
  return report;
}

/* n = 10 is the example of Marsaglia, Tsang and Wang (1 - .7294644252); the others were computed
 * with 60 digits from the same matrix. */
static void kolmogorov_gives_published_values(void **state)
{
  (void)state;
  assert_near(kolmogorov_p(10, 0.3), 0.270535574800, 1e-12);
  assert_near(kolmogorov_p(100, 0.12), 0.103303749018, 1e-12);
  assert_near(kolmogorov_p(1000, 0.04), 0.079339554975, 1e-12);
}

/* Closed forms: 2 (1 - d)^n from 1 - 1/n on, 1 - n! (2 d - 1/n)^n for 1/2 <= n d <= 1. */
static void kolmogorov_has_closed_forms_at_both_ends(void **state)
{
  (void)state;
  for (size_t n = 1; n <= 60; n++) {
    const double count = (double)n;
    double factorial = 1;
    for (size_t i = 2; i <= n; i++)
      factorial *= (double)i;
    for (double f = 0; f <= 1; f += 0.125) {
      const double high = 1 - f / count, low = (0.5 + 0.5 * f) / count;
      if (high >= 0.5)
        assert_near(kolmogorov_p(n, high), 2 * pow(f / count, count), 1e-15);
      const double near = 1 - factorial * pow(2 * low - 1 / count, count);
      assert_near(kolmogorov_p(n, low), near, 1e-14);
    }
    assert_true(kolmogorov_p(n, 0) == 1 && kolmogorov_p(n, 1) == 0);
  }
}

/* Between the ways of computing p there is no step: over each border p falls by what its slope
 * says, and it falls throughout. */
static void kolmogorov_falls_without_steps(void **state)
{
  (void)state;
  const size_t counts[] = {7, 40, 500, 5000, 5001, 100000, 1000001};
  for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
    const double root = sqrt((double)counts[c]);
    double before = 1;
    const int step = counts[c] > 1000 ? 10 : 1; /* the matrix takes its time */
    for (int k = 1; k <= 60; k += step) {
      const double p = kolmogorov_p(counts[c], fmin(0.05 * k / root, 1));
      assert_true(p <= before + 1e-12 && p >= 0);
      before = p;
    }
    const double d = sqrt(6 / (double)counts[c]);
    if (d < 1 && counts[c] <= 500)
      assert_close(kolmogorov_p(counts[c], d * (1 - 1e-6)),
                   kolmogorov_p(counts[c], d * (1 + 1e-6)), 3e-4);
  }
  for (double z = 0.3; z < 1.6; z += 0.4) /* p moves by (p_n+1 - p_n) = O(n^-3/2) */
    assert_near(kolmogorov_p(5000, z / sqrt(5000)), kolmogorov_p(5001, z / sqrt(5001)),
                2e-6);
}

/* The limit law: K(1) of Smirnov's table, .730000. */
static void kolmogorov_has_its_limit(void **state)
{
  (void)state;
  double sum = 0;
  for (int k = 1; k < 20; k++)
    sum += (k % 2 ? 2 : -2) * exp(-2.0 * k * k);
  assert_near(sum, 0.27, 5e-7);
  assert_near(kolmogorov_p((size_t)1 << 60, ldexp(1, -30)), sum, 1e-8);
  const double far = kolmogorov_p((size_t)1 << 60, 3 * ldexp(1, -30));
  assert_close(far, 2 * exp(-18), 1e-8);
}

static void tests_find_distance_and_bins(void **state)
{
  (void)state;
  double r[N];
  packing_psd *psd = test_uniform(1, 2);
  for (int i = 0; i < N; i++)
    r[i] = 1 + (i + 0.5) / N;
  packing_size_tests_report t = test_sizes(psd, r, N, 10);
  assert_int_equal(t.count, N);
  assert_close(t.ks, 0.5 / N, 1e-9);
  assert_near(t.ks_p, 1, 1e-12);
  assert_int_equal(t.bins, 10);
  assert_near(t.chi_square, 0, 1e-20);
  assert_near(t.chi_square_p, 1, 1e-12);
  /* 20 of the 200 of the first bin move to the last: 2 * 20^2 / 200 = 4 */
  for (int i = 0; i < 20; i++)
    r[i] = 1.95;
  t = test_sizes(psd, r, N, 10);
  assert_close(t.chi_square, 4.0, 1e-9);
  assert_near(t.chi_square_p, 0.9114125, 1e-7); /* tables: Q(4.5, 2) */
  assert_close(t.ks_p, kolmogorov_p(N, t.ks), 1e-15);
  t = test_sizes(psd, r, N, 2);
  assert_close(t.chi_square, 2 * 20.0 * 20 / 1000, 1e-9);
  assert_near(t.chi_square_p, erfc(sqrt(0.4)), 1e-12); /* one degree of freedom */
  packing_psd_destroy(psd);
}

static void bins_follow_the_number_of_particles(void **state)
{
  (void)state;
  static double r[100000];
  const size_t counts[] = {1, 2, 9, 10, 32, 1000, 100000};
  const size_t bins[] = {2, 2, 2, 2, 6, 31, 200};
  packing_psd *psd = test_uniform(1, 2);
  for (size_t i = 0; i < 100000; i++)
    r[i] = 1 + (double)i / 1e5;
  for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++)
    assert_int_equal(test_sizes(psd, r, counts[c], 0).bins, bins[c]);
  assert_int_equal(test_sizes(psd, r, 100, 10000).bins, 10000);
  packing_psd_destroy(psd);
}

/* Atoms of 5, 3 and 2 tenths: three bins whatever is asked, and none to compare for one atom. */
static void atoms_are_bins(void **state)
{
  (void)state;
  const double radii[] = {1, 1.5, 4}, shares[] = {5, 3, 2};
  packing_psd_discrete_def def;
  packing_psd *psd = NULL, *mono = test_mono(1.5);
  double r[100];
  packing_psd_discrete_def_init(&def);
  def.count = 3;
  def.r = radii;
  def.share = shares;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_discrete(NULL, &def, &psd));
  for (int i = 0; i < 100; i++)
    r[i] = radii[i % 10 < 4 ? 0 : i % 10 < 8 ? 1 : 2]; /* 40, 40, 20 */
  const packing_size_tests_report t = test_sizes(psd, r, 100, 50);
  assert_int_equal(t.bins, 3);
  assert_close(t.chi_square, 100.0 / 50 + 100.0 / 30, 1e-12);
  assert_close(t.chi_square_p, exp(-t.chi_square / 2), 1e-12); /* two degrees */
  const packing_size_tests_report one = test_sizes(mono, r, 100, 50);
  assert_int_equal(one.bins, 1);
  assert_true(isnan(one.chi_square) && isnan(one.chi_square_p) && one.ks > 0.3);
  packing_psd_destroy(psd);
  packing_psd_destroy(mono);
}

/* Far from the law p underflows to 0 and does not fail. */
static void hopeless_samples_have_p_0(void **state)
{
  (void)state;
  static double r[100000];
  for (int i = 0; i < 100000; i++)
    r[i] = 9;
  packing_psd *psd = test_uniform(1, 2);
  for (size_t count = 10; count <= 100000; count *= 10)
    for (size_t bins = 2; bins <= 10000; bins *= 5) {
      const packing_size_tests_report t = test_sizes(psd, r, count, bins);
      assert_true(t.ks == 1 && t.ks_p == 0);
      assert_close(t.chi_square, (double)(count * (bins - 1)), 1e-9);
      assert_true(t.chi_square_p >= 0 && t.chi_square_p < 0.01);
    }
  packing_psd_destroy(psd);
}

/* A mixture of radii around 1 (share .8 by number) and around 2. */
static packing_psd *two_sizes(double unit)
{
  packing_psd *parts[2] = {test_uniform(0.75 * unit, 1.25 * unit),
                           test_uniform(1.5 * unit, 2.5 * unit)};
  const double share[] = {4, 1};
  packing_psd_mixture_def def;
  packing_psd *psd = NULL;
  packing_psd_mixture_def_init(&def);
  def.count = 2;
  def.parts = parts;
  def.share = share;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_mixture(NULL, &def, &psd));
  packing_psd_destroy(parts[0]);
  packing_psd_destroy(parts[1]);
  return psd;
}

static void components_stand_for_themselves(void **state)
{
  (void)state;
  double r[N], mass[2] = {0, 0};
  int32_t component[N];
  packing_size_component found[2];
  packing_psd *psd = two_sizes(1), *alone = test_uniform(0.75, 1.25);
  size_t count[2] = {0, 0};
  for (int i = 0; i < N; i++) {
    component[i] = i % 5 == 4;
    const double u = (i / 5 * 4 + i % 5 % 4 + 0.5) / N / 0.8;
    r[i] = component[i] ? 1.5 + (i / 5 + 0.5) / N * 5 : 0.75 + 0.5 * u;
    count[component[i]]++;
    mass[component[i]] += pow(r[i], 3);
  }
  packing_view v = view_of(r, N);
  v.component.data = component;
  v.component.stride = sizeof component[0];
  assert_ok(packing_measure_components(NULL, psd, &v, found));
  const double m[2] = {0.8 * (1 + 0.0625),
                       0.2 * 8 * (1 + 0.0625)}; /* E r^3 = 1 + 3 s^2 */
  for (int c = 0; c < 2; c++) {
    assert_int_equal(found[c].count, count[c]);
    assert_near(found[c].number_asked, c ? 0.2 : 0.8, 1e-15);
    assert_near(found[c].number_placed, c ? 0.2 : 0.8, 1e-15);
    assert_near(found[c].number_sd, 0.4 / sqrt(N), 1e-15);
    assert_near(found[c].mass_asked, m[c] / (m[0] + m[1]), 1e-12);
    assert_near(found[c].mass_placed, mass[c] / (mass[0] + mass[1]), 1e-12);
    assert_close(found[c].ks, 0.5 / (double)count[c], 1e-9);
    assert_near(found[c].ks_p, 1, 1e-12);
  }
  /* half of the small ones twice too many */
  for (int i = 0; i < N; i++)
    if (!component[i] && r[i] > 1)
      r[i] = 1;
  assert_ok(packing_measure_components(NULL, psd, &v, found));
  assert_close(found[0].ks, 0.5, 1e-3);
  assert_true(found[0].ks_p < 1e-100 && found[1].ks_p > 0.999);
  /* one component needs no column */
  v.component.data = NULL;
  v.count = 1;
  assert_ok(packing_measure_components(NULL, alone, &v, found));
  assert_true(found[0].number_asked == 1 && found[0].mass_placed == 1);
  assert_true(found[0].number_sd == 0 && found[0].count == 1);
  packing_psd_destroy(psd);
  packing_psd_destroy(alone);
}

static void a_component_may_be_missing(void **state)
{
  (void)state;
  const double r[] = {1.5, 2, 2.5};
  const int32_t component[] = {1, 1, 1};
  packing_size_component found[2];
  packing_psd *psd = two_sizes(1);
  packing_view v = view_of(r, 3);
  v.component.data = component;
  v.component.stride = sizeof component[0];
  assert_ok(packing_measure_components(NULL, psd, &v, found));
  assert_true(found[0].count == 0 && found[0].number_placed == 0);
  assert_true(found[0].mass_placed == 0 && isnan(found[0].ks) && isnan(found[0].ks_p));
  assert_true(found[1].number_placed == 1 && found[1].mass_placed == 1);
  assert_close(found[1].ks, 1.0 / 3, 1e-12);
  packing_psd_destroy(psd);
}

static void scaling_by_powers_of_two_changes_nothing(void **state)
{
  (void)state;
  double r[N];
  int32_t component[N];
  packing_size_tests_report first = {0};
  packing_size_component found[2], first_found[2];
  for (int e = -40; e <= 40; e += 20) {
    packing_psd *psd = two_sizes(ldexp(1, e));
    packing_rng *rng = NULL;
    assert_ok(packing_rng_create(NULL, 11, PACKING_PURPOSE_SIZE, 0, &rng));
    for (int i = 0; i < N; i++) {
      size_t from = 0;
      r[i] = packing_psd_draw(psd, rng, &from);
      component[i] = (int32_t)from;
    }
    packing_view v = view_of(r, N);
    v.component.data = component;
    v.component.stride = sizeof component[0];
    const packing_size_tests_report t = test_sizes(psd, r, N, 0);
    assert_ok(packing_measure_components(NULL, psd, &v, found));
    if (e == -40) {
      first = t;
      memcpy(first_found, found, sizeof found);
    }
    assert_memory_equal(&t, &first, sizeof t);
    assert_memory_equal(found, first_found, sizeof found);
    packing_rng_destroy(rng);
    packing_psd_destroy(psd);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(kolmogorov_gives_published_values),
      cmocka_unit_test(kolmogorov_has_closed_forms_at_both_ends),
      cmocka_unit_test(kolmogorov_falls_without_steps),
      cmocka_unit_test(kolmogorov_has_its_limit),
      cmocka_unit_test(tests_find_distance_and_bins),
      cmocka_unit_test(bins_follow_the_number_of_particles),
      cmocka_unit_test(atoms_are_bins),
      cmocka_unit_test(hopeless_samples_have_p_0),
      cmocka_unit_test(components_stand_for_themselves),
      cmocka_unit_test(a_component_may_be_missing),
      cmocka_unit_test(scaling_by_powers_of_two_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
