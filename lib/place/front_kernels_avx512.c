/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pocket front's kernels for AVX-512. */
#include "front_kernels.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

#define TARGET __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,bmi,bmi2")))

TARGET static inline void take_root(packing_i_front_vector *v)
{
  *v = (packing_i_front_vector)_mm512_sqrt_pd((__m512d)*v);
}

TARGET static inline unsigned mask_bits(const packing_i_front_mask *m)
{
  return (unsigned)_mm512_movepi64_mask((__m512i)*m);
}

TARGET static inline void pack(double *to, const packing_i_front_vector *v, unsigned bits)
{
  _mm512_storeu_pd(to, _mm512_maskz_compress_pd((__mmask8)bits, (__m512d)*v));
}

TARGET static inline void pack_numbers(uint32_t *to, uint32_t first, unsigned bits)
{
  const __m256i all = _mm256_add_epi32(_mm256_set1_epi32((int)first),
                                       _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256((__m256i *)(void *)to,
                      _mm256_maskz_compress_epi32((__mmask8)bits, all));
}

#include "front_kernels_body.h"

const packing_i_front_kernels packing_i_front_kernels_avx512 = {
    gather, bodies, caps, pairs, sieve, interval, bounds};
#endif
