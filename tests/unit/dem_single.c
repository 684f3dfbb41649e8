/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One particle against closed solutions. Steps are small enough that semi-implicit Euler's own
 * error, of first order in dt, stays below the tolerance of 1e-4; slip velocities so small that
 * regularised friction differs from Coulomb's by less. */
#include "dem_scenes.h"

static const double radius = 0.01, density = 1000, poisson = 0.25;

/* A wide box whose floor is z = 0. */
static void floor_scene(dem_scene *s, double young, double damping, double friction)
{
  dem_scene_init(s, test_box(20, 2, 20, 0));
  dem_material(s, density, young, poisson, damping, friction);
  dem_hertz(s, 0);
}

/* A sphere at (1, 1) that sinks into the floor as its weight asks. */
static dem_body on_floor(double weight_acceleration, double young)
{
  const double sunk = dem_static_overlap(dem_mass(density, radius) * weight_acceleration,
                                         radius, dem_rigid_young(young, poisson));
  const dem_body b = {.x = {1, 1, radius - sunk}, .r = radius};
  return b;
}

/* At rest the force is m g to the last digit, so the overlap shows Hertz's law itself; the
 * damping has shrunk what is left of the motion by more than 1e-20. The published figures have
 * ten digits. */
static void rest_on_the_floor(void **state)
{
  (void)state;
  const double gravity[2] = {9.81, 2}, published[2] = {2.028586064e-6, 7.026959166e-7};
  for (int k = 0; k < 2; k++) {
    dem_scene s;
    floor_scene(&s, 1e8, 0.1, 0);
    const dem_body start = {.x = {1, 1, 1.0001 * radius}, .r = radius};
    dem_add(&s, &start);
    s.def.gravity.z = -gravity[k];
    s.def.dt = 1e-5;
    dem_start(&s);
    const packing_dem_report report = dem_run_for(&s, 0.5);
    const double sunk = radius - dem_get(&s, 0).x.z;
    assert_close(sunk, published[k], 1e-9);
    assert_close(sunk,
                 dem_static_overlap(dem_mass(density, radius) * gravity[k], radius,
                                    dem_rigid_young(1e8, poisson)),
                 1e-11);
    assert_int_equal(report.wall_contacts, 1);
    assert_int_equal(report.contacts, 0);
    assert_true(report.max_speed < 1e-12); /* an ulp of z in a step: 1.7e-13 */
    dem_scene_free(&s);
  }
}

/* The paper's own step, a fifth of a radian of the resting oscillation: forward Euler would gain
 * energy here. After ten thousand radians nothing has grown. */
static void paper_step_comes_to_rest(void **state)
{
  (void)state;
  dem_scene s;
  floor_scene(&s, 1e8, 0.1, 0.2);
  dem_sliding(&s, 1e-3);
  dem_body b = on_floor(2, 1e8);
  b.x.z += 3e-7;
  dem_add(&s, &b);
  s.def.gravity.z = -2;
  s.def.dt = 1e-4;
  dem_start(&s);
  const double start = dem_run(&s, 20).kinetic_energy;
  assert_true(start > 0);
  assert_true(dem_run(&s, 1000).kinetic_energy < 1e-12 * start);
  /* An ulp of z in a step is 1.7e-14 m/s; that squared times the mass is 1e-30. */
  assert_true(dem_run(&s, 50000).kinetic_energy < 1e-28);
  assert_close(radius - dem_get(&s, 0).x.z, 7.026959166e-7, 1e-9);
  dem_scene_free(&s);
}

/* Without damping the oscillation goes on for ever, its amplitude neither growing nor shrinking
 * beyond the wobble of a symplectic method, of order omega dt = 0.2. */
static void undamped_oscillation_keeps_its_size(void **state)
{
  (void)state;
  dem_scene s;
  floor_scene(&s, 1e8, 0, 0);
  dem_body b = on_floor(2, 1e8);
  const double rest = b.x.z;
  b.x.z += 1e-7;
  dem_add(&s, &b);
  s.def.gravity.z = -2;
  s.def.dt = 1e-4;
  dem_start(&s);
  double least = 1, most = 0;
  for (int part = 0; part < 10; part++) {
    double reach = 0;
    for (int k = 0; k < 500; k++) {
      dem_run(&s, 1);
      reach = fmax(reach, fabs(dem_get(&s, 0).x.z - rest));
    }
    least = fmin(least, reach);
    most = fmax(most, reach);
    dem_run(&s, 5000);
  }
  assert_true(most < 1.3e-7 && least > 0.9e-7);
  assert_true(most < 1.02 * least);
  dem_scene_free(&s);
}

static const double stiff = 1e10; /* sinks 1e-5 of its radius */

/* Accelerations down an incline, which is a floor under tilted gravity. */
typedef struct slope {
  double a;       /* along it */
  double r_alpha; /* spin-up times the radius */
  double speed;   /* at the end */
} slope;

static const double slope_slip = 2e-4;

static slope incline(double degrees, double friction, int rotations, packing_arm arm)
{
  const double angle = degrees * DEM_PI / 180, g = 9.81;
  dem_scene s;
  floor_scene(&s, stiff, 0.1, friction);
  dem_sliding(&s, slope_slip);
  const dem_body b = on_floor(g * cos(angle), stiff);
  dem_add(&s, &b);
  s.def.gravity = dem_vec(g * sin(angle), 0, -g * cos(angle));
  s.def.rotations = rotations;
  s.def.arm = arm;
  s.def.dt = 1e-5;
  dem_start(&s);
  dem_run_for(&s, 0.1);
  const dem_body early = dem_get(&s, 0);
  dem_run_for(&s, 0.1);
  const dem_body late = dem_get(&s, 0);
  assert_near(late.x.y, 1, 0);
  assert_near(late.w.x, 0, 0);
  dem_scene_free(&s);
  const slope out = {(late.v.x - early.v.x) / 0.1, radius * (late.w.y - early.w.y) / 0.1,
                     late.v.x};
  return out;
}

/* A rolling sphere slips at a constant, tiny velocity, so its acceleration has no error of
 * regularisation. With the arm at the radius the solution is exact; at the contact point the arm
 * is shorter by the overlap, 1e-5 of it. */
static void incline_rolls(void **state)
{
  (void)state;
  slope s = incline(20, 0.3, 1, PACKING_ARM_CONTACT);
  assert_close(s.a, 2.396584, 1e-4);
  assert_close(s.r_alpha, 2.396584, 1e-4);
  s = incline(45, 0.5, 1, PACKING_ARM_CONTACT);
  assert_close(s.a, 4.954798, 1e-4);
  s = incline(20, 0.3, 1, PACKING_ARM_RADIUS);
  assert_close(s.a, 5.0 / 7 * 9.81 * sin(20 * DEM_PI / 180), 1e-8);
}

static void contact_arm_is_shorter_by_the_overlap(void **state)
{
  (void)state;
  const double angle = 20 * DEM_PI / 180;
  const double arm = on_floor(9.81 * cos(angle), stiff).x.z / radius;
  const slope s = incline(20, 0.3, 1, PACKING_ARM_CONTACT);
  assert_close(s.a, 9.81 * sin(angle) / (1 + 0.4 / (arm * arm)), 1e-8);
  assert_close(s.r_alpha, s.a / arm, 1e-8);
}

static void incline_slides(void **state)
{
  (void)state;
  const slope s = incline(30, 0.1, 1, PACKING_ARM_CONTACT);
  assert_close(s.a, 4.055429, 1e-4);
  assert_close(s.r_alpha, 2.123927, 1e-4);
}

/* Regularised friction cannot hold a block: it creeps where friction balances the pull. */
static void incline_with_locked_rotation(void **state)
{
  (void)state;
  slope s = incline(30, 0.3, 0, PACKING_ARM_CONTACT);
  assert_close(s.a, 2.356287, 1e-4);
  assert_near(s.r_alpha, 0, 0);
  s = incline(20, 0.4, 0, PACKING_ARM_CONTACT);
  const double share = tan(20 * DEM_PI / 180) / 0.4;
  assert_close(s.speed, slope_slip * share / sqrt(1 - share * share), 1e-6);
  assert_near(s.a, 0, 1e-9);
}

/* A sphere thrown along the floor at 1 m/s with a spin; stands after each of two times. */
static void slide(double friction, double spin, int rotations, const double time[2],
                  dem_body seen[2])
{
  dem_scene s;
  floor_scene(&s, stiff, 0.1, friction);
  dem_sliding(&s, slope_slip);
  dem_body b = on_floor(9.81, stiff);
  b.v.x = 1;
  b.w.y = spin / radius;
  dem_add(&s, &b);
  s.def.gravity.z = -9.81;
  s.def.rotations = rotations;
  s.def.dt = 1e-6 * round(time[0] * 1e6 / 14000);
  dem_start(&s);
  for (int k = 0; k < 2; k++) {
    dem_run_for(&s, time[k] - (k == 0 ? 0 : time[0]));
    seen[k] = dem_get(&s, 0);
    seen[k].x.x -= 1;
  }
  dem_scene_free(&s);
}

/* v, t and x where rolling begins; then the sphere rolls on without losing speed. What is left of
 * the slip at that time is 2/7 of a fraction of slope_slip. */
static void slide_to_roll(void **state)
{
  (void)state;
  const struct {
    double friction, spin, v, t, x;
  } cases[3] = {{0.2, 0, 5.0 / 7, 0.145624, 0.124821},
                {0.3, 0, 5.0 / 7, 0.097083, 0.083214},
                {0.2, -1, 3.0 / 7, 0.291248, 0.208034}};
  for (int k = 0; k < 3; k++) {
    const double time[2] = {cases[k].t, 2 * cases[k].t};
    dem_body seen[2];
    slide(cases[k].friction, cases[k].spin, 1, time, seen);
    assert_close(seen[0].v.x, cases[k].v, 1e-4);
    assert_close(seen[0].x.x, cases[k].x, 1e-4);
    assert_close(seen[1].v.x, cases[k].v, 1e-4);
    assert_close(seen[1].w.y * radius, cases[k].v, 1e-4);
    assert_close(seen[1].x.x, cases[k].x + cases[k].v * cases[k].t, 1e-4);
    assert_near(seen[1].x.y, 1, 0);
  }
}

static void slide_to_a_stop(void **state)
{
  (void)state;
  const double time[2] = {0.339789 / 2, 0.5};
  dem_body seen[2];
  slide(0.3, 0, 0, time, seen);
  assert_close(seen[0].v.x, 0.5, 1e-4);
  assert_close(seen[0].x.x, 0.75 * 0.169895, 1e-4);
  assert_close(seen[1].x.x, 0.169895, 1e-4);
  assert_near(seen[1].v.x, 0, 1e-12);
}

/* Spins are given and never change. */
static void locked_rotation_keeps_the_spin(void **state)
{
  (void)state;
  const double time[2] = {0.05, 0.1};
  dem_body seen[2];
  slide(0.3, 0.25, 0, time, seen);
  assert_true(seen[0].w.y == 0.25 / radius && seen[1].w.y == 0.25 / radius);
  assert_true(seen[0].v.x < 0.9);
}

/* Falls from rest in a fluid: force c (v_fluid - v) is taken at the old velocity, an error of
 * dt / (2 tau) = 1e-5. */
static void drag_and_gravity(void **state)
{
  (void)state;
  const struct {
    double r, terminal, v, x;
  } cases[2] = {{0.01, 1.675516, 1.167652, 0.697306}, {0.02, 13.404129, 1.857944, 0}};
  for (int k = 0; k < 2; k++) {
    dem_scene s;
    floor_scene(&s, 1e6, 0.1, 0);
    const dem_body b = {.x = {1, 1, 19}, .r = cases[k].r};
    dem_add(&s, &b);
    s.def.gravity.z = -2;
    s.def.drag = 0.005;
    s.def.dt = 2e-5;
    dem_start(&s);
    dem_run_for(&s, 1);
    const dem_body seen = dem_get(&s, 0);
    const double m = dem_mass(density, cases[k].r), tau = m / 0.005;
    assert_close(seen.v.z, -cases[k].v, 1e-4);
    assert_close(19 - seen.x.z, 2 * tau * (1 - tau * (1 - exp(-1 / tau))), 1e-4);
    if (k == 0)
      assert_close(19 - seen.x.z, cases[k].x, 1e-4);
    /* The terminal velocity is a fixed point of the step itself. */
    dem_body falling = seen;
    falling.v.z = -2 * tau;
    dem_put(&s, 0, &falling);
    assert_ok(packing_dem_reload(s.dem));
    dem_run_for(&s, 0.1);
    assert_close(dem_get(&s, 0).v.z, -cases[k].terminal, 1e-6);
    assert_close(dem_get(&s, 0).v.z, -2 * tau, 1e-12);
    dem_scene_free(&s);
  }
}

static void constant_fluid_velocity(void **state)
{
  (void)state;
  dem_scene s;
  floor_scene(&s, 1e6, 0.1, 0);
  const dem_body b = {.x = {10, 1, 10}, .r = radius, .v = {0.5, 0, 0}};
  dem_add(&s, &b);
  s.def.drag = 0.05;
  s.def.fluid_velocity = dem_vec(-1, 0.25, 2);
  s.def.dt = 5e-6;
  dem_start(&s);
  const double tau = dem_mass(density, radius) / 0.05, t = 0.1, left = exp(-t / tau);
  dem_run_for(&s, t);
  const packing_vec3 v = dem_get(&s, 0).v;
  assert_close(v.x, -1 + 1.5 * left, 1e-4);
  assert_close(v.y, 0.25 * (1 - left), 1e-4);
  assert_close(v.z, 2 * (1 - left), 1e-4);
  dem_scene_free(&s);
}

typedef struct current {
  double rate; /* v_x = rate t, v_z = - rate (z - middle) */
  double middle;
} current;

static packing_vec3 flows(void *user, const packing_vec3 *point, double time)
{
  const current *c = user;
  return dem_vec(c->rate * time, 0, -c->rate * (point->z - c->middle));
}

/* Along x the fluid speeds up: v = rate (t - tau (1 - exp(-t / tau))). Along z it flows back to
 * the middle: a damped oscillator, z'' + z' / tau + rate z / tau = 0. */
static void fluid_velocity_by_a_function(void **state)
{
  (void)state;
  dem_scene s;
  current c = {2, 10};
  floor_scene(&s, 1e6, 0.1, 0);
  const dem_body b = {.x = {10, 1, 10.5}, .r = radius};
  dem_add(&s, &b);
  s.def.drag = 0.05;
  s.def.fluid_velocity = dem_vec(77, 77, 77); /* the function stands in its place */
  s.def.fluid = flows;
  s.def.fluid_user = &c;
  s.def.dt = 5e-6;
  dem_start(&s);
  const double tau = dem_mass(density, radius) / 0.05, t = 0.3;
  dem_run_for(&s, t);
  const dem_body seen = dem_get(&s, 0);
  assert_close(seen.v.x, c.rate * (t - tau * (1 - exp(-t / tau))), 1e-4);
  assert_near(seen.v.y, 0, 0);
  const double root = sqrt(0.25 / (tau * tau) - c.rate / tau), mean = -0.5 / tau;
  const double slow = mean + root, fast = mean - root;
  assert_close(seen.x.z - 10,
               0.5 * (fast * exp(slow * t) - slow * exp(fast * t)) / (fast - slow), 1e-4);
  dem_scene_free(&s);
}

/* The fluid is asked at the time of the step, which goes on over reloads. */
static void fluid_time_goes_on(void **state)
{
  (void)state;
  dem_scene s;
  current c = {1, 10};
  floor_scene(&s, 1e6, 0.1, 0);
  const dem_body b = {.x = {10, 1, 10}, .r = radius};
  dem_add(&s, &b);
  s.def.drag = 0.05;
  s.def.fluid = flows;
  s.def.fluid_user = &c;
  s.def.dt = 0x1p-10;
  dem_start(&s);
  dem_run(&s, 100);
  assert_ok(packing_dem_reload(s.dem));
  const packing_dem_report report = dem_run(&s, 100);
  const packing_vec3 v = dem_get(&s, 0).v;
  assert_true(report.steps == 200);
  assert_true(report.time == 200 * 0x1p-10 && report.dt == 0x1p-10);
  double expected = 0;
  const double share = 0.05 * 0x1p-10 / dem_mass(density, radius);
  for (int k = 0; k < 200; k++)
    expected += share * (k * 0x1p-10 - expected);
  assert_close(v.x, expected, 1e-12);
  dem_scene_free(&s);
}

/* An advised step may change with a reload: time goes on from where it was. */
static void time_goes_on_through_another_step(void **state)
{
  (void)state;
  dem_scene s;
  floor_scene(&s, 1e6, 0.1, 0);
  const dem_body large = {.x = {10, 1, 10}, .r = radius};
  const dem_body small = {.x = {10, 1.5, 10}, .r = 0.1 * radius};
  dem_add(&s, &large);
  s.def.gravity.y = -1;
  s.def.dt = 0;
  dem_start(&s);
  const packing_dem_report before = dem_run(&s, 10);
  dem_add(&s, &small);
  assert_ok(packing_dem_reload(s.dem));
  const packing_dem_report after = dem_run(&s, 5);
  assert_true(after.dt < 0.5 * before.dt);
  assert_near(after.time, 10 * before.dt + 5 * after.dt, 1e-15 * before.time);
  dem_scene_free(&s);
}

/* From rest at h, each flight with a long step, each impact with a short one; between them the
 * stepper is made anew. Gravity's own work in a contact lowers the restitution by some 1e-5. */
static void bounces(void **state)
{
  (void)state;
  const double young = 1e13, xi = 0.1, g = 9.81, height = 0.45;
  const double e = packing_hertz_restitution(xi, 0);
  dem_scene s;
  floor_scene(&s, young, xi, 0);
  const dem_body b = {.x = {1, 1, radius + height}, .r = radius};
  dem_add(&s, &b);
  s.def.gravity.z = -g;
  for (int k = 1; k <= 3; k++) {
    dem_body now = dem_get(&s, 0);
    const double drop = now.x.z - radius, v = sqrt(2 * g * drop);
    s.def.dt = 6e-7;
    dem_start(&s);
    dem_run_for(&s, sqrt(2 * (drop - 1e-5) / g) - 3 * s.def.dt);
    assert_true(dem_get(&s, 0).x.z > radius);
    s.def.dt = dem_collision_time(dem_mass(density, radius), radius,
                                  dem_rigid_young(young, poisson), v) /
               20000;
    dem_start(&s);
    do {
      dem_run(&s, 100);
      now = dem_get(&s, 0);
    } while (now.v.z < 0 || now.x.z < radius);
    s.def.dt = 6e-7;
    dem_start(&s);
    dem_run_for(&s, now.v.z / g);
    assert_close(dem_get(&s, 0).x.z - radius, height * pow(e, 2 * k), 1e-4);
  }
  dem_scene_free(&s);
}

enum { BASE = 3 };

/* The fluid bears down on the fourth sphere alone: its weight over the drag. */
static packing_vec3 presses(void *user, const packing_vec3 *point, double time)
{
  (void)time;
  return dem_vec(0, 0, point->z > 10 + radius ? -*(const double *)user : 0);
}

/* Three touching spheres so heavy that they stay, and one on top, without friction. There is no
 * gravity, which would take the three along: the fluid presses on the fourth instead. */
static void frictionless_pyramid(void **state)
{
  (void)state;
  dem_scene s;
  dem_scene_init(&s, test_box(20, 20, 20, 0));
  dem_material(&s, 2500e13, 1e7, poisson, 0.1, 0);
  dem_material(&s, 2500, 1e7, poisson, 0.1, 0);
  dem_hertz(&s, 0);
  const double m = dem_mass(2500, radius), drag = 0.1, g = 9.81;
  double blow = m * g / drag;
  for (int k = 0; k < BASE; k++) {
    const double angle = 2 * DEM_PI * k / BASE, far = 2 * radius / sqrt(3);
    const dem_body b = {
        .x = {10 + far * cos(angle), 10 + far * sin(angle), 10}, .r = radius, .type = 1};
    dem_add(&s, &b);
  }
  const dem_body top = {
      .x = {10, 10, 10 + sqrt(8.0 / 3) * radius}, .r = radius, .type = 2};
  dem_add(&s, &top);
  s.def.drag = drag;
  s.def.fluid = presses;
  s.def.fluid_user = &blow;
  s.def.dt = 1e-5;
  dem_start(&s);
  const packing_dem_report report = dem_run_for(&s, 0.4);
  /* Within the digits of the reference, 1e-9, and positions near 10, 2e-15 / 2e-5. */
  assert_close((dem_get(&s, 3).x.z - 10) / radius, 1.630653853, 1e-9);
  assert_close(report.max_overlap, 1.909581e-3, 1e-6);
  assert_true(report.contacts >= 3);
  assert_near(dem_get(&s, 3).v.z, 0, 1e-9); /* an ulp of z in a step: 1.8e-10 */
  dem_scene_free(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rest_on_the_floor),
      cmocka_unit_test(paper_step_comes_to_rest),
      cmocka_unit_test(undamped_oscillation_keeps_its_size),
      cmocka_unit_test(incline_rolls),
      cmocka_unit_test(contact_arm_is_shorter_by_the_overlap),
      cmocka_unit_test(incline_slides),
      cmocka_unit_test(incline_with_locked_rotation),
      cmocka_unit_test(slide_to_roll),
      cmocka_unit_test(slide_to_a_stop),
      cmocka_unit_test(locked_rotation_keeps_the_spin),
      cmocka_unit_test(drag_and_gravity),
      cmocka_unit_test(constant_fluid_velocity),
      cmocka_unit_test(fluid_velocity_by_a_function),
      cmocka_unit_test(fluid_time_goes_on),
      cmocka_unit_test(time_goes_on_through_another_step),
      cmocka_unit_test(bounces),
      cmocka_unit_test(frictionless_pyramid),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
