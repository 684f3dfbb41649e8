/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PHILOX_BATCH_H
#define PACKING_PHILOX_BATCH_H

/* Philox4x32-10 of many counters at once. Every instruction set gives the words of
 * packing_i_philox(), bit for bit (tests/internal/rng.c). */

#include "rng_internal.h"

enum { PACKING_I_PHILOX_BATCH = 16 };

/* word[w][i] = word w of Philox of the counter {first + i, index}, 64 bits each. */
typedef void (*packing_i_philox_batch)(uint64_t first, uint64_t index,
                                       const uint32_t key[2],
                                       uint32_t word[4][PACKING_I_PHILOX_BATCH]);

/* The version for an instruction set that the machine has. */
packing_i_philox_batch packing_i_philox_batch_for(packing_isa isa);

#endif
