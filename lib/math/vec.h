/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_VEC_H
#define PACKING_VEC_H

/* Vectors and the volumes of balls. Only + - * / and sqrt decide anything: they round the same
 * on every machine. */

#include <math.h>
#include <packing/types.h>

#define PACKING_I_PI 3.14159265358979323846

static inline packing_vec3 packing_i_vec(double x, double y, double z)
{
  packing_vec3 v = {x, y, z};
  return v;
}

static inline packing_vec3 packing_i_add(packing_vec3 a, packing_vec3 b)
{
  return packing_i_vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline packing_vec3 packing_i_sub(packing_vec3 a, packing_vec3 b)
{
  return packing_i_vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline packing_vec3 packing_i_scale(packing_vec3 a, double s)
{
  return packing_i_vec(a.x * s, a.y * s, a.z * s);
}

static inline double packing_i_dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline packing_vec3 packing_i_cross(packing_vec3 a, packing_vec3 b)
{
  return packing_i_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                       a.x * b.y - a.y * b.x);
}

static inline double packing_i_norm(packing_vec3 a)
{
  return sqrt(packing_i_dot(a, a));
}

static inline int packing_i_vec_finite(packing_vec3 a)
{
  return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static inline double packing_i_component(packing_vec3 a, int axis)
{
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* Sets component `axis`. */
static inline void packing_i_set_component(packing_vec3 *v, int axis, double value)
{
  *(axis == 0 ? &v->x : axis == 1 ? &v->y : &v->z) = value;
}

/* Volume of a sphere (dim 3) or area of a disc (dim 2). */
static inline double packing_i_ball_volume(int dim, double r)
{
  return dim == 2 ? PACKING_I_PI * r * r : 4.0 / 3.0 * PACKING_I_PI * r * r * r;
}

#endif
