/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of the containers fails once. */
#include "domain_scenes.h"

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

/* scene_make() asserts: here each constructor may fail. */
#define MAKE(name, ...)                                                                  \
  do {                                                                                   \
    packing_domain_##name##_def def;                                                     \
    packing_domain_##name##_def_init(&def);                                              \
    __VA_ARGS__;                                                                         \
    return packing_domain_create_##name(context, &def, made);                            \
  } while (0)

static enum scene_kind kind_now;

static packing_status make(packing_context *context, packing_domain **made)
{
  switch (kind_now) {
  case SCENE_BOX:
    MAKE(box, def.size.x = def.size.y = def.size.z = 1.3);
  case SCENE_CYLINDER:
    MAKE(cylinder, def.radius = 0.83, def.height = 1.7);
  case SCENE_TUBE:
    MAKE(tube, def.inner_radius = 0.41, def.outer_radius = 1.13, def.height = 1.2);
  case SCENE_CONE:
    MAKE(cone, def.bottom_radius = 0.37, def.top_radius = 1.21, def.height = 1.4);
  case SCENE_SILO:
    MAKE(silo, def.radius = 0.93, def.height = 2.1, def.outlet_radius = 0.27,
         def.hopper_height = 0.71);
  case SCENE_SPHERE:
    MAKE(sphere, def.radius = 1.07);
  case SCENE_RECTANGLE:
    MAKE(rectangle, def.size_x = 1.3, def.size_y = 0.9);
  case SCENE_CIRCLE:
    MAKE(circle, def.radius = 1.07);
  case SCENE_ANNULUS:
    MAKE(annulus, def.inner_radius = 0.41, def.outer_radius = 1.13);
  case SCENE_END:
    break;
  }
  return PACKING_ERR_INTERNAL;
}

/* A container, what is left of it within a margin, and a particle cut by its wall. */
static packing_status one_kind(packing_context *context, uint64_t *hash)
{
  packing_domain *made = NULL, *inset = NULL;
  packing_status status = make(context, &made);
  if (status == PACKING_OK)
    status = packing_domain_create_inset(context, made, 0.125, &inset);
  double found[3] = {0, 0, 0};
  if (status == PACKING_OK) {
    packing_bounds b;
    packing_domain_bounds(made, &b);
    const packing_vec3 edge = {b.lo.x, (b.lo.y + b.hi.y) / 2, (b.lo.z + b.hi.z) / 2};
    found[0] = packing_domain_volume(made);
    found[1] = packing_domain_volume(inset);
    status = packing_domain_sphere_volume(made, &edge, 0.3, 1e-9, &found[2], NULL);
  }
  packing_domain_destroy(inset);
  packing_domain_destroy(made);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, found, sizeof found);
  return status;
}

static void every_kind_may_find_no_memory(void **state)
{
  (void)state;
  for (int k = 0; k < SCENE_END; k++) {
    kind_now = (enum scene_kind)k;
    assert_true(test_every_allocation(one_kind) >= 2);
  }
}

static void every_allocation_may_fail(void **state)
{
  (void)state;
  assert_int_equal(test_every_allocation(scenario), 4);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_kind_may_find_no_memory),
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
