/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_IMAGES_H
#define PACKING_IMAGES_H

/* Pairs of particles with all their periodic images, in cells of any width. */

#include "grid/grid_internal.h"

typedef struct packing_i_images packing_i_images;

/* A pair: i < j, or a particle with an image of itself. */
typedef struct packing_i_image {
  size_t i; /* indices in the view */
  size_t j;
  packing_vec3 d; /* from i to this image of j: x_j + image - x_i */
  double distance;
  double r_i;
  double r_j;
  int16_t image[3]; /* periods that j is moved by, both centres wrapped into the cell */
} packing_i_image;

typedef void (*packing_i_image_function)(void *arg, const packing_i_image *pair);

/* Asks for the pairs with d <= (r_i + r_j) * factor + gap; a factor of 0 leaves the radii out.
 * `domain` gives the periodic directions, NULL: none. What is wrong with the view or the gap (not
 * finite, or so large that more than 32000 periods are within reach) is told in the context. The result borrows neither the view nor the domain. */
packing_status packing_i_images_create(packing_context *context,
                                       const packing_domain *domain,
                                       const packing_view *view, double factor,
                                       double gap, packing_i_images **images);

/* NULL is fine. */
void packing_i_images_destroy(packing_i_images *images);

/* Blocks depend on the particles only, and may be visited on any threads. */
size_t packing_i_images_blocks(const packing_i_images *images);

/* Over all blocks every pair is met once for each of its images within reach, a particle's own
 * ones once for both directions (the first component of image[] that is not 0 is above 0 then),
 * in an order that depends on the particles only; and now and then one that misses it by a few
 * units in the last place: fn decides. Allocates nothing. */
void packing_i_images_visit(const packing_i_images *images, size_t block,
                            packing_i_image_function fn, void *arg);

/* The grid beneath, and what it is asked: for those who count in its order. */
const packing_grid *packing_i_images_grid(const packing_i_images *images);
const packing_i_grid_reach *packing_i_images_reach(const packing_i_images *images);

/* Whether a pair may have more than one image within reach. */
int packing_i_images_are_many(const packing_i_images *images);

#endif
