/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_CUT_INTERNAL_H
#define PACKING_CUT_INTERNAL_H

/* What a ball, a container and a cell have in common; as slices across an axis u and v lie in
 * the slice and h is its height. */

#include "domain_kinds.h"

/* The question. */
typedef struct packing_i_cut_job {
  const packing_i_domain_body *body; /* NULL: all space */
  const packing_i_cell *cell;
  packing_bounds box; /* of the cell and of a container that is a box */
  packing_vec3 centre;
  double r;
  double tolerance;
  int dim;
} packing_i_cut_job;

static inline double packing_i_cut_lo(const packing_i_cut_job *j, int k)
{
  return packing_i_component(j->box.lo, k);
}

static inline double packing_i_cut_hi(const packing_i_cut_job *j, int k)
{
  return packing_i_component(j->box.hi, k);
}

static inline int packing_i_is_revolution(const packing_i_domain_body *body)
{
  return body != NULL &&
         body->ops->signed_distance == packing_i_revolution_signed_distance;
}

static inline int packing_i_is_round(const packing_i_domain_body *body)
{
  return body != NULL && body->ops->signed_distance == packing_i_round_signed_distance;
}

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

/* What the errors are relative to: the ball, else the container, else the cell. */
double packing_i_cut_reference(const packing_i_cut_job *job);

/* The volume by slices, or in the plane by one; *error grows by its error. Not for custom
 * containers. */
double packing_i_cut_slices(const packing_i_cut_job *job, double *error);

#endif
