/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Walls of the pocket front. A wall is the plane through its nearest point: exact for flat walls;
 * on curved ones the plane is moved to where the particle is until it stays. Its body is scaled by
 * the mean radius, so that rooms of walls and spheres compare. */
#include "front_pockets.h"

/* Distance and normal are of the point c; the body is about the origin. */
static packing_i_front_body body_of(const packing_i_pockets *p,
                                    const packing_i_near_wall *wall, packing_vec3 c)
{
  const packing_i_front_body body = {
      packing_i_scale(wall->normal, -p->mean_r),
      p->mean_r * (wall->distance - packing_i_dot(wall->normal, c)), -p->mean_r};
  return body;
}

int packing_i_front_wall_body(const packing_i_pockets *p, const packing_vec3 *origin,
                              packing_vec3 c, double r, uint32_t *number,
                              packing_i_front_body *body)
{
  const uint32_t wall = *number & ~PACKING_I_FRONT_WALL;
  if (wall == PACKING_I_FRONT_PLANE) {
    *body = packing_i_front_plane();
    body->p.z = p->mean_r;
    return 1;
  }
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 point = packing_i_add(*origin, c);
  const int count = packing_i_domain_near_walls(p->domain, &point, 2 * p->max_r, near);
  const packing_i_near_wall *best = NULL;
  for (int n = 0; n < count && (best == NULL || (uint32_t)best->wall != wall); n++)
    if (best == NULL || (uint32_t)near[n].wall == wall ||
        fabs(near[n].distance - r) < fabs(best->distance - r))
      best = near + n;
  if (best == NULL)
    return 0;
  *number = PACKING_I_FRONT_WALL | (uint32_t)best->wall;
  *body = body_of(p, best, c);
  return 1;
}

static void add(packing_i_front_halo *halo, const packing_i_front_body *body,
                uint32_t wall)
{
  const size_t n = halo->count++;
  halo->x[n] = body->p.x;
  halo->y[n] = body->p.y;
  halo->z[n] = body->p.z;
  halo->a[n] = body->a;
  halo->b[n] = body->b;
  halo->r[n] = HUGE_VAL;
  halo->id[n] = PACKING_I_FRONT_WALL | wall;
}

int packing_i_front_walls_gather(const packing_i_pockets *p, const packing_vec3 *origin,
                                 packing_vec3 c, double reach, packing_i_front_halo *halo)
{
  if (halo->count + PACKING_I_NEAR_WALLS + 1 > halo->capacity)
    return 0;
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 point = packing_i_add(*origin, c);
  const int count = packing_i_domain_near_walls(p->domain, &point, reach, near);
  for (int n = 0; n < count; n++) {
    const packing_i_front_body body = body_of(p, near + n, c);
    add(halo, &body, (uint32_t)near[n].wall);
  }
  return 1;
}

int packing_i_front_holds(const packing_i_pockets *p, const packing_vec3 *c, double r)
{
  return packing_i_domain_keeps_whole(p->domain, c, r - p->touch);
}
