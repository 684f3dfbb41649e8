/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_H
#define PACKING_FRONT_H

/** \file packing/front.h
 *  The advancing front: each particle is placed in contact with three bodies (two in two
 *  dimensions) that stand already, particles or walls; those that still have room beside them
 *  are the front. A placer, to be stepped as packing/placer.h says. */

#include <packing/placer.h>
#include <packing/tangency.h>

PACKING_BEGIN_DECLS

/** How particles and places are chosen. */
typedef enum packing_front_mode {
  PACKING_FRONT_DENSE = 0, /**< the best place and size of many; random close packing */
  PACKING_FRONT_FAST = 1,  /**< a good place and size of few */
  PACKING_FRONT_PAPER =
      2 /**< the seed paper's Pseudocode 2: the first place that is free */
} packing_front_mode;

/** Where the front starts. */
typedef enum packing_front_direction {
  PACKING_FRONT_OUTWARD = 0, /**< at the innermost point */
  PACKING_FRONT_INWARD = 1   /**< at the walls, the whole boundary first */
} packing_front_direction;

/** In which order particles of a list are taken (paper mode; section 3.3). */
typedef enum packing_front_select {
  PACKING_FRONT_RANDOM = 0, /**< any of them */
  PACKING_FRONT_FIFO = 1,   /**< the oldest first */
  PACKING_FRONT_LIFO = 2    /**< the youngest first */
} packing_front_select;

/** The name of a mode, as in "dense".
 *  \param mode any value
 *  \return a constant string, NULL for other values. Thread-safe */
PACKING_API const char *packing_front_mode_name(packing_front_mode mode);

/** The name of a direction, as in "outward".
 *  \param direction any value
 *  \return a constant string, NULL for other values. Thread-safe */
PACKING_API const char *packing_front_direction_name(packing_front_direction direction);

/** The name of a selection, as in "fifo".
 *  \param select any value
 *  \return a constant string, NULL for other values. Thread-safe */
PACKING_API const char *packing_front_select_name(packing_front_select select);

/** A class of an exact list. */
typedef struct packing_front_class {
  double r;     /**< radius [L] */
  size_t count; /**< particles */
} packing_front_class;

/** Part of the container with sizes of its own. */
typedef struct packing_front_region {
  packing_domain
      *domain;      /**< where: the centre lies inside; NULL where `choose` is given */
  packing_psd *psd; /**< the sizes there */
} packing_front_region;

/** Options of packing_front_create(). */
typedef struct packing_front_def {
  size_t struct_size;      /**< set by packing_front_def_init() */
  packing_front_mode mode; /**< default dense */
  uint64_t seed;           /**< default 1 */
  uint64_t stream;         /**< which pack of that seed; default 0 */
  size_t count;            /**< particles to add; 0 (default): no limit */
  double volume_fraction;  /**< stop when the particles added reach this share of the
       domain's volume, to half a particle [1]; 0 (default): no limit */
  packing_front_direction direction;    /**< default outward */
  packing_front_select select_particle; /**< paper: order of the front; default random */
  packing_front_select
      select_neighbours; /**< paper: order of neighbours; default random */
  const packing_contact_method *contact; /**< paper: how a particle is placed in contact;
       copied; NULL (default): wrappers */
  packing_shape *shape; /**< paper: shape of all particles, turned at random; kept; NULL
       (default): spheres, discs */
  size_t
      stock; /**< fast and dense: radii drawn in advance from which the best is chosen, 1
       to 4096; 0 (default): 64 when fast, 256 when dense, and fewer, down to 16,
       for less than 2e5 particles and for very different sizes */
  const packing_front_class
      *classes;       /**< an exact list instead of a distribution (then psd
       is NULL); copied; NULL (default): none */
  size_t class_count; /**< entries of `classes` */
  const packing_front_region
      *regions;        /**< parts of the container with other sizes; the first
       that holds a centre counts; domains and distributions are kept; NULL (default): none */
  size_t region_count; /**< entries of `regions` */
  size_t (*choose)(void *user, const packing_vec3 *centre); /**< instead of the regions'
       domains: 0 for the distribution of the placer, i for regions[i - 1]; must depend on the
       centre alone, be thread-safe, and live as long as the placer; NULL: none */
  void *user;                                               /**< passed to `choose` */
} packing_front_def;

/** Writes the defaults; called through packing_front_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_front_def_fill(packing_front_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_front_def_init(packing_front_def *def)
{
  packing_front_def_fill(def, sizeof *def);
}

/** Makes a placer by the advancing front. Without count and volume fraction it goes on until
 *  nothing fits. Particles of the store are obstacles and front.
 *
 *  Paper: Perez Morales, Rosello Valera, Recarey et al., Pseudocode 2: a particle of the front,
 *  two neighbours of it (one in 2D), the first place in contact with the three that is inside
 *  and free; a front particle without any is dropped, the pending particle stays. Outward it
 *  starts with three discs or four spheres in contact, the mean of their centres at the innermost
 *  point; where they have no room, at the walls. When the front has run out, it begins again with
 *  such a group wherever the container is still empty, then at the walls, if there is room for a
 *  particle far from all others. Inward the whole boundary is covered first. With a shape the
 *  store gets the column of orientations.
 *
 *  Fast and dense: the places are kept as pockets, triples of bodies with the interval of radii
 *  that fit between them, and the next pocket and its radius are chosen by how well they match;
 *  the sizes come from a stratified stock, so that they stay those of the distribution.
 *  Spheres and walls alike bound centre and radius linearly, which solves contacts in closed
 *  form (doc/methods/front.md).
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container; kept
 *  \param psd radii; kept; NULL with an exact list
 *  \param particles the store, of the domain's dimension; a component column is filled
 *  \param[out] placer the placer
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (a field out of its range,
 *          dimensions that differ, an option of another mode); PACKING_ERR_GEOMETRY (the
 *          smallest particle fits nowhere); PACKING_ERR_UNSUPPORTED; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI
 *
 *  The store is enlarged at once by what is expected. Cost: linear in the particles; beside the
 *  store some 5 bytes a particle, and the front. */
PACKING_API PACKING_WARN_UNUSED packing_status packing_front_create(
    packing_context *context, const packing_front_def *def, packing_domain *domain,
    packing_psd *psd, packing_particles *particles, packing_placer **placer);

/** The particles on the front, for pictures: those that may still get neighbours.
 *  \param placer made by packing_front_create()
 *  \param capacity entries of `index`
 *  \param[out] index of particles in the store, rising, at most `capacity`; NULL is fine with
 *         capacity 0
 *  \param[out] count how many there are
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL, another placer); PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status packing_front_members(
    const packing_placer *placer, size_t capacity, size_t *index, size_t *count);

/** What is left of an exact list.
 *  \param placer made by packing_front_create() with classes
 *  \param[out] counts of `class_count` entries, in the order of the def
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL, another placer, no list) */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_front_unplaced(const packing_placer *placer, size_t *counts);

PACKING_END_DECLS

#endif
