/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Box with periodic directions and an open top: intervals along three axes (planar.c). A ball
 * is cut in closed form (cut_planes.c). */
#include "domain_kinds.h"

static const packing_i_domain_ops box_ops = {
    .name = "box",
    .reference =
        "axis-aligned planes; cut volumes by the divergence theorem and Gauss-Bonnet",
    .signed_distance = packing_i_planar_signed_distance,
    .holds = packing_i_planar_holds,
    .near_walls = packing_i_planar_near_walls,
    .inset = packing_i_planar_inset,
    .sphere_volume = packing_i_planar_sphere_volume,
};

void packing_domain_box_def_fill(packing_domain_box_def *def, size_t size)
{
  packing_domain_box_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_domain_create_box(packing_context *context,
                                         const packing_domain_box_def *def,
                                         packing_domain **domain)
{
  packing_domain_box_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_box, open_top, def, &d));
  const packing_i_planar_def planar = {
      .size = d.size,
      .corner = d.corner,
      .periodic = d.periodic,
      .open_top = d.open_top,
      .size_fields = {"size.x", "size.y", "size.z"},
  };
  return packing_i_planar_create(context, &box_ops, 3, &planar, domain);
}
