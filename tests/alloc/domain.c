/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the containers fails once. */
#include "test.h"

static double slab(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  if (normal != NULL)
    *normal = (packing_vec3){0, 0, point->z < 0.5 ? 1 : -1};
  return point->z < 0.5 ? point->z : 1 - point->z;
}

static packing_status built_in(packing_context *context, packing_domain *made[3])
{
  packing_domain_silo_def silo;
  packing_domain_silo_def_init(&silo);
  silo.radius = 1;
  silo.height = 3;
  silo.hopper_height = 1;
  const packing_status status = packing_domain_create_silo(context, &silo, &made[0]);
  if (status != PACKING_OK)
    return status;
  return packing_domain_create_inset(context, made[0], 0.25, &made[1]);
}

static packing_status all(packing_context *context, packing_domain *made[4])
{
  packing_domain_custom_def custom;
  packing_domain_custom_def_init(&custom);
  custom.signed_distance = slab;
  custom.bounds.hi = (packing_vec3){1, 1, 1};
  packing_status status = built_in(context, made);
  if (status == PACKING_OK)
    status = packing_domain_create_custom(context, &custom, &made[2]);
  if (status == PACKING_OK)
    status = packing_domain_create_inset(context, made[2], 0.125, &made[3]);
  return status;
}

static packing_status scenario(packing_context *context, uint64_t *hash)
{
  packing_domain *made[4] = {NULL, NULL, NULL, NULL};
  const packing_status status = all(context, made);
  uint64_t h = TEST_HASH_START;
  for (int i = 0; i < 4; i++) {
    if (status == PACKING_OK) {
      const double v = packing_domain_volume(made[i]);
      h = test_hash(h, &v, sizeof v);
    }
    packing_domain_destroy(made[i]);
  }
  if (status == PACKING_OK)
    *hash = h;
  return status;
}

static void every_allocation_may_fail(void **state)
{
  (void)state;
  assert_int_equal(test_every_allocation(scenario), 4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
