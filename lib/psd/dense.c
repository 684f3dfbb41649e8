/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The densest random packing of any distribution: R. S. Farr and R. D. Groot, "Close packing
 * density of polydisperse hard spheres", J. Chem. Phys. 131, 244104 (2009).
 *
 * A straight line through a pack of spheres of diameters D cuts them in chords. Laid on the line
 * these are rods, of lengths L with density P1(L) = 2 L Int_L^inf P3(D) dD / E[D^2], that is
 *
 *   C(L) = E[min(L, D)^2] / E[D^2].
 *
 * The rods are put one by one, longest first, each into the largest gap: with f = 0.7654, fitted
 * by the paper to equal spheres, a rod L needs a gap of f L on its left to the next rod (all
 * longer than it), so a gap g becomes f L and max(f L, g - (1 + f) L): the line grows where the
 * rod does not fit. The first rod has one gap of f times itself (the line is a ring).
 * phi = sum of rods / (sum of rods + sum of gaps).
 *
 * Here the law is 2^14 equal shares of mass (points of the unit square, so that mixtures and
 * samples cost no inversions), which makes C piecewise quadratic, and the rods are the 20000
 * mid-quantiles of C. Doubling both moves the results by less than 1e-4. Gaps are kept in a heap:
 * O(N log N). */
#include "psd_internal.h"
#include <gsl/gsl_sort.h>
#include <math.h>

enum { SIZE_BITS = 14, SIZES = 1 << SIZE_BITS, RODS = 20000 };

static const double f = 0.7654;

/* j with its SIZE_BITS bits in reverse, to (0, 1). */
static double radical_inverse(unsigned j)
{
  unsigned reverse = 0;
  for (int bit = 0; bit < SIZE_BITS; bit++)
    reverse |= (j >> bit & 1u) << (SIZE_BITS - 1 - bit);
  return (reverse + 0.5) / SIZES;
}

/* Sizes of equal mass, rising. */
static void fill_sizes(const packing_psd *psd, double *size)
{
  for (unsigned j = 0; j < SIZES; j++) {
    size_t component;
    size[j] = packing_i_psd_radius(psd, PACKING_BY_MASS, (j + 0.5) / SIZES,
                                   radical_inverse(j), &component) /
              psd->unit;
  }
  gsl_sort(size, 1, SIZES);
}

/* The mid-quantiles of C, rising. A share of mass counts 1 / D^3 spheres, so 1 - C(L) goes as the
 * sum of 1 / D - L^2 / D^3 over D > L: found from the top, where nothing cancels. */
static void fill_rods(const double *size, double *rod)
{
  double all = 0, area = 0, number = 0; /* of the sizes from j on */
  size_t j = SIZES;
  for (size_t i = SIZES; i-- > 0;)
    all += 1 / size[i];
  for (size_t i = RODS; i-- > 0;) {
    const double beyond = all * ((double)(RODS - i) - 0.5) / RODS;
    while (j > 0 && area - number * size[j - 1] * size[j - 1] < beyond) {
      j--;
      area += 1 / size[j];
      number += 1 / (size[j] * size[j] * size[j]);
    }
    rod[i] = sqrt((area - beyond) / number);
  }
}

/* The heap's root is replaced and sinks to its place; the largest is on top. */
static void sink(double *heap, size_t count, double gap)
{
  size_t at = 0;
  for (;;) {
    size_t child = 2 * at + 1;
    if (child >= count)
      break;
    if (child + 1 < count && heap[child + 1] > heap[child])
      child++;
    if (heap[child] <= gap)
      break;
    heap[at] = heap[child];
    at = child;
  }
  heap[at] = gap;
}

static void rise(double *heap, size_t at, double gap)
{
  while (at > 0 && heap[(at - 1) / 2] < gap) {
    heap[at] = heap[(at - 1) / 2];
    at = (at - 1) / 2;
  }
  heap[at] = gap;
}

static double pack(const double *rod, double *heap)
{
  double rods = rod[RODS - 1], gaps = 0;
  heap[0] = f * rods;
  for (size_t count = 1; count < RODS; count++) {
    const double length = rod[RODS - 1 - count];
    const double least = f * length;
    const double rest = heap[0] - (1 + f) * length;
    sink(heap, count, fmax(least, rest));
    rise(heap, count, least);
    rods += length;
  }
  for (size_t i = 0; i < RODS; i++)
    gaps += heap[i];
  return rods / (rods + gaps);
}

packing_status packing_psd_dense_limit(packing_context *context, const packing_psd *psd,
                                       double *volume_fraction)
{
  if (psd == NULL || volume_fraction == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID,
                          psd == NULL ? "psd" : "volume_fraction", PACKING_NO_INDEX,
                          "NULL");
  if (psd->dim != 3)
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "psd", PACKING_NO_INDEX,
                          "the theory is for spheres (dim 3), not for dim %d", psd->dim);
  const packing_allocator *allocator = packing_i_allocator(context);
  double *block = packing_i_alloc(allocator, SIZES + 2 * RODS, sizeof *block);
  if (block == NULL)
    return packing_i_nomem(context);
  double *rod = block + SIZES, *heap = rod + RODS;
  fill_sizes(psd, block);
  fill_rods(block, rod);
  *volume_fraction = pack(rod, heap);
  packing_i_free(allocator, block);
  return PACKING_OK;
}
