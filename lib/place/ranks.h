/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RANKS_H
#define PACKING_RANKS_H

/* Things in the order of a size. */

#include <stddef.h>

typedef struct packing_i_rank {
  double r;
  size_t index;
} packing_i_rank;

/* Sorts by r > 0, equal ones in the order they had; `spare` has room for `count` too. Linear: at
 * most six passes, fewer where sizes differ little, none where they are equal. */
void packing_i_ranks_sort(packing_i_rank *ranks, packing_i_rank *spare, size_t count);

#endif
