/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every request of loosening fails once; the pack then is as it was. */
#include "test.h"

static packing_status loosen(packing_context *context, uint64_t *hash)
{
  packing_domain *domain = test_box(10, 10, 10, 0);
  packing_particles *store = test_store(3);
  for (int i = 0; i < 100; i++) {
    const packing_vec3 centre = {i % 10 + .5, (double)(i / 10) + .5, .5};
    assert_ok(packing_particles_add(store, centre, 0.3 + 0.002 * (i * 37 % 100), NULL));
  }
  const uint64_t before = test_hash_particles(store);
  packing_loosen_def def;
  packing_loosen_def_init(&def);
  def.how = PACKING_LOOSEN_REMOVE;
  def.volume_fraction = 0.013;
  double reached = -1;
  const packing_status status = packing_loosen(context, &def, domain, store, &reached);
  *hash = test_hash_particles(store);
  if (status != PACKING_OK)
    assert_true(*hash == before && reached == -1);
  packing_particles_destroy(store);
  packing_domain_destroy(domain);
  return status;
}

static void every_allocation_may_fail(void **state)
{
  (void)state;
  assert_int_equal(test_every_allocation(loosen), 4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
