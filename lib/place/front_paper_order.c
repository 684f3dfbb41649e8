/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The neighbours of a front particle in the order asked (section 3.3). */
#include "front_paper.h"
#include <string.h>

packing_status packing_i_paper_rows(const packing_placer *placer, size_t count)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const packing_allocator *allocator = packing_i_allocator(placer->context);
  if (count <= scan->capacity)
    return PACKING_OK;
  const size_t capacity = count + count / 2 + 64;
  const size_t row = 2 * sizeof *scan->body + 2 * sizeof *scan->rank +
                     sizeof *scan->bound + sizeof *scan->end + sizeof *scan->outer +
                     sizeof *scan->inner;
  void *rows = packing_i_alloc(allocator, capacity, row);
  if (rows == NULL)
    return packing_i_nomem(placer->context);
  const uint32_t *outer = scan->outer;
  scan->body = rows;
  scan->rank = (void *)(scan->body + 2 * capacity);
  scan->bound = (void *)(scan->rank + 2 * capacity);
  scan->end = (void *)(scan->bound + capacity);
  scan->outer = (void *)(scan->end + capacity);
  scan->inner = scan->outer + capacity;
  if (scan->rows != NULL)
    memcpy(scan->outer, outer, scan->capacity * sizeof *outer);
  packing_i_free(allocator, scan->rows);
  scan->rows = rows;
  scan->capacity = capacity;
  return PACKING_OK;
}

void packing_i_paper_sort(packing_i_rank *rank, size_t count)
{
  if (count > PACKING_I_PAPER_FEW) {
    packing_i_ranks_sort(rank, rank + count, count);
    return;
  }
  for (size_t k = 1; k < count; k++) {
    const packing_i_rank moved = rank[k];
    size_t to = k;
    for (; to > 0 && rank[to - 1].r > moved.r; to--)
      rank[to] = rank[to - 1];
    rank[to] = moved;
  }
}

/* Rises with the order in which particles are taken; ranks are above 0. */
static double age(size_t particle, int lifo)
{
  return 1.0 + (double)(lifo ? UINT32_MAX - particle : particle);
}

void packing_i_paper_order(packing_i_paper *paper, uint32_t *order, size_t count,
                           size_t (*particle)(const packing_i_paper_scan *scan,
                                              size_t entry))
{
  packing_i_paper_scan *scan = &paper->scan;
  const int lifo = paper->select_neighbours == PACKING_FRONT_LIFO;
  if (paper->select_neighbours == PACKING_FRONT_RANDOM) {
    for (size_t k = 0; k < count; k++)
      order[k] = (uint32_t)k;
    return;
  }
  for (size_t k = 0; k < count; k++)
    scan->rank[k] = (packing_i_rank){age(particle(scan, k), lifo), k};
  packing_i_paper_sort(scan->rank, count);
  for (size_t k = 0; k < count; k++)
    order[k] = (uint32_t)scan->rank[k].index;
}

void packing_i_paper_pick(packing_i_paper *paper, uint32_t *order, size_t at,
                          size_t count)
{
  if (paper->select_neighbours != PACKING_FRONT_RANDOM || count - at < 2)
    return;
  const size_t other = at + packing_i_stream_below(&paper->choice, count - at);
  const uint32_t entry = order[other];
  order[other] = order[at];
  order[at] = entry;
}
