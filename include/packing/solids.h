/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SOLIDS_H
#define PACKING_SOLIDS_H

/** \file packing/solids.h
 *  Containers made of parts: polygons with holes in the plane z = 0, and unions, intersections
 *  and differences of any two containers of one dimension. And the point of any container that
 *  is farthest from its walls. */

#include <packing/domain.h>

PACKING_BEGIN_DECLS

/** Options of packing_domain_create_polygon(). */
typedef struct packing_domain_polygon_def {
  size_t struct_size; /**< set by packing_domain_polygon_def_init() */
  size_t count;       /**< vertices of all rings together, at least 3 */
  const double *x;    /**< their coordinates, `count` entries [L]; copied */
  const double *y;    /**< the same along y [L] */
  size_t rings;       /**< closed lines; default 1 */
  const size_t
      *sizes; /**< vertices of each ring, `rings` entries that add up to count, each
                            at least 3; NULL: one ring of all */
  /** What each ring is said to be, `rings` entries: 1 a hole, 0 an outer ring; held against
   *  where it lies. NULL (default): where it lies says it. */
  const int *holes;
} packing_domain_polygon_def;

/** Writes the defaults; called through packing_domain_polygon_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_polygon_def_fill(packing_domain_polygon_def *def,
                                                 size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_polygon_def_init(packing_domain_polygon_def *def)
{
  packing_domain_polygon_def_fill(def, sizeof *def);
}

/** Makes a polygon in the plane z = 0, in one or more pieces, with holes. A ring is closed from
 *  its last vertex to its first (which is not repeated) and may run either way. A point is
 *  inside when it lies within an odd number of rings (even-odd rule): a ring within a ring is a
 *  hole, a ring within a hole an island. Rings may neither cross nor touch, themselves or one
 *  another; what comes as close as the rounding of a coordinate touches.
 *
 *  Distances are exact and take logarithmic time, volumes of parts of discs are closed forms.
 *  The area of an inset is computed to 1e-4, by subdivision.
 *  \param context NULL is fine
 *  \param def options; count, x and y have no default
 *  \param[out] domain the container, of kind "polygon"
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE (count,
 *          rings, sizes, holes); PACKING_ERR_GEOMETRY (repeated vertices, rings that cross or
 *          touch, a ring without an area, a hole outside: the message names ring, vertex, both
 *          from 1, and point; the log record's index is the vertex, from 0 over all rings);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. Time goes with n log n */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_polygon(
    packing_context *context, const packing_domain_polygon_def *def,
    packing_domain **domain);

/** How two containers are combined. */
typedef enum packing_operation {
  PACKING_UNION = 0,        /**< what lies in one of them, or both */
  PACKING_INTERSECTION = 1, /**< what lies in both */
  PACKING_DIFFERENCE = 2    /**< what lies in `a` and not in `b` */
} packing_operation;

/** Options of packing_domain_create_combination(). */
typedef struct packing_domain_combination_def {
  size_t struct_size;          /**< set by packing_domain_combination_def_init() */
  packing_operation operation; /**< default ::PACKING_UNION */
  packing_domain *a;           /**< a container; the combination keeps it */
  packing_domain *b;           /**< another of the same dimension; kept too */
  double volume;           /**< of the combination [L^3], [L^2]; 0 (default): computed */
  double volume_tolerance; /**< relative error of a computed volume [1], default 1e-4 */
} packing_domain_combination_def;

/** Writes the defaults; called through packing_domain_combination_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_combination_def_fill(packing_domain_combination_def *def,
                                                     size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void
packing_domain_combination_def_init(packing_domain_combination_def *def)
{
  packing_domain_combination_def_fill(def, sizeof *def);
}

/** Makes the union, intersection or difference of two containers, which may be combinations
 *  themselves. Periodic and open-topped containers are not combined.
 *
 *  Inside, the signed distance is that to the nearest wall of the combination, seams between
 *  the two containers included. It is exact where the nearest wall is that of one of them; near
 *  seams it is too small by 1e-9 of itself, or, where a piece of a seam is nearly equally far
 *  all along and beside the walls of custom containers, meshes and corners of polygons, by what
 *  some 1400 cells of space leave open: never too large, so that no particle protrudes. A
 *  particle may straddle a seam that the union covers; gaps between the two as narrow as the
 *  rounding of a coordinate are no gaps. Outside the distance is never too large in size (as
 *  that of a custom container). Where an operand's own distance outside is too small, as that of
 *  the inset of a combination may be, so is that of what it is taken away from.
 *
 *  The volume is exact where both are boxes, rectangles, spheres or circles, or one of them is
 *  cut by a box, a sphere, a circle or a cylinder, or where they lie apart; else it is computed
 *  as that of a custom container is, from the distances of both.
 *  \param context NULL is fine
 *  \param def options; a and b have no default
 *  \param[out] domain the container, of kind "union", "intersection" or "difference"
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL, different dimensions);
 *          PACKING_ERR_RANGE (operation, volume_tolerance; a computed volume misses it);
 *          PACKING_ERR_UNSUPPORTED (a periodic or an open-topped container; more than 64
 *          containers in all); PACKING_ERR_GEOMETRY (nothing is left, or less than can be told
 *          from nothing; a custom container's distance that is NaN); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_combination(
    packing_context *context, const packing_domain_combination_def *def,
    packing_domain **domain);

/** Finds the point of a container that is farthest from its walls.
 *
 *  Closed forms for box, rectangle, bodies of revolution and round containers. Of all points
 *  that are equally far they give the one lowest in z, then in y, then in x; along periodic
 *  directions the middle of the cell. Without any wall: the middle of the cell, at a distance
 *  of infinity. Below an open top the point stays in the region.
 *
 *  For the other kinds: branch and bound on the signed distance, cells cut in three (so that
 *  what is symmetric keeps its centre line), the most promising first, of equal ones the one
 *  lowest in z, then y, then x. It ends when no point can be farther by more than the tolerance,
 *  or after some 1e6 distances (unions: 1e5) and 100 MB, with a warning in the log: then the
 *  best point met is given, its distance being what it is.
 *  \param context NULL is fine
 *  \param domain the container
 *  \param tolerance how far from the largest distance the answer may stay [L], > 0; ignored by
 *         closed forms
 *  \param[out] point where, in the region [L]
 *  \param[out] distance the signed distance there [L]; NULL is fine
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (tolerance);
 *          PACKING_ERR_GEOMETRY (custom: no point inside was found, or a distance is NaN);
 *          PACKING_ERR_NOMEM. The same point for any context */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_domain_innermost(packing_context *context, const packing_domain *domain,
                         double tolerance, packing_vec3 *point, double *distance);

PACKING_END_DECLS

#endif
