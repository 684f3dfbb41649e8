/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_TOUCHING_H
#define PACKING_TEST_TOUCHING_H

/* What tests of the contact methods share. */
#include "cluster.h"
#include "domain_scenes.h"

static inline packing_body touching_sphere(double x, double y, double z, double r)
{
  const packing_vec3 centre = {x, y, z};
  return packing_body_sphere(centre, r);
}

static inline packing_body touching_wall(const packing_domain *domain, int number)
{
  packing_body body;
  memset(&body, 0, sizeof body);
  body.domain = domain;
  body.wall = number;
  return body;
}

static inline packing_contact_task touching_task(int dim, double r)
{
  packing_contact_task task;
  packing_contact_task_init(&task);
  task.dim = dim;
  task.mobile = touching_sphere(0, 0, 0, r);
  return task;
}

static inline double touching_gap(const packing_contact_task *task, packing_vec3 centre,
                                  int body)
{
  packing_body mobile = task->mobile;
  mobile.centre = centre;
  return packing_body_gap(&mobile, &task->fixed[body]);
}

/* Largest gap in size, and the least with its sign. */
static inline double touching_worst(const packing_contact_task *task, packing_vec3 centre)
{
  double worst = 0;
  for (int i = 0; i < task->dim; i++)
    worst = fmax(worst, fabs(touching_gap(task, centre, i)));
  return worst;
}

static inline double touching_least(const packing_contact_task *task, packing_vec3 centre)
{
  double least = HUGE_VAL;
  for (int i = 0; i < task->dim; i++)
    least = fmin(least, touching_gap(task, centre, i));
  return least;
}

static inline double touching_apart(packing_vec3 a, packing_vec3 b)
{
  return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
              (a.z - b.z) * (a.z - b.z));
}

/* Largest coordinate or radius: what rounding is relative to. */
static inline double touching_extent(const packing_contact_task *task)
{
  double extent = task->mobile.r;
  for (int i = 0; i < task->dim; i++)
    if (task->fixed[i].domain == NULL) {
      const packing_vec3 zero = {0, 0, 0};
      extent =
          fmax(extent, touching_apart(task->fixed[i].centre, zero) + task->fixed[i].r);
    }
  return extent;
}

static inline packing_vec3 touching_direction(uint64_t *random, int dim)
{
  for (;;) {
    packing_vec3 v = {scene_random(random) - 0.5, scene_random(random) - 0.5,
                      dim == 3 ? scene_random(random) - 0.5 : 0};
    const double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    if (length < 0.5 && length > 0.1) {
      v.x /= length;
      v.y /= length;
      v.z /= length;
      return v;
    }
  }
}

/* A radius, spread evenly over the octaves from 1 to `ratio`. */
static inline double touching_radius(uint64_t *random, double ratio)
{
  return exp(log(ratio) * scene_random(random));
}

/* Spheres or discs around a particle that touches all but for a share `loose` of their
 * distance. They do not overlap. */
static inline packing_contact_task touching_random(uint64_t *random, int dim,
                                                   double ratio, double loose)
{
  for (;;) {
    packing_contact_task task = touching_task(dim, touching_radius(random, ratio));
    int overlaps = 0;
    for (int i = 0; i < dim; i++) {
      const packing_vec3 v = touching_direction(random, dim);
      const double r = touching_radius(random, ratio);
      const double away =
          (r + task.mobile.r) * (1 + loose * (scene_random(random) - 0.5));
      task.fixed[i] = touching_sphere(away * v.x, away * v.y, away * v.z, r);
      for (int j = 0; j < i; j++)
        overlaps = overlaps || packing_body_overlap(&task.fixed[i], &task.fixed[j]);
    }
    if (!overlaps)
      return task;
  }
}

#endif
