/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What must not be rounded: on which side of a plane a point lies, whether triangles meet, which
 * way a thin triangle faces. Signs come from the predicates of lib/delaunay. */
#include "mesh_internal.h"
#include "delaunay/expansion.h"
#include "delaunay/predicates.h"

static const double GRAIN = 0x1.8p-147; /* adding it rounds to its last bit, 2^-199 */

packing_i_mesh_point packing_i_mesh_place(const packing_mesh *mesh, const double x[3])
{
  packing_i_mesh_point p;
  for (int k = 0; k < 3; k++) {
    const double v = x[k] * mesh->unit;
    p.x[k] = fabs(v) < 0x1p-147 ? (v + GRAIN) - GRAIN : v;
  }
  return p;
}

static packing_i_delaunay_point in_space(const packing_i_mesh_point *p)
{
  const packing_i_delaunay_point q = {{p->x[0], p->x[1], p->x[2]}, 0};
  return q;
}

int packing_i_mesh_orient(const packing_i_mesh_point *a, const packing_i_mesh_point *b,
                          const packing_i_mesh_point *c, const packing_i_mesh_point *d)
{
  const packing_i_delaunay_point p[4] = {in_space(a), in_space(b), in_space(c),
                                         in_space(d)};
  const packing_i_delaunay_point *const at[4] = {&p[0], &p[1], &p[2], &p[3]};
  return packing_i_delaunay_orient(3, at);
}

/* The sign of the area of abc seen along an axis. */
static int orient_along(int axis, const packing_i_mesh_point *a,
                        const packing_i_mesh_point *b, const packing_i_mesh_point *c)
{
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const packing_i_delaunay_point p[3] = {
      {{a->x[u], a->x[v], 0}, 0}, {{b->x[u], b->x[v], 0}, 0}, {{c->x[u], c->x[v], 0}, 0}};
  const packing_i_delaunay_point *const at[4] = {&p[0], &p[1], &p[2], NULL};
  return packing_i_delaunay_orient(2, at);
}

typedef struct corners {
  packing_i_mesh_point p[3];
} corners;

static corners corners_of(const packing_mesh *mesh, size_t t)
{
  corners c;
  for (int i = 0; i < 3; i++)
    c.p[i] = packing_i_mesh_place(mesh, packing_i_mesh_corner(mesh, t, i));
  return c;
}

/* An axis along which the triangle has an area, or -1. */
static int open_axis(const corners *c)
{
  for (int axis = 2; axis >= 0; axis--)
    if (orient_along(axis, &c->p[0], &c->p[1], &c->p[2]) != 0)
      return axis;
  return -1;
}

int packing_i_mesh_is_flat(const packing_mesh *mesh, size_t t)
{
  const corners c = corners_of(mesh, t);
  return open_axis(&c) < 0;
}

/* One component of (b - a) x (c - a), the two others' axes given. */
static packing_i_two minor_of(const corners *c, int u, int v)
{
  const packing_i_two bu = packing_i_two_sum(c->p[1].x[u], -c->p[0].x[u]);
  const packing_i_two bv = packing_i_two_sum(c->p[1].x[v], -c->p[0].x[v]);
  const packing_i_two cu = packing_i_two_sum(c->p[2].x[u], -c->p[0].x[u]);
  const packing_i_two cv = packing_i_two_sum(c->p[2].x[v], -c->p[0].x[v]);
  return packing_i_double_add(packing_i_double_multiply(bu, cv),
                              packing_i_double_negate(packing_i_double_multiply(bv, cu)));
}

packing_vec3 packing_i_mesh_normal(const packing_mesh *mesh, size_t t, double *area)
{
  const corners c = corners_of(mesh, t);
  packing_vec3 n =
      packing_i_vec(minor_of(&c, 1, 2).hi, minor_of(&c, 2, 0).hi, minor_of(&c, 0, 1).hi);
  const double most = fmax(fmax(fabs(n.x), fabs(n.y)), fabs(n.z));
  if (most > 0)
    n = packing_i_vec(n.x / most, n.y / most, n.z / most);
  const double norm = packing_i_norm(n);
  if (area != NULL)
    *area = 0.5 * most * norm / mesh->unit / mesh->unit;
  return most > 0 ? packing_i_vec(n.x / norm, n.y / norm, n.z / norm) : n;
}

static int between_signs(int a, int b, int c)
{
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/* In the plane: whether p lies in the triangle or on its border. */
static int holds_flat(int axis, const corners *c, const packing_i_mesh_point *p)
{
  return between_signs(orient_along(axis, &c->p[0], &c->p[1], p),
                       orient_along(axis, &c->p[1], &c->p[2], p),
                       orient_along(axis, &c->p[2], &c->p[0], p));
}

/* p on the line of a and b: whether it is one of them or between. */
static int is_between(const packing_i_mesh_point *a, const packing_i_mesh_point *b,
                      const packing_i_mesh_point *p)
{
  for (int k = 0; k < 3; k++)
    if ((p->x[k] < a->x[k] && p->x[k] < b->x[k]) ||
        (p->x[k] > a->x[k] && p->x[k] > b->x[k]))
      return 0;
  return 1;
}

static int segments_meet(int axis, const packing_i_mesh_point *a,
                         const packing_i_mesh_point *b, const packing_i_mesh_point *p,
                         const packing_i_mesh_point *q)
{
  const int ap = orient_along(axis, a, b, p), aq = orient_along(axis, a, b, q);
  const int pa = orient_along(axis, p, q, a), pb = orient_along(axis, p, q, b);
  if (ap * aq < 0 && pa * pb < 0)
    return 1;
  return (ap == 0 && is_between(a, b, p)) || (aq == 0 && is_between(a, b, q)) ||
         (pa == 0 && is_between(p, q, a)) || (pb == 0 && is_between(p, q, b));
}

static int segment_meets_flat(const corners *c, const packing_i_mesh_point *p,
                              const packing_i_mesh_point *q)
{
  const int axis = open_axis(c);
  if (axis < 0)
    return 0;
  if (holds_flat(axis, c, p) || holds_flat(axis, c, q))
    return 1;
  for (int i = 0; i < 3; i++)
    if (segments_meet(axis, &c->p[i], &c->p[(i + 1) % 3], p, q))
      return 1;
  return 0;
}

/* Whether a segment and a triangle, borders counted, have a point in common. */
static int segment_meets(const corners *c, const packing_i_mesh_point *p,
                         const packing_i_mesh_point *q)
{
  const int sp = packing_i_mesh_orient(&c->p[0], &c->p[1], &c->p[2], p);
  const int sq = packing_i_mesh_orient(&c->p[0], &c->p[1], &c->p[2], q);
  if (sp * sq > 0)
    return 0;
  if (sp == 0 && sq == 0)
    return segment_meets_flat(c, p, q);
  return between_signs(packing_i_mesh_orient(p, q, &c->p[0], &c->p[1]),
                       packing_i_mesh_orient(p, q, &c->p[1], &c->p[2]),
                       packing_i_mesh_orient(p, q, &c->p[2], &c->p[0]));
}

/* The sides of a triangle's plane that another's corners lie on. */
static void sides_of(const corners *c, const corners *of, int side[3])
{
  for (int i = 0; i < 3; i++)
    side[i] = packing_i_mesh_orient(&c->p[0], &c->p[1], &c->p[2], &of->p[i]);
}

static int all_beyond(const int s[3])
{
  return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

/* Where a segment crosses the triangle's plane; of one in the plane the middle. For messages. */
static packing_vec3 crossing(const packing_mesh *mesh, const corners *c,
                             const packing_i_mesh_point *p, const packing_i_mesh_point *q)
{
  const packing_vec3 a = packing_i_mesh_vec(c->p[0].x), x = packing_i_mesh_vec(p->x),
                     y = packing_i_mesh_vec(q->x);
  const packing_vec3 n = packing_i_cross(packing_i_sub(packing_i_mesh_vec(c->p[1].x), a),
                                         packing_i_sub(packing_i_mesh_vec(c->p[2].x), a));
  const double from = packing_i_dot(n, packing_i_sub(x, a));
  const double to = packing_i_dot(n, packing_i_sub(y, a));
  const double s = from != to ? from / (from - to) : 0.5;
  const packing_vec3 at =
      packing_i_add(x, packing_i_scale(packing_i_sub(y, x), fmin(fmax(s, 0), 1)));
  return packing_i_scale(at, 1 / mesh->unit);
}

/* Which corners are shared: pairs (i of s, j of t). */
typedef struct shared {
  int count;
  int of_s[3], of_t[3];
} shared;

static shared shared_corners(const packing_mesh *mesh, size_t s, size_t t)
{
  shared both = {0, {0}, {0}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (mesh->triangle[3 * s + (size_t)i] == mesh->triangle[3 * t + (size_t)j] &&
          both.count < 3) {
        both.of_s[both.count] = i;
        both.of_t[both.count++] = j;
      }
  return both;
}

/* Neighbours across an edge: they lie on each other where they are in one plane and on one side
 * of the edge, or fold back to it within 1e-6 rad. */
static packing_i_mesh_meeting meet_at_edge(const packing_mesh *mesh, size_t s, size_t t,
                                           const corners c[2], const shared *both)
{
  static const double least_sine = 1e-6;
  const int i = 3 - both->of_s[0] - both->of_s[1], j = 3 - both->of_t[0] - both->of_t[1];
  const packing_i_mesh_point *a = &c[0].p[both->of_s[0]], *b = &c[0].p[both->of_s[1]];
  if (packing_i_mesh_orient(a, b, &c[0].p[i], &c[1].p[j]) == 0) {
    const int axis = open_axis(&c[0]);
    return axis >= 0 && orient_along(axis, a, b, &c[0].p[i]) ==
                            orient_along(axis, a, b, &c[1].p[j])
               ? PACKING_I_MESH_ON_EACH_OTHER
               : PACKING_I_MESH_APART;
  }
  const packing_vec3 m = packing_i_mesh_normal(mesh, s, NULL),
                     n = packing_i_mesh_normal(mesh, t, NULL);
  return packing_i_dot(m, n) < 0 && packing_i_norm(packing_i_cross(m, n)) < least_sine
             ? PACKING_I_MESH_ON_EACH_OTHER
             : PACKING_I_MESH_APART;
}

/* The edges of triangle 0 that may meet triangle 1 beyond what is shared: all, or the one opposite
 * to the shared corner. */
static int edges_meet(const packing_mesh *mesh, const corners *edges, const corners *c,
                      int opposite, packing_vec3 *point)
{
  for (int i = 0; i < 3; i++) {
    const packing_i_mesh_point *p = &edges->p[(i + 1) % 3], *q = &edges->p[(i + 2) % 3];
    if ((opposite < 0 || opposite == i) && segment_meets(c, p, q)) {
      *point = crossing(mesh, c, p, q);
      return 1;
    }
  }
  return 0;
}

packing_i_mesh_meeting packing_i_mesh_meet(const packing_mesh *mesh, size_t s, size_t t,
                                           packing_vec3 *point)
{
  const corners c[2] = {corners_of(mesh, s), corners_of(mesh, t)};
  const shared both = shared_corners(mesh, s, t);
  int of_t[3], of_s[3];
  if (both.count >= 2) {
    *point = packing_i_scale(packing_i_add(packing_i_mesh_vec(c[0].p[both.of_s[0]].x),
                                           packing_i_mesh_vec(c[0].p[both.of_s[1]].x)),
                             0.5 / mesh->unit);
    return both.count == 3 ? PACKING_I_MESH_ON_EACH_OTHER
                           : meet_at_edge(mesh, s, t, c, &both);
  }
  sides_of(&c[0], &c[1], of_t);
  sides_of(&c[1], &c[0], of_s);
  if (all_beyond(of_t) || all_beyond(of_s))
    return PACKING_I_MESH_APART;
  if (!edges_meet(mesh, &c[0], &c[1], both.count == 1 ? both.of_s[0] : -1, point) &&
      !edges_meet(mesh, &c[1], &c[0], both.count == 1 ? both.of_t[0] : -1, point))
    return PACKING_I_MESH_APART;
  return of_t[0] == 0 && of_t[1] == 0 && of_t[2] == 0 ? PACKING_I_MESH_ON_EACH_OTHER
                                                      : PACKING_I_MESH_CROSS;
}
