/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pocket front: start, steps, end. See front_pockets.h.
 *
 * Seed paper (I. Perez Morales, R. Rosello Valera, C. Recarey and others), section 3, with the
 * choice of place and radius in place of the first that fits. */
#include "front_pockets.h"
#include <float.h>
#include <stdlib.h>

/* Below so many particles one lane does it: tiles would be too few. */
static const double many_3d = 2e5, many_2d = 5e4;

static const double expected_3d = 0.66, expected_2d = 0.88;

/* ---- lengths ---- */

static void set_lengths(packing_i_pockets *p)
{
  const packing_i_source *source = p->front.source;
  const packing_particles *store = p->placer->particles;
  p->min_r = packing_i_source_min_r(source);
  p->max_r = packing_i_source_max_r(source);
  p->mean_r = packing_i_source_moment(source, 1);
  p->body_r = p->max_r;
  p->most_r = HUGE_VAL;
  for (int axis = 0; axis < 3; axis++)
    if (p->periodic >> axis & 1U)
      p->most_r = fmin(p->most_r, 0.5 * packing_i_component(p->period, axis));
  for (size_t i = 0; i < store->count; i++)
    p->body_r = fmax(p->body_r, store->r[i]);
  int exponent;
  (void)frexp(p->max_r, &exponent);
  p->unit = ldexp(1, exponent - 1);
  p->per_unit = 1 / p->unit;
  p->equal = !(p->max_r > p->min_r);
  p->reference_r = p->equal ? p->max_r : 0.85 * p->mean_r;
  p->wide = p->max_r > PACKING_I_FRONT_RATIO * p->min_r;
  p->cap = 1.2;
  p->slack = 1e-12 * p->mean_r * p->mean_r;
  const packing_bounds *b = &p->bounds;
  const double far =
      fmax(fmax(fmax(fabs(b->lo.x), fabs(b->hi.x)), fmax(fabs(b->lo.y), fabs(b->hi.y))),
           fmax(fabs(b->lo.z), fabs(b->hi.z)));
  p->touch = fmax(1e-13 * p->min_r, 4 * DBL_EPSILON * far);
}

/* With too few pockets a front among very different sizes dies out. */
static size_t litter_for(const packing_i_pockets *p, int narrow)
{
  const double ratio = p->max_r / p->min_r;
  if (narrow)
    return 3;
  return ratio < 2.5 ? 2 : ratio < 5 ? 4 : SIZE_MAX;
}

/* Equal and nearly equal sizes pack best strictly inside out (Bennett's global criterion: C. H.
 * Bennett, J. Appl. Phys. 43, 2727, 1972); others where the best of a thicker layer is taken.
 * Weights and steps were found by trial on 1e5 to 1e6 particles. */
static void set_weights(packing_i_pockets *p, const packing_front_def *def)
{
  const int fast = def->mode == PACKING_FRONT_FAST;
  const int narrow = p->max_r - p->min_r <= 0.15 * p->mean_r;
  const int looks_ahead = !fast && !p->equal;
  p->second = looks_ahead ? 0.4 : 0;
  p->third = looks_ahead ? 0.1 : 0;
  p->exits = looks_ahead ? 3 : 1;
  p->order = narrow ? 3 : 0.1;
  p->balance = p->equal ? 0 : p->dim == 2 ? 2 : 0.1;
  p->level_step = (narrow ? 0.3 : 2) * p->mean_r;
  p->litter = fast ? litter_for(p, narrow) : SIZE_MAX;
}

/* Tiles: so large that two with one between them touch no common sphere. */
static packing_vec3 tile_edge(packing_i_pockets *p)
{
  const double least = 2.05 * (5 * p->max_r + p->body_r);
  packing_vec3 edge = packing_i_vec(least, least, least);
  double *const e[3] = {&edge.x, &edge.y, &edge.z};
  for (int axis = 0; axis < 3 && p->lanes > 1; axis++) {
    const double period = packing_i_component(p->period, axis);
    if (!(p->periodic >> axis & 1U))
      continue;
    const double pairs = floor(period / (2 * least));
    if (pairs < 2)
      p->lanes = 1;
    else
      *e[axis] = period / (2 * pairs); /* an even number: colours fit at the seam */
  }
  if (p->lanes == 1)
    edge = packing_i_vec(least, least, least);
  if (p->dim == 2)
    edge.z = 64 * least;
  return edge;
}

/* Cells along the edge of a tile: each holds a few particles of the middle sizes by volume, and
 * tiles hold no more than 32^3 of them. */
static int cells_along(const packing_i_pockets *p, double edge)
{
  const packing_i_source *source = p->front.source;
  const double middle = packing_i_source_moment(source, p->dim + 1) /
                        packing_i_source_moment(source, p->dim);
  const double n = ceil(edge / (2.6 * middle));
  return n < 6 ? 6 : n < PACKING_I_TILE_MOST ? (int)n : PACKING_I_TILE_MOST;
}

static double expected(const packing_i_pockets *p)
{
  const packing_placer *placer = p->placer;
  const double fraction = p->dim == 2 ? expected_2d : expected_3d;
  const double ball =
      packing_i_ball_volume(p->dim, 1) * packing_i_source_moment(p->front.source, p->dim);
  double n = fraction * placer->domain_volume / ball;
  if (p->front.count != 0)
    n = fmin(n, (double)p->front.count);
  if (p->front.solid_volume > 0)
    n = fmin(n, p->front.solid_volume / ball);
  return n;
}

/* ---- start ---- */

static packing_status members(const packing_placer *placer, size_t capacity,
                              size_t *index, size_t *count);

static packing_status start_lanes(packing_i_pockets *p, const packing_front_def *def,
                                  size_t stock)
{
  packing_context *context = p->placer->context;
  p->lane = packing_i_calloc(packing_i_allocator(context), p->lanes, sizeof *p->lane);
  if (p->lane == NULL)
    return packing_i_nomem(context);
  p->halo_room = 512;
  for (size_t l = 0; l < p->lanes; l++) {
    PACKING_I_TRY(packing_i_lane_init(p, p->lane + l, p->halo_room));
    if (l == 0) {
      p->lane[0].source = p->front.source;
      continue;
    }
    packing_front_def own = *def;
    own.stream += l * UINT64_C(0x9E3779B97F4A7C15); /* far from what users count */
    PACKING_I_TRY(packing_i_source_create(context, &own, p->placer->psd, stock,
                                          &p->lane[l].source));
  }
  return PACKING_OK;
}

static packing_status start(packing_i_pockets *p, const packing_front_def *def,
                            size_t stock)
{
  packing_placer *placer = p->placer;
  const double n = expected(p);
  p->lanes = def->classes == NULL && n >= (p->dim == 2 ? many_2d : many_3d)
                 ? (size_t)PACKING_I_LANES
                 : 1;
  const packing_vec3 edge = tile_edge(p);
  p->colours = p->lanes > 1 ? 8 : 1;
  const int n_edge = cells_along(p, edge.x);
  const int cells[3] = {n_edge, n_edge, p->dim == 2 ? 1 : n_edge};
  packing_vec3 origin = p->bounds.lo;
  if (p->dim == 2)
    origin.z = -0.5 * edge.z;
  packing_i_front_grid_init(&p->grid, packing_i_allocator(placer->context), origin, edge,
                            cells);
  PACKING_I_TRY(start_lanes(p, def, stock));
  if (n < 1e9) /* a guess: the store grows beyond it if need be */
    PACKING_I_TRY(packing_particles_reserve(
        placer->particles, placer->particles->count + (size_t)(1.02 * n) + 16));
  packing_i_front_search_begin(p, 0);
  PACKING_I_TRY(packing_i_front_enter_store(p));
  return p->live_count > 0 ? PACKING_OK : packing_i_front_seed(p);
}

packing_status packing_i_front_pockets_start(packing_placer *placer,
                                             const packing_front_def *def,
                                             const packing_i_front *head)
{
  packing_i_pockets *p =
      packing_i_calloc(packing_i_allocator(placer->context), 1, sizeof *p);
  if (p == NULL)
    return packing_i_nomem(placer->context);
  p->front = *head;
  p->front.members = members;
  p->placer = placer;
  p->kernels = packing_i_front_kernels_for(packing_context_isa(placer->context));
  p->domain = placer->domain;
  p->dim = packing_domain_dim(p->domain);
  p->periodic = packing_domain_periodic(p->domain);
  packing_domain_bounds(p->domain, &p->bounds);
  p->period = p->domain->body.period;
  p->open_axis = p->domain->body.open_axis;
  p->curved = packing_i_domain_planar(p->domain) == NULL;
  p->inward = def->direction == PACKING_FRONT_INWARD && isfinite(head->room);
  set_lengths(p);
  set_weights(p, def);
  packing_i_stream_open(&p->turns, def->seed, def->stream, PACKING_PURPOSE_POSITION, 0);
  placer->method = p;
  placer->ops = &packing_i_front_pockets_ops;
  const size_t stood = placer->particles->count;
  const packing_status status =
      start(p, def, packing_i_source_stock(head->source, 0)->count);
  if (status != PACKING_OK) {
    packing_particles_truncate(placer->particles, stood);
    p->front.source = NULL; /* still the caller's */
    if (p->lane != NULL)
      p->lane[0].source = NULL;
    packing_i_front_pockets_ops.release(placer);
    placer->method = NULL;
  }
  return status;
}

/* ---- steps ---- */

double packing_i_front_key(const packing_i_pockets *p, const packing_vec3 *c)
{
  if (p->inward)
    return packing_domain_signed_distance(p->domain, c, NULL);
  return packing_i_norm(packing_i_domain_separation(p->domain, p->front.innermost, *c));
}

static packing_status step(packing_placer *placer, size_t budget)
{
  packing_i_pockets *p = placer->method;
  packing_placer_report *tally = &placer->tally;
  for (size_t n = 0; n < budget && tally->state == PACKING_PLACER_RUNNING; n++) {
    int done = 0;
    if (p->front.count != 0 && tally->placed >= p->front.count) {
      tally->state = PACKING_PLACER_DONE;
      break;
    }
    PACKING_I_TRY(packing_i_front_round(p, &done));
    if (done) {
      tally->state = PACKING_PLACER_SATURATED;
      tally->unplaced = packing_i_source_unplaced(p->front.source);
      if (packing_i_source_listed(p->front.source) && tally->unplaced == 0)
        tally->state = PACKING_PLACER_DONE;
      if (!packing_i_front_wants(&p->front, tally,
                                 packing_i_ball_volume(p->dim, p->min_r)))
        tally->state =
            PACKING_PLACER_DONE; /* the goal is met, or below half a particle */
    }
  }
  tally->progress = packing_i_front_progress(&p->front, placer);
  return PACKING_OK;
}

/* ---- the front ---- */

static int by_index(const void *a, const void *b)
{
  const size_t x = *(const size_t *)a, y = *(const size_t *)b;
  return x < y ? -1 : x > y;
}

static packing_status members(const packing_placer *placer, size_t capacity,
                              size_t *index, size_t *count)
{
  const packing_i_pockets *p = placer->method;
  const packing_allocator *allocator = packing_i_allocator(placer->context);
  size_t n = 0;
  size_t *all =
      packing_i_alloc(allocator, p->chunks * PACKING_I_POCKET_CHUNK, sizeof *all);
  if (all == NULL)
    return packing_i_nomem(placer->context);
  for (uint32_t id = 1; id < p->chunks * PACKING_I_POCKET_CHUNK; id++)
    if (packing_i_pocket_at(p, id)->alive) {
      unsigned k;
      const packing_i_front_bin *bin =
          packing_i_front_bin_of(&p->grid, packing_i_pocket_at(p, id)->owner, &k);
      all[n++] = bin->index[k];
    }
  qsort(all, n, sizeof *all, by_index);
  size_t kept = 0;
  for (size_t m = 0; m < n; m++)
    if (m == 0 || all[m] != all[m - 1])
      all[kept++] = all[m];
  *count = kept;
  for (size_t m = 0; m < kept && m < capacity; m++)
    index[m] = all[m];
  packing_i_free(allocator, all);
  return PACKING_OK;
}

static void release(packing_placer *placer)
{
  packing_i_pockets *p = placer->method;
  const packing_allocator *allocator = packing_i_allocator(placer->context);
  for (size_t l = 0; p->lane != NULL && l < p->lanes; l++)
    packing_i_lane_release(p, p->lane + l);
  if (p->lane == NULL)
    packing_i_source_destroy(p->front.source);
  packing_i_free(allocator, p->lane);
  packing_i_free(allocator, p->live);
  for (size_t c = 0; c < p->chunks; c++)
    packing_i_free(allocator, p->chunk[c]);
  packing_i_free(allocator, p->chunk);
  packing_i_front_grid_release(&p->grid);
  packing_i_free(allocator, p);
}

const packing_i_placer_ops packing_i_front_pockets_ops = {
    "front", "I. Perez Morales and others, section 3; pockets between triples of bodies",
    step, release};
