/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force between particles near each other: E. M. B. Campello and K. R. Cassares, Lat. Am. J.
 * Solids Struct. 13 (2016) 23, equation 5, which pulls i towards j by
 * alpha_1 d^-beta_1 - alpha_2 d^-beta_2, d the distance of the centres. `normal` counts
 * repulsion, so the sign is the other one here.
 *
 * Departure: a cut-off, from which on there is no force; the paper sums over all pairs.
 *
 * Cost: up to two powers a pair, those of the C library. They need not round alike on different
 * machines; this law alone is exempt from giving the same bytes on all of them. */
#include "dem_internal.h"
#include <math.h>

/* 0 without calling pow(): an absent term must not make NaN of 0 times infinity. */
static double term(double strength, double distance, double exponent)
{
  return strength == 0 ? 0 : strength * pow(distance, -exponent);
}

static void act(void *user, const packing_contact_batch *batch)
{
  const packing_law *law = user;
  const packing_law_near_field_def *d = &law->as.near_field;
  for (size_t k = 0; k < batch->count; k++)
    if (batch->distance[k] < d->cutoff)
      batch->normal[k] += term(d->repulsion, batch->distance[k], d->repulsion_exponent) -
                          term(d->attraction, batch->distance[k], d->attraction_exponent);
}

static packing_law_function kernel(const packing_law *law, packing_isa isa)
{
  (void)law;
  (void)isa;
  return act;
}

static const packing_i_law_ops near_field_ops = {
    .name = "near-field",
    .reference = "Campello and Cassares, Lat. Am. J. Solids Struct. 13, 23 (2016), "
                 "equation 5",
    .kernel = kernel,
};

void packing_law_near_field_def_fill(packing_law_near_field_def *def, size_t size)
{
  packing_law_near_field_def defaults = {.cutoff = 0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check(packing_context *context, const packing_law_near_field_def *d)
{
  PACKING_I_TRY(packing_i_check_finite(context, "attraction", d->attraction));
  PACKING_I_TRY(
      packing_i_check_finite(context, "attraction_exponent", d->attraction_exponent));
  PACKING_I_TRY(packing_i_check_finite(context, "repulsion", d->repulsion));
  PACKING_I_TRY(
      packing_i_check_finite(context, "repulsion_exponent", d->repulsion_exponent));
  return packing_i_check_positive(context, "cutoff", d->cutoff);
}

packing_status packing_law_create_near_field(packing_context *context,
                                             const packing_law_near_field_def *def,
                                             packing_law **law)
{
  packing_law_near_field_def d;
  PACKING_I_TRY(packing_i_check_given(context, "def", def));
  PACKING_I_TRY(packing_i_check_given(context, "law", law));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_law_near_field, cutoff, def, &d));
  PACKING_I_TRY(check(context, &d));
  packing_law *made;
  PACKING_I_TRY(packing_i_law_create(context, &near_field_ops, &made));
  made->as.near_field = d;
  made->reach = d.cutoff;
  *law = made;
  return PACKING_OK;
}
