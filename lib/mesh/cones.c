/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cones of normals, so that searches leave out what faces elsewhere. Where the distance from a point
 * has a local minimum over the surface, the way there lies in the cone spanned by the normals of the
 * faces that meet there (else some direction would lead along the surface to nearer points). A box of
 * the tree none of whose ways from the point are within the cone of its triangles' normals, and of
 * those around their corners, holds no minimum (D. E. Johnson, E.
 * Cohen, IEEE ICRA 2001, 2453, for pairs of surfaces). Cones are wider than need be by at least
 * 1e-5 rad and balls about boxes larger by 2^-20 of the largest coordinate: single precision and the
 * roundings of distances never decide. N log N; 64 bytes a node. */
#include "mesh/surface_internal.h"

enum { BLOCK = 1024 /* nodes */ };
static const double MARGIN = 1e-5;       /* of cosines */
static const double LEAST_COSINE = 0.02; /* wider ones are of no use */
static const double BALL_MARGIN = 0x1p-20;

/* Axis and cosine and sine of half the angle. */
typedef struct cone {
  packing_vec3 axis;
  double cosine, sine;
} cone;

typedef struct job {
  packing_i_surface *surface;
  cone *of; /* of each vertex: all normals around it */
} job;

static const cone everything = {{0, 0, 0}, -1, 0};

static packing_vec3 normal_of(const packing_i_surface *s, uint32_t triangle)
{
  return packing_i_mesh_vec(s->facet[s->slot[triangle]].normal);
}

static double sine_of(double cosine)
{
  return sqrt(fmax(0, (1 - cosine) * (1 + cosine)));
}

static cone cone_of_vertex(const packing_i_surface *s, uint32_t v)
{
  const double length = packing_i_norm(s->vertex_normal[v]);
  cone c = everything;
  if (!(length > 0))
    return c;
  c.axis = packing_i_scale(s->vertex_normal[v], 1 / length);
  c.cosine = 1;
  for (uint32_t i = s->around_first[v]; i < s->around_first[v + 1]; i++)
    c.cosine = fmin(c.cosine, packing_i_dot(c.axis, normal_of(s, s->around[i] / 3)));
  c.sine = sine_of(c.cosine);
  return c.cosine < LEAST_COSINE ? everything : c;
}

/* The cosine of the angle from an axis that takes in a cone; -1: too wide. */
static double cosine_with(packing_vec3 axis, const cone *c)
{
  const double cosine = packing_i_dot(axis, c->axis);
  if (c->cosine < 0 || cosine < LEAST_COSINE)
    return -1;
  return cosine * c->cosine - sine_of(cosine) * c->sine;
}

/* Of the facets [from, to). */
static cone cone_of_range(const job *j, uint32_t from, uint32_t to)
{
  const packing_i_surface *s = j->surface;
  packing_vec3 sum = {0, 0, 0};
  for (uint32_t i = from; i < to; i++)
    sum = packing_i_add(sum, packing_i_mesh_vec(s->facet[i].normal));
  const double length = packing_i_norm(sum);
  if (!(length > LEAST_COSINE * (to - from)))
    return everything;
  cone c = {packing_i_scale(sum, 1 / length), 1, 0};
  for (uint32_t i = from; i < to; i++)
    for (uint32_t k = 0; k < 3; k++) {
      const uint32_t v = s->mesh->triangle[3 * s->mesh->order[i] + k];
      c.cosine = fmin(c.cosine, cosine_with(c.axis, &j->of[v]));
      if (c.cosine < LEAST_COSINE)
        return everything;
    }
  return c;
}

static void set_side(const job *j, size_t node, int side, uint32_t from, uint32_t to)
{
  const packing_mesh *mesh = j->surface->mesh;
  const cone c = cone_of_range(j, from, to);
  packing_i_cone *out = &j->surface->cone[2 * node + (size_t)side];
  const double cosine = c.cosine - MARGIN;
  double square = 0;
  for (int k = 0; k < 3; k++) {
    const double lo = mesh->node[node].lo[side][k] * mesh->unit;
    const double hi = mesh->node[node].hi[side][k] * mesh->unit;
    out->middle[k] = (float)(0.5 * (lo + hi));
    out->axis[k] = (float)packing_i_component(c.axis, k);
    square += 0.25 * (hi - lo) * (hi - lo);
  }
  out->radius = (float)(sqrt(square) * (1 + BALL_MARGIN) + BALL_MARGIN);
  out->sine = cosine > 0 ? (float)(sine_of(cosine) + 1e-6) : 2;
}

/* The children of a node have its facets one behind the other: where those of a child begin, or
 * end. */
static uint32_t border_of(const packing_mesh *mesh, uint32_t child, int high)
{
  while (!(child & PACKING_I_MESH_LEAF))
    child = mesh->node[child].child[high];
  return packing_i_mesh_leaf_first(child) + (high ? packing_i_mesh_leaf_count(child) : 0);
}

static void set_block(void *user, size_t block)
{
  const job *j = user;
  const packing_mesh *mesh = j->surface->mesh;
  for (size_t n = block * BLOCK; n < mesh->nodes && n < (block + 1) * BLOCK; n++)
    for (int side = 0; side < 2; side++) {
      const uint32_t child = mesh->node[n].child[side];
      set_side(j, n, side, border_of(mesh, child, 0), border_of(mesh, child, 1));
    }
}

packing_status packing_i_cones_create(packing_context *context,
                                      packing_i_surface *surface)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const packing_mesh *mesh = surface->mesh;
  job j = {surface, packing_i_alloc(allocator, mesh->vertices, sizeof *j.of)};
  surface->cone =
      packing_i_alloc(&surface->allocator, mesh->nodes + 1, 2 * sizeof *surface->cone);
  if (j.of == NULL || surface->cone == NULL) {
    packing_i_free(allocator, j.of);
    return packing_i_nomem(context);
  }
  for (size_t v = 0; v < mesh->vertices; v++)
    j.of[v] = cone_of_vertex(surface, (uint32_t)v);
  packing_i_parallel(context, (mesh->nodes + BLOCK - 1) / BLOCK, set_block, &j);
  packing_i_free(allocator, j.of);
  return PACKING_OK;
}
