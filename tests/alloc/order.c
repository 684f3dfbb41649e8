/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the measures of order fails in turn. */
#include "test.h"

enum { SIDE = 6, COUNT = SIDE * SIDE * SIDE };

typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
} pack;

static void fill(pack *p)
{
  for (int i = 0; i < COUNT; i++) {
    p->x[i] = 0.5 + i % SIDE;
    p->y[i] = 0.5 + i / SIDE % SIDE;
    p->z[i] = 0.5 + i / SIDE / SIDE;
    p->r[i] = 0.5;
  }
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
}

static packing_status run_rdf(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_rdf_def def;
  packing_rdf_report report;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p);
  packing_rdf_def_init(&def);
  def.r_max = 2;
  packing_rdf_report_init(&report);
  const packing_status status =
      packing_measure_rdf(context, &def, box, &p.view, NULL, 0, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  packing_domain_destroy(box);
  return status;
}

static packing_status measure_hexatic(packing_context *context,
                                      const packing_neighbours *n, uint64_t *hash)
{
  packing_hexatic_report report;
  packing_hexatic_report_init(&report);
  const packing_status status =
      packing_measure_hexatic(context, NULL, n, NULL, 0, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  return status;
}

static packing_status measure_all(packing_context *context, const packing_neighbours *n,
                                  uint64_t *hash)
{
  packing_bond_order_report order;
  packing_common_neighbours_report crystals;
  packing_bond_order_report_init(&order);
  packing_common_neighbours_report_init(&crystals);
  packing_status status = packing_measure_bond_order(context, NULL, n, NULL, 0, &order);
  if (status == PACKING_OK)
    status = packing_measure_common_neighbours(context, n, NULL, 0, &crystals);
  if (status == PACKING_OK) {
    *hash = test_hash(TEST_HASH_START, &order, sizeof order);
    *hash = test_hash(*hash, &crystals, sizeof crystals);
  }
  return status;
}

static packing_status run_kind(packing_context *context, packing_neighbours_kind kind,
                               int dim, uint64_t *hash)
{
  pack p;
  packing_neighbours_def def;
  packing_neighbours *n = NULL;
  fill(&p);
  packing_neighbours_def_init(&def);
  def.kind = kind;
  def.dim = dim;
  packing_status status = packing_neighbours_create(context, &def, NULL, &p.view, &n);
  if (status == PACKING_OK)
    status = dim == 2 ? measure_hexatic(context, n, hash) : measure_all(context, n, hash);
  packing_neighbours_destroy(n);
  return status;
}

static packing_status run_spheres(packing_context *context, uint64_t *hash)
{
  return run_kind(context, PACKING_NEIGHBOURS_WITHIN, 3, hash);
}

static packing_status run_discs(packing_context *context, uint64_t *hash)
{
  return run_kind(context, PACKING_NEIGHBOURS_NEAREST, 2, hash);
}

static void measures_of_order_survive_any_failure(void **state)
{
  (void)state;
  assert_true(test_every_allocation(run_rdf) >= 10);
  assert_true(test_every_allocation(run_spheres) >= 20);
  assert_true(test_every_allocation(run_discs) >= 18);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(measures_of_order_survive_any_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
