/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text as numbers, correctly rounded: 19 digits and the short product, or all digits. */
#include "decimal_internal.h"
#include <string.h>

enum { WORD_DIGITS = 19, LEAST_EXPONENT = -1074, MOST_EXPONENT = 99999 };

/* What stands in the text: w 10^exponent, more digits after w where `more`. */
typedef struct decimal {
  const char *first, *last; /* the digits, with the point */
  uint64_t w;
  int digits;   /* of w, leading zeros left out */
  int exponent; /* of the last digit of w */
  int dropped;  /* digits after w */
  int more;     /* one of them is not 0 */
} decimal;

static inline int is_digit(char c)
{
  return (unsigned char)(c - '0') <= 9;
}

static const char *scan_digits(const char *p, decimal *d)
{
  uint64_t w = d->w;
  int digits = d->digits;
  for (; is_digit(*p) && digits < WORD_DIGITS; p++) {
    w = w * 10 + (uint64_t)(*p - '0');
    digits += w != 0;
  }
  d->w = w;
  d->digits = digits;
  for (; is_digit(*p); p++) {
    d->dropped++;
    d->more |= *p != '0';
  }
  return p;
}

/* Reads an exponent, if there is one; *valid is cleared where digits are missing. */
static const char *scan_exponent(const char *p, int *exponent, int *valid)
{
  *exponent = 0;
  if (*p != 'e' && *p != 'E')
    return p;
  p++;
  const int negative = *p == '-';
  if (*p == '-' || *p == '+')
    p++;
  *valid = is_digit(*p);
  for (; is_digit(*p); p++)
    if (*exponent < MOST_EXPONENT)
      *exponent = *exponent * 10 + (*p - '0');
  if (negative)
    *exponent = -*exponent;
  return p;
}

static packing_i_number scan(const char **at, decimal *d)
{
  const char *p = *at;
  int fraction = 0, exponent, valid = 1;
  memset(d, 0, sizeof *d);
  d->first = p;
  p = scan_digits(p, d);
  int any = p > d->first;
  if (*p == '.') {
    const char *point = p++;
    p = scan_digits(p, d);
    fraction = (int)(p - point - 1);
    any |= fraction > 0;
  }
  d->last = p;
  if (!any)
    return PACKING_I_NUMBER_NONE;
  p = scan_exponent(p, &exponent, &valid);
  if (p - d->first > PACKING_I_NUMBER_LENGTH)
    return PACKING_I_NUMBER_LONG;
  d->exponent = exponent - fraction + d->dropped;
  *at = p;
  return valid ? PACKING_I_NUMBER_OK : PACKING_I_NUMBER_NONE;
}

/* The double below or at (hi 2^64 + lo) 2^exp2: mantissa *m, exponent *e. */
static packing_i_rounding to_mantissa(uint64_t w, int q, uint64_t *m, int *e)
{
  int lead = 0;
  for (; w >> 63 == 0; w <<= 1)
    lead++;
  packing_i_scaled s = packing_i_scale10(w, q);
  s.exp2 -= lead;
  int shift = s.hi >> 63 != 0 ? 75 : 74; /* keeps 53 bits */
  if (s.exp2 + shift < LEAST_EXPONENT)
    shift = LEAST_EXPONENT - s.exp2;
  *e = s.exp2 + shift;
  if (shift > 128) { /* below half of the least denormal */
    *m = 0;
    return PACKING_I_ROUND_DOWN;
  }
  return packing_i_round_scaled(&s, shift, m);
}

/* All digits of the text against m + 1/2, in units of 2^e. */
static packing_i_rounding decide_by_all_digits(const decimal *d, uint64_t m, int e)
{
  packing_i_big text, middle;
  packing_i_big_set(&text, 0);
  for (const char *p = d->first; p < d->last; p++)
    if (*p != '.')
      packing_i_big_muladd(&text, 10, (uint32_t)(*p - '0'));
  packing_i_big_set(&middle, 2 * m + 1);
  const int sign = packing_i_big_compare(&text, 1 - e, d->exponent - d->dropped, &middle);
  return sign < 0   ? PACKING_I_ROUND_DOWN
         : sign > 0 ? PACKING_I_ROUND_UP
                    : PACKING_I_ROUND_TIE;
}

static double assemble(uint64_t m, int e)
{
  double v;
  if (m >> 53 != 0) {
    m >>= 1; /* 2^53, by a carry */
    e++;
  }
  uint64_t bits = m;
  if (m >> 52 != 0)
    bits = (uint64_t)(e + 1075) << 52 | (m & ((UINT64_C(1) << 52) - 1));
  memcpy(&v, &bits, sizeof v);
  return v;
}

static packing_i_number round_decimal(const decimal *d, double *v)
{
  uint64_t m, next_m;
  int e, next_e;
  *v = 0;
  if (d->w == 0 || d->digits + d->exponent <= -324) /* below 1e-324 */
    return PACKING_I_NUMBER_OK;
  if (d->digits + d->exponent > 309)
    return PACKING_I_NUMBER_LARGE;
  packing_i_rounding rounding = to_mantissa(d->w, d->exponent, &m, &e);
  if (d->more && rounding != PACKING_I_ROUND_UNSURE) {
    /* the text lies between w and w + 1 */
    const packing_i_rounding next = to_mantissa(d->w + 1, d->exponent, &next_m, &next_e);
    const int up = rounding == PACKING_I_ROUND_UP, next_up = next == PACKING_I_ROUND_UP;
    if (rounding == PACKING_I_ROUND_TIE || next == PACKING_I_ROUND_TIE ||
        next == PACKING_I_ROUND_UNSURE || e != next_e ||
        m + (uint64_t)up != next_m + (uint64_t)next_up)
      rounding = PACKING_I_ROUND_UNSURE;
  }
  if (rounding == PACKING_I_ROUND_UNSURE)
    rounding = decide_by_all_digits(d, m, e);
  m += rounding == PACKING_I_ROUND_UP || (rounding == PACKING_I_ROUND_TIE && (m & 1));
  if (e + (int)(m >> 53) > 971)
    return PACKING_I_NUMBER_LARGE;
  *v = assemble(m, e);
  return PACKING_I_NUMBER_OK;
}

packing_i_number packing_i_parse_double(const char **at, double *v)
{
  const char *p = *at;
  decimal d;
  const int negative = *p == '-';
  if (*p == '-' || *p == '+')
    p++;
  const packing_i_number found = scan(&p, &d);
  if (found != PACKING_I_NUMBER_OK)
    return found;
  *at = p;
  const packing_i_number rounded = round_decimal(&d, v);
  if (negative)
    *v = -*v;
  return rounded;
}

packing_i_number packing_i_parse_int(const char **at, int64_t *v)
{
  const char *p = *at;
  const int negative = *p == '-';
  const uint64_t limit = (uint64_t)INT64_MAX + (uint64_t)negative;
  uint64_t n = 0;
  if (*p == '-' || *p == '+')
    p++;
  const char *first = p;
  int large = 0;
  for (; is_digit(*p); p++) {
    const uint64_t digit = (uint64_t)(*p - '0');
    large |= n > (limit - digit) / 10;
    n = n * 10 + digit;
  }
  if (p == first)
    return PACKING_I_NUMBER_NONE;
  if (large)
    return PACKING_I_NUMBER_LARGE;
  *at = p;
  *v = negative ? (int64_t)-n : (int64_t)n;
  return PACKING_I_NUMBER_OK;
}
