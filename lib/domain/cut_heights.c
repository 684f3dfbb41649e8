/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the slices of a cut change their shape: discs begin to touch from outside or inside,
 * meet an edge or a corner, or three borders meet in a point. Closed forms, roots of quadratics
 * at most. Left out are points where a cone, or three curved walls, meet the rest: there only
 * the second derivative of the area jumps, which the quadrature bears. */
#include "cut_internal.h"

/* A point that stays the same in all slices. */
typedef struct vertex {
  double at[2];
} vertex;

enum {
  MOST_VERTICES = 4 + 2 * 4 * PACKING_I_CURVES + PACKING_I_CURVES * PACKING_I_CURVES
};

typedef struct search {
  const packing_i_cut *cut;
  packing_i_heights *list;
  int vertices;
  vertex vertex[MOST_VERTICES];
} search;

/* Adds a height between the ends, which stand first, keeping the order. One that rounding alone
 * tells from another is that other. */
static void add(packing_i_heights *list, double h)
{
  const double same = 1e-14 * (list->h[list->count - 1] - list->h[0]);
  if (!(h > list->h[0] + same && h < list->h[list->count - 1] - same) ||
      list->count == PACKING_I_HEIGHTS)
    return;
  int at = list->count;
  while (list->h[at - 1] > h)
    at--;
  if (h - list->h[at - 1] <= same || list->h[at] - h <= same)
    return;
  for (int i = list->count++; i > at; i--)
    list->h[i] = list->h[i - 1];
  list->h[at] = h;
}

/* Adds offset + the roots of a x^2 + b x + c. */
static void add_roots(packing_i_heights *list, double offset, double a, double b,
                      double c)
{
  const double d = b * b - 4 * a * c;
  if (!(d >= 0))
    return;
  const double q = -0.5 * (b + copysign(sqrt(d), b));
  if (a != 0)
    add(list, offset + q / a);
  if (q != 0)
    add(list, offset + c / q);
}

/* Where the radius is d >= 0. */
static void add_radius(packing_i_heights *list, const packing_i_curve *c, double d)
{
  if (c->kind == PACKING_I_CURVE_BALL) {
    const double s = (c->a - d) * (c->a + d);
    if (!(s >= 0))
      return;
    add(list, c->b - sqrt(s));
    add(list, c->b + sqrt(s));
  } else if (c->b != 0) {
    add(list, (d - c->a) / c->b);
  }
}

static void touch_lines(packing_i_heights *list, const packing_i_curve *p,
                        const packing_i_curve *q, double d)
{
  for (int i = 0; i < 4; i++) {
    const double s = i & 1 ? -1 : 1, e = i & 2 ? -d : d;
    if (p->b + s * q->b != 0)
      add(list, (e - p->a - s * q->a) / (p->b + s * q->b));
  }
}

/* a^2 - x^2 = (d +- radius)^2 with x from the ball's centre. */
static void touch_ball_and_line(packing_i_heights *list, const packing_i_curve *ball,
                                const packing_i_curve *line, double d)
{
  for (int s = -1; s <= 1; s += 2) {
    const double k = s * line->b, m = d + s * (line->a + line->b * ball->b);
    add_roots(list, ball->b, 1 + k * k, 2 * m * k, (m - ball->a) * (m + ball->a));
  }
}

/* The difference of both squared radii is linear, K + d^2 + 2 D x, and its distance from d^2 is
 * 2 d times the second radius, with a sign. */
static void touch_balls(packing_i_heights *list, const packing_i_curve *p,
                        const packing_i_curve *q, double d)
{
  const double far = p->b - q->b;
  const double k = (p->a - q->a) * (p->a + q->a) + far * far - d * d;
  add_roots(list, p->b, 4 * (far * far + d * d), 4 * far * (k + 2 * d * d),
            k * k - 4 * d * d * (q->a - far) * (q->a + far));
}

/* Where p + q, or their difference, is d, with a sign. */
static void add_touching(packing_i_heights *list, const packing_i_curve *p,
                         const packing_i_curve *q, double d)
{
  if (p->kind == PACKING_I_CURVE_LINE && q->kind == PACKING_I_CURVE_LINE)
    touch_lines(list, p, q, d);
  else if (p->kind == PACKING_I_CURVE_LINE)
    touch_ball_and_line(list, q, p, d);
  else if (q->kind == PACKING_I_CURVE_LINE)
    touch_ball_and_line(list, p, q, d);
  else
    touch_balls(list, p, q, d);
}

static double middle(const packing_i_curve *c, int side)
{
  return side == 0 ? c->u : c->v;
}

/* Between the middles; where one is a strip, in its direction. */
static double apart(const packing_i_curve *p, const packing_i_curve *q)
{
  const double u = q->u - p->u, v = q->v - p->v;
  const int strip = p->strip >= 0 ? p->strip : q->strip;
  return strip < 0 ? sqrt(u * u + v * v) : fabs(strip == 0 ? u : v);
}

static int is_upright(const packing_i_curve *c)
{
  return c->kind == PACKING_I_CURVE_LINE && c->b == 0 && c->strip < 0;
}

static void add_vertex(search *s, double u, double v)
{
  const vertex p = {{u, v}};
  s->vertex[s->vertices++] = p;
}

static double edge(const packing_i_cut *c, int k)
{
  return k % 2 == 0 ? c->lo[k / 2] : c->hi[k / 2];
}

/* Corners, and where upright cylinders meet edges. */
static void find_vertices_of_edges(search *s)
{
  const packing_i_cut *c = s->cut;
  for (int k = 0; k < 4; k++)
    if (isfinite(edge(c, k % 2)) && isfinite(edge(c, 2 + k / 2)))
      add_vertex(s, edge(c, k % 2), edge(c, 2 + k / 2));
  for (int i = 0; i < c->curves; i++)
    for (int k = 0; k < 4 && is_upright(&c->curve[i]); k++) {
      const packing_i_curve *p = &c->curve[i];
      const double d = edge(c, k) - middle(p, k / 2);
      for (int side = -1; side <= 1 && fabs(d) < p->a; side += 2) {
        const double at = middle(p, 1 - k / 2) + side * sqrt((p->a - d) * (p->a + d));
        add_vertex(s, k < 2 ? edge(c, k) : at, k < 2 ? at : edge(c, k));
      }
    }
}

/* Where two upright cylinders meet. */
static void find_vertices_of_cylinders(search *s)
{
  const packing_i_cut *c = s->cut;
  for (int i = 0; i < c->curves; i++)
    for (int j = i + 1; j < c->curves; j++) {
      const packing_i_curve *p = &c->curve[i], *q = &c->curve[j];
      const double d = apart(p, q);
      if (!is_upright(p) || !is_upright(q) || !(d > 0))
        continue;
      const double foot = ((d - q->a) * (d + q->a) + p->a * p->a) / (2 * d);
      const double half2 = (p->a - foot) * (p->a + foot);
      const double eu = (q->u - p->u) / d, ev = (q->v - p->v) / d;
      for (int side = -1; side <= 1 && half2 > 0; side += 2)
        add_vertex(s, p->u + foot * eu - side * sqrt(half2) * ev,
                   p->v + foot * ev + side * sqrt(half2) * eu);
    }
}

static void add_at_vertices(search *s, const packing_i_curve *c)
{
  for (int i = 0; i < s->vertices; i++) {
    const double u = s->vertex[i].at[0] - c->u, v = s->vertex[i].at[1] - c->v;
    add_radius(s->list, c,
               c->strip < 0    ? sqrt(u * u + v * v)
               : c->strip == 0 ? fabs(u)
                               : fabs(v));
  }
}

/* In the plane of an edge a ball, and a strip along it, is a circle. */
static int circle_at(const packing_i_curve *c, int side, double at, double circle[3])
{
  const double d = c->strip < 0 ? at - middle(c, side) : 0;
  if (c->kind != PACKING_I_CURVE_BALL || c->strip == side || !(fabs(d) < c->a))
    return 0;
  circle[0] = middle(c, 1 - side);
  circle[1] = c->b;
  circle[2] = (c->a - d) * (c->a + d);
  return 1;
}

static void add_common(packing_i_heights *list, const double p[3], const double q[3])
{
  const double x = q[0] - p[0], h = q[1] - p[1], d2 = x * x + h * h;
  if (!(d2 > 0))
    return;
  const double foot = 0.5 * (1 + (p[2] - q[2]) / d2); /* share of the way */
  const double half2 = p[2] / d2 - foot * foot;
  if (!(half2 >= 0))
    return;
  add(list, p[1] + foot * h - sqrt(half2) * x);
  add(list, p[1] + foot * h + sqrt(half2) * x);
}

static void add_on_edges(search *s, const packing_i_curve *p, const packing_i_curve *q)
{
  for (int k = 0; k < 4; k++) {
    double a[3], b[3];
    if (circle_at(p, k / 2, edge(s->cut, k), a) &&
        circle_at(q, k / 2, edge(s->cut, k), b))
      add_common(s->list, a, b);
  }
}

static void add_at_edges(search *s, const packing_i_curve *c)
{
  for (int k = 0; k < 4; k++)
    if (isfinite(edge(s->cut, k)) && (c->strip < 0 || c->strip == k / 2))
      add_radius(s->list, c, fabs(edge(s->cut, k) - middle(c, k / 2)));
}

void packing_i_cut_heights(const packing_i_cut *cut, packing_i_heights *heights)
{
  search s = {.cut = cut, .list = heights};
  heights->count = 2;
  heights->h[0] = cut->low;
  heights->h[1] = cut->high;
  find_vertices_of_edges(&s);
  find_vertices_of_cylinders(&s);
  for (int i = 0; i < cut->curves; i++) {
    const packing_i_curve *c = &cut->curve[i];
    add_radius(heights, c, 0);
    add_at_edges(&s, c);
    add_at_vertices(&s, c);
    for (int j = i + 1; j < cut->curves; j++) {
      add_touching(heights, c, &cut->curve[j], apart(c, &cut->curve[j]));
      add_on_edges(&s, c, &cut->curve[j]);
    }
  }
}
