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

#include "front_kernels_body.h"

const packing_i_front_kernels packing_i_front_kernels_avx512 = {gather, bodies,   pairs,
                                                                sieve,  interval, bounds};
#endif
