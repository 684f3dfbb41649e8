/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One hash for any threads, instruction set, order of blocks and size of steps; and the hashes
 * of this version, which only + - * / and sqrt went into. */
#include "test.h"

typedef packing_placer *(*scene)(packing_context *context, packing_domain *domain,
                                 packing_psd *psd, packing_particles *store);

static packing_placer *rsa(packing_context *context, packing_domain *domain,
                           packing_psd *psd, packing_particles *store)
{
  packing_placer *placer = NULL;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.seed = 20261121;
  def.stream = 3;
  def.count = packing_psd_max_r(psd) > packing_psd_min_r(psd) ? 700 : 0;
  assert_ok(packing_rsa_create(context, &def, domain, psd, store, &placer));
  return placer;
}

static packing_placer *largest_first(packing_context *context, packing_domain *domain,
                                     packing_psd *psd, packing_particles *store)
{
  packing_placer *placer = NULL;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.seed = 7;
  def.count = 700;
  def.order = PACKING_ORDER_DESCENDING;
  assert_ok(packing_rsa_create(context, &def, domain, psd, store, &placer));
  return placer;
}

static packing_placer *crystal(packing_context *context, packing_domain *domain,
                               packing_psd *psd, packing_particles *store)
{
  packing_placer *placer = NULL;
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.kind = PACKING_LATTICE_FCC;
  assert_ok(packing_lattice_create(context, &def, domain, psd, store, &placer));
  return placer;
}

static packing_domain *cylinder(void)
{
  packing_domain_cylinder_def def;
  packing_domain *domain = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = 6.7;
  def.height = 13.3;
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  return domain;
}

static packing_placer *cells(packing_context *context, packing_domain *domain,
                             packing_psd *psd, packing_particles *store)
{
  packing_placer *placer = NULL;
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.count = 300;
  assert_ok(packing_lattice_create(context, &def, domain, psd, store, &placer));
  return placer;
}

static uint64_t run(packing_context *context, scene make, packing_domain *domain,
                    packing_psd *psd, size_t budget)
{
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_placer *placer = make(context, domain, psd, store);
  packing_placer_report report;
  packing_placer_report_init(&report);
  do
    assert_ok(packing_placer_step(placer, budget, &report));
  while (report.state == PACKING_PLACER_RUNNING);
  const uint64_t hash = test_hash_particles(store);
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  return hash;
}

static void backwards(void *user, size_t blocks, packing_block_function fn, void *arg)
{
  (void)user;
  while (blocks-- > 0)
    fn(arg, blocks);
}

static packing_context *backwards_context(void)
{
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.parallel = backwards;
  assert_ok(packing_context_create(&def, &context));
  return context;
}

static void check(scene make, packing_domain *domain, packing_psd *psd, uint64_t golden)
{
  const uint64_t hash = run(NULL, make, domain, psd, 1);
  packing_context *context;
  for (size_t t = 0; t < TEST_TEAMS; t++) {
    context = test_team(t);
    assert_true(run(context, make, domain, psd, 1 + 6 * t) == hash);
    packing_context_destroy(context);
  }
  context = backwards_context();
  assert_true(run(context, make, domain, psd, 1000) == hash);
  packing_context_destroy(context);
  if (hash != golden)
    print_error("hash 0x%016llx, golden 0x%016llx\n", (unsigned long long)hash,
                (unsigned long long)golden);
  assert_true(hash == golden);
  packing_domain_destroy(domain);
  packing_psd_destroy(psd);
}

static void equal_spheres_to_saturation(void **state)
{
  (void)state;
  check(rsa, test_box(23.7, 21.3, 19.9, 7), test_mono(0.5), UINT64_C(0x26aa35645f7f49a0));
}

static void equal_spheres_between_walls(void **state)
{
  (void)state;
  check(rsa, test_box(23.7, 21.3, 19.9, PACKING_PERIODIC_Y), test_mono(0.5),
        UINT64_C(0x1aedc0f36f92b3d3));
}

static void equal_discs_to_saturation(void **state)
{
  (void)state;
  check(rsa, test_rectangle(53.1, 47.7, 3), test_mono(0.5), UINT64_C(0x4107b9f3b0c0c54d));
}

static void unequal_spheres(void **state)
{
  (void)state;
  check(rsa, test_box(13.7, 11.3, 12.9, 7), test_uniform(0.31, 0.62),
        UINT64_C(0x5a46399fe0dfda03));
}

static void reference_cells(void **state)
{
  (void)state;
  check(cells, test_box(13.7, 11.3, 12.9, 0), test_uniform(0.31, 0.62),
        UINT64_C(0x2f11aff11d770e49));
}

static void curved_walls(void **state)
{
  (void)state;
  check(rsa, cylinder(), test_mono(0.5), UINT64_C(0xbb28fa168fae257d));
  check(largest_first, cylinder(), test_uniform(0.31, 0.92),
        UINT64_C(0x440758e8a89488d6));
  check(crystal, cylinder(), test_mono(0.5), UINT64_C(0xd76529f622653f2b));
}

/* The seed and the stream matter, a second call does not. */
static void seeds_and_streams_differ(void **state)
{
  (void)state;
  packing_domain *domain = test_box(9, 9, 9, 7);
  packing_psd *psd = test_mono(0.5);
  uint64_t hash[4];
  const uint64_t seed[4] = {1, 2, 1, 1}, stream[4] = {0, 0, 1, 0};
  for (int i = 0; i < 4; i++) {
    packing_particles *store = test_store(3);
    packing_placer *placer = NULL;
    packing_rsa_def def;
    packing_rsa_def_init(&def);
    def.seed = seed[i];
    def.stream = stream[i];
    def.count = 100;
    assert_ok(packing_rsa_create(NULL, &def, domain, psd, store, &placer));
    test_run(placer);
    hash[i] = test_hash_particles(store);
    packing_placer_destroy(placer);
    packing_particles_destroy(store);
  }
  assert_true(hash[0] != hash[1] && hash[0] != hash[2] && hash[1] != hash[2]);
  assert_true(hash[0] == hash[3]);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equal_spheres_to_saturation),
      cmocka_unit_test(equal_spheres_between_walls),
      cmocka_unit_test(equal_discs_to_saturation),
      cmocka_unit_test(unequal_spheres),
      cmocka_unit_test(reference_cells),
      cmocka_unit_test(curved_walls),
      cmocka_unit_test(seeds_and_streams_differ),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
