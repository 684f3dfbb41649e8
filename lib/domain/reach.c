/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far a container reaches from a point, or from a line along an axis. Exact for boxes and
 * round containers, and for bodies of revolution from points or lines along their axis; else
 * the farthest corner of the bounds. Constant time. */
#include "domain_kinds.h"

/* Whether a cell grows along an axis with its radius. */
static int grows(const packing_i_domain_body *body, const packing_i_cell *cell, int k)
{
  return k < body->dim &&
         (body->dim == 2 || cell->kind == PACKING_I_CELL_BALL || k != cell->axis);
}

static double farthest_corner(const packing_i_domain_body *body,
                              const packing_i_cell *cell)
{
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    const double x = packing_i_component(cell->centre, k);
    const double far = fmax(fabs(packing_i_component(body->bounds.lo, k) - x),
                            fabs(packing_i_component(body->bounds.hi, k) - x));
    sum += grows(body, cell, k) ? far * far : 0;
  }
  return sqrt(sum);
}

static double farthest_of_round(const packing_i_domain_body *body,
                                const packing_i_cell *cell)
{
  packing_vec3 d = packing_i_sub(body->as.round.centre, cell->centre);
  for (int k = 0; k < 3; k++)
    if (!grows(body, cell, k))
      packing_i_set_component(&d, k, 0);
  return packing_i_norm(d) + body->as.round.outer;
}

/* The widest circle, or that which is farthest from the point. */
static double farthest_of_revolution(const packing_i_domain_body *body,
                                     const packing_i_cell *cell)
{
  const packing_i_revolution *p = &body->as.revolution;
  double rho, h, most = 0;
  packing_i_revolution_local(p, &cell->centre, &rho, &h, NULL);
  for (int i = 0; i < p->knots; i++) {
    const double across = rho + packing_i_revolution_outer(p, p->knot[i]);
    const double along = cell->kind == PACKING_I_CELL_BALL ? p->knot[i] - h : 0;
    most = fmax(most, sqrt(across * across + along * along));
  }
  return most;
}

double packing_i_domain_reach(const packing_domain *domain, const packing_i_cell *cell)
{
  const packing_i_domain_body *body = &domain->body;
  double period = HUGE_VAL;
  for (int k = 0; k < 3; k++)
    if (grows(body, cell, k))
      period = fmin(period, packing_i_component(body->period, k));
  if (isfinite(period))
    return 0.5 * period;
  if (body->ops->signed_distance == packing_i_round_signed_distance)
    return farthest_of_round(body, cell);
  if (body->ops->signed_distance == packing_i_revolution_signed_distance &&
      (cell->kind == PACKING_I_CELL_BALL || cell->axis == body->as.revolution.axis))
    return farthest_of_revolution(body, cell);
  return farthest_corner(body, cell);
}
