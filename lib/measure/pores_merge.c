/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Merging by overlap, level 1 of Reboul, Vincens and Cambou (Granul. Matter 10, 2008, 457): from the
 * largest sphere down, each that is still free becomes a pore and takes what overlaps it by more
 * than the share asked. Here what is reached through others taken before joins too, but all are
 * held against the one sphere that began, so chains do not grow across the pack. N log N. */
#include "measure/pores_internal.h"
#include "vec.h"

/* Ends of edges by node: edge * 2 + which end. */
typedef struct links {
  size_t *start;
  size_t *end;
} links;

static packing_status make_links(const packing_i_pore_network *n, links *l)
{
  l->start = packing_i_calloc(n->allocator, (size_t)n->nodes + 1, sizeof *l->start);
  l->end = packing_i_alloc(n->allocator, 2 * n->edges, sizeof *l->end);
  if (l->start == NULL || l->end == NULL)
    return packing_i_nomem(n->context);
  for (size_t i = 0; i < n->edges; i++) {
    l->start[n->edge[i].a]++;
    l->start[n->edge[i].b]++;
  }
  size_t total = 0;
  for (size_t a = 0; a <= n->nodes; a++) {
    total += l->start[a];
    l->start[a] = total;
  }
  for (size_t i = n->edges; i-- > 0;) {
    l->end[--l->start[n->edge[i].b]] = 2 * i + 1;
    l->end[--l->start[n->edge[i].a]] = 2 * i;
  }
  return PACKING_OK;
}

static int is_larger(const packing_i_pore_node *node, uint32_t a, uint32_t b)
{
  return node[a].radius > node[b].radius || (node[a].radius == node[b].radius && a < b);
}

/* Sifts order[root] down a heap with the smallest sphere on top. */
static void sift(const packing_i_pore_node *node, uint32_t *order, size_t root,
                 size_t count)
{
  for (size_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && is_larger(node, order[child], order[child + 1]))
      child++;
    const uint32_t top = order[root];
    if (!is_larger(node, top, order[child]))
      return;
    order[root] = order[child];
    order[child] = top;
  }
}

/* Largest first, ties by number. */
static void sort_nodes(const packing_i_pore_node *node, uint32_t *order, size_t count)
{
  for (size_t i = 0; i < count; i++)
    order[i] = (uint32_t)i;
  for (size_t i = count / 2; i-- > 0;)
    sift(node, order, i, count);
  while (count-- > 1) {
    const uint32_t smallest = order[0];
    order[0] = order[count];
    order[count] = smallest;
    sift(node, order, 0, count);
  }
}

static int overlaps(const packing_i_pore_network *n, const packing_i_pore_node *large,
                    const packing_i_pore_node *small, int32_t shift)
{
  const packing_vec3 centre = packing_i_pores_shifted(n, small->centre, shift);
  const double d = packing_i_norm(packing_i_sub(large->centre, centre));
  return large->radius + small->radius - d > 2 * n->def.overlap * small->radius;
}

/* Grows the pore of one node; taken[] is room for all, each entering once. */
static void grow_pore(packing_i_pore_network *n, const links *l, uint32_t root,
                      unsigned char *owned, uint32_t *taken)
{
  size_t count = 1;
  taken[0] = root;
  owned[root] = 1;
  for (size_t i = 0; i < count; i++) {
    const uint32_t a = taken[i];
    for (size_t k = l->start[a]; k < l->start[a + 1]; k++) {
      const packing_i_pore_edge *e = &n->edge[l->end[k] / 2];
      const int back = (int)(l->end[k] % 2);
      const uint32_t b = back ? e->a : e->b;
      /* a stands at -shift of the root's frame */
      const int32_t at = (back ? -e->image : e->image) - n->node[a].shift;
      if (owned[b] || !overlaps(n, &n->node[root], &n->node[b], at))
        continue;
      owned[b] = 1;
      n->node[b].owner = root;
      n->node[b].shift = -at;
      taken[count++] = b;
    }
  }
}

/* Edges between owners; inside one pore they vanish. */
static void lead_edges(packing_i_pore_network *n)
{
  size_t kept = 0;
  for (size_t i = 0; i < n->edges; i++) {
    packing_i_pore_edge e = n->edge[i];
    const packing_i_pore_node *a = &n->node[e.a], *b = &n->node[e.b];
    e.image += b->shift - a->shift;
    e.centre = packing_i_pores_shifted(n, e.centre, -a->shift);
    e.a = a->owner;
    e.b = b->owner;
    if (e.a != e.b || e.image != 0)
      n->edge[kept++] = e;
  }
  n->edges = kept;
}

packing_status packing_i_pores_merge_nodes(packing_i_pore_network *n)
{
  links l = {NULL, NULL};
  uint32_t *order = packing_i_alloc(n->allocator, n->nodes, sizeof *order);
  uint32_t *taken = packing_i_alloc(n->allocator, n->nodes, sizeof *taken);
  unsigned char *owned = packing_i_calloc(n->allocator, n->nodes, 1);
  packing_status status = make_links(n, &l);
  if (status == PACKING_OK && (order == NULL || taken == NULL || owned == NULL))
    status = packing_i_nomem(n->context);
  if (status == PACKING_OK) {
    sort_nodes(n->node, order, n->nodes);
    for (size_t i = 0; i < n->nodes; i++)
      if (!owned[order[i]])
        grow_pore(n, &l, order[i], owned, taken);
    lead_edges(n);
    status = packing_i_pores_sort_edges(n);
  }
  packing_i_free(n->allocator, l.start);
  packing_i_free(n->allocator, l.end);
  packing_i_free(n->allocator, order);
  packing_i_free(n->allocator, taken);
  packing_i_free(n->allocator, owned);
  return status;
}
