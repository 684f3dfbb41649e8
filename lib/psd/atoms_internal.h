/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_ATOMS_INTERNAL_H
#define PACKING_ATOMS_INTERNAL_H

/* Distributions on a list of radii: discrete laws, and samples. */

#include "psd_internal.h"

typedef struct packing_i_atoms {
  packing_psd base;
  size_t count;
  double *x;       /* never falling */
  double *upto[2]; /* the share up to each entry, by number and by mass; the last is 1 */
} packing_i_atoms;

double packing_i_atoms_cdf(const packing_psd *psd, packing_by by, double x);
double packing_i_atoms_quantile(const packing_psd *psd, packing_by by, double p);
void packing_i_atoms_finish(packing_psd *psd);

/* The first entry with a share up to it of at least p. */
size_t packing_i_atoms_find(const packing_i_atoms *atoms, packing_by by, double p);

/* How many entries have x_i <= x. */
size_t packing_i_atoms_count_to(const packing_i_atoms *atoms, double x);

/* Makes a law of `count` sorted radii and shares > 0 (NULL: alike) within [min_r, max_r]. `size`
 * is that of the kind's struct, a packing_i_atoms at its head; its moments are those of the
 * entries. */
packing_status packing_i_atoms_create(packing_context *context,
                                      const packing_i_psd_ops *ops, size_t size,
                                      size_t count, const double *r, const double *share,
                                      packing_by by, int dim, double min_r, double max_r,
                                      packing_i_atoms **atoms);

#endif
