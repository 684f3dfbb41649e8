/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RNG_H
#define PACKING_RNG_H

/** \file packing/rng.h
 *  Random streams: Philox4x32-10 (Salmon, Moraes, Dror, Shaw, SC11), a counter-based
 *  generator. A stream is named by (seed, purpose, index) and is independent of every other
 *  and of the order in which streams are used, so results do not depend on threads. */

#include <packing/base.h>

PACKING_BEGIN_DECLS

/** What a stream is drawn for. Users take any value from ::PACKING_PURPOSE_USER on. */
enum {
  PACKING_PURPOSE_SIZE = 1,     /**< radii of a placer */
  PACKING_PURPOSE_POSITION = 2, /**< positions of a placer */
  PACKING_PURPOSE_SAMPLE = 3,   /**< estimates by sampling */
  PACKING_PURPOSE_USER = 1024   /**< the first free value */
};

/** A random stream; one owner. */
typedef struct packing_rng packing_rng;

/** Opens a stream at its beginning. A stream holds 2^65 draws of 64 bits.
 *  \param context NULL is fine
 *  \param seed any value
 *  \param purpose one of the PACKING_PURPOSE_ values or the user's own
 *  \param index which stream of that purpose (a particle, a pack, a block)
 *  \param[out] rng the stream
 *  \return PACKING_OK; PACKING_ERR_NOMEM; PACKING_ERR_INVALID (rng NULL) */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_rng_create(packing_context *context, uint64_t seed, uint32_t purpose,
                   uint64_t index, packing_rng **rng);

/** Closes a stream.
 *  \param rng NULL is fine */
PACKING_API void packing_rng_destroy(packing_rng *rng);

/** Draws 64 random bits.
 *  \param rng the stream
 *  \return uniform over all values */
PACKING_API uint64_t packing_rng_bits(packing_rng *rng);

/** Draws from [0, 1): a multiple of 2^-53.
 *  \param rng the stream
 *  \return uniform, never 1 */
PACKING_API double packing_rng_uniform(packing_rng *rng);

/** Draws from (0, 1): an odd multiple of 2^-53.
 *  \param rng the stream
 *  \return uniform, never 0 or 1 */
PACKING_API double packing_rng_uniform_open(packing_rng *rng);

/** Draws an integer without bias (Lemire's method).
 *  \param rng the stream
 *  \param bound at least 1 (0 gives 0)
 *  \return uniform over [0, bound) */
PACKING_API uint64_t packing_rng_below(packing_rng *rng, uint64_t bound);

/** Draws from the standard normal distribution (GSL's ziggurat).
 *  \param rng the stream
 *  \return mean 0, variance 1 */
PACKING_API double packing_rng_normal(packing_rng *rng);

PACKING_END_DECLS

#endif
