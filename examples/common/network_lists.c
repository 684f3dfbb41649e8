/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "network_lists.h"
#include <stdlib.h>

packing_status network_take(const packing_pores *pores, network *n)
{
  packing_status status = packing_pores_list(pores, 0, 0, NULL, &n->pores);
  if (status == PACKING_OK)
    status = packing_pores_constrictions(pores, 0, 0, NULL, &n->ways);
  if (status != PACKING_OK)
    return status;
  n->pore = calloc(n->pores + 1, sizeof *n->pore);
  n->way = calloc(n->ways + 1, sizeof *n->way);
  if (!n->pore || !n->way)
    return PACKING_ERR_NOMEM;
  status = packing_pores_list(pores, 0, n->pores, n->pore, &n->pores);
  if (status == PACKING_OK)
    status = packing_pores_constrictions(pores, 0, n->ways, n->way, &n->ways);
  return status;
}

void network_drop(network *n)
{
  free(n->pore);
  free(n->way);
}

int network_leaves(const packing_constriction *c)
{
  return c->image[0] != 0 || c->image[1] != 0 || c->image[2] != 0;
}
