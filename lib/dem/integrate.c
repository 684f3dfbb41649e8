/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Semi-implicit Euler (Campello and Cassares, Algorithm 2, equations 1 to 4): velocities and
 * spins from the forces, positions from the new velocities. */
#include "stepper_internal.h"

static void set_vector(double to[4], packing_vec3 v)
{
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
  to[3] = 0;
}

static packing_i_advance arguments(const packing_dem *dem)
{
  const packing_dem_def *def = &dem->def;
  const double dt = dem->dt, spin_dt = def->rotations ? dt : 0;
  packing_i_advance a = {
      .position = dem->position,
      .motion = dem->motion,
      .force = dem->force,
      .built = dem->built,
      .dt = {dt, dt, dt, 0},
      .spin_dt = {spin_dt, spin_dt, spin_dt, 0},
      .keep = {0, 0, 0, 1},
      .drag = def->drag,
  };
  set_vector(a.gravity, def->gravity);
  set_vector(a.flow, def->fluid_velocity);
  return a;
}

/* One by one, each in the flow where it is. */
static double advance_in_flow(const packing_dem *dem, const packing_i_slab *slab)
{
  packing_i_advance a = arguments(dem);
  const double time = packing_i_dem_time(dem);
  double most = 0;
  for (size_t p = slab->first; p < slab->first + slab->count; p++) {
    const double *x = dem->position + PACKING_I_POSITION * p;
    const packing_vec3 at = packing_i_vec(x[0], x[1], x[2]);
    set_vector(a.flow, dem->def.fluid(dem->def.fluid_user, &at, time));
    most = fmax(most, dem->kernels->advance(&a, p, p + 1));
  }
  return most;
}

static void slab_advance(void *arg, size_t s)
{
  packing_dem *dem = arg;
  packing_i_slab *slab = &dem->slab[s];
  if (dem->def.fluid != NULL) {
    slab->displaced2 = advance_in_flow(dem, slab);
    return;
  }
  const packing_i_advance a = arguments(dem);
  slab->displaced2 = dem->kernels->advance(&a, slab->first, slab->first + slab->count);
}

void packing_i_dem_integrate(packing_dem *dem)
{
  packing_i_dem_run(dem, (size_t)dem->cut.slabs, slab_advance, dem);
}
