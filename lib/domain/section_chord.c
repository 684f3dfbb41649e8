/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much of a line lies in a container: an interval for each wall, all of them cut to one
 * another; a tube's hole is taken off. Closed forms, quadratics at most. */
#include "domain_kinds.h"

typedef struct interval {
  double from, to;
} interval;

static interval common(interval a, interval b)
{
  const interval c = {fmax(a.from, b.from), fmin(a.to, b.to)};
  return c;
}

static double length(interval a)
{
  return a.to > a.from ? a.to - a.from : 0;
}

static interval everything(void)
{
  const interval all = {-HUGE_VAL, HUGE_VAL};
  return all;
}

static interval nothing(void)
{
  const interval none = {HUGE_VAL, -HUGE_VAL};
  return none;
}

/* Where lo <= x + t d <= hi. */
static interval between(double x, double d, double lo, double hi)
{
  if (d == 0)
    return x >= lo && x <= hi ? everything() : nothing();
  const double a = (lo - x) / d, b = (hi - x) / d;
  return a < b ? (interval){a, b} : (interval){b, a};
}

/* Where a t^2 + 2 b t + c <= 0 with a > 0. */
static interval inside_quadratic(double a, double b, double c)
{
  const double d = b * b - a * c;
  if (!(d > 0))
    return nothing();
  const double q = -(b + copysign(sqrt(d), b));
  const double x = q / a, y = q != 0 ? c / q : 0;
  return x < y ? (interval){x, y} : (interval){y, x};
}

/* The line seen from an axis: squared distance from it r2 + 2 rs t + ss t^2, height
 * h + k t. */
typedef struct line {
  double r2, rs, ss, h, k;
} line;

/* Where rho <= radius + slope * height, a cone of one sheet. */
static interval inside_cone(const line *l, double radius, double slope)
{
  const double m = radius + slope * l->h,
               n = slope * l->k; /* the radius is m + n t >= 0 */
  const double a = l->ss - n * n, b = l->rs - m * n, c = l->r2 - m * m;
  const interval sheet = n > 0 ? (interval){-m / n, HUGE_VAL}
                               : (n < 0 ? (interval){-HUGE_VAL, -m / n} : everything());
  if (a > 0)
    return common(inside_quadratic(a, b, c), sheet);
  if (a == 0 && b == 0)
    return c <= 0 ? sheet : nothing();
  if (a == 0)
    return common(b > 0 ? (interval){-HUGE_VAL, -0.5 * c / b}
                        : (interval){-0.5 * c / b, HUGE_VAL},
                  sheet);
  /* Steeper than the wall: outside between the roots, one side of which is the sheet. */
  const interval gap = inside_quadratic(-a, -b, -c);
  if (!(gap.from < gap.to))
    return sheet;
  return n > 0 ? common((interval){gap.to, HUGE_VAL}, sheet)
               : common((interval){-HUGE_VAL, gap.from}, sheet);
}

static interval in_wall(const packing_i_wall *w, const line *l)
{
  if (w->a == 0)
    return between(l->h * w->b, l->k * w->b, -w->c, HUGE_VAL);
  return inside_cone(l, w->c / -w->a, w->b / -w->a);
}

static double in_revolution(const packing_i_revolution *p, const packing_vec3 *start,
                            const packing_vec3 *d, interval all)
{
  const packing_vec3 s = packing_i_sub(*start, p->base);
  line l = {0, 0, 0, packing_i_component(s, p->axis), packing_i_component(*d, p->axis)};
  interval hole = nothing();
  for (int i = 1; i < 3; i++) {
    const double x = packing_i_component(s, (p->axis + i) % 3);
    const double y = packing_i_component(*d, (p->axis + i) % 3);
    l.r2 += x * x;
    l.rs += x * y;
    l.ss += y * y;
  }
  all = common(all, between(l.h, l.k, p->knot[0], p->knot[p->knots - 1]));
  for (int i = 0; i < p->walls; i++)
    if (p->wall[i].a > 0)
      hole = in_wall(&p->wall[i], &l);
    else
      all = common(all, in_wall(&p->wall[i], &l));
  return length(all) - length(common(all, hole));
}

static double in_box(const packing_bounds *b, const packing_vec3 *start,
                     const packing_vec3 *d, interval all)
{
  for (int k = 0; k < 3; k++)
    all = common(all,
                 between(packing_i_component(*start, k), packing_i_component(*d, k),
                         packing_i_component(b->lo, k), packing_i_component(b->hi, k)));
  return length(all);
}

double packing_i_chord(const packing_i_domain_body *body, const packing_vec3 *start,
                       const packing_vec3 *direction, double least, double most)
{
  const interval all = {least, most};
  if (body->ops->signed_distance == packing_i_revolution_signed_distance)
    return in_revolution(&body->as.revolution, start, direction, all);
  if (body->ops->signed_distance == packing_i_planar_signed_distance)
    return in_box(&body->bounds, start, direction, all);
  const packing_vec3 s = packing_i_sub(*start, body->as.round.centre);
  const double radius = body->as.round.outer, distance = packing_i_norm(s);
  return length(common(all, inside_quadratic(1, packing_i_dot(s, *direction),
                                             (distance - radius) * (distance + radius))));
}
