/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solutions of triples of bodies as curves in the radius, and what bounds them. See the header.
 * Cost: a curve some 80 operations, a bound some 40 and two roots. */
#include "front_curve.h"

enum { STEPS_UP = 8 }; /* from a root, of up to 1e-15 8^7 of it */

/* Parents in line leave the side open. */
static const double parallel = 1e-18; /* |p_j x p_k|^2 over |p_j|^2 |p_k|^2 */

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  return packing_i_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                       a.x * b.y - a.y * b.x);
}

static packing_vec3 sum_of(packing_vec3 a, double u, packing_vec3 b, double v)
{
  return packing_i_vec(a.x * u + b.x * v, a.y * u + b.y * v, a.z * u + b.z * v);
}

int packing_i_front_curve_init(double sphere_r, const packing_i_front_body *j,
                               const packing_i_front_body *k, int side,
                               packing_i_front_curve *curve)
{
  const double jj = packing_i_dot(j->p, j->p), kk = packing_i_dot(k->p, k->p),
               jk = packing_i_dot(j->p, k->p);
  const packing_vec3 normal = cross(j->p, k->p);
  const double det = packing_i_dot(normal, normal);
  if (!(det > parallel * jj * kk))
    return 0;
  curve->base =
      sum_of(j->p, (kk * j->a - jk * k->a) / det, k->p, (jj * k->a - jk * j->a) / det);
  curve->slope =
      sum_of(j->p, (kk * j->b - jk * k->b) / det, k->p, (jj * k->b - jk * j->b) / det);
  curve->side = packing_i_scale(normal, (double)side / sqrt(det));
  curve->s2[0] = sphere_r * sphere_r - packing_i_dot(curve->base, curve->base);
  curve->s2[1] = 2 * (sphere_r - packing_i_dot(curve->base, curve->slope));
  curve->s2[2] = 1 - packing_i_dot(curve->slope, curve->slope);
  return 1;
}

static double height2(const packing_i_front_curve *curve, double r)
{
  return curve->s2[0] + r * (curve->s2[1] + r * curve->s2[2]);
}

int packing_i_front_curve_at(const packing_i_front_curve *curve, double r,
                             packing_vec3 *centre)
{
  const double s2 = height2(curve, r);
  if (!(s2 >= 0))
    return 0;
  const double s = sqrt(s2);
  centre->x = curve->base.x + curve->slope.x * r + s * curve->side.x;
  centre->y = curve->base.y + curve->slope.y * r + s * curve->side.y;
  centre->z = curve->base.z + curve->slope.z * r + s * curve->side.z;
  return 1;
}

/* The real roots of q[0] + q[1] x + q[2] x^2, rising; +infinity where there are none. */
static void roots(const double q[3], double x[2])
{
  x[0] = x[1] = HUGE_VAL;
  const double discriminant = q[1] * q[1] - 4 * q[0] * q[2];
  if (!(discriminant >= 0))
    return;
  const double root = sqrt(discriminant);
  const double sum = -0.5 * (q[1] + (q[1] >= 0 ? root : -root));
  const double one = q[2] != 0 ? sum / q[2] : HUGE_VAL;
  const double two = sum != 0 ? q[0] / sum : one;
  x[0] = one < two ? one : two;
  x[1] = one < two ? two : one;
}

double packing_i_front_curve_start(const packing_i_front_curve *curve, double r)
{
  if (height2(curve, r) >= 0)
    return r;
  double x[2];
  roots(curve->s2, x);
  for (int k = 0; k < 2; k++) {
    if (!(x[k] > r) || !isfinite(x[k]))
      continue;
    /* A root is good to rounding; a few steps up reach the side that has solutions. */
    double start = x[k];
    double step = 1e-15;
    for (int n = 0; n < STEPS_UP; n++) {
      if (height2(curve, start) >= 0)
        return start;
      step *= 8;
      start = x[k] * (1 + step);
    }
  }
  return HUGE_VAL;
}

/* Room is u + v r - w s(r); it is 0 where (u + v r)^2 = w^2 s^2(r) and u + v r has w's sign. */
packing_i_front_bound packing_i_front_curve_bound(const packing_i_front_curve *curve,
                                                  const packing_i_front_body *body,
                                                  double r)
{
  const double u = body->a - packing_i_dot(curve->base, body->p);
  const double v = body->b - packing_i_dot(curve->slope, body->p);
  const double w = packing_i_dot(curve->side, body->p);
  const double s2 = height2(curve, r);
  packing_i_front_bound bound = {u + v * r - w * (s2 > 0 ? sqrt(s2) : 0), HUGE_VAL,
                                 HUGE_VAL};
  const double q[3] = {u * u - w * w * curve->s2[0], 2 * u * v - w * w * curve->s2[1],
                       v * v - w * w * curve->s2[2]};
  double x[2];
  roots(q, x);
  for (int k = 0; k < 2; k++) {
    if (!(x[k] > r) || !isfinite(x[k]) || (u + v * x[k]) * w < 0 ||
        height2(curve, x[k]) < 0)
      continue;
    if (bound.first == HUGE_VAL)
      bound.first = x[k];
    else
      bound.second = x[k];
  }
  return bound;
}

packing_vec3 packing_i_front_polish(double sphere_r, const packing_i_front_body *j,
                                    const packing_i_front_body *k, double r,
                                    packing_vec3 centre)
{
  const double reach = sphere_r + r;
  /* Rows 2 c, p_j, p_k; the right side is what is missing. Cramer's rule. */
  const double e = 0.5 * (reach * reach - packing_i_dot(centre, centre));
  const double f = packing_i_front_room(j, centre, r),
               g = packing_i_front_room(k, centre, r);
  const packing_vec3 jk = cross(j->p, k->p), kc = cross(k->p, centre),
                     cj = cross(centre, j->p);
  const double det = packing_i_dot(centre, jk);
  const double size = packing_i_norm(centre) * packing_i_norm(jk);
  /* Where the two solutions meet the step is not defined, and not needed. */
  if (!(fabs(det) > 1e-5 * size))
    return centre;
  const packing_vec3 step = packing_i_scale(
      packing_i_add(packing_i_scale(jk, e),
                    packing_i_add(packing_i_scale(kc, f), packing_i_scale(cj, g))),
      1 / det);
  return packing_i_add(centre, step);
}
