/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sorting particles into rows: radix sort by cell, merge sort along a row. Both are stable, so
 * equal keys stay in the order of the view. */
#include "grid/grid_internal.h"
#include <assert.h>
#include <string.h>

typedef packing_i_grid_record record;

enum { DIGIT_BITS = 11, BUCKETS = 1 << DIGIT_BITS, SHORT_RUN = 12 };

static uint64_t key_of(const record *r, int by_c)
{
  return by_c ? r->c : r->key.b;
}

static int bit_length(uint64_t v)
{
  int bits = 0;
  for (; v != 0; v >>= 1)
    bits++;
  return bits;
}

static void radix_pass(const record *from, record *to, size_t count, int by_c,
                       uint64_t least, int shift, int bits)
{
  size_t start[BUCKETS] = {0};
  const uint64_t mask = (UINT64_C(1) << bits) - 1;
  size_t before = 0;
  for (size_t i = 0; i < count; i++)
    start[(key_of(&from[i], by_c) - least) >> shift & mask]++;
  for (size_t k = 0; k <= mask; k++) {
    const size_t here = start[k];
    start[k] = before;
    before += here;
  }
  for (size_t i = 0; i < count; i++)
    to[start[(key_of(&from[i], by_c) - least) >> shift & mask]++] = from[i];
}

/* By one of the keys, in as few passes as its spread needs: none when all are alike. */
static void radix_sort(record *records, record *spare, size_t count, int by_c)
{
  uint64_t least = UINT64_MAX, most = 0;
  for (size_t i = 0; i < count; i++) {
    const uint64_t k = key_of(&records[i], by_c);
    least = k < least ? k : least;
    most = k > most ? k : most;
  }
  if (count < 2 || least == most)
    return;
  const int bits = bit_length(most - least);
  assert(bits > 0);
  const int passes = (bits + DIGIT_BITS - 1) / DIGIT_BITS;
  const int digit = (bits + passes - 1) / passes;
  record *from = records, *to = spare;
  for (int p = 0; p < passes; p++) {
    radix_pass(from, to, count, by_c, least, p * digit, digit);
    record *swap = from;
    from = to;
    to = swap;
  }
  if (from != records)
    memcpy(records, from, count * sizeof *records);
}

void packing_i_grid_sort_cells(record *records, record *spare, size_t count)
{
  radix_sort(records, spare, count, 0);
  radix_sort(records, spare, count, 1);
}

static void insertion_sort(record *r, size_t count)
{
  for (size_t i = 1; i < count; i++) {
    const record held = r[i];
    size_t k = i;
    for (; k > 0 && held.key.s < r[k - 1].key.s; k--)
      r[k] = r[k - 1];
    r[k] = held;
  }
}

static void merge(const record *from, record *to, size_t middle, size_t end)
{
  size_t a = 0, b = middle;
  for (size_t k = 0; k < end; k++)
    to[k] = b == end || (a < middle && from[a].key.s <= from[b].key.s) ? from[a++]
                                                                       : from[b++];
}

void packing_i_grid_sort_row(record *records, record *spare, size_t count)
{
  for (size_t at = 0; at < count; at += SHORT_RUN)
    insertion_sort(records + at, count - at < SHORT_RUN ? count - at : SHORT_RUN);
  record *from = records, *to = spare;
  for (size_t run = SHORT_RUN; run < count; run *= 2) {
    for (size_t at = 0; at < count; at += 2 * run) {
      const size_t left = count - at;
      merge(from + at, to + at, run < left ? run : left, 2 * run < left ? 2 * run : left);
    }
    record *swap = from;
    from = to;
    to = swap;
  }
  if (from != records)
    memcpy(records, from, count * sizeof *records);
}
