/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rsa_round.h"
#include "rsa_order.h"
#include <stdlib.h>
#include <string.h>

enum {
  COUNTS_A_UNIT = 1 << 16,
  DARTS_A_BLOCK = 1024,
  BLOCKS_A_UNIT = 16,
  DARTS_AHEAD = PACKING_I_PHILOX_BATCH,
  CANDIDATES_A_UNIT = 1 << 14,
  CANDIDATES_A_BLOCK = 2048,
  PURPOSE_COUNT = 64, /* streams of our own beside PACKING_PURPOSE_POSITION */
  PURPOSE_TIME = 65,
  PURPOSE_BIAS = 66
};

enum { REFUSED, ACCEPTED, UNSETTLED };

static void open_key(uint64_t seed, uint64_t stream, uint32_t purpose, uint32_t key[2])
{
  packing_i_stream s;
  packing_i_stream_open(&s, seed, stream, purpose, 0);
  key[0] = s.key[0];
  key[1] = s.key[1];
}

packing_status packing_i_rsa_round_init(packing_i_rsa_round *round,
                                        packing_context *context, uint64_t seed,
                                        uint64_t stream)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  open_key(seed, stream, PACKING_PURPOSE_POSITION, round->key);
  open_key(seed, stream, PURPOSE_TIME, round->time_key);
  open_key(seed, stream, PURPOSE_COUNT, round->count_key);
  packing_i_stream_open(&round->counts, seed, stream, PURPOSE_BIAS, 0);
  round->philox = packing_i_philox_batch_for(packing_context_isa(context));
  round->scratch = packing_i_alloc(allocator, (size_t)DARTS_A_BLOCK * BLOCKS_A_UNIT,
                                   sizeof *round->scratch);
  round->scratch_count =
      packing_i_alloc(allocator, BLOCKS_A_UNIT, sizeof *round->scratch_count);
  if (round->scratch == NULL || round->scratch_count == NULL)
    return packing_i_nomem(context);
  return PACKING_OK;
}

void packing_i_rsa_round_release(packing_i_rsa_round *round, packing_context *context)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_i_free(allocator, round->first);
  packing_i_free(allocator, round->candidate);
  packing_i_free(allocator, round->fate);
  packing_i_free(allocator, round->order);
  packing_i_free(allocator, round->scratch);
  packing_i_free(allocator, round->scratch_count);
}

packing_status packing_i_rsa_round_begin(packing_i_rsa_round *round,
                                         packing_context *context, size_t darts,
                                         size_t bins)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  if (bins + 1 > round->first_room) {
    uint32_t *first = packing_i_alloc(allocator, bins + 1, sizeof *first);
    if (first == NULL)
      return packing_i_nomem(context);
    packing_i_free(allocator, round->first);
    round->first = first;
    round->first_room = bins + 1;
  }
  memset(round->first, 0, (bins + 1) * sizeof *round->first);
  round->darts = darts;
  round->bins = bins;
  round->number++;
  round->at = 0;
  round->candidates = 0;
  round->accepted = 0;
  round->stage = PACKING_I_RSA_COUNT;
  return PACKING_OK;
}

static void next_stage(packing_i_rsa_round *round, packing_i_rsa_stage stage)
{
  round->stage = stage;
  round->at = 0;
}

/* How many of the next `unit` items of `total` there are. */
static size_t portion(const packing_i_rsa_round *round, size_t total, size_t unit)
{
  return total - round->at < unit ? total - round->at : unit;
}

/* One of the bins from 32 random bits, all alike: Lemire's method; the few numbers that would favour
 * a bin are replaced. */
static size_t bin_from(packing_i_rsa_round *round, uint32_t bits)
{
  const uint32_t bins = (uint32_t)round->bins;
  const uint64_t product = (uint64_t)bits * bins;
  if ((uint32_t)product < bins && (uint32_t)product < (0 - bins) % bins)
    return packing_i_stream_below(&round->counts, bins);
  return (size_t)(product >> 32);
}

/* Draws the bin of some darts; at the end first[b] is the first dart of bin b. */
static void count_step(packing_i_rsa_round *round)
{
  enum { AT_ONCE = 4 * PACKING_I_PHILOX_BATCH };
  const size_t n = portion(round, round->darts, COUNTS_A_UNIT);
  for (size_t i = 0; i < n; i += AT_ONCE) {
    uint32_t word[4][PACKING_I_PHILOX_BATCH];
    round->philox((round->at + i) / 4, round->number, round->count_key, word);
    for (size_t k = 0; k < AT_ONCE && i + k < n; k++)
      round
          ->first[bin_from(round,
                           word[k / PACKING_I_PHILOX_BATCH][k % PACKING_I_PHILOX_BATCH]) +
                  1]++;
  }
  round->at += n;
  if (round->at < round->darts)
    return;
  for (size_t b = 0; b < round->bins; b++)
    round->first[b + 1] += round->first[b];
  next_stage(round, PACKING_I_RSA_THROW);
}

typedef struct round_task {
  packing_i_rsa_round *round;
  const packing_i_rsa_scene *scene;
  size_t count; /* items of this unit, from round->at */
} round_task;

/* The time of a dart. */
static uint64_t time_of(const packing_i_rsa_round *round, size_t dart)
{
  const uint32_t counter[4] = {(uint32_t)dart, (uint32_t)(dart >> 32),
                               (uint32_t)round->number, (uint32_t)(round->number >> 32)};
  uint32_t random[4];
  packing_i_philox(counter, round->time_key, random);
  return (uint64_t)random[1] << 32 | random[0];
}

/* The bin that a dart belongs to. */
static size_t bin_of(const packing_i_rsa_round *round, size_t dart)
{
  size_t low = 0, high = round->bins;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    if (round->first[middle] <= dart)
      low = middle;
    else
      high = middle;
  }
  return low;
}

typedef struct dart_point {
  packing_vec3 p;
  size_t dart;
} dart_point;

/* Draws the points of some darts, and has the cells around them fetched. */
static size_t draw_points(const packing_i_rsa_round *round,
                          const packing_i_rsa_scene *scene, size_t from, size_t to,
                          size_t *bin, dart_point *out)
{
  size_t count = 0;
  uint32_t word[4][PACKING_I_PHILOX_BATCH];
  round->philox(from, round->number, round->key, word);
  for (size_t dart = from; dart < to; dart++) {
    const size_t i = dart - from;
    const uint32_t random[4] = {word[0][i], word[1][i], word[2][i], word[3][i]};
    while (round->first[*bin + 1] <= dart)
      ++*bin;
    out[count].dart = dart;
    if (!scene->target.point(scene->target.user, *bin, random, &out[count].p))
      continue;
    packing_i_rsa_cells_fetch(scene->cells, out[count].p);
    count++;
  }
  return count;
}

static void throw_block(void *arg, size_t block)
{
  const round_task *task = arg;
  const packing_i_rsa_round *round = task->round;
  const packing_i_rsa_scene *scene = task->scene;
  packing_i_rsa_candidate *out = &round->scratch[block * DARTS_A_BLOCK];
  const size_t from = round->at + block * DARTS_A_BLOCK;
  const size_t end = round->at + task->count;
  const size_t to = from + DARTS_A_BLOCK < end ? from + DARTS_A_BLOCK : end;
  uint32_t found = 0;
  size_t bin = bin_of(round, from);
  dart_point points[DARTS_AHEAD];
  for (size_t at = from; at < to; at += DARTS_AHEAD) {
    const size_t stop = at + DARTS_AHEAD < to ? at + DARTS_AHEAD : to;
    const size_t count = draw_points(round, scene, at, stop, &bin, points);
    for (size_t i = 0; i < count; i++) {
      const packing_vec3 p = points[i].p;
      if ((!scene->boxlike &&
           !packing_domain_holds(scene->placer->domain, &p,
                                 scene->r * (1 - packing_i_hold_slack))) ||
          !packing_i_rsa_cells_free(scene->cells, p))
        continue;
      out[found++] =
          (packing_i_rsa_candidate){p.x, p.y, p.z, time_of(round, points[i].dart)};
    }
  }
  round->scratch_count[block] = found;
}

/* Room for `more` candidates in each array of them. */
static packing_status reserve_candidates(packing_i_rsa_round *round,
                                         packing_context *context, size_t more)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  if (round->candidates + more <= round->room)
    return PACKING_OK;
  const size_t room = round->candidates + more + round->room / 2;
  packing_i_rsa_candidate *candidate = packing_i_regrow(
      allocator, round->candidate, round->candidates, room, sizeof *candidate);
  if (candidate == NULL)
    return packing_i_nomem(context);
  round->candidate = candidate;
  packing_i_free(allocator, round->fate);
  packing_i_free(allocator, round->order);
  round->room = 0;
  round->fate = packing_i_alloc(allocator, room, sizeof *round->fate);
  round->order = packing_i_alloc(allocator, room, sizeof *round->order);
  if (round->fate == NULL || round->order == NULL)
    return packing_i_nomem(context);
  round->room = room;
  return PACKING_OK;
}

static packing_status throw_step(packing_i_rsa_round *round,
                                 const packing_i_rsa_scene *scene)
{
  packing_context *context = scene->placer->context;
  round_task task = {round, scene, 0};
  task.count = portion(round, round->darts, (size_t)DARTS_A_BLOCK * BLOCKS_A_UNIT);
  PACKING_I_TRY(reserve_candidates(round, context, task.count));
  const size_t blocks = (task.count + DARTS_A_BLOCK - 1) / DARTS_A_BLOCK;
  packing_i_parallel(context, blocks, throw_block, &task);
  for (size_t b = 0; b < blocks; b++) {
    memcpy(&round->candidate[round->candidates], &round->scratch[b * DARTS_A_BLOCK],
           round->scratch_count[b] * sizeof *round->candidate);
    round->candidates += round->scratch_count[b];
  }
  round->at += task.count;
  if (round->at == round->darts)
    next_stage(round, PACKING_I_RSA_LINK);
  return PACKING_OK;
}

static packing_vec3 place_of(const packing_i_rsa_round *round, size_t i)
{
  const packing_i_rsa_candidate *c = &round->candidate[i];
  return packing_i_vec(c->x, c->y, c->z);
}

/* Candidates join the chains of their cells, ahead of what stands. */
static packing_status link_step(packing_i_rsa_round *round,
                                const packing_i_rsa_scene *scene, size_t most)
{
  packing_i_rsa_cells *cells = scene->cells;
  packing_particles *store = scene->placer->particles;
  if (round->at == 0) {
    PACKING_I_TRY(packing_i_rsa_cells_reserve(cells, scene->placer->context,
                                              cells->count + round->candidates));
    const size_t more = round->candidates < most ? round->candidates : most;
    if (store->count + more > store->capacity)
      PACKING_I_TRY(
          packing_particles_reserve(store, store->count + more + store->count / 2));
    round->base = cells->count;
  }
  const size_t n = portion(round, round->candidates, CANDIDATES_A_UNIT);
  for (size_t i = 0; i < n; i++)
    packing_i_rsa_cells_insert(cells, place_of(round, round->at + i));
  round->at += n;
  if (round->at == round->candidates)
    next_stage(round, PACKING_I_RSA_DECIDE);
  return PACKING_OK;
}

/* Whether the candidates of a chain, which stand ahead of all else, have one within a diameter
 * of p that is earlier than candidate i; of those that are settled only the accepted count. */
static int chain_has_earlier(const packing_i_rsa_round *round,
                             const packing_i_rsa_cells *cells, uint32_t head,
                             packing_vec3 p, size_t i, int settling)
{
  const uint64_t time = round->candidate[i].time;
  for (uint32_t at = head; at > round->base; at = cells->record[at - 1].next) {
    const size_t j = at - 1 - round->base;
    const packing_i_rsa_candidate *q = &round->candidate[j];
    if (j == i || q->time > time || (q->time == time && j > i) ||
        (settling && round->fate[j] != ACCEPTED))
      continue;
    const double dx = q->x - p.x, dy = q->y - p.y, dz = q->z - p.z;
    if (dx * dx + dy * dy + dz * dz < cells->diameter2)
      return 1;
  }
  return 0;
}

static int has_earlier(const packing_i_rsa_round *round, const packing_i_rsa_cells *cells,
                       size_t i, int settling)
{
  const packing_vec3 p = place_of(round, i);
  const uint32_t cell = cells->record[round->base + i].cell;
  uint32_t where[3];
  packing_i_rsa_cells_locate(cells, p, where);
  if (packing_i_rsa_cells_is_inner(cells, where)) {
    uint32_t list[28];
    const size_t n = packing_i_rsa_cells_heads(cells, cell, (uint32_t)round->base, list);
    for (size_t k = 0; k < n; k++)
      if (chain_has_earlier(round, cells, list[k], p, i, settling))
        return 1;
    return 0;
  }
  packing_i_rsa_near around[27];
  const size_t n = packing_i_rsa_cells_around(cells, cell, around);
  for (size_t k = 0; k < n; k++)
    if (chain_has_earlier(round, cells, cells->head[around[k].cell],
                          packing_i_sub(p, around[k].shift), i, settling))
      return 1;
  return 0;
}

static void decide_block(void *arg, size_t block)
{
  const round_task *task = arg;
  packing_i_rsa_round *round = task->round;
  const size_t from = round->at + block * CANDIDATES_A_BLOCK;
  const size_t end = round->at + task->count;
  const size_t to = from + CANDIDATES_A_BLOCK < end ? from + CANDIDATES_A_BLOCK : end;
  for (size_t i = from; i < to; i++)
    round->fate[i] = has_earlier(round, task->scene->cells, i, 0) ? UNSETTLED : ACCEPTED;
}

static void decide_step(packing_i_rsa_round *round, const packing_i_rsa_scene *scene)
{
  round_task task = {round, scene, portion(round, round->candidates, CANDIDATES_A_UNIT)};
  packing_i_parallel(scene->placer->context,
                     (task.count + CANDIDATES_A_BLOCK - 1) / CANDIDATES_A_BLOCK,
                     decide_block, &task);
  round->at += task.count;
  if (round->at == round->candidates)
    next_stage(round, PACKING_I_RSA_SORT);
}

/* Collects the candidates of one fate. */
static size_t collect(packing_i_rsa_round *round, unsigned char fate)
{
  size_t count = 0;
  for (size_t i = 0; i < round->candidates; i++)
    if (round->fate[i] == fate)
      round->order[count++] = (uint32_t)i;
  return count;
}

/* Lists the unsettled by time. */
static void sort_step(packing_i_rsa_round *round)
{
  round->unsettled = collect(round, UNSETTLED);
  packing_i_rsa_sort_by_time(round->candidate, round->order, round->unsettled);
  next_stage(round, PACKING_I_RSA_SETTLE);
}

/* Settles the rest by time. */
static void settle_step(packing_i_rsa_round *round, const packing_i_rsa_scene *scene)
{
  const size_t n = portion(round, round->unsettled, CANDIDATES_A_UNIT);
  for (size_t k = 0; k < n; k++) {
    const size_t i = round->order[round->at + k];
    round->fate[i] = has_earlier(round, scene->cells, i, 1) ? REFUSED : ACCEPTED;
  }
  round->at += n;
  if (round->at == round->unsettled)
    next_stage(round, PACKING_I_RSA_UNLINK);
}

/* Takes all candidates out of the chains again, the last one first. */
static void unlink_step(packing_i_rsa_round *round, const packing_i_rsa_scene *scene)
{
  packing_i_rsa_cells *cells = scene->cells;
  for (size_t i = round->candidates; i-- > 0;) {
    const packing_i_rsa_record *record = &cells->record[round->base + i];
    cells->head[record->cell] = record->next;
  }
  cells->count = round->base;
  next_stage(round, PACKING_I_RSA_TRIM);
}

/* Refuses what comes too late for `most`. */
static void trim_step(packing_i_rsa_round *round, size_t most)
{
  round->accepted = collect(round, ACCEPTED);
  if (round->accepted > most) {
    packing_i_rsa_select_by_time(round->candidate, round->order, round->accepted, most);
    for (size_t k = most; k < round->accepted; k++)
      round->fate[round->order[k]] = REFUSED;
  }
  next_stage(round, PACKING_I_RSA_COMMIT);
}

static packing_status commit_step(packing_i_rsa_round *round,
                                  const packing_i_rsa_scene *scene)
{
  const size_t n = portion(round, round->candidates, CANDIDATES_A_UNIT);
  for (size_t i = round->at; i < round->at + n; i++) {
    if (round->fate[i] != ACCEPTED)
      continue;
    packing_i_rsa_cells_insert(scene->cells, place_of(round, i));
    PACKING_I_TRY(packing_i_placer_put(scene->placer, place_of(round, i), scene->r, 0));
  }
  round->at += n;
  if (round->at == round->candidates)
    next_stage(round, PACKING_I_RSA_IDLE);
  return PACKING_OK;
}

packing_status packing_i_rsa_round_step(packing_i_rsa_round *round,
                                        const packing_i_rsa_scene *scene, size_t most)
{
  switch (round->stage) {
  case PACKING_I_RSA_IDLE:
    break;
  case PACKING_I_RSA_COUNT:
    count_step(round);
    break;
  case PACKING_I_RSA_THROW:
    return throw_step(round, scene);
  case PACKING_I_RSA_LINK:
    return link_step(round, scene, most);
  case PACKING_I_RSA_DECIDE:
    decide_step(round, scene);
    break;
  case PACKING_I_RSA_SORT:
    sort_step(round);
    break;
  case PACKING_I_RSA_SETTLE:
    settle_step(round, scene);
    break;
  case PACKING_I_RSA_UNLINK:
    unlink_step(round, scene);
    break;
  case PACKING_I_RSA_TRIM:
    trim_step(round, most);
    break;
  case PACKING_I_RSA_COMMIT:
    return commit_step(round, scene);
  }
  return PACKING_OK;
}
