/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of profiles, maps and sections fails in turn. */
#include "test.h"

enum { SIDE = 3, COUNT = SIDE * SIDE * SIDE };

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

static packing_status run_profile(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_profile_report report;
  packing_profile_bin bin[50];
  size_t count = 0;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p);
  packing_profile_report_init(&report);
  const packing_status status =
      packing_measure_profile(context, NULL, box, &p.view, bin, 50, &count, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, bin, sizeof bin);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_map(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_porosity_map_report report;
  packing_porosity_cell cell[1000];
  size_t count = 0;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p);
  packing_porosity_map_report_init(&report);
  const packing_status status = packing_measure_porosity_map(context, NULL, box, &p.view,
                                                             cell, 1000, &count, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, cell, sizeof cell);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_sections(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_sections_report report;
  packing_section_entry entry[5];
  size_t count = 0;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p);
  packing_sections_report_init(&report);
  const packing_status status =
      packing_measure_sections(context, NULL, box, &p.view, entry, 5, &count, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, entry, sizeof entry);
  packing_domain_destroy(box);
  return status;
}

static packing_status run_image(packing_context *context, uint64_t *hash)
{
  pack p;
  packing_section_def section;
  packing_section_image_def def;
  packing_section_image_report report;
  size_t count = 0;
  packing_domain *box = test_box(SIDE, SIDE, SIDE, 1);
  fill(&p);
  packing_section_def_init(&section);
  section.point.z = 1.25;
  packing_section_image_def_init(&def);
  def.rows = def.columns = 64;
  packing_section_image_report_init(&report);
  const packing_status status = packing_measure_section_image(
      context, &section, &def, box, &p.view, NULL, 0, &count, &report);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &report, sizeof report);
  packing_domain_destroy(box);
  return status;
}

static void porosity_survives_any_failure(void **state)
{
  (void)state;
  assert_int_equal(test_every_allocation(run_profile), 4);
  assert_int_equal(test_every_allocation(run_map), 6);
  assert_int_equal(test_every_allocation(run_sections), 6);
  assert_int_equal(test_every_allocation(run_image), 4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(porosity_survives_any_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
