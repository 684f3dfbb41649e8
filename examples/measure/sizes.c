/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes asked against sizes placed: curves, sieves, errors, tests, components. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/pack.h"
#include "../common/program.h"
#include "../common/tap.h"
#include "measure.h"

/* ---- sieves ---- */

static int falling(const void *a, const void *b)
{
  const double p = *(const double *)a, q = *(const double *)b;
  return p > q ? -1 : p < q;
}

static int add_opening(measure_job *job, const char *where, const char *word)
{
  sizes_found *found = &job->sizes;
  found->openings = program_take_more(found->openings, found->opening_count + 1,
                                      sizeof *found->openings);
  return number_positive(where, word, &found->openings[found->opening_count++]);
}

static int read_list(measure_job *job, const char *text)
{
  size_t count = 0;
  char *copy = program_copy(text, strlen(text));
  char **words = spec_split(copy, ',', &count);
  int code = 0;
  for (size_t i = 0; i < count && !code; i++)
    code = add_opening(job, "--sieves", words[i]);
  free(words);
  free(copy);
  return code;
}

/* One opening a line; `#` lines and blank lines are skipped. */
static int read_lines(measure_job *job, char *text)
{
  size_t count = 0;
  char **lines = spec_split(text, '\n', &count);
  int code = 0;
  for (size_t i = 0; i < count && !code; i++) {
    char where[128];
    char *line = lines[i] + strspn(lines[i], " \t\r");
    line[strcspn(line, " \t\r")] = '\0';
    snprintf(where, sizeof where, "--sieves: %.80s: line %zu", job->asked->sieves_text,
             i + 1);
    if (*line && *line != '#')
      code = add_opening(job, where, line);
  }
  free(lines);
  return code;
}

enum { SIEVE_FILE = 65536 }; /* bytes, at most */

static int read_file(measure_job *job, const char *path)
{
  packing_file *file = NULL;
  char *text = program_take(SIEVE_FILE + 1, 1);
  tap t;
  size_t used = 0, got = 1;
  packing_status status = packing_file_open(job->context, path, &file);
  if (status == PACKING_OK)
    tap_open(&t, packing_file_stream(file));
  while (status == PACKING_OK && got && used < SIEVE_FILE) {
    status = t.stream.read(t.stream.user, text + used, SIEVE_FILE - used, &got);
    used += status == PACKING_OK ? got : 0;
  }
  int code = status == PACKING_OK ? 0 : measure_failed(job, status, "--sieves");
  if (!code && used == SIEVE_FILE)
    code = program_fail(PROGRAM_BAD_INPUT, "--sieves: %s is no list of sieves", path);
  if (!code)
    tap_note(&t, &job->files, path);
  packing_file_close(file);
  if (!code)
    code = read_lines(job, text);
  free(text);
  return code;
}

int sizes_read_sieves(measure_job *job)
{
  const char *text = job->asked->sieves_text;
  sizes_found *found = &job->sizes;
  if (!text)
    return 0;
  int code = strspn(text, "0123456789.,eE+-") == strlen(text) ? read_list(job, text)
                                                              : read_file(job, text);
  if (code)
    return code;
  if (found->opening_count == 0)
    return program_fail(PROGRAM_BAD_INPUT, "--sieves: %s has no opening", text);
  qsort(found->openings, found->opening_count, sizeof *found->openings, falling);
  for (size_t i = 1; i < found->opening_count; i++)
    if (found->openings[i] == found->openings[i - 1])
      return program_fail(PROGRAM_BAD_INPUT, "--sieves: %.9g stands twice",
                          found->openings[i]);
  return 0;
}

/* ---- measuring ---- */

static void find_range(const measure_job *job, sizes_found *found)
{
  const pack p = {.view = job->view};
  double sum = 0;
  found->lo = (double)INFINITY;
  found->hi = 0;
  for (size_t i = 0; i < job->view.count; i++) {
    const double r = pack_radius(&p, i);
    found->lo = fmin(found->lo, r);
    found->hi = fmax(found->hi, r);
  }
  /* From the smallest, so that the mean of equal ones is theirs. */
  for (size_t i = 0; i < job->view.count; i++)
    sum += pack_radius(&p, i) - found->lo;
  found->mean = found->lo + sum / (double)job->view.count;
}

/* Radii of the curves: even steps of the logarithm over all that is asked and there is. */
static void choose_radii(const measure_job *job, sizes_found *found)
{
  double lo = found->lo, hi = found->hi;
  if (job->psd) {
    lo = fmin(lo, packing_psd_min_r(job->psd));
    hi = fmax(hi, packing_psd_max_r(job->psd));
  }
  for (size_t k = 0; k < CURVE_POINTS; k++)
    found->r[k] =
        k == CURVE_POINTS - 1 ? hi : lo * pow(hi / lo, (double)k / (CURVE_POINTS - 1));
}

static packing_status take_curve(measure_job *job, packing_by by)
{
  sizes_found *found = &job->sizes;
  packing_size_curve_def def;
  packing_size_curve_def_init(&def);
  def.by = by;
  def.dim = job->spec.dim;
  return packing_measure_size_curve(
      job->context, &def, job->psd, &job->view, CURVE_POINTS, found->r,
      job->psd ? found->asked[by] : NULL, found->placed[by]);
}

static packing_status take_sieves(measure_job *job)
{
  sizes_found *found = &job->sizes;
  packing_sieves_def def;
  if (found->opening_count == 0)
    return PACKING_OK;
  packing_sieves_def_init(&def);
  def.count = found->opening_count;
  def.opening_d = found->openings;
  def.dim = job->spec.dim;
  found->sieves = program_take(def.count + 1, sizeof *found->sieves);
  return packing_measure_sieves(job->context, &def, job->psd, &job->view, found->sieves);
}

/* Per cent by mass: passing the sieves, or without any at the points of the curve. */
static packing_status take_errors(measure_job *job)
{
  sizes_found *found = &job->sizes;
  const size_t count = found->sieves ? found->opening_count : CURVE_POINTS;
  double *asked = program_take(count, sizeof *asked);
  double *placed = program_take(count, sizeof *placed);
  for (size_t k = 0; k < count; k++) {
    asked[k] = found->sieves ? found->sieves[k].asked_passing
                             : 100 * found->asked[PACKING_BY_MASS][k];
    placed[k] = found->sieves ? found->sieves[k].placed_passing
                              : 100 * found->placed[PACKING_BY_MASS][k];
  }
  packing_curve_errors_report_init(&found->errors);
  const packing_status status =
      packing_measure_curve_errors(job->context, count, asked, placed, &found->errors);
  free(placed);
  free(asked);
  return status;
}

/* A pack from elsewhere may not know its components. */
static packing_status take_components(measure_job *job)
{
  sizes_found *found = &job->sizes;
  const size_t count = packing_psd_components(job->psd);
  const pack p = {.view = job->view};
  if (count > 1 && (!job->view.component.data || pack_components(&p) > count))
    return PACKING_OK;
  found->components = program_take(count, sizeof *found->components);
  found->component_count = count;
  return packing_measure_components(job->context, job->psd, &job->view,
                                    found->components);
}

static packing_status compare(measure_job *job)
{
  packing_size_tests_report_init(&job->sizes.tests);
  packing_status status = take_errors(job);
  if (status == PACKING_OK)
    status = packing_measure_size_tests(job->context, NULL, job->psd, &job->view,
                                        &job->sizes.tests);
  if (status == PACKING_OK)
    status = take_components(job);
  return status;
}

int sizes_measure(measure_job *job)
{
  find_range(job, &job->sizes);
  choose_radii(job, &job->sizes);
  packing_status status = take_curve(job, PACKING_BY_NUMBER);
  if (status == PACKING_OK)
    status = take_curve(job, PACKING_BY_MASS);
  if (status == PACKING_OK)
    status = take_sieves(job);
  if (status == PACKING_OK && job->psd)
    status = compare(job);
  job->sizes.made = status == PACKING_OK;
  return status == PACKING_OK ? 0 : measure_failed(job, status, "sizes");
}

/* ---- reporting ---- */

static void report_curves(cJSON *all, const sizes_found *found, int asked)
{
  static const char *const names[2][2] = {{"number_asked", "number_placed"},
                                          {"mass_asked", "mass_placed"}};
  cJSON *made = report_add_object(all, "curve");
  cJSON *d = report_add_list(made, "diameter");
  for (size_t k = 0; k < CURVE_POINTS; k++)
    report_append_real(d, 2 * found->r[k]);
  for (int by = 0; by < 2; by++) {
    if (asked)
      report_add_reals(made, names[by][0], found->asked[by], CURVE_POINTS);
    else
      report_add_text(made, names[by][0], NULL);
    report_add_reals(made, names[by][1], found->placed[by], CURVE_POINTS);
  }
}

static cJSON *report_sieves(const sizes_found *found)
{
  if (!found->sieves)
    return NULL;
  cJSON *made = report_new();
  cJSON *opening = report_add_list(made, "opening");
  cJSON *asked = report_add_list(made, "retained_asked");
  cJSON *placed = report_add_list(made, "retained_placed");
  cJSON *asked_passing = report_add_list(made, "passing_asked");
  cJSON *passing = report_add_list(made, "passing_placed");
  for (size_t k = 0; k <= found->opening_count; k++) {
    report_append_real(opening, found->sieves[k].opening_d);
    report_append_real(asked, found->sieves[k].asked_retained);
    report_append_real(placed, found->sieves[k].placed_retained);
    report_append_real(asked_passing, found->sieves[k].asked_passing);
    report_append_real(passing, found->sieves[k].placed_passing);
  }
  return made;
}

static cJSON *report_errors(const packing_curve_errors_report *e)
{
  cJSON *made = report_new();
  report_add_real(made, "mae", e->mae);
  report_add_real(made, "mse", e->mse);
  report_add_real(made, "rmae", e->rmae);
  report_add_real(made, "mre", e->mre);
  return made;
}

static cJSON *report_tests(const packing_size_tests_report *t)
{
  cJSON *made = report_new();
  report_add_real(made, "ks", t->ks);
  report_add_real(made, "ks_p", t->ks_p);
  report_add_real(made, "chi_square", t->chi_square);
  report_add_count(made, "chi_square_bins", t->bins);
  report_add_real(made, "chi_square_p", t->chi_square_p);
  return made;
}

static void report_component(cJSON *list, const packing_size_component *c)
{
  cJSON *made = report_new();
  report_append_item(list, made);
  report_add_count(made, "count", c->count);
  report_add_real(made, "number_asked", c->number_asked);
  report_add_real(made, "number_placed", c->number_placed);
  report_add_real(made, "number_sd", c->number_sd);
  report_add_real(made, "mass_asked", c->mass_asked);
  report_add_real(made, "mass_placed", c->mass_placed);
  report_add_real(made, "ks", c->ks);
  report_add_real(made, "ks_p", c->ks_p);
}

cJSON *sizes_report(const measure_job *job)
{
  const sizes_found *found = &job->sizes;
  if (!found->made)
    return NULL;
  cJSON *made = report_new();
  report_add_real(made, "min_r", found->lo);
  report_add_real(made, "max_r", found->hi);
  report_add_real(made, "mean_r", found->mean);
  report_curves(made, found, job->psd != NULL);
  report_add_item(made, "sieves", report_sieves(found));
  report_add_item(made, "errors", job->psd ? report_errors(&found->errors) : NULL);
  report_add_item(made, "tests", job->psd ? report_tests(&found->tests) : NULL);
  cJSON *list = report_add_list(made, "components");
  for (size_t k = 0; k < found->component_count; k++)
    report_component(list, &found->components[k]);
  return made;
}
