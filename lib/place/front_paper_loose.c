/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places beside a front particle that has not enough neighbours to give one: alone, any direction;
 * with a single neighbour or wall, anywhere in contact with both. The paper does not say how a front
 * goes on from a lone particle. Only the first particles of a run need it, and those that stood in
 * the store far from others. */
#include "front_paper.h"

enum { TRIES = 64 };

int packing_i_paper_settle(const packing_i_paper *paper, double r,
                           const packing_body *body, size_t bodies, packing_vec3 *x)
{
  return packing_i_front_settle(packing_i_paper_slack(paper, r, r), r, body, bodies, x);
}

/* Beside P_i alone, from a direction. */
static int approach(const packing_body *mobile, const packing_body *fixed,
                    packing_vec3 from, packing_vec3 *x)
{
  packing_body far = *mobile;
  const double reach = mobile->r + fixed->r;
  far.centre = packing_i_add(fixed->centre, packing_i_scale(from, 2 * reach));
  const packing_vec3 back = packing_i_scale(from, -1);
  const double way = packing_body_distance(&far, fixed, &back);
  *x = packing_i_add(far.centre, packing_i_scale(back, way));
  return isfinite(way);
}

/* A random place in contact with P_i and what is beside it. */
static int guess(packing_placer *placer, packing_vec3 *x)
{
  packing_i_paper *paper = placer->method;
  const packing_i_paper_scan *scan = &paper->scan;
  const packing_vec3 from =
      packing_i_front_direction(&paper->choice, placer->particles->dim);
  packing_body touched[2] = {packing_i_paper_body(placer, scan->i, scan->centre)};
  const packing_body mobile = packing_i_paper_mobile(paper, scan->zone, scan->centre);
  if (paper->shape != NULL)
    return approach(&mobile, &touched[0], from, x);
  *x = packing_i_add(scan->centre, packing_i_scale(from, scan->unit));
  if (scan->walls > 0 && paper->phase == PACKING_I_PAPER_WALLS) {
    touched[1] = packing_body_sphere(scan->centre, scan->r);
    touched[1].domain = placer->domain;
    touched[1].wall = scan->wall[0].wall;
  } else if (scan->near.count > 0) {
    const packing_i_index_image *image = &scan->near.at[0];
    touched[1] =
        packing_i_paper_body(placer, image->index, packing_i_add(scan->centre, image->p));
  } else {
    return 1;
  }
  return packing_i_paper_settle(paper, scan->r, touched, 2, x);
}

packing_status packing_i_paper_loose(packing_placer *placer,
                                     packing_i_paper_answer *answer)
{
  packing_i_paper *paper = placer->method;
  packing_i_paper_scan *scan = &paper->scan;
  const size_t dim = (size_t)placer->particles->dim;
  const size_t walls = paper->phase == PACKING_I_PAPER_WALLS ? scan->walls : 0;
  if (paper->phase == PACKING_I_PAPER_WALLS && walls == 0)
    return PACKING_OK; /* away from the boundary */
  if (scan->near.count + walls >= dim - 1 && placer->tally.placed > dim)
    return PACKING_OK;
  const packing_i_stream before = paper->choice;
  for (int k = 0; k < TRIES; k++) {
    packing_vec3 x;
    int is_free = 0;
    if (!guess(placer, &x))
      continue;
    const packing_body mobile = packing_i_paper_mobile(paper, scan->zone, x);
    placer->tally.attempts++;
    paper->work += 200;
    if (!packing_i_paper_inside(placer, &mobile, scan->zone))
      continue;
    const packing_status status =
        packing_i_paper_free(placer, &mobile, &scan->local, &is_free);
    if (status != PACKING_OK) {
      paper->choice = before;
      return status;
    }
    if (is_free) {
      packing_i_paper_put(placer, x, scan->zone);
      *answer = PACKING_I_PAPER_PLACED;
      return PACKING_OK;
    }
  }
  return PACKING_OK;
}
