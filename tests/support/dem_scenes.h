/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_DEM_SCENES_H
#define PACKING_TEST_DEM_SCENES_H

/* Scenes for the stepper, put together piece by piece. All calls assert success. */
#include "test.h"

#define DEM_PI 3.14159265358979323846

/* A particle as tests see it. */
typedef struct dem_body {
  packing_vec3 x, v, w;
  double r;
  int32_t type; /* 0 stands for 1 */
} dem_body;

/* What a stepper is made from; everything in it is the scene's, the context too. */
typedef struct dem_scene {
  packing_context *context; /* NULL until set */
  packing_domain *domain;
  packing_materials *materials;
  packing_law *laws[16];
  size_t law_count;
  packing_particles *store; /* with types, velocities and spins */
  packing_dem_def def;
  packing_dem *dem; /* NULL until dem_start() */
} dem_scene;

/* An empty scene in a domain, of which it takes the caller's hold. */
void dem_scene_init(dem_scene *s, packing_domain *domain);
void dem_scene_free(dem_scene *s);

size_t dem_material(dem_scene *s, double density, double young, double poisson,
                    double damping, double friction);
void dem_hertz(dem_scene *s, int pull);
void dem_sliding(dem_scene *s, double slip_velocity);
void dem_near_field(dem_scene *s, double attraction, double attraction_exponent,
                    double repulsion, double repulsion_exponent, double cutoff);
/* A law of the caller's, which the scene takes over. */
void dem_law(dem_scene *s, packing_law *law);

/* Adds a particle; returns its index. */
size_t dem_add(dem_scene *s, const dem_body *body);
dem_body dem_get(const dem_scene *s, size_t i);
/* Overwrites position, velocity and spin of a particle. */
void dem_put(dem_scene *s, size_t i, const dem_body *body);

/* Makes the stepper, in place of the one there was. */
packing_status dem_try(dem_scene *s);
void dem_start(dem_scene *s);
packing_dem_report dem_run(dem_scene *s, uint64_t steps);
/* The nearest whole number of steps. */
packing_dem_report dem_run_for(dem_scene *s, double time);

/* Hash of positions, radii, velocities and spins. */
uint64_t dem_hash(const packing_particles *store);

/* Fills the domain of a scene at random with spheres (discs) of radii in [r, ratio r] up to a
 * volume fraction, none overlapping, of types 1 .. types in turn, with velocities up to `speed`
 * along each axis of the domain's dimension and spins up to speed / r. */
void dem_cloud(dem_scene *s, double r, double ratio, double fraction, int types,
               double speed, uint64_t seed);

/* Adds the particles of another scene; lengths and velocities are multiplied, spins too
 * by what follows. */
void dem_copy(dem_scene *to, const dem_scene *from, double lengths, double velocities);

/* Mass of a sphere. */
double dem_mass(double density, double r);
/* E* of a material against a rigid wall, and of two materials. */
double dem_rigid_young(double young, double poisson);
double dem_pair_young(double young_a, double poisson_a, double young_b, double poisson_b);
/* Overlap at which Hertz's force is `load`. */
double dem_static_overlap(double load, double reduced_r, double reduced_young);
/* Hertz's collision time, largest overlap and largest force without damping. */
double dem_collision_time(double reduced_m, double reduced_r, double reduced_young,
                          double v);
double dem_collision_overlap(double reduced_m, double reduced_r, double reduced_young,
                             double v);

static inline packing_vec3 dem_vec(double x, double y, double z)
{
  const packing_vec3 v = {x, y, z};
  return v;
}

/* Repeatable numbers in [0, 1). */
static inline double dem_random(uint64_t *state)
{
  uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

#endif
