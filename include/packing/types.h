/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TYPES_H
#define PACKING_TYPES_H

/** \file packing/types.h
 *  Plain vectors, bounds, and packing_view: any host's arrays as a pack, without a copy. */

#include <packing/base.h>
#include <string.h>

PACKING_BEGIN_DECLS

/** A point or a direction. In two dimensions z is 0. */
typedef struct packing_vec3 {
  double x; /**< along x */
  double y; /**< along y */
  double z; /**< along z */
} packing_vec3;

/** An axis-aligned box, `lo` <= `hi`. */
typedef struct packing_bounds {
  packing_vec3 lo; /**< the corner with the smallest coordinates [L] */
  packing_vec3 hi; /**< the corner with the largest coordinates [L] */
} packing_bounds;

/** A coordinate axis. */
typedef enum packing_axis {
  PACKING_AXIS_X = 0, /**< x */
  PACKING_AXIS_Y = 1, /**< y */
  PACKING_AXIS_Z = 2  /**< z */
} packing_axis;

/** Periodic directions, as a sum. */
enum {
  PACKING_PERIODIC_X = 1, /**< periodic along x */
  PACKING_PERIODIC_Y = 2, /**< periodic along y */
  PACKING_PERIODIC_Z = 4  /**< periodic along z */
};

/** What the shares of a size distribution count. */
typedef enum packing_by {
  PACKING_BY_NUMBER = 0, /**< particles */
  PACKING_BY_MASS = 1    /**< mass of particles of one density: r^3 (discs: r^2) */
} packing_by;

/** A bond between two particles. */
typedef struct packing_bond {
  size_t i;     /**< index of a particle */
  size_t j;     /**< index of another */
  int32_t type; /**< its tag, or type */
} packing_bond;

/** One number of every particle: entry i stands at `(const char *)data + i * stride`. */
typedef struct packing_column {
  const void *data; /**< the first entry; NULL: the column is absent */
  size_t stride;    /**< bytes from an entry to the next */
} packing_column;

/** A pack as somebody's arrays, borrowed for the length of a call. `x`, `y`, `r` are
 *  needed, `z` in three dimensions; the rest may be absent. Doubles must be aligned as
 *  doubles. */
typedef struct packing_view {
  size_t struct_size;       /**< set by packing_view_init() */
  size_t count;             /**< particles */
  packing_column x;         /**< double, centre [L] */
  packing_column y;         /**< double, centre [L] */
  packing_column z;         /**< double, centre [L]; absent: 0 */
  packing_column r;         /**< double, bounding radius [L] */
  packing_column id;        /**< int64_t, the host's name of the particle */
  packing_column type;      /**< int32_t, 1 where absent */
  packing_column component; /**< int32_t, which part of a mixture */
  packing_column vx;        /**< double, velocity [L T^-1] */
  packing_column vy;        /**< double, velocity [L T^-1] */
  packing_column vz;        /**< double, velocity [L T^-1] */
  packing_column wx;        /**< double, spin [T^-1] */
  packing_column wy;        /**< double, spin [T^-1] */
  packing_column wz;        /**< double, spin [T^-1] */
  packing_column qw;        /**< double, orientation quaternion, real part [1] */
  packing_column qx;        /**< double, orientation quaternion [1] */
  packing_column qy;        /**< double, orientation quaternion [1] */
  packing_column qz;        /**< double, orientation quaternion [1] */
} packing_view;

/** Makes a view of nothing.
 *  \param[out] view all columns absent, count 0 */
static inline void packing_view_init(packing_view *view)
{
  memset(view, 0, sizeof *view);
  view->struct_size = sizeof *view;
}

/** Makes a view of four plain arrays.
 *  \param[out] view the view
 *  \param count particles
 *  \param x,y,z centres, each of `count` entries [L]; z may be NULL in two dimensions
 *  \param r radii, `count` entries [L] */
static inline void packing_view_init_arrays(packing_view *view, size_t count,
                                            const double *x, const double *y,
                                            const double *z, const double *r)
{
  packing_view_init(view);
  view->count = count;
  view->x.data = x;
  view->y.data = y;
  view->z.data = z;
  view->r.data = r;
  view->x.stride = view->y.stride = view->z.stride = view->r.stride = sizeof(double);
}

PACKING_END_DECLS

#endif
