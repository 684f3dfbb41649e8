/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RSA_VOXELS_H
#define PACKING_RSA_VOXELS_H

/* The voxels that may still hold a centre: cubes cut from the cells by halving, all of one
 * level. A voxel is dropped when one exclusion ball (radius one diameter) covers it, or when it
 * lies outside the region of centres. An empty list proves saturation.
 * G. Zhang and S. Torquato, Phys. Rev. E 88, 053312 (2013); M. S. Ebeida et al., Comput. Graph.
 * Forum 31, 785 (2012). */

#include "rsa_cells.h"
#include "rsa_children.h"

typedef struct packing_i_rsa_voxel {
  uint32_t cell;
  uint32_t at[3]; /* within the cell, in voxels */
} packing_i_rsa_voxel;

/* A list in blocks, so that growing never copies and a consumed block goes at once. */
enum { PACKING_I_VOXELS_A_BLOCK = 1 << 15 };

typedef struct packing_i_rsa_voxel_list {
  packing_i_rsa_voxel **block;
  size_t blocks;   /* in the table */
  size_t capacity; /* of the table */
  size_t count;    /* voxels */
} packing_i_rsa_voxel_list;

/* Cells are halved at most so often: a voxel is then 1e-9 of a cell wide. */
enum { PACKING_I_VOXEL_DEEPEST = 30 };

typedef struct packing_i_rsa_voxels {
  packing_i_rsa_voxel_list live;
  packing_i_rsa_voxel_list next; /* grows while a split is under way */
  size_t parents;                /* voxels to be split; at level 0 the cells themselves */
  size_t split;                  /* of them done */
  int level;                     /* of `live`; -1: there is none yet */
  double part;                   /* edge of a voxel in cells */
  unsigned char *mask;           /* children of the parents of one portion that stay */
} packing_i_rsa_voxels;

/* What a split needs to know. */
typedef struct packing_i_rsa_space {
  const packing_i_rsa_cells *cells;
  const packing_domain *domain;
  double r;
  int dim;
  int boxlike; /* the region of centres is the box of the cells */
  packing_context *context;
  packing_i_rsa_children children;
} packing_i_rsa_space;

/* Starts with all cells as the parents of the first split. */
packing_status packing_i_rsa_voxels_init(packing_i_rsa_voxels *voxels,
                                         const packing_i_rsa_space *space);
void packing_i_rsa_voxels_release(packing_i_rsa_voxels *voxels, packing_context *context);

/* Begins to split the live voxels. */
void packing_i_rsa_voxels_begin_split(packing_i_rsa_voxels *voxels);

/* Splits one portion of parents; *done tells whether it was the last. */
packing_status packing_i_rsa_voxels_split(packing_i_rsa_voxels *voxels,
                                          const packing_i_rsa_space *space, int *done);

static inline packing_i_rsa_voxel
packing_i_rsa_voxel_at(const packing_i_rsa_voxel_list *list, size_t i)
{
  return list->block[i / PACKING_I_VOXELS_A_BLOCK][i % PACKING_I_VOXELS_A_BLOCK];
}

/* The point at fractions t of a voxel. */
packing_vec3 packing_i_rsa_voxel_point(const packing_i_rsa_voxels *voxels,
                                       const packing_i_rsa_cells *cells,
                                       packing_i_rsa_voxel voxel, packing_vec3 t);

#endif
