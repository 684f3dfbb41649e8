/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PORES_RESULT_H
#define PACKING_PORES_RESULT_H

/* What is kept of a network. */

#include "measure/pores_internal.h"

/* The handle. 120 bytes a pore, 104 a constriction. */
struct packing_pores {
  packing_context *context;
  const packing_allocator *allocator;
  packing_pores_report report;
  packing_pore *pore;
  packing_constriction *constriction;
  double *radii[2]; /* of free pores, of free constrictions, rising */
  size_t free[2];
};

packing_status packing_i_pores_list_result(const packing_i_pore_network *n,
                                           packing_pores **pores);

#endif
