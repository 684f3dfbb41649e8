/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The line of the approximate methods (seed 001, 3.4.3): through the mean c_m of the centres,
 * along the normal u of the segment (2D) or triangle (3D) of the centres, from c_0 = c_m + 2 R u
 * to c_m, R the largest circumscribed radius of all; at c_0 the mobile particle is free of all
 * fixed ones, for u is normal to c_m - c_i.
 *
 * The paper has no walls. Here the way into a wall stands for the side of the triangle that leads
 * to its centre, so that u runs along the wall, and the line is moved along the wall's normal
 * until the mobile particle, on its way from c_0 to c_m, slides along the wall: it touches the
 * wall all the time where that is flat, at one end where it is curved. (The gap is 2^-40 of the
 * mobile radius and not 0, lest rounding make it an overlap.) u stays normal to the particles'
 * c_m - c_i, so that c_0 is free of them as before. Constant time. */
#include "touch_internal.h"
#include <float.h>

enum { LIFTS = 24 };

static packing_vec3 mean_of_particles(const packing_contact_task *task, double *largest)
{
  packing_vec3 sum = {0, 0, 0};
  int count = 0;
  *largest = task->mobile.r;
  for (int i = 0; i < task->dim; i++) {
    const packing_body *body = &task->fixed[i];
    if (body->domain != NULL)
      continue;
    sum = packing_i_add(sum, body->centre);
    count++;
    *largest = body->r > *largest ? body->r : *largest;
  }
  return packing_i_scale(sum, 1.0 / count);
}

/* The walls of a task, with their normals where the line is sought. */
typedef struct rails {
  int count;
  const packing_body *wall[2];
  packing_vec3 normal[2];
  double wanted[2]; /* how far along each normal the line is to be moved */
  double slack;
} rails;

/* Returns 0 where there is no such wall. */
static int rails_at(const packing_contact_task *task, packing_vec3 mean, rails *r)
{
  packing_body mobile = task->mobile;
  mobile.centre = mean;
  r->count = 0;
  const double rounding = 16 * DBL_EPSILON * packing_i_touch_extent(task);
  r->slack = 0x1p-40 * mobile.r > rounding ? 0x1p-40 * mobile.r : rounding;
  for (int i = 0; i < task->dim; i++) {
    if (task->fixed[i].domain == NULL)
      continue;
    const int k = r->count++;
    r->wall[k] = &task->fixed[i];
    r->wanted[k] = r->slack - packing_body_wall_gap(&mobile, r->wall[k]->domain,
                                                    r->wall[k]->wall, &r->normal[k]);
    if (!isfinite(r->wanted[k]))
      return 0;
  }
  return 1;
}

/* The shortest way that goes as far along each normal as is wanted. */
static packing_vec3 lift_of(const rails *r)
{
  if (r->count == 0)
    return packing_i_vec(0, 0, 0);
  if (r->count == 1)
    return packing_i_scale(r->normal[0], r->wanted[0]);
  const double cosine = packing_i_dot(r->normal[0], r->normal[1]);
  const double det = 1 - cosine * cosine;
  return packing_i_add(
      packing_i_scale(r->normal[0], (r->wanted[0] - cosine * r->wanted[1]) / det),
      packing_i_scale(r->normal[1], (r->wanted[1] - cosine * r->wanted[0]) / det));
}

/* Moves the line until neither end protrudes from a wall. */
static int lift(const packing_contact_task *task, packing_vec3 mean, rails *r,
                packing_i_touch_line *line)
{
  for (int step = 0; step < LIFTS; step++) {
    line->middle = packing_i_add(mean, lift_of(r));
    const packing_body near = packing_i_touch_mobile(task, line, 0),
                       far = packing_i_touch_mobile(task, line, 1);
    int free = 1;
    for (int k = 0; k < r->count; k++) {
      const double one =
          packing_body_wall_gap(&near, r->wall[k]->domain, r->wall[k]->wall, NULL);
      const double two =
          packing_body_wall_gap(&far, r->wall[k]->domain, r->wall[k]->wall, NULL);
      const double least = one < two ? one : two;
      if (least >= 0.5 * r->slack)
        continue;
      r->wanted[k] += r->slack - least;
      free = 0;
    }
    if (free)
      return packing_i_vec_finite(line->middle);
  }
  return 0;
}

int packing_i_touch_line_of(const packing_contact_task *task, int side,
                            packing_i_touch_line *line)
{
  double largest;
  const packing_vec3 mean = mean_of_particles(task, &largest);
  const int first = packing_i_touch_first(task);
  const packing_vec3 from = task->fixed[first].centre;
  rails r;
  if (!rails_at(task, mean, &r))
    return 0;
  packing_vec3 way[2];
  for (int k = 0; k < 2; k++) {
    const int index = (first + 1 + k) % 3;
    const int wall = index < task->dim && task->fixed[index].domain != NULL;
    way[k] = packing_i_touch_towards(task, index, wall ? mean : from);
  }
  const packing_vec3 normal = packing_i_cross(way[0], way[1]);
  const double length = packing_i_norm(normal);
  if (!(length > 1e-9 * packing_i_norm(way[0]) * packing_i_norm(way[1])))
    return 0;
  line->along = packing_i_scale(normal, side / length);
  line->length = 2 * largest;
  return lift(task, mean, &r, line);
}
