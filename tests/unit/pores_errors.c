/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What packing_pores_ calls refuse, lists in parts, size distributions, merging. */
#include "test.h"

enum { SIDE = 3, COUNT = SIDE * SIDE * SIDE };

typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
} pack;

static pack *cubic(void)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  for (int i = 0; i < COUNT; i++) {
    p->x[i] = 0.5 + i % SIDE;
    p->y[i] = 0.5 + i / SIDE % SIDE;
    p->z[i] = 0.5 + i / SIDE / SIDE;
    p->r[i] = 0.5;
  }
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
  return p;
}

static void options_are_checked(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 7);
  packing_pores *pores = (packing_pores *)&state;
  packing_pores *const untouched = pores;
  pack *p = cubic();
  packing_pores_def def;
#define REFUSED(set, code, field)                                                        \
  do {                                                                                   \
    packing_pores_def_init(&def);                                                        \
    set;                                                                                 \
    assert_fails(c, packing_pores_create(c, &def, box, &p->view, &pores), code, field);  \
    assert_status(packing_pores_create(NULL, &def, box, &p->view, &pores), code);        \
    assert_ptr_equal(pores, untouched);                                                  \
  } while (0)
  REFUSED(def.dim = 1, PACKING_ERR_RANGE, "dim");
  REFUSED(def.dim = 2, PACKING_ERR_INVALID, "dim");
  REFUSED(def.merge = (packing_pores_merge)2, PACKING_ERR_INVALID, "merge");
  REFUSED(def.overlap = (double)NAN, PACKING_ERR_INVALID, "overlap");
  REFUSED(def.overlap = -0.1, PACKING_ERR_RANGE, "overlap");
  REFUSED(def.overlap = 1.1, PACKING_ERR_RANGE, "overlap");
  REFUSED(def.tolerance = 0, PACKING_ERR_RANGE, "tolerance");
  REFUSED(def.tolerance = (double)INFINITY, PACKING_ERR_INVALID, "tolerance");
  REFUSED(def.tolerance = 0.2, PACKING_ERR_RANGE, "tolerance");
  REFUSED(def.struct_size = 3, PACKING_ERR_ABI, "struct_size");
  REFUSED(p->r[5] = 0, PACKING_ERR_RANGE, "r");
  p->r[5] = 0.5;
  REFUSED(p->z[7] = (double)NAN, PACKING_ERR_INVALID, "z");
  p->z[7] = 0.5;
#undef REFUSED
  assert_fails(c, packing_pores_create(c, NULL, box, NULL, &pores), PACKING_ERR_INVALID,
               "view");
  assert_fails(c, packing_pores_create(c, NULL, box, &p->view, NULL), PACKING_ERR_INVALID,
               "pores");
  packing_domain_destroy(box);
  packing_context_destroy(c);
  free(p);
}

static void queries_are_checked(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_pores *pores = NULL;
  packing_pores_report report;
  packing_pore one;
  packing_constriction way;
  double radius;
  size_t count = 77;
  pack *p = cubic();
  assert_ok(packing_pores_create(c, NULL, NULL, &p->view, &pores));
  memset(&report, 0, sizeof report);
  assert_fails(c, packing_pores_summary(pores, &report), PACKING_ERR_ABI, "struct_size");
  assert_fails(c, packing_pores_summary(pores, NULL), PACKING_ERR_INVALID, "report");
  assert_status(packing_pores_summary(NULL, &report), PACKING_ERR_INVALID);
  assert_fails(c, packing_pores_list(pores, 0, 1, NULL, &count), PACKING_ERR_INVALID,
               "list");
  assert_fails(c, packing_pores_list(pores, 0, 1, &one, NULL), PACKING_ERR_INVALID,
               "count");
  assert_status(packing_pores_list(NULL, 0, 1, &one, &count), PACKING_ERR_INVALID);
  assert_fails(c, packing_pores_constrictions(pores, 0, 1, NULL, &count),
               PACKING_ERR_INVALID, "list");
  assert_fails(c, packing_pores_constrictions(pores, 0, 1, &way, NULL),
               PACKING_ERR_INVALID, "count");
  assert_status(packing_pores_constrictions(NULL, 0, 1, &way, &count),
                PACKING_ERR_INVALID);
  const packing_pores_part part = PACKING_PORES_PORES;
  assert_fails(c,
               packing_pores_sizes(pores, (packing_pores_part)2, PACKING_BY_MASS, 1,
                                   &radius, NULL, &count),
               PACKING_ERR_INVALID, "part");
  assert_fails(c,
               packing_pores_sizes(pores, part, (packing_by)2, 1, &radius, NULL, &count),
               PACKING_ERR_INVALID, "by");
  assert_fails(c,
               packing_pores_sizes(pores, part, PACKING_BY_MASS, 1, NULL, NULL, &count),
               PACKING_ERR_INVALID, "radii");
  assert_fails(c,
               packing_pores_sizes(pores, part, PACKING_BY_MASS, 1, &radius, NULL, NULL),
               PACKING_ERR_INVALID, "count");
  assert_status(
      packing_pores_sizes(NULL, part, PACKING_BY_MASS, 1, &radius, NULL, &count),
      PACKING_ERR_INVALID);
  assert_int_equal(count, 77);
  packing_pores_destroy(pores);
  packing_pores_destroy(NULL);
  packing_context_destroy(c);
  free(p);
}

static void lists_come_in_parts(void **state)
{
  (void)state;
  packing_pores *pores = NULL;
  packing_pore all[8], some[3];
  packing_constriction ways[12], way;
  size_t count;
  pack *p = cubic();
  assert_ok(packing_pores_create(NULL, NULL, NULL, &p->view, &pores));
  assert_ok(packing_pores_list(pores, 0, 8, all, &count));
  assert_int_equal(count, 8);
  assert_ok(packing_pores_list(pores, 6, 3, some, &count));
  assert_int_equal(count, 8);
  for (int i = 0; i < 2; i++)
    assert_true(some[i].centre.x == all[6 + i].centre.x &&
                some[i].particles[3] == all[6 + i].particles[3]);
  assert_ok(packing_pores_list(pores, 100, 3, some, &count));
  assert_ok(packing_pores_constrictions(pores, 0, 12, ways, &count));
  assert_int_equal(count, 12);
  for (size_t i = 0; i < 12; i++) {
    assert_ok(packing_pores_constrictions(pores, i, 1, &way, &count));
    assert_true(way.a == ways[i].a && way.b == ways[i].b);
    assert_true(i == 0 || ways[i - 1].a < way.a ||
                (ways[i - 1].a == way.a && ways[i - 1].b < way.b));
  }
  packing_pores_destroy(pores);
  free(p);
}

/* Pores of FCC: by number 2/3 are tetrahedral, by volume those share 2 t^3 / (2 t^3 + o^3). */
static void sizes_are_shares_by_number_and_volume(void **state)
{
  (void)state;
  const double x[4] = {0, .5, .5, 0}, y[4] = {0, .5, 0, .5}, z[4] = {0, 0, .5, .5};
  const double r[4] = {sqrt(2) / 4, sqrt(2) / 4, sqrt(2) / 4, sqrt(2) / 4};
  const double t = sqrt(1.5) - 1, o = sqrt(2) - 1;
  double radii[12], passing[12], some[8];
  size_t count;
  packing_view view;
  packing_pores *pores = NULL;
  packing_domain *box = test_box(1, 1, 1, 7);
  packing_view_init_arrays(&view, 4, x, y, z, r);
  assert_ok(packing_pores_create(NULL, NULL, box, &view, &pores));
  assert_ok(packing_pores_sizes(pores, PACKING_PORES_PORES, PACKING_BY_NUMBER, 12, radii,
                                passing, &count));
  assert_int_equal(count, 12);
  for (int i = 0; i < 12; i++) {
    assert_close(radii[i], (i < 8 ? t : o) * r[0], 1e-13);
    assert_close(passing[i], (i + 1) / 12.0, 1e-15);
  }
  assert_ok(packing_pores_sizes(pores, PACKING_PORES_PORES, PACKING_BY_MASS, 12, radii,
                                passing, &count));
  assert_close(passing[7], 2 * t * t * t / (2 * t * t * t + o * o * o), 1e-12);
  assert_true(passing[11] == 1);
  assert_ok(packing_pores_sizes(pores, PACKING_PORES_CONSTRICTIONS, PACKING_BY_MASS, 8,
                                some, NULL, &count));
  assert_int_equal(count, 32);
  assert_close(some[7], (2 / sqrt(3) - 1) * r[0], 1e-12);
  packing_pores_destroy(pores);
  packing_domain_destroy(box);
}

/* A row of three holes, the first wider: what overlaps by more than the share joins the largest
 * there is, and no chain goes on from there. */
static void overlapping_pores_merge_into_the_largest(void **state)
{
  (void)state;
  const double at[4] = {0, 1.9, 3.3, 4.7}; /* cross-sections; half-diagonal sqrt 2 */
  double x[16], y[16], z[16], r[16], radius[3];
  packing_view view;
  packing_pore list[3];
  packing_pores_def def;
  size_t count;
  for (int i = 0; i < 16; i++) {
    x[i] = at[i / 4];
    y[i] = i % 2 * 2;
    z[i] = i / 2 % 2 * 2;
    r[i] = 0.25;
  }
  for (int i = 0; i < 3; i++) {
    const double half = (at[i + 1] - at[i]) / 2;
    radius[i] = sqrt(half * half + 2) - 0.25;
  }
  packing_view_init_arrays(&view, 16, x, y, z, r);
  packing_pores_def_init(&def);
  for (int m = 0; m < 4; m++) {
    packing_pores *pores = NULL;
    const double shared = (radius[0] + radius[1] - (at[2] - at[0]) / 2) / (2 * radius[1]);
    def.merge = m == 0 ? PACKING_PORES_MERGE_NONE : PACKING_PORES_MERGE_OVERLAP;
    def.overlap = m == 1 ? shared * 1.001 : m == 2 ? shared * 0.999 : 0;
    assert_ok(packing_pores_create(NULL, &def, NULL, &view, &pores));
    assert_ok(packing_pores_list(pores, 0, 3, list, &count));
    /* the second and third, alike, share more than the first does with either; once the
     * second is the first's, the third does not follow, for it does not reach the first */
    assert_int_equal(count, m == 0 ? 3 : 2);
    const size_t large = list[0].radius > list[1].radius ? 0 : 1;
    assert_close(list[large].radius, radius[0], 1e-13);
    assert_close(list[large].centre.x, 0.95, 1e-13);
    if (m > 0)
      assert_int_equal(list[large].cells > list[1 - large].cells, m > 1);
    if (m > 0)
      assert_near(list[1 - large].centre.x, m == 1 ? 3.3 : 4, 0.71);
    packing_pores_destroy(pores);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(options_are_checked), cmocka_unit_test(queries_are_checked),
      cmocka_unit_test(lists_come_in_parts),
      cmocka_unit_test(sizes_are_shares_by_number_and_volume),
      cmocka_unit_test(overlapping_pores_merge_into_the_largest)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
