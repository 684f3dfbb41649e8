/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all size distributions share: holds, and the questions asked of them. */
#include "psd_internal.h"
#include <math.h>

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

double packing_i_psd_point(const packing_psd *psd, packing_by by, double u, double v,
                           size_t *component)
{
  (void)v;
  *component = 0;
  return psd->ops->quantile(psd, by, u);
}

double packing_i_psd_radius(const packing_psd *psd, packing_by by, double u, double v,
                            size_t *component)
{
  return clamp(psd, psd->ops->point(psd, by, u, v, component));
}

double packing_i_psd_bisect(const packing_psd *psd, packing_by by, double p)
{
  double lo = psd->min_x, hi = psd->max_x;
  if (psd->ops->cdf(psd, by, lo) >= p)
    return lo;
  for (;;) {
    const double middle = hi > 2 * lo ? sqrt(lo * hi) : lo + (hi - lo) / 2;
    if (!(lo < middle && middle < hi))
      return hi;
    if (psd->ops->cdf(psd, by, middle) < p)
      lo = middle;
    else
      hi = middle;
  }
}

double packing_i_psd_draw(const packing_psd *psd, packing_i_stream *stream,
                          size_t *component)
{
  size_t part;
  const double u = packing_i_stream_uniform_open(stream);
  const double v = psd->ops->numbers > 1 ? packing_i_stream_uniform_open(stream) : 0.5;
  const double r = packing_i_psd_radius(psd, PACKING_BY_NUMBER, u, v, &part);
  if (component != NULL)
    *component = part;
  return r;
}

double packing_psd_draw(const packing_psd *psd, packing_rng *rng, size_t *component)
{
  return packing_i_psd_draw(psd, packing_i_rng_stream(rng), component);
}
