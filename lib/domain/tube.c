/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The space between two coaxial cylinders: a rectangle turned about an axis beside it
 * (revolution.c). */
#include "domain_kinds.h"

static const packing_i_domain_ops tube_ops = {
    .name = "tube",
    .reference = "convex profile; cut volumes by slices (differences of lenses)",
    .signed_distance = packing_i_revolution_signed_distance,
    .holds = packing_i_revolution_holds,
    .near_walls = packing_i_revolution_near_walls,
    .inset = packing_i_revolution_inset,
    .sphere_volume = packing_i_revolution_sphere_volume,
};

void packing_domain_tube_def_fill(packing_domain_tube_def *def, size_t size)
{
  packing_domain_tube_def defaults = {.axis = PACKING_AXIS_Z};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_domain_create_tube(packing_context *context,
                                          const packing_domain_tube_def *def,
                                          packing_domain **domain)
{
  packing_domain_tube_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_tube, open_top, def, &d));
  PACKING_I_TRY(packing_i_domain_check_ring(context, d.inner_radius, d.outer_radius));
  PACKING_I_TRY(packing_i_check_positive(context, "height", d.height));
  const packing_i_revolution_def profile = {
      .base = d.base,
      .axis = d.axis,
      .open_top = d.open_top,
      .height = d.height,
      .corners = 5,
      .rho = {d.inner_radius, d.outer_radius, d.outer_radius, d.inner_radius,
              d.inner_radius},
      .h = {0, 0, d.height, d.height, 0},
  };
  return packing_i_revolution_create(context, &tube_ops, &profile, domain);
}
