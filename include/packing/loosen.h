/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_LOOSEN_H
#define PACKING_LOOSEN_H

/** \file packing/loosen.h
 *  Lowering the volume fraction of a finished pack: step 4 of the seed paper's method. */

#include <packing/domain.h>
#include <packing/particles.h>

PACKING_BEGIN_DECLS

/** How a pack is made looser. */
typedef enum packing_loosen_how {
  PACKING_LOOSEN_SHRINK = 0, /**< all radii by one factor: positions stay */
  PACKING_LOOSEN_REMOVE = 1  /**< particles at random: the distribution stays */
} packing_loosen_how;

/** Options of packing_loosen(). */
typedef struct packing_loosen_def {
  size_t struct_size;     /**< set by packing_loosen_def_init() */
  packing_loosen_how how; /**< default shrink */
  double volume_fraction; /**< wanted, of the domain's volume, 0 < v [1] */
  uint64_t seed;          /**< remove: which particles; default 1 */
  uint64_t stream;        /**< default 0 */
} packing_loosen_def;

/** Writes the defaults; called through packing_loosen_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_loosen_def_fill(packing_loosen_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_loosen_def_init(packing_loosen_def *def)
{
  packing_loosen_def_fill(def, sizeof *def);
}

/** Makes a pack looser (seed paper, section 3, step 4; its Figure 12: 5 %, 2.3 %, 1.2 % solids).
 *  Shrinking meets the fraction to rounding. Removing takes particles at random, one from each
 *  of as many equal shares of the order by radius (or keeps one from each, where more than half
 *  go): the sizes removed and kept differ from their share of any range of sizes by about two
 *  particles, and equal ones go without regard to where they stand. A last few, 16 at most, are
 *  chosen by their size to meet the fraction: to half of the smallest particle's volume where so
 *  few can do that, as in every smooth distribution, and always to the largest one's. The volume
 *  of particles is counted whole. What stays keeps its order and its columns. A fraction above
 *  that of the pack by no more than rounding leaves the pack as it is.
 *  \param context NULL is fine
 *  \param def options; volume_fraction has no default
 *  \param domain the container
 *  \param particles the store, left as before on failure
 *  \param[out] reached the fraction reached [1]; NULL is fine
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (how; volume_fraction: above that
 *          of the pack, not > 0, or so small that radii vanish; dimensions that differ);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI
 *  Cost: linear; removing takes 41 bytes a particle meanwhile. */
PACKING_API PACKING_WARN_UNUSED packing_status packing_loosen(
    packing_context *context, const packing_loosen_def *def, const packing_domain *domain,
    packing_particles *particles, double *reached);

PACKING_END_DECLS

#endif
