/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Silo: a cylinder on a conical hopper with a flat outlet, a pentagon turned about its side
 * (revolution.c). */
#include "domain_kinds.h"

static const packing_i_domain_ops silo_ops = {
    .name = "silo",
    .reference = "convex profile; cut volumes by slices (lenses of two discs)",
    .signed_distance = packing_i_revolution_signed_distance,
    .holds = packing_i_revolution_holds,
    .near_walls = packing_i_revolution_near_walls,
    .inset = packing_i_revolution_inset,
    .sphere_volume = packing_i_revolution_sphere_volume,
};

void packing_domain_silo_def_fill(packing_domain_silo_def *def, size_t size)
{
  packing_domain_silo_def defaults = {.axis = PACKING_AXIS_Z};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check(packing_context *context, const packing_domain_silo_def *d)
{
  PACKING_I_TRY(packing_i_check_positive(context, "radius", d->radius));
  PACKING_I_TRY(packing_i_check_positive(context, "height", d->height));
  PACKING_I_TRY(packing_i_check_not_negative(context, "outlet_radius", d->outlet_radius));
  PACKING_I_TRY(packing_i_check_positive(context, "hopper_height", d->hopper_height));
  if (d->outlet_radius >= d->radius)
    return packing_i_fail(context, PACKING_ERR_RANGE, "outlet_radius", PACKING_NO_INDEX,
                          "%g must be below radius, %g", d->outlet_radius, d->radius);
  if (d->hopper_height >= d->height)
    return packing_i_fail(context, PACKING_ERR_RANGE, "hopper_height", PACKING_NO_INDEX,
                          "%g must be below height, %g", d->hopper_height, d->height);
  return PACKING_OK;
}

packing_status packing_domain_create_silo(packing_context *context,
                                          const packing_domain_silo_def *def,
                                          packing_domain **domain)
{
  packing_domain_silo_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_silo, open_top, def, &d));
  PACKING_I_TRY(check(context, &d));
  const packing_i_revolution_def profile = {
      .base = d.base,
      .axis = d.axis,
      .open_top = d.open_top,
      .height = d.height,
      .corners = 5,
      .rho = {0, d.outlet_radius, d.radius, d.radius, 0},
      .h = {0, 0, d.hopper_height, d.height, d.height},
  };
  return packing_i_revolution_create(context, &silo_ops, &profile, domain);
}
