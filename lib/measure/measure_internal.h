/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_MEASURE_INTERNAL_H
#define PACKING_MEASURE_INTERNAL_H

/* What the measures share: checks of views, blocks. */

#include "domain/domain_internal.h"
#include "sum.h"
#include <math.h>
#include <packing/measure.h>

enum { PACKING_I_MEASURE_BLOCK = 4096 /* particles of a parallel block */ };

static inline size_t packing_i_measure_blocks(size_t count)
{
  return (count + PACKING_I_MEASURE_BLOCK - 1) / PACKING_I_MEASURE_BLOCK;
}

static inline size_t packing_i_measure_block_end(size_t block, size_t count)
{
  const size_t first = block * PACKING_I_MEASURE_BLOCK;
  return count - first < PACKING_I_MEASURE_BLOCK ? count
                                                 : first + PACKING_I_MEASURE_BLOCK;
}

/* Whether a ball is away from the walls of a box or rectangle (most particles are); always 0 for
 * `walls` NULL. */
static inline int packing_i_measure_is_clear(const packing_i_planar *walls,
                                             packing_vec3 p, double r)
{
  return walls != NULL && p.x - walls->wall_lo[0] >= r && walls->wall_hi[0] - p.x >= r &&
         p.y - walls->wall_lo[1] >= r && walls->wall_hi[1] - p.y >= r &&
         p.z - walls->wall_lo[2] >= r && walls->wall_hi[2] - p.z >= r;
}

/* Today's copy of the caller's view. */
packing_status packing_i_measure_view(packing_context *context, const packing_view *view,
                                      packing_view *copy);

/* Whether particle i has finite numbers (z only where it counts) and r > 0. */
int packing_i_measure_is_good(const packing_view *view, size_t i, int flat);

/* All particles are; the message names the first that is not. */
packing_status packing_i_measure_check(packing_context *context, const packing_view *view,
                                       int flat);

/* The part of a container at least `margin` from its walls. Where nothing is left, which is no
 * failure, *inner stays as it is. `field` is named when it cannot be made. */
packing_status packing_i_measure_inner(packing_context *context, const char *field,
                                       packing_domain *domain, double margin,
                                       packing_domain **inner);

#endif
