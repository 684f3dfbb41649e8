/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the measures fails in turn. */
#include "test.h"

enum { SIDE = 6, COUNT = SIDE * SIDE * SIDE };

typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
} pack;

static void fill(pack *p, double first_r)
{
  for (int i = 0; i < COUNT; i++) {
    p->x[i] = 0.5 + i % SIDE;
    p->y[i] = 0.5 + i / SIDE % SIDE;
    p->z[i] = 0.5 + i / SIDE / SIDE;
    p->r[i] = 0.5;
  }
  p->r[0] = first_r;
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
}

static packing_status run_audit(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_audit_report report;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p, (double)NAN);
  packing_audit_report_init(&report);
  const packing_status status = packing_audit(context, NULL, box, &p.view, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_volume(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_volume_report report;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p, 0.75);
  packing_volume_report_init(&report);
  const packing_status status =
      packing_measure_volume(context, NULL, box, &p.view, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_coordination(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_coordination_report report;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p, 0.75);
  packing_coordination_report_init(&report);
  const packing_status status =
      packing_measure_coordination(context, NULL, box, &p.view, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_sizes(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_sizes_report report;
  packing_psd *psd = test_uniform(0.25, 1);
  fill(&p, 0.75);
  packing_sizes_report_init(&report);
  const packing_status status = packing_measure_sizes(context, psd, &p.view, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  packing_psd_destroy(psd);
  return status;
}

static void measures_survive_any_failure(void **state)
{
  (void)state;
  assert_true(test_every_allocation(run_audit) >= 12);
  assert_true(test_every_allocation(run_volume) >= 3);
  assert_true(test_every_allocation(run_coordination) >= 14);
  assert_int_equal(test_every_allocation(run_sizes), 4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(measures_survive_any_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
