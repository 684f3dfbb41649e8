/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TOUCH_INTERNAL_H
#define PACKING_TOUCH_INTERNAL_H

/* What the ways to place a particle in contact share. Tasks are valid:
 * packing_contact_place() sees to that. Side +1 of a task is the side from which the
 * bodies 0, 1, 2 turn counter-clockwise (in two dimensions: to the right, going from body
 * 0 to body 1), and its place comes first. */

#include "shape/shape_internal.h"
#include "vec.h"
#include <packing/tangency.h>

/* The gaps of a place with their gradients; the plane z = 0 is the third body in two
 * dimensions. */
typedef struct packing_i_touch {
  packing_vec3 normal[3];
  double gap[3];
  double worst; /* largest gap in size */
} packing_i_touch;

/* The bodies as the mobile particle with its centre at x meets them. */
void packing_i_touch_at(const packing_contact_task *task, packing_vec3 x,
                        packing_i_touch *touch);

/* The largest coordinate or radius of the task: what its rounding is relative to. */
double packing_i_touch_extent(const packing_contact_task *task);

/* A gap that counts as none: 1e-12 of the mobile radius, or 8 rounding units of the
 * extent. */
double packing_i_touch_tolerance(const packing_contact_task *task);

/* Newton's steps from near a solution, while they bring the worst gap down. */
packing_vec3 packing_i_touch_polish(const packing_contact_task *task, packing_vec3 x,
                                    packing_i_touch *touch);

/* Levenberg and Marquardt's way from x to where all gaps are 0. Returns whether it came
 * there. */
int packing_i_touch_descend(const packing_contact_task *task, packing_vec3 *x);

/* Whether all particles of the task are spheres. */
int packing_i_touch_all_round(const packing_contact_task *task);

int packing_i_touch_has_walls(const packing_contact_task *task);

/* The first particle of the fixed bodies; the bodies after it in turn give, with it, the
 * side. */
int packing_i_touch_first(const packing_contact_task *task);

/* A point from which all walls of the task are seen: `from` itself or the centre of a
 * particle (edges and facets of polygons and meshes are not seen from everywhere).
 * Returns 0 where there is none. */
int packing_i_touch_view(const packing_contact_task *task, packing_vec3 *from);

/* The line along which the approximate methods come (section 3.4.3). */
typedef struct packing_i_touch_line {
  packing_vec3 middle; /* c_m */
  packing_vec3 along;  /* u, unit, to the side */
  double length;       /* 2 R */
  int is_free;         /* whether the mobile particle is free of all bodies at c_0 */
} packing_i_touch_line;

/* Returns 0 where the bodies have no such line: centres in a row, opposite walls. */
int packing_i_touch_line_of(const packing_contact_task *task, int side,
                            packing_i_touch_line *line);

/* The mobile particle at a share t of the line. */
static inline packing_body packing_i_touch_mobile(const packing_contact_task *task,
                                                  const packing_i_touch_line *line,
                                                  double t)
{
  packing_body mobile = task->mobile;
  mobile.centre =
      packing_i_add(line->middle, packing_i_scale(line->along, t * line->length));
  return mobile;
}

/* Places on side +1, then on side -1: packing_i_touch_sides() calls `find`, which returns
 * whether there is one, and leaves out the second where it is the first one. */
typedef int (*packing_i_touch_find)(const packing_contact_task *task, int side,
                                    packing_vec3 *x);
int packing_i_touch_sides(const packing_contact_task *task, packing_i_touch_find find,
                          packing_vec3 centre[2]);

#endif
