/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sphere that touches four spheres (a pore), three in their plane (a constriction, or in two
 * dimensions a pore), or two on their line (a gap): equations 2 and 3 of the sequential
 * trilateration method. With d_i = p_i - p_1 the differences of |c - p_i| = R + r_i are linear,
 *
 *   d_i . c = (|d_i|^2 + r_1^2 - r_i^2) / 2 - R (r_i - r_1),    so c = u - R v,
 *
 * and the first equation leaves (|v|^2 - 1) R^2 - 2 (u . v + r_1) R + |u|^2 - r_1^2 = 0. For
 * equal radii v = 0 and R = |u| - r_1. The system is solved by cross products, three spheres with
 * their normal as a third row, which costs no more digits than the shape of the cell does. Roots
 * are taken as q / a and c / q with q of one sign, so nearly touching and nearly equal spheres lose
 * nothing. A root R > 0 touches all from outside: the equations say R + r_i > 0 is a distance. A
 * negative root is the sphere that encloses all. Lengths are scaled by a power of two first: no
 * product leaves the range of doubles. */
#include "measure/tangent.h"
#include "vec.h"

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  return packing_i_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                       a.x * b.y - a.y * b.x);
}

static double longest_edge(int count, const packing_vec3 *p)
{
  double longest = 0;
  for (int i = 0; i < count; i++)
    for (int j = 0; j < i; j++) {
      const double d = packing_i_norm(packing_i_sub(p[i], p[j]));
      longest = d > longest ? d : longest;
    }
  return longest;
}

/* A power of two near 1 / the largest coordinate difference or radius. */
static double unit_of(int count, const packing_vec3 *centre, const double *r)
{
  double most = r[0];
  int exponent;
  for (int i = 1; i < count; i++) {
    const packing_vec3 d = packing_i_sub(centre[i], centre[0]);
    most = fmax(fmax(most, r[i]), fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))));
  }
  (void)frexp(most, &exponent);
  return ldexp(1.0, -exponent);
}

/* Solves d_i . u = a_i for three rows; the determinant is given. */
static packing_vec3 solve(const packing_vec3 d[3], const double a[3], double det)
{
  const packing_vec3 s =
      packing_i_add(packing_i_scale(cross(d[1], d[2]), a[0]),
                    packing_i_add(packing_i_scale(cross(d[2], d[0]), a[1]),
                                  packing_i_scale(cross(d[0], d[1]), a[2])));
  return packing_i_vec(s.x / det, s.y / det, s.z / det);
}

/* Rows that two or three spheres lack: across them the centre does not move. */
static void complete(int count, packing_vec3 d[3], packing_vec3 *normal)
{
  if (count == 2) {
    *normal = packing_i_vec(-d[0].y, d[0].x, 0);
    d[1] = *normal;
    d[2] = cross(d[0], d[1]);
  } else {
    *normal = cross(d[0], d[1]);
    d[2] = *normal;
  }
}

int packing_i_tangency_set(packing_i_tangency *t, int count, const packing_vec3 *centre,
                           const double *r)
{
  const double unit = unit_of(count, centre, r);
  packing_vec3 d[3], p[4] = {{0, 0, 0}};
  double a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
  const double r0 = r[0] * unit;
  for (int i = 1; i < count; i++) {
    const double ri = r[i] * unit;
    p[i] = packing_i_scale(packing_i_sub(centre[i], centre[0]), unit);
    d[i - 1] = p[i];
    b[i - 1] = ri - r0;
    a[i - 1] = (packing_i_dot(p[i], p[i]) - b[i - 1] * (ri + r0)) / 2;
  }
  t->normal = packing_i_vec(0, 0, 0);
  if (count < 4)
    complete(count, d, &t->normal);
  const double det = packing_i_dot(d[0], cross(d[1], d[2]));
  const double edge = longest_edge(count, p);
  if (!(fabs(det) > 0))
    return 0;
  t->height = count == 4   ? fabs(det) / (edge * edge * edge)
              : count == 3 ? sqrt(fabs(det)) / (edge * edge)
                           : 1;
  t->origin = centre[0];
  t->r = r[0];
  t->u = packing_i_scale(solve(d, a, det), 1 / unit);
  t->v = solve(d, b, det);
  return packing_i_vec_finite(t->u) && packing_i_vec_finite(t->v);
}

int packing_i_tangency_radii(const packing_i_tangency *t, double radii[2])
{
  int exponent, count = 0;
  (void)frexp(fmax(t->r, fmax(fabs(t->u.x), fmax(fabs(t->u.y), fabs(t->u.z)))),
              &exponent);
  const double unit = ldexp(1.0, -exponent), r = t->r * unit;
  const packing_vec3 u = packing_i_scale(t->u, unit);
  const double a = packing_i_dot(t->v, t->v) - 1, b = -(packing_i_dot(u, t->v) + r);
  const double length = packing_i_norm(u), c = (length - r) * (length + r);
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0))
    return 0;
  const double q = -(b + copysign(sqrt(discriminant), b));
  const double root[2] = {a != 0 ? q / a : 0, q != 0 ? c / q : 0};
  for (int i = 0; i < 2; i++)
    if (root[i] > 0 && isfinite(root[i]))
      radii[count++] = root[i] / unit;
  if (count == 2 && radii[0] > radii[1]) {
    const double larger = radii[0];
    radii[0] = radii[1];
    radii[1] = larger;
  }
  return count;
}

packing_vec3 packing_i_tangency_centre(const packing_i_tangency *t, double radius)
{
  return packing_i_add(t->origin, packing_i_sub(t->u, packing_i_scale(t->v, radius)));
}
