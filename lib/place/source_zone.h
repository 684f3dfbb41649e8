/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SOURCE_ZONE_H
#define PACKING_SOURCE_ZONE_H

/* Part of the container with one distribution, or the list, and its stock. */

#include "source.h"
#include "source_list.h"
#include "source_strata.h"

typedef struct packing_i_zone {
  packing_i_stock stock;
  packing_psd *psd;         /* of a list: its law at the start */
  packing_i_strata choice;  /* which part of a mixture, which radius of a list */
  packing_i_strata *strata; /* of the radii, one for each part */
  double *upto;             /* share up to each part, by number */
  int listed;
  packing_i_list list;
  size_t returned; /* radii that came back; the last is the next to go out */
  double returned_r[PACKING_I_RETURNS];
  size_t returned_component[PACKING_I_RETURNS];
} packing_i_zone;

/* Where the numbers of a zone come from. */
typedef struct packing_i_zone_key {
  uint64_t seed;
  uint64_t stream;
  size_t zone;
} packing_i_zone_key;

/* Fills a cleared zone from a distribution, or, where that is NULL, from the def's classes.
 * packing_i_zone_finish() is called whatever comes back. */
packing_status packing_i_zone_start(packing_context *context, packing_psd *psd,
                                    const packing_front_def *def, size_t stock,
                                    packing_i_zone_key key, packing_i_zone *zone);
void packing_i_zone_finish(const packing_allocator *allocator, packing_i_zone *zone);

/* See packing_i_source_take() and packing_i_source_next(). */
void packing_i_zone_take(packing_i_zone *zone, size_t index, double *r,
                         size_t *component);
int packing_i_zone_next(packing_i_zone *zone, double *r, size_t *component);
void packing_i_zone_return(packing_i_zone *zone, double r, size_t component);

#endif
