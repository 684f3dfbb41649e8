/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "philox_batch.h"

static void batch_baseline(uint64_t first, uint64_t index, const uint32_t key[2],
                           uint32_t word[4][PACKING_I_PHILOX_BATCH])
{
  for (unsigned i = 0; i < PACKING_I_PHILOX_BATCH; i++) {
    const uint64_t block = first + i;
    const uint32_t counter[4] = {(uint32_t)block, (uint32_t)(block >> 32),
                                 (uint32_t)index, (uint32_t)(index >> 32)};
    uint32_t out[4];
    packing_i_philox(counter, key, out);
    for (unsigned w = 0; w < 4; w++)
      word[w][i] = out[w];
  }
}

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

/* A word stands in the low half of a 64-bit lane; what gathers in the high half is never looked
 * at, because products take the low half only. */

__attribute__((target("avx2"))) static void
batch_avx2(uint64_t first, uint64_t index, const uint32_t key[2],
           uint32_t word[4][PACKING_I_PHILOX_BATCH])
{
  const __m256i m0 = _mm256_set1_epi64x(0xD2511F53), m1 = _mm256_set1_epi64x(0xCD9E8D57);
  for (unsigned i = 0; i < PACKING_I_PHILOX_BATCH; i += 4) {
    const uint64_t b = first + i;
    __m256i c0 =
        _mm256_add_epi64(_mm256_set1_epi64x((long long)b), _mm256_set_epi64x(3, 2, 1, 0));
    __m256i c1 = _mm256_srli_epi64(c0, 32);
    __m256i c2 = _mm256_set1_epi64x((long long)index), c3 = _mm256_srli_epi64(c2, 32);
    uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < PACKING_I_PHILOX_ROUNDS; round++) {
      const __m256i p0 = _mm256_mul_epu32(c0, m0), p1 = _mm256_mul_epu32(c2, m1);
      c0 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p1, 32), c1),
                            _mm256_set1_epi64x(k0));
      c2 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p0, 32), c3),
                            _mm256_set1_epi64x(k1));
      c1 = p1;
      c3 = p0;
      k0 += UINT32_C(0x9E3779B9);
      k1 += UINT32_C(0xBB67AE85);
    }
    const __m256i all[4] = {c0, c1, c2, c3};
    const __m256i even = _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6);
    for (unsigned w = 0; w < 4; w++)
      _mm_storeu_si128((__m128i *)(void *)&word[w][i],
                       _mm256_castsi256_si128(_mm256_permutevar8x32_epi32(all[w], even)));
  }
}

__attribute__((target("avx512f,avx512bw,avx512dq,avx512vl"))) static void
batch_avx512(uint64_t first, uint64_t index, const uint32_t key[2],
             uint32_t word[4][PACKING_I_PHILOX_BATCH])
{
  const __m512i m0 = _mm512_set1_epi64(0xD2511F53), m1 = _mm512_set1_epi64(0xCD9E8D57);
  const __m512i steps = _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7);
  for (unsigned i = 0; i < PACKING_I_PHILOX_BATCH; i += 8) {
    const uint64_t b = first + i;
    __m512i c0 = _mm512_add_epi64(_mm512_set1_epi64((long long)b), steps);
    __m512i c1 = _mm512_srli_epi64(c0, 32);
    __m512i c2 = _mm512_set1_epi64((long long)index), c3 = _mm512_srli_epi64(c2, 32);
    uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < PACKING_I_PHILOX_ROUNDS; round++) {
      const __m512i p0 = _mm512_mul_epu32(c0, m0), p1 = _mm512_mul_epu32(c2, m1);
      c0 = _mm512_xor_si512(_mm512_xor_si512(_mm512_srli_epi64(p1, 32), c1),
                            _mm512_set1_epi64(k0));
      c2 = _mm512_xor_si512(_mm512_xor_si512(_mm512_srli_epi64(p0, 32), c3),
                            _mm512_set1_epi64(k1));
      c1 = p1;
      c3 = p0;
      k0 += UINT32_C(0x9E3779B9);
      k1 += UINT32_C(0xBB67AE85);
    }
    _mm256_storeu_si256((__m256i *)(void *)&word[0][i], _mm512_cvtepi64_epi32(c0));
    _mm256_storeu_si256((__m256i *)(void *)&word[1][i], _mm512_cvtepi64_epi32(c1));
    _mm256_storeu_si256((__m256i *)(void *)&word[2][i], _mm512_cvtepi64_epi32(c2));
    _mm256_storeu_si256((__m256i *)(void *)&word[3][i], _mm512_cvtepi64_epi32(c3));
  }
}
#endif

packing_i_philox_batch packing_i_philox_batch_for(packing_isa isa)
{
#if defined(__x86_64__) && defined(__GNUC__)
  if (isa == PACKING_ISA_AVX512)
    return batch_avx512;
  if (isa == PACKING_ISA_AVX2)
    return batch_avx2;
#endif
  (void)isa;
  return batch_baseline;
}
