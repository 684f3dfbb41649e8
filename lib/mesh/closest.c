/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nearest point of a surface: down the tree, the nearer box first, boxes beyond the best one
 * left out. The sign is that of the product with the normal of the nearest feature (surface.c). */
#include "mesh/facet.h"

typedef struct waiting {
  double square;
  uint32_t child;
} waiting;

/* Holds the triangles of a leaf against the best. */
static void try_leaf(const packing_i_surface *s, uint32_t child, packing_vec3 point,
                     packing_i_nearest *best)
{
  const uint32_t first = packing_i_mesh_leaf_first(child);
  for (uint32_t i = first; i < first + packing_i_mesh_leaf_count(child); i++) {
    packing_i_nearest here = packing_i_facet_nearest(&s->facet[i], point, best->square);
    here.facet = i;
    if (here.square < best->square ||
        (here.square == best->square && best->facet != PACKING_I_MESH_NONE &&
         s->mesh->order[i] < s->mesh->order[best->facet]))
      *best = here;
  }
}

packing_i_nearest packing_i_surface_nearest(const packing_i_surface *surface,
                                            const packing_vec3 *point, double limit,
                                            double enough)
{
  waiting stack[PACKING_I_MESH_DEPTH];
  packing_i_nearest best = {limit, {0, 0, 0}, PACKING_I_MESH_NONE, 0};
  const double p[3] = {point->x, point->y, point->z};
  int top = 0;
  uint32_t child = surface->mesh->root;
  for (;;) {
    if (child & PACKING_I_MESH_LEAF) {
      try_leaf(surface, child, *point, &best);
      if (best.square < enough)
        return best;
    } else {
      const packing_i_mesh_node *node = &surface->mesh->node[child];
      const double d[2] = {packing_i_node_square(node, 0, p),
                           packing_i_node_square(node, 1, p)};
      const int near = d[1] < d[0];
      if (d[!near] <= best.square)
        stack[top++] = (waiting){d[!near], node->child[!near]};
      if (d[near] <= best.square) {
        child = node->child[near];
        continue;
      }
    }
    do
      if (top == 0)
        return best;
    while (stack[--top].square > best.square);
    child = stack[top].child;
  }
}

packing_vec3 packing_i_surface_normal(const packing_i_surface *surface, uint32_t facet,
                                      int feature)
{
  const uint32_t half = 3 * surface->mesh->order[facet];
  if (feature >= PACKING_I_FEATURE_CORNER)
    return surface->vertex_normal
        [surface->mesh->triangle[half + (uint32_t)(feature - PACKING_I_FEATURE_CORNER)]];
  if (feature >= PACKING_I_FEATURE_EDGE)
    return surface
        ->edge_normal[surface->edge[half + (uint32_t)(feature - PACKING_I_FEATURE_EDGE)]];
  return packing_i_mesh_vec(surface->facet[facet].normal);
}

int packing_i_surface_is_inside(const packing_i_surface *surface,
                                const packing_i_nearest *nearest)
{
  const packing_vec3 n =
      packing_i_surface_normal(surface, nearest->facet, nearest->feature);
  return packing_i_dot(n, nearest->away) <= 0;
}

packing_vec3 packing_i_surface_gradient(const packing_i_surface *surface,
                                        const packing_i_nearest *nearest)
{
  const packing_vec3 n =
      packing_i_surface_normal(surface, nearest->facet, nearest->feature);
  const double distance = sqrt(nearest->square);
  if (nearest->feature == PACKING_I_FEATURE_FACE)
    return packing_i_scale(n, -1);
  if (!(distance > 0))
    return packing_i_scale(n, -1 / packing_i_norm(n));
  return packing_i_scale(nearest->away,
                         (packing_i_dot(n, nearest->away) <= 0 ? 1 : -1) / distance);
}
