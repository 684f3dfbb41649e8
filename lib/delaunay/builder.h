/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_BUILDER_H
#define PACKING_BUILDER_H

/* A triangulation at work: what insertion keeps beside it. */

#include "delaunay/delaunay_internal.h"
#include "delaunay/predicates.h"

typedef struct packing_i_delaunay_list {
  uint32_t *entry;
  uint32_t count;
  uint32_t room;
} packing_i_delaunay_list;

typedef struct packing_i_delaunay_builder {
  packing_context *context;
  packing_i_delaunay *t;
  packing_i_exact exact;
  unsigned char *mark;               /* of each cell: enum in insert.c */
  uint32_t room;                     /* cells there is memory for */
  uint32_t hint;                     /* a cell of the last point inserted */
  packing_i_delaunay_list conflicts; /* cells that the new point ends */
  packing_i_delaunay_list spared;    /* cells around them */
  packing_i_delaunay_list facets;    /* between: a cell in conflict * 4 + k */
  packing_i_delaunay_list free;      /* cells to be used again */
} packing_i_delaunay_builder;

/* Points of a cell, the ghost's place taken by `q`; returns the ghost's place or -1. */
static inline int packing_i_delaunay_corners(const packing_i_delaunay *t, uint32_t cell,
                                             const packing_i_delaunay_point *q,
                                             const packing_i_delaunay_point *p[4])
{
  const uint32_t *v = t->cell[cell].v;
  int ghost = -1;
  for (int k = 0; k <= t->dim; k++) {
    if (v[k] == PACKING_I_DELAUNAY_NONE)
      ghost = k;
    p[k] = v[k] == PACKING_I_DELAUNAY_NONE ? q : &t->point[v[k]];
  }
  return ghost;
}

/* The cell that holds `q`, or the ghost cell beyond whose facet it lies. */
uint32_t packing_i_delaunay_walk(const packing_i_delaunay *t, uint32_t from,
                                 const packing_i_delaunay_point *q);

/* Takes up point `v`, which then has cells or is hidden, as others may become. */
packing_status packing_i_delaunay_insert(packing_i_delaunay_builder *b, uint32_t v);

/* Makes room for `more` further cells. */
packing_status packing_i_delaunay_reserve(packing_i_delaunay_builder *b, uint32_t more);

#endif
