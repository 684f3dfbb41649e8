/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a sphere; a ball is cut to a lens (round.c, lens.c). */
#include "domain_kinds.h"

static const packing_i_domain_ops sphere_ops = {
    .name = "sphere",
    .reference = "one radius; cut by lenses",
    .signed_distance = packing_i_round_signed_distance,
    .near_walls = packing_i_round_near_walls,
    .inset = packing_i_round_inset,
    .sphere_volume = packing_i_round_sphere_volume,
};

void packing_domain_sphere_def_fill(packing_domain_sphere_def *def, size_t size)
{
  packing_domain_sphere_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_domain_create_sphere(packing_context *context,
                                            const packing_domain_sphere_def *def,
                                            packing_domain **domain)
{
  packing_domain_sphere_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_sphere, centre, def, &d));
  PACKING_I_TRY(packing_i_check_positive(context, "radius", d.radius));
  const packing_i_round round_def = {.centre = d.centre, .outer = d.radius};
  return packing_i_round_create(context, &sphere_ops, 3, &round_def, domain);
}
