/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PREDICATES_H
#define PACKING_PREDICATES_H

/* The two questions that decide everything, answered exactly. */

#include "delaunay/delaunay_internal.h"

/* Room for what is computed with exactly, allocated once. */
typedef struct packing_i_exact {
  double *room;
} packing_i_exact;

packing_status packing_i_exact_create(packing_context *context, packing_i_exact *exact);

/* Sign of det(p1 - p0, ... p_dim - p0): +1, 0, -1. */
int packing_i_delaunay_orient(int dim, const packing_i_delaunay_point *const p[4]);

/* For dim + 1 points of positive orientation: +1 where q is nearer than orthogonal to their
 * orthogonal sphere (its power is less than that of the lifted plane), 0 on it, -1 beyond. */
int packing_i_delaunay_side(const packing_i_exact *exact, int dim,
                            const packing_i_delaunay_point *const p[4],
                            const packing_i_delaunay_point *q);

/* The same by expansions alone; rows[i] are the differences that decide (see exact.c). */
int packing_i_exact_orient(int dim, const packing_i_delaunay_point *const p[4]);
int packing_i_exact_side(const packing_i_exact *exact, int dim,
                         const packing_i_delaunay_point *const p[4],
                         const packing_i_delaunay_point *q);

#endif
