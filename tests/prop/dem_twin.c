/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper against a twin: the paper's equations said plainly, all pairs, one by one. Both add
 * the same forces in different orders, so they part by rounding only, which collisions amplify;
 * runs are short enough for 1e-11 of a radius. */
#include "dem_scenes.h"

/* The slip velocity is so large that friction, taken at the old velocities, does not overshoot in
 * the hardest collision (3.5 mu normal dt / m stays below it): else sticking contacts chatter, and
 * rounding doubles with every step. */

enum { MOST = 700, MATERIALS = 2 };

/* What the twin is made from, beside the particles. */
typedef struct model {
  int dim, rotations, disc_mass, pull, rubs;
  packing_arm arm;
  unsigned periodic;
  packing_vec3 size;
  double density[MATERIALS], young[MATERIALS], poisson[MATERIALS], damping[MATERIALS],
      friction[MATERIALS];
  int walls_of; /* material of the walls, -1: rigid */
  double slip;
  packing_vec3 gravity, fluid;
  double drag;
  double attraction, repulsion, cutoff; /* d^-1 and d^-2; cutoff 0: none */
  double dt;
} model;

static double dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* a + by * b */
static packing_vec3 plus(packing_vec3 a, double by, packing_vec3 b)
{
  return dem_vec(a.x + by * b.x, a.y + by * b.y, a.z + by * b.z);
}

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  return dem_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static double mass(const model *m, const dem_body *b)
{
  const double density = m->density[b->type - 1];
  return m->disc_mass ? DEM_PI * b->r * b->r * density : dem_mass(density, b->r);
}

/* (1 - nu^2) / E; 0 for rigid walls. */
static double compliance(const model *m, int material)
{
  return material < 0
             ? 0
             : (1 - m->poisson[material] * m->poisson[material]) / m->young[material];
}

static double mean(const double of[MATERIALS], int a, int b)
{
  return b < 0 ? of[a] : (of[a] + of[b]) / 2;
}

/* Force on i at the contact and the arms, for unit normal n from i to j. A wall is a `j` at rest
 * of infinite mass and radius. */
static packing_vec3 contact(const model *m, const dem_body *i, const dem_body *j,
                            int other, packing_vec3 n, double overlap, double r,
                            double reduced_m, double arms[2])
{
  const int own = i->type - 1;
  const double soft_i = compliance(m, own), soft_j = compliance(m, other);
  const double young = 1 / (soft_i + soft_j);
  const double xi = mean(m->damping, own, other), mu = mean(m->friction, own, other);
  const double c = 2 * xi * sqrt(2 * young * reduced_m * sqrt(r)) * pow(overlap, 0.25);
  const double approach = dot(plus(i->v, -1, j->v), n);
  double normal = 4.0 / 3 * sqrt(r) * young * pow(overlap, 1.5) + c * approach;
  if (!m->pull && normal < 0)
    normal = 0;
  const int full = m->arm == PACKING_ARM_RADIUS;
  arms[0] = i->r - (full ? 0 : overlap * soft_i * young);
  arms[1] = j->r - (full ? 0 : overlap * soft_j * young);
  packing_vec3 u =
      plus(plus(j->v, -arms[1], cross(j->w, n)), -1, plus(i->v, arms[0], cross(i->w, n)));
  u = plus(u, -dot(u, n), n);
  const double rub =
      m->rubs ? mu * fabs(normal) / sqrt(dot(u, u) + m->slip * m->slip) : 0;
  return plus(dem_vec(n.x * -normal, n.y * -normal, n.z * -normal), rub, u);
}

/* Of the nearest image, for particles that stay within a cell of each other. */
static double image(double d, double size, int periodic)
{
  if (!periodic)
    return d;
  return d > size / 2 ? d - size : d < -size / 2 ? d + size : d;
}

static void add_pair(const model *m, const dem_body *b, size_t i, size_t j,
                     packing_vec3 *force, packing_vec3 *moment)
{
  packing_vec3 apart = plus(b[j].x, -1, b[i].x);
  apart.x = image(apart.x, m->size.x, (m->periodic & 1) != 0);
  apart.y = image(apart.y, m->size.y, (m->periodic & 2) != 0);
  apart.z = image(apart.z, m->size.z, (m->periodic & 4) != 0);
  const double d = sqrt(dot(apart, apart)), overlap = b[i].r + b[j].r - d;
  const packing_vec3 n = {apart.x / d, apart.y / d, apart.z / d};
  if (d < m->cutoff) {
    const double near = m->attraction / d - m->repulsion / (d * d);
    force[i] = plus(force[i], near, n);
    force[j] = plus(force[j], -near, n);
  }
  if (overlap <= 0)
    return;
  const double mi = mass(m, &b[i]), mj = mass(m, &b[j]);
  double arms[2];
  const packing_vec3 f =
      contact(m, &b[i], &b[j], b[j].type - 1, n, overlap,
              b[i].r * b[j].r / (b[i].r + b[j].r), mi * mj / (mi + mj), arms);
  force[i] = plus(force[i], 1, f);
  force[j] = plus(force[j], -1, f);
  moment[i] = plus(moment[i], arms[0], cross(n, f));
  moment[j] = plus(moment[j], arms[1], cross(n, f));
}

static void add_walls(const model *m, const dem_body *b, packing_vec3 *force,
                      packing_vec3 *moment)
{
  const dem_body wall = {.r = 1};
  const double at[3] = {b->x.x, b->x.y, b->x.z};
  const double size[3] = {m->size.x, m->size.y, m->size.z};
  for (int axis = 0; axis < m->dim; axis++)
    for (int high = 0; high < 2 && (m->periodic >> axis & 1) == 0; high++) {
      const double overlap = b->r - (high ? size[axis] - at[axis] : at[axis]);
      const double to = high ? 1 : -1;
      const packing_vec3 n =
          dem_vec(axis == 0 ? to : 0, axis == 1 ? to : 0, axis == 2 ? to : 0);
      double arms[2];
      if (overlap <= 0)
        continue;
      const packing_vec3 f =
          contact(m, b, &wall, m->walls_of, n, overlap, b->r, mass(m, b), arms);
      *force = plus(*force, 1, f);
      *moment = plus(*moment, arms[0], cross(n, f));
    }
}

/* One step of semi-implicit Euler. */
static void twin_step(const model *m, dem_body *b, size_t count)
{
  static packing_vec3 force[MOST], moment[MOST];
  memset(force, 0, sizeof force);
  memset(moment, 0, sizeof moment);
  for (size_t i = 0; i < count; i++) {
    for (size_t j = i + 1; j < count; j++)
      add_pair(m, b, i, j, force, moment);
    add_walls(m, &b[i], &force[i], &moment[i]);
    force[i] = plus(force[i], mass(m, &b[i]), m->gravity);
    force[i] = plus(force[i], m->drag, plus(m->fluid, -1, b[i].v));
  }
  for (size_t i = 0; i < count; i++) {
    const double weight = mass(m, &b[i]);
    const double inertia = (m->disc_mass ? 0.5 : 0.4) * weight * b[i].r * b[i].r;
    b[i].v = plus(b[i].v, m->dt / weight, force[i]);
    if (m->rotations)
      b[i].w = plus(b[i].w, m->dt / inertia, moment[i]);
    b[i].x = plus(b[i].x, m->dt, b[i].v);
  }
}

static model common(int dim, unsigned periodic)
{
  const model m = {.dim = dim,
                   .rotations = 1,
                   .rubs = 1,
                   .periodic = periodic,
                   .size =
                       dim == 2 ? dem_vec(0.75, 0.5, 0) : dem_vec(0.25, 0.3125, 0.28125),
                   .density = {1000, 2600},
                   .young = {1e8, 3e8},
                   .poisson = {0.25, 0.4},
                   .damping = {0.1, 0.3},
                   .friction = {0.2, 0.6},
                   .walls_of = -1,
                   .slip = 0.5,
                   .dt = 1e-5};
  return m;
}

static void scene_of(dem_scene *s, const model *m)
{
  dem_scene_init(s, m->dim == 2 ? test_rectangle(m->size.x, m->size.y, m->periodic)
                                : test_box(m->size.x, m->size.y, m->size.z, m->periodic));
  for (int k = 0; k < MATERIALS; k++)
    dem_material(s, m->density[k], m->young[k], m->poisson[k], m->damping[k],
                 m->friction[k]);
  dem_hertz(s, m->pull);
  if (m->rubs)
    dem_sliding(s, m->slip);
  if (m->cutoff > 0)
    dem_near_field(s, m->attraction, 1, m->repulsion, 2, m->cutoff);
  s->def.dt = m->dt;
  s->def.gravity = m->gravity;
  s->def.drag = m->drag;
  s->def.fluid_velocity = m->fluid;
  s->def.rotations = m->rotations;
  s->def.arm = m->arm;
  s->def.disc_mass = m->disc_mass;
  if (m->walls_of >= 0)
    s->def.wall_material = (size_t)m->walls_of;
}

/* The largest distance between the twins, in radii. */
static double parted(const dem_scene *s, const dem_body *twin, size_t count)
{
  double most = 0;
  for (size_t i = 0; i < count; i++) {
    const dem_body b = dem_get(s, i);
    const packing_vec3 d = packing_domain_separation(s->domain, &b.x, &twin[i].x);
    const packing_vec3 v = plus(b.v, -1, twin[i].v), w = plus(b.w, -1, twin[i].w);
    most = fmax(most, sqrt(dot(d, d)) / b.r);
    /* Velocities of 1 m/s; they change within a collision, so they part further. */
    most = fmax(most, 1e-2 * sqrt(dot(v, v)));
    most = fmax(most, 1e-2 * sqrt(dot(w, w)) * b.r);
  }
  return most;
}

/* Steps both, `steps` in all, and holds them against each other on the way. */
static void compare(const model *m, double fraction, double speed, int steps)
{
  static dem_body twin[MOST];
  dem_scene s;
  scene_of(&s, m);
  dem_cloud(&s, 0.01, 3, fraction, MATERIALS, speed, 11);
  const size_t count = packing_particles_count(s.store);
  assert_true(count > 100 && count <= MOST);
  for (size_t i = 0; i < count; i++)
    twin[i] = dem_get(&s, i);
  dem_start(&s);
  size_t touches = 0, wall_touches = 0;
  packing_dem_report report;
  for (int part = 0; part < 10; part++) {
    for (int k = 0; k < steps / 10; k++)
      twin_step(m, twin, count);
    report = dem_run(&s, (uint64_t)(steps / 10));
    touches += report.contacts;
    wall_touches += report.wall_contacts;
    assert_near(parted(&s, twin, count), 0, 1e-11);
  }
  assert_true(touches > 100 && report.rebuilds > 1); /* or it shows little */
  assert_true((wall_touches > 0) == (m->periodic != (m->dim == 2 ? 3U : 7U)));
  dem_scene_free(&s);
}

static void periodic_3d(void **state)
{
  (void)state;
  const model m = common(3, 7);
  compare(&m, 0.35, 2, 400);
}

static void walls_3d(void **state)
{
  (void)state;
  model m = common(3, 0);
  m.gravity = dem_vec(3, -2, -20);
  compare(&m, 0.3, 2, 400);
}

static void mixed_borders_and_material_walls_3d(void **state)
{
  (void)state;
  model m = common(3, PACKING_PERIODIC_Y);
  m.walls_of = 1;
  m.pull = 1;
  m.arm = PACKING_ARM_RADIUS;
  compare(&m, 0.3, 2, 400);
}

static void everything_at_once_3d(void **state)
{
  (void)state;
  model m = common(3, PACKING_PERIODIC_X | PACKING_PERIODIC_Z);
  m.gravity = dem_vec(0, -20, 5);
  m.drag = 0.2;
  m.fluid = dem_vec(1, 2, -3);
  m.attraction = 0.02;
  m.repulsion = 0.0004;
  m.cutoff = 0.07;
  compare(&m, 0.3, 2, 400);
}

static void smooth_without_spin_3d(void **state)
{
  (void)state;
  model m = common(3, 7);
  m.rubs = 0;
  m.rotations = 0;
  compare(&m, 0.35, 2, 400);
}

static void locked_rotations_3d(void **state)
{
  (void)state;
  model m = common(3, 0);
  m.rotations = 0;
  compare(&m, 0.3, 2, 400);
}

static void periodic_2d(void **state)
{
  (void)state;
  const model m = common(2, 3);
  compare(&m, 0.5, 4, 600);
}

static void walls_2d(void **state)
{
  (void)state;
  model m = common(2, 0);
  m.gravity = dem_vec(0, -50, 0);
  m.disc_mass = 1;
  m.density[0] = 15;
  m.density[1] = 40;
  compare(&m, 0.5, 4, 600);
}

static void near_field_2d(void **state)
{
  (void)state;
  model m = common(2, PACKING_PERIODIC_X);
  m.attraction = 0.02;
  m.repulsion = 0.0004;
  m.cutoff = 0.07;
  compare(&m, 0.5, 4, 600);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic_3d),
      cmocka_unit_test(walls_3d),
      cmocka_unit_test(mixed_borders_and_material_walls_3d),
      cmocka_unit_test(everything_at_once_3d),
      cmocka_unit_test(smooth_without_spin_3d),
      cmocka_unit_test(locked_rotations_3d),
      cmocka_unit_test(periodic_2d),
      cmocka_unit_test(walls_2d),
      cmocka_unit_test(near_field_2d),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
