/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rsa_order.h"

static int earlier(const packing_i_rsa_candidate *c, uint32_t a, uint32_t b)
{
  const uint64_t ta = c[a].time, tb = c[b].time;
  return ta < tb || (ta == tb && a < b);
}

/* Sifts order[root] down a heap with the latest candidate on top. */
static void sift(const packing_i_rsa_candidate *c, uint32_t *order, size_t root,
                 size_t count)
{
  for (size_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && earlier(c, order[child], order[child + 1]))
      child++;
    const uint32_t top = order[root];
    if (!earlier(c, top, order[child]))
      return;
    order[root] = order[child];
    order[child] = top;
  }
}

/* order[] by time, then number: a heap sort needs no memory and no context for a comparison. */
void packing_i_rsa_sort_by_time(const packing_i_rsa_candidate *c, uint32_t *order,
                                size_t count)
{
  for (size_t i = count / 2; i-- > 0;)
    sift(c, order, i, count);
  while (count-- > 1) {
    const uint32_t latest = order[0];
    order[0] = order[count];
    order[count] = latest;
    sift(c, order, 0, count);
  }
}

/* Hoare's partition: returns the end of a part, neither empty nor all, none of which is later than
 * any of the rest. Times are random, so the middle is as good a pivot as any. */
static size_t partition(const packing_i_rsa_candidate *c, uint32_t *order, size_t low,
                        size_t high)
{
  const uint32_t pivot = order[low + (high - 1 - low) / 2];
  for (;; low++) {
    while (earlier(c, order[low], pivot))
      low++;
    high--;
    while (earlier(c, pivot, order[high]))
      high--;
    if (low >= high)
      return high + 1;
    const uint32_t later = order[low];
    order[low] = order[high];
    order[high] = later;
  }
}

/* Moves the `first` earliest of order[] to its front. */
void packing_i_rsa_select_by_time(const packing_i_rsa_candidate *c, uint32_t *order,
                                  size_t count, size_t first)
{
  size_t low = 0, high = count;
  while (low < first && first < high) {
    const size_t middle = partition(c, order, low, high);
    if (first < middle)
      high = middle;
    else
      low = middle;
  }
}
