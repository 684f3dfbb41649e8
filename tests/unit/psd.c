/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Size distributions: hand values, and every refusal on purpose. */
#include "test.h"

static packing_psd *mono(double r)
{
  packing_psd_mono_def def;
  packing_psd *psd = NULL;
  packing_psd_mono_def_init(&def);
  def.r = r;
  assert_ok(packing_psd_create_mono(NULL, &def, &psd));
  return psd;
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

static double moment(const packing_psd *psd, packing_by by, int power)
{
  double m = NAN;
  assert_ok(packing_psd_moment(psd, by, power, &m));
  return m;
}

static void mono_is_one_size(void **state)
{
  (void)state;
  packing_psd *psd = mono(2.385);
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

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mono_is_one_size),
      cmocka_unit_test(uniform_has_hand_values),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
