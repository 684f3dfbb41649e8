/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SURFACE_INTERNAL_H
#define PACKING_SURFACE_INTERNAL_H

/* A sound mesh as the border of a region: distances, features near a point, balls cut. */

#include "mesh/mesh_internal.h"

/* A triangle and its normal, in the order of the tree's leaves: 96 bytes. */
typedef struct packing_i_facet {
  double corner[3][3];
  double normal[3];
} packing_i_facet;

/* How far a cell's middle is from the surface at least, negative outside, and at most; in edges of
 * a cell. */
typedef struct packing_i_depth_cell {
  float least, most;
} packing_i_depth_cell;

/* A coarse grid of what is known of the distance. */
typedef struct packing_i_depth {
  double lo[3], edge;
  size_t cells[3];
  packing_i_depth_cell *value;
} packing_i_depth;

/* About a child of a node of the tree, in units of the mesh's: a ball around its box, and a cone
 * that holds the normals of its triangles and of those that touch them (cones.c). */
typedef struct packing_i_cone {
  float middle[3], radius;
  float axis[3], sine; /* of half its angle; above 1: there is none */
} packing_i_cone;

typedef struct packing_i_surface {
  packing_allocator allocator;
  packing_mesh *mesh;
  packing_i_facet *facet;
  uint32_t *slot;              /* of each triangle: its facet */
  uint32_t *twin;              /* of each half edge */
  uint32_t *edge;              /* of each half edge: which edge */
  size_t edges;                /* how many */
  packing_vec3 *edge_normal;   /* sum of the two normals */
  packing_vec3 *vertex_normal; /* sum of the normals by their angles */
  uint32_t *around; /* half edges that leave each vertex, one vertex after the other */
  uint32_t *around_first; /* of each vertex, and where the last one ends */
  uint32_t *patch; /* of each triangle: the lowest one of those in one plane with it */
  packing_i_cone *cone; /* two a node, as its children */
  packing_i_depth depth;
} packing_i_surface;

/* Takes a hold of the mesh, which must be sound. */
packing_status packing_i_surface_create(packing_context *context, packing_mesh *mesh,
                                        packing_i_surface **surface);
/* NULL is fine. */
void packing_i_surface_destroy(packing_i_surface *surface);

/* Features of a triangle: itself, edges 1 + i from corner i on, corners 4 + i. */
enum {
  PACKING_I_FEATURE_FACE = 0,
  PACKING_I_FEATURE_EDGE = 1,
  PACKING_I_FEATURE_CORNER = 4
};

/* The nearest point of the surface. */
typedef struct packing_i_nearest {
  double square;     /* of the distance */
  packing_vec3 away; /* from that point to the one asked about */
  uint32_t facet;    /* NONE: nothing within the limit */
  int feature;
} packing_i_nearest;

/* Looks no farther than sqrt(limit), and is content with anything nearer than sqrt(enough). On ties
 * the lowest triangle. */
packing_i_nearest packing_i_surface_nearest(const packing_i_surface *surface,
                                            const packing_vec3 *point, double limit,
                                            double enough);

/* The outward normal that decides the sign there: of the face, the edge or the corner, of any
 * length. */
packing_vec3 packing_i_surface_normal(const packing_i_surface *surface, uint32_t facet,
                                      int feature);

/* 1 where the point asked about is inside or on the surface. */
int packing_i_surface_is_inside(const packing_i_surface *surface,
                                const packing_i_nearest *nearest);

/* The gradient of the signed distance, which is positive inside. */
packing_vec3 packing_i_surface_gradient(const packing_i_surface *surface,
                                        const packing_i_nearest *nearest);

/* Features where the distance from a point has a local minimum, seen from the side that the point
 * is on (near.c). */
typedef struct packing_i_near_feature {
  double distance;
  packing_vec3 normal;
  uint32_t wall; /* patches, then edges, then vertices */
} packing_i_near_feature;

enum { PACKING_I_NEAR_FEATURES = 6 };

/* The numbers of walls are below this. */
static inline size_t packing_i_surface_walls(const packing_i_surface *surface)
{
  return surface->mesh->triangles + surface->edges + surface->mesh->vertices;
}

/* The nearest of those whose distance is below reach, the nearest first. Where a point outside has
 * none in reach, the nearest. */
int packing_i_surface_near(const packing_i_surface *surface, const packing_vec3 *point,
                           double reach,
                           packing_i_near_feature near[PACKING_I_NEAR_FEATURES]);

/* The cones (cones.c). */
packing_status packing_i_cones_create(packing_context *context,
                                      packing_i_surface *surface);

/* The grid (depth.c). */
packing_status packing_i_depth_create(packing_context *context,
                                      packing_i_surface *surface);

/* A bound of the signed distance: positive: at least that much inside; negative: at least that
 * much outside; 0: unknown. Constant time. */
double packing_i_surface_depth(const packing_i_surface *surface,
                               const packing_vec3 *point);

/* No less than the distance from the surface. Constant time. */
double packing_i_surface_most_depth(const packing_i_surface *surface,
                                    const packing_vec3 *point);

/* The part of a ball inside, and a bound of its error (ball.c). */
double packing_i_surface_ball(const packing_i_surface *surface,
                              const packing_vec3 *centre, double r, double *error);

#endif
