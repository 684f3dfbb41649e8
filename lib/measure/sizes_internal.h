/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SIZES_INTERNAL_H
#define PACKING_SIZES_INTERNAL_H

/* What the measures of sizes share: radii, sorted, and the curves that they make. */

#include "measure/measure_internal.h"
#include "psd/psd_internal.h"
#include <packing/sizes.h>

/* The radii of some particles. Their curve rises at radius r[k] from share[by][k - 1] to
 * share[by][k], and is level between. */
typedef struct packing_i_sizes {
  const packing_allocator *allocator;
  size_t count;     /* particles, at least 1 */
  size_t steps;     /* different radii */
  double *sorted;   /* count radii, rising */
  double *r;        /* steps */
  double *share[2]; /* steps each, by number and by mass */
} packing_i_sizes;

/* Reads the view and refuses it if it is empty or a radius is bad; centres may be anything. */
packing_status packing_i_sizes_view(packing_context *context, const packing_view *view,
                                    packing_view *copy);

/* Makes the curves of `count` radii; free them also after a failure. */
packing_status packing_i_sizes_make(packing_context *context, const packing_column *r,
                                    size_t count, int dim, packing_i_sizes *sizes);

void packing_i_sizes_free(packing_i_sizes *sizes);

/* Mass of a particle whose radius, in some unit, is r. */
static inline double packing_i_sizes_mass(double r, int dim)
{
  return dim == 2 ? r * r : r * r * r;
}

/* How many steps are at radii up to r. */
size_t packing_i_sizes_steps_upto(const packing_i_sizes *sizes, double r);

/* The placed curve at r. */
static inline double packing_i_sizes_upto(const packing_i_sizes *sizes, packing_by by,
                                          double r)
{
  const size_t k = packing_i_sizes_steps_upto(sizes, r);
  return k == 0 ? 0.0 : sizes->share[by][k - 1];
}

/* sup |placed - asked|. */
double packing_i_sizes_distance(const packing_i_sizes *sizes, packing_by by,
                                const packing_psd *psd);

/* By what mass goes: `dim` where it is given, else that of the distribution, else 3. */
packing_status packing_i_sizes_dim(packing_context *context, int asked,
                                   const packing_psd *psd, int *dim);

/* P(sqrt(n) D_n < z) by the expansion of Pelz and Good. */
double packing_i_kolmogorov_expansion(double n, double z);

/* P(D_n < d) by the matrix of Marsaglia, Tsang and Wang. */
packing_status packing_i_kolmogorov_matrix(packing_context *context, size_t n, double d,
                                           double *chance);

/* P(D_n+ >= d), one side only, and its limit for large n. */
double packing_i_kolmogorov_side(size_t n, double d);
double packing_i_kolmogorov_side_limit(double n, double d);

#endif
