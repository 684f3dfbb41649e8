/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts with walls: r* = r, m* = m, the wall stands still ("Walls" in doc/methods/dem.md;
 * equations 7 to 15 as for pairs). */
#include "stepper_internal.h"
#include <string.h>

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  return packing_i_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                       a.x * b.y - a.y * b.x);
}

/* Kinematics of particle p, entry `near_entry` of those near walls, against a wall; n points
 * into the wall. */
static void put(const packing_dem *dem, size_t near_entry, size_t p,
                const packing_i_near_wall *wall, packing_i_batch *b)
{
  const size_t k = b->count++;
  const packing_i_pair_table *table = dem->materials;
  const size_t entry =
      dem->material[p] * (table->count + 1) + packing_i_dem_wall_column(dem);
  const double *motion = dem->motion + PACKING_I_MOTION * p;
  const double r = dem->position[PACKING_I_POSITION * p + 3];
  const packing_vec3 n = packing_i_scale(wall->normal, -1);
  const packing_vec3 v = packing_i_vec(motion[0], motion[1], motion[2]);
  const packing_vec3 w = packing_i_vec(motion[4], motion[5], motion[6]);
  const double overlap = r - wall->distance;
  const double arm =
      dem->def.arm == PACKING_ARM_RADIUS ? r : r - table->share[entry] * overlap;
  const double approach = packing_i_dot(v, n);
  const packing_vec3 turning = cross(packing_i_scale(w, arm), n);
  b->i[k] = (uint32_t)p;
  b->slot[k] = (uint32_t)(near_entry * PACKING_I_NEAR_WALLS + (size_t)wall->wall);
  b->pair[k] = (uint32_t)entry;
  b->dx[k] = n.x;
  b->dy[k] = n.y;
  b->dz[k] = n.z;
  b->distance[k] = wall->distance;
  b->overlap[k] = overlap;
  b->arm_i[k] = arm;
  b->reduced_r[k] = r;
  b->reduced_m[k] = motion[3];
  b->approach[k] = approach;
  b->ux[k] = approach * n.x - v.x - turning.x;
  b->uy[k] = approach * n.y - v.y - turning.y;
  b->uz[k] = approach * n.z - v.z - turning.z;
}

/* Adds the forces to the particles. */
static void add(packing_dem *dem, const packing_i_batch *b)
{
  for (size_t k = 0; k < b->count; k++) {
    double *to = dem->force + (size_t)PACKING_I_FORCE * b->i[k];
    const packing_vec3 n = packing_i_vec(b->dx[k], b->dy[k], b->dz[k]);
    const packing_vec3 f = packing_i_vec(b->fx[k], b->fy[k], b->fz[k]);
    const packing_vec3 moment = cross(n, f);
    to[0] += f.x - b->normal[k] * n.x;
    to[1] += f.y - b->normal[k] * n.y;
    to[2] += f.z - b->normal[k] * n.z;
    to[4] += b->arm_i[k] * moment.x;
    to[5] += b->arm_i[k] * moment.y;
    to[6] += b->arm_i[k] * moment.z;
  }
}

/* The kinematics are there; forces begin at 0. */
static void fill_up(packing_i_batch *b)
{
  double *const columns[] = {b->dx,      b->dy,        b->dz,        b->distance,
                             b->overlap, b->reduced_r, b->reduced_m, b->approach,
                             b->ux,      b->uy,        b->uz};
  double *const forces[] = {b->normal, b->fx, b->fy, b->fz};
  packing_i_batch_repeat(columns, sizeof columns / sizeof *columns, b->count);
  for (size_t k = b->count; k % 8 != 0; k++)
    b->pair[k] = b->pair[b->count - 1];
  for (size_t c = 0; c < sizeof forces / sizeof *forces; c++)
    memset(forces[c], 0, PACKING_I_ROOM * sizeof *forces[c]);
}

static void flush(packing_dem *dem, packing_i_slab *slab, packing_i_batch *b, int tally)
{
  if (b->count == 0)
    return;
  fill_up(b);
  double *history = packing_i_history_fetch(dem, (size_t)(slab - dem->slab), b, 1);
  /* Of one material all entries are the same. */
  const packing_pair_material *table =
      dem->materials->pair + (dem->one_material ? b->pair[0] : 0);
  packing_i_dem_apply(dem, NULL, table, history, b);
  packing_i_history_store(dem, history, b, 1);
  add(dem, b);
  if (tally)
    slab->wall_contacts += b->count;
  b->count = 0;
}

void packing_i_dem_wall_forces(packing_dem *dem, packing_i_slab *slab,
                               packing_i_batch *batch, int tally)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  for (size_t k = slab->first; k < slab->first + slab->wall_count; k++) {
    const size_t p = dem->near_wall[k];
    const double *at = dem->position + PACKING_I_POSITION * p;
    const packing_vec3 x = packing_i_vec(at[0], at[1], at[2]);
    const int walls = packing_i_domain_near_walls(dem->domain, &x, at[3], near);
    for (int w = 0; w < walls; w++)
      put(dem, k, p, &near[w], batch);
    if (batch->count > PACKING_I_BATCH - PACKING_I_NEAR_WALLS)
      flush(dem, slab, batch, tally);
  }
  flush(dem, slab, batch, tally);
}
