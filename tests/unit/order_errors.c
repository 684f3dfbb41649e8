/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the measures of order refuse. */
#include "test.h"

static double x[3] = {1, 2, 3}, y[3] = {1, 1, 1}, z[3] = {1, 1, 1},
              r[3] = {0.5, 0.5, 0.5};

static packing_view three(void)
{
  packing_view v;
  packing_view_init_arrays(&v, 3, x, y, z, r);
  return v;
}

static packing_neighbours *neighbours(packing_context *context, int dim, int kind)
{
  packing_neighbours_def def;
  packing_neighbours *n = NULL;
  const packing_view v = three();
  packing_neighbours_def_init(&def);
  def.dim = dim;
  def.kind = (packing_neighbours_kind)kind;
  assert_ok(packing_neighbours_create(context, &def, NULL, &v, &n));
  return n;
}

static void refuse_rdf(packing_context *context, const packing_rdf_def *def,
                       packing_status status, const char *field)
{
  const packing_view v = three();
  packing_rdf_bin bins[100];
  packing_rdf_report report;
  packing_domain *box = test_box(4, 4, 4, 7);
  memset(bins, 0x55, sizeof bins);
  packing_rdf_report_init(&report);
  const packing_rdf_report before = report;
  assert_fails(context, packing_measure_rdf(context, def, box, &v, bins, 100, &report),
               status, field);
  assert_memory_equal(&report, &before, sizeof report);
  for (size_t k = 0; k < sizeof bins; k++)
    assert_int_equal(((unsigned char *)bins)[k], 0x55);
  packing_domain_destroy(box);
}

static void rdf_refuses_bad_options(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  const struct {
    double r_max;
    packing_status status;
  } reaches[] = {{0, PACKING_ERR_RANGE},
                 {-1, PACKING_ERR_RANGE},
                 {(double)NAN, PACKING_ERR_INVALID},
                 {(double)INFINITY, PACKING_ERR_INVALID},
                 {1e-200, PACKING_ERR_RANGE},
                 {1e200, PACKING_ERR_RANGE},
                 {4e6, PACKING_ERR_RANGE}}; /* too many periods */
  packing_rdf_def def;
  for (size_t k = 0; k < sizeof reaches / sizeof reaches[0]; k++) {
    packing_rdf_def_init(&def);
    def.r_max = reaches[k].r_max;
    refuse_rdf(context, &def, reaches[k].status, "r_max");
  }
  packing_rdf_def_init(&def);
  def.bins = 0;
  refuse_rdf(context, &def, PACKING_ERR_RANGE, "bins");
  def.bins = SIZE_MAX;
  refuse_rdf(context, &def, PACKING_ERR_RANGE, "bins");
  packing_rdf_def_init(&def);
  def.in_diameters = 2;
  refuse_rdf(context, &def, PACKING_ERR_RANGE, "in_diameters");
  packing_rdf_def_init(&def);
  def.margin = -0.5;
  refuse_rdf(context, &def, PACKING_ERR_RANGE, "margin");
  def.margin = (double)NAN;
  refuse_rdf(context, &def, PACKING_ERR_INVALID, "margin");
  packing_rdf_def_init(&def);
  def.by = (packing_rdf_by)3;
  refuse_rdf(context, &def, PACKING_ERR_RANGE, "by");
  def.by = PACKING_RDF_COMPONENT;
  refuse_rdf(context, &def, PACKING_ERR_INVALID, "component");
  packing_rdf_def_init(&def);
  def.struct_size = 9;
  refuse_rdf(context, &def, PACKING_ERR_ABI, "struct_size");
  packing_context_destroy(context);
}

static void rdf_refuses_bad_arguments(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_view v = three();
  packing_rdf_report report;
  packing_rdf_bin bin;
  packing_domain *box = test_box(4, 4, 4, 7);
  packing_rdf_report_init(&report);
  assert_fails(context, packing_measure_rdf(context, NULL, NULL, &v, NULL, 0, &report),
               PACKING_ERR_INVALID, "domain");
  assert_fails(context, packing_measure_rdf(context, NULL, box, NULL, NULL, 0, &report),
               PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_measure_rdf(context, NULL, box, &v, NULL, 1, &report),
               PACKING_ERR_INVALID, "bins");
  assert_fails(context, packing_measure_rdf(context, NULL, box, &v, &bin, 1, NULL),
               PACKING_ERR_INVALID, "report");
  report.struct_size = 0;
  assert_fails(context, packing_measure_rdf(context, NULL, box, &v, &bin, 1, &report),
               PACKING_ERR_ABI, "struct_size");
  packing_rdf_report_init(&report);
  r[1] = 0;
  assert_fails(context, packing_measure_rdf(context, NULL, box, &v, NULL, 0, &report),
               PACKING_ERR_RANGE, "r");
  r[1] = 0.5;
  x[2] = (double)NAN;
  assert_fails(context, packing_measure_rdf(context, NULL, box, &v, NULL, 0, &report),
               PACKING_ERR_INVALID, "x");
  x[2] = 3;
  assert_status(packing_measure_rdf(NULL, NULL, NULL, &v, NULL, 0, &report),
                PACKING_ERR_INVALID);
  packing_domain_destroy(box);
  packing_context_destroy(context);
}

static void refuse_neighbours(packing_context *context, const packing_neighbours_def *def,
                              packing_status status, const char *field)
{
  const packing_view v = three();
  packing_neighbours *n = NULL;
  assert_fails(context, packing_neighbours_create(context, def, NULL, &v, &n), status,
               field);
  assert_null(n);
}

static void neighbours_refuse_bad_options(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_neighbours_def def;
  packing_neighbours_def_init(&def);
  def.kind = (packing_neighbours_kind)2;
  refuse_neighbours(context, &def, PACKING_ERR_RANGE, "kind");
  packing_neighbours_def_init(&def);
  def.factor = 0;
  refuse_neighbours(context, &def, PACKING_ERR_RANGE, "factor");
  def.factor = (double)INFINITY;
  refuse_neighbours(context, &def, PACKING_ERR_INVALID, "factor");
  packing_neighbours_def_init(&def);
  def.gap = -1;
  refuse_neighbours(context, &def, PACKING_ERR_RANGE, "gap");
  packing_neighbours_def_init(&def);
  def.nearest = 0;
  refuse_neighbours(context, &def, PACKING_ERR_RANGE, "nearest");
  def.nearest = 257;
  refuse_neighbours(context, &def, PACKING_ERR_RANGE, "nearest");
  packing_neighbours_def_init(&def);
  def.margin = -1;
  refuse_neighbours(context, &def, PACKING_ERR_RANGE, "margin");
  def.margin = 1; /* of no container */
  refuse_neighbours(context, &def, PACKING_ERR_INVALID, "margin");
  packing_neighbours_def_init(&def);
  def.dim = 1;
  refuse_neighbours(context, &def, PACKING_ERR_RANGE, "dim");
  packing_neighbours_def_init(&def);
  def.struct_size = 9;
  refuse_neighbours(context, &def, PACKING_ERR_ABI, "struct_size");
  r[2] = -1;
  refuse_neighbours(context, NULL, PACKING_ERR_RANGE, "r");
  r[2] = 1e-200; /* its square is no number */
  refuse_neighbours(context, NULL, PACKING_ERR_RANGE, "r");
  r[2] = 0.5;
  packing_context_destroy(context);
}

static void neighbours_refuse_bad_arguments(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  const packing_view v = three();
  packing_neighbours *n = NULL;
  packing_neighbour one;
  size_t count = 77;
  assert_fails(context, packing_neighbours_create(context, NULL, NULL, NULL, &n),
               PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_neighbours_create(context, NULL, NULL, &v, NULL),
               PACKING_ERR_INVALID, "neighbours");
  n = neighbours(context, 3, 0);
  assert_fails(context, packing_neighbours_of(n, 3, NULL, 0, &count), PACKING_ERR_RANGE,
               "i");
  assert_fails(context, packing_neighbours_of(n, 0, NULL, 1, &count), PACKING_ERR_INVALID,
               "list");
  assert_int_equal(count, 77);
  assert_fails(context, packing_neighbours_of(n, 0, &one, 1, NULL), PACKING_ERR_INVALID,
               "count");
  assert_status(packing_neighbours_of(NULL, 0, &one, 1, &count), PACKING_ERR_INVALID);
  packing_neighbours_destroy(n);
  packing_neighbours_destroy(NULL);
  packing_context_destroy(context);
}

static void bond_order_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_neighbours *n = neighbours(context, 3, 0);
  packing_bond_order_def def;
  packing_bond_order_report report;
  packing_bond_order local = {7, 7, 7};
  const int bad[] = {0, 1, 5, 13, 14, -2};
  packing_bond_order_def_init(&def);
  packing_bond_order_report_init(&report);
  for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
    def.l = bad[k];
    assert_fails(context,
                 packing_measure_bond_order(context, &def, n, &local, 1, &report),
                 PACKING_ERR_RANGE, "l");
  }
  packing_bond_order_def_init(&def);
  assert_fails(context, packing_measure_bond_order(context, &def, NULL, NULL, 0, &report),
               PACKING_ERR_INVALID, "neighbours");
  assert_fails(context, packing_measure_bond_order(context, &def, n, NULL, 1, &report),
               PACKING_ERR_INVALID, "local");
  assert_fails(context, packing_measure_bond_order(context, &def, n, &local, 1, NULL),
               PACKING_ERR_INVALID, "report");
  report.struct_size = 1;
  assert_fails(context, packing_measure_bond_order(context, &def, n, &local, 1, &report),
               PACKING_ERR_ABI, "struct_size");
  def.struct_size = 9;
  assert_fails(context, packing_measure_bond_order(context, &def, n, &local, 1, &report),
               PACKING_ERR_ABI, "struct_size");
  assert_true(local.q == 7 && local.averaged == 7 && local.w == 7);
  packing_neighbours_destroy(n);
  packing_context_destroy(context);
}

static void hexatic_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_neighbours *flat = neighbours(context, 2, 0), *n = neighbours(context, 3, 0);
  packing_hexatic_def def;
  packing_hexatic_report report;
  packing_hexatic local = {7, 7, 7, 7};
  packing_hexatic_def_init(&def);
  packing_hexatic_report_init(&report);
  for (int k = 0; k < 2; k++) {
    def.fold = k == 0 ? 1 : 13;
    assert_fails(context,
                 packing_measure_hexatic(context, &def, flat, &local, 1, &report),
                 PACKING_ERR_RANGE, "fold");
  }
  packing_hexatic_def_init(&def);
  assert_fails(context, packing_measure_hexatic(context, &def, NULL, NULL, 0, &report),
               PACKING_ERR_INVALID, "neighbours");
  assert_fails(context, packing_measure_hexatic(context, &def, n, NULL, 0, &report),
               PACKING_ERR_INVALID, "neighbours");
  assert_fails(context, packing_measure_hexatic(context, &def, flat, NULL, 1, &report),
               PACKING_ERR_INVALID, "local");
  assert_fails(context, packing_measure_hexatic(context, &def, flat, &local, 1, NULL),
               PACKING_ERR_INVALID, "report");
  report.struct_size = 0;
  assert_fails(context, packing_measure_hexatic(context, &def, flat, &local, 1, &report),
               PACKING_ERR_ABI, "struct_size");
  def.struct_size = 9;
  assert_fails(context, packing_measure_hexatic(context, &def, flat, &local, 1, &report),
               PACKING_ERR_ABI, "struct_size");
  assert_true(local.re == 7 && local.neighbours == 7);
  packing_neighbours_destroy(n);
  packing_neighbours_destroy(flat);
  packing_context_destroy(context);
}

static void common_neighbours_refuse(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_neighbours *flat = neighbours(context, 2, 0), *n = neighbours(context, 3, 0);
  packing_neighbours *near = neighbours(context, 3, PACKING_NEIGHBOURS_NEAREST);
  packing_common_neighbours_report report;
  packing_structure kind = PACKING_STRUCTURE_END;
  packing_common_neighbours_report_init(&report);
  const packing_neighbours *const bad[] = {NULL, flat, near};
  for (size_t k = 0; k < 3; k++)
    assert_fails(context,
                 packing_measure_common_neighbours(context, bad[k], &kind, 1, &report),
                 PACKING_ERR_INVALID, "neighbours");
  assert_fails(context, packing_measure_common_neighbours(context, n, NULL, 1, &report),
               PACKING_ERR_INVALID, "structures");
  assert_fails(context, packing_measure_common_neighbours(context, n, &kind, 1, NULL),
               PACKING_ERR_INVALID, "report");
  report.struct_size = 0;
  assert_fails(context, packing_measure_common_neighbours(context, n, &kind, 1, &report),
               PACKING_ERR_ABI, "struct_size");
  assert_int_equal(kind, PACKING_STRUCTURE_END);
  packing_neighbours_destroy(n);
  packing_neighbours_destroy(flat);
  packing_neighbours_destroy(near);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rdf_refuses_bad_options),
      cmocka_unit_test(rdf_refuses_bad_arguments),
      cmocka_unit_test(neighbours_refuse_bad_options),
      cmocka_unit_test(neighbours_refuse_bad_arguments),
      cmocka_unit_test(bond_order_refuses),
      cmocka_unit_test(hexatic_refuses),
      cmocka_unit_test(common_neighbours_refuse),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
