/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The densest random packing against published figures. */
#include "psds.h"

static double limit_of(packing_psd *psd)
{
  double limit = nan("");
  assert_ok(packing_psd_dense_limit(NULL, psd, &limit));
  packing_psd_destroy(psd);
  return limit;
}

static packing_psd *lognormal(double sigma)
{
  packing_psd_lognormal_def def;
  packing_psd *psd = NULL;
  packing_psd_lognormal_def_init(&def);
  def.median_r = 1;
  def.sigma = sigma;
  def.min_r = exp(-9 * sigma); /* as good as uncut */
  def.max_r = exp(9 * sigma);
  assert_ok(packing_psd_create_lognormal(NULL, &def, &psd));
  return psd;
}

static packing_psd *binary(double ratio, double small)
{
  const double r[] = {1, ratio}, share[] = {small, 1 - small};
  packing_psd_discrete_def def;
  packing_psd *psd = NULL;
  packing_psd_discrete_def_init(&def);
  def.count = 2;
  def.r = r;
  def.share = share;
  assert_ok(packing_psd_create_discrete(NULL, &def, &psd));
  return psd;
}

/* The closed fit of R. S. Farr, Powder Technology 245, 28 (2013), to this algorithm. */
static double fit_of(double sigma)
{
  const double pi = acos(-1);
  return 1 - .57 * exp(-sigma) + .2135 * exp(-.57 * sigma / .2135) +
         .0019 *
             (cos(2 * pi * (1 - exp(-.75 * pow(sigma, .7) - .025 * pow(sigma, 4)))) - 1);
}

static void equal_spheres_pack_to_6435(void **state)
{
  (void)state;
  assert_near(limit_of(test_mono(1)), .6435, 1e-4);
}

static void lognormal_follows_the_fit(void **state)
{
  (void)state;
  const double sigma[] = {.05, .1, .2, .3, .4, .5, .6, .8, 1};
  for (size_t i = 0; i < sizeof sigma / sizeof *sigma; i++)
    assert_near(limit_of(lognormal(sigma[i])), fit_of(sigma[i]), 2e-4);
}

static void uniform_has_the_known_values(void **state)
{
  (void)state;
  assert_near(limit_of(test_uniform(.5, 1.5)), .6636, 5e-4);
  assert_near(limit_of(test_uniform(.2, .4)), .6552, 5e-4);
}

/* The best composition has 20 to 30 per cent of small spheres, to a grid of 2 per cent. */
static void binary_peaks_where_it_should(void **state)
{
  (void)state;
  const double ratio[] = {2, 3, 5, 7, 10}, want[] = {.682, .7300, .7876, .8144, .8273};
  for (size_t i = 0; i < sizeof ratio / sizeof *ratio; i++) {
    double best = 0, at = 0;
    for (int percent = 10; percent <= 40; percent += 2) {
      const double limit = limit_of(binary(ratio[i], percent / 100.0));
      if (limit > best) {
        best = limit;
        at = percent / 100.0;
      }
    }
    assert_near(best, want[i], 5e-4);
    assert_true(at >= .18 && at <= .32);
  }
}

static int falling(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x < y) - (x > y);
}

/* The paper word by word: chords of spheres that a random line meets, longest first, each into
 * the largest gap, which all gaps are looked through for. */
static double slow_limit(packing_psd *psd)
{
  enum { RODS = 12000 };
  static double rod[RODS], gap[RODS];
  const double largest = packing_psd_max_r(psd), f = .7654;
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 1, PACKING_PURPOSE_USER, 0, &rng));
  for (size_t n = 0; n < RODS;) {
    const double r = packing_psd_draw(psd, rng, NULL);
    if (packing_rng_uniform(rng) < r * r / (largest * largest))
      rod[n++] = 2 * r * sqrt(packing_rng_uniform(rng));
  }
  qsort(rod, RODS, sizeof *rod, falling);
  gap[0] = f * rod[0];
  for (size_t n = 1; n < RODS; n++) {
    size_t widest = 0;
    for (size_t i = 1; i < n; i++)
      if (gap[i] > gap[widest])
        widest = i;
    gap[n] = fmax(f * rod[n], gap[widest] - (1 + f) * rod[n]);
    gap[widest] = f * rod[n];
  }
  double solid = 0, empty = 0;
  for (size_t n = 0; n < RODS; n++) {
    solid += rod[n];
    empty += gap[n];
  }
  packing_rng_destroy(rng);
  return solid / (solid + empty);
}

/* 12000 random rods scatter by some 1e-3. */
static void slow_way_finds_the_same(void **state)
{
  (void)state;
  packing_psd *psds[] = {test_mono(2.385), test_uniform(.2, 1), binary(7, .22),
                         lognormal(.3)};
  for (size_t i = 0; i < sizeof psds / sizeof *psds; i++) {
    const double slow = slow_limit(psds[i]);
    assert_near(limit_of(psds[i]), slow, 4e-3);
  }
}

/* A size that hardly anybody has changes nothing; a mixture is the same however it is put. */
static void limit_does_not_depend_on_the_wording(void **state)
{
  (void)state;
  packing_psd *parts[] = {test_mono(1), test_mono(3)};
  const double share[] = {.25, .75};
  packing_psd_mixture_def def;
  packing_psd *mixture = NULL;
  packing_psd_mixture_def_init(&def);
  def.count = 2;
  def.parts = parts;
  def.share = share;
  assert_ok(packing_psd_create_mixture(NULL, &def, &mixture));
  packing_psd_destroy(parts[0]);
  packing_psd_destroy(parts[1]);
  assert_near(limit_of(mixture), limit_of(binary(3, .25)), 1e-12);
  assert_near(limit_of(binary(1 + 1e-9, .5)), limit_of(test_mono(7)), 1e-8);
}

/* A kernel of 10 per cent about one size is the lognormal law of sigma .1, cut at 3 sigma. */
static void smoothed_sample_is_its_kernel(void **state)
{
  (void)state;
  const double r[] = {1, 1, 1};
  packing_psd_sample_def def;
  packing_psd *psd = NULL;
  packing_psd_sample_def_init(&def);
  def.count = 3;
  def.r = r;
  def.bandwidth = .1;
  assert_ok(packing_psd_create_sample(NULL, &def, &psd));
  assert_near(limit_of(psd), fit_of(.1), 5e-4);
}

static void limit_is_refused(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_psd *flat = test_psd(TEST_PSD_UNIFORM, 1, PACKING_BY_NUMBER, 2);
  double limit = 7;
  assert_fails(context, packing_psd_dense_limit(context, flat, &limit),
               PACKING_ERR_UNSUPPORTED, "psd");
  assert_fails(context, packing_psd_dense_limit(context, NULL, &limit),
               PACKING_ERR_INVALID, "psd");
  assert_fails(context, packing_psd_dense_limit(context, flat, NULL), PACKING_ERR_INVALID,
               "volume_fraction");
  assert_true(limit == 7);
  packing_psd_destroy(flat);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equal_spheres_pack_to_6435),
      cmocka_unit_test(lognormal_follows_the_fit),
      cmocka_unit_test(uniform_has_the_known_values),
      cmocka_unit_test(binary_peaks_where_it_should),
      cmocka_unit_test(slow_way_finds_the_same),
      cmocka_unit_test(limit_does_not_depend_on_the_wording),
      cmocka_unit_test(smoothed_sample_is_its_kernel),
      cmocka_unit_test(limit_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
