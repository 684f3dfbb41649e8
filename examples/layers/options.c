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
  KEY_GRAVITY,
  KEY_ROTATIONS,
  KEY_FRICTION,
  KEY_SLIP_VELOCITY,
  KEY_YOUNG,
  KEY_POISSON,
  KEY_DAMPING,
  KEY_PULL,
  KEY_DRAG,
  KEY_NEAR_FIELD,
  KEY_DISC_MASS,
  KEY_ARM,
  KEY_WALLS,
  KEY_DT,
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
    {NULL, 0, NULL, 0, "Forces:", 4},
    {"gravity", KEY_GRAVITY, "G|GX,GY,GZ", 0,
     "what jams the particles: downwards (default 2), or a vector (two dimensions: "
     "GX,GY) "
     "that points downwards in part",
     4},
    {"rotations", KEY_ROTATIONS, "on|off", 0, "whether particles spin (default on)", 4},
    {"friction", KEY_FRICTION, "MU", 0, "coefficient of friction (default 0.2)", 4},
    {"slip-velocity", KEY_SLIP_VELOCITY, "V0", 0,
     "friction grows with the sliding velocity u as u / sqrt(u^2 + V0^2) (default 0.001 "
     "of "
     "sqrt(g r), r the mean radius)",
     4},
    {"young", KEY_YOUNG, "E", 0, "Young's modulus (default 1e8)", 4},
    {"poisson", KEY_POISSON, "NU", 0, "Poisson's ratio (default 0.25)", 4},
    {"damping", KEY_DAMPING, "XI", 0, "damping rate of contacts (default 0.1)", 4},
    {"pull", KEY_PULL, "on|off", 0,
     "on: contacts pull at separation, as printed in the paper (default off)", 4},
    {"drag", KEY_DRAG, "C", 0,
     "force per velocity of the fluid (default 0, in the examples 0.005)", 4},
    {"near-field", KEY_NEAR_FIELD, "A1,B1,A2,B2,CUTOFF", 0,
     "force between centres at distance d below CUTOFF: attraction A1 d^-B1, repulsion "
     "A2 "
     "d^-B2 (default none)",
     4},
    {"disc-mass", KEY_DISC_MASS, "on|off", 0,
     "two dimensions: on, particles weigh as discs (--density by area); off (default), "
     "as "
     "spheres",
     4},
    {"arm", KEY_ARM, "contact|radius", 0,
     "where friction turns a particle: at the common contact point (default), or at its "
     "radius as in the paper",
     4},
    {"walls", KEY_WALLS, "rigid|material", 0,
     "walls that do not give way (default), or of the particles' material", 4},
    {"dt", KEY_DT, "DT", 0,
     "length of a step (default: advised for the smallest particle and a fall through "
     "H0; "
     "in the examples 1e-4)",
     4},
    {"sheet", KEY_SHEET, "FILE", 0, "one picture of all packs (.png or .svg)", 7},
    {NULL, 0, NULL, 0, NULL, 0},
};

const char *const layers_end_names[] = {"rest", "time", NULL};
const char *const layers_start_names[] = {"highest", "bed", NULL};
const char *const layers_full_names[] = {"bed", "highest", NULL};
const char *const layers_arm_names[] = {"contact", "radius", NULL};
const char *const layers_wall_names[] = {"rigid", "material", NULL};
static const char *const example_names[] = {"5.1", "5.2", "5.3", "5.4", NULL};
static const char *const switch_names[] = {"off", "on", NULL};

/* Reals: where they go and what they may be. */
enum { ANY, NOT_NEGATIVE, POSITIVE, SHARE };

typedef struct real_row {
  int key;
  const char *option;
  size_t place;
  int kind;
} real_row;

#define REAL(key, option, member, kind)                                                  \
  {                                                                                      \
    key, option, offsetof(layers_options, member), kind                                  \
  }

static const real_row reals[] = {
    REAL(KEY_HEIGHT, "--height", height, POSITIVE),
    REAL(KEY_LAYER_HEIGHT, "--layer-height", layer_height, POSITIVE),
    REAL(KEY_LAYER_DENSITY, "--layer-density", layer_density, SHARE),
    REAL(KEY_LAYER_TIME, "--layer-time", layer_time, POSITIVE),
    REAL(KEY_LAYER_TIME_MAX, "--layer-time-max", layer_time_max, POSITIVE),
    REAL(KEY_REST_TOLERANCE, "--rest-tolerance", rest_tolerance, POSITIVE),
    REAL(KEY_FRICTION, "--friction", friction, NOT_NEGATIVE),
    REAL(KEY_SLIP_VELOCITY, "--slip-velocity", slip_velocity, POSITIVE),
    REAL(KEY_YOUNG, "--young", young, POSITIVE),
    REAL(KEY_POISSON, "--poisson", poisson, ANY),
    REAL(KEY_DAMPING, "--damping", damping, NOT_NEGATIVE),
    REAL(KEY_DRAG, "--drag", drag, NOT_NEGATIVE),
    REAL(KEY_DT, "--dt", dt, POSITIVE),
};

static int read_real(const real_row *row, const char *text, layers_options *o)
{
  double *value = (double *)(void *)((char *)o + row->place);
  if (row->kind == POSITIVE)
    return number_positive(row->option, text, value);
  const int code = number_real(row->option, text, value);
  if (!code && row->kind == NOT_NEGATIVE && !(*value >= 0))
    return program_fail(PROGRAM_BAD_INPUT, "%s: %s is below 0", row->option, text);
  if (!code && row->kind == SHARE && !(*value > 0 && *value < 1))
    return program_fail(PROGRAM_BAD_INPUT, "%s: %s is not between 0 and 1", row->option,
                        text);
  if (!code && row->key == KEY_POISSON && !(*value > -1 && *value <= 0.5))
    return program_fail(PROGRAM_BAD_INPUT, "--poisson: %s is not above -1 and up to 0.5",
                        text);
  return code;
}

static int read_choice(const char *option, const char *text, const char *const *names,
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
    code = read_choice("--example", text, example_names, &choice);
    o->example = text;
    return code;
  case KEY_DIM:
    return number_whole("--dim", text, 2, 3, &o->dim);
  case KEY_LAYER_START:
    code = read_choice("--layer-start", text, layers_start_names, &choice);
    o->start = (layer_start)choice;
    return code;
  case KEY_FULL:
    code = read_choice("--full", text, layers_full_names, &choice);
    o->full = (full_rule)choice;
    return code;
  case KEY_LAYER_END:
    code = read_choice("--layer-end", text, layers_end_names, &choice);
    o->end = (layer_end)choice;
    return code;
  case KEY_ARM:
    code = read_choice("--arm", text, layers_arm_names, &choice);
    o->arm = (packing_arm)choice;
    return code;
  case KEY_ROTATIONS:
    return read_choice("--rotations", text, switch_names, &o->rotations);
  case KEY_PULL:
    return read_choice("--pull", text, switch_names, &o->pull);
  case KEY_DISC_MASS:
    return read_choice("--disc-mass", text, switch_names, &o->disc_mass);
  case KEY_WALLS:
    return read_choice("--walls", text, layers_wall_names, &o->material_walls);
  case KEY_MAX_LAYERS:
    return number_whole("--max-layers", text, 1, LAYERS_MOST, &o->max_layers);
  case KEY_PACKS:
    return number_whole("--packs", text, 1, PACKS_MOST, &o->packs);
  case KEY_SETS:
    return number_whole("--sets", text, 1, PACKS_MOST, &o->sets);
  case KEY_GRAVITY:
    o->gravity = text;
    return 0;
  case KEY_NEAR_FIELD:
    o->near_field = text;
    return 0;
  case KEY_SHEET:
    return read_sheet(o, text);
  default:
    return -1;
  }
}

static int read_own(int key, const char *text, layers_options *o)
{
  for (size_t i = 0; i < sizeof reals / sizeof reals[0]; i++)
    if (reals[i].key == key)
      return read_real(&reals[i], text, o);
  return read_word(key, text, o);
}

error_t layers_options_parse(int key, char *argument, struct argp_state *state)
{
  layers_options *o = state->input;
  if (key == ARGP_KEY_INIT) {
    options_refuse(key, argument, state);
    options_pass_on(state, &o->common, 1);
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
  for (size_t i = 0; i < sizeof reals / sizeof reals[0]; i++)
    *(double *)(void *)((char *)o + reals[i].place) = (double)NAN;
  o->rotations = 1;
  o->packs = o->sets = 1;
  o->max_layers = 1000;
}

uint64_t layers_stream(const layers_options *o, size_t number)
{
  const uint64_t set = number / o->packs, pack_of_set = number % o->packs;
  return o->common.stream + PACKS_MOST * set + pack_of_set;
}
