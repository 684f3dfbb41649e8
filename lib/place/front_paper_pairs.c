/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps 2.2 and 2.2.1 by a contact method, for any shape: all pairs of neighbours of P_i one after
 * the other, in the order asked. While the boundary is being covered (section 3.2, inward, step 3)
 * the walls near P_i are bodies like others, the oldest of all, and P_j is one of them. In the plane
 * there is no P_k.
 *
 * Cost: a call of the method for each pair whose bodies are near enough to be touched by one
 * particle; a look at the neighbours for each place. */
#include "front_paper.h"
#include <string.h>

static size_t particle_near(const packing_i_paper_scan *scan, size_t entry)
{
  return scan->near.at[entry].index;
}

/* Entries are neighbours, and from near.count on walls. */
static int is_wall(const packing_i_paper_scan *scan, size_t entry)
{
  return entry >= scan->near.count;
}

static void find_walls(const packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  scan->walls = 0;
  if (paper->phase == PACKING_I_PAPER_WALLS)
    scan->walls = (size_t)packing_i_domain_near_walls(
        placer->domain, &scan->centre, scan->r_i + 2 * scan->r, scan->wall);
}

packing_status packing_i_paper_pairs_begin(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  find_walls(placer);
  PACKING_I_TRY(packing_i_paper_rows(placer, scan->near.count + scan->walls));
  if (paper->phase == PACKING_I_PAPER_INSIDE) {
    scan->outers = scan->near.count;
    packing_i_paper_order(paper, scan->outer, scan->outers, particle_near);
    return PACKING_OK;
  }
  const int lifo = paper->select_neighbours == PACKING_FRONT_LIFO;
  scan->outers = scan->walls;
  for (size_t w = 0; w < scan->walls; w++)
    scan->outer[w] = (uint32_t)(scan->near.count + (lifo ? scan->walls - 1 - w : w));
  return PACKING_OK;
}

/* What can stand beside outer[next_outer]: the outer ones after it and, while walls are covered,
 * all neighbours. */
static void list_inner(packing_i_paper *paper)
{
  packing_i_paper_scan *scan = &paper->scan;
  const size_t rest = scan->outers - scan->next_outer - 1;
  const uint32_t *after = scan->outer + scan->next_outer + 1;
  size_t particles = 0;
  if (paper->phase == PACKING_I_PAPER_WALLS) {
    particles = scan->near.count;
    const int lifo = paper->select_neighbours == PACKING_FRONT_LIFO;
    packing_i_paper_order(paper, scan->inner + (lifo ? 0 : rest), particles,
                          particle_near);
    memcpy(scan->inner + (lifo ? particles : 0), after, rest * sizeof *after);
  } else {
    memcpy(scan->inner, after, rest * sizeof *after);
  }
  scan->inners = rest + particles;
}

static packing_body body_of(const packing_placer *placer, size_t entry)
{
  const packing_i_paper *paper = placer->method;
  const packing_i_paper_scan *scan = &paper->scan;
  if (is_wall(scan, entry)) {
    packing_body wall = packing_body_sphere(scan->centre, scan->r);
    wall.domain = placer->domain;
    wall.wall = scan->wall[entry - scan->near.count].wall;
    return wall;
  }
  const packing_i_index_image *image = &scan->near.at[entry];
  return packing_i_paper_body(placer, image->index,
                              packing_i_add(scan->centre, image->p));
}

/* Whether one particle can touch both: two neighbours that are too far apart cannot be. */
static int are_near(const packing_i_paper_scan *scan, size_t j, size_t k)
{
  if (is_wall(scan, j) || is_wall(scan, k))
    return 1;
  const packing_i_index_image *a = &scan->near.at[j], *b = &scan->near.at[k];
  const packing_vec3 apart = packing_i_sub(a->p, b->p);
  const double reach = a->r + b->r + 2 * scan->r;
  return packing_i_dot(apart, apart) <= reach * reach;
}

/* Spheres that a place near P_i overlaps are found here sooner than by the index. */
static int is_taken(const packing_i_paper *paper, packing_vec3 centre)
{
  const packing_i_paper_scan *scan = &paper->scan;
  const packing_vec3 s = packing_i_sub(centre, scan->centre);
  for (size_t l = 0; l < scan->near.count && paper->shape == NULL; l++) {
    const packing_i_index_image *image = &scan->near.at[l];
    const packing_vec3 apart = packing_i_sub(s, image->p);
    const double least =
        image->r + scan->r - packing_i_paper_slack(paper, image->r, scan->r);
    if (packing_i_dot(apart, apart) < least * least)
      return 1;
  }
  return 0;
}

static packing_status try_place(packing_placer *placer, packing_vec3 centre,
                                packing_i_paper_answer *answer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const packing_body mobile = packing_i_paper_mobile(paper, scan->zone, centre);
  placer->tally.attempts++;
  paper->work += 4 + scan->near.count / 4;
  if (is_taken(paper, centre) || !packing_i_paper_inside(placer, &mobile, scan->zone))
    return PACKING_OK;
  int is_free;
  paper->work += 60;
  PACKING_I_TRY(packing_i_paper_free(placer, &mobile, &scan->local, &is_free));
  if (!is_free)
    return PACKING_OK;
  packing_i_paper_put(placer, centre, scan->zone);
  *answer = PACKING_I_PAPER_PLACED;
  return PACKING_OK;
}

/* Function G of P_i, P_j and P_k: any of its places. */
static packing_status try_pair(packing_placer *placer, size_t j, size_t k,
                               packing_i_paper_answer *answer)
{
  packing_i_paper *paper = placer->method;
  const packing_i_paper_scan *scan = &paper->scan;
  const packing_contact_method *method =
      paper->phase == PACKING_I_PAPER_WALLS ? &paper->wall_contact : &paper->contact;
  if (j != k && method->exact && !are_near(scan, j, k))
    return PACKING_OK;
  packing_contact_task task;
  packing_contact_task_init(&task);
  task.dim = placer->particles->dim;
  task.mobile = packing_i_paper_mobile(paper, scan->zone, scan->centre);
  task.fixed[0] = packing_i_paper_body(placer, scan->i, scan->centre);
  task.fixed[1] = body_of(placer, j);
  if (task.dim == 3)
    task.fixed[2] = body_of(placer, k);
  packing_vec3 centre[2];
  const int count = packing_contact_place(method, &task, centre);
  paper->work += method->place == packing_contact_wrappers()->place ? 60 : 600;
  const size_t first = count == 2 ? (size_t)packing_i_stream_below(&paper->choice, 2) : 0;
  for (size_t n = 0; n < (size_t)count && *answer != PACKING_I_PAPER_PLACED; n++)
    PACKING_I_TRY(try_place(placer, centre[n ^ first], answer));
  return PACKING_OK;
}

static void next_outer(packing_i_paper_scan *scan)
{
  scan->next_outer++;
  scan->picked = 0;
}

/* Chooses P_j, and what can be P_k. */
static void pick_outer(packing_i_paper *paper, int flat)
{
  packing_i_paper_scan *scan = &paper->scan;
  packing_i_paper_pick(paper, scan->outer, scan->next_outer, scan->outers);
  scan->inners = 0;
  if (!flat)
    list_inner(paper);
  scan->next_inner = 0;
  scan->picked = 1;
  scan->picked_inner = 0;
}

packing_status packing_i_paper_pairs(packing_placer *placer,
                                     packing_i_paper_answer *answer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const int flat = placer->particles->dim == 2;
  *answer = PACKING_I_PAPER_NOWHERE;
  if (scan->next_outer == scan->outers)
    return PACKING_OK;
  *answer = PACKING_I_PAPER_GOING;
  if (!scan->picked)
    pick_outer(paper, flat);
  const size_t j = scan->outer[scan->next_outer];
  size_t k = j;
  if (!flat) {
    if (scan->next_inner == scan->inners) {
      next_outer(scan);
      return PACKING_OK;
    }
    if (!scan->picked_inner)
      packing_i_paper_pick(paper, scan->inner, scan->next_inner, scan->inners);
    scan->picked_inner = 1;
    k = scan->inner[scan->next_inner];
  }
  paper->work += 4;
  const packing_i_stream before = paper->choice;
  const packing_status status = try_pair(placer, j, k, answer);
  if (status != PACKING_OK) {
    paper->choice = before; /* the same draws when this is repeated */
    return status;
  }
  if (flat)
    next_outer(scan);
  scan->next_inner++;
  scan->picked_inner = 0;
  return PACKING_OK;
}
