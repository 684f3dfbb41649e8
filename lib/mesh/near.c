/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The features of a surface that stop a ball from growing or moving: where the distance from its
 * centre has a local minimum over the surface. A face does where the foot of the perpendicular is
 * on it; an edge where the foot is beyond it on both faces; a vertex where all its edges lead away.
 * Triangles in one plane are one wall. Cost: the triangles in reach. */
#include "mesh/facet.h"

enum { MOST = PACKING_I_NEAR_FEATURES };

/* Features found on one side, the nearest first. */
typedef struct list {
  int count;
  packing_i_near_feature item[MOST];
} list;

typedef struct job {
  const packing_i_surface *surface;
  packing_vec3 point;
  int inside;    /* the point is known to be */
  double limit;  /* square */
  list found[2]; /* seen from outside, from inside */
  packing_i_nearest nearest;
} job;

/* Across edge i of a triangle. */
static uint32_t neighbour(const packing_i_surface *s, uint32_t triangle, int i)
{
  return s->twin[3 * triangle + (uint32_t)i] / 3;
}

static int edge_is_minimum(const job *j, uint32_t triangle, int i)
{
  const uint32_t twin = j->surface->twin[3 * triangle + (uint32_t)i];
  const packing_i_facet *f = &j->surface->facet[j->surface->slot[twin / 3]];
  return packing_i_facet_side(f, (int)(twin % 3), j->point) < 0;
}

static int vertex_is_minimum(const job *j, uint32_t v)
{
  const packing_i_surface *s = j->surface;
  const packing_vec3 at = packing_i_mesh_vec(&s->mesh->vertex[3 * (size_t)v]);
  const packing_vec3 from = packing_i_sub(at, j->point);
  for (uint32_t i = s->around_first[v]; i < s->around_first[v + 1]; i++) {
    const uint32_t to = packing_i_mesh_to(s->mesh, s->around[i]);
    const packing_vec3 e =
        packing_i_sub(packing_i_mesh_vec(&s->mesh->vertex[3 * (size_t)to]), at);
    if (packing_i_dot(from, e) < 0)
      return 0;
  }
  return 1;
}

static int is_minimum(const job *j, const packing_i_nearest *n)
{
  const uint32_t triangle = j->surface->mesh->order[n->facet];
  if (n->feature >= PACKING_I_FEATURE_CORNER)
    return vertex_is_minimum(
        j,
        j->surface->mesh
            ->triangle[3 * triangle + (uint32_t)(n->feature - PACKING_I_FEATURE_CORNER)]);
  if (n->feature >= PACKING_I_FEATURE_EDGE)
    return edge_is_minimum(j, triangle, n->feature - PACKING_I_FEATURE_EDGE);
  return 1;
}

/* Edges and vertices within a plane are part of its wall. */
static uint32_t wall_of_edge(const packing_i_surface *s, uint32_t triangle, int i)
{
  const uint32_t patch = s->patch[triangle];
  if (s->patch[neighbour(s, triangle, i)] == patch)
    return patch;
  return (uint32_t)s->mesh->triangles + s->edge[3 * triangle + (uint32_t)i];
}

static uint32_t wall_of_vertex(const packing_i_surface *s, uint32_t triangle, uint32_t v)
{
  const uint32_t patch = s->patch[triangle];
  for (uint32_t i = s->around_first[v]; i < s->around_first[v + 1]; i++)
    if (s->patch[s->around[i] / 3] != patch)
      return (uint32_t)(s->mesh->triangles + s->edges) + v;
  return patch;
}

static uint32_t wall_of(const packing_i_surface *s, const packing_i_nearest *n)
{
  const uint32_t triangle = s->mesh->order[n->facet];
  if (n->feature >= PACKING_I_FEATURE_CORNER)
    return wall_of_vertex(
        s, triangle,
        s->mesh
            ->triangle[3 * triangle + (uint32_t)(n->feature - PACKING_I_FEATURE_CORNER)]);
  if (n->feature >= PACKING_I_FEATURE_EDGE)
    return wall_of_edge(s, triangle, n->feature - PACKING_I_FEATURE_EDGE);
  return s->patch[triangle];
}

/* Roundings at borders can show one point of the surface as two features. */
static int is_same(const packing_i_near_feature *a, const packing_i_near_feature *b)
{
  return a->wall == b->wall ||
         (fabs(a->distance - b->distance) <= 1e-9 * fabs(a->distance) &&
          packing_i_dot(a->normal, b->normal) > 1 - 1e-12);
}

static void put(list *l, const packing_i_near_feature *f)
{
  for (int i = 0; i < l->count; i++)
    if (is_same(&l->item[i], f))
      return;
  int at = l->count < MOST ? l->count++ : MOST;
  for (; at > 0; at--) {
    const packing_i_near_feature *before = &l->item[at - 1];
    if (fabs(before->distance) < fabs(f->distance) ||
        (fabs(before->distance) == fabs(f->distance) && before->wall < f->wall))
      break;
    if (at < MOST)
      l->item[at] = *before;
  }
  if (at < MOST)
    l->item[at] = *f;
}

static void take(job *j, const packing_i_nearest *n)
{
  const int inside = packing_i_surface_is_inside(j->surface, n);
  const double distance = sqrt(n->square);
  const packing_i_near_feature f = {inside ? distance : -distance,
                                    packing_i_surface_gradient(j->surface, n),
                                    wall_of(j->surface, n)};
  list *l = &j->found[inside];
  put(l, &f);
  if (inside && l->count == MOST)
    j->limit = fmin(j->limit,
                    l->item[MOST - 1].distance * l->item[MOST - 1].distance * (1 + 1e-9));
}

static void try_leaf(job *j, uint32_t child)
{
  const uint32_t first = packing_i_mesh_leaf_first(child);
  for (uint32_t i = first; i < first + packing_i_mesh_leaf_count(child); i++) {
    packing_i_nearest here =
        packing_i_facet_nearest(&j->surface->facet[i], j->point, j->limit);
    here.facet = i;
    if (!(here.square <= j->limit))
      continue;
    if (here.square < j->nearest.square)
      j->nearest = here;
    if (is_minimum(j, &here))
      take(j, &here);
  }
}

static void search(job *j)
{
  uint32_t stack[PACKING_I_MESH_DEPTH];
  const double p[3] = {j->point.x, j->point.y, j->point.z}, unit = j->surface->mesh->unit;
  const double q[3] = {unit * p[0], unit * p[1], unit * p[2]};
  int top = 0;
  stack[top++] = j->surface->mesh->root;
  while (top > 0) {
    const uint32_t child = stack[--top];
    if (child & PACKING_I_MESH_LEAF) {
      try_leaf(j, child);
      continue;
    }
    const packing_i_mesh_node *node = &j->surface->mesh->node[child];
    const double d[2] = {packing_i_node_square(node, 0, p),
                         packing_i_node_square(node, 1, p)};
    const int near = d[1] < d[0];
    const packing_i_cone *cone = &j->surface->cone[2 * (size_t)child];
    if (d[!near] <= j->limit && !packing_i_cone_faces_away(&cone[!near], q, j->inside))
      stack[top++] = node->child[!near];
    if (d[near] <= j->limit && !packing_i_cone_faces_away(&cone[near], q, j->inside))
      stack[top++] = node->child[near];
  }
}

/* Only what is in reach. */
static int give(const list *l, double reach,
                packing_i_near_feature near[PACKING_I_NEAR_FEATURES])
{
  int count = 0;
  for (int i = 0; i < l->count; i++)
    if (l->item[i].distance < reach)
      near[count++] = l->item[i];
  return count;
}

int packing_i_surface_near(const packing_i_surface *surface, const packing_vec3 *point,
                           double reach,
                           packing_i_near_feature near[PACKING_I_NEAR_FEATURES])
{
  job j = {.surface = surface,
           .point = *point,
           .nearest = {HUGE_VAL, {0, 0, 0}, PACKING_I_MESH_NONE, 0}};
  const double depth = packing_i_surface_depth(surface, point);
  if (depth > 0 && depth >= reach)
    return 0;
  j.inside = depth > 0;
  j.limit = reach > 0 ? reach * reach : 0;
  search(&j);
  if (j.nearest.facet == PACKING_I_MESH_NONE) {
    if (depth > 0)
      return 0;
    j.nearest = packing_i_surface_nearest(surface, point, HUGE_VAL, 0);
    if (j.nearest.facet == PACKING_I_MESH_NONE) /* out of range, or no number */
      return 0;
  }
  const int inside = packing_i_surface_is_inside(surface, &j.nearest);
  if (!inside || sqrt(j.nearest.square) < reach)
    take(&j, &j.nearest); /* whatever roundings made of its neighbours */
  return give(&j.found[inside], reach, near);
}
