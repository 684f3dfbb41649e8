/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of libm round differently from one library, and one processor, to the next, so none of
 * them may decide: here they answer nonsense, and counts stay what they are. */
#include "test.h"

double atan2(double y, double x)
{
  (void)y;
  (void)x;
  return (double)NAN;
}

double pow(double x, double y)
{
  (void)x;
  (void)y;
  return (double)NAN;
}

double cbrt(double x)
{
  (void)x;
  return (double)NAN;
}

/* Two discs that touch in each of 36 directions, in the middles of the 36 sectors. */
static void sectors_of_normals_do_not_lean_on_atan2(void **state)
{
  (void)state;
  enum { SECTORS = 36 };
  static double x[2 * SECTORS], y[2 * SECTORS], z[2 * SECTORS], r[2 * SECTORS];
  const double turn = 3.14159265358979323846 / SECTORS;
  packing_contacts_def def;
  packing_contacts *contacts = NULL;
  size_t counts[SECTORS], bins = 0;
  packing_view v;
  for (int k = 0; k < SECTORS; k++) {
    const int i = 2 * k, j = 2 * k + 1;
    x[i] = 4 * k;
    x[j] = x[i] + cos((2 * k + 1) * turn);
    y[j] = sin((2 * k + 1) * turn);
    r[i] = r[j] = 0.5;
  }
  packing_view_init_arrays(&v, 2 * SECTORS, x, y, z, r);
  packing_contacts_def_init(&def);
  def.dim = 2;
  assert_ok(packing_contacts_create(NULL, &def, NULL, &v, &contacts));
  assert_int_equal(packing_contacts_count(contacts), SECTORS);
  assert_ok(packing_contacts_normals(contacts, NULL, counts, SECTORS, &bins));
  assert_int_equal(bins, SECTORS);
  for (int k = 0; k < SECTORS; k++)
    assert_int_equal(counts[k], 2);
  packing_contacts_destroy(contacts);
}

/* 2 N^(2/5), where it is a whole number. */
static void bins_of_sizes_do_not_lean_on_pow(void **state)
{
  (void)state;
  enum { COUNT = 59049 }; /* 9^5 */
  packing_psd_uniform_def law;
  packing_psd *psd = NULL;
  packing_view v;
  packing_size_tests_report report;
  double *r = malloc(COUNT * sizeof *r), at = 0;
  assert_non_null(r);
  packing_psd_uniform_def_init(&law);
  law.min_r = 1;
  law.max_r = 2;
  assert_ok(packing_psd_create_uniform(NULL, &law, &psd));
  for (int i = 0; i < COUNT; i++)
    r[i] = 1 + (i + 0.5) / COUNT;
  packing_view_init_arrays(&v, COUNT, &at, &at, &at, r);
  v.x.stride = v.y.stride = v.z.stride = 0;
  packing_size_tests_report_init(&report);
  assert_ok(packing_measure_size_tests(NULL, NULL, psd, &v, &report));
  assert_int_equal(report.bins, 162);
  packing_psd_destroy(psd);
  free(r);
}

/* An FCC cell: 8 holes between four spheres, 4 between six. */
static void copies_of_a_cell_do_not_lean_on_cbrt(void **state)
{
  (void)state;
  const double x[4] = {0, 0, 1, 1}, y[4] = {0, 1, 0, 1}, z[4] = {0, 1, 1, 0};
  const double touching = sqrt(0.5), r[4] = {touching, touching, touching, touching};
  packing_domain *cell = test_box(2, 2, 2, 7);
  packing_pores *pores = NULL;
  packing_pores_report report;
  packing_view v;
  packing_view_init_arrays(&v, 4, x, y, z, r);
  packing_pores_report_init(&report);
  assert_ok(packing_pores_create(NULL, NULL, cell, &v, &pores));
  assert_ok(packing_pores_summary(pores, &report));
  assert_int_equal(report.pores, 12);
  packing_pores_destroy(pores);
  packing_domain_destroy(cell);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sectors_of_normals_do_not_lean_on_atan2),
      cmocka_unit_test(bins_of_sizes_do_not_lean_on_pow),
      cmocka_unit_test(copies_of_a_cell_do_not_lean_on_cbrt),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
