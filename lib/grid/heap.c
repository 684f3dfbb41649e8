/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smallest of many values in a fixed room: a heap with the largest kept value on top, sorted
 * in place at the end (J. W. J. Williams, Algorithm 232, Commun. ACM 7, 1964). */
#include "grid/grid_internal.h"

static void sift_down(size_t *heap, size_t held, size_t at)
{
  const size_t value = heap[at];
  for (;;) {
    size_t child = 2 * at + 1;
    if (child >= held)
      break;
    if (child + 1 < held && heap[child + 1] > heap[child])
      child++;
    if (heap[child] <= value)
      break;
    heap[at] = heap[child];
    at = child;
  }
  heap[at] = value;
}

void packing_i_heap_offer(size_t *heap, size_t capacity, size_t *held, size_t value)
{
  if (*held < capacity) {
    size_t at = (*held)++;
    for (; at > 0 && heap[(at - 1) / 2] < value; at = (at - 1) / 2)
      heap[at] = heap[(at - 1) / 2];
    heap[at] = value;
  } else if (capacity > 0 && value < heap[0]) {
    heap[0] = value;
    sift_down(heap, capacity, 0);
  }
}

void packing_i_heap_sort(size_t *heap, size_t held)
{
  while (held > 1) {
    const size_t largest = heap[0];
    heap[0] = heap[--held];
    heap[held] = largest;
    sift_down(heap, held, 0);
  }
}
