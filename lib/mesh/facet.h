/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FACET_H
#define PACKING_FACET_H

/* The nearest point of a triangle. Where the foot of the perpendicular is on the inner side of all
 * three edges it is that; else it lies on an edge that the foot is beyond. The distance from the
 * face is then the product with a normal that is exact to the last bits (mesh/exact_triangles.c),
 * which no thin triangle spoils. Regions as C. Ericson, Real-Time Collision Detection (2005),
 * 5.1.5, tells them apart, without his barycentric quotients. */

#include "mesh/surface_internal.h"

static inline packing_vec3 packing_i_facet_corner(const packing_i_facet *f, int i)
{
  return packing_i_mesh_vec(f->corner[i]);
}

/* Positive where a point's foot is on the inner side of edge i. */
static inline double packing_i_facet_side(const packing_i_facet *f, int i,
                                          packing_vec3 point)
{
  const packing_vec3 a = packing_i_facet_corner(f, i),
                     b = packing_i_facet_corner(f, i == 2 ? 0 : i + 1);
  const packing_vec3 inner =
      packing_i_cross(packing_i_mesh_vec(f->normal), packing_i_sub(b, a));
  return packing_i_dot(inner, packing_i_sub(point, a));
}

static inline void packing_i_facet_try_edge(const packing_i_facet *f, int i,
                                            packing_vec3 point, packing_i_nearest *best)
{
  const packing_vec3 a = packing_i_facet_corner(f, i),
                     b = packing_i_facet_corner(f, i == 2 ? 0 : i + 1);
  const packing_vec3 e = packing_i_sub(b, a);
  packing_vec3 away = packing_i_sub(point, a);
  const double along = packing_i_dot(away, e), all = packing_i_dot(e, e);
  int feature = PACKING_I_FEATURE_CORNER + i;
  if (along >= all) {
    away = packing_i_sub(point, b);
    feature = PACKING_I_FEATURE_CORNER + (i == 2 ? 0 : i + 1);
  } else if (along > 0) {
    away = packing_i_sub(away, packing_i_scale(e, along / all));
    feature = PACKING_I_FEATURE_EDGE + i;
  }
  const double square = packing_i_dot(away, away);
  if (square < best->square) {
    best->square = square;
    best->away = away;
    best->feature = feature;
  }
}

/* square = HUGE_VAL: farther than sqrt(limit) for certain. */
static inline packing_i_nearest packing_i_facet_nearest(const packing_i_facet *f,
                                                        packing_vec3 point, double limit)
{
  packing_i_nearest best = {HUGE_VAL, {0, 0, 0}, 0, 0};
  const packing_vec3 n = packing_i_mesh_vec(f->normal);
  const double height =
      packing_i_dot(n, packing_i_sub(point, packing_i_facet_corner(f, 0)));
  int beyond = 0;
  if (height * height > limit)
    return best;
  for (int i = 0; i < 3; i++)
    if (packing_i_facet_side(f, i, point) < 0) {
      packing_i_facet_try_edge(f, i, point, &best);
      beyond = 1;
    }
  if (!beyond) {
    best.square = height * height;
    best.away = packing_i_scale(n, height);
    best.feature = PACKING_I_FEATURE_FACE;
  }
  return best;
}

/* Whether no point of a child of the tree can be where the distance from `point` (in units of the
 * mesh's) has a local minimum: no way there is along a normal of its cone. A ball's ways are within
 * asin(radius / distance) of that to its middle. `inside`: the point is known to be; else ways
 * against the normals count, too. */
static inline int packing_i_cone_faces_away(const packing_i_cone *c,
                                            const double point[3], int inside)
{
  const double x = (double)c->middle[0] - point[0], y = (double)c->middle[1] - point[1],
               z = (double)c->middle[2] - point[2];
  const double radius = (double)c->radius, sine = (double)c->sine;
  const double beyond = x * x + y * y + z * z - radius * radius;
  const double along =
      x * (double)c->axis[0] + y * (double)c->axis[1] + z * (double)c->axis[2];
  const double most = (inside ? along : fabs(along)) + sine * radius;
  return beyond > 0 && (most < 0 || most * most < (1 - sine * sine) * beyond);
}

/* The squared distance of a point from a box of the tree. */
static inline double packing_i_node_square(const packing_i_mesh_node *node, int side,
                                           const double p[3])
{
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    const double low = node->lo[side][k] - p[k], high = p[k] - node->hi[side][k];
    const double gap = low > high ? low : high;
    sum += gap > 0 ? gap * gap : 0;
  }
  return sum;
}

#endif
