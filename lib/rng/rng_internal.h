/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RNG_INTERNAL_H
#define PACKING_RNG_INTERNAL_H

/* Streams of random numbers as plain values: no allocation, nothing shared, everything inline.
 *
 * Philox4x32-10: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers:
 * as easy as 1, 2, 3", SC11 (2011), section 4.4. One block is 10 rounds of two 32 x 32 -> 64
 * bit products and gives 128 bits.
 *
 * Names of streams: the key is the first half of philox(counter = {seed, stream}, key =
 * {purpose, tag}), the counter is {block, index}, 64 bits each. For one (seed, stream, purpose)
 * the streams of two indices thus never share a counter; two different (seed, stream, purpose)
 * share a key with probability 2^-64. */

#include <gsl/gsl_rng.h>
#include <packing/rng.h>

enum {
  PACKING_I_PHILOX_ROUNDS = 10,
  PACKING_I_STREAM_TAG = 0x7061636b /* "pack": sets our keys apart from a bare Philox */
};

/* out = Philox4x32-10 of a counter under a key. */
static inline void packing_i_philox(const uint32_t counter[4], const uint32_t key[2],
                                    uint32_t out[4])
{
  uint32_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
  uint32_t k0 = key[0], k1 = key[1];
  for (int round = 0; round < PACKING_I_PHILOX_ROUNDS; round++) {
    const uint64_t p0 = (uint64_t)c0 * UINT32_C(0xD2511F53);
    const uint64_t p1 = (uint64_t)c2 * UINT32_C(0xCD9E8D57);
    c0 = (uint32_t)(p1 >> 32) ^ c1 ^ k0;
    c2 = (uint32_t)(p0 >> 32) ^ c3 ^ k1;
    c1 = (uint32_t)p1;
    c3 = (uint32_t)p0;
    k0 += UINT32_C(0x9E3779B9);
    k1 += UINT32_C(0xBB67AE85);
  }
  out[0] = c0;
  out[1] = c1;
  out[2] = c2;
  out[3] = c3;
}

/* A stream; 40 bytes, copied freely (a copy goes on from the same place). */
typedef struct packing_i_stream {
  uint32_t key[2];
  uint64_t index;
  uint64_t block;  /* the next one */
  uint64_t spare;  /* second half of the last one */
  uint64_t spares; /* 1: `spare` is still to be handed out */
} packing_i_stream;

static inline void packing_i_stream_open(packing_i_stream *s, uint64_t seed,
                                         uint64_t stream, uint32_t purpose,
                                         uint64_t index)
{
  const uint32_t counter[4] = {(uint32_t)seed, (uint32_t)(seed >> 32), (uint32_t)stream,
                               (uint32_t)(stream >> 32)};
  const uint32_t key[2] = {purpose, PACKING_I_STREAM_TAG};
  uint32_t hash[4];
  packing_i_philox(counter, key, hash);
  s->key[0] = hash[0];
  s->key[1] = hash[1];
  s->index = index;
  s->block = 0;
  s->spare = 0;
  s->spares = 0;
}

/* 64 random bits. */
static inline uint64_t packing_i_stream_bits(packing_i_stream *s)
{
  if (s->spares != 0) {
    s->spares = 0;
    return s->spare;
  }
  const uint32_t counter[4] = {(uint32_t)s->block, (uint32_t)(s->block >> 32),
                               (uint32_t)s->index, (uint32_t)(s->index >> 32)};
  uint32_t out[4];
  packing_i_philox(counter, s->key, out);
  s->block++;
  s->spare = (uint64_t)out[3] << 32 | out[2];
  s->spares = 1;
  return (uint64_t)out[1] << 32 | out[0];
}

/* [0, 1): a multiple of 2^-53. */
static inline double packing_i_stream_uniform(packing_i_stream *s)
{
  return (double)(packing_i_stream_bits(s) >> 11) * 0x1p-53;
}

/* (0, 1): an odd multiple of 2^-53. */
static inline double packing_i_stream_uniform_open(packing_i_stream *s)
{
  return (double)((packing_i_stream_bits(s) >> 12) * 2 + 1) * 0x1p-53;
}

/* The high and the low half of a product. */
static inline uint64_t packing_i_multiply(uint64_t a, uint64_t b, uint64_t *low)
{
  const uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
  const uint64_t middle = a1 * b0 + (a0 * b0 >> 32);
  const uint64_t other = a0 * b1 + (uint32_t)middle;
  *low = a * b;
  return a1 * b1 + (middle >> 32) + (other >> 32);
}

/* [0, bound) without bias, bound > 0: D. Lemire, "Fast random integer generation in an
 * interval", ACM Trans. Model. Comput. Simul. 29, 3 (2019). */
static inline uint64_t packing_i_stream_below(packing_i_stream *s, uint64_t bound)
{
  uint64_t low;
  uint64_t high = packing_i_multiply(packing_i_stream_bits(s), bound, &low);
  if (low < bound) {
    const uint64_t least = (0 - bound) % bound; /* 2^64 mod bound */
    while (low < least)
      high = packing_i_multiply(packing_i_stream_bits(s), bound, &low);
  }
  return high;
}

/* The generator as GSL sees it: 32 bits a call. Its state is a packing_i_stream. */
extern const gsl_rng_type packing_i_gsl_philox;

/* The stream inside the public handle. */
packing_i_stream *packing_i_rng_stream(packing_rng *rng);

/* A GSL generator that draws from the stream; valid as long as the stream is. */
static inline gsl_rng packing_i_stream_gsl(packing_i_stream *s)
{
  gsl_rng rng = {&packing_i_gsl_philox, s};
  return rng;
}

#endif
