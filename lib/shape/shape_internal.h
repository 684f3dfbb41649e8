/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SHAPE_INTERNAL_H
#define PACKING_SHAPE_INTERNAL_H

/* What a shape is inside, and what placers ask of bodies beyond the public functions. */

#include "base_internal.h"
#include "vec.h"
#include <packing/shape.h>
#include <stdatomic.h>

struct packing_shape {
  atomic_size_t holds;
  packing_allocator allocator; /* a copy: a shape outlives its context */
  packing_shape_def def;       /* its name points to the one below */
  char name[];
};

/* The shape whose functions answer for a pair of particles; NULL: both are spheres. */
static inline const packing_shape *packing_i_pair_shape(const packing_body *a,
                                                        const packing_body *b)
{
  return a->shape != NULL ? a->shape : b->shape;
}

/* Two spheres, `apart` from the fixed centre to the mobile one, radii adding up to
 * `reach`: how far until they touch (`leaving` 0) or let go of each other again (1);
 * infinity: they do not meet from now on. */
double packing_i_sphere_distance(packing_vec3 apart, double reach,
                                 const packing_vec3 *direction, int leaving);

/* How far a sphere can go until it touches a wall of a built-in container, in closed
 * form. Returns 0, and writes nothing, for other containers. */
int packing_i_wall_distance(const packing_body *a, const packing_body *wall,
                            const packing_vec3 *direction, double *distance);

/* The least t in [from, to] at which a particle, moved by t, touches b; infinity: none.
 * From the gap alone. */
double packing_i_march(const packing_body *a, const packing_body *b,
                       const packing_vec3 *direction, double from, double to);

#endif
