/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_REPORT_H
#define EXAMPLES_REPORT_H

/* The JSON report that every program writes: one shape, fixed order, what does not apply is
 * null and never missing. */

#include <cjson/cJSON.h>
#include "pack.h"

/* "Not known": real numbers NaN, counts REPORT_NONE. */
#define REPORT_NONE SIZE_MAX

/* A fabric tensor, of the library's report. */
typedef struct report_fabric {
  int known; /* 0: not measured */
  int dim;
  size_t count; /* directions in it */
  double eigenvalues[3], tensor[3][3], sd, noise_floor;
} report_fabric;

typedef struct report {
  const char *program;
  const char *command;
  cJSON *options; /* becomes the report's */
  const input_files *input;
  int seedless; /* 1: nothing random, the seed is null */
  uint64_t seed;
  int threads;
  int dim;
  size_t particles;
  double domain_volume, solid_volume, volume_fraction, volume_fraction_inner;
  double coordination_mean, coordination_mean_no_rattlers, coordination_tolerance;
  size_t rattlers;
  int histogram_known; /* 0: none */
  size_t histogram[PACKING_COORDINATION_BINS];
  report_fabric fabric;
  double max_overlap, max_protrusion, audit_limit;
  int audit_passed; /* 1, 0, or -1: not made */
  packing_audit_report audit;
  double ks, ks_limit, ks_mass, mean_relative_error;
  size_t unplaced;
  const char *own_key; /* of what only this program reports; NULL: nothing */
  cJSON *own;          /* becomes the report's */
  double time_place, time_settle, time_measure, time_total;
} report;

/* All unknown. */
void report_init(report *r);

/* The report as an object. Functions here end the program when memory is out. */
cJSON *report_object(report *r);

/* One report of several packs: what they share (with `options`, which becomes the report's),
 * then "packs" and "mean", "sd" and "cv" of their numbers; where `sets` > 1, "sets" of as many
 * packs each with the same four, the numbers of all packs, and "set_means", the same three of
 * the means of the sets. The `count` objects become the report's. Standard deviations are those
 * of samples (count - 1), null of one; a number that a pack does not have is null in all three. */
cJSON *report_packs(const report *shared, cJSON *options, cJSON **packs, size_t count,
                    size_t sets);

/* The text, with a newline at its end; free it. The object is freed. */
char *report_text(cJSON *object);

/* Numbers of full precision in a JSON object; NaN and REPORT_NONE become null. */
void report_add_real(cJSON *object, const char *key, double value);
void report_add_count(cJSON *object, const char *key, size_t value);
void report_add_u64(cJSON *object, const char *key, uint64_t value);
void report_add_text(cJSON *object, const char *key, const char *value);
void report_add_flag(cJSON *object, const char *key, int value);
cJSON *report_add_object(cJSON *object, const char *key);
cJSON *report_add_list(cJSON *object, const char *key);
void report_append_text(cJSON *list, const char *value);
void report_append_count(cJSON *list, size_t value);
void report_append_real(cJSON *list, double value);

/* A list of `count` numbers, and a fabric, all null where it is not known. */
void report_add_reals(cJSON *object, const char *key, const double *values, size_t count);
void report_add_fabric(cJSON *object, const char *key, const report_fabric *fabric);

/* Puts an object or list of its own into another; NULL: null. */
void report_add_item(cJSON *object, const char *key, cJSON *item);
void report_append_item(cJSON *list, cJSON *item);

/* An empty object. */
cJSON *report_new(void);

#endif
