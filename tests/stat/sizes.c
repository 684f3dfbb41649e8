/* SPDX-License-Identifier: GPL-3.0-or-later */
/* p-values of true samples are uniform. 400 packs of 300 radii of a law: the distance of their
 * p-values from the uniform law has a p-value of its own, which is below 1e-4 in one run of
 * 10 000; chi-square is discrete, so its p-values are only nearly uniform. The seeds are fixed. */
#include "psds.h"

enum { PACKS = 400, RADII = 300 };

static double p_of_p(double *p)
{
  packing_size_tests_report report;
  packing_view v;
  packing_psd *uniform = test_uniform(1, 2);
  for (int i = 0; i < PACKS; i++)
    p[i] += 1; /* radii are above 0 */
  packing_view_init_arrays(&v, PACKS, p, p, p, p);
  packing_size_tests_report_init(&report);
  assert_ok(packing_measure_size_tests(NULL, NULL, uniform, &v, &report));
  packing_psd_destroy(uniform);
  return report.ks_p;
}

static void p_values_of_true_samples_are_uniform(void **state)
{
  (void)state;
  const int kinds[] = {TEST_PSD_NORMAL, TEST_PSD_LOGNORMAL, TEST_PSD_WEIBULL,
                       TEST_PSD_MIXTURE};
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
    packing_psd *psd = test_psd(kinds[k], 1, PACKING_BY_NUMBER, 3);
    double r[RADII], ks[PACKS], chi[PACKS];
    for (int pack = 0; pack < PACKS; pack++) {
      packing_rng *rng = NULL;
      packing_size_tests_report report;
      packing_view v;
      assert_ok(
          packing_rng_create(NULL, 2385, PACKING_PURPOSE_SIZE, (uint64_t)pack, &rng));
      for (int i = 0; i < RADII; i++)
        r[i] = packing_psd_draw(psd, rng, NULL);
      packing_rng_destroy(rng);
      packing_view_init_arrays(&v, RADII, r, r, r, r);
      packing_size_tests_report_init(&report);
      assert_ok(packing_measure_size_tests(NULL, NULL, psd, &v, &report));
      ks[pack] = report.ks_p;
      chi[pack] = report.chi_square_p;
    }
    assert_true(p_of_p(ks) > 1e-4);
    assert_true(p_of_p(chi) > 1e-4);
    packing_psd_destroy(psd);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(p_values_of_true_samples_are_uniform)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
