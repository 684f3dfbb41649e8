/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Given radii with given shares. A share by mass is one by number over r^dim, and back. */
#include "atoms_internal.h"

static const packing_i_psd_ops ops = {"discrete",
                                      "given radii",
                                      packing_i_atoms_cdf,
                                      packing_i_atoms_quantile,
                                      packing_i_psd_point,
                                      1,
                                      packing_i_atoms_finish};

void packing_psd_discrete_def_fill(packing_psd_discrete_def *def, size_t size)
{
  packing_psd_discrete_def defaults = {0};
  defaults.by = PACKING_BY_MASS;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check(packing_context *context, const packing_psd_discrete_def *d)
{
  PACKING_I_TRY(packing_i_psd_check_measure(context, d->by, d->dim));
  PACKING_I_TRY(packing_i_psd_check_count(context, d->count, 1));
  PACKING_I_TRY(packing_i_psd_check_entries(context, "r", d->r, d->count));
  PACKING_I_TRY(packing_i_psd_check_rising(context, "r", d->r, d->count));
  PACKING_I_TRY(packing_i_psd_check_entries(context, "share", d->share, d->count));
  return packing_i_psd_check_span(context, "r", d->r[0], d->r[d->count - 1]);
}

packing_status packing_psd_create_discrete(packing_context *context,
                                           const packing_psd_discrete_def *def,
                                           packing_psd **psd)
{
  packing_psd_discrete_def d;
  packing_i_atoms *atoms;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_discrete, dim, def, &d));
  PACKING_I_TRY(check(context, &d));
  PACKING_I_TRY(packing_i_atoms_create(context, &ops, sizeof *atoms, d.count, d.r,
                                       d.share, d.by, d.dim, d.r[0], d.r[d.count - 1],
                                       &atoms));
  *psd = &atoms->base;
  return PACKING_OK;
}
