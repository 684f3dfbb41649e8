/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Placing a particle in contact in one move (Perez Morales et al., 3.4.3, equations 4 to
 * 10): from c_0 = c_m + 2 R u along -u by the least of its directional distances to the
 * bodies. The place is that of the binary approach without its bisection. Where all miss,
 * or the first contact lies beyond c_m, there is no place.
 *
 * Cost: 3 directional distances a side. */
#include "touch_internal.h"

static int place_on_side(const packing_contact_task *task, int side, packing_vec3 *x)
{
  packing_i_touch_line line;
  if (!packing_i_touch_line_of(task, side, &line) || !line.is_free)
    return 0;
  const packing_body mobile = packing_i_touch_mobile(task, &line, 1);
  const packing_vec3 down = packing_i_scale(line.along, -1);
  double least = HUGE_VAL;
  for (int i = 0; i < task->dim; i++) {
    const double distance = packing_body_distance(&mobile, &task->fixed[i], &down);
    least = distance < least ? distance : least;
  }
  if (!(least <= line.length))
    return 0;
  *x = packing_i_add(mobile.centre, packing_i_scale(down, least));
  return 1;
}

static int place(void *user, const packing_contact_task *task, packing_vec3 centre[2])
{
  (void)user;
  return packing_i_touch_sides(task, place_on_side, centre);
}

const packing_contact_method *packing_contact_direct(void)
{
  static const packing_contact_method method = {
      .name = "direct",
      .reference =
          "Perez Morales et al., section 3.4.3, equations 4 to 10: direct approach",
      .exact = 0,
      .place = place,
  };
  return &method;
}
