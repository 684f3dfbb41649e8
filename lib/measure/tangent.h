/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TANGENT_H
#define PACKING_TANGENT_H

/* Spheres that touch others from outside. */

#include <packing/types.h>

/* Centres of spheres of radius R that touch `count` others, and lie in their affine hull, as a
 * function of R: origin + u - R v. Whatever is orthogonal to all of them is centred at origin + u,
 * its radius squared |u|^2 - r^2. */
typedef struct packing_i_tangency {
  packing_vec3 origin; /* of the first */
  double r;            /* its radius */
  packing_vec3 u;
  packing_vec3 v;
  packing_vec3 normal; /* to the hull of three in space, of two in the plane z = 0 */
  double
      height; /* determinant of the edges relative to the power of the longest: 0 is flat */
} packing_i_tangency;

/* Two, three or four spheres; 0 where they are too flat to be solved at all. */
int packing_i_tangency_set(packing_i_tangency *t, int count, const packing_vec3 *centre,
                           const double *r);

/* The radii > 0 for which a sphere touches all from outside, smaller first; returns how many. */
int packing_i_tangency_radii(const packing_i_tangency *t, double radii[2]);

packing_vec3 packing_i_tangency_centre(const packing_i_tangency *t, double radius);

#endif
