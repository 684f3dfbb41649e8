/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_FRONT_SCENES_H
#define PACKING_TEST_FRONT_SCENES_H

/* Packs of the advancing front in paper mode, and what must hold of every one. Header only: several
 * test programs share it. */
#include "domain_scenes.h"

static inline packing_front_def front_paper(void)
{
  packing_front_def def;
  packing_front_def_init(&def);
  def.mode = PACKING_FRONT_PAPER;
  return def;
}

/* One container of each kind, some 10 particles of radius 1 across. */
static const scene front_rooms[] = {
    {SCENE_BOX, 13.1, 11.7, 12.3, 0, {-3, 2, 1}, 2, 0, 0},
    {SCENE_BOX, 11.3, 12.9, 10.7, 0, {0, 0, 0}, 2, 0, 3},
    {SCENE_BOX, 10.9, 11.3, 12.1, 0, {0, 0, 0}, 2, 0, 7},
    {SCENE_BOX, 10.9, 11.3, 12.1, 0, {0, 0, 0}, 2, 1, 0},
    {SCENE_CYLINDER, 6.3, 12.7, 0, 0, {1, 2, 3}, 0, 0, 0},
    {SCENE_TUBE, 4.1, 9.3, 9.1, 0, {0, 0, 0}, 2, 0, 0},
    {SCENE_CONE, 8.1, 2.3, 12.1, 0, {0, 0, 0}, 2, 0, 0},
    {SCENE_SILO, 6.9, 16.3, 2.7, 4.9, {0, 0, 0}, 2, 0, 0},
    {SCENE_SPHERE, 7.3, 0, 0, 0, {5, 5, 5}, 2, 0, 0},
    {SCENE_RECTANGLE, 23.1, 21.7, 0, 0, {0, 0, 0}, 1, 0, 0},
    {SCENE_RECTANGLE, 23.1, 21.7, 0, 0, {0, 0, 0}, 1, 0, 3},
    {SCENE_CIRCLE, 13.3, 0, 0, 0, {1, 1, 0}, 1, 0, 0},
    {SCENE_ANNULUS, 6.3, 14.7, 0, 0, {0, 0, 0}, 1, 0, 0},
};
enum { FRONT_ROOMS = sizeof front_rooms / sizeof *front_rooms };

static inline int has_walls(packing_domain *domain)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const packing_vec3 middle = {0.5 * (b.lo.x + b.hi.x), 0.5 * (b.lo.y + b.hi.y),
                               0.5 * (b.lo.z + b.hi.z)};
  return isfinite(packing_domain_signed_distance(domain, &middle, NULL));
}

/* Runs to the end; the pack must be one: overlaps and protrusions are rounding. */
static inline packing_placer_report front_pack(const packing_front_def *def,
                                               packing_domain *domain, packing_psd *psd,
                                               packing_particles *store)
{
  packing_placer *placer = NULL;
  packing_view view;
  packing_audit_report audit;
  assert_ok(packing_front_create(NULL, def, domain, psd, store, &placer));
  const packing_placer_report report = test_run(placer);
  packing_placer_destroy(placer);
  packing_particles_view(store, &view);
  packing_audit_report_init(&audit);
  if (def->shape == NULL) { /* of circumscribed spheres the audit knows nothing */
    assert_ok(packing_audit(NULL, NULL, domain, &view, &audit));
    assert_true(audit.max_overlap <= 1e-12);
    assert_true(audit.max_protrusion <= 1e-12);
    assert_int_equal(audit.duplicates + audit.bad_numbers, 0);
  }
  return report;
}

static inline packing_vec3 front_centre(packing_particles *store, size_t i)
{
  packing_view v;
  packing_particles_view(store, &v);
  const double *x = v.x.data, *y = v.y.data, *z = v.z.data;
  const packing_vec3 p = {x[i], y[i], z[i]};
  return p;
}

static inline double front_radius(packing_particles *store, size_t i)
{
  packing_view v;
  packing_particles_view(store, &v);
  return ((const double *)v.r.data)[i];
}

/* The gap between two particles, to the nearest image. */
static inline double front_gap(packing_domain *domain, packing_particles *store, size_t i,
                               size_t j)
{
  const packing_vec3 a = front_centre(store, i), b = front_centre(store, j);
  const packing_vec3 s = packing_domain_separation(domain, &a, &b);
  return sqrt(s.x * s.x + s.y * s.y + s.z * s.z) - front_radius(store, i) -
         front_radius(store, j);
}

/* The gap between a particle and the nearest wall. */
static inline double front_wall_gap(packing_domain *domain, packing_particles *store,
                                    size_t i)
{
  const packing_vec3 p = front_centre(store, i);
  return packing_domain_signed_distance(domain, &p, NULL) - front_radius(store, i);
}

/* Pairs in contact. */
static inline size_t front_contacts(packing_domain *domain, packing_particles *store)
{
  size_t contacts = 0;
  const size_t count = packing_particles_count(store);
  for (size_t i = 0; i < count; i++)
    for (size_t j = 0; j < i; j++)
      contacts += fabs(front_gap(domain, store, i, j)) <= 1e-10;
  return contacts;
}

#endif
