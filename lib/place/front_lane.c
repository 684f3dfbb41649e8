/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of the lanes: one block each, cut into arrays of whole vectors. */
#include "front_pockets.h"

enum {
  CANDIDATES = 8192,
  CAPS = 1024,
  CURVES = 256,
  HEAP = 8192,
  OUTBOX = 2 * PACKING_I_POCKETS_SPARE,
  LINE = 64
};

/* Hands out pieces of a block; with block NULL it only adds up. */
typedef struct carver {
  unsigned char *block;
  size_t used;
} carver;

static void *carve(carver *c, size_t count, size_t size)
{
  void *piece = c->block == NULL ? NULL : c->block + c->used;
  c->used += (count * size + LINE - 1) / LINE * LINE;
  return piece;
}

static double *numbers(carver *c, size_t count)
{
  return carve(c, count, sizeof(double));
}

static void lay_out(packing_i_front_lane *lane, carver *c, size_t halo_room)
{
  packing_i_front_halo *h = &lane->halo;
  double **column[6] = {&h->x, &h->y, &h->z, &h->a, &h->b, &h->r};
  for (int k = 0; k < 6; k++)
    *column[k] = numbers(c, halo_room + PACKING_I_FRONT_WIDTH);
  h->id = carve(c, halo_room + PACKING_I_FRONT_WIDTH, sizeof *h->id);
  h->capacity = halo_room;
  packing_i_front_caps *s = &lane->caps;
  double **cap[7] = {&s->x, &s->y, &s->z, &s->square, &s->top, &s->room, &s->reach};
  for (int k = 0; k < 7; k++)
    *cap[k] = numbers(c, CAPS);
  s->halo = carve(c, CAPS, sizeof *s->halo);
  s->cosine = numbers(c, CAPS);
  s->order = carve(c, CAPS, sizeof *s->order);
  s->capacity = CAPS;
  packing_i_front_candidates *n = &lane->candidates;
  n->x = numbers(c, CANDIDATES);
  n->y = numbers(c, CANDIDATES);
  n->z = numbers(c, CANDIDATES);
  n->pair = carve(c, CANDIDATES, sizeof *n->pair);
  n->capacity = CANDIDATES;
  packing_i_front_curves *v = &lane->curves;
  for (int k = 0; k < 3; k++) {
    v->base[k] = numbers(c, CURVES);
    v->slope[k] = numbers(c, CURVES);
    v->side[k] = numbers(c, CURVES);
    v->s2[k] = numbers(c, CURVES);
  }
  double **curve[9] = {&v->lo, &v->x,    &v->y,     &v->z,     &v->a,
                       &v->b,  &v->room, &v->first, &v->second};
  for (int k = 0; k < 9; k++)
    *curve[k] = numbers(c, CURVES);
  lane->curve_pocket = carve(c, CURVES, sizeof *lane->curve_pocket);
  lane->curve_room = CURVES;
  lane->heap = carve(c, HEAP, sizeof *lane->heap);
  lane->heap_room = HEAP;
  lane->placed_room = PACKING_I_LANE_QUOTA + 2 * PACKING_I_FRONT_IMAGES;
  lane->placed = carve(c, lane->placed_room, sizeof *lane->placed);
  lane->outbox = carve(c, OUTBOX, sizeof *lane->outbox);
  lane->outbox_room = OUTBOX;
}

packing_status packing_i_lane_init(packing_i_pockets *p, packing_i_front_lane *lane,
                                   size_t halo_room)
{
  const packing_allocator *allocator = packing_i_allocator(p->placer->context);
  carver c = {NULL, 0};
  packing_i_front_lane measured;
  lay_out(&measured, &c, halo_room);
  void *block = packing_i_calloc(allocator, c.used, 1);
  if (block == NULL)
    return packing_i_nomem(p->placer->context);
  packing_i_free(allocator, lane->block);
  lane->block = block;
  c.block = block;
  c.used = 0;
  lay_out(lane, &c, halo_room);
  return PACKING_OK;
}

void packing_i_lane_release(packing_i_pockets *p, packing_i_front_lane *lane)
{
  const packing_allocator *allocator = packing_i_allocator(p->placer->context);
  packing_i_source_destroy(lane->source);
  packing_i_free(allocator, lane->block);
  packing_i_free(allocator, lane->todo);
}

/* ---- free lists ---- */

/* A chunk of pockets for the free list. */
static int make_pockets(packing_i_pockets *p)
{
  enum { POCKETS = PACKING_I_POCKET_CHUNK };
  const packing_allocator *allocator = packing_i_allocator(p->placer->context);
  if (p->chunks >= UINT32_MAX / POCKETS)
    return 0;
  if (p->chunks == p->chunk_room) {
    const size_t room = 2 * p->chunk_room + 64;
    packing_i_pocket **grown =
        packing_i_regrow(allocator, p->chunk, p->chunks, room, sizeof *grown);
    if (grown == NULL)
      return 0;
    p->chunk = grown;
    p->chunk_room = room;
  }
  packing_i_pocket *pocket = packing_i_calloc(allocator, POCKETS, sizeof *pocket);
  if (pocket == NULL)
    return 0;
  p->chunk[p->chunks] = pocket;
  const uint32_t first = (uint32_t)p->chunks++ * POCKETS;
  for (uint32_t k = POCKETS; k-- > 0;) {
    if (first + k == 0)
      continue; /* none */
    pocket[k].next = p->free_pocket;
    p->free_pocket = first + k;
    p->free_pockets++;
  }
  return 1;
}

packing_status packing_i_lane_stock_up(packing_i_pockets *p, packing_i_front_lane *lane)
{
  /* Low and high water: a lane keeps what it frees, which is warm in its cache. */
  enum { LOW = 2 * PACKING_I_POCKETS_SPARE, HIGH = 16 * PACKING_I_POCKETS_SPARE };
  enum { BINS = 256 + PACKING_I_FRONT_IMAGES };
  while (lane->free_pockets > HIGH) {
    const uint32_t id = lane->free_pocket;
    lane->free_pocket = packing_i_pocket_at(p, id)->next;
    lane->free_pockets--;
    packing_i_pocket_at(p, id)->next = p->free_pocket;
    p->free_pocket = id;
    p->free_pockets++;
  }
  /* First what can fail: which pockets the lane gets must not depend on it. */
  while (lane->free_pockets < LOW && p->free_pockets < LOW)
    if (!make_pockets(p))
      return packing_i_nomem(p->placer->context);
  for (size_t n = lane->free_pockets < LOW ? LOW : 0; n > 0; n--) {
    const uint32_t id = p->free_pocket;
    p->free_pocket = packing_i_pocket_at(p, id)->next;
    p->free_pockets--;
    packing_i_pocket_at(p, id)->next = lane->free_pocket;
    lane->free_pocket = id;
    lane->free_pockets++;
  }
  while (lane->free_bins < BINS) {
    if (p->grid.free_bin == 0 && !packing_i_front_grid_reserve_bins(&p->grid))
      return packing_i_nomem(p->placer->context);
    const uint32_t bin = p->grid.free_bin;
    p->grid.free_bin = packing_i_front_bin_at(&p->grid, bin)->next;
    packing_i_front_bin_at(&p->grid, bin)->next = lane->free_bin;
    lane->free_bin = bin;
    lane->free_bins++;
  }
  return PACKING_OK;
}
