/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether threads pay. A step meets them three times: few particles, or a machine that others use
 * too, and one thread is faster than several that wait for each other. Now and then some steps
 * are timed either way and the faster way is taken; the bytes are the same. */
#define _POSIX_C_SOURCE 200809L
#include "stepper_internal.h"
#include <time.h>

enum { PROBE = 8, ROUND = 1024 }; /* steps of a probe, and from one to the next */

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void packing_i_threads_begin(packing_dem *dem)
{
  packing_i_threads *t = &dem->threads;
  if (t->step == 0)
    t->together = t->alone = 0;
  t->one = t->step < PROBE ? 0 : t->step < 2 * PROBE ? 1 : t->alone < t->together;
  if (t->step < 2 * PROBE)
    t->start = now();
}

void packing_i_threads_end(packing_dem *dem)
{
  packing_i_threads *t = &dem->threads;
  if (t->step < 2 * PROBE)
    *(t->one ? &t->alone : &t->together) += now() - t->start;
  t->step = (t->step + 1) % ROUND;
}

void packing_i_dem_run(packing_dem *dem, size_t blocks, packing_block_function fn,
                       void *arg)
{
  packing_i_parallel(dem->threads.one ? NULL : dem->context, blocks, fn, arg);
}
