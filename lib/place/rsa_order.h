/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RSA_ORDER_H
#define PACKING_RSA_ORDER_H

/* Lists of candidates by time, ties by number; neither takes memory. */

#include "rsa_round.h"

/* Sorts `count` numbers of candidates, the earliest first. */
void packing_i_rsa_sort_by_time(const packing_i_rsa_candidate *c, uint32_t *order,
                                size_t count);

/* Moves the `first` earliest to the front. Linear. */
void packing_i_rsa_select_by_time(const packing_i_rsa_candidate *c, uint32_t *order,
                                  size_t count, size_t first);

#endif
