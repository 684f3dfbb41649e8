/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Radii as curves, and the distance of a curve from a law: two-sided, exact for laws with atoms,
 * as both sides of every step are looked at. N log N to sort; where the law's curve is only read
 * off at every 64th size, monotony shows that nothing in between can matter. */
#include "measure/sizes_internal.h"
#include "view.h"
#include <gsl/gsl_sort.h>

enum { STRIDE = 64 };

static packing_status check_radii(packing_context *context, const packing_view *v)
{
  if (v->count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "view", PACKING_NO_INDEX,
                          "0 particles, at least 1 is needed");
  for (size_t i = 0; i < v->count; i++) {
    const double r = packing_i_view_r(v, i);
    if (!isfinite(r))
      return packing_i_fail(context, PACKING_ERR_INVALID, "r", i,
                            "%g of particle %zu is not a finite number", r, i);
    if (!(r > 0))
      return packing_i_fail(context, PACKING_ERR_RANGE, "r", i,
                            "%g of particle %zu must be above 0", r, i);
  }
  return PACKING_OK;
}

packing_status packing_i_sizes_view(packing_context *context, const packing_view *view,
                                    packing_view *copy)
{
  PACKING_I_TRY(packing_i_measure_view(context, view, copy));
  return check_radii(context, copy);
}

packing_status packing_i_sizes_dim(packing_context *context, int asked,
                                   const packing_psd *psd, int *dim)
{
  if (asked != 0 && asked != 2 && asked != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2, 3, or 0 for that of the distribution", asked);
  if (asked != 0 && psd != NULL && asked != psd->dim)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, but the distribution is of dim %d", asked, psd->dim);
  *dim = asked != 0 ? asked : psd != NULL ? psd->dim : 3;
  return PACKING_OK;
}

/* Equal radii share one step. */
static void make_steps(packing_i_sizes *s, int dim)
{
  size_t n = 0;
  packing_i_sum mass = {0, 0};
  for (size_t i = 0; i < s->count; i++) {
    packing_i_sum_add(&mass,
                      packing_i_sizes_mass(s->sorted[i] / s->sorted[s->count - 1], dim));
    if (i + 1 < s->count && s->sorted[i + 1] == s->sorted[i])
      continue;
    s->r[n] = s->sorted[i];
    s->share[PACKING_BY_NUMBER][n] = (double)(i + 1) / (double)s->count;
    s->share[PACKING_BY_MASS][n++] = packing_i_sum_value(&mass);
  }
  for (size_t k = 0; k < n; k++)
    s->share[PACKING_BY_MASS][k] /= packing_i_sum_value(&mass);
  s->steps = n;
}

packing_status packing_i_sizes_make(packing_context *context, const packing_column *r,
                                    size_t count, int dim, packing_i_sizes *sizes)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  memset(sizes, 0, sizeof *sizes);
  sizes->allocator = allocator;
  sizes->count = count;
  sizes->sorted = packing_i_alloc(allocator, count, sizeof *sizes->sorted);
  sizes->r = packing_i_alloc(allocator, count, sizeof *sizes->r);
  for (int by = 0; by < 2; by++)
    sizes->share[by] = packing_i_alloc(allocator, count, sizeof *sizes->share[by]);
  if (sizes->sorted == NULL || sizes->r == NULL || sizes->share[0] == NULL ||
      sizes->share[1] == NULL)
    return packing_i_nomem(context);
  for (size_t i = 0; i < count; i++)
    sizes->sorted[i] = packing_i_column_double(r, i);
  gsl_sort(sizes->sorted, 1, count);
  make_steps(sizes, dim);
  return PACKING_OK;
}

void packing_i_sizes_free(packing_i_sizes *sizes)
{
  packing_i_free(sizes->allocator, sizes->sorted);
  packing_i_free(sizes->allocator, sizes->r);
  packing_i_free(sizes->allocator, sizes->share[0]);
  packing_i_free(sizes->allocator, sizes->share[1]);
}

size_t packing_i_sizes_steps_upto(const packing_i_sizes *sizes, double r)
{
  size_t lo = 0, hi = sizes->steps; /* the answer is in lo .. hi */
  while (lo < hi) {
    const size_t middle = lo + (hi - lo) / 2;
    if (sizes->r[middle] <= r)
      lo = middle + 1;
    else
      hi = middle;
  }
  return lo;
}

static double share_before(const packing_i_sizes *s, packing_by by, size_t k)
{
  return k == 0 ? 0.0 : s->share[by][k - 1];
}

/* The law's curve just below a radius, so that an atom there is not counted. */
static double law_below(const packing_psd *psd, packing_by by, double r)
{
  return packing_psd_cdf(psd, by, nextafter(r, 0.0));
}

static double larger(double a, double b)
{
  return b > a ? b : a;
}

/* Distance of the curves on both sides of the steps first .. last, at the ends only. */
static double ends_distance(const packing_i_sizes *s, packing_by by,
                            const packing_psd *psd, size_t first, size_t last,
                            double *bound)
{
  const double below = law_below(psd, by, s->r[first]);
  const double above = packing_psd_cdf(psd, by, s->r[last]);
  *bound = larger(s->share[by][last] - below, above - share_before(s, by, first));
  return larger(fabs(share_before(s, by, first) - below),
                fabs(s->share[by][last] - above));
}

static size_t last_of(const packing_i_sizes *s, size_t first)
{
  const size_t left = s->steps - first;
  return first + (left < STRIDE ? left : STRIDE) - 1;
}

/* Between steps the placed curve is level and the law's rises, so the steps decide. */
double packing_i_sizes_distance(const packing_i_sizes *sizes, packing_by by,
                                const packing_psd *psd)
{
  double most = 0, bound = 0;
  for (size_t first = 0; first < sizes->steps; first += STRIDE)
    most =
        larger(most, ends_distance(sizes, by, psd, first, last_of(sizes, first), &bound));
  for (size_t first = 0; first < sizes->steps; first += STRIDE) {
    const size_t last = last_of(sizes, first);
    ends_distance(sizes, by, psd, first, last, &bound);
    for (size_t k = first; k <= last && bound > most; k++) {
      double unused;
      most = larger(most, ends_distance(sizes, by, psd, k, k, &unused));
    }
  }
  return most;
}
