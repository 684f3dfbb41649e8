/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes asked against sizes placed. */
#include "test.h"

enum { MOST = 5000 };

static packing_sizes_report compare(packing_psd *psd, const double *r, size_t count)
{
  packing_sizes_report report;
  packing_view v;
  packing_view_init_arrays(&v, count, r, r, r, r);
  packing_sizes_report_init(&report);
  assert_ok(packing_measure_sizes(NULL, psd, &v, &report));
  return report;
}

static int by_value(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The definition: both sides of every step, one by one. */
static double direct_ks(const packing_psd *psd, const double *r, size_t count)
{
  double *sorted = malloc(count * sizeof *sorted), most = 0;
  assert_non_null(sorted);
  memcpy(sorted, r, count * sizeof *sorted);
  qsort(sorted, count, sizeof *sorted, by_value);
  for (size_t first = 0, end; first < count; first = end) {
    for (end = first; end < count && sorted[end] == sorted[first];)
      end++;
    const double law = packing_psd_cdf(psd, PACKING_BY_NUMBER, sorted[first]);
    const double below =
        packing_psd_cdf(psd, PACKING_BY_NUMBER, nextafter(sorted[first], 0));
    most = fmax(most, fabs((double)end / (double)count - law));
    most = fmax(most, fabs((double)first / (double)count - below));
  }
  free(sorted);
  return most;
}

static void equal_particles_asked_and_placed(void **state)
{
  (void)state;
  packing_psd *psd = test_mono(2.385);
  double r[100];
  for (int i = 0; i < 100; i++)
    r[i] = 2.385;
  packing_sizes_report s = compare(psd, r, 100);
  assert_true(s.ks == 0 && s.ks_mass == 0 && s.mean_relative_error == 0);
  assert_true(s.min_r == 2.385 && s.max_r == 2.385);
  assert_close(s.mean_r, 2.385, 1e-15);
  assert_close(s.ks_limit, 0.136, 1e-15);
  for (int i = 0; i < 100; i++)
    r[i] = 2.385 * 1.01;
  s = compare(psd, r, 100);
  assert_true(s.ks == 1 && s.ks_mass == 1);
  assert_near(s.mean_relative_error, 0.01, 1e-14);
  for (int i = 0; i < 100; i++)
    r[i] = i < 25 ? 2 : 2.385;
  s = compare(psd, r, 100);
  assert_close(s.ks, 0.25, 1e-15);
  assert_close(s.ks_mass, 25 * 8 / (25 * 8 + 75 * pow(2.385, 3)), 1e-14);
  packing_psd_destroy(psd);
}

static void the_distance_is_that_of_the_definition(void **state)
{
  (void)state;
  static double r[MOST];
  packing_psd *asked = test_uniform(1, 2), *other = test_uniform(0.875, 1.75);
  const size_t counts[] = {1, 2, 3, 63, 64, 65, 127, 129, 1000, MOST};
  for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++)
    for (uint64_t seed = 0; seed < 6; seed++) {
      packing_rng *rng = NULL;
      assert_ok(packing_rng_create(NULL, seed, PACKING_PURPOSE_SIZE, 0, &rng));
      for (size_t i = 0; i < counts[c]; i++)
        r[i] = packing_psd_draw(seed % 3 == 2 ? other : asked, rng, NULL);
      if (seed % 2 == 1)
        for (size_t i = 0; i < counts[c]; i++)
          r[i] = floor(16 * r[i]) / 16; /* ties */
      const packing_sizes_report s = compare(asked, r, counts[c]);
      assert_close(s.ks, direct_ks(asked, r, counts[c]), 1e-14);
      packing_rng_destroy(rng);
    }
  packing_psd_destroy(asked);
  packing_psd_destroy(other);
}

/* A law of atoms that is placed exactly is at distance 0; one particle more of a size tells. */
static void atoms_are_no_distance(void **state)
{
  (void)state;
  const double radii[] = {1, 1.5, 4}, shares[] = {5, 3, 2};
  packing_psd_discrete_def def;
  packing_psd *psd = NULL;
  double r[101];
  packing_psd_discrete_def_init(&def);
  def.count = 3;
  def.r = radii;
  def.share = shares;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_discrete(NULL, &def, &psd));
  for (int i = 0; i < 101; i++)
    r[i] = radii[i % 10 < 5 ? 0 : i % 10 < 8 ? 1 : 2];
  packing_sizes_report s = compare(psd, r, 100);
  assert_near(s.ks, 0, 1e-15);
  assert_near(s.ks_mass, 0, 1e-15);
  assert_near(s.mean_relative_error, 0, 1e-15);
  s = compare(psd, r, 101);
  assert_close(s.ks, 51.0 / 101 - 0.5, 1e-12);
  assert_close(s.ks, direct_ks(psd, r, 101), 1e-14);
  packing_psd_destroy(psd);
}

/* Radii at the middle of n equal shares of a law by mass are 1/(2 n) from it at worst by
 * number; by mass the curve follows within the largest particle's share. */
static void curves_by_mass_follow_radii_cubed(void **state)
{
  (void)state;
  enum { N = 1000 };
  double r[N], mass = 0, largest = 0, most = 0;
  packing_psd *psd = test_uniform(1, 3);
  for (int i = 0; i < N; i++) {
    r[i] = packing_psd_quantile(psd, PACKING_BY_NUMBER, (i + 0.5) / N);
    mass += r[i] * r[i] * r[i];
    largest = fmax(largest, r[i] * r[i] * r[i]);
  }
  double before = 0;
  for (int i = 0; i < N; i++) {
    const double law = packing_psd_cdf(psd, PACKING_BY_MASS, r[i]);
    most = fmax(most, fabs(before / mass - law));
    before += r[i] * r[i] * r[i];
    most = fmax(most, fabs(before / mass - law));
  }
  const packing_sizes_report s = compare(psd, r, N);
  assert_close(s.ks, 0.5 / N, 1e-9);
  assert_close(s.ks_mass, most, 1e-9);
  assert_true(s.ks_mass < largest / mass);
  assert_near(s.mean_relative_error, 0, 1e-3);
  packing_psd_destroy(psd);
}

static void quantiles_are_the_smallest_that_reach(void **state)
{
  (void)state;
  packing_psd *psd = test_uniform(1, 2);
  double r[40];
  for (int i = 0; i < 40; i++)
    r[39 - i] = packing_psd_quantile(psd, PACKING_BY_NUMBER, (i + 1) / 40.0) * 1.125;
  assert_near(compare(psd, r, 40).mean_relative_error, 0.125, 1e-14);
  double expected = 0; /* of one particle: all quantiles placed are it */
  for (int k = 1; k < 20; k++)
    expected += (r[0] / (1 + k / 20.0) - 1) / 19;
  assert_close(compare(psd, r, 1).mean_relative_error, expected, 1e-12);
  packing_psd_destroy(psd);
}

static void scaling_by_powers_of_two_changes_nothing(void **state)
{
  (void)state;
  double r[500];
  packing_sizes_report first = {0};
  for (int e = 0; e <= 40; e += 10) {
    packing_psd *psd = test_uniform(ldexp(0.7, e), ldexp(2.1, e));
    for (int i = 0; i < 500; i++)
      r[i] = ldexp(0.7 + 1.3 * (i * 37 % 500) / 500, e);
    const packing_sizes_report s = compare(psd, r, 500);
    if (e == 0)
      first = s;
    assert_true(s.ks == first.ks && s.ks_mass == first.ks_mass &&
                s.mean_relative_error == first.mean_relative_error && s.ks > 0);
    assert_true(s.mean_r == ldexp(first.mean_r, e));
    packing_psd_destroy(psd);
  }
}

static void sizes_refuse_bad_input(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_psd *psd = test_mono(1);
  packing_sizes_report s;
  double r[3] = {1, 1, 1};
  packing_view v;
  packing_view_init_arrays(&v, 0, r, r, r, r);
  packing_sizes_report_init(&s);
  assert_fails(context, packing_measure_sizes(context, psd, &v, &s), PACKING_ERR_RANGE,
               "view");
  v.count = 3;
  assert_fails(context, packing_measure_sizes(context, NULL, &v, &s), PACKING_ERR_INVALID,
               "psd");
  assert_fails(context, packing_measure_sizes(context, psd, NULL, &s),
               PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_measure_sizes(context, psd, &v, NULL),
               PACKING_ERR_INVALID, "report");
  r[2] = 0;
  assert_fails(context, packing_measure_sizes(context, psd, &v, &s), PACKING_ERR_RANGE,
               "particle 2");
  r[2] = (double)NAN;
  assert_fails(context, packing_measure_sizes(context, psd, &v, &s), PACKING_ERR_INVALID,
               "particle 2");
  s.struct_size = 0;
  r[2] = 1;
  assert_fails(context, packing_measure_sizes(context, psd, &v, &s), PACKING_ERR_ABI,
               "struct_size");
  packing_psd_destroy(psd);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equal_particles_asked_and_placed),
      cmocka_unit_test(the_distance_is_that_of_the_definition),
      cmocka_unit_test(atoms_are_no_distance),
      cmocka_unit_test(curves_by_mass_follow_radii_cubed),
      cmocka_unit_test(quantiles_are_the_smallest_that_reach),
      cmocka_unit_test(scaling_by_powers_of_two_changes_nothing),
      cmocka_unit_test(sizes_refuse_bad_input),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
