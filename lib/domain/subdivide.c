/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volume of a set given by a distance function alone, whole or within a ball.
 *
 * Cells are halved along each axis. The distance changes by no more than the way gone, so a cell
 * whose centre is farther from the wall than its corners lies on one side and counts in full (a
 * ball's part in it in closed form, cut_planes.c) or not. At the last level the wall is taken for
 * the plane that distance and normal give at the cell's centre, which leaves an error that falls
 * with the square of the cell. Levels are added until the last two differ by less than the
 * tolerance (and those before by less than four times it, lest they agree by chance). Cost: the
 * number of cells that the wall passes through at the last level. */
#include "domain_kinds.h"
#include <math.h>

enum { FIRST_LEVEL = 3, LAST_LEVEL = 20 };

typedef struct job {
  const packing_i_domain_body *body;
  double (*distance)(const packing_i_domain_body *body, const packing_vec3 *point,
                     packing_vec3 *normal);
  packing_vec3 centre;
  double r; /* 0: no ball */
  double volume;
  size_t calls, crossed;
} job;

typedef struct cell {
  double middle[3], half[3];
} cell;

static double square(double x)
{
  return x * x;
}

/* The cell's volume, or the ball's part in it. */
static double content(const job *j, const cell *c)
{
  double product = 1, lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0}, error;
  for (int k = 0; k < j->body->dim; k++) {
    const double x = c->middle[k] - packing_i_component(j->centre, k);
    lo[k] = x - c->half[k];
    hi[k] = x + c->half[k];
    product *= 2 * c->half[k];
  }
  return j->r > 0 ? packing_i_cut_planes(j->body->dim, j->r, lo, hi, &error) : product;
}

static int beyond_ball(const job *j, const cell *c)
{
  double nearest = 0;
  for (int k = 0; k < j->body->dim; k++) {
    const double gap =
        fabs(c->middle[k] - packing_i_component(j->centre, k)) - c->half[k];
    nearest += gap > 0 ? gap * gap : 0;
  }
  return j->r > 0 && nearest >= j->r * j->r;
}

static double cube_above_0(double x)
{
  return x > 0 ? x * x * x : 0;
}

/* The part of the cube [-1, 1]^3 where s + m0 u0 + m1 u1 + m2 u2 >= 0: inclusion and exclusion
 * of the tetrahedra that the plane cuts off beyond the corners. */
static double above_plane(double s, const double m[3])
{
  const double a = s + m[0] + m[1] + m[2];
  if (a <= 0)
    return 0;
  if (s >= m[0] + m[1] + m[2])
    return 1;
  double sum = cube_above_0(a);
  for (int k = 0; k < 3; k++)
    sum += cube_above_0(a - 2 * (m[0] + m[1] + m[2]) + 2 * m[k]) -
           cube_above_0(a - 2 * m[k]);
  return sum / (48 * m[0] * m[1] * m[2]);
}

/* The part of a cell that lies inside when the wall in it is a plane. */
static double inside_part(const job *j, const cell *c, double distance,
                          packing_vec3 normal)
{
  double m[3] = {0, 0, 0}, most = 0;
  for (int k = 0; k < j->body->dim; k++) {
    m[k] = fabs(packing_i_component(normal, k)) * c->half[k];
    most = fmax(most, m[k]);
  }
  if (!(most > 0 && isfinite(most)))
    return isnan(distance) ? distance : distance >= 0;
  /* A plane along an axis is tilted a little, which changes the part by the square of it, and
   * keeps the quotient above 0/0. */
  for (int k = 0; k < 3; k++)
    m[k] = fmax(m[k], 1e-5 * most);
  return isnan(distance) ? distance : above_plane(distance, m);
}

/* Recursion goes no deeper than LAST_LEVEL. */
static void visit(job *j, const cell *c, int levels)
{
  const int dim = j->body->dim;
  packing_vec3 normal = {0, 0, 0};
  const packing_vec3 middle = {c->middle[0], c->middle[1], c->middle[2]};
  if (beyond_ball(j, c))
    return;
  const double reach = sqrt(square(c->half[0]) + square(c->half[1]) + square(c->half[2]));
  const double distance = j->distance(j->body, &middle, levels == 0 ? &normal : NULL);
  j->calls++;
  if (distance <= -reach)
    return;
  if (distance >= reach) {
    j->volume += content(j, c);
    return;
  }
  if (levels == 0) {
    j->crossed++;
    j->volume += content(j, c) * inside_part(j, c, distance, normal);
    return;
  }
  for (int child = 0; child < 1 << dim; child++) {
    cell part = *c;
    for (int k = 0; k < dim; k++) {
      part.half[k] = 0.5 * c->half[k];
      part.middle[k] += child >> k & 1 ? part.half[k] : -part.half[k];
    }
    visit(j, &part, levels - 1);
  }
}

/* The bounds, or what of them the ball's cube reaches. 0: nothing. */
static int root(const job *j, cell *c)
{
  *c = (cell){{0, 0, 0}, {0, 0, 0}};
  for (int k = 0; k < j->body->dim; k++) {
    double lo = packing_i_component(j->body->bounds.lo, k);
    double hi = packing_i_component(j->body->bounds.hi, k);
    if (j->r > 0) {
      lo = fmax(lo, packing_i_component(j->centre, k) - j->r);
      hi = fmin(hi, packing_i_component(j->centre, k) + j->r);
    }
    if (!(lo < hi))
      return 0;
    c->middle[k] = 0.5 * (lo + hi);
    c->half[k] = 0.5 * (hi - lo);
  }
  return 1;
}

static int subdivide(job j, packing_i_tolerance tolerance, size_t calls, double *volume,
                     double *error)
{
  cell whole;
  double before = 0, step_before = HUGE_VAL;
  *volume = *error = 0;
  if (!root(&j, &whole))
    return 0;
  for (int level = FIRST_LEVEL; level <= LAST_LEVEL; level++) {
    j.volume = 0;
    j.crossed = j.calls = 0;
    visit(&j, &whole, level);
    const double step = level == FIRST_LEVEL ? HUGE_VAL : fabs(j.volume - before);
    before = j.volume;
    *volume = j.volume;
    *error = j.crossed == 0 ? 0 : fmax(step, 0.25 * step_before);
    step_before = step;
    if (isnan(j.volume))
      return -1;
    if (*error <= tolerance.absolute + tolerance.relative * j.volume ||
        j.calls > calls / 4)
      return 0;
  }
  return 0;
}

int packing_i_subdivide(const packing_i_domain_body *body, const packing_vec3 *centre,
                        double r, packing_i_tolerance tolerance, size_t calls,
                        double *volume, double *error)
{
  const job j = {body, body->ops->signed_distance, *centre, r, 0, 0, 0};
  return subdivide(j, tolerance, calls, volume, error);
}

int packing_i_subdivide_sides(const packing_i_domain_body *body,
                              const packing_vec3 *centre, double r,
                              packing_i_tolerance tolerance, size_t calls, double *volume,
                              double *error)
{
  const packing_i_domain_ops *ops = body->ops;
  const job j = {
      body, ops->side != NULL ? ops->side : ops->signed_distance, *centre, r, 0, 0, 0};
  return subdivide(j, tolerance, calls, volume, error);
}
