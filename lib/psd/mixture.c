/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mixtures. A part's share by mass is its share by number times its mean r^dim, over the sum; cdf
 * and moments are sums over the parts, the inverse bisects the cdf. A draw takes one number for
 * the part (the rest of it goes on to a part that needs two) and one for the radius. */
#include "psd_internal.h"
#include <math.h>

typedef struct mixture {
  packing_psd base;
  packing_psd **part;
  double *upto[2]; /* the share up to each part, by number and by mass; the last is 1 */
} mixture;

static double share_of(const mixture *m, packing_by by, size_t i)
{
  const double *upto = m->upto[by == PACKING_BY_MASS];
  return upto[i] - (i == 0 ? 0 : upto[i - 1]);
}

static double cdf(const packing_psd *psd, packing_by by, double x)
{
  const mixture *m = (const mixture *)psd;
  double sum = 0;
  for (size_t i = 0; i < psd->components; i++)
    sum += share_of(m, by, i) * packing_psd_cdf(m->part[i], by, x * psd->unit);
  return sum;
}

static double point(const packing_psd *psd, packing_by by, double u, double v,
                    size_t *component)
{
  const mixture *m = (const mixture *)psd;
  const double *upto = m->upto[by == PACKING_BY_MASS];
  size_t i = 0, inner;
  while (upto[i] < v)
    i++;
  /* Within (0, 1) even where rounding says otherwise. */
  const double rest = (v - (i == 0 ? 0 : upto[i - 1])) / share_of(m, by, i);
  *component = i;
  return packing_i_psd_radius(m->part[i], by, u, fmin(fmax(rest, 0x1p-53), 1 - 0x1p-53),
                              &inner) /
         psd->unit;
}

static void finish(packing_psd *psd)
{
  mixture *m = (mixture *)psd;
  for (size_t i = 0; m->part != NULL && i < psd->components; i++)
    packing_psd_destroy(m->part[i]);
  packing_i_free(&psd->allocator, m->part);
  packing_i_free(&psd->allocator, m->upto[0]);
  packing_i_free(&psd->allocator, m->upto[1]);
}

static const packing_i_psd_ops ops = {
    "mixture", "sum of share times part", cdf, packing_i_psd_bisect, point, 2, finish};

const packing_psd *packing_i_psd_part(const packing_psd *psd, size_t i)
{
  return psd->ops == &ops ? ((const mixture *)psd)->part[i] : psd;
}

double packing_i_psd_part_share(const packing_psd *psd, packing_by by, size_t i)
{
  return psd->ops == &ops ? share_of((const mixture *)psd, by, i) : 1;
}

void packing_psd_mixture_def_fill(packing_psd_mixture_def *def, size_t size)
{
  packing_psd_mixture_def defaults = {0};
  defaults.by = PACKING_BY_MASS;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_parts(packing_context *context,
                                  const packing_psd_mixture_def *d)
{
  if (d->parts == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "parts", PACKING_NO_INDEX,
                          "NULL");
  for (size_t i = 0; i < d->count; i++) {
    if (d->parts[i] == NULL)
      return packing_i_fail(context, PACKING_ERR_INVALID, "parts", i, "part %zu: NULL",
                            i + 1);
    if (d->parts[i]->dim != d->dim)
      return packing_i_fail(context, PACKING_ERR_INVALID, "parts", i,
                            "part %zu: dim %d in a mixture of dim %d", i + 1,
                            d->parts[i]->dim, d->dim);
  }
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_psd_mixture_def *d,
                            double *min_r, double *max_r)
{
  PACKING_I_TRY(packing_i_psd_check_measure(context, d->by, d->dim));
  PACKING_I_TRY(packing_i_psd_check_count(context, d->count, 1));
  PACKING_I_TRY(check_parts(context, d));
  PACKING_I_TRY(packing_i_psd_check_entries(context, "share", d->share, d->count));
  *min_r = packing_psd_min_r(d->parts[0]);
  *max_r = packing_psd_max_r(d->parts[0]);
  for (size_t i = 1; i < d->count; i++) {
    *min_r = fmin(*min_r, packing_psd_min_r(d->parts[i]));
    *max_r = fmax(*max_r, packing_psd_max_r(d->parts[i]));
  }
  return packing_i_psd_check_span(context, "parts", *min_r, *max_r);
}

/* E[x^n] of a part by number, in units of the mixture. */
static double part_moment(const mixture *m, size_t i, int n)
{
  const packing_psd *part = m->part[i];
  return ldexp(packing_i_psd_number_moment(part, n),
               n * (part->exponent - m->base.exponent));
}

static void fill(mixture *m, const double *share)
{
  packing_psd *psd = &m->base;
  double largest = 0, sum[2] = {0, 0};
  for (size_t i = 0; i < psd->components; i++)
    largest = fmax(largest, share[i]);
  for (size_t i = 0; i < psd->components; i++) {
    const double mass = part_moment(m, i, psd->dim);
    const double number = share[i] / largest / (psd->by == PACKING_BY_MASS ? mass : 1);
    m->upto[0][i] = sum[0] += number;
    m->upto[1][i] = sum[1] += number * mass;
    for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
      psd->moment[n] += number * part_moment(m, i, n + PACKING_I_PSD_LEAST_POWER);
  }
  for (size_t i = 0; i < psd->components; i++) {
    m->upto[0][i] /= sum[0];
    m->upto[1][i] /= sum[1];
  }
  for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
    psd->moment[n] /= sum[0];
}

packing_status packing_psd_create_mixture(packing_context *context,
                                          const packing_psd_mixture_def *def,
                                          packing_psd **psd)
{
  packing_psd_mixture_def d;
  double min_r, max_r;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_mixture, dim, def, &d));
  PACKING_I_TRY(check(context, &d, &min_r, &max_r));
  mixture *m =
      (mixture *)packing_i_psd_new(context, &ops, sizeof *m, d.by, d.dim, min_r, max_r);
  if (m == NULL)
    return PACKING_ERR_NOMEM;
  const packing_allocator *allocator = &m->base.allocator;
  m->base.components = d.count;
  m->part = packing_i_calloc(allocator, d.count, sizeof(packing_psd *));
  m->upto[0] = packing_i_alloc(allocator, d.count, sizeof *m->upto[0]);
  m->upto[1] = packing_i_alloc(allocator, d.count, sizeof *m->upto[1]);
  if (m->part == NULL || m->upto[0] == NULL || m->upto[1] == NULL) {
    packing_psd_destroy(&m->base);
    return packing_i_nomem(context);
  }
  for (size_t i = 0; i < d.count; i++)
    m->part[i] = packing_psd_retain(d.parts[i]);
  fill(m, d.share);
  *psd = &m->base;
  return PACKING_OK;
}
