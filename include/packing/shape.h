/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SHAPE_H
#define PACKING_SHAPE_H

/** \file packing/shape.h
 *  Shapes of particles, and single bodies: a particle with a shape, or the wall of a
 *  container.
 *
 *  All that a placer asks of a pair of bodies is the gap between them, whether they
 *  overlap and how far one can go in a direction until they touch. A sphere (a disc in
 *  two dimensions) is built in and is the shape NULL; others come from functions of the
 *  user. A shape is immutable, reference-counted and can be shared by threads and
 *  contexts. */

#include <packing/domain.h>

PACKING_BEGIN_DECLS

/** The shape of a particle. */
typedef struct packing_shape packing_shape;

/** One body: a particle, or a wall. */
typedef struct packing_body {
  const packing_shape *shape; /**< NULL: a sphere (disc) */
  packing_vec3 centre;        /**< of the circumscribed sphere [L] */
  double r;                   /**< its radius, which is the size of the shape [L] */
  double orientation[4];      /**< unit quaternion w, x, y, z; 1, 0, 0, 0: as defined */
  const packing_domain
      *domain; /**< not NULL: the body is a wall of this container, and the
       fields above do not count */
  /** Of a wall: which of the container's, -1 the nearest one. Of box and rectangle 2 k is
   *  the low and 2 k + 1 the high side of axis k; of sphere, circle and annulus 0 the
   *  outer and 1 the inner wall; others count theirs from 0. */
  int wall;
} packing_body;

/** A sphere (disc) as a body.
 *  \param centre [L]
 *  \param r radius [L]
 *  \return the body */
static inline packing_body packing_body_sphere(packing_vec3 centre, double r)
{
  packing_body body;
  memset(&body, 0, sizeof body);
  body.centre = centre;
  body.r = r;
  body.orientation[0] = 1;
  body.wall = -1;
  return body;
}

/** What a shape of the user's own can do. All functions must be thread-safe; they are
 *  called with at least one body of this shape; the other may have it too, or be a
 *  sphere, or have any other shape that the pack holds. */
typedef struct packing_shape_def {
  size_t struct_size; /**< set by packing_shape_def_init() */
  const char *name;   /**< copied, as in "two-sphere cluster" */
  /** The gap: positive apart, 0 in outer contact, negative where the insides overlap [L];
   *  continuous (seed paper, equation 1). Never a wall. */
  double (*gap)(void *user, const packing_body *a, const packing_body *b);
  /** Whether the insides overlap; NULL: where the gap is negative. */
  int (*overlap)(void *user, const packing_body *a, const packing_body *b);
  /** How far `a` can go along the unit vector `direction` until it touches `b`, both
   *  apart; infinity: never (equation 4) [L]. NULL: found from the gap. */
  double (*distance)(void *user, const packing_body *a, const packing_body *b,
                     const packing_vec3 *direction);
  /** The least distance of the body's surface from the walls of a container, negative
   *  where it protrudes [L]. `wall` is -1 for all walls or the number of one; `normal`
   *  may be NULL. */
  double (*clearance)(void *user, const packing_body *a, const packing_domain *domain,
                      int wall, packing_vec3 *normal);
  /** Volume of the shape of size r [L^3]; 2D: area [L^2]. */
  double (*volume)(void *user, double r, int dim);
  /** Principal moments of inertia at density 1 and size r [L^5]; 2D: only [2], [L^4].
   *  NULL: the shape has none to tell. */
  void (*inertia)(void *user, double r, int dim, double moments[3]);
  void *user; /**< passed to the functions */
  /** Called once, when the shape is gone, never when making it failed; NULL is fine. */
  void (*release)(void *user);
} packing_shape_def;

/** Writes the defaults; called through packing_shape_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_shape_def_fill(packing_shape_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_shape_def_init(packing_shape_def *def)
{
  packing_shape_def_fill(def, sizeof *def);
}

/** Makes a shape from the user's functions.
 *  \param context NULL is fine
 *  \param def options; name, gap, clearance and volume have no default
 *  \param[out] shape the shape
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL); PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_shape_create_custom(
    packing_context *context, const packing_shape_def *def, packing_shape **shape);

/** Lets go of a shape; what was made from it keeps it.
 *  \param shape NULL is fine. Thread-safe */
PACKING_API void packing_shape_destroy(packing_shape *shape);

/** Takes one more hold of a shape; each needs its packing_shape_destroy().
 *  \param shape NULL is fine
 *  \return shape. Thread-safe */
PACKING_API packing_shape *packing_shape_retain(packing_shape *shape);

/** The name of a shape.
 *  \param shape NULL: a sphere
 *  \return a string that lives as long as the shape. Thread-safe */
PACKING_API const char *packing_shape_name(const packing_shape *shape);

/** Volume of a shape.
 *  \param shape NULL: a sphere (disc)
 *  \param r circumscribed radius [L]
 *  \param dim 2 or 3
 *  \return volume [L^3]; 2D: area [L^2]. Thread-safe */
PACKING_API double packing_shape_volume(const packing_shape *shape, double r, int dim);

/** Principal moments of inertia at density 1.
 *  \param shape NULL: a sphere (disc)
 *  \param r circumscribed radius [L]
 *  \param dim 2 or 3
 *  \param[out] moments [L^5]; 2D: only [2] counts, [L^4]; the others are 0
 *  \return 1; 0: the shape does not tell. Thread-safe */
PACKING_API int packing_shape_inertia(const packing_shape *shape, double r, int dim,
                                      double moments[3]);

/** The gap between two bodies of which one may be a wall (seed paper, equation 1).
 *  \param a,b the bodies, not both walls
 *  \return positive apart, 0 in contact, negative where they overlap [L]. Thread-safe */
PACKING_API double packing_body_gap(const packing_body *a, const packing_body *b);

/** The gap between a particle and a wall, and which way the wall faces.
 *  \param a a particle
 *  \param domain the container
 *  \param wall which of its walls, as in packing_body; -1: the nearest one
 *  \param[out] normal unit gradient of the gap, 0 where there is no such wall; NULL is
 *  fine
 *  \return as packing_body_gap(); infinity where the container has no wall of that
 *  number.
 *          Thread-safe */
PACKING_API double packing_body_wall_gap(const packing_body *a,
                                         const packing_domain *domain, int wall,
                                         packing_vec3 *normal);

/** Whether two bodies overlap (touching is none).
 *  \param a,b the bodies, not both walls
 *  \return 1 or 0. Thread-safe */
PACKING_API int packing_body_overlap(const packing_body *a, const packing_body *b);

/** The directional distance (seed paper, equations 4 to 10): how far `a` can go along
 *  `direction` until it touches `b`. Bodies that touch or overlap already: 0 where `a`
 *  moves nearer. Closed forms for spheres and the walls of built-in containers; else from
 *  the gap, to rounding, yet a touch as short as 2^-16 of the radius of `a` may be
 *  passed.
 *  \param a a particle, apart from b or touching it
 *  \param b a particle or a wall
 *  \param direction unit vector
 *  \return [L]; infinity: never. Thread-safe */
PACKING_API double packing_body_distance(const packing_body *a, const packing_body *b,
                                         const packing_vec3 *direction);

/** Whether and by how much a body lies inside a container.
 *  \param a a particle
 *  \param domain the container
 *  \param[out] normal direction that takes it away from the nearest wall; NULL is fine
 *  \return the least distance of its surface from the walls, negative where it protrudes
 *  [L].
 *          Thread-safe */
PACKING_API double packing_body_clearance(const packing_body *a,
                                          const packing_domain *domain,
                                          packing_vec3 *normal);

PACKING_END_DECLS

#endif
