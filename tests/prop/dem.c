/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What must hold for any scene: conservation, symmetry, scaling. */
#include "dem_scenes.h"

static double dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static packing_vec3 plus(packing_vec3 a, double by, packing_vec3 b)
{
  return dem_vec(a.x + by * b.x, a.y + by * b.y, a.z + by * b.z);
}

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  return dem_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static const double density = 1000, young = 1e8, poisson = 0.25;

/* Spheres near the origin of a space without walls in reach, all bound for the origin. */
static void implosion(dem_scene *s, double fraction, double damping, double friction)
{
  packing_domain_box_def def;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&def);
  def.size = dem_vec(20, 20, 20);
  def.corner = dem_vec(-10, -10, -10);
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  dem_scene_init(s, domain);
  dem_material(s, density, young, poisson, damping, friction);
  dem_hertz(s, 0);
  dem_scene cloud;
  dem_scene_init(&cloud, test_box(0.125, 0.125, 0.125, 0));
  dem_cloud(&cloud, 0.01, 2, fraction, 1, 0.3, 3);
  const packing_vec3 middle = {0.0625, 0.0625, 0.0625};
  for (size_t i = 0; i < packing_particles_count(cloud.store); i++) {
    dem_body b = dem_get(&cloud, i);
    b.x = plus(b.x, -1, middle);
    b.v = plus(b.v, -20, b.x);
    dem_add(s, &b);
  }
  dem_scene_free(&cloud);
}

/* Sums over all particles. */
typedef struct sums {
  packing_vec3 momentum, angular;
  double momentum_scale, angular_scale, energy;
} sums;

static double spring_energy(const dem_body *a, const dem_body *b)
{
  const packing_vec3 apart = plus(a->x, -1, b->x);
  const double overlap = a->r + b->r - sqrt(dot(apart, apart));
  const double reduced_young = dem_rigid_young(young, poisson) / 2;
  return overlap <= 0 ? 0
                      : 8.0 / 15 * reduced_young * sqrt(a->r * b->r / (a->r + b->r)) *
                            pow(overlap, 2.5);
}

static sums sum(const dem_scene *s)
{
  const size_t count = packing_particles_count(s->store);
  sums t;
  memset(&t, 0, sizeof t);
  for (size_t i = 0; i < count; i++) {
    const dem_body b = dem_get(s, i);
    const double m = dem_mass(density, b.r), inertia = 0.4 * m * b.r * b.r;
    t.momentum = plus(t.momentum, m, b.v);
    t.momentum_scale += m * sqrt(dot(b.v, b.v));
    t.angular = plus(plus(t.angular, m, cross(b.x, b.v)), inertia, b.w);
    t.angular_scale +=
        m * sqrt(dot(b.x, b.x) * dot(b.v, b.v)) + inertia * sqrt(dot(b.w, b.w));
    t.energy += 0.5 * m * dot(b.v, b.v) + 0.5 * inertia * dot(b.w, b.w);
    for (size_t j = 0; j < i; j++) {
      const dem_body other = dem_get(s, j);
      t.energy += spring_energy(&b, &other);
    }
  }
  return t;
}

static double distance(packing_vec3 a, packing_vec3 b)
{
  const packing_vec3 d = plus(a, -1, b);
  return sqrt(dot(d, d));
}

/* Each pair adds opposite numbers: what drifts is the rounding of some 1000 additions. */
static void momentum_is_conserved(void **state)
{
  (void)state;
  for (int periodic = 0; periodic < 2; periodic++) {
    dem_scene s;
    if (periodic) {
      dem_scene_init(&s, test_box(0.25, 0.25, 0.25, 7));
      dem_material(&s, density, young, poisson, 0.1, 0.3);
      dem_hertz(&s, 0);
      dem_cloud(&s, 0.01, 3, 0.35, 1, 1, 7);
    } else {
      implosion(&s, 0.25, 0.1, 0.3);
    }
    dem_sliding(&s, 1e-2);
    dem_near_field(&s, 0.01, 1, 0.0002, 2, 0.06);
    s.def.dt = 2e-5;
    dem_start(&s);
    const sums before = sum(&s);
    dem_run(&s, 500);
    const sums after = sum(&s);
    assert_near(distance(after.momentum, before.momentum), 0,
                1e-13 * before.momentum_scale);
    assert_true(fabs(after.energy / before.energy - 1) > 1e-3); /* they did collide */
    dem_scene_free(&s);
  }
}

/* With arms that end in one point the moments of a contact cancel against those of its forces.
 * Arms of r_i and r_j are too long by the overlap together. */
static void angular_momentum_needs_arms_to_the_contact(void **state)
{
  (void)state;
  double drift[2];
  for (int arm = 0; arm < 2; arm++) {
    dem_scene s;
    implosion(&s, 0.25, 0.1, 0.3);
    dem_material(&s, density, 3 * young, poisson, 0.1, 0.3);
    for (size_t i = 0; i < packing_particles_count(s.store); i += 2) {
      int32_t type[512];
      assert_true(packing_particles_count(s.store) <= 512);
      assert_ok(
          packing_particles_extract(s.store, PACKING_FIELD_TYPE, type, sizeof *type));
      type[i] = 2;
      assert_ok(packing_particles_set(s.store, PACKING_FIELD_TYPE, type, sizeof *type));
    }
    dem_sliding(&s, 1e-2);
    s.def.dt = 1e-5;
    s.def.arm = (packing_arm)arm;
    dem_start(&s);
    const sums before = sum(&s);
    dem_run(&s, 1000);
    const sums after = sum(&s);
    drift[arm] = distance(after.angular, before.angular) / before.angular_scale;
    dem_scene_free(&s);
  }
  assert_near(drift[PACKING_ARM_CONTACT], 0, 1e-13);
  assert_true(drift[PACKING_ARM_RADIUS] > 1e-6);
}

/* Largest deviation of kinetic plus elastic energy over a time, relative. */
static double energy_error(double dt, double *at_end)
{
  dem_scene s;
  implosion(&s, 0.2, 0, 0);
  s.def.dt = dt;
  dem_start(&s);
  const double before = sum(&s).energy;
  double most = 0, now = 0;
  const int parts = 200;
  for (int k = 0; k < parts; k++) {
    dem_run_for(&s, 5e-3 / parts);
    now = fabs(sum(&s).energy / before - 1);
    most = fmax(most, now);
  }
  *at_end = now;
  dem_scene_free(&s);
  return most;
}

/* Within contacts the energy of semi-implicit Euler is off by a term of first order, dt v . F / 2,
 * which comes and goes. Halving the step halves it. */
static void elastic_energy_converges_in_first_order(void **state)
{
  (void)state;
  double end;
  const double coarse = energy_error(5e-6, &end), middle = energy_error(2.5e-6, &end),
               fine = energy_error(1.25e-6, &end);
  assert_true(coarse < 0.05);
  assert_near(log2(coarse / middle), 1, 0.25);
  assert_near(log2(middle / fine), 1, 0.15);
}

/* Damping and friction never add energy to what is there, up to that term. */
static void dissipation_only_takes(void **state)
{
  (void)state;
  dem_scene s;
  implosion(&s, 0.25, 0.1, 0.5);
  dem_sliding(&s, 1e-2);
  s.def.dt = 2e-6;
  dem_start(&s);
  double before = sum(&s).energy;
  const double first = before;
  for (int k = 0; k < 40; k++) {
    dem_run(&s, 100);
    const double now = sum(&s).energy;
    assert_true(now < before + 2e-3 * first);
    before = now;
  }
  assert_true(before < 0.8 * first);
  dem_scene_free(&s);
}

/* A drum in the middle of which the origin lies, walls all round. */
static void drum(dem_scene *s)
{
  packing_domain_box_def def;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&def);
  def.size = dem_vec(0.25, 0.25, 0.25);
  def.corner = dem_vec(-0.125, -0.125, -0.125);
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  dem_scene_init(s, domain);
  dem_material(s, density, young, poisson, 0.1, 0.3);
  dem_material(s, 3 * density, 2 * young, poisson, 0.2, 0.5);
  dem_hertz(s, 0);
  dem_sliding(s, 1e-2);
  s->def.gravity = dem_vec(4, 1, -20);
  s->def.drag = 0.01;
  s->def.fluid_velocity = dem_vec(1, -2, 0.5);
  s->def.dt = 1e-5;
}

/* What is left turns right: forces meet a particle in another order, so equal to rounding, which
 * collisions amplify. */
static void mirror_image(void **state)
{
  (void)state;
  dem_scene s, mirror;
  drum(&s);
  drum(&mirror);
  dem_cloud(&s, 0.01, 2, 0.33, 2, 2, 19);
  const size_t count = packing_particles_count(s.store);
  for (size_t i = 0; i < count; i++) {
    dem_body b = dem_get(&s, i);
    b.x.x = -b.x.x;
    b.v.x = -b.v.x;
    b.w.y = -b.w.y;
    b.w.z = -b.w.z;
    dem_add(&mirror, &b);
  }
  mirror.def.gravity.x = -mirror.def.gravity.x;
  mirror.def.fluid_velocity.x = -mirror.def.fluid_velocity.x;
  dem_start(&s);
  dem_start(&mirror);
  const packing_dem_report report = dem_run(&s, 400);
  dem_run(&mirror, 400);
  assert_true(report.contacts > 10 && report.wall_contacts > 3);
  for (size_t i = 0; i < count; i++) {
    const dem_body a = dem_get(&s, i), b = dem_get(&mirror, i);
    assert_near(a.x.x, -b.x.x, 1e-10 * a.r);
    assert_near(a.x.y, b.x.y, 1e-10 * a.r);
    assert_near(a.x.z, b.x.z, 1e-10 * a.r);
    assert_near(a.w.x, b.w.x, 1e-6);
    assert_near(a.w.y, -b.w.y, 1e-6);
    assert_near(a.w.z, -b.w.z, 1e-6);
  }
  dem_scene_free(&s);
  dem_scene_free(&mirror);
}

/* The order in which particles stand in the store changes nothing but rounding. */
static void order_of_particles_is_no_matter(void **state)
{
  (void)state;
  dem_scene s, backwards;
  drum(&s);
  drum(&backwards);
  dem_cloud(&s, 0.01, 2, 0.33, 2, 2, 23);
  const size_t count = packing_particles_count(s.store);
  for (size_t i = count; i-- > 0;) {
    const dem_body b = dem_get(&s, i);
    dem_add(&backwards, &b);
  }
  dem_start(&s);
  dem_start(&backwards);
  dem_run(&s, 400);
  dem_run(&backwards, 400);
  for (size_t i = 0; i < count; i++) {
    const dem_body a = dem_get(&s, i), b = dem_get(&backwards, count - 1 - i);
    assert_true(a.r == b.r && a.type == b.type);
    assert_near(distance(a.x, b.x), 0, 1e-10 * a.r);
  }
  dem_scene_free(&s);
  dem_scene_free(&backwards);
}

/* In a periodic cell there is no first point: shifted by a third of it, all goes the same way. */
static void shifted_cell(void **state)
{
  (void)state;
  dem_scene s, shifted;
  const packing_vec3 shift = {0.08, 0.17, 0.12};
  dem_scene *const both[2] = {&s, &shifted};
  for (int k = 0; k < 2; k++) {
    dem_scene_init(both[k], test_box(0.25, 0.25, 0.25, 7));
    dem_material(both[k], density, young, poisson, 0.1, 0.3);
    dem_hertz(both[k], 0);
    dem_sliding(both[k], 1e-2);
    both[k]->def.dt = 1e-5;
  }
  dem_cloud(&s, 0.01, 3, 0.35, 1, 2, 29);
  const size_t count = packing_particles_count(s.store);
  for (size_t i = 0; i < count; i++) {
    dem_body b = dem_get(&s, i);
    b.x = plus(b.x, 1, shift);
    packing_domain_wrap(shifted.domain, &b.x);
    dem_add(&shifted, &b);
  }
  dem_start(&s);
  dem_start(&shifted);
  const packing_dem_report report = dem_run(&s, 400);
  dem_run(&shifted, 400);
  assert_true(report.contacts > 10);
  for (size_t i = 0; i < count; i++) {
    const dem_body a = dem_get(&s, i), b = dem_get(&shifted, i);
    const packing_vec3 moved = plus(a.x, 1, shift);
    const packing_vec3 d = packing_domain_separation(s.domain, &moved, &b.x);
    /* The shift itself rounds positions by 1e-17, 1e-13 of a collision's overlap. */
    assert_near(sqrt(dot(d, d)), 0, 1e-9 * a.r);
  }
  dem_scene_free(&s);
  dem_scene_free(&shifted);
}

/* A drum with units of length 2^a, time 2^b and mass 2^c times as large. */
static void scaled_drum(dem_scene *s, const dem_scene *cloud, int a, int b, int c,
                        int own_dt)
{
  const double length = ldexp(1, a), time = ldexp(1, b), mass = ldexp(1, c);
  const double velocity = length / time, pressure = mass / (length * time * time);
  packing_domain_box_def def;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&def);
  def.size = dem_vec(0.25 * length, 0.25 * length, 0.25 * length);
  def.corner = dem_vec(-0.125 * length, -0.125 * length, -0.125 * length);
  def.periodic = PACKING_PERIODIC_Y;
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  dem_scene_init(s, domain);
  const double volume = length * length * length;
  dem_material(s, density * mass / volume, young * pressure, poisson, 0.1, 0.3);
  dem_material(s, 3 * density * mass / volume, 2 * young * pressure, poisson, 0.2, 0.5);
  dem_hertz(s, 0);
  dem_sliding(s, 1e-2 * velocity);
  s->def.gravity = dem_vec(4 * velocity / time, velocity / time, -20 * velocity / time);
  s->def.drag = 0.01 * mass / time;
  s->def.fluid_velocity = dem_vec(velocity, -2 * velocity, 0.5 * velocity);
  s->def.dt = own_dt ? 0 : 1e-5 * time;
  dem_copy(s, cloud, length, velocity);
  dem_start(s);
}

/* No length, time or mass is special: powers of two change nothing but exponents. */
static void units_are_no_matter(void **state)
{
  (void)state;
  static const int units[][3] = {{1, 0, 0},  {-7, 0, 0},  {0, 3, 0},
                                 {0, 0, -9}, {13, -5, 4}, {-20, 11, 1}};
  dem_scene cloud;
  drum(&cloud);
  dem_cloud(&cloud, 0.01, 2, 0.33, 2, 2, 31);
  const size_t count = packing_particles_count(cloud.store);
  for (int own_dt = 0; own_dt < 2; own_dt++) {
    dem_scene s;
    scaled_drum(&s, &cloud, 0, 0, 0, own_dt);
    const packing_dem_report report = dem_run(&s, 300);
    assert_true(report.contacts > 10 && report.wall_contacts > 0);
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
      if (own_dt && (k != 0 && k != 4))
        continue;
      const int *u = units[k];
      dem_scene t;
      scaled_drum(&t, &cloud, u[0], u[1], u[2], own_dt);
      const packing_dem_report scaled = dem_run(&t, 300);
      /* The advice has a fifth root, of which the last digit may differ. */
      if (own_dt) {
        assert_close(scaled.dt, ldexp(report.dt, u[1]), 1e-14);
        dem_scene_free(&t);
        continue;
      }
      assert_true(scaled.contacts == report.contacts &&
                  scaled.rebuilds == report.rebuilds);
      assert_true(scaled.kinetic_energy ==
                  ldexp(report.kinetic_energy, u[2] + 2 * (u[0] - u[1])));
      assert_true(scaled.max_overlap == report.max_overlap);
      for (size_t i = 0; i < count; i++) {
        const dem_body a = dem_get(&s, i), b = dem_get(&t, i);
        assert_true(b.x.x == ldexp(a.x.x, u[0]) && b.x.y == ldexp(a.x.y, u[0]) &&
                    b.x.z == ldexp(a.x.z, u[0]));
        assert_true(b.v.z == ldexp(a.v.z, u[0] - u[1]) && b.w.x == ldexp(a.w.x, -u[1]));
      }
      dem_scene_free(&t);
    }
    dem_scene_free(&s);
  }
  dem_scene_free(&cloud);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(momentum_is_conserved),
      cmocka_unit_test(angular_momentum_needs_arms_to_the_contact),
      cmocka_unit_test(elastic_energy_converges_in_first_order),
      cmocka_unit_test(dissipation_only_takes),
      cmocka_unit_test(mirror_image),
      cmocka_unit_test(order_of_particles_is_no_matter),
      cmocka_unit_test(shifted_cell),
      cmocka_unit_test(units_are_no_matter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
