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

void packing_i_paper_order(packing_i_paper *paper, uint32_t *order, size_t count,
                           size_t (*particle)(const packing_i_paper_scan *scan,
                                              size_t entry))
{
  packing_i_paper_scan *scan = &paper->scan;
  const double sign = paper->select_neighbours == PACKING_FRONT_LIFO ? -1 : 1;
  if (paper->select_neighbours == PACKING_FRONT_RANDOM) {
    for (size_t k = 0; k < count; k++)
      order[k] = (uint32_t)k;
    return;
  }
  for (size_t k = 0; k < count; k++)
    scan->rank[k] = (packing_i_rank){sign * (double)particle(scan, k), k};
  packing_i_ranks_sort(scan->rank, scan->rank + count, count);
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
