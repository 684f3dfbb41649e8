/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Circular cylinder: a rectangle turned about its side (revolution.c). */
#include "domain_kinds.h"

static const packing_i_domain_ops cylinder_ops = {
    .name = "cylinder",
    .reference = "convex profile; cut volumes by slices (lenses of two discs)",
    .signed_distance = packing_i_revolution_signed_distance,
    .holds = packing_i_revolution_holds,
    .near_walls = packing_i_revolution_near_walls,
    .inset = packing_i_revolution_inset,
    .sphere_volume = packing_i_revolution_sphere_volume,
};

void packing_domain_cylinder_def_fill(packing_domain_cylinder_def *def, size_t size)
{
  packing_domain_cylinder_def defaults = {.axis = PACKING_AXIS_Z};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_domain_create_cylinder(packing_context *context,
                                              const packing_domain_cylinder_def *def,
                                              packing_domain **domain)
{
  packing_domain_cylinder_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_cylinder, open_top, def, &d));
  PACKING_I_TRY(packing_i_check_positive(context, "radius", d.radius));
  PACKING_I_TRY(packing_i_check_positive(context, "height", d.height));
  const packing_i_revolution_def profile = {
      .base = d.base,
      .axis = d.axis,
      .open_top = d.open_top,
      .height = d.height,
      .corners = 4,
      .rho = {0, d.radius, d.radius, 0},
      .h = {0, 0, d.height, d.height},
  };
  return packing_i_revolution_create(context, &cylinder_ops, &profile, domain);
}
