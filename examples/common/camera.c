/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera.h"
#include <math.h>

static double dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

void camera_init(camera *v, int dim)
{
  const double azimuth = 0.55, elevation = 0.38;
  const double ca = cos(azimuth), sa = sin(azimuth);
  const double ce = cos(elevation), se = sin(elevation);
  v->scale = 1;
  v->x = v->y = 0;
  if (dim == 2) {
    v->right = (packing_vec3){1, 0, 0};
    v->up = (packing_vec3){0, 1, 0};
    v->toward = (packing_vec3){0, 0, 1};
    return;
  }
  v->right = (packing_vec3){ca, sa, 0};
  v->toward = (packing_vec3){ce * sa, -ce * ca, se};
  v->up = (packing_vec3){-se * sa, se * ca, ce};
}

spot camera_project(const camera *v, packing_vec3 point)
{
  return (spot){v->x + v->scale * dot(v->right, point),
                v->y - v->scale * dot(v->up, point), v->scale * dot(v->toward, point)};
}
