/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The volume that a ball and an endless cylinder share, by complete elliptic integrals (as in
 * F. Lamarche, C. Leroy, Comput. Phys. Commun. 59, 1990, p. 359, derived afresh here).
 *
 * Chords parallel to the axis, summed over rings round the ball's centre and integrated by parts,
 * give with s the square of a ring's radius, a = (R - d)^2 and b = (R + d)^2
 *
 *     V = V0 - 2/3 int_a^min(b, r^2) (r^2 - s)^2 (s + R^2 - d^2) / (s sqrt(P)) ds,
 *     P = (s - a) (b - s) (r^2 - s),
 *
 * where V0 is the ball when the axis is nearer than R, nothing when it is farther, half of it in
 * between. The four powers of s give four integrals: those of 1, s and 1/s go with
 * s = a cos^2 + min(b, r^2) sin^2 over to cel of R. Bulirsch (Numer. Math. 13, 1969, p. 305),
 * that of s^2 follows as sqrt(P) vanishes at both ends. The error is some roundings of the ball, times
 * R / r where that is large. Constant time. */
#include "domain_kinds.h"
#include <float.h>

/* int_0^pi/2 (a cos^2 + b sin^2) / ((cos^2 + p sin^2) sqrt(cos^2 + k^2 sin^2)), k, p > 0. */
static double cel(double k, double p, double a, double b)
{
  double e = k, m = 1;
  p = sqrt(p);
  b /= p;
  for (;;) {
    const double f = a, g = e / p, before = m;
    a += b / p;
    b = 2 * (b + f * g);
    p += g;
    m += k;
    if (fabs(before - k) <= 1e-8 * before)
      return 0.5 * PACKING_I_PI * (b + a * m) / (m * (m + p));
    k = 2 * sqrt(e);
    e = k * m;
  }
}

/* In units of the ball's radius: what cylinder R at distance d leaves of a ball of radius 1. */
static double share(double radius, double d)
{
  const double a = (radius - d) * (radius - d), b = (radius + d) * (radius + d);
  const double c = (radius - d) * (radius + d);
  const double near = b < 1 ? b : 1, far = b < 1 ? 1 : b;
  /* Where both are one, 1 and s have infinite integrals, whose sum is finite. */
  const double k = sqrt(fmax((far - near) / (far - a), 1e-24));
  const double scale = 2 / sqrt(far - a);
  const double j0 = scale * cel(k, 1, 1, 1), j1 = scale * cel(k, 1, a, near);
  const double j2 =
      (2 * (a + near + far) * j1 - (a * near + near * far + far * a) * j0) / 3;
  const double j = a > 0 ? scale * (c / a) * cel(k, near / a, 1, 1) : 0;
  const double whole = packing_i_ball_volume(3, 1);
  const double start = c > 0 && a > 0 ? whole : (a > 0 ? 0 : 0.5 * whole);
  return start - 2.0 / 3.0 * (j2 + (c - 2) * j1 + (1 - 2 * c) * j0 + j);
}

double packing_i_ball_cylinder(double r, double radius, double d, double *error)
{
  const double ball = packing_i_ball_volume(3, r);
  *error = 0;
  if (d >= radius + r || radius <= 0)
    return 0;
  if (d <= radius - r)
    return ball;
  *error = 64 * DBL_EPSILON * (1 + radius / r) * ball;
  const double v = share(radius / r, d / r) * r * r * r;
  return v < 0 ? 0 : v < ball ? v : ball;
}
