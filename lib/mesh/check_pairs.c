/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tree against itself: for each triangle those of higher number whose boxes touch its own, in
 * blocks on the context's threads. */
#include "mesh_internal.h"

enum { BLOCK = 4096 /* triangles */ };

typedef struct findings {
  packing_i_mesh_finding on_each_other, crossing;
} findings;

typedef struct search {
  const packing_mesh *mesh;
  findings *of; /* of each block */
} search;

typedef struct seeker {
  const packing_mesh *mesh;
  uint32_t triangle;
  findings *found;
} seeker;

static int meet(void *user, uint32_t other)
{
  const seeker *s = user;
  packing_vec3 point = {0, 0, 0};
  if (other <= s->triangle)
    return 1;
  const packing_i_mesh_meeting m =
      packing_i_mesh_meet(s->mesh, s->triangle, other, &point);
  if (m == PACKING_I_MESH_ON_EACH_OTHER)
    packing_i_mesh_find(&s->found->on_each_other, s->triangle, other, point);
  if (m == PACKING_I_MESH_CROSS)
    packing_i_mesh_find(&s->found->crossing, s->triangle, other, point);
  return 1;
}

static void search_block(void *user, size_t block)
{
  const search *all = user;
  const packing_mesh *mesh = all->mesh;
  findings *found = &all->of[block];
  found->on_each_other = found->crossing = packing_i_mesh_nothing();
  for (size_t t = block * BLOCK; t < mesh->triangles && t < (block + 1) * BLOCK; t++) {
    double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
           hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < 9; i++) {
      const double x = packing_i_mesh_corner(mesh, t, i / 3)[i % 3];
      lo[i % 3] = fmin(lo[i % 3], x);
      hi[i % 3] = fmax(hi[i % 3], x);
    }
    seeker s = {mesh, (uint32_t)t, found};
    packing_i_mesh_in_box(mesh, lo, hi, meet, &s);
  }
}

static void add(packing_i_mesh_finding *sum, const packing_i_mesh_finding *of_block)
{
  const size_t count = sum->count + of_block->count;
  if (sum->count == 0)
    *sum = *of_block;
  sum->count = count;
}

packing_status packing_i_mesh_check_pairs(packing_context *context,
                                          const packing_mesh *mesh,
                                          packing_i_mesh_finding *on_each_other,
                                          packing_i_mesh_finding *crossing)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t blocks = (mesh->triangles + BLOCK - 1) / BLOCK;
  search all = {mesh, packing_i_alloc(allocator, blocks, sizeof *all.of)};
  if (all.of == NULL)
    return packing_i_nomem(context);
  packing_i_parallel(context, blocks, search_block, &all);
  for (size_t b = 0; b < blocks; b++) {
    add(on_each_other, &all.of[b].on_each_other);
    add(crossing, &all.of[b].crossing);
  }
  packing_i_free(allocator, all.of);
  return PACKING_OK;
}
