/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volume of a ball within a body of revolution. Where all that it can reach are upright walls, it is
 * what the ball shares with an endless cylinder, less what it shares with the hole (closed form:
 * ball_cylinder.c); else it comes from slices across the axis.
 *
 * A slice of the ball is a disc, a slice of the body a disc (tube: a ring) round the axis, so
 * the volume is the integral over the height of the area of a lens. The integrand bends where
 * the profile bends and where two discs begin to touch from outside or inside; the latter are
 * the heights at which the ball's great circle in the plane of the axis meets a face, that is a
 * chord of a circle. Between such heights the lens is either one of its two discs, whose area is
 * quadratic in the height, and Simpson's rule is exact; or a proper lens, analytic inside the
 * interval and with half-integer powers at its ends, for integrate.c.
 * Cost: at most 26 heights; most balls have two or three proper intervals. */
#include "domain_kinds.h"
#include <float.h>
#include <math.h>

enum { MOST_HEIGHTS = PACKING_I_KNOTS + 2 + 4 * PACKING_I_WALLS, DEEPEST = 12 };

/* Proper lenses are halved twice before the rules are asked: where a wall passes near the centre the
 * integrand changes fast at both ends, and the differences of the rules can be small by chance. */
static const packing_i_depths lens_depths = {2, DEEPEST};

/* What the integrand needs. Heights count from the ball's centre, so that it loses no digits where the
 * base is far. */
typedef struct cut {
  const packing_i_revolution *body;
  double (*radius)(const packing_i_revolution *p, double h); /* of the body's slice */
  double rho, h, r;                                          /* the ball */
} cut;

static double slice_of_ball(const cut *c, double h)
{
  const double s = (c->r - h) * (c->r + h);
  return s > 0 ? sqrt(s) : 0;
}

static double slice_of_body(const cut *c, double h)
{
  return c->radius(c->body, c->h + h);
}

static double lens_at(const void *arg, double h)
{
  const cut *c = arg;
  return packing_i_lens(2, slice_of_ball(c, h), slice_of_body(c, h), c->rho);
}

/* What the two discs of a height share. */
typedef enum share { NOTHING, DISC_OF_BALL, DISC_OF_BODY, LENS } share;

static share share_at(const cut *c, double h)
{
  const double ball = slice_of_ball(c, h), body = slice_of_body(c, h);
  if (c->rho >= ball + body)
    return NOTHING;
  if (c->rho > fabs(ball - body))
    return LENS;
  return ball < body ? DISC_OF_BALL : DISC_OF_BODY;
}

static double simpson(const cut *c, const double h[2], share s)
{
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    const double at = i == 1 ? 0.5 * (h[0] + h[1]) : h[i / 2];
    const double radius = s == DISC_OF_BALL ? slice_of_ball(c, at) : slice_of_body(c, at);
    sum += (i == 1 ? 4 : 1) * radius * radius;
  }
  return PACKING_I_PI * (h[1] - h[0]) / 6 * sum;
}

/* The integral over heights between which nothing bends. Three places must agree before it is
 * taken for one disc: discs may touch in passing in one of them. */
static double piece(const cut *c, const double h[2], double tolerance, double *error)
{
  const share s = share_at(c, 0.5 * (h[0] + h[1]));
  if (s == LENS || s != share_at(c, 0.75 * h[0] + 0.25 * h[1]) ||
      s != share_at(c, 0.25 * h[0] + 0.75 * h[1]))
    return packing_i_integrate(lens_at, c, h, lens_depths, tolerance, error);
  return s == NOTHING ? 0 : simpson(c, h, s);
}

typedef struct heights {
  int count;
  double h[MOST_HEIGHTS];
} heights;

/* Adds a height between the ends, which stand first, keeping the order. */
static void add_height(heights *list, double h)
{
  if (!(h > list->h[0] && h < list->h[list->count - 1]))
    return;
  int at = list->count++;
  for (; list->h[at - 1] > h; at--)
    list->h[at] = list->h[at - 1];
  list->h[at] = h;
}

/* Where the circle of radius r round (rho, h) meets the face of a wall. */
static void add_touching(heights *list, const packing_i_wall *w, double rho, double h,
                         double r)
{
  const double to_wall = w->a * rho + w->b * h + w->c;
  if (w->a == 0 || fabs(to_wall) > r)
    return;
  const double chord = sqrt((r - to_wall) * (r + to_wall));
  const double foot = w->a * h - w->b * rho;
  for (int side = -1; side <= 1; side += 2) {
    const double t = foot + side * chord;
    if (t > w->from && t < w->to)
      add_height(list, side * chord * w->a - to_wall * w->b);
  }
}

/* All heights between which the integrand is smooth; fewer than two: the ball passes by. */
static heights find_heights(const cut *c)
{
  const packing_i_revolution *p = c->body;
  const double low = fmax(p->knot[0] - c->h, -c->r);
  const double high = fmin(p->knot[p->knots - 1] - c->h, c->r);
  heights list = {.count = 0};
  if (!(low < high))
    return list;
  list.count = 2;
  list.h[0] = low;
  list.h[1] = high;
  for (int i = 0; i < p->knots; i++)
    add_height(&list, p->knot[i] - c->h);
  for (int i = 0; i < p->walls; i++) {
    add_touching(&list, &p->wall[i], c->rho, c->h, c->r);
    add_touching(&list, &p->wall[i], -c->rho, c->h, c->r);
  }
  return list;
}

static double integrate(const cut *c, const heights *list, double tolerance,
                        double *error)
{
  double sum = 0;
  for (int i = 0; i + 1 < list->count; i++)
    sum += piece(c, &list->h[i], tolerance, error);
  return sum;
}

/* Whether the slices of the body are alike over all heights of the ball. */
static int is_upright(const cut *c)
{
  const packing_i_revolution *p = c->body;
  const double low = c->h - c->r, high = c->h + c->r;
  if (!(low >= p->knot[0] && high <= p->knot[p->knots - 1]))
    return 0;
  const double outer = packing_i_revolution_outer(p, low);
  const double inner = packing_i_revolution_inner(p, low);
  for (int i = 0; i < p->knots; i++) {
    const double h = fmin(fmax(p->knot[i], low), high);
    if (packing_i_revolution_outer(p, h) != outer ||
        packing_i_revolution_inner(p, h) != inner)
      return 0;
  }
  return outer < PACKING_I_CYLINDER_RADII * c->r;
}

/* In a cylinder, less what is in its hole. */
static double upright(const cut *c, double *error)
{
  double e = 0;
  double v = packing_i_ball_cylinder(c->r, packing_i_revolution_outer(c->body, c->h),
                                     c->rho, &e);
  *error += e;
  v -= packing_i_ball_cylinder(c->r, packing_i_revolution_inner(c->body, c->h), c->rho,
                               &e);
  *error += e;
  return v;
}

/* The same by slices. */
static double sliced(cut *c, double tolerance, double *error)
{
  const heights list = find_heights(c);
  c->radius = packing_i_revolution_outer;
  const double v = integrate(c, &list, tolerance, error);
  c->radius = packing_i_revolution_inner;
  return v - integrate(c, &list, tolerance, error);
}

int packing_i_revolution_sphere_volume(const packing_i_domain_body *body,
                                       const packing_vec3 *centre, double r,
                                       double tolerance, double *volume, double *error)
{
  const packing_i_revolution *p = &body->as.revolution;
  const double ball = packing_i_ball_volume(3, r);
  const double rounding = 64 * DBL_EPSILON * ball;
  /* Half of what is allowed, over all pieces; no finer than rounding lets the rules agree. */
  const double allowed = fmax(0.5 * tolerance * ball, 4 * rounding) / MOST_HEIGHTS;
  cut c = {.body = p, .r = r};
  packing_i_revolution_local(p, centre, &c.rho, &c.h, NULL);
  *error = rounding;
  const double v = is_upright(&c) ? upright(&c, error) : sliced(&c, allowed, error);
  const double most = ball < body->volume ? ball : body->volume;
  *volume = v < 0 ? 0 : v > most ? most : v;
  return 0;
}
