/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_RSA_ROUND_H
#define PACKING_RSA_ROUND_H

/* A round of darts, worked off in the order of space instead of time, with the outcome of the
 * order of time.
 *
 * Each dart has a random time. (1) The number of darts of each bin is drawn: bins are equal in
 * volume, neighbours in memory. (2) Bin by bin the darts are thrown and those that miss all
 * particles that stand become candidates; blocks of darts are independent, so threads share
 * them. (3) A candidate with no earlier candidate within a diameter is accepted. (4) The few
 * others are settled in order of time. So a round is what a sequence of darts would have been,
 * but walks through memory once; the time of a dart decides, never its place or thread.
 * The idea is that of deterministic reservations (Blelloch, Fineman, Gibbons and Shun, PPoPP
 * 2012). When rounds came in, 1e6 particles took 2.9 s of processor time,
 * one dart after the other 3.8 to 4.3 s (2026-11-21, a loaded machine). */

#include "rsa_cells.h"
#include "rsa_internal.h"
#include "rng/philox_batch.h"

typedef struct packing_i_rsa_candidate {
  double x, y, z;
  uint64_t time;
} packing_i_rsa_candidate;

/* Where darts go: the point of `random` in a bin; 0: this dart falls nowhere. */
typedef struct packing_i_rsa_target {
  int (*point)(const void *user, size_t bin, const uint32_t random[4],
               packing_vec3 *point);
  const void *user;
} packing_i_rsa_target;

typedef enum packing_i_rsa_stage {
  PACKING_I_RSA_IDLE,
  PACKING_I_RSA_COUNT,
  PACKING_I_RSA_THROW,
  PACKING_I_RSA_LINK,
  PACKING_I_RSA_DECIDE,
  PACKING_I_RSA_SORT,
  PACKING_I_RSA_SETTLE,
  PACKING_I_RSA_UNLINK,
  PACKING_I_RSA_TRIM,
  PACKING_I_RSA_COMMIT
} packing_i_rsa_stage;

typedef struct packing_i_rsa_round {
  packing_i_rsa_stage stage;
  uint32_t key[2];         /* positions */
  uint32_t time_key[2];    /* times */
  uint32_t count_key[2];   /* bins */
  packing_i_stream counts; /* for the few numbers that would bias a bin */
  packing_i_philox_batch philox;
  uint64_t number; /* of this round */
  size_t darts;
  size_t bins;
  size_t at;       /* how far the stage is */
  size_t base;     /* records before this round */
  uint32_t *first; /* bins + 1: first dart of each bin */
  size_t first_room;
  packing_i_rsa_candidate *candidate;
  size_t candidates;
  size_t room; /* for candidates, in all arrays of them */
  unsigned char *fate;
  uint32_t *order; /* candidates to be settled, by time */
  packing_i_rsa_candidate *scratch;
  uint32_t *scratch_count;
  size_t unsettled;
  size_t accepted;
} packing_i_rsa_round;

/* What a round works on. */
typedef struct packing_i_rsa_scene {
  packing_placer *placer;
  packing_i_rsa_cells *cells;
  double r;
  int boxlike; /* every dart is inside the container */
  packing_i_rsa_target target;
} packing_i_rsa_scene;

packing_status packing_i_rsa_round_init(packing_i_rsa_round *round,
                                        packing_context *context, uint64_t seed,
                                        uint64_t stream);
void packing_i_rsa_round_release(packing_i_rsa_round *round, packing_context *context);

/* Begins a round. On failure it can be begun again. */
packing_status packing_i_rsa_round_begin(packing_i_rsa_round *round,
                                         packing_context *context, size_t darts,
                                         size_t bins);

/* Does one unit of work; the stage is IDLE when the round is over. At most `most` particles are
 * added, the earliest. After PACKING_ERR_NOMEM it can be called again. */
packing_status packing_i_rsa_round_step(packing_i_rsa_round *round,
                                        const packing_i_rsa_scene *scene, size_t most);

#endif
