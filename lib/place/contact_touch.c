/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gaps of a place, and the solution of "all gaps are 0" for three unknowns (two in the
 * plane z = 0) by Newton's method and, from afar, Levenberg and Marquardt's. Gradients of
 * spheres and walls are exact, those of other shapes central differences. */
#include "touch_internal.h"
#include <float.h>

enum { POLISH_STEPS = 4, DESCENT_STEPS = 250 };

/* Of a radius: places farther apart are two. */
static const double near_place = 0x1p-6;

/* A descent that wins less of the squares in a step than this share has ended. */
static const double standstill = 0x1p-30;

/* Of a radius: as far as the centre is moved to find a gradient. */
static const double difference_step = 0x1p-18;

int packing_i_touch_first(const packing_contact_task *task)
{
  int i = 0;
  while (i < task->dim - 1 && task->fixed[i].domain != NULL)
    i++;
  return i;
}

int packing_i_touch_all_round(const packing_contact_task *task)
{
  for (int i = 0; i < task->dim; i++)
    if (task->fixed[i].domain == NULL && task->fixed[i].shape != NULL)
      return 0;
  return task->mobile.shape == NULL;
}

int packing_i_touch_has_walls(const packing_contact_task *task)
{
  for (int i = 0; i < task->dim; i++)
    if (task->fixed[i].domain != NULL)
      return 1;
  return 0;
}

static int sees_walls(const packing_contact_task *task, packing_vec3 from)
{
  packing_body mobile = task->mobile;
  mobile.centre = from;
  for (int i = 0; i < task->dim; i++) {
    const packing_body *body = &task->fixed[i];
    if (body->domain != NULL &&
        !isfinite(packing_body_wall_gap(&mobile, body->domain, body->wall, NULL)))
      return 0;
  }
  return 1;
}

int packing_i_touch_view(const packing_contact_task *task, packing_vec3 *from)
{
  if (sees_walls(task, *from))
    return 1;
  for (int i = 0; i < task->dim; i++) {
    *from = task->fixed[i].centre;
    if (task->fixed[i].domain == NULL && sees_walls(task, *from))
      return 1;
  }
  return 0;
}

static double size_of(packing_vec3 v)
{
  const double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z);
  const double most = x > y ? x : y;
  return most > z ? most : z;
}

double packing_i_touch_extent(const packing_contact_task *task)
{
  double extent = task->mobile.r;
  for (int i = 0; i < task->dim; i++) {
    if (task->fixed[i].domain != NULL)
      continue;
    const double size = size_of(task->fixed[i].centre) + task->fixed[i].r;
    extent = size > extent ? size : extent;
  }
  return extent;
}

double packing_i_touch_tolerance(const packing_contact_task *task)
{
  const double rounding = 8 * DBL_EPSILON * packing_i_touch_extent(task);
  const double share = 1e-12 * task->mobile.r;
  return share > rounding ? share : rounding;
}

/* Whether two places are one as far as the tolerance can tell: what lies between is a
 * place. */
static int is_same(const packing_contact_task *task, packing_vec3 a, packing_vec3 b)
{
  if (packing_i_norm(packing_i_sub(a, b)) > near_place * task->mobile.r)
    return 0;
  packing_i_touch between;
  packing_i_touch_at(task, packing_i_scale(packing_i_add(a, b), 0.5), &between);
  return between.worst <= packing_i_touch_tolerance(task);
}

int packing_i_touch_sides(const packing_contact_task *task, packing_i_touch_find find,
                          packing_vec3 centre[2])
{
  packing_vec3 first, second;
  const int one = find(task, 1, &first);
  const int two = find(task, -1, &second) && !(one && is_same(task, first, second));
  if (one)
    centre[0] = first;
  if (two)
    centre[one] = second;
  return one + two;
}

static double moved_gap(packing_body mobile, const packing_body *body, int axis,
                        double by)
{
  double *coordinate = axis == 0   ? &mobile.centre.x
                       : axis == 1 ? &mobile.centre.y
                                   : &mobile.centre.z;
  *coordinate += by;
  return packing_body_gap(&mobile, body);
}

static packing_vec3 differences(const packing_body *mobile, const packing_body *body,
                                int dim)
{
  const double step = difference_step * mobile->r;
  double slope[3] = {0, 0, 0};
  for (int k = 0; k < dim; k++)
    slope[k] = (moved_gap(*mobile, body, k, step) - moved_gap(*mobile, body, k, -step)) /
               (2 * step);
  return packing_i_vec(slope[0], slope[1], slope[2]);
}

static double gap_of(const packing_body *mobile, const packing_body *body, int dim,
                     packing_vec3 *normal)
{
  if (body->domain != NULL)
    return packing_body_wall_gap(mobile, body->domain, body->wall, normal);
  if (packing_i_pair_shape(mobile, body) != NULL) {
    *normal = differences(mobile, body, dim);
    return packing_body_gap(mobile, body);
  }
  const packing_vec3 apart = packing_i_sub(mobile->centre, body->centre);
  const double length = packing_i_norm(apart);
  *normal = length > 0 ? packing_i_scale(apart, 1 / length) : packing_i_vec(1, 0, 0);
  return length - (mobile->r + body->r);
}

void packing_i_touch_at(const packing_contact_task *task, packing_vec3 x,
                        packing_i_touch *touch)
{
  packing_body mobile = task->mobile;
  mobile.centre = x;
  touch->normal[0] = touch->normal[1] = packing_i_vec(0, 0, 0);
  touch->normal[2] = packing_i_vec(0, 0, 1);
  touch->gap[2] = 0;
  touch->worst = 0;
  for (int i = 0; i < task->dim; i++) {
    touch->gap[i] = gap_of(&mobile, &task->fixed[i], task->dim, &touch->normal[i]);
    const double size = fabs(touch->gap[i]);
    /* Not a number counts as infinite. */
    if (!(size <= touch->worst))
      touch->worst = size <= DBL_MAX ? size : HUGE_VAL;
  }
}

/* Cramer's rule; 0 where the three normals are all but dependent, as at a double root. */
static int newton(const packing_i_touch *touch, packing_vec3 *x)
{
  const packing_vec3 *n = touch->normal;
  const packing_vec3 c0 = packing_i_cross(n[1], n[2]), c1 = packing_i_cross(n[2], n[0]),
                     c2 = packing_i_cross(n[0], n[1]);
  const double det = packing_i_dot(n[0], c0);
  if (!(fabs(det) > 1e-7))
    return 0;
  const packing_vec3 sum =
      packing_i_add(packing_i_scale(c0, touch->gap[0]),
                    packing_i_add(packing_i_scale(c1, touch->gap[1]),
                                  packing_i_scale(c2, touch->gap[2])));
  *x = packing_i_sub(*x, packing_i_scale(sum, 1 / det));
  return 1;
}

packing_vec3 packing_i_touch_polish(const packing_contact_task *task, packing_vec3 x,
                                    packing_i_touch *touch)
{
  packing_i_touch_at(task, x, touch);
  for (int i = 0; i < POLISH_STEPS && touch->worst > 0; i++) {
    packing_vec3 next = x;
    packing_i_touch there;
    if (!newton(touch, &next))
      break;
    packing_i_touch_at(task, next, &there);
    if (!(there.worst < touch->worst))
      break;
    const int done = there.worst > 0.125 * touch->worst;
    x = next;
    *touch = there;
    if (done)
      break;
  }
  return x;
}

static double squares(const packing_i_touch *touch)
{
  return touch->gap[0] * touch->gap[0] + touch->gap[1] * touch->gap[1] +
         touch->gap[2] * touch->gap[2];
}

/* The step of (J'J + damping) step = -J'g, J the normals; by adjugates. */
static packing_vec3 damped_step(const packing_i_touch *touch, double damping)
{
  packing_vec3 row[3] = {{damping, 0, 0}, {0, damping, 0}, {0, 0, damping}};
  packing_vec3 right = {0, 0, 0};
  for (int i = 0; i < 3; i++) {
    const packing_vec3 n = touch->normal[i];
    row[0] = packing_i_add(row[0], packing_i_scale(n, n.x));
    row[1] = packing_i_add(row[1], packing_i_scale(n, n.y));
    row[2] = packing_i_add(row[2], packing_i_scale(n, n.z));
    right = packing_i_sub(right, packing_i_scale(n, touch->gap[i]));
  }
  const packing_vec3 c0 = packing_i_cross(row[1], row[2]),
                     c1 = packing_i_cross(row[2], row[0]),
                     c2 = packing_i_cross(row[0], row[1]);
  const double det = packing_i_dot(row[0], c0);
  const packing_vec3 sum = packing_i_add(
      packing_i_scale(c0, right.x),
      packing_i_add(packing_i_scale(c1, right.y), packing_i_scale(c2, right.z)));
  return packing_i_scale(sum, 1 / det);
}

int packing_i_touch_descend(const packing_contact_task *task, packing_vec3 *x)
{
  const double enough = packing_i_touch_tolerance(task);
  double damping = 0x1p-10;
  packing_i_touch here;
  packing_i_touch_at(task, *x, &here);
  for (int i = 0; i < DESCENT_STEPS && here.worst > 0.25 * enough; i++) {
    packing_i_touch there;
    const packing_vec3 next = packing_i_add(*x, damped_step(&here, damping));
    packing_i_touch_at(task, next, &there);
    const double before = squares(&here), after = squares(&there);
    if (there.worst < HUGE_VAL && after < before) {
      *x = next;
      here = there;
      /* At the bottom, and that is not 0: the bodies are too far apart. */
      if (before - after < standstill * before)
        break;
      damping *= 0x1p-4;
      if (damping < 0x1p-50)
        damping = 0x1p-50;
    } else {
      damping *= 8;
      if (damping > 0x1p30)
        break;
    }
  }
  *x = packing_i_touch_polish(task, *x, &here);
  return here.worst <= enough;
}
