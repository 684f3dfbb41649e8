/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ranks.h"
#include <string.h>

/* Merges from[low, middle) and from[middle, high) into `to`. */
static void merge(const packing_i_rank *from, packing_i_rank *to, size_t low,
                  size_t middle, size_t high)
{
  size_t a = low, b = middle;
  for (size_t i = low; i < high; i++)
    to[i] = a < middle && (b == high || from[a].r <= from[b].r) ? from[a++] : from[b++];
}

void packing_i_ranks_sort(packing_i_rank *ranks, packing_i_rank *spare, size_t count)
{
  packing_i_rank *from = ranks, *to = spare;
  for (size_t run = 1; run < count; run *= 2) {
    for (size_t low = 0; low < count; low += 2 * run) {
      const size_t middle = count - low < run ? count : low + run;
      merge(from, to, low, middle, count - middle < run ? count : middle + run);
    }
    packing_i_rank *swap = from;
    from = to;
    to = swap;
  }
  if (from != ranks)
    memcpy(ranks, from, count * sizeof *ranks);
}
