/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The area that a few discs and a rectangle have in common.
 *
 * Discs that hold another, or that the others keep out of, are struck off first; what remains of
 * one disc or of two without the rectangle has formulas of its own (cut_planes.c, lens.c). Else
 * the border is walked: each circle falls into arcs between the points where it meets the others
 * and the edges, and an arc whose middle lies in all the rest belongs to the border, as does of
 * an edge what all discs hold. By Green's theorem the area is the sum over the border of
 *
 *     (A x B) / 2 + r^2 / 2 (angle - sin(angle))
 *
 * for an arc from A to B, the triangle with the origin and the segment beyond it, and of the
 * triangle alone for an edge. The origin is the centre of the smallest disc and both circles
 * that meet share the point where they do, so that no more is lost than some roundings of that
 * disc, however large the others are. */
#include "domain_kinds.h"
#include <float.h>

/* Points on one circle: two for each other circle and for each edge. */
enum { MOST_POINTS = 2 * (PACKING_I_DISCS - 1) + 8 };

typedef struct point {
  double u, v, angle;
} point;

typedef struct region {
  int count;
  packing_i_disc disc[PACKING_I_DISCS];
  double lo[2], hi[2];
} region;

static double distance(const packing_i_disc *a, const packing_i_disc *b)
{
  return sqrt((a->u - b->u) * (a->u - b->u) + (a->v - b->v) * (a->v - b->v));
}

/* What rounding can move the circles of both by. */
static double blur(const packing_i_disc *a, const packing_i_disc *b)
{
  return 4 * DBL_EPSILON *
         (a->r + fabs(a->u) + fabs(a->v) + b->r + fabs(b->u) + fabs(b->v));
}

/* Strikes off discs that hold another, up to rounding (of two circles that are as good as one
 * not both must have arcs); of equal ones the later. 0: two discs are apart. */
static int strike_off(region *g)
{
  for (int i = 0; i < g->count; i++)
    for (int j = i + 1; j < g->count; j++) {
      const packing_i_disc *a = &g->disc[i], *b = &g->disc[j];
      const double d = distance(a, b);
      if (d >= a->r + b->r)
        return 0;
      if (d > fabs(a->r - b->r) + blur(a, b))
        continue;
      g->disc[b->r >= a->r ? j : i] = g->disc[g->count - 1];
      g->count--;
      i = -1;
      break;
    }
  return 1;
}

static int smallest(const region *g)
{
  int least = 0;
  for (int i = 1; i < g->count; i++)
    if (g->disc[i].r < g->disc[least].r)
      least = i;
  return least;
}

static void move_origin(region *g, double u, double v)
{
  for (int i = 0; i < g->count; i++) {
    g->disc[i].u -= u;
    g->disc[i].v -= v;
  }
  g->lo[0] -= u;
  g->hi[0] -= u;
  g->lo[1] -= v;
  g->hi[1] -= v;
}

static void add_point(point points[MOST_POINTS], int *count, const packing_i_disc *c,
                      double u, double v)
{
  const point p = {u, v, atan2(v - c->v, u - c->u)};
  int at = (*count)++;
  for (; at > 0 && points[at - 1].angle > p.angle; at--)
    points[at] = points[at - 1];
  points[at] = p;
}

/* Where two circles meet, the same points whichever is named first. */
static int meet(const region *g, int i, int j, double u[2], double v[2])
{
  const packing_i_disc *a = &g->disc[i < j ? i : j], *b = &g->disc[i < j ? j : i];
  if (b->r < a->r) { /* from the smaller */
    const packing_i_disc *c = a;
    a = b;
    b = c;
  }
  const double d = distance(a, b);
  const double foot = ((d - b->r) * (d + b->r) + a->r * a->r) / (2 * d);
  const double half2 = (a->r - foot) * (a->r + foot);
  if (!(half2 > 0))
    return 0;
  const double half = sqrt(half2);
  const double eu = (b->u - a->u) / d, ev = (b->v - a->v) / d;
  for (int side = 0; side < 2; side++) {
    const double s = side == 0 ? half : -half;
    u[side] = a->u + foot * eu - s * ev;
    v[side] = a->v + foot * ev + s * eu;
  }
  return 1;
}

static int holds(const region *g, int but, double u, double v)
{
  for (int i = 0; i < g->count; i++) {
    const packing_i_disc *c = &g->disc[i];
    if (i != but && (u - c->u) * (u - c->u) + (v - c->v) * (v - c->v) > c->r * c->r)
      return 0;
  }
  return u >= g->lo[0] && u <= g->hi[0] && v >= g->lo[1] && v <= g->hi[1];
}

/* Half a chord at the distance d from the centre. */
static double chord(const packing_i_disc *c, double d)
{
  return fabs(d) < c->r ? sqrt((c->r - d) * (c->r + d)) : 0;
}

static int find_points(const region *g, int i, point points[MOST_POINTS])
{
  const packing_i_disc *c = &g->disc[i];
  int count = 0;
  for (int j = 0; j < g->count; j++) {
    double u[2], v[2];
    if (j == i || !meet(g, i, j, u, v))
      continue;
    for (int side = 0; side < 2; side++)
      add_point(points, &count, c, u[side], v[side]);
  }
  for (int k = 0; k < 4; k++) {
    const double at = k % 2 == 0 ? g->lo[k / 2] : g->hi[k / 2];
    const double half = chord(c, at - (k < 2 ? c->u : c->v));
    for (int side = -1; side <= 1 && half > 0; side += 2)
      add_point(points, &count, c, k < 2 ? at : c->u + side * half,
                k < 2 ? c->v + side * half : at);
  }
  return count;
}

/* Twice the area that the arcs of circle i add. */
static double arcs(const region *g, int i)
{
  const packing_i_disc *c = &g->disc[i];
  point points[MOST_POINTS];
  const int count = find_points(g, i, points);
  double sum = 0;
  if (count == 0)
    return holds(g, i, c->u + c->r, c->v) ? 2 * PACKING_I_PI * c->r * c->r : 0;
  for (int k = 0; k < count; k++) {
    const point *a = &points[k], *b = &points[(k + 1) % count];
    const double angle = b->angle - a->angle + (k + 1 == count ? 2 * PACKING_I_PI : 0);
    const double middle = a->angle + 0.5 * angle;
    if (holds(g, i, c->u + c->r * cos(middle), c->v + c->r * sin(middle)))
      sum += (a->u * b->v - b->u * a->v) + c->r * c->r * packing_i_minus_sin(angle);
  }
  return sum;
}

/* Twice the area that edge k (low u, high u, low v, high v) adds. */
static double edge(const region *g, int k)
{
  const double at = k % 2 == 0 ? g->lo[k / 2] : g->hi[k / 2];
  double from = g->lo[1 - k / 2], to = g->hi[1 - k / 2];
  if (!isfinite(at))
    return 0;
  for (int i = 0; i < g->count; i++) {
    const packing_i_disc *c = &g->disc[i];
    const double half = chord(c, at - (k < 2 ? c->u : c->v));
    const double middle = k < 2 ? c->v : c->u;
    if (half == 0)
      return 0;
    from = fmax(from, middle - half);
    to = fmin(to, middle + half);
  }
  return to > from ? (k % 2 == 0 ? -at : at) * (to - from) : 0;
}

static double walk(const region *g)
{
  double sum = 0;
  for (int i = 0; i < g->count; i++)
    sum += arcs(g, i);
  for (int k = 0; k < 4; k++)
    sum += edge(g, k);
  return sum > 0 ? 0.5 * sum : 0;
}

double packing_i_discs_area(int count, const packing_i_disc discs[], const double lo[2],
                            const double hi[2])
{
  region g = {.count = count, .lo = {lo[0], lo[1]}, .hi = {hi[0], hi[1]}};
  double error;
  for (int i = 0; i < count; i++) {
    if (!(discs[i].r > 0))
      return 0;
    g.disc[i] = discs[i];
  }
  if (!(lo[0] < hi[0] && lo[1] < hi[1]) || !strike_off(&g))
    return 0;
  if (g.count == 0)
    return (hi[0] - lo[0]) * (hi[1] - lo[1]);
  const packing_i_disc c = g.disc[smallest(&g)];
  move_origin(&g, c.u, c.v);
  const int clear =
      g.lo[0] <= -c.r && g.hi[0] >= c.r && g.lo[1] <= -c.r && g.hi[1] >= c.r;
  if (g.count == 2 && clear)
    return packing_i_lens(2, g.disc[0].r, g.disc[1].r, distance(&g.disc[0], &g.disc[1]));
  if (g.count == 1) {
    const double low[3] = {g.lo[0], g.lo[1], 0}, high[3] = {g.hi[0], g.hi[1], 0};
    return packing_i_cut_planes(2, c.r, low, high, &error);
  }
  return walk(&g);
}
