/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Status codes, version, context, defs of other ages. */
#include "test.h"

static void statuses_have_distinct_texts(void **state)
{
  (void)state;
  for (int a = 0; a < PACKING_STATUS_END; a++)
    for (int b = 0; b < a; b++)
      assert_string_not_equal(packing_status_string((packing_status)a),
                              packing_status_string((packing_status)b));
  assert_string_equal(packing_status_string((packing_status)99), "unknown status");
}

static void version_is_that_of_the_headers(void **state)
{
  (void)state;
  char text[32];
  snprintf(text, sizeof text, "%d.%d.%d", PACKING_VERSION_MAJOR, PACKING_VERSION_MINOR,
           PACKING_VERSION_PATCH);
  assert_string_equal(packing_version(), text);
}

static void context_refuses_bad_options(void **state)
{
  (void)state;
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.threads = -1;
  assert_status(packing_context_create(&def, &context), PACKING_ERR_RANGE);
  packing_context_def_init(&def);
  def.threads = 1025;
  assert_status(packing_context_create(&def, &context), PACKING_ERR_RANGE);
  packing_context_def_init(&def);
  def.isa = PACKING_ISA_END;
  assert_status(packing_context_create(&def, &context), PACKING_ERR_RANGE);
  packing_context_def_init(&def);
  def.struct_size = 3;
  assert_status(packing_context_create(&def, &context), PACKING_ERR_ABI);
  /* Not initialised: what lies behind must not be read. */
  def.struct_size = SIZE_MAX;
  assert_status(packing_context_create(&def, &context), PACKING_ERR_ABI);
  assert_status(packing_context_create(NULL, NULL), PACKING_ERR_INVALID);
  assert_null(context);
}

static void *no_memory(void *user, size_t size, size_t alignment)
{
  (void)user;
  (void)size;
  (void)alignment;
  return NULL;
}

static void release_nothing(void *user, void *block)
{
  (void)user;
  (void)block;
}

static void context_says_nomem(void **state)
{
  (void)state;
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.allocator.allocate = no_memory;
  assert_status(packing_context_create(&def, &context), PACKING_ERR_INVALID);
  def.allocator.release = release_nothing;
  assert_status(packing_context_create(&def, &context), PACKING_ERR_NOMEM);
}

static void instruction_sets_have_names(void **state)
{
  (void)state;
  for (int isa = 0; isa < PACKING_ISA_END; isa++) {
    packing_context_def def;
    packing_context *context = NULL;
    packing_context_def_init(&def);
    def.isa = (packing_isa)isa;
    assert_string_not_equal(packing_isa_name((packing_isa)isa), "unknown");
    if (!packing_isa_available((packing_isa)isa)) {
      assert_status(packing_context_create(&def, &context), PACKING_ERR_UNSUPPORTED);
      continue;
    }
    assert_ok(packing_context_create(&def, &context));
    const packing_isa used = packing_context_isa(context);
    assert_true(isa == PACKING_ISA_AUTO ? used != PACKING_ISA_AUTO : (int)used == isa);
    packing_context_destroy(context);
  }
  assert_string_equal(packing_isa_name((packing_isa)77), "unknown");
}

/* A caller built when the struct was longer, setting an option we do not have. */
static void newer_caller_is_refused_only_if_it_uses_what_is_new(void **state)
{
  (void)state;
  struct {
    packing_context_def def;
    double of_tomorrow;
  } newer;
  packing_context *context = NULL;
  memset(&newer, 0, sizeof newer);
  packing_context_def_fill(&newer.def, sizeof newer);
  assert_int_equal(newer.def.struct_size, sizeof newer);
  assert_ok(packing_context_create(&newer.def, &context));
  packing_context_destroy(context);
  newer.of_tomorrow = 2.385;
  assert_status(packing_context_create(&newer.def, &context), PACKING_ERR_ABI);
}

static void keep_last_record(void *user, const packing_log_record *record)
{
  packing_log_record *kept = user;
  *kept = *record;
  kept->message = NULL;
}

static void failures_reach_message_and_log(void **state)
{
  (void)state;
  packing_context_def def;
  packing_context *context = NULL;
  packing_log_record last = {0};
  packing_context_def_init(&def);
  def.log = keep_last_record;
  def.log_user = &last;
  assert_ok(packing_context_create(&def, &context));
  assert_string_equal(packing_context_message(context), "");
  packing_file *file = NULL;
  assert_fails(context, packing_file_open(context, "/nonexistent/pack.csv", &file),
               PACKING_ERR_IO, "pack.csv");
  assert_int_equal(last.level, PACKING_LOG_ERROR);
  assert_int_equal(last.status, PACKING_ERR_IO);
  packing_context_destroy(context);
}

static void null_handles_are_fine(void **state)
{
  (void)state;
  packing_context_destroy(NULL);
  packing_domain_destroy(NULL);
  packing_psd_destroy(NULL);
  packing_particles_destroy(NULL);
  packing_placer_destroy(NULL);
  packing_grid_destroy(NULL);
  packing_rng_destroy(NULL);
  packing_file_close(NULL);
  assert_int_equal(packing_context_threads(NULL), 1);
  assert_string_equal(packing_context_message(NULL), "");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(statuses_have_distinct_texts),
      cmocka_unit_test(version_is_that_of_the_headers),
      cmocka_unit_test(context_refuses_bad_options),
      cmocka_unit_test(context_says_nomem),
      cmocka_unit_test(instruction_sets_have_names),
      cmocka_unit_test(newer_caller_is_refused_only_if_it_uses_what_is_new),
      cmocka_unit_test(failures_reach_message_and_log),
      cmocka_unit_test(null_handles_are_fine),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
