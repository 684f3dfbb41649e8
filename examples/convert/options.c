/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "convert.h"

const char convert_program[] = "packing-convert";
const char *const change_names[] = {"crop",      "scale", "shift",
                                    "replicate", "bond",  "renumber"};

/* So many copies along an axis at most, and so many particles in all. */
static const uint64_t MOST_TIMES = 1000000;

enum {
  KEY_CROP = 0x400,
  KEY_CROP_BY,
  KEY_SCALE,
  KEY_SHIFT,
  KEY_REPLICATE,
  KEY_BOND,
  KEY_RENUMBER
};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "On the way, in the order given, each as often as wanted:", 3},
    {"renumber", KEY_RENUMBER, NULL, 0,
     "ids become 1, 2, 3 ... (those of .geo files begin at 0, LAMMPS wants them above)",
     3},
    {"crop", KEY_CROP, "SPEC", 0,
     "keep the particles inside this container, which is the pack's own from then on", 3},
    {"crop-by", KEY_CROP_BY, "WHAT", 0,
     "crop: whole (default): particles that lie inside as a whole; centres: those whose "
     "centre does",
     3},
    {"scale", KEY_SCALE, "S", 0, "multiply all lengths, and velocities, by S", 3},
    {"shift", KEY_SHIFT, "X,Y,Z", 0, "move everything (two dimensions: X,Y)", 3},
    {"bond", KEY_BOND, "GAP", 0,
     "bond the pairs whose surfaces are at most GAP apart, a length, and no others (for "
     "the formats that hold bonds: lammps, geo)",
     3},
    {"replicate", KEY_REPLICATE, "NX,NY,NZ", 0,
     "repeat the box so many times along x, y, z (two dimensions: NX,NY): first the pack "
     "itself, then its copies, x fastest; ids, where there are any, become 1, 2, 3 ...; "
     "bonds across a periodic border lead to the next copy",
     3},
    {NULL, 0, NULL, 0, NULL, 0},
};

/* Three numbers, or two; returns how many, 0 after a line. */
static size_t read_numbers(const char *option, const char *text, char *copy, char **words)
{
  size_t count = 0;
  strcpy(copy, text);
  char **found = spec_split(copy, ',', &count);
  if (count == 2 || count == 3)
    memcpy(words, found, count * sizeof *words);
  else {
    program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is not two or three numbers", option, text);
    count = 0;
  }
  free(found);
  return count;
}

static int read_shift(const char *text, change *c)
{
  char *words[3], *copy = program_copy(text, strlen(text));
  double v[3] = {0, 0, 0};
  c->numbers = read_numbers("--shift", text, copy, words);
  int code = c->numbers ? 0 : PROGRAM_BAD_INPUT;
  for (size_t i = 0; i < c->numbers && !code; i++)
    code = number_real("--shift", words[i], &v[i]);
  c->by = (packing_vec3){v[0], v[1], v[2]};
  free(copy);
  return code;
}

static int read_replicate(const char *text, change *c)
{
  char *words[3], *copy = program_copy(text, strlen(text));
  c->times[0] = c->times[1] = c->times[2] = 1;
  c->numbers = read_numbers("--replicate", text, copy, words);
  int code = c->numbers ? 0 : PROGRAM_BAD_INPUT;
  for (size_t i = 0; i < c->numbers && !code; i++)
    code = number_whole("--replicate", words[i], 1, MOST_TIMES, &c->times[i]);
  free(copy);
  return code;
}

static int read_gap(const char *text, change *c)
{
  const int code = number_real("--bond", text, &c->factor);
  if (!code && c->factor < 0)
    return program_fail(PROGRAM_BAD_INPUT, "--bond: %s is below 0", text);
  return code;
}

static int read_crop_by(const char *text, convert_options *o)
{
  o->by_centres = strcmp(text, "centres") == 0;
  if (o->by_centres || strcmp(text, "whole") == 0)
    return 0;
  return program_fail(PROGRAM_BAD_INPUT, "--crop-by: '%s' is not whole or centres", text);
}

static int read_change(change_kind kind, const char *text, convert_options *o)
{
  o->changes = program_take_more(o->changes, o->change_count + 1, sizeof *o->changes);
  change *c = &o->changes[o->change_count++];
  memset(c, 0, sizeof *c);
  c->kind = kind;
  c->text = text;
  switch (kind) {
  case CHANGE_CROP:
    return domain_spec_parse_as("--crop", text, &c->keep);
  case CHANGE_SCALE:
    return number_positive("--scale", text, &c->factor);
  case CHANGE_SHIFT:
    return read_shift(text, c);
  case CHANGE_BOND:
    return read_gap(text, c);
  case CHANGE_RENUMBER:
    return 0;
  default:
    return read_replicate(text, c);
  }
}

static int read_own(int key, const char *text, convert_options *o)
{
  switch (key) {
  case KEY_CROP:
    return read_change(CHANGE_CROP, text, o);
  case KEY_CROP_BY:
    return read_crop_by(text, o);
  case KEY_SCALE:
    return read_change(CHANGE_SCALE, text, o);
  case KEY_SHIFT:
    return read_change(CHANGE_SHIFT, text, o);
  case KEY_BOND:
    return read_change(CHANGE_BOND, text, o);
  case KEY_RENUMBER:
    return read_change(CHANGE_RENUMBER, "", o);
  case KEY_REPLICATE:
    return read_change(CHANGE_REPLICATE, text, o);
  default:
    return -1;
  }
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
  convert_options *o = state->input;
  if (key == ARGP_KEY_INIT) {
    options_refuse(key, argument, state);
    options_pass_on(state, &o->common, 2);
    state->child_inputs[2] = &o->in;
    return 0;
  }
  const int code = read_own(key, argument, o);
  if (code > 0)
    exit(code);
  return code == 0 ? 0 : options_refuse(key, argument, state);
}

static const struct argp_child children[] = {{&options_pack_argp, 0, NULL, 0},
                                             {&options_out_argp, 0, NULL, 0},
                                             {&input_argp, 0, NULL, 0},
                                             {NULL, 0, NULL, 0}};

const struct argp convert_argp = {
    .options = table,
    .parser = parse,
    .args_doc = "--in=[FORMAT:]FILE --out=[FORMAT:]FILE",
    .doc =
        "Turns packs of spheres or discs from any format into any other, and crops, "
        "scales, moves and repeats them on the way. What a file tells of its container "
        "goes along, --domain says it where it does not. An audit says what the pack is "
        "like in the end, and does not change the exit status.\v ",
    .children = children,
    .help_filter = options_add_domain_help,
};

void convert_options_init(convert_options *o)
{
  memset(o, 0, sizeof *o);
  options_init(&o->common);
  input_init(&o->in);
}

void convert_options_free(convert_options *o)
{
  options_free(&o->common);
  input_free(&o->in);
  free(o->changes);
}

int convert_options_check(const convert_options *o)
{
  const int code = input_check(&o->in);
  if (code)
    return code;
  if (o->common.out_count == 0)
    return program_fail(PROGRAM_BAD_INPUT, "--out is missing; see --help");
  return 0;
}
