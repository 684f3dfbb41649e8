/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Balls, containers and cells by slices: across the axis of a body of revolution or, where there
 * is none, of a cylindrical cell, all slices are discs, strips and rectangles (discs.c), and the
 * volume is the integral of their areas over the heights. Between the heights where their shape
 * changes (cut_heights.c) the area is smooth inside and has half-integer powers at the ends
 * (integrate.c). A tube or a ring is its outside less its hole. Some tenths of a millisecond. */
#include "cut_internal.h"
#include <float.h>

/* The slices: u and v follow the axis in cyclic order. */
static int slicing_axis(const packing_i_cut_job *j)
{
  if (j->dim == 2)
    return 2;
  if (packing_i_is_revolution(j->body))
    return j->body->as.revolution.axis;
  return j->cell->kind == PACKING_I_CELL_CYLINDER ? j->cell->axis : 2;
}

/* Heights and places count from here, so that little is lost to rounding. */
static packing_vec3 origin_of(const packing_i_cut_job *j)
{
  if (j->r > 0)
    return j->centre;
  if (packing_i_is_revolution(j->body))
    return j->body->as.revolution.base;
  return packing_i_is_round(j->body) ? j->body->as.round.centre : j->cell->centre;
}

typedef struct frame {
  int axis;
  packing_vec3 origin;
} frame;

static double along(const frame *f, int which, const packing_vec3 *p)
{
  const int axis = (f->axis + which) % 3;
  return packing_i_component(*p, axis) - packing_i_component(f->origin, axis);
}

static packing_i_curve *add_curve(packing_i_cut *c, const frame *f,
                                  const packing_vec3 *centre, double radius)
{
  packing_i_curve *curve = &c->curve[c->curves++];
  *curve = (packing_i_curve){.a = radius, .strip = -1};
  curve->u = along(f, 1, centre);
  curve->v = along(f, 2, centre);
  curve->kind = PACKING_I_CURVE_LINE;
  return curve;
}

static void limit(packing_i_cut *c, double low, double high)
{
  c->low = fmax(c->low, low);
  c->high = fmin(c->high, high);
}

/* A ball; in the plane a disc. */
static void add_ball(packing_i_cut *c, const packing_i_cut_job *j, const frame *f,
                     const packing_vec3 *centre, double radius)
{
  packing_i_curve *curve = add_curve(c, f, centre, radius);
  if (j->dim == 2)
    return;
  curve->kind = PACKING_I_CURVE_BALL;
  curve->b = along(f, 0, centre);
  limit(c, curve->b - radius, curve->b + radius);
}

static void add_cell(packing_i_cut *c, const packing_i_cut_job *j, const frame *f)
{
  const packing_i_cell *cell = j->cell;
  if (cell->kind == PACKING_I_CELL_BOX)
    return;
  if (cell->kind == PACKING_I_CELL_BALL || j->dim == 2) {
    add_ball(c, j, f, &cell->centre, cell->radius);
    return;
  }
  if (cell->axis == f->axis) {
    add_curve(c, f, &cell->centre, cell->radius);
    return;
  }
  add_ball(c, j, f, &cell->centre, cell->radius);
  c->curve[c->curves - 1].strip = (f->axis + 1) % 3 == cell->axis ? 1 : 0;
}

/* The outside, or the hole. */
static void add_container(packing_i_cut *c, const packing_i_cut_job *j, const frame *f,
                          int hole)
{
  c->wall = c->curves;
  if (packing_i_is_round(j->body)) {
    const packing_i_round *s = &j->body->as.round;
    add_ball(c, j, f, &s->centre, hole ? s->inner : s->outer);
  } else if (packing_i_is_revolution(j->body)) {
    const packing_i_revolution *p = &j->body->as.revolution;
    const double base = along(f, 0, &p->base);
    limit(c, base + p->knot[0], base + p->knot[p->knots - 1]);
    for (int i = 0; i < p->walls; i++) {
      const packing_i_wall *w = &p->wall[i];
      if (hole ? !(w->a > 0) : !(w->a < 0))
        continue;
      packing_i_curve *curve = add_curve(c, f, &p->base, 0);
      curve->b = w->b / -w->a;
      curve->a = w->c / -w->a - curve->b * base;
    }
  }
  c->walls = c->curves - c->wall;
}

static packing_i_cut make_cut(const packing_i_cut_job *j, const frame *f, int hole)
{
  packing_i_cut c = {.low = -HUGE_VAL, .high = HUGE_VAL};
  for (int k = 0; k < 2; k++) {
    c.lo[k] = along(f, k + 1, &j->box.lo);
    c.hi[k] = along(f, k + 1, &j->box.hi);
  }
  if (j->dim == 3)
    limit(&c, along(f, 0, &j->box.lo), along(f, 0, &j->box.hi));
  if (j->r > 0)
    add_ball(&c, j, f, &j->centre, j->r);
  add_cell(&c, j, f);
  add_container(&c, j, f, hole);
  return c;
}

/* The area of the slice at a height. */
static double slice(const void *arg, double h)
{
  const packing_i_cut *c = arg;
  double lo[2] = {c->lo[0], c->lo[1]}, hi[2] = {c->hi[0], c->hi[1]};
  packing_i_disc disc[PACKING_I_DISCS];
  int discs = 0;
  for (int i = 0; i < c->curves; i++) {
    const packing_i_curve *curve = &c->curve[i];
    double radius = packing_i_curve_radius(curve, h);
    if (i == c->wall)
      for (; i + 1 < c->wall + c->walls; i++)
        radius = fmin(radius, packing_i_curve_radius(&c->curve[i + 1], h));
    if (curve->strip >= 0) {
      const double middle = curve->strip == 0 ? curve->u : curve->v;
      lo[curve->strip] = fmax(lo[curve->strip], middle - radius);
      hi[curve->strip] = fmin(hi[curve->strip], middle + radius);
    } else {
      disc[discs++] = (packing_i_disc){curve->u, curve->v, radius};
    }
  }
  return packing_i_discs_area(discs, disc, lo, hi);
}

/* What the errors are relative to. */
double packing_i_cut_reference(const packing_i_cut_job *j)
{
  if (j->r > 0)
    return packing_i_ball_volume(j->dim, j->r);
  if (j->body != NULL)
    return j->body->volume;
  double box = 1;
  for (int k = 0; k < j->dim; k++) {
    const int round = j->cell->kind == PACKING_I_CELL_BALL ||
                      (j->cell->kind == PACKING_I_CELL_CYLINDER && k != j->cell->axis);
    const double size = packing_i_cut_hi(j, k) - packing_i_cut_lo(j, k);
    box *= round ? fmin(size, 2 * j->cell->radius) : size;
  }
  return box;
}

/* Cones and three round things meet where cut_heights.c does not look. */
static packing_i_depths depths_of(const packing_i_cut *c)
{
  packing_i_depths depths = {0, PACKING_I_DEEPEST};
  int slanted = 0;
  for (int i = 0; i < c->curves; i++)
    slanted += c->curve[i].kind == PACKING_I_CURVE_LINE && c->curve[i].b != 0;
  if (c->curves - (c->walls > 1 ? c->walls - 1 : 0) >= 3 || slanted > 0)
    depths.least = 2;
  return depths;
}

static double integrate(const packing_i_cut_job *j, const packing_i_cut *c, double *error)
{
  packing_i_heights list;
  double sum = 0;
  if (j->dim == 2)
    return slice(c, 0);
  if (!(c->low < c->high))
    return 0;
  packing_i_cut_heights(c, &list);
  const double whole = packing_i_cut_reference(j);
  const double allowed = fmax(0.5 * j->tolerance / list.count, 1e-14) * whole;
  for (int i = 0; i + 1 < list.count; i++)
    sum += packing_i_integrate(slice, c, &list.h[i], depths_of(c), allowed, error);
  return sum;
}

double packing_i_cut_slices(const packing_i_cut_job *j, double *error)
{
  const frame f = {slicing_axis(j), origin_of(j)};
  const packing_i_cut outside = make_cut(j, &f, 0);
  double sum = integrate(j, &outside, error);
  const packing_i_cut hole = make_cut(j, &f, 1);
  const int has_hole = packing_i_is_round(j->body)        ? j->body->as.round.inner > 0
                       : packing_i_is_revolution(j->body) ? hole.walls > 0
                                                          : 0;
  if (has_hole)
    sum -= integrate(j, &hole, error);
  *error += 256 * DBL_EPSILON * packing_i_cut_reference(j);
  return sum > 0 ? sum : 0;
}
