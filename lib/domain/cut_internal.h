/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_CUT_INTERNAL_H
#define PACKING_CUT_INTERNAL_H

/* What a ball, a container and a cell have in common, as slices across an axis: u and v lie in
 * the slice, h is its height. */

#include "domain_kinds.h"

/* A radius over the height: of a disc round (u, v), or half the width of a strip. */
typedef struct packing_i_curve {
  enum { PACKING_I_CURVE_BALL, PACKING_I_CURVE_LINE } kind;
  double a, b; /* sqrt(a^2 - (h - b)^2), or a + b h */
  double u, v;
  int strip; /* it limits u (0) or v (1); -1: a disc */
} packing_i_curve;

enum { PACKING_I_CURVES = PACKING_I_WALLS + 2, PACKING_I_HEIGHTS = 256 };

typedef struct packing_i_cut {
  double lo[2], hi[2]; /* borders of u and v, maybe infinite */
  double low, high;    /* of the heights */
  int curves;
  packing_i_curve curve[PACKING_I_CURVES];
  int walls, wall; /* curves of one container: the least counts; the first of them */
} packing_i_cut;

typedef struct packing_i_heights {
  int count;
  double h[PACKING_I_HEIGHTS];
} packing_i_heights;

static inline double packing_i_curve_radius(const packing_i_curve *c, double h)
{
  if (c->kind == PACKING_I_CURVE_LINE)
    return c->a + c->b * h;
  const double s = (c->a - (h - c->b)) * (c->a + (h - c->b));
  return s > 0 ? sqrt(s) : 0;
}

/* The heights between which the area of the slice is smooth, rising, with both ends. */
void packing_i_cut_heights(const packing_i_cut *cut, packing_i_heights *heights);

#endif
