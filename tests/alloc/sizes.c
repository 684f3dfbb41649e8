/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the measures of sizes fails in turn. */
#include "psds.h"

enum { COUNT = 200 };

static packing_psd *psd;
static double r[COUNT];
static int32_t component[COUNT];
static packing_view view;

static int set_up(void **state)
{
  packing_rng *rng = NULL;
  (void)state;
  psd = test_psd(TEST_PSD_MIXTURE, 1, PACKING_BY_NUMBER, 3);
  assert_ok(packing_rng_create(NULL, 5, PACKING_PURPOSE_SIZE, 0, &rng));
  for (int i = 0; i < COUNT; i++) {
    size_t from = 0;
    r[i] = packing_psd_draw(psd, rng, &from);
    component[i] = (int32_t)from;
  }
  packing_rng_destroy(rng);
  packing_view_init_arrays(&view, COUNT, r, r, r, r);
  view.component.data = component;
  view.component.stride = sizeof component[0];
  return 0;
}

static int tear_down(void **state)
{
  (void)state;
  packing_psd_destroy(psd);
  return 0;
}

static packing_status run_curve(packing_context *context, uint64_t *hash)
{
  double placed[COUNT];
  const packing_status status =
      packing_measure_size_curve(context, NULL, NULL, &view, COUNT, r, NULL, placed);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, placed, sizeof placed);
  return status;
}

static packing_status run_sieves(packing_context *context, uint64_t *hash)
{
  const double openings[] = {3, 2, 1};
  packing_sieve sieves[4];
  packing_sieves_def def;
  packing_sieves_def_init(&def);
  def.count = 3;
  def.opening_d = openings;
  const packing_status status = packing_measure_sieves(context, &def, psd, &view, sieves);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, sieves, sizeof sieves);
  return status;
}

static packing_status run_kolmogorov(packing_context *context, uint64_t *hash)
{
  double p = 0;
  const packing_status status = packing_kolmogorov_p(context, 100, 0.1, &p);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &p, sizeof p);
  return status;
}

static packing_status run_size_tests(packing_context *context, uint64_t *hash)
{
  packing_size_tests_report report;
  packing_size_tests_report_init(&report);
  const packing_status status =
      packing_measure_size_tests(context, NULL, psd, &view, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  return status;
}

static packing_status run_components(packing_context *context, uint64_t *hash)
{
  packing_size_component list[8];
  assert_in_range(packing_psd_components(psd), 2, 8);
  const packing_status status = packing_measure_components(context, psd, &view, list);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, list, packing_psd_components(psd) * sizeof *list);
  return status;
}

static void sizes_survive_any_failure(void **state)
{
  (void)state;
  const size_t parts = packing_psd_components(psd);
  assert_int_equal(test_every_allocation(run_curve), 4);
  assert_int_equal(test_every_allocation(run_sieves), 4);
  assert_int_equal(test_every_allocation(run_kolmogorov), 4);
  assert_int_equal(test_every_allocation(run_size_tests), 8);
  assert_int_equal(test_every_allocation(run_components), 3 + 8 * parts);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(sizes_survive_any_failure)};
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
