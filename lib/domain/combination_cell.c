/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a cell may lie outside a combination.
 *
 * A part whose wall the cell is clear of lies in it wholly or not at all. Of the others the walls
 * in the cell are half spaces, but for a slack of curvature * reach^2 / 2 that their curvature
 * makes: exact for boxes, edges of polygons and level walls. So the formula of the combination
 * becomes a list of terms, each a few half spaces that hold together; one whose half spaces do
 * not meet within the cell is dropped, and so is the gap between two walls that are one surface
 * seen from both sides, up to rounding. Where a part gives no half space (custom containers,
 * corners of polygons, a cell round an axis) or lists are full, less is known and the terms are
 * larger: never smaller. */
#include "combination_internal.h"
#include "polygon_internal.h"
#include <assert.h>
#include <math.h>

enum { SURFACE_PLANE, SURFACE_BALL, SURFACE_REVOLUTION };

/* Terms of a part of the formula on the stack. */
typedef struct terms {
  int count; /* 0: nothing */
  packing_i_term term[PACKING_I_TERMS];
} terms;

static int is(const packing_i_domain_body *body,
              double (*distance)(const packing_i_domain_body *, const packing_vec3 *,
                                 packing_vec3 *))
{
  return body->ops->signed_distance == distance;
}

/* The distance of the point from the centre of curvature, over the curved share of the normal. */
static void set_curvature(const packing_i_domain_body *body, const packing_vec3 *point,
                          packing_i_bound *b)
{
  double rho = HUGE_VAL, h, share = 1;
  b->surface = SURFACE_PLANE;
  if (is(body, packing_i_round_signed_distance)) {
    b->surface = SURFACE_BALL;
    packing_vec3 v = packing_i_sub(*point, body->as.round.centre);
    if (body->dim == 2)
      v.z = 0;
    rho = packing_i_norm(v);
  } else if (is(body, packing_i_revolution_signed_distance)) {
    const packing_i_revolution *p = &body->as.revolution;
    share = fabs(p->wall[b->wall].a);
    if (share > 0) {
      b->surface = SURFACE_REVOLUTION + p->axis;
      packing_i_revolution_local(p, point, &rho, &h, NULL);
    }
  }
  b->curvature = b->surface == SURFACE_PLANE ? 0 : share / rho;
}

static double slack_of(const packing_i_bound *b, double reach)
{
  const double left = 1 - b->curvature * reach; /* rho can shrink by reach */
  if (b->curvature == 0)
    return 0;
  return left > 0 ? 0.5 * b->curvature * reach * reach / left : HUGE_VAL;
}

static void set_bound(const packing_i_cell_view *view, const packing_i_domain_body *body,
                      const packing_i_near_wall *wall, packing_i_bound *b)
{
  b->wall = wall->wall;
  b->normal = packing_i_scale(wall->normal, b->sign);
  b->value = b->sign * wall->distance;
  set_curvature(body, &view->centre, b);
  b->slack = slack_of(b, view->reach);
}

static int has_walls(const packing_i_domain_body *body)
{
  return is(body, packing_i_planar_signed_distance) ||
         is(body, packing_i_round_signed_distance) ||
         is(body, packing_i_revolution_signed_distance);
}

static packing_i_near_wall wall_of(const packing_i_edge *e, int place,
                                   const packing_vec3 *p)
{
  const packing_vec3 normal = {e->nx, e->ny, 0};
  const packing_vec3 from = {p->x - e->ax, p->y - e->ay, 0};
  return (packing_i_near_wall){packing_i_dot(from, normal), normal, place};
}

/* The walls of a part that pass through the cell; -1: they cannot be told. */
static int walls_in(const packing_i_cell_view *view, const packing_i_domain_body *body,
                    packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  if (has_walls(body))
    return body->ops->near_walls(body, &view->centre, view->reach, near);
  const packing_i_polygon *p = packing_i_domain_polygon(body);
  if (p == NULL || p->inset > 0)
    return -1;
  const int place =
      packing_i_polygon_edge_in(p->data, view->centre.x, view->centre.y, view->reach);
  if (place < 0)
    return -1;
  near[0] = wall_of(&p->data->edge[place], place, &view->centre);
  return 1;
}

static void make_whole(terms *t)
{
  t->count = 1;
  t->term[0].count = 0;
}

/* Whether bound i of one part leaves no room beside bound j of another. */
static int is_one_surface(const packing_i_combination_data *data,
                          const packing_i_bound *a, const packing_i_bound *b)
{
  const packing_vec3 sum = packing_i_add(a->normal, b->normal);
  return a->part != b->part && a->surface == b->surface &&
         packing_i_dot(sum, sum) <= 1e-24 && a->value + b->value >= -data->blur &&
         fabs(a->curvature - b->curvature) <= 1e-9 * a->curvature;
}

static double in_bound(const packing_i_cell_view *view, const packing_i_bound *b,
                       const packing_vec3 *point)
{
  return packing_i_dot(b->normal, packing_i_sub(*point, view->centre)) + b->value -
         b->slack;
}

/* The distance from a point to what two half spaces share. */
static double to_pair(const packing_i_cell_view *view, const packing_i_bound *a,
                      const packing_i_bound *b, const packing_vec3 *point,
                      packing_vec3 *foot)
{
  const double v = in_bound(view, a, point), w = in_bound(view, b, point);
  const double k = packing_i_dot(a->normal, b->normal);
  double on_a = 0, on_b = 0;
  *foot = *point;
  if (v > 0 && w - k * v <= 0) {
    on_a = v;
  } else if (w > 0 && v - k * w <= 0) {
    on_b = w;
  } else if (v > 0 || w > 0) {
    const double sine2 = (1 - k) * (1 + k);
    if (!(sine2 >
          1e-15)) /* no farther apart than parallel ones; those that face do not meet */
      return k > 0 ? fmax(v, w) : HUGE_VAL;
    on_a = (v - k * w) / sine2;
    on_b = (w - k * v) / sine2;
  }
  if (on_a == 0 && on_b == 0)
    return 0;
  const packing_vec3 way =
      packing_i_add(packing_i_scale(a->normal, on_a), packing_i_scale(b->normal, on_b));
  *foot = packing_i_sub(*point, way);
  return on_b == 0 ? on_a : on_a == 0 ? on_b : packing_i_norm(way);
}

double packing_i_term_distance(const packing_i_cell_view *view,
                               const packing_i_term *term, const packing_vec3 *point,
                               packing_vec3 *foot)
{
  double most = 0;
  *foot = *point;
  for (int i = 0; i < term->count; i++) {
    const packing_i_bound *a = &view->bound[term->bound[i]];
    const double v = in_bound(view, a, point);
    if (v > most) {
      most = v;
      *foot = packing_i_sub(*point, packing_i_scale(a->normal, v));
    }
  }
  for (int i = 0; i < term->count; i++)
    for (int j = i + 1; j < term->count; j++) {
      packing_vec3 at;
      const double d = to_pair(view, &view->bound[term->bound[i]],
                               &view->bound[term->bound[j]], point, &at);
      if (d > most) {
        most = d;
        *foot = at;
      }
    }
  return most;
}

/* Whether the term is empty within the cell. */
static int is_void(const packing_i_combination_data *data,
                   const packing_i_cell_view *view, const packing_i_term *term)
{
  packing_vec3 foot;
  for (int i = 0; i < term->count; i++)
    for (int j = i + 1; j < term->count; j++)
      if (is_one_surface(data, &view->bound[term->bound[i]],
                         &view->bound[term->bound[j]]))
        return 1;
  return packing_i_term_distance(view, term, &view->centre, &foot) > view->reach;
}

static void join(const packing_i_term *a, const packing_i_term *b, packing_i_term *both)
{
  *both = *a;
  for (int i = 0; i < b->count && both->count < PACKING_I_TERM; i++)
    both->bound[both->count++] = b->bound[i];
}

/* *a and *b, into *a. */
static void take_both(const packing_i_combination_data *data,
                      const packing_i_cell_view *view, terms *a, const terms *b)
{
  terms c;
  c.count = 0;
  for (int i = 0; i < a->count; i++)
    for (int j = 0; j < b->count; j++) {
      if (c.count == PACKING_I_TERMS) /* what is in both is in either */
        return;
      join(&a->term[i], &b->term[j], &c.term[c.count]);
      if (!is_void(data, view, &c.term[c.count]))
        c.count++;
    }
  *a = c;
}

static void take_either(terms *a, const terms *b)
{
  if (a->count + b->count > PACKING_I_TERMS) {
    make_whole(a);
    return;
  }
  for (int i = 0; i < b->count; i++)
    a->term[a->count++] = b->term[i];
}

/* Outside a part: beyond one of its walls; inside: within all of them. */
static void view_part(const packing_i_combination_data *data, packing_i_step step,
                      double distance, packing_i_cell_view *view, terms *t)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_i_domain_body *body = data->part[step.part];
  const int is_inside = step.kind == PACKING_I_STEP_INSIDE;
  t->count = 0;
  if (fabs(distance) >= view->reach) {
    if ((distance > 0) == is_inside)
      make_whole(t);
    return;
  }
  const int walls = walls_in(view, body, near);
  if (walls < 1 || view->bounds + walls > PACKING_I_BOUNDS) {
    make_whole(t);
    return;
  }
  if (is_inside)
    make_whole(t);
  for (int i = 0; i < walls; i++) {
    packing_i_bound *b = &view->bound[view->bounds];
    b->part = step.part;
    b->sign = is_inside ? -1 : 1;
    set_bound(view, body, &near[i], b);
    if (is_inside && b->slack < HUGE_VAL && t->term[0].count < PACKING_I_TERM) {
      t->term[0].bound[t->term[0].count++] = view->bounds++;
    } else if (!is_inside && b->slack < HUGE_VAL) {
      t->term[t->count].count = 1;
      t->term[t->count++].bound[0] = view->bounds++;
    } else if (!is_inside) {
      make_whole(t);
      return;
    }
  }
}

void packing_i_view_cell(const packing_i_combination_data *data, int dim,
                         const packing_vec3 *centre, double half,
                         packing_i_cell_view *view)
{
  double distance[PACKING_I_PARTS];
  terms stack[PACKING_I_FORMULA_DEPTH];
  int used = 0, part;
  view->dim = dim;
  view->centre = *centre;
  view->reach = half * sqrt((double)dim) * (1 + 1e-15);
  view->bounds = view->terms = 0;
  packing_i_part_distances(data, centre, distance);
  view->sides = packing_i_formula(data, distance, &part);
  for (int i = 0; i < data->steps; i++) {
    const packing_i_step s = data->step[i];
    if (s.kind == PACKING_I_STEP_AND || s.kind == PACKING_I_STEP_OR) {
      assert(used > 1); /* postfix order, as in combination_formula.c */
      used--;
      if (s.kind == PACKING_I_STEP_AND)
        take_both(data, view, &stack[used - 1], &stack[used]);
      else
        take_either(&stack[used - 1], &stack[used]);
    } else {
      view_part(data, s, distance[s.part], view, &stack[used++]);
    }
  }
  assert(used == 1);
  view->terms = stack[0].count;
  for (int i = 0; i < view->terms; i++)
    view->term[i] = stack[0].term[i];
}

int packing_i_move_bounds(const packing_i_combination_data *data,
                          const packing_vec3 *centre, packing_i_cell_view *view,
                          const packing_i_term *term)
{
  view->centre = *centre;
  view->reach = 0;
  for (int i = 0; i < term->count; i++) {
    packing_i_near_wall near[PACKING_I_NEAR_WALLS];
    packing_i_bound *b = &view->bound[term->bound[i]];
    const packing_i_domain_body *body = data->part[b->part];
    const packing_i_polygon *p = packing_i_domain_polygon(body);
    int walls = 1, found = 0;
    if (p != NULL)
      near[0] = wall_of(&p->data->edge[b->wall], b->wall, centre);
    else
      walls = body->ops->near_walls(body, centre, HUGE_VAL, near);
    while (found < walls && near[found].wall != b->wall)
      found++;
    if (found == walls)
      return 0;
    set_bound(view, body, &near[found], b);
  }
  return 1;
}
