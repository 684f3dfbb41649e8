/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_CURVE_H
#define PACKING_FRONT_CURVE_H

/* The centre of a particle that touches a sphere and two more bodies, as a curve in its radius.
 *
 * Everything is relative to the centre of the sphere, of radius R. A particle of radius r whose
 * centre is c touches it where |c| = R + r. Of the points of that sphere those free of another
 * body are, for spheres and flat walls alike, a half space whose border moves with r:
 *
 *   c . p <= a + b r,   and c . p = a + b r where it touches.
 *
 * So a triple of bodies has the solutions c(r) = P + Q r + s(r) n, with s^2 a quadratic in r, and
 * a fourth body bounds r by the root of a quadratic: the sphere tangent to all four, which need
 * not touch one another (the problem of Apollonius; Soddy's spheres where they do). */

#include "vec.h"

/* A body beside the sphere. */
typedef struct packing_i_front_body {
  packing_vec3 p;
  double a;
  double b;
} packing_i_front_body;

/* A sphere of radius r whose centre is p from that of the sphere of radius R. */
static inline packing_i_front_body packing_i_front_sphere(packing_vec3 p, double r,
                                                          double sphere_r)
{
  const packing_i_front_body body = {
      p, 0.5 * (packing_i_dot(p, p) + (sphere_r - r) * (sphere_r + r)), sphere_r - r};
  return body;
}

/* A flat wall at `distance` from the sphere's centre; `normal` is unit and shows to the side
 * where the particles are. */
static inline packing_i_front_body packing_i_front_wall(packing_vec3 normal,
                                                        double distance)
{
  const packing_i_front_body body = {packing_i_scale(normal, -1.0), distance, -1.0};
  return body;
}

/* The plane z = 0 that holds the centres of discs: always touched. */
static inline packing_i_front_body packing_i_front_plane(void)
{
  const packing_i_front_body body = {{0, 0, 1}, 0, 0};
  return body;
}

/* Room of a body for a particle at c: 0 where it touches, negative where they overlap. In units of
 * length times |p|. */
static inline double packing_i_front_room(const packing_i_front_body *body,
                                          packing_vec3 c, double r)
{
  return body->a + body->b * r - packing_i_dot(c, body->p);
}

/* c(r) = base + slope r + sqrt(s2[0] + s2[1] r + s2[2] r^2) side. */
typedef struct packing_i_front_curve {
  packing_vec3 base;
  packing_vec3 slope;
  packing_vec3 side; /* unit, towards one of the two solutions */
  double s2[3];
} packing_i_front_curve;

/* The curve of a sphere of radius R with two bodies; `side` is +1 or -1, for the solution along
 * p_j x p_k or against it. Returns 0 where p_j and p_k are parallel to rounding. */
int packing_i_front_curve_init(double sphere_r, const packing_i_front_body *j,
                               const packing_i_front_body *k, int side,
                               packing_i_front_curve *curve);

/* The centre at radius r. Returns 0 where no such particle touches all three. */
int packing_i_front_curve_at(const packing_i_front_curve *curve, double r,
                             packing_vec3 *centre);

/* The smallest radius at or above r at which the triple has a solution; +infinity: none. */
double packing_i_front_curve_start(const packing_i_front_curve *curve, double r);

/* How a fourth body bounds the radius. */
typedef struct packing_i_front_bound {
  double room;   /* at the radius asked, in units of length times |p| */
  double first;  /* the next larger radius at which it touches; +infinity: none */
  double second; /* the one after */
} packing_i_front_bound;

/* The bound of a fourth body beyond radius r, where the curve has a solution. */
packing_i_front_bound packing_i_front_curve_bound(const packing_i_front_curve *curve,
                                                  const packing_i_front_body *body,
                                                  double r);

/* The place of a particle of radius r near `centre`, made tangent to the sphere and two bodies by
 * one step of Newton's method, which leaves rounding only. */
packing_vec3 packing_i_front_polish(double sphere_r, const packing_i_front_body *j,
                                    const packing_i_front_body *k, double r,
                                    packing_vec3 centre);

#endif
