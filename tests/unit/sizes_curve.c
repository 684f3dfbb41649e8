/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of sizes, sieves, and the errors between curves. */
#include "psds.h"

enum { N = 600 };

static packing_view view_of(const double *r, size_t count)
{
  packing_view v;
  packing_view_init_arrays(&v, count, r, r, r, r);
  return v;
}

static void draw(const packing_psd *psd, uint64_t seed, double *r, size_t count)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, seed, PACKING_PURPOSE_SIZE, 0, &rng));
  for (size_t i = 0; i < count; i++)
    r[i] = packing_psd_draw(psd, rng, NULL);
  packing_rng_destroy(rng);
}

/* The definition: one particle after the other. */
static double direct_share(const double *r, size_t count, int power, double upto)
{
  long double in = 0, all = 0;
  for (size_t i = 0; i < count; i++) {
    const long double m = powl(r[i], power);
    all += m;
    if (r[i] <= upto)
      in += m;
  }
  return (double)(in / all);
}

static void curves_are_those_of_the_definition(void **state)
{
  (void)state;
  double r[N], asked[80], placed[80], at[80];
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++)
    for (int dim = 2; dim <= 3; dim++)
      for (int by = 0; by < 2; by++) {
        packing_psd *psd = test_psd(kind, 1.37, PACKING_BY_NUMBER, dim);
        packing_size_curve_def def;
        draw(psd, 7, r, N);
        const packing_view v = view_of(r, N);
        for (int k = 0; k < 80; k++)
          at[k] = k % 2 ? r[7 * k] : packing_psd_max_r(psd) * (80 - k) / 77;
        packing_size_curve_def_init(&def);
        def.by = (packing_by)by;
        assert_ok(packing_measure_size_curve(NULL, &def, psd, &v, 80, at, asked, placed));
        for (int k = 0; k < 80; k++) {
          assert_near(placed[k], direct_share(r, N, by ? dim : 0, at[k]), 1e-14);
          assert_true(asked[k] == packing_psd_cdf(psd, (packing_by)by, at[k]));
        }
        packing_psd_destroy(psd);
      }
}

static void a_curve_needs_no_distribution(void **state)
{
  (void)state;
  const double r[] = {3, 1, 2, 2}, at[] = {0.5, 1, 1.999, 2, 3, 99};
  const double areas[] = {0, 1.0 / 18, 1.0 / 18, 9.0 / 18, 1, 1};
  double placed[6];
  const packing_view v = view_of(r, 4);
  packing_size_curve_def def;
  assert_ok(packing_measure_size_curve(NULL, NULL, NULL, &v, 6, at, NULL, placed));
  assert_true(placed[0] == 0 && placed[1] == 0.25 && placed[2] == 0.25);
  assert_true(placed[3] == 0.75 && placed[4] == 1 && placed[5] == 1);
  packing_size_curve_def_init(&def);
  def.by = PACKING_BY_MASS;
  def.dim = 2;
  assert_ok(packing_measure_size_curve(NULL, &def, NULL, &v, 6, at, NULL, placed));
  for (int k = 0; k < 6; k++)
    assert_near(placed[k], areas[k], 1e-15);
  assert_ok(packing_measure_size_curve(NULL, &def, NULL, &v, 6, at, NULL, NULL));
  assert_ok(packing_measure_size_curve(NULL, &def, NULL, &v, 0, NULL, NULL, NULL));
}

/* Spheres of diameter 1 (8 of them), 2 (one) and 4 (one): masses 8, 8 and 64 of 80. */
static void sieves_hold_the_masses_between_them(void **state)
{
  (void)state;
  const double r[] = {.5, .5, .5, .5, 2, .5, .5, 1, .5, .5};
  const double openings[] = {5, 4, 3, 1.5, 0.8}, passing[] = {100, 100, 20, 10, 0, 0};
  packing_sieve sieves[6];
  packing_sieves_def def;
  packing_psd *psd = test_uniform(0.5, 2);
  const packing_view v = view_of(r, 10);
  packing_sieves_def_init(&def);
  def.count = 5;
  def.opening_d = openings;
  for (int with = 0; with < 2; with++) {
    double asked = 0, placed = 0;
    assert_ok(packing_measure_sieves(NULL, &def, with ? psd : NULL, &v, sieves));
    for (int k = 0; k < 6; k++) {
      const packing_sieve *s = &sieves[k];
      const double before = k == 0 ? 100 : sieves[k - 1].placed_passing;
      assert_true(s->opening_d == (k < 5 ? openings[k] : 0));
      assert_near(s->placed_passing, passing[k], 1e-12);
      assert_near(s->placed_retained, before - passing[k], 1e-12);
      placed += s->placed_retained;
      if (!with) {
        assert_true(isnan(s->asked_passing) && isnan(s->asked_retained));
        continue;
      }
      /* a share of mass of (r^4 - 0.5^4) / (2^4 - 0.5^4) has r up to there */
      const double rk = fmin(fmax(s->opening_d / 2, 0.5), 2);
      assert_near(s->asked_passing, 100 * (pow(rk, 4) - 0.0625) / 15.9375, 1e-10);
      asked += s->asked_retained;
    }
    assert_near(placed, 100, 1e-12);
    assert_near(with ? asked : 100, 100, 1e-12);
  }
  packing_psd_destroy(psd);
}

/* Curves of Tables 10 and 11 of the advancing-front paper, per cent. */
static const double aa_experiment[] = {0.3,  1.94,  2.26,  3.91, 10.94,
                                       39.7, 96.13, 99.83, 100};
static const double aa_virtual[] = {0.305,   1.86877, 2.33738, 4.40837, 11.7401,
                                    40.9511, 96.0188, 99.8178, 100};
static const double ah_experiment[] = {0.98,  2.58,  2.74,  3.87,  5.16,  6.45, 7.74,
                                       20.32, 33.39, 53.72, 71.72, 83.78, 100};
static const double ah_virtual[] = {0.980272, 2.59155, 2.89303,  4.24557, 5.34449,
                                    6.646,    7.91426, 22.41333, 35.6489, 54.28313,
                                    72.06208, 83.8994, 100};

static packing_curve_errors_report errors(size_t count, const double *asked,
                                          const double *placed)
{
  packing_curve_errors_report report;
  packing_curve_errors_report_init(&report);
  assert_ok(packing_measure_curve_errors(NULL, count, asked, placed, &report));
  return report;
}

/* The paper prints .40, .35, 4.59 % and -3.50 %: its sums (2.827, 2.477, 32.10 %, -24.50 %) are
 * right, but divided by 7 where there are 9 points. */
static void table_10_is_divided_by_its_points(void **state)
{
  (void)state;
  const packing_curve_errors_report e = errors(9, aa_experiment, aa_virtual);
  assert_near(e.mae, 0.3141, 5e-5);
  assert_near(e.mse, 0.2753, 5e-5);
  assert_near(100 * e.rmae, 3.567, 5e-4);
  assert_near(100 * e.mre, -2.722, 5e-4);
  assert_int_equal(e.relative_count, 9);
  assert_near(e.mae * 9 / 7, 0.40, 5e-3);
  assert_near(e.mse * 9 / 7, 0.35, 5e-3);
  assert_near(100 * e.rmae * 9 / 7, 4.59, 5e-3);
  assert_near(100 * e.mre * 9 / 7, -3.50, 5e-3);
}

/* The paper prints .78, 1.39, 5.96 % and -5.96 %: the sums of the first nine of 13 rows, divided
 * by 7. */
static void table_11_has_thirteen_points(void **state)
{
  (void)state;
  const packing_curve_errors_report e = errors(13, ah_experiment, ah_virtual);
  assert_near(e.mae, 0.4978, 5e-5);
  assert_near(e.mse, 0.7847, 5e-5);
  assert_near(100 * e.rmae, 3.336, 5e-4);
  assert_near(100 * e.mre, -3.336, 5e-4);
  const packing_curve_errors_report nine = errors(9, ah_experiment, ah_virtual);
  assert_near(nine.mae * 9 / 7, 0.78, 5e-3);
  assert_near(nine.mse * 9 / 7, 1.39, 5e-3);
  assert_near(100 * nine.rmae * 9 / 7, 5.96, 5e-3);
}

static void points_with_nothing_asked_have_no_relative_error(void **state)
{
  (void)state;
  const double asked[] = {0, 0, 0.5, 1}, placed[] = {0, 0.25, 0.25, 1};
  const packing_curve_errors_report e = errors(4, asked, placed);
  assert_true(e.mae == 0.125 && e.mse == 0.03125 && e.relative_count == 2);
  assert_true(e.rmae == 0.25 && e.mre == 0.25);
  const packing_curve_errors_report none = errors(2, asked, placed);
  assert_true(none.mae == 0.125 && none.relative_count == 0);
  assert_true(isnan(none.rmae) && isnan(none.mre));
}

static void curves_of_two_packs_can_be_compared(void **state)
{
  (void)state;
  double r[N], placed[2][5];
  const double at[] = {1.2, 1.4, 1.6, 1.8, 2};
  packing_psd *psd = test_uniform(1, 2);
  for (int pack = 0; pack < 2; pack++) {
    draw(psd, (uint64_t)pack, r, N);
    const packing_view v = view_of(r, N);
    assert_ok(
        packing_measure_size_curve(NULL, NULL, NULL, &v, 5, at, NULL, placed[pack]));
  }
  const packing_curve_errors_report e = errors(5, placed[0], placed[1]);
  assert_true(e.mae > 0 && e.mae < 5 / sqrt(N) && e.mse <= 5 * e.mae * e.mae);
  packing_psd_destroy(psd);
}

static void scaling_by_powers_of_two_changes_nothing(void **state)
{
  (void)state;
  double r[N], at[20], asked[20], placed[20], first_asked[20], first_placed[20];
  packing_sieve sieves[5], first[5];
  for (int e = 0; e <= 60; e += 20) {
    packing_psd *psd = test_psd(TEST_PSD_MIXTURE, ldexp(0.7, e), PACKING_BY_MASS, 3);
    packing_sieves_def def;
    packing_size_curve_def curve;
    draw(psd, 3, r, N);
    const packing_view v = view_of(r, N);
    const double most = packing_psd_max_r(psd);
    for (int k = 0; k < 20; k++)
      at[k] = most * (k + 1) / 20;
    const double openings[] = {1.9 * most, 1.5 * most, most, 0.5 * most};
    packing_size_curve_def_init(&curve);
    curve.by = PACKING_BY_MASS;
    packing_sieves_def_init(&def);
    def.count = 4;
    def.opening_d = openings;
    assert_ok(packing_measure_size_curve(NULL, &curve, psd, &v, 20, at, asked, placed));
    assert_ok(packing_measure_sieves(NULL, &def, psd, &v, sieves));
    if (e == 0) {
      memcpy(first, sieves, sizeof first);
      memcpy(first_asked, asked, sizeof asked);
      memcpy(first_placed, placed, sizeof placed);
    }
    assert_memory_equal(first_asked, asked, sizeof asked);
    assert_memory_equal(first_placed, placed, sizeof placed);
    for (int k = 0; k < 5; k++) {
      assert_true(sieves[k].opening_d == ldexp(first[k].opening_d, e));
      assert_true(sieves[k].asked_passing == first[k].asked_passing);
      assert_true(sieves[k].placed_passing == first[k].placed_passing);
    }
    packing_psd_destroy(psd);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(curves_are_those_of_the_definition),
      cmocka_unit_test(a_curve_needs_no_distribution),
      cmocka_unit_test(sieves_hold_the_masses_between_them),
      cmocka_unit_test(table_10_is_divided_by_its_points),
      cmocka_unit_test(table_11_has_thirteen_points),
      cmocka_unit_test(points_with_nothing_asked_have_no_relative_error),
      cmocka_unit_test(curves_of_two_packs_can_be_compared),
      cmocka_unit_test(scaling_by_powers_of_two_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
