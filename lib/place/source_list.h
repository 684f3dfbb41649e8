/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SOURCE_LIST_H
#define PACKING_SOURCE_LIST_H

/* An exact list: so many radii of each class, drawn without being put back. */

#include "ranks.h"
#include "base_internal.h"
#include <packing/front.h>
#include <packing/psd.h>
#include <stdint.h>

typedef struct packing_i_list {
  size_t classes;
  packing_i_rank *rank; /* the classes by radius */
  size_t *tree;         /* Fenwick's sums over `rank` of what is not drawn; from 1 */
  size_t stride;        /* the largest power of two that is not above `classes` */
  size_t undrawn;
  size_t *left; /* of each class as it was given, what is not taken: drawn or not */
  size_t unplaced;
} packing_i_list;

/* `list` is cleared; packing_i_list_finish() is called whatever comes back. */
packing_status packing_i_list_start(packing_context *context,
                                    const packing_front_class *classes, size_t count,
                                    packing_i_list *list);
void packing_i_list_finish(const packing_allocator *allocator, packing_i_list *list);

/* The law of the radii of a list, none of which is drawn yet. */
packing_status packing_i_list_psd(packing_context *context, const packing_i_list *list,
                                  packing_psd **psd);

/* Draws the radius that stands at `p` / 2^64 of those not drawn, of which there must be one. */
double packing_i_list_draw(packing_i_list *list, uint64_t p, size_t *class_index);

#endif
