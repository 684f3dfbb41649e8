/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_REPORT_H
#define EXAMPLES_REPORT_H

/* The JSON report that every program writes: one shape, fixed order, what does not apply is
 * null and never missing. */

#include <cjson/cJSON.h>
#include "pack.h"

/* "Not known": real numbers NaN, counts REPORT_NONE. */
#define REPORT_NONE SIZE_MAX

typedef struct report {
  const char *program;
  const char *command;
  cJSON *options; /* becomes the report's */
  const input_files *input;
  uint64_t seed;
  int threads;
  int dim;
  size_t particles;
  double domain_volume, solid_volume, volume_fraction, volume_fraction_inner;
  double coordination_mean, coordination_mean_no_rattlers, coordination_tolerance;
  size_t rattlers;
  const size_t *histogram; /* NULL: none */
  size_t histogram_bins;
  double max_overlap, max_protrusion, audit_limit;
  int audit_passed; /* 1, 0, or -1: not made */
  double ks, ks_limit, ks_mass, mean_relative_error;
  size_t unplaced;
  double time_place, time_settle, time_measure, time_total;
} report;

/* All unknown. */
void report_init(report *r);

/* The text, with a newline at its end; free it. Ends the program when memory is out. */
char *report_text(const report *r);

/* Numbers of full precision in a JSON object; NaN and REPORT_NONE become null. */
void report_add_real(cJSON *object, const char *key, double value);
void report_add_count(cJSON *object, const char *key, size_t value);
void report_add_u64(cJSON *object, const char *key, uint64_t value);
void report_add_text(cJSON *object, const char *key, const char *value);
void report_add_flag(cJSON *object, const char *key, int value);
cJSON *report_add_list(cJSON *object, const char *key);
void report_append_text(cJSON *list, const char *value);

#endif
