/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether threads pay. A step meets them three times: with few particles, or on a machine that
 * others use too, one thread is faster than several that wait for each other. Rounds of steps are
 * timed, one thread or all; the faster way is taken, the other tried now and then. The bytes are
 * the same. */
#define _POSIX_C_SOURCE 200809L
#include "stepper_internal.h"
#include <time.h>

enum {
  STEPS = 64,
  EXPLORE = 32
}; /* steps of a round; every so many rounds the other way */

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* What the next round does. A way that was never tried has taken no time yet. */
static int choose(const packing_i_threads *t)
{
  const int faster = t->seconds[1] < t->seconds[0];
  return t->round % EXPLORE == EXPLORE - 1 ? !faster : faster;
}

void packing_i_threads_begin(packing_dem *dem)
{
  packing_i_threads *t = &dem->threads;
  if (t->step == 0)
    t->one = choose(t);
  t->start = now();
}

void packing_i_threads_end(packing_dem *dem)
{
  packing_i_threads *t = &dem->threads;
  t->took += now() - t->start;
  if (++t->step < STEPS)
    return;
  double *seconds = &t->seconds[t->one];
  *seconds = *seconds > 0 ? 0.75 * *seconds + 0.25 * t->took : t->took;
  t->took = 0;
  t->step = 0;
  t->round++;
}

void packing_i_dem_run(packing_dem *dem, size_t blocks, packing_block_function fn,
                       void *arg)
{
  packing_i_parallel(dem->threads.one ? NULL : dem->context, blocks, fn, arg);
}
