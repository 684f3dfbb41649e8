/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a ball, a container and a cell have in common.
 *
 * Boxes in boxes, two balls, a ball and a cylinder have closed forms (cut_planes.c, lens.c,
 * ball_cylinder.c): some tenths of a microsecond. Where curved walls of both cut, or a round cell
 * a box, the volume comes from slices (cut_slices.c). A custom container or a mesh takes the
 * cell's wall for one more wall of its own (subdivide.c). */
#include "cut_internal.h"
#include <float.h>

enum { CALLS_FOR_PART = 1 << 21 };

static int is_planar(const packing_i_domain_body *body)
{
  return body->ops->signed_distance == packing_i_planar_signed_distance;
}

/* A container that is a box is no more than a smaller cell. */
static void take_box(packing_i_cut_job *j)
{
  if (j->body == NULL || !is_planar(j->body))
    return;
  const packing_i_planar *p = &j->body->as.planar;
  for (int k = 0; k < j->dim; k++) {
    packing_i_set_component(&j->box.lo, k, fmax(packing_i_cut_lo(j, k), p->cut_lo[k]));
    packing_i_set_component(&j->box.hi, k, fmin(packing_i_cut_hi(j, k), p->cut_hi[k]));
  }
  j->body = NULL;
}

/* -1: the ball is outside the box, or the box empty; 1: inside; 0: neither. */
static int side_of_box(const packing_i_cut_job *j)
{
  int inside = 1;
  for (int k = 0; k < j->dim; k++) {
    const double x = packing_i_component(j->centre, k);
    if (packing_i_cut_lo(j, k) - x >= j->r || x - packing_i_cut_hi(j, k) >= j->r ||
        packing_i_cut_lo(j, k) >= packing_i_cut_hi(j, k))
      return -1;
    inside = inside && x - packing_i_cut_lo(j, k) >= j->r &&
             packing_i_cut_hi(j, k) - x >= j->r;
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

static int side_of_cell(const packing_i_cut_job *j)
{
  packing_vec3 away;
  if (j->cell->kind == PACKING_I_CELL_BOX)
    return 1;
  const double d = from_middle(j->cell, j->dim, &j->centre, &away);
  return d >= j->cell->radius + j->r ? -1 : d <= j->cell->radius - j->r;
}

/* A custom container or a mesh with the cell's wall. */
typedef struct both {
  const packing_i_domain_body *body;
  const packing_i_cell *cell;
} both;

static double distance_to_both(void *user, const packing_vec3 *point,
                               packing_vec3 *normal)
{
  const both *b = user;
  packing_vec3 away;
  const packing_i_domain_ops *ops = b->body->ops;
  const double d =
      (ops->side != NULL ? ops->side : ops->signed_distance)(b->body, point, normal);
  const double rho = from_middle(b->cell, b->body->dim, point, &away);
  if (b->cell->kind == PACKING_I_CELL_BOX || !(b->cell->radius - rho < d))
    return d;
  if (normal != NULL)
    *normal = rho > 0 ? packing_i_scale(away, -1 / rho) : packing_i_vec(1, 0, 0);
  return b->cell->radius - rho;
}

static int subdivided(const packing_i_cut_job *j, double *volume, double *error)
{
  both b = {j->body, j->cell};
  packing_i_domain_body body = packing_i_domain_body_new(&packing_i_custom_ops, j->dim);
  double box = 1;
  body.as.custom.signed_distance = distance_to_both;
  body.as.custom.user = &b;
  body.bounds = j->body->bounds;
  for (int k = 0; k < j->dim; k++) {
    const double lo =
        fmax(packing_i_component(body.bounds.lo, k), packing_i_cut_lo(j, k));
    const double hi =
        fmin(packing_i_component(body.bounds.hi, k), packing_i_cut_hi(j, k));
    packing_i_set_component(&body.bounds.lo, k, lo);
    packing_i_set_component(&body.bounds.hi, k, hi);
    box *= hi > lo ? hi - lo : 0;
  }
  const packing_i_tolerance enough = {
      fmax(j->tolerance, 1e-4) * (j->r > 0 ? packing_i_cut_reference(j) : box), 0};
  return packing_i_subdivide(&body, &j->centre, j->r, enough, CALLS_FOR_PART, volume,
                             error);
}

/* Closed forms for a cell that is a box, and no container but a box. */
static double boxed(const packing_i_cut_job *j, double *error)
{
  double lo[3], hi[3], box = 1;
  for (int k = 0; k < 3; k++) {
    const double x = packing_i_component(j->centre, k);
    lo[k] = packing_i_cut_lo(j, k) - x;
    hi[k] = packing_i_cut_hi(j, k) - x;
    if (k < j->dim)
      box *= hi[k] > lo[k] ? packing_i_cut_hi(j, k) - packing_i_cut_lo(j, k) : 0;
  }
  *error = 0;
  return j->r > 0 ? packing_i_cut_planes(j->dim, j->r, lo, hi, error) : box;
}

/* No container that is not a box, none in reach of the ball. */
static double free_part(const packing_i_cut_job *j, int in_box, int in_cell,
                        double *error)
{
  packing_vec3 away;
  const double radius = j->cell->radius;
  *error = 0;
  if (j->cell->kind == PACKING_I_CELL_BOX || (j->r > 0 && in_cell > 0))
    return boxed(j, error);
  if (j->r == 0 || in_box == 0)
    return packing_i_cut_slices(j, error);
  const double d = from_middle(j->cell, j->dim, &j->centre, &away);
  *error = 64 * DBL_EPSILON * packing_i_ball_volume(j->dim, j->r);
  if (j->cell->kind == PACKING_I_CELL_BALL || j->dim == 2)
    return packing_i_lens(j->dim, j->r, radius, d);
  if (radius < PACKING_I_CYLINDER_RADII * j->r)
    return packing_i_ball_cylinder(j->r, radius, d, error);
  return packing_i_cut_slices(j, error);
}

/* Without a ball: clips the box to the container's bounds and says whether it then lies wholly
 * inside (1), outside (-1) or neither (0). */
static int clip(packing_i_cut_job *j)
{
  packing_vec3 middle = {0, 0, 0};
  double reach = 0;
  for (int k = 0; k < j->dim; k++) {
    const double lo =
        fmax(packing_i_cut_lo(j, k), packing_i_component(j->body->bounds.lo, k));
    const double hi =
        fmin(packing_i_cut_hi(j, k), packing_i_component(j->body->bounds.hi, k));
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
static int part(packing_i_cut_job *j, double *volume, double *error)
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
  else if (packing_i_is_round(j->body) || packing_i_is_revolution(j->body))
    *volume = packing_i_cut_slices(j, error);
  else
    return subdivided(j, volume, error);
  return 0;
}

/* The question, for the parts of a combination. */
typedef struct question {
  const packing_i_cell *cell;
  const packing_vec3 *centre;
  double r, tolerance;
} question;

static int ask(const packing_domain *domain, const void *arg, double *volume,
               double *error)
{
  const question *q = arg;
  return packing_i_domain_cell_volume(domain, q->cell, q->centre, q->r, q->tolerance,
                                      volume, error);
}

int packing_i_domain_cell_volume(const packing_domain *domain, const packing_i_cell *cell,
                                 const packing_vec3 *centre, double r, double tolerance,
                                 double *volume, double *error)
{
  const packing_i_domain_body *body = &domain->body;
  packing_i_cut_job j = {body, cell, cell->box, *centre, r, tolerance, body->dim};
  if (packing_i_has_parts(body)) {
    const question q = {cell, centre, r, tolerance};
    return packing_i_by_parts(domain, ask, &q, volume, error);
  }
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
