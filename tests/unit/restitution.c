/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Restitution against the damping rate: stored values, a collision step by step, the inverse. */
#include "test.h"

/* By RK4 and by the closed forms, two independent computations. */
static void known_values(void **state)
{
  (void)state;
  static const double known[][3] = {{.02, .933471, .934368}, {.05, .841701, .846776},
                                    {.10, .707351, .724674}, {.15, .592544, .626043},
                                    {.20, .493898, .545402}, {.30, .335159, .423113},
                                    {.50, .127881, .273152}, {.70, .023445, .189155}};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    assert_near(packing_hertz_restitution(known[i][0], 1), known[i][1], 5.1e-7);
    assert_near(packing_hertz_restitution(known[i][0], 0), known[i][2], 5.1e-7);
  }
}

/* The formula that the documentation prints for the force cut off at 0. */
static void the_printed_formula(void **state)
{
  (void)state;
  for (double xi = 0.01; xi < 0.9; xi += 0.01) {
    const double zeta = xi * sqrt(1.2), s = sqrt(1 - zeta * zeta);
    const double turn = 3.14159265358979323846 - atan2(2 * zeta * s, 1 - 2 * zeta * zeta);
    assert_close(packing_hertz_restitution(xi, 0), exp(-zeta / s * turn), 1e-13);
  }
}

/* Two spheres with E* = r* = m* = 1 that meet with velocity 1: delta'' = -force. */
static double force(double xi, double delta, double rate)
{
  const double root = sqrt(fmax(delta, 0));
  return 4.0 / 3.0 * root * root * root + 2 * xi * sqrt(2 * root) * rate;
}

typedef struct motion {
  double delta, rate;
} motion;

static motion step(double xi, motion at, double dt)
{
  motion k[4], probe = at;
  static const double ahead[] = {0.5, 0.5, 1};
  for (int i = 0; i < 4; i++) {
    k[i] = (motion){probe.rate, -force(xi, probe.delta, probe.rate)};
    if (i < 3)
      probe = (motion){at.delta + ahead[i] * dt * k[i].delta,
                       at.rate + ahead[i] * dt * k[i].rate};
  }
  at.delta += dt / 6 * (k[0].delta + 2 * k[1].delta + 2 * k[2].delta + k[3].delta);
  at.rate += dt / 6 * (k[0].rate + 2 * k[1].rate + 2 * k[2].rate + k[3].rate);
  return at;
}

static double collide(double xi, int pull)
{
  motion at = {0, 1};
  const double dt = 2e-5;
  do
    at = step(xi, at, dt);
  while (pull ? at.delta > 0 : force(xi, at.delta, at.rate) > 0);
  return -at.rate;
}

/* Under, at and over critical damping (xi = .9129). */
static void collisions_step_by_step(void **state)
{
  (void)state;
  static const double rates[] = {0, .05, .1, .3, .6, .9, .91287, 1, 1.5, 4};
  for (size_t i = 0; i < sizeof rates / sizeof *rates; i++) {
    const double xi = rates[i];
    assert_near(packing_hertz_restitution(xi, 0), collide(xi, 0), 2e-6);
    if (xi < 0.7)
      assert_near(packing_hertz_restitution(xi, 1), collide(xi, 1), 2e-6);
  }
}

static void critical_damping(void **state)
{
  (void)state;
  const double critical = sqrt(5.0 / 6.0);
  assert_close(packing_hertz_restitution(critical, 0), exp(-2), 1e-14);
  assert_true(packing_hertz_restitution(critical * (1 + 1e-15), 1) == 0);
  assert_true(packing_hertz_restitution(critical * 0.99, 1) > 0);
  /* No step where one form takes over from the other. */
  for (double d = 1e-15; d < 1e-2; d *= 3) {
    const double below = packing_hertz_restitution(critical * (1 - d), 0);
    const double above = packing_hertz_restitution(critical * (1 + d), 0);
    /* d ln e / d ln zeta = -4/3 there */
    assert_near(log(below / above), 8.0 / 3.0 * d, 1e-14 + d * d);
  }
}

static void limits(void **state)
{
  (void)state;
  for (int pull = 0; pull < 2; pull++) {
    assert_true(packing_hertz_restitution(0, pull) == 1);
    assert_true(packing_hertz_damping(1, pull) == 0);
    assert_true(isnan(packing_hertz_restitution(-1e-300, pull)));
    assert_true(isnan(packing_hertz_restitution((double)NAN, pull)));
    assert_true(isnan(packing_hertz_restitution(HUGE_VAL, pull)));
    assert_true(isnan(packing_hertz_damping(0, pull)));
    assert_true(isnan(packing_hertz_damping(-0.5, pull)));
    assert_true(isnan(packing_hertz_damping(nextafter(1, 2), pull)));
    assert_true(isnan(packing_hertz_damping((double)NAN, pull)));
    assert_true(isnan(packing_hertz_damping(HUGE_VAL, pull)));
    assert_true(packing_hertz_restitution(1.7e308, pull) == 0);
    double last = 2;
    for (double xi = 0.001; xi < (pull ? 0.9 : 1e6); xi *= 1.01) {
      const double e = packing_hertz_restitution(xi, pull);
      assert_true(e < last && e > 0);
      last = e;
    }
  }
  /* Far beyond critical damping: 1 / (4 zeta^2). */
  assert_close(packing_hertz_restitution(1e9, 0), 1 / (4.8e18), 1e-12);
}

/* Relative 1e-12 of the damping rate, from restitutions next to 1 to the smallest. */
static void the_inverse(void **state)
{
  (void)state;
  for (int pull = 0; pull < 2; pull++)
    for (double xi = 1e-9; xi < (pull ? 0.85 : 1e100); xi *= 1.37) {
      const double e = packing_hertz_restitution(xi, pull);
      /* e is rounded: that much of xi cannot be told from it. */
      const double blur = 1.2e-16 / -log(e);
      assert_close(packing_hertz_damping(e, pull), xi, 1e-12 + blur);
    }
  for (double e = 5e-324; e < 1; e = e < 1e-3 ? e * 17 : e + 0.0137) {
    assert_near(log(packing_hertz_restitution(packing_hertz_damping(e, 0), 0)), log(e),
                -1e-12 * log(e));
    if (e > 1e-3)
      assert_close(packing_hertz_restitution(packing_hertz_damping(e, 1), 1), e, 1e-10);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(known_values),     cmocka_unit_test(the_printed_formula),
      cmocka_unit_test(critical_damping), cmocka_unit_test(collisions_step_by_step),
      cmocka_unit_test(limits),           cmocka_unit_test(the_inverse),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
