/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The line of the approximate methods (Perez Morales et al., 3.4.3): through the mean c_m
 * of the centres, along the normal u of the segment (2D) or triangle (3D) of the centres,
 * from c_0 = c_m + 2 R u to c_m, R the largest circumscribed radius of all; at c_0 the
 * mobile particle is free of all fixed ones, for u is normal to c_m - c_i.
 *
 * The paper has no walls. Here the way into a wall stands for the side of the triangle
 * that leads to its centre, so that u runs along the wall, and the line is moved along
 * the wall's normal until the mobile particle, on its way from c_0 to c_m, slides along
 * the wall: it touches the wall all the time where that is flat, at one end where it is
 * curved. (The gap is 2^-40 of the mobile radius and not 0, lest rounding make it an
 * overlap.) u stays normal to the particles' c_m - c_i, so that c_0 is free of them as
 * before. Where a curved wall leaves no room for a line of that length, a half or a
 * quarter of it serves if its end is free. Constant time. */
#include "touch_internal.h"
#include <float.h>

enum { LIFTS = 24, SHORTEST = 4 };

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

/* The walls as they are seen from a point. */
static rails rails_at(const packing_contact_task *task, packing_vec3 mean,
                      packing_vec3 from)
{
  rails r = {.count = 0};
  packing_body mobile = task->mobile;
  mobile.centre = from;
  const double rounding = 16 * DBL_EPSILON * packing_i_touch_extent(task);
  r.slack = 0x1p-40 * mobile.r > rounding ? 0x1p-40 * mobile.r : rounding;
  for (int i = 0; i < task->dim; i++) {
    const packing_body *wall = &task->fixed[i];
    if (wall->domain == NULL)
      continue;
    packing_vec3 *normal = &r.normal[r.count];
    const double gap = packing_body_wall_gap(&mobile, wall->domain, wall->wall, normal);
    const double moved = packing_i_dot(*normal, packing_i_sub(mean, from));
    r.wanted[r.count] = r.slack - (gap + moved);
    r.wall[r.count++] = wall;
  }
  return r;
}

/* From the first particle to body `index`, or into that wall. */
static packing_vec3 way_to(const packing_contact_task *task, int index, const rails *r)
{
  if (index == 2 && task->dim == 2)
    return packing_i_vec(0, 0, 1);
  const packing_body *body = &task->fixed[index];
  if (body->domain == NULL)
    return packing_i_sub(body->centre, task->fixed[packing_i_touch_first(task)].centre);
  return packing_i_scale(r->normal[r->count == 2 && r->wall[1] == body], -1);
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

/* How much further along its normal a wall wants the line, for the particle at one end to
 * come free of it. */
static double missing_at(const packing_body *end, const rails *r, int k)
{
  packing_vec3 normal;
  const double gap =
      packing_body_wall_gap(end, r->wall[k]->domain, r->wall[k]->wall, &normal);
  if (gap >= 0.5 * r->slack)
    return 0;
  const double cosine = packing_i_dot(normal, r->normal[k]);
  return (r->slack - gap) / (cosine > 0.25 ? cosine : 0.25);
}

/* Moves the line until neither end protrudes from a wall. */
static int lift(const packing_contact_task *task, packing_vec3 mean, rails start,
                packing_i_touch_line *line)
{
  rails moved = start, *r = &moved;
  for (int step = 0; step < LIFTS; step++) {
    line->middle = packing_i_add(mean, lift_of(r));
    const packing_body near = packing_i_touch_mobile(task, line, 0),
                       far = packing_i_touch_mobile(task, line, 1);
    double most = 0;
    for (int k = 0; k < r->count; k++) {
      const double one = missing_at(&near, r, k), two = missing_at(&far, r, k);
      const double more = one > two ? one : two;
      r->wanted[k] += more;
      most = more > most ? more : most;
    }
    if (!(most > 0))
      return packing_i_vec_finite(line->middle);
  }
  return 0;
}

static int free_of_particles(const packing_contact_task *task, const packing_body *mobile)
{
  for (int i = 0; i < task->dim; i++)
    if (task->fixed[i].domain == NULL && packing_body_overlap(mobile, &task->fixed[i]))
      return 0;
  return 1;
}

/* The line of the paper's length, or what of it a narrow container leaves. */
static void set_length(const packing_contact_task *task, packing_vec3 mean,
                       const rails *r, double length, packing_i_touch_line *line)
{
  line->is_free = 0;
  for (int part = 1; part <= SHORTEST && !line->is_free; part *= 2) {
    line->length = length / part;
    if (!lift(task, mean, *r, line))
      continue;
    const packing_body far = packing_i_touch_mobile(task, line, 1);
    line->is_free = part == 1 || free_of_particles(task, &far);
  }
}

int packing_i_touch_line_of(const packing_contact_task *task, int side,
                            packing_i_touch_line *line)
{
  double largest;
  const packing_vec3 mean = mean_of_particles(task, &largest);
  packing_vec3 from = mean;
  if (!packing_i_touch_view(task, &from))
    return 0;
  const rails r = rails_at(task, mean, from);
  const int first = packing_i_touch_first(task);
  const packing_vec3 one = way_to(task, (first + 1) % 3, &r),
                     two = way_to(task, (first + 2) % 3, &r);
  const packing_vec3 normal = packing_i_cross(one, two);
  const double length = packing_i_norm(normal);
  if (!(length > 1e-9 * packing_i_norm(one) * packing_i_norm(two)))
    return 0;
  line->along = packing_i_scale(normal, side / length);
  set_length(task, mean, &r, 2 * largest, line);
  return 1;
}
