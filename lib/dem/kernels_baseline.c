/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper's kernels in plain C: one pair at a time. */
#include "stepper_internal.h"
#include <string.h>

#define TARGET
#define WIDTH 1
typedef double vector;
typedef unsigned mask;

static inline vector vector_all(double a)
{
  return a;
}

static inline vector vector_load(const double *p)
{
  return *p;
}

static inline void vector_store(double *p, vector v)
{
  *p = v;
}

static inline vector vector_sqrt(vector v)
{
  return sqrt(v);
}

static inline vector vector_least0(vector v)
{
  return v > 0 ? v : 0;
}

static inline vector vector_image(vector v, double period, double half)
{
  return packing_i_dem_image(v, period, half);
}

static inline mask vector_less(vector a, vector b, unsigned lanes)
{
  (void)lanes;
  return a < b;
}

/* What is not wanted is overwritten by the next. */
static inline void vector_pack(double *p, vector v, mask m)
{
  (void)m;
  *p = v;
}

static inline void index_pack(uint32_t *p, const uint32_t *q, mask m)
{
  (void)m;
  *p = *q;
}

static inline void slot_pack(uint32_t *p, uint32_t first, mask m)
{
  (void)m;
  *p = first;
}

static inline size_t mask_count(mask m)
{
  return m;
}

static inline void records_load(const double *base, size_t stride, const uint32_t *index,
                                vector v[4])
{
  for (int k = 0; k < 4; k++)
    v[k] = base[stride * *index + (size_t)k];
}

static inline void records_add(double *base, const uint32_t *i, const uint32_t *j,
                               unsigned lanes, const vector v[6], const vector w[6])
{
  (void)lanes;
  double *a = base + (size_t)PACKING_I_FORCE * *i,
         *b = base + (size_t)PACKING_I_FORCE * *j;
  for (int k = 0; k < 3; k++) {
    a[k] += v[k];
    a[k + 4] += v[k + 3];
  }
  for (int k = 0; k < 3; k++) {
    b[k] += w[k];
    b[k + 4] += w[k + 3];
  }
}

#include "kernels_body.h"

const packing_i_kernels packing_i_kernels_baseline = {screen, motion, add, advance};

const packing_i_kernels *packing_i_kernels_for(packing_isa isa)
{
#if defined(__x86_64__) && defined(__GNUC__)
  if (isa == PACKING_ISA_AVX512)
    return &packing_i_kernels_avx512;
  if (isa == PACKING_ISA_AVX2)
    return &packing_i_kernels_avx2;
#endif
  (void)isa;
  return &packing_i_kernels_baseline;
}
