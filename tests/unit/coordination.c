/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts with known answers. */
#include "test.h"

enum { MOST = 2100 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
} pack;

static pack *new_pack(void)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  packing_view_init_arrays(&p->view, 0, p->x, p->y, p->z, p->r);
  return p;
}

static void add(pack *p, double x, double y, double z, double r)
{
  const size_t i = p->view.count++;
  p->x[i] = x;
  p->y[i] = y;
  p->z[i] = z;
  p->r[i] = r;
}

static packing_coordination_report measure(const pack *p, packing_domain *domain, int dim,
                                           double tolerance)
{
  packing_coordination_def def;
  packing_coordination_report report;
  packing_coordination_def_init(&def);
  def.dim = dim;
  def.tolerance = tolerance;
  packing_coordination_report_init(&report);
  assert_ok(packing_measure_coordination(NULL, &def, domain, &p->view, &report));
  size_t sum = 0;
  for (int k = 0; k < PACKING_COORDINATION_BINS; k++)
    sum += report.histogram[k];
  assert_int_equal(sum, p->view.count);
  return report;
}

/* Every particle of a crystal has the same number of contacts. */
static void assert_crystal(const packing_coordination_report *r, size_t count,
                           size_t each)
{
  assert_int_equal(r->contacts, count * each / 2);
  assert_int_equal(r->histogram[each], count);
  assert_true(r->mean == (double)each && r->mean_no_rattlers == (double)each);
  assert_int_equal(r->rattlers, 0);
}

static void cubic_crystals_have_6_8_and_12(void **state)
{
  (void)state;
  const double corner[4][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  pack *p = new_pack();
  packing_domain *cell = test_box(8, 8, 8, 7);
  for (int i = 0; i < 512; i++)
    add(p, i % 8, i / 8 % 8, i / 64, 0.5);
  packing_coordination_report r = measure(p, cell, 3, 1e-9);
  assert_crystal(&r, 512, 6);
  p->view.count = 0;
  for (int i = 0; i < 512; i++) {
    add(p, i % 8, i / 8 % 8, i / 64, sqrt(3) / 4);
    add(p, i % 8 + 0.5, i / 8 % 8 + 0.5, i / 64 + 0.5, sqrt(3) / 4);
  }
  r = measure(p, cell, 3, 1e-9);
  assert_crystal(&r, 1024, 8);
  p->view.count = 0;
  for (int i = 0; i < 2048; i++) {
    const double *c = corner[i / 512];
    add(p, i % 8 + c[0], i / 8 % 8 + c[1], i / 64 % 8 + c[2], sqrt(2) / 4);
  }
  r = measure(p, cell, 3, 1e-9);
  assert_crystal(&r, 2048, 12);
  packing_domain_destroy(cell);
  free(p);
}

static void plane_crystals_have_4_and_6(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *square = test_rectangle(6, 6, 3);
  for (int i = 0; i < 36; i++)
    add(p, i % 6, i / 6, 5 * i, 0.5);
  packing_coordination_report r = measure(p, square, 2, 1e-9);
  assert_crystal(&r, 36, 4);
  packing_domain_destroy(square);
  packing_domain *strip = test_rectangle(6, 6 * sqrt(3), 3);
  p->view.count = 0;
  for (int i = 0; i < 36; i++) {
    add(p, i % 6, i / 6 * sqrt(3), 0, 0.5);
    add(p, i % 6 + 0.5, (i / 6 + 0.5) * sqrt(3), 0, 0.5);
  }
  r = measure(p, strip, 2, 1e-9);
  assert_crystal(&r, 72, 6);
  packing_domain_destroy(strip);
  free(p);
}

/* A hole in a cubic crystal, and in it a sphere that hangs on one wall of it. */
static void a_rattler_is_taken_out_with_its_contacts(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(4, 4, 4, 7);
  for (int i = 0; i < 64; i++)
    if (i != 21)
      add(p, i % 4, i / 4 % 4, i / 16, 0.5);
  add(p, 1 - 0.25, 1, 1, 0.25); /* touches the one at (0, 1, 1) */
  const packing_coordination_report r = measure(p, cell, 3, 1e-9);
  assert_int_equal(r.contacts, 63 * 6 / 2 - 3 + 1);
  assert_int_equal(r.rattlers, 1);
  assert_close(r.mean, 2.0 * 187 / 64, 1e-15);
  assert_close(r.mean_no_rattlers, 2.0 * 186 / 63, 1e-15);
  assert_int_equal(r.histogram[1], 1);
  assert_int_equal(r.histogram[5], 5);
  assert_int_equal(r.histogram[6], 58);
  packing_domain_destroy(cell);
  free(p);
}

/* Seven discs hold each other; six do not, but only the two at the gap lack a contact. */
static void removal_goes_on_until_nothing_more_falls(void **state)
{
  (void)state;
  pack *p = new_pack();
  add(p, 0, 0, 0, 0.5);
  for (int k = 0; k < 6; k++)
    add(p, cos(k * acos(0.5)), sin(k * acos(0.5)), 0, 0.5);
  packing_coordination_report r = measure(p, NULL, 2, 1e-9);
  assert_int_equal(r.contacts, 12);
  assert_int_equal(r.rattlers, 0);
  assert_close(r.mean_no_rattlers, 24.0 / 7, 1e-15);
  p->view.count = 6;
  r = measure(p, NULL, 2, 1e-9);
  assert_int_equal(r.contacts, 9);
  assert_int_equal(r.histogram[2], 2);
  assert_int_equal(r.rattlers, 6);
  assert_true(isnan(r.mean_no_rattlers));
  assert_close(r.mean, 3.0, 1e-15);
  p->view.count = 7;
  assert_int_equal(measure(p, NULL, 3, 1e-9).rattlers, 7);
  free(p);
}

static void the_tolerance_is_relative_to_both_radii(void **state)
{
  (void)state;
  pack *p = new_pack();
  add(p, 0, 0, 0, 3);
  add(p, 4.04, 0, 0, 1); /* a gap of 0.01 (r_i + r_j) */
  assert_int_equal(measure(p, NULL, 3, 0.0099).contacts, 0);
  assert_int_equal(measure(p, NULL, 3, 0.0101).contacts, 1);
  assert_int_equal(measure(p, NULL, 3, 0).contacts, 0);
  p->x[1] = 4;
  assert_int_equal(measure(p, NULL, 3, 0).contacts, 1);
  free(p);
}

static void many_contacts_go_to_the_last_bin(void **state)
{
  (void)state;
  pack *p = new_pack();
  const double golden = 3.14159265358979323846 * (3 - sqrt(5));
  add(p, 0, 0, 0, 1);
  for (int k = 0; k < 100; k++) {
    const double z = 1 - (2 * k + 1) / 100.0, s = sqrt(1 - z * z);
    add(p, 1.01 * s * cos(k * golden), 1.01 * s * sin(k * golden), 1.01 * z, 0.01);
  }
  const packing_coordination_report r = measure(p, NULL, 3, 1e-9);
  assert_int_equal(r.contacts, 100);
  assert_int_equal(r.histogram[PACKING_COORDINATION_BINS - 1], 1);
  assert_int_equal(r.histogram[1], 100);
  assert_int_equal(r.rattlers, 101);
  free(p);
}

static void few_particles_are_counted(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_coordination_report r = measure(p, NULL, 3, 1e-9);
  assert_true(r.contacts == 0 && isnan(r.mean) && isnan(r.mean_no_rattlers));
  add(p, 0, 0, 0, 1);
  r = measure(p, NULL, 3, 1e-9);
  assert_true(r.contacts == 0 && r.mean == 0 && r.rattlers == 1 && r.histogram[0] == 1);
  add(p, 2, 0, 0, 1);
  r = measure(p, NULL, 3, 1e-9);
  assert_true(r.contacts == 1 && r.mean == 1 && r.rattlers == 2 && r.histogram[1] == 2);
  free(p);
}

static void coordination_refuses_bad_input(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  pack *p = new_pack();
  packing_coordination_def def;
  packing_coordination_report r;
  add(p, 0, 0, 0, 1);
  packing_coordination_report_init(&r);
  packing_coordination_def_init(&def);
  def.tolerance = -1;
  assert_fails(context, packing_measure_coordination(context, &def, NULL, &p->view, &r),
               PACKING_ERR_RANGE, "tolerance");
  def.tolerance = (double)INFINITY;
  assert_fails(context, packing_measure_coordination(context, &def, NULL, &p->view, &r),
               PACKING_ERR_INVALID, "tolerance");
  packing_coordination_def_init(&def);
  def.dim = 4;
  assert_fails(context, packing_measure_coordination(context, &def, NULL, &p->view, &r),
               PACKING_ERR_RANGE, "dim");
  def.struct_size = 9;
  assert_fails(context, packing_measure_coordination(context, &def, NULL, &p->view, &r),
               PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_measure_coordination(context, NULL, NULL, NULL, &r),
               PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_measure_coordination(context, NULL, NULL, &p->view, NULL),
               PACKING_ERR_INVALID, "report");
  p->r[0] = (double)NAN;
  assert_fails(context, packing_measure_coordination(context, NULL, NULL, &p->view, &r),
               PACKING_ERR_INVALID, "particle 0");
  assert_true(r.mean == 0);
  free(p);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cubic_crystals_have_6_8_and_12),
      cmocka_unit_test(plane_crystals_have_4_and_6),
      cmocka_unit_test(a_rattler_is_taken_out_with_its_contacts),
      cmocka_unit_test(removal_goes_on_until_nothing_more_falls),
      cmocka_unit_test(the_tolerance_is_relative_to_both_radii),
      cmocka_unit_test(many_contacts_go_to_the_last_bin),
      cmocka_unit_test(few_particles_are_counted),
      cmocka_unit_test(coordination_refuses_bad_input),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
