/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equal particles. A draw takes its number of the stream like every other kind, so that
 * changing the sizes does not shift what is drawn after them. */
#include "psd_internal.h"
#include <gsl/gsl_math.h>

static double cdf(const packing_psd *psd, packing_by by, double x)
{
  (void)by;
  return x < psd->max_x ? 0 : 1;
}

static double quantile(const packing_psd *psd, packing_by by, double p)
{
  (void)by;
  (void)p;
  return psd->max_x;
}

static const packing_i_psd_ops ops = {
    "mono", "one radius", cdf, quantile, packing_i_psd_point, 1, NULL};

void packing_psd_mono_def_fill(packing_psd_mono_def *def, size_t size)
{
  packing_psd_mono_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_psd_create_mono(packing_context *context,
                                       const packing_psd_mono_def *def, packing_psd **psd)
{
  packing_psd_mono_def d;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_mono, dim, def, &d));
  PACKING_I_TRY(packing_i_psd_check_measure(context, d.by, d.dim));
  PACKING_I_TRY(packing_i_check_positive(context, "r", d.r));
  PACKING_I_TRY(packing_i_psd_check_span(context, "r", d.r, d.r));
  packing_psd *p = packing_i_psd_new(context, &ops, sizeof *p, d.by, d.dim, d.r, d.r);
  if (p == NULL)
    return PACKING_ERR_NOMEM;
  for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
    p->moment[n] = gsl_pow_int(p->max_x, n + PACKING_I_PSD_LEAST_POWER);
  *psd = p;
  return PACKING_OK;
}
