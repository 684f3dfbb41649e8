/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random sequential addition of equal particles, to proved saturation.
 *
 * First darts uniform over the region of centres, tested against the cells around. When few
 * still hit, darts uniform over the voxels that no single exclusion ball covers: refusals are
 * only left out, so the law of the process is untouched. After as many darts as there are voxels
 * these are halved and culled against the particles that stand by then.
 * Cost: linear in N up to saturation.
 * Seed 000, section 2, step 2; Zhang and Torquato, Phys. Rev. E 88, 053312 (2013). */
#include "rsa_internal.h"
#include "rsa_voxels.h"

enum {
  DARTS_A_UNIT = 8192,
  BATCH = 16,       /* darts drawn ahead, so that their cells are fetched meanwhile */
  WINDOW = 1 << 16, /* darts over which hits are counted */
  FEW = 16,         /* voxels from here on: fewer than one hit in so many darts */
  STILL_MANY = 4    /* no split while one in so many hits */
};

typedef enum equal_phase { DARTS, SPLIT, VOXELS } equal_phase;

typedef struct equal {
  packing_i_rsa_goal goal;
  packing_i_stream stream;
  packing_i_rsa_cells cells;
  packing_i_rsa_voxels voxels;
  packing_i_rsa_space space;
  double r;
  double ball;
  size_t component;
  equal_phase phase;
  size_t darts; /* in the window or round */
  size_t hits;
  packing_vec3 ahead[BATCH];
  unsigned next_ahead;
} equal;

/* Keeps a coordinate in [lo, lo + period) after rounding. */
static double keep(double x, double lo, double period)
{
  return period > 0 && x >= lo + period ? lo : x;
}

static packing_vec3 keep_point(const packing_i_rsa_cells *c, packing_vec3 p)
{
  return packing_i_vec(keep(p.x, c->lo.x, c->period.x), keep(p.y, c->lo.y, c->period.y),
                       keep(p.z, c->lo.z, c->period.z));
}

/* Three numbers in [0, 1); two dimensions take two. */
static packing_vec3 draw_unit(equal *e)
{
  const double x = packing_i_stream_uniform(&e->stream);
  const double y = packing_i_stream_uniform(&e->stream);
  return packing_i_vec(x, y,
                       e->space.dim == 2 ? 0 : packing_i_stream_uniform(&e->stream));
}

/* Fetches the heads of the nine rows of cells around a point. */
static void fetch_around(const packing_i_rsa_cells *c, packing_vec3 p)
{
  const int64_t row = c->n[0], layer = (int64_t)c->n[0] * c->n[1];
  const uint32_t *head = c->head + packing_i_rsa_cell_of(c, p);
  for (int64_t k = -1; k <= 1; k++)
    for (int64_t j = -1; j <= 1; j++)
      __builtin_prefetch(
          (const void *)((uintptr_t)head + (uintptr_t)((k * layer + j * row) * 4)));
}

static packing_vec3 next_dart(equal *e)
{
  const packing_i_rsa_cells *c = &e->cells;
  if (e->next_ahead == BATCH) {
    for (unsigned i = 0; i < BATCH; i++) {
      const packing_vec3 u = draw_unit(e);
      e->ahead[i] = keep_point(c, packing_i_vec(c->lo.x + u.x * c->width.x,
                                                c->lo.y + u.y * c->width.y,
                                                c->lo.z + u.z * c->width.z));
      fetch_around(c, e->ahead[i]);
    }
    e->next_ahead = 0;
  }
  return e->ahead[e->next_ahead++];
}

static packing_vec3 next_voxel_dart(equal *e)
{
  const size_t i = packing_i_stream_below(&e->stream, e->voxels.live.count);
  const packing_vec3 u = draw_unit(e);
  return keep_point(&e->cells, packing_i_rsa_voxel_point(
                                   &e->voxels, &e->cells,
                                   packing_i_rsa_voxel_at(&e->voxels.live, i), u));
}

/* Room for one more particle, taken before its dart is drawn: a step that runs out of memory can
 * be repeated. */
static packing_status reserve_one(packing_placer *placer, equal *e)
{
  packing_particles *store = placer->particles;
  if (store->count == store->capacity)
    PACKING_I_TRY(
        packing_particles_reserve(store, store->count + store->count / 2 + 256));
  return packing_i_rsa_cells_reserve(&e->cells, placer->context, e->cells.count + 1);
}

/* Tries a centre. */
static packing_status try_dart(packing_placer *placer, equal *e, packing_vec3 p)
{
  placer->tally.attempts++;
  e->darts++;
  if (!e->space.boxlike && !packing_domain_holds(placer->domain, &p, e->r))
    return PACKING_OK;
  if (!packing_i_rsa_cells_free(&e->cells, p))
    return PACKING_OK;
  e->hits++;
  packing_i_rsa_cells_insert(&e->cells, p);
  return packing_i_placer_put(placer, p, e->r, e->component);
}

static int wants_more(packing_placer *placer, const equal *e)
{
  if (packing_i_rsa_wants(&e->goal, &placer->tally, e->ball))
    return 1;
  placer->tally.state = PACKING_PLACER_DONE;
  return 0;
}

static packing_status throw_darts(packing_placer *placer, equal *e)
{
  for (size_t i = 0; i < DARTS_A_UNIT && wants_more(placer, e); i++) {
    if (e->darts == WINDOW) {
      if (e->hits < WINDOW / FEW) {
        PACKING_I_TRY(packing_i_rsa_voxels_init(&e->voxels, &e->space));
        e->phase = SPLIT;
        return PACKING_OK;
      }
      e->darts = e->hits = 0;
    }
    PACKING_I_TRY(reserve_one(placer, e));
    PACKING_I_TRY(try_dart(placer, e, next_dart(e)));
  }
  return PACKING_OK;
}

static packing_status throw_voxel_darts(packing_placer *placer, equal *e)
{
  for (size_t i = 0; i < DARTS_A_UNIT && wants_more(placer, e); i++) {
    if (e->darts >= e->voxels.live.count) {
      if (e->hits < e->darts / STILL_MANY) {
        packing_i_rsa_voxels_begin_split(&e->voxels);
        e->phase = SPLIT;
        return PACKING_OK;
      }
      e->darts = e->hits = 0;
    }
    PACKING_I_TRY(reserve_one(placer, e));
    PACKING_I_TRY(try_dart(placer, e, next_voxel_dart(e)));
  }
  return PACKING_OK;
}

static packing_status split_some(packing_placer *placer, equal *e)
{
  int done = 0;
  PACKING_I_TRY(packing_i_rsa_voxels_split(&e->voxels, &e->space, &done));
  if (!done)
    return PACKING_OK;
  e->phase = VOXELS;
  e->darts = e->hits = 0;
  if (e->voxels.live.count == 0 || e->voxels.level > PACKING_I_VOXEL_DEEPEST)
    placer->tally.state = PACKING_PLACER_SATURATED;
  return PACKING_OK;
}

static packing_status equal_step(packing_placer *placer, size_t budget)
{
  equal *e = placer->method;
  for (; budget > 0 && placer->tally.state == PACKING_PLACER_RUNNING; budget--)
    switch (e->phase) {
    case DARTS:
      PACKING_I_TRY(throw_darts(placer, e));
      break;
    case SPLIT:
      PACKING_I_TRY(split_some(placer, e));
      break;
    case VOXELS:
      PACKING_I_TRY(throw_voxel_darts(placer, e));
      break;
    }
  const double limit =
      e->space.dim == 2 ? PACKING_I_RSA_SATURATION_2D : PACKING_I_RSA_SATURATION_3D;
  const double full = placer->tally.volume_fraction / limit;
  const double asked = packing_i_rsa_progress(&e->goal, &placer->tally);
  placer->tally.progress = asked > full ? asked : full < 1 ? full : 1;
  return PACKING_OK;
}

static void equal_release(packing_placer *placer)
{
  equal *e = placer->method;
  packing_i_rsa_cells_release(&e->cells, placer->context);
  packing_i_rsa_voxels_release(&e->voxels, placer->context);
  packing_i_free(packing_i_allocator(placer->context), e);
}

/* Particles expected at the end; 0 where only saturation ends it. */
static size_t expected_count(const packing_placer *placer, const equal *e)
{
  size_t count = e->goal.count;
  if (e->goal.solid_volume > 0) {
    const double by_volume = e->goal.solid_volume / e->ball + 1;
    if (count == 0 || by_volume < (double)count)
      count = by_volume < 4e9 ? (size_t)by_volume : 0;
  }
  return count == 0 ? 0 : count + placer->particles->count;
}

/* Whether a particle of the store can touch one whose centre lies in the region. */
static int within_reach(const packing_i_rsa_cells *c, packing_vec3 p)
{
  const packing_vec3 u = packing_i_sub(p, c->lo);
  const double d = c->diameter;
  return u.x > -d && u.y > -d && u.z > -d && u.x < c->width.x + d &&
         u.y < c->width.y + d && u.z < c->width.z + d;
}

static packing_status add_obstacles(packing_placer *placer, equal *e)
{
  const packing_particles *store = placer->particles;
  for (size_t i = 0; i < store->count; i++) {
    packing_vec3 p = {store->x[i], store->y[i], store->z[i]};
    packing_domain_wrap(placer->domain, &p);
    if (!within_reach(&e->cells, p))
      continue;
    PACKING_I_TRY(
        packing_i_rsa_cells_reserve(&e->cells, placer->context, e->cells.count + 1));
    packing_i_rsa_cells_insert(&e->cells, p);
  }
  return PACKING_OK;
}

packing_status packing_i_rsa_equal_start(packing_placer *placer,
                                         const packing_rsa_def *def,
                                         const packing_i_rsa_goal *goal)
{
  packing_context *context = placer->context;
  equal *e = packing_i_calloc(packing_i_allocator(context), 1, sizeof *e);
  if (e == NULL)
    return packing_i_nomem(context);
  placer->method = e;
  e->goal = *goal;
  e->r = packing_psd_max_r(placer->psd);
  e->ball = packing_i_ball_volume(placer->particles->dim, e->r);
  e->next_ahead = BATCH;
  e->phase = DARTS;
  packing_i_stream_open(&e->stream, def->seed, def->stream, PACKING_PURPOSE_POSITION, 0);
  const size_t expected = expected_count(placer, e);
  PACKING_I_TRY(
      packing_i_rsa_cells_init(&e->cells, context, placer->domain, e->r, expected));
  e->space = (packing_i_rsa_space){&e->cells,
                                   placer->domain,
                                   e->r,
                                   placer->particles->dim,
                                   packing_i_domain_planar(placer->domain) != NULL,
                                   context};
  if (expected > 0) {
    PACKING_I_TRY(packing_particles_reserve(placer->particles, expected));
    PACKING_I_TRY(packing_i_rsa_cells_reserve(&e->cells, context, expected));
  }
  return add_obstacles(placer, e);
}

const packing_i_placer_ops packing_i_rsa_equal_ops = {
    "rsa",
    "Campello and Cassares, section 2, step 2; Zhang and Torquato, Phys. Rev. E 88, "
    "053312 "
    "(2013)",
    equal_step, equal_release};
