/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_CAMERA_H
#define EXAMPLES_CAMERA_H

/* Parallel projection of a pack onto a sheet. */

#include <packing/packing.h>

typedef struct camera {
  packing_vec3 right, up, toward; /* unit vectors; toward the viewer */
  double scale;                   /* pixels a length */
  double x, y;                    /* pixels of the origin */
} camera;

/* A projected point, in pixels: x to the right, y down, depth toward the viewer. */
typedef struct spot {
  double x, y, depth;
} spot;

/* From above right for 3, straight down for 2 dimensions; scale 1. */
void camera_init(camera *v, int dim);

spot camera_project(const camera *v, packing_vec3 point);

#endif
