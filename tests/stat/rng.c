/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Streams are uniform and independent as far as simple counts can tell. Each limit is 5 standard
 * deviations: false alarm 6e-7 (a little more for chi-square). Seeds are fixed. */
#include "test.h"

enum { DRAWS = 1 << 19, BINS = 256 };

static packing_rng *open_stream(uint64_t seed, uint32_t purpose, uint64_t index)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, seed, purpose, index, &rng));
  return rng;
}

static void assert_flat(const size_t *seen, size_t bins, size_t draws)
{
  const double expected = (double)draws / (double)bins, freedom = (double)bins - 1;
  double chi = 0;
  for (size_t i = 0; i < bins; i++)
    chi += pow((double)seen[i] - expected, 2) / expected;
  assert_near(chi, freedom, 5 * sqrt(2 * freedom));
}

static void every_byte_is_uniform(void **state)
{
  (void)state;
  for (int shift = 0; shift < 64; shift += 8) {
    size_t seen[BINS] = {0};
    packing_rng *rng = open_stream(1, PACKING_PURPOSE_USER, (uint64_t)shift);
    for (int i = 0; i < DRAWS; i++)
      seen[packing_rng_bits(rng) >> shift & 255]++;
    assert_flat(seen, BINS, DRAWS);
    packing_rng_destroy(rng);
  }
}

/* What a placer sees that opens a stream per particle. */
static void first_draws_of_neighbouring_streams_are_uniform(void **state)
{
  (void)state;
  size_t by_index[BINS] = {0}, by_seed[BINS] = {0}, by_purpose[BINS] = {0};
  for (uint32_t i = 0; i < DRAWS / 4; i++) {
    packing_rng *a = open_stream(1, PACKING_PURPOSE_USER, i);
    packing_rng *b = open_stream(i, PACKING_PURPOSE_USER, 0);
    packing_rng *c = open_stream(1, i, 0);
    by_index[packing_rng_below(a, BINS)]++;
    by_seed[packing_rng_below(b, BINS)]++;
    by_purpose[packing_rng_below(c, BINS)]++;
    packing_rng_destroy(a);
    packing_rng_destroy(b);
    packing_rng_destroy(c);
  }
  assert_flat(by_index, BINS, DRAWS / 4);
  assert_flat(by_seed, BINS, DRAWS / 4);
  assert_flat(by_purpose, BINS, DRAWS / 4);
}

/* Pairs of successive draws, and of draws of two streams, over a 16 x 16 board. */
static void pairs_are_uniform(void **state)
{
  (void)state;
  size_t successive[BINS] = {0}, across[BINS] = {0};
  packing_rng *a = open_stream(5, PACKING_PURPOSE_USER, 0);
  packing_rng *b = open_stream(5, PACKING_PURPOSE_USER, 1);
  for (int i = 0; i < DRAWS; i++) {
    const uint64_t x = packing_rng_below(a, 16), y = packing_rng_below(a, 16);
    successive[16 * x + y]++;
    across[16 * y + packing_rng_below(b, 16)]++;
  }
  assert_flat(successive, BINS, DRAWS);
  assert_flat(across, BINS, DRAWS);
  packing_rng_destroy(a);
  packing_rng_destroy(b);
}

/* A bound of 3 2^62: the remainder of a 64-bit draw would give the lower third twice the share
 * of the rest. */
static void below_is_not_biased(void **state)
{
  (void)state;
  size_t thirds[3] = {0, 0, 0}, dice[6] = {0, 0, 0, 0, 0, 0};
  packing_rng *rng = open_stream(6, PACKING_PURPOSE_USER, 0);
  for (int i = 0; i < DRAWS; i++) {
    thirds[packing_rng_below(rng, UINT64_C(3) << 62) >> 62]++;
    dice[packing_rng_below(rng, 6)]++;
  }
  for (size_t i = 0; i < 3; i++)
    assert_near((double)thirds[i], DRAWS / 3.0, 5 * sqrt(DRAWS * 2.0 / 9));
  assert_flat(dice, 6, DRAWS);
  packing_rng_destroy(rng);
}

static void normals_have_their_moments(void **state)
{
  (void)state;
  double sum[5] = {0, 0, 0, 0, 0};
  packing_rng *rng = open_stream(7, PACKING_PURPOSE_USER, 0);
  for (int i = 0; i < DRAWS; i++) {
    const double z = packing_rng_normal(rng);
    double power = 1;
    for (int k = 1; k < 5; k++)
      sum[k] += power *= z;
  }
  assert_near(sum[1] / DRAWS, 0, 5 * sqrt(1.0 / DRAWS));
  assert_near(sum[2] / DRAWS, 1, 5 * sqrt(2.0 / DRAWS));
  assert_near(sum[3] / DRAWS, 0, 5 * sqrt(15.0 / DRAWS));
  assert_near(sum[4] / DRAWS, 3, 5 * sqrt(96.0 / DRAWS));
  packing_rng_destroy(rng);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_byte_is_uniform),
      cmocka_unit_test(first_draws_of_neighbouring_streams_are_uniform),
      cmocka_unit_test(pairs_are_uniform),
      cmocka_unit_test(below_is_not_biased),
      cmocka_unit_test(normals_have_their_moments),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
