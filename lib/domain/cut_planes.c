/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volume of a ball (area of a disc) within an axis-aligned box, in closed form.
 *
 * Along each axis the indicator of an interval is a sum of at most three half-lines whose
 * borders lie on the far side of the centre; the product over the axes is a sum of the ball,
 * caps, wedges of two and corners of three orthogonal planes at distances a, b, c >= 0 from
 * the centre, each with a plus or minus. A corner K is bounded by pieces of the planes with
 * areas A, and a piece S of the sphere, so that by the divergence theorem
 *
 *     3 |K| = r |S| - a A_a - b A_b - c A_c,
 *     |S| / r^2 = t_ab + t_bc + t_ca - pi - (a u_a + b u_b + c u_c) / r     (Gauss-Bonnet),
 *     2 A_a = (r^2 - a^2) u_a - b (w_ab - c) - c (w_ac - b),
 *
 * where w_ab = sqrt(r^2 - a^2 - b^2) is the half chord in the planes a and b,
 * t_ab = atan2(r w_ab, a b) the angle of S where it meets both, and
 * u_a = atan2(w_ab, b) - atan2(c, w_ac) the angle of its arc in the plane a. A wedge is twice
 * the corner with c = 0. Error: a few roundings of the whole ball; a cap alone is exact to a
 * few roundings of itself. At most 27 terms. */
#include "domain_kinds.h"
#include <float.h>
#include <math.h>

static double half_chord(double r, double a, double b)
{
  const double s = (r - a) * (r + a) - b * b;
  return s > 0 ? sqrt(s) : 0;
}

/* The part of a disc beyond two orthogonal lines at a, b >= 0; at rho^2 = chord^2 + b^2. */
static double disc_corner(double rho2, double a, double chord_a, double b, double chord_b,
                          double *angle)
{
  *angle = atan2(chord_a, a) - atan2(b, chord_b);
  return 0.5 * (rho2 * *angle - a * (chord_a - b) - b * (chord_b - a));
}

static double corner2(double r, double a, double b)
{
  double angle;
  if (a * a + b * b >= r * r)
    return 0;
  return disc_corner(r * r, a, half_chord(r, a, 0), b, half_chord(r, b, 0), &angle);
}

static double corner3(double r, double a, double b, double c)
{
  if (a * a + b * b + c * c >= r * r)
    return 0;
  const double ab = half_chord(r, a, b), bc = half_chord(r, b, c),
               ca = half_chord(r, c, a);
  double ua, ub, uc;
  const double area_a = disc_corner((r - a) * (r + a), b, ab, c, ca, &ua);
  const double area_b = disc_corner((r - b) * (r + b), c, bc, a, ab, &ub);
  const double area_c = disc_corner((r - c) * (r + c), a, ca, b, bc, &uc);
  const double angles =
      atan2(r * ab, a * b) + atan2(r * bc, b * c) + atan2(r * ca, c * a) - PACKING_I_PI;
  const double sphere = r * r * angles - r * (a * ua + b * ub + c * uc);
  const double volume = (r * sphere - a * area_a - b * area_b - c * area_c) / 3;
  return volume > 0 ? volume : 0;
}

/* One term of an axis: sign times the half-line beyond `at`, or the line when at < 0. */
typedef struct term {
  double sign, at;
} term;

static int axis_terms(double r, double lo, double hi, term terms[3])
{
  int n = 0;
  const double near = lo > 0   ? lo
                      : hi < 0 ? -hi
                               : -1; /* the centre's way to the interval */
  if (near < r)
    terms[n++] = (term){1, near};
  if (lo <= 0 && -lo < r)
    terms[n++] = (term){-1, -lo};
  if (hi >= 0 && hi < r)
    terms[n++] = (term){-1, hi};
  return n;
}

/* The ball beyond the planes of the terms that have one. */
static double beyond(int dim, double r, const double at[3])
{
  double a[3];
  int n = 0;
  for (int k = 0; k < 3; k++)
    if (at[k] >= 0)
      a[n++] = at[k];
  if (n == 0)
    return packing_i_ball_volume(dim, r);
  if (n == 1)
    return packing_i_cap(dim, r, r - a[0]);
  if (dim == 2)
    return corner2(r, a[0], a[1]);
  return n == 2 ? 2 * corner3(r, a[0], a[1], 0) : corner3(r, a[0], a[1], a[2]);
}

static double all_terms(int dim, double r, const double lo[3], const double hi[3])
{
  term terms[3][3] = {{{1, -1}}, {{1, -1}}, {{1, -1}}};
  int n[3] = {1, 1, 1};
  for (int k = 0; k < (dim == 2 ? 2 : 3); k++)
    n[k] = axis_terms(r, lo[k], hi[k], terms[k]);
  double sum = 0;
  for (int i = 0; i < n[0]; i++)
    for (int j = 0; j < n[1]; j++)
      for (int k = 0; k < n[2]; k++) {
        const double at[3] = {terms[0][i].at, terms[1][j].at, terms[2][k].at};
        sum +=
            terms[0][i].sign * terms[1][j].sign * terms[2][k].sign * beyond(dim, r, at);
      }
  return sum;
}

double packing_i_cut_planes(int dim, double r, const double lo[3], const double hi[3],
                            double *error)
{
  const int axes = dim == 2 ? 2 : 3;
  double box = 1, corner2_of_box = 0;
  for (int k = 0; k < axes; k++) {
    const double far = -lo[k] > hi[k] ? -lo[k] : hi[k];
    box *= hi[k] > lo[k] ? hi[k] - lo[k] : 0;
    corner2_of_box += far * far;
  }
  *error = 0;
  if (corner2_of_box <= r * r)
    return box;
  const double ball = packing_i_ball_volume(dim, r);
  const double most = box < ball ? box : ball;
  const double sum = all_terms(dim, r, lo, hi);
  *error = 64 * DBL_EPSILON * ball;
  return sum < 0 ? 0 : sum > most ? most : sum;
}

int packing_i_planar_sphere_volume(const packing_i_domain_body *body,
                                   const packing_vec3 *centre, double r, double tolerance,
                                   double *volume, double *error)
{
  (void)tolerance;
  const packing_i_planar *p = &body->as.planar;
  double lo[3], hi[3];
  for (int k = 0; k < 3; k++) {
    const double x = packing_i_component(*centre, k);
    lo[k] = p->cut_lo[k] - x;
    hi[k] = p->cut_hi[k] - x;
  }
  *volume = packing_i_cut_planes(body->dim, r, lo, hi, error);
  return 0;
}
