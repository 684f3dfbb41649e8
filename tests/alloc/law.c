/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of laws and materials fails once. */
#include "test.h"

static void evaluate(void *user, const packing_contact_batch *batch)
{
  (void)user;
  (void)batch;
}

static int made_custom, released;

static void release(void *user)
{
  (void)user;
  released++;
}

static packing_status make_custom(packing_context *context, packing_law **law)
{
  packing_law_custom_def def;
  packing_law_custom_def_init(&def);
  def.evaluate = evaluate;
  def.release = release;
  const packing_status status = packing_law_create_custom(context, &def, law);
  made_custom += status == PACKING_OK;
  return status;
}

static packing_status make_laws(packing_context *context, packing_law *laws[4])
{
  packing_law_sliding_def sliding;
  packing_law_near_field_def near_field;
  packing_law_sliding_def_init(&sliding);
  packing_law_near_field_def_init(&near_field);
  sliding.slip_velocity = 1e-3;
  near_field.cutoff = 0.1;
  packing_status status = packing_law_create_hertz(context, NULL, &laws[0]);
  if (status == PACKING_OK)
    status = packing_law_create_sliding(context, &sliding, &laws[1]);
  if (status == PACKING_OK)
    status = packing_law_create_near_field(context, &near_field, &laws[2]);
  if (status == PACKING_OK)
    status = make_custom(context, &laws[3]);
  return status;
}

static packing_status make_materials(packing_context *context, size_t *index)
{
  packing_materials *materials = NULL;
  packing_material_def def;
  packing_material_def_init(&def);
  def.density = 1000;
  def.young = 1e8;
  packing_status status = packing_materials_create(context, &materials);
  for (int i = 0; i < 3 && status == PACKING_OK; i++)
    status = packing_materials_add(materials, &def, index);
  if (status == PACKING_OK)
    status = packing_materials_set_pair(materials, 0, 2, 0.3, 0.4);
  packing_materials_destroy(materials);
  return status;
}

static packing_status scenario(packing_context *context, uint64_t *hash)
{
  packing_law *laws[4] = {NULL, NULL, NULL, NULL};
  size_t index = 0;
  packing_status status = make_laws(context, laws);
  if (status == PACKING_OK)
    status = make_materials(context, &index);
  uint64_t h = test_hash(TEST_HASH_START, &index, sizeof index);
  for (int i = 0; i < 4; i++) {
    if (status == PACKING_OK)
      h = test_hash(h, packing_law_name(laws[i]), 4);
    packing_law_destroy(laws[i]);
  }
  if (status == PACKING_OK)
    *hash = h;
  return status;
}

static void every_allocation_may_fail(void **state)
{
  (void)state;
  assert_int_equal(test_every_allocation(scenario), 5);
  assert_true(made_custom > 0);
  assert_int_equal(released, made_custom);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
