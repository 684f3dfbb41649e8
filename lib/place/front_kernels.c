/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pocket front's kernels for every machine, and the choice of a set. */
#include "front_kernels.h"

#define TARGET

static inline void take_root(packing_i_front_vector *v)
{
  for (unsigned k = 0; k < PACKING_I_FRONT_WIDTH; k++)
    (*v)[k] = sqrt((*v)[k]);
}

static inline unsigned mask_bits(const packing_i_front_mask *m)
{
  unsigned bits = 0;
  for (unsigned k = 0; k < PACKING_I_FRONT_WIDTH; k++)
    bits |= (unsigned)((*m)[k] & 1) << k;
  return bits;
}

static inline void pack(double *to, const packing_i_front_vector *v, unsigned bits)
{
  for (const double *from = (const double *)v; bits != 0; bits &= bits - 1)
    *to++ = from[__builtin_ctz(bits)];
}

static inline void pack_numbers(uint32_t *to, uint32_t first, unsigned bits)
{
  for (; bits != 0; bits &= bits - 1)
    *to++ = first + (uint32_t)__builtin_ctz(bits);
}

#include "front_kernels_body.h"

const packing_i_front_kernels packing_i_front_kernels_baseline = {
    gather, bodies, caps, pairs, sieve, interval, bounds};

const packing_i_front_kernels *packing_i_front_kernels_for(packing_isa isa)
{
#if defined(__x86_64__) && defined(__GNUC__)
  if (isa == PACKING_ISA_AVX512)
    return &packing_i_front_kernels_avx512;
  if (isa == PACKING_ISA_AVX2)
    return &packing_i_front_kernels_avx2;
#endif
  (void)isa;
  return &packing_i_front_kernels_baseline;
}
