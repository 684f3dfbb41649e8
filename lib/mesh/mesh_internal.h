/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_MESH_INTERNAL_H
#define PACKING_MESH_INTERNAL_H

/* Triangle meshes: the tree over their triangles, who touches whom, exact questions. What a
 * container asks of a sound one stands in surface_internal.h. */

#include "base_internal.h"
#include "vec.h"
#include <packing/mesh.h>
#include <stdatomic.h>

/* No triangle, edge, half edge or part. */
#define PACKING_I_MESH_NONE UINT32_MAX

enum { PACKING_I_MESH_MOST = 1 << 28 /* triangles, and vertices */ };

/* Two boxes and what is in them: a node, or with PACKING_I_MESH_LEAF triangles `order[first ..
 * first + count - 1]`. */
typedef struct packing_i_mesh_node {
  double lo[2][3], hi[2][3];
  uint32_t child[2];
} packing_i_mesh_node;

enum {
  PACKING_I_MESH_LEAF_SIZE = 4, /* triangles at most */
  PACKING_I_MESH_DEPTH = 96     /* of the tree, at most */
};
#define PACKING_I_MESH_LEAF 0x80000000U

static inline uint32_t packing_i_mesh_leaf(uint32_t first, uint32_t count)
{
  return PACKING_I_MESH_LEAF | (count - 1) << 28 | first;
}

static inline uint32_t packing_i_mesh_leaf_first(uint32_t child)
{
  return child & 0x0fffffffU;
}

static inline uint32_t packing_i_mesh_leaf_count(uint32_t child)
{
  return (child >> 28 & 7) + 1;
}

struct packing_mesh {
  atomic_size_t holds;
  packing_allocator allocator; /* a copy: a mesh outlives its context */
  size_t vertices, triangles;
  double *vertex;     /* 3 of each */
  uint32_t *triangle; /* 3 of each */
  packing_bounds bounds;
  double area, volume;
  double unit; /* a power of two: coordinates times this are at most 1/4 */
  double pad;  /* boxes of the tree are larger than their triangles by this */
  packing_i_mesh_node *node;
  size_t nodes;
  uint32_t root;   /* as packing_i_mesh_node.child */
  uint32_t *order; /* triangles as the leaves have them */
};

static inline const double *packing_i_mesh_corner(const packing_mesh *mesh, size_t t,
                                                  int corner)
{
  return &mesh->vertex[3 * (size_t)mesh->triangle[3 * t + (size_t)corner]];
}

static inline packing_vec3 packing_i_mesh_vec(const double x[3])
{
  return packing_i_vec(x[0], x[1], x[2]);
}

/* Merges vertices and leaves out triangles that lose a corner by it, or not (merge.c). */
packing_status packing_i_mesh_merge(packing_context *context, packing_mesh *mesh,
                                    double tolerance, int leave_out);

/* The tree (tree.c). */
packing_status packing_i_mesh_grow_tree(packing_context *context, packing_mesh *mesh);

/* Triangles whose boxes a box touches, in the order of the tree; visit() returns 0 to stop. */
typedef int (*packing_i_mesh_visit_function)(void *user, uint32_t triangle);
void packing_i_mesh_in_box(const packing_mesh *mesh, const double lo[3],
                           const double hi[3], packing_i_mesh_visit_function visit,
                           void *user);

/* A normal of unit length, to the last bits however thin the triangle; of one without area 0.
 * `area` may be NULL (exact_triangles.c). */
packing_vec3 packing_i_mesh_normal(const packing_mesh *mesh, size_t t, double *area);

/* Half edge 3 t + i leads from corner i of triangle t to the next. */
static inline uint32_t packing_i_mesh_next(uint32_t half)
{
  return half % 3 == 2 ? half - 2 : half + 1;
}

static inline uint32_t packing_i_mesh_from(const packing_mesh *mesh, uint32_t half)
{
  return mesh->triangle[half];
}

static inline uint32_t packing_i_mesh_to(const packing_mesh *mesh, uint32_t half)
{
  return mesh->triangle[packing_i_mesh_next(half)];
}

/* All half edges in the order of their ends (the lower one first), then of their numbers:
 * 3 triangles numbers. NULL: no memory (edges.c). */
uint32_t *packing_i_mesh_sort_edges(packing_context *context, const packing_mesh *mesh);

/* How many from half[i] on have the ends of half[i]. */
size_t packing_i_mesh_edge_size(const packing_mesh *mesh, const uint32_t *half, size_t i);

/* Whether the triangles of two half edges of an edge have one orientation. */
static inline int packing_i_mesh_agree(const packing_mesh *mesh, uint32_t a, uint32_t b)
{
  return packing_i_mesh_from(mesh, a) == packing_i_mesh_to(mesh, b) &&
         packing_i_mesh_from(mesh, b) == packing_i_mesh_to(mesh, a);
}

/* Of a mesh where each edge has two half edges: the other one of each (edges.c). */
void packing_i_mesh_twins(const packing_mesh *mesh, const uint32_t *half, uint32_t *twin);

/* The part that a triangle belongs to, from 0; returns how many there are. `part` has room for
 * all triangles (edges.c). */
uint32_t packing_i_mesh_parts(const packing_mesh *mesh, const uint32_t *twin,
                              uint32_t *part);

/* Exact questions (exact_triangles.c). Points are vertices, or others rounded to the grid of the
 * predicates. */
typedef struct packing_i_mesh_point {
  double x[3]; /* in units of the mesh's */
} packing_i_mesh_point;

packing_i_mesh_point packing_i_mesh_place(const packing_mesh *mesh, const double x[3]);
/* The sign of det(b - a, c - a, d - a). */
int packing_i_mesh_orient(const packing_i_mesh_point *a, const packing_i_mesh_point *b,
                          const packing_i_mesh_point *c, const packing_i_mesh_point *d);
int packing_i_mesh_is_flat(const packing_mesh *mesh, size_t t);

/* What two triangles have in common that is not a shared corner or edge. */
typedef enum packing_i_mesh_meeting {
  PACKING_I_MESH_APART,
  PACKING_I_MESH_ON_EACH_OTHER,
  PACKING_I_MESH_CROSS
} packing_i_mesh_meeting;

packing_i_mesh_meeting packing_i_mesh_meet(const packing_mesh *mesh, size_t s, size_t t,
                                           packing_vec3 *point);

/* How often the surface is left less how often it is entered on the way from `from` to a point
 * far outside: 1 inside a sound mesh, 0 outside. Triangles of part `without` (see
 * packing_i_mesh_parts(), NULL: none) do not count (crossings.c). */
int packing_i_mesh_winding(const packing_mesh *mesh, const double from[3],
                           const uint32_t *part, uint32_t without);

/* Findings of the check. */
typedef struct packing_i_mesh_finding {
  size_t count;
  size_t triangle, other;
  packing_vec3 point;
} packing_i_mesh_finding;

static inline packing_i_mesh_finding packing_i_mesh_nothing(void)
{
  const packing_i_mesh_finding none = {0, PACKING_NO_INDEX, PACKING_NO_INDEX, {0, 0, 0}};
  return none;
}

/* Counts one more; keeps the first. */
void packing_i_mesh_find(packing_i_mesh_finding *finding, size_t triangle, size_t other,
                         packing_vec3 point);

packing_vec3 packing_i_mesh_middle(const packing_mesh *mesh, size_t t);

/* Triangles that meet where they should not (check_pairs.c). */
packing_status packing_i_mesh_check_pairs(packing_context *context,
                                          const packing_mesh *mesh,
                                          packing_i_mesh_finding *on_each_other,
                                          packing_i_mesh_finding *crossing);

/* Parts that face the wrong way (check_parts.c). */
packing_status packing_i_mesh_check_parts(packing_context *context,
                                          const packing_mesh *mesh, const uint32_t *twin,
                                          packing_i_mesh_finding *inverted,
                                          size_t *parts);

#endif
