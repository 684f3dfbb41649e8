/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SOURCE_STRATA_H
#define PACKING_SOURCE_STRATA_H

/* Numbers in (0, 1) that fill it more evenly than chance would. A round takes each of K strata
 * once, in a random order; within a stratum the rounds go by steps of the golden ratio from a
 * random start. Each number by itself is uniform.
 *
 * Of the first N numbers the share below u differs from u by less than
 * (K / 4 + 4 + 3.6 log(1 + N / K)) / N, for every u: the first term is the round that is not
 * complete, the rest the one stratum that u cuts, by theorem 2.3.4 of L. Kuipers and H.
 * Niederreiter, Uniform Distribution of Sequences (1974). By chance it would be 1 / sqrt(N).
 *
 * A second number can be had with each: in each stratum it goes by steps of sqrt 2, so that the
 * pairs fill the square; its ends are cut by up to K strata, each of which errs by itself.
 * Cost: half a block of the generator a number. */

#include "rng/rng_internal.h"

enum { PACKING_I_STRATA_BITS = 6, PACKING_I_STRATA = 1 << PACKING_I_STRATA_BITS };

typedef struct packing_i_strata {
  packing_i_stream stream;
  uint64_t start[PACKING_I_STRATA];  /* of the steps, in 2^-64 of a stratum */
  uint64_t second[PACKING_I_STRATA]; /* of the second number's, in 2^-64 */
  uint64_t round;
  uint32_t taken;                  /* strata of this round */
  uint8_t order[PACKING_I_STRATA]; /* the first `taken` are taken */
} packing_i_strata;

static inline void packing_i_strata_open(packing_i_strata *s, uint64_t seed,
                                         uint64_t stream, uint64_t index)
{
  packing_i_stream_open(&s->stream, seed, stream, PACKING_PURPOSE_SIZE, index);
  for (unsigned k = 0; k < PACKING_I_STRATA; k++) {
    s->start[k] = packing_i_stream_bits(&s->stream);
    s->second[k] = packing_i_stream_bits(&s->stream);
    s->order[k] = (uint8_t)k;
  }
  s->round = 0;
  s->taken = 0;
}

/* The next number, in 2^-64. */
static inline uint64_t packing_i_strata_bits(packing_i_strata *s)
{
  if (s->taken == PACKING_I_STRATA) {
    s->taken = 0;
    s->round++;
  }
  const uint32_t here = s->taken++;
  const uint64_t there =
      here + packing_i_stream_below(&s->stream, PACKING_I_STRATA - here);
  const uint8_t k = s->order[there];
  s->order[there] = s->order[here];
  s->order[here] = k;
  const uint64_t golden = UINT64_C(0x9E3779B97F4A7C15); /* 2^64 / ((1 + sqrt 5) / 2) */
  return (uint64_t)k << (64 - PACKING_I_STRATA_BITS) |
         (s->start[k] + s->round * golden) >> PACKING_I_STRATA_BITS;
}

static inline double packing_i_strata_open_interval(uint64_t bits)
{
  return (double)((bits >> 12) * 2 + 1) * 0x1p-53;
}

/* The next number: an odd multiple of 2^-53, as packing_i_stream_uniform_open(). */
static inline double packing_i_strata_uniform_open(packing_i_strata *s)
{
  return packing_i_strata_open_interval(packing_i_strata_bits(s));
}

/* The second number of the last. */
static inline double packing_i_strata_second(const packing_i_strata *s)
{
  const uint64_t root = UINT64_C(0x6A09E667F3BCC909); /* 2^64 (sqrt 2 - 1) */
  const uint8_t k = s->order[s->taken - 1];
  return packing_i_strata_open_interval(s->second[k] + s->round * root);
}

#endif
