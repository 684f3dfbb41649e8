/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PLACE_INTERNAL_H
#define PACKING_PLACE_INTERNAL_H

/* What all placers share: the handle, its descriptor, the tally of what was placed. */

#include "domain/domain_internal.h"
#include "particles/particles_internal.h"
#include "psd/psd_internal.h"
#include "rng/rng_internal.h"
#include "base_internal.h"
#include "vec.h"
#include <packing/placer.h>

/* A container that is too small for a particle by no more than rounding still has room for it:
 * packing_i_placer_check_room() forgives the first share of the radius, random sequential
 * addition accepts centres that are short of the radius by no more than the second. Were the
 * second 0, a gap of one diameter would be refused again and again by rounding. */
static const double packing_i_room_slack = 1e-10;
static const double packing_i_hold_slack = 2e-10;

/* One method of placing. `step` does about `budget` units of work (some milliseconds each at
 * most), keeps placer->tally, and sets its state once it has ended. After PACKING_ERR_NOMEM it
 * can be called again. `release` frees the method's own part; NULL is never passed. */
typedef struct packing_i_placer_ops {
  const char *name;
  const char *reference;
  packing_status (*step)(packing_placer *placer, size_t budget);
  void (*release)(packing_placer *placer);
} packing_i_placer_ops;

struct packing_placer {
  const packing_i_placer_ops *ops;
  packing_context *context;
  packing_domain *domain;
  packing_psd *psd;
  packing_particles *particles;
  double domain_volume;
  packing_placer_report tally;
  void *method; /* the method's own part */
};

/* Makes a placer that holds context, domain and psd. Refuses NULL arguments and dimensions that
 * differ. */
packing_status packing_i_placer_create(packing_context *context,
                                       const packing_i_placer_ops *ops,
                                       packing_domain *domain, packing_psd *psd,
                                       packing_particles *particles,
                                       packing_placer **placer);

/* A particle of radius r, or the largest, must have room for its centre, and not meet its own
 * image: PACKING_ERR_GEOMETRY. */
packing_status packing_i_placer_check_room_of(const packing_placer *placer, double r);
packing_status packing_i_placer_check_room(const packing_placer *placer);

/* Adds a particle to the store and the tally. */
packing_status packing_i_placer_put(packing_placer *placer, packing_vec3 centre, double r,
                                    size_t component);

/* The same of a particle that is no ball: its volume is told. */
packing_status packing_i_placer_put_body(packing_placer *placer, packing_vec3 centre,
                                         double r, size_t component, double volume);

#endif
