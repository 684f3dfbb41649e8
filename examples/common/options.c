/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "options.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "report.h"

enum {
  KEY_DOMAIN = 0x100,
  KEY_AND,
  KEY_OR,
  KEY_MINUS,
  KEY_PSD,
  KEY_COUNT,
  KEY_MASS,
  KEY_DENSITY,
  KEY_POROSITY,
  KEY_SEED,
  KEY_STREAM,
  KEY_THREADS,
  KEY_ISA,
  KEY_OUT,
  KEY_REPORT,
  KEY_MAX_OVERLAP,
  KEY_PLOT_SIZES,
  KEY_COLOUR,
  KEY_QUIET
};

/* Of every program. */
static const struct argp_option pack_table[] = {
    {NULL, 0, NULL, 0, "What and where:", 1},
    {"domain", KEY_DOMAIN, "SPEC", 0, "the container", 1},
    {"or", KEY_OR, "SPEC", 0, "joined with this one", 1},
    {"and", KEY_AND, "SPEC", 0, "only what lies in this one too", 1},
    {"minus", KEY_MINUS, "SPEC", 0, "without what lies in this one", 1},
    {NULL, 0, NULL, 0, "Randomness and machine:", 6},
    {"threads", KEY_THREADS, "N", 0, "threads (default all cores)", 6},
    {"isa", KEY_ISA, "NAME", 0,
     "instruction set: auto (default), baseline, avx2, avx512. Neither this nor the "
     "number of threads changes a result",
     6},
    {NULL, 0, NULL, 0, "Results:", 7},
    {"report", KEY_REPORT, "FILE", 0,
     "write the JSON report there (default: standard output)", 7},
    {"max-overlap", KEY_MAX_OVERLAP, "X", 0,
     "the audit fails above this overlap or protrusion, relative to the smaller radius "
     "(default 1e-9, after settling 0.01)",
     7},
    {"quiet", KEY_QUIET, NULL, 0, "no progress bar, no remarks, no summary", 7},
    {NULL, 0, NULL, 0, NULL, 0},
};

/* Of those that know of sizes asked for. */
static const struct argp_option sizes_table[] = {
    {"psd", KEY_PSD, "SPEC", 0, "the particle sizes", 1},
    {NULL, 0, NULL, 0, NULL, 0},
};

/* Of those that write packs. */
static const struct argp_option out_table[] = {
    {"density", KEY_DENSITY, "RHO", 0, "density of the particles (default 1000)", 1},
    {"out", KEY_OUT, "[FORMAT:]FILE", 0, output_help, 7},
    {"colour", KEY_COLOUR, "WHAT", 0,
     "what colours show in pictures of the pack: radius (default), component, height", 7},
    {"color", KEY_COLOUR, "WHAT", OPTION_ALIAS | OPTION_HIDDEN, NULL, 7},
    {NULL, 0, NULL, 0, NULL, 0},
};

/* Of those that make packs. */
static const struct argp_option make_table[] = {
    {"seed", KEY_SEED, "N", 0, "64-bit seed (default 1)", 6},
    {"stream", KEY_STREAM, "N", 0, "which pack of that seed (default 0)", 6},
    {"plot-sizes", KEY_PLOT_SIZES, "FILE", 0,
     "plot the sizes asked and placed (.png or .svg)", 7},
    {NULL, 0, NULL, 0, NULL, 0},
};

static const struct argp_option amount_table[] = {
    {NULL, 0, NULL, 0, "How much (at most one; none: as much as fits):", 2},
    {"count", KEY_COUNT, "N", 0, "so many particles", 2},
    {"mass", KEY_MASS, "M", 0, "particles of that mass, by --density", 2},
    {"target-porosity", KEY_POROSITY, "P", 0, "until so much of the container is void",
     2},
    {NULL, 0, NULL, 0, NULL, 0},
};

static const char *const colour_names[] = {"radius", "component", "height"};

const char *colour_name(colour_by colour)
{
  return colour_names[colour];
}

static int read_colour(const char *text, colour_by *colour)
{
  for (int i = 0; i < 3; i++)
    if (strcmp(colour_names[i], text) == 0) {
      *colour = (colour_by)i;
      return 0;
    }
  return program_fail(PROGRAM_BAD_INPUT,
                      "--colour: '%s' is not radius, component or height", text);
}

static int read_isa(const char *text, packing_isa *isa)
{
  for (int i = 0; i < PACKING_ISA_END; i++)
    if (strcmp(packing_isa_name((packing_isa)i), text) == 0) {
      *isa = (packing_isa)i;
      if (packing_isa_available(*isa))
        return 0;
      return program_fail(PROGRAM_BAD_INPUT, "--isa: this machine has no %s", text);
    }
  return program_fail(PROGRAM_BAD_INPUT,
                      "--isa: '%s' is not auto, baseline, avx2 or avx512", text);
}

static int read_max_overlap(const char *text, double *limit)
{
  const int code = number_real("--max-overlap", text, limit);
  if (!code && !(*limit >= 0 && *limit < 1))
    return program_fail(PROGRAM_BAD_INPUT, "--max-overlap: %s is not from 0 to below 1",
                        text);
  return code;
}

static int read_count(const char *text, size_t *count)
{
  uint64_t value = 0;
  const int code = number_whole("--count", text, 1, UINT32_MAX, &value);
  *count = (size_t)value;
  return code;
}

static int read_threads(const char *text, int *threads)
{
  uint64_t value = 0;
  const int code = number_whole("--threads", text, 1, 1024, &value);
  *threads = (int)value;
  return code;
}

static int read_out(options *o, const char *text)
{
  o->out = program_take_more(o->out, o->out_count + 1, sizeof *o->out);
  o->out[o->out_count++] = text;
  return outputs_add_pack(&o->outputs, "--out", text);
}

static int read_report(options *o, const char *text)
{
  if (o->report)
    return program_fail(PROGRAM_BAD_INPUT, "--report: given twice");
  o->report = text;
  return outputs_add_report(&o->outputs, "--report", text);
}

static int read_plot(options *o, const char *text)
{
  if (o->plot_sizes)
    return program_fail(PROGRAM_BAD_INPUT, "--plot-sizes: given twice");
  o->plot_sizes = text;
  return outputs_add_sizes(&o->outputs, "--plot-sizes", text);
}

static int read_once(const char *option, const char *text, const char **slot)
{
  if (*slot)
    return program_fail(PROGRAM_BAD_INPUT, "%s: given twice", option);
  *slot = text;
  return 0;
}

/* Onto the end of what --domain will be combined with. */
static int read_combined(options *o, const char *option, const char *text)
{
  const size_t before = o->combined ? strlen(o->combined) : 0;
  const size_t size = before + strlen(option) + strlen(text) + 3;
  o->combined = program_take_more(o->combined, size, 1);
  snprintf(o->combined + before, size - before, " %s %s", option, text);
  return 0;
}

/* --domain with what it is combined with, at the end of the command line. */
static int join_domain(options *o)
{
  if (!o->combined)
    return 0;
  if (!o->domain)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--or, --and, --minus: --domain is missing, to combine with");
  const size_t size = strlen(o->domain) + strlen(o->combined) + 1;
  o->joined = program_take(size, 1);
  snprintf(o->joined, size, "%s%s", o->domain, o->combined);
  o->domain = o->joined;
  free(o->combined);
  o->combined = NULL;
  return 0;
}

/* The exit code of reading one option; -1 for keys that are none of ours. */
static int read_option(int key, const char *text, options *o)
{
  switch (key) {
  case KEY_DOMAIN:
    return read_once("--domain", text, &o->domain);
  case KEY_OR:
    return read_combined(o, "--or", text);
  case KEY_AND:
    return read_combined(o, "--and", text);
  case KEY_MINUS:
    return read_combined(o, "--minus", text);
  case ARGP_KEY_END:
    return join_domain(o);
  case KEY_PSD:
    return read_once("--psd", text, &o->psd);
  case KEY_DENSITY:
    o->density_given = 1;
    return number_positive("--density", text, &o->density);
  case KEY_SEED:
    return number_whole("--seed", text, 0, UINT64_MAX, &o->seed);
  case KEY_STREAM:
    return number_whole("--stream", text, 0, UINT64_MAX, &o->stream);
  case KEY_THREADS:
    return read_threads(text, &o->threads);
  case KEY_ISA:
    return read_isa(text, &o->isa);
  case KEY_OUT:
    return read_out(o, text);
  case KEY_REPORT:
    return read_report(o, text);
  case KEY_MAX_OVERLAP:
    return read_max_overlap(text, &o->max_overlap);
  case KEY_PLOT_SIZES:
    return read_plot(o, text);
  case KEY_COLOUR:
    return read_colour(text, &o->colour);
  case KEY_QUIET:
    o->quiet = 1;
    return 0;
  default:
    return -1;
  }
}

static int read_amount(int key, const char *text, options *o)
{
  switch (key) {
  case KEY_COUNT:
    return read_count(text, &o->count);
  case KEY_MASS:
    return number_positive("--mass", text, &o->mass);
  case KEY_POROSITY:
    return number_share("--target-porosity", text, &o->porosity);
  default:
    return -1;
  }
}

/* Only one way to say how much. */
static int check_amount(const options *o)
{
  const int given = (o->count > 0) + !isnan(o->mass) + !isnan(o->porosity);
  if (given > 1)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--count, --mass, --target-porosity: only one of them");
  return 0;
}

static error_t end_or_go_on(int code)
{
  if (code > 0)
    exit(code);
  return code == 0 ? 0 : ARGP_ERR_UNKNOWN;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
  return end_or_go_on(read_option(key, argument, state->input));
}

static error_t parse_amount(int key, char *argument, struct argp_state *state)
{
  if (key == ARGP_KEY_END)
    return end_or_go_on(check_amount(state->input));
  return end_or_go_on(read_amount(key, argument, state->input));
}

void options_pass_on(struct argp_state *state, options *o, size_t children)
{
  for (size_t i = 0; i < children; i++)
    state->child_inputs[i] = o;
}

const struct argp options_pack_argp = {.options = pack_table, .parser = parse};
const struct argp options_sizes_argp = {.options = sizes_table, .parser = parse};
const struct argp options_out_argp = {.options = out_table, .parser = parse};

static const struct argp_child all_children[] = {{&options_pack_argp, 0, NULL, 0},
                                                 {&options_sizes_argp, 0, NULL, 0},
                                                 {&options_out_argp, 0, NULL, 0},
                                                 {NULL, 0, NULL, 0}};

static error_t parse_all(int key, char *argument, struct argp_state *state)
{
  if (key == ARGP_KEY_INIT) {
    options_pass_on(state, state->input, 3);
    return 0;
  }
  return parse(key, argument, state);
}

const struct argp options_argp = {
    .options = make_table, .parser = parse_all, .children = all_children};
const struct argp options_amount_argp = {.options = amount_table, .parser = parse_amount};

/* The parts one after the other where the end of --help is made, else the text as it is. */
static char *end_help(int key, const char *text, const char *const *parts)
{
  char *all = NULL;
  size_t size = 0;
  if (key != ARGP_KEY_HELP_POST_DOC)
    return (char *)(uintptr_t)text;
  FILE *to = open_memstream(&all, &size);
  if (!to)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  for (; *parts; parts++)
    fputs(*parts, to);
  const int failed = ferror(to);
  if (fclose(to) != 0 || failed || !all)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  return all;
}

char *options_add_spec_help(int key, const char *text, void *input)
{
  static const char *const parts[] = {spec_domain_help,       "\n", spec_psd_help, "\n",
                                      spec_maker_status_help, NULL};
  (void)input;
  return end_help(key, text, parts);
}

char *options_add_grower_help(int key, const char *text, void *input)
{
  static const char *const parts[] = {spec_domain_help,        "\n", spec_psd_help, "\n",
                                      spec_grower_status_help, NULL};
  (void)input;
  return end_help(key, text, parts);
}

char *options_add_domain_help(int key, const char *text, void *input)
{
  static const char *const parts[] = {spec_domain_help, "\n", spec_taker_status_help,
                                      NULL};
  (void)input;
  return end_help(key, text, parts);
}

char *options_add_taker_help(int key, const char *text, void *input)
{
  static const char *const parts[] = {spec_domain_help,       "\n", spec_psd_help, "\n",
                                      spec_taker_status_help, NULL};
  (void)input;
  return end_help(key, text, parts);
}

void options_report_machine(cJSON *all, const options *o, const packing_context *context)
{
  report_add_count(all, "threads", (size_t)packing_context_threads(context));
  report_add_text(all, "isa", packing_isa_name(packing_context_isa(context)));
  report_add_real(all, "max_overlap", o->max_overlap);
}

void options_report_out(cJSON *all, const options *o)
{
  report_add_text(all, "colour", colour_name(o->colour));
  cJSON *list = report_add_list(all, "out");
  for (size_t i = 0; i < o->out_count; i++)
    report_append_text(list, o->out[i]);
}

void options_report(cJSON *all, const options *o, const packing_context *context)
{
  report_add_u64(all, "seed", o->seed);
  report_add_u64(all, "stream", o->stream);
  options_report_machine(all, o, context);
  options_report_out(all, o);
  report_add_text(all, "plot_sizes", o->plot_sizes);
  report_add_text(all, "report", o->report);
  report_add_flag(all, "quiet", o->quiet);
}

static void print_version(FILE *to, struct argp_state *state)
{
  (void)state;
  fprintf(
      to,
      "%s (libpacking) %s\n"
      "Copyright (C) the authors of libpacking\n"
      "License GPLv3+: GNU GPL version 3 or later <https://gnu.org/licenses/gpl.html>.\n"
      "This is free software: you are free to change and redistribute it.\n"
      "There is NO WARRANTY, to the extent permitted by law.\n",
      program_invocation_short_name, packing_version());
}

error_t options_refuse(int key, char *argument, struct argp_state *state)
{
  if (key == ARGP_KEY_INIT) {
    /* getopt's line says what is wrong; argp's second line would only point at --help. */
    state->err_stream = NULL;
    return 0;
  }
  if (key == ARGP_KEY_ARG)
    exit(program_fail(PROGRAM_BAD_INPUT, "'%s' is no option", argument));
  return ARGP_ERR_UNKNOWN;
}

static int parse_line(const struct argp *own, int argc, char **argv, unsigned flags,
                      void *input)
{
  argp_program_version_hook = print_version;
  const error_t error = argp_parse(own, argc, argv, flags, NULL, input);
  if (error == ENOMEM)
    return program_fail(PROGRAM_SYSTEM, "out of memory");
  return error == 0 ? 0 : PROGRAM_BAD_INPUT;
}

int options_parse(const struct argp *own, int argc, char **argv, void *input)
{
  return parse_line(own, argc, argv, 0, input);
}

int options_parse_in_order(const struct argp *own, int argc, char **argv, void *input)
{
  return parse_line(own, argc, argv, ARGP_IN_ORDER, input);
}

void options_init(options *o)
{
  memset(o, 0, sizeof *o);
  o->mass = o->porosity = (double)NAN;
  o->density = 1000;
  o->seed = 1;
  o->max_overlap = 1e-9;
}

void options_free(options *o)
{
  outputs_free(&o->outputs);
  free(o->out);
  free(o->combined);
  free(o->joined);
}

int options_choice(const char *option, const char *text, const char *const *names,
                   int *choice)
{
  char list[64] = "";
  for (int i = 0; names[i]; i++) {
    if (strcmp(names[i], text) == 0) {
      *choice = i;
      return 0;
    }
    spec_list(list, sizeof list, names[i]);
  }
  return program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is none of %s", option, text, list);
}

/* Pack after pack would repeat the warning about one field with other numbers. */
static void tell_warning(void *user, const packing_log_record *record)
{
  static char told[64];
  const char *field = record->field ? record->field : "";
  (void)user;
  if (record->level != PACKING_LOG_WARNING || (*field && strcmp(field, told) == 0))
    return;
  snprintf(told, sizeof told, "%s", field);
  program_remark("%s", record->message);
}

int options_context(const options *o, packing_context **context)
{
  packing_context_def def;
  packing_context_def_init(&def);
  def.threads = o->threads;
  def.isa = o->isa;
  def.log = tell_warning;
  if (o->quiet)
    program_quiet();
  const packing_status status = packing_context_create(&def, context);
  return status == PACKING_OK ? 0 : program_status(NULL, status, "--threads, --isa");
}
