/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the measures of sizes refuse, and that they leave their outputs alone then. */
#include "test.h"

enum { COUNT = 3 };

typedef struct setting {
  packing_context *context;
  packing_psd *psd;
  packing_view view;
  double r[COUNT];
} setting;

static int set_up(void **state)
{
  setting *s = calloc(1, sizeof *s);
  assert_non_null(s);
  s->context = test_context(1, PACKING_ISA_AUTO);
  s->psd = test_uniform(1, 2);
  for (int i = 0; i < COUNT; i++)
    s->r[i] = 1.25 + 0.25 * i;
  packing_view_init_arrays(&s->view, COUNT, s->r, s->r, s->r, s->r);
  *state = s;
  return 0;
}

static int tear_down(void **state)
{
  setting *s = *state;
  packing_psd_destroy(s->psd);
  packing_context_destroy(s->context);
  free(s);
  return 0;
}

static void curve_refuses(void **state)
{
  setting *s = *state;
  packing_context *c = s->context;
  packing_size_curve_def def;
  double at[2] = {1, 2}, asked[2] = {7, 7}, placed[2] = {7, 7};
#define CURVE(psd, view, r)                                                              \
  packing_measure_size_curve(c, &def, psd, view, 2, r, asked, placed)
  packing_size_curve_def_init(&def);
  assert_fails(c, CURVE(s->psd, &s->view, NULL), PACKING_ERR_INVALID, "r");
  assert_fails(c, CURVE(NULL, &s->view, at), PACKING_ERR_INVALID, "psd");
  assert_fails(c, CURVE(s->psd, NULL, at), PACKING_ERR_INVALID, "view");
  at[1] = 0;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_RANGE, "r: entry 1");
  at[1] = (double)INFINITY;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_INVALID, "r: entry 1");
  at[1] = 2;
  def.by = (packing_by)2;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_RANGE, "by");
  def.by = PACKING_BY_MASS;
  def.dim = 1;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_RANGE, "dim");
  def.dim = 2;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_RANGE, "dim");
  def.dim = 3;
  s->r[1] = -1;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_RANGE, "particle 1");
  s->r[1] = (double)NAN;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_INVALID, "particle 1");
  s->view.count = 0;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_RANGE, "view");
  def.struct_size = 1;
  assert_fails(c, CURVE(s->psd, &s->view, at), PACKING_ERR_ABI, "struct_size");
  assert_true(asked[0] == 7 && asked[1] == 7 && placed[0] == 7 && placed[1] == 7);
}

static void sieves_refuse(void **state)
{
  setting *s = *state;
  packing_context *c = s->context;
  packing_sieves_def def;
  packing_sieve out[3] = {{7, 7, 7, 7, 7}, {7, 7, 7, 7, 7}, {7, 7, 7, 7, 7}};
  double openings[] = {4, 2};
#define SIEVES(to) packing_measure_sieves(c, &def, s->psd, &s->view, to)
  packing_sieves_def_init(&def);
  assert_fails(c, packing_measure_sieves(c, NULL, s->psd, &s->view, out),
               PACKING_ERR_RANGE, "count");
  assert_fails(c, SIEVES(out), PACKING_ERR_RANGE, "count");
  def.count = 2;
  assert_fails(c, SIEVES(out), PACKING_ERR_INVALID, "opening_d");
  def.opening_d = openings;
  assert_fails(c, SIEVES(NULL), PACKING_ERR_INVALID, "sieves");
  openings[1] = 4;
  assert_fails(c, SIEVES(out), PACKING_ERR_RANGE, "opening_d: entry 1: 4 is not finer");
  openings[1] = -2;
  assert_fails(c, SIEVES(out), PACKING_ERR_RANGE, "opening_d: entry 1");
  openings[1] = (double)NAN;
  assert_fails(c, SIEVES(out), PACKING_ERR_INVALID, "opening_d: entry 1");
  openings[1] = 2;
  def.dim = 4;
  assert_fails(c, SIEVES(out), PACKING_ERR_RANGE, "dim");
  def.dim = 2;
  assert_fails(c, SIEVES(out), PACKING_ERR_RANGE, "dim");
  def.dim = 0;
  s->view.count = 0;
  assert_fails(c, SIEVES(out), PACKING_ERR_RANGE, "view");
  s->view.struct_size = 0;
  assert_fails(c, SIEVES(out), PACKING_ERR_INVALID, "view");
  def.struct_size = 0;
  assert_fails(c, SIEVES(out), PACKING_ERR_ABI, "struct_size");
  for (int k = 0; k < 3; k++)
    assert_true(out[k].opening_d == 7 && out[k].placed_passing == 7);
}

static void errors_refuse(void **state)
{
  packing_context *c = ((setting *)*state)->context;
  packing_curve_errors_report e;
  double asked[] = {1, 2}, placed[] = {1, 2};
#define ERRORS(count, a, b) packing_measure_curve_errors(c, count, a, b, &e)
  packing_curve_errors_report_init(&e);
  e.mae = 7;
  assert_fails(c, ERRORS(0, asked, placed), PACKING_ERR_RANGE, "count");
  assert_fails(c, ERRORS(2, NULL, placed), PACKING_ERR_INVALID, "asked");
  assert_fails(c, ERRORS(2, asked, NULL), PACKING_ERR_INVALID, "placed");
  assert_fails(c, packing_measure_curve_errors(c, 2, asked, placed, NULL),
               PACKING_ERR_INVALID, "report");
  asked[1] = -1;
  assert_fails(c, ERRORS(2, asked, placed), PACKING_ERR_RANGE, "asked: entry 1");
  asked[1] = (double)NAN;
  assert_fails(c, ERRORS(2, asked, placed), PACKING_ERR_INVALID, "asked: entry 1");
  asked[1] = 2;
  placed[0] = -1;
  assert_fails(c, ERRORS(2, asked, placed), PACKING_ERR_RANGE, "placed: entry 0");
  placed[0] = (double)INFINITY;
  assert_fails(c, ERRORS(2, asked, placed), PACKING_ERR_INVALID, "placed: entry 0");
  placed[0] = 1;
  assert_true(e.mae == 7);
  e.struct_size = 0;
  assert_fails(c, ERRORS(2, asked, placed), PACKING_ERR_ABI, "struct_size");
}

static void kolmogorov_refuses(void **state)
{
  packing_context *c = ((setting *)*state)->context;
  double p = 7;
  assert_fails(c, packing_kolmogorov_p(c, 5, 0.5, NULL), PACKING_ERR_INVALID, "p");
  assert_fails(c, packing_kolmogorov_p(c, 0, 0.5, &p), PACKING_ERR_RANGE, "count");
  assert_fails(c, packing_kolmogorov_p(c, 5, -0.5, &p), PACKING_ERR_RANGE, "distance");
  assert_fails(c, packing_kolmogorov_p(c, 5, 1.5, &p), PACKING_ERR_RANGE, "distance");
  assert_fails(c, packing_kolmogorov_p(c, 5, (double)NAN, &p), PACKING_ERR_INVALID,
               "distance");
  assert_true(p == 7);
}

static void tests_refuse(void **state)
{
  setting *s = *state;
  packing_context *c = s->context;
  packing_size_tests_def def;
  packing_size_tests_report t;
#define TESTS(psd, view) packing_measure_size_tests(c, &def, psd, view, &t)
  packing_size_tests_def_init(&def);
  packing_size_tests_report_init(&t);
  t.ks = 7;
  assert_fails(c, TESTS(NULL, &s->view), PACKING_ERR_INVALID, "psd");
  assert_fails(c, TESTS(s->psd, NULL), PACKING_ERR_INVALID, "view");
  assert_fails(c, packing_measure_size_tests(c, NULL, s->psd, &s->view, NULL),
               PACKING_ERR_INVALID, "report");
  def.bins = 1;
  assert_fails(c, TESTS(s->psd, &s->view), PACKING_ERR_RANGE, "bins");
  def.bins = PACKING_SIZE_TESTS_BINS + 1;
  assert_fails(c, TESTS(s->psd, &s->view), PACKING_ERR_RANGE, "bins");
  def.bins = 2;
  s->view.count = 0;
  assert_fails(c, TESTS(s->psd, &s->view), PACKING_ERR_RANGE, "view");
  assert_true(t.ks == 7);
  s->view.count = COUNT;
  t.struct_size = 0;
  assert_fails(c, TESTS(s->psd, &s->view), PACKING_ERR_ABI, "struct_size");
  def.struct_size = 0;
  assert_fails(c, TESTS(s->psd, &s->view), PACKING_ERR_ABI, "struct_size");
}

static void components_refuse(void **state)
{
  setting *s = *state;
  packing_context *c = s->context;
  packing_size_component out[2] = {{.count = 7}, {.count = 7}};
  packing_psd *const parts[] = {s->psd, s->psd};
  const double share[] = {1, 1};
  int32_t component[] = {0, 1, 2};
  packing_psd_mixture_def def;
  packing_psd *psd = NULL;
  packing_psd_mixture_def_init(&def);
  def.count = 2;
  def.parts = parts;
  def.share = share;
  assert_ok(packing_psd_create_mixture(c, &def, &psd));
#define COMPONENTS(p, v, to) packing_measure_components(c, p, v, to)
  assert_fails(c, COMPONENTS(NULL, &s->view, out), PACKING_ERR_INVALID, "psd");
  assert_fails(c, COMPONENTS(psd, NULL, out), PACKING_ERR_INVALID, "view");
  assert_fails(c, COMPONENTS(psd, &s->view, NULL), PACKING_ERR_INVALID, "components");
  assert_fails(c, COMPONENTS(psd, &s->view, out), PACKING_ERR_INVALID, "component: NULL");
  s->view.component.data = component;
  s->view.component.stride = sizeof component[0];
  assert_fails(c, COMPONENTS(psd, &s->view, out), PACKING_ERR_RANGE, "particle 2");
  component[2] = -1;
  assert_fails(c, COMPONENTS(psd, &s->view, out), PACKING_ERR_RANGE, "particle 2");
  component[2] = 1;
  assert_fails(c, COMPONENTS(s->psd, &s->view, out), PACKING_ERR_RANGE, "particle 1");
  s->view.count = 0;
  assert_fails(c, COMPONENTS(psd, &s->view, out), PACKING_ERR_RANGE, "view");
  assert_true(out[0].count == 7 && out[1].count == 7);
  packing_psd_destroy(psd);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(curve_refuses, set_up, tear_down),
      cmocka_unit_test_setup_teardown(sieves_refuse, set_up, tear_down),
      cmocka_unit_test_setup_teardown(errors_refuse, set_up, tear_down),
      cmocka_unit_test_setup_teardown(kolmogorov_refuses, set_up, tear_down),
      cmocka_unit_test_setup_teardown(tests_refuse, set_up, tear_down),
      cmocka_unit_test_setup_teardown(components_refuse, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
