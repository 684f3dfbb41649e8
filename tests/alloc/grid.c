/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the grid fails in turn. */
#include "test.h"

enum { COUNT = 300 };

static packing_status search(packing_context *context, uint64_t *hash)
{
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_pair pairs[COUNT] = {{0, 0}};
  packing_view v;
  packing_grid *grid = NULL;
  size_t count = 0;
  for (int i = 0; i < COUNT; i++) {
    x[i] = i % 7 * 1.25;
    y[i] = i % 11 * 0.75;
    z[i] = i % 13 * 0.875;
    r[i] = 0.0625 * (1 + i % 17);
  }
  packing_view_init_arrays(&v, COUNT, x, y, z, r);
  packing_status status = packing_grid_create(context, NULL, NULL, &v, &grid);
  if (status != PACKING_OK)
    return status;
  status = packing_grid_pairs(grid, 0, pairs, COUNT, &count);
  packing_grid_destroy(grid);
  if (status != PACKING_OK)
    return status;
  *hash = test_hash(TEST_HASH_START, pairs, sizeof pairs);
  *hash = test_hash(*hash, &count, sizeof count);
  return PACKING_OK;
}

static void grid_survives_any_failure(void **state)
{
  (void)state;
  assert_true(test_every_allocation(search) >= 12);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(grid_survives_any_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
