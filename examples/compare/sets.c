/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "../common/progress.h"
#include "compare.h"

compare_set *compare_new_set(compare_job *job, const char *name)
{
  job->sets = program_take_more(job->sets, job->set_count + 1, sizeof *job->sets);
  compare_set *set = &job->sets[job->set_count++];
  memset(set, 0, sizeof *set);
  set->name = program_copy(name, strlen(name));
  return set;
}

/* Room doubles at each power of two. */
void compare_add_value(compare_set *set, double value)
{
  if ((set->count & (set->count - 1)) == 0)
    set->values = program_take_more(set->values, set->count ? 2 * set->count : 1,
                                    sizeof *set->values);
  set->values[set->count++] = value;
}

static int gather_files(compare_job *job, const source *s)
{
  compare_set *set = compare_new_set(job, s->name);
  int code = 0;
  for (size_t i = 0; i < s->file_count && !code; i++)
    code = compare_add_file(job, s->option, s->files[i], set);
  if (!code && set->count == 0)
    code = program_fail(PROGRAM_BAD_INPUT, "%s: %s has no particles", s->option,
                        s->files[0]);
  if (set->what && strcmp(set->what, "report") == 0)
    set->what = job->asked->key;
  return code;
}

static void gather_summary(compare_job *job, const source *s)
{
  char name[32];
  snprintf(name, sizeof name, "%zu", job->set_count + 1);
  compare_set *set = compare_new_set(job, s->name ? s->name : name);
  set->what = "summary";
  set->figures = s->figures;
}

static int gather_one(compare_job *job, const source *s)
{
  switch (s->kind) {
  case SOURCE_FILES:
    return gather_files(job, s);
  case SOURCE_VALUES:
    return compare_add_columns(job, s->option, s->files[0]);
  default:
    gather_summary(job, s);
    return 0;
  }
}

int compare_gather(compare_job *job)
{
  for (size_t i = 0; i < job->asked->source_count; i++) {
    const int code = gather_one(job, &job->asked->sources[i]);
    if (code)
      return code;
    if (job->set_count > COMPARE_MOST_SETS)
      return program_fail(PROGRAM_BAD_INPUT, "%s: more than %d sets",
                          job->asked->sources[i].option, COMPARE_MOST_SETS);
  }
  for (size_t i = 0; i < job->set_count; i++) {
    compare_set *set = &job->sets[i];
    if (!set->values)
      continue;
    stat_sort(set->values, set->count);
    set->figures = stat_summarise(set->values, set->count);
  }
  return 0;
}

/* ---- what is made of them ---- */

/* Of sets of equal size, else NaN. They are sorted, as cumulative curves are anyway. */
static packing_curve_errors_report compare_curves(const compare_set *asked,
                                                  const compare_set *got)
{
  packing_curve_errors_report found;
  packing_curve_errors_report_init(&found);
  if (asked->count != got->count ||
      packing_measure_curve_errors(NULL, asked->count, asked->values, got->values,
                                   &found) != PACKING_OK)
    found.mae = found.mse = found.rmae = found.mre = (double)NAN;
  return found;
}

static compare_pair compare_two(const compare_job *job, size_t a, size_t b)
{
  const double nan = (double)NAN;
  const compare_set *x = &job->sets[a], *y = &job->sets[b];
  const unsigned tests = job->asked->tests;
  compare_pair p = {.a = a,
                    .b = b,
                    .welch = {nan, nan, nan},
                    .mann_whitney = {nan, nan, 0},
                    .ks = {nan, nan, 0},
                    .curves = {.mae = nan, .mse = nan, .rmae = nan, .mre = nan}};
  if (tests & TEST_WELCH)
    p.welch = stat_welch_test(&x->figures, &y->figures);
  if (!x->values || !y->values)
    return p;
  if (tests & TEST_MANN_WHITNEY)
    p.mann_whitney = stat_mann_whitney_test(x->values, x->count, y->values, y->count);
  if (tests & TEST_KS)
    p.ks = stat_ks_test(x->values, x->count, y->values, y->count);
  if (tests & TEST_CURVES)
    p.curves = compare_curves(x, y);
  return p;
}

static int run_pairs(compare_job *job)
{
  const size_t n = job->set_count;
  job->pairs = program_take(n * (n - 1) / 2, sizeof *job->pairs);
  for (size_t a = 0; a < n; a++)
    for (size_t b = a + 1; b < n; b++) {
      if (interrupted())
        return program_interrupted();
      job->pairs[job->pair_count++] = compare_two(job, a, b);
    }
  return 0;
}

static void run_anova(compare_job *job)
{
  stat_summary *figures = program_take(job->set_count, sizeof *figures);
  const stat_anova none = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
  for (size_t i = 0; i < job->set_count; i++)
    figures[i] = job->sets[i].figures;
  job->anova =
      job->asked->tests & TEST_ANOVA ? stat_anova_test(figures, job->set_count) : none;
  free(figures);
}

typedef struct watch {
  progress bar;
  size_t done, all;
} watch;

static int watch_fits(void *user)
{
  watch *w = user;
  w->done++;
  progress_show(&w->bar, (double)w->done / (double)w->all, w->done);
  return interrupted() ? program_interrupted() : 0;
}

static int by_rank(const void *a, const void *b)
{
  const fit_result *x = a, *y = b;
  const size_t rx = x->fitted ? x->rank : SIZE_MAX, ry = y->fitted ? y->rank : SIZE_MAX;
  return rx != ry ? (rx > ry) - (rx < ry) : strcmp(x->law->name, y->law->name);
}

static int fit_set(const compare_job *job, compare_set *set, uint64_t stream, watch *w)
{
  const compare_options *o = job->asked;
  for (int k = 0; k < FIT_LAWS; k++) {
    if (!o->fits[k])
      continue;
    const int code =
        fit_sample(fit_laws[k], set->values, set->count, o->bootstrap, o->seed, stream,
                   watch_fits, w, &set->fits[set->fit_count]);
    if (code)
      return code;
    set->fit_count++;
  }
  fit_rank(set->fits, set->fit_count);
  qsort(set->fits, set->fit_count, sizeof *set->fits, by_rank);
  return 0;
}

static int run_fits(compare_job *job)
{
  watch w;
  size_t laws = 0, stream = 0;
  for (int k = 0; k < FIT_LAWS; k++)
    laws += job->asked->fits[k] != 0;
  if (laws == 0)
    return 0;
  w.done = 0;
  w.all = laws * job->set_count * (job->asked->bootstrap + 1);
  progress_start(&w.bar, "fitting", !job->asked->quiet);
  for (; stream < job->set_count; stream++) {
    compare_set *set = &job->sets[stream];
    const int code = set->values ? fit_set(job, set, stream, &w) : 0;
    if (code)
      return code;
  }
  progress_clear();
  return 0;
}

int compare_run(compare_job *job)
{
  for (size_t i = 0; i < job->set_count; i++) {
    compare_set *set = &job->sets[i];
    const int asked = set->values && (job->asked->tests & TEST_DIXON);
    set->dixon = stat_dixon_test(set->values, asked ? set->count : 0);
  }
  run_anova(job);
  const int code = run_pairs(job);
  return code ? code : run_fits(job);
}

void compare_job_free(compare_job *job)
{
  for (size_t i = 0; i < job->set_count; i++) {
    free(job->sets[i].name);
    free(job->sets[i].values);
  }
  free(job->sets);
  free(job->pairs);
  input_files_free(&job->input);
  packing_context_destroy(job->context);
}
