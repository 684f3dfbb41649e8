/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction that slides all the time: E. M. B. Campello and K. R. Cassares, Lat. Am. J. Solids
 * Struct. 13 (2016) 23, equations 12 to 15.
 *
 *   f = mu |N| u / sqrt(u u + v0^2), on i
 *
 * N is the whole normal force, what all laws before this one made of it; u the velocity of j's
 * point of contact relative to i's, with the spins, without its part along the normal.
 *
 * Departures. The printed direction u / |u| is 0 / 0 at rest: v0 makes it fade out, at the price
 * that what leans on friction creeps. The velocity printed in equation 14 has no spin; then spin
 * would never act on positions.
 *
 * Cost: a root and a division a contact, in vectors of 8 contacts with AVX-512, no branch. */
#include "law_kernel.h"
#include <math.h>

/* `pair` NULL, a constant where this is inlined: the first material for all. */
PACKING_I_LOOP void rub(size_t padded, double v0, const double *restrict ux,
                        const double *restrict uy, const double *restrict uz,
                        const uint32_t *restrict pair,
                        const packing_pair_material *restrict materials,
                        const double *restrict normal, double *restrict fx,
                        double *restrict fy, double *restrict fz)
{
  const double one = materials[0].friction;
  for (size_t k = 0; k < padded; k++) {
    const double mu = pair == NULL ? one : materials[pair[k]].friction;
    const double square = ux[k] * ux[k] + uy[k] * uy[k] + uz[k] * uz[k];
    const double f = mu * fabs(normal[k]) / sqrt(square + v0 * v0);
    fx[k] += f * ux[k];
    fy[k] += f * uy[k];
    fz[k] += f * uz[k];
  }
}

PACKING_I_LOOP void work(void *user, const packing_contact_batch *b)
{
  const packing_law *law = user;
  const double v0 = law->as.sliding.slip_velocity;
  const size_t padded = packing_i_padded(b->count);
  const double *ux = PACKING_I_ALIGNED(b->ux);
  const double *uy = PACKING_I_ALIGNED(b->uy);
  const double *uz = PACKING_I_ALIGNED(b->uz);
  const double *normal = PACKING_I_ALIGNED(b->normal);
  double *fx = PACKING_I_ALIGNED(b->fx);
  double *fy = PACKING_I_ALIGNED(b->fy);
  double *fz = PACKING_I_ALIGNED(b->fz);
  if (b->pair == NULL)
    rub(padded, v0, ux, uy, uz, NULL, b->materials, normal, fx, fy, fz);
  else
    rub(padded, v0, ux, uy, uz, b->pair, b->materials, normal, fx, fy, fz);
}

PACKING_I_LAW_KERNELS(sliding, work)

static packing_law_function kernel(const packing_law *law, packing_isa isa)
{
  (void)law;
  return sliding_for(isa);
}

static const packing_i_law_ops sliding_ops = {
    .name = "sliding",
    .reference = "Campello and Cassares, Lat. Am. J. Solids Struct. 13, 23 (2016), "
                 "equations 12 to 15",
    .kernel = kernel,
};

void packing_law_sliding_def_fill(packing_law_sliding_def *def, size_t size)
{
  packing_law_sliding_def defaults = {.slip_velocity = 0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_law_create_sliding(packing_context *context,
                                          const packing_law_sliding_def *def,
                                          packing_law **law)
{
  packing_law_sliding_def d;
  PACKING_I_TRY(packing_i_check_given(context, "def", def));
  PACKING_I_TRY(packing_i_check_given(context, "law", law));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_law_sliding, slip_velocity, def, &d));
  PACKING_I_TRY(packing_i_check_positive(context, "slip_velocity", d.slip_velocity));
  /* Its square keeps the kernel from 0 / 0. */
  if (!isnormal(d.slip_velocity * d.slip_velocity))
    return packing_i_fail(context, PACKING_ERR_RANGE, "slip_velocity", PACKING_NO_INDEX,
                          "the square of %g is beyond what a double can hold",
                          d.slip_velocity);
  packing_law *made;
  PACKING_I_TRY(packing_i_law_create(context, &sliding_ops, &made));
  made->as.sliding = d;
  *law = made;
  return PACKING_OK;
}
