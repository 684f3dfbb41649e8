/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An exact list. A draw asks for the radius at a share p of what is left, so that even p make
 * even draws, and what was drawn too often becomes rarer. Cost: log2(classes) a draw, by P. M.
 * Fenwick's tree (Softw. Pract. Exper. 24, 327, 1994). */
#include "source_list.h"
#include "rng/rng_internal.h"

static void fill(packing_i_list *list, const packing_front_class *classes)
{
  const size_t n = list->classes;
  for (size_t i = 0; i < n; i++)
    list->left[i] = classes[i].count;
  for (size_t i = 1; i <= n; i++)
    list->tree[i] = classes[list->rank[i - 1].index].count;
  for (size_t i = 1; i <= n; i++) {
    list->undrawn += list->left[i - 1];
    const size_t above = i + (i & (0 - i));
    if (above <= n)
      list->tree[above] += list->tree[i];
  }
  list->unplaced = list->undrawn;
  for (list->stride = 1; list->stride <= n / 2;)
    list->stride *= 2;
}

packing_status packing_i_list_start(packing_context *context,
                                    const packing_front_class *classes, size_t count,
                                    packing_i_list *list)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_i_rank *spare = packing_i_alloc(allocator, count, sizeof *spare);
  list->classes = count;
  list->rank = packing_i_alloc(allocator, count, sizeof *list->rank);
  list->tree = packing_i_calloc(allocator, count + 1, sizeof *list->tree);
  list->left = packing_i_alloc(allocator, count, sizeof *list->left);
  packing_status status = PACKING_OK;
  if (spare == NULL || list->rank == NULL || list->tree == NULL || list->left == NULL) {
    status = packing_i_nomem(context);
  } else {
    for (size_t i = 0; i < count; i++)
      list->rank[i] = (packing_i_rank){classes[i].r, i};
    packing_i_ranks_sort(list->rank, spare, count);
    fill(list, classes);
    if (list->undrawn == 0)
      status = packing_i_fail(context, PACKING_ERR_RANGE, "classes", PACKING_NO_INDEX,
                              "no particles");
  }
  packing_i_free(allocator, spare);
  return status;
}

void packing_i_list_finish(const packing_allocator *allocator, packing_i_list *list)
{
  packing_i_free(allocator, list->rank);
  packing_i_free(allocator, list->tree);
  packing_i_free(allocator, list->left);
}

/* Distinct radii that occur, rising, and how often. */
static size_t gather(const packing_i_list *list, double *r, double *share)
{
  size_t count = 0;
  for (size_t i = 0; i < list->classes; i++) {
    const packing_i_rank *rank = &list->rank[i];
    const size_t held = list->left[rank->index];
    if (held == 0)
      continue;
    if (count == 0 || rank->r > r[count - 1]) {
      r[count] = rank->r;
      share[count++] = 0;
    }
    share[count - 1] += (double)held;
  }
  return count;
}

packing_status packing_i_list_psd(packing_context *context, const packing_i_list *list,
                                  packing_psd **psd)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  double *r = packing_i_alloc(allocator, list->classes, sizeof *r);
  double *share = packing_i_alloc(allocator, list->classes, sizeof *share);
  packing_status status = PACKING_ERR_NOMEM;
  if (r == NULL || share == NULL) {
    status = packing_i_nomem(context);
  } else {
    packing_psd_discrete_def def;
    packing_psd_discrete_def_init(&def);
    def.r = r;
    def.share = share;
    def.count = gather(list, r, share);
    def.by = PACKING_BY_NUMBER;
    status = packing_psd_create_discrete(context, &def, psd);
  }
  packing_i_free(allocator, r);
  packing_i_free(allocator, share);
  return status;
}

double packing_i_list_draw(packing_i_list *list, uint64_t p, size_t *class_index)
{
  uint64_t low;
  size_t rest = (size_t)packing_i_multiply(p, list->undrawn, &low);
  size_t at = 0; /* classes that end at or before the one drawn */
  for (size_t step = list->stride; step > 0; step /= 2)
    if (at + step <= list->classes && list->tree[at + step] <= rest) {
      at += step;
      rest -= list->tree[at];
    }
  for (size_t i = at + 1; i <= list->classes; i += i & (0 - i))
    list->tree[i]--;
  list->undrawn--;
  *class_index = list->rank[at].index;
  return list->rank[at].r;
}
