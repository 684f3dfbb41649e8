/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RSA_CHILDREN_H
#define PACKING_RSA_CHILDREN_H

/* The kernel of a split: which of a voxel's eight children one exclusion ball covers. One version
 * for each instruction set; they do the same operations in the same order, so their answers are
 * the same bits (tests/internal/place.c). */

#include "base_internal.h"
#include "vec.h"

enum {
  /* Centres kept of 27 cells; more are only possible among obstacles that overlap one another,
   * and leaving some out keeps voxels, never drops them. */
  PACKING_I_MOST_NEAR = 1024
};

/* Centres of exclusion balls around a cell, relative to its lowest corner, and room for those of
 * them that hold the centre of one parent. */
typedef struct packing_i_rsa_near_centres {
  double x[PACKING_I_MOST_NEAR], y[PACKING_I_MOST_NEAR], z[PACKING_I_MOST_NEAR];
  size_t count;
  double holding_x[PACKING_I_MOST_NEAR + 8], holding_y[PACKING_I_MOST_NEAR + 8],
      holding_z[PACKING_I_MOST_NEAR + 8];
} packing_i_rsa_near_centres;

/* Bit k of the result: child k of the voxel about `centre` is covered by a ball of squared radius
 * `reach2`, or was so in `covered`. Children have half edges h; child k lies above the centre
 * along x, y, z where bits 0, 1, 2 of k are set. */
typedef unsigned (*packing_i_rsa_children)(packing_i_rsa_near_centres *near,
                                           packing_vec3 centre, packing_vec3 h,
                                           double reach2, unsigned covered);

/* The version for an instruction set that the machine has. */
packing_i_rsa_children packing_i_rsa_children_for(packing_isa isa);

#endif
