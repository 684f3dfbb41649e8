/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_NETWORK_LISTS_H
#define EXAMPLES_NETWORK_LISTS_H

/* What the writers of networks share: its lists. */

#include <packing/packing.h>

typedef struct network {
  packing_pore *pore;
  packing_constriction *way;
  size_t pores, ways;
} network;

/* Drop it in any case. */
packing_status network_take(const packing_pores *pores, network *n);
void network_drop(network *n);

/* Whether a way ends at an image. */
int network_leaves(const packing_constriction *c);

#endif
