/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper's kernels for AVX-512: eight pairs at a time. Records are loaded whole and
 * transposed in registers. */
#include "stepper_internal.h"
#include <string.h>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

#define TARGET __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
#define WIDTH 8
typedef __m512d vector;
typedef __mmask8 mask;

TARGET static inline vector vector_all(double a)
{
  return _mm512_set1_pd(a);
}

TARGET static inline vector vector_load(const double *p)
{
  return _mm512_load_pd(p);
}

TARGET static inline void vector_store(double *p, vector v)
{
  _mm512_store_pd(p, v);
}

TARGET static inline vector vector_sqrt(vector v)
{
  return _mm512_sqrt_pd(v);
}

TARGET static inline vector vector_least0(vector v)
{
  return _mm512_max_pd(v, _mm512_setzero_pd());
}

TARGET static inline vector vector_image(vector v, double period, double half)
{
  const vector p = _mm512_set1_pd(period);
  const mask over = _mm512_cmp_pd_mask(v, _mm512_set1_pd(half), _CMP_GT_OQ);
  const mask under = _mm512_cmp_pd_mask(v, _mm512_set1_pd(-half), _CMP_LT_OQ);
  return _mm512_mask_sub_pd(_mm512_mask_add_pd(v, under, v, p), over, v, p);
}

TARGET static inline mask vector_less(vector a, vector b, unsigned lanes)
{
  return _mm512_mask_cmp_pd_mask((mask)((1U << lanes) - 1U), a, b, _CMP_LT_OQ);
}

TARGET static inline void vector_pack(double *p, vector v, mask m)
{
  _mm512_storeu_pd(p, _mm512_maskz_compress_pd(m, v));
}

TARGET static inline void index_pack(uint32_t *p, const uint32_t *q, mask m)
{
  const __m256i v = _mm256_loadu_si256((const __m256i *)(const void *)q);
  _mm256_storeu_si256((__m256i *)(void *)p, _mm256_maskz_compress_epi32(m, v));
}

TARGET static inline void slot_pack(uint32_t *p, uint32_t first, mask m)
{
  const __m256i v = _mm256_add_epi32(_mm256_set1_epi32((int)first),
                                     _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256((__m256i *)(void *)p, _mm256_maskz_compress_epi32(m, v));
}

TARGET static inline size_t mask_count(mask m)
{
  return (size_t)__builtin_popcount(m);
}

TARGET static inline vector two_records(const double *a, const double *b)
{
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(a)), _mm256_load_pd(b),
                            1);
}

TARGET static inline void records_load(const double *base, size_t stride,
                                       const uint32_t *index, vector v[4])
{
  vector r[4];
  for (unsigned k = 0; k < 4; k++)
    r[k] = two_records(base + stride * index[k], base + stride * index[k + 4]);
  const vector a = _mm512_unpacklo_pd(r[0], r[1]), b = _mm512_unpackhi_pd(r[0], r[1]);
  const vector c = _mm512_unpacklo_pd(r[2], r[3]), d = _mm512_unpackhi_pd(r[2], r[3]);
  const __m512i even = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i odd = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  v[0] = _mm512_permutex2var_pd(a, even, c);
  v[1] = _mm512_permutex2var_pd(b, even, d);
  v[2] = _mm512_permutex2var_pd(a, odd, c);
  v[3] = _mm512_permutex2var_pd(b, odd, d);
}

/* Columns x y z and 0 to rows: row[0] = records 0 and 2, row[1] = 1 and 3, row[2] = 4 and 6,
 * row[3] = 5 and 7. */
TARGET static inline void rows(const vector v[3], vector row[4])
{
  const vector none = _mm512_setzero_pd();
  const vector a = _mm512_unpacklo_pd(v[0], v[1]), b = _mm512_unpackhi_pd(v[0], v[1]);
  const vector c = _mm512_unpacklo_pd(v[2], none), d = _mm512_unpackhi_pd(v[2], none);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
  const __m512i high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
  row[0] = _mm512_permutex2var_pd(a, low, c);
  row[1] = _mm512_permutex2var_pd(b, low, d);
  row[2] = _mm512_permutex2var_pd(a, high, c);
  row[3] = _mm512_permutex2var_pd(b, high, d);
}

/* Records of force and moment, in their order. */
TARGET static inline void eight_records(const vector v[6], vector record[8])
{
  static const unsigned char place[4] = {0, 1, 4,
                                         5}; /* and the second of each, 2 later */
  vector f[4], t[4];
  rows(v, f);
  rows(v + 3, t);
  for (unsigned k = 0; k < 4; k++) {
    record[place[k]] = _mm512_shuffle_f64x2(f[k], t[k], 0x44);
    record[place[k] + 2] = _mm512_shuffle_f64x2(f[k], t[k], 0xee);
  }
}

TARGET static inline void add_to(double *p, vector v)
{
  _mm512_store_pd(p, _mm512_add_pd(_mm512_load_pd(p), v));
}

TARGET static inline void records_add(double *base, const uint32_t *i, const uint32_t *j,
                                      unsigned lanes, const vector v[6],
                                      const vector w[6])
{
  vector on_i[8], on_j[8];
  eight_records(v, on_i);
  eight_records(w, on_j);
  if (lanes == WIDTH) { /* unrolled, the records stay in registers */
#pragma GCC unroll 8
    for (unsigned k = 0; k < WIDTH; k++) {
      add_to(base + (size_t)PACKING_I_FORCE * i[k], on_i[k]);
      add_to(base + (size_t)PACKING_I_FORCE * j[k], on_j[k]);
    }
    return;
  }
  for (unsigned k = 0; k < lanes; k++) {
    add_to(base + (size_t)PACKING_I_FORCE * i[k], on_i[k]);
    add_to(base + (size_t)PACKING_I_FORCE * j[k], on_j[k]);
  }
}

#include "kernels_body.h"

const packing_i_kernels packing_i_kernels_avx512 = {screen, motion, add, advance};
#endif
