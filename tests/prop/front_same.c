/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One seed, one pack: whatever the threads, the instruction set, the budget of a step and the unit
 * of length, fast and dense. */
#include "pocket_scenes.h"

/* Large enough for the lanes to work side by side, stopped soon after they have begun to: the
 * start is the same for all, so the seconds go into what differs. */
typedef struct large {
  scene room;
  double min_r;
} large;

static const large many[] = {
    {{SCENE_BOX, 110, 111, 112, 0, {0, 0, 0}, 2, 0, 0}, 0.7},
    {{SCENE_BOX, 110, 111, 112, 0, {-50, 20, 0}, 2, 0, 7}, 0.7},
    {{SCENE_CYLINDER, 62, 118, 0, 0, {0, 0, 0}, 2, 0, 0}, 0.7},
    {{SCENE_RECTANGLE, 470, 460, 0, 0, {0, 0, 0}, 1, 0, 3}, 0.7},
    {{SCENE_CIRCLE, 260, 0, 0, 0, {0, 0, 0}, 1, 0, 0}, 0.7},
};

static uint64_t steps(packing_context *context, const packing_front_def *def,
                      packing_domain *domain, packing_psd *psd, size_t rounds,
                      size_t budget, int look)
{
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_placer *placer = NULL;
  packing_placer_report report;
  packing_placer_report_init(&report);
  assert_ok(packing_front_create(context, def, domain, psd, store, &placer));
  for (size_t n = 0; n < rounds && report.state == PACKING_PLACER_RUNNING; n += budget)
    assert_ok(packing_placer_step(placer, budget, &report));
  packing_placer_destroy(placer);
  if (look)
    pocket_audit(domain, store);
  const uint64_t hash = test_hash_particles(store);
  packing_particles_destroy(store);
  return hash;
}

/* Threads and the widest instruction set there is up to so much. */
static packing_context *workers(int threads, packing_isa isa)
{
  while (!packing_isa_available(isa))
    isa = (packing_isa)((int)isa - 1);
  return test_context(threads, isa);
}

static const struct {
  int threads;
  packing_isa isa;
} teams[] = {{1, PACKING_ISA_BASELINE},
             {2, PACKING_ISA_AVX2},
             {3, PACKING_ISA_AVX512},
             {8, PACKING_ISA_BASELINE}};
enum { TEAMS = sizeof teams / sizeof *teams };

/* The lanes side by side. */
static void for_all_threads_and_sets(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof many / sizeof *many; k++)
    for (int mode = 0; mode < 2; mode++) {
      packing_domain *domain = scene_make(&many[k].room);
      packing_psd *psd = test_uniform(many[k].min_r, 1.3);
      packing_front_def def = pocket_def(pocket_modes[mode]);
      def.direction = (packing_front_direction)((k + (size_t)mode) % 2);
      uint64_t hash = 0;
      for (size_t t = 0; t < TEAMS; t++) {
        packing_context *context = workers(teams[t].threads, teams[t].isa);
        const uint64_t now = steps(context, &def, domain, psd, 40, 20, t == 1);
        packing_context_destroy(context);
        assert_true(t == 0 || now == hash);
        hash = now;
      }
      packing_psd_destroy(psd);
      packing_domain_destroy(domain);
    }
}

/* A whole pack of one lane. */
static void for_all_budgets_and_sets(void **state)
{
  (void)state;
  static const size_t budgets[TEAMS] = {1, 2, 7, 100000};
  for (int dim = 2; dim <= 3; dim++)
    for (int mode = 0; mode < 2; mode++) {
      packing_domain *domain =
          dim == 2 ? test_rectangle(60, 50, 1) : test_box(16, 15, 14, 4);
      packing_psd *psd = test_uniform(0.5, 1.3);
      const packing_front_def def = pocket_def(pocket_modes[mode]);
      uint64_t hash = 0;
      for (size_t t = 0; t < TEAMS; t++) {
        packing_context *context = workers(teams[t].threads, teams[t].isa);
        const uint64_t now =
            steps(context, &def, domain, psd, SIZE_MAX / 2, budgets[t], 1);
        packing_context_destroy(context);
        assert_true(t == 0 || now == hash);
        hash = now;
      }
      packing_psd_destroy(psd);
      packing_domain_destroy(domain);
    }
}

/* Stopped after any step, what stands is a pack and counted right; other seeds and streams give
 * others. */
static void after_any_step(void **state)
{
  (void)state;
  for (int mode = 0; mode < 2; mode++) {
    packing_domain *domain = test_box(17, 16, 15, 0);
    packing_psd *psd = test_uniform(0.5, 1.3);
    packing_particles *store = test_store(3);
    packing_placer *placer = NULL;
    packing_front_def def = pocket_def(pocket_modes[mode]);
    packing_placer_report report;
    packing_placer_report_init(&report);
    assert_ok(packing_front_create(NULL, &def, domain, psd, store, &placer));
    double progress = 0;
    while (report.state == PACKING_PLACER_RUNNING) {
      assert_ok(packing_placer_step(placer, 1, &report));
      const double *r = pocket_radii(store);
      double solid = 0;
      for (size_t i = 0; i < packing_particles_count(store); i++)
        solid += 4.0 / 3.0 * TEST_PI * r[i] * r[i] * r[i];
      assert_int_equal(packing_particles_count(store), report.placed);
      assert_close(report.solid_volume, solid, 1e-12);
      assert_close(report.volume_fraction, solid / (17 * 16 * 15), 1e-12);
      assert_true(report.progress >= progress && report.progress <= 1);
      progress = report.progress;
      pocket_audit(domain, store);
    }
    const uint64_t whole = test_hash_particles(store);
    const size_t placed = report.placed;
    assert_ok(packing_placer_step(placer, 5, &report)); /* it has ended */
    assert_int_equal(report.placed, placed);
    assert_true(test_hash_particles(store) == whole);
    packing_placer_destroy(placer);
    packing_particles_destroy(store);
    def.stream = 1;
    const uint64_t other = steps(NULL, &def, domain, psd, SIZE_MAX / 2, 100, 0);
    def.stream = 0;
    def.seed = 2;
    const uint64_t third = steps(NULL, &def, domain, psd, SIZE_MAX / 2, 100, 0);
    assert_true(whole != other && whole != third && other != third);
    packing_psd_destroy(psd);
    packing_domain_destroy(domain);
  }
}

/* ---- units of length ---- */

static packing_particles *scaled(scene room, double scale, packing_front_def def,
                                 double min_r)
{
  double *const length[] = {&room.a,    &room.b,    &room.c,   &room.d,
                            &room.at.x, &room.at.y, &room.at.z};
  for (size_t k = 0; k < sizeof length / sizeof *length; k++)
    *length[k] *= scale;
  packing_domain *domain = scene_make(&room);
  packing_psd *psd = min_r < 1 ? test_uniform(min_r * scale, scale) : test_mono(scale);
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_placer *placer = NULL;
  assert_ok(packing_front_create(NULL, &def, domain, psd, store, &placer));
  test_run(placer);
  packing_placer_destroy(placer);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  return store;
}

static void same_when_scaled(scene room, packing_front_def def, double min_r)
{
  static const int powers[] = {-140, 140};
  packing_particles *plain = scaled(room, 1, def, min_r);
  packing_view a, b;
  packing_particles_view(plain, &a);
  for (size_t k = 0; k < sizeof powers / sizeof *powers; k++) {
    packing_particles *other = scaled(room, ldexp(1, powers[k]), def, min_r);
    packing_particles_view(other, &b);
    assert_int_equal(a.count, b.count);
    const double *from[4] = {a.x.data, a.y.data, a.z.data, a.r.data};
    const double *to[4] = {b.x.data, b.y.data, b.z.data, b.r.data};
    for (size_t c = 0; c < 4; c++)
      for (size_t i = 0; i < a.count; i++)
        assert_true(ldexp(from[c][i], powers[k]) == to[c][i]);
    packing_particles_destroy(other);
  }
  packing_particles_destroy(plain);
}

static void in_any_unit(void **state)
{
  (void)state;
  static const scene rooms[] = {
      {SCENE_BOX, 9.3, 8.7, 8.1, 0, {1, 2, 3}, 2, 0, 0},
      {SCENE_BOX, 9.3, 8.7, 8.1, 0, {1, 2, 3}, 2, 0, 7},
      {SCENE_CYLINDER, 4.7, 9.1, 0, 0, {1, 2, 3}, 1, 0, 0},
      {SCENE_SILO, 4.9, 12.3, 1.7, 2.9, {0, 0, 0}, 2, 0, 0},
      {SCENE_SPHERE, 5.3, 0, 0, 0, {5, 5, 5}, 2, 0, 0},
      {SCENE_RECTANGLE, 23.1, 21.7, 0, 0, {0, 0, 0}, 1, 0, 1},
      {SCENE_ANNULUS, 6.3, 14.7, 0, 0, {0, 0, 0}, 1, 0, 0},
  };
  for (size_t k = 0; k < sizeof rooms / sizeof *rooms; k++)
    for (int way = 0; way < 4; way++) {
      packing_front_def def = pocket_def(pocket_modes[way & 1]);
      def.direction = (packing_front_direction)(way >> 1);
      same_when_scaled(rooms[k], def, way == 0 ? 1 : 0.4);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(for_all_threads_and_sets),
      cmocka_unit_test(for_all_budgets_and_sets),
      cmocka_unit_test(after_any_step),
      cmocka_unit_test(in_any_unit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
