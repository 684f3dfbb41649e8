/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two particles, or one and a wall: collisions against closed solutions, and single steps against
 * the formulas, as m dv / dt of one step is the force. Impacts of Chung and Ooi are those of
 * Granular Matter 13, 643 (2011). */
#include "dem_scenes.h"

/* Space without walls in reach, the origin in its middle. */
static packing_domain *space(int dim)
{
  packing_domain *domain = NULL;
  packing_domain_box_def box;
  packing_domain_rectangle_def rectangle;
  packing_domain_box_def_init(&box);
  packing_domain_rectangle_def_init(&rectangle);
  box.size = dem_vec(20, 20, 20);
  box.corner = dem_vec(-10, -10, -10);
  rectangle.size_x = rectangle.size_y = 20;
  rectangle.corner = dem_vec(-10, -10, 0);
  if (dim == 2)
    assert_ok(packing_domain_create_rectangle(NULL, &rectangle, &domain));
  else
    assert_ok(packing_domain_create_box(NULL, &box, &domain));
  return domain;
}

static packing_vec3 along(packing_vec3 n, double by)
{
  return dem_vec(n.x * by, n.y * by, n.z * by);
}

static packing_vec3 minus(packing_vec3 a, packing_vec3 b)
{
  return dem_vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

static double dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  return dem_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static double length(packing_vec3 a)
{
  return sqrt(dot(a, a));
}

/* A unit vector that favours no axis; its length is 1 to the last digit but one. */
static const packing_vec3 askew = {2.0 / 7, 3.0 / 7, 6.0 / 7};

/* One of two colliding spheres. */
typedef struct stuff {
  double r, density, young, poisson, damping;
} stuff;

static const stuff common = {0.01, 1000, 1e8, 0.25, 0.1};

/* What two spheres are to each other. */
typedef struct couple {
  double m, r, young; /* reduced */
} couple;

static couple reduced(const stuff *a, const stuff *b)
{
  const double ma = dem_mass(a->density, a->r), mb = dem_mass(b->density, b->r);
  const couple c = {ma * mb / (ma + mb), a->r * b->r / (a->r + b->r),
                    dem_pair_young(a->young, a->poisson, b->young, b->poisson)};
  return c;
}

/* Two spheres about to collide head-on along `askew` with relative velocity v. They are `gap`
 * apart; the centre of mass moves. */
static void approach(dem_scene *s, const stuff *a, const stuff *b, int pull, double v,
                     double gap)
{
  dem_scene_init(s, space(3));
  dem_material(s, a->density, a->young, a->poisson, a->damping, 0);
  dem_material(s, b->density, b->young, b->poisson, b->damping, 0);
  dem_hertz(s, pull);
  dem_body body = {.v = along(askew, 0.7 * v), .r = a->r, .type = 1};
  dem_add(s, &body);
  body = (dem_body){.x = along(askew, a->r + b->r + gap),
                    .v = along(askew, -0.3 * v),
                    .r = b->r,
                    .type = 2};
  dem_add(s, &body);
}

/* Of sphere 1 as seen from sphere 0. */
static double receding(const dem_scene *s)
{
  return dot(askew, minus(dem_get(s, 1).v, dem_get(s, 0).v));
}

/* Velocity after over velocity before, with `steps` steps in Hertz's collision time. */
static double rebound(const stuff *a, const stuff *b, int pull, double v, double steps)
{
  const couple c = reduced(a, b);
  dem_scene s;
  const double time = dem_collision_time(c.m, c.r, c.young, v), dt = time / steps;
  approach(&s, a, b, pull, v, 0.37 * v * dt);
  s.def.dt = dt;
  dem_start(&s);
  const packing_dem_report report = dem_run_for(&s, 4 * time);
  assert_true(report.contacts == 0 || receding(&s) > 0);
  const double e = receding(&s) / v;
  dem_scene_free(&s);
  return e;
}

/* Equations 7 and 9 as printed take the root of a negative number: the spheres must repel. */
static void head_on_pair_repels(void **state)
{
  (void)state;
  dem_scene s;
  approach(&s, &common, &common, 0, 1, 1e-5);
  s.def.dt = 1e-6;
  dem_start(&s);
  assert_close(receding(&s), -1.0, 1e-15);
  dem_run_for(&s, 1e-3);
  assert_true(receding(&s) > 0.7);
  const dem_body a = dem_get(&s, 0), b = dem_get(&s, 1);
  assert_true(length(minus(b.x, a.x)) > a.r + b.r);
  assert_close(dot(askew, a.v) + dot(askew, b.v), 0.4, 1e-12); /* momentum */
  assert_true(length(a.w) == 0 && length(b.w) == 0);
  dem_scene_free(&s);
}

/* The first-order error of the step is below 1e-3 with 2000 steps in a collision. */
static void restitution_follows_damping(void **state)
{
  (void)state;
  static const double xi[] = {0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7};
  for (size_t k = 0; k < sizeof xi / sizeof *xi; k++)
    for (int pull = 0; pull < 2; pull++) {
      stuff a = common;
      a.damping = xi[k];
      assert_near(rebound(&a, &a, pull, 0.5, 2000),
                  packing_hertz_restitution(xi[k], pull), 1e-3);
    }
}

static void restitution_does_not_depend_on_anything_else(void **state)
{
  (void)state;
  stuff a = common, b = {0.027, 2600, 7e9, 0.4, 0.3};
  for (int pull = 0; pull < 2; pull++) {
    const double e = packing_hertz_restitution(0.2, pull);
    static const double v[] = {1e-3, 0.05, 2, 10};
    a.damping = 0.2;
    for (size_t k = 0; k < sizeof v / sizeof *v; k++)
      assert_near(rebound(&a, &a, pull, v[k], 2000), e, 1e-3);
    a.damping = 0.1; /* the mean of both holds */
    assert_near(rebound(&a, &b, pull, 1, 2000), e, 1e-3);
    assert_near(rebound(&b, &a, pull, 1, 2000), e, 1e-3);
  }
}

static void pair_damping_takes_the_place_of_the_mean(void **state)
{
  (void)state;
  dem_scene s;
  const couple c = reduced(&common, &common);
  const double time = dem_collision_time(c.m, c.r, c.young, 1);
  approach(&s, &common, &common, 0, 1, 0);
  assert_ok(packing_materials_set_pair(s.materials, 1, 0, 0.5, 0));
  s.def.dt = time / 2000;
  dem_start(&s);
  dem_run_for(&s, 4 * time);
  assert_near(receding(&s), packing_hertz_restitution(0.5, 0), 1e-3);
  dem_scene_free(&s);
}

/* With 5 or so steps in a collision the restitution scatters with the phase of the first contact:
 * within .035 up to .2 m/s, .065 at 2 m/s. The figures are those of a program of a few lines that
 * shares nothing with the library but the scheme. */
static void paper_step_scatters_as_known(void **state)
{
  (void)state;
  static const struct {
    double v, mean, least, most;
  } known[3] = {{0.05, 0.704327487440217, 0.6931689553607573, 0.7176835581767806},
                {0.2, 0.7054511789617165, 0.6963789168686502, 0.7365469527624713},
                {2, 0.7081675521197691, 0.6833417702150164, 0.7618633068661075}};
  for (int k = 0; k < 3; k++) {
    double mean = 0, least = 1, most = 0;
    for (int phase = 0; phase < 10; phase++) {
      dem_scene s;
      const double v = known[k].v;
      approach(&s, &common, &common, 1, v, (phase + 0.5) / 10 * v * 1e-4);
      s.def.dt = 1e-4;
      dem_start(&s);
      dem_run_for(&s, 1e-2);
      const double e = receding(&s) / v;
      mean += e / 10;
      least = fmin(least, e);
      most = fmax(most, e);
      dem_scene_free(&s);
    }
    /* The overlaps, 1e-6 and more, carry the rounding of positions, 1e-18. */
    assert_close(mean, known[k].mean, 1e-10);
    assert_close(least, known[k].least, 1e-10);
    assert_close(most, known[k].most, 1e-10);
    assert_near(mean, packing_hertz_restitution(0.1, 1), 0.005);
  }
}

/* What an impact came to. */
typedef struct impact {
  double overlap, force, time;
} impact;

/* Steps one by one; force is m dv / dt of the first sphere, which has mass m. `wall`: its overlap
 * with the floor z = -10 counts, not that with the second sphere. */
static impact watch(dem_scene *s, double m, int wall, size_t steps)
{
  impact seen = {0, 0, 0};
  for (size_t k = 0; k < steps; k++) {
    const dem_body before = dem_get(s, 0);
    dem_run(s, 1);
    const dem_body after = dem_get(s, 0);
    const double force = m * length(minus(after.v, before.v)) / s->def.dt;
    double overlap = after.r - (after.x.z + 10);
    if (!wall) {
      const dem_body other = dem_get(s, 1);
      overlap = after.r + other.r - length(minus(other.x, after.x));
    }
    seen.overlap = fmax(seen.overlap, overlap);
    seen.force = fmax(seen.force, force);
    seen.time += force > 0 ? s->def.dt : 0;
  }
  return seen;
}

/* Test 1: two equal spheres, 10 m/s each, elastic. A step is 1/5000 of the collision, and the
 * method is of first order: 1e-3 leaves room for both. */
static void chung_ooi_1(void **state)
{
  (void)state;
  const struct {
    stuff of;
    impact is;
  } cases[2] = {
      {{0.01, 2800, 4.8e10, 0.2, 0}, {2.74113e-4, 10696.9, 4.03395e-5}},
      {{0.01, 2500, 2.0e10, 0.25, 0}, {3.68304e-4, 7108.24, 5.42010e-5}},
  };
  for (int k = 0; k < 2; k++) {
    dem_scene s;
    approach(&s, &cases[k].of, &cases[k].of, 0, 20, 0);
    s.def.dt = cases[k].is.time / 5000;
    dem_start(&s);
    const impact seen = watch(&s, dem_mass(cases[k].of.density, 0.01), 0, 6000);
    assert_close(seen.overlap, cases[k].is.overlap, 1e-3);
    assert_close(seen.force, cases[k].is.force, 1e-3);
    assert_close(seen.time, cases[k].is.time, 1e-3);
    assert_close(receding(&s), 20.0, 1e-4);
    dem_scene_free(&s);
  }
}

/* Test 2: a sphere on a rigid plane, .2 m/s, elastic. */
static void chung_ooi_2(void **state)
{
  (void)state;
  const struct {
    stuff of;
    impact is;
  } cases[2] = {
      {{0.1, 2699, 7.0e10, 0.3, 0}, {4.97172e-5, 11369.9, 7.31657e-4}},
      {{0.1, 1800, 4.0e10, 0.35, 0}, {5.21233e-5, 7232.68, 7.67066e-4}},
  };
  for (int k = 0; k < 2; k++) {
    const stuff *of = &cases[k].of;
    dem_scene s;
    dem_scene_init(&s, space(3));
    dem_material(&s, of->density, of->young, of->poisson, of->damping, 0);
    dem_hertz(&s, 0);
    const dem_body b = {.x = {0, 0, -10 + of->r}, .v = {0, 0, -0.2}, .r = of->r};
    dem_add(&s, &b);
    s.def.dt = cases[k].is.time / 5000;
    dem_start(&s);
    const impact seen = watch(&s, dem_mass(of->density, of->r), 1, 6000);
    assert_close(seen.overlap, cases[k].is.overlap, 1e-3);
    assert_close(seen.force, cases[k].is.force, 1e-3);
    assert_close(seen.time, cases[k].is.time, 1e-3);
    assert_close(dem_get(&s, 0).v.z, 0.2, 1e-4);
    dem_scene_free(&s);
  }
}

/* Test 4: an oblique impact on a rigid plane at 3.9 m/s, e .98, mu .092. Returns the sphere
 * after it. */
static dem_body oblique(double degrees, packing_arm arm)
{
  const double r = 0.0025, young = 3.8e11, angle = degrees * DEM_PI / 180;
  const double vn = 3.9 * cos(angle), vt = 3.9 * sin(angle);
  dem_scene s;
  dem_scene_init(&s, space(3));
  dem_material(&s, 4000, young, 0.23, packing_hertz_damping(0.98, 0), 0.092);
  dem_hertz(&s, 0);
  dem_sliding(&s, 1e-3);
  const dem_body b = {.x = {0, 0, -10 + r}, .v = {0.6 * vt, 0.8 * vt, -vn}, .r = r};
  dem_add(&s, &b);
  const double time =
      dem_collision_time(dem_mass(4000, r), r, dem_rigid_young(young, 0.23), vn);
  s.def.arm = arm;
  s.def.dt = time / 4000;
  dem_start(&s);
  dem_run_for(&s, 1.5 * time);
  const dem_body seen = dem_get(&s, 0);
  dem_scene_free(&s);
  return seen;
}

/* All the contact through, the sphere slides: friction's impulse is mu times the normal one. The
 * arm at the radius makes this exact but for the step; the arm at the contact point is shorter by
 * the overlap, up to .3 % of it, within the 1 % asked. */
static void chung_ooi_4_gross_sliding(void **state)
{
  (void)state;
  static const double table[][4] = {
      {40, .78291, 544.216, 11.621}, {50, .84715, 456.652, 29.488},
      {60, .89483, 355.212, 48.159}, {70, .93370, 242.979, 65.086},
      {80, .96788, 123.364, 78.983}, {85, .98406, 61.918, 84.812}};
  for (size_t k = 0; k < sizeof table / sizeof *table; k++)
    for (int arm = 0; arm < 2; arm++) {
      const double angle = table[k][0] * DEM_PI / 180, tolerance = arm == 0 ? 1e-2 : 1e-3;
      const dem_body b = oblique(table[k][0], (packing_arm)arm);
      const double vt = hypot(b.v.x, b.v.y), w = length(b.w);
      assert_close(b.v.z / (3.9 * cos(angle)), 0.98, 1e-3);
      assert_close(vt / (3.9 * sin(angle)), table[k][1], 1e-3);
      assert_close(w, table[k][2], tolerance);
      assert_close(atan2(vt - w * b.r, b.v.z) * 180 / DEM_PI, table[k][3], tolerance);
      /* It rolls the way it goes. */
      assert_near(b.v.y * 0.6, b.v.x * 0.8, 1e-12);
      assert_true(b.w.x < 0 && b.w.y > 0 && b.w.z == 0);
      assert_near(b.w.x * 0.6, -b.w.y * 0.8, 1e-12 * w);
    }
}

/* Test 5 in the sliding regime: psi_2 = psi_1 - 7 and r w / (mu vn) = 5 for e = 1. */
static void chung_ooi_5_gross_sliding(void **state)
{
  (void)state;
  const double r = 1e-5, mu = 0.3, vn = 5;
  for (int k = 0; k < 3; k++) {
    const double psi = 7.5 + 2 * k;
    dem_scene s;
    dem_scene_init(&s, space(3));
    dem_material(&s, 7850, 2.08e11, 0.3, 0, mu);
    dem_hertz(&s, 0);
    dem_sliding(&s, 1e-3);
    const dem_body b = {.x = {0, 0, -10 + r}, .v = {psi * mu * vn, 0, -vn}, .r = r};
    dem_add(&s, &b);
    const double time =
        dem_collision_time(dem_mass(7850, r), r, dem_rigid_young(2.08e11, 0.3), vn);
    s.def.arm = PACKING_ARM_RADIUS;
    s.def.dt = time / 4000;
    dem_start(&s);
    dem_run_for(&s, 1.5 * time);
    const dem_body seen = dem_get(&s, 0);
    assert_near((seen.v.x - r * seen.w.y) / (mu * vn), psi - 7, 1e-2);
    assert_near(r * seen.w.y / (mu * vn), 5, 5e-3);
    dem_scene_free(&s);
  }
}

/* Test 7: equal spheres with opposite spins meet head-on; their surfaces move alike, so nothing
 * but the normal velocity changes. With equal spins they rub. */
static void chung_ooi_7(void **state)
{
  (void)state;
  for (int alike = 0; alike < 2; alike++) {
    dem_scene s;
    dem_scene_init(&s, space(3));
    dem_material(&s, 2700, 7e10, 0.33, packing_hertz_damping(0.5, 0), 0.4);
    dem_hertz(&s, 0);
    dem_sliding(&s, 1e-3);
    dem_body b = {.v = {0.2, 0, 0}, .w = {0, 0, 3}, .r = 0.1};
    dem_add(&s, &b);
    b.x.x = 0.2;
    b.v.x = -0.2;
    b.w.z = alike ? 3 : -3;
    dem_add(&s, &b);
    s.def.dt = 1e-6;
    dem_start(&s);
    dem_run_for(&s, 3e-3);
    const dem_body i = dem_get(&s, 0), j = dem_get(&s, 1);
    assert_close(j.v.x - i.v.x, 0.2, 2e-3);
    if (!alike) {
      assert_near(i.v.y, 0, 0);
      assert_near(j.v.y, 0, 0);
      assert_near(i.w.z, 3, 0);
      assert_near(j.w.z, -3, 0);
    } else {
      assert_true(i.v.y < -1e-3 && j.v.y > 1e-3);
      assert_true(i.w.z < 2.99 && j.w.z < 2.99);
    }
    dem_scene_free(&s);
  }
}

/* One step: force on a sphere and moment about its centre. */
typedef struct push {
  packing_vec3 force, moment;
} push;

static push pushed(const dem_body *before, const dem_body *after, double m,
                   double inertia, double dt)
{
  const push p = {along(minus(after->v, before->v), m / dt),
                  along(minus(after->w, before->w), inertia / dt)};
  return p;
}

static void assert_vector(packing_vec3 a, packing_vec3 b, double tolerance)
{
  const double d = length(minus(a, b));
  if (!(d <= tolerance * length(b)))
    print_error("(%g, %g, %g), expected (%g, %g, %g)\n", a.x, a.y, a.z, b.x, b.y, b.z);
  assert_true(d <= tolerance * length(b));
}

/* F2 and F4, said once more in vectors: force on i, and the moments on both. */
static void expected(const dem_body *i, const dem_body *j, const couple *c, double xi,
                     double mu, double slip, double share, int arms, packing_vec3 out[3])
{
  const packing_vec3 apart = minus(j->x, i->x);
  const double d = length(apart), overlap = i->r + j->r - d;
  const packing_vec3 n = along(apart, 1 / d);
  const double damper = 2 * xi * sqrt(c->m * 2 * c->young * sqrt(c->r * overlap));
  const double spring = 4.0 / 3 * c->young * sqrt(c->r) * pow(overlap, 1.5);
  const double normal = fmax(spring + damper * dot(minus(i->v, j->v), n), 0);
  const double ai = arms == PACKING_ARM_RADIUS ? i->r : i->r - share * overlap;
  const double aj = arms == PACKING_ARM_RADIUS ? j->r : j->r - (1 - share) * overlap;
  const packing_vec3 pi = minus(i->v, along(cross(i->w, n), -ai));
  const packing_vec3 pj = minus(j->v, along(cross(j->w, n), aj));
  packing_vec3 u = minus(pj, pi);
  u = minus(u, along(n, dot(u, n)));
  const packing_vec3 friction = along(u, mu * normal / sqrt(dot(u, u) + slip * slip));
  out[0] = minus(friction, along(n, normal));
  out[1] = along(cross(n, friction), ai);
  out[2] = along(cross(n, friction), aj);
}

/* Unequal sizes and materials, spins about every axis: every term at once, in one step. The
 * overlap's rounding, 1e-17 / 5e-5, comes first in the tolerance. */
static void one_step_is_the_formula(void **state)
{
  (void)state;
  const stuff a = {0.01, 1000, 1e8, 0.25, 0.1}, b = {0.025, 2600, 4e8, 0.4, 0.3};
  const couple c = reduced(&a, &b);
  const double share = c.young / dem_rigid_young(a.young, a.poisson);
  const double ma = dem_mass(a.density, a.r), mb = dem_mass(b.density, b.r);
  for (int arms = 0; arms < 2; arms++)
    for (int sign = -1; sign < 2; sign += 2) {
      dem_scene s;
      dem_scene_init(&s, space(3));
      dem_material(&s, a.density, a.young, a.poisson, a.damping, 0.1);
      dem_material(&s, b.density, b.young, b.poisson, b.damping, 0.5);
      dem_hertz(&s, 0);
      dem_sliding(&s, 0.05);
      dem_body i = {.v = {0.3, -0.1, 0.2 * sign}, .w = {3, -5, 2}, .r = a.r, .type = 1};
      dem_body j = {.x = along(askew, a.r + b.r - 5e-5),
                    .v = {-0.2, 0.15, 0.05},
                    .w = {-7, 1, 4},
                    .r = b.r,
                    .type = 2};
      dem_add(&s, &i);
      dem_add(&s, &j);
      s.def.arm = (packing_arm)arms;
      s.def.dt = 1e-6;
      dem_start(&s);
      dem_run(&s, 1);
      const dem_body after_i = dem_get(&s, 0), after_j = dem_get(&s, 1);
      const push on_i = pushed(&i, &after_i, ma, 0.4 * ma * a.r * a.r, 1e-6);
      const push on_j = pushed(&j, &after_j, mb, 0.4 * mb * b.r * b.r, 1e-6);
      packing_vec3 want[3];
      expected(&i, &j, &c, 0.2, 0.3, 0.05, share, arms, want);
      assert_true(length(want[1]) > 0);
      assert_vector(on_i.force, want[0], 1e-10);
      assert_vector(on_j.force, along(want[0], -1), 1e-10);
      assert_vector(on_i.moment, want[1], 1e-10);
      assert_vector(on_j.moment, want[2], 1e-10);
      /* x moves with the new velocity. */
      assert_vector(minus(after_i.x, i.x), along(after_i.v, 1e-6), 1e-10);
      dem_scene_free(&s);
    }
}

/* Receding fast, the damper would pull: cut off by default, kept on demand. */
static void pull_is_an_option(void **state)
{
  (void)state;
  for (int pull = 0; pull < 2; pull++) {
    dem_scene s;
    approach(&s, &common, &common, pull, -1, -1e-6);
    s.def.dt = 1e-6;
    dem_start(&s);
    dem_run(&s, 1);
    if (pull)
      assert_true(receding(&s) < 1 - 1e-5);
    else
      assert_close(receding(&s), 1.0, 1e-15);
    dem_scene_free(&s);
  }
}

/* Stiffness of unlike materials, in one step without velocities. */
static void reduced_young_of_unlike_materials(void **state)
{
  (void)state;
  static const double young[] = {1e7, 1e8, 3e9}, poisson[] = {0, 0.25, 0.5};
  for (int k = 0; k < 3; k++)
    for (int l = 0; l < 3; l++) {
      const stuff a = {0.01, 1000, young[k], poisson[l], 0};
      const stuff b = {0.02, 3000, young[(k + l) % 3], poisson[k], 0};
      const couple c = reduced(&a, &b);
      dem_scene s;
      approach(&s, &a, &b, 0, 0, -4e-5);
      s.def.dt = 1e-6;
      dem_start(&s);
      dem_run(&s, 1);
      assert_close(receding(&s) / 1e-6 * c.m,
                   4.0 / 3 * c.young * sqrt(c.r) * pow(4e-5, 1.5), 1e-10);
      dem_scene_free(&s);
    }
}

/* Two spheres that do not touch, `apart` from centre to centre, with a near field alone. */
static void near_pair(dem_scene *s, double apart, const double field[5])
{
  dem_scene_init(s, space(3));
  dem_material(s, 1000, 1e4, 0.25, 0, 0);
  dem_hertz(s, 0);
  dem_near_field(s, field[0], field[1], field[2], field[3], field[4]);
  dem_body b = {.r = 0.0625};
  dem_add(s, &b);
  b.x.x = apart;
  dem_add(s, &b);
  s->def.dt = 1e-4;
  dem_start(s);
}

static double near_force(double apart, const double field[5])
{
  dem_scene s;
  near_pair(&s, apart, field);
  dem_run(&s, 1);
  const double m = dem_mass(1000, 0.0625);
  const dem_body i = dem_get(&s, 0), j = dem_get(&s, 1);
  assert_near(i.v.x, -j.v.x, 0);
  assert_true(i.v.y == 0 && i.v.z == 0);
  dem_scene_free(&s);
  return m * (j.v.x - i.v.x) / 2 / 1e-4;
}

static void near_field_signs_and_size(void **state)
{
  (void)state;
  const double attracts[5] = {3, 2, 0, 0, 1}, repels[5] = {0, 0, 3, 1.5, 1},
               both[5] = {3, 1, 0.5, 4, 1};
  assert_close(near_force(0.3, attracts), -3 / (0.3 * 0.3), 1e-12);
  assert_close(near_force(0.3, repels), 3 / pow(0.3, 1.5), 1e-12);
  assert_close(near_force(0.3, both), 0.5 / pow(0.3, 4) - 3 / 0.3, 1e-12);
}

/* A distance of exactly the cutoff is too far. */
static void near_field_ends_at_the_cutoff(void **state)
{
  (void)state;
  const double field[5] = {3, 0, 0, 0, 0.5};
  assert_near(near_force(0.5, field), 0, 0);
  assert_near(near_force(0.75, field), 0, 0);
  assert_close(near_force(nextafter(0.5, 0), field), -3.0, 1e-12);
}

/* alpha_1 d^-2 and alpha_2 d^-4 cancel at d = sqrt(alpha_2 / alpha_1) = 1/2, where all numbers
 * are powers of two: the pair stays to the last bit. Nudged, it swings with stiffness
 * 4 alpha_2 d^-5 - 2 alpha_1 d^-3 = 16. */
static void near_field_holds_a_pair(void **state)
{
  (void)state;
  const double field[5] = {1, 2, 0.25, 4, 1}, nudge = 1e-5;
  dem_scene s;
  near_pair(&s, 0.5, field);
  dem_run(&s, 1000);
  assert_near(dem_get(&s, 0).x.x, 0, 0);
  assert_near(dem_get(&s, 1).x.x, 0.5, 0);
  dem_scene_free(&s);
  near_pair(&s, 0.5 + nudge, field);
  const double omega = sqrt(16 / (dem_mass(1000, 0.0625) / 2));
  dem_run_for(&s, DEM_PI / omega);
  /* Half a period on, the nudge is on the other side; first order in dt and in the nudge. */
  assert_near(dem_get(&s, 1).x.x - dem_get(&s, 0).x.x - 0.5, -nudge, 1e-3 * nudge);
  dem_scene_free(&s);
}

static void walls_have_no_near_field(void **state)
{
  (void)state;
  dem_scene s;
  dem_scene_init(&s, space(3));
  dem_material(&s, 1000, 1e4, 0.25, 0, 0);
  dem_near_field(&s, 1, 0, 0, 0, 1);
  const dem_body b = {.x = {0, 0, -9.9}, .r = 0.0625};
  dem_add(&s, &b);
  s.def.dt = 1e-4;
  dem_start(&s);
  dem_run(&s, 10);
  assert_near(dem_get(&s, 0).x.z, -9.9, 0);
  dem_scene_free(&s);
}

/* In the plane, a disc that weighs as a sphere and one that weighs as a disc, rubbing against one
 * at rest for a step: mass and inertia show in velocity and spin. */
static void flat_masses(void **state)
{
  (void)state;
  const double r = 0.01, overlap = 5e-5, dt = 1e-6;
  for (int disc = 0; disc < 2; disc++) {
    const double density = disc ? 15 : 1000;
    const double m = disc ? DEM_PI * r * r * density : dem_mass(density, r);
    const couple c = {m / 2, r / 2, dem_rigid_young(1e8, 0.25) / 2};
    const double inertia = (disc ? 0.5 : 0.4) * m * r * r;
    dem_scene s;
    dem_scene_init(&s, space(2));
    dem_material(&s, density, 1e8, 0.25, 0.1, 0.3);
    dem_hertz(&s, 0);
    dem_sliding(&s, 0.05);
    dem_body i = {.v = {0.1, 0.3, 0}, .w = {0, 0, 20}, .r = r};
    dem_body j = {.x = {0.6 * (2 * r - overlap), 0.8 * (2 * r - overlap), 0}, .r = r};
    dem_add(&s, &i);
    dem_add(&s, &j);
    s.def.disc_mass = disc;
    s.def.dt = dt;
    dem_start(&s);
    dem_run(&s, 1);
    const dem_body after_i = dem_get(&s, 0), after_j = dem_get(&s, 1);
    const push on_i = pushed(&i, &after_i, m, inertia, dt);
    const push on_j = pushed(&j, &after_j, m, inertia, dt);
    packing_vec3 want[3];
    expected(&i, &j, &c, 0.1, 0.3, 0.05, 0.5, 0, want);
    assert_vector(on_i.force, want[0], 1e-10);
    assert_vector(on_j.force, along(want[0], -1), 1e-10);
    assert_vector(on_i.moment, want[1], 1e-10);
    assert_vector(on_j.moment, want[2], 1e-10);
    dem_scene_free(&s);
  }
}

/* Two dimensions stay flat to the last bit, for hundreds of collisions. */
static void flat_stays_flat(void **state)
{
  (void)state;
  dem_scene s;
  dem_scene_init(&s, test_rectangle(0.3, 0.3, PACKING_PERIODIC_X));
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.5);
  dem_hertz(&s, 0);
  dem_sliding(&s, 1e-3);
  dem_cloud(&s, 0.01, 1.5, 0.4, 1, 1, 5);
  s.def.gravity.y = -2;
  s.def.dt = 2e-5;
  dem_start(&s);
  dem_run(&s, 1500);
  double spin = 0;
  for (size_t i = 0; i < packing_particles_count(s.store); i++) {
    const dem_body b = dem_get(&s, i);
    assert_true(b.x.z == 0 && b.v.z == 0 && b.w.x == 0 && b.w.y == 0);
    spin += fabs(b.w.z);
  }
  assert_true(spin > 0);
  dem_scene_free(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(head_on_pair_repels),
      cmocka_unit_test(restitution_follows_damping),
      cmocka_unit_test(restitution_does_not_depend_on_anything_else),
      cmocka_unit_test(pair_damping_takes_the_place_of_the_mean),
      cmocka_unit_test(paper_step_scatters_as_known),
      cmocka_unit_test(chung_ooi_1),
      cmocka_unit_test(chung_ooi_2),
      cmocka_unit_test(chung_ooi_4_gross_sliding),
      cmocka_unit_test(chung_ooi_5_gross_sliding),
      cmocka_unit_test(chung_ooi_7),
      cmocka_unit_test(one_step_is_the_formula),
      cmocka_unit_test(pull_is_an_option),
      cmocka_unit_test(reduced_young_of_unlike_materials),
      cmocka_unit_test(near_field_signs_and_size),
      cmocka_unit_test(near_field_ends_at_the_cutoff),
      cmocka_unit_test(near_field_holds_a_pair),
      cmocka_unit_test(walls_have_no_near_field),
      cmocka_unit_test(flat_masses),
      cmocka_unit_test(flat_stays_flat),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
