/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds for every distribution, whatever its kind. */
#include "psds.h"

/* Calls fn for every kind, by number and by mass, in 2 and 3 dimensions. */
static void for_all(void (*fn)(int kind, packing_by by, int dim))
{
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++)
    for (int dim = 2; dim <= 3; dim++) {
      fn(kind, PACKING_BY_NUMBER, dim);
      fn(kind, PACKING_BY_MASS, dim);
    }
}

static packing_rng *stream(void)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 3, PACKING_PURPOSE_SIZE, 0, &rng));
  return rng;
}

static void scale_by_a_power_of_two(int kind, packing_by by, int dim)
{
  static const int powers[] = {-40, -1, 5, 60};
  packing_psd *one = test_psd(kind, 1, by, dim);
  for (size_t i = 0; i < sizeof powers / sizeof *powers; i++) {
    const double unit = ldexp(1, powers[i]);
    packing_psd *other = test_psd(kind, unit, by, dim);
    packing_rng *a = stream(), *b = stream();
    assert_true(packing_psd_min_r(other) == packing_psd_min_r(one) * unit);
    assert_true(packing_psd_max_r(other) == packing_psd_max_r(one) * unit);
    for (int n = -6; n <= 6; n++)
      assert_true(test_psd_moment(other, PACKING_BY_MASS, n) ==
                  ldexp(test_psd_moment(one, PACKING_BY_MASS, n), n * powers[i]));
    for (int k = 0; k < 300; k++) {
      size_t part_of_one = 0, part_of_other = 0;
      const double r = packing_psd_draw(one, a, &part_of_one);
      assert_true(packing_psd_draw(other, b, &part_of_other) == r * unit);
      assert_int_equal(part_of_other, part_of_one);
      assert_true(packing_psd_cdf(other, PACKING_BY_MASS, r * unit) ==
                  packing_psd_cdf(one, PACKING_BY_MASS, r));
      const double p = k / 300.0;
      assert_true(packing_psd_quantile(other, PACKING_BY_MASS, p) ==
                  packing_psd_quantile(one, PACKING_BY_MASS, p) * unit);
    }
    packing_rng_destroy(a);
    packing_rng_destroy(b);
    packing_psd_destroy(other);
  }
  packing_psd_destroy(one);
}

static void scaling_keeps_every_bit(void **state)
{
  (void)state;
  for_all(scale_by_a_power_of_two);
}

static void dense_limit_has_no_scale(void **state)
{
  (void)state;
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++) {
    packing_psd *one = test_psd(kind, 1, PACKING_BY_MASS, 3);
    packing_psd *other = test_psd(kind, 0x1p-33, PACKING_BY_MASS, 3);
    double a = nan(""), b = nan("");
    assert_ok(packing_psd_dense_limit(NULL, one, &a));
    assert_ok(packing_psd_dense_limit(NULL, other, &b));
    assert_true(a == b);
    assert_true(a > .6434 && a < 1);
    packing_psd_destroy(one);
    packing_psd_destroy(other);
  }
}

/* cdf and quantile rise, keep within their ends, and undo each other: cdf(quantile(p)) >= p, and
 * nothing smaller will do. */
static void invert_each_other(int kind, packing_by by, int dim)
{
  packing_psd *psd = test_psd(kind, 1, by, dim);
  for (int b = 0; b < 2; b++) {
    const packing_by asked = (packing_by)b;
    double r_before = 0, p_before = 0;
    for (int k = 0; k <= 500; k++) {
      const double p = k / 500.0, r = packing_psd_quantile(psd, asked, p);
      assert_true(r >= r_before);
      assert_true(r >= packing_psd_min_r(psd) && r <= packing_psd_max_r(psd));
      assert_true(packing_psd_cdf(psd, asked, r * (1 + 1e-14)) >= p - 1e-13);
      if (k > 0)
        assert_true(packing_psd_cdf(psd, asked, r * (1 - 1e-12)) <= p + 1e-13);
      r_before = r;
      const double x = packing_psd_min_r(psd) *
                       pow(packing_psd_max_r(psd) / packing_psd_min_r(psd), p);
      assert_true(packing_psd_cdf(psd, asked, x) >= p_before - 1e-15);
      p_before = packing_psd_cdf(psd, asked, x);
    }
  }
  packing_psd_destroy(psd);
}

static void cdf_and_quantile_belong_together(void **state)
{
  (void)state;
  for_all(invert_each_other);
}

/* E[g] is the mean of g over p. The ends count, so the points p = s^2 (3 - 2 s) crowd there; jumps
 * leave an error of the order of their size over the number of points. */
static void average_over_quantiles(int kind, packing_by by, int dim)
{
  packing_psd *psd = test_psd(kind, 1, by, dim);
  const int cells = 2000;
  for (int b = 0; b < 2; b++) {
    double sum[4] = {0, 0, 0, 0};
    for (int k = 0; k < cells; k++) {
      const double s = (k + .5) / cells, weight = 6 * s * (1 - s) / cells;
      const double r = packing_psd_quantile(psd, (packing_by)b, s * s * (3 - 2 * s));
      for (int n = 0; n < 4; n++)
        sum[n] += weight * pow(r, n);
    }
    for (int n = 0; n < 4; n++)
      assert_close(sum[n], test_psd_moment(psd, (packing_by)b, n), 1e-3 * (n + 1));
  }
  packing_psd_destroy(psd);
}

static void moments_are_those_of_the_quantiles(void **state)
{
  (void)state;
  for_all(average_over_quantiles);
}

/* The k-th moment by mass is E[r^(k + dim)] / E[r^dim] by number, wherever both are offered. */
static void weigh(int kind, packing_by by, int dim)
{
  packing_psd *psd = test_psd(kind, 1, by, dim);
  for (int k = -6; k + dim <= 6; k++)
    assert_close(test_psd_moment(psd, PACKING_BY_MASS, k),
                 test_psd_moment(psd, PACKING_BY_NUMBER, k + dim) /
                     test_psd_moment(psd, PACKING_BY_NUMBER, dim),
                 1e-14);
  packing_psd_destroy(psd);
}

static void mass_is_number_times_volume(void **state)
{
  (void)state;
  for_all(weigh);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(scaling_keeps_every_bit),
      cmocka_unit_test(dense_limit_has_no_scale),
      cmocka_unit_test(cdf_and_quantile_belong_together),
      cmocka_unit_test(moments_are_those_of_the_quantiles),
      cmocka_unit_test(mass_is_number_times_volume),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
