/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Point location by a visibility walk: from a cell through any facet that parts it from the point.
 * It ends, since regular triangulations have no cycle of cells that hide each other as seen from
 * a point (H. Edelsbrunner, Combinatorica 10, 1990, 251) and orientation is exact. N^(1/3) steps
 * from anywhere, a few from a neighbour. */
#include "delaunay/builder.h"

uint32_t packing_i_delaunay_walk(const packing_i_delaunay *t, uint32_t from,
                                 const packing_i_delaunay_point *q)
{
  const packing_i_delaunay_point *p[4];
  const int ghost = packing_i_delaunay_corners(t, from, q, p);
  uint32_t cell = ghost >= 0 ? t->cell[from].n[ghost] : from;
  uint32_t last = PACKING_I_DELAUNAY_NONE;
  for (int k = 0; k <= t->dim;) {
    if (k == 0 && packing_i_delaunay_corners(t, cell, q, p) >= 0)
      return cell;
    const uint32_t next = t->cell[cell].n[k];
    const packing_i_delaunay_point *corner = p[k];
    p[k] = q;
    const int beyond = next != last && packing_i_delaunay_orient(t->dim, p) < 0;
    p[k] = corner;
    k++;
    if (beyond) {
      last = cell;
      cell = next;
      k = 0;
    }
  }
  return cell;
}

uint32_t packing_i_delaunay_locate(const packing_i_delaunay *t, const packing_vec3 *point,
                                   uint32_t hint)
{
  if (t->cells == 0)
    return PACKING_I_DELAUNAY_NONE;
  const packing_i_delaunay_point q = {
      {point->x * t->scale, point->y * t->scale, t->dim == 3 ? point->z * t->scale : 0},
      0};
  return packing_i_delaunay_walk(t, hint < t->cells ? hint : 0, &q);
}
