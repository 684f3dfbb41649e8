/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_LATTICE_INTERNAL_H
#define PACKING_LATTICE_INTERNAL_H

/* A lattice is a sequence of sites, bottom first; the kinds differ in where site i is. */

#include "place_index.h"

/* Crystals: layers of rows. Fractions are of the conventional cell. */
typedef struct packing_i_crystal {
  packing_vec3 cell;    /* edges of the conventional cell [L] */
  packing_vec3 origin;  /* the first site */
  size_t n[3];          /* cells along each axis */
  size_t layers;        /* per cell along z */
  size_t rows;          /* per layer and cell along y */
  const double *offset; /* layers x rows x 2: y and x of each row */
} packing_i_crystal;

/* Reference cells: cubes of edge l, k[0] x k[1] a layer. */
typedef struct packing_i_cells {
  packing_vec3 origin;
  double edge;
  size_t k[2];
} packing_i_cells;

typedef struct packing_i_lattice {
  size_t sites;
  size_t next;  /* the next site */
  size_t count; /* particles asked; 0: all that fit */
  double spacing_r;
  double pending_r; /* drawn, not yet placed; 0: none */
  size_t pending_component;
  packing_i_stream sizes;
  packing_i_stream positions;
  packing_i_index index; /* what stands in the store */
  int obstacles;         /* whether it holds anything */
  int random;            /* cells, not a crystal */
  packing_i_crystal crystal;
  packing_i_cells cells;
} packing_i_lattice;

/* Lays out the sites. */
packing_status packing_i_crystal_start(packing_placer *placer, packing_i_lattice *lattice,
                                       packing_lattice_kind kind);
packing_status packing_i_cells_start(packing_placer *placer, packing_i_lattice *lattice,
                                     double edge);

/* Where site i is; for cells, for a particle of radius r. */
packing_vec3 packing_i_crystal_site(const packing_i_crystal *crystal, size_t i);
packing_vec3 packing_i_cells_site(packing_i_lattice *lattice, size_t i, double r,
                                  int dim);

#endif
