/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An outward front that has run out before the container is full: in a narrow container a few
 * particles may stand so that nothing touches three of them and lies inside, and an order of
 * selection may lead into a corner. The paper proves that its loop ends, and takes it that the
 * container is full by then. Here the front begins again
 *
 *   with a first group (section 3.2), as long as there is a point from which walls and particles are
 *   9/4 of the largest radius away: four equal spheres need 1 + sqrt(3/2), however they are turned;
 *   then, if there is room for the largest particle and nothing nearer to its centre than two of the
 *   largest diameters, at the walls, as where the first group had no room.
 *
 * The container's bounds are cut in halves down to a sixteenth of that; cells too near to walls or
 * particles are passed over as a whole. Particles only come, so each search goes through the
 * container once, however many groups are placed. Memory: a stack of cells. Cost: about a look into
 * the index a particle, once. */
#include "front_paper.h"

/* What a cell must leave, in the largest radii: to walls and to surfaces of particles. */
typedef struct need {
  double wall, particle;
} need;

static need need_of(const packing_i_paper *paper)
{
  const double r = packing_i_source_max_r(paper->front.source);
  if (paper->again == PACKING_I_PAPER_AGAIN_GROUPS)
    return (need){2.25 * r, 2.25 * r};
  return (need){r, 4 * r};
}

static double distance_of(const packing_placer *placer, packing_vec3 p)
{
  return fmin(packing_domain_signed_distance(placer->domain, &p, NULL),
              packing_i_paper_below_top(placer->domain, p));
}

/* Whether some of a cell may have the room needed. */
static int may_have(const packing_placer *placer, const packing_i_paper_cell *cell,
                    need most)
{
  const packing_i_paper *paper = placer->method;
  const double reach = packing_i_paper_cell_reach(cell, placer->particles->dim);
  if (!packing_i_paper_cell_counts(placer, cell) ||
      distance_of(placer, cell->centre) + reach < most.wall)
    return 0;
  return most.particle <= reach ||
         packing_i_index_free(&paper->index, cell->centre, most.particle - reach);
}

/* Whether its centre has. */
static int has(const packing_placer *placer, const packing_i_paper_cell *cell, need most)
{
  const packing_i_paper *paper = placer->method;
  const packing_i_paper_cell point = {cell->centre, 0};
  return packing_i_paper_cell_counts(placer, &point) &&
         distance_of(placer, cell->centre) >= most.wall &&
         packing_i_index_free(&paper->index, cell->centre, most.particle);
}

/* The next search, or none. */
static packing_i_paper_search next_search(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  if (paper->again == PACKING_I_PAPER_AGAIN_LATER)
    paper->again = PACKING_I_PAPER_AGAIN_GROUPS;
  else if (paper->again == PACKING_I_PAPER_AGAIN_GROUPS && isfinite(paper->front.room))
    paper->again = PACKING_I_PAPER_AGAIN_WALLS;
  else
    paper->again = PACKING_I_PAPER_AGAIN_NEVER;
  if (paper->again == PACKING_I_PAPER_AGAIN_NEVER)
    return PACKING_I_PAPER_FULL;
  packing_i_paper_walk_begin(placer);
  return PACKING_I_PAPER_SEARCHING;
}

packing_status packing_i_paper_look(packing_placer *placer,
                                    packing_i_paper_search *search)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_walk *walk = &paper->walk;
  const need most = need_of(paper);
  *search = PACKING_I_PAPER_SEARCHING;
  if (paper->again == PACKING_I_PAPER_AGAIN_LATER || walk->cells == 0) {
    *search = next_search(placer);
    return PACKING_OK;
  }
  const packing_i_paper_cell *cell = &walk->cell[walk->cells - 1];
  paper->work += 60;
  if (!may_have(placer, cell, most)) {
    walk->cells--;
    return PACKING_OK;
  }
  if (has(placer, cell, most)) {
    if (paper->again == PACKING_I_PAPER_AGAIN_WALLS) {
      *search = PACKING_I_PAPER_AT_WALLS;
      return PACKING_OK;
    }
    int room;
    PACKING_I_TRY(packing_i_paper_start_at(placer, cell->centre, &room));
    if (room) /* there may be more in this cell when the front has run out again */
      return PACKING_OK;
  }
  if (cell->half > most.particle / 16)
    packing_i_paper_divide(walk, placer->particles->dim);
  else
    walk->cells--;
  return PACKING_OK;
}
