/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_POCKET_SCENES_H
#define PACKING_TEST_POCKET_SCENES_H

/* Packs of the advancing front in the modes fast and dense, and what must hold of every one.
 * Header only: several test programs share it. */
#include "domain_scenes.h"

static const packing_front_mode pocket_modes[2] = {PACKING_FRONT_DENSE,
                                                   PACKING_FRONT_FAST};

static inline packing_front_def pocket_def(packing_front_mode mode)
{
  packing_front_def def;
  packing_front_def_init(&def);
  def.mode = mode;
  return def;
}

/* Eight rounding units of the container: of its largest coordinate. */
static inline double pocket_rounding(const packing_domain *domain)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const double c[6] = {b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z};
  double far = 0;
  for (int k = 0; k < 6; k++)
    if (isfinite(c[k]))
      far = fmax(far, fabs(c[k]));
  return 8 * 0x1p-52 * far;
}

/* Overlap and protrusion are at most 1e-12 of the (smaller) radius or 8 rounding units of the
 * container; particles from `from` on are looked at, the others are what stood before. */
static inline void pocket_audit(packing_domain *domain, packing_particles *store)
{
  packing_view v;
  packing_audit_report audit;
  packing_particles_view(store, &v);
  packing_audit_report_init(&audit);
  assert_ok(packing_audit(NULL, NULL, domain, &v, &audit));
  assert_int_equal(audit.duplicates + audit.bad_numbers, 0);
  const double *r = v.r.data;
  const double rounding = pocket_rounding(domain);
  if (audit.overlap_i != PACKING_NO_INDEX) {
    const double least = fmin(r[audit.overlap_i], r[audit.overlap_j]);
    assert_true(audit.max_overlap * least <= fmax(1e-12 * least, rounding));
  }
  if (audit.protrusion_i != PACKING_NO_INDEX) {
    const double own = r[audit.protrusion_i];
    assert_true(audit.max_protrusion * own <= fmax(1e-12 * own, rounding));
  }
}

/* Runs a front to its end in a context; the pack must be one. */
static inline packing_placer_report pocket_pack(packing_context *context,
                                                const packing_front_def *def,
                                                packing_domain *domain, packing_psd *psd,
                                                packing_particles *store)
{
  packing_placer *placer = NULL;
  assert_ok(packing_front_create(context, def, domain, psd, store, &placer));
  const size_t stood = packing_particles_count(store);
  const packing_placer_report report = test_run(placer);
  packing_placer_destroy(placer);
  (void)stood;
  pocket_audit(domain, store);
  assert_true(report.state == PACKING_PLACER_DONE ||
              report.state == PACKING_PLACER_SATURATED);
  return report;
}

static inline packing_vec3 pocket_at(double x, double y, double z)
{
  const packing_vec3 p = {x, y, z};
  return p;
}

static inline const double *pocket_radii(packing_particles *store)
{
  packing_view v;
  packing_particles_view(store, &v);
  return v.r.data;
}

#endif
