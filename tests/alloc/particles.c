/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the store fails in turn. */
#include "test.h"

static packing_status grow_the_store(packing_particles *p)
{
  const packing_vec3 c = {0.5, -0.25, 0};
  double x[50], r[50];
  packing_view v;
  for (int i = 0; i < 50; i++) {
    x[i] = i * 2.385;
    r[i] = 1 + i;
  }
  packing_status status = packing_particles_add(p, c, 2.385, NULL);
  if (status == PACKING_OK)
    status = packing_particles_add_user_column(p, "first");
  if (status == PACKING_OK)
    status = packing_particles_add_columns(p, PACKING_COLUMN_VELOCITY);
  if (status == PACKING_OK)
    status = packing_particles_add_user_column(p, "second");
  packing_view_init_arrays(&v, 50, x, x, NULL, r);
  if (status == PACKING_OK)
    status = packing_particles_append(p, &v);
  if (status == PACKING_OK)
    status = packing_particles_reserve(p, 1000);
  return status;
}

static packing_status store(packing_context *context, uint64_t *hash)
{
  packing_particles_def def;
  packing_particles *p = NULL;
  packing_particles_def_init(&def);
  def.columns = PACKING_COLUMN_ID;
  def.capacity = 1;
  packing_status status = packing_particles_create(context, &def, &p);
  if (status != PACKING_OK)
    return status;
  status = grow_the_store(p);
  if (status == PACKING_OK)
    *hash = test_hash_particles(p);
  packing_particles_destroy(p);
  return status;
}

static void store_survives_any_failure(void **state)
{
  (void)state;
  assert_true(test_every_allocation(store) >= 30);
}

/* A failing append leaves numbers and blocks where they were. */
static void failing_growth_keeps_the_view_valid(void **state)
{
  (void)state;
  for (size_t k = 1; k <= 5; k++) {
    test_allocator a = {0};
    packing_context *context = test_allocator_context(&a);
    packing_particles_def def;
    packing_particles *p = NULL;
    packing_view before, after, v;
    const double x[20] = {0},
                 r[20] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    packing_particles_def_init(&def);
    def.capacity = 10;
    assert_ok(packing_particles_create(context, &def, &p));
    packing_view_init_arrays(&v, 10, x, x, x, r);
    assert_ok(packing_particles_append(p, &v));
    packing_particles_view(p, &before);
    a.fail_at = a.requests + k;
    v.count = 20;
    assert_status(packing_particles_append(p, &v), PACKING_ERR_NOMEM);
    packing_particles_view(p, &after);
    assert_memory_equal(&before, &after, sizeof before);
    assert_ok(packing_particles_append(p, &v));
    assert_int_equal(packing_particles_count(p), 30);
    packing_particles_destroy(p);
    packing_context_destroy(context);
    assert_int_equal(a.live, 0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(store_survives_any_failure),
      cmocka_unit_test(failing_growth_keeps_the_view_valid),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
