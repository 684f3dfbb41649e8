/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places beside a front particle that has not enough neighbours to give one: alone, any direction;
 * with a single neighbour or wall, anywhere in contact with both. The paper does not say how a front
 * goes on from a lone particle. Only the first particles of a run need it, and those that stood in
 * the store far from others. */
#include "front_paper.h"

enum { TRIES = 64, SETTLE_STEPS = 40 };

static double gap_of(double r, const packing_body *body, packing_vec3 x,
                     packing_vec3 *normal)
{
  if (body->domain != NULL) {
    const packing_body mobile = packing_body_sphere(x, r);
    return packing_body_wall_gap(&mobile, body->domain, body->wall, normal);
  }
  const packing_vec3 apart = packing_i_sub(x, body->centre);
  const double length = packing_i_norm(apart);
  *normal = length > 0 ? packing_i_scale(apart, 1 / length) : packing_i_vec(1, 0, 0);
  return length - (r + body->r);
}

/* The shortest step that closes all gaps as they look from x, along normals made orthogonal one
 * after the other; the largest gap in size, infinite where there is no such step. */
static double step_of(double r, const packing_body *body, size_t bodies, packing_vec3 x,
                      packing_vec3 *step)
{
  packing_vec3 unit[3];
  double along[3], worst = 0;
  *step = packing_i_vec(0, 0, 0);
  for (size_t m = 0; m < bodies; m++) {
    packing_vec3 normal;
    const double gap = gap_of(r, &body[m], x, &normal);
    packing_vec3 rest = normal;
    double left = -gap;
    for (size_t l = 0; l < m; l++) {
      const double part = packing_i_dot(normal, unit[l]);
      rest = packing_i_sub(rest, packing_i_scale(unit[l], part));
      left -= part * along[l];
    }
    const double length = packing_i_norm(rest);
    if (!(length > 1e-4) || !isfinite(gap))
      return HUGE_VAL;
    unit[m] = packing_i_scale(rest, 1 / length);
    along[m] = left / length;
    *step = packing_i_add(*step, packing_i_scale(unit[m], along[m]));
    worst = fabs(gap) > worst ? fabs(gap) : worst;
  }
  return worst;
}

int packing_i_paper_settle(const packing_i_paper *paper, double r,
                           const packing_body *body, size_t bodies, packing_vec3 *x)
{
  const double enough = packing_i_paper_slack(paper, r, r);
  packing_vec3 at = *x, step, best = at;
  double least = HUGE_VAL;
  for (int k = 0; k < SETTLE_STEPS; k++) {
    const double worst = step_of(r, body, bodies, at, &step);
    if (worst == HUGE_VAL)
      break;
    if (worst < least) {
      least = worst;
      best = at;
    } else if (least <= enough) {
      break; /* rounding */
    }
    if (worst == 0)
      break;
    at = packing_i_add(at, step);
  }
  *x = best;
  return least <= enough;
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
      packing_i_paper_direction(&paper->choice, placer->particles->dim);
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
