/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What laws remember of contacts. Each listed pair and each wall near a particle has room for
 * `size` numbers and the step of its last touch: a contact that did not touch in the step before
 * begins anew with zeros. When the list is made again, what lives is carried over by the names of
 * both partners; where i and j have swapped, odd numbers change their sign. */
#include "stepper_internal.h"
#include <string.h>

enum { WALLS = PACKING_I_NEAR_WALLS };

/* A step's mark; 0 and 1 are never one, so a cleared mark is none. */
static uint64_t mark_of(const packing_dem *dem)
{
  return dem->steps + 2;
}

static int lives(const packing_dem *dem, uint64_t mark)
{
  return mark + 1 == mark_of(dem);
}

packing_status packing_i_history_create(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  for (size_t l = 0; l < dem->law_count; l++) {
    const packing_law *law = dem->laws[l];
    h->offset[l] = h->size;
    for (size_t k = 0; k < law->history_size; k++)
      h->swap[h->size++] = law->history_even >> k & 1U ? 1 : -1;
  }
  if (h->size == 0)
    return PACKING_OK;
  return packing_i_dem_renew(
      dem, &h->work, (size_t)PACKING_I_SLABS * PACKING_I_ROOM * h->size, sizeof *h->work);
}

void packing_i_history_release(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  void *const all[] = {h->work,           h->value,
                       h->mark,           h->wall_value,
                       h->wall_mark,      h->carried,
                       h->carried_id,     h->carried_at,
                       h->wall_carried,   h->wall_carried_mark,
                       h->wall_carried_at};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++)
    packing_i_free(dem->allocator, all[k]);
}

size_t packing_i_history_bytes(const packing_dem *dem)
{
  const packing_i_history *h = &dem->history;
  const size_t number = h->size * sizeof(double), wall = number + sizeof(uint64_t);
  return (size_t)PACKING_I_SLABS * PACKING_I_ROOM * number +
         h->particles * (2 * (size_t)WALLS * wall + 2 * sizeof(uint32_t)) +
         h->pairs * (number + sizeof(uint64_t)) +
         h->carried_room * (number + sizeof(uint32_t));
}

/* Room for the particles and pairs that the stepper has room for. */
static packing_status grow(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  const size_t walls = dem->capacity * WALLS;
  if (h->particles != dem->capacity) {
    h->particles = 0;
    PACKING_I_TRY(
        packing_i_dem_renew(dem, &h->wall_value, walls * h->size, sizeof(double)));
    PACKING_I_TRY(packing_i_dem_renew(dem, &h->wall_mark, walls, sizeof(uint64_t)));
    PACKING_I_TRY(
        packing_i_dem_renew(dem, &h->wall_carried, walls * h->size, sizeof(double)));
    PACKING_I_TRY(
        packing_i_dem_renew(dem, &h->wall_carried_mark, walls, sizeof(uint64_t)));
    PACKING_I_TRY(
        packing_i_dem_renew(dem, &h->wall_carried_at, dem->capacity, sizeof(uint32_t)));
    PACKING_I_TRY(
        packing_i_dem_renew(dem, &h->carried_at, dem->capacity + 1, sizeof(uint32_t)));
    h->particles = dem->capacity;
  }
  if (h->pairs != dem->list_capacity) {
    h->pairs = 0;
    PACKING_I_TRY(packing_i_dem_renew(dem, &h->value, dem->list_capacity * h->size,
                                      sizeof(double)));
    PACKING_I_TRY(
        packing_i_dem_renew(dem, &h->mark, dem->list_capacity, sizeof(uint64_t)));
    h->pairs = dem->list_capacity;
  }
  return PACKING_OK;
}

/* The name of a pair: the lower of both, then the other; whether i has the lower one. */
static int name_pair(const packing_dem *dem, size_t slot, uint32_t name[2])
{
  const uint32_t i = dem->id[dem->list_i[slot]], j = dem->id[dem->list_j[slot]];
  name[0] = i < j ? i : j;
  name[1] = i < j ? j : i;
  return i < j;
}

static size_t count_living(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  size_t living = 0;
  uint32_t name[2];
  memset(h->carried_at, 0, (dem->count + 1) * sizeof *h->carried_at);
  for (int s = 0; s < dem->cut.slabs; s++)
    for (size_t k = 0; k < dem->slab[s].list_count; k++) {
      const size_t slot = dem->slab[s].list_first + k;
      if (!lives(dem, h->mark[slot]))
        continue;
      name_pair(dem, slot, name);
      h->carried_at[name[0] + 1]++;
      living++;
    }
  return living;
}

/* Values are carried as seen from the lower name. */
static void orient(const packing_i_history *h, int straight, const double *from,
                   double *to)
{
  for (size_t k = 0; k < h->size; k++)
    to[k] = straight ? from[k] : h->swap[k] * from[k];
}

static packing_status carry_pairs(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  const size_t living = count_living(dem);
  uint32_t *at = h->carried_at, name[2];
  if (living > h->carried_room) {
    h->carried_room = 0;
    PACKING_I_TRY(packing_i_dem_renew(dem, &h->carried, dem->list_capacity * h->size,
                                      sizeof(double)));
    PACKING_I_TRY(
        packing_i_dem_renew(dem, &h->carried_id, dem->list_capacity, sizeof(uint32_t)));
    h->carried_room = dem->list_capacity;
  }
  for (size_t i = 0; i < dem->count; i++)
    at[i + 1] += at[i];
  for (int s = 0; s < dem->cut.slabs; s++)
    for (size_t k = 0; k < dem->slab[s].list_count; k++) {
      const size_t slot = dem->slab[s].list_first + k;
      if (!lives(dem, h->mark[slot]))
        continue;
      const int straight = name_pair(dem, slot, name);
      const size_t to = at[name[0]]++;
      h->carried_id[to] = name[1];
      orient(h, straight, h->value + slot * h->size, h->carried + to * h->size);
    }
  memmove(at + 1, at, dem->count * sizeof *at); /* each had moved to its end */
  at[0] = 0;
  return PACKING_OK;
}

/* Particles without a wall nearby have no entry: their place is UINT32_MAX. */
static void carry_walls(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  double *value = h->wall_value;
  uint64_t *mark = h->wall_mark;
  for (size_t i = 0; i < dem->count; i++)
    h->wall_carried_at[i] = UINT32_MAX;
  for (int s = 0; s < dem->cut.slabs; s++)
    for (size_t k = 0; k < dem->slab[s].wall_count; k++) {
      const size_t entry = dem->slab[s].first + k;
      h->wall_carried_at[dem->id[dem->near_wall[entry]]] = (uint32_t)entry;
    }
  h->wall_value = h->wall_carried;
  h->wall_mark = h->wall_carried_mark;
  h->wall_carried = value;
  h->wall_carried_mark = mark;
}

packing_status packing_i_history_carry(packing_dem *dem)
{
  if (dem->history.size == 0 || !dem->history.kept)
    return PACKING_OK;
  PACKING_I_TRY(carry_pairs(dem));
  carry_walls(dem);
  return PACKING_OK;
}

static void restore_pairs(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  uint32_t name[2];
  for (int s = 0; s < dem->cut.slabs; s++)
    for (size_t k = 0; k < dem->slab[s].list_count; k++) {
      const size_t slot = dem->slab[s].list_first + k;
      const int straight = name_pair(dem, slot, name);
      for (size_t c = h->carried_at[name[0]]; c < h->carried_at[name[0] + 1]; c++)
        if (h->carried_id[c] == name[1]) {
          orient(h, straight, h->carried + c * h->size, h->value + slot * h->size);
          h->mark[slot] = mark_of(dem) - 1;
        }
    }
}

static void restore_walls(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  for (int s = 0; s < dem->cut.slabs; s++)
    for (size_t k = 0; k < dem->slab[s].wall_count; k++) {
      const size_t to = dem->slab[s].first + k;
      const size_t from = h->wall_carried_at[dem->id[dem->near_wall[to]]];
      if (from == UINT32_MAX)
        continue;
      memcpy(h->wall_value + to * WALLS * h->size,
             h->wall_carried + from * WALLS * h->size, WALLS * h->size * sizeof(double));
      memcpy(h->wall_mark + to * WALLS, h->wall_carried_mark + from * WALLS,
             WALLS * sizeof(uint64_t));
    }
}

packing_status packing_i_history_restore(packing_dem *dem)
{
  packing_i_history *h = &dem->history;
  if (h->size == 0)
    return PACKING_OK;
  PACKING_I_TRY(grow(dem));
  memset(h->mark, 0, dem->list_capacity * sizeof *h->mark);
  memset(h->wall_mark, 0, dem->capacity * WALLS * sizeof *h->wall_mark);
  if (h->kept) {
    restore_pairs(dem);
    restore_walls(dem);
  }
  h->kept = 1;
  return PACKING_OK;
}

double *packing_i_history_fetch(const packing_dem *dem, size_t slab,
                                const packing_i_batch *b, int walls)
{
  const packing_i_history *h = &dem->history;
  if (h->size == 0)
    return NULL;
  double *work = h->work + slab * PACKING_I_ROOM * h->size;
  const double *value = walls ? h->wall_value : h->value;
  const uint64_t *mark = walls ? h->wall_mark : h->mark;
  for (size_t k = 0; k < b->count; k++) {
    const size_t from = b->slot[k];
    const int known = lives(dem, mark[from]);
    for (size_t c = 0; c < h->size; c++)
      work[c * PACKING_I_ROOM + k] = known ? value[from * h->size + c] : 0;
  }
  for (size_t c = 0; c < h->size; c++)
    for (size_t k = b->count; k % 8 != 0; k++)
      work[c * PACKING_I_ROOM + k] = 0;
  return work;
}

void packing_i_history_store(packing_dem *dem, const double *work,
                             const packing_i_batch *b, int walls)
{
  packing_i_history *h = &dem->history;
  if (h->size == 0)
    return;
  double *value = walls ? h->wall_value : h->value;
  uint64_t *mark = walls ? h->wall_mark : h->mark;
  for (size_t k = 0; k < b->count; k++) {
    const size_t to = b->slot[k];
    for (size_t c = 0; c < h->size; c++)
      value[to * h->size + c] = work[c * PACKING_I_ROOM + k];
    mark[to] = mark_of(dem);
  }
}
