/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Placing a particle in contact by intersecting wrappers (Perez Morales et al., 3.4.1):
 * the wrapper of a body is the surface on which the mobile centre lies while the
 * particles touch. That of a sphere is a sphere of radius r + r_i, that of a flat wall a
 * plane at the distance r.
 *
 * Departure: three wrappers are not intersected one after the other. Relative to one of
 * the spheres all others are linear in the centre (front_curve.h), so that spheres and
 * flat walls are one case, and the two roots come from one square root. In the plane z =
 * 0 is the third body. A curved wall is taken as the plane that touches it where the
 * particle does; where that is comes out of repeating this, and Newton's method on the
 * gaps ends it. Newton's steps take away what rounding left in the closed form too.
 *
 * Cost: some 200 operations and 9 roots; with a curved wall up to 12 times as much. */
#include "front_curve.h"
#include "touch_internal.h"

enum { LINEARISATIONS = 12 };

/* A squared height of this share of the squared reach counts as 0: of it rounding leaves
 * no more, and gaps are then no larger than 2e-15 of the reach. */
static const double double_root = 0x1p-48;

/* The task as its first sphere sees it. */
typedef struct view {
  const packing_contact_task *task;
  const packing_body *sphere;
  int other[2];
} view;

static view view_of(const packing_contact_task *task)
{
  const int first = packing_i_touch_first(task);
  const view v = {task, &task->fixed[first], {(first + 1) % 3, (first + 2) % 3}};
  return v;
}

/* Body k of the others, walls as they are near the mobile centre c (from the sphere's
 * centre). Returns 0 where there is no such wall. */
static int body_of(const view *v, int k, packing_vec3 c, packing_i_front_body *body)
{
  const int index = v->other[k];
  if (index == 2 && v->task->dim == 2) {
    *body = packing_i_front_plane();
    return 1;
  }
  const packing_body *other = &v->task->fixed[index];
  if (other->domain == NULL) {
    *body = packing_i_front_sphere(packing_i_sub(other->centre, v->sphere->centre),
                                   other->r, v->sphere->r);
    return 1;
  }
  packing_body mobile = v->task->mobile;
  packing_vec3 normal;
  mobile.centre = packing_i_add(v->sphere->centre, c);
  const double gap = packing_body_wall_gap(&mobile, other->domain, other->wall, &normal);
  *body = packing_i_front_wall(normal, gap + mobile.r - packing_i_dot(normal, c));
  return isfinite(gap);
}

/* The two places that touch the sphere and two linear bodies; one where they all but
 * meet. */
static int solve(const view *v, const packing_i_front_body body[2], int nearest,
                 packing_vec3 c[2])
{
  packing_i_front_curve curve;
  const double r = v->task->mobile.r, reach = v->sphere->r + r;
  if (!packing_i_front_curve_init(v->sphere->r, &body[0], &body[1], 1, &curve))
    return 0;
  const double s2 = curve.s2[0] + r * (curve.s2[1] + r * curve.s2[2]);
  const packing_vec3 foot = packing_i_add(curve.base, packing_i_scale(curve.slope, r));
  c[0] = c[1] = foot;
  if (!(s2 >= -double_root * reach * reach) && !nearest)
    return 0;
  if (!(s2 > double_root * reach * reach))
    return 1;
  const packing_vec3 height = packing_i_scale(curve.side, sqrt(s2));
  c[0] = packing_i_add(foot, height);
  c[1] = packing_i_sub(foot, height);
  return 2;
}

static int place_among_spheres(const view *v, packing_vec3 centre[2])
{
  packing_i_front_body body[2];
  packing_vec3 c[2];
  packing_i_touch touch;
  const packing_vec3 nowhere = {0, 0, 0};
  body_of(v, 0, nowhere, &body[0]);
  body_of(v, 1, nowhere, &body[1]);
  const int count = solve(v, body, 0, c);
  for (int i = 0; i < count; i++)
    centre[i] =
        packing_i_touch_polish(v->task, packing_i_add(v->sphere->centre, c[i]), &touch);
  return count;
}

/* The place on a side, the walls made flat again and again where it came to lie.
 * Meanwhile the planes may have no solution; then the nearest approach serves. */
static int place_at_walls(const packing_contact_task *task, int side,
                          packing_vec3 *centre)
{
  const view v = view_of(task);
  packing_vec3 from = v.sphere->centre;
  if (!packing_i_touch_view(task, &from))
    return 0;
  packing_vec3 at = packing_i_sub(from, v.sphere->centre);
  const double step = 1e-3 * task->mobile.r;
  for (int i = 0; i < LINEARISATIONS; i++) {
    packing_i_front_body body[2];
    packing_vec3 c[2];
    if (!body_of(&v, 0, at, &body[0]) || !body_of(&v, 1, at, &body[1]) ||
        !solve(&v, body, 1, c))
      return 0;
    const double moved = packing_i_norm(packing_i_sub(c[side < 0], at));
    at = c[side < 0];
    if (moved <= step)
      break;
  }
  *centre = packing_i_add(v.sphere->centre, at);
  return packing_i_touch_descend(task, centre);
}

static int place(void *user, const packing_contact_task *task, packing_vec3 centre[2])
{
  (void)user;
  if (!packing_i_touch_all_round(task))
    return 0;
  if (packing_i_touch_has_walls(task))
    return packing_i_touch_sides(task, place_at_walls, centre);
  const view v = view_of(task);
  return place_among_spheres(&v, centre);
}

const packing_contact_method *packing_contact_wrappers(void)
{
  static const packing_contact_method method = {
      .name = "wrappers",
      .reference = "Perez Morales et al., section 3.4.1: intersection of the wrappers",
      .exact = 1,
      .place = place,
  };
  return &method;
}
