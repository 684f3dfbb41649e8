/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of all pairs: counted by first particle, then each put into its place. */
#include "grid/grid_internal.h"
#include <math.h>

typedef struct collector {
  const packing_grid *grid;
  double gap;
  size_t capacity;
  size_t count;
  size_t *held;  /* partners of i so far */
  size_t *start; /* place of its first partner */
  size_t *partners;
} collector;

static int touches(const collector *c, const packing_i_grid_pair *p)
{
  return p->distance <= c->grid->r[p->own] + c->grid->r[p->other] + c->gap;
}

static void count_pair(void *arg, const packing_i_grid_pair *p)
{
  collector *c = arg;
  if (!touches(c, p))
    return;
  c->count++;
  c->start[packing_i_grid_ends(c->grid, p).i]++;
}

static void place_pair(void *arg, const packing_i_grid_pair *p)
{
  collector *c = arg;
  const size_t i = packing_i_grid_ends(c->grid, p).i,
               j = packing_i_grid_ends(c->grid, p).j;
  if (!touches(c, p) || c->start[i] >= c->capacity)
    return;
  const size_t room = c->start[i + 1] - c->start[i], left = c->capacity - c->start[i];
  packing_i_heap_offer(c->partners + c->start[i], room < left ? room : left, &c->held[i],
                       j);
}

static void visit_all(const packing_grid *grid, packing_i_pair_function fn, collector *c)
{
  const packing_i_grid_reach reach = {1.0, c->gap, 0};
  const size_t blocks = packing_i_grid_blocks(grid);
  for (size_t b = 0; b < blocks; b++)
    packing_i_grid_visit(grid, &reach, b, fn, c);
}

/* Counts become places. */
static void add_up(size_t *start, size_t count)
{
  size_t before = 0;
  for (size_t i = 0; i <= count; i++) {
    const size_t here = start[i];
    start[i] = before;
    before += here;
  }
}

static void list_pairs(const packing_grid *grid, collector *c, packing_pair *pairs)
{
  visit_all(grid, place_pair, c);
  for (size_t i = 0; i < grid->count; i++) {
    const size_t start = c->start[i];
    packing_i_heap_sort(c->partners + (c->held[i] > 0 ? start : 0), c->held[i]);
    for (size_t k = 0; k < c->held[i]; k++) {
      pairs[start + k].i = i;
      pairs[start + k].j = c->partners[start + k];
    }
  }
}

static packing_status check_query(const packing_grid *grid, double gap,
                                  const packing_pair *pairs, size_t capacity,
                                  const size_t *count)
{
  if (grid == NULL)
    return PACKING_ERR_INVALID;
  if (count == NULL || (pairs == NULL && capacity > 0))
    return packing_i_fail(grid->context, PACKING_ERR_INVALID,
                          count == NULL ? "count" : "pairs", PACKING_NO_INDEX, "NULL");
  return packing_i_check_finite(grid->context, "gap", gap);
}

packing_status packing_grid_pairs(const packing_grid *grid, double gap,
                                  packing_pair *pairs, size_t capacity, size_t *count)
{
  packing_status status = PACKING_OK;
  collector c = {grid, gap, capacity, 0, NULL, NULL, NULL};
  PACKING_I_TRY(check_query(grid, gap, pairs, capacity, count));
  c.start = packing_i_calloc(grid->allocator, grid->count + 1, sizeof *c.start);
  if (c.start == NULL)
    return packing_i_nomem(grid->context);
  visit_all(grid, count_pair, &c);
  if (capacity > 0 && c.count > 0) {
    c.capacity = capacity < c.count ? capacity : c.count;
    c.held = packing_i_calloc(grid->allocator, grid->count, sizeof *c.held);
    c.partners = packing_i_alloc(grid->allocator, c.capacity, sizeof *c.partners);
    if (c.held == NULL || c.partners == NULL) {
      status = packing_i_nomem(grid->context);
      goto out;
    }
    add_up(c.start, grid->count);
    list_pairs(grid, &c, pairs);
  }
  *count = c.count;
out:
  packing_i_free(grid->allocator, c.start);
  packing_i_free(grid->allocator, c.held);
  packing_i_free(grid->allocator, c.partners);
  return status;
}
