/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every request of the advancing front, fast and dense, fails once: PACKING_ERR_NOMEM, nothing
 * leaks, the store is as it was when nothing could be made, and valid when a step failed; a step
 * that failed can be repeated and gives the bytes of an undisturbed run. */
#include "pocket_scenes.h"
#include "solids.h"

typedef struct made {
  packing_domain *domain;
  packing_psd *psd;
  packing_particles *store;
  packing_placer *placer;
} made;

static void unmake(made *m)
{
  packing_placer_destroy(m->placer);
  packing_particles_destroy(m->store);
  packing_psd_destroy(m->psd);
  packing_domain_destroy(m->domain);
}

typedef struct task {
  scene room;
  double min_r, max_r;
  packing_front_mode mode;
  packing_front_direction direction;
  size_t count;
  int obstacles;
  int chambers; /* more than one: beside the room stand others like it */
} task;

static const task tasks[] = {
    {{SCENE_BOX, 5, 4.5, 4, 0, {0, 0, 0}, 2, 0, 0},
     0.5,
     0.5,
     PACKING_FRONT_DENSE,
     0,
     40,
     1,
     0},
    {{SCENE_BOX, 5, 4.5, 4, 0, {0, 0, 0}, 2, 0, 7},
     0.3,
     0.7,
     PACKING_FRONT_FAST,
     0,
     40,
     0,
     0},
    {{SCENE_CYLINDER, 3, 5, 0, 0, {0, 0, 0}, 2, 0, 0},
     0.3,
     0.7,
     PACKING_FRONT_DENSE,
     1,
     40,
     0,
     0},
    {{SCENE_RECTANGLE, 16, 15, 0, 0, {0, 0, 0}, 1, 0, 1},
     0.3,
     0.7,
     PACKING_FRONT_DENSE,
     0,
     60,
     2,
     0},
    {{SCENE_RECTANGLE, 6, 5, 0, 0, {0, 0, 0}, 1, 0, 0},
     0.5,
     0.5,
     PACKING_FRONT_FAST,
     0,
     0,
     0,
     2},
};
enum { TASKS = sizeof tasks / sizeof *tasks };

/* All but the placer; made without failures. */
static made begin(const task *t)
{
  made m = {0};
  m.domain = scene_make(&t->room);
  for (int c = 1; c < t->chambers; c++) {
    scene other = t->room;
    other.at.x += 4 * c * t->room.a;
    m.domain = solid_of(PACKING_UNION, m.domain, scene_make(&other));
  }
  m.psd = t->min_r < t->max_r ? test_uniform(t->min_r, t->max_r) : test_mono(t->max_r);
  return m;
}

static packing_status fill(packing_context *context, const task *t, made *m)
{
  packing_particles_def flat;
  packing_particles_def_init(&flat);
  flat.dim = packing_domain_dim(m->domain);
  packing_status status = packing_particles_create(context, &flat, &m->store);
  for (int k = 0; k < t->obstacles && status == PACKING_OK; k++)
    status = packing_particles_add(
        m->store, pocket_at(2 + 2.5 * k, 2, flat.dim == 2 ? 0 : 2), 0.9, NULL);
  if (status != PACKING_OK)
    return status;
  packing_front_def def = pocket_def(t->mode);
  def.direction = t->direction;
  def.count = t->count;
  status = packing_front_create(context, &def, m->domain, m->psd, m->store, &m->placer);
  if (status != PACKING_OK) {
    assert_null(m->placer);
    assert_int_equal(packing_particles_count(m->store), t->obstacles);
  }
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

static const task *at_work;

static packing_status whole(packing_context *context, uint64_t *hash)
{
  made m = begin(at_work);
  packing_status status = fill(context, at_work, &m);
  if (status == PACKING_OK)
    status = run(&m, hash);
  size_t count = 0;
  if (status == PACKING_OK)
    status = packing_front_members(m.placer, 0, NULL, &count);
  unmake(&m);
  return status;
}

static void every_request_fails_once(void **state)
{
  (void)state;
  for (int k = 0; k < TASKS; k++) {
    at_work = &tasks[k];
    assert_true(test_every_allocation(whole) >= 15);
  }
}

/* A run whose `fail_at`-th request of stepping fails, and goes on. */
static uint64_t stepped(packing_context *context, test_allocator *a, const task *t,
                        size_t fail_at, size_t rounds, size_t *requests)
{
  made m = begin(t);
  uint64_t hash = 0;
  assert_ok(fill(context, t, &m));
  const size_t before = a->requests;
  a->fail_at = fail_at == 0 ? 0 : before + fail_at;
  packing_placer_report report;
  packing_placer_report_init(&report);
  int failures = 0;
  for (size_t n = 0; n < rounds && report.state == PACKING_PLACER_RUNNING;) {
    const packing_status status = packing_placer_step(m.placer, 1, &report);
    if (status == PACKING_OK) {
      n++;
      continue;
    }
    assert_int_equal(status, PACKING_ERR_NOMEM);
    assert_int_equal(failures++, 0);
    pocket_audit(m.domain, m.store);
  }
  assert_int_equal(failures, fail_at != 0);
  hash = test_hash_particles(m.store);
  *requests = a->requests - before;
  a->fail_at = 0;
  unmake(&m);
  return hash;
}

static void steps_go_on_after_a_failure(void **state)
{
  (void)state;
  for (int k = 0; k < TASKS; k++) {
    test_allocator a = {0};
    packing_context *context = test_allocator_context(&a);
    size_t requests, ignored;
    const uint64_t hash = stepped(context, &a, &tasks[k], 0, SIZE_MAX, &requests);
    for (size_t at = 1; at <= requests; at++)
      assert_true(stepped(context, &a, &tasks[k], at, SIZE_MAX, &ignored) == hash);
    packing_context_destroy(context);
    assert_int_equal(a.live, 0);
  }
}

/* The lanes side by side, every so many requests. */
static void lanes_go_on_after_a_failure(void **state)
{
  (void)state;
  static const task large = {{SCENE_BOX, 110, 111, 112, 0, {0, 0, 0}, 2, 0, 4},
                             0.7,
                             1.3,
                             PACKING_FRONT_FAST,
                             0,
                             0,
                             0,
                             0};
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  size_t requests, ignored;
  const uint64_t hash = stepped(context, &a, &large, 0, 14, &requests);
  assert_true(requests > 10);
  for (size_t at = 1; at <= requests; at += 1 + requests / 2)
    assert_true(stepped(context, &a, &large, at, 14, &ignored) == hash);
  packing_context_destroy(context);
  assert_int_equal(a.live, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_request_fails_once),
      cmocka_unit_test(steps_go_on_after_a_failure),
      cmocka_unit_test(lanes_go_on_after_a_failure),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
