/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random sequential addition of equal particles, to proved saturation.
 *
 * First darts uniform over the region of centres, tested against the cells around. When few
 * still hit, darts uniform over the voxels that no single exclusion ball covers: refusals are
 * only left out, so the law of the process is untouched. Once one dart has been thrown for every
 * eight voxels and few hit, these are halved and culled against the particles that stand by then.
 * Darts go in rounds (rsa_round.h). Cost: linear in N up to saturation.
 * Campello and Cassares (2016), section 2, step 2; Zhang and Torquato, Phys. Rev. E 88, 053312 (2013). */
#include "rsa_round.h"
#include "rsa_voxels.h"

enum {
  FEW = 64,          /* voxels once fewer than one in so many darts hits */
  STILL_MANY = 2,    /* no split while one in so many hits */
  VOXELS_A_DART = 8, /* thrown before voxels are split again; 1 took a tenth longer */
  CELLS_A_HIT = 20,  /* a round aims at one hit in so many cells: few darts then meet */
  MOST_HITS =
      1 << 18, /* and at no more than this, so that each stage of it stays short */
  MOST_DARTS = 1 << 21,
  LEAST_DARTS = 16,
  VOXELS_A_BIN = 64,
  MOST_AHEAD = 1 << 22, /* particles to make room for ahead where none are counted */
  HOPELESS_A_CELL =
      64, /* so many voxels for each cell, and so many more, none of which was */
  HOPELESS = 1 << 20 /* hit since the last split, end the run */
};

typedef enum equal_phase { DARTS, SPLIT, VOXELS } equal_phase;

typedef struct equal {
  packing_i_rsa_goal goal;
  packing_i_rsa_cells cells;
  packing_i_rsa_voxels voxels;
  packing_i_rsa_space space;
  packing_i_rsa_round round;
  packing_i_rsa_scene scene;
  double ball;
  double hit_rate; /* of the last round */
  size_t thrown;   /* darts since the last split */
  size_t hits;     /* of them */
  equal_phase phase;
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

/* Three numbers in [0, 1) of 40 bits each. */
static packing_vec3 unit_point(const uint32_t random[4])
{
  const uint32_t low = random[3];
  return packing_i_vec((double)((uint64_t)random[0] << 8 | (low & 255U)) * 0x1p-40,
                       (double)((uint64_t)random[1] << 8 | (low >> 8 & 255U)) * 0x1p-40,
                       (double)((uint64_t)random[2] << 8 | (low >> 16 & 255U)) * 0x1p-40);
}

/* Bins of the first phase: rows of cells along x. */
static int row_point(const void *user, size_t bin, const uint32_t random[4],
                     packing_vec3 *point)
{
  const packing_i_rsa_cells *c = &((const equal *)user)->cells;
  const packing_vec3 u = unit_point(random);
  const double row = (double)bin, layer = floor((row + 0.5) * c->per_layer);
  const double y = row - layer * c->n[1] + u.y, z = layer + u.z;
  *point = keep_point(c, packing_i_vec(c->lo.x + u.x * c->width.x,
                                       c->lo.y + y * c->edge.y, c->lo.z + z * c->edge.z));
  return 1;
}

/* Bins of the second: 64 voxels next to one another in the list; the last one is filled up with
 * voxels that are not there. */
static int voxel_point(const void *user, size_t bin, const uint32_t random[4],
                       packing_vec3 *point)
{
  const equal *e = user;
  const size_t i = bin * VOXELS_A_BIN + (random[3] >> 24) % VOXELS_A_BIN;
  if (i >= e->voxels.live.count)
    return 0;
  *point = keep_point(
      &e->cells, packing_i_rsa_voxel_point(&e->voxels, &e->cells,
                                           packing_i_rsa_voxel_at(&e->voxels.live, i),
                                           unit_point(random)));
  return 1;
}

/* Particles that may still be added. */
static size_t still_wanted(const packing_placer *placer, const equal *e)
{
  size_t most = SIZE_MAX;
  if (e->goal.count != 0)
    most = e->goal.count - placer->tally.placed;
  if (e->goal.solid_volume > 0) {
    const double left =
        (e->goal.solid_volume - placer->tally.solid_volume) / e->ball + 0.5;
    const size_t whole = left < 1 ? 0 : left < 1e18 ? (size_t)left : SIZE_MAX;
    if (whole < most)
      most = whole;
  }
  return most;
}

static double limited(double value, double least, double most)
{
  return value < least ? least : value > most ? most : value;
}

/* Darts for a round that should hit as often as is asked for and good for it. */
static size_t darts_of_round(const packing_placer *placer, const equal *e)
{
  const double cells = (double)e->cells.n[0] * e->cells.n[1] * e->cells.n[2];
  const double wanted = 1.05 * (double)still_wanted(placer, e);
  double hits = limited(cells / CELLS_A_HIT, 1, MOST_HITS);
  if (wanted < hits)
    hits = wanted;
  return (size_t)limited(hits / e->hit_rate, LEAST_DARTS, MOST_DARTS);
}

static packing_status begin_round(packing_placer *placer, equal *e)
{
  size_t darts = darts_of_round(placer, e), bins = (size_t)e->cells.n[1] * e->cells.n[2];
  if (e->phase == VOXELS) {
    const size_t live = e->voxels.live.count, enough = live / VOXELS_A_DART;
    bins = (live + VOXELS_A_BIN - 1) / VOXELS_A_BIN;
    if (darts > enough)
      darts = (size_t)limited((double)enough, LEAST_DARTS, MOST_DARTS);
  }
  e->scene.target.point = e->phase == VOXELS ? voxel_point : row_point;
  return packing_i_rsa_round_begin(&e->round, placer->context, darts, bins);
}

/* What comes after a round: another one, or a split of the voxels. */
static packing_status round_over(packing_placer *placer, equal *e)
{
  const double rate = (double)e->round.accepted / (double)e->round.darts;
  if (e->phase == DARTS && rate * FEW < 1) {
    PACKING_I_TRY(packing_i_rsa_voxels_init(&e->voxels, &e->space));
    e->phase = SPLIT;
  } else if (e->phase == VOXELS && rate * STILL_MANY < 1 &&
             VOXELS_A_DART * (e->thrown + e->round.darts) >= e->voxels.live.count) {
    packing_i_rsa_voxels_begin_split(&e->voxels);
    e->phase = SPLIT;
  }
  placer->tally.attempts += e->round.darts;
  e->thrown += e->round.darts;
  e->hits += e->round.accepted;
  e->hit_rate = limited(rate, 1.0 / 64, 1);
  e->round.darts = 0;
  return PACKING_OK;
}

static packing_status throw_some(packing_placer *placer, equal *e)
{
  if (e->round.stage != PACKING_I_RSA_IDLE)
    return packing_i_rsa_round_step(&e->round, &e->scene, still_wanted(placer, e));
  if (e->round.darts > 0)
    return round_over(placer, e);
  if (still_wanted(placer, e) > 0)
    return begin_round(placer, e);
  placer->tally.state = PACKING_PLACER_DONE;
  return PACKING_OK;
}

/* Where centres fit on a surface only (a gap of exactly one diameter), voxels along it are never
 * covered and never hit: their number grows with each split. */
static int is_hopeless(const equal *e)
{
  const double cells = (double)e->cells.n[0] * e->cells.n[1] * e->cells.n[2];
  return e->hits == 0 &&
         (double)e->voxels.live.count > HOPELESS_A_CELL * cells + HOPELESS;
}

static packing_status split_some(packing_placer *placer, equal *e)
{
  int done = 0;
  PACKING_I_TRY(packing_i_rsa_voxels_split(&e->voxels, &e->space, &done));
  if (!done)
    return PACKING_OK;
  if (e->voxels.live.count == 0 || e->voxels.level > PACKING_I_VOXEL_DEEPEST)
    placer->tally.state = PACKING_PLACER_SATURATED;
  else if (is_hopeless(e))
    placer->tally.state = PACKING_PLACER_GAVE_UP;
  e->phase = VOXELS;
  e->thrown = e->hits = 0;
  e->hit_rate = 0.25;
  return PACKING_OK;
}

static double progress_of(const packing_placer *placer, const equal *e)
{
  const double limit =
      e->space.dim == 2 ? PACKING_I_RSA_SATURATION_2D : PACKING_I_RSA_SATURATION_3D;
  const double full = placer->tally.volume_fraction / limit;
  const double asked = packing_i_rsa_progress(&e->goal, &placer->tally);
  return asked > full ? asked : limited(full, 0, 1);
}

static packing_status equal_step(packing_placer *placer, size_t budget)
{
  equal *e = placer->method;
  for (; budget > 0 && placer->tally.state == PACKING_PLACER_RUNNING; budget--)
    PACKING_I_TRY(e->phase == SPLIT && still_wanted(placer, e) > 0
                      ? split_some(placer, e)
                      : throw_some(placer, e));
  placer->tally.progress = progress_of(placer, e);
  return PACKING_OK;
}

static void equal_release(packing_placer *placer)
{
  equal *e = placer->method;
  packing_i_rsa_cells_release(&e->cells, placer->context);
  packing_i_rsa_voxels_release(&e->voxels, placer->context);
  packing_i_rsa_round_release(&e->round, placer->context);
  packing_i_free(packing_i_allocator(placer->context), e);
}

/* Particles expected at the end, no more than the container's volume holds; 0 where only
 * saturation ends it. */
static size_t expected_count(const packing_placer *placer, const equal *e)
{
  size_t wanted = still_wanted(placer, e);
  const double fit = placer->domain_volume / e->ball;
  if (wanted <= UINT32_MAX && fit < (double)wanted)
    wanted = (size_t)fit + 1;
  return wanted > UINT32_MAX ? 0 : wanted + placer->particles->count;
}

/* About how many stand at saturation, for memory taken ahead: growing at 1e6 particles takes long
 * steps. 0 where that would be much memory for a caller who may stop early. */
static size_t saturated_count(const packing_placer *placer, const equal *e)
{
  const double limit = placer->particles->dim == 2 ? PACKING_I_RSA_SATURATION_2D
                                                   : PACKING_I_RSA_SATURATION_3D;
  const double count = 1.02 * limit * placer->domain_volume / e->ball;
  return count < MOST_AHEAD ? (size_t)count + placer->particles->count : 0;
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
  const double r = packing_psd_max_r(placer->psd);
  const int boxlike = packing_i_domain_planar(placer->domain) != NULL;
  e->goal = *goal;
  e->ball = packing_i_ball_volume(placer->particles->dim, r);
  e->hit_rate = 1;
  e->phase = DARTS;
  PACKING_I_TRY(packing_i_rsa_round_init(&e->round, context, def->seed, def->stream));
  const size_t expected = expected_count(placer, e);
  PACKING_I_TRY(
      packing_i_rsa_cells_init(&e->cells, context, placer->domain, r, expected));
  e->space =
      (packing_i_rsa_space){&e->cells,
                            placer->domain,
                            r,
                            placer->particles->dim,
                            boxlike,
                            context,
                            packing_i_rsa_children_for(packing_context_isa(context))};
  e->scene = (packing_i_rsa_scene){placer, &e->cells, r, boxlike, {row_point, e}};
  const size_t ahead = expected > 0 ? expected : saturated_count(placer, e);
  if (ahead > 0) {
    PACKING_I_TRY(packing_particles_reserve(placer->particles, ahead));
    /* The candidates of the last rounds are more than what is kept of them. */
    PACKING_I_TRY(
        packing_i_rsa_cells_reserve(&e->cells, context, ahead + ahead / 4 + 64));
  }
  return add_obstacles(placer, e);
}

const packing_i_placer_ops packing_i_rsa_equal_ops = {
    "rsa",
    "Campello and Cassares, section 2, step 2; Zhang and Torquato, Phys. Rev. E 88, "
    "053312 "
    "(2013)",
    equal_step, equal_release};
