/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The start of an inward front (section 3.2): one particle in contact with as many walls as
 * possible, then, while the whole boundary is being covered, further ones wherever the front did not
 * get to, as on the second wall of a tube. To find these, the bounds are cut in halves down to cells
 * of 0.7 mean radii that the boundary runs through; in each a particle is put against the wall when
 * it has room.
 *
 * Memory: a stack of cells, whatever the container's size. Cost: a few distances for each square of
 * a mean radius of the boundary. */
#include "front_paper.h"

/* Half the edge of the smallest cells, in mean radii; of the plane's and space's diagonals. */
static const double finest = 0.35, diagonal_2d = 1.4142135623731,
                    diagonal_3d = 1.7320508075689;

static double component_of(packing_vec3 v, int axis)
{
  return packing_i_component(v, axis);
}

void packing_i_paper_walk_begin(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  packing_bounds b;
  packing_domain_bounds(placer->domain, &b);
  const packing_vec3 width = packing_i_sub(b.hi, b.lo);
  const double half = 0.5 * fmax(width.x, fmax(width.y, width.z));
  packing_i_paper_cell *root = &paper->walk.cell[0];
  root->half = half;
  root->centre = packing_i_add(b.lo, packing_i_vec(half, half, half));
  if (placer->particles->dim == 2)
    root->centre.z = 0;
  paper->walk.cells = 1;
}

int packing_i_paper_cell_counts(const packing_placer *placer,
                                const packing_i_paper_cell *cell)
{
  packing_bounds b;
  packing_domain_bounds(placer->domain, &b);
  for (int axis = 0; axis < placer->particles->dim; axis++) {
    const double x = component_of(cell->centre, axis);
    if (x - cell->half > component_of(b.hi, axis) ||
        x + cell->half < component_of(b.lo, axis))
      return 0;
  }
  return 1;
}

double packing_i_paper_cell_reach(const packing_i_paper_cell *cell, int dim)
{
  return cell->half * (dim == 2 ? diagonal_2d : diagonal_3d);
}

/* Whether the boundary can run through a cell. */
static int has_boundary(const packing_placer *placer, const packing_i_paper_cell *cell)
{
  if (!packing_i_paper_cell_counts(placer, cell))
    return 0;
  const double reach = packing_i_paper_cell_reach(cell, placer->particles->dim);
  const double distance =
      packing_domain_signed_distance(placer->domain, &cell->centre, NULL);
  return distance <= reach && distance >= -reach;
}

void packing_i_paper_divide(packing_i_paper_walk *walk, int dim)
{
  const packing_i_paper_cell cell = walk->cell[--walk->cells];
  const double half = 0.5 * cell.half;
  for (int part = (dim == 2 ? 4 : 8) - 1; part >= 0; part--) {
    packing_i_paper_cell *child = &walk->cell[walk->cells++];
    child->half = half;
    child->centre.x = cell.centre.x + (part & 1 ? half : -half);
    child->centre.y = cell.centre.y + (part & 2 ? half : -half);
    child->centre.z = dim == 2 ? 0 : cell.centre.z + (part & 4 ? half : -half);
  }
}

/* A shape's own way to the wall: as far as its clearance, along the normal. */
static int settle_shape(const packing_placer *placer, packing_body *mobile)
{
  const double slack = packing_i_paper_slack(placer->method, mobile->r, mobile->r);
  for (int k = 0; k < 60; k++) {
    packing_vec3 normal;
    const double gap = packing_body_clearance(mobile, placer->domain, &normal);
    if (fabs(gap) <= slack)
      return 1;
    mobile->centre = packing_i_sub(mobile->centre, packing_i_scale(normal, gap));
  }
  return 0;
}

/* Where the pending particle stands against the wall in this cell; 0: nowhere. */
static int place_in(const packing_placer *placer, const packing_i_paper_cell *cell,
                    size_t zone, packing_vec3 *x)
{
  const packing_i_paper *paper = placer->method;
  const packing_body wall = packing_i_front_wall_of(placer->domain, -1);
  packing_body mobile = packing_i_paper_mobile(paper, zone, cell->centre);
  const int settled =
      paper->shape != NULL
          ? settle_shape(placer, &mobile)
          : packing_i_paper_settle(paper, mobile.r, &wall, 1, &mobile.centre);
  if (!settled)
    return 0;
  *x = mobile.centre;
  if (!paper->walk.seeded && paper->shape == NULL)
    packing_i_front_move_to_corner(
        placer->domain, packing_i_paper_slack(paper, mobile.r, mobile.r), mobile.r, x);
  mobile.centre = *x;
  return packing_i_paper_inside(placer, &mobile, zone);
}

/* Puts a particle against the wall in a cell, where it has room. */
static packing_status seed(packing_placer *placer, const packing_i_paper_cell *cell)
{
  packing_i_paper *paper = placer->method;
  const size_t zone = packing_i_source_zone(paper->front.source, &cell->centre);
  const packing_i_paper_pending *pending = packing_i_paper_next(placer, zone);
  packing_vec3 x;
  int is_free = 0;
  if (pending == NULL || packing_i_paper_meets_itself(placer, pending->r))
    return PACKING_OK;
  PACKING_I_TRY(packing_i_paper_reserve(placer, 1, pending->r));
  if (!place_in(placer, cell, zone, &x))
    return PACKING_OK;
  const packing_body mobile = packing_i_paper_mobile(paper, zone, x);
  placer->tally.attempts++;
  PACKING_I_TRY(packing_i_paper_free(placer, &mobile, &paper->scan.local, &is_free));
  if (is_free) {
    packing_i_paper_put(placer, x, zone);
    paper->walk.seeded = 1;
  }
  return PACKING_OK;
}

packing_status packing_i_paper_walk_on(packing_placer *placer, int *over)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_walk *walk = &paper->walk;
  *over = walk->cells == 0;
  if (*over)
    return PACKING_OK;
  const packing_i_paper_cell cell = walk->cell[walk->cells - 1];
  const double mean = packing_i_source_moment(paper->front.source, 1);
  paper->work += 10;
  if (has_boundary(placer, &cell)) {
    if (cell.half > finest * mean) {
      packing_i_paper_divide(walk, placer->particles->dim);
      return PACKING_OK;
    }
    paper->work += 60;
    PACKING_I_TRY(seed(placer, &cell));
  }
  walk->cells--;
  return PACKING_OK;
}
