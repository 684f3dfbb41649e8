/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Radix sort: the bits of positive doubles, read as integers, have their order. */
#include "ranks.h"
#include <stdint.h>
#include <string.h>

enum { DIGIT_BITS = 11, BUCKETS = 1 << DIGIT_BITS };

static uint64_t bits_of(double r)
{
  uint64_t bits;
  memcpy(&bits, &r, sizeof bits);
  return bits;
}

static void pass(const packing_i_rank *from, packing_i_rank *to, size_t count,
                 uint64_t least, int shift)
{
  size_t start[BUCKETS] = {0}, before = 0;
  for (size_t i = 0; i < count; i++)
    start[(bits_of(from[i].r) - least) >> shift & (BUCKETS - 1)]++;
  for (size_t k = 0; k < BUCKETS; k++) {
    const size_t here = start[k];
    start[k] = before;
    before += here;
  }
  for (size_t i = 0; i < count; i++)
    to[start[(bits_of(from[i].r) - least) >> shift & (BUCKETS - 1)]++] = from[i];
}

void packing_i_ranks_sort(packing_i_rank *ranks, packing_i_rank *spare, size_t count)
{
  uint64_t least = UINT64_MAX, most = 0;
  for (size_t i = 0; i < count; i++) {
    const uint64_t bits = bits_of(ranks[i].r);
    least = bits < least ? bits : least;
    most = bits > most ? bits : most;
  }
  packing_i_rank *from = ranks, *to = spare;
  for (int shift = 0; shift < 64 && count > 0 && (most - least) >> shift != 0;
       shift += DIGIT_BITS) {
    pass(from, to, count, least, shift);
    packing_i_rank *swap = from;
    from = to;
    to = swap;
  }
  if (from != ranks)
    memcpy(ranks, from, count * sizeof *ranks);
}
