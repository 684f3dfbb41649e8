/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps: forces, motion, and a new list when particles have moved half a skin. */
#include "stepper_internal.h"

static double displaced2(const packing_dem *dem)
{
  double most = 0;
  for (int s = 0; s < dem->cut.slabs; s++)
    most = dem->slab[s].displaced2 > most ? dem->slab[s].displaced2 : most;
  return most;
}

/* Squared way of a particle since the list was made; not finite where a position or velocity is
 * not, or where a velocity is beyond all bounds. */
static double way2_of(const packing_dem *dem, size_t p)
{
  const double *x = dem->position + PACKING_I_POSITION * p;
  const double *from = dem->built + PACKING_I_POSITION * p;
  double way2 = 0;
  for (int k = 0; k < 3; k++)
    way2 += (x[k] - from[k]) * (x[k] - from[k]);
  return way2;
}

/* Says which particle has left the numbers: that of the longest way, of several the first. */
static packing_status blown_up(packing_dem *dem)
{
  size_t least = SIZE_MAX;
  double most = 0;
  for (size_t p = 0; p < dem->count; p++) {
    const double way2 = way2_of(dem, p), way = way2 < HUGE_VAL ? way2 : HUGE_VAL;
    if (way < most || (!(way > most) && dem->id[p] >= least))
      continue;
    most = way;
    least = dem->id[p];
  }
  dem->loaded = 0;
  return packing_i_fail(dem->context, PACKING_ERR_UNSTABLE, "particles", least,
                        "particle %zu is no longer finite after step %llu", least,
                        (unsigned long long)dem->steps);
}

static packing_status one_step(packing_dem *dem, int tally)
{
  packing_i_dem_forces(dem, tally);
  packing_i_dem_integrate(dem);
  dem->steps++;
  const double way2 = displaced2(dem), reach = 0.5 * dem->skin;
  if (way2 < reach * reach)
    return PACKING_OK;
  if (!(way2 < HUGE_VAL))
    return blown_up(dem);
  return packing_i_dem_rebuild(dem);
}

static double energy_and_weight(const packing_dem *dem, double *weight)
{
  const double j = packing_i_dem_inertia(dem);
  const double g = packing_i_norm(dem->def.gravity);
  double energy = 0;
  *weight = 0;
  for (size_t p = 0; p < dem->count; p++) {
    const double *v = dem->motion + PACKING_I_MOTION * p;
    const double r = dem->position[PACKING_I_POSITION * p + 3];
    const double motion2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const double spin2 = v[4] * v[4] + v[5] * v[5] + v[6] * v[6];
    energy += 0.5 * v[3] * (motion2 + j * r * r * spin2);
    *weight += v[3] * g * r;
  }
  return energy;
}

static void fill_report(const packing_dem *dem, packing_dem_report *report)
{
  double weight;
  packing_dem_report_init(report);
  report->steps = dem->steps;
  report->time = packing_i_dem_time(dem);
  report->dt = dem->dt;
  report->particles = dem->count;
  report->kinetic_energy = energy_and_weight(dem, &weight);
  report->kinetic_per_mgr = weight > 0 ? report->kinetic_energy / weight : (double)NAN;
  report->max_speed = sqrt(packing_i_dem_max_speed2(dem));
  report->rebuilds = dem->rebuilds;
  report->contacts = dem->contacts;
  report->wall_contacts = dem->wall_contacts;
  report->max_overlap = dem->max_overlap;
}

packing_status packing_dem_step(packing_dem *dem, uint64_t steps,
                                packing_dem_report *report)
{
  packing_dem_report filled;
  if (dem == NULL)
    return PACKING_ERR_INVALID;
  packing_dem_report_init(&filled);
  if (steps == 0)
    return packing_i_fail(dem->context, PACKING_ERR_RANGE, "steps", PACKING_NO_INDEX,
                          "0 must be at least 1");
  if (report != NULL && report->struct_size < sizeof report->struct_size)
    return packing_i_report_write(dem->context, report, &filled, sizeof filled);
  if (!dem->loaded || dem->particles->count != dem->count)
    return packing_i_fail(dem->context, PACKING_ERR_INVALID, "particles",
                          PACKING_NO_INDEX,
                          "the store has changed or a call failed: reload the stepper");
  dem->loaded = 0; /* until all steps are made */
  const uint64_t before = dem->steps;
  for (uint64_t s = 1; s <= steps; s++) {
    packing_i_threads_begin(dem);
    const packing_status status = one_step(dem, s == steps);
    packing_i_threads_end(dem);
    if (status != PACKING_OK) {
      dem->steps = before; /* as the store is */
      return status;
    }
  }
  dem->loaded = 1;
  packing_i_dem_save(dem);
  if (report == NULL)
    return PACKING_OK;
  fill_report(dem, &filled);
  return packing_i_report_write(dem->context, report, &filled, sizeof filled);
}
