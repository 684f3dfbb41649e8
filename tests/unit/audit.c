/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The audit finds exactly what was planted. */
#include "test.h"

enum { SIDE = 5, COUNT = SIDE * SIDE * SIDE };

/* A cubic array of spheres of radius 0.4, 1 apart: nothing touches. */
typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
} pack;

static pack sound_pack(void)
{
  pack p;
  for (int i = 0; i < COUNT; i++) {
    p.x[i] = 0.5 + i % SIDE;
    p.y[i] = 0.5 + i / SIDE % SIDE;
    p.z[i] = 0.5 + i / SIDE / SIDE;
    p.r[i] = 0.4;
  }
  return p;
}

static packing_audit_report audit(pack *p, packing_domain *domain, double limit)
{
  packing_audit_def def;
  packing_audit_report report;
  packing_audit_def_init(&def);
  if (limit >= 0)
    def.limit = limit;
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
  packing_audit_report_init(&report);
  assert_ok(packing_audit(NULL, &def, domain, &p->view, &report));
  return report;
}

static void a_sound_pack_passes(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 0);
  const packing_audit_report r = audit(&p, box, -1);
  assert_int_equal(r.passed, 1);
  assert_true(r.max_overlap == 0 && r.max_protrusion == 0);
  assert_true(r.overlap_i == PACKING_NO_INDEX && r.overlap_j == PACKING_NO_INDEX);
  assert_true(r.protrusion_i == PACKING_NO_INDEX && r.bad_number_i == PACKING_NO_INDEX);
  assert_true(r.overlaps + r.protrusions + r.duplicates + r.bad_numbers == 0);
  packing_domain_destroy(box);
}

static void a_planted_overlap_is_found_exactly(void **state)
{
  (void)state;
  pack p = sound_pack();
  p.x[31] += 0.3; /* towards 32, 0.7 apart */
  p.r[32] = 0.35;
  const double d = p.x[32] - p.x[31];
  const packing_audit_report r = audit(&p, NULL, -1);
  assert_int_equal(r.passed, 0);
  assert_true(r.overlap_i == 31 && r.overlap_j == 32 && r.overlaps == 1);
  assert_true(r.max_overlap == (0.4 + 0.35 - d) / 0.35);
}

static void a_particle_overlaps_its_own_image(void **state)
{
  (void)state;
  const double x = 0.5, r = 0.625;
  packing_view view;
  packing_view_init_arrays(&view, 1, &x, &x, &x, &r);
  for (unsigned periodic = 0; periodic < 8; periodic++) {
    packing_domain *cell = test_box(2, 1, 2, periodic);
    packing_audit_report report;
    packing_audit_report_init(&report);
    assert_ok(packing_audit(NULL, NULL, cell, &view, &report));
    const int meets = (periodic & PACKING_PERIODIC_Y) != 0;
    assert_true(report.max_overlap == (meets ? 0.25 / 0.625 : 0));
    assert_int_equal(report.overlaps, meets);
    assert_true(report.overlap_i == (meets ? 0 : PACKING_NO_INDEX));
    assert_true(report.overlap_j == report.overlap_i);
    packing_domain_destroy(cell);
  }
}

static void of_equal_overlaps_the_lowest_pair_is_named(void **state)
{
  (void)state;
  pack p = sound_pack();
  p.r[100] = p.r[101] = 0.5625;
  p.r[62] = p.r[63] = 0.5625;
  p.r[16] = p.r[21] = 0.5625;
  const packing_audit_report r = audit(&p, NULL, -1);
  assert_true(r.overlap_i == 16 && r.overlap_j == 21);
  assert_int_equal(r.overlaps, 3);
}

static void the_limit_decides(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 0);
  p.r[0] = 0.625; /* overlaps 1, 5 and 25, protrudes by 0.2 r */
  packing_audit_report r = audit(&p, box, 0.2);
  assert_int_equal(r.passed, 1);
  assert_true(r.overlaps == 0 && r.protrusions == 0);
  assert_true(r.max_overlap > 0 && r.max_protrusion == 0.125 / 0.625);
  r = audit(&p, box, 0.19);
  assert_int_equal(r.passed, 0);
  assert_true(r.protrusions == 1 && r.overlaps == 0);
  r = audit(&p, box, 0.06);
  assert_int_equal(r.overlaps, 3);
  packing_domain_destroy(box);
}

static void a_planted_protrusion_is_found_exactly(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 0);
  p.z[7] = 0.25;
  p.z[9] = 0.25;
  p.x[124] = 4.625;
  const packing_audit_report r = audit(&p, box, -1);
  assert_int_equal(r.passed, 0);
  assert_int_equal(r.protrusion_i, 7);
  assert_int_equal(r.protrusions, 3);
  assert_true(r.max_protrusion == (0.4 - 0.25) / 0.4);
  packing_domain_destroy(box);
}

static void a_particle_outside_protrudes_by_more_than_its_size(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 0);
  p.y[60] = -10;
  const packing_audit_report r = audit(&p, box, -1);
  assert_int_equal(r.protrusion_i, 60);
  assert_close(r.max_protrusion, 10.4 / 0.4, 1e-15);
  packing_domain_destroy(box);
}

static void an_open_top_is_no_wall(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain_box_def def;
  packing_domain *open = NULL;
  packing_domain_box_def_init(&def);
  def.size.x = def.size.y = def.size.z = SIDE;
  def.open_top = 1;
  assert_ok(packing_domain_create_box(NULL, &def, &open));
  p.z[124] = 40;
  assert_int_equal(audit(&p, open, -1).passed, 1);
  packing_domain_destroy(open);
}

static void borders_of_a_periodic_cell_are_crossed(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain *cell = test_box(SIDE, SIDE, SIDE, 7);
  assert_int_equal(audit(&p, cell, -1).passed, 1);
  p.x[0] = p.y[0] = p.z[0] = 0.125;
  p.x[124] = p.y[124] = p.z[124] = 4.875;
  packing_audit_report r = audit(&p, cell, -1); /* across the corner */
  assert_true(r.overlap_i == 0 && r.overlap_j == 124 && r.max_protrusion == 0);
  assert_close(r.max_overlap, (0.8 - 0.25 * sqrt(3)) / 0.4, 1e-14);
  p = sound_pack();
  p.x[4] += 0.75; /* 5.25, an image of 0.25: on top of 0 */
  r = audit(&p, cell, -1);
  assert_true(r.overlap_i == 0 && r.overlap_j == 4 && r.overlaps == 1);
  assert_close(r.max_overlap, (0.8 - 0.25) / 0.4, 1e-14);
  assert_int_equal(audit(&p, NULL, -1).passed, 1);
  packing_domain_destroy(cell);
}

static void duplicates_are_counted_in_pairs(void **state)
{
  (void)state;
  pack p = sound_pack();
  p.x[10] = p.x[11] = p.x[12] = 2.5;
  p.y[10] = p.y[11] = p.y[12] = -0.0;
  p.y[11] = 0;
  const packing_audit_report r = audit(&p, NULL, -1);
  assert_int_equal(r.duplicates, 3);
  assert_true(r.max_overlap == 2 && r.overlap_i == 10 && r.overlap_j == 11);
}

static void bad_numbers_are_left_out(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 0);
  p.x[3] = (double)NAN;
  p.y[50] = (double)INFINITY;
  p.z[51] = -(double)INFINITY;
  p.r[52] = (double)NAN;
  p.r[53] = 0;
  p.r[54] = -0.4;
  p.x[31] += 0.3;
  p.z[100] = 4.75;
  const packing_audit_report r = audit(&p, box, -1);
  assert_int_equal(r.passed, 0);
  assert_int_equal(r.bad_numbers, 6);
  assert_int_equal(r.bad_number_i, 3);
  assert_true(r.overlap_i == 31 && r.overlap_j == 32 && r.overlaps == 1);
  assert_true(r.protrusion_i == 100 && r.protrusions == 1);
  packing_domain_destroy(box);
}

static void nothing_but_bad_numbers_fails(void **state)
{
  (void)state;
  pack p = sound_pack();
  for (int i = 0; i < COUNT; i++)
    p.r[i] = 0;
  const packing_audit_report r = audit(&p, NULL, -1);
  assert_int_equal(r.bad_numbers, COUNT);
  assert_int_equal(r.passed, 0);
}

static void the_plane_ignores_z(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain *square = test_rectangle(SIDE * SIDE, SIDE, 0);
  for (int i = 0; i < COUNT; i++) {
    p.x[i] = 0.5 + i / SIDE;
    p.y[i] = 0.5 + i % SIDE;
    p.z[i] = i % 3 == 0 ? (double)NAN : 100.0 * i;
  }
  assert_int_equal(audit(&p, square, -1).passed, 1);
  p.y[17] += 0.5;
  const packing_audit_report r = audit(&p, square, -1);
  assert_true(r.overlap_i == 17 && r.overlap_j == 18 && r.bad_numbers == 0);
  packing_domain_destroy(square);
}

static void an_empty_pack_passes(void **state)
{
  (void)state;
  packing_domain *box = test_box(1, 1, 1, 1);
  packing_audit_report r;
  packing_view v;
  packing_view_init(&v);
  packing_audit_report_init(&r);
  assert_ok(packing_audit(NULL, NULL, box, &v, &r));
  assert_true(r.passed == 1 && r.max_overlap == 0 && r.max_protrusion == 0);
  packing_domain_destroy(box);
}

static void scaling_by_powers_of_two_changes_nothing(void **state)
{
  (void)state;
  pack p = sound_pack();
  p.x[31] += 0.3;
  p.z[100] = 4.75;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, PACKING_PERIODIC_X);
  const packing_audit_report r = audit(&p, box, -1);
  packing_domain_destroy(box);
  for (int e = -60; e <= 60; e += 24) {
    pack q = sound_pack();
    const double edge = ldexp(SIDE, e);
    for (int i = 0; i < COUNT; i++) {
      q.x[i] = ldexp(p.x[i], e);
      q.y[i] = ldexp(p.y[i], e);
      q.z[i] = ldexp(p.z[i], e);
      q.r[i] = ldexp(p.r[i], e);
    }
    box = test_box(edge, edge, edge, PACKING_PERIODIC_X);
    const packing_audit_report s = audit(&q, box, -1);
    assert_memory_equal(&r, &s, sizeof r);
    packing_domain_destroy(box);
  }
}

static double fails_beyond_2(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  if (normal != NULL)
    normal->x = normal->y = normal->z = 0;
  return point->x > 2 ? (double)NAN : 10.0;
}

static void a_container_that_answers_nan_holds_nothing(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_domain_custom_def def;
  packing_domain *custom = NULL;
  packing_domain_custom_def_init(&def);
  def.signed_distance = fails_beyond_2;
  def.bounds.hi.x = def.bounds.hi.y = def.bounds.hi.z = 2;
  def.volume = 8;
  assert_ok(packing_domain_create_custom(NULL, &def, &custom));
  const packing_audit_report r = audit(&p, custom, -1);
  assert_int_equal(r.passed, 0);
  assert_int_equal(r.protrusions, COUNT * 3 / 5);
  assert_int_equal(r.protrusion_i, 2);
  assert_true(r.max_protrusion == (double)INFINITY);
  packing_domain_destroy(custom);
}

static void audit_refuses_bad_input(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  pack p = sound_pack();
  packing_audit_def def;
  packing_audit_report report;
  packing_audit_report_init(&report);
  report.overlaps = 77;
  packing_audit_def_init(&def);
  packing_view_init_arrays(&p.view, COUNT, p.x, p.y, p.z, p.r);
  def.limit = (double)NAN;
  assert_fails(context, packing_audit(context, &def, NULL, &p.view, &report),
               PACKING_ERR_INVALID, "limit");
  def.limit = -1e-9;
  assert_fails(context, packing_audit(context, &def, NULL, &p.view, &report),
               PACKING_ERR_RANGE, "limit");
  def.struct_size = 1;
  assert_fails(context, packing_audit(context, &def, NULL, &p.view, &report),
               PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_audit(context, NULL, NULL, NULL, &report),
               PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_audit(context, NULL, NULL, &p.view, NULL),
               PACKING_ERR_INVALID, "report");
  p.x[5] = 1e200;
  assert_fails(context, packing_audit(context, NULL, NULL, &p.view, &report),
               PACKING_ERR_RANGE, "particle 5");
  assert_int_equal(report.overlaps, 77);
  packing_context_destroy(context);
}

/* A caller whose report ends after max_overlap gets no more than that. */
static void an_older_report_is_filled_as_far_as_it_goes(void **state)
{
  (void)state;
  pack p = sound_pack();
  packing_audit_report report;
  memset(&report, 0x5a, sizeof report);
  report.struct_size = offsetof(packing_audit_report, overlap_i);
  packing_view_init_arrays(&p.view, COUNT, p.x, p.y, p.z, p.r);
  assert_ok(packing_audit(NULL, NULL, NULL, &p.view, &report));
  assert_true(report.passed == 1 && report.max_overlap == 0);
  assert_true(report.overlap_i != PACKING_NO_INDEX);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_sound_pack_passes),
      cmocka_unit_test(a_planted_overlap_is_found_exactly),
      cmocka_unit_test(a_particle_overlaps_its_own_image),
      cmocka_unit_test(of_equal_overlaps_the_lowest_pair_is_named),
      cmocka_unit_test(the_limit_decides),
      cmocka_unit_test(a_planted_protrusion_is_found_exactly),
      cmocka_unit_test(a_particle_outside_protrudes_by_more_than_its_size),
      cmocka_unit_test(an_open_top_is_no_wall),
      cmocka_unit_test(borders_of_a_periodic_cell_are_crossed),
      cmocka_unit_test(duplicates_are_counted_in_pairs),
      cmocka_unit_test(bad_numbers_are_left_out),
      cmocka_unit_test(nothing_but_bad_numbers_fails),
      cmocka_unit_test(the_plane_ignores_z),
      cmocka_unit_test(an_empty_pack_passes),
      cmocka_unit_test(scaling_by_powers_of_two_changes_nothing),
      cmocka_unit_test(a_container_that_answers_nan_holds_nothing),
      cmocka_unit_test(audit_refuses_bad_input),
      cmocka_unit_test(an_older_report_is_filled_as_far_as_it_goes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
