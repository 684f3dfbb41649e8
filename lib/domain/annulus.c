/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring between two circles in the plane z = 0; a disc is cut to the difference of two
 * lenses (round.c, lens.c). */
#include "domain_kinds.h"

static const packing_i_domain_ops annulus_ops = {
    .name = "annulus",
    .reference = "two radii; cut by lenses",
    .signed_distance = packing_i_round_signed_distance,
    .near_walls = packing_i_round_near_walls,
    .inset = packing_i_round_inset,
    .sphere_volume = packing_i_round_sphere_volume,
};

void packing_domain_annulus_def_fill(packing_domain_annulus_def *def, size_t size)
{
  packing_domain_annulus_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_domain_create_annulus(packing_context *context,
                                             const packing_domain_annulus_def *def,
                                             packing_domain **domain)
{
  packing_domain_annulus_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_annulus, centre, def, &d));
  PACKING_I_TRY(packing_i_domain_check_ring(context, d.inner_radius, d.outer_radius));
  const packing_i_round round_def = {
      .centre = d.centre, .outer = d.outer_radius, .inner = d.inner_radius};
  return packing_i_round_create(context, &annulus_ops, 2, &round_def, domain);
}
