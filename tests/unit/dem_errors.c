/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every refusal of the stepper on purpose, and that what is refused changes nothing. */
#include "dem_scenes.h"

/* What came through the log. */
typedef struct log_seen {
  int warnings, errors;
  char text[512];
  size_t index;
} log_seen;

static void take(void *user, const packing_log_record *record)
{
  log_seen *seen = user;
  seen->warnings += record->level == PACKING_LOG_WARNING;
  seen->errors += record->level == PACKING_LOG_ERROR;
  seen->index = record->index;
  snprintf(seen->text, sizeof seen->text, "%s", record->message);
}

static packing_context *listening(log_seen *seen)
{
  packing_context_def def;
  packing_context *context = NULL;
  memset(seen, 0, sizeof *seen);
  packing_context_def_init(&def);
  def.threads = 1;
  def.log = take;
  def.log_user = seen;
  assert_ok(packing_context_create(&def, &context));
  return context;
}

/* Four spheres, the last two near each other, in a box of 1; nothing wrong with it. */
static void sound(dem_scene *s, unsigned periodic)
{
  dem_scene_init(s, test_box(1, 1, 1, periodic));
  s->context = test_context(1, PACKING_ISA_AUTO);
  dem_material(s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_material(s, 2000, 1e8, 0.25, 0.1, 0.2);
  dem_hertz(s, 0);
  dem_sliding(s, 1e-2);
  for (int k = 0; k < 4; k++) {
    const dem_body b = {.x = {0.2 + 0.2 * k - (k == 3 ? 0.18 : 0), 0.5, 0.5},
                        .v = {0.1, 0, 0},
                        .r = 0.01,
                        .type = k % 2 + 1};
    dem_add(s, &b);
  }
  s->def.dt = 1e-5;
}

#define assert_refused(s, status, field)                                                 \
  assert_fails((s)->context, dem_try(s), status, field)

static void null_arguments(void **state)
{
  (void)state;
  dem_scene s;
  packing_dem *dem = NULL;
  sound(&s, 0);
  packing_context *c = s.context;
  /* The defaults will do. */
  assert_ok(packing_dem_create(c, NULL, s.domain, s.materials, s.laws, 2, s.store, &dem));
  packing_dem_destroy(dem);
  dem = NULL;
  assert_fails(c,
               packing_dem_create(c, &s.def, NULL, s.materials, s.laws, 2, s.store, &dem),
               PACKING_ERR_INVALID, "domain");
  assert_fails(c, packing_dem_create(c, &s.def, s.domain, NULL, s.laws, 2, s.store, &dem),
               PACKING_ERR_INVALID, "materials");
  assert_fails(
      c, packing_dem_create(c, &s.def, s.domain, s.materials, NULL, 2, s.store, &dem),
      PACKING_ERR_INVALID, "laws");
  assert_fails(
      c, packing_dem_create(c, &s.def, s.domain, s.materials, s.laws, 2, NULL, &dem),
      PACKING_ERR_INVALID, "particles");
  assert_fails(
      c, packing_dem_create(c, &s.def, s.domain, s.materials, s.laws, 2, s.store, NULL),
      PACKING_ERR_INVALID, "dem");
  assert_null(dem);
  packing_dem_advice advice;
  packing_dem_advice_init(&advice);
  assert_status(packing_dem_step(NULL, 1, NULL), PACKING_ERR_INVALID);
  assert_status(packing_dem_reload(NULL), PACKING_ERR_INVALID);
  assert_status(packing_dem_advise(NULL, &advice), PACKING_ERR_INVALID);
  dem_start(&s);
  assert_status(packing_dem_advise(s.dem, NULL), PACKING_ERR_INVALID);
  packing_dem_destroy(NULL);
  dem_scene_free(&s);
}

static void no_laws_is_fine(void **state)
{
  (void)state;
  dem_scene s;
  packing_dem *dem = NULL;
  sound(&s, 0);
  assert_ok(
      packing_dem_create(NULL, &s.def, s.domain, s.materials, NULL, 0, s.store, &dem));
  assert_ok(packing_dem_step(dem, 10, NULL));
  assert_close(dem_get(&s, 0).x.x, 0.2 + 0.1 * 1e-4, 1e-14);
  packing_dem_destroy(dem);
  dem_scene_free(&s);
}

/* Every number of the def, not a number, infinite, and out of range. */
static void bad_fields(void **state)
{
  (void)state;
  static const struct {
    size_t at;
    const char *name;
    int negative_is_fine;
  } fields[] = {
      {offsetof(packing_dem_def, dt), "dt", 0},
      {offsetof(packing_dem_def, gravity.x), "gravity.x", 1},
      {offsetof(packing_dem_def, gravity.y), "gravity.y", 1},
      {offsetof(packing_dem_def, gravity.z), "gravity.z", 1},
      {offsetof(packing_dem_def, drag), "drag", 0},
      {offsetof(packing_dem_def, fluid_velocity.x), "fluid_velocity.x", 1},
      {offsetof(packing_dem_def, fluid_velocity.y), "fluid_velocity.y", 1},
      {offsetof(packing_dem_def, fluid_velocity.z), "fluid_velocity.z", 1},
      {offsetof(packing_dem_def, impact_velocity), "impact_velocity", 0},
      {offsetof(packing_dem_def, max_start_overlap), "max_start_overlap", 0},
  };
  static const double bad[3] = {NAN, INFINITY, -INFINITY};
  dem_scene s;
  sound(&s, 0);
  const packing_dem_def good = s.def;
  for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
    double *field = (double *)(void *)((char *)&s.def + fields[f].at);
    for (int k = 0; k < 3; k++) {
      *field = bad[k];
      assert_refused(&s, PACKING_ERR_INVALID, fields[f].name);
    }
    *field = -1;
    if (fields[f].negative_is_fine)
      assert_ok(dem_try(&s));
    else
      assert_refused(&s, PACKING_ERR_RANGE, fields[f].name);
    s.def = good;
  }
  dem_scene_free(&s);
}

static void bad_choices(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  const packing_dem_def good = s.def;
  s.def.rotations = 2;
  assert_refused(&s, PACKING_ERR_RANGE, "rotations");
  s.def = good;
  s.def.arm = (packing_arm)2;
  assert_refused(&s, PACKING_ERR_RANGE, "arm");
  s.def = good;
  s.def.disc_mass = -1;
  assert_refused(&s, PACKING_ERR_RANGE, "disc_mass");
  s.def.disc_mass = 1; /* of spheres */
  assert_refused(&s, PACKING_ERR_INVALID, "disc_mass");
  s.def = good;
  s.def.wall_material = 2;
  assert_refused(&s, PACKING_ERR_RANGE, "wall_material");
  s.def.wall_material = 1;
  assert_ok(dem_try(&s));
  dem_scene_free(&s);
}

static void flat_scenes(void **state)
{
  (void)state;
  dem_scene s;
  dem_scene_init(&s, test_rectangle(1, 1, 0));
  s.context = test_context(1, PACKING_ISA_AUTO);
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_body b = {.x = {0.5, 0.5, 0}, .r = 0.01};
  dem_add(&s, &b);
  s.def.dt = 1e-5;
  const packing_dem_def good = s.def;
  s.def.gravity.z = -1;
  assert_refused(&s, PACKING_ERR_RANGE, "gravity.z");
  s.def = good;
  s.def.fluid_velocity.z = 1;
  assert_refused(&s, PACKING_ERR_RANGE, "fluid_velocity.z");
  s.def = good;
  assert_ok(dem_try(&s));
  /* Out of the plane there is no motion, and no spin but about z. */
  dem_body out = b;
  out.v.z = 1;
  dem_put(&s, 0, &out);
  assert_refused(&s, PACKING_ERR_INVALID, "particle 0");
  out = b;
  out.w.x = 1;
  dem_put(&s, 0, &out);
  assert_refused(&s, PACKING_ERR_INVALID, "particle 0");
  out = b;
  out.w.z = 1;
  dem_put(&s, 0, &out);
  assert_ok(dem_try(&s));
  dem_scene_free(&s);
}

static void dimensions_differ(void **state)
{
  (void)state;
  dem_scene s;
  packing_dem *dem = NULL;
  packing_domain *flat = test_rectangle(1, 1, 0);
  sound(&s, 0);
  assert_fails(
      s.context,
      packing_dem_create(s.context, &s.def, flat, s.materials, s.laws, 2, s.store, &dem),
      PACKING_ERR_RANGE, "dimension");
  assert_null(dem);
  packing_domain_destroy(flat);
  dem_scene_free(&s);
}

static packing_dem_advice advised(const dem_scene *s)
{
  packing_dem_advice advice;
  packing_dem_advice_init(&advice);
  assert_ok(packing_dem_advise(s->dem, &advice));
  return advice;
}

/* Formula F5 for two of the smallest, at the speed of a fall through the container; the limit by
 * the softer of their contact and that with a wall, at an overlap of 1 % of the radius. */
static void advice_is_equation_23(void **state)
{
  (void)state;
  dem_scene s;
  dem_scene_init(&s, test_box(1, 1, 2, 0));
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_hertz(&s, 0);
  dem_body b = {.x = {0.5, 0.5, 0.5}, .r = 0.02};
  dem_add(&s, &b);
  b.x.x = 0.6;
  b.r = 0.01;
  dem_add(&s, &b);
  s.def.gravity.z = -2;
  dem_start(&s);
  const double m = dem_mass(1000, 0.01) / 2, young = dem_pair_young(1e8, 0.25, 1e8, 0.25);
  const double v = sqrt(2 * 2 * 2), root = sqrt(1.01) - 0.1;
  packing_dem_advice a = advised(&s);
  assert_close(a.impact_velocity, v, 1e-14);
  assert_close(a.collision_time, 2.868265 * pow(m * m / (0.005 * young * young * v), 0.2),
               1e-6);
  /* Pair: E* / 2, m / 2, r / 2; wall: E*, m, r, stiffer by 2 sqrt(2) with 2 m. */
  assert_close(a.limit,
               2 * root / sqrt(2 * 2 * young * sqrt(0.01 * 0.01 * 0.01) / (2 * m)),
               1e-12);
  assert_close(a.advised, fmin(a.collision_time / 5, a.limit / 2), 1e-15);
  assert_near(dem_run(&s, 3).dt, a.advised, 0);
  /* Faster than the fall; then as asked; then without any velocity. */
  b = dem_get(&s, 0);
  b.v = dem_vec(0, 3, 4);
  dem_put(&s, 0, &b);
  assert_ok(packing_dem_reload(s.dem));
  assert_close(advised(&s).impact_velocity, 10.0, 1e-14);
  s.def.impact_velocity = 0.5;
  dem_start(&s);
  assert_near(advised(&s).impact_velocity, 0.5, 0);
  b.v = dem_vec(0, 0, 0);
  dem_put(&s, 0, &b);
  s.def.gravity.z = s.def.impact_velocity = 0;
  b = dem_get(&s, 1);
  b.v = dem_vec(0, 0, 0);
  dem_put(&s, 1, &b);
  dem_start(&s);
  a = advised(&s);
  assert_true(isinf(a.collision_time) && a.impact_velocity == 0);
  assert_near(a.advised, a.limit / 2, 0);
  dem_scene_free(&s);
}

static void unstable_steps(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  dem_start(&s);
  const packing_dem_advice a = advised(&s);
  char text[32];
  snprintf(text, sizeof text, "%.4g", a.advised);
  s.def.dt = a.limit;
  assert_refused(&s, PACKING_ERR_UNSTABLE, text);
  assert_refused(&s, PACKING_ERR_UNSTABLE, "dt");
  s.def.dt = nextafter(a.limit, 0);
  assert_ok(dem_try(&s));
  s.def.dt = 1;
  assert_refused(&s, PACKING_ERR_UNSTABLE, text);
  /* The drag of the smallest particle decides before its contacts do. */
  s.def.drag = 2 * dem_mass(1000, 0.01) / 1e-6;
  s.def.dt = 1.001e-6;
  assert_refused(&s, PACKING_ERR_UNSTABLE, "dt");
  s.def.dt = 0.999e-6;
  assert_ok(dem_try(&s));
  assert_close(advised(&s).limit, 1e-6, 1e-12);
  dem_scene_free(&s);
}

/* The step that is refused does blow up, and one below it does not: a sphere squeezed by 1 % of
 * its radius against a wall by its weight. */
static void the_limit_is_a_limit(void **state)
{
  (void)state;
  for (int beyond = 0; beyond < 2; beyond++) {
    dem_scene s;
    dem_scene_init(&s, test_box(1, 1, 1, 0));
    dem_material(&s, 1000, 1e6, 0.25, 0.1, 0);
    dem_hertz(&s, 1);
    const double sunk = 1e-4 * (beyond ? 1.2 : 0.8);
    const double load = 4.0 / 3 * dem_rigid_young(1e6, 0.25) * 0.1 * pow(sunk, 1.5);
    dem_body b = {.x = {0.5, 0.5, 0.01 - sunk}, .r = 0.01};
    dem_add(&s, &b);
    s.def.gravity.z = -load / dem_mass(1000, 0.01);
    s.def.max_start_overlap = 0.1;
    dem_start(&s);
    s.def.dt = 0.9999 * advised(&s).limit;
    b.x.z += 1e-9;
    dem_put(&s, 0, &b);
    dem_start(&s);
    dem_run(&s, 300);
    const double off = fabs(dem_get(&s, 0).x.z - 0.01 + sunk);
    assert_true(beyond ? off > 1e-6 : off < 1e-9);
    dem_scene_free(&s);
  }
}

static void step_between_advice_and_limit_warns_once(void **state)
{
  (void)state;
  dem_scene s;
  log_seen seen;
  sound(&s, 0);
  packing_context_destroy(s.context);
  s.context = listening(&seen);
  s.def.dt = 0;
  dem_start(&s);
  const packing_dem_advice a = advised(&s);
  s.def.dt = a.advised;
  dem_start(&s);
  dem_run(&s, 100);
  assert_int_equal(seen.warnings + seen.errors, 0);
  s.def.dt = 1.01 * a.advised;
  dem_start(&s);
  dem_run(&s, 100);
  dem_run(&s, 100);
  assert_int_equal(seen.warnings, 1);
  assert_int_equal(seen.errors, 0);
  assert_non_null(strstr(seen.text, "advised"));
  assert_null(strchr(seen.text, '\n'));
  dem_scene_free(&s);
}

/* The pair is named, also across a periodic border; a little overlap is allowed. */
static void overlapping_starts(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, PACKING_PERIODIC_X);
  dem_body b = dem_get(&s, 3);
  b.x.x = 0.6 + 0.02 - 1.01e-4;
  dem_put(&s, 3, &b);
  assert_refused(&s, PACKING_ERR_RANGE, "2 and 3");
  assert_refused(&s, PACKING_ERR_RANGE, "max_start_overlap");
  b.x.x = 0.6 + 0.02 - 0.99e-4;
  dem_put(&s, 3, &b);
  assert_ok(dem_try(&s));
  s.def.max_start_overlap = 0;
  assert_refused(&s, PACKING_ERR_RANGE, "2 and 3");
  b.x.x = 0.995;
  dem_put(&s, 3, &b);
  b = dem_get(&s, 0);
  b.x.x = 0.005;
  dem_put(&s, 0, &b);
  assert_refused(&s, PACKING_ERR_RANGE, "0 and 3");
  /* Of unequal ones the smaller radius counts. */
  s.def.max_start_overlap = 0.01;
  b.x = dem_vec(0.4, 0.5 + 0.11 - 2e-4, 0.5);
  b.r = 0.1;
  dem_add(&s, &b);
  b = dem_get(&s, 0);
  b.x.x = 0.1;
  dem_put(&s, 0, &b);
  assert_refused(&s, PACKING_ERR_RANGE, "1 and 4");
  dem_scene_free(&s);
}

static void starts_at_walls(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  const dem_body good = dem_get(&s, 1);
  dem_body b = good;
  b.x.z = 1.001;
  dem_put(&s, 1, &b);
  assert_refused(&s, PACKING_ERR_GEOMETRY, "particle 1");
  b.x.z = 0.008; /* a fifth of the radius in the wall */
  dem_put(&s, 1, &b);
  assert_refused(&s, PACKING_ERR_RANGE, "particle 1");
  b.x.z = 0.0099001;
  dem_put(&s, 1, &b);
  assert_ok(dem_try(&s));
  dem_scene_free(&s);
}

static void types_need_materials(void **state)
{
  (void)state;
  static const int32_t bad[] = {0, -1, 3, INT32_MAX, INT32_MIN};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    dem_scene s;
    int32_t types[4] = {1, 2, 1, 2};
    sound(&s, 0);
    types[2] = bad[k];
    assert_ok(packing_particles_set(s.store, PACKING_FIELD_TYPE, types, sizeof *types));
    assert_refused(&s, PACKING_ERR_RANGE, "particle 2");
    types[2] = 2;
    assert_ok(packing_particles_set(s.store, PACKING_FIELD_TYPE, types, sizeof *types));
    assert_ok(dem_try(&s));
    dem_scene_free(&s);
  }
}

static void no_materials(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  packing_materials_destroy(s.materials);
  assert_ok(packing_materials_create(s.context, &s.materials));
  assert_refused(&s, PACKING_ERR_RANGE, "materials");
  dem_scene_free(&s);
}

static void narrow_periodic_cells(void **state)
{
  (void)state;
  for (int axis = 0; axis < 3; axis++) {
    dem_scene s;
    packing_vec3 size = {1, 1, 1};
    double *narrow = axis == 0 ? &size.x : axis == 1 ? &size.y : &size.z;
    *narrow = 0.079; /* less than two diameters of .02 */
    dem_scene_init(&s, test_box(size.x, size.y, size.z, 1U << axis));
    s.context = test_context(1, PACKING_ISA_AUTO);
    dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.2);
    dem_hertz(&s, 0);
    const dem_body b = {.x = {0.05, 0.05, 0.05}, .r = 0.02};
    dem_add(&s, &b);
    s.def.dt = 1e-6;
    assert_refused(&s, PACKING_ERR_GEOMETRY, "periodic");
    dem_scene_free(&s);
  }
  /* A near field reaches further than contacts. */
  dem_scene s;
  sound(&s, PACKING_PERIODIC_Y);
  assert_ok(dem_try(&s));
  dem_near_field(&s, 1, 1, 0, 0, 0.501);
  assert_refused(&s, PACKING_ERR_GEOMETRY, "periodic");
  dem_scene_free(&s);
}

static void too_many_laws(void **state)
{
  (void)state;
  dem_scene s;
  packing_law *laws[17];
  packing_dem *dem = NULL;
  sound(&s, 0);
  for (int k = 0; k < 17; k++)
    laws[k] = s.laws[0];
  assert_fails(s.context,
               packing_dem_create(s.context, &s.def, s.domain, s.materials, laws, 17,
                                  s.store, &dem),
               PACKING_ERR_RANGE, "law_count");
  assert_ok(packing_dem_create(s.context, &s.def, s.domain, s.materials, laws, 16,
                               s.store, &dem));
  packing_dem_destroy(dem);
  dem = NULL;
  laws[1] = NULL;
  assert_fails(s.context,
               packing_dem_create(s.context, &s.def, s.domain, s.materials, laws, 2,
                                  s.store, &dem),
               PACKING_ERR_INVALID, "law 1");
  assert_null(dem);
  dem_scene_free(&s);
}

/* Sound for a while, then not a number. */
typedef struct fuse {
  int left;
  double then;
} fuse;

static void burn(void *user, const packing_contact_batch *batch)
{
  fuse *f = user;
  const double push = f->left-- > 0 ? 0 : f->then;
  for (size_t k = 0; k < batch->count; k++)
    batch->normal[k] += push;
}

/* Particles 2 and 3 touch, and step 5 of the second call throws them out of the numbers. */
static void particles_that_leave_the_numbers(void **state)
{
  (void)state;
  static const double then[3] = {NAN, INFINITY, -INFINITY};
  for (int k = 0; k < 3; k++) {
    dem_scene s;
    log_seen seen;
    fuse f = {24, then[k]};
    packing_law *law = NULL;
    packing_law_custom_def def;
    packing_law_custom_def_init(&def);
    def.evaluate = burn;
    def.user = &f;
    assert_ok(packing_law_create_custom(NULL, &def, &law));
    sound(&s, 0);
    packing_context_destroy(s.context);
    s.context = listening(&seen);
    dem_law(&s, law);
    dem_body b = dem_get(&s, 3);
    b.x.x = 0.6 + 0.02 - 5e-5;
    dem_put(&s, 3, &b);
    dem_start(&s);
    dem_run(&s, 20);
    const uint64_t before = dem_hash(s.store);
    seen.warnings = 0;
    packing_dem_report report;
    packing_dem_report_init(&report);
    report.steps = 777;
    assert_fails(s.context, packing_dem_step(s.dem, 30, &report), PACKING_ERR_UNSTABLE,
                 "particle 2 ");
    assert_non_null(strstr(packing_context_message(s.context), "step 25"));
    assert_true(report.steps == 777);
    assert_int_equal(seen.errors, 1);
    assert_int_equal(seen.index, 2);
    assert_non_null(strstr(seen.text, "particle 2 "));
    assert_true(dem_hash(s.store) == before);
    /* It refuses until it is reloaded, and then goes on. */
    assert_fails(s.context, packing_dem_step(s.dem, 1, NULL), PACKING_ERR_INVALID,
                 "reload");
    f.left = 1000;
    assert_ok(packing_dem_reload(s.dem));
    assert_true(dem_run(&s, 10).steps == 30); /* those lost do not count */
    assert_true(dem_hash(s.store) != before);
    dem_scene_free(&s);
  }
}

/* Finite, but its way in a step has no finite square. */
static void particles_too_fast_for_numbers(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  dem_body b = dem_get(&s, 1);
  b.v.y = 1e200;
  dem_put(&s, 1, &b);
  const uint64_t before = dem_hash(s.store);
  const packing_status status = dem_try(&s);
  if (status == PACKING_OK)
    assert_fails(s.context, packing_dem_step(s.dem, 3, NULL), PACKING_ERR_UNSTABLE,
                 "particle 1 ");
  else
    test_names(s.context, "particle 1", "packing_dem_create", __FILE__, __LINE__);
  assert_true(dem_hash(s.store) == before);
  dem_scene_free(&s);
}

/* So far apart that the volume between them is beyond all numbers, though each place is one. */
static void particles_too_far_apart_for_a_volume(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  for (size_t k = 0; k < 4; k++) {
    dem_body b = dem_get(&s, k);
    const double v = 1e110 * (1 + (double)k);
    b.v = dem_vec(v, v, v);
    dem_put(&s, k, &b);
  }
  assert_ok(packing_dem_create(s.context, &s.def, s.domain, s.materials, NULL, 0, s.store,
                               &s.dem));
  dem_run(&s, 3);
  assert_close(dem_get(&s, 0).x.x, 3e105, 1e-9);
  dem_scene_free(&s);
}

static void masses_must_be_numbers(void **state)
{
  (void)state;
  static const double radii[2] = {1e-110, 1e-200};
  for (int k = 0; k < 2; k++) {
    dem_scene s;
    sound(&s, 0);
    const dem_body b = {.x = {0.5, 0.1, 0.5}, .r = radii[k]};
    dem_add(&s, &b);
    assert_refused(&s, PACKING_ERR_RANGE, "particle 4");
    dem_scene_free(&s);
  }
}

static void store_of_another_size(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  dem_start(&s);
  dem_run(&s, 5);
  const dem_body b = {.x = {0.5, 0.1, 0.5}, .r = 0.01};
  dem_add(&s, &b);
  assert_fails(s.context, packing_dem_step(s.dem, 1, NULL), PACKING_ERR_INVALID,
               "reload");
  assert_ok(packing_dem_reload(s.dem));
  assert_true(dem_run(&s, 5).steps == 10);
  packing_particles_truncate(s.store, 2);
  assert_fails(s.context, packing_dem_step(s.dem, 1, NULL), PACKING_ERR_INVALID,
               "reload");
  assert_ok(packing_dem_reload(s.dem));
  assert_int_equal(dem_run(&s, 5).particles, 2);
  packing_particles_truncate(s.store, 0);
  assert_ok(packing_dem_reload(s.dem));
  assert_int_equal(dem_run(&s, 5).particles, 0);
  dem_scene_free(&s);
}

static void failed_reload(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  dem_start(&s);
  dem_run(&s, 5);
  const dem_body good = dem_get(&s, 1);
  dem_body b = good;
  b.x.y = 2;
  dem_put(&s, 1, &b);
  assert_fails(s.context, packing_dem_reload(s.dem), PACKING_ERR_GEOMETRY, "particle 1");
  const uint64_t before = dem_hash(s.store);
  assert_fails(s.context, packing_dem_step(s.dem, 1, NULL), PACKING_ERR_INVALID,
               "reload");
  assert_true(dem_hash(s.store) == before);
  b.x = dem_get(&s, 0).x;
  dem_put(&s, 1, &b);
  assert_fails(s.context, packing_dem_reload(s.dem), PACKING_ERR_RANGE, "0 and 1");
  dem_put(&s, 1, &good);
  assert_ok(packing_dem_reload(s.dem));
  assert_true(dem_run(&s, 5).steps == 10);
  dem_scene_free(&s);
}

static void no_steps(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  dem_start(&s);
  assert_fails(s.context, packing_dem_step(s.dem, 0, NULL), PACKING_ERR_RANGE, "steps");
  dem_run(&s, 1);
  dem_scene_free(&s);
}

/* Without particles no step can be advised; a given one is taken, and nothing moves. */
static void empty_store(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  packing_particles_truncate(s.store, 0);
  s.def.dt = 0;
  assert_refused(&s, PACKING_ERR_INVALID, "dt");
  s.def.dt = 1e-3;
  s.def.gravity.z = -1;
  dem_start(&s);
  const packing_dem_report report = dem_run(&s, 7);
  assert_true(report.steps == 7 && report.time == 7 * 1e-3);
  assert_true(report.particles == 0 && report.contacts == 0 &&
              report.kinetic_energy == 0);
  assert_true(isnan(report.kinetic_per_mgr));
  dem_scene_free(&s);
}

static void sizes_of_structs(void **state)
{
  (void)state;
  dem_scene s;
  sound(&s, 0);
  const packing_dem_def good = s.def;
  s.def.struct_size = 0;
  assert_refused(&s, PACKING_ERR_ABI, "struct_size");
  s.def = good;
  /* A caller of tomorrow, setting an option that is not known yet. */
  struct {
    packing_dem_def def;
    double of_tomorrow;
  } newer;
  memset(&newer, 0, sizeof newer);
  packing_dem_def_fill(&newer.def, sizeof newer);
  newer.def.dt = 1e-5;
  assert_ok(packing_dem_create(s.context, &newer.def, s.domain, s.materials, s.laws, 2,
                               s.store, &s.dem));
  newer.of_tomorrow = 1;
  packing_dem *dem = NULL;
  assert_status(packing_dem_create(s.context, &newer.def, s.domain, s.materials, s.laws,
                                   2, s.store, &dem),
                PACKING_ERR_ABI);
  /* A report that was never made is refused before a step is; a short one is filled in part. */
  packing_dem_report report;
  memset(&report, 0, sizeof report);
  const uint64_t before = dem_hash(s.store);
  assert_status(packing_dem_step(s.dem, 1, &report), PACKING_ERR_ABI);
  assert_true(dem_hash(s.store) == before);
  report.struct_size = offsetof(packing_dem_report, time);
  report.time = 123;
  assert_ok(packing_dem_step(s.dem, 2, &report));
  assert_true(report.steps == 2 && report.time == 123);
  packing_dem_advice advice;
  memset(&advice, 0, sizeof advice);
  assert_status(packing_dem_advise(s.dem, &advice), PACKING_ERR_ABI);
  dem_scene_free(&s);
}

/* What the report adds up. */
static void report_adds_up(void **state)
{
  (void)state;
  dem_scene s;
  dem_scene_init(&s, test_box(1, 1, 1, 0));
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_hertz(&s, 0);
  dem_body b = {.x = {0.5, 0.5, 0.00999}, .r = 0.01, .w = {3, 4, 12}};
  dem_add(&s, &b);
  b = (dem_body){.x = {0.5, 0.529995, 0.5}, .r = 0.02, .v = {0, 3, 4}};
  dem_add(&s, &b);
  b = (dem_body){.x = {0.5, 0.5, 0.5}, .r = 0.01, .v = {0, 3, 4}};
  dem_add(&s, &b);
  s.def.gravity.z = -1e-9;
  s.def.dt = 1e-9;
  dem_start(&s);
  const packing_dem_report r = dem_run(&s, 1);
  const double m = dem_mass(1000, 0.01), motion = 0.5 * m * 9 * 25,
               spin = 0.5 * 0.4 * m * 1e-4 * 169;
  assert_int_equal(r.particles, 3);
  assert_int_equal(r.contacts, 1);
  assert_int_equal(r.wall_contacts, 1);
  assert_true(r.steps == 1 && r.time == 1e-9 && r.dt == 1e-9 && r.rebuilds >= 1);
  assert_close(r.max_overlap, 5e-6 / 0.01,
               1e-9); /* rounding of positions, 1e-16 / 5e-6 */
  assert_close(r.max_speed, 5.0, 1e-6);
  assert_close(r.kinetic_energy, motion + spin, 1e-6);
  assert_close(r.kinetic_per_mgr, (motion + spin) / (m * 1e-9 * (0.01 + 8 * 0.02 + 0.01)),
               1e-6);
  assert_true(packing_dem_bytes(s.dem) > 3 * sizeof(dem_body));
  dem_scene_free(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(null_arguments),
      cmocka_unit_test(no_laws_is_fine),
      cmocka_unit_test(bad_fields),
      cmocka_unit_test(bad_choices),
      cmocka_unit_test(flat_scenes),
      cmocka_unit_test(dimensions_differ),
      cmocka_unit_test(advice_is_equation_23),
      cmocka_unit_test(unstable_steps),
      cmocka_unit_test(the_limit_is_a_limit),
      cmocka_unit_test(step_between_advice_and_limit_warns_once),
      cmocka_unit_test(overlapping_starts),
      cmocka_unit_test(starts_at_walls),
      cmocka_unit_test(types_need_materials),
      cmocka_unit_test(no_materials),
      cmocka_unit_test(narrow_periodic_cells),
      cmocka_unit_test(too_many_laws),
      cmocka_unit_test(particles_that_leave_the_numbers),
      cmocka_unit_test(particles_too_fast_for_numbers),
      cmocka_unit_test(particles_too_far_apart_for_a_volume),
      cmocka_unit_test(masses_must_be_numbers),
      cmocka_unit_test(store_of_another_size),
      cmocka_unit_test(failed_reload),
      cmocka_unit_test(no_steps),
      cmocka_unit_test(empty_store),
      cmocka_unit_test(sizes_of_structs),
      cmocka_unit_test(report_adds_up),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
