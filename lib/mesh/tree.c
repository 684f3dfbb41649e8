/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A binary tree of boxes over the triangles, built from the top: the cut is that of the least
 * surface-area cost over 16 bins along each axis (I. Wald, IEEE Symposium on Interactive Ray
 * Tracing 2007, 33), deep down and where centres coincide in the middle. Boxes are larger than
 * what they hold by 16 roundings of the largest coordinate, so no computed distance from a
 * triangle is less than that from its box. N log N; no recursion. */
#include "mesh_internal.h"
#include <string.h>

enum { BINS = 16, SAH_DEPTH = 40 };
static const double NODE_COST = 0.5; /* of visiting a node, in triangles */

typedef struct box {
  double lo[3], hi[3];
} box;

typedef struct work {
  packing_mesh *mesh;
  box *of; /* of each triangle */
  uint32_t nodes;
} work;

/* What is still to be cut, and who waits for it. */
typedef struct range {
  uint32_t first, count;
  uint32_t parent; /* NONE: the root */
  int side, depth;
} range;

typedef struct cut {
  int axis; /* -1: none */
  double lo, width;
  int bin; /* the first of the high side */
  double cost;
} cut;

static const box empty = {{HUGE_VAL, HUGE_VAL, HUGE_VAL},
                          {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

static inline void join(box *a, const box *b)
{
  for (int k = 0; k < 3; k++) {
    a->lo[k] = b->lo[k] < a->lo[k] ? b->lo[k] : a->lo[k];
    a->hi[k] = b->hi[k] > a->hi[k] ? b->hi[k] : a->hi[k];
  }
}

static double half_area(const box *b)
{
  const double x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
  return x * y + y * z + z * x;
}

static inline double twice_middle(const box *b, int axis)
{
  return b->lo[axis] + b->hi[axis];
}

static box box_of_triangle(const packing_mesh *mesh, size_t t)
{
  box b = empty;
  for (int i = 0; i < 3; i++) {
    const double *x = packing_i_mesh_corner(mesh, t, i);
    box corner;
    for (int k = 0; k < 3; k++) {
      corner.lo[k] = x[k] - mesh->pad;
      corner.hi[k] = x[k] + mesh->pad;
    }
    join(&b, &corner);
  }
  return b;
}

static inline int bin_of(const box *b, int axis, double lo, double width)
{
  const int bin = (int)((twice_middle(b, axis) - lo) / width * BINS);
  return bin < BINS ? bin : BINS - 1;
}

/* The cheapest cut across one axis, if it is better than *best. */
static void try_axis(const work *w, const range *r, int axis, cut *best)
{
  const uint32_t *order = &w->mesh->order[r->first];
  box bin[BINS], right[BINS], left = empty;
  uint32_t count[BINS] = {0}, beyond[BINS];
  double lo = HUGE_VAL, hi = -HUGE_VAL;
  for (uint32_t i = 0; i < r->count; i++) {
    lo = fmin(lo, twice_middle(&w->of[order[i]], axis));
    hi = fmax(hi, twice_middle(&w->of[order[i]], axis));
  }
  if (!(hi > lo))
    return;
  for (int b = 0; b < BINS; b++)
    bin[b] = empty;
  for (uint32_t i = 0; i < r->count; i++) {
    const int b = bin_of(&w->of[order[i]], axis, lo, hi - lo);
    join(&bin[b], &w->of[order[i]]);
    count[b]++;
  }
  right[BINS - 1] = bin[BINS - 1];
  beyond[BINS - 1] = count[BINS - 1];
  for (int b = BINS - 2; b > 0; b--) {
    right[b] = right[b + 1];
    join(&right[b], &bin[b]);
    beyond[b] = beyond[b + 1] + count[b];
  }
  for (int b = 1; b < BINS; b++) {
    join(&left, &bin[b - 1]);
    const uint32_t before = r->count - beyond[b];
    if (before == 0 || beyond[b] == 0)
      continue;
    const double cost = half_area(&left) * before + half_area(&right[b]) * beyond[b];
    if (cost < best->cost)
      *best = (cut){axis, lo, hi - lo, b, cost};
  }
}

/* Puts the low side first; returns how many they are. */
static uint32_t part(const work *w, const range *r, const cut *c)
{
  uint32_t *order = &w->mesh->order[r->first];
  uint32_t i = 0, j = r->count;
  while (i < j)
    if (bin_of(&w->of[order[i]], c->axis, c->lo, c->width) < c->bin) {
      i++;
    } else {
      const uint32_t t = order[i];
      order[i] = order[--j];
      order[j] = t;
    }
  return i;
}

static box box_of_range(const work *w, uint32_t first, uint32_t count)
{
  box b = empty;
  for (uint32_t i = first; i < first + count; i++)
    join(&b, &w->of[w->mesh->order[i]]);
  return b;
}

/* How many go to the low side; 0: a leaf. */
static uint32_t divide(const work *w, const range *r)
{
  const box all = box_of_range(w, r->first, r->count);
  const double area = half_area(&all);
  cut best = {.axis = -1, .cost = HUGE_VAL};
  if (r->count <= 1)
    return 0;
  for (int axis = 0; axis < 3 && r->depth < SAH_DEPTH; axis++)
    try_axis(w, r, axis, &best);
  if (r->count <= PACKING_I_MESH_LEAF_SIZE &&
      !(best.cost + NODE_COST * area < area * r->count))
    return 0;
  return best.axis < 0 ? r->count / 2 : part(w, r, &best);
}

static void tell_parent(const work *w, const range *r, uint32_t child)
{
  if (r->parent == PACKING_I_MESH_NONE)
    w->mesh->root = child;
  else
    w->mesh->node[r->parent].child[r->side] = child;
}

static void set_side(packing_i_mesh_node *node, int side, const box *b)
{
  memcpy(node->lo[side], b->lo, sizeof b->lo);
  memcpy(node->hi[side], b->hi, sizeof b->hi);
}

/* Depth grows by one a level up to SAH_DEPTH, then counts halve: below PACKING_I_MESH_DEPTH. */
static void grow(work *w)
{
  range stack[PACKING_I_MESH_DEPTH];
  int top = 0;
  stack[top++] = (range){0, (uint32_t)w->mesh->triangles, PACKING_I_MESH_NONE, 0, 0};
  while (top > 0) {
    const range r = stack[--top];
    const uint32_t low = divide(w, &r);
    if (low == 0) {
      tell_parent(w, &r, packing_i_mesh_leaf(r.first, r.count));
      continue;
    }
    const uint32_t node = w->nodes++;
    const box left = box_of_range(w, r.first, low);
    const box right = box_of_range(w, r.first + low, r.count - low);
    set_side(&w->mesh->node[node], 0, &left);
    set_side(&w->mesh->node[node], 1, &right);
    tell_parent(w, &r, node);
    stack[top++] = (range){r.first + low, r.count - low, node, 1, r.depth + 1};
    stack[top++] = (range){r.first, low, node, 0, r.depth + 1};
  }
}

packing_status packing_i_mesh_grow_tree(packing_context *context, packing_mesh *mesh)
{
  const packing_allocator *allocator = &mesh->allocator;
  work w = {.mesh = mesh};
  mesh->order = packing_i_alloc(allocator, mesh->triangles, sizeof *mesh->order);
  mesh->node = packing_i_alloc(allocator, mesh->triangles, sizeof *mesh->node);
  w.of = packing_i_alloc(allocator, mesh->triangles, sizeof *w.of);
  if (mesh->order == NULL || mesh->node == NULL || w.of == NULL) {
    packing_i_free(allocator, w.of);
    return packing_i_nomem(context);
  }
  for (size_t t = 0; t < mesh->triangles; t++) {
    mesh->order[t] = (uint32_t)t;
    w.of[t] = box_of_triangle(mesh, t);
  }
  grow(&w);
  mesh->nodes = w.nodes;
  packing_i_free(allocator, w.of);
  return PACKING_OK;
}

static int touches(const packing_i_mesh_node *node, int side, const double lo[3],
                   const double hi[3])
{
  for (int k = 0; k < 3; k++)
    if (node->lo[side][k] > hi[k] || node->hi[side][k] < lo[k])
      return 0;
  return 1;
}

void packing_i_mesh_in_box(const packing_mesh *mesh, const double lo[3],
                           const double hi[3], packing_i_mesh_visit_function visit,
                           void *user)
{
  uint32_t stack[PACKING_I_MESH_DEPTH];
  int top = 0;
  stack[top++] = mesh->root;
  while (top > 0) {
    const uint32_t child = stack[--top];
    if (child & PACKING_I_MESH_LEAF) {
      const uint32_t first = packing_i_mesh_leaf_first(child);
      for (uint32_t i = 0; i < packing_i_mesh_leaf_count(child); i++)
        if (!visit(user, mesh->order[first + i]))
          return;
      continue;
    }
    const packing_i_mesh_node *node = &mesh->node[child];
    for (int side = 1; side >= 0; side--)
      if (touches(node, side, lo, hi))
        stack[top++] = node->child[side];
  }
}
