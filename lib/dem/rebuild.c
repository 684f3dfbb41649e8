/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A new list: how far it reaches, and what has to happen before and after. */
#include "stepper_internal.h"

double packing_i_dem_max_speed2(const packing_dem *dem)
{
  double most = 0;
  for (size_t p = 0; p < dem->count; p++) {
    const double *v = dem->motion + PACKING_I_MOTION * p;
    const double v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    most = v2 > most ? v2 : most;
  }
  return most;
}

/* The skin lasts some twenty steps at the largest speed there is; thin where all rests, so that
 * few pairs are listed in vain, and never so thick that the list is mostly that. */
static double choose_skin(const packing_dem *dem)
{
  const double least = 0.1 * dem->r_min, most = 0.4 * 0.5 * (dem->r_min + dem->r_max);
  const double wanted = 40 * dem->dt * sqrt(packing_i_dem_max_speed2(dem));
  return wanted < least ? least : wanted < most ? wanted : most;
}

static void wrap(packing_dem *dem)
{
  if (!dem->images.any)
    return;
  for (size_t p = 0; p < dem->count; p++) {
    double *x = dem->position + PACKING_I_POSITION * p;
    packing_vec3 at = packing_i_vec(x[0], x[1], x[2]);
    packing_domain_wrap(dem->domain, &at);
    x[0] = at.x;
    x[1] = at.y;
    x[2] = at.z;
  }
}

packing_status packing_i_dem_rebuild(packing_dem *dem)
{
  if (dem->count == 0) {
    dem->cut.slabs = 0;
    return PACKING_OK;
  }
  PACKING_I_TRY(packing_i_history_carry(dem));
  wrap(dem);
  dem->skin = choose_skin(dem);
  PACKING_I_TRY(packing_i_dem_sort(dem));
  PACKING_I_TRY(packing_i_dem_list(dem));
  PACKING_I_TRY(packing_i_history_restore(dem));
  dem->rebuilds++;
  return PACKING_OK;
}
