/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Semi-implicit Euler (Campello and Cassares, Algorithm 2, equations 1 to 4): velocities and
 * spins from the forces, positions from the new velocities. */
#include "stepper_internal.h"

static packing_vec3 fluid_at(const packing_dem *dem, const double *x)
{
  if (dem->def.fluid == NULL)
    return dem->def.fluid_velocity;
  const packing_vec3 at = packing_i_vec(x[0], x[1], x[2]);
  return dem->def.fluid(dem->def.fluid_user, &at, (double)dem->steps * dem->dt);
}

/* One particle; returns the square of its way since the list was made. */
static inline double advance(const packing_dem *dem, size_t p, const double g[3],
                             int spins)
{
  double *x = dem->position + PACKING_I_POSITION * p;
  double *v = dem->motion + PACKING_I_MOTION * p;
  double *f = dem->force + PACKING_I_FORCE * p;
  const double *from = dem->built + PACKING_I_POSITION * p;
  const double dt = dem->dt, drag = dem->def.drag * f[3];
  double flow[3] = {0, 0, 0}, way2 = 0;
  if (drag > 0) {
    const packing_vec3 u = fluid_at(dem, x);
    flow[0] = u.x;
    flow[1] = u.y;
    flow[2] = u.z;
  }
  for (int k = 0; k < 3; k++) {
    v[k] += dt * (f[k] * f[3] + g[k] - drag * (v[k] - flow[k]));
    x[k] += dt * v[k];
    f[k] = 0;
    way2 += (x[k] - from[k]) * (x[k] - from[k]);
  }
  for (int k = 4; k < 7; k++) {
    if (spins)
      v[k] += dt * (f[k] * f[7]);
    f[k] = 0;
  }
  return way2;
}

static void slab_advance(void *arg, size_t s)
{
  packing_dem *dem = arg;
  packing_i_slab *slab = &dem->slab[s];
  const double g[3] = {dem->def.gravity.x, dem->def.gravity.y, dem->def.gravity.z};
  const int spins = dem->def.rotations;
  double most = 0;
  for (size_t p = slab->first; p < slab->first + slab->count; p++) {
    const double way2 = advance(dem, p, g, spins);
    if (!(way2 <= most)) /* a NaN becomes infinity, which stays */
      most = way2 < HUGE_VAL ? way2 : HUGE_VAL;
  }
  slab->displaced2 = most;
}

void packing_i_dem_integrate(packing_dem *dem)
{
  packing_i_parallel(dem->context, (size_t)dem->cut.slabs, slab_advance, dem);
}
