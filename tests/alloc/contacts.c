/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the contact network fails in turn. */
#include "test.h"

enum { SIDE = 5, COUNT = SIDE * SIDE * SIDE, LIST = 4 * COUNT, BINS = 400 };

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
    p->r[i] = i == 62 ? 0.125 : 0.5;
  }
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
}

/* Asks all there is to ask. */
static packing_status ask(const packing_contacts *contacts, uint64_t *hash)
{
  static packing_contact list[LIST];
  static size_t numbers[BINS];
  packing_coordination_report coordination;
  packing_classes_report classes;
  packing_fabric_report fabric;
  packing_fabric_def def;
  size_t count = 0;
  packing_coordination_report_init(&coordination);
  packing_classes_report_init(&classes);
  packing_fabric_report_init(&fabric);
  packing_fabric_def_init(&def);
  def.of = PACKING_CONTACTS_OF_ALL;
  packing_status status = packing_contacts_list(contacts, 3, LIST, list, &count);
  if (status == PACKING_OK)
    status = packing_contacts_coordination(contacts, &coordination);
  if (status == PACKING_OK)
    status = packing_contacts_classes(contacts, NULL, &classes);
  if (status == PACKING_OK)
    status = packing_contacts_fabric(contacts, &def, &fabric);
  if (status == PACKING_OK)
    status = packing_contacts_normals(contacts, NULL, numbers, BINS, &(size_t){0});
  if (status != PACKING_OK)
    return status;
  *hash = test_hash(TEST_HASH_START, list, count * sizeof *list);
  *hash = test_hash(*hash, &coordination, sizeof coordination);
  *hash = test_hash(*hash, &classes, sizeof classes);
  *hash = test_hash(*hash, &fabric, sizeof fabric);
  *hash = test_hash(*hash, numbers, sizeof numbers);
  return PACKING_OK;
}

static packing_status run_in(packing_context *context, packing_domain *box,
                             uint64_t *hash)
{
  pack p;
  packing_contacts *contacts = NULL;
  fill(&p);
  packing_status status = packing_contacts_create(context, NULL, box, &p.view, &contacts);
  if (status == PACKING_OK)
    status = ask(contacts, hash);
  packing_contacts_destroy(contacts);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_with_walls(packing_context *context, uint64_t *hash)
{
  return run_in(context, test_box(SIDE, SIDE, SIDE, 1), hash);
}

/* So narrow that images are kept. */
static packing_status run_narrow(packing_context *context, uint64_t *hash)
{
  return run_in(context, test_box(1, SIDE, SIDE, 3), hash);
}

static packing_status run_orientations(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_fabric_report report;
  fill(&p);
  packing_column *q[4] = {&p.view.qw, &p.view.qx, &p.view.qy, &p.view.qz};
  const double *data[4] = {p.x, p.y, p.z, p.r};
  for (int k = 0; k < 4; k++) {
    q[k]->data = data[k];
    q[k]->stride = sizeof *data[k];
  }
  packing_fabric_report_init(&report);
  const packing_status status =
      packing_measure_orientations(context, NULL, &p.view, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  return status;
}

static void contacts_survive_any_failure(void **state)
{
  (void)state;
  assert_true(test_every_allocation(run_with_walls) >= 25);
  assert_true(test_every_allocation(run_narrow) >= 22);
  assert_int_equal(test_every_allocation(run_orientations), 1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(contacts_survive_any_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
