/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "layers.h"

enum {
  KEY_EXAMPLE = 0x200,
  KEY_DIM,
  KEY_HEIGHT,
  KEY_LAYER_HEIGHT,
  KEY_LAYER_DENSITY,
  KEY_FULL,
  KEY_LAYER_START,
  KEY_MAX_LAYERS,
  KEY_LAYER_END,
  KEY_LAYER_TIME,
  KEY_LAYER_TIME_MAX,
  KEY_REST_TOLERANCE,
  KEY_PACKS,
  KEY_SETS,
  KEY_SHEET
};

const struct argp_option layers_options_table[] = {
    {NULL, 0, NULL, 0, "The paper's data:", 0},
    {"example", KEY_EXAMPLE, "5.1|5.2|5.3|5.4", 0,
     "container, sizes and all numbers of an example of Campello and Cassares: 5.1 discs "
     "of radius 0.01 in 1.0 x 0.5; 5.2 the same, normal (sd 0.001, cut to 0.007..0.013); "
     "5.3 spheres of 0.02 in 1.0 x 1.0 x 0.5; 5.4 the same, normal (sd 0.002, cut to "
     "0.014..0.026). Every option beside it replaces its number",
     0},
    {"dim", KEY_DIM, "2|3", 0,
     "the example's container in so many dimensions; with --domain: a check", 0},
    {NULL, 0, NULL, 0, "Layers:", 3},
    {"height", KEY_HEIGHT, "H", 0,
     "height of the bed, in place of the container's (example: 0.5)", 3},
    {"layer-height", KEY_LAYER_HEIGHT, "H0", 0,
     "height of the space that a layer is laid into (default 0.2 of the height; where "
     "that is more, and no example is asked for, 2.5 times the largest diameter)",
     3},
    {"layer-density", KEY_LAYER_DENSITY, "PHI", 0,
     "volume fraction of that space (default 0.4 in two, 0.25 in three dimensions)", 3},
    {"full", KEY_FULL, "RULE", 0,
     "when the bed is full: bed (default), no column of two mean diameters' width ends "
     "below the height; highest, the highest particle reaches it. A closed container "
     "(sphere, circle, annulus, a body on its side) is full when no layer finds room",
     3},
    {"max-layers", KEY_MAX_LAYERS, "N", 0, "give up after so many (default 1000)", 3},
    {"layer-end", KEY_LAYER_END, "rest|time", 0,
     "a layer ends at rest (default) or after --layer-time", 3},
    {"layer-start", KEY_LAYER_START, "WHERE", 0,
     "where that space begins: highest (default), above the highest particle; bed, where "
     "the lowest column of two mean diameters' width ends, the rest of the bed standing "
     "in "
     "the way",
     3},
    {"layer-time", KEY_LAYER_TIME, "T", 0,
     "time for a layer (default: that in which 10 times H0 are fallen through, 1.0 in "
     "the "
     "examples)",
     3},
    {"layer-time-max", KEY_LAYER_TIME_MAX, "T", 0,
     "a layer that finds no rest ends after this (default 10 times --layer-time)", 3},
    {"rest-tolerance", KEY_REST_TOLERANCE, "X", 0,
     "rest: kinetic energy over the sum of m g r below this (default 1e-4), looked at "
     "every hundredth of --layer-time once H0 can have been fallen through",
     3},
    {"packs", KEY_PACKS, "N", 0,
     "so many packs, each with a stream of its own (default 1). Files of several get "
     "numbers: pack.csv becomes pack-1.csv, pack-2.csv ... Pack P alone: --stream P-1",
     3},
    {"sets", KEY_SETS, "N", 0,
     "so many sets of packs (default 1), with statistics of each set and of all: "
     "pack-1-1.csv ... Pack P of set S alone: --stream 1000 (S - 1) + P - 1",
     3},
    {"sheet", KEY_SHEET, "FILE", 0, "one picture of all packs (.png or .svg)", 7},
    {NULL, 0, NULL, 0, NULL, 0},
};

const char *const layers_end_names[] = {"rest", "time", NULL};
const char *const layers_start_names[] = {"highest", "bed", NULL};
const char *const layers_full_names[] = {"bed", "highest", NULL};
static const char *const example_names[] = {"5.1", "5.2", "5.3", "5.4", NULL};

/* Reals: where they go and what they may be. */
static const struct {
  int key;
  const char *option;
  size_t place;
  int (*read)(const char *where, const char *text, double *value);
} reals[] = {
    {KEY_HEIGHT, "--height", offsetof(layers_options, height), number_positive},
    {KEY_LAYER_HEIGHT, "--layer-height", offsetof(layers_options, layer_height),
     number_positive},
    {KEY_LAYER_DENSITY, "--layer-density", offsetof(layers_options, layer_density),
     number_share},
    {KEY_LAYER_TIME, "--layer-time", offsetof(layers_options, layer_time),
     number_positive},
    {KEY_LAYER_TIME_MAX, "--layer-time-max", offsetof(layers_options, layer_time_max),
     number_positive},
    {KEY_REST_TOLERANCE, "--rest-tolerance", offsetof(layers_options, rest_tolerance),
     number_positive},
};
enum { REALS = sizeof reals / sizeof reals[0] };

static double *real_at(layers_options *o, size_t row)
{
  return (double *)(void *)((char *)o + reals[row].place);
}

static int read_sheet(layers_options *o, const char *text)
{
  if (o->sheet)
    return program_fail(PROGRAM_BAD_INPUT, "--sheet: given twice");
  o->sheet = text;
  return outputs_add_sheet(&o->common.outputs, "--sheet", text);
}

/* The exit code of reading a word or a whole number; -1 for keys that are none of these. */
static int read_word(int key, const char *text, layers_options *o)
{
  int choice = 0, code = 0;
  switch (key) {
  case KEY_EXAMPLE:
    code = options_choice("--example", text, example_names, &choice);
    o->example = text;
    return code;
  case KEY_DIM:
    return number_whole("--dim", text, 2, 3, &o->dim);
  case KEY_LAYER_START:
    code = options_choice("--layer-start", text, layers_start_names, &choice);
    o->start = (layer_start)choice;
    return code;
  case KEY_FULL:
    code = options_choice("--full", text, layers_full_names, &choice);
    o->full = (full_rule)choice;
    return code;
  case KEY_LAYER_END:
    code = options_choice("--layer-end", text, layers_end_names, &choice);
    o->end = (layer_end)choice;
    return code;
  case KEY_MAX_LAYERS:
    return number_whole("--max-layers", text, 1, LAYERS_MOST, &o->max_layers);
  case KEY_PACKS:
    return number_whole("--packs", text, 1, PACKS_MOST, &o->packs);
  case KEY_SETS:
    return number_whole("--sets", text, 1, PACKS_MOST, &o->sets);
  case KEY_SHEET:
    return read_sheet(o, text);
  default:
    return -1;
  }
}

static int read_own(int key, const char *text, layers_options *o)
{
  for (size_t i = 0; i < REALS; i++)
    if (reals[i].key == key)
      return reals[i].read(reals[i].option, text, real_at(o, i));
  return read_word(key, text, o);
}

error_t layers_options_parse(int key, char *argument, struct argp_state *state)
{
  layers_options *o = state->input;
  if (key == ARGP_KEY_INIT) {
    options_refuse(key, argument, state);
    options_pass_on(state, &o->common, 1);
    state->child_inputs[1] = &o->forces;
    return 0;
  }
  const int code = read_own(key, argument, o);
  if (code > 0)
    exit(code);
  return code == 0 ? 0 : options_refuse(key, argument, state);
}

void layers_options_init(layers_options *o)
{
  memset(o, 0, sizeof *o);
  options_init(&o->common);
  o->common.max_overlap = 0.01;
  for (size_t i = 0; i < REALS; i++)
    *real_at(o, i) = (double)NAN;
  forces_options_init(&o->forces);
  o->packs = o->sets = 1;
  o->max_layers = 1000;
}

uint64_t layers_stream(const layers_options *o, size_t number)
{
  const uint64_t set = number / o->packs, pack_of_set = number % o->packs;
  return o->common.stream + PACKS_MOST * set + pack_of_set;
}
