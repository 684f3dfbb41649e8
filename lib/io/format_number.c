/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text: what printf's "%.17g" writes, some thirty nanoseconds each. */
#include "decimal_internal.h"
#include <string.h>

enum { DIGITS = 17 };

static const char pairs[] = "00010203040506070809101112131415161718192021222324"
                            "25262728293031323334353637383940414243444546474849"
                            "50515253545556575859606162636465666768697071727374"
                            "75767778798081828384858687888990919293949596979899";

/* The last `count` digits of n, right-aligned before `end`. */
static void put_digits(char *end, unsigned count, uint64_t n)
{
  for (; count >= 2; count -= 2, n /= 100)
    memcpy(end -= 2, pairs + n % 100 * 2, 2);
  if (count == 1)
    *--end = (char)('0' + n % 10);
}

/* v = m 2^e, with the top bit of m set; v is finite and not 0. */
static uint64_t split(uint64_t bits, int *e)
{
  const int biased = (int)(bits >> 52 & 0x7ff);
  uint64_t m = bits & ((UINT64_C(1) << 52) - 1);
  *e = (biased == 0 ? 1 : biased) - 1075;
  if (biased != 0)
    m |= UINT64_C(1) << 52;
  for (; m >> 63 == 0; m <<= 1)
    --*e;
  return m;
}

/* m 2^e 10^(16 - k), rounded to a whole number. */
static uint64_t scaled_digits(uint64_t m, int e, int k)
{
  const int q = DIGITS - 1 - k;
  const packing_i_scaled s = packing_i_scale10(m, q);
  uint64_t n;
  packing_i_rounding rounding = packing_i_round_scaled(&s, -(e + s.exp2), &n);
  if (rounding == PACKING_I_ROUND_UNSURE)
    rounding = packing_i_round_exactly(m, e, q, n);
  return n + (rounding == PACKING_I_ROUND_UP ||
              (rounding == PACKING_I_ROUND_TIE && (n & 1) != 0));
}

/* The 17 digits of m 2^e, and the decimal exponent of the first. */
static uint64_t digits_of(uint64_t m, int e, int *exponent)
{
  const uint64_t limit = UINT64_C(100000000000000000);
  /* floor(log10 2^(e + 63)): that of the number, or one less */
  int k = (e + 63) * 78913 >> 18;
  uint64_t n = scaled_digits(m, e, k);
  if (n >= limit)
    n = scaled_digits(m, e, ++k);
  *exponent = k;
  return n;
}

static unsigned put_exponent(char *out, int k)
{
  const unsigned size = k <= -100 || k >= 100 ? 3 : 2;
  out[0] = 'e';
  out[1] = k < 0 ? '-' : '+';
  put_digits(out + 2 + size, size, (uint64_t)(k < 0 ? -k : k));
  return 2 + size;
}

/* d.ddde+XX */
static unsigned put_scientific(char *out, const char *digits, unsigned count, int k)
{
  unsigned used = 1;
  out[0] = digits[0];
  if (count > 1) {
    out[1] = '.';
    memcpy(out + 2, digits + 1, count - 1);
    used = count + 1;
  }
  return used + put_exponent(out + used, k);
}

/* 0.000ddd, ddd.ddd or ddd000 */
static unsigned put_fixed(char *out, const char *digits, unsigned count, int k)
{
  if (k < 0) {
    memcpy(out, "0.0000", 6);
    memcpy(out + 1 - k, digits, count);
    return (unsigned)(1 - k) + count;
  }
  const unsigned whole = (unsigned)k + 1; /* at most 17, all of them in `digits` */
  memcpy(out, digits, whole);
  if (count <= whole)
    return whole;
  out[whole] = '.';
  memcpy(out + whole + 1, digits + whole, count - whole);
  return count + 1;
}

unsigned packing_i_format_double(double v, char *out)
{
  char digits[DIGITS];
  unsigned count = DIGITS, used = 0;
  uint64_t bits;
  int e, k;
  memcpy(&bits, &v, sizeof bits);
  if (bits >> 63 != 0)
    out[used++] = '-';
  if (bits << 1 == 0) {
    out[used++] = '0';
    return used;
  }
  const uint64_t m = split(bits, &e);
  put_digits(digits + DIGITS, DIGITS, digits_of(m, e, &k));
  while (digits[count - 1] == '0')
    count--;
  if (k < -4 || k >= DIGITS)
    return used + put_scientific(out + used, digits, count, k);
  return used + put_fixed(out + used, digits, count, k);
}

unsigned packing_i_format_int(int64_t v, char *out)
{
  char reversed[20];
  unsigned count = 0, used = 0;
  uint64_t n = v < 0 ? -(uint64_t)v : (uint64_t)v;
  if (v < 0)
    out[used++] = '-';
  do
    reversed[count++] = (char)('0' + n % 10);
  while ((n /= 10) != 0);
  while (count > 0)
    out[used++] = reversed[--count];
  return used;
}
