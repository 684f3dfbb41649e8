/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which pocket is filled next, and with which radius.
 *
 * The radius is the largest of the stock that fits, or the largest of the bin of which the stock
 * holds most beyond its share. What it leaves of the room decides: the gap to
 * the next body met as the radius grows, and with less weight those to the second and third. To
 * that come the order of growth, and a bonus for radii of which the stock holds more than its
 * share, without which the sizes that fit badly would pile up there.
 *
 * Scores go stale as radii are taken, so the best of the heap is scored anew when it comes up. */
#include "front_pockets.h"

/* What radius r leaves of the pocket's room. */
static double leaves(const packing_i_pockets *p, const packing_i_pocket *pocket,
                     const packing_i_stock *stock, double r)
{
  const double cap = p->cap * packing_i_pocket_most(p, pocket);
  double gap[3];
  for (int e = 0; e < 3; e++)
    gap[e] = (pocket->exit[e] < cap ? pocket->exit[e] : cap) - r;
  const double left = (gap[0] + p->second * gap[1] + p->third * gap[2]) / r;
  return p->balance > 0 ? left - p->balance * packing_i_stock_excess(stock, r) : left;
}

double packing_i_pocket_score(const packing_i_pockets *p, packing_i_front_lane *lane,
                              const packing_i_pocket *pocket, size_t *index)
{
  const packing_i_stock *stock = packing_i_source_stock(lane->source, pocket->zone);
  const double most = packing_i_pocket_most(p, pocket);
  const size_t fitting =
      packing_i_stock_below(stock, pocket->exit[0] < most ? pocket->exit[0] : most);
  if (fitting == 0 || stock->r[fitting - 1] < pocket->lo)
    return HUGE_VAL;
  double score = leaves(p, pocket, stock, stock->r[fitting - 1]);
  *index = fitting - 1;
  if (p->balance > 0 && stock->full < fitting && stock->full > 0 &&
      stock->r[stock->full - 1] >= pocket->lo) {
    const double other = leaves(p, pocket, stock, stock->r[stock->full - 1]);
    if (other < score) {
      score = other;
      *index = stock->full - 1;
    }
  }
  return score + p->order * (pocket->key - p->level) / p->mean_r;
}

/* Smaller scores first; equal ones by the pocket. */
static inline int before(const packing_i_front_entry *a, const packing_i_front_entry *b)
{
  return a->score < b->score || (!(b->score < a->score) && a->pocket < b->pocket);
}

static void push(packing_i_front_lane *lane, packing_i_front_entry entry)
{
  if (lane->heap_count == lane->heap_room)
    return;
  size_t n = lane->heap_count++;
  while (n > 0) {
    const size_t up = (n - 1) / 2;
    if (!before(&entry, lane->heap + up))
      break;
    lane->heap[n] = lane->heap[up];
    n = up;
  }
  lane->heap[n] = entry;
}

/* Puts an entry in the place of the first. */
static void sift(packing_i_front_lane *lane, packing_i_front_entry entry)
{
  size_t n = 0;
  for (;;) {
    size_t down = 2 * n + 1;
    if (down >= lane->heap_count)
      break;
    if (down + 1 < lane->heap_count && before(lane->heap + down + 1, lane->heap + down))
      down++;
    if (!before(lane->heap + down, &entry))
      break;
    lane->heap[n] = lane->heap[down];
    n = down;
  }
  lane->heap[n] = entry;
}

static void pop(packing_i_front_lane *lane)
{
  const packing_i_front_entry last = lane->heap[--lane->heap_count];
  if (lane->heap_count > 0)
    sift(lane, last);
}

void packing_i_pocket_offer(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t id)
{
  packing_i_pocket *pocket = packing_i_pocket_at(p, id);
  size_t index;
  pocket->version++;
  if (pocket->home != lane->at_work || !(pocket->key < p->level))
    return;
  const double score = packing_i_pocket_score(p, lane, pocket, &index);
  if (score < HUGE_VAL) {
    const packing_i_front_entry entry = {score, id, pocket->version};
    push(lane, entry);
  }
}

uint32_t packing_i_pocket_best(packing_i_pockets *p, packing_i_front_lane *lane,
                               size_t *index)
{
  while (lane->heap_count > 0) {
    packing_i_front_entry top = lane->heap[0];
    const packing_i_pocket *pocket = packing_i_pocket_at(p, top.pocket);
    if (!pocket->alive || pocket->version != top.version) {
      pop(lane);
      continue;
    }
    const double score = packing_i_pocket_score(p, lane, pocket, index);
    if (!(score < HUGE_VAL)) {
      pop(lane);
      continue;
    }
    if (score > top.score) {
      top.score = score;
      sift(lane, top);
      continue;
    }
    pop(lane);
    return top.pocket;
  }
  return 0;
}
