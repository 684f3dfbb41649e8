/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What queries lean on, made once: facets in the order of the tree, who is whose neighbour, and the
 * normals of edges and vertices that tell inside from outside (J. A. Baerentzen, H. Aanaes, IEEE
 * Trans. Vis. Comput. Graph. 11 (2005) 243): an edge takes the sum of its two normals, a vertex that
 * of its faces weighted by their angles. Linear; some 450 bytes a triangle of a small mesh, 250 of a large
 * one. */
#include "mesh/surface_internal.h"
#include <string.h>

static const double ONE_PLANE = 1e-9; /* rad between triangles of one wall */

static packing_vec3 vertex_at(const packing_mesh *mesh, uint32_t v)
{
  return packing_i_mesh_vec(&mesh->vertex[3 * (size_t)v]);
}

static void set_facets(packing_i_surface *s)
{
  const packing_mesh *mesh = s->mesh;
  for (size_t i = 0; i < mesh->triangles; i++) {
    const uint32_t t = mesh->order[i];
    packing_i_facet *f = &s->facet[i];
    const packing_vec3 n = packing_i_mesh_normal(mesh, t, NULL);
    for (int k = 0; k < 3; k++) {
      memcpy(f->corner[k], packing_i_mesh_corner(mesh, t, k), sizeof f->corner[k]);
      f->normal[k] = packing_i_component(n, k);
    }
    s->slot[t] = (uint32_t)i;
  }
}

static packing_vec3 normal_of(const packing_i_surface *s, size_t t)
{
  return packing_i_mesh_vec(s->facet[s->slot[t]].normal);
}

static void set_edges(packing_i_surface *s, const uint32_t *half)
{
  packing_i_mesh_twins(s->mesh, half, s->twin);
  for (size_t e = 0; e < s->edges; e++) {
    const uint32_t a = half[2 * e], b = half[2 * e + 1];
    s->edge[a] = s->edge[b] = (uint32_t)e;
    s->edge_normal[e] = packing_i_add(normal_of(s, a / 3), normal_of(s, b / 3));
  }
}

/* The angle between two directions, in [0, pi], by + - * / and roots: halved until the series of
 * the arc tangent is short. */
static double angle_between(packing_vec3 u, packing_vec3 v)
{
  const double x = packing_i_dot(u, v), y = packing_i_norm(packing_i_cross(u, v));
  const double r = sqrt(x * x + y * y);
  double t = r + fabs(x) > 0 ? y / (r + fabs(x)) : 0; /* of half the acute angle */
  for (int i = 0; i < 3; i++)
    t /= 1 + sqrt(1 + t * t);
  const double t2 = t * t;
  double sum = 0;
  for (int k = 17; k >= 1; k -= 2)
    sum = 1.0 / k - t2 * sum;
  const double acute = 16 * t * sum;
  return x < 0 ? PACKING_I_PI - acute : acute;
}

static void set_vertex_normals(packing_i_surface *s)
{
  const packing_mesh *mesh = s->mesh;
  memset(s->vertex_normal, 0, mesh->vertices * sizeof *s->vertex_normal);
  for (size_t h = 0; h < 3 * mesh->triangles; h++) {
    const uint32_t half = (uint32_t)h, next = packing_i_mesh_next(half);
    const packing_vec3 a = vertex_at(mesh, mesh->triangle[half]);
    const packing_vec3 u = packing_i_sub(vertex_at(mesh, mesh->triangle[next]), a);
    const packing_vec3 v =
        packing_i_sub(vertex_at(mesh, mesh->triangle[packing_i_mesh_next(next)]), a);
    packing_vec3 *n = &s->vertex_normal[mesh->triangle[half]];
    const double unit = mesh->unit; /* keeps products in range */
    const double angle =
        angle_between(packing_i_scale(u, unit), packing_i_scale(v, unit));
    *n = packing_i_add(*n, packing_i_scale(normal_of(s, h / 3), angle));
  }
}

static void set_around(packing_i_surface *s)
{
  const packing_mesh *mesh = s->mesh;
  const size_t halves = 3 * mesh->triangles;
  memset(s->around_first, 0, (mesh->vertices + 2) * sizeof *s->around_first);
  for (size_t h = 0; h < halves; h++)
    s->around_first[mesh->triangle[h] + 2]++;
  for (size_t v = 2; v < mesh->vertices + 2; v++)
    s->around_first[v] += s->around_first[v - 1];
  for (size_t h = 0; h < halves; h++)
    s->around[s->around_first[mesh->triangle[h] + 1]++] = (uint32_t)h;
}

static uint32_t root_of(uint32_t *patch, uint32_t t)
{
  while (patch[t] != t) {
    patch[t] = patch[patch[t]];
    t = patch[t];
  }
  return t;
}

/* Neighbours in one plane are one wall, named by the lowest of them. */
static void set_patches(packing_i_surface *s)
{
  for (size_t t = 0; t < s->mesh->triangles; t++)
    s->patch[t] = (uint32_t)t;
  for (size_t h = 0; h < 3 * s->mesh->triangles; h++) {
    const packing_vec3 m = normal_of(s, h / 3), n = normal_of(s, s->twin[h] / 3);
    if (packing_i_dot(m, n) < 0 || packing_i_norm(packing_i_cross(m, n)) > ONE_PLANE)
      continue;
    const uint32_t a = root_of(s->patch, (uint32_t)(h / 3)),
                   b = root_of(s->patch, s->twin[h] / 3);
    if (a < b)
      s->patch[b] = a;
    else
      s->patch[a] = b;
  }
  for (size_t t = 0; t < s->mesh->triangles; t++)
    s->patch[t] = root_of(s->patch, (uint32_t)t);
}

void packing_i_surface_destroy(packing_i_surface *surface)
{
  if (surface == NULL)
    return;
  const packing_allocator allocator = surface->allocator;
  packing_i_free(&allocator, surface->facet);
  packing_i_free(&allocator, surface->slot);
  packing_i_free(&allocator, surface->twin);
  packing_i_free(&allocator, surface->edge);
  packing_i_free(&allocator, surface->edge_normal);
  packing_i_free(&allocator, surface->vertex_normal);
  packing_i_free(&allocator, surface->around);
  packing_i_free(&allocator, surface->around_first);
  packing_i_free(&allocator, surface->patch);
  packing_i_free(&allocator, surface->cone);
  packing_i_free(&allocator, surface->depth.value);
  packing_mesh_destroy(surface->mesh);
  packing_i_free(&allocator, surface);
}

/* 1: all there. */
static int allocate(packing_i_surface *s)
{
  const packing_allocator *a = &s->allocator;
  const size_t triangles = s->mesh->triangles, vertices = s->mesh->vertices;
  s->edges = 3 * triangles / 2;
  s->facet = packing_i_alloc(a, triangles, sizeof *s->facet);
  s->slot = packing_i_alloc(a, triangles, sizeof *s->slot);
  s->twin = packing_i_alloc(a, triangles, 3 * sizeof *s->twin);
  s->edge = packing_i_alloc(a, triangles, 3 * sizeof *s->edge);
  s->edge_normal = packing_i_alloc(a, s->edges, sizeof *s->edge_normal);
  s->vertex_normal = packing_i_alloc(a, vertices, sizeof *s->vertex_normal);
  s->around = packing_i_alloc(a, triangles, 3 * sizeof *s->around);
  s->around_first = packing_i_alloc(a, vertices + 2, sizeof *s->around_first);
  s->patch = packing_i_alloc(a, triangles, sizeof *s->patch);
  return s->facet != NULL && s->slot != NULL && s->twin != NULL && s->edge != NULL &&
         s->edge_normal != NULL && s->vertex_normal != NULL && s->around != NULL &&
         s->around_first != NULL && s->patch != NULL;
}

static packing_status fill(packing_context *context, packing_i_surface *s)
{
  uint32_t *half = allocate(s) ? packing_i_mesh_sort_edges(context, s->mesh) : NULL;
  if (half == NULL)
    return packing_i_nomem(context);
  set_facets(s);
  set_edges(s, half);
  packing_i_free(packing_i_allocator(context), half);
  set_vertex_normals(s);
  set_around(s);
  set_patches(s);
  PACKING_I_TRY(packing_i_cones_create(context, s));
  return packing_i_depth_create(context, s);
}

packing_status packing_i_surface_create(packing_context *context, packing_mesh *mesh,
                                        packing_i_surface **surface)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_i_surface *s = packing_i_calloc(allocator, 1, sizeof *s);
  if (s == NULL)
    return packing_i_nomem(context);
  s->allocator = *allocator;
  s->mesh = packing_mesh_retain(mesh);
  const packing_status status = fill(context, s);
  if (status == PACKING_OK)
    *surface = s;
  else
    packing_i_surface_destroy(s);
  return status;
}
