/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Same bytes from the stepper: any threads, instruction set, order of blocks, division of the
 * steps among calls; and the bytes of this version, which only + - * / and sqrt went into. */
#include "dem_scenes.h"

/* A scene to step: everything but the context. */
typedef void (*scene_maker)(dem_scene *s);

static void two_materials(dem_scene *s)
{
  dem_material(s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_material(s, 2600, 3e8, 0.4, 0.3, 0.6);
}

/* Walls, gravity, drag, friction, sizes 1 : 4. */
static void drum(dem_scene *s)
{
  packing_domain_cylinder_def def;
  packing_domain *domain = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = 0.2;
  def.height = 0.5;
  def.base = dem_vec(0.1, -0.2, 0.3);
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  dem_scene_init(s, domain);
  two_materials(s);
  s->def.max_start_overlap = 0.1; /* it is reloaded in full motion */
  dem_hertz(s, 0);
  dem_sliding(s, 0.01);
  dem_cloud(s, 0.006, 4, 0.25, 2, 1, 1);
  s->def.gravity = dem_vec(1, 0, -20);
  s->def.drag = 0.01;
  s->def.fluid_velocity = dem_vec(0, 1, 0);
  s->def.wall_material = 1;
  s->def.dt = 1e-5;
}

/* A periodic cell, pulling contacts, arms of the paper. */
static void cell(dem_scene *s)
{
  dem_scene_init(s, test_box(0.4, 0.35, 0.3, 7));
  two_materials(s);
  s->def.max_start_overlap = 0.1; /* it is reloaded in full motion */
  dem_hertz(s, 1);
  dem_sliding(s, 0.01);
  dem_cloud(s, 0.014, 1, 0.3, 1, 2, 2);
  s->def.arm = PACKING_ARM_RADIUS;
  s->def.dt = 1e-5;
}

/* The plane, periodic across, a floor. */
static void plane(dem_scene *s)
{
  dem_scene_init(s, test_rectangle(1, 0.5, PACKING_PERIODIC_X));
  dem_material(s, 1000, 1e8, 0.25, 0.1, 0.2);
  s->def.max_start_overlap = 0.1;
  dem_hertz(s, 0);
  dem_sliding(s, 0.001);
  dem_cloud(s, 0.007, 2, 0.45, 1, 1, 3);
  s->def.gravity.y = -20;
  s->def.dt = 2e-5;
}

static uint64_t run(scene_maker make, packing_context *context, const uint64_t *parts)
{
  dem_scene s;
  make(&s);
  s.context = context;
  dem_start(&s);
  for (; *parts > 0; parts++)
    dem_run(&s, *parts);
  const uint64_t hash = dem_hash(s.store);
  dem_scene_free(&s);
  return hash;
}

static const uint64_t whole[] = {180, 0};
static const uint64_t by_parts[][6] = {
    {1, 179, 0}, {179, 1, 0}, {7, 11, 13, 149, 0}, {90, 90, 0}};

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
  def.threads = 4;
  def.parallel = backwards;
  assert_ok(packing_context_create(&def, &context));
  return context;
}

static void check(scene_maker make, uint64_t golden)
{
  const uint64_t hash = run(make, NULL, whole);
  for (size_t t = 0; t < TEST_TEAMS; t++)
    assert_true(run(make, test_team(t), whole) == hash);
  assert_true(run(make, backwards_context(), whole) == hash);
  for (size_t k = 0; k < sizeof by_parts / sizeof *by_parts; k++)
    assert_true(run(make, NULL, by_parts[k]) == hash);
  if (hash != golden)
    print_error("hash 0x%016llx, golden 0x%016llx\n", (unsigned long long)hash,
                (unsigned long long)golden);
  assert_true(hash == golden);
}

static void spheres_in_a_drum(void **state)
{
  (void)state;
  check(drum, UINT64_C(0xaa481999f05690c3));
}

static void spheres_in_a_cell(void **state)
{
  (void)state;
  check(cell, UINT64_C(0x835bbed29f851108));
}

static void discs_in_the_plane(void **state)
{
  (void)state;
  check(plane, UINT64_C(0x41ab9b54ddea06f4));
}

/* One call a step is the same as one call. */
static void single_steps(void **state)
{
  (void)state;
  dem_scene s;
  cell(&s);
  dem_start(&s);
  for (int k = 0; k < 180; k++)
    dem_run(&s, 1);
  assert_true(dem_hash(s.store) == run(cell, NULL, whole));
  dem_scene_free(&s);
}

/* Puts one more particle into a hole of a periodic or closed box of the bounds: tries until the
 * stepper takes it. */
static void pour_one(dem_scene *s, uint64_t seed)
{
  packing_bounds in;
  packing_domain_bounds(s->domain, &in);
  uint64_t random = seed;
  for (int k = 0; k < 100; k++) {
    dem_body b = {.v = {1, -1, 1}, .r = 0.002, .type = 2};
    b.x.x = in.lo.x + (in.hi.x - in.lo.x) * dem_random(&random);
    b.x.y = in.lo.y + (in.hi.y - in.lo.y) * dem_random(&random);
    b.x.z = in.lo.z + (in.hi.z - in.lo.z) * dem_random(&random);
    const size_t at = dem_add(s, &b);
    if (packing_dem_reload(s->dem) == PACKING_OK)
      return;
    packing_particles_truncate(s->store, at);
  }
  fail_msg("no hole: %s", packing_context_message(s->context));
}

/* 1 thread and plain C against 3 threads and the best instructions, step by step, with particles
 * added on the way: the first step that differs is told. */
static void lockstep(void **state)
{
  (void)state;
  dem_scene a, b;
  drum(&a);
  drum(&b);
  a.context = test_context(1, PACKING_ISA_BASELINE);
  b.context = test_context(3, PACKING_ISA_AUTO);
  dem_start(&a);
  dem_start(&b);
  for (int k = 0; k < 150; k++) {
    if (k == 50 || k == 100) {
      pour_one(&a, (uint64_t)k);
      pour_one(&b, (uint64_t)k);
    }
    const packing_dem_report left = dem_run(&a, 1), right = dem_run(&b, 1);
    if (memcmp(&left, &right, sizeof left) != 0 || dem_hash(a.store) != dem_hash(b.store))
      fail_msg("step %d differs", k);
  }
  dem_scene_free(&a);
  dem_scene_free(&b);
}

/* A scene that is stepped, given more particles, reloaded and stepped again. */
static uint64_t poured(packing_context *context, const uint64_t *parts)
{
  dem_scene s;
  cell(&s);
  s.context = context;
  dem_start(&s);
  for (uint64_t k = 0; k < 3; k++) {
    for (const uint64_t *p = parts; *p > 0; p++)
      dem_run(&s, *p);
    pour_one(&s, 77 + k);
  }
  dem_run(&s, 100);
  const uint64_t hash = dem_hash(s.store);
  dem_scene_free(&s);
  return hash;
}

static void added_particles(void **state)
{
  (void)state;
  static const uint64_t thirty[] = {30, 0}, parts[] = {1, 9, 20, 0};
  const uint64_t hash = poured(NULL, thirty);
  assert_true(poured(test_context(3, PACKING_ISA_AUTO), parts) == hash);
  assert_true(poured(test_context(2, PACKING_ISA_BASELINE), thirty) == hash);
}

/* A stepper made anew from the store at every turn goes on like one that never stopped, but for
 * the order in which forces are added up: equal to rounding. */
static void made_anew(void **state)
{
  (void)state;
  dem_scene a, b;
  plane(&a);
  plane(&b);
  dem_start(&a);
  for (int k = 0; k < 10; k++) {
    dem_run(&a, 10);
    dem_start(&b);
    dem_run(&b, 10);
  }
  for (size_t i = 0; i < packing_particles_count(a.store); i++) {
    const dem_body x = dem_get(&a, i), y = dem_get(&b, i);
    const packing_vec3 d = packing_domain_separation(a.domain, &x.x, &y.x);
    assert_near(sqrt(d.x * d.x + d.y * d.y), 0, 1e-9 * x.r);
  }
  dem_scene_free(&a);
  dem_scene_free(&b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(spheres_in_a_drum),  cmocka_unit_test(spheres_in_a_cell),
      cmocka_unit_test(discs_in_the_plane), cmocka_unit_test(single_steps),
      cmocka_unit_test(lockstep),           cmocka_unit_test(added_particles),
      cmocka_unit_test(made_anew),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
