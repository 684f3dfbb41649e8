/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random sequential addition of any sizes. A radius is drawn once and kept until it is placed:
 * to draw again after a refusal would favour small ones. In descending order all
 * radii are drawn first. The radii are the same in both orders.
 *
 * Cost: a dart looks into some 8 to 27 cells of each octave of radii; the number of darts per
 * particle grows as the free share of the container falls. There is no proof of saturation here:
 * the placer gives up after max_failures refusals of one radius.
 * Campello and Cassares (2016), section 2, step 2. */
#include "place_index.h"
#include "rsa_internal.h"
#include <stdlib.h>

enum {
  DARTS_A_UNIT = 1024,
  MOST_EXPECTED = 1000000000,
  MOST_WITHOUT_GOAL = 1 << 20 /* then more may come, at the price of fuller cells */
};

typedef struct drawn_size {
  double r;
  size_t component;
  size_t index; /* in the order of drawing */
} drawn_size;

typedef struct mixed {
  packing_i_rsa_goal goal;
  packing_i_stream sizes;
  packing_i_stream positions;
  packing_i_index index;
  packing_bounds bounds;
  unsigned periodic;
  packing_order order;
  uint64_t max_failures;
  uint64_t failures;  /* of the pending radius */
  drawn_size pending; /* the radius to be placed; r 0: none */
  drawn_size *list;   /* descending order: all of them */
  size_t listed;
  size_t next;
  size_t undrawn; /* asked beyond the list, which is more than the container holds */
} mixed;

static drawn_size draw_size(const packing_placer *placer, mixed *m)
{
  drawn_size drawn = {0, 0, 0};
  drawn.r = packing_i_psd_draw(placer->psd, &m->sizes, &drawn.component);
  return drawn;
}

/* A coordinate uniform over the bounds, a radius away from walls. */
static double draw_along(mixed *m, double lo, double hi, int periodic, double r)
{
  const double width = periodic ? hi - lo : hi - lo - 2 * r;
  const double u = packing_i_stream_uniform(&m->positions);
  if (width < 0)
    return lo + 0.5 * (hi - lo);
  const double x = (periodic ? lo : lo + r) + u * width;
  return periodic && x >= hi ? lo : x;
}

static packing_vec3 draw_centre(const packing_placer *placer, mixed *m, double r)
{
  const packing_bounds *b = &m->bounds;
  packing_vec3 p = {0, 0, 0};
  p.x = draw_along(m, b->lo.x, b->hi.x, (m->periodic & PACKING_PERIODIC_X) != 0, r);
  p.y = draw_along(m, b->lo.y, b->hi.y, (m->periodic & PACKING_PERIODIC_Y) != 0, r);
  if (placer->particles->dim == 3)
    p.z = draw_along(m, b->lo.z, b->hi.z, (m->periodic & PACKING_PERIODIC_Z) != 0, r);
  return p;
}

/* Takes the next radius; ends the run when no more is asked for. */
static void next_size(packing_placer *placer, mixed *m)
{
  m->failures = 0;
  if (m->order == PACKING_ORDER_DESCENDING) {
    if (m->next == m->listed)
      placer->tally.state = PACKING_PLACER_DONE;
    else
      m->pending = m->list[m->next++];
    return;
  }
  const drawn_size drawn = draw_size(placer, m);
  const double ball = packing_i_ball_volume(placer->particles->dim, drawn.r);
  if (packing_i_rsa_wants(&m->goal, &placer->tally, ball))
    m->pending = drawn;
  else
    placer->tally.state = PACKING_PLACER_DONE;
}

static void give_up(packing_placer *placer, const mixed *m)
{
  placer->tally.state = PACKING_PLACER_GAVE_UP;
  placer->tally.unplaced = 1 + (m->listed - m->next) + m->undrawn;
}

/* One dart for the pending radius. Memory is taken before the dart is drawn, so that a step that
 * runs out of it can be repeated. */
static packing_status throw_dart(packing_placer *placer, mixed *m)
{
  packing_particles *store = placer->particles;
  const double r = m->pending.r;
  if (store->count == store->capacity)
    PACKING_I_TRY(
        packing_particles_reserve(store, store->count + store->count / 2 + 256));
  PACKING_I_TRY(packing_i_index_reserve(&m->index, 1, r));
  const packing_vec3 p = draw_centre(placer, m, r);
  placer->tally.attempts++;
  if (packing_domain_holds(placer->domain, &p, r * (1 - packing_i_hold_slack)) &&
      packing_i_index_free(&m->index, p, r)) {
    packing_i_index_insert(&m->index, p, r);
    PACKING_I_TRY(packing_i_placer_put(placer, p, r, m->pending.component));
    m->pending.r = 0;
  } else if (++m->failures == m->max_failures) {
    give_up(placer, m);
  }
  return PACKING_OK;
}

static packing_status mixed_step(packing_placer *placer, size_t budget)
{
  mixed *m = placer->method;
  while (budget-- > 0)
    for (int i = 0; i < DARTS_A_UNIT; i++) {
      if (m->pending.r == 0)
        next_size(placer, m);
      if (placer->tally.state != PACKING_PLACER_RUNNING)
        return PACKING_OK;
      PACKING_I_TRY(throw_dart(placer, m));
    }
  placer->tally.progress = packing_i_rsa_progress(&m->goal, &placer->tally);
  return PACKING_OK;
}

static void mixed_release(packing_placer *placer)
{
  mixed *m = placer->method;
  packing_i_index_release(&m->index);
  packing_i_free(packing_i_allocator(placer->context), m->list);
  packing_i_free(packing_i_allocator(placer->context), m);
}

/* Largest first, then as drawn. */
static int before(const void *a, const void *b)
{
  const drawn_size *p = a, *q = b;
  if (p->r != q->r)
    return p->r > q->r ? -1 : 1;
  return p->index < q->index ? -1 : 1;
}

/* Draws all radii that the goal asks for. */
static packing_status draw_list(packing_placer *placer, mixed *m)
{
  const packing_allocator *allocator = packing_i_allocator(placer->context);
  packing_placer_report tally = placer->tally;
  size_t capacity = 0;
  for (;;) {
    drawn_size drawn = draw_size(placer, m);
    const double ball = packing_i_ball_volume(placer->particles->dim, drawn.r);
    if (!packing_i_rsa_wants(&m->goal, &tally, ball))
      break;
    if (m->listed == capacity) {
      capacity += capacity / 2 + 256;
      drawn_size *list =
          packing_i_regrow(allocator, m->list, m->listed, capacity, sizeof *list);
      if (list == NULL)
        return packing_i_nomem(placer->context);
      m->list = list;
    }
    drawn.index = m->listed;
    m->list[m->listed++] = drawn;
    tally.placed++;
    tally.solid_volume += ball;
    if (tally.solid_volume > placer->domain_volume) {
      /* Some of these will find no place: the rest need not be drawn to know. */
      m->undrawn = m->goal.count - m->listed;
      break;
    }
  }
  qsort(m->list, m->listed, sizeof *m->list, before);
  return PACKING_OK;
}

static int has_goal(const mixed *m)
{
  return m->goal.count != 0 || m->goal.solid_volume > 0;
}

/* About how many particles will stand, and some more since sizes vary: no more than the volume
 * asked, or that of the container, holds. */
static size_t expected_count(const packing_placer *placer, const mixed *m)
{
  const int dim = placer->particles->dim;
  double most = has_goal(m) ? MOST_EXPECTED : MOST_WITHOUT_GOAL, moment = 0;
  if (m->goal.count != 0 && (double)m->goal.count < most)
    most = (double)m->goal.count;
  if (packing_psd_moment(placer->psd, PACKING_BY_NUMBER, dim, &moment) == PACKING_OK) {
    const double volume =
        m->goal.solid_volume > 0 ? m->goal.solid_volume : placer->domain_volume;
    const double by_volume =
        1.05 * volume / (packing_i_ball_volume(dim, 1) * moment) + 64;
    if (by_volume < most)
      most = by_volume;
  }
  return (size_t)most + placer->particles->count;
}

static double largest_radius(const packing_placer *placer)
{
  double r = packing_psd_max_r(placer->psd);
  for (size_t i = 0; i < placer->particles->count; i++)
    if (placer->particles->r[i] > r)
      r = placer->particles->r[i];
  return r;
}

packing_status packing_i_rsa_mixed_start(packing_placer *placer,
                                         const packing_rsa_def *def,
                                         const packing_i_rsa_goal *goal)
{
  mixed *m = packing_i_calloc(packing_i_allocator(placer->context), 1, sizeof *m);
  if (m == NULL)
    return packing_i_nomem(placer->context);
  placer->method = m;
  m->goal = *goal;
  m->order = def->order;
  m->max_failures = def->max_failures;
  m->periodic = packing_domain_periodic(placer->domain);
  packing_domain_bounds(placer->domain, &m->bounds);
  packing_i_stream_open(&m->sizes, def->seed, def->stream, PACKING_PURPOSE_SIZE, 0);
  packing_i_stream_open(&m->positions, def->seed, def->stream, PACKING_PURPOSE_POSITION,
                        0);
  const size_t expected = expected_count(placer, m);
  packing_i_index_init(&m->index, placer->context, placer->domain, largest_radius(placer),
                       expected);
  if (has_goal(m)) /* growing later would make long steps */
    PACKING_I_TRY(packing_particles_reserve(placer->particles, expected));
  PACKING_I_TRY(packing_i_index_add_store(&m->index, placer->domain, placer->particles));
  return m->order == PACKING_ORDER_DESCENDING ? draw_list(placer, m) : PACKING_OK;
}

const packing_i_placer_ops packing_i_rsa_mixed_ops = {
    "rsa", "Campello and Cassares, section 2, step 2", mixed_step, mixed_release};
