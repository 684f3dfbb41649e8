/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_DELAUNAY_INTERNAL_H
#define PACKING_DELAUNAY_INTERNAL_H

/* The regular triangulation (power or weighted Delaunay triangulation) of spheres, or of discs:
 * of centres p with weights r^2, the simplices that have an empty orthogonal sphere. Its dual is
 * the power (Laguerre) diagram. doc/methods/pores.md tells the method.
 *
 * Decisions are exact, and ties are broken as if each weight were moved by an infinitesimal of its
 * own, ordered by position (x, then y, z, r, index): the set of cells depends on the spheres only,
 * neither on their numbering nor, for spheres moved by one exact vector, on where they stand, and
 * no cell is flat.
 *
 * A ghost vertex closes the hull, so every cell has dim + 1 neighbours. */

#include "base_internal.h"

/* No cell; the ghost vertex; a sphere without a cell. */
#define PACKING_I_DELAUNAY_NONE UINT32_MAX

typedef struct packing_i_delaunay_point {
  double x[3]; /* scaled: see delaunay.c */
  double r;
} packing_i_delaunay_point;

/* Three vertices and neighbours in two dimensions. Neighbour k is across the facet opposite to
 * vertex k. A cell of real vertices is oriented: det(v1 - v0, v2 - v0, v3 - v0) > 0. One with the
 * ghost is so for whatever stands outside its facet in the ghost's place. 32 bytes. */
typedef struct packing_i_delaunay_cell {
  uint32_t v[4];
  uint32_t n[4];
} packing_i_delaunay_cell;

typedef struct packing_i_delaunay {
  packing_allocator allocator;
  int dim;
  int spanned; /* dimension of the centres' affine hull, -1 of none; no cells below dim */
  uint32_t count;                  /* of spheres */
  packing_i_delaunay_point *point; /* in the order of insertion */
  uint32_t *input;                 /* index that the caller knows each by */
  uint32_t *where;                 /* a cell of each; NONE: hidden */
  packing_i_delaunay_cell *cell;   /* real ones [0, real), then those with the ghost */
  uint32_t real;
  uint32_t cells;
  double scale; /* points are the caller's times this power of two */
} packing_i_delaunay;

/* What to triangulate: columns of doubles, finite; dim 2: z is not looked at; r NULL: 0. */
typedef struct packing_i_delaunay_source {
  int dim;
  size_t count;
  const double *x;
  const double *y;
  const double *z;
  const double *r;
} packing_i_delaunay_source;

/* PACKING_ERR_RANGE beyond 2^30 cells; PACKING_ERR_NOMEM. N log N for points that are spread
 * evenly; some 290 bytes a sphere in three dimensions. */
packing_status packing_i_delaunay_create(packing_context *context,
                                         const packing_i_delaunay_source *source,
                                         packing_i_delaunay **triangulation);

/* NULL is fine. */
void packing_i_delaunay_destroy(packing_i_delaunay *triangulation);

/* The cell that holds a point given in the caller's lengths (one of them where it lies on a facet),
 * or the ghost cell beyond whose facet it lies; walks there from `hint` (a cell, or NONE).
 * NONE where there are no cells. */
uint32_t packing_i_delaunay_locate(const packing_i_delaunay *triangulation,
                                   const packing_vec3 *point, uint32_t hint);

static inline int packing_i_delaunay_is_real(const packing_i_delaunay *t, uint32_t cell)
{
  return cell < t->real;
}

/* The caller's index of vertex k of a real cell. */
static inline uint32_t packing_i_delaunay_vertex(const packing_i_delaunay *t,
                                                 uint32_t cell, int k)
{
  return t->input[t->cell[cell].v[k]];
}

/* Across facet k of a cell: the neighbour's facet that leads back. */
static inline int packing_i_delaunay_mirror(const packing_i_delaunay *t, uint32_t cell,
                                            int k)
{
  const packing_i_delaunay_cell *n = &t->cell[t->cell[cell].n[k]];
  int m = 0;
  while (n->n[m] != cell)
    m++;
  return m;
}

#endif
