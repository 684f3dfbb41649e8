/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_SETTLING_H
#define EXAMPLES_SETTLING_H

/* Letting a pack fall until it rests. */

#include "forces.h"

typedef struct settling {
  const forces *forces;
  packing_dem *dem;
  size_t particles;
  packing_dem_report *moved; /* the stepper's last report */
  double fall;      /* height that can have been fallen through before a look [L] */
  double look;      /* time between two looks is a hundredth of this [T] */
  double time_max;  /* it ends after this at the latest [T] */
  int rest;         /* 1: or at rest, */
  double tolerance; /* kinetic energy over the sum of m g r being below this [1] */
  /* Called after every few steps with the share of the time and the particle-steps done. */
  void (*show)(void *user, double share, double work);
  void *user;
} settling;

/* How it ended. */
typedef struct settled_state {
  double time; /* simulated */
  int rested;  /* 1: its end was rest */
} settled_state;

/* Steps on. Returns 0, or an exit code after one line on standard error. */
int settling_run(const settling *s, settled_state *end);

/* More steps than that are taken for a slip of the pen: they would take weeks. */
int settling_check(const char *option, double time_max, double dt);

#endif
