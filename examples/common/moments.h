/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_MOMENTS_H
#define EXAMPLES_MOMENTS_H

/* Mean and standard deviation of a sample. */

#include <stddef.h>

typedef struct moments {
  double mean; /* NaN of none */
  double sd;   /* of a sample (divisor n - 1); NaN of fewer than two */
} moments;

moments moments_of(const double *values, size_t count);

#endif
