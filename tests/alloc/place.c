/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every request of every placer fails once: PACKING_ERR_NOMEM, nothing leaks, a retry gives the
 * same bytes; and a step that failed can be repeated. */
#include "test.h"

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

static packing_status box(packing_context *context, made *m, double edge,
                          unsigned periodic)
{
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size.x = def.size.y = def.size.z = edge;
  def.periodic = periodic;
  return packing_domain_create_box(context, &def, &m->domain);
}

static packing_status sizes(packing_context *context, made *m, double min_r, double max_r)
{
  if (min_r < max_r) {
    packing_psd_uniform_def def;
    packing_psd_uniform_def_init(&def);
    def.min_r = min_r;
    def.max_r = max_r;
    return packing_psd_create_uniform(context, &def, &m->psd);
  }
  packing_psd_mono_def def;
  packing_psd_mono_def_init(&def);
  def.r = max_r;
  return packing_psd_create_mono(context, &def, &m->psd);
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

static packing_status rsa(packing_context *context, uint64_t *hash, double min_r,
                          packing_rsa_def *def)
{
  made m = {0};
  packing_status status = box(context, &m, 9, 7);
  if (status == PACKING_OK)
    status = sizes(context, &m, min_r, 0.5);
  if (status == PACKING_OK)
    status = packing_particles_create(context, NULL, &m.store);
  if (status == PACKING_OK)
    status = packing_rsa_create(context, def, m.domain, m.psd, m.store, &m.placer);
  if (status == PACKING_OK)
    status = run(&m, hash);
  unmake(&m);
  return status;
}

static packing_status saturated(packing_context *context, uint64_t *hash)
{
  return rsa(context, hash, 0.5, NULL);
}

static packing_status counted(packing_context *context, uint64_t *hash)
{
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 400;
  return rsa(context, hash, 0.5, &def);
}

static packing_status descending(packing_context *context, uint64_t *hash)
{
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.count = 900;
  def.order = PACKING_ORDER_DESCENDING;
  return rsa(context, hash, 0.05, &def);
}

static packing_status cells(packing_context *context, uint64_t *hash)
{
  made m = {0};
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.count = 500;
  packing_status status = box(context, &m, 9, 0);
  if (status == PACKING_OK)
    status = sizes(context, &m, 0.2, 0.4);
  if (status == PACKING_OK)
    status = packing_particles_create(context, NULL, &m.store);
  if (status == PACKING_OK)
    status = packing_lattice_create(context, &def, m.domain, m.psd, m.store, &m.placer);
  if (status == PACKING_OK)
    status = run(&m, hash);
  unmake(&m);
  return status;
}

/* A crystal cut to a cylinder, round a particle that stands. */
static packing_status crystal(packing_context *context, uint64_t *hash)
{
  made m = {0};
  packing_domain_cylinder_def round;
  packing_lattice_def def;
  const packing_vec3 centre = {0.5, 0.25, 3};
  packing_domain_cylinder_def_init(&round);
  round.radius = 4.5;
  round.height = 7;
  packing_lattice_def_init(&def);
  def.kind = PACKING_LATTICE_HCP;
  packing_status status = packing_domain_create_cylinder(context, &round, &m.domain);
  if (status == PACKING_OK)
    status = sizes(context, &m, 0.2, 0.4);
  if (status == PACKING_OK)
    status = packing_particles_create(context, NULL, &m.store);
  if (status == PACKING_OK)
    status = packing_particles_add(m.store, centre, 1.5, NULL);
  if (status == PACKING_OK)
    status = packing_lattice_create(context, &def, m.domain, m.psd, m.store, &m.placer);
  if (status == PACKING_OK)
    status = run(&m, hash);
  unmake(&m);
  return status;
}

/* Equal discs until no more fits. */
static packing_status discs(packing_context *context, uint64_t *hash)
{
  made m = {0};
  packing_domain_annulus_def ring;
  packing_particles_def flat;
  packing_domain_annulus_def_init(&ring);
  ring.inner_radius = 2;
  ring.outer_radius = 7;
  packing_particles_def_init(&flat);
  flat.dim = 2;
  packing_status status = packing_domain_create_annulus(context, &ring, &m.domain);
  if (status == PACKING_OK)
    status = sizes(context, &m, 0.5, 0.5);
  if (status == PACKING_OK)
    status = packing_particles_create(context, &flat, &m.store);
  if (status == PACKING_OK)
    status = packing_rsa_create(context, NULL, m.domain, m.psd, m.store, &m.placer);
  if (status == PACKING_OK)
    status = run(&m, hash);
  unmake(&m);
  return status;
}

static void every_request_fails_once(void **state)
{
  (void)state;
  assert_true(test_every_allocation(saturated) >= 12);
  assert_true(test_every_allocation(counted) >= 10);
  assert_true(test_every_allocation(descending) >= 10);
  assert_true(test_every_allocation(cells) >= 5);
  assert_true(test_every_allocation(crystal) >= 5);
  assert_true(test_every_allocation(discs) >= 12);
}

/* The k-th request of stepping fails; stepping on gives the pack of an undisturbed run. */
static uint64_t stepped(double min_r, size_t fail_at, size_t *requests)
{
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  made m = {0};
  uint64_t hash = 0;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.max_failures = 20000;
  assert_ok(box(context, &m, 9, 7));
  assert_ok(sizes(context, &m, min_r, 0.5));
  assert_ok(packing_particles_create(context, NULL, &m.store));
  assert_ok(packing_rsa_create(context, &def, m.domain, m.psd, m.store, &m.placer));
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
  for (int k = 0; k < 2; k++) {
    const double min_r = k == 0 ? 0.5 : 0.35;
    size_t requests, ignored;
    const uint64_t hash = stepped(min_r, 0, &requests);
    assert_true(requests > 2);
    for (size_t at = 1; at <= requests; at++)
      assert_true(stepped(min_r, at, &ignored) == hash);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_request_fails_once),
      cmocka_unit_test(steps_go_on_after_a_failure),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
