/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes: cells that share one sphere, as the four of an octahedral hole do, and flat cells, which
 * rounding leaves between points of one plane and whose own sphere would be noise: each of those
 * joins a neighbour, so that what is beyond it becomes a neighbour of that. Disjoint sets, each
 * member with the image of the root it belongs to. Almost linear. */
#include "measure/pores_internal.h"
#include "vec.h"
#include <string.h>

/* Members of a set lead to its root; `shift` is the image of the parent a cell belongs to. */
typedef struct sets {
  uint32_t *parent;
  int32_t *shift;
} sets;

static uint32_t find_root(sets *s, uint32_t cell, int32_t *shift)
{
  uint32_t root = cell;
  int32_t total = 0;
  while (s->parent[root] != root) {
    total += s->shift[root];
    root = s->parent[root];
  }
  *shift = total;
  while (s->parent[cell] != root && cell != root) { /* everybody on the way to the root */
    const uint32_t next = s->parent[cell];
    const int32_t step = s->shift[cell];
    s->parent[cell] = root;
    s->shift[cell] = total;
    total -= step;
    cell = next;
  }
  return root;
}

/* Cell a belongs together with the image `shift` of cell b. */
static void join(sets *s, uint32_t a, uint32_t b, int32_t shift)
{
  int32_t to_a, to_b;
  const uint32_t root_a = find_root(s, a, &to_a), root_b = find_root(s, b, &to_b);
  if (root_a < root_b) {
    s->parent[root_b] = root_a;
    s->shift[root_b] = to_a - shift - to_b;
  } else if (root_b < root_a) {
    s->parent[root_a] = root_b;
    s->shift[root_a] = shift + to_b - to_a;
  }
}

static int is_same_sphere(const packing_i_pore_network *n, const packing_i_pore_cell *a,
                          const packing_i_pore_cell *b, int32_t shift)
{
  const double allowed = n->def.tolerance * fmax(a->radius, b->radius);
  const packing_vec3 centre = packing_i_pores_shifted(n, b->centre, shift);
  return fabs(a->radius - b->radius) <= allowed &&
         packing_i_norm(packing_i_sub(a->centre, centre)) <= allowed;
}

static void join_same_spheres(const packing_i_pore_network *n, sets *s)
{
  for (uint32_t i = 0; i < n->cells; i++) {
    const packing_i_pore_cell *c = &n->cell[i];
    for (int k = 0; c->state == PACKING_I_PORE_SPHERE && k <= n->dim; k++) {
      const uint32_t j = c->neighbour[k];
      if (j != PACKING_I_PORES_NONE && j != i &&
          n->cell[j].state == PACKING_I_PORE_SPHERE &&
          is_same_sphere(n, c, &n->cell[j], c->shift[k]))
        join(s, i, j, c->shift[k]);
    }
  }
}

/* Periods from b to the image of it that stands nearest to a. */
static int32_t nearest_image(const packing_i_pore_network *n, packing_vec3 a,
                             packing_vec3 b)
{
  int image[3] = {0, 0, 0};
  for (int axis = 0; axis < 3; axis++)
    if (n->period[axis] > 0)
      image[axis] =
          (int)floor((packing_i_component(a, axis) - packing_i_component(b, axis)) /
                         n->period[axis] +
                     0.5);
  return packing_i_image_code(image);
}

static size_t hash_touch(const packing_i_pore_cell *c)
{
  uint64_t h = 0;
  for (int k = 0; k < 4; k++) {
    h = (h ^ c->touch[k]) * UINT64_C(0x9E3779B97F4A7C15);
    h ^= h >> 29;
  }
  return (size_t)h;
}

/* Joins spheres that moved to one place, or to where another cell's stands: those that touch the
 * same particles. */
static void join_moved(const packing_i_pore_network *n, sets *s, uint32_t *table,
                       size_t mask)
{
  for (size_t i = 0; i <= mask; i++)
    table[i] = PACKING_I_PORES_NONE;
  for (uint32_t i = 0; i < n->cells; i++) {
    const packing_i_pore_cell *c = &n->cell[i];
    if (c->state != PACKING_I_PORE_SPHERE)
      continue;
    size_t slot = hash_touch(c) & mask;
    for (; table[slot] != PACKING_I_PORES_NONE; slot = (slot + 1) & mask) {
      const packing_i_pore_cell *other = &n->cell[table[slot]];
      const int32_t shift = nearest_image(n, c->centre, other->centre);
      if (memcmp(c->touch, other->touch, sizeof c->touch) == 0 &&
          is_same_sphere(n, c, other, shift)) {
        join(s, i, table[slot], shift);
        break;
      }
    }
    if (table[slot] == PACKING_I_PORES_NONE)
      table[slot] = i;
  }
}

static packing_status join_all_moved(const packing_i_pore_network *n, sets *s)
{
  size_t moved = 0, size = 2;
  for (uint32_t i = 0; i < n->cells; i++)
    moved += (size_t)(n->cell[i].state == PACKING_I_PORE_SPHERE && n->cell[i].moved);
  if (moved == 0)
    return PACKING_OK;
  while (size < 2 * (size_t)n->cells)
    size *= 2;
  uint32_t *table = packing_i_alloc(n->allocator, size, sizeof *table);
  if (table == NULL)
    return PACKING_ERR_NOMEM;
  join_moved(n, s, table, size - 1);
  packing_i_free(n->allocator, table);
  return PACKING_OK;
}

/* Joins a flat cell to the first neighbour with a sphere, or with one joined before. */
static int join_flat_cell(const packing_i_pore_network *n, sets *s, uint32_t i,
                          unsigned char *joined)
{
  const packing_i_pore_cell *c = &n->cell[i];
  for (int k = 0; k <= n->dim; k++) {
    const uint32_t j = c->neighbour[k];
    if (j == PACKING_I_PORES_NONE || !joined[j])
      continue;
    join(s, i, j, c->shift[k]);
    joined[i] = 1;
    return 1;
  }
  return 0;
}

/* Round by round, so a chain of flat cells ends at one with a sphere. */
static void join_flat_cells(const packing_i_pore_network *n, sets *s,
                            unsigned char *joined)
{
  for (int more = 1; more;) {
    more = 0;
    for (uint32_t i = 0; i < n->cells; i++)
      if (n->cell[i].state == PACKING_I_PORE_FLAT && !joined[i])
        more |= join_flat_cell(n, s, i, joined);
  }
}

/* Numbers the sets that have a sphere, in the order of their first cells. */
static void number_nodes(packing_i_pore_network *n, sets *s, const unsigned char *joined)
{
  n->nodes = 0;
  for (uint32_t i = 0; i < n->cells; i++) {
    int32_t shift;
    n->node_of[i] = PACKING_I_PORES_NONE;
    if (joined[i] && find_root(s, i, &shift) == i)
      n->node_of[i] = n->nodes++;
  }
  for (uint32_t i = 0; i < n->cells; i++)
    if (joined[i])
      n->node_of[i] = n->node_of[find_root(s, i, &n->node_shift[i])];
}

/* The sphere of a node is that of its best shaped cell, and stands where that does. */
static void choose_spheres(packing_i_pore_network *n)
{
  for (uint32_t i = 0; i < n->nodes; i++) {
    n->node[i].cell = PACKING_I_PORES_NONE;
    n->node[i].cells = 0;
    n->node[i].owner = i;
    n->node[i].shift = 0;
  }
  for (uint32_t i = 0; i < n->cells; i++) {
    if (n->node_of[i] == PACKING_I_PORES_NONE)
      continue;
    packing_i_pore_node *node = &n->node[n->node_of[i]];
    const packing_i_pore_cell *c = &n->cell[i];
    node->cells++;
    if (c->state != PACKING_I_PORE_SPHERE ||
        (node->cell != PACKING_I_PORES_NONE && !(c->height > n->cell[node->cell].height)))
      continue;
    node->cell = i;
    node->centre = packing_i_pores_shifted(n, c->centre, -n->node_shift[i]);
    node->radius = c->radius;
    node->limit = c->limit;
  }
}

packing_status packing_i_pores_make_nodes(packing_i_pore_network *n)
{
  packing_status status = PACKING_ERR_NOMEM;
  sets s = {packing_i_alloc(n->allocator, n->cells, sizeof *s.parent),
            packing_i_calloc(n->allocator, n->cells, sizeof *s.shift)};
  unsigned char *joined = packing_i_alloc(n->allocator, n->cells, 1);
  n->node_of = packing_i_alloc(n->allocator, n->cells, sizeof *n->node_of);
  n->node_shift = packing_i_calloc(n->allocator, n->cells, sizeof *n->node_shift);
  if (s.parent == NULL || s.shift == NULL || joined == NULL || n->node_of == NULL ||
      n->node_shift == NULL)
    goto out;
  for (uint32_t i = 0; i < n->cells; i++) {
    s.parent[i] = i;
    joined[i] = n->cell[i].state == PACKING_I_PORE_SPHERE;
  }
  join_same_spheres(n, &s);
  if (join_all_moved(n, &s) != PACKING_OK)
    goto out;
  join_flat_cells(n, &s, joined);
  number_nodes(n, &s, joined);
  n->node = packing_i_alloc(n->allocator, n->nodes, sizeof *n->node);
  if (n->node == NULL)
    goto out;
  choose_spheres(n);
  status = PACKING_OK;
out:
  packing_i_free(n->allocator, s.parent);
  packing_i_free(n->allocator, s.shift);
  packing_i_free(n->allocator, joined);
  return status == PACKING_OK ? PACKING_OK : packing_i_nomem(n->context);
}
