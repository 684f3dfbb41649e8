/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the store into the stepper, with all checks of a start. */
#include "stepper_internal.h"

static double column(const packing_particles *p, packing_field field, size_t i)
{
  return ((const double *)p->column[field])[i];
}

static packing_status check_count(const packing_dem *dem)
{
  if (dem->particles->count >= UINT32_MAX / 16)
    return packing_i_fail(dem->context, PACKING_ERR_RANGE, "particles", PACKING_NO_INDEX,
                          "%zu are more than a stepper takes", dem->particles->count);
  return PACKING_OK;
}

static packing_status load_material(packing_dem *dem, size_t i)
{
  const packing_particles *p = dem->particles;
  const int32_t *type = p->column[PACKING_FIELD_TYPE];
  const int32_t t = type == NULL ? 1 : type[i];
  if (t < 1 || (size_t)t > dem->materials->count)
    return packing_i_fail(dem->context, PACKING_ERR_RANGE, "type", i,
                          "particle %zu is of type %ld; there are %zu materials", i,
                          (long)t, dem->materials->count);
  dem->material[i] = (uint32_t)(t - 1);
  return PACKING_OK;
}

static void load_particle(packing_dem *dem, size_t i)
{
  const packing_particles *p = dem->particles;
  double *x = dem->position + PACKING_I_POSITION * i;
  double *v = dem->motion + PACKING_I_MOTION * i;
  packing_vec3 at = packing_i_vec(p->x[i], p->y[i], p->z[i]);
  packing_domain_wrap(dem->domain, &at);
  x[0] = at.x;
  x[1] = at.y;
  x[2] = at.z;
  x[3] = p->r[i];
  for (int k = 0; k < 3; k++) {
    v[k] = column(p, (packing_field)(PACKING_FIELD_VX + k), i);
    v[4 + k] = column(p, (packing_field)(PACKING_FIELD_WX + k), i);
  }
  v[3] = packing_i_ball_volume(dem->dim == 2 && dem->def.disc_mass ? 2 : 3, p->r[i]) *
         dem->materials->density[dem->material[i]];
  v[7] = 0;
  dem->id[i] = (uint32_t)i;
}

/* Motion that the plane does not have. */
static packing_status check_flat(const packing_dem *dem, size_t i)
{
  const double *v = dem->motion + PACKING_I_MOTION * i;
  if (dem->dim == 2 &&
      (v[2] < 0 || v[2] > 0 || v[4] < 0 || v[4] > 0 || v[5] < 0 || v[5] > 0))
    return packing_i_fail(dem->context, PACKING_ERR_INVALID, "velocity", i,
                          "particle %zu moves or spins out of the plane", i);
  return PACKING_OK;
}

static packing_status check_mass(const packing_dem *dem, size_t i)
{
  const double *v = dem->motion + PACKING_I_MOTION * i;
  const double r = dem->position[PACKING_I_POSITION * i + 3];
  const double inertia = v[3] * r * r;
  if (isnormal(v[3]) && isnormal(inertia) && isfinite(1 / v[3] / v[3]) &&
      isfinite(1 / inertia / inertia))
    return PACKING_OK;
  return packing_i_fail(dem->context, PACKING_ERR_RANGE, "density", i,
                        "particle %zu of radius %g would have a mass of %g", i, r, v[3]);
}

static packing_status check_walls(const packing_dem *dem, size_t i)
{
  const double *x = dem->position + PACKING_I_POSITION * i;
  const packing_vec3 at = packing_i_vec(x[0], x[1], x[2]);
  const double distance = packing_domain_signed_distance(dem->domain, &at, NULL);
  if (!(distance > 0))
    return packing_i_fail(dem->context, PACKING_ERR_GEOMETRY, "particles", i,
                          "the centre of particle %zu is outside the container", i);
  const double overlap = (x[3] - distance) / x[3];
  if (overlap > dem->def.max_start_overlap)
    return packing_i_fail(
        dem->context, PACKING_ERR_RANGE, "max_start_overlap", i,
        "particle %zu overlaps a wall by %.3g of its radius; %g is allowed", i, overlap,
        dem->def.max_start_overlap);
  return PACKING_OK;
}

/* Wherever an image of a particle could meet another at the same time as the particle itself. */
static packing_status check_periods(const packing_dem *dem)
{
  const double range = fmax(2 * dem->r_max, dem->reach);
  for (int k = 0; k < 3; k++)
    if (dem->images.period[k] < 2 * range)
      return packing_i_fail(dem->context, PACKING_ERR_GEOMETRY, "domain",
                            PACKING_NO_INDEX,
                            "the periodic direction %c is %g wide, less than two "
                            "interaction distances of %g",
                            "xyz"[k], dem -> images.period[k], range);
  return PACKING_OK;
}

/* Refuses a pair that overlaps too much: the message names the one that does most. */
static packing_status check_overlaps(const packing_dem *dem)
{
  size_t worst_i = PACKING_NO_INDEX, worst_j = 0;
  double worst = dem->def.max_start_overlap;
  for (int s = 0; s < dem->cut.slabs; s++) {
    const packing_i_slab *slab = &dem->slab[s];
    for (size_t k = slab->list_first; k < slab->list_first + slab->list_count; k++) {
      const double *a = dem->position + (size_t)PACKING_I_POSITION * dem->list_i[k];
      const double *b = dem->position + (size_t)PACKING_I_POSITION * dem->list_j[k];
      const packing_vec3 d = packing_i_domain_separation(
          dem->domain, packing_i_vec(a[0], a[1], a[2]), packing_i_vec(b[0], b[1], b[2]));
      const double overlap = (a[3] + b[3] - packing_i_norm(d)) / fmin(a[3], b[3]);
      if (overlap > worst) {
        worst = overlap;
        worst_i = dem->id[dem->list_i[k]];
        worst_j = dem->id[dem->list_j[k]];
      }
    }
  }
  if (worst_i == PACKING_NO_INDEX)
    return PACKING_OK;
  return packing_i_fail(
      dem->context, PACKING_ERR_RANGE, "max_start_overlap", worst_i,
      "particles %zu and %zu overlap by %.3g of the smaller radius; %g is allowed",
      worst_i < worst_j ? worst_i : worst_j, worst_i < worst_j ? worst_j : worst_i, worst,
      dem->def.max_start_overlap);
}

static packing_status load_all(packing_dem *dem)
{
  dem->r_min = HUGE_VAL;
  dem->r_max = 0;
  dem->one_material = dem->materials->count == 1;
  for (size_t i = 0; i < dem->count; i++) {
    PACKING_I_TRY(load_material(dem, i));
    load_particle(dem, i);
    PACKING_I_TRY(check_mass(dem, i));
    PACKING_I_TRY(check_flat(dem, i));
    PACKING_I_TRY(check_walls(dem, i));
    dem->r_min = fmin(dem->r_min, dem->particles->r[i]);
    dem->r_max = fmax(dem->r_max, dem->particles->r[i]);
  }
  return check_periods(dem);
}

packing_status packing_i_dem_load(packing_dem *dem)
{
  dem->loaded = 0;
  dem->history.kept = 0;
  dem->threads = (packing_i_threads){0};
  PACKING_I_TRY(check_count(dem));
  PACKING_I_TRY(packing_i_dem_grow(dem, dem->particles->count));
  dem->count = dem->particles->count;
  PACKING_I_TRY(load_all(dem));
  PACKING_I_TRY(packing_i_dem_check_step(dem));
  PACKING_I_TRY(packing_i_dem_rebuild(dem));
  PACKING_I_TRY(check_overlaps(dem));
  dem->loaded = 1;
  return PACKING_OK;
}
