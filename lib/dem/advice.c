/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How long a step may be (Campello and Cassares, equation 23, and the linear limit of the
 * integrator). */
#include "stepper_internal.h"

/* Two spheres, or a sphere and a wall. */
typedef struct contact {
  double r, m; /* reduced */
  const packing_pair_material *of;
} contact;

/* x^(1/5) by Newton's method from above: + - * / only, the same bits everywhere. */
static double fifth_root(double x)
{
  if (!(x > 0) || !isfinite(x))
    return x;
  int exponent;
  frexp(x, &exponent);
  double root = ldexp(1, exponent / 5 + 1);
  for (double next;; root = next) {
    const double r2 = root * root;
    next = root - (root - x / (r2 * r2)) / 5;
    if (!(next < root))
      return root;
  }
}

/* Hertz's elastic collision: t_c = 2.868 (m*^2 / (r* E*^2 v))^(1/5); the exact factor is
 * 2.9432 (15/16)^(2/5). */
static double collision_time(const contact *c, double v)
{
  const double factor = 2.8682653;
  return v > 0
             ? factor * fifth_root(c->m * c->m / (c->r * c->of->young * c->of->young * v))
             : HUGE_VAL;
}

/* The damped oscillator x'' = -omega^2 x - 2 xi omega x' is stable under semi-implicit Euler for
 * omega dt < 2 (sqrt(1 + xi^2) - xi). Stiffness at an overlap of 1 % of the radius. */
static double limit_of(const contact *c, double r)
{
  const double overlap = 0.01 * r, xi = c->of->damping;
  const double stiffness = 2 * c->of->young * sqrt(c->r * overlap);
  return 2 * (sqrt(1 + xi * xi) - xi) / sqrt(stiffness / c->m);
}

/* The lightest and smallest of a material, squeezed between its like or at a wall. */
static void consider(packing_dem *dem, size_t material, double r, double m)
{
  const packing_i_pair_table *table = dem->materials;
  const packing_pair_material *row = table->pair + material * (table->count + 1);
  const contact pair = {0.5 * r, 0.5 * m, &row[material]};
  const contact at_wall = {r, m, &row[packing_i_dem_wall_column(dem)]};
  packing_dem_advice *a = &dem->advice;
  a->collision_time = fmin(a->collision_time, collision_time(&pair, a->impact_velocity));
  a->limit = fmin(a->limit, fmin(limit_of(&pair, r), limit_of(&at_wall, r)));
  if (dem->def.drag > 0)
    a->limit = fmin(a->limit, 2 * m / dem->def.drag);
}

static double fall_velocity(const packing_dem *dem)
{
  packing_bounds b;
  packing_domain_bounds(dem->domain, &b);
  const packing_vec3 g = dem->def.gravity, size = packing_i_sub(b.hi, b.lo);
  return sqrt(2 * (fabs(g.x) * size.x + fabs(g.y) * size.y + fabs(g.z) * size.z));
}

static double impact_velocity(const packing_dem *dem)
{
  if (dem->def.impact_velocity > 0)
    return dem->def.impact_velocity;
  return fmax(fall_velocity(dem), 2 * sqrt(packing_i_dem_max_speed2(dem)));
}

static void advise(packing_dem *dem)
{
  packing_dem_advice *a = &dem->advice;
  a->impact_velocity = impact_velocity(dem);
  a->collision_time = HUGE_VAL;
  a->limit = HUGE_VAL;
  size_t smallest[PACKING_I_MATERIALS];
  for (size_t k = 0; k < dem->materials->count; k++)
    smallest[k] = SIZE_MAX;
  for (size_t p = 0; p < dem->count; p++) {
    size_t *s = &smallest[dem->material[p]];
    if (*s == SIZE_MAX || dem->position[PACKING_I_POSITION * p + 3] <
                              dem->position[PACKING_I_POSITION * *s + 3])
      *s = p;
  }
  for (size_t k = 0; k < dem->materials->count; k++)
    if (smallest[k] != SIZE_MAX)
      consider(dem, k, dem->position[PACKING_I_POSITION * smallest[k] + 3],
               dem->motion[PACKING_I_MOTION * smallest[k] + 3]);
  a->advised = fmin(a->collision_time / 5, 0.5 * a->limit);
}

packing_status packing_i_dem_check_step(packing_dem *dem)
{
  advise(dem);
  const double time = packing_i_dem_time(dem), before = dem->dt;
  const packing_dem_advice *a = &dem->advice;
  if (dem->def.dt > 0) {
    dem->dt = dem->def.dt;
  } else {
    if (!isfinite(a->advised))
      return packing_i_fail(dem->context, PACKING_ERR_INVALID, "dt", PACKING_NO_INDEX,
                            "none is given, and without particles none can be advised");
    dem->dt = a->advised;
  }
  if (dem->dt < before || dem->dt > before) {
    dem->time_before = time;
    dem->steps_before = dem->steps;
  }
  if (!(dem->dt < a->limit))
    return packing_i_fail(dem->context, PACKING_ERR_UNSTABLE, "dt", PACKING_NO_INDEX,
                          "%g is unstable from %.4g on; advised is %.4g", dem->dt,
                          a->limit, a->advised);
  if (dem->dt > a->advised)
    packing_i_warn(dem->context, "dt",
                   "%g is more than a fifth of the collision time at a speed of %.3g; "
                   "advised is %.4g",
                   dem->dt, a->impact_velocity, a->advised);
  return PACKING_OK;
}

packing_status packing_dem_advise(const packing_dem *dem, packing_dem_advice *advice)
{
  if (dem == NULL || advice == NULL)
    return PACKING_ERR_INVALID;
  return packing_i_report_write(NULL, advice, &dem->advice, sizeof dem->advice);
}
