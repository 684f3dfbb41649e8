/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The seed paper's advancing front, Pseudocode 2 (I. Perez Morales, R. Rosello Valera, C. Recarey
 * and others, sections 3 to 3.4):
 *
 *   1    a first group of particles is the pack P and the front FP;
 *   2.1  a particle P_i of FP is selected; V are its neighbours;
 *   2.2  for all P_j, P_k of V: where the pending particle touches the three, lies inside and is
 *        free of all, it is placed there and joins P and FP; the next is drawn;
 *   2.3  where no pair has such a place, P_i leaves FP.
 *
 * The pending particle (size, shape, rotation) stays until it is placed: to draw again on failure
 * would favour small ones. Neighbours are those nearer than 2 r_new, surface to surface. Inward, the
 * walls are bodies, and until the whole boundary is covered each place touches one of them.
 *
 * Departures: see doc/methods/front.md. Cost: for each particle placed one look at all pairs near
 * P_i that finds nothing, and one that ends early: linear in the particles. */
#include "front_paper.h"
#include <float.h>
#include <string.h>

enum {
  WORK_A_UNIT = 300000, /* some 3 ms */
  MOST_EXPECTED = 1000000000,
  MOST_WITHOUT_GOAL = 1 << 20
};

/* A volume fraction that equal and mixed spheres rarely exceed in this mode. */
static const double most_filled = 0.62, most_filled_2d = 0.9;

/* Ends the run; what was drawn in vain goes back. */
static void finish(packing_placer *placer, packing_placer_state state)
{
  packing_i_paper *paper = placer->method;
  for (size_t z = 0; z < paper->zones; z++) {
    packing_i_paper_pending *pending = &paper->pending[z];
    if (pending->r > 0)
      packing_i_source_return(paper->front.source, z, pending->r, pending->component);
    pending->r = 0;
  }
  placer->tally.state = state;
  if (state == PACKING_PLACER_SATURATED)
    placer->tally.unplaced = packing_i_source_unplaced(paper->front.source);
}

int packing_i_paper_draw(packing_placer *placer, size_t zone,
                         const packing_placer_report *tally,
                         packing_i_paper_pending *pending)
{
  packing_i_paper *paper = placer->method;
  const int dim = placer->particles->dim;
  pending->r = 0;
  if (!packing_i_front_wants(&paper->front, tally, 0) ||
      !packing_i_source_next(paper->front.source, zone, &pending->r, &pending->component))
    return 0;
  pending->volume = packing_shape_volume(paper->shape, pending->r, dim);
  if (paper->shape != NULL)
    packing_i_front_turn(&paper->turns, dim, pending->orientation);
  if (packing_i_front_wants(&paper->front, tally, pending->volume))
    return 1;
  packing_i_source_return(paper->front.source, zone, pending->r, pending->component);
  pending->r = 0;
  return 0;
}

packing_i_paper_pending *packing_i_paper_next(packing_placer *placer, size_t zone)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_pending *pending = &paper->pending[zone];
  /* Since it was drawn, particles of other zones may have reached the goal. */
  if (pending->r > 0
          ? packing_i_front_wants(&paper->front, &placer->tally, pending->volume)
          : packing_i_paper_draw(placer, zone, &placer->tally, pending))
    return pending;
  finish(placer, PACKING_PLACER_DONE);
  return NULL;
}

packing_status packing_i_paper_reserve(packing_placer *placer, size_t count, double r)
{
  packing_i_paper *paper = placer->method;
  packing_particles *store = placer->particles;
  if (store->capacity - store->count < count)
    PACKING_I_TRY(
        packing_particles_reserve(store, store->count + store->count / 2 + count + 256));
  PACKING_I_TRY(packing_i_front_list_reserve(&paper->list, placer->context, count));
  return packing_i_index_reserve(&paper->index, count, r);
}

void packing_i_paper_put(packing_placer *placer, packing_vec3 centre, size_t zone)
{
  packing_i_paper *paper = placer->method;
  packing_particles *store = placer->particles;
  packing_i_paper_pending *pending = &paper->pending[zone];
  packing_domain_wrap(placer->domain, &centre);
  const size_t at = store->count;
  PACKING_IGNORE(packing_i_placer_put_body(placer, centre, pending->r, pending->component,
                                           pending->volume)); /* room was reserved */
  if (paper->shape != NULL)
    for (int k = 0; k < 4; k++)
      ((double *)store->column[PACKING_FIELD_QW + k])[at] = pending->orientation[k];
  packing_i_index_insert(&paper->index, centre, pending->r);
  packing_i_front_list_add(&paper->list, at);
  pending->r = 0;
}

packing_body packing_i_paper_mobile(const packing_i_paper *paper, size_t zone,
                                    packing_vec3 centre)
{
  const packing_i_paper_pending *pending = &paper->pending[zone];
  packing_body body = packing_body_sphere(centre, pending->r);
  body.shape = paper->shape;
  for (int k = 0; k < 4 && paper->shape != NULL; k++)
    body.orientation[k] = pending->orientation[k];
  return body;
}

packing_body packing_i_paper_body(const packing_placer *placer, size_t particle,
                                  packing_vec3 centre)
{
  const packing_i_paper *paper = placer->method;
  const packing_particles *store = placer->particles;
  packing_body body = packing_body_sphere(centre, store->r[particle]);
  body.shape = paper->shape;
  for (int k = 0; k < 4 && paper->shape != NULL; k++)
    body.orientation[k] = ((double *)store->column[PACKING_FIELD_QW + k])[particle];
  return body;
}

double packing_i_paper_below_top(const packing_domain *domain, packing_vec3 p)
{
  const int axis = domain->body.open_axis;
  if (axis < 0)
    return HUGE_VAL;
  return packing_i_component(domain->body.bounds.hi, axis) - packing_i_component(p, axis);
}

int packing_i_paper_inside(const packing_placer *placer, const packing_body *mobile,
                           size_t zone)
{
  const packing_i_paper *paper = placer->method;
  const double slack = packing_i_paper_slack(paper, mobile->r, mobile->r);
  if (!packing_i_vec_finite(mobile->centre) ||
      packing_i_paper_below_top(placer->domain, mobile->centre) < mobile->r - slack)
    return 0;
  if (mobile->shape == NULL) {
    if (!packing_domain_holds(placer->domain, &mobile->centre, mobile->r - slack))
      return 0;
  } else if (!(packing_body_clearance(mobile, placer->domain, NULL) >= -slack)) {
    return 0;
  }
  if (paper->zones == 1)
    return 1;
  packing_vec3 centre = mobile->centre;
  packing_domain_wrap(placer->domain, &centre);
  const size_t there = packing_i_source_zone(paper->front.source, &centre);
  if (there != zone && paper->seen[there] == 0)
    paper->seen[there] = 1;
  return there == zone;
}

packing_status packing_i_paper_free(const packing_placer *placer,
                                    const packing_body *mobile,
                                    packing_i_index_images *near, int *is_free)
{
  const packing_i_paper *paper = placer->method;
  *is_free = 0;
  PACKING_I_TRY(packing_i_index_near(&paper->index, mobile->centre, mobile->r, near));
  for (size_t l = 0; l < near->count; l++) {
    const packing_i_index_image *other = &near->at[l];
    const double slack = packing_i_paper_slack(paper, mobile->r, other->r);
    double gap;
    if (mobile->shape == NULL) {
      gap = packing_i_norm(other->p) - (mobile->r + other->r);
    } else {
      const packing_body body = packing_i_paper_body(
          placer, other->index, packing_i_add(mobile->centre, other->p));
      gap = packing_body_gap(mobile, &body);
    }
    if (!(gap >= -slack))
      return PACKING_OK;
  }
  *is_free = 1;
  return PACKING_OK;
}

int packing_i_paper_meets_itself(const packing_placer *placer, double r)
{
  const packing_vec3 period = placer->domain->body.period;
  const double least = fmin(period.x, fmin(period.y, period.z));
  return 2 * r > least + packing_i_paper_slack(placer->method, r, r);
}

/* Step 2.1: a particle of the front. */
static void select(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const packing_particles *store = placer->particles;
  scan->at = packing_i_front_list_select(&paper->list, &paper->choice);
  scan->i = paper->list.member[scan->at];
  scan->centre = packing_i_vec(store->x[scan->i], store->y[scan->i], store->z[scan->i]);
  packing_domain_wrap(placer->domain, &scan->centre);
  scan->r_i = store->r[scan->i];
  scan->room = fmin(packing_domain_signed_distance(placer->domain, &scan->centre, NULL),
                    packing_i_paper_below_top(placer->domain, scan->centre));
  scan->zone = packing_i_source_zone(paper->front.source, &scan->centre);
  scan->selected = 1;
  scan->gathered = 0;
  if (paper->zones > 1)
    memset(paper->seen, 0, paper->zones);
}

/* What is nearer to P_i than `gap`, surface to surface. */
static packing_status find_near(packing_placer *placer, double gap)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  PACKING_I_TRY(
      packing_i_index_near(&paper->index, scan->centre, scan->r_i + gap, &scan->near));
  size_t kept = 0;
  for (size_t l = 0; l < scan->near.count; l++) {
    const packing_i_index_image *image = &scan->near.at[l];
    const int self =
        image->index == scan->i && image->p.x == 0 && image->p.y == 0 && image->p.z == 0;
    if (!self)
      scan->near.at[kept++] = *image;
  }
  scan->near.count = kept;
  paper->work += 16 * (kept + 8);
  return PACKING_OK;
}

/* Whether those next to P_i leave no place for a much larger particle, which is so nearly always
 * when it would have thousands of neighbours. */
static packing_status is_closed(packing_placer *placer, int *closed)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  *closed = 0;
  if (!paper->closed_form || paper->phase != PACKING_I_PAPER_INSIDE ||
      scan->r <= 2 * scan->r_i)
    return PACKING_OK;
  PACKING_I_TRY(find_near(placer, scan->r_i));
  return packing_i_paper_rings_closed(placer, closed);
}

/* The neighbours V of P_i: nearer than 2 r, surface to surface. */
static packing_status gather(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  scan->r = paper->pending[scan->zone].r;
  scan->unit = scan->r_i + scan->r;
  scan->next_outer = scan->outers = 0;
  scan->picked = scan->picked_inner = 0;
  PACKING_I_TRY(packing_i_paper_reserve(placer, 1, scan->r));
  int closed;
  PACKING_I_TRY(is_closed(placer, &closed));
  if (!closed) {
    PACKING_I_TRY(find_near(placer, 2 * scan->r));
    if (paper->closed_form && paper->phase == PACKING_I_PAPER_INSIDE)
      PACKING_I_TRY(packing_i_paper_rings_begin(placer));
    else
      PACKING_I_TRY(packing_i_paper_pairs_begin(placer));
  }
  scan->gathered = 1;
  return PACKING_OK;
}

/* Another zone that places were seen in; `zones` when all are tried. */
static size_t next_zone(packing_i_paper *paper)
{
  if (paper->zones == 1)
    return 1;
  paper->seen[paper->scan.zone] = 2;
  size_t zone = 0;
  while (zone < paper->zones && paper->seen[zone] != 1)
    zone++;
  return zone;
}

/* Steps 2.2 and 2.3 for the selected particle. */
static packing_status scan_on(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  if (packing_i_paper_next(placer, scan->zone) == NULL)
    return PACKING_OK;
  if (!scan->gathered)
    PACKING_I_TRY(gather(placer));
  const int inside = paper->phase == PACKING_I_PAPER_INSIDE;
  packing_i_paper_answer answer = PACKING_I_PAPER_NOWHERE;
  if (!packing_i_paper_meets_itself(placer, scan->r)) {
    if (paper->closed_form && inside)
      PACKING_I_TRY(packing_i_paper_rings(placer, &answer));
    else
      PACKING_I_TRY(packing_i_paper_pairs(placer, &answer));
    if (answer == PACKING_I_PAPER_NOWHERE)
      PACKING_I_TRY(packing_i_paper_loose(placer, &answer));
  }
  if (answer == PACKING_I_PAPER_NOWHERE) {
    const size_t zone = next_zone(paper);
    scan->gathered = 0;
    if (zone < paper->zones) {
      scan->zone = zone;
      return PACKING_OK;
    }
    packing_i_front_list_drop(&paper->list, scan->at);
  }
  scan->selected = answer == PACKING_I_PAPER_GOING;
  return PACKING_OK;
}

/* All particles are the front of the inside: inward, step 4; and those that stood already. */
static packing_status begin_inside(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  const size_t count = placer->particles->count;
  PACKING_I_TRY(packing_i_front_list_reserve(&paper->list, placer->context, count));
  paper->list.first = paper->list.end = 0;
  for (size_t i = 0; i < count; i++)
    packing_i_front_list_add(&paper->list, i);
  paper->phase = PACKING_I_PAPER_INSIDE;
  return PACKING_OK;
}

/* As an inward front, with all that stands. */
static packing_status begin_walls(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  PACKING_I_TRY(begin_inside(placer));
  paper->phase = PACKING_I_PAPER_WALLS;
  paper->again = PACKING_I_PAPER_AGAIN_NEVER;
  packing_i_paper_walk_begin(placer);
  return PACKING_OK;
}

/* Step 1. */
static packing_status start(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  int started = 0;
  /* Room for all of the list first: what follows a group that stands must not fail. */
  PACKING_I_TRY(packing_i_front_list_reserve(&paper->list, placer->context,
                                             placer->particles->count + 8));
  if (paper->direction == PACKING_FRONT_OUTWARD) {
    PACKING_I_TRY(packing_i_paper_start_outward(placer, &started));
    if (placer->tally.state != PACKING_PLACER_RUNNING)
      return PACKING_OK;
  }
  return started ? begin_inside(placer) : begin_walls(placer);
}

/* The front of the inside has run out. */
static packing_status look(packing_placer *placer)
{
  packing_i_paper_search search;
  PACKING_I_TRY(packing_i_paper_look(placer, &search));
  if (search == PACKING_I_PAPER_FULL)
    finish(placer, PACKING_PLACER_SATURATED);
  return search == PACKING_I_PAPER_AT_WALLS ? begin_walls(placer) : PACKING_OK;
}

static packing_status advance(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  paper->work += 16;
  if (paper->phase == PACKING_I_PAPER_START)
    return start(placer);
  if (paper->scan.selected)
    return scan_on(placer);
  if (packing_i_front_list_count(&paper->list) > 0) {
    select(placer);
    return PACKING_OK;
  }
  if (paper->phase == PACKING_I_PAPER_INSIDE)
    return look(placer);
  int over = 0;
  PACKING_I_TRY(packing_i_paper_walk_on(placer, &over));
  return over && placer->tally.state == PACKING_PLACER_RUNNING ? begin_inside(placer)
                                                               : PACKING_OK;
}

static packing_status paper_step(packing_placer *placer, size_t budget)
{
  packing_i_paper *paper = placer->method;
  for (; budget > 0; budget--) {
    paper->work = 0;
    while (paper->work < WORK_A_UNIT) {
      PACKING_I_TRY(advance(placer));
      if (placer->tally.state != PACKING_PLACER_RUNNING)
        return PACKING_OK;
    }
  }
  placer->tally.progress = packing_i_front_progress(&paper->front, placer);
  return PACKING_OK;
}

static void release_parts(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  const packing_allocator *allocator = packing_i_allocator(placer->context);
  packing_i_paper_scan *scan = &paper->scan;
  packing_i_index_release(&paper->index);
  void *const blocks[] = {scan->near.at,      scan->local.at, scan->rows,
                          paper->list.member, paper->pending, paper->seen};
  for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++)
    packing_i_free(allocator, blocks[k]);
  packing_shape_destroy(paper->shape);
  packing_i_free(allocator, paper);
  placer->method = NULL;
}

static void paper_release(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_i_source_destroy(paper->front.source);
  release_parts(placer);
}

static packing_status paper_members(const packing_placer *placer, size_t capacity,
                                    size_t *index, size_t *count)
{
  const packing_i_paper *paper = placer->method;
  return packing_i_front_list_rising(&paper->list, placer->context,
                                     placer->particles->count, capacity, index, count);
}

/* About how many particles will stand. */
static size_t expected_count(const packing_placer *placer, const packing_i_paper *paper)
{
  const int dim = placer->particles->dim;
  const packing_i_front *front = &paper->front;
  const int goal = front->count != 0 || front->solid_volume > 0;
  double most = goal ? MOST_EXPECTED : MOST_WITHOUT_GOAL;
  const double filled = (dim == 2 ? most_filled_2d : most_filled) * placer->domain_volume;
  const double volume =
      front->solid_volume > 0 ? fmin(front->solid_volume, filled) : filled;
  const double mean = packing_shape_volume(paper->shape, 1, dim) *
                      packing_i_source_moment(front->source, dim);
  most = fmin(most, 1.05 * volume / mean + 64);
  if (front->count != 0)
    most = fmin(most, (double)front->count);
  return (size_t)most + placer->particles->count;
}

/* The unit in which the last place of coordinates in the container is rounded. */
static double rounding_of(const packing_domain *domain)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const double x = fmax(fabs(b.lo.x), fabs(b.hi.x));
  const double y = fmax(fabs(b.lo.y), fabs(b.hi.y));
  const double z = fmax(fabs(b.lo.z), fabs(b.hi.z));
  return DBL_EPSILON * fmax(x, fmax(y, z));
}

static packing_status build(packing_placer *placer, const packing_front_def *def)
{
  packing_i_paper *paper = placer->method;
  const packing_allocator *allocator = packing_i_allocator(placer->context);
  const packing_particles *store = placer->particles;
  paper->zones = packing_i_source_zones(paper->front.source);
  paper->pending = packing_i_calloc(allocator, paper->zones, sizeof *paper->pending);
  paper->seen = packing_i_calloc(allocator, paper->zones, 1);
  if (paper->pending == NULL || paper->seen == NULL)
    return packing_i_nomem(placer->context);
  double top = packing_i_source_max_r(paper->front.source);
  for (size_t i = 0; i < store->count; i++)
    top = fmax(top, store->r[i]);
  const size_t expected = expected_count(placer, paper);
  packing_i_index_init(&paper->index, placer->context, placer->domain, top, expected);
  /* All at once: growing later would make long steps. */
  const double least = packing_i_source_min_r(paper->front.source);
  double r = top;
  while (r > 0.5 * least) { /* an octave each; halving does not round */
    PACKING_I_TRY(packing_i_index_reserve(&paper->index, expected, fmax(r, least)));
    r *= 0.5;
  }
  PACKING_I_TRY(packing_i_index_add_store(&paper->index, placer->domain, store));
  PACKING_I_TRY(packing_particles_reserve(placer->particles, expected));
  if (def->shape != NULL)
    PACKING_I_TRY(
        packing_particles_add_columns(placer->particles, PACKING_COLUMN_ORIENTATION));
  paper->before = store->count;
  paper->rounding = rounding_of(placer->domain);
  return PACKING_OK;
}

packing_status packing_i_front_paper_start(packing_placer *placer,
                                           const packing_front_def *def,
                                           const packing_i_front *head)
{
  if (def->direction == PACKING_FRONT_INWARD && !isfinite(head->room))
    return packing_i_fail(placer->context, PACKING_ERR_RANGE, "direction",
                          PACKING_NO_INDEX, "inward needs walls, there are none");
  packing_i_paper *paper =
      packing_i_calloc(packing_i_allocator(placer->context), 1, sizeof *paper);
  if (paper == NULL)
    return packing_i_nomem(placer->context);
  placer->method = paper;
  paper->front = *head;
  paper->front.members = paper_members;
  paper->direction = def->direction;
  paper->list.select = def->select_particle;
  paper->select_neighbours = def->select_neighbours;
  paper->contact = def->contact != NULL ? *def->contact : *packing_contact_wrappers();
  paper->closed_form = def->contact == NULL || def->contact == packing_contact_wrappers();
  paper->wall_contact = paper->contact.exact ? paper->contact
                        : def->shape == NULL ? *packing_contact_wrappers()
                                             : *packing_contact_potential();
  paper->shape = packing_shape_retain(def->shape);
  packing_i_stream_open(&paper->choice, def->seed, def->stream, PACKING_PURPOSE_POSITION,
                        0);
  packing_i_stream_open(&paper->turns, def->seed, def->stream, PACKING_PURPOSE_POSITION,
                        1);
  const packing_status status = build(placer, def);
  if (status != PACKING_OK)
    release_parts(placer);
  return status;
}

const packing_i_placer_ops packing_i_front_paper_ops = {
    "front", "Perez Morales et al., Pseudocode 2", paper_step, paper_release};
