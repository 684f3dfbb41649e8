/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every request of the front's paper mode fails once: PACKING_ERR_NOMEM, nothing leaks, a retry gives
 * the same bytes; a step that failed can be repeated. */
#include "cluster.h"
#include "front_scenes.h"

typedef struct made {
  packing_domain *domain;
  packing_psd *psd;
  packing_particles *store;
  packing_shape *shape;
  packing_placer *placer;
} made;

static void unmake(made *m)
{
  packing_placer_destroy(m->placer);
  packing_shape_destroy(m->shape);
  packing_particles_destroy(m->store);
  packing_psd_destroy(m->psd);
  packing_domain_destroy(m->domain);
}

/* What is under test: a container, sizes, options. */
typedef struct setting {
  int round, list, cluster;
  packing_front_direction direction;
  packing_front_select select;
  int stands; /* particles stand in the store */
} setting;

/* Some 300 small ones at the floor: more than the list of the front has to spare. */
static packing_status add_floor(packing_particles *store)
{
  for (int i = 0; i < 7; i++)
    for (int j = 0; j < 7; j++)
      for (int k = 0; k < 6; k++) {
        const packing_vec3 at = {0.6 + 1.3 * i, 0.6 + 1.3 * j, 0.3 + 0.25 * k};
        const packing_status status = packing_particles_add(store, at, 0.1, NULL);
        if (status != PACKING_OK)
          return status;
      }
  return PACKING_OK;
}

static packing_status make(packing_context *context, const setting *set, made *m)
{
  const packing_front_class classes[2] = {{0.9, 40}, {0.4, 20}};
  packing_front_def def = front_paper();
  packing_status status;
  def.direction = set->direction;
  def.select_particle = set->select;
  if (set->round) {
    packing_domain_cylinder_def room;
    packing_domain_cylinder_def_init(&room);
    room.radius = 4.3;
    room.height = 9;
    status = packing_domain_create_cylinder(context, &room, &m->domain);
  } else {
    packing_domain_box_def room;
    packing_domain_box_def_init(&room);
    room.size.x = room.size.y = room.size.z = 9;
    status = packing_domain_create_box(context, &room, &m->domain);
  }
  packing_psd_uniform_def sizes;
  packing_psd_uniform_def_init(&sizes);
  sizes.min_r = 0.6;
  sizes.max_r = 1.1;
  if (set->list) {
    def.classes = classes;
    def.class_count = 2;
  } else if (status == PACKING_OK) {
    status = packing_psd_create_uniform(context, &sizes, &m->psd);
  }
  if (set->cluster) {
    def.contact = packing_contact_direct();
    def.count = 20;
    if (status == PACKING_OK)
      status = test_cluster_create(context, 0.6, 1, &m->shape);
    def.shape = m->shape;
  }
  if (status == PACKING_OK)
    status = packing_particles_create(context, NULL, &m->store);
  if (status == PACKING_OK && set->stands)
    status = add_floor(m->store);
  if (status == PACKING_OK)
    status = packing_front_create(context, &def, m->domain, m->psd, m->store, &m->placer);
  return status;
}

static packing_status run(made *m, uint64_t *hash)
{
  packing_placer_report report;
  packing_placer_report_init(&report);
  do {
    const packing_status status = packing_placer_step(m->placer, 3, &report);
    if (status != PACKING_OK)
      return status;
  } while (report.state == PACKING_PLACER_RUNNING);
  *hash = test_hash_particles(m->store);
  return PACKING_OK;
}

static const setting settings[] = {
    {0, 0, 0, PACKING_FRONT_OUTWARD, PACKING_FRONT_RANDOM, 0},
    {1, 0, 0, PACKING_FRONT_INWARD, PACKING_FRONT_FIFO, 0},
    {0, 1, 0, PACKING_FRONT_INWARD, PACKING_FRONT_LIFO, 0},
    {0, 0, 1, PACKING_FRONT_OUTWARD, PACKING_FRONT_RANDOM, 0},
    {0, 0, 0, PACKING_FRONT_OUTWARD, PACKING_FRONT_RANDOM, 1},
};

static packing_status scenario(packing_context *context, uint64_t *hash, size_t k)
{
  made m = {0};
  packing_status status = make(context, &settings[k], &m);
  if (status == PACKING_OK)
    status = run(&m, hash);
  unmake(&m);
  return status;
}

static packing_status outward(packing_context *context, uint64_t *hash)
{
  return scenario(context, hash, 0);
}

static packing_status inward(packing_context *context, uint64_t *hash)
{
  return scenario(context, hash, 1);
}

static packing_status listed(packing_context *context, uint64_t *hash)
{
  return scenario(context, hash, 2);
}

static packing_status clusters(packing_context *context, uint64_t *hash)
{
  return scenario(context, hash, 3);
}

static packing_status above_a_floor(packing_context *context, uint64_t *hash)
{
  return scenario(context, hash, 4);
}

static void every_request_fails_once(void **state)
{
  (void)state;
  assert_true(test_every_allocation(outward) >= 15);
  assert_true(test_every_allocation(inward) >= 15);
  assert_true(test_every_allocation(listed) >= 15);
  assert_true(test_every_allocation(clusters) >= 15);
  assert_true(test_every_allocation(above_a_floor) >= 15);
}

/* The k-th request of stepping fails; stepping on gives the pack of an undisturbed run. */
static uint64_t stepped(const setting *set, size_t fail_at, size_t *requests)
{
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  made m = {0};
  uint64_t hash = 0;
  assert_ok(make(context, set, &m));
  const size_t before = a.requests;
  a.fail_at = fail_at == 0 ? 0 : before + fail_at;
  packing_status status = run(&m, &hash);
  if (status == PACKING_ERR_NOMEM)
    status = run(&m, &hash);
  assert_ok(status);
  *requests = a.requests - before;
  unmake(&m);
  packing_context_destroy(context);
  assert_int_equal(a.live, 0);
  return hash;
}

static void steps_go_on_after_a_failure(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof settings / sizeof *settings; k++) {
    size_t requests, ignored;
    const uint64_t hash = stepped(&settings[k], 0, &requests);
    assert_true(requests > 2);
    for (size_t at = 1; at <= requests; at++)
      assert_true(stepped(&settings[k], at, &ignored) == hash);
  }
}

/* Asking for the members fails once. */
static packing_status members(packing_context *context, uint64_t *hash)
{
  made m = {0};
  size_t index[64], count = 0;
  packing_status status = make(context, &settings[0], &m);
  if (status == PACKING_OK)
    status = packing_placer_step(m.placer, 1, NULL);
  if (status == PACKING_OK)
    status = packing_front_members(m.placer, 64, index, &count);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &count, sizeof count);
  unmake(&m);
  return status;
}

static void members_fail_once(void **state)
{
  (void)state;
  assert_true(test_every_allocation(members) >= 10);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_request_fails_once),
      cmocka_unit_test(steps_go_on_after_a_failure),
      cmocka_unit_test(members_fail_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
