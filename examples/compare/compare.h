/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_COMPARE_H
#define EXAMPLES_COMPARE_H

/* packing-compare: sets of numbers, where they come from, and what is made of them. Functions
 * return 0, or an exit code after one line on standard error. */

#include <argp.h>
#include "../common/fit.h"
#include "../common/output.h"
#include "../common/report.h"
#include "../common/stat.h"

enum { COMPARE_MOST_SETS = 100, COMPARE_TESTS = 6 };

/* Tests, in the order of their names. */
enum {
  TEST_WELCH = 1,
  TEST_MANN_WHITNEY = 2,
  TEST_KS = 4,
  TEST_ANOVA = 8,
  TEST_DIXON = 16,
  TEST_CURVES = 32
};

extern const char *const compare_test_names[COMPARE_TESTS];

typedef enum source_kind { SOURCE_FILES, SOURCE_VALUES, SOURCE_SUMMARY } source_kind;

/* One option that brings sets. */
typedef struct source {
  source_kind kind;
  const char *option; /* "--a" */
  char *name;         /* of the set; NULL: that of the column, or a number */
  const char **files; /* as typed */
  size_t file_count;
  stat_summary figures; /* of SOURCE_SUMMARY */
} source;

typedef struct compare_options {
  source *sources;
  size_t source_count;
  const char *key;                  /* dotted; NULL: not given */
  unsigned tests;                   /* sum of TEST_ */
  int fits[FIT_LAWS];               /* 1: asked for */
  size_t bootstrap;                 /* samples, default 1000 */
  uint64_t seed;                    /* default 1 */
  const char *report;               /* NULL: standard output */
  const char *test_text, *fit_text; /* as typed, or NULL */
  int quiet;
  outputs outputs;
} compare_options;

extern const struct argp compare_argp;
void compare_options_init(compare_options *o);
void compare_options_free(compare_options *o);
int compare_options_check(const compare_options *o);

/* A set of numbers, or their figures only. */
typedef struct compare_set {
  char *name;
  const char *what; /* the key, "r" of packs, "values", "summary" */
  double *values;   /* sorted; NULL: figures only */
  size_t count;
  stat_summary figures;
  stat_dixon dixon;
  fit_result fits[FIT_LAWS];
  size_t fit_count; /* in order of rank */
} compare_set;

typedef struct compare_pair {
  size_t a, b;
  stat_welch welch;
  stat_mann_whitney mann_whitney;
  stat_ks ks;
  packing_curve_errors_report curves; /* of b, where a was asked; NaN: not made */
} compare_pair;

typedef struct compare_job {
  compare_options *asked;
  packing_context *context;
  input_files input;
  compare_set *sets;
  size_t set_count;
  compare_pair *pairs;
  size_t pair_count;
  stat_anova anova;
} compare_job;

/* Adds the numbers of a report (by the key) or the radii of a pack, [FORMAT:]FILE, to a set. */
int compare_add_file(compare_job *job, const char *option, const char *name,
                     compare_set *set);

/* Adds one set for each column of a file of numbers. */
int compare_add_columns(compare_job *job, const char *option, const char *path);

/* A new set, with nothing in it; the name is copied. */
compare_set *compare_new_set(compare_job *job, const char *name);
void compare_add_value(compare_set *set, double value);

/* All sets that were asked for. */
int compare_gather(compare_job *job);

/* All tests and fits. */
int compare_run(compare_job *job);

/* The report, which takes no part of the job over; and the summary for people. */
cJSON *compare_report(const compare_job *job, const char *command);
void compare_print(const compare_job *job);

void compare_job_free(compare_job *job);

#endif
