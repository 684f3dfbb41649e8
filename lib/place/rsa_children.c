/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A ball covers a child when it holds the child's farthest corner. The parent's centre is a corner
 * of every child, so only balls that hold it can cover one: they are picked first. */
#include "rsa_children.h"

enum { CHILDREN = 8, ALL = 0xff };

/* Squares of the farthest distance from q, relative to the parent's centre, to the lower and the
 * upper half along an axis. */
static inline double lower2(double q, double h)
{
  const double far = fabs(q + h) + h;
  return far * far;
}

static inline double upper2(double q, double h)
{
  const double far = fabs(q - h) + h;
  return far * far;
}

static inline size_t pick(packing_i_rsa_near_centres *near, packing_vec3 centre,
                          double reach2)
{
  size_t count = 0;
  for (size_t i = 0; i < near->count; i++) {
    const double x = near->x[i] - centre.x, y = near->y[i] - centre.y,
                 z = near->z[i] - centre.z;
    near->holding_x[count] = x;
    near->holding_y[count] = y;
    near->holding_z[count] = z;
    count += x * x + y * y + z * z < reach2; /* no branch: it would be guessed wrong */
  }
  return count;
}

static unsigned children_baseline(packing_i_rsa_near_centres *near, packing_vec3 centre,
                                  packing_vec3 h, double reach2, unsigned covered)
{
  const size_t count = pick(near, centre, reach2);
  for (size_t i = 0; i < count && covered != ALL; i++) {
    const double qx = near->holding_x[i], qy = near->holding_y[i],
                 qz = near->holding_z[i];
    const double x[2] = {lower2(qx, h.x), upper2(qx, h.x)};
    const double y[2] = {lower2(qy, h.y), upper2(qy, h.y)};
    const double z[2] = {lower2(qz, h.z), upper2(qz, h.z)};
    for (unsigned k = 0; k < CHILDREN; k++)
      covered |= (unsigned)(x[k & 1U] + y[k >> 1 & 1U] + z[k >> 2] < reach2) << k;
  }
  return covered;
}

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

__attribute__((target("avx2"))) static unsigned
children_avx2(packing_i_rsa_near_centres *near, packing_vec3 centre, packing_vec3 h,
              double reach2, unsigned covered)
{
  const size_t count = pick(near, centre, reach2);
  const __m256d reach = _mm256_set1_pd(reach2);
  for (size_t i = 0; i < count && covered != ALL; i++) {
    const double qx = near->holding_x[i], qy = near->holding_y[i],
                 qz = near->holding_z[i];
    const double lx = lower2(qx, h.x), ux = upper2(qx, h.x);
    const double ly = lower2(qy, h.y), uy = upper2(qy, h.y);
    const __m256d xy =
        _mm256_add_pd(_mm256_set_pd(ux, lx, ux, lx), _mm256_set_pd(uy, uy, ly, ly));
    const __m256d low = _mm256_add_pd(xy, _mm256_set1_pd(lower2(qz, h.z)));
    const __m256d high = _mm256_add_pd(xy, _mm256_set1_pd(upper2(qz, h.z)));
    covered |= (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(low, reach, _CMP_LT_OQ));
    covered |= (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(high, reach, _CMP_LT_OQ)) << 4;
  }
  return covered;
}

#define PACKING_I_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))

PACKING_I_AVX512 static size_t pick_avx512(packing_i_rsa_near_centres *near,
                                           packing_vec3 centre, double reach2)
{
  const __m512d cx = _mm512_set1_pd(centre.x), cy = _mm512_set1_pd(centre.y),
                cz = _mm512_set1_pd(centre.z), reach = _mm512_set1_pd(reach2);
  size_t count = 0;
  for (size_t i = 0; i < near->count; i += 8) {
    const size_t left = near->count - i;
    const __mmask8 there = (__mmask8)(left < 8 ? (1U << left) - 1U : (unsigned)ALL);
    const __m512d x = _mm512_sub_pd(_mm512_maskz_loadu_pd(there, &near->x[i]), cx);
    const __m512d y = _mm512_sub_pd(_mm512_maskz_loadu_pd(there, &near->y[i]), cy);
    const __m512d z = _mm512_sub_pd(_mm512_maskz_loadu_pd(there, &near->z[i]), cz);
    const __m512d d2 = _mm512_add_pd(
        _mm512_add_pd(_mm512_mul_pd(x, x), _mm512_mul_pd(y, y)), _mm512_mul_pd(z, z));
    const __mmask8 holds = _mm512_mask_cmp_pd_mask(there, d2, reach, _CMP_LT_OQ);
    _mm512_storeu_pd(&near->holding_x[count], _mm512_maskz_compress_pd(holds, x));
    _mm512_storeu_pd(&near->holding_y[count], _mm512_maskz_compress_pd(holds, y));
    _mm512_storeu_pd(&near->holding_z[count], _mm512_maskz_compress_pd(holds, z));
    count += (size_t)__builtin_popcount(holds);
  }
  return count;
}

PACKING_I_AVX512 static unsigned children_avx512(packing_i_rsa_near_centres *near,
                                                 packing_vec3 centre, packing_vec3 h,
                                                 double reach2, unsigned covered)
{
  const size_t count = pick_avx512(near, centre, reach2);
  const __m512d reach = _mm512_set1_pd(reach2);
  for (size_t i = 0; i < count && covered != ALL; i++) {
    const double qx = near->holding_x[i], qy = near->holding_y[i],
                 qz = near->holding_z[i];
    const __m512d x = _mm512_mask_blend_pd(0xaa, _mm512_set1_pd(lower2(qx, h.x)),
                                           _mm512_set1_pd(upper2(qx, h.x)));
    const __m512d y = _mm512_mask_blend_pd(0xcc, _mm512_set1_pd(lower2(qy, h.y)),
                                           _mm512_set1_pd(upper2(qy, h.y)));
    const __m512d z = _mm512_mask_blend_pd(0xf0, _mm512_set1_pd(lower2(qz, h.z)),
                                           _mm512_set1_pd(upper2(qz, h.z)));
    covered |=
        _mm512_cmp_pd_mask(_mm512_add_pd(_mm512_add_pd(x, y), z), reach, _CMP_LT_OQ);
  }
  return covered;
}
#endif

packing_i_rsa_children packing_i_rsa_children_for(packing_isa isa)
{
#if defined(__x86_64__) && defined(__GNUC__)
  if (isa == PACKING_ISA_AVX512)
    return children_avx512;
  if (isa == PACKING_ISA_AVX2)
    return children_avx2;
#endif
  (void)isa;
  return children_baseline;
}
