/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper: life, steps, report. doc/methods/dem.md tells the method. */
#include "stepper_internal.h"

enum { FIRST_SHARE = 8 }; /* pairs a particle that the list has room for at first */

void packing_dem_def_fill(packing_dem_def *def, size_t size)
{
  packing_dem_def defaults = {0};
  defaults.rotations = 1;
  defaults.arm = PACKING_ARM_CONTACT;
  defaults.wall_material = PACKING_MATERIAL_RIGID;
  defaults.max_start_overlap = 0.01;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* A vector; in the plane its z must be 0. */
static packing_status check_vector(packing_context *context, const char *const names[3],
                                   const packing_vec3 *v, int dim)
{
  PACKING_I_TRY(packing_i_check_point(context, names, v));
  if (dim == 2 && (v->z < 0 || v->z > 0))
    return packing_i_fail(context, PACKING_ERR_RANGE, names[2], PACKING_NO_INDEX,
                          "%g must be 0 in two dimensions", v->z);
  return PACKING_OK;
}

static packing_status check_def(packing_context *context, const packing_dem_def *d,
                                int dim, size_t materials)
{
  static const char *const gravity[] = {"gravity.x", "gravity.y", "gravity.z"};
  static const char *const fluid[] = {"fluid_velocity.x", "fluid_velocity.y",
                                      "fluid_velocity.z"};
  PACKING_I_TRY(packing_i_check_not_negative(context, "dt", d->dt));
  PACKING_I_TRY(check_vector(context, gravity, &d->gravity, dim));
  PACKING_I_TRY(packing_i_check_not_negative(context, "drag", d->drag));
  PACKING_I_TRY(check_vector(context, fluid, &d->fluid_velocity, dim));
  PACKING_I_TRY(packing_i_check_switch(context, "rotations", d->rotations));
  if (d->arm != PACKING_ARM_CONTACT && d->arm != PACKING_ARM_RADIUS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "arm", PACKING_NO_INDEX,
                          "%d is no arm", (int)d->arm);
  PACKING_I_TRY(packing_i_check_switch(context, "disc_mass", d->disc_mass));
  if (d->disc_mass && dim != 2)
    return packing_i_fail(context, PACKING_ERR_INVALID, "disc_mass", PACKING_NO_INDEX,
                          "spheres are no discs");
  if (d->wall_material != PACKING_MATERIAL_RIGID && d->wall_material >= materials)
    return packing_i_fail(context, PACKING_ERR_RANGE, "wall_material", PACKING_NO_INDEX,
                          "there are %zu materials, none numbered %zu", materials,
                          d->wall_material);
  PACKING_I_TRY(
      packing_i_check_not_negative(context, "impact_velocity", d->impact_velocity));
  return packing_i_check_not_negative(context, "max_start_overlap", d->max_start_overlap);
}

static packing_status check_laws(packing_context *context, packing_law *const *laws,
                                 size_t count)
{
  if (count > PACKING_I_LAWS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "law_count", PACKING_NO_INDEX,
                          "%zu laws are more than %d", count, PACKING_I_LAWS);
  for (size_t l = 0; l < count; l++)
    if (laws == NULL || laws[l] == NULL)
      return packing_i_fail(context, PACKING_ERR_INVALID, "laws", l, "law %zu is NULL",
                            l);
  return PACKING_OK;
}

static void take_laws(packing_dem *dem, packing_law *const *laws, size_t count)
{
  for (size_t l = 0; l < count; l++) {
    dem->laws[l] = packing_i_law_retain(laws[l]);
    dem->work[l] = laws[l]->ops->kernel(laws[l], packing_context_isa(dem->context));
    dem->reach = fmax(dem->reach, laws[l]->reach);
  }
  dem->law_count = count;
}

static void set_images(packing_dem *dem)
{
  const packing_vec3 period = dem->domain->body.period;
  for (int k = 0; k < 3; k++) {
    dem->images.period[k] = packing_i_component(period, k);
    dem->images.half[k] = 0.5 * dem->images.period[k];
    dem->images.any |= isfinite(dem->images.period[k]);
  }
}

static packing_status build(packing_dem *dem, const packing_materials *materials,
                            packing_law *const *laws, size_t law_count)
{
  take_laws(dem, laws, law_count);
  PACKING_I_TRY(packing_i_history_create(dem));
  set_images(dem);
  dem->dim = packing_domain_dim(dem->domain);
  dem->list_share = FIRST_SHARE;
  dem->kernels = packing_i_kernels_for(packing_context_isa(dem->context));
  dem->materials = packing_i_alloc(dem->allocator, 1, sizeof *dem->materials);
  if (dem->materials == NULL)
    return packing_i_nomem(dem->context);
  PACKING_I_TRY(packing_i_materials_table(dem->context, materials, dem->materials));
  PACKING_I_TRY(check_def(dem->context, &dem->def, dem->dim, dem->materials->count));
  PACKING_I_TRY(packing_particles_add_columns(dem->particles, PACKING_COLUMN_VELOCITY |
                                                                  PACKING_COLUMN_SPIN));
  return packing_i_dem_load(dem);
}

packing_status packing_dem_create(packing_context *context, const packing_dem_def *def,
                                  packing_domain *domain,
                                  const packing_materials *materials,
                                  packing_law *const *laws, size_t law_count,
                                  packing_particles *particles, packing_dem **dem)
{
  packing_dem_def d;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_dem, max_start_overlap, def, &d));
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  PACKING_I_TRY(packing_i_check_given(context, "materials", materials));
  PACKING_I_TRY(packing_i_check_given(context, "particles", particles));
  PACKING_I_TRY(packing_i_check_given(context, "dem", dem));
  PACKING_I_TRY(check_laws(context, laws, law_count));
  if (packing_domain_dim(domain) != packing_particles_dim(particles))
    return packing_i_fail(context, PACKING_ERR_RANGE, "particles", PACKING_NO_INDEX,
                          "the store has %d dimensions, the domain %d",
                          packing_particles_dim(particles), packing_domain_dim(domain));
  packing_dem *made = packing_i_calloc(packing_i_allocator(context), 1, sizeof *made);
  if (made == NULL)
    return packing_i_nomem(context);
  made->context = packing_i_context_hold(context);
  made->allocator = packing_i_allocator(context);
  made->domain = packing_domain_retain(domain);
  made->particles = particles;
  made->def = d;
  const packing_status status = build(made, materials, laws, law_count);
  if (status != PACKING_OK) {
    packing_dem_destroy(made);
    return status;
  }
  *dem = made;
  return PACKING_OK;
}

void packing_dem_destroy(packing_dem *dem)
{
  if (dem == NULL)
    return;
  packing_i_dem_release_arrays(dem);
  packing_i_history_release(dem);
  for (size_t l = 0; l < dem->law_count; l++)
    packing_law_destroy(dem->laws[l]);
  packing_i_free(dem->allocator, dem->materials);
  packing_domain_destroy(dem->domain);
  packing_context *context = dem->context;
  packing_i_free(dem->allocator, dem);
  packing_context_destroy(context);
}

packing_status packing_dem_reload(packing_dem *dem)
{
  return dem == NULL ? PACKING_ERR_INVALID : packing_i_dem_load(dem);
}

size_t packing_dem_bytes(const packing_dem *dem)
{
  return sizeof *dem + sizeof *dem->materials + packing_i_dem_room_bytes(dem) +
         packing_i_history_bytes(dem);
}
