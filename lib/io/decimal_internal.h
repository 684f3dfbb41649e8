/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_DECIMAL_INTERNAL_H
#define PACKING_DECIMAL_INTERNAL_H

/* Between doubles and decimal digits, correctly rounded, in integers only: neither the locale
 * nor the rounding mode of the host can change a digit.
 *
 * One product of 64 by 128 bits decides nearly always (Lemire, Software: Practice and
 * Experience 51, 1700, 2021, eq. 1); the powers of ten are cut to 128 bits, so the product is
 * known within two units of its 128th bit, and where a rounding point falls between them,
 * integers of full length decide. */

#include <stdint.h>

enum {
  PACKING_I_POW10_MIN = -343,    /* the least denormal, read from 19 digits */
  PACKING_I_POW10_MAX = 340,     /* the same, written with 17 */
  PACKING_I_DOUBLE_SIZE = 32,    /* room for what packing_i_format_double() writes */
  PACKING_I_NUMBER_LENGTH = 1024 /* longest number read, in bytes */
};

extern const uint64_t packing_i_pow10[PACKING_I_POW10_MAX - PACKING_I_POW10_MIN + 1][2];

/* Writes v, finite, as printf's "%.17g" would in the C locale with rounding to nearest; no
 * terminating zero. Returns the number of bytes, at most 24. */
unsigned packing_i_format_double(double v, char *out);

/* Writes v in decimal; at most 20 bytes, no terminating zero. */
unsigned packing_i_format_int(int64_t v, char *out);

typedef enum packing_i_number {
  PACKING_I_NUMBER_OK,
  PACKING_I_NUMBER_NONE,  /* no number stands here */
  PACKING_I_NUMBER_LARGE, /* beyond the range of the type */
  PACKING_I_NUMBER_LONG   /* more than PACKING_I_NUMBER_LENGTH bytes */
} packing_i_number;

/* Reads [+-]digits[.digits][(e|E)[+-]digits] at *at and moves *at behind it; the text must end
 * with a byte that is no part of a number. Rounds to nearest, ties to even; what is nearer to
 * 0 than to the least denormal gives 0 of its sign. */
packing_i_number packing_i_parse_double(const char **at, double *v);

/* Reads [+-]digits. */
packing_i_number packing_i_parse_int(const char **at, int64_t *v);

/* m 10^q = (hi 2^64 + lo + low 2^-64 + d) 2^exp2, where the top bit of m is set and
 * 0 <= d < 1; d is 0 where `exact` is set. hi has bit 62 or 63 set. */
typedef struct packing_i_scaled {
  uint64_t hi, lo, low;
  int exp2;
  int exact;
} packing_i_scaled;

packing_i_scaled packing_i_scale10(uint64_t m, int q);

typedef enum packing_i_rounding {
  PACKING_I_ROUND_DOWN,
  PACKING_I_ROUND_UP,
  PACKING_I_ROUND_TIE,
  PACKING_I_ROUND_UNSURE /* the product is too short to tell */
} packing_i_rounding;

/* How to round off the last `shift` bits, 65 to 128, of hi 2^64 + lo: *kept is what stays. */
packing_i_rounding packing_i_round_scaled(const packing_i_scaled *s, int shift,
                                          uint64_t *kept);

/* How to round m 2^e 10^q to n or n + 1, when it lies between them: by whole numbers of full
 * length, which is right always and slow. */
packing_i_rounding packing_i_round_exactly(uint64_t m, int e, int q, uint64_t n);

/* A whole number of up to 5120 bits: a number of 1024 digits (3402 bits) and the exponent of
 * the least denormal (1075 bits) fit together. */
enum { PACKING_I_BIG_LIMBS = 160 };
typedef struct packing_i_big {
  unsigned count;
  uint32_t limb[PACKING_I_BIG_LIMBS];
} packing_i_big;

void packing_i_big_set(packing_i_big *big, uint64_t v);
/* big = big * factor + term. */
void packing_i_big_muladd(packing_i_big *big, uint32_t factor, uint32_t term);
/* The sign of a 2^a2 10^a10 - b; a and b are overwritten. */
int packing_i_big_compare(packing_i_big *a, int a2, int a10, packing_i_big *b);

#endif
