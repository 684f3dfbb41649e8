/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vertices in one place become one. Vertices are hashed by the cell of a grid that they stand in
 * (its edge is the tolerance; without one a cell is a place), and each joins the first kept one
 * within the tolerance in the 27 cells around. Kept vertices are farther apart than the
 * tolerance, so a cell holds a few. Expected time linear. */
#include "mesh_internal.h"
#include <string.h>

typedef struct table {
  const packing_mesh *mesh;
  double tolerance;
  uint32_t *slot; /* kept vertices, open addressing; `mask` + 1 of them */
  uint32_t *next; /* of kept vertices: the next of a cell with the same hash */
  size_t mask;
} table;

static uint64_t mixed(uint64_t h, double v)
{
  uint64_t bits;
  v += 0.0; /* -0 */
  memcpy(&bits, &v, sizeof bits);
  h = (h ^ bits) * UINT64_C(0x9E3779B97F4A7C15);
  h = (h ^ (h >> 29)) * UINT64_C(0xBF58476D1CE4E5B9);
  return h ^ (h >> 32);
}

static size_t slot_of(const table *t, const double cell[3])
{
  uint64_t h = UINT64_C(0x94D049BB133111EB);
  for (int k = 0; k < 3; k++)
    h = mixed(h, cell[k]);
  return (size_t)h & t->mask;
}

static int is_near(const table *t, uint32_t v, const double x[3])
{
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    const double d = t->mesh->vertex[3 * (size_t)v + (size_t)k] - x[k];
    if (t->tolerance == 0 && d != 0)
      return 0;
    sum += d * d;
  }
  return sqrt(sum) <= t->tolerance;
}

static void cell_of(const table *t, const double x[3], double cell[3])
{
  for (int k = 0; k < 3; k++)
    cell[k] = t->tolerance > 0 ? floor(x[k] / t->tolerance) : x[k];
}

/* The first kept vertex near x, or NONE. */
static uint32_t find(const table *t, const double x[3])
{
  double cell[3], at[3];
  uint32_t best = PACKING_I_MESH_NONE;
  const int reach = t->tolerance > 0, cells = reach ? 27 : 1;
  cell_of(t, x, cell);
  for (int i = 0; i < cells; i++) {
    at[0] = cell[0] + (reach ? i % 3 - 1 : 0);
    at[1] = cell[1] + (reach ? i / 3 % 3 - 1 : 0);
    at[2] = cell[2] + (reach ? i / 9 - 1 : 0);
    for (uint32_t v = t->slot[slot_of(t, at)]; v != PACKING_I_MESH_NONE; v = t->next[v])
      if (v < best && is_near(t, v, x))
        best = v;
  }
  return best;
}

static void keep(table *t, uint32_t v)
{
  double cell[3];
  cell_of(t, &t->mesh->vertex[3 * (size_t)v], cell);
  const size_t s = slot_of(t, cell);
  t->next[v] = t->slot[s];
  t->slot[s] = v;
}

/* Which vertex each becomes. */
static void join(table *t, uint32_t *becomes)
{
  memset(t->slot, 0xff, (t->mask + 1) * sizeof *t->slot);
  for (size_t v = 0; v < t->mesh->vertices; v++) {
    const uint32_t first = find(t, &t->mesh->vertex[3 * v]);
    becomes[v] = first == PACKING_I_MESH_NONE ? (uint32_t)v : first;
    if (first == PACKING_I_MESH_NONE)
      keep(t, (uint32_t)v);
  }
}

/* Renames corners; triangles that lost one may be left out. */
static void rename_corners(packing_mesh *mesh, const uint32_t *becomes, int leave_out)
{
  size_t kept = 0;
  for (size_t t = 0; t < mesh->triangles; t++) {
    uint32_t v[3];
    for (size_t i = 0; i < 3; i++)
      v[i] = becomes[mesh->triangle[3 * t + i]];
    if (leave_out && (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]))
      continue;
    memcpy(&mesh->triangle[3 * kept++], v, sizeof v);
  }
  mesh->triangles = kept;
}

/* Leaves out vertices without triangles. `number` is room for their new numbers. */
static void drop_unused(packing_mesh *mesh, uint32_t *number)
{
  size_t kept = 0;
  memset(number, 0, mesh->vertices * sizeof *number);
  for (size_t i = 0; i < 3 * mesh->triangles; i++)
    number[mesh->triangle[i]] = 1;
  for (size_t v = 0; v < mesh->vertices; v++)
    if (number[v]) {
      memmove(&mesh->vertex[3 * kept], &mesh->vertex[3 * v], 3 * sizeof(double));
      number[v] = (uint32_t)kept++;
    }
  for (size_t i = 0; i < 3 * mesh->triangles; i++)
    mesh->triangle[i] = number[mesh->triangle[i]];
  mesh->vertices = kept;
}

packing_status packing_i_mesh_merge(packing_context *context, packing_mesh *mesh,
                                    double tolerance, int leave_out)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  table t = {.mesh = mesh, .tolerance = tolerance, .mask = 15};
  packing_status status = PACKING_OK;
  while (t.mask < 2 * mesh->vertices)
    t.mask = 2 * t.mask + 1;
  t.slot = packing_i_alloc(allocator, t.mask + 1, sizeof *t.slot);
  t.next = packing_i_alloc(allocator, mesh->vertices, sizeof *t.next);
  uint32_t *becomes = packing_i_alloc(allocator, mesh->vertices, sizeof *becomes);
  if (t.slot == NULL || t.next == NULL || becomes == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  join(&t, becomes);
  rename_corners(mesh, becomes, leave_out);
  drop_unused(mesh, becomes);
  if (mesh->triangles == 0)
    status = packing_i_fail(context, PACKING_ERR_GEOMETRY, "merge", PACKING_NO_INDEX,
                            "no triangle is left");
out:
  packing_i_free(allocator, t.slot);
  packing_i_free(allocator, t.next);
  packing_i_free(allocator, becomes);
  return status;
}
