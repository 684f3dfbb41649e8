/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plane sections of containers, and of balls within them.
 *
 * The section is a rectangle, a circle or a ring where a plane along two axes cuts a box, where
 * any plane cuts a ball, and where one across the axis cuts a body of revolution: closed forms
 * (discs.c). Every other section is the integral of its chords (section_chord.c) along u over
 * v, piece by piece between the corners of the section of the bounds and the sides of the disc;
 * what else bends the chords is left to the bisection. A custom container is subdivided in the
 * plane (subdivide.c), where its distance changes as slowly as in space. */
#include "domain_kinds.h"
#include <float.h>

enum { CALLS_FOR_SECTION = 1 << 21, MOST_CORNERS = 12, MOST_ENDS = MOST_CORNERS + 4 };

static packing_vec3 at(const packing_i_plane *p, double u, double v)
{
  return packing_i_add(p->origin, packing_i_add(packing_i_scale(p->u_axis, u),
                                                packing_i_scale(p->v_axis, v)));
}

/* The axis that the plane lies across, or -1. */
static int axis_of(const packing_i_plane *p)
{
  for (int k = 0; k < 3; k++)
    if (fabs(packing_i_component(p->normal, k)) == 1)
      return k;
  return -1;
}

static int is_planar(const packing_i_domain_body *body)
{
  return body->ops->signed_distance == packing_i_planar_signed_distance;
}

static int is_revolution(const packing_i_domain_body *body)
{
  return body->ops->signed_distance == packing_i_revolution_signed_distance;
}

static int is_round(const packing_i_domain_body *body)
{
  return body->ops->signed_distance == packing_i_round_signed_distance;
}

/* u and v of the corners of the section of the bounds: where the plane crosses an edge. */
static int find_corners(const packing_i_domain_body *body, const packing_i_plane *p,
                        double corner[MOST_CORNERS][2])
{
  int count = 0;
  for (int edge = 0; edge < 12; edge++) {
    const int k = edge / 4;
    packing_vec3 a = body->bounds.lo, b;
    for (int i = 1; i < 3; i++)
      if (edge >> (i - 1) & 1)
        packing_i_set_component(&a, (k + i) % 3,
                                packing_i_component(body->bounds.hi, (k + i) % 3));
    b = a;
    packing_i_set_component(&b, k, packing_i_component(body->bounds.hi, k));
    const double from = packing_i_dot(packing_i_sub(a, p->origin), p->normal);
    const double to = packing_i_dot(packing_i_sub(b, p->origin), p->normal);
    if (from == to || (from < 0 && to < 0) || (from > 0 && to > 0))
      continue;
    const packing_vec3 cross = packing_i_sub(
        packing_i_add(a, packing_i_scale(packing_i_sub(b, a), from / (from - to))),
        p->origin);
    corner[count][0] = packing_i_dot(cross, p->u_axis);
    corner[count++][1] = packing_i_dot(cross, p->v_axis);
  }
  return count;
}

/* A circle that holds the section, where there is one; a radius of 0: the plane misses it. */
static int circle_of(const packing_i_domain_body *body, const packing_i_plane *p,
                     packing_i_disc *circle, double *hole)
{
  packing_vec3 c;
  *hole = 0;
  if (is_round(body)) {
    c = packing_i_sub(body->as.round.centre, p->origin);
    const double d = packing_i_dot(c, p->normal), r = body->as.round.outer;
    circle->r = fabs(d) < r ? sqrt((r - d) * (r + d)) : 0;
  } else if (is_revolution(body) && axis_of(p) == body->as.revolution.axis) {
    const packing_i_revolution *s = &body->as.revolution;
    c = packing_i_sub(s->base, p->origin);
    const double h = -packing_i_component(c, s->axis);
    const int within = h >= s->knot[0] && h <= s->knot[s->knots - 1];
    circle->r = within ? packing_i_revolution_outer(s, h) : 0;
    *hole = within ? packing_i_revolution_inner(s, h) : 0;
  } else {
    return 0;
  }
  circle->u = packing_i_dot(c, p->u_axis);
  circle->v = packing_i_dot(c, p->v_axis);
  return 1;
}

int packing_i_domain_section_window(const packing_domain *domain,
                                    const packing_i_plane *plane, double lo[2],
                                    double hi[2])
{
  const packing_i_domain_body *body = &domain->body;
  double corner[MOST_CORNERS][2], hole;
  packing_i_disc circle;
  const int count = find_corners(body, plane, corner);
  const int is_circle = circle_of(body, plane, &circle, &hole);
  if (count == 0 || (is_circle && circle.r == 0))
    return 0;
  for (int k = 0; k < 2; k++) {
    lo[k] = HUGE_VAL;
    hi[k] = -HUGE_VAL;
    for (int i = 0; i < count; i++) {
      lo[k] = fmin(lo[k], corner[i][k]);
      hi[k] = fmax(hi[k], corner[i][k]);
    }
    if (is_circle) {
      lo[k] = (k == 0 ? circle.u : circle.v) - circle.r;
      hi[k] = (k == 0 ? circle.u : circle.v) + circle.r;
    }
  }
  return lo[0] < hi[0] && lo[1] < hi[1];
}

/* The integrand. */
typedef struct chords {
  const packing_i_domain_body *body;
  const packing_i_plane *plane;
  double u, v, r; /* the disc, or r = 0 */
  double lo, hi;  /* of u */
} chords;

static double chord_at(const void *arg, double v)
{
  const chords *c = arg;
  const packing_vec3 start = at(c->plane, 0, v);
  double lo = c->lo, hi = c->hi;
  if (c->r > 0) {
    const double s = (c->r - (v - c->v)) * (c->r + (v - c->v));
    const double half = s > 0 ? sqrt(s) : 0;
    lo = c->u - half;
    hi = c->u + half;
  }
  return packing_i_chord(c->body, &start, &c->plane->u_axis, lo, hi);
}

static void add_end(double ends[MOST_ENDS], int *count, double v)
{
  if (!(v > ends[0] && v < ends[*count - 1]))
    return;
  int place = (*count)++;
  for (; ends[place - 1] > v; place--)
    ends[place] = ends[place - 1];
  ends[place] = v;
}

static double sum_of_chords(const chords *c, const double lo[2], const double hi[2],
                            double tolerance, double *error)
{
  static const packing_i_depths depths = {2, PACKING_I_DEEPEST};
  const double size =
      c->r > 0 ? packing_i_ball_volume(2, c->r) : (hi[0] - lo[0]) * (hi[1] - lo[1]);
  double corner[MOST_CORNERS][2], ends[MOST_ENDS] = {lo[1], hi[1]}, sum = 0;
  int count = 2;
  if (c->r > 0) {
    ends[0] = fmax(lo[1], c->v - c->r);
    ends[1] = fmin(hi[1], c->v + c->r);
  }
  const int corners = find_corners(c->body, c->plane, corner);
  for (int i = 0; i < corners; i++)
    add_end(ends, &count, corner[i][1]);
  const double allowed = fmax(0.5 * tolerance / count, 1e-14) * size;
  for (int i = 0; i + 1 < count && ends[0] < ends[1]; i++)
    sum += packing_i_integrate(chord_at, c, &ends[i], depths, allowed, error);
  *error += 64 * DBL_EPSILON * size;
  return sum;
}

/* A custom container or a mesh seen in the plane. */
typedef struct flat {
  const packing_i_domain_body *body;
  const packing_i_plane *plane;
} flat;

static double distance_in_plane(void *user, const packing_vec3 *point,
                                packing_vec3 *normal)
{
  const flat *f = user;
  packing_vec3 n = {0, 0, 0};
  const packing_vec3 p = at(f->plane, point->x, point->y);
  const packing_i_domain_ops *ops = f->body->ops;
  const double d = (ops->side != NULL ? ops->side : ops->signed_distance)(
      f->body, &p, normal == NULL ? NULL : &n);
  if (normal != NULL)
    *normal = packing_i_vec(packing_i_dot(n, f->plane->u_axis),
                            packing_i_dot(n, f->plane->v_axis), 0);
  return d;
}

static int subdivided(const chords *c, const double lo[2], const double hi[2],
                      double tolerance, double *area, double *error)
{
  flat f = {c->body, c->plane};
  packing_i_domain_body body = packing_i_domain_body_new(&packing_i_custom_ops, 2);
  const packing_vec3 centre = {c->u, c->v, 0};
  const double size =
      c->r > 0 ? packing_i_ball_volume(2, c->r) : (hi[0] - lo[0]) * (hi[1] - lo[1]);
  const packing_i_tolerance enough = {fmax(tolerance, 1e-4) * size, 0};
  body.as.custom.signed_distance = distance_in_plane;
  body.as.custom.user = &f;
  body.bounds.lo = packing_i_vec(lo[0], lo[1], 0);
  body.bounds.hi = packing_i_vec(hi[0], hi[1], 0);
  return packing_i_subdivide(&body, &centre, c->r, enough, CALLS_FOR_SECTION, area,
                             error);
}

/* Discs and rectangles: 1 where the section is one. */
static int closed_form(const chords *c, const double lo[2], const double hi[2],
                       double *area, double *error)
{
  static const double far[2] = {-HUGE_VAL, -HUGE_VAL}, near[2] = {HUGE_VAL, HUGE_VAL};
  packing_i_disc disc[3] = {{c->u, c->v, c->r}};
  double hole;
  const int first = c->r > 0 ? 0 : 1;
  if (is_planar(c->body) && axis_of(c->plane) >= 0) {
    *area = packing_i_discs_area(1 - first, disc, lo, hi);
  } else if (circle_of(c->body, c->plane, &disc[1], &hole)) {
    *area = packing_i_discs_area(2 - first, &disc[first], far, near);
    disc[1].r = hole;
    if (hole > 0)
      *area -= packing_i_discs_area(2 - first, &disc[first], far, near);
  } else {
    return 0;
  }
  *error =
      64 * DBL_EPSILON *
      (c->r > 0 ? packing_i_ball_volume(2, c->r) : (hi[0] - lo[0]) * (hi[1] - lo[1]));
  return 1;
}

/* The question, for the parts of a combination. */
typedef struct question {
  const packing_i_plane *plane;
  double u, v, r, tolerance;
} question;

static int ask(const packing_domain *domain, const void *arg, double *area, double *error)
{
  const question *q = arg;
  return packing_i_domain_section_area(domain, q->plane, q->u, q->v, q->r, q->tolerance,
                                       area, error);
}

int packing_i_domain_section_area(const packing_domain *domain,
                                  const packing_i_plane *plane, double u, double v,
                                  double r, double tolerance, double *area, double *error)
{
  double lo[2], hi[2];
  *area = *error = 0;
  if (packing_i_has_parts(&domain->body)) {
    const question q = {plane, u, v, r, tolerance};
    return packing_i_by_parts(domain, ask, &q, area, error);
  }
  if (!packing_i_domain_section_window(domain, plane, lo, hi))
    return 0;
  if (r > 0 && (u + r <= lo[0] || u - r >= hi[0] || v + r <= lo[1] || v - r >= hi[1]))
    return 0;
  const chords c = {&domain->body, plane, u, v, r, lo[0], hi[0]};
  if (closed_form(&c, lo, hi, area, error))
    return 0;
  if (!is_planar(c.body) && !is_revolution(c.body))
    return subdivided(&c, lo, hi, tolerance, area, error);
  *area = sum_of_chords(&c, lo, hi, tolerance, error);
  return 0;
}

int packing_i_domain_contains(const packing_domain *domain, const packing_vec3 *point)
{
  const packing_i_domain_body *body = &domain->body;
  for (int k = 0; k < body->dim; k++) {
    const double x = packing_i_component(*point, k);
    if (x < packing_i_component(body->bounds.lo, k) ||
        x > packing_i_component(body->bounds.hi, k))
      return 0;
  }
  return body->ops->signed_distance(body, point, NULL) >= 0;
}
