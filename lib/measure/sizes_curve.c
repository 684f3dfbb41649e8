/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cumulative curves of sizes at given radii, and the masses on a stack of sieves. A curve is
 * F(r) = share with radius <= r; a sieve of opening d passes 100 F(d / 2) per cent by mass and
 * retains what the next coarser one has passed less that. N log N, plus log N a radius. */
#include "measure/sizes_internal.h"

void packing_size_curve_def_fill(packing_size_curve_def *def, size_t size)
{
  packing_size_curve_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

void packing_sieves_def_fill(packing_sieves_def *def, size_t size)
{
  packing_sieves_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_length(packing_context *context, const char *field, size_t i,
                                   double v)
{
  if (!isfinite(v))
    return packing_i_fail(context, PACKING_ERR_INVALID, field, i,
                          "entry %zu: %g is not a finite number", i, v);
  if (!(v > 0))
    return packing_i_fail(context, PACKING_ERR_RANGE, field, i,
                          "entry %zu: %g must be above 0", i, v);
  return PACKING_OK;
}

static packing_status check_curve(packing_context *context,
                                  const packing_size_curve_def *d, const packing_psd *psd,
                                  size_t count, const double *r, const double *asked)
{
  PACKING_I_TRY(packing_i_psd_check_measure(context, d->by, 3));
  if (count > 0)
    PACKING_I_TRY(packing_i_check_given(context, "r", r));
  for (size_t i = 0; i < count; i++)
    PACKING_I_TRY(check_length(context, "r", i, r[i]));
  if (asked != NULL)
    PACKING_I_TRY(packing_i_check_given(context, "psd", psd));
  return PACKING_OK;
}

packing_status packing_measure_size_curve(packing_context *context,
                                          const packing_size_curve_def *def,
                                          packing_psd *psd, const packing_view *view,
                                          size_t count, const double *r, double *asked,
                                          double *placed)
{
  packing_size_curve_def d;
  packing_view v;
  packing_i_sizes sizes;
  int dim;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_size_curve, dim, def, &d));
  PACKING_I_TRY(check_curve(context, &d, psd, count, r, asked));
  PACKING_I_TRY(packing_i_sizes_dim(context, d.dim, psd, &dim));
  PACKING_I_TRY(packing_i_sizes_view(context, view, &v));
  const packing_status status = packing_i_sizes_make(context, &v.r, v.count, dim, &sizes);
  if (status == PACKING_OK) {
    for (size_t i = 0; i < count && asked != NULL; i++)
      asked[i] = packing_psd_cdf(psd, d.by, r[i]);
    for (size_t i = 0; i < count && placed != NULL; i++)
      placed[i] = packing_i_sizes_upto(&sizes, d.by, r[i]);
  }
  packing_i_sizes_free(&sizes);
  return status;
}

static packing_status check_sieves(packing_context *context, const packing_sieves_def *d,
                                   const packing_sieve *sieves)
{
  const double *opening = d->opening_d;
  if (d->count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "0 sieves, at least 1 is needed");
  PACKING_I_TRY(packing_i_check_given(context, "opening_d", opening));
  for (size_t i = 0; i < d->count; i++) {
    PACKING_I_TRY(check_length(context, "opening_d", i, opening[i]));
    if (i > 0 && opening[i] >= opening[i - 1])
      return packing_i_fail(context, PACKING_ERR_RANGE, "opening_d", i,
                            "entry %zu: %g is not finer than %g before it", i, opening[i],
                            opening[i - 1]);
  }
  return packing_i_check_given(context, "sieves", sieves);
}

/* The pan, after the last sieve, lets nothing pass. */
static void sieve(const packing_sieves_def *d, const packing_psd *psd,
                  const packing_i_sizes *sizes, packing_sieve *sieves)
{
  double asked = 100, placed = 100; /* what arrives */
  for (size_t i = 0; i <= d->count; i++) {
    packing_sieve *s = &sieves[i];
    s->opening_d = i < d->count ? d->opening_d[i] : 0;
    s->asked_passing =
        psd == NULL ? (double)NAN
                    : 100 * packing_psd_cdf(psd, PACKING_BY_MASS, s->opening_d / 2);
    s->asked_retained = asked - s->asked_passing;
    s->placed_passing =
        100 * packing_i_sizes_upto(sizes, PACKING_BY_MASS, s->opening_d / 2);
    s->placed_retained = placed - s->placed_passing;
    asked = s->asked_passing;
    placed = s->placed_passing;
  }
}

packing_status packing_measure_sieves(packing_context *context,
                                      const packing_sieves_def *def, packing_psd *psd,
                                      const packing_view *view, packing_sieve *sieves)
{
  packing_sieves_def d;
  packing_view v;
  packing_i_sizes sizes;
  int dim;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_sieves, dim, def, &d));
  PACKING_I_TRY(check_sieves(context, &d, sieves));
  PACKING_I_TRY(packing_i_sizes_dim(context, d.dim, psd, &dim));
  PACKING_I_TRY(packing_i_sizes_view(context, view, &v));
  const packing_status status = packing_i_sizes_make(context, &v.r, v.count, dim, &sizes);
  if (status == PACKING_OK)
    sieve(&d, psd, &sizes, sieves);
  packing_i_sizes_free(&sizes);
  return status;
}
