/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a front begins at the walls (section 3.2): in contact with as many of them as possible.
 *
 * A place in contact with given bodies is found from a point nearby by the shortest steps that
 * close all gaps as they look from there: Newton's method, of second order on curved walls. */
#include "front_internal.h"
#include "shape/shape_internal.h"

enum { SETTLE_STEPS = 40 };

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

int packing_i_front_settle(double slack, double r, const packing_body *body,
                           size_t bodies, packing_vec3 *x)
{
  packing_vec3 at = *x, step, best = at;
  double least = HUGE_VAL;
  for (int k = 0; k < SETTLE_STEPS; k++) {
    const double worst = step_of(r, body, bodies, at, &step);
    if (worst == HUGE_VAL)
      break;
    if (worst < least) {
      least = worst;
      best = at;
    } else if (least <= slack) {
      break; /* rounding */
    }
    if (worst == 0)
      break;
    at = packing_i_add(at, step);
  }
  *x = best;
  return least <= slack;
}

packing_body packing_i_front_wall_of(packing_domain *domain, int wall)
{
  packing_body body = packing_body_sphere(packing_i_vec(0, 0, 0), 1);
  body.domain = domain;
  body.wall = wall;
  return body;
}

/* Tries to touch the walls of a set (bits) from x; whether it lies inside then. */
static int touch_set(packing_domain *domain, double slack, double r,
                     const packing_i_near_wall *wall, int walls, unsigned set,
                     packing_vec3 *x)
{
  packing_body body[3];
  size_t bodies = 0;
  for (int w = 0; w < walls; w++)
    if (set >> w & 1U)
      body[bodies++] = packing_i_front_wall_of(domain, wall[w].wall);
  return packing_i_front_settle(slack, r, body, bodies, x) &&
         packing_i_domain_keeps_whole(domain, x, r - slack);
}

static int count_bits(unsigned set)
{
  int count = 0;
  for (; set != 0; set &= set - 1)
    count++;
  return count;
}

void packing_i_front_move_to_corner(packing_domain *domain, double slack, double r,
                                    packing_vec3 *x)
{
  packing_i_near_wall wall[PACKING_I_NEAR_WALLS];
  const int dim = packing_domain_dim(domain);
  const int walls = packing_i_domain_near_walls(domain, x, HUGE_VAL, wall);
  int most = 1;
  double nearest = HUGE_VAL;
  packing_vec3 best = *x;
  for (unsigned set = 1; set < 1U << walls; set++) {
    const int count = count_bits(set);
    packing_vec3 at = *x;
    if (count < 2 || count > dim || count < most ||
        !touch_set(domain, slack, r, wall, walls, set, &at))
      continue;
    const double way = packing_i_norm(packing_i_sub(at, *x));
    if (count > most || way < nearest) {
      most = count;
      nearest = way;
      best = at;
    }
  }
  *x = best;
}
