/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RSA_INTERNAL_H
#define PACKING_RSA_INTERNAL_H

/* The two ways of random sequential addition (one for equal sizes, one for the rest) and what
 * they share: when to stop. */

#include "place_internal.h"

/* Volume fractions at saturation of equal sizes in a large periodic cell (Zhang and Torquato,
 * Phys. Rev. E 88, 053312, 2013). */
#define PACKING_I_RSA_SATURATION_2D 0.5470735
#define PACKING_I_RSA_SATURATION_3D 0.3841307

/* How much is asked; both may be absent. */
typedef struct packing_i_rsa_goal {
  size_t count;        /* 0: no limit */
  double solid_volume; /* 0: no limit */
} packing_i_rsa_goal;

/* Whether the next particle, of volume `next`, is still asked for: the solid volume is met to
 * half a particle. */
int packing_i_rsa_wants(const packing_i_rsa_goal *goal,
                        const packing_placer_report *tally, double next);

/* Share of the goal that is reached, 0 to 1. */
double packing_i_rsa_progress(const packing_i_rsa_goal *goal,
                              const packing_placer_report *tally);

/* Fill placer->method, for a psd of one radius (all particles in the store have it too), or any
 * psd. On failure method may be set: the caller destroys the placer. */
packing_status packing_i_rsa_equal_start(packing_placer *placer,
                                         const packing_rsa_def *def,
                                         const packing_i_rsa_goal *goal);
packing_status packing_i_rsa_mixed_start(packing_placer *placer,
                                         const packing_rsa_def *def,
                                         const packing_i_rsa_goal *goal);

extern const packing_i_placer_ops packing_i_rsa_equal_ops;
extern const packing_i_placer_ops packing_i_rsa_mixed_ops;

#endif
