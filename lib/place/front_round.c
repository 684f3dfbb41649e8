/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order of work. Growth goes by levels: only pockets whose key (the distance from the start)
 * is below the level are filled, so the front stays even; within a level the tiles take turns,
 * colour by colour. See front_pockets.h on lanes. */
#include "front_pockets.h"
#include <assert.h>

/* ---- preparing ---- */

packing_status packing_i_front_prepare_tile(packing_i_pockets *p, uint32_t tile)
{
  packing_i_front_grid *grid = &p->grid;
  if (packing_i_front_tile_surround(grid, tile) != PACKING_OK)
    return packing_i_nomem(p->placer->context);
  for (int n = 0; n < PACKING_I_TILE_AROUND; n++) {
    const uint32_t t = grid->tile[tile].around[n];
    if (grid->tile[t].cell != NULL)
      continue;
    if (packing_i_front_tile_fill(grid, t, p->placer->particles) != PACKING_OK) {
      packing_i_front_tile_empty(grid, t);
      return packing_i_nomem(p->placer->context);
    }
  }
  return PACKING_OK;
}

/* Whether no sphere that starts in the tile meets a wall. */
static int is_clear(const packing_i_pockets *p, const packing_i_front_tile *tile)
{
  const packing_vec3 half = packing_i_scale(p->grid.edge, 0.5);
  packing_vec3 middle = packing_i_add(tile->lo, half);
  double reach = 2 * p->max_r + 4 * p->max_r + packing_i_norm(half);
  if (p->dim == 2) {
    middle.z = 0;
    reach -= packing_i_norm(half) - hypot(half.x, half.y);
  }
  for (int axis = 0; axis < 3; axis++) /* an open top is a border too */
    if (p->open_axis == axis && packing_i_component(middle, axis) + reach >
                                    packing_i_component(p->bounds.hi, axis))
      return 0;
  return packing_i_domain_clear(p->domain, &middle, reach) ||
         packing_domain_signed_distance(p->domain, &middle, NULL) > reach;
}

packing_status packing_i_front_prepare(packing_i_pockets *p, uint32_t tile)
{
  PACKING_I_TRY(packing_i_front_prepare_tile(p, tile));
  packing_i_front_tile *t = p->grid.tile + tile;
  if (!t->judged) {
    t->judged = 1;
    t->clear = is_clear(p, t);
  }
  return p->periodic == 0 ? PACKING_OK : packing_i_front_prepare_images(p, tile);
}

/* ---- collecting ---- */

static packing_status make_live(packing_i_pockets *p, uint32_t tile)
{
  if (p->grid.tile[tile].live)
    return PACKING_OK;
  if (p->live_count == p->live_room) {
    const size_t room = 2 * p->live_room + 64;
    uint32_t *grown = packing_i_regrow(packing_i_allocator(p->placer->context), p->live,
                                       p->live_count, room, sizeof *grown);
    if (grown == NULL)
      return packing_i_nomem(p->placer->context);
    p->live = grown;
    p->live_room = room;
  }
  p->grid.tile[tile].live = 1;
  p->live[p->live_count++] = tile;
  return PACKING_OK;
}

/* All or nothing, so that it can be repeated. */
static packing_status collect_one(packing_i_pockets *p, const packing_i_front_placed *q,
                                  size_t stored)
{
  packing_placer *placer = p->placer;
  const size_t after = placer->particles->count + (size_t)(!q->image && !stored);
  const uint32_t index = (uint32_t)((stored != 0 ? stored : after) - 1);
  unsigned k;
  packing_i_front_bin *bin = packing_i_front_bin_of(&p->grid, q->place, &k);
  bin->index[k] = index;
  if (q->image) {
    p->grid.tile[q->tile].pinned = 1;
    return PACKING_OK;
  }
  if (packing_i_front_tile_note(&p->grid, q->tile, index) != PACKING_OK)
    return packing_i_nomem(placer->context);
  if (stored)
    return PACKING_OK;
  const packing_status status =
      packing_i_placer_put(placer, q->centre, q->r, q->component);
  if (status != PACKING_OK)
    packing_i_front_tile_forget(&p->grid, q->tile);
  return status;
}

static packing_status bring_home(packing_i_pockets *p, uint32_t id)
{
  packing_i_pocket *pocket = packing_i_pocket_at(p, id);
  packing_i_front_tile *tile = p->grid.tile + pocket->home;
  PACKING_I_TRY(make_live(p, pocket->home));
  pocket->home_next = tile->pockets;
  tile->pockets = id;
  if (pocket->key < tile->next_key)
    tile->next_key = pocket->key;
  return PACKING_OK;
}

packing_status packing_i_front_collect(packing_i_pockets *p, packing_i_front_lane *lane,
                                       size_t stored)
{
  for (; lane->collected < lane->placed_count; lane->collected++)
    PACKING_I_TRY(collect_one(p, lane->placed + lane->collected, stored));
  lane->placed_count = lane->collected = 0;
  for (; lane->delivered < lane->outbox_count; lane->delivered++)
    PACKING_I_TRY(bring_home(p, lane->outbox[lane->delivered]));
  lane->outbox_count = lane->delivered = 0;
  lane->particles = 0;
  p->placer->tally.attempts += lane->attempts;
  lane->attempts = 0;
  return PACKING_OK;
}

/* ---- a tile ---- */

static void free_pocket(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t id)
{
  packing_i_pocket_at(p, id)->next = lane->free_pocket;
  lane->free_pocket = id;
  lane->free_pockets++;
}

/* Frees the dead pockets of a tile, drops those that were left behind, and offers the others. */
static void muster(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t t)
{
  packing_i_front_tile *tile = p->grid.tile + t;
  lane->heap_count = 0;
  tile->next_key = HUGE_VAL;
  uint32_t *link = &tile->pockets;
  while (*link != 0) {
    const uint32_t id = *link;
    packing_i_pocket *pocket = packing_i_pocket_at(p, id);
    const packing_i_pocket *after = packing_i_pocket_at(p, pocket->home_next);
    __builtin_prefetch(after);
    __builtin_prefetch(after->exit);
    if (pocket->alive && pocket->key < p->level - 3 * p->level_step) {
      size_t index;
      if (!(packing_i_pocket_score(p, lane, pocket, &index) < HUGE_VAL))
        packing_i_pocket_kill(p, id);
    }
    if (!pocket->alive) {
      *link = pocket->home_next;
      free_pocket(p, lane, id);
      continue;
    }
    if (pocket->key < p->level)
      packing_i_pocket_offer(p, lane, id);
    if (!(pocket->key < p->level) && pocket->key < tile->next_key)
      tile->next_key = pocket->key;
    link = &pocket->home_next;
  }
}

/* Whether the particle that would come next is still asked for. */
static int wants(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t id,
                 size_t index)
{
  if (!(lane->volume_left < HUGE_VAL))
    return 1;
  const double r =
      packing_i_source_stock(lane->source, packing_i_pocket_at(p, id)->zone)->r[index];
  if (lane->volume + 0.5 * packing_i_ball_volume(p->dim, r) <= lane->volume_left)
    return 1;
  lane->met = 1;
  return 0;
}

/* Works on a tile until nothing is due; 0: it stopped before. */
static int work_tile(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile)
{
  lane->at_work = tile;
  if (!lane->resumes)
    muster(p, lane, tile);
  lane->resumes = 1;
  for (;;) {
    if (lane->particles >= lane->quota)
      return 0;
    size_t index;
    const uint32_t id = packing_i_pocket_best(p, lane, &index);
    if (id == 0)
      return 1;
    if (!wants(p, lane, id, index) || !packing_i_pocket_fill(p, lane, tile, id, index))
      return 0;
  }
}

static void work(void *arg, size_t block)
{
  packing_i_pockets *p = arg;
  packing_i_front_lane *lane = p->lane + block;
  while (lane->todo_next < lane->todo_count &&
         work_tile(p, lane, lane->todo[lane->todo_next])) {
    lane->todo_next++;
    lane->resumes = 0;
  }
  lane->at_work = 0;
}

/* ---- a round ---- */

static int colour_of(const packing_i_pockets *p, const packing_i_front_tile *tile)
{
  if (p->colours == 1)
    return 0;
  return (int)((tile->at[0] & 1) | (tile->at[1] & 1) << 1 | (tile->at[2] & 1) << 2);
}

/* Shares the tiles of the colour that have work out among so many lanes. */
static packing_status hand_out(packing_i_pockets *p, size_t lanes, size_t *tiles)
{
  assert(lanes > 0); /* ration() gives one at least: for those who read this file alone */
  *tiles = 0;
  for (size_t l = 0; l < p->lanes; l++) {
    p->lane[l].todo_count = p->lane[l].todo_next = 0;
    p->lane[l].resumes = 0;
  }
  for (size_t n = 0; n < p->live_count; n++) {
    const packing_i_front_tile *tile = p->grid.tile + p->live[n];
    if (!(tile->next_key < p->level) || colour_of(p, tile) != p->colour)
      continue;
    packing_i_front_lane *lane = p->lane + (*tiles)++ % lanes;
    if (lane->todo_count == lane->todo_room) {
      const size_t room = 2 * lane->todo_room + 64;
      uint32_t *grown =
          packing_i_regrow(packing_i_allocator(p->placer->context), lane->todo,
                           lane->todo_count, room, sizeof *grown);
      if (grown == NULL)
        return packing_i_nomem(p->placer->context);
      lane->todo = grown;
      lane->todo_room = room;
    }
    lane->todo[lane->todo_count++] = p->live[n];
  }
  return PACKING_OK;
}

/* What is handed out and not finished goes back: near the goal one lane does the rest. */
static void call_back(packing_i_pockets *p)
{
  for (size_t l = 0; l < p->lanes; l++) {
    packing_i_front_lane *lane = p->lane + l;
    for (size_t n = lane->todo_next; n < lane->todo_count; n++)
      p->grid.tile[lane->todo[n]].next_key = -HUGE_VAL;
  }
  p->active = 0;
}

/* How much each lane may place, so that all together stop where they shall. Returns how many
 * lanes may work side by side. */
static size_t ration(packing_i_pockets *p)
{
  const packing_placer_report *tally = &p->placer->tally;
  const packing_i_front *goal = &p->front;
  size_t left = goal->count == 0 ? SIZE_MAX : goal->count - tally->placed;
  const double volume =
      goal->solid_volume > 0 ? goal->solid_volume - tally->solid_volume : HUGE_VAL;
  const size_t most = p->lanes * PACKING_I_LANE_QUOTA;
  const int plenty =
      left > most && volume > (double)most * packing_i_ball_volume(p->dim, p->max_r);
  for (size_t l = 0; l < p->lanes; l++) {
    packing_i_front_lane *lane = p->lane + l;
    lane->quota = left < PACKING_I_LANE_QUOTA ? left : PACKING_I_LANE_QUOTA;
    lane->volume_left = plenty ? HUGE_VAL : volume;
    lane->volume = 0;
    lane->starved = 0;
    lane->met = 0;
    lane->particles = 0;
  }
  return plenty ? p->lanes : 1;
}

/* All that a lane may need in a round: it does not allocate. */
static packing_status feed(packing_i_pockets *p)
{
  for (size_t l = 0; l < p->active; l++)
    PACKING_I_TRY(packing_i_lane_stock_up(p, p->lane + l));
  return PACKING_OK;
}

static packing_status take_over(packing_i_pockets *p)
{
  p->owed = 1;
  int halo = 0, finished = 1;
  for (size_t l = 0; l < p->lanes; l++) { /* those at rest owe nothing */
    packing_i_front_lane *lane = p->lane + l;
    PACKING_I_TRY(packing_i_front_collect(p, lane, 0));
    halo |= lane->starved == 2;
    finished &= lane->todo_next == lane->todo_count;
    if (lane->met)
      p->placer->tally.state = PACKING_PLACER_DONE;
  }
  p->owed = 0;
  if (finished)
    p->active = 0;
  if (!halo)
    return PACKING_OK;
  call_back(p); /* their heaps go with the memory */
  p->halo_room *= 2;
  for (size_t l = 0; l < p->lanes; l++)
    PACKING_I_TRY(packing_i_lane_init(p, p->lane + l, p->halo_room));
  return PACKING_OK;
}

/* ---- levels ---- */

static int is_left(const packing_i_front_grid *grid, const packing_i_front_tile *tile)
{
  if (tile->pinned || tile->stays > 0)
    return 0;
  for (int n = 0; n < PACKING_I_TILE_AROUND; n++)
    if (tile->around[n] != 0 && grid->tile[tile->around[n]].pockets != 0)
      return 0;
  return 1;
}

/* Empties the tiles that no pocket is near to. */
static void leave_tiles(packing_i_front_grid *grid)
{
  size_t kept = 0;
  for (size_t n = 0; n < grid->standings; n++) {
    const uint32_t t = grid->standing[n];
    if (grid->tile[t].cell == NULL)
      continue;
    if (is_left(grid, grid->tile + t))
      packing_i_front_tile_empty(grid, t);
    else {
      grid->tile[t].stays -= grid->tile[t].stays > 0;
      grid->standing[kept++] = t;
    }
  }
  grid->standings = kept;
}

/* Goes on to the next level: the tiles that the front has left are emptied. 0: no pocket is left
 * anywhere. */
static int next_level(packing_i_pockets *p)
{
  packing_i_front_grid *grid = &p->grid;
  double least = HUGE_VAL;
  size_t kept = 0;
  for (size_t n = 0; n < p->live_count; n++) {
    packing_i_front_tile *tile = grid->tile + p->live[n];
    if (tile->pockets == 0) {
      tile->live = 0;
      continue;
    }
    if (tile->next_key < least)
      least = tile->next_key;
    p->live[kept++] = p->live[n];
  }
  p->live_count = kept;
  leave_tiles(grid);
  p->ready = 0;
  p->idle_colours = 0;
  if (least < HUGE_VAL) {
    p->level = least > p->level ? least + p->level_step : p->level + p->level_step;
    /* What did not fit the stock is looked at again. */
    for (size_t n = 0; n < p->live_count; n++)
      grid->tile[p->live[n]].next_key = -HUGE_VAL;
  }
  return least < HUGE_VAL;
}

/* Looks for places where the front may begin anew; *done: there are none. */
static packing_status search(packing_i_pockets *p, int *done)
{
  int placed;
  PACKING_I_TRY(packing_i_front_search_on(p, &placed));
  if (placed && !p->search.at_walls)
    p->level = -HUGE_VAL; /* another front, with levels of its own */
  if (p->search.blocks > 0)
    return PACKING_OK;
  *done = !p->search.at_walls;
  if (p->search.at_walls)
    packing_i_front_search_begin(p, 0);
  return PACKING_OK;
}

/* Hands out the tiles of the next colour that has any. None has, on this level at the walls or on
 * any level: looks for more places. */
static packing_status next_colour(packing_i_pockets *p, size_t lanes, int *done)
{
  size_t tiles = 0;
  for (;;) {
    PACKING_I_TRY(hand_out(p, lanes, &tiles));
    if (tiles > 0)
      break;
    p->colour = (p->colour + 1) % p->colours;
    if (++p->idle_colours < p->colours)
      continue;
    if (p->search.at_walls && p->level > 0) {
      p->idle_colours = 0;
      return search(p, done);
    }
    if (!next_level(p)) {
      int go_on;
      PACKING_I_TRY(packing_i_front_reseed(p, &go_on));
      return go_on ? PACKING_OK : search(p, done);
    }
  }
  p->idle_colours = 0;
  for (size_t l = 0; l < lanes; l++)
    for (size_t n = 0; n < p->lane[l].todo_count; n++)
      PACKING_I_TRY(packing_i_front_prepare(p, p->lane[l].todo[n]));
  p->active = lanes;
  return PACKING_OK;
}

packing_status packing_i_front_round(packing_i_pockets *p, int *done)
{
  *done = 0;
  if (p->owed) /* memory was short; what was done counts all the same */
    return take_over(p);
  const size_t lanes = ration(p);
  if (p->active > lanes)
    call_back(p);
  if (p->active == 0)
    PACKING_I_TRY(next_colour(p, lanes, done));
  if (p->active == 0)
    return PACKING_OK;
  PACKING_I_TRY(feed(p));
  packing_i_parallel(p->placer->context, p->active, work, p);
  return take_over(p);
}
