/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pocket front's kernels for AVX2. */
#include "front_kernels.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

#define TARGET __attribute__((target("avx2,bmi,bmi2")))

TARGET static inline void take_root(packing_i_front_vector *v)
{
  double *half = (double *)v;
  _mm256_store_pd(half, _mm256_sqrt_pd(_mm256_load_pd(half)));
  _mm256_store_pd(half + 4, _mm256_sqrt_pd(_mm256_load_pd(half + 4)));
}

TARGET static inline unsigned mask_bits(const packing_i_front_mask *m)
{
  const double *half = (const double *)m;
  return (unsigned)_mm256_movemask_pd(_mm256_load_pd(half)) |
         (unsigned)_mm256_movemask_pd(_mm256_load_pd(half + 4)) << 4;
}

TARGET static inline void pack(double *to, const packing_i_front_vector *v, unsigned bits)
{
  for (const double *from = (const double *)v; bits != 0; bits &= bits - 1)
    *to++ = from[__builtin_ctz(bits)];
}

TARGET static inline void pack_numbers(uint32_t *to, uint32_t first, unsigned bits)
{
  for (; bits != 0; bits &= bits - 1)
    *to++ = first + (uint32_t)__builtin_ctz(bits);
}

#include "front_kernels_body.h"

const packing_i_front_kernels packing_i_front_kernels_avx2 = {
    gather, bodies, caps, pairs, sieve, interval, bounds};
#endif
