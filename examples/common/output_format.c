/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be written, by name and by extension. */
#include <stdio.h>
#include <string.h>
#include "output.h"
#include "picture.h"
#include "program.h"

const char output_help[] =
    "write the pack; may be repeated. Formats: csv vtp vtu lammps dump liggghts yade "
    "yade-pack geo xyz pov pfc neper-coo neper-weight mercury, the container alone as "
    "stl or "
    "stl-ascii, decks that load and run what is written beside them as lammps-deck and "
    "liggghts-deck, pictures as png and svg; without FORMAT by extension: .csv .vtp .vtu "
    ".data .dump .geo .xyz .pov .stl .png .svg";

/* ---- formats of the library ---- */

static void fill_def(packing_write_def *def, const pack *p)
{
  packing_write_def_init(def);
  def->dim = p->spec->dim;
  def->domain = p->domain;
  def->density = p->density;
  def->bonds = p->bonds;
  def->bond_count = p->bond_count;
  def->note_count = p->notes.count;
  def->keys = p->notes.keys;
  def->values = (const char *const *)p->notes.values;
}

static int is_deck(const output *out)
{
  return out->format && (strcmp(out->format, "lammps-deck") == 0 ||
                         strcmp(out->format, "liggghts-deck") == 0);
}

/* The output of the same pack in a format; NULL: none. */
static const output *beside(const outputs *all, const output *out, const char *format)
{
  for (size_t i = 0; i < all->count; i++) {
    const output *other = &all->items[i];
    if (other->format && strcmp(other->format, format) == 0 && other->pack == out->pack)
      return other;
  }
  return NULL;
}

/* What a deck loads: either program reads either's data. */
static const output *data_beside(const outputs *all, const output *deck)
{
  const int lammps = strcmp(deck->format, "lammps-deck") == 0;
  const output *own = beside(all, deck, lammps ? "lammps" : "liggghts");
  return own ? own : beside(all, deck, lammps ? "liggghts" : "lammps");
}

/* How one file calls another: by its name alone where both lie in one folder. */
static const char *name_from(const output *from, const output *to)
{
  const char *slash = strrchr(from->path, '/'), *cut = strrchr(to->path, '/');
  const size_t depth = slash ? (size_t)(slash + 1 - from->path) : 0;
  if (depth == (cut ? (size_t)(cut + 1 - to->path) : 0) &&
      strncmp(from->path, to->path, depth) == 0)
    return to->path + depth;
  return to->path;
}

static void fill_deck(packing_deck_def *deck, const outputs *all, const output *out)
{
  const output *data = data_beside(all, out), *mesh = beside(all, out, "stl");
  packing_deck_def_init(deck);
  deck->data_name = name_from(out, data);
  if (!mesh)
    mesh = beside(all, out, "stl-ascii");
  if (mesh)
    deck->mesh_name = name_from(out, mesh);
}

packing_status output_write_format(const outputs *all, const output *out, const pack *p,
                                   const packing_stream *stream)
{
  packing_write_def def;
  packing_deck_def deck;
  fill_def(&def, p);
  if (is_deck(out)) {
    fill_deck(&deck, all, out);
    def.deck = &deck;
  }
  return packing_write_pack(p->context, &def, out->format, &p->view, stream);
}

int output_check_format(const outputs *all, const output *out)
{
  if (is_deck(out) && !data_beside(all, out))
    return program_fail(
        PROGRAM_BAD_INPUT,
        "%s: '%s' loads a pack: write that beside it, as in --out pack.data", out->option,
        out->text);
  return 0;
}

/* ---- which format ---- */

static packing_status write_report(const pack *p, const packing_stream *stream)
{
  return stream->write(stream->user, p->report, strlen(p->report));
}

/* What the programs write themselves. */
typedef struct format {
  const char *name;
  const char *extension;
  pack_writer write;
} format;

static const format picture_formats[] = {
    {"png", ".png", picture_write_png},
    {"svg", ".svg", picture_write_svg},
    {NULL, NULL, NULL},
};

static const format sizes_formats[] = {
    {"png", ".png", picture_write_sizes_png},
    {"svg", ".svg", picture_write_sizes_svg},
    {NULL, NULL, NULL},
};

static int has_extension(const char *path, const char *extension)
{
  const size_t all = strlen(path), end = strlen(extension);
  return all > end && strcmp(path + all - end, extension) == 0 &&
         path[all - end - 1] != '/';
}

/* A file name with a colon in it needs a slash before: ./a:b.csv. */
static size_t prefix_length(const char *text)
{
  const size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_-");
  return text[length] == ':' ? length : 0;
}

static int unknown_format(const char *option, const char *text, size_t length)
{
  char known[512] = "";
  const packing_write_format *f;
  for (size_t i = 0; (f = packing_write_format_at(i)) != NULL; i++)
    spec_list(known, sizeof known, f->name);
  for (const format *own = picture_formats; own->name; own++)
    spec_list(known, sizeof known, own->name);
  return program_fail(PROGRAM_BAD_INPUT, "%s: unknown format '%.*s'; known are %s",
                      option, (int)length, text, known);
}

static int unknown_extension(const char *option, const char *path)
{
  char known[512] = "";
  const packing_write_format *f;
  for (size_t i = 0; (f = packing_write_format_at(i)) != NULL; i++)
    if (*f->extensions)
      spec_list(known, sizeof known, f->extensions);
  return program_fail(
      PROGRAM_BAD_INPUT,
      "%s: '%s' has none of the extensions %s, .png, .svg, and no FORMAT: "
      "is before it",
      option, path, known);
}

static int add_by_name(outputs *all, const char *option, const char *text)
{
  char name[32];
  const size_t length = prefix_length(text);
  snprintf(name, sizeof name, "%.*s", (int)length, text);
  const packing_write_format *f = packing_write_format_find(name);
  const format *own = picture_formats;
  while (own->name && strcmp(own->name, name) != 0)
    own++;
  if (length >= sizeof name || (!f && !own->name))
    return unknown_format(option, text, length);
  if (!text[length + 1])
    return program_fail(PROGRAM_BAD_INPUT, "%s: a file name is missing after '%s'",
                        option, text);
  output *made = outputs_add(all, option, text, text + length + 1);
  made->format = f ? f->name : NULL;
  made->write = f ? NULL : own->write;
  return 0;
}

static const format *find_extension(const char *path, const format *formats)
{
  for (const format *f = formats; f->name; f++)
    if (has_extension(path, f->extension))
      return f;
  return NULL;
}

/* The format of a picture's path, NULL after a line about what is wrong with it. */
static const format *picture_of(const char *option, const char *path,
                                const format *formats)
{
  const format *f = find_extension(path, formats);
  if (!f)
    program_fail(PROGRAM_BAD_INPUT, "%s: '%s' has none of the extensions .png .svg",
                 option, path);
  return f;
}

int outputs_add_pack(outputs *all, const char *option, const char *text)
{
  if (prefix_length(text))
    return add_by_name(all, option, text);
  const packing_write_format *f = packing_write_format_of(text);
  const format *own = find_extension(text, picture_formats);
  if (!f && !own)
    return unknown_extension(option, text);
  output *made = outputs_add(all, option, text, text);
  made->format = f ? f->name : NULL;
  made->write = f ? NULL : own->write;
  return 0;
}

int outputs_add_sizes(outputs *all, const char *option, const char *path)
{
  const format *f = picture_of(option, path, sizes_formats);
  if (!f)
    return PROGRAM_BAD_INPUT;
  outputs_add(all, option, path, path)->write = f->write;
  return 0;
}

int outputs_add_sheet(outputs *all, const char *option, const char *path)
{
  static const format formats[] = {
      {"png", ".png", NULL}, {"svg", ".svg", NULL}, {NULL, NULL, NULL}};
  const format *f = picture_of(option, path, formats);
  if (!f)
    return PROGRAM_BAD_INPUT;
  output *made = outputs_add(all, option, path, path);
  made->write_all = f == formats ? picture_write_sheet_png : picture_write_sheet_svg;
  made->shared = 1;
  return 0;
}

int outputs_add_report(outputs *all, const char *option, const char *path)
{
  if (!*path)
    return program_fail(PROGRAM_BAD_INPUT, "%s: a file name is missing", option);
  output *made = outputs_add(all, option, path, path);
  made->write = write_report;
  made->shared = 1;
  return 0;
}
