/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Biased randomised insertion order (N. Amenta, S. Choi, G. Rote, SoCG 2003, 211): every point joins
 * the last round with probability 7/8, of the others each the round before with 7/8, and so on;
 * within a round points follow a Hilbert curve, so each is near the one before, and memory too.
 * The curve's index is J. Skilling's (AIP Conf. Proc. 707, 2004, 381). Linear. */
#include "delaunay/hilbert.h"

enum {
  AXIS_BITS = 19, /* of a coordinate on the curve in three dimensions */
  FLAT_BITS = 28, /* in two */
  ROUND_SHIFT = 57,
  MOST_ROUNDS = 10,
  FIRST_ROUND = 64, /* points that need no further round before */
  RADIX_BITS = 8
};

typedef struct record {
  uint64_t key;
  uint32_t point;
} record;

/* A number that has nothing to do with its neighbours' (S. Vigna's splitmix64). */
static uint64_t scatter(uint64_t i)
{
  uint64_t z = i + UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

/* Rounds back from the last. */
static int rounds_back(uint32_t i, uint32_t count)
{
  const uint64_t bits = scatter(i);
  int back = 0;
  while (back < MOST_ROUNDS && (count >> 3 * back) > FIRST_ROUND &&
         (bits >> 3 * back & 7) == 0)
    back++;
  return back;
}

static uint64_t hilbert(int dim, uint32_t x[3], int bits)
{
  for (uint32_t q = UINT32_C(1) << (bits - 1); q > 1; q >>= 1)
    for (int i = 0; i < dim; i++) {
      const uint32_t swap = x[i] & q ? 0 : (x[0] ^ x[i]) & (q - 1);
      x[0] ^= x[i] & q ? q - 1 : swap;
      x[i] ^= swap;
    }
  for (int i = 1; i < dim; i++)
    x[i] ^= x[i - 1];
  uint32_t flip = 0;
  for (uint32_t q = UINT32_C(1) << (bits - 1); q > 1; q >>= 1)
    flip ^= x[dim - 1] & q ? q - 1 : 0;
  uint64_t index = 0;
  for (int b = bits - 1; b >= 0; b--)
    for (int i = 0; i < dim; i++)
      index = index << 1 | ((x[i] ^ flip) >> b & 1U);
  return index;
}

/* Bounds of the points, as a corner and the longest edge. */
static double extent(int dim, const packing_i_delaunay_point *p, uint32_t count,
                     double lo[3])
{
  double longest = 0;
  for (int k = 0; k < dim; k++) {
    double hi = p[0].x[k];
    lo[k] = hi;
    for (uint32_t i = 1; i < count; i++) {
      lo[k] = p[i].x[k] < lo[k] ? p[i].x[k] : lo[k];
      hi = p[i].x[k] > hi ? p[i].x[k] : hi;
    }
    longest = hi - lo[k] > longest ? hi - lo[k] : longest;
  }
  return longest;
}

static void set_keys(int dim, const packing_i_delaunay_point *p, uint32_t count,
                     record *records)
{
  double lo[3] = {0, 0, 0};
  const int bits = dim == 3 ? AXIS_BITS : FLAT_BITS;
  const double longest = extent(dim, p, count, lo);
  const double cells = (double)((UINT32_C(1) << bits) - 1);
  for (uint32_t i = 0; i < count; i++) {
    uint32_t x[3] = {0, 0, 0};
    for (int k = 0; k < dim && longest > 0; k++)
      x[k] = (uint32_t)((p[i].x[k] - lo[k]) / longest * cells);
    const uint64_t round = (uint64_t)(MOST_ROUNDS - rounds_back(i, count));
    records[i].key = round << ROUND_SHIFT | hilbert(dim, x, bits);
    records[i].point = i;
  }
}

/* One stable pass by eight bits. */
static void sort_pass(const record *from, record *to, uint32_t count, int shift)
{
  uint32_t start[1 << RADIX_BITS] = {0}, total = 0;
  const uint64_t mask = (1 << RADIX_BITS) - 1;
  for (uint32_t i = 0; i < count; i++)
    start[from[i].key >> shift & mask]++;
  for (int d = 0; d < 1 << RADIX_BITS; d++) {
    const uint32_t here = start[d];
    start[d] = total;
    total += here;
  }
  for (uint32_t i = 0; i < count; i++)
    to[start[from[i].key >> shift & mask]++] = from[i];
}

packing_status packing_i_delaunay_order(packing_context *context, int dim,
                                        const packing_i_delaunay_point *points,
                                        uint32_t count, uint32_t *order)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  record *records = packing_i_alloc(allocator, 2 * (size_t)count, sizeof *records);
  if (records == NULL)
    return packing_i_nomem(context);
  if (count > 0)
    set_keys(dim, points, count, records);
  record *from = records, *to = records + count;
  for (int shift = 0; shift < 64; shift += RADIX_BITS) {
    sort_pass(from, to, count, shift);
    record *swap = from;
    from = to;
    to = swap;
  }
  for (uint32_t i = 0; i < count; i++)
    order[i] = from[i].point;
  packing_i_free(allocator, records);
  return PACKING_OK;
}
