/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SOURCE_H
#define PACKING_SOURCE_H

/* Where the front's radii come from: a distribution, one for each zone of the container, or an
 * exact list. Radii are drawn by number and by strata (source_strata.h), so that the sizes drawn
 * follow the distribution closer than chance would; what is placed differs from what is drawn by
 * the stock at most. Each zone has a stock of such radii to choose from. A list is drawn without
 * being put back; the `component` of its radii is the index of their class.
 *
 * Cost: a choice a binary search in the stock, a refill one move of half of it. */

#include "psd/psd_internal.h"
#include "rng/rng_internal.h"
#include <packing/domain.h>
#include <packing/front.h>

enum {
  PACKING_I_STOCK_BINS = 8,
  PACKING_I_STOCK_MOST = 4096,
  PACKING_I_RETURNS = 8 /* more than a first group, and one that the goal refused */
};

/* The radii at hand in one zone, rising. Read freely; changed by packing_i_source_take() only. */
typedef struct packing_i_stock {
  double *r;
  int32_t *component;
  size_t count; /* falls only when a list comes to its end */
  /* Radii at which a bin of equal shares by number ends; the last is the largest of all. Equal
   * radii fall into one bin, and bins of next to no share are joined to another: the others then
   * are empty, and no radius between the smallest and the largest falls into them. */
  double edge[PACKING_I_STOCK_BINS];
  double due[PACKING_I_STOCK_BINS];  /* share of the bin in the distribution, by number */
  size_t held[PACKING_I_STOCK_BINS]; /* radii of the bin in the stock */
  double weight[PACKING_I_STOCK_BINS]; /* 1 / (count due); 0 for a bin that is empty */
  /* So many radii are up to the end of the bin held in the greatest excess. */
  size_t full;
} packing_i_stock;

typedef struct packing_i_source packing_i_source;

/* `stock` radii are held ready, at least 1; `def` gives regions, choose, or classes (then psd is
 * NULL); checked by the caller. */
packing_status packing_i_source_create(packing_context *context,
                                       const packing_front_def *def, packing_psd *psd,
                                       size_t stock, packing_i_source **source);
void packing_i_source_destroy(packing_i_source *source); /* NULL is fine */

/* The distribution of zone 0; of a list, its law as it was at the start. */
packing_psd *packing_i_source_psd(const packing_i_source *source);

int packing_i_source_listed(const packing_i_source *source); /* 1: an exact list */

size_t packing_i_source_zones(const packing_i_source *source);
/* The zone of a centre, from 0 (the placer's own distribution): the first region that holds it,
 * or what `choose` says; 0 where that is above the number of regions. Thread-safe. */
size_t packing_i_source_zone(const packing_i_source *source, const packing_vec3 *centre);
packing_i_stock *packing_i_source_stock(packing_i_source *source, size_t zone);

/* Smallest and largest radius of all zones. */
double packing_i_source_min_r(const packing_i_source *source);
double packing_i_source_max_r(const packing_i_source *source);
/* E[r^n] by number of zone 0, n from -6 to 9; of a list: as it was at the start. */
double packing_i_source_moment(const packing_i_source *source, int n);

/* Takes radius `index` out of the stock of a zone, which is not empty, and refills it. */
void packing_i_source_take(packing_i_source *source, size_t zone, size_t index, double *r,
                           size_t *component);

/* The next radius as it comes, without regard to its size (for a front that places what it
 * drew); 0: the list has come to its end. */
int packing_i_source_next(packing_i_source *source, size_t zone, double *r,
                          size_t *component);
/* Puts a radius that was drawn back: it could not be placed. The last put back is the next that
 * packing_i_source_next() gives. At most PACKING_I_RETURNS of a zone are back at a time. */
void packing_i_source_return(packing_i_source *source, size_t zone, double r,
                             size_t component);

/* What is left of a list, by class as given: not taken, or returned. Of a distribution nothing is
 * written. */
void packing_i_source_left(const packing_i_source *source, size_t *counts);
/* Radii that were drawn and not placed: all that is left of a list, what was returned of a
 * distribution (not its stock). */
size_t packing_i_source_unplaced(const packing_i_source *source);

/* How many radii of a stock are at most r. Without branches: which way it goes is chance. */
static inline size_t packing_i_stock_below(const packing_i_stock *stock, double r)
{
  size_t first = 0;
  for (size_t left = stock->count; left > 0;) {
    const size_t half = (left + 1) / 2;
    first += stock->r[first + half - 1] <= r ? half : 0;
    left -= half;
  }
  return first;
}

static inline size_t packing_i_stock_bin(const packing_i_stock *stock, double r)
{
  size_t bin = 0;
  for (size_t k = 0; k + 1 < PACKING_I_STOCK_BINS; k++)
    bin += r > stock->edge[k];
  return bin;
}

/* By how much the stock holds more radii of r's bin than its share: 0 balanced, -1 none. */
static inline double packing_i_stock_excess(const packing_i_stock *stock, double r)
{
  const size_t bin = packing_i_stock_bin(stock, r);
  return (double)stock->held[bin] * stock->weight[bin] - 1;
}

#endif
