/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_LAW_KERNEL_H
#define PACKING_LAW_KERNEL_H

/* A law's loop is written once, in plain C with + - * / and sqrt only, and compiled for each
 * instruction set. The compiler turns it into vectors; since each operation rounds by itself,
 * all of them give the same bytes. */

#include "dem_internal.h"

#if defined(__GNUC__)
/* Inlined into every instantiation, so that it is compiled for its instruction set. */
#define PACKING_I_LOOP static inline __attribute__((always_inline))
/* An array of a batch. */
#define PACKING_I_ALIGNED(array) __builtin_assume_aligned((array), 64)
#else
#define PACKING_I_LOOP static inline
#define PACKING_I_ALIGNED(array) (array)
#endif

#if defined(__x86_64__) && defined(__GNUC__)
#define PACKING_I_AVX2 __attribute__((target("avx2")))
#if defined(__clang__)
#define PACKING_I_AVX512                                                                 \
  __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl"), min_vector_width(512)))
#else
#define PACKING_I_AVX512                                                                 \
  __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")))
#endif

/* Defines noun_for(isa), which picks among the instantiations of loop(user, batch). */
#define PACKING_I_LAW_KERNELS(noun, loop)                                                \
  static void noun##_baseline(void *user, const packing_contact_batch *batch)            \
  {                                                                                      \
    loop(user, batch);                                                                   \
  }                                                                                      \
  PACKING_I_AVX2 static void noun##_avx2(void *user, const packing_contact_batch *batch) \
  {                                                                                      \
    loop(user, batch);                                                                   \
  }                                                                                      \
  PACKING_I_AVX512 static void noun##_avx512(void *user,                                 \
                                             const packing_contact_batch *batch)         \
  {                                                                                      \
    loop(user, batch);                                                                   \
  }                                                                                      \
  static packing_law_function noun##_for(packing_isa isa)                                \
  {                                                                                      \
    return isa == PACKING_ISA_AVX512 ? noun##_avx512                                     \
           : isa == PACKING_ISA_AVX2 ? noun##_avx2                                       \
                                     : noun##_baseline;                                  \
  }
#else
#define PACKING_I_LAW_KERNELS(noun, loop)                                                \
  static void noun##_baseline(void *user, const packing_contact_batch *batch)            \
  {                                                                                      \
    loop(user, batch);                                                                   \
  }                                                                                      \
  static packing_law_function noun##_for(packing_isa isa)                                \
  {                                                                                      \
    (void)isa;                                                                           \
    return noun##_baseline;                                                              \
  }
#endif

/* Entries to work on: whole vectors, so that no rest is left over. */
static inline size_t packing_i_padded(size_t count)
{
  return (count + 7) & ~(size_t)7;
}

#endif
