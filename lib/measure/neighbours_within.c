/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neighbours within a distance: pairs are met twice, to count them and to list them. Threads
 * take places in a list as they come (atomic counters); sorting the list afterwards makes the
 * result the same for any of them. Linear in particles and pairs, and 8 bytes a particle
 * meanwhile. */
#include "measure/images.h"
#include "measure/order_internal.h"
#include <stdatomic.h>

typedef struct search {
  const packing_i_images *images;
  packing_neighbours *neighbours;
  atomic_size_t
      *next; /* of each particle: bonds so far, then the next place in its list */
  packing_i_image_function fn;
  double factor;
  double gap;
} search;

static int is_near(const search *s, const packing_i_image *p)
{
  return p->distance <= s->factor * (p->r_i + p->r_j) + s->gap;
}

static size_t take(atomic_size_t *next, size_t i)
{
  return atomic_fetch_add_explicit(&next[i], 1, memory_order_relaxed);
}

static void count_pair(void *arg, const packing_i_image *p)
{
  const search *s = arg;
  if (!is_near(s, p))
    return;
  (void)take(s->next, p->i);
  (void)take(s->next, p->j);
}

static void list_pair(void *arg, const packing_i_image *p)
{
  const search *s = arg;
  if (!is_near(s, p))
    return;
  packing_i_bond there = {p->j, {0, 0, 0}}, back = {p->i, {0, 0, 0}};
  for (int k = 0; k < 3; k++) {
    there.image[k] = p->image[k];
    back.image[k] = (int16_t)-p->image[k];
  }
  s->neighbours->bonds[take(s->next, p->i)] = there;
  s->neighbours->bonds[take(s->next, p->j)] = back;
}

static void visit_block(void *arg, size_t block)
{
  search *s = arg;
  packing_i_images_visit(s->images, block, s->fn, s);
}

/* Shell sort (D. L. Shell, Commun. ACM 2, 1959, p. 30), gaps of Knuth: most lists are short. */
static void sort_list(packing_i_bond *list, size_t count)
{
  size_t gap = 1;
  while (gap < count / 3)
    gap = 3 * gap + 1;
  for (; gap > 0; gap /= 3)
    for (size_t k = gap; k < count; k++) {
      const packing_i_bond moved = list[k];
      size_t at = k;
      for (; at >= gap && packing_i_bond_compare(&moved, &list[at - gap]) < 0; at -= gap)
        list[at] = list[at - gap];
      list[at] = moved;
    }
}

static void sort_block(void *arg, size_t block)
{
  const packing_neighbours *n = arg;
  const size_t end = packing_i_measure_block_end(block, n->count);
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++)
    sort_list(n->bonds + n->start[i], n->start[i + 1] - n->start[i]);
}

/* From counts to places. */
static void place_lists(search *s)
{
  packing_neighbours *n = s->neighbours;
  for (size_t i = 0; i < n->count; i++) {
    n->start[i + 1] =
        n->start[i] + atomic_load_explicit(&s->next[i], memory_order_relaxed);
    atomic_store_explicit(&s->next[i], n->start[i], memory_order_relaxed);
  }
}

static packing_status list_all(packing_context *context, search *s)
{
  packing_neighbours *n = s->neighbours;
  const size_t blocks = packing_i_images_blocks(s->images);
  for (size_t i = 0; i < n->count; i++)
    atomic_init(&s->next[i], 0);
  s->fn = count_pair;
  packing_i_parallel(context, blocks, visit_block, s);
  place_lists(s);
  n->bonds = packing_i_alloc(n->allocator, n->start[n->count], sizeof *n->bonds);
  if (n->bonds == NULL)
    return packing_i_nomem(context);
  s->fn = list_pair;
  packing_i_parallel(context, blocks, visit_block, s);
  packing_i_parallel(context, packing_i_measure_blocks(n->count), sort_block, n);
  return PACKING_OK;
}

packing_status packing_i_neighbours_within(packing_context *context,
                                           packing_neighbours *n,
                                           const packing_domain *domain,
                                           const packing_view *view, double factor,
                                           double gap)
{
  packing_i_images *images = NULL;
  PACKING_I_TRY(packing_i_images_create(context, domain, view, factor, gap, &images));
  search s = {images, n, NULL, NULL, factor, gap};
  s.next = packing_i_alloc(n->allocator, n->count, sizeof *s.next);
  const packing_status status =
      s.next == NULL ? packing_i_nomem(context) : list_all(context, &s);
  packing_i_free(n->allocator, s.next);
  packing_i_images_destroy(images);
  return status;
}
