/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which triangles share edges: half edges sorted by their ends, in two stable passes of counting.
 * Linear. */
#include "mesh_internal.h"
#include <string.h>

static uint32_t low_end(const packing_mesh *mesh, uint32_t half)
{
  const uint32_t a = packing_i_mesh_from(mesh, half), b = packing_i_mesh_to(mesh, half);
  return a < b ? a : b;
}

static uint32_t high_end(const packing_mesh *mesh, uint32_t half)
{
  const uint32_t a = packing_i_mesh_from(mesh, half), b = packing_i_mesh_to(mesh, half);
  return a < b ? b : a;
}

/* One pass: `from` (NULL: 0, 1, 2 ...) to `to`; `start` has room for all vertices and one more. */
static void pass(const packing_mesh *mesh,
                 uint32_t (*end)(const packing_mesh *mesh, uint32_t half),
                 const uint32_t *from, uint32_t *to, size_t *start)
{
  const size_t halves = 3 * mesh->triangles;
  memset(start, 0, (mesh->vertices + 1) * sizeof *start);
  for (size_t i = 0; i < halves; i++)
    start[end(mesh, (uint32_t)i) + 1]++;
  for (size_t v = 0; v < mesh->vertices; v++)
    start[v + 1] += start[v];
  for (size_t i = 0; i < halves; i++) {
    const uint32_t half = from == NULL ? (uint32_t)i : from[i];
    to[start[end(mesh, half)]++] = half;
  }
}

uint32_t *packing_i_mesh_sort_edges(packing_context *context, const packing_mesh *mesh)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  uint32_t *half = packing_i_alloc(allocator, mesh->triangles, 3 * sizeof *half);
  uint32_t *spare = packing_i_alloc(allocator, mesh->triangles, 3 * sizeof *spare);
  size_t *start = packing_i_alloc(allocator, mesh->vertices + 1, sizeof *start);
  if (half != NULL && spare != NULL && start != NULL) {
    pass(mesh, high_end, NULL, spare, start);
    pass(mesh, low_end, spare, half, start);
  } else {
    packing_i_free(allocator, half);
    half = NULL;
  }
  packing_i_free(allocator, spare);
  packing_i_free(allocator, start);
  return half;
}

size_t packing_i_mesh_edge_size(const packing_mesh *mesh, const uint32_t *half, size_t i)
{
  size_t size = 1;
  while (i + size < 3 * mesh->triangles &&
         low_end(mesh, half[i]) == low_end(mesh, half[i + size]) &&
         high_end(mesh, half[i]) == high_end(mesh, half[i + size]))
    size++;
  return size;
}

void packing_i_mesh_twins(const packing_mesh *mesh, const uint32_t *half, uint32_t *twin)
{
  for (size_t i = 0; i + 1 < 3 * mesh->triangles; i += 2) {
    twin[half[i]] = half[i + 1];
    twin[half[i + 1]] = half[i];
  }
}

static uint32_t root_of(uint32_t *part, uint32_t t)
{
  while (part[t] != t) {
    part[t] = part[part[t]];
    t = part[t];
  }
  return t;
}

uint32_t packing_i_mesh_parts(const packing_mesh *mesh, const uint32_t *twin,
                              uint32_t *part)
{
  uint32_t parts = 0;
  for (size_t t = 0; t < mesh->triangles; t++)
    part[t] = (uint32_t)t;
  for (size_t h = 0; h < 3 * mesh->triangles; h++) {
    const uint32_t a = root_of(part, (uint32_t)(h / 3)), b = root_of(part, twin[h] / 3);
    if (a < b)
      part[b] = a;
    else
      part[a] = b;
  }
  /* roots are the lowest of their parts: they get their numbers first */
  for (size_t t = 0; t < mesh->triangles; t++)
    part[t] = root_of(part, (uint32_t)t);
  for (size_t t = 0; t < mesh->triangles; t++)
    part[t] = part[t] == t ? parts++ : part[part[t]];
  return parts;
}
