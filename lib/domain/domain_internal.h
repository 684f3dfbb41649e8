/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_DOMAIN_INTERNAL_H
#define PACKING_DOMAIN_INTERNAL_H

/* What a container is inside, and what placers and measures may use of it without a call
 * through a pointer: packing_i_domain_planar(), packing_i_domain_axis() and
 * packing_i_domain_separation(). */

#include "base_internal.h"
#include "vec.h"
#include <packing/domain.h>
#include <stdatomic.h>

typedef struct packing_i_domain_body packing_i_domain_body;

/* A wall near a point. */
typedef struct packing_i_near_wall {
  double distance;     /* of the point, positive inside */
  packing_vec3 normal; /* unit, into the container */
  int wall;            /* which of the container's walls, from 0 */
} packing_i_near_wall;

enum { PACKING_I_NEAR_WALLS = 6 };

/* One kind of container. */
typedef struct packing_i_domain_ops {
  const char *name;
  const char *reference;
  double (*signed_distance)(const packing_i_domain_body *body, const packing_vec3 *point,
                            packing_vec3 *normal); /* `normal` may be NULL */
  /* A cheaper function that is positive inside, 0 at the same walls, and changes no faster: what
   * volumes by subdivision ask for. NULL: signed_distance. */
  double (*side)(const packing_i_domain_body *body, const packing_vec3 *point,
                 packing_vec3 *normal);
  /* signed_distance >= r, the cheap way; NULL: no cheaper way. */
  int (*holds)(const packing_i_domain_body *body, const packing_vec3 *centre, double r);
  /* packing_i_domain_clear(); NULL: no cheaper way than the distance. */
  int (*clear)(const packing_i_domain_body *body, const packing_vec3 *point, double r);
  /* packing_i_domain_near_walls(). */
  int (*near_walls)(const packing_i_domain_body *body, const packing_vec3 *point,
                    double reach, packing_i_near_wall near[PACKING_I_NEAR_WALLS]);
  /* Moves every wall of *body inwards by d > 0 and corrects bounds and volume; a volume of 0
   * says that nothing is left. */
  packing_status (*inset)(packing_context *context, packing_i_domain_body *body,
                          double d);
  /* The part of a ball or disc that the region holds and an error, where the ball is neither
   * wholly inside nor wholly outside; -1 when the container misbehaves (custom only). */
  int (*sphere_volume)(const packing_i_domain_body *body, const packing_vec3 *centre,
                       double r, double tolerance, double *volume, double *error);
  /* After *body was made as an inset of `from`: shares what they share. NULL: nothing. */
  void (*inherit)(packing_i_domain_body *body, packing_domain *from);
  void (*release)(const packing_i_domain_body *body); /* NULL: nothing to release */
} packing_i_domain_ops;

/* Box and rectangle. Infinite where there is no wall, so that no test is needed. */
typedef struct packing_i_planar {
  double wall_lo[3], wall_hi[3]; /* walls */
  double cut_lo[3], cut_hi[3];   /* borders of the region: walls and the open top */
} packing_i_planar;

/* A straight wall of a body of revolution, in the half plane of rho (distance from the axis)
 * and h (height above the base). */
typedef struct packing_i_wall {
  double a, b, c; /* distance from it, positive inside: a rho + b h + c, a a + b b = 1 */
  double from,
      to; /* its face: -c (a, b) + t (-b, a) with t in [from, to], maybe infinite */
} packing_i_wall;

enum { PACKING_I_WALLS = 4, PACKING_I_KNOTS = 8 };

/* Cylinder, tube, cone and silo: a convex polygon turned about an axis. */
typedef struct packing_i_revolution {
  int axis, walls, knots;
  packing_vec3 base;
  packing_i_wall wall[PACKING_I_WALLS];
  double open_height; /* of the open top; +infinity: none */
  double
      knot[PACKING_I_KNOTS]; /* heights where the region begins, bends and ends, rising */
} packing_i_revolution;

/* Sphere, circle and annulus. */
typedef struct packing_i_round {
  packing_vec3 centre;
  double outer, inner; /* inner 0: no inner wall */
} packing_i_round;

/* The user's functions. */
typedef struct packing_i_custom {
  double (*signed_distance)(void *user, const packing_vec3 *point, packing_vec3 *normal);
  void (*release)(void *user);
  void *user;
  double volume_tolerance;
  double inset;         /* taken off the distance */
  packing_domain *root; /* of an inset: the domain that owns the user's data; else NULL */
} packing_i_custom;

/* Edges, a tree over them, and what an inset took off. */
typedef struct packing_i_polygon {
  const struct packing_i_polygon_data *data;
  double inset;
  packing_domain *root; /* of an inset: the domain that owns the data; else NULL */
} packing_i_polygon;

/* Two containers and how they are combined. */
typedef struct packing_i_combination {
  const struct packing_i_combination_data *data;
  double inset;
  double volume_tolerance;
  packing_domain *root; /* of an inset: the domain that owns the data; else NULL */
} packing_i_combination;

/* The inside of a mesh; its surface stands in mesh/surface_internal.h. */
typedef struct packing_i_meshed {
  struct packing_i_surface *surface;
  double inset;         /* taken off the distance */
  packing_domain *root; /* of an inset: the domain that owns the surface; else NULL */
} packing_i_meshed;

struct packing_i_domain_body {
  const packing_i_domain_ops *ops;
  int dim;
  unsigned periodic;     /* sum of PACKING_PERIODIC_ */
  int walls;             /* the numbers of near walls are below this */
  int open_axis;         /* the open top is the high side of the bounds here; -1: none */
  double volume;         /* of the region */
  packing_bounds bounds; /* of the region */
  packing_vec3 period;   /* size of the cell; +infinity where not periodic */
  union {
    packing_i_planar planar;
    packing_i_revolution revolution;
    packing_i_round round;
    packing_i_custom custom;
    packing_i_polygon polygon;
    packing_i_combination combination;
    packing_i_meshed mesh;
  } as;
};

struct packing_domain {
  atomic_size_t holds;
  packing_allocator allocator; /* a copy: a domain outlives its context */
  packing_i_domain_body body;
};

/* The walls of a box or rectangle, else NULL. A loop over many points then needs no call:
 * a ball is held where x - wall_lo[k] >= r and wall_hi[k] - x >= r for all k. */
const packing_i_planar *packing_i_domain_planar(const packing_domain *domain);

/* The axis of a cylinder, tube, cone or silo (a packing_axis), else -1. */
int packing_i_domain_axis(const packing_domain *domain);

/* A sphere, circle or annulus, else NULL. */
const packing_i_round *packing_i_domain_round(const packing_domain *domain);

/* The mesh that a container is the inside of, else NULL (also for its insets). */
const packing_mesh *packing_i_domain_mesh(const packing_domain *domain);

/* Radii of the slice of a body of revolution at a height within the region. */
double packing_i_revolution_outer(const packing_i_revolution *p, double h);
double packing_i_revolution_inner(const packing_i_revolution *p, double h);

/* The walls whose distance from a point inside (or a little outside) is less than reach, each
 * once, in the order of their numbers
 * (of meshes, polygons and combinations nearest first); returns how many. Every wall is taken as far as its
 * surface goes on, which in the built-in containers makes a difference only outside: there the
 * distance is negative and the normal still shows into the container.
 *
 * The numbers: of box and rectangle 2 k for the low and 2 k + 1 for the high side of axis k; of
 * cylinder, tube, cone and silo those of packing_i_revolution.wall; of sphere, circle and
 * annulus 0 for the outer and 1 for the inner wall; a custom container has one wall, the nearest,
 * 0; of a polygon of n vertices i for the edge from vertex i, and n + i for vertex i where that is
 * a wall of its own (a corner that bends into the container); of a combination those of the
 * first container, then those of the second one behind them, then one for the nearest seam. Of
 * more than PACKING_I_NEAR_WALLS walls of polygons and combinations the nearest are given, nearest
 * first. A number stays that of its wall wherever the point is. On the axis or in the centre of a
 * round wall, which is equally near all around, one direction stands for all. Thread-safe,
 * constant time.
 *
 * The walls of a mesh are faces (triangles in one plane are one), edges and vertices: those where
 * the distance from the point has a local minimum over the surface, seen from the side that the
 * point is on, nearest first. Nothing goes on beyond an edge. `normal` leads from the nearest point of the feature to the point, into the container.
 * Of a point outside with none in reach the nearest is told. Cost: the triangles in reach. */
static inline int
packing_i_domain_near_walls(const packing_domain *domain, const packing_vec3 *point,
                            double reach, packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  return domain->body.ops->near_walls(&domain->body, point, reach, near);
}

/* 1 only if a point is certainly at least r from all walls; of a mesh a point deep inside is told
 * in constant time, and 0 may stand for "not known without more work". */
static inline int packing_i_domain_clear(const packing_domain *domain,
                                         const packing_vec3 *point, double r)
{
  const packing_i_domain_ops *ops = domain->body.ops;
  if (ops->clear != NULL)
    return ops->clear(&domain->body, point, r);
  return ops->signed_distance(&domain->body, point, NULL) >= r;
}

/* Whether a ball lies wholly inside: at least r from the walls and below an open top. */
int packing_i_domain_keeps_whole(const packing_domain *domain, const packing_vec3 *centre,
                                 double r);

/* A convex cell, to cut containers and particles with: a box, or what a box and a cylinder or
 * a ball have in common. */
typedef enum packing_i_cell_kind {
  PACKING_I_CELL_BOX,
  PACKING_I_CELL_CYLINDER, /* in two dimensions a disc, as is a ball */
  PACKING_I_CELL_BALL
} packing_i_cell_kind;

typedef struct packing_i_cell {
  packing_i_cell_kind kind;
  packing_bounds box; /* infinite entries are fine */
  int axis;           /* of the cylinder */
  packing_vec3 centre;
  double radius;
} packing_i_cell;

/* The volume (area) that a container, a cell and, when r > 0, a ball have in common, and its
 * error: a bound for closed forms, else an estimate. The tolerance is relative to the ball, or
 * to the container when r is 0. Without a ball the cell must be bounded in the container's
 * periodic directions. 0, or -1 when a custom container misbehaves. Thread-safe. */
int packing_i_domain_cell_volume(const packing_domain *domain, const packing_i_cell *cell,
                                 const packing_vec3 *centre, double r, double tolerance,
                                 double *volume, double *error);

/* How large the radius of a round cell must be to hold the container; along periodic directions
 * that the cell grows into, half the smallest period. */
double packing_i_domain_reach(const packing_domain *domain, const packing_i_cell *cell);

/* A plane through a container of three dimensions, in which (u, v) is the point
 * origin + u u_axis + v v_axis; all unit vectors, u_axis x v_axis = normal. */
typedef struct packing_i_plane {
  packing_vec3 origin, u_axis, v_axis, normal;
} packing_i_plane;

/* A rectangle that holds the container's section (of a periodic cell: cut at its borders). 0:
 * the plane misses it. */
int packing_i_domain_section_window(const packing_domain *domain,
                                    const packing_i_plane *plane, double lo[2],
                                    double hi[2]);

/* The area that the container's section, and when r > 0 the disc round (u, v), have in common,
 * and its error: a bound for closed forms, else an estimate. The tolerance is relative to the
 * disc or the window. 0, or -1 when a custom container misbehaves. Thread-safe. */
int packing_i_domain_section_area(const packing_domain *domain,
                                  const packing_i_plane *plane, double u, double v,
                                  double r, double tolerance, double *area,
                                  double *error);

/* Whether a point lies in the region; in a periodic cell, in the cell. */
int packing_i_domain_contains(const packing_domain *domain, const packing_vec3 *point);

/* One component of a separation. The difference is exact for neighbours in a cell; on a tie
 * the shorter way round is the direct one. Odd: swapping the ends changes the sign alone. */
static inline double packing_i_nearest_image(double difference, double period)
{
  const double half = 0.5 * period;
  if (difference > half)
    difference -= period;
  else if (difference < -half)
    difference += period;
  return fabs(difference) > half ? remainder(difference, period) : difference;
}

/* packing_domain_separation(), inline. */
static inline packing_vec3 packing_i_domain_separation(const packing_domain *domain,
                                                       packing_vec3 a, packing_vec3 b)
{
  const packing_vec3 period = domain->body.period;
  return packing_i_vec(packing_i_nearest_image(b.x - a.x, period.x),
                       packing_i_nearest_image(b.y - a.y, period.y),
                       packing_i_nearest_image(b.z - a.z, period.z));
}

#endif
