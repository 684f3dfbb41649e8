/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rsa_voxels.h"

enum {
  PORTION = 4096, /* parents split before a step may return */
  PARENTS_A_TASK = 512,
  CHILDREN = 8
};

/* A ball must cover a voxel by this share of its radius squared to drop it: far above what
 * rounding does to a dart, far below what matters. */
static const double safe = 1 - 1e-10;

static void list_release(packing_i_rsa_voxel_list *list,
                         const packing_allocator *allocator)
{
  for (size_t b = 0; b < list->blocks; b++)
    packing_i_free(allocator, list->block[b]);
  packing_i_free(allocator, list->block);
  *list = (packing_i_rsa_voxel_list){0};
}

/* Gives back the blocks before voxel `end`: all at once at the end would take long. */
static void list_release_before(packing_i_rsa_voxel_list *list,
                                const packing_allocator *allocator, size_t end)
{
  for (size_t b = end / PACKING_I_VOXELS_A_BLOCK; b-- > 0 && list->block[b] != NULL;) {
    packing_i_free(allocator, list->block[b]);
    list->block[b] = NULL;
  }
}

/* Makes room for `more` voxels. */
static packing_status list_reserve(packing_i_rsa_voxel_list *list,
                                   packing_context *context, size_t more)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  while (list->count + more > list->blocks * PACKING_I_VOXELS_A_BLOCK) {
    if (list->blocks == list->capacity) {
      const size_t grown = 2 * list->capacity + 16;
      packing_i_rsa_voxel **table =
          packing_i_regrow(allocator, list->block, list->blocks, grown, sizeof *table);
      if (table == NULL)
        return packing_i_nomem(context);
      list->block = table;
      list->capacity = grown;
    }
    packing_i_rsa_voxel *block =
        packing_i_alloc(allocator, PACKING_I_VOXELS_A_BLOCK, sizeof *block);
    if (block == NULL)
      return packing_i_nomem(context);
    list->block[list->blocks++] = block;
  }
  return PACKING_OK;
}

packing_status packing_i_rsa_voxels_init(packing_i_rsa_voxels *voxels,
                                         const packing_i_rsa_space *space)
{
  *voxels = (packing_i_rsa_voxels){0};
  voxels->level = -1;
  voxels->part = 1;
  voxels->mask =
      packing_i_alloc(packing_i_allocator(space->context), PORTION, sizeof *voxels->mask);
  if (voxels->mask == NULL)
    return packing_i_nomem(space->context);
  voxels->parents = (size_t)space->cells->n[0] * space->cells->n[1] * space->cells->n[2];
  return PACKING_OK;
}

void packing_i_rsa_voxels_release(packing_i_rsa_voxels *voxels, packing_context *context)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  list_release(&voxels->live, allocator);
  list_release(&voxels->next, allocator);
  packing_i_free(allocator, voxels->mask);
}

void packing_i_rsa_voxels_begin_split(packing_i_rsa_voxels *voxels)
{
  voxels->parents = voxels->live.count;
  voxels->split = 0;
}

packing_vec3 packing_i_rsa_voxel_point(const packing_i_rsa_voxels *voxels,
                                       const packing_i_rsa_cells *cells,
                                       packing_i_rsa_voxel voxel, packing_vec3 t)
{
  const double part = voxels->part;
  const uint32_t nx = cells->n[0], ny = cells->n[1];
  const uint32_t k = voxel.cell / nx / ny;
  const double x = (double)(voxel.cell % nx) + ((double)voxel.at[0] + t.x) * part;
  const double y = (double)(voxel.cell / nx % ny) + ((double)voxel.at[1] + t.y) * part;
  const double z = (double)k + ((double)voxel.at[2] + t.z) * part;
  return packing_i_vec(cells->lo.x + x * cells->edge.x, cells->lo.y + y * cells->edge.y,
                       cells->lo.z + z * cells->edge.z);
}

static packing_vec3 corner_of(const packing_i_rsa_cells *cells, uint32_t cell)
{
  const uint32_t nx = cells->n[0], ny = cells->n[1], k = cell / nx / ny;
  return packing_i_vec(cells->lo.x + (double)(cell % nx) * cells->edge.x,
                       cells->lo.y + (double)(cell / nx % ny) * cells->edge.y,
                       cells->lo.z + (double)k * cells->edge.z);
}

static void gather(const packing_i_rsa_cells *cells, uint32_t cell,
                   packing_i_rsa_near_centres *near)
{
  packing_i_rsa_near around[27];
  const size_t count = packing_i_rsa_cells_around(cells, cell, around);
  const packing_vec3 corner = corner_of(cells, cell);
  near->count = 0;
  for (size_t i = 0; i < count; i++) {
    const packing_vec3 shift = packing_i_sub(around[i].shift, corner);
    for (uint32_t at = cells->head[around[i].cell];
         at != 0 && near->count < PACKING_I_MOST_NEAR; at = cells->record[at - 1].next) {
      const packing_i_rsa_record *q = &cells->record[at - 1];
      near->x[near->count] = q->x + shift.x;
      near->y[near->count] = q->y + shift.y;
      near->z[near->count++] = q->z + shift.z;
    }
  }
}

/* Children of which no point is as far inside the container as a centre must be. */
static unsigned outside(const packing_i_rsa_space *space, packing_vec3 centre,
                        packing_vec3 h)
{
  const double half_diagonal = packing_i_norm(h);
  const double least = space->r * (1 - packing_i_hold_slack) * safe;
  if (packing_domain_signed_distance(space->domain, &centre, NULL) >=
      space->r + half_diagonal)
    return 0;
  unsigned mask = 0;
  for (unsigned k = 0; k < CHILDREN; k++) {
    const packing_vec3 child =
        packing_i_vec(centre.x + (k & 1U ? h.x : -h.x), centre.y + (k & 2U ? h.y : -h.y),
                      centre.z + (k & 4U ? h.z : -h.z));
    const double inside = packing_domain_signed_distance(space->domain, &child, NULL);
    mask |= (unsigned)(inside + half_diagonal < least) << k;
  }
  return mask;
}

/* Children that stand for the same points as another where the region is flat. */
static unsigned twins(packing_vec3 h)
{
  return (h.x > 0 ? 0U : 0xaaU) | (h.y > 0 ? 0U : 0xccU) | (h.z > 0 ? 0U : 0xf0U);
}

typedef struct split_task {
  const packing_i_rsa_voxels *voxels;
  const packing_i_rsa_space *space;
  size_t first, count; /* of the portion */
} split_task;

static packing_i_rsa_voxel parent_at(const packing_i_rsa_voxels *voxels, size_t i)
{
  if (voxels->level >= 0)
    return packing_i_rsa_voxel_at(&voxels->live, i);
  return (packing_i_rsa_voxel){(uint32_t)i, {0, 0, 0}};
}

/* Which children of a parent are kept. */
static unsigned children_kept(const packing_i_rsa_space *space,
                              packing_i_rsa_near_centres *near,
                              packing_i_rsa_voxel parent, double part)
{
  const packing_vec3 edge = packing_i_scale(space->cells->edge, part);
  const packing_vec3 h = packing_i_scale(edge, 0.25); /* half edges of a child */
  const packing_vec3 centre = packing_i_vec(((double)parent.at[0] + 0.5) * edge.x,
                                            ((double)parent.at[1] + 0.5) * edge.y,
                                            ((double)parent.at[2] + 0.5) * edge.z);
  unsigned dropped =
      space->children(near, centre, h, space->cells->diameter2 * safe, twins(h));
  if (!space->boxlike && dropped != 0xffU)
    dropped |=
        outside(space, packing_i_add(corner_of(space->cells, parent.cell), centre), h);
  return ~dropped & 0xffU;
}

static void split_block(void *arg, size_t block)
{
  const split_task *task = arg;
  const packing_i_rsa_voxels *voxels = task->voxels;
  const size_t from = block * PARENTS_A_TASK;
  const size_t to =
      from + PARENTS_A_TASK < task->count ? from + PARENTS_A_TASK : task->count;
  packing_i_rsa_near_centres near;
  near.count = 0;
  uint32_t gathered = UINT32_MAX;
  for (size_t i = from; i < to; i++) {
    const packing_i_rsa_voxel parent = parent_at(voxels, task->first + i);
    if (parent.cell != gathered) {
      gather(task->space->cells, parent.cell, &near);
      gathered = parent.cell;
    }
    voxels->mask[i] =
        (unsigned char)children_kept(task->space, &near, parent, voxels->part);
  }
}

static void append_children(packing_i_rsa_voxel_list *list, packing_i_rsa_voxel parent,
                            unsigned mask)
{
  for (uint32_t k = 0; k < CHILDREN; k++) {
    if ((mask >> k & 1U) == 0)
      continue;
    const packing_i_rsa_voxel child = {parent.cell,
                                       {parent.at[0] * 2 + (k & 1U),
                                        parent.at[1] * 2 + (k >> 1 & 1U),
                                        parent.at[2] * 2 + (k >> 2)}};
    list->block[list->count / PACKING_I_VOXELS_A_BLOCK]
               [list->count % PACKING_I_VOXELS_A_BLOCK] = child;
    list->count++;
  }
}

packing_status packing_i_rsa_voxels_split(packing_i_rsa_voxels *voxels,
                                          const packing_i_rsa_space *space, int *done)
{
  const size_t left = voxels->parents - voxels->split;
  const size_t count = left < PORTION ? left : PORTION;
  PACKING_I_TRY(list_reserve(&voxels->next, space->context, count * CHILDREN));
  split_task task = {voxels, space, voxels->split, count};
  packing_i_parallel(space->context, (count + PARENTS_A_TASK - 1) / PARENTS_A_TASK,
                     split_block, &task);
  for (size_t i = 0; i < count; i++)
    append_children(&voxels->next, parent_at(voxels, voxels->split + i), voxels->mask[i]);
  voxels->split += count;
  if (voxels->level >= 0)
    list_release_before(&voxels->live, packing_i_allocator(space->context),
                        voxels->split);
  *done = voxels->split == voxels->parents;
  if (*done) {
    list_release(&voxels->live, packing_i_allocator(space->context));
    voxels->live = voxels->next;
    voxels->next = (packing_i_rsa_voxel_list){0};
    voxels->level = voxels->level < 0 ? 1 : voxels->level + 1;
    voxels->part *= 0.5;
  }
  return PACKING_OK;
}
