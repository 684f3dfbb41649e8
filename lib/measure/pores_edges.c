/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges in order: by (a, b, image, particles), each once. Buckets of their first node, then
 * insertion: a node has few. Linear. */
#include "measure/pores_internal.h"
#include "vec.h"

/* From the lower node to the higher, of one node to the image that comes later. */
static void turn(const packing_i_pore_network *n, packing_i_pore_edge *e)
{
  if (e->a < e->b || (e->a == e->b && e->image >= 0))
    return;
  const uint32_t a = e->a;
  e->centre = packing_i_pores_shifted(n, e->centre, -e->image);
  e->a = e->b;
  e->b = a;
  e->image = -e->image;
}

static int compare_double(double a, double b)
{
  return a < b ? -1 : a > b;
}

static int compare(const packing_i_pore_edge *a, const packing_i_pore_edge *b)
{
  if (a->b != b->b)
    return a->b < b->b ? -1 : 1;
  if (a->image != b->image)
    return a->image < b->image ? -1 : 1;
  for (int k = 0; k < 3; k++)
    if (a->particle[k] != b->particle[k])
      return a->particle[k] < b->particle[k] ? -1 : 1;
  const int x = compare_double(a->centre.x, b->centre.x),
            y = compare_double(a->centre.y, b->centre.y),
            z = compare_double(a->centre.z, b->centre.z);
  return x != 0 ? x : y != 0 ? y : z;
}

static void sort_bucket(packing_i_pore_edge *e, size_t count)
{
  for (size_t i = 1; i < count; i++) {
    const packing_i_pore_edge moved = e[i];
    size_t at = i;
    for (; at > 0 && compare(&moved, &e[at - 1]) < 0; at--)
      e[at] = e[at - 1];
    e[at] = moved;
  }
}

/* Open ways between two pores differ by their width only: of pores alike, each may be the smaller. */
static int is_same(const packing_i_pore_network *n, const packing_i_pore_edge *a,
                   const packing_i_pore_edge *b)
{
  const double allowed = n->def.tolerance * fmax(a->radius, b->radius);
  const int both_open = a->limit == PACKING_PORE_OPEN && b->limit == PACKING_PORE_OPEN;
  return fabs(a->radius - b->radius) <= allowed &&
         (both_open || packing_i_norm(packing_i_sub(a->centre, b->centre)) <= allowed);
}

/* Drops what repeats one before it between the same nodes. */
static void drop_repeated(packing_i_pore_network *n)
{
  size_t kept = 0, group = 0;
  for (size_t i = 0; i < n->edges; i++) {
    const packing_i_pore_edge e = n->edge[i];
    if (kept > 0 && (n->edge[kept - 1].a != e.a || n->edge[kept - 1].b != e.b ||
                     n->edge[kept - 1].image != e.image))
      group = kept;
    int repeated = 0;
    for (size_t k = group; k < kept; k++)
      repeated |= is_same(n, &n->edge[k], &e);
    if (!repeated)
      n->edge[kept++] = e;
  }
  n->edges = kept;
}

packing_status packing_i_pores_sort_edges(packing_i_pore_network *n)
{
  size_t *start = packing_i_calloc(n->allocator, (size_t)n->nodes + 1, sizeof *start);
  packing_i_pore_edge *sorted = packing_i_alloc(n->allocator, n->edges, sizeof *sorted);
  if (start == NULL || sorted == NULL) {
    packing_i_free(n->allocator, start);
    packing_i_free(n->allocator, sorted);
    return packing_i_nomem(n->context);
  }
  for (size_t i = 0; i < n->edges; i++) {
    turn(n, &n->edge[i]);
    start[n->edge[i].a + 1]++;
  }
  for (size_t a = 0; a < n->nodes; a++)
    start[a + 1] += start[a];
  for (size_t i = n->edges; i-- > 0;) {
    const packing_i_pore_edge *e = &n->edge[i];
    sorted[--start[e->a + 1]] = *e; /* start[a + 1] ends as the first of bucket a */
  }
  for (size_t a = 0; a < n->nodes; a++) {
    const size_t end = a + 1 < n->nodes ? start[a + 2] : n->edges;
    sort_bucket(sorted + start[a + 1], end - start[a + 1]);
  }
  packing_i_free(n->allocator, n->edge);
  packing_i_free(n->allocator, start);
  n->edge = sorted;
  drop_repeated(n);
  return PACKING_OK;
}
