/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps 2.2 and 2.2.1 for spheres and discs: of all pairs of neighbours of P_i the first, in the
 * order asked, between which the pending particle has a place. The wrappers of P_i and P_j meet in
 * a ring, on which each other sphere takes an arc: a place is an end of an arc that no other arc
 * covers (front_paper_ring.h). So P_j costs one look at the neighbours and one at the pairs of ends, and
 * what a neighbour hides as a whole costs next to nothing.
 *
 * Order: P_j by age or at random, then P_k by age or at random among those with a place; of two
 * places either. Where P_i has many neighbours (it is much larger than they), only those near P_j
 * are looked at. */
#include "front_paper.h"

static packing_i_ring_body body_of(const packing_i_paper *paper, packing_vec3 p, double r,
                                   size_t index)
{
  const packing_i_paper_scan *scan = &paper->scan;
  packing_i_ring_body body = packing_i_ring_body_of(
      p, r, scan->r, scan->unit, packing_i_paper_slack(paper, scan->r, r));
  body.index = index;
  return body;
}

/* Whether all neighbours are looked at for each P_j: where they are few, or P_i is not so large that
 * most of them are far from any one. */
static int is_few(const packing_i_paper_scan *scan)
{
  return scan->near.count <= PACKING_I_PAPER_FEW || scan->r_i <= 4 * scan->r;
}

static size_t particle_of_body(const packing_i_paper_scan *scan, size_t entry)
{
  return scan->body[entry].index;
}

static size_t particle_near(const packing_i_paper_scan *scan, size_t entry)
{
  return scan->near.at[entry].index;
}

/* Whether one of the first `count` bodies takes all places that this one would. */
static int is_hidden(const packing_i_ring_body *bodies, size_t count,
                     const packing_i_ring_body *body)
{
  for (size_t k = 0; k < count; k++)
    if (packing_i_ring_hides(&bodies[k], body))
      return 1;
  return 0;
}

/* All neighbours as bodies, those first that take most of the places; without those that are
 * hidden, some two thirds. */
static void fill_bodies(packing_i_paper *paper)
{
  packing_i_paper_scan *scan = &paper->scan;
  const size_t count = scan->near.count;
  scan->bodies = 0;
  if (count == 0) /* there may be no arrays yet */
    return;
  packing_i_ring_body *unsorted = scan->body + scan->capacity;
  for (size_t l = 0; l < count; l++) {
    const packing_i_index_image *image = &scan->near.at[l];
    unsorted[l] = body_of(paper, image->p, image->r, image->index);
    scan->rank[l] = (packing_i_rank){unsorted[l].cosine, l};
  }
  packing_i_paper_sort(scan->rank, count);
  for (size_t l = 0; l < count; l++) {
    const packing_i_ring_body *body = &unsorted[scan->rank[l].index];
    if (!is_hidden(scan->body, scan->bodies, body))
      scan->body[scan->bodies++] = *body;
  }
  paper->work += count * scan->bodies / 4;
}

/* Whether no place on the ring of body j is free of the bodies at hand. */
static int is_ring_covered(packing_i_paper *paper, size_t j, int flat)
{
  packing_i_paper_scan *scan = &paper->scan;
  packing_i_ring ring = packing_i_ring_flat();
  size_t bounding;
  if (!flat && !packing_i_ring_of(&scan->body[j], &ring))
    return 1;
  if (!packing_i_ring_bounds(&ring, scan->body, scan->bodies, flat ? SIZE_MAX : j,
                             scan->bound, &bounding))
    return 1;
  paper->work += scan->bodies + 6 * bounding;
  return bounding > 0 && packing_i_ring_ends(scan->body, scan->bound, bounding, 0,
                                             bounding, scan->end) == 0;
}

packing_status packing_i_paper_rings_closed(packing_placer *placer, int *closed)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const int flat = placer->particles->dim == 2;
  *closed = 0;
  if (scan->near.count > PACKING_I_PAPER_FEW)
    scan->near.count = PACKING_I_PAPER_FEW;
  PACKING_I_TRY(packing_i_paper_rows(placer, scan->near.count));
  fill_bodies(paper);
  const size_t rings = flat && scan->bodies > 0 ? 1 : scan->bodies;
  size_t j = 0;
  while (j < rings && is_ring_covered(paper, j, flat))
    j++;
  *closed = rings > 0 && j == rings;
  return PACKING_OK;
}

packing_status packing_i_paper_rings_begin(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const size_t count = scan->near.count;
  PACKING_I_TRY(packing_i_paper_rows(placer, count));
  scan->outers = count;
  if (is_few(scan)) {
    fill_bodies(paper);
    scan->outers = scan->bodies;
    packing_i_paper_order(paper, scan->outer, scan->outers, particle_of_body);
  } else {
    packing_i_paper_order(paper, scan->outer, count, particle_near);
  }
  return PACKING_OK;
}

/* The bodies that can take places beside neighbour `entry`; its place among them. */
static packing_status bodies_beside(packing_placer *placer, size_t entry, size_t *j)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const packing_i_index_image *p_j = &scan->near.at[entry];
  const packing_vec3 centre = packing_i_add(scan->centre, p_j->p);
  const packing_vec3 base =
      packing_i_sub(centre, scan->centre); /* p_j but for rounding */
  const double reach = p_j->r + 2 * scan->r;
  PACKING_I_TRY(packing_i_index_near(&paper->index, centre, reach, &scan->local));
  const size_t count = scan->local.count;
  PACKING_I_TRY(packing_i_paper_rows(placer, count));
  scan->bodies = 0;
  *j = 0;
  for (size_t l = 0; l < count; l++) {
    const packing_i_index_image *image = &scan->local.at[l];
    const packing_vec3 p = packing_i_add(base, image->p);
    const int is_j = packing_i_dot(image->p, image->p) < p_j->r * p_j->r;
    const int is_i = packing_i_dot(p, p) < scan->r_i * scan->r_i;
    if (is_j)
      *j = scan->bodies;
    if (!is_i)
      scan->body[scan->bodies++] = body_of(paper, p, image->r, image->index);
  }
  paper->work += 16 * (count + 8);
  return PACKING_OK;
}

/* Whether a place holds as it will be stored: contacts, no overlaps, inside. */
static int is_place(packing_placer *placer, packing_vec3 q, size_t j, size_t k,
                    packing_vec3 *centre)
{
  packing_i_paper *paper = placer->method;
  const packing_i_paper_scan *scan = &paper->scan;
  const packing_vec3 c = packing_i_add(scan->centre, packing_i_scale(q, scan->unit));
  const packing_vec3 s = packing_i_sub(c, scan->centre);
  const double slack = packing_i_paper_slack(paper, scan->r, scan->r_i);
  if (!(fabs(packing_i_norm(s) - scan->unit) <= slack))
    return 0;
  for (size_t l = 0; l < scan->bodies; l++) {
    const packing_i_ring_body *body = &scan->body[l];
    const packing_vec3 apart = packing_i_sub(packing_i_scale(s, 1 / scan->unit), body->p);
    const double gap = packing_i_norm(apart) - body->t, most = body->slack / body->t;
    if (!(gap >= -most) || ((l == j || l == k) && !(gap <= most)))
      return 0;
  }
  packing_body mobile = packing_body_sphere(c, scan->r);
  *centre = c;
  if (paper->zones == 1 && scan->room >= scan->r_i + 2 * scan->r)
    return 1;
  return packing_i_paper_inside(placer, &mobile, scan->zone);
}

/* Of several ends the one to be tried now. */
static size_t choose_end(packing_i_paper *paper, const packing_i_ring_end *ends,
                         size_t count)
{
  const packing_i_paper_scan *scan = &paper->scan;
  if (paper->select_neighbours == PACKING_FRONT_RANDOM)
    return count < 2 ? 0 : packing_i_stream_below(&paper->choice, count);
  const int lifo = paper->select_neighbours == PACKING_FRONT_LIFO;
  size_t best = 0;
  for (size_t k = 1; k < count; k++) {
    const size_t one = scan->body[scan->bound[ends[k].bound].body].index;
    const size_t other = scan->body[scan->bound[ends[best].bound].body].index;
    if (lifo ? one > other : one < other)
      best = k;
  }
  return best;
}

/* The first of the free ends that is a place; 0: none. */
static int take_end(packing_placer *placer, const packing_i_ring *ring, size_t j,
                    size_t count, packing_vec3 *centre)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const int flat = placer->particles->dim == 2;
  while (count > 0) {
    const size_t at = choose_end(paper, scan->end, count);
    packing_i_ring_end *end = &scan->end[at];
    unsigned side = end->sides;
    if (side == 3)
      side = 1 + (unsigned)packing_i_stream_below(&paper->choice, 2);
    const packing_i_ring_bound *bound = &scan->bound[end->bound];
    const packing_i_ring_body *k = &scan->body[bound->body], *other = &scan->body[j];
    packing_vec3 q = packing_i_ring_at(ring, bound, side);
    q = flat ? packing_i_ring_polish(q, ring->n, 0, k->p, k->a)
             : packing_i_ring_polish(q, other->p, other->a, k->p, k->a);
    placer->tally.attempts++;
    if (is_place(placer, q, flat ? bound->body : j, bound->body, centre))
      return 1;
    end->sides &= ~side;
    if (end->sides == 0)
      *end = scan->end[--count];
  }
  return 0;
}

/* A place that touches P_i and P_j, and in space a third; 0: none. */
static int take_ring(packing_placer *placer, size_t j, packing_vec3 *centre)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const int flat = placer->particles->dim == 2;
  packing_i_ring ring = packing_i_ring_flat();
  size_t bounding, from = 0;
  paper->work += scan->bodies;
  if (!flat && !packing_i_ring_of(&scan->body[j], &ring))
    return 0;
  if (!packing_i_ring_bounds(&ring, scan->body, scan->bodies, flat ? SIZE_MAX : j,
                             scan->bound, &bounding))
    return 0;
  size_t upto = bounding;
  if (flat) {
    while (from < bounding && scan->bound[from].body != j)
      from++;
    upto = from < bounding ? from + 1 : from;
  }
  paper->work += 6 * (upto - from);
  const size_t ends =
      packing_i_ring_ends(scan->body, scan->bound, bounding, from, upto, scan->end);
  return take_end(placer, &ring, j, ends, centre);
}

packing_status packing_i_paper_rings(packing_placer *placer,
                                     packing_i_paper_answer *answer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  *answer = PACKING_I_PAPER_NOWHERE;
  if (scan->next_outer == scan->outers)
    return PACKING_OK;
  if (!scan->picked)
    packing_i_paper_pick(paper, scan->outer, scan->next_outer, scan->outers);
  scan->picked = 1;
  size_t j = scan->outer[scan->next_outer];
  if (!is_few(scan))
    PACKING_I_TRY(bodies_beside(placer, j, &j));
  packing_vec3 centre;
  *answer = PACKING_I_PAPER_GOING;
  if (take_ring(placer, j, &centre)) {
    packing_i_paper_put(placer, centre, scan->zone);
    *answer = PACKING_I_PAPER_PLACED;
    return PACKING_OK;
  }
  if (is_few(scan))
    scan->body[j].done = 1;
  scan->next_outer++;
  scan->picked = 0;
  return PACKING_OK;
}
