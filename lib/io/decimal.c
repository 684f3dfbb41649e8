/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scaling by powers of ten: the short product, and whole numbers of full length for the rest.
 * See decimal_internal.h. */
#include "decimal_internal.h"
#include <string.h>

/* a * b: the high half is returned. Four products of 32 bits, so that any C11 will do. */
static uint64_t multiply(uint64_t a, uint64_t b, uint64_t *low)
{
  const uint64_t mask = UINT32_MAX;
  const uint64_t ll = (a & mask) * (b & mask);
  const uint64_t lh = (a & mask) * (b >> 32);
  const uint64_t hl = (a >> 32) * (b & mask);
  const uint64_t middle = (ll >> 32) + (lh & mask) + (hl & mask);
  *low = (middle << 32) | (ll & mask);
  return (a >> 32) * (b >> 32) + (lh >> 32) + (hl >> 32) + (middle >> 32);
}

/* floor(q log2 10), for q of the table. */
static int floor_log2_pow10(int q)
{
  return q * 217706 >> 16;
}

packing_i_scaled packing_i_scale10(uint64_t m, int q)
{
  const uint64_t *power = packing_i_pow10[q - PACKING_I_POW10_MIN];
  packing_i_scaled s;
  uint64_t carry;
  s.hi = multiply(m, power[0], &s.lo);
  carry = multiply(m, power[1], &s.low);
  s.lo += carry;
  s.hi += s.lo < carry;
  s.exp2 = floor_log2_pow10(q) - 63;
  s.exact = q >= 0 && q <= 55; /* 5^55 < 2^128 */
  return s;
}

packing_i_rounding packing_i_round_scaled(const packing_i_scaled *s, int shift,
                                          uint64_t *kept)
{
  const uint64_t half = UINT64_C(1) << (shift - 65);
  const uint64_t rest = s->hi & (half + half - 1); /* at shift 128, half + half is 0 */
  *kept = shift == 128 ? 0 : s->hi >> (shift - 64);
  if (rest == half && s->lo == 0) {
    if (!s->exact)
      return PACKING_I_ROUND_UNSURE;
    return s->low == 0 ? PACKING_I_ROUND_TIE : PACKING_I_ROUND_UP;
  }
  if (rest == half - 1 && s->lo == UINT64_MAX && !s->exact)
    return PACKING_I_ROUND_UNSURE;
  return rest >= half ? PACKING_I_ROUND_UP : PACKING_I_ROUND_DOWN;
}

void packing_i_big_set(packing_i_big *big, uint64_t v)
{
  big->count = 2;
  big->limb[0] = (uint32_t)v;
  big->limb[1] = (uint32_t)(v >> 32);
}

void packing_i_big_muladd(packing_i_big *big, uint32_t factor, uint32_t term)
{
  uint64_t carry = term;
  for (unsigned i = 0; i < big->count; i++) {
    carry += (uint64_t)big->limb[i] * factor;
    big->limb[i] = (uint32_t)carry;
    carry >>= 32;
  }
  if (carry != 0)
    big->limb[big->count++] = (uint32_t)carry;
}

static void big_times_pow5(packing_i_big *big, int power)
{
  enum { STEP = 13 };
  for (; power >= STEP; power -= STEP)
    packing_i_big_muladd(big, 1220703125U, 0); /* 5^13 */
  for (; power > 0; power--)
    packing_i_big_muladd(big, 5, 0);
}

static void big_shift(packing_i_big *big, int bits)
{
  const unsigned limbs = (unsigned)bits / 32;
  packing_i_big_muladd(big, UINT32_C(1) << bits % 32, 0);
  memmove(big->limb + limbs, big->limb, big->count * sizeof big->limb[0]);
  memset(big->limb, 0, limbs * sizeof big->limb[0]);
  big->count += limbs;
}

static void big_trim(packing_i_big *big)
{
  while (big->count > 0 && big->limb[big->count - 1] == 0)
    big->count--;
}

int packing_i_big_compare(packing_i_big *a, int a2, int a10, packing_i_big *b)
{
  big_times_pow5(a10 >= 0 ? a : b, a10 >= 0 ? a10 : -a10);
  const int shift = a2 + a10;
  big_trim(a);
  big_trim(b);
  big_shift(shift >= 0 ? a : b, shift >= 0 ? shift : -shift);
  if (a->count != b->count)
    return a->count < b->count ? -1 : 1;
  for (unsigned i = a->count; i-- > 0;)
    if (a->limb[i] != b->limb[i])
      return a->limb[i] < b->limb[i] ? -1 : 1;
  return 0;
}

packing_i_rounding packing_i_round_exactly(uint64_t m, int e, int q, uint64_t n)
{
  packing_i_big exact, middle;
  packing_i_big_set(&exact, m);
  packing_i_big_set(&middle, 2 * n + 1);
  const int sign = packing_i_big_compare(&exact, e + 1, q, &middle);
  return sign < 0   ? PACKING_I_ROUND_DOWN
         : sign > 0 ? PACKING_I_ROUND_UP
                    : PACKING_I_ROUND_TIE;
}
