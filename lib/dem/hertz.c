/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The normal force of Hertz with damping: E. M. B. Campello and K. R. Cassares, Lat. Am. J.
 * Solids Struct. 13 (2016) 23, equations 7 to 11.
 *
 *   a = sqrt(r* delta), radius of the contact      k_t = 2 E* a, its tangent stiffness
 *   F = 4/3 E* delta a + 2 xi sqrt(m* k_t) ddelta/dt
 *
 * Departures. As printed, equation 9 makes delta the gap, whose root does not exist in contact:
 * delta is the overlap here, and the sign of the force turned. The printed damping constant,
 * 2 xi sqrt(2 E* m* sqrt(r*)) delta^(1/4), is the one above with the roots taken in another
 * order. The force pulls where the particles part fast: the paper keeps that, by default it is
 * cut off at 0. The cut is of this law's own force; what other laws added stays.
 *
 * Cost: two roots a contact, in vectors of 8 contacts with AVX-512, no branch. */
#include "law_kernel.h"
#include <math.h>

/* `pair` NULL, a constant where this is inlined: the first material for all. */
PACKING_I_LOOP void push(size_t padded, double least, const double *restrict overlap,
                         const double *restrict reduced_r,
                         const double *restrict reduced_m,
                         const double *restrict approach, const uint32_t *restrict pair,
                         const packing_pair_material *restrict materials,
                         double *restrict normal)
{
  const packing_pair_material one = materials[0];
  for (size_t k = 0; k < padded; k++) {
    const double young = pair == NULL ? one.young : materials[pair[k]].young;
    const double xi = pair == NULL ? one.damping : materials[pair[k]].damping;
    const double a = sqrt(reduced_r[k] * overlap[k]);
    const double stiffness = 2 * young * a;
    const double damping = 2 * xi * sqrt(reduced_m[k] * stiffness);
    const double force = 2.0 / 3.0 * stiffness * overlap[k] + damping * approach[k];
    normal[k] += force < least ? least : force;
  }
}

PACKING_I_LOOP void work(void *user, const packing_contact_batch *b)
{
  const packing_law *law = user;
  const double least = law->as.hertz.pull ? -HUGE_VAL : 0;
  const size_t padded = packing_i_padded(b->count);
  const double *overlap = PACKING_I_ALIGNED(b->overlap);
  const double *reduced_r = PACKING_I_ALIGNED(b->reduced_r);
  const double *reduced_m = PACKING_I_ALIGNED(b->reduced_m);
  const double *approach = PACKING_I_ALIGNED(b->approach);
  double *normal = PACKING_I_ALIGNED(b->normal);
  if (b->pair == NULL)
    push(padded, least, overlap, reduced_r, reduced_m, approach, NULL, b->materials,
         normal);
  else
    push(padded, least, overlap, reduced_r, reduced_m, approach, b->pair, b->materials,
         normal);
}

PACKING_I_LAW_KERNELS(hertz, work)

static packing_law_function kernel(const packing_law *law, packing_isa isa)
{
  (void)law;
  return hertz_for(isa);
}

static const packing_i_law_ops hertz_ops = {
    .name = "hertz",
    .reference = "Campello and Cassares, Lat. Am. J. Solids Struct. 13, 23 (2016), "
                 "equations 7 to 11",
    .kernel = kernel,
};

void packing_law_hertz_def_fill(packing_law_hertz_def *def, size_t size)
{
  packing_law_hertz_def defaults = {.pull = 0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_law_create_hertz(packing_context *context,
                                        const packing_law_hertz_def *def,
                                        packing_law **law)
{
  packing_law_hertz_def d;
  PACKING_I_TRY(packing_i_check_given(context, "law", law));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_law_hertz, pull, def, &d));
  PACKING_I_TRY(packing_i_check_switch(context, "pull", d.pull));
  packing_law *made;
  PACKING_I_TRY(packing_i_law_create(context, &hertz_ops, &made));
  made->as.hertz = d;
  *law = made;
  return PACKING_OK;
}
