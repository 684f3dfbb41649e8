/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures give the same bytes for any number of threads and every instruction set. */
#include "test.h"

enum { COUNT = 9000 /* three blocks of the grid and of the measures */ };

static uint64_t hash_reports(packing_context *context, packing_domain *domain,
                             packing_psd *psd, const packing_view *v)
{
  packing_audit_report audit;
  packing_volume_report volume;
  packing_coordination_report coordination;
  packing_coordination_def def;
  packing_sizes_report sizes;
  packing_audit_report_init(&audit);
  packing_volume_report_init(&volume);
  packing_coordination_report_init(&coordination);
  packing_coordination_def_init(&def);
  def.tolerance = 0.125;
  packing_sizes_report_init(&sizes);
  assert_ok(packing_audit(context, NULL, domain, v, &audit));
  assert_ok(packing_measure_volume(context, NULL, domain, v, &volume));
  assert_ok(packing_measure_coordination(context, &def, domain, v, &coordination));
  assert_ok(packing_measure_sizes(context, psd, v, &sizes));
  assert_true(audit.max_overlap > 0 && volume.inner_fraction > 0 && sizes.ks > 0);
  assert_true(coordination.rattlers > 0 && coordination.rattlers < COUNT);
  uint64_t hash = test_hash(TEST_HASH_START, &audit, sizeof audit);
  hash = test_hash(hash, &volume, sizeof volume);
  hash = test_hash(hash, &coordination, sizeof coordination);
  return test_hash(hash, &sizes, sizeof sizes);
}

/* All that a network of contacts tells. */
static uint64_t hash_contacts(packing_context *context, packing_domain *domain,
                              const packing_view *v)
{
  enum { BINS = 400 };
  packing_contacts_def def;
  packing_contacts *contacts = NULL;
  packing_classes_report classes;
  packing_fabric_report fabric;
  packing_fabric_def all;
  size_t bins[BINS] = {0}, count = 0;
  packing_contacts_def_init(&def);
  def.tolerance = 0.125;
  packing_classes_report_init(&classes);
  packing_fabric_report_init(&fabric);
  packing_fabric_def_init(&all);
  all.of = PACKING_CONTACTS_OF_ALL;
  assert_ok(packing_contacts_create(context, &def, domain, v, &contacts));
  const size_t most =
      packing_contacts_count(contacts) + packing_contacts_wall_count(contacts);
  packing_contact *list = malloc(most * sizeof *list);
  assert_non_null(list);
  assert_ok(packing_contacts_list(contacts, 0, most, list, &count));
  assert_ok(packing_contacts_classes(contacts, NULL, &classes));
  assert_ok(packing_contacts_fabric(contacts, &all, &fabric));
  assert_ok(packing_contacts_normals(contacts, NULL, bins, BINS, &count));
  assert_true(count <= BINS && classes.stable > 0 && fabric.count > COUNT);
  uint64_t hash = test_hash(TEST_HASH_START, list, most * sizeof *list);
  hash = test_hash(hash, &classes, sizeof classes);
  hash = test_hash(hash, &fabric, sizeof fabric);
  free(list);
  packing_contacts_destroy(contacts);
  return test_hash(hash, bins, sizeof bins);
}

/* The pairs of a grid that was built with the context. */
static uint64_t hash_pairs(packing_context *context, packing_domain *domain,
                           const packing_view *v)
{
  packing_grid *grid = NULL;
  size_t count = 0;
  assert_ok(packing_grid_create(context, NULL, domain, v, &grid));
  assert_ok(packing_grid_pairs(grid, 0.125, NULL, 0, &count));
  packing_pair *pairs = malloc(count * sizeof *pairs);
  assert_true(count > 0 && pairs != NULL);
  assert_ok(packing_grid_pairs(grid, 0.125, pairs, count, &count));
  const uint64_t hash = test_hash(TEST_HASH_START, pairs, count * sizeof *pairs);
  free(pairs);
  packing_grid_destroy(grid);
  return hash;
}

static void one_hash_for_all(void **state)
{
  (void)state;
  static double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_rng *rng = NULL;
  packing_psd *psd = test_uniform(0.1, 1);
  packing_view v;
  assert_ok(packing_rng_create(NULL, 1, PACKING_PURPOSE_USER, 0, &rng));
  for (size_t i = 0; i < COUNT; i++) {
    x[i] = 22 * packing_rng_uniform(rng);
    y[i] = 21 * packing_rng_uniform(rng);
    z[i] = 20 * packing_rng_uniform(rng);
    r[i] = packing_psd_draw(psd, rng, NULL);
  }
  packing_rng_destroy(rng);
  packing_view_init_arrays(&v, COUNT, x, y, z, r);
  for (unsigned periodic = 0; periodic < 8; periodic += 5) {
    packing_domain *box = test_box(22, 21, 20, periodic);
    const uint64_t reports = hash_reports(NULL, box, psd, &v);
    const uint64_t pairs = hash_pairs(NULL, box, &v);
    const uint64_t contacts = hash_contacts(NULL, box, &v);
    for (size_t t = 0; t < TEST_TEAMS; t++) {
      packing_context *context = test_team(t);
      assert_true(hash_reports(context, box, psd, &v) == reports);
      assert_true(hash_pairs(context, box, &v) == pairs);
      assert_true(hash_contacts(context, box, &v) == contacts);
      packing_context_destroy(context);
    }
    packing_domain_destroy(box);
  }
  packing_psd_destroy(psd);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(one_hash_for_all)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
