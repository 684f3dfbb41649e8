/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws: what is taken, what is refused, names and life. */
#include "test.h"

static void evaluate(void *user, const packing_contact_batch *batch)
{
  (void)user;
  (void)batch;
}

static void count_release(void *user)
{
  ++*(int *)user;
}

/* Each law with the least options that it takes. */
static packing_law_sliding_def sliding_def(void)
{
  packing_law_sliding_def def;
  packing_law_sliding_def_init(&def);
  def.slip_velocity = 1e-3;
  return def;
}

static packing_law_near_field_def near_field_def(void)
{
  packing_law_near_field_def def;
  packing_law_near_field_def_init(&def);
  def.cutoff = 0.1;
  return def;
}

static int releases;

static packing_law_custom_def custom_def(void)
{
  packing_law_custom_def def;
  packing_law_custom_def_init(&def);
  def.evaluate = evaluate;
  def.release = count_release;
  def.user = &releases;
  return def;
}

#define REFUSE(kind, good, member, value, status, field)                                 \
  do {                                                                                   \
    packing_law_##kind##_def bad = (good);                                               \
    bad.member = (value);                                                                \
    assert_fails(context, packing_law_create_##kind(context, &bad, &law), (status),      \
                 (field));                                                               \
    assert_null(law);                                                                    \
  } while (0)

static packing_law_hertz_def hertz_def(void)
{
  packing_law_hertz_def def;
  packing_law_hertz_def_init(&def);
  return def;
}

static void hertz_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_law *law = NULL;
  REFUSE(hertz, hertz_def(), pull, 2, PACKING_ERR_RANGE, "pull");
  REFUSE(hertz, hertz_def(), pull, -1, PACKING_ERR_RANGE, "pull");
  REFUSE(hertz, hertz_def(), struct_size, 3, PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_law_create_hertz(context, NULL, NULL),
               PACKING_ERR_INVALID, "law");
  packing_context_destroy(context);
}

static void sliding_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_law *law = NULL;
  const packing_law_sliding_def good = sliding_def();
  REFUSE(sliding, good, slip_velocity, 0, PACKING_ERR_RANGE, "slip_velocity");
  REFUSE(sliding, good, slip_velocity, -1, PACKING_ERR_RANGE, "slip_velocity");
  REFUSE(sliding, good, slip_velocity, 1e-160, PACKING_ERR_RANGE, "slip_velocity");
  REFUSE(sliding, good, slip_velocity, 1e160, PACKING_ERR_RANGE, "slip_velocity");
  REFUSE(sliding, good, slip_velocity, (double)NAN, PACKING_ERR_INVALID, "slip_velocity");
  REFUSE(sliding, good, slip_velocity, HUGE_VAL, PACKING_ERR_INVALID, "slip_velocity");
  REFUSE(sliding, good, struct_size, 3, PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_law_create_sliding(context, NULL, &law),
               PACKING_ERR_INVALID, "def");
  assert_fails(context, packing_law_create_sliding(context, &good, NULL),
               PACKING_ERR_INVALID, "law");
  packing_context_destroy(context);
}

static void near_field_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_law *law = NULL;
  const packing_law_near_field_def good = near_field_def();
  REFUSE(near_field, good, attraction, (double)NAN, PACKING_ERR_INVALID, "attraction");
  REFUSE(near_field, good, attraction_exponent, HUGE_VAL, PACKING_ERR_INVALID,
         "attraction_exponent");
  REFUSE(near_field, good, repulsion, -HUGE_VAL, PACKING_ERR_INVALID, "repulsion");
  REFUSE(near_field, good, repulsion_exponent, (double)NAN, PACKING_ERR_INVALID,
         "repulsion_exponent");
  REFUSE(near_field, good, cutoff, 0, PACKING_ERR_RANGE, "cutoff");
  REFUSE(near_field, good, cutoff, -1, PACKING_ERR_RANGE, "cutoff");
  REFUSE(near_field, good, cutoff, (double)NAN, PACKING_ERR_INVALID, "cutoff");
  REFUSE(near_field, good, cutoff, HUGE_VAL, PACKING_ERR_INVALID, "cutoff");
  REFUSE(near_field, good, struct_size, 3, PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_law_create_near_field(context, NULL, &law),
               PACKING_ERR_INVALID, "def");
  assert_fails(context, packing_law_create_near_field(context, &good, NULL),
               PACKING_ERR_INVALID, "law");
  packing_context_destroy(context);
}

static void custom_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_law *law = NULL;
  packing_law_custom_def good = custom_def();
  releases = 0;
  REFUSE(custom, good, evaluate, NULL, PACKING_ERR_INVALID, "evaluate");
  REFUSE(custom, good, reach, -1, PACKING_ERR_RANGE, "reach");
  REFUSE(custom, good, reach, (double)NAN, PACKING_ERR_INVALID, "reach");
  REFUSE(custom, good, reach, HUGE_VAL, PACKING_ERR_INVALID, "reach");
  REFUSE(custom, good, history_size, 17, PACKING_ERR_RANGE, "history_size");
  REFUSE(custom, good, history_size, SIZE_MAX, PACKING_ERR_RANGE, "history_size");
  REFUSE(custom, good, history_even, 1, PACKING_ERR_RANGE, "history_even");
  REFUSE(custom, good, struct_size, 3, PACKING_ERR_ABI, "struct_size");
  good.history_size = 16;
  REFUSE(custom, good, reach, 1, PACKING_ERR_INVALID, "history_size");
  REFUSE(custom, good, history_even, 0x10000, PACKING_ERR_RANGE, "history_even");
  assert_fails(context, packing_law_create_custom(context, NULL, &law),
               PACKING_ERR_INVALID, "def");
  assert_fails(context, packing_law_create_custom(context, &good, NULL),
               PACKING_ERR_INVALID, "law");
  assert_int_equal(releases, 0); /* what was never made is not released */
  good.history_even = 0xFFFF;
  assert_ok(packing_law_create_custom(context, &good, &law));
  packing_law_destroy(law);
  assert_int_equal(releases, 1);
  packing_context_destroy(context);
}

static void laws_have_names_and_references(void **state)
{
  (void)state;
  const packing_law_sliding_def sliding = sliding_def();
  const packing_law_near_field_def near_field = near_field_def();
  const packing_law_custom_def custom = custom_def();
  packing_law *laws[4];
  const char *const names[] = {"hertz", "sliding", "near-field", "custom"};
  const char *const equations[] = {"equations 7 to 11", "equations 12 to 15",
                                   "equation 5", "the user's function"};
  assert_ok(packing_law_create_hertz(NULL, NULL, &laws[0]));
  assert_ok(packing_law_create_sliding(NULL, &sliding, &laws[1]));
  assert_ok(packing_law_create_near_field(NULL, &near_field, &laws[2]));
  assert_ok(packing_law_create_custom(NULL, &custom, &laws[3]));
  for (int i = 0; i < 4; i++) {
    assert_string_equal(packing_law_name(laws[i]), names[i]);
    assert_non_null(strstr(packing_law_reference(laws[i]), equations[i]));
    packing_law_destroy(laws[i]);
  }
  packing_law_destroy(NULL);
}

/* A law may be let go after the context that it was made with. */
static void laws_outlive_their_context(void **state)
{
  (void)state;
  test_allocator counting = {0};
  packing_context *context = test_allocator_context(&counting);
  packing_law *law = NULL;
  assert_ok(packing_law_create_hertz(context, NULL, &law));
  packing_context_destroy(context);
  assert_int_equal(counting.live, 1);
  assert_string_equal(packing_law_name(law), "hertz");
  packing_law_destroy(law);
  assert_int_equal(counting.live, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hertz_refuses),
      cmocka_unit_test(sliding_refuses),
      cmocka_unit_test(near_field_refuses),
      cmocka_unit_test(custom_refuses),
      cmocka_unit_test(laws_have_names_and_references),
      cmocka_unit_test(laws_outlive_their_context),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
