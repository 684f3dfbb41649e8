/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The part of a ball that a surface encloses, in closed form. Seen from the centre, the ball is cut
 * into cones over the triangles: where a triangle is within the ball, its cone ends on the
 * triangle's plane (h A / 3, h the height of the centre over the plane, A the area), else on the
 * sphere (r^3 / 3 times the solid angle). All solid angles together are 4 pi inside and 0 outside,
 * so triangles that miss the ball need no look:
 *
 *   V = [inside] 4 pi r^3 / 3 + sum_t s_t (h_t A_t - r^3 W_t) / 3,
 *
 * A_t and W_t area and solid angle of what triangle and ball have in common, s_t = 1 where the
 * centre is on the inner side of the plane, else -1. A_t and W_t are sums over the edges, seen from
 * the foot of the centre: along an edge at distance q, with t from the foot's own foot,
 *   dA = q dt / 2,  dW = d(atan(t / q) - atan(h t / (q sqrt(h^2 + q^2 + t^2)))),
 * and along the circle of radius R = sqrt(r^2 - h^2)
 *   dA = R^2 dphi / 2,  dW = (1 - h / r) dphi.
 * On the surface, where the cones have no height and edges no side, the centre is moved by some
 * 1e-8 r, in no direction that meshes are likely to have. */
#include "mesh/surface_internal.h"
#include <float.h>

typedef struct job {
  const packing_i_surface *surface;
  packing_vec3 centre;
  double r;
  double sum; /* of s (h A / r^3 - W), times 1 / 3 */
  size_t count;
} job;

/* Area and solid angle, lengths in units of the ball's radius. */
typedef struct content {
  double area, angle;
} content;

static double angle_of_flat(double h, double q, double t)
{
  return atan2(t, q) - atan2(h * t, q * sqrt(h * h + q * q + t * t));
}

/* Between the foot and the edge from p to q, seen from the foot; n is the normal. */
static content over_edge(packing_vec3 p, packing_vec3 q, packing_vec3 n, double h)
{
  content c = {0, 0};
  const packing_vec3 e = packing_i_sub(q, p);
  const double length = packing_i_norm(e);
  const double off = packing_i_dot(n, packing_i_cross(p, q)) / length;
  const double from = packing_i_dot(p, e) / length, to = packing_i_dot(q, e) / length;
  const double d = fabs(off), circle2 = (1 - h) * (1 + h);
  double sector = atan2(to, d) - atan2(from, d);
  if (off == 0)
    return c;
  const double chord2 = circle2 - d * d;
  const double half = chord2 > 0 ? sqrt(chord2) : 0;
  const double a = fmax(from, -half), b = fmin(to, half);
  if (a < b) {
    sector -= atan2(b, d) - atan2(a, d);
    c.area = 0.5 * d * (b - a);
    c.angle = angle_of_flat(h, d, b) - angle_of_flat(h, d, a);
  }
  c.area += 0.5 * circle2 * sector;
  c.angle += (1 - h) * sector;
  if (off < 0) {
    c.area = -c.area;
    c.angle = -c.angle;
  }
  return c;
}

static int add_triangle(void *user, uint32_t t)
{
  job *j = user;
  const packing_i_facet *f = &j->surface->facet[j->surface->slot[t]];
  const packing_vec3 n = packing_i_mesh_vec(f->normal);
  packing_vec3 corner[3];
  for (int i = 0; i < 3; i++)
    corner[i] = packing_i_scale(
        packing_i_sub(packing_i_mesh_vec(f->corner[i]), j->centre), 1 / j->r);
  const double over = -packing_i_dot(n, corner[0]), h = fabs(over);
  content all = {0, 0};
  if (h >= 1)
    return 1;
  for (int i = 0; i < 3; i++)
    corner[i] = packing_i_add(corner[i], packing_i_scale(n, over));
  for (int i = 0; i < 3; i++) {
    const content c = over_edge(corner[i], corner[(i + 1) % 3], n, h);
    all.area += c.area;
    all.angle += c.angle;
  }
  j->sum += (over <= 0 ? 1 : -1) * (h * all.area - all.angle) / 3;
  j->count++;
  return 1;
}

double packing_i_surface_ball(const packing_i_surface *surface,
                              const packing_vec3 *centre, double r, double *error)
{
  static const double least = 1e-8; /* distance from the surface, in radii */
  job j = {.surface = surface, .centre = *centre, .r = r};
  packing_i_nearest nearest = packing_i_surface_nearest(surface, centre, HUGE_VAL, 0);
  const int is_close = nearest.square < least * least * r * r;
  if (is_close) {
    const packing_vec3 by = {1.1307 * least * r, 0.5911 * least * r, 1.6715 * least * r};
    j.centre = packing_i_add(*centre, by);
    nearest = packing_i_surface_nearest(surface, &j.centre, HUGE_VAL, 0);
  }
  const int inside = packing_i_surface_is_inside(surface, &nearest);
  const double lo[3] = {j.centre.x - r, j.centre.y - r, j.centre.z - r};
  const double hi[3] = {j.centre.x + r, j.centre.y + r, j.centre.z + r};
  packing_i_mesh_in_box(surface->mesh, lo, hi, add_triangle, &j);
  const double ball = packing_i_ball_volume(3, r), cube = r * r * r;
  const double volume = (inside ? ball : 0) + j.sum * cube;
  *error =
      (64 * DBL_EPSILON * (double)(j.count + 1) + (is_close ? 16 * least : 0)) * ball;
  return fmin(fmax(volume, 0), ball);
}
