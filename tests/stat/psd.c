/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is drawn has the law that was asked for. Seeds are fixed, so a failure is a change. */
#include "psds.h"

enum { DRAWS = 100000 };

static int rising(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static packing_rng *stream(uint64_t index)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 2026, PACKING_PURPOSE_SIZE, index, &rng));
  return rng;
}

/* The largest distance of the drawn from the asked distribution, times sqrt(N), on both sides of
 * each jump. */
static double kolmogorov(const packing_psd *psd, double *r, size_t count)
{
  double worst = 0;
  qsort(r, count, sizeof *r, rising);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && r[end] == r[i];)
      end++;
    const double n = (double)count;
    const double upto = packing_psd_cdf(psd, PACKING_BY_NUMBER, r[i]);
    const double below = packing_psd_cdf(psd, PACKING_BY_NUMBER, nextafter(r[i], 0));
    worst = fmax(worst, fabs((double)end / n - upto));
    worst = fmax(worst, fabs((double)i / n - below));
  }
  return worst * sqrt((double)count);
}

/* Kolmogorov and Smirnov: 1.95 is passed by chance once in 1000 tests of a continuous law, more
 * rarely for one with jumps; 26 tests. */
static void draws_follow_the_law(void **state)
{
  (void)state;
  static double r[DRAWS];
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++)
    for (int variant = 0; variant < 2; variant++) {
      packing_psd *psd =
          test_psd(kind, 1, variant == 0 ? PACKING_BY_NUMBER : PACKING_BY_MASS, 3);
      packing_rng *rng = stream((uint64_t)(2 * kind + variant));
      for (size_t i = 0; i < DRAWS; i++) {
        r[i] = packing_psd_draw(psd, rng, NULL);
        assert_true(r[i] >= packing_psd_min_r(psd) && r[i] <= packing_psd_max_r(psd));
      }
      const double distance = kolmogorov(psd, r, DRAWS);
      if (distance >= 1.95)
        fail_msg("%s, variant %d: %g", test_psd_name(kind), variant, distance);
      packing_rng_destroy(rng);
      packing_psd_destroy(psd);
    }
}

/* A mixture in a mixture, of parts that need two numbers themselves: components are those of the
 * outer one. */
static void mixtures_nest(void **state)
{
  (void)state;
  static double r[DRAWS];
  packing_psd *parts[] = {test_psd(TEST_PSD_MIXTURE, 1, PACKING_BY_NUMBER, 3),
                          test_psd(TEST_PSD_SMOOTHED, 3, PACKING_BY_NUMBER, 3)};
  const double share[] = {1, 1};
  packing_psd_mixture_def def;
  packing_psd *psd = NULL;
  packing_psd_mixture_def_init(&def);
  def.count = 2;
  def.parts = parts;
  def.share = share;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_mixture(NULL, &def, &psd));
  packing_rng *rng = stream(3000);
  size_t second = 0;
  for (size_t i = 0; i < DRAWS; i++) {
    size_t component = 9;
    r[i] = packing_psd_draw(psd, rng, &component);
    assert_true(component < 2);
    second += component;
  }
  assert_true(kolmogorov(psd, r, DRAWS) < 1.95);
  assert_near((double)second, DRAWS / 2.0, 5 * sqrt(DRAWS / 4.0));
  packing_rng_destroy(rng);
  packing_psd_destroy(psd);
  packing_psd_destroy(parts[0]);
  packing_psd_destroy(parts[1]);
}

/* Their mean mass within 5 standard errors: false alarm 6e-7 each, 13 tests. */
static void draws_weigh_what_they_should(void **state)
{
  (void)state;
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++) {
    packing_psd *psd = test_psd(kind, 1, PACKING_BY_MASS, 3);
    packing_rng *rng = stream((uint64_t)(1000 + kind));
    const double mean = test_psd_moment(psd, PACKING_BY_NUMBER, 3);
    const double square = test_psd_moment(psd, PACKING_BY_NUMBER, 6);
    double sum = 0;
    for (int i = 0; i < DRAWS; i++)
      sum += pow(packing_psd_draw(psd, rng, NULL), 3);
    const double error = sqrt(fmax(square - mean * mean, 0) / DRAWS);
    assert_near(sum / DRAWS, mean, 5 * error + 1e-11 * mean);
    packing_rng_destroy(rng);
    packing_psd_destroy(psd);
  }
}

/* Parts of a mixture by mass come .6 / <r^3> in number; chi-square with 2 degrees of freedom
 * passes 18.4 with probability 1e-4. Each part's draws lie in its range. */
static void parts_come_in_their_shares(void **state)
{
  (void)state;
  packing_psd *parts[] = {test_uniform(1, 2), test_uniform(2, 3), test_uniform(3.5, 4)};
  const double share[] = {.1, .3, .6};
  packing_psd_mixture_def def;
  packing_psd *psd = NULL;
  packing_psd_mixture_def_init(&def);
  def.count = 3;
  def.parts = parts;
  def.share = share;
  assert_ok(packing_psd_create_mixture(NULL, &def, &psd));
  double number[3], all = 0, chi = 0;
  size_t seen[3] = {0, 0, 0};
  for (size_t i = 0; i < 3; i++)
    all += number[i] = share[i] / test_psd_moment(parts[i], PACKING_BY_NUMBER, 3);
  packing_rng *rng = stream(2000);
  for (int i = 0; i < DRAWS; i++) {
    size_t component = 9;
    const double r = packing_psd_draw(psd, rng, &component);
    assert_true(component < 3);
    assert_true(r >= packing_psd_min_r(parts[component]));
    assert_true(r <= packing_psd_max_r(parts[component]));
    seen[component]++;
  }
  for (size_t i = 0; i < 3; i++) {
    const double expected = DRAWS * number[i] / all;
    chi += pow((double)seen[i] - expected, 2) / expected;
    packing_psd_destroy(parts[i]);
  }
  assert_true(chi < 18.4);
  packing_rng_destroy(rng);
  packing_psd_destroy(psd);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(draws_follow_the_law),
      cmocka_unit_test(mixtures_nest),
      cmocka_unit_test(draws_weigh_what_they_should),
      cmocka_unit_test(parts_come_in_their_shares),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
