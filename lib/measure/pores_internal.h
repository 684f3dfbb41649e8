/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PORES_INTERNAL_H
#define PACKING_PORES_INTERNAL_H

/* The making of a pore network: spheres and their periodic copies are triangulated
 * (pores_copies.c), each cell gets its sphere (pores_cells.c), cells with one sphere become one
 * node, faces between nodes become constrictions (pores_faces.c), nodes may be merged
 * (pores_merge.c), and what is left is listed (pores.c). */

#include "delaunay/delaunay_internal.h"
#include "grid/grid_internal.h"
#include "measure/measure_internal.h"
#include "measure/tangent.h"
#include <packing/pores.h>

#define PACKING_I_PORES_NONE UINT32_MAX

/* Images are numbers: x 2^20 + y 2^10 + z periods. They add up as vectors do, and are ordered as
 * (x, y, z) are, as long as each stays within +-500. */
enum { PACKING_I_PORES_MOST_IMAGES = 500 };

static inline int32_t packing_i_image_code(const int image[3])
{
  return image[0] * (1 << 20) + image[1] * (1 << 10) + image[2];
}

static inline void packing_i_image_decode(int32_t code, int image[3])
{
  image[2] = ((code + 512) & 1023) - 512;
  code = (code - image[2]) / 1024;
  image[1] = ((code + 512) & 1023) - 512;
  image[0] = (code - image[1]) / 1024;
}

/* What a cell came to. */
typedef enum packing_i_pore_state {
  PACKING_I_PORE_SPHERE, /* it has one */
  PACKING_I_PORE_FLAT,
  PACKING_I_PORE_OUTSIDE,
  PACKING_I_PORE_CLOSED
} packing_i_pore_state;

/* A cell of the triangulation, each of a periodic cell's once: that whose first corner stands in
 * the cell. 128 bytes. */
typedef struct packing_i_pore_cell {
  uint32_t corner[4];    /* copies, sorted by (particle, image) */
  uint32_t neighbour[4]; /* across the facet opposite to each; NONE */
  int32_t shift[4];      /* image of each neighbour */
  packing_vec3 centre;   /* relative to the origin of the network */
  double radius;
  double height;
  packing_i_pore_state state;
  packing_pore_limit limit;
  uint32_t
      touch[4]; /* particles that the sphere touches: the corners', unless it moved */
  int moved;
} packing_i_pore_cell;

/* Spheres that another one touches. */
typedef struct packing_i_corners {
  packing_vec3 p[4];
  double r[4];
  uint32_t particle[4];
} packing_i_corners;

/* Cells that share one sphere. Becomes a pore, alone or with others. */
typedef struct packing_i_pore_node {
  packing_vec3 centre;
  double radius;
  uint32_t cell;  /* the best shaped of them */
  uint32_t cells; /* how many */
  packing_pore_limit limit;
  uint32_t owner; /* the node whose pore it belongs to, itself at first */
  int32_t shift;  /* image of the owner it belongs to */
} packing_i_pore_node;

/* A way from node a to the image of node b. The centre is given where a stands. */
typedef struct packing_i_pore_edge {
  uint32_t a;
  uint32_t b;
  int32_t image;
  uint32_t particle[3];
  packing_vec3 centre;
  double radius; /* 0: closed */
  packing_pore_limit limit;
} packing_i_pore_edge;

typedef struct packing_i_pore_network {
  packing_context *context;
  const packing_allocator *allocator;
  const packing_domain *domain; /* may be NULL */
  packing_pores_def def;
  int dim;
  unsigned periodic;
  packing_bounds box;  /* of the domain, or around the particles */
  double period[3];    /* 0 where open; such that copies are exact */
  packing_vec3 origin; /* corner of the periodic cell, 0 along open axes */
  double r_max;
  size_t count; /* particles */
  double *x;    /* copies: particles first; relative to the origin */
  double *y;
  double *z;
  double *r;
  uint32_t *particle; /* of each copy */
  int32_t *image;     /* of each copy */
  size_t copies;
  size_t room;
  packing_grid *grid;
  packing_i_pore_cell *cell;
  uint32_t cells;
  size_t hidden;
  uint32_t *node_of;   /* of each cell; NONE */
  int32_t *node_shift; /* image of the node that a cell belongs to */
  packing_i_pore_node *node;
  uint32_t nodes;
  packing_i_pore_edge *edge;
  size_t edges;
  size_t closed_edges;
} packing_i_pore_network;

/* Where image `code` of a point stands. */
static inline packing_vec3 packing_i_pores_shifted(const packing_i_pore_network *n,
                                                   packing_vec3 p, int32_t code)
{
  int image[3];
  packing_i_image_decode(code, image);
  p.x += image[0] * n->period[0];
  p.y += image[1] * n->period[1];
  p.z += image[2] * n->period[2];
  return p;
}

static inline packing_vec3 packing_i_pores_copy(const packing_i_pore_network *n,
                                                uint32_t copy)
{
  const packing_vec3 p = {n->x[copy], n->y[copy], n->z[copy]};
  return p;
}

/* Takes in the particles, moved into the periodic cell. */
packing_status packing_i_pores_take(packing_i_pore_network *n, const packing_view *view);

/* Makes copies, the triangulation and the list of cells with their neighbours. */
packing_status packing_i_pores_triangulate(packing_i_pore_network *n);

/* Gives each cell its sphere, or says why it has none. */
void packing_i_pores_fill_cells(packing_i_pore_network *n);

/* The image of a particle that is nearest to a point. */
packing_vec3 packing_i_pores_image(const packing_i_pore_network *n, uint32_t particle,
                                   packing_vec3 at);

/* The distance from a point to the nearest surface as far as that is below `radius` by more than
 * the tolerance, else `radius`; < 0 inside a particle. `which` (may be NULL) is that particle. */
double packing_i_pores_clearance(const packing_i_pore_network *n, packing_vec3 centre,
                                 double radius, uint32_t *which);

/* Looks for the empty sphere nearby where that of a cell, which touches `q`, is not; changes the
 * cell when there is one inside the container. */
void packing_i_pores_settle(const packing_i_pore_network *n, const packing_i_corners *q,
                            packing_vec3 centre, double radius, packing_i_pore_cell *c);

/* The distance from a point to the container's wall, or out of the box around the particles;
 * +infinity where there is none. */
double packing_i_pores_wall(const packing_i_pore_network *n, packing_vec3 centre);

/* Makes nodes of cells that have the same sphere, and of flat ones beside them. */
packing_status packing_i_pores_make_nodes(packing_i_pore_network *n);

/* Makes edges of the faces between nodes. */
packing_status packing_i_pores_make_edges(packing_i_pore_network *n);

/* Sorts edges and drops those met twice. */
packing_status packing_i_pores_sort_edges(packing_i_pore_network *n);

/* Merges nodes that overlap larger ones; edges then go between the owners. */
packing_status packing_i_pores_merge_nodes(packing_i_pore_network *n);

#endif
