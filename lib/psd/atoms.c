/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions on a list of radii; see atoms_internal.h. Questions cost O(log count). */
#include "atoms_internal.h"
#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

size_t packing_i_atoms_count_to(const packing_i_atoms *atoms, double x)
{
  size_t lo = 0, hi = atoms->count;
  while (lo < hi) {
    const size_t middle = lo + (hi - lo) / 2;
    if (atoms->x[middle] <= x)
      lo = middle + 1;
    else
      hi = middle;
  }
  return lo;
}

size_t packing_i_atoms_find(const packing_i_atoms *atoms, packing_by by, double p)
{
  const double *upto = atoms->upto[by == PACKING_BY_MASS];
  size_t lo = 0, hi = atoms->count - 1;
  while (lo < hi) {
    const size_t middle = lo + (hi - lo) / 2;
    if (upto[middle] < p)
      lo = middle + 1;
    else
      hi = middle;
  }
  return lo;
}

double packing_i_atoms_cdf(const packing_psd *psd, packing_by by, double x)
{
  const packing_i_atoms *atoms = (const packing_i_atoms *)psd;
  const size_t count = packing_i_atoms_count_to(atoms, x);
  return count == 0 ? 0 : atoms->upto[by == PACKING_BY_MASS][count - 1];
}

double packing_i_atoms_quantile(const packing_psd *psd, packing_by by, double p)
{
  const packing_i_atoms *atoms = (const packing_i_atoms *)psd;
  return atoms->x[packing_i_atoms_find(atoms, by, p)];
}

void packing_i_atoms_finish(packing_psd *psd)
{
  packing_i_atoms *atoms = (packing_i_atoms *)psd;
  packing_i_free(&psd->allocator, atoms->x);
  packing_i_free(&psd->allocator, atoms->upto[0]);
  packing_i_free(&psd->allocator, atoms->upto[1]);
}

/* Shares by number and by mass from those that the law counts, as running sums, and moments. */
static void fill(packing_i_atoms *atoms, const double *share)
{
  packing_psd *psd = &atoms->base;
  const int e = packing_i_psd_number_exponent(psd->by, psd->dim);
  double largest = 0, sum[2] = {0, 0};
  for (size_t i = 0; share != NULL && i < atoms->count; i++)
    largest = fmax(largest, share[i]);
  for (size_t i = 0; i < atoms->count; i++) {
    const double x = atoms->x[i];
    const double number = (share == NULL ? 1 : share[i] / largest) * gsl_pow_int(x, e);
    atoms->upto[0][i] = sum[0] += number;
    atoms->upto[1][i] = sum[1] += number * gsl_pow_int(x, psd->dim);
    for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
      psd->moment[n] += number * gsl_pow_int(x, n + PACKING_I_PSD_LEAST_POWER);
  }
  for (size_t i = 0; i < atoms->count; i++) {
    atoms->upto[0][i] /= sum[0];
    atoms->upto[1][i] /= sum[1];
  }
  for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
    psd->moment[n] /= sum[0];
}

packing_status packing_i_atoms_create(packing_context *context,
                                      const packing_i_psd_ops *ops, size_t size,
                                      size_t count, const double *r, const double *share,
                                      packing_by by, int dim, double min_r, double max_r,
                                      packing_i_atoms **atoms)
{
  packing_i_atoms *a =
      (packing_i_atoms *)packing_i_psd_new(context, ops, size, by, dim, min_r, max_r);
  if (a == NULL)
    return PACKING_ERR_NOMEM;
  const packing_allocator *allocator = &a->base.allocator;
  a->count = count;
  a->x = packing_i_alloc(allocator, count, sizeof *a->x);
  a->upto[0] = packing_i_alloc(allocator, count, sizeof *a->upto[0]);
  a->upto[1] = packing_i_alloc(allocator, count, sizeof *a->upto[1]);
  if (a->x == NULL || a->upto[0] == NULL || a->upto[1] == NULL) {
    packing_psd_destroy(&a->base);
    return packing_i_nomem(context);
  }
  for (size_t i = 0; i < count; i++)
    a->x[i] = r[i] / a->base.unit;
  fill(a, share);
  *atoms = a;
  return PACKING_OK;
}
