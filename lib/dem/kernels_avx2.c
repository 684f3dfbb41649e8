/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper's kernels for AVX2: four pairs at a time. */
#include "stepper_internal.h"
#include <string.h>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

#define TARGET __attribute__((target("avx2")))
#define WIDTH 4
typedef __m256d vector;
typedef unsigned mask;

TARGET static inline vector vector_all(double a)
{
  return _mm256_set1_pd(a);
}

TARGET static inline vector vector_load(const double *p)
{
  return _mm256_load_pd(p);
}

TARGET static inline void vector_store(double *p, vector v)
{
  _mm256_store_pd(p, v);
}

TARGET static inline vector vector_sqrt(vector v)
{
  return _mm256_sqrt_pd(v);
}

TARGET static inline vector vector_least0(vector v)
{
  return _mm256_max_pd(v, _mm256_setzero_pd());
}

TARGET static inline vector vector_image(vector v, double period, double half)
{
  const vector p = _mm256_set1_pd(period);
  const vector over = _mm256_cmp_pd(v, _mm256_set1_pd(half), _CMP_GT_OQ);
  const vector under = _mm256_cmp_pd(v, _mm256_set1_pd(-half), _CMP_LT_OQ);
  const vector lower = _mm256_blendv_pd(v, _mm256_add_pd(v, p), under);
  return _mm256_blendv_pd(lower, _mm256_sub_pd(v, p), over);
}

TARGET static inline mask vector_less(vector a, vector b, unsigned lanes)
{
  return (mask)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ)) & ((1U << lanes) - 1U);
}

TARGET static inline void vector_pack(double *p, vector v, mask m)
{
  double lane[WIDTH];
  _mm256_storeu_pd(lane, v);
  for (unsigned k = 0; k < WIDTH; k++) {
    *p = lane[k];
    p += m >> k & 1U;
  }
}

TARGET static inline void index_pack(uint32_t *p, const uint32_t *q, mask m)
{
  for (unsigned k = 0; k < WIDTH; k++) {
    *p = q[k];
    p += m >> k & 1U;
  }
}

TARGET static inline void slot_pack(uint32_t *p, uint32_t first, mask m)
{
  for (unsigned k = 0; k < WIDTH; k++) {
    *p = first + k;
    p += m >> k & 1U;
  }
}

TARGET static inline size_t mask_count(mask m)
{
  return (size_t)__builtin_popcount(m);
}

/* Rows to columns; its own inverse. */
TARGET static inline void transpose(const vector from[4], vector to[4])
{
  const vector a = _mm256_unpacklo_pd(from[0], from[1]);
  const vector b = _mm256_unpackhi_pd(from[0], from[1]);
  const vector c = _mm256_unpacklo_pd(from[2], from[3]);
  const vector d = _mm256_unpackhi_pd(from[2], from[3]);
  to[0] = _mm256_permute2f128_pd(a, c, 0x20);
  to[1] = _mm256_permute2f128_pd(b, d, 0x20);
  to[2] = _mm256_permute2f128_pd(a, c, 0x31);
  to[3] = _mm256_permute2f128_pd(b, d, 0x31);
}

TARGET static inline void records_load(const double *base, size_t stride,
                                       const uint32_t *index, vector v[4])
{
  vector row[4];
  for (unsigned k = 0; k < WIDTH; k++)
    row[k] = _mm256_load_pd(base + stride * index[k]);
  transpose(row, v);
}

TARGET static inline void add_to(double *p, vector v)
{
  _mm256_store_pd(p, _mm256_add_pd(_mm256_load_pd(p), v));
}

TARGET static inline void records_add(double *base, const uint32_t *i, const uint32_t *j,
                                      unsigned lanes, const vector v[6],
                                      const vector w[6])
{
  const vector none = _mm256_setzero_pd();
  vector fi[4] = {v[0], v[1], v[2], none}, ti[4] = {v[3], v[4], v[5], none};
  vector fj[4] = {w[0], w[1], w[2], none}, tj[4] = {w[3], w[4], w[5], none};
  transpose(fi, fi);
  transpose(ti, ti);
  transpose(fj, fj);
  transpose(tj, tj);
  for (unsigned k = 0; k < lanes; k++) {
    double *a = base + (size_t)PACKING_I_FORCE * i[k];
    double *b = base + (size_t)PACKING_I_FORCE * j[k];
    add_to(a, fi[k]);
    add_to(a + 4, ti[k]);
    add_to(b, fj[k]);
    add_to(b + 4, tj[k]);
  }
}

#include "kernels_body.h"

const packing_i_kernels packing_i_kernels_avx2 = {screen, motion, add, advance};
#endif
