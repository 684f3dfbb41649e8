/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public stream. */
#include "test.h"

static packing_rng *open_stream(uint64_t seed, uint32_t purpose, uint64_t index)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, seed, purpose, index, &rng));
  return rng;
}

/* Two streams of one name give the same numbers, whatever is drawn elsewhere in between. */
static void streams_do_not_depend_on_order(void **state)
{
  (void)state;
  uint64_t alone[64];
  packing_rng *a = open_stream(7, PACKING_PURPOSE_USER, 3);
  for (size_t i = 0; i < 64; i++)
    alone[i] = packing_rng_bits(a);
  packing_rng_destroy(a);
  a = open_stream(7, PACKING_PURPOSE_USER, 3);
  packing_rng *b = open_stream(7, PACKING_PURPOSE_USER, 4);
  for (size_t i = 0; i < 64; i++) {
    for (size_t k = 0; k < i % 3; k++)
      (void)packing_rng_bits(b);
    assert_true(packing_rng_bits(a) == alone[i]);
  }
  packing_rng_destroy(a);
  packing_rng_destroy(b);
}

static void first_draws_of_seed_1_never_change(void **state)
{
  (void)state;
  packing_rng *rng = open_stream(1, PACKING_PURPOSE_USER, 0);
  assert_true(packing_rng_bits(rng) == UINT64_C(0x299c322586eeb9a9));
  assert_true(packing_rng_bits(rng) == UINT64_C(0x612abb0fcd75267d));
  assert_true(packing_rng_bits(rng) == UINT64_C(0x0c1a827dec8b0dd0));
  packing_rng_destroy(rng);
}

static void uniforms_lie_on_their_grids(void **state)
{
  (void)state;
  packing_rng *rng = open_stream(1, PACKING_PURPOSE_USER, 0);
  for (int i = 0; i < 100000; i++) {
    const double u = packing_rng_uniform(rng), v = packing_rng_uniform_open(rng);
    assert_true(u >= 0 && u < 1 && u * 0x1p53 == floor(u * 0x1p53));
    assert_true(v > 0 && v < 1 && fmod(v * 0x1p53, 2) == 1);
  }
  packing_rng_destroy(rng);
}

static void below_has_simple_ends(void **state)
{
  (void)state;
  packing_rng *rng = open_stream(1, PACKING_PURPOSE_USER, 0);
  int seen[3] = {0, 0, 0};
  assert_int_equal(packing_rng_below(rng, 0), 0);
  assert_int_equal(packing_rng_below(rng, 1), 0);
  for (int i = 0; i < 100; i++)
    seen[packing_rng_below(rng, 3)] = 1;
  assert_true(seen[0] && seen[1] && seen[2]);
  packing_rng_destroy(rng);
}

static void stream_holds_its_context(void **state)
{
  (void)state;
  test_allocator allocator = {0};
  packing_context *context = test_allocator_context(&allocator);
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(context, 1, 2, 3, &rng));
  packing_context_destroy(context);
  assert_true(allocator.live > 0);
  (void)packing_rng_bits(rng);
  packing_rng_destroy(rng);
  assert_int_equal(allocator.live, 0);
  packing_rng_destroy(NULL);
}

static void stream_is_refused(void **state)
{
  (void)state;
  test_allocator allocator = {0};
  packing_context *context = test_allocator_context(&allocator);
  packing_rng *rng = NULL;
  assert_fails(context, packing_rng_create(context, 1, 2, 3, NULL), PACKING_ERR_INVALID,
               "rng");
  allocator.fail_at = allocator.requests + 1;
  assert_status(packing_rng_create(context, 1, 2, 3, &rng), PACKING_ERR_NOMEM);
  assert_null(rng);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(streams_do_not_depend_on_order),
      cmocka_unit_test(first_draws_of_seed_1_never_change),
      cmocka_unit_test(uniforms_lie_on_their_grids),
      cmocka_unit_test(below_has_simple_ends),
      cmocka_unit_test(stream_holds_its_context),
      cmocka_unit_test(stream_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
