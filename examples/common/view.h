/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_VIEW_H
#define EXAMPLES_VIEW_H

/* Parallel projection of a pack onto a sheet. */

#include <packing/packing.h>

typedef struct view {
  packing_vec3 right, up, toward; /* unit vectors; toward the viewer */
  double scale;                   /* pixels a length */
  double x, y;                    /* pixels of the origin */
} view;

/* A projected point, in pixels: x to the right, y down, depth toward the viewer. */
typedef struct spot {
  double x, y, depth;
} spot;

/* From above right for 3, straight down for 2 dimensions; scale 1. */
void view_init(view *v, int dim);

spot view_project(const view *v, packing_vec3 point);

#endif
