/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all size distributions share: holds, limits, and the questions asked of them. */
#include "psd_internal.h"
#include <math.h>

/* Radii between these, and not farther apart than this, keep every moment of -6 .. 9 within
 * the range of doubles. */
static const double least_r = 1e-200, most_r = 1e200, least_ratio = 1e-30;

packing_status packing_i_psd_check_arguments(packing_context *context, const void *def,
                                             packing_psd **psd)
{
  if (def == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "def", PACKING_NO_INDEX, "NULL");
  if (psd == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "psd", PACKING_NO_INDEX, "NULL");
  return PACKING_OK;
}

packing_status packing_i_psd_check_measure(packing_context *context, packing_by by,
                                           int dim)
{
  if (by != PACKING_BY_NUMBER && by != PACKING_BY_MASS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "by", PACKING_NO_INDEX,
                          "%d is neither number nor mass", (int)by);
  if (dim != 2 && dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d is neither 2 nor 3", dim);
  return PACKING_OK;
}

packing_status packing_i_psd_check_span(packing_context *context, const char *field,
                                        double min_r, double max_r)
{
  if (min_r < least_r || max_r > most_r)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "%g is not between %g and %g", min_r < least_r ? min_r : max_r,
                          least_r, most_r);
  if (min_r / max_r < least_ratio)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "sizes from %g to %g span more than 1:%g", min_r, max_r,
                          1 / least_ratio);
  return PACKING_OK;
}

packing_status packing_i_psd_check_cut(packing_context *context, double min_r,
                                       double max_r)
{
  PACKING_I_TRY(packing_i_check_positive(context, "min_r", min_r));
  PACKING_I_TRY(packing_i_check_positive(context, "max_r", max_r));
  if (max_r <= min_r)
    return packing_i_fail(context, PACKING_ERR_RANGE, "max_r", PACKING_NO_INDEX,
                          "%g must be above min_r = %g", max_r, min_r);
  return packing_i_psd_check_span(context, "min_r", min_r, max_r);
}

packing_psd *packing_i_psd_new(packing_context *context, const packing_i_psd_ops *ops,
                               size_t size, packing_by by, int dim, double min_r,
                               double max_r)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_psd *psd = packing_i_calloc(allocator, 1, size);
  if (psd == NULL) {
    PACKING_IGNORE(packing_i_nomem(context));
    return NULL;
  }
  psd->ops = ops;
  psd->allocator = *allocator;
  atomic_init(&psd->holds, 1);
  psd->by = by;
  psd->dim = dim;
  psd->components = 1;
  psd->max_x = frexp(max_r, &psd->exponent);
  psd->unit = ldexp(1, psd->exponent);
  psd->min_x = min_r / psd->unit;
  return psd;
}

packing_psd *packing_psd_retain(packing_psd *psd)
{
  if (psd != NULL)
    atomic_fetch_add_explicit(&psd->holds, 1, memory_order_relaxed);
  return psd;
}

void packing_psd_destroy(packing_psd *psd)
{
  if (psd == NULL || atomic_fetch_sub_explicit(&psd->holds, 1, memory_order_acq_rel) != 1)
    return;
  if (psd->ops->finish != NULL)
    psd->ops->finish(psd);
  const packing_allocator allocator = psd->allocator;
  packing_i_free(&allocator, psd);
}

double packing_psd_min_r(const packing_psd *psd)
{
  return psd->min_x * psd->unit;
}

double packing_psd_max_r(const packing_psd *psd)
{
  return psd->max_x * psd->unit;
}

const char *packing_psd_kind(const packing_psd *psd)
{
  return psd->ops->name;
}

size_t packing_psd_components(const packing_psd *psd)
{
  return psd->components;
}

packing_status packing_psd_moment(const packing_psd *psd, packing_by by, int power,
                                  double *moment)
{
  if (psd == NULL || moment == NULL)
    return PACKING_ERR_INVALID;
  if (power < PACKING_I_PSD_LEAST_POWER || power > PACKING_I_PSD_MOST_POWER)
    return PACKING_ERR_RANGE;
  double m = packing_i_psd_number_moment(psd, power);
  if (by == PACKING_BY_MASS)
    m = packing_i_psd_number_moment(psd, power + psd->dim) /
        packing_i_psd_number_moment(psd, psd->dim);
  m = ldexp(m, power * psd->exponent);
  if (!isnormal(m)) /* lengths of 1e100 to the sixth are no doubles */
    return PACKING_ERR_RANGE;
  *moment = m;
  return PACKING_OK;
}

double packing_psd_cdf(const packing_psd *psd, packing_by by, double r)
{
  if (isnan(r))
    return r;
  if (r < packing_psd_min_r(psd))
    return 0;
  if (r >= packing_psd_max_r(psd))
    return 1;
  const double p = psd->ops->cdf(psd, by, r / psd->unit);
  return fmin(fmax(p, 0), 1);
}

/* Rounding must not carry a size beyond the cut. */
static double clamp(const packing_psd *psd, double x)
{
  return fmin(fmax(x, psd->min_x), psd->max_x) * psd->unit;
}

double packing_psd_quantile(const packing_psd *psd, packing_by by, double p)
{
  if (isnan(p))
    return p;
  if (p <= 0)
    return packing_psd_min_r(psd);
  if (p >= 1)
    return packing_psd_max_r(psd);
  return clamp(psd, psd->ops->quantile(psd, by, p));
}

double packing_i_psd_draw_inverse(const packing_psd *psd, packing_i_stream *stream,
                                  size_t *component)
{
  *component = 0;
  return psd->ops->quantile(psd, PACKING_BY_NUMBER,
                            packing_i_stream_uniform_open(stream));
}

double packing_i_psd_draw(const packing_psd *psd, packing_i_stream *stream,
                          size_t *component)
{
  size_t part = 0;
  const double r = clamp(psd, psd->ops->draw(psd, stream, &part));
  if (component != NULL)
    *component = part;
  return r;
}

double packing_psd_draw(const packing_psd *psd, packing_rng *rng, size_t *component)
{
  return packing_i_psd_draw(psd, packing_i_rng_stream(rng), component);
}
