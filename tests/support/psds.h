/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_PSDS_H
#define PACKING_TEST_PSDS_H

/* One size distribution of each kind, for tests that hold for all of them. */

#include "test.h"

enum {
  TEST_PSD_MONO,
  TEST_PSD_UNIFORM,
  TEST_PSD_NORMAL,
  TEST_PSD_LOGNORMAL,
  TEST_PSD_WEIBULL,
  TEST_PSD_GAMMA,
  TEST_PSD_EXPONENTIAL,
  TEST_PSD_DISCRETE,
  TEST_PSD_CURVE,
  TEST_PSD_CURVE_LINEAR,
  TEST_PSD_SAMPLE,
  TEST_PSD_SMOOTHED,
  TEST_PSD_MIXTURE,
  TEST_PSD_KINDS
};

const char *test_psd_name(int kind);

/* Lengths are in units of `unit`. */
packing_status test_psd_create(packing_context *context, int kind, double unit,
                               packing_by by, int dim, packing_psd **psd);

/* The same, asserting success. */
packing_psd *test_psd(int kind, double unit, packing_by by, int dim);

/* E[r^power], asserting success. */
double test_psd_moment(const packing_psd *psd, packing_by by, int power);

#endif
