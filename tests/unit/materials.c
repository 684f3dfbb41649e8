/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of materials: what is taken and what is refused. */
#include "test.h"

static packing_material_def glass(void)
{
  packing_material_def def;
  packing_material_def_init(&def);
  def.density = 2500;
  def.young = 7e10;
  return def;
}

static void defaults_are_those_of_the_paper(void **state)
{
  (void)state;
  packing_material_def def;
  packing_material_def_init(&def);
  assert_int_equal(def.struct_size, sizeof def);
  assert_true(def.density == 0 && def.young == 0);
  assert_true(def.poisson == 0.25 && def.damping == 0.1 && def.friction == 0.2);
}

#define REFUSE(member, value, status, field)                                             \
  do {                                                                                   \
    packing_material_def bad = glass();                                                  \
    bad.member = (value);                                                                \
    assert_fails(context, packing_materials_add(materials, &bad, &index), (status),      \
                 (field));                                                               \
    assert_int_equal(index, 77);                                                         \
  } while (0)

#define REFUSE_POSITIVE(member)                                                          \
  do {                                                                                   \
    REFUSE(member, (double)NAN, PACKING_ERR_INVALID, #member);                           \
    REFUSE(member, HUGE_VAL, PACKING_ERR_INVALID, #member);                              \
    REFUSE(member, 0, PACKING_ERR_RANGE, #member);                                       \
    REFUSE(member, -1, PACKING_ERR_RANGE, #member);                                      \
  } while (0)

#define REFUSE_NEGATIVE(member)                                                          \
  do {                                                                                   \
    REFUSE(member, (double)NAN, PACKING_ERR_INVALID, #member);                           \
    REFUSE(member, HUGE_VAL, PACKING_ERR_INVALID, #member);                              \
    REFUSE(member, -1e-300, PACKING_ERR_RANGE, #member);                                 \
  } while (0)

static void bad_materials_are_refused(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_materials *materials = NULL;
  size_t index = 77;
  assert_fails(context, packing_materials_create(context, NULL), PACKING_ERR_INVALID,
               "materials");
  assert_ok(packing_materials_create(context, &materials));
  REFUSE_POSITIVE(density);
  REFUSE_POSITIVE(young);
  REFUSE(young, 1e-308, PACKING_ERR_RANGE, "young");
  REFUSE(young, 1e308, PACKING_ERR_RANGE, "young");
  REFUSE(poisson, (double)NAN, PACKING_ERR_INVALID, "poisson");
  REFUSE(poisson, -HUGE_VAL, PACKING_ERR_INVALID, "poisson");
  REFUSE(poisson, -1, PACKING_ERR_RANGE, "poisson");
  REFUSE(poisson, nextafter(0.5, 1), PACKING_ERR_RANGE, "poisson");
  REFUSE_NEGATIVE(damping);
  REFUSE_NEGATIVE(friction);
  REFUSE(struct_size, 3, PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_materials_add(materials, NULL, &index),
               PACKING_ERR_INVALID, "def");
  const packing_material_def def = glass();
  assert_status(packing_materials_add(NULL, &def, &index), PACKING_ERR_INVALID);
  assert_ok(packing_materials_add(materials, &def, NULL));
  packing_materials_destroy(materials);
  packing_materials_destroy(NULL);
  packing_context_destroy(context);
}

static void a_table_takes_64(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_materials *materials = NULL;
  const packing_material_def def = glass();
  size_t index = 77;
  assert_ok(packing_materials_create(context, &materials));
  for (size_t i = 0; i < 64; i++) {
    assert_ok(packing_materials_add(materials, &def, &index));
    assert_int_equal(index, i);
  }
  assert_fails(context, packing_materials_add(materials, &def, &index), PACKING_ERR_RANGE,
               "materials");
  assert_int_equal(index, 63);
  assert_ok(packing_materials_set_pair(materials, 63, 63, 0, 0));
  assert_ok(packing_materials_set_pair(materials, 63, PACKING_MATERIAL_RIGID, 0, 0));
  packing_materials_destroy(materials);
  packing_context_destroy(context);
}

static void bad_pairs_are_refused(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_materials *m = NULL;
  const packing_material_def def = glass();
  const size_t rigid = PACKING_MATERIAL_RIGID;
  assert_ok(packing_materials_create(context, &m));
  assert_ok(packing_materials_add(m, &def, NULL));
  packing_context_destroy(context); /* the table keeps it */
  assert_fails(context, packing_materials_set_pair(m, 1, 0, 0, 0), PACKING_ERR_RANGE,
               "a");
  assert_fails(context, packing_materials_set_pair(m, 0, 1, 0, 0), PACKING_ERR_RANGE,
               "b");
  assert_fails(context, packing_materials_set_pair(m, rigid, rigid, 0, 0),
               PACKING_ERR_INVALID, "b");
  assert_fails(context, packing_materials_set_pair(m, 0, 0, -1, 0), PACKING_ERR_RANGE,
               "damping");
  assert_fails(context, packing_materials_set_pair(m, 0, rigid, (double)NAN, 0),
               PACKING_ERR_INVALID, "damping");
  assert_fails(context, packing_materials_set_pair(m, 0, 0, 0, -1), PACKING_ERR_RANGE,
               "friction");
  assert_fails(context, packing_materials_set_pair(m, rigid, 0, 0, HUGE_VAL),
               PACKING_ERR_INVALID, "friction");
  assert_status(packing_materials_set_pair(NULL, 0, 0, 0, 0), PACKING_ERR_INVALID);
  assert_ok(packing_materials_set_pair(m, 0, 0, 0, 0));
  packing_materials_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_paper),
      cmocka_unit_test(bad_materials_are_refused),
      cmocka_unit_test(a_table_takes_64),
      cmocka_unit_test(bad_pairs_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
