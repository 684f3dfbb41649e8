/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a ball, a container and a cell have in common.
 *
 * Boxes in boxes, two balls, a ball and a cylinder have closed forms (cut_planes.c, lens.c,
 * ball_cylinder.c), and so has all of the plane (discs.c). Else the volume is the integral over
 * heights of the area of a slice: across the axis of a body of revolution or, where there is
 * none, of a cylindrical cell, all slices are discs, strips and rectangles. Between the heights
 * where their shape changes (cut_heights.c) the area is smooth inside and has half-integer
 * powers at the ends (integrate.c). A tube or a ring is its outside less its hole. A custom
 * container takes the cell's wall for one more wall of its own (subdivide.c). Some tenths of a
 * millisecond for a ball that curved walls of both cut, else some tenths of a microsecond. */
#include "cut_internal.h"
#include <float.h>

enum {
  CALLS_FOR_PART = 1 << 21,
  MOST_RADII = 1000 /* of a ball, in a cylinder with a closed form */
};

/* The question. */
typedef struct job {
  const packing_i_domain_body *body; /* NULL: all space */
  const packing_i_cell *cell;
  packing_bounds box; /* of the cell and of a container that is a box */
  packing_vec3 centre;
  double r;
  double tolerance;
  int dim;
} job;

static double low_side(const job *j, int k)
{
  return packing_i_component(j->box.lo, k);
}

static double high_side(const job *j, int k)
{
  return packing_i_component(j->box.hi, k);
}

static int is_planar(const packing_i_domain_body *body)
{
  return body->ops->signed_distance == packing_i_planar_signed_distance;
}

static int is_revolution(const packing_i_domain_body *body)
{
  return body != NULL &&
         body->ops->signed_distance == packing_i_revolution_signed_distance;
}

static int is_round(const packing_i_domain_body *body)
{
  return body != NULL && body->ops->signed_distance == packing_i_round_signed_distance;
}

/* A container that is a box is no more than a smaller cell. */
static void take_box(job *j)
{
  if (j->body == NULL || !is_planar(j->body))
    return;
  const packing_i_planar *p = &j->body->as.planar;
  for (int k = 0; k < j->dim; k++) {
    packing_i_set_component(&j->box.lo, k, fmax(low_side(j, k), p->cut_lo[k]));
    packing_i_set_component(&j->box.hi, k, fmin(high_side(j, k), p->cut_hi[k]));
  }
  j->body = NULL;
}

/* -1: the ball is outside the box, or the box empty; 1: inside; 0: neither. */
static int side_of_box(const job *j)
{
  int inside = 1;
  for (int k = 0; k < j->dim; k++) {
    const double x = packing_i_component(j->centre, k);
    if (low_side(j, k) - x >= j->r || x - high_side(j, k) >= j->r ||
        low_side(j, k) >= high_side(j, k))
      return -1;
    inside = inside && x - low_side(j, k) >= j->r && high_side(j, k) - x >= j->r;
  }
  return inside;
}

/* The distance of the ball from the axis or the centre of a round cell. */
static double from_middle(const packing_i_cell *cell, int dim, const packing_vec3 *point,
                          packing_vec3 *away)
{
  *away = packing_i_sub(*point, cell->centre);
  if (dim == 2)
    away->z = 0;
  else if (cell->kind == PACKING_I_CELL_CYLINDER)
    packing_i_set_component(away, cell->axis, 0);
  return packing_i_norm(*away);
}

static int side_of_cell(const job *j)
{
  packing_vec3 away;
  if (j->cell->kind == PACKING_I_CELL_BOX)
    return 1;
  const double d = from_middle(j->cell, j->dim, &j->centre, &away);
  return d >= j->cell->radius + j->r ? -1 : d <= j->cell->radius - j->r;
}

/* The slices: u and v follow the axis in cyclic order. */
static int slicing_axis(const job *j)
{
  if (j->dim == 2)
    return 2;
  if (is_revolution(j->body))
    return j->body->as.revolution.axis;
  return j->cell->kind == PACKING_I_CELL_CYLINDER ? j->cell->axis : 2;
}

/* Heights and places count from here, so that little is lost to rounding. */
static packing_vec3 origin_of(const job *j)
{
  if (j->r > 0)
    return j->centre;
  if (is_revolution(j->body))
    return j->body->as.revolution.base;
  return is_round(j->body) ? j->body->as.round.centre : j->cell->centre;
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
static void add_ball(packing_i_cut *c, const job *j, const frame *f,
                     const packing_vec3 *centre, double radius)
{
  packing_i_curve *curve = add_curve(c, f, centre, radius);
  if (j->dim == 2)
    return;
  curve->kind = PACKING_I_CURVE_BALL;
  curve->b = along(f, 0, centre);
  limit(c, curve->b - radius, curve->b + radius);
}

static void add_cell(packing_i_cut *c, const job *j, const frame *f)
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
static void add_container(packing_i_cut *c, const job *j, const frame *f, int hole)
{
  c->wall = c->curves;
  if (is_round(j->body)) {
    const packing_i_round *s = &j->body->as.round;
    add_ball(c, j, f, &s->centre, hole ? s->inner : s->outer);
  } else if (is_revolution(j->body)) {
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

static packing_i_cut make_cut(const job *j, const frame *f, int hole)
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
static double reference(const job *j)
{
  if (j->r > 0)
    return packing_i_ball_volume(j->dim, j->r);
  if (j->body != NULL)
    return j->body->volume;
  double box = 1;
  for (int k = 0; k < j->dim; k++) {
    const int round = j->cell->kind == PACKING_I_CELL_BALL ||
                      (j->cell->kind == PACKING_I_CELL_CYLINDER && k != j->cell->axis);
    const double size = high_side(j, k) - low_side(j, k);
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

static double integrate(const job *j, const packing_i_cut *c, double *error)
{
  packing_i_heights list;
  double sum = 0;
  if (j->dim == 2)
    return slice(c, 0);
  if (!(c->low < c->high))
    return 0;
  packing_i_cut_heights(c, &list);
  const double whole = reference(j);
  const double allowed = fmax(0.5 * j->tolerance / list.count, 1e-14) * whole;
  for (int i = 0; i + 1 < list.count; i++)
    sum += packing_i_integrate(slice, c, &list.h[i], depths_of(c), allowed, error);
  return sum;
}

static double sliced(const job *j, double *error)
{
  const frame f = {slicing_axis(j), origin_of(j)};
  const packing_i_cut outside = make_cut(j, &f, 0);
  double sum = integrate(j, &outside, error);
  const packing_i_cut hole = make_cut(j, &f, 1);
  const int has_hole = is_round(j->body)        ? j->body->as.round.inner > 0
                       : is_revolution(j->body) ? hole.walls > 0
                                                : 0;
  if (has_hole)
    sum -= integrate(j, &hole, error);
  *error += 256 * DBL_EPSILON * reference(j);
  return sum > 0 ? sum : 0;
}

/* A custom container with the cell's wall. */
typedef struct both {
  const packing_i_domain_body *body;
  const packing_i_cell *cell;
} both;

static double distance_to_both(void *user, const packing_vec3 *point,
                               packing_vec3 *normal)
{
  const both *b = user;
  packing_vec3 away;
  const double d = b->body->ops->signed_distance(b->body, point, normal);
  const double rho = from_middle(b->cell, b->body->dim, point, &away);
  if (b->cell->kind == PACKING_I_CELL_BOX || !(b->cell->radius - rho < d))
    return d;
  if (normal != NULL)
    *normal = rho > 0 ? packing_i_scale(away, -1 / rho) : packing_i_vec(1, 0, 0);
  return b->cell->radius - rho;
}

static int subdivided(const job *j, double *volume, double *error)
{
  both b = {j->body, j->cell};
  packing_i_domain_body body = packing_i_domain_body_new(j->body->ops, j->dim);
  double box = 1;
  body.as.custom.signed_distance = distance_to_both;
  body.as.custom.user = &b;
  body.bounds = j->body->bounds;
  for (int k = 0; k < j->dim; k++) {
    const double lo = fmax(packing_i_component(body.bounds.lo, k), low_side(j, k));
    const double hi = fmin(packing_i_component(body.bounds.hi, k), high_side(j, k));
    packing_i_set_component(&body.bounds.lo, k, lo);
    packing_i_set_component(&body.bounds.hi, k, hi);
    box *= hi > lo ? hi - lo : 0;
  }
  const packing_i_tolerance enough = {
      fmax(j->tolerance, 1e-4) * (j->r > 0 ? reference(j) : box), 0};
  return packing_i_subdivide(&body, &j->centre, j->r, enough, CALLS_FOR_PART, volume,
                             error);
}

/* Closed forms for a cell that is a box, and no container but a box. */
static double boxed(const job *j, double *error)
{
  double lo[3], hi[3], box = 1;
  for (int k = 0; k < 3; k++) {
    const double x = packing_i_component(j->centre, k);
    lo[k] = low_side(j, k) - x;
    hi[k] = high_side(j, k) - x;
    if (k < j->dim)
      box *= hi[k] > lo[k] ? high_side(j, k) - low_side(j, k) : 0;
  }
  *error = 0;
  return j->r > 0 ? packing_i_cut_planes(j->dim, j->r, lo, hi, error) : box;
}

/* No container that is not a box, none in reach of the ball. */
static double free_part(const job *j, int in_box, int in_cell, double *error)
{
  packing_vec3 away;
  const double radius = j->cell->radius;
  *error = 0;
  if (j->cell->kind == PACKING_I_CELL_BOX || (j->r > 0 && in_cell > 0))
    return boxed(j, error);
  if (j->r == 0 || in_box == 0)
    return sliced(j, error);
  const double d = from_middle(j->cell, j->dim, &j->centre, &away);
  *error = 64 * DBL_EPSILON * packing_i_ball_volume(j->dim, j->r);
  if (j->cell->kind == PACKING_I_CELL_BALL || j->dim == 2)
    return packing_i_lens(j->dim, j->r, radius, d);
  if (radius < MOST_RADII * j->r)
    return packing_i_ball_cylinder(j->r, radius, d, error);
  return sliced(j, error);
}

/* Without a ball: clips the box to the container's bounds and says whether it then lies wholly
 * inside (1), outside (-1) or neither (0). */
static int clip(job *j)
{
  packing_vec3 middle = {0, 0, 0};
  double reach = 0;
  for (int k = 0; k < j->dim; k++) {
    const double lo = fmax(low_side(j, k), packing_i_component(j->body->bounds.lo, k));
    const double hi = fmin(high_side(j, k), packing_i_component(j->body->bounds.hi, k));
    if (!(lo < hi))
      return -1;
    packing_i_set_component(&j->box.lo, k, lo);
    packing_i_set_component(&j->box.hi, k, hi);
    packing_i_set_component(&middle, k, 0.5 * (lo + hi));
    reach += 0.25 * (hi - lo) * (hi - lo);
  }
  const double d = j->body->ops->signed_distance(j->body, &middle, NULL);
  reach = sqrt(reach);
  return d <= -reach ? -1 : d >= reach;
}

/* What the container, the cell and the ball have in common. */
static int part(job *j, double *volume, double *error)
{
  const int in_box = j->r > 0 ? side_of_box(j) : 0;
  const int in_cell = j->r > 0 ? side_of_cell(j) : 0;
  *volume = *error = 0;
  if (in_box < 0 || in_cell < 0)
    return 0;
  if (j->r == 0 && j->body != NULL) {
    const int side = clip(j);
    if (side < 0)
      return 0;
    if (side > 0)
      j->body = NULL;
  }
  if (j->body == NULL)
    *volume = free_part(j, in_box, in_cell, error);
  else if (in_box > 0 && in_cell > 0)
    return j->body->ops->sphere_volume(j->body, &j->centre, j->r, j->tolerance, volume,
                                       error);
  else if (is_round(j->body) || is_revolution(j->body))
    *volume = sliced(j, error);
  else
    return subdivided(j, volume, error);
  return 0;
}

int packing_i_domain_cell_volume(const packing_domain *domain, const packing_i_cell *cell,
                                 const packing_vec3 *centre, double r, double tolerance,
                                 double *volume, double *error)
{
  const packing_i_domain_body *body = &domain->body;
  job j = {body, cell, cell->box, *centre, r, tolerance, body->dim};
  if (r > 0) {
    const double distance = body->ops->signed_distance(body, centre, NULL);
    *volume = *error = 0;
    if (isnan(distance))
      return -1;
    if (distance <= -r)
      return 0;
    if (distance >= r && packing_i_domain_keeps_whole(domain, centre, r))
      j.body = NULL;
  }
  take_box(&j);
  return part(&j, volume, error);
}
