/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_BENCH_H
#define PACKING_BENCH_H

/* What the benchmarks share. Define _POSIX_C_SOURCE 199309L or later before including it. */

#include <packing/packing.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Seconds of wall clock. */
static inline double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Ends the program when a call failed. */
static inline void must(packing_status status)
{
  if (status == PACKING_OK)
    return;
  fprintf(stderr, "%s\n", packing_status_string(status));
  exit(1);
}

#endif
