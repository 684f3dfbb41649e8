/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of a shape fails once; placing in contact allocates nothing. */
#include "touching.h"

static packing_status make_and_use(packing_context *context, uint64_t *hash)
{
  packing_shape *shape = NULL;
  const packing_status status = test_cluster_create(context, 0.6, 1, &shape);
  if (status != PACKING_OK)
    assert_null(shape);
  else
    *hash = test_hash(*hash, packing_shape_name(shape), 8);
  packing_shape_destroy(shape);
  return status;
}

static void shapes(void **state)
{
  (void)state;
  assert_int_equal(test_every_allocation(make_and_use), 1);
  assert_int_equal(test_clusters_alive(), 0);
}

static void methods(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  packing_shape *shape = NULL;
  uint64_t random = 1;
  assert_ok(test_cluster_create(context, 0.6, 0, &shape));
  const size_t before = a.requests;
  for (int i = 0; i < 20; i++) {
    packing_contact_task task = touching_random(&random, 3, 2, 0.4);
    packing_vec3 centre[2];
    task.mobile.shape = i % 2 ? shape : NULL;
    packing_contact_place(packing_contact_wrappers(), &task, centre);
    packing_contact_place(packing_contact_potential(), &task, centre);
    packing_contact_place(packing_contact_binary(), &task, centre);
    packing_contact_place(packing_contact_direct(), &task, centre);
  }
  assert_int_equal(a.requests, before);
  packing_shape_destroy(shape);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shapes),
      cmocka_unit_test(methods),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
