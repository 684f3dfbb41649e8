/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of materials, laws and stepper fails in turn; and steps take no memory once the
 * list of neighbours has found its size. */
#include "dem_scenes.h"

/* Remembers how long contacts last, and pushes a little the longer. */
static void ages(void *user, const packing_contact_batch *batch)
{
  (void)user;
  for (size_t k = 0; k < batch->count; k++) {
    double *age = &batch->history[k];
    *age += batch->dt;
    batch->normal[k] += 1e-3 * *age;
  }
}

static packing_status make_laws(packing_context *context, packing_law *laws[4])
{
  packing_law_sliding_def sliding;
  packing_law_near_field_def near_field;
  packing_law_custom_def custom;
  packing_law_sliding_def_init(&sliding);
  packing_law_near_field_def_init(&near_field);
  packing_law_custom_def_init(&custom);
  sliding.slip_velocity = 0.01;
  near_field.attraction = 1e-3;
  near_field.cutoff = 0.03;
  custom.evaluate = ages;
  custom.history_size = 1;
  custom.history_even = 1;
  packing_status status = packing_law_create_hertz(context, NULL, &laws[0]);
  if (status == PACKING_OK)
    status = packing_law_create_sliding(context, &sliding, &laws[1]);
  if (status == PACKING_OK)
    status = packing_law_create_near_field(context, &near_field, &laws[2]);
  if (status == PACKING_OK)
    status = packing_law_create_custom(context, &custom, &laws[3]);
  return status;
}

static packing_status make_materials(packing_context *context,
                                     packing_materials **materials)
{
  packing_material_def def;
  packing_material_def_init(&def);
  def.density = 1000;
  def.young = 1e8;
  packing_status status = packing_materials_create(context, materials);
  for (int k = 0; k < 3 && status == PACKING_OK; k++)
    status = packing_materials_add(*materials, &def, NULL);
  if (status == PACKING_OK)
    status = packing_materials_set_pair(*materials, 0, 1, 0.2, 0.3);
  return status;
}

static packing_status make_store(packing_context *context, packing_particles **store)
{
  packing_status status = packing_particles_create(context, NULL, store);
  for (int i = 0; i < 125 && status == PACKING_OK; i++) {
    const packing_vec3 at = {0.02 + 0.0201 * (i % 5), 0.02 + 0.0201 * (i / 5 % 5),
                             0.02 + 0.0201 * (i / 25)};
    status = packing_particles_add(*store, at, 0.01, NULL);
  }
  return status;
}

/* Squeezes the grid of spheres together, so that pairs become neighbours. */
static packing_status use(packing_dem *dem, packing_particles *store, uint64_t *hash)
{
  double v[126];
  packing_view view;
  packing_particles_view(store, &view);
  for (size_t i = 0; i < view.count; i++)
    v[i] = 20 * (0.07 - ((const double *)view.x.data)[i]);
  packing_status status = packing_particles_set(store, PACKING_FIELD_VX, v, sizeof *v);
  if (status == PACKING_OK)
    status = packing_dem_reload(dem);
  if (status == PACKING_OK)
    status = packing_dem_step(dem, 20, NULL);
  const packing_vec3 extra = {0.3, 0.3, 0.3};
  if (status == PACKING_OK)
    status = packing_particles_add(store, extra, 0.05, NULL);
  if (status == PACKING_OK)
    status = packing_dem_reload(dem);
  /* What is refused for want of memory in a step leaves the store as it was. */
  const uint64_t before = dem_hash(store);
  if (status == PACKING_OK) {
    status = packing_dem_step(dem, 20, NULL);
    assert_true(status == PACKING_OK || dem_hash(store) == before);
  }
  if (status == PACKING_OK)
    *hash = dem_hash(store);
  return status;
}

static packing_status settle(packing_context *context, uint64_t *hash)
{
  packing_domain_box_def box;
  packing_domain *domain = NULL;
  packing_materials *materials = NULL;
  packing_law *laws[4] = {NULL, NULL, NULL, NULL};
  packing_particles *store = NULL;
  packing_dem *dem = NULL;
  packing_dem_def def;
  packing_domain_box_def_init(&box);
  box.size = dem_vec(0.5, 0.5, 0.5);
  box.periodic = PACKING_PERIODIC_X;
  packing_dem_def_init(&def);
  def.gravity.z = -9.81;
  def.dt = 2e-5;
  def.max_start_overlap = 0.2;
  packing_status status = packing_domain_create_box(context, &box, &domain);
  if (status == PACKING_OK)
    status = make_materials(context, &materials);
  if (status == PACKING_OK)
    status = make_laws(context, laws);
  if (status == PACKING_OK)
    status = make_store(context, &store);
  if (status == PACKING_OK)
    status = packing_dem_create(context, &def, domain, materials, laws, 4, store, &dem);
  if (status == PACKING_OK)
    status = use(dem, store, hash);
  packing_dem_destroy(dem);
  packing_particles_destroy(store);
  for (int l = 0; l < 4; l++)
    packing_law_destroy(laws[l]);
  packing_materials_destroy(materials);
  packing_domain_destroy(domain);
  return status;
}

static void stepper_survives_any_failure(void **state)
{
  (void)state;
  assert_true(test_every_allocation(settle) >= 30);
}

/* After a step that ran out of memory the stepper can be reloaded and goes on. */
static void step_out_of_memory(void **state)
{
  (void)state;
  test_allocator a = {0};
  dem_scene s;
  dem_scene_init(&s, test_box(0.2, 0.2, 0.2, 0));
  s.context = test_allocator_context(&a);
  dem_material(&s, 1000, 1e4, 0.25, 0, 0);
  dem_hertz(&s, 0);
  /* A thin cloud of soft spheres that implodes: the list must grow on the way. */
  dem_cloud(&s, 0.01, 1, 0.05, 1, 0, 5);
  for (size_t i = 0; i < packing_particles_count(s.store); i++) {
    dem_body b = dem_get(&s, i);
    b.v = dem_vec(20 * (0.1 - b.x.x), 20 * (0.1 - b.x.y), 20 * (0.1 - b.x.z));
    dem_put(&s, i, &b);
  }
  s.def.dt = 1e-4;
  dem_start(&s);
  const uint64_t before = dem_hash(s.store);
  a.fail_at = a.requests + 1;
  assert_fails(s.context, packing_dem_step(s.dem, 800, NULL), PACKING_ERR_NOMEM,
               "out of memory");
  assert_true(dem_hash(s.store) == before);
  assert_status(packing_dem_step(s.dem, 1, NULL), PACKING_ERR_INVALID);
  a.fail_at = 0;
  assert_ok(packing_dem_reload(s.dem));
  dem_run(&s, 100);
  assert_true(dem_hash(s.store) != before);
  dem_scene_free(&s);
  assert_int_equal(a.live, 0);
}

/* A bed that has come to rest, and one that is stirred at constant density. */
static void steps_take_no_memory_once_warm(void **state)
{
  (void)state;
  for (int history = 0; history < 2; history++) {
    test_allocator a = {0};
    dem_scene s;
    dem_scene_init(&s, test_box(0.25, 0.25, 0.25, 7));
    s.context = test_allocator_context(&a);
    dem_material(&s, 1000, 1e8, 0.25, 0, 0);
    dem_hertz(&s, 0);
    if (history) {
      packing_law_custom_def custom;
      packing_law *law = NULL;
      packing_law_custom_def_init(&custom);
      custom.evaluate = ages;
      custom.history_size = 1;
      assert_ok(packing_law_create_custom(NULL, &custom, &law));
      dem_law(&s, law);
    }
    dem_cloud(&s, 0.012, 2, 0.3, 1, 1, 5);
    s.def.dt = 2e-5;
    dem_start(&s);
    const uint64_t rebuilds = dem_run(&s, 1000).rebuilds;
    const size_t warm = a.requests;
    assert_true(dem_run(&s, 1000).rebuilds > rebuilds + 5);
    assert_int_equal(a.requests, warm);
    assert_true(packing_dem_bytes(s.dem) >= a.bytes / 2 &&
                packing_dem_bytes(s.dem) <= 2 * a.bytes);
    dem_scene_free(&s);
    assert_int_equal(a.live, 0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stepper_survives_any_failure),
      cmocka_unit_test(step_out_of_memory),
      cmocka_unit_test(steps_take_no_memory_once_warm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
