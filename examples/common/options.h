/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_OPTIONS_H
#define EXAMPLES_OPTIONS_H

/* The options that all programs share, as a child parser for argp. A program puts
 * {&options_argp, 0, NULL, 0} among its children and hands a `options` down as its input. A bad
 * value ends the program with one line and exit code 2. */

#include <argp.h>
#include <cjson/cJSON.h>
#include "output.h"

typedef struct options {
  const char *domain; /* NULL: not given; what it is combined with stands behind it */
  char *combined;     /* while options are read: that */
  char *joined;       /* what `domain` points to then */
  const char *psd;    /* NULL: not given */
  size_t count;       /* 0: not given */
  double mass;        /* NaN: not given */
  double density;     /* [M L^-3], default 1000 */
  int density_given;
  double porosity;       /* NaN: not given */
  uint64_t seed, stream; /* default 1, 0 */
  int threads;           /* 0: all cores */
  packing_isa isa;       /* default auto */
  double max_overlap;    /* limit of the audit, default 1e-9 */
  outputs outputs;
  const char **out; /* the --out as typed */
  size_t out_count;
  const char *report;     /* NULL: standard output */
  const char *plot_sizes; /* NULL: none */
  colour_by colour;
  int quiet;
} options;

void options_init(options *o);
void options_free(options *o);

/* All of them, for programs that make packs. */
extern const struct argp options_argp;

/* The parts of it, for programs that take packs: container, threads, audit, report; --psd; how
 * packs are written. */
extern const struct argp options_pack_argp;
extern const struct argp options_sizes_argp;
extern const struct argp options_out_argp;

/* Hands `o` down to so many children; for ARGP_KEY_INIT. */
void options_pass_on(struct argp_state *state, options *o, size_t children);

/* Beside it for programs that can be told how much: --count, --mass, --target-porosity. */
extern const struct argp options_amount_argp;

/* Parses the whole command line with a program's own argp; returns 0 or exit code 2. `input`
 * goes to the program's parser, which hands an `options` to its children. */
int options_parse(const struct argp *own, int argc, char **argv, void *input);

/* The same, plain arguments coming to the parser where they stand among the options. */
int options_parse_in_order(const struct argp *own, int argc, char **argv, void *input);

/* The parser of a program without options of its own; others call it for what they do not
 * know. Plain arguments are refused. */
error_t options_refuse(int key, char *argument, struct argp_state *state);

/* A help filter that ends --help with the little language of --domain and --psd, one of --domain
 * alone, and one of both for programs that judge no pack. */
char *options_add_spec_help(int key, const char *text, void *input);
char *options_add_grower_help(int key, const char *text, void *input);
char *options_add_domain_help(int key, const char *text, void *input);
char *options_add_taker_help(int key, const char *text, void *input);

/* Adds threads, instruction set and audit to the options of a report; then the ways out. */
void options_report_machine(cJSON *all, const options *o, const packing_context *context);
void options_report_out(cJSON *all, const options *o);

/* Adds all that makers of packs share. */
void options_report(cJSON *all, const options *o, const packing_context *context);

/* The names of colour_by. */
const char *colour_name(colour_by colour);

/* Which of the names (NULL behind the last) a word is; 0 or an exit code. */
int options_choice(const char *option, const char *text, const char *const *names,
                   int *choice);

/* A context as asked; 0 or an exit code. */
int options_context(const options *o, packing_context **context);

#endif
