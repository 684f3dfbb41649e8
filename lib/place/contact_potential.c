/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Placing a particle in contact by minimising a potential (Perez Morales et al., 3.4.2,
 * equation 2): the centre x for which the sum of |gap(M_x, F_i)| is least; it is in
 * contact with all bodies where that is 0. Nothing but the gaps is asked of the shapes.
 *
 * Departure: the sum of absolute values has a kink just where the solution is, and
 * minimisers that follow its gradient stop beside it. Here the sum of squares is
 * minimised, which has the same zeros and none of the kinks, by Levenberg and Marquardt's
 * method, whose last steps are Newton's on the gaps. A place counts where every gap is at
 * most 1e-12 of the mobile radius (or 8 rounding units). Each side is started where
 * spheres around the bodies would stop a particle that comes along the line of section
 * 3.4.3, and above the smallest of them; with walls and other shapes also near c_m.
 *
 * Cost: 5 to 20 times 3 gaps a start, 7 times as many for shapes without gradients. */
#include "touch_internal.h"

/* Where, as a share of the line, circumscribed spheres would stop the particle. */
static double stop_of(const packing_contact_task *task, const packing_i_touch_line *line)
{
  double most = 0;
  for (int i = 0; i < task->dim; i++) {
    const packing_body *body = &task->fixed[i];
    if (body->domain != NULL)
      continue;
    const packing_vec3 apart = packing_i_sub(line->middle, body->centre);
    const double reach = task->mobile.r + body->r;
    const double height2 = reach * reach - packing_i_dot(apart, apart);
    if (height2 > 0 && sqrt(height2) > most)
      most = sqrt(height2);
  }
  return most / line->length;
}

/* On which side of the bodies a place lies, the middle being on both. */
static int is_on_side(const packing_i_touch_line *line, packing_vec3 x, double r)
{
  return packing_i_dot(packing_i_sub(x, line->middle), line->along) >= -0x1p-22 * r;
}

/* Above the smallest of the particles: far from the middle where sizes differ much. */
static packing_vec3 above_smallest(const packing_contact_task *task,
                                   const packing_i_touch_line *line)
{
  const packing_body *least = &task->fixed[packing_i_touch_first(task)];
  for (int i = 0; i < task->dim; i++)
    if (task->fixed[i].domain == NULL && task->fixed[i].r < least->r)
      least = &task->fixed[i];
  return packing_i_add(least->centre,
                       packing_i_scale(line->along, least->r + task->mobile.r));
}

/* Walls and other shapes than spheres have one more start: of 4316 places of clusters it
 * finds the last 11. */
static int place_on_side(const packing_contact_task *task, int side, packing_vec3 *x)
{
  packing_i_touch_line line;
  if (!packing_i_touch_line_of(task, side, &line))
    return 0;
  const double near = 0.125 * task->mobile.r / line.length;
  const packing_vec3 start[] = {
      packing_i_touch_mobile(task, &line, stop_of(task, &line)).centre,
      above_smallest(task, &line), packing_i_touch_mobile(task, &line, near).centre};
  const int simple = packing_i_touch_all_round(task) && !packing_i_touch_has_walls(task);
  const int starts = simple ? 2 : 3;
  for (int i = 0; i < starts; i++) {
    *x = start[i];
    if (packing_i_touch_descend(task, x) && is_on_side(&line, *x, task->mobile.r))
      return 1;
  }
  return 0;
}

/* Whether some pair is too far apart for the particle to reach both. */
static int is_hopeless(const packing_contact_task *task)
{
  const double across = 2 * task->mobile.r;
  for (int i = 1; i < task->dim; i++)
    for (int j = 0; j < i; j++) {
      const packing_body *a = &task->fixed[i], *b = &task->fixed[j];
      if (a->domain != NULL || b->domain != NULL)
        continue;
      const double apart = packing_i_norm(packing_i_sub(a->centre, b->centre));
      if (apart > (a->r + b->r + across) * (1 + 0x1p-40))
        return 1;
    }
  return 0;
}

static int place(void *user, const packing_contact_task *task, packing_vec3 centre[2])
{
  (void)user;
  return is_hopeless(task) ? 0 : packing_i_touch_sides(task, place_on_side, centre);
}

const packing_contact_method *packing_contact_potential(void)
{
  static const packing_contact_method method = {
      .name = "potential",
      .reference =
          "Perez Morales et al., section 3.4.2, equation 2: potential minimisation",
      .exact = 1,
      .place = place,
  };
  return &method;
}
