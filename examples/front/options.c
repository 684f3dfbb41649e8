/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "front.h"

#define BAD(...) program_fail(PROGRAM_BAD_INPUT, __VA_ARGS__)

enum {
  KEY_MODE = 0x200,
  KEY_DIRECTION,
  KEY_CONTACT,
  KEY_SELECT,
  KEY_STOCK,
  KEY_LIST,
  KEY_GRADE,
  KEY_LOOSEN,
  KEY_SETTLE,
  KEY_SETTLE_TIME,
  KEY_REST_TOLERANCE,
  KEY_FRAMES,
  KEY_TRACE
};

enum { FRAMES = 6 };

const struct argp_option front_options_table[] = {
    {"grade", KEY_GRADE, "SIZES@CONTAINER", 0,
     "particles with their centre in this part of the container have these sizes; may be "
     "repeated, the first part that holds a centre counts, --psd holds for the rest",
     1},
    {"list", KEY_LIST, "FILE", 0,
     "in place of --psd, exactly these particles: a table with a header line, columns "
     "radius or diameter, and count or mass (by --density); '#' starts a comment",
     2},
    {NULL, 0, NULL, 0, "How:", 3},
    {"mode", KEY_MODE, "MODE", 0,
     "dense (default): the best place and size of many; fast: a good one of few; paper: "
     "the first place that is free, Pseudocode 2 of Perez Morales et al.",
     3},
    {"direction", KEY_DIRECTION, "WAY", 0,
     "outward (default): from the innermost point; inward: the whole boundary first", 3},
    {"contact", KEY_CONTACT, "METHOD", 0,
     "paper: how a particle is placed in contact: wrappers (default), potential, binary, "
     "direct",
     3},
    {"select", KEY_SELECT, "FRONT[,NEXT]", 0,
     "paper: in which order particles of the front, and neighbours of one, are taken: "
     "random (default), fifo, lifo. One word stands for both",
     3},
    {"stock", KEY_STOCK, "N", 0,
     "fast, dense: radii drawn in advance, of which the one that fits best is taken "
     "(default 64, dense 256, fewer for small packs and very different sizes)",
     3},
    {NULL, 0, NULL, 0, "After placing:", 5},
    {"loosen", KEY_LOOSEN, "shrink|remove", 0,
     "fill the container, then go down to --target-porosity: all radii by one factor, or "
     "particles at random, the sizes staying as they are",
     5},
    {"settle", KEY_SETTLE, "gravity", 0,
     "let the pack fall and jam by the discrete-element method, under the forces above",
     5},
    {"settle-time", KEY_SETTLE_TIME, "T", 0,
     "a pack that finds no rest ends after this (default: 10 times the time in which 10 "
     "heights of the container are fallen through)",
     5},
    {"rest-tolerance", KEY_REST_TOLERANCE, "X", 0,
     "rest: kinetic energy over the sum of m g r below this (default 1e-4)", 5},
    {"frames", KEY_FRAMES, "[N:]FILE", 0,
     "one picture (.png or .svg) of the growth: the pack at N moments (default 6), its "
     "front in red",
     7},
    {"trace", KEY_TRACE, "FILE", 0,
     "a table of the growth: seconds,particles,volume_fraction", 7},
    {NULL, 0, NULL, 0, NULL, 0},
};

static const char *const loosen_names[] = {"shrink", "remove", NULL};
static const char *const settle_names[] = {"gravity", NULL};

/* The names of a choice, from the library. */
typedef const char *(*naming)(int value);

static const char *mode_name(int value)
{
  return packing_front_mode_name((packing_front_mode)value);
}

static const char *direction_name(int value)
{
  return packing_front_direction_name((packing_front_direction)value);
}

static const char *select_name(int value)
{
  return packing_front_select_name((packing_front_select)value);
}

static int read_named(const char *option, const char *text, naming name_of, int *choice)
{
  const char *names[8] = {NULL};
  for (int i = 0; i < 7 && name_of(i); i++)
    names[i] = name_of(i);
  return options_choice(option, text, names, choice);
}

static int read_mode(const char *text, front_options *o)
{
  int choice = 0;
  const int code = read_named("--mode", text, mode_name, &choice);
  o->mode = (packing_front_mode)choice;
  return code;
}

static int read_direction(const char *text, front_options *o)
{
  int choice = 0;
  const int code = read_named("--direction", text, direction_name, &choice);
  o->direction = (packing_front_direction)choice;
  return code;
}

static int read_contact(const char *text, front_options *o)
{
  o->contact = packing_contact_method_named(text);
  return o->contact
             ? 0
             : BAD("--contact: '%s' is none of wrappers, potential, binary, direct",
                   text);
}

static int read_select(const char *text, front_options *o)
{
  size_t count = 0;
  int code = 0;
  char *copy = program_copy(text, strlen(text));
  char **words = spec_split(copy, ',', &count);
  if (count > 2)
    code = BAD("--select: '%s' has more than two words", text);
  for (size_t i = 0; i < 2 && !code; i++) {
    int choice = 0;
    code = read_named("--select", words[i < count ? i : 0], select_name, &choice);
    o->select[i] = (packing_front_select)choice;
  }
  o->select_given = 1;
  free(words);
  free(copy);
  return code;
}

static int read_stock(const char *text, front_options *o)
{
  uint64_t value = 0;
  const int code = number_whole("--stock", text, 1, 4096, &value);
  o->stock = text;
  o->stock_count = (size_t)value;
  return code;
}

static int read_grade(const char *text, front_options *o)
{
  if (o->grade_count == FRONT_GRADES_MOST)
    return BAD("--grade: more than %d", FRONT_GRADES_MOST);
  o->grades[o->grade_count++] = text;
  return 0;
}

static int read_loosen(const char *text, front_options *o)
{
  int choice = 0;
  const int code = options_choice("--loosen", text, loosen_names, &choice);
  o->loosen = (packing_loosen_how)choice;
  o->loosen_given = 1;
  return code;
}

static int read_settle(const char *text, front_options *o)
{
  int choice = 0;
  if (strcmp(text, "compression") == 0)
    return BAD("--settle: compression needs walls that move, which the stepper does not "
               "have yet; gravity is there");
  o->settle = 1;
  return options_choice("--settle", text, settle_names, &choice);
}

static packing_status write_frames_png(const pack *p, const packing_stream *stream)
{
  return front_frames_write(p, stream, 0);
}

static packing_status write_frames_svg(const pack *p, const packing_stream *stream)
{
  return front_frames_write(p, stream, 1);
}

static int ends_in(const char *text, const char *end)
{
  const size_t length = strlen(text), less = strlen(end);
  return length > less && strcmp(text + length - less, end) == 0;
}

/* "6:growth.png" */
static int read_frames(const char *text, front_options *o)
{
  const size_t digits = strspn(text, "0123456789");
  const char *path = digits && text[digits] == ':' ? text + digits + 1 : text;
  uint64_t count = FRAMES;
  if (o->frames)
    return BAD("--frames: given twice");
  if (path != text) {
    char *number = program_copy(text, digits);
    const int code = number_whole("--frames", number, 1, FRONT_FRAMES_MOST, &count);
    free(number);
    if (code)
      return code;
  }
  const int svg = ends_in(path, ".svg");
  if (!svg && !ends_in(path, ".png"))
    return BAD("--frames: '%s' does not end in .png or .svg", path);
  output *made = outputs_add(&o->common.outputs, "--frames", text, path);
  made->write = svg ? write_frames_svg : write_frames_png;
  o->frames = text;
  o->frame_count = (size_t)count;
  return 0;
}

static int read_trace(const char *text, front_options *o)
{
  if (o->trace)
    return BAD("--trace: given twice");
  o->trace = text;
  outputs_add(&o->common.outputs, "--trace", text, text)->write = front_trace_write;
  return 0;
}

static int read_list(const char *text, front_options *o)
{
  if (o->list)
    return BAD("--list: given twice");
  o->list = text;
  return 0;
}

/* The exit code of reading one option; -1 for keys that are none of ours. */
static int read_own(int key, const char *text, front_options *o)
{
  static const struct {
    int key;
    int (*read)(const char *text, front_options *o);
  } rows[] = {{KEY_MODE, read_mode},       {KEY_DIRECTION, read_direction},
              {KEY_CONTACT, read_contact}, {KEY_SELECT, read_select},
              {KEY_STOCK, read_stock},     {KEY_LIST, read_list},
              {KEY_GRADE, read_grade},     {KEY_LOOSEN, read_loosen},
              {KEY_SETTLE, read_settle},   {KEY_FRAMES, read_frames},
              {KEY_TRACE, read_trace}};
  if (key == KEY_SETTLE_TIME)
    return number_positive("--settle-time", text, &o->settle_time);
  if (key == KEY_REST_TOLERANCE)
    return number_positive("--rest-tolerance", text, &o->rest_tolerance);
  for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
    if (rows[i].key == key)
      return rows[i].read(text, o);
  return -1;
}

error_t front_options_parse(int key, char *argument, struct argp_state *state)
{
  front_options *o = state->input;
  if (key == ARGP_KEY_INIT) {
    options_refuse(key, argument, state);
    options_pass_on(state, &o->common, 2);
    state->child_inputs[2] = &o->forces;
    state->child_inputs[3] = &o->in;
    return 0;
  }
  const int code = read_own(key, argument, o);
  if (code > 0)
    exit(code);
  return code == 0 ? 0 : options_refuse(key, argument, state);
}

void front_options_init(front_options *o)
{
  memset(o, 0, sizeof *o);
  options_init(&o->common);
  forces_options_init(&o->forces);
  input_init(&o->in);
  o->common.max_overlap = o->settle_time = o->rest_tolerance = (double)NAN;
}

/* ---- what goes together ---- */

static int check_amount(const front_options *o)
{
  const options *c = &o->common;
  if (!o->list && !c->psd)
    return BAD("--psd is missing (or --list); see --help");
  if (o->list && c->psd)
    return BAD("--list, --psd: only one of them");
  if (o->list && o->grade_count)
    return BAD("--list: has no sizes by --grade");
  if (o->list && c->count)
    return BAD("--list: tells the --count itself");
  if (o->list && !isnan(c->mass))
    return BAD("--list: tells the --mass itself");
  if (o->loosen_given && isnan(c->porosity))
    return BAD("--loosen: --target-porosity is missing");
  if (o->loosen_given && o->in.text)
    return BAD("--loosen: would change the particles of --in too");
  return 0;
}

static int check_mode(const front_options *o)
{
  const char *mode = packing_front_mode_name(o->mode);
  const int paper = o->mode == PACKING_FRONT_PAPER;
  if (o->contact && !paper)
    return BAD("--contact: --mode %s has none; paper has", mode);
  if (o->select_given && !paper)
    return BAD("--select: --mode %s has none; paper has", mode);
  if (o->stock && paper)
    return BAD("--stock: --mode paper has none; fast and dense have");
  return 0;
}

static int check_settling(const front_options *o)
{
  const char *lost = o->forces.given             ? o->forces.given
                     : !isnan(o->settle_time)    ? "settle-time"
                     : !isnan(o->rest_tolerance) ? "rest-tolerance"
                                                 : NULL;
  return lost && !o->settle ? BAD("--%s: is for --settle", lost) : 0;
}

int front_options_check(front_options *o)
{
  int code = check_amount(o);
  if (!code)
    code = check_mode(o);
  if (!code)
    code = check_settling(o);
  if (!code && o->in.text)
    code = input_check(&o->in);
  if (!code && !o->in.text && !o->common.domain)
    code = BAD("--domain is missing; see --help");
  if (isnan(o->common.max_overlap))
    o->common.max_overlap = o->settle ? 0.01 : 1e-9;
  return code;
}
