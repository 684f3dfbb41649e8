/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volume fractions with known answers. */
#include "test.h"

static const double pi = 3.14159265358979323846;

enum { MOST = 4096 };

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

static packing_volume_report measure(const pack *p, packing_domain *domain, double margin)
{
  packing_volume_def def;
  packing_volume_report report;
  packing_volume_def_init(&def);
  def.inner_margin = margin;
  packing_volume_report_init(&report);
  assert_ok(packing_measure_volume(NULL, &def, domain, &p->view, &report));
  return report;
}

static void crystals_fill_what_they_must(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(8, 8, 8, 7);
  for (int i = 0; i < 512; i++) /* simple cubic */
    add(p, i % 8, i / 8 % 8, i / 64, 0.5);
  packing_volume_report r = measure(p, cell, 3);
  assert_near(r.volume_fraction, pi / 6, 1e-14);
  assert_near(r.volume_fraction, 0.523598776, 1e-9);
  assert_true(r.inner_fraction == r.volume_fraction && r.inner_volume == r.domain_volume);
  p->view.count = 0;
  for (int i = 0; i < 512; i++) { /* face-centred cubic */
    const double x = i % 8, y = i / 8 % 8, z = i / 64, s = 0.5 / sqrt(2);
    add(p, x, y, z, s);
    add(p, x + 0.5, y + 0.5, z, s);
    add(p, x + 0.5, y, z + 0.5, s);
    add(p, x, y + 0.5, z + 0.5, s);
  }
  r = measure(p, cell, 3);
  assert_near(r.volume_fraction, pi / sqrt(18), 1e-14);
  assert_near(r.volume_fraction, 0.740480490, 1e-9);
  assert_true(r.error >= 0 && r.error < 1e-12);
  packing_domain_destroy(cell);
  free(p);
}

/* The inner region of a cubic array of 10^3 is 7^3 of its cells, shifted by half of one. */
static void the_inner_region_cuts_particles(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(10, 10, 10, 0);
  for (int i = 0; i < 1000; i++)
    add(p, 0.5 + i % 10, 0.5 + i / 10 % 10, 0.5 + i / 100, 0.5);
  packing_volume_report r = measure(p, box, 2);
  assert_near(r.volume_fraction, pi / 6, 1e-14);
  assert_true(r.inner_volume == 512);
  assert_near(r.inner_fraction, pi / 6, 1e-14);
  r = measure(p, box, 3); /* borders through centres */
  assert_true(r.inner_volume == 343);
  assert_near(r.inner_fraction, pi / 6, 1e-9);
  assert_near(r.inner_solid, 343 * pi / 6, 1e-6);
  r = measure(p, box, 0);
  assert_true(r.inner_volume == 1000 && r.inner_fraction == r.volume_fraction);
  packing_domain_destroy(box);
  free(p);
}

static void walls_of_some_axes_bound_the_inner_region(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *slab = test_box(10, 10, 10, PACKING_PERIODIC_X | PACKING_PERIODIC_Y);
  add(p, 0, 0, 5, 0.5);
  const packing_volume_report r = measure(p, slab, 4);
  assert_close(r.inner_volume, 600.0, 1e-14);
  assert_close(r.inner_fraction, pi / 6 / 600, 1e-14);
  packing_domain_destroy(slab);
  free(p);
}

static void an_empty_inner_region_is_no_failure(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  pack *p = new_pack();
  packing_domain *box = test_box(5, 5, 5, 0);
  packing_volume_report r;
  add(p, 2.5, 2.5, 2.5, 1);
  packing_volume_report_init(&r);
  assert_ok(packing_measure_volume(context, NULL, box, &p->view, &r));
  assert_true(r.inner_volume == 0 && r.inner_solid == 0 && isnan(r.inner_fraction));
  assert_close(r.volume_fraction, 4 * pi / 3 / 125, 1e-15);
  assert_string_equal(packing_context_message(context), "");
  packing_context_destroy(context);
  assert_int_equal(a.live, 0);
  packing_domain_destroy(box);
  free(p);
}

static void walls_and_open_tops_cut(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain_box_def def;
  packing_domain *box = NULL;
  packing_domain_box_def_init(&def);
  def.size.x = def.size.y = def.size.z = 1;
  def.open_top = 1;
  assert_ok(packing_domain_create_box(NULL, &def, &box));
  add(p, 0.5, 0.5, 0.995, 0.02);  /* the open top is 0.005 above the centre */
  add(p, 0.5, 0.5, 7, 0.02);      /* above it all */
  add(p, -0.005, 0.5, 0.3, 0.02); /* the wall is 0.005 away, the centre outside */
  add(p, 0.5, -3, 0.3, 0.02);
  const packing_volume_report r = measure(p, box, 3);
  const double above = 2.290744643243e-5, whole = 3.351032163829e-5;
  assert_close(r.solid_volume, whole, 1e-12); /* one part and its complement */
  p->view.count = 1;
  assert_close(measure(p, box, 3).solid_volume, above, 1e-12);
  packing_domain_destroy(box);
  free(p);
}

static void discs_are_cut_too(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *square = test_rectangle(1, 1, 0);
  add(p, 0.5, 0.004, (double)NAN, 0.01);
  const packing_volume_report r = measure(p, square, 3);
  assert_close(r.solid_volume, 2.348919228459e-4, 1e-12);
  assert_true(r.domain_volume == 1);
  packing_domain_destroy(square);
  free(p);
}

static void an_empty_pack_has_fraction_0(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(2, 3, 4, 0);
  const packing_volume_report r = measure(p, box, 3);
  assert_true(r.volume_fraction == 0 && r.solid_volume == 0 && r.domain_volume == 24);
  packing_domain_destroy(box);
  free(p);
}

static void scaling_by_powers_of_two_changes_nothing(void **state)
{
  (void)state;
  double fraction = 0, inner = 0;
  for (int e = 0; e <= 60; e += 20) {
    pack *p = new_pack();
    packing_domain *box = test_box(ldexp(9.7, e), ldexp(9.1, e), ldexp(8.3, e), 1);
    for (int i = 0; i < 700; i++)
      add(p, ldexp(i % 10, e), ldexp(i / 10 % 10, e), ldexp(i / 100, e),
          ldexp(0.3 + i % 7 / 10.0, e));
    const packing_volume_report r = measure(p, box, 2);
    if (e == 0) {
      fraction = r.volume_fraction;
      inner = r.inner_fraction;
    }
    assert_true(r.volume_fraction == fraction && r.inner_fraction == inner && inner > 0);
    packing_domain_destroy(box);
    free(p);
  }
}

static void volume_refuses_bad_input(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  pack *p = new_pack();
  packing_domain *box = test_box(1, 1, 1, 0);
  packing_volume_def def;
  packing_volume_report r;
  add(p, 0.5, 0.5, 0.5, 0.1);
  add(p, 0.5, 0.5, 0.2, 0.1);
  packing_volume_report_init(&r);
  const struct {
    double margin, tolerance;
    packing_status status;
    const char *field;
  } bad[] = {{-1, 1e-9, PACKING_ERR_RANGE, "inner_margin"},
             {(double)NAN, 1e-9, PACKING_ERR_INVALID, "inner_margin"},
             {(double)INFINITY, 1e-9, PACKING_ERR_INVALID, "inner_margin"},
             {3, 0, PACKING_ERR_RANGE, "tolerance"},
             {3, 1, PACKING_ERR_RANGE, "tolerance"},
             {3, (double)NAN, PACKING_ERR_INVALID, "tolerance"}};
  for (size_t b = 0; b < sizeof bad / sizeof bad[0]; b++) {
    packing_volume_def_init(&def);
    def.inner_margin = bad[b].margin;
    def.tolerance = bad[b].tolerance;
    assert_fails(context, packing_measure_volume(context, &def, box, &p->view, &r),
                 bad[b].status, bad[b].field);
  }
  assert_fails(context, packing_measure_volume(context, NULL, NULL, &p->view, &r),
               PACKING_ERR_INVALID, "domain");
  assert_fails(context, packing_measure_volume(context, NULL, box, NULL, &r),
               PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_measure_volume(context, NULL, box, &p->view, NULL),
               PACKING_ERR_INVALID, "report");
  def.struct_size = 0;
  assert_fails(context, packing_measure_volume(context, &def, box, &p->view, &r),
               PACKING_ERR_ABI, "struct_size");
  p->y[1] = (double)NAN;
  assert_fails(context, packing_measure_volume(context, NULL, box, &p->view, &r),
               PACKING_ERR_INVALID, "y: of particle 1");
  p->y[1] = 0.5;
  p->r[1] = -0.1;
  assert_fails(context, packing_measure_volume(context, NULL, box, &p->view, &r),
               PACKING_ERR_RANGE, "particle 1");
  assert_true(r.domain_volume == 0);
  packing_domain_destroy(box);
  free(p);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(crystals_fill_what_they_must),
      cmocka_unit_test(the_inner_region_cuts_particles),
      cmocka_unit_test(walls_of_some_axes_bound_the_inner_region),
      cmocka_unit_test(an_empty_inner_region_is_no_failure),
      cmocka_unit_test(walls_and_open_tops_cut),
      cmocka_unit_test(discs_are_cut_too),
      cmocka_unit_test(an_empty_pack_has_fraction_0),
      cmocka_unit_test(scaling_by_powers_of_two_changes_nothing),
      cmocka_unit_test(volume_refuses_bad_input),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
