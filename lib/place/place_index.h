/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PLACE_INDEX_H
#define PACKING_PLACE_INDEX_H

/* A growing neighbour index for spheres of any sizes: one level of cells for each octave of
 * radii below the largest (Krijgsman, Ogarko and Luding, Comput. Part. Mech. 1, 357, 2014). A
 * level's cells are at least a largest diameter of the level wide. There are no more than some for
 * each particle expected, so memory goes with particles, not with volume: where the container needs
 * more, cells far apart share one, like the two ends of a torus. Most cells of the fine levels are
 * empty where sizes differ much: a bit a cell tells, and 64 are passed over at once. */

#include "place_internal.h"

enum { PACKING_I_INDEX_LEVELS = 24 };

typedef struct packing_i_index_level {
  double largest_r; /* of the particles in it so far */
  packing_vec3 per_edge;
  size_t n[3];     /* cells held */
  size_t whole[3]; /* cells of the container: n, or more where they share */
  uint64_t *full;  /* per cell a bit: whether there is any; rows along x start a word */
  size_t words;    /* of a row */
  uint32_t *head;  /* per cell: index + 1 of the first entry; NULL: nothing there yet */
  size_t count;
} packing_i_index_level;

typedef struct packing_i_index_entry {
  double x, y, z, r;
  uint32_t next; /* index + 1 within the cell; 0: none */
} packing_i_index_entry;

typedef struct packing_i_index {
  packing_context *context;
  packing_vec3 lo, width, period;
  double top_r; /* largest radius that can come */
  size_t expected;
  packing_i_index_level level[PACKING_I_INDEX_LEVELS];
  packing_i_index_entry *entry;
  size_t count;
  size_t capacity;
} packing_i_index;

/* A particle, or an image of one, near a point. */
typedef struct packing_i_index_image {
  packing_vec3 p; /* from the point to its centre */
  double r;
  size_t index; /* of the particle, in the order of insertion */
} packing_i_index_image;

typedef struct packing_i_index_images {
  packing_i_index_image *at;
  size_t count;
  size_t capacity;
} packing_i_index_images;

/* Covers the bounds of the domain. `top_r` bounds all radii; `expected` is about how many will
 * come (0: unknown). Allocates nothing. */
void packing_i_index_init(packing_i_index *index, packing_context *context,
                          const packing_domain *domain, double top_r, size_t expected);
void packing_i_index_release(packing_i_index *index);

/* Makes room for `more` particles, one of which has radius r. */
packing_status packing_i_index_reserve(packing_i_index *index, size_t more, double r);

/* Adds a particle; room was reserved. Points outside the bounds are fine. */
void packing_i_index_insert(packing_i_index *index, packing_vec3 p, double r);

/* Whether a sphere would overlap none. */
int packing_i_index_free(const packing_i_index *index, packing_vec3 p, double r);

/* All particles and images whose surface is less than `distance` away from a point of the
 * container, with that of a particle that stands there. Memory comes from the context of the index;
 * on failure the list can be asked for again. */
packing_status packing_i_index_near(const packing_i_index *index, packing_vec3 p,
                                    double distance, packing_i_index_images *images);

/* Adds all particles of the store, wrapped into the cell of the domain. */
packing_status packing_i_index_add_store(packing_i_index *index,
                                         const packing_domain *domain,
                                         const packing_particles *store);

#endif
