/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Placing a particle in contact by bisection (Perez Morales et al., 3.4.3, equation 3):
 * on the line from c_m (t = 0) to c_0 = c_m + 2 R u (t = 1) f(t) is 1 where the particle
 * is free of all bodies, and t* = inf {t : f = 1 on [t, 1]}. Nothing but "do they
 * overlap" is asked of the shapes. At least one body is touched, to the tolerance of
 * 2^-40 of the mobile radius.
 *
 * The paper takes f for rising. Of spheres it is; if they do not overlap at t = 0 the
 * particle slips through between them, touches none, and there is no place. Other shapes
 * are watched from t = 1 down in steps of an eighth of the smallest radius (at most 4096
 * of them), and the last interval is halved. The end that is free is taken: what is
 * returned has been seen to overlap nothing.
 *
 * Cost: 3 tests of overlap for each of some 42 halvings (and each step) and side. */
#include "touch_internal.h"

enum { STEPS_MOST = 4096 };

static const double tolerance = 0x1p-40; /* of the mobile radius */

static int is_free(const packing_contact_task *task, const packing_i_touch_line *line,
                   double t)
{
  const packing_body mobile = packing_i_touch_mobile(task, line, t);
  for (int i = 0; i < task->dim; i++)
    if (packing_body_overlap(&mobile, &task->fixed[i]))
      return 0;
  return 1;
}

/* How many steps to go down in; 1: all is convex. */
static int steps_of(const packing_contact_task *task, const packing_i_touch_line *line)
{
  double least = task->mobile.r;
  int convex = task->mobile.shape == NULL;
  for (int i = 0; i < task->dim; i++) {
    const packing_body *body = &task->fixed[i];
    if (body->domain != NULL)
      continue;
    convex = convex && body->shape == NULL;
    least = body->r < least ? body->r : least;
  }
  const double steps = ceil(8 * line->length / least);
  return convex ? 1 : steps < STEPS_MOST ? (int)steps : STEPS_MOST;
}

/* The last step seen free, and the next one, at which something is overlapped. */
static int first_overlap(const packing_contact_task *task,
                         const packing_i_touch_line *line, double *taken, double *free)
{
  const int steps = steps_of(task, line);
  *free = 1;
  if (!is_free(task, line, 1))
    return 0;
  for (int i = steps - 1; i >= 0; i--) {
    *taken = (double)i / steps;
    if (!is_free(task, line, *taken))
      return 1;
    *free = *taken;
  }
  return 0;
}

static int place_on_side(const packing_contact_task *task, int side, packing_vec3 *x)
{
  packing_i_touch_line line;
  double lo, hi;
  if (!packing_i_touch_line_of(task, side, &line) || !line.is_free ||
      !first_overlap(task, &line, &lo, &hi))
    return 0;
  const double enough = tolerance * task->mobile.r / line.length;
  while (hi - lo > enough) {
    const double middle = 0.5 * (lo + hi);
    if (!(middle > lo && middle < hi))
      break;
    if (is_free(task, &line, middle))
      hi = middle;
    else
      lo = middle;
  }
  *x = packing_i_touch_mobile(task, &line, hi).centre;
  return 1;
}

static int place(void *user, const packing_contact_task *task, packing_vec3 centre[2])
{
  (void)user;
  return packing_i_touch_sides(task, place_on_side, centre);
}

const packing_contact_method *packing_contact_binary(void)
{
  static const packing_contact_method method = {
      .name = "binary",
      .reference = "Perez Morales et al., section 3.4.3, equation 3: binary approach",
      .exact = 0,
      .place = place,
  };
  return &method;
}
