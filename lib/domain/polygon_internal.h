/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_POLYGON_INTERNAL_H
#define PACKING_POLYGON_INTERNAL_H

/* A polygon with holes: its edges, stored in the order of a tree of boxes over them. Edge i runs
 * from vertex i to the next one of its ring, numbered as the user gave them. */

#include "domain_kinds.h"
#include <packing/solids.h>

typedef struct packing_i_edge {
  double ax, ay, bx, by;
  double nx, ny; /* unit normal, to the inside */
  int id;        /* of the edge and of the vertex a; a is vertex `id` */
  int next;      /* the vertex b */
} packing_i_edge;

typedef struct packing_i_rect {
  double lo[2], hi[2];
} packing_i_rect;

typedef struct packing_i_polygon_data {
  packing_allocator allocator;
  int count;            /* edges and vertices */
  packing_i_edge *edge; /* in the order of the tree */
  int *place;           /* where edge i stands */
  int *before;          /* the vertex before vertex i in its ring */
  int *ring;            /* of vertex i */
  packing_i_rect
      *box; /* of the nodes: the root is 1, the children of k are 2 k, 2 k + 1 */
} packing_i_polygon_data;

/* A node of the tree on its way: edges [from, to). */
typedef struct packing_i_node {
  int node, from, to;
} packing_i_node;

enum { PACKING_I_LEAF = 4, PACKING_I_TREE_DEPTH = 64 };

static inline int packing_i_is_leaf(packing_i_node n)
{
  return n.to - n.from <= PACKING_I_LEAF;
}

static inline packing_i_node packing_i_child(packing_i_node n, int right)
{
  const int middle = n.from + (n.to - n.from) / 2;
  return (packing_i_node){2 * n.node + right, right ? middle : n.from,
                          right ? n.to : middle};
}

/* How many nodes, the unused node 0 included, a tree over so many edges may have. */
size_t packing_i_polygon_nodes(int count);

/* Orders the edges and fills `place` and `box`. */
void packing_i_polygon_build(packing_i_polygon_data *data);

/* Squared distance of a point from a box. */
static inline double packing_i_rect_distance2(const packing_i_rect *b, double x, double y)
{
  const double dx = fmax(fmax(b->lo[0] - x, x - b->hi[0]), 0);
  const double dy = fmax(fmax(b->lo[1] - y, y - b->hi[1]), 0);
  return dx * dx + dy * dy;
}

/* What of an edge is nearest to a point. */
typedef enum packing_i_foot {
  PACKING_I_FOOT_EDGE,
  PACKING_I_FOOT_A,
  PACKING_I_FOOT_B
} packing_i_foot;

packing_i_foot packing_i_edge_foot(const packing_i_edge *e, double x, double y,
                                   double *distance2);

/* Whether the corner at vertex i bends into the polygon, by more than 180 degrees inside. */
int packing_i_polygon_is_reflex(const packing_i_polygon_data *data, int vertex);

double packing_i_polygon_distance(const packing_i_polygon_data *data, double x, double y,
                                  packing_vec3 *normal);

/* The wall that is nearest, by its number. */
int packing_i_polygon_nearest(const packing_i_polygon_data *data, double x, double y);

/* The walls within reach that have their foot in view: from the inside (side 1) or, with
 * distances and normals turned, from the outside (-1). */
int packing_i_polygon_near_walls(const packing_i_polygon *p, int side,
                                 const packing_vec3 *point, double reach,
                                 packing_i_near_wall near[PACKING_I_NEAR_WALLS]);

/* The edge that crosses the disc, -1 where there is none, -2 where there are more. */
int packing_i_polygon_edge_in(const packing_i_polygon_data *data, double x, double y,
                              double r);

/* The area of the disc's part in the polygon. */
double packing_i_polygon_disc(const packing_i_polygon_data *data, double x, double y,
                              double r);

/* Refuses rings that cross or touch. */
packing_status packing_i_polygon_check(packing_context *context,
                                       const packing_i_polygon_data *data);

/* Whether vertex `vertex` lies within an odd number of the other rings. */
int packing_i_polygon_within(const packing_i_polygon_data *data, int vertex);

#endif
