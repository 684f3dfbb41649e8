/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "../common/options.h"
#include "../common/program.h"
#include "compare.h"

const char *const compare_test_names[COMPARE_TESTS] = {"welch", "mann-whitney", "ks",
                                                       "anova", "dixon",        "curves"};

enum {
  KEY_A = 0x500,
  KEY_B,
  KEY_SET,
  KEY_VALUES,
  KEY_SUMMARY,
  KEY_KEY,
  KEY_TEST,
  KEY_FIT,
  KEY_BOOTSTRAP,
  KEY_SEED,
  KEY_REPORT,
  KEY_QUIET
};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "Sets of numbers, as many as wanted:", 1},
    {"a", KEY_A, "FILE...", 0,
     "the set named a: a number of each report (--key; a report of several packs gives "
     "as "
     "many), or the radii of packs, each as [FORMAT:]FILE in the formats that "
     "packing-convert reads",
     1},
    {"b", KEY_B, "FILE...", 0, "the set named b", 1},
    {"set", KEY_SET, "NAME=FILE...", 0, "a set of any name; may be repeated", 1},
    {"key", KEY_KEY, "KEY", 0,
     "which number of a report: volume_fraction, coordination.mean, "
     "fabric.eigenvalues.0, ...",
     1},
    {"values", KEY_VALUES, "FILE", 0,
     "a set from each column of numbers; columns are parted by commas or blanks, the "
     "first line may name them, # begins a remark",
     1},
    {"summary", KEY_SUMMARY, "[NAME=]MEAN,SD,N", 0,
     "a set known in figures only; its standard error as se=E may stand in place of N",
     1},
    {NULL, 0, NULL, 0, "What to do:", 2},
    {"test", KEY_TEST, "LIST", 0,
     "some of welch, mann-whitney, ks (each two sets), anova (all sets), dixon (each "
     "set), parted by commas (default: all of these; none: none); curves: each two sets "
     "of "
     "equal size are rising curves at the same points, the first asked and the second "
     "got, and their errors are told",
     2},
    {"fit", KEY_FIT, "LIST", 0,
     "fit laws to each set, ranked by how well they fit: some of normal, lognormal, "
     "weibull, gamma, exponential, uniform, cauchy, chi-square, or all (default: none)",
     2},
    {"bootstrap", KEY_BOOTSTRAP, "N", 0,
     "samples drawn from each fitted law for its p-value (default 1000; 0: none)", 2},
    {"seed", KEY_SEED, "N", 0, "64-bit seed of these samples (default 1)", 2},
    {NULL, 0, NULL, 0, "Results:", 3},
    {"report", KEY_REPORT, "FILE", 0,
     "write the JSON report there (default: standard output)", 3},
    {"quiet", KEY_QUIET, NULL, 0, "no summary on standard error, no progress bar", 3},
    {NULL, 0, NULL, 0, NULL, 0},
};

static source *add_source(compare_options *o, source_kind kind, const char *option)
{
  o->sources = program_take_more(o->sources, o->source_count + 1, sizeof *o->sources);
  source *s = &o->sources[o->source_count++];
  memset(s, 0, sizeof *s);
  s->kind = kind;
  s->option = option;
  return s;
}

static int add_file(source *s, const char *path)
{
  if (!*path)
    return program_fail(PROGRAM_BAD_INPUT, "%s: a file name is missing", s->option);
  s->files = program_take_more(s->files, s->file_count + 1, sizeof *s->files);
  s->files[s->file_count++] = path;
  return 0;
}

static int read_set(compare_options *o, const char *option, const char *name,
                    const char *path)
{
  source *s = add_source(o, SOURCE_FILES, option);
  s->name = program_copy(name, strlen(name));
  return add_file(s, path);
}

static int read_named_set(compare_options *o, const char *text)
{
  const char *equals = strchr(text, '=');
  if (!equals || equals == text)
    return program_fail(PROGRAM_BAD_INPUT, "--set: '%s' is not NAME=FILE", text);
  source *s = add_source(o, SOURCE_FILES, "--set");
  s->name = program_copy(text, (size_t)(equals - text));
  return add_file(s, equals + 1);
}

/* N, or se=E: then n = (sd / E)^2. */
static int read_size(const char *word, stat_summary *s)
{
  double v = 0;
  if (strncmp(word, "se=", 3) == 0) {
    const int code = number_positive("--summary: se", word + 3, &v);
    s->n = s->sd / v * (s->sd / v);
    return code;
  }
  uint64_t n = 0;
  const int code = number_whole("--summary: N", word, 1, UINT32_MAX, &n);
  s->n = (double)n;
  return code;
}

static int read_figures(char *copy, const char *text, stat_summary *s)
{
  size_t count = 0;
  char **words = spec_split(copy, ',', &count);
  int code = 0;
  if (count != 3)
    code = program_fail(PROGRAM_BAD_INPUT,
                        "--summary: '%s' is not MEAN,SD,N or MEAN,SD,se=E", text);
  if (!code)
    code = number_real("--summary: MEAN", words[0], &s->mean);
  if (!code)
    code = number_positive("--summary: SD", words[1], &s->sd);
  if (!code)
    code = read_size(words[2], s);
  if (!code && !(s->n > 1))
    code = program_fail(PROGRAM_BAD_INPUT,
                        "--summary: %s leaves %.4g numbers, not more "
                        "than 1",
                        text, s->n);
  free(words);
  return code;
}

static int read_summary(compare_options *o, const char *text)
{
  source *s = add_source(o, SOURCE_SUMMARY, "--summary");
  const size_t first = strcspn(text, ",="), named = text[first] == '=' ? first : 0;
  if (named)
    s->name = program_copy(text, named);
  char *copy = program_copy(text, strlen(text));
  const int code = read_figures(named ? copy + named + 1 : copy, text, &s->figures);
  free(copy);
  return code;
}

static int read_values(compare_options *o, const char *path)
{
  return add_file(add_source(o, SOURCE_VALUES, "--values"), path);
}

/* Which of the names a word is; -1: none. */
static int find_test(const char *word)
{
  for (int k = 0; k < COMPARE_TESTS; k++)
    if (strcmp(word, compare_test_names[k]) == 0)
      return k;
  return -1;
}

static int read_tests(compare_options *o, const char *text)
{
  size_t count = 0;
  int code = 0;
  o->test_text = text;
  o->tests = 0;
  if (strcmp(text, "none") == 0)
    return 0;
  char *copy = program_copy(text, strlen(text)), **words = spec_split(copy, ',', &count);
  for (size_t i = 0; i < count && !code; i++) {
    const int k = find_test(words[i]);
    if (k < 0)
      code = program_fail(PROGRAM_BAD_INPUT,
                          "--test: '%s' is not welch, mann-whitney, ks, anova, dixon or "
                          "curves",
                          words[i]);
    else
      o->tests |= 1U << k;
  }
  free(words);
  free(copy);
  return code;
}

static int read_law(compare_options *o, const char *word)
{
  char known[160] = "";
  int found = 0;
  for (int k = 0; k < FIT_LAWS; k++) {
    spec_list(known, sizeof known, fit_laws[k]->name);
    if (strcmp(word, "all") == 0 || strcmp(word, fit_laws[k]->name) == 0)
      found = o->fits[k] = 1;
  }
  if (found)
    return 0;
  return program_fail(PROGRAM_BAD_INPUT, "--fit: '%s' is none of all, %s", word, known);
}

static int read_fits(compare_options *o, const char *text)
{
  size_t count = 0;
  int code = 0;
  o->fit_text = text;
  char *copy = program_copy(text, strlen(text)), **words = spec_split(copy, ',', &count);
  for (size_t i = 0; i < count && !code; i++)
    code = read_law(o, words[i]);
  free(words);
  free(copy);
  return code;
}

static int read_bootstrap(compare_options *o, const char *text)
{
  uint64_t n = 0;
  const int code = number_whole("--bootstrap", text, 0, 10000000, &n);
  o->bootstrap = (size_t)n;
  return code;
}

static int read_report(compare_options *o, const char *text)
{
  if (o->report)
    return program_fail(PROGRAM_BAD_INPUT, "--report: given twice");
  o->report = text;
  return outputs_add_report(&o->outputs, "--report", text);
}

static int read_key(compare_options *o, const char *text)
{
  if (o->key)
    return program_fail(PROGRAM_BAD_INPUT, "--key: given twice");
  if (!*text)
    return program_fail(PROGRAM_BAD_INPUT, "--key: a name is missing");
  o->key = text;
  return 0;
}

/* A word that belongs to no option goes to the set before it. */
static int read_word(compare_options *o, const char *text)
{
  source *last = o->source_count ? &o->sources[o->source_count - 1] : NULL;
  if (!last || last->kind != SOURCE_FILES)
    return program_fail(PROGRAM_BAD_INPUT,
                        "'%s' is no option, and follows no --a, --b or "
                        "--set",
                        text);
  return add_file(last, text);
}

/* The exit code of reading one option; -1 for keys that are none of ours. */
static int read_option(int key, const char *text, compare_options *o)
{
  switch (key) {
  case KEY_A:
    return read_set(o, "--a", "a", text);
  case KEY_B:
    return read_set(o, "--b", "b", text);
  case KEY_SET:
    return read_named_set(o, text);
  case KEY_VALUES:
    return read_values(o, text);
  case KEY_SUMMARY:
    return read_summary(o, text);
  case KEY_KEY:
    return read_key(o, text);
  case KEY_TEST:
    return read_tests(o, text);
  case KEY_FIT:
    return read_fits(o, text);
  case KEY_BOOTSTRAP:
    return read_bootstrap(o, text);
  case KEY_SEED:
    return number_whole("--seed", text, 0, UINT64_MAX, &o->seed);
  case KEY_REPORT:
    return read_report(o, text);
  case KEY_QUIET:
    o->quiet = 1;
    return 0;
  case ARGP_KEY_ARG:
    return read_word(o, text);
  default:
    return -1;
  }
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
  if (key == ARGP_KEY_INIT) {
    state->err_stream =
        NULL; /* getopt's line says what is wrong, argp's would not add to it */
    return 0;
  }
  const int code = read_option(key, argument, state->input);
  if (code > 0)
    exit(code);
  return code == 0 ? 0 : ARGP_ERR_UNKNOWN;
}

const struct argp compare_argp = {
    .options = table,
    .parser = parse,
    .args_doc = "--a=FILE... --b=FILE...",
    .doc =
        "Compares sets of numbers, as studies with many packs give them: numbers out of "
        "reports, radii of packs, columns of a table, or mean, standard deviation and "
        "size alone.\v"
        "Tests: Welch's t (two means, any variances), Mann-Whitney's U (two sets, by "
        "rank; "
        "exact for at most 50 numbers each without ties), Kolmogorov-Smirnov (two sets, "
        "the largest distance of their curves; exact up to 1e7 pairs), one-way analysis "
        "of variance (all sets), Dixon's Q (is the number farthest off an outlier? 3 to "
        "30 numbers). Curves: MAE, MSE, RMAE and MRE, the means of |e|, e^2, |e| / asked "
        "and e / "
        "asked over the points, e = asked - got. All p-values are two-sided. Sets known "
        "in figures only take part "
        "in "
        "Welch's test and the analysis of variance.\n\n"
        "Fits are of maximum likelihood. Their p is the share of samples drawn from the "
        "fitted law that lie as far (Kolmogorov-Smirnov) from their own fit; "
        "kolmogorov_p, which takes the law as known beforehand, is too large.\n\n"
        "Exit status: 0 done, whatever the tests say; 2 bad input; 3 input, output or "
        "memory; 130 interrupted.",
};

void compare_options_init(compare_options *o)
{
  memset(o, 0, sizeof *o);
  o->tests = TEST_WELCH | TEST_MANN_WHITNEY | TEST_KS | TEST_ANOVA | TEST_DIXON;
  o->bootstrap = 1000;
  o->seed = 1;
}

void compare_options_free(compare_options *o)
{
  for (size_t i = 0; i < o->source_count; i++) {
    free(o->sources[i].name);
    free(o->sources[i].files);
  }
  free(o->sources);
  outputs_free(&o->outputs);
}

int compare_options_check(const compare_options *o)
{
  if (o->source_count == 0)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--a, --set, --values or --summary is missing; see --help");
  for (size_t i = 0; i < o->source_count; i++)
    for (size_t j = 0; j < i && o->sources[i].name; j++)
      if (o->sources[j].name && strcmp(o->sources[i].name, o->sources[j].name) == 0)
        return program_fail(PROGRAM_BAD_INPUT, "%s: two sets are named %s",
                            o->sources[i].option, o->sources[i].name);
  return 0;
}
