/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "input.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "report.h"
#include "tap.h"

/* ---- options ---- */

enum { KEY_IN = 0x300, KEY_FRAME, KEY_SORT, KEY_RADIUS, KEY_DIAMETER, KEY_DIM };

static const struct argp_option table[] = {
    {"in", KEY_IN, "[FORMAT:]FILE", 0,
     "the pack to read. Formats: csv vtp vtu lammps liggghts dump yade yade-pack geo xyz "
     "xyzd; without FORMAT by extension: .csv .vtp .vtu .data .dump .geo .xyz .xyzd, and "
     "but for .vtp .vtu .xyzd also with .gz",
     1},
    {"frame", KEY_FRAME, "N", 0,
     "which frame of a dump or xyz file, from 0 (default: last)", 1},
    {"sort", KEY_SORT, NULL, 0, "order the particles by their ids", 1},
    {"radius-array", KEY_RADIUS, "NAME", 0, "the array of radii in a VTK file", 1},
    {"diameter-array", KEY_DIAMETER, "NAME", 0, "or that of diameters", 1},
    {"dim", KEY_DIM, "N", 0,
     "2 or 3 (default: as the container or the file says, 2 where every z is 0)", 1},
    {NULL, 0, NULL, 0, NULL, 0},
};

/* A file name with a colon in it needs a slash before: ./a:b.csv. */
static size_t prefix_length(const char *text)
{
  const size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_-");
  return text[length] == ':' ? length : 0;
}

static int unknown_format(const char *text, size_t length)
{
  char known[256] = "";
  const char *name;
  for (size_t i = 0; (name = packing_read_format(i)) != NULL; i++)
    spec_list(known, sizeof known, name);
  if (length > 0)
    return program_fail(PROGRAM_BAD_INPUT, "--in: unknown format '%.*s'; known are %s",
                        (int)length, text, known);
  return program_fail(PROGRAM_BAD_INPUT,
                      "--in: '%s' has no known extension, and no FORMAT: is before it; "
                      "known are %s",
                      text, known);
}

static int read_in(const char *text, input *in)
{
  const size_t length = prefix_length(text);
  const char *extension = packing_read_format_of(text);
  if (in->text)
    return program_fail(PROGRAM_BAD_INPUT, "--in: given twice");
  in->text = text;
  in->path = length ? text + length + 1 : text;
  if (!*in->path)
    return program_fail(PROGRAM_BAD_INPUT, "--in: a file name is missing in '%s'", text);
  if (length)
    snprintf(in->format, sizeof in->format, "%.*s", (int)length, text);
  else if (extension)
    snprintf(in->format, sizeof in->format, "%s", extension);
  if ((length && length >= sizeof in->format) || !*in->format ||
      !packing_read_format_about(in->format))
    return unknown_format(text, length);
  return 0;
}

static int read_frame(const char *text, input *in)
{
  uint64_t frame = 0;
  if (strcmp(text, "last") == 0) {
    in->frame = PACKING_FRAME_LAST;
    return 0;
  }
  const int code = number_whole("--frame", text, 0, INT64_MAX, &frame);
  in->frame = (int64_t)frame;
  return code;
}

static int read_dim(const char *text, input *in)
{
  uint64_t dim = 0;
  const int code = number_whole("--dim", text, 2, 3, &dim);
  in->dim = (int)dim;
  return code;
}

static int read_option(int key, const char *text, input *in)
{
  switch (key) {
  case KEY_IN:
    return read_in(text, in);
  case KEY_FRAME:
    return read_frame(text, in);
  case KEY_SORT:
    in->sort = 1;
    return 0;
  case KEY_RADIUS:
    in->radius = text;
    return 0;
  case KEY_DIAMETER:
    in->diameter = text;
    return 0;
  case KEY_DIM:
    return read_dim(text, in);
  default:
    return -1;
  }
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
  const int code = read_option(key, argument, state->input);
  if (code > 0)
    exit(code);
  return code == 0 ? 0 : ARGP_ERR_UNKNOWN;
}

const struct argp input_argp = {.options = table, .parser = parse};

void input_init(input *in)
{
  memset(in, 0, sizeof *in);
  in->frame = PACKING_FRAME_LAST;
  packing_read_info_init(&in->info);
}

void input_free(input *in)
{
  packing_particles_destroy(in->particles);
  packing_bonds_destroy(in->bonds);
  free(in->domain_note);
}

int input_check(const input *in)
{
  if (!in->text)
    return program_fail(PROGRAM_BAD_INPUT, "--in is missing; see --help");
  if (in->radius && in->diameter)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--radius-array, --diameter-array: only one of them");
  if ((in->radius || in->diameter) && strncmp(in->format, "vt", 2) != 0)
    return program_fail(PROGRAM_BAD_INPUT, "%s: %s has no arrays with names",
                        in->radius ? "--radius-array" : "--diameter-array", in->format);
  return 0;
}

void input_report(cJSON *all, const input *in)
{
  report_add_text(all, "in", in->text);
  report_add_text(all, "format", in->format);
  report_add_count(all, "frame", in->info.frame);
  report_add_flag(all, "sort", in->sort);
  report_add_text(all, "radius_array", in->radius);
  report_add_text(all, "diameter_array", in->diameter);
}

/* ---- reading ---- */

/* The value of "# domain: VALUE" in the lines that begin a table. */
static char *find_note(const char *head)
{
  static const char mark[] = "\xEF\xBB\xBF", key[] = "# domain: ";
  const size_t marked = strncmp(head, mark, sizeof mark - 1) == 0 ? sizeof mark - 1 : 0;
  for (const char *line = head + marked; *line == '#';) {
    const char *end = strchr(line, '\n');
    if (!end)
      break;
    const size_t length = (size_t)(end - line) - (end > line && end[-1] == '\r');
    if (length > sizeof key - 1 && strncmp(line, key, sizeof key - 1) == 0)
      return program_copy(line + sizeof key - 1, length - (sizeof key - 1));
    line = end + 1;
  }
  return NULL;
}

static packing_status read_stream(input *in, packing_context *context,
                                  const packing_stream *stream)
{
  packing_read_def def;
  packing_read_def_init(&def);
  def.frame = in->frame;
  def.sort = in->sort;
  def.radius_name = in->radius;
  def.diameter_name = in->diameter;
  def.bonds = in->bonds;
  return packing_read_pack(context, &def, in->format, stream, in->particles, &in->info);
}

static int failed(const input *in, packing_context *context, packing_status status)
{
  char where[4200];
  if (interrupted())
    return program_interrupted();
  snprintf(where, sizeof where, "--in: %s", in->path);
  return program_status(context, status, where);
}

/* Whether the file is what --dim says; every z is 0 in two dimensions. */
static int check_dim(input *in)
{
  if (in->dim == 2 && in->info.dim == 3)
    return program_fail(PROGRAM_BAD_INPUT, "--dim: %s has particles off the plane z = 0",
                        in->path);
  return 0;
}

void input_announce(input *in, input_files *files)
{
  in->note = files->count;
  tap_announce(files, in->path);
}

int input_read(input *in, packing_context *context, input_files *files)
{
  packing_file *file = NULL;
  tap t;
  packing_status status = packing_particles_create(context, NULL, &in->particles);
  if (status == PACKING_OK)
    status = packing_bonds_create(context, &in->bonds);
  if (status != PACKING_OK)
    return program_status(context, status, "--in");
  status = packing_file_open(context, in->path, &file);
  if (status != PACKING_OK)
    return program_status(context, status, "--in");
  tap_open(&t, packing_file_stream(file));
  status = read_stream(in, context, &t.stream);
  if (status == PACKING_OK)
    tap_finish(&t, files->items[in->note].sha256);
  packing_file_close(file);
  if (status != PACKING_OK || interrupted())
    return failed(in, context, status);
  if (strcmp(in->format, "csv") == 0) {
    in->domain_note = find_note(t.head);
    in->notes_hidden = strncmp(t.head, "\x1f\x8b", 2) == 0;
  }
  return check_dim(in);
}

/* ---- the container ---- */

char *input_box_text(int dim, const packing_bounds *box, unsigned periodic)
{
  domain_spec spec;
  domain_spec_none(dim, &spec);
  spec.kind = dim == 2 ? DOMAIN_RECT : DOMAIN_BOX;
  spec.size[0] = box->hi.x - box->lo.x;
  spec.size[1] = box->hi.y - box->lo.y;
  spec.size[2] = box->hi.z - box->lo.z;
  spec.at = box->lo;
  spec.periodic = periodic;
  return domain_spec_text(&spec);
}

static int has_tilt(const packing_read_info *info)
{
  return info->tilt.x != 0 || info->tilt.y != 0 || info->tilt.z != 0;
}

static char *box_of_file(const input *in, int dim)
{
  if (!in->info.has_box)
    return NULL;
  if (has_tilt(&in->info)) {
    program_remark("%s: its box is tilted and is no container here", in->path);
    return NULL;
  }
  unsigned periodic = in->info.has_periodic ? in->info.periodic : 0;
  if (dim == 2)
    periodic &= PACKING_PERIODIC_X | PACKING_PERIODIC_Y;
  return input_box_text(dim, &in->info.box, periodic);
}

int input_domain(const input *in, const char *asked, domain_spec *spec, char **text)
{
  const int dim = in->dim ? in->dim : in->info.dim;
  *text = asked             ? program_copy(asked, strlen(asked))
          : in->domain_note ? program_copy(in->domain_note, strlen(in->domain_note))
                            : box_of_file(in, dim);
  domain_spec_none(dim, spec);
  if (!*text && in->notes_hidden)
    program_remark("%s: a container noted in a compressed table is not seen; --domain "
                   "tells it",
                   in->path);
  if (!*text)
    return 0;
  const int code =
      domain_spec_parse_as(asked ? "--domain" : "--in: its container", *text, spec);
  if (code)
    return code;
  if (spec->dim == 2 && in->info.dim == 3)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--domain: %s is flat, and %s has particles off the plane z = 0",
                        *text, in->path);
  if (in->dim && spec->dim != in->dim)
    return program_fail(PROGRAM_BAD_INPUT, "--dim: %s has %d dimensions", *text,
                        spec->dim);
  return 0;
}

void input_tell_domain(const input *in, const char *asked, const char *text)
{
  const int unsure = !in->domain_note && !in->info.has_periodic;
  if (!asked && text)
    program_remark("the container is %s, as %s says%s", text, in->path,
                   unsure ? "; whether it is periodic, it does not say: taken as walls "
                            "(--domain says otherwise)"
                          : "");
}
