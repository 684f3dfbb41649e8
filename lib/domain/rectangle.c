/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rectangle in the plane z = 0 with periodic directions and an open top: intervals along two
 * axes (planar.c). A disc is cut in closed form (cut_planes.c). */
#include "domain_kinds.h"

static const packing_i_domain_ops rectangle_ops = {
    .name = "rectangle",
    .reference = "axis-aligned lines; cut areas by the divergence theorem",
    .signed_distance = packing_i_planar_signed_distance,
    .holds = packing_i_planar_holds,
    .near_walls = packing_i_planar_near_walls,
    .inset = packing_i_planar_inset,
    .sphere_volume = packing_i_planar_sphere_volume,
};

void packing_domain_rectangle_def_fill(packing_domain_rectangle_def *def, size_t size)
{
  packing_domain_rectangle_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_domain_create_rectangle(packing_context *context,
                                               const packing_domain_rectangle_def *def,
                                               packing_domain **domain)
{
  packing_domain_rectangle_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_rectangle, open_top, def, &d));
  const packing_i_planar_def planar = {
      .size = packing_i_vec(d.size_x, d.size_y, 0),
      .corner = d.corner,
      .periodic = d.periodic,
      .open_top = d.open_top,
      .size_fields = {"size_x", "size_y", ""},
  };
  return packing_i_planar_create(context, &rectangle_ops, 2, &planar, domain);
}
