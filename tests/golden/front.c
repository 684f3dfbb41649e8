/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The front: one hash for any threads and instruction set, and that of this version. */
#include "cluster.h"
#include "front_scenes.h"

static uint64_t run(const packing_front_def *def, int room, int threads, packing_isa isa)
{
  packing_context *context = threads == 0 ? NULL : test_context(threads, isa);
  packing_domain *domain = scene_make(&front_rooms[room]);
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_placer *placer = NULL;
  assert_ok(packing_front_create(context, def, domain, psd, store, &placer));
  test_run(placer);
  const uint64_t hash = test_hash_particles(store);
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  packing_context_destroy(context);
  return hash;
}

static void check(const packing_front_def *def, int room, uint64_t known)
{
  const uint64_t hash = run(def, room, 0, PACKING_ISA_AUTO);
  if (hash != known)
    print_message("# room %d: %#llx\n", room, (unsigned long long)hash);
  assert_true(hash == known);
  for (int threads = 1; threads <= 8; threads *= 2)
    assert_true(run(def, room, threads, PACKING_ISA_AUTO) == hash);
  assert_true(run(def, room, 2, PACKING_ISA_BASELINE) == hash);
}

static void outward(void **state)
{
  (void)state;
  packing_front_def def = front_paper();
  def.seed = 20261122;
  check(&def, 0, UINT64_C(0x4a8c28746fa5c77d));
  check(&def, 2, UINT64_C(0x95206385cb06f9ba));
  def.select_particle = PACKING_FRONT_FIFO;
  def.select_neighbours = PACKING_FRONT_LIFO;
  check(&def, 9, UINT64_C(0xadd2f8b5f445654d));
}

static void inward(void **state)
{
  (void)state;
  packing_front_def def = front_paper();
  def.direction = PACKING_FRONT_INWARD;
  def.stream = 2;
  check(&def, 4, UINT64_C(0xfb3efd2b35cfefb4));
  check(&def, 7, UINT64_C(0x3e339a57eef8906f));
  check(&def, 12, UINT64_C(0xbfb57267a442c450));
}

static void other_contacts(void **state)
{
  (void)state;
  packing_front_def def = front_paper();
  def.count = 60;
  def.contact = packing_contact_potential();
  check(&def, 0, UINT64_C(0x4073137962300083));
  def.contact = packing_contact_direct();
  check(&def, 0, UINT64_C(0x64b76b93878baf04));
}

static void pockets(void **state)
{
  (void)state;
  packing_front_def def;
  packing_front_def_init(&def);
  check(&def, 0, UINT64_C(0xa7822a5dcacdd9ed));
  check(&def, 2, UINT64_C(0x926c05e878f3bfd7));
  def.mode = PACKING_FRONT_FAST;
  check(&def, 9, UINT64_C(0x1ea79723ea9d9fca));
  def.direction = PACKING_FRONT_INWARD;
  check(&def, 4, UINT64_C(0x74b61d3b937c171a));
}

/* Seed and stream matter. */
static void seeds_and_streams_differ(void **state)
{
  (void)state;
  packing_front_def def = front_paper();
  const uint64_t one = run(&def, 0, 1, PACKING_ISA_AUTO);
  def.seed = 2;
  const uint64_t two = run(&def, 0, 1, PACKING_ISA_AUTO);
  def.stream = 1;
  const uint64_t three = run(&def, 0, 1, PACKING_ISA_AUTO);
  assert_true(one != two && two != three && one != three);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(outward),
      cmocka_unit_test(inward),
      cmocka_unit_test(other_contacts),
      cmocka_unit_test(pockets),
      cmocka_unit_test(seeds_and_streams_differ),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
