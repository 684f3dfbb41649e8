/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The generator itself: known answers, the naming of streams, the face shown to GSL. */
#include "test.h"
#include "rng/philox_batch.h"
#include "rng/rng_internal.h"
#include <gsl/gsl_randist.h>

typedef struct known_answer {
  uint32_t counter[4], key[2], out[4];
} known_answer;

/* The vectors of Random123's kat_vectors for philox4x32, 10 rounds. */
static const known_answer known_answers[] = {
    {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
    {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
     {0xffffffff, 0xffffffff},
     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
    {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
     {0xa4093822, 0x299f31d0},
     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
};

static void philox_gives_the_published_answers(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof known_answers / sizeof *known_answers; k++) {
    uint32_t out[4];
    packing_i_philox(known_answers[k].counter, known_answers[k].key, out);
    for (size_t i = 0; i < 4; i++)
      assert_int_equal(out[i], known_answers[k].out[i]);
  }
}

/* The mapping that rng_internal.h documents, step by step. */
static void stream_is_mapped_as_documented(void **state)
{
  (void)state;
  const uint64_t seed = UINT64_C(0x0123456789abcdef),
                 stream = UINT64_C(0xfedcba9876543210);
  const uint64_t index = UINT64_C(0x1122334455667788);
  const uint32_t purpose = 0xcafe;
  packing_i_stream s;
  packing_i_stream_open(&s, seed, stream, purpose, index);
  const uint32_t name[4] = {0x89abcdef, 0x01234567, 0x76543210, 0xfedcba98};
  const uint32_t tag[2] = {purpose, 0x7061636b};
  uint32_t key[4], out[4];
  packing_i_philox(name, tag, key);
  for (uint32_t block = 0; block < 3; block++) {
    const uint32_t counter[4] = {block, 0, 0x55667788, 0x11223344};
    packing_i_philox(counter, key, out);
    assert_true(packing_i_stream_bits(&s) == ((uint64_t)out[1] << 32 | out[0]));
    assert_true(packing_i_stream_bits(&s) == ((uint64_t)out[3] << 32 | out[2]));
  }
}

static int by_value(const void *a, const void *b)
{
  const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
  return (x > y) - (x < y);
}

/* One change of one bit of any part of the name gives another stream: 64 + 64 + 32 + 64
 * neighbours of a name, all different (they collide by chance with probability 1e-15). */
static void every_bit_of_the_name_counts(void **state)
{
  (void)state;
  uint64_t first[225];
  size_t n = 0;
  packing_i_stream s;
  packing_i_stream_open(&s, 1, 2, 3, 4);
  first[n++] = packing_i_stream_bits(&s);
  for (int bit = 0; bit < 64; bit++) {
    const uint64_t flip = UINT64_C(1) << bit;
    packing_i_stream_open(&s, 1 ^ flip, 2, 3, 4);
    first[n++] = packing_i_stream_bits(&s);
    packing_i_stream_open(&s, 1, 2 ^ flip, 3, 4);
    first[n++] = packing_i_stream_bits(&s);
    packing_i_stream_open(&s, 1, 2, 3, 4 ^ flip);
    first[n++] = packing_i_stream_bits(&s);
    if (bit < 32) {
      packing_i_stream_open(&s, 1, 2, 3 ^ (uint32_t)flip, 4);
      first[n++] = packing_i_stream_bits(&s);
    }
  }
  assert_int_equal(n, 225);
  qsort(first, n, sizeof *first, by_value);
  for (size_t i = 1; i < n; i++)
    assert_true(first[i] != first[i - 1]);
}

static void public_stream_is_the_inner_one(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  packing_i_stream s;
  assert_ok(packing_rng_create(NULL, 77, PACKING_PURPOSE_USER, 5, &rng));
  packing_i_stream_open(&s, 77, 0, PACKING_PURPOSE_USER, 5);
  for (int i = 0; i < 9; i++)
    assert_true(packing_rng_bits(rng) == packing_i_stream_bits(&s));
  for (int i = 0; i < 9; i++)
    assert_true(packing_rng_uniform_open(rng) == packing_i_stream_uniform_open(&s));
  for (uint64_t bound = 1; bound < 99; bound += 7)
    assert_true(packing_rng_below(rng, bound) == packing_i_stream_below(&s, bound));
  packing_rng_destroy(rng);
}

static void product_is_exact(void **state)
{
  (void)state;
  const uint64_t all = UINT64_MAX;
  uint64_t low;
  assert_true(packing_i_multiply(all, all, &low) == all - 1 && low == 1);
  assert_true(packing_i_multiply(UINT64_C(1) << 63, 6, &low) == 3 && low == 0);
  /* (2^64 - 2^32 + 1) (2^32 + 1) = 2^96 + 1: a carry through the middle */
  assert_true(packing_i_multiply(UINT64_C(0xffffffff00000001), UINT64_C(0x100000001),
                                 &low) == UINT64_C(0x100000000) &&
              low == 1);
}

static void below_refuses_what_would_bias(void **state)
{
  (void)state;
  const uint64_t bound = (UINT64_C(1) << 63) + 1;
  const int n = 1000;
  packing_i_stream s;
  packing_i_stream_open(&s, 1, 0, PACKING_PURPOSE_USER, 0);
  for (int i = 0; i < n; i++)
    assert_true(packing_i_stream_below(&s, bound) < bound);
  /* Just under half of the values is refused: 2 draws each, and blocks hold 2. The count of
   * draws has sd sqrt(2 n); 6 sd, one-sided twice: false alarm 2e-9. */
  assert_near((double)s.block, n, 6 * sqrt(2.0 * n) / 2);
}

static void gsl_draws_from_the_stream(void **state)
{
  (void)state;
  packing_i_stream s, twin;
  packing_i_stream_open(&s, 3, 0, PACKING_PURPOSE_USER, 0);
  twin = s;
  const gsl_rng rng = packing_i_stream_gsl(&s);
  assert_string_equal(gsl_rng_name(&rng), "philox4x32-10");
  assert_int_equal(gsl_rng_size(&rng), sizeof s);
  assert_true(gsl_rng_max(&rng) == 0xffffffffUL && gsl_rng_min(&rng) == 0);
  assert_true(gsl_rng_get(&rng) == (packing_i_stream_bits(&twin) >> 32));
  assert_true(gsl_rng_uniform(&rng) == packing_i_stream_uniform(&twin));
  gsl_rng_set(&rng, 9);
  packing_i_stream_open(&twin, 9, 0, 0, 0);
  assert_true(gsl_rng_get(&rng) == (packing_i_stream_bits(&twin) >> 32));
}

/* Mean and variance of 1e6 normals, each within 5 sd: false alarm 6e-7 each. */
static void ziggurat_runs_on_the_stream(void **state)
{
  (void)state;
  const int n = 1000000;
  double sum = 0, squares = 0;
  packing_i_stream s;
  packing_i_stream_open(&s, 4, 0, PACKING_PURPOSE_USER, 0);
  const gsl_rng rng = packing_i_stream_gsl(&s);
  for (int i = 0; i < n; i++) {
    const double z = gsl_ran_gaussian_ziggurat(&rng, 1);
    sum += z;
    squares += z * z;
  }
  assert_near(sum / n, 0, 5 / sqrt(n));
  assert_near(squares / n, 1, 5 * sqrt(2.0 / n));
}

/* Each instruction set, across the carry of the counter. */
static void batches_are_the_single_blocks(void **state)
{
  (void)state;
  const uint64_t firsts[] = {0, 5, 0xfffffff9, UINT64_C(0x123456789abcdef0),
                             UINT64_MAX - 3};
  const uint32_t key[2] = {0x9e3779b9, 0xdeadbeef};
  for (int isa = PACKING_ISA_BASELINE; isa < PACKING_ISA_END; isa++) {
    if (!packing_isa_available((packing_isa)isa))
      continue;
    for (size_t f = 0; f < sizeof firsts / sizeof *firsts; f++) {
      const uint64_t index = UINT64_C(0xfedcba9876543210) + f;
      uint32_t word[4][PACKING_I_PHILOX_BATCH];
      packing_i_philox_batch_for((packing_isa)isa)(firsts[f], index, key, word);
      for (unsigned i = 0; i < PACKING_I_PHILOX_BATCH; i++) {
        const uint64_t block = firsts[f] + i;
        const uint32_t counter[4] = {(uint32_t)block, (uint32_t)(block >> 32),
                                     (uint32_t)index, (uint32_t)(index >> 32)};
        uint32_t out[4];
        packing_i_philox(counter, key, out);
        for (unsigned w = 0; w < 4; w++)
          assert_true(word[w][i] == out[w]);
      }
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(philox_gives_the_published_answers),
      cmocka_unit_test(stream_is_mapped_as_documented),
      cmocka_unit_test(every_bit_of_the_name_counts),
      cmocka_unit_test(public_stream_is_the_inner_one),
      cmocka_unit_test(product_is_exact),
      cmocka_unit_test(below_refuses_what_would_bias),
      cmocka_unit_test(gsl_draws_from_the_stream),
      cmocka_unit_test(ziggurat_runs_on_the_stream),
      cmocka_unit_test(batches_are_the_single_blocks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
