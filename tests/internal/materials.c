/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What materials make of each other in the table that kernels read. */
#include "dem/dem_internal.h"
#include "test.h"

static packing_i_pair_table table;

static size_t add(packing_materials *m, double young, double poisson, double damping,
                  double friction)
{
  packing_material_def def;
  size_t index = 99;
  packing_material_def_init(&def);
  def.density = 1000 * young;
  def.young = young;
  def.poisson = poisson;
  def.damping = damping;
  def.friction = friction;
  assert_ok(packing_materials_add(m, &def, &index));
  return index;
}

static packing_materials *made(void)
{
  packing_materials *m = NULL;
  assert_ok(packing_materials_create(NULL, &m));
  return m;
}

static const packing_pair_material *pair(size_t a, size_t b)
{
  return &table.pair[a * (table.count + 1) + b];
}

static double share(size_t a, size_t b)
{
  return table.share[a * (table.count + 1) + b];
}

/* Equation 8; for two of a kind E / (2 (1 - nu^2)), against a rigid wall twice that. */
static void stiffness_is_that_of_the_paper(void **state)
{
  (void)state;
  packing_materials *m = made();
  assert_int_equal(add(m, 1e8, 0.25, 0.1, 0.2), 0);
  assert_int_equal(add(m, 7e10, 0.3, 0.3, 0.6), 1);
  assert_ok(packing_i_materials_table(NULL, m, &table));
  packing_materials_destroy(m);
  assert_int_equal(table.count, 2);
  assert_close(pair(0, 0)->young, 1e8 / (2 * 0.9375), 1e-15);
  assert_close(pair(0, 2)->young, 1e8 / 0.9375, 1e-15);
  assert_close(pair(1, 2)->young, 7e10 / 0.91, 1e-15);
  assert_close(1 / pair(0, 1)->young, 0.9375 / 1e8 + 0.91 / 7e10, 1e-15);
  assert_memory_equal(pair(0, 1), pair(1, 0), sizeof *pair(0, 1));
  assert_true(table.density[0] == 1e11 && table.density[1] == 7e13);
}

static void overlap_is_shared_by_stiffness(void **state)
{
  (void)state;
  packing_materials *m = made();
  add(m, 1e8, 0.25, 0.1, 0.2);
  add(m, 3e8, 0.25, 0.1, 0.2);
  add(m, 1e8, 0.25, 0.4, 0.5);
  assert_ok(packing_i_materials_table(NULL, m, &table));
  packing_materials_destroy(m);
  assert_true(share(0, 0) == 0.5 && share(1, 1) == 0.5 && share(0, 2) == 0.5);
  assert_close(share(0, 1), 0.75, 1e-15);
  assert_close(share(1, 0), 0.25, 1e-15);
  for (size_t a = 0; a < 3; a++)
    assert_true(share(a, 3) == 1);
}

static void unlike_materials_have_the_mean(void **state)
{
  (void)state;
  packing_materials *m = made();
  add(m, 1e8, 0.25, 0.1, 0.2);
  add(m, 7e10, 0.3, 0.3, 0.6);
  assert_ok(packing_i_materials_table(NULL, m, &table));
  packing_materials_destroy(m);
  assert_true(pair(0, 0)->damping == 0.1 && pair(0, 0)->friction == 0.2);
  assert_close(pair(0, 1)->damping, 0.2, 1e-15);
  assert_close(pair(1, 0)->friction, 0.4, 1e-15);
  assert_true(pair(0, 2)->damping == 0.1 && pair(1, 2)->friction == 0.6);
}

/* Each pair of four materials and the rigid wall, in either order, with numbers of its own. */
static void set_pairs_are_kept_apart(void **state)
{
  (void)state;
  packing_materials *m = made();
  for (int i = 0; i < 4; i++)
    add(m, 1e8, 0.25, 0.1, 0.2);
  for (size_t a = 0; a < 4; a++)
    for (size_t b = 0; b <= a; b++)
      assert_ok(packing_materials_set_pair(m, (a + b) % 2 ? a : b, (a + b) % 2 ? b : a,
                                           10.0 * (double)a + (double)b, 0.5));
  for (size_t a = 0; a < 4; a++)
    if (a % 2)
      assert_ok(packing_materials_set_pair(m, PACKING_MATERIAL_RIGID, a, 7, (double)a));
    else
      assert_ok(packing_materials_set_pair(m, a, PACKING_MATERIAL_RIGID, 7, (double)a));
  assert_ok(packing_materials_set_pair(m, 2, 1, 5, 0)); /* the last word holds */
  assert_ok(packing_i_materials_table(NULL, m, &table));
  for (size_t a = 0; a < 4; a++) {
    for (size_t b = 0; b <= a; b++) {
      const int last = a == 2 && b == 1;
      assert_true(pair(a, b)->damping == (last ? 5 : 10.0 * (double)a + (double)b));
      assert_true(pair(b, a)->damping == pair(a, b)->damping);
      assert_true(pair(b, a)->friction == (last ? 0 : 0.5));
    }
    assert_true(pair(a, 4)->damping == 7 && pair(a, 4)->friction == (double)a);
  }
  packing_materials_destroy(m);
}

static void an_empty_table_is_refused(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_materials *m = made();
  assert_fails(context, packing_i_materials_table(context, m, &table), PACKING_ERR_RANGE,
               "materials");
  packing_materials_destroy(m);
  packing_context_destroy(context);
}

static void extremes_stay_numbers(void **state)
{
  (void)state;
  packing_materials *m = made();
  add(m, 1e-300, 0.5, 1e308, 0);
  add(m, 1e300, -0.999999, 1e308, 1e308);
  assert_ok(packing_i_materials_table(NULL, m, &table));
  packing_materials_destroy(m);
  for (size_t a = 0; a < 2; a++)
    for (size_t b = 0; b < 3; b++) {
      assert_true(isfinite(pair(a, b)->young) && pair(a, b)->young > 0);
      assert_true(isfinite(pair(a, b)->damping) && isfinite(pair(a, b)->friction));
      assert_true(share(a, b) >= 0 && share(a, b) <= 1);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stiffness_is_that_of_the_paper),
      cmocka_unit_test(overlap_is_shared_by_stiffness),
      cmocka_unit_test(unlike_materials_have_the_mean),
      cmocka_unit_test(set_pairs_are_kept_apart),
      cmocka_unit_test(an_empty_table_is_refused),
      cmocka_unit_test(extremes_stay_numbers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
