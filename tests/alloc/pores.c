/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the pore network fails in turn. */
#include "test.h"

enum { SIDE = 4, COUNT = SIDE * SIDE * SIDE };

static uint64_t hash_sums(const packing_pores *pores)
{
  packing_pores_report r;
  packing_pores_report_init(&r);
  assert_ok(packing_pores_summary(pores, &r));
  const double sums[] = {(double)r.pores, (double)r.constrictions, r.mean_r,
                         r.mean_constriction_r};
  return test_hash(TEST_HASH_START, sums, sizeof sums);
}

/* Shaken cubic; one particle hides in another; periodic with a first margin too small. */
static packing_status run(packing_context *context, unsigned periodic, int dim,
                          uint64_t *hash)
{
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
  packing_pores *pores = NULL;
  packing_pores_def def;
  packing_domain *box =
      dim == 3 ? test_box(SIDE, SIDE, SIDE, periodic) : test_rectangle(SIDE, SIDE, 3);
  for (int i = 0; i < COUNT; i++) {
    x[i] = (0.5 + i % SIDE + 0.3 * sin(i)) * 0.6;
    y[i] = 0.5 + i / SIDE % SIDE + 0.3 * sin(2 * i);
    z[i] = 0.5 + i / SIDE / SIDE + 0.3 * sin(3 * i);
    r[i] = i == 7 ? 0.02 : 0.2;
  }
  x[7] = x[8];
  y[7] = y[8];
  z[7] = z[8];
  packing_view_init_arrays(&view, dim == 3 ? COUNT : SIDE * SIDE, x, y, z, r);
  packing_pores_def_init(&def);
  def.merge = PACKING_PORES_MERGE_OVERLAP;
  const packing_status status = packing_pores_create(context, &def, box, &view, &pores);
  if (status == PACKING_OK)
    *hash = hash_sums(pores);
  packing_pores_destroy(pores);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_open(packing_context *context, uint64_t *hash)
{
  return run(context, 0, 3, hash);
}

static packing_status run_periodic(packing_context *context, uint64_t *hash)
{
  return run(context, 7, 3, hash);
}

static packing_status run_flat(packing_context *context, uint64_t *hash)
{
  return run(context, 3, 2, hash);
}

static void pores_survive_any_failure(void **state)
{
  (void)state;
  assert_true(test_every_allocation(run_open) >= 40);
  assert_true(test_every_allocation(run_periodic) >= 50);
  assert_true(test_every_allocation(run_flat) >= 40);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(pores_survive_any_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
