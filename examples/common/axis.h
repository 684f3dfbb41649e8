/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_AXIS_H
#define EXAMPLES_AXIS_H

/* Axes: where a value stands, and round numbers for the ticks. */

#include <stddef.h>

enum { AXIS_TICKS = 24 };

typedef struct axis_range {
  double lo, hi; /* lo < hi; logarithmic: lo > 0 */
  int logarithmic;
  size_t count;
  double tick[AXIS_TICKS];
} axis_range;

/* An axis over [lo, hi], logarithmic where hi / lo exceeds 3 and `may_be_logarithmic`; an
 * empty range is widened. */
void axis_init(axis_range *a, double lo, double hi, int may_be_logarithmic);

/* Leaves at most half of the ticks, for a narrow panel. */
void axis_thin(axis_range *a);

/* From 0 at lo to 1 at hi. */
double axis_place(const axis_range *a, double value);
double axis_value(const axis_range *a, double place);

#endif
