/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Size distributions: values worked by hand, and the answers at the ends. */
#include "psds.h"

static double moment(const packing_psd *psd, packing_by by, int power)
{
  return test_psd_moment(psd, by, power);
}

static packing_psd *uniform(double min_r, double max_r, packing_by by, int dim)
{
  packing_psd_uniform_def def;
  packing_psd *psd = NULL;
  packing_psd_uniform_def_init(&def);
  def.min_r = min_r;
  def.max_r = max_r;
  def.by = by;
  def.dim = dim;
  assert_ok(packing_psd_create_uniform(NULL, &def, &psd));
  return psd;
}

static packing_psd *discrete(size_t count, const double *r, const double *share,
                             packing_by by, int dim)
{
  packing_psd_discrete_def def;
  packing_psd *psd = NULL;
  packing_psd_discrete_def_init(&def);
  assert_int_equal(def.by, PACKING_BY_MASS);
  def.count = count;
  def.r = r;
  def.share = share;
  def.by = by;
  def.dim = dim;
  assert_ok(packing_psd_create_discrete(NULL, &def, &psd));
  return psd;
}

static packing_psd *curve(size_t count, const double *diameter, const double *passing,
                          int logarithmic, packing_by by)
{
  packing_psd_curve_def def;
  packing_psd *psd = NULL;
  packing_psd_curve_def_init(&def);
  assert_int_equal(def.by, PACKING_BY_MASS);
  assert_int_equal(def.logarithmic, 1);
  def.count = count;
  def.diameter_d = diameter;
  def.passing = passing;
  def.logarithmic = logarithmic;
  def.by = by;
  assert_ok(packing_psd_create_curve(NULL, &def, &psd));
  return psd;
}

static void mono_is_one_size(void **state)
{
  (void)state;
  packing_psd *psd = test_mono(2.385);
  packing_rng *rng = NULL;
  size_t component = 7;
  assert_ok(packing_rng_create(NULL, 1, PACKING_PURPOSE_SIZE, 0, &rng));
  assert_string_equal(packing_psd_kind(psd), "mono");
  assert_true(packing_psd_min_r(psd) == 2.385 && packing_psd_max_r(psd) == 2.385);
  assert_int_equal(packing_psd_components(psd), 1);
  assert_true(packing_psd_draw(psd, rng, &component) == 2.385);
  assert_int_equal(component, 0);
  assert_true(packing_psd_draw(psd, rng, NULL) == 2.385);
  for (int by = PACKING_BY_NUMBER; by <= PACKING_BY_MASS; by++) {
    assert_true(packing_psd_cdf(psd, (packing_by)by, 2.384) == 0);
    assert_true(packing_psd_cdf(psd, (packing_by)by, 2.385) == 1);
    assert_true(packing_psd_quantile(psd, (packing_by)by, .3) == 2.385);
    for (int n = -6; n <= 6; n++)
      assert_close(moment(psd, (packing_by)by, n), pow(2.385, n), 1e-15);
  }
  packing_rng_destroy(rng);
  packing_psd_destroy(psd);
}

/* U[1, 2] by number: E[r^n] = (2^(n+1) - 1) / (n + 1); by mass weighted by r^3 / (15/4). */
static void uniform_has_hand_values(void **state)
{
  (void)state;
  packing_psd *psd = uniform(1, 2, PACKING_BY_NUMBER, 3);
  assert_close(moment(psd, PACKING_BY_NUMBER, 1), 1.5, 1e-15);
  assert_close(moment(psd, PACKING_BY_NUMBER, -1), log(2), 1e-15);
  assert_close(moment(psd, PACKING_BY_NUMBER, 3), 3.75, 1e-15);
  assert_close(moment(psd, PACKING_BY_MASS, 1), 31.0 / 5 / 3.75, 1e-15);
  assert_close(moment(psd, PACKING_BY_MASS, -3), 1 / 3.75, 1e-15);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1.25), .25, 1e-15);
  assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 1.5), (5.0625 - 1) / 15, 1e-15);
  assert_close(packing_psd_quantile(psd, PACKING_BY_MASS, .4), pow(7, .25), 1e-15);
  packing_psd_destroy(psd);
  psd = uniform(1, 2, PACKING_BY_MASS, 2); /* by number: density ~ r^-2 */
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1.5), (1 - 1 / 1.5) / .5, 1e-15);
  assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 1.5), .5, 1e-15);
  assert_close(moment(psd, PACKING_BY_NUMBER, 1), log(2) / .5, 1e-15);
  packing_psd_destroy(psd);
}

/* A band of 1e-12 about 1: the cut is linear to 1e-12, and nothing cancels. */
static void narrow_uniform_keeps_its_digits(void **state)
{
  (void)state;
  const double width = 0x1p-40;
  packing_psd *psd = uniform(1, 1 + width, PACKING_BY_NUMBER, 3);
  assert_near(packing_psd_cdf(psd, PACKING_BY_MASS, 1 + width / 4), .25, 1e-11);
  assert_near((packing_psd_quantile(psd, PACKING_BY_MASS, .25) - 1) / width, .25, 1e-3);
  assert_close(moment(psd, PACKING_BY_NUMBER, 6), 1 + 3 * width, 1e-15);
  packing_psd_destroy(psd);
}

/* Truncated at 3 sd, cv .1: the figures of a normal table. */
static void truncated_normal_has_table_values(void **state)
{
  (void)state;
  packing_psd_normal_def def;
  packing_psd *psd = NULL;
  packing_psd_normal_def_init(&def);
  def.mean_r = 1;
  def.sd_r = .1;
  def.min_r = .7;
  def.max_r = 1.3;
  assert_ok(packing_psd_create_normal(NULL, &def, &psd));
  const double mean = moment(psd, PACKING_BY_NUMBER, 1);
  const double square = moment(psd, PACKING_BY_NUMBER, 2);
  assert_close(mean, 1.0, 1e-14);
  assert_near(sqrt(square - mean * mean) / .1, .986578, 5e-7);
  assert_near(square / (mean * mean), 1.009733, 5e-7);
  assert_near(moment(psd, PACKING_BY_NUMBER, 3), 1.029200, 5e-7);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1.0), .5, 1e-14);
  assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, .5), 1.0, 1e-15);
  packing_psd_destroy(psd);
}

/* Radii 1 and 2, 3 parts of mass to 8: 3 : 1 by number. In two dimensions 3 : 2. */
static void discrete_converts_mass_and_number(void **state)
{
  (void)state;
  const double r[] = {1, 2}, share[] = {3, 8};
  packing_psd *psd = discrete(2, r, share, PACKING_BY_MASS, 3);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1), .75, 1e-15);
  assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 1.5), 3.0 / 11, 1e-15);
  assert_close(moment(psd, PACKING_BY_NUMBER, 1), 1.25, 1e-15);
  assert_close(moment(psd, PACKING_BY_NUMBER, 3), 2.75, 1e-15);
  assert_close(moment(psd, PACKING_BY_MASS, 1), 19.0 / 11, 1e-15);
  assert_close(moment(psd, PACKING_BY_MASS, -3), 1 / 2.75, 1e-15);
  assert_true(packing_psd_quantile(psd, PACKING_BY_NUMBER, .75) == 1);
  assert_true(packing_psd_quantile(psd, PACKING_BY_NUMBER, .7500001) == 2);
  assert_true(packing_psd_quantile(psd, PACKING_BY_MASS, .75) == 2);
  packing_psd_destroy(psd);
  psd = discrete(2, r, share, PACKING_BY_MASS, 2);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1), .6, 1e-15);
  packing_psd_destroy(psd);
  psd = discrete(2, r, share, PACKING_BY_NUMBER, 3);
  assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 1), 3.0 / 67, 1e-15);
  packing_psd_destroy(psd);
}

/* Two rows, linear axis, by mass: mass uniform over the radius in [1, 2], so the density by
 * number goes as r^-3: F = (1 - r^-2) / (3/4). Log axis: mass as 1/r, number as r^-4. */
static void curve_of_two_rows_has_hand_values(void **state)
{
  (void)state;
  const double diameter[] = {2, 4}, passing[] = {0, 1};
  packing_psd *psd = curve(2, diameter, passing, 0, PACKING_BY_MASS);
  assert_true(packing_psd_min_r(psd) == 1 && packing_psd_max_r(psd) == 2);
  assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 1.25), .25, 1e-14);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1.5), (1 - 1 / 2.25) / .75, 1e-14);
  assert_close(moment(psd, PACKING_BY_MASS, 1), 1.5, 1e-14);
  assert_close(moment(psd, PACKING_BY_NUMBER, 1), .5 / .375, 1e-14);
  packing_psd_destroy(psd);
  psd = curve(2, diameter, passing, 1, PACKING_BY_MASS);
  assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, sqrt(2)), .5, 1e-14);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1.5),
               (1 - pow(1.5, -3)) / (1 - .125), 1e-14);
  assert_close(moment(psd, PACKING_BY_NUMBER, 3), 3 * log(2) / (1 - .125), 1e-14);
  packing_psd_destroy(psd);
}

/* Between rows the curve stays between their values, and passes through them; flat ends carry
 * no size. */
static void curve_is_monotone_on_a_nasty_table(void **state)
{
  (void)state;
  const double diameter[] = {.063, .0631, .125, .25, .2500001, 1, 1.1, 4, 16, 31.5, 63};
  const double passing[] = {0, 0, 1e-9, 1e-9, .4, .40000001, .9, .9, .9999, 1, 1};
  const size_t rows = 11;
  const double rounding = 2e-16 / 4e-7; /* of x, within the step of width 4e-7 x */
  for (int logarithmic = 0; logarithmic < 2; logarithmic++) {
    packing_psd *psd = curve(rows, diameter, passing, logarithmic, PACKING_BY_MASS);
    assert_close(packing_psd_min_r(psd), .0631 / 2, 1e-15);
    assert_close(packing_psd_max_r(psd), 31.5 / 2, 1e-15);
    double before = 0;
    for (size_t i = 0; i + 1 < rows; i++) {
      assert_near(packing_psd_cdf(psd, PACKING_BY_MASS, diameter[i] / 2), passing[i],
                  rounding);
      for (int k = 1; k < 200; k++) {
        const double d = diameter[i] + (diameter[i + 1] - diameter[i]) * k / 200;
        const double p = packing_psd_cdf(psd, PACKING_BY_MASS, d / 2);
        assert_true(p >= before - 1e-15);
        assert_true(p >= passing[i] - rounding && p <= passing[i + 1] + rounding);
        before = p;
      }
    }
    packing_psd_destroy(psd);
  }
}

/* Three rows with equal steps of 1 in diameter, passing 0, 1/4, 1. Steffen: slopes at the rows
 * 0 (one-sided parabola: 0), 2 min(1/4, 3/4, 1/2 * 1/2) = 1/2, 1; then by Hermite's formula the
 * curve is (d - 1)^2 / 4, which is the parabola through the rows. */
static void curve_reproduces_a_parabola(void **state)
{
  (void)state;
  const double diameter[] = {1, 2, 3}, passing[] = {0, .25, 1};
  packing_psd *psd = curve(3, diameter, passing, 0, PACKING_BY_NUMBER);
  for (double d = 1.125; d < 3; d += .125)
    assert_near(packing_psd_cdf(psd, PACKING_BY_NUMBER, d / 2), (d - 1) * (d - 1) / 4,
                1e-15);
  assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, .49), (1 + 2 * .7) / 2,
               1e-14);
  packing_psd_destroy(psd);
}

static void sample_counts_its_entries(void **state)
{
  (void)state;
  packing_psd *psd = test_psd(TEST_PSD_SAMPLE, 1, PACKING_BY_NUMBER, 3);
  /* .5, .5, .75, 1, 1.5 */
  assert_true(packing_psd_min_r(psd) == .5 && packing_psd_max_r(psd) == 1.5);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, .5), .4, 1e-15);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, .9), .6, 1e-15);
  assert_close(moment(psd, PACKING_BY_NUMBER, 1), .85, 1e-15);
  assert_true(packing_psd_quantile(psd, PACKING_BY_NUMBER, .39) == .5);
  assert_true(packing_psd_quantile(psd, PACKING_BY_NUMBER, .61) == 1);
  packing_psd_destroy(psd);
}

/* The cut lognormal kernel has median 1 and reaches exp(3 bandwidth) both ways. */
static void smoothed_sample_spreads_its_entries(void **state)
{
  (void)state;
  const double r = 2;
  packing_psd_sample_def def;
  packing_psd *psd = NULL;
  packing_psd_sample_def_init(&def);
  def.count = 1;
  def.r = &r;
  def.bandwidth = .05;
  assert_ok(packing_psd_create_sample(NULL, &def, &psd));
  assert_close(packing_psd_min_r(psd), 2 * exp(-.15), 1e-15);
  assert_close(packing_psd_max_r(psd), 2 * exp(.15), 1e-15);
  assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, .5), 2.0, 1e-14);
  const double inside = erf(3 / sqrt(2)), one = erf(1 / sqrt(2));
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 2 * exp(.05)),
               .5 + .5 * one / inside, 1e-13);
  packing_psd_destroy(psd);
}

/* Equal masses of radius 1 and radius 2 are 8 : 1 by number. */
static void mixture_shares_by_mass_or_number(void **state)
{
  (void)state;
  packing_psd *parts[] = {test_mono(1), test_mono(2)};
  const double share[] = {1, 1};
  packing_psd_mixture_def def;
  packing_psd *psd = NULL;
  packing_psd_mixture_def_init(&def);
  assert_int_equal(def.by, PACKING_BY_MASS);
  def.count = 2;
  def.parts = parts;
  def.share = share;
  assert_ok(packing_psd_create_mixture(NULL, &def, &psd));
  packing_psd_destroy(parts[0]); /* the mixture keeps them */
  packing_psd_destroy(parts[1]);
  assert_int_equal(packing_psd_components(psd), 2);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 1), 8.0 / 9, 1e-15);
  assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 1), .5, 1e-15);
  assert_close(moment(psd, PACKING_BY_NUMBER, 1), 10.0 / 9, 1e-15);
  assert_close(moment(psd, PACKING_BY_MASS, 1), 1.5, 1e-15);
  assert_true(packing_psd_quantile(psd, PACKING_BY_NUMBER, .888) == 1);
  assert_true(packing_psd_quantile(psd, PACKING_BY_NUMBER, .889) == 2);
  packing_psd_destroy(psd);
}

static void ends_are_ends(void **state)
{
  (void)state;
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++) {
    packing_psd *psd = test_psd(kind, 1, PACKING_BY_MASS, 3);
    const double lo = packing_psd_min_r(psd), hi = packing_psd_max_r(psd);
    for (int b = 0; b < 2; b++) {
      const packing_by by = (packing_by)b;
      assert_true(packing_psd_quantile(psd, by, 0) == lo);
      assert_true(packing_psd_quantile(psd, by, -1) == lo);
      assert_true(packing_psd_quantile(psd, by, 1) == hi);
      assert_true(packing_psd_quantile(psd, by, 2) == hi);
      assert_true(packing_psd_cdf(psd, by, -1) == 0);
      assert_true(packing_psd_cdf(psd, by, lo * (1 - 1e-15)) == 0);
      assert_true(packing_psd_cdf(psd, by, hi) == 1);
      assert_true(packing_psd_cdf(psd, by, HUGE_VAL) == 1);
      assert_true(isnan(packing_psd_cdf(psd, by, nan(""))));
      assert_true(isnan(packing_psd_quantile(psd, by, nan(""))));
      assert_close(moment(psd, by, 0), 1.0, 1e-15);
    }
    packing_psd_destroy(psd);
  }
}

static void moments_have_limits(void **state)
{
  (void)state;
  double m = 7;
  packing_psd *psd = test_mono(1e100);
  assert_status(packing_psd_moment(psd, PACKING_BY_NUMBER, 7, &m), PACKING_ERR_RANGE);
  assert_status(packing_psd_moment(psd, PACKING_BY_NUMBER, -7, &m), PACKING_ERR_RANGE);
  assert_status(packing_psd_moment(psd, PACKING_BY_NUMBER, 4, &m), PACKING_ERR_RANGE);
  assert_status(packing_psd_moment(psd, PACKING_BY_NUMBER, -4, &m), PACKING_ERR_RANGE);
  assert_status(packing_psd_moment(psd, PACKING_BY_NUMBER, 1, NULL), PACKING_ERR_INVALID);
  assert_status(packing_psd_moment(NULL, PACKING_BY_NUMBER, 1, &m), PACKING_ERR_INVALID);
  assert_true(m == 7);
  assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, 3, &m));
  assert_close(m, 1e300, 1e-14);
  packing_psd_destroy(psd);
}

static void holds_are_counted(void **state)
{
  (void)state;
  test_allocator allocator = {0};
  packing_context *context = test_allocator_context(&allocator);
  const size_t before = allocator.live;
  packing_psd *psd = NULL;
  assert_ok(test_psd_create(context, TEST_PSD_MIXTURE, 1, PACKING_BY_MASS, 3, &psd));
  packing_context_destroy(context); /* a distribution needs none */
  assert_ptr_equal(packing_psd_retain(psd), psd);
  packing_psd_destroy(psd);
  assert_true(allocator.live > before - 1);
  assert_close(moment(psd, PACKING_BY_NUMBER, 0), 1.0, 1e-15);
  packing_psd_destroy(psd);
  assert_int_equal(allocator.live, 0);
  assert_null(packing_psd_retain(NULL));
}

static void kinds_have_names(void **state)
{
  (void)state;
  static const char *const names[] = {
      "mono",     "uniform", "normal", "lognormal", "weibull", "gamma",  "exponential",
      "discrete", "curve",   "curve",  "sample",    "sample",  "mixture"};
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++) {
    packing_psd *psd = test_psd(kind, 1, PACKING_BY_NUMBER, 2);
    assert_string_equal(packing_psd_kind(psd), names[kind]);
    assert_int_equal(packing_psd_components(psd), kind == TEST_PSD_MIXTURE ? 3 : 1);
    packing_psd_destroy(psd);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mono_is_one_size),
      cmocka_unit_test(uniform_has_hand_values),
      cmocka_unit_test(narrow_uniform_keeps_its_digits),
      cmocka_unit_test(truncated_normal_has_table_values),
      cmocka_unit_test(discrete_converts_mass_and_number),
      cmocka_unit_test(curve_of_two_rows_has_hand_values),
      cmocka_unit_test(curve_is_monotone_on_a_nasty_table),
      cmocka_unit_test(curve_reproduces_a_parabola),
      cmocka_unit_test(sample_counts_its_entries),
      cmocka_unit_test(smoothed_sample_spreads_its_entries),
      cmocka_unit_test(mixture_shares_by_mass_or_number),
      cmocka_unit_test(ends_are_ends),
      cmocka_unit_test(moments_have_limits),
      cmocka_unit_test(holds_are_counted),
      cmocka_unit_test(kinds_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
