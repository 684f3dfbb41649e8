/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One container of --domain: KIND:FIELDS[,axis=A][+MODIFIER[:VALUE]]... */
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "spec.h"
#include "tap.h"

enum { PERIODIC = 1, OPEN = 2, AXIS = 4, FROM_FILE = 8 };

typedef struct kind_row {
  const char *name;
  const char *form;     /* for messages */
  const char *field[4]; /* names of the lengths; NULL past the last */
  domain_kind kind;
  int dim;
  int can;    /* which modifiers make sense */
  int height; /* which length is the height, from 1; 0: none */
} kind_row;

static const kind_row kinds[] = {
    {"box", "box:LX,LY,LZ", {"LX", "LY", "LZ"}, DOMAIN_BOX, 3, PERIODIC | OPEN, 3},
    {"rect", "rect:LX,LY", {"LX", "LY"}, DOMAIN_RECT, 2, PERIODIC | OPEN, 2},
    {"cylinder", "cylinder:R,H", {"R", "H"}, DOMAIN_CYLINDER, 3, OPEN | AXIS, 2},
    {"tube", "tube:RI,RO,H", {"RI", "RO", "H"}, DOMAIN_TUBE, 3, OPEN | AXIS, 3},
    {"cone", "cone:R0,R1,H", {"R0", "R1", "H"}, DOMAIN_CONE, 3, OPEN | AXIS, 3},
    {"silo",
     "silo:R,H,ROUT,HCONE",
     {"R", "H", "ROUT", "HCONE"},
     DOMAIN_SILO,
     3,
     OPEN | AXIS,
     2},
    {"sphere", "sphere:R", {"R"}, DOMAIN_SPHERE, 3, 0, 0},
    {"circle", "circle:R", {"R"}, DOMAIN_CIRCLE, 2, 0, 0},
    {"annulus", "annulus:RI,RO", {"RI", "RO"}, DOMAIN_ANNULUS, 2, 0, 0},
    {"polygon", "polygon:FILE", {NULL}, DOMAIN_POLYGON, 2, FROM_FILE, 0},
    {"mesh", "mesh:FILE", {NULL}, DOMAIN_MESH, 3, FROM_FILE, 0},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* The option being read, which every message names first. */
static const char *option = "--domain";

__attribute__((format(printf, 1, 2))) static int bad(const char *format, ...)
{
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return program_fail(PROGRAM_BAD_INPUT, "%s: %s", option, text);
}

static int unknown_kind(const char *name)
{
  char list[256] = "";
  for (size_t i = 0; i < KINDS; i++)
    spec_list(list, sizeof list, kinds[i].name);
  return bad("unknown container '%s'; known are %s", name, list);
}

static const kind_row *find_kind(const char *name)
{
  for (size_t i = 0; i < KINDS; i++)
    if (strcmp(kinds[i].name, name) == 0)
      return &kinds[i];
  return NULL;
}

static size_t count_fields(const kind_row *row)
{
  size_t n = 0;
  while (n < 4 && row->field[n])
    n++;
  return n;
}

/* "axis=x" */
static int read_axis(const kind_row *row, const char *value, domain_spec *spec)
{
  if (!(row->can & AXIS))
    return bad("axis: does not apply to %s", row->name);
  if (strlen(value) != 1 || !strchr("xyz", *value))
    return bad("axis: '%s' is not x, y or z", value);
  spec->axis = (packing_axis)(*value - 'x');
  return 0;
}

static int read_lengths(const kind_row *row, char **words, size_t count,
                        domain_spec *spec)
{
  const size_t need = count_fields(row);
  if (count > need && strncmp(words[count - 1], "axis=", 5) == 0) {
    const int code = read_axis(row, words[--count] + 5, spec);
    if (code)
      return code;
  }
  if (count < need)
    return bad("%s is missing, as in %s", row->field[*words[0] ? count : 0], row->form);
  if (count > need)
    return bad("'%s' is one field too many for %s", words[need], row->form);
  for (size_t i = 0; i < need; i++) {
    char where[64];
    snprintf(where, sizeof where, "%s: %s: %s", option, row->name, row->field[i]);
    const int code = number_real(where, words[i], &spec->size[i]);
    if (code)
      return code;
  }
  return 0;
}

static int read_periodic(const kind_row *row, const char *value, domain_spec *spec)
{
  const char *all = row->dim == 2 ? "xy" : "xyz";
  if (!(row->can & PERIODIC))
    return bad("+periodic: does not apply to %s", row->name);
  for (const char *at = value ? value : all; *at; at++) {
    if (!strchr(all, *at))
      return bad("+periodic: '%s' has other letters than %s", value, all);
    spec->periodic |= (unsigned)PACKING_PERIODIC_X << (*at - 'x');
  }
  return spec->periodic ? 0 : bad("+periodic: an axis is missing");
}

static int read_at(const kind_row *row, char *value, domain_spec *spec)
{
  double v[3] = {0, 0, 0};
  size_t count = 0;
  int code = 0;
  char where[64];
  snprintf(where, sizeof where, "%s: +at", option);
  char **words = spec_split(value, ',', &count);
  if (count > 3 || count < (size_t)row->dim)
    code = bad("+at: %zu numbers, where %s is wanted", count,
               row->dim == 2 ? "X,Y" : "X,Y,Z");
  for (size_t i = 0; i < count && !code; i++)
    code = number_real(where, words[i], &v[i]);
  if (!code && row->dim == 2 && v[2] != 0)
    code = bad("+at: Z must be 0 in two dimensions");
  spec->at.x += v[0];
  spec->at.y += v[1];
  spec->at.z += v[2];
  free(words);
  return code;
}

static int read_scale(const char *value, domain_spec *spec)
{
  double scale = 1;
  char where[64];
  snprintf(where, sizeof where, "%s: +scale", option);
  const int code = number_positive(where, value, &scale);
  if (code)
    return code;
  domain_spec_scale(spec, scale);
  return 0;
}

static int read_modifier(const kind_row *row, char *word, domain_spec *spec)
{
  char *value = strchr(word, ':');
  if (value)
    *value++ = '\0';
  if (strcmp(word, "periodic") == 0)
    return read_periodic(row, value, spec);
  if (strcmp(word, "at") == 0)
    return read_at(row, value ? value : word + 2, spec);
  if (strcmp(word, "scale") == 0)
    return read_scale(value ? value : "", spec);
  if (strcmp(word, "open") != 0)
    return bad("unknown modifier '+%s'; known are +periodic, +at, +scale, +open", word);
  if (!(row->can & OPEN))
    return bad("+open: does not apply to %s", row->name);
  if (!value || strcmp(value, "top") != 0)
    return bad("+open: '%s' is not top", value ? value : "");
  spec->open_top = 1;
  return 0;
}

void domain_spec_none(int dim, domain_spec *spec)
{
  memset(spec, 0, sizeof *spec);
  spec->axis = PACKING_AXIS_Z;
  spec->scale = spec->more_scale = 1;
  spec->dim = dim;
}

/* Ends the word at `at` before the next modifier and returns that, or NULL. A '+' before a
 * digit or a point belongs to a number. */
static char *cut_modifier(char *at)
{
  for (; *at; at++)
    if (*at == '+' && !isdigit((unsigned char)at[1]) && at[1] != '.') {
      *at = '\0';
      return at + 1;
    }
  return NULL;
}

/* The file's name stays where it is typed, at `typed`. */
static int read_file_name(const kind_row *row, const char *fields, const char *typed,
                          domain_spec *spec)
{
  if (!*fields)
    return bad("FILE is missing, as in %s", row->form);
  spec->file = typed;
  spec->file_length = (int)strlen(fields);
  return 0;
}

static int read_fields(const kind_row *row, char *fields, domain_spec *spec)
{
  size_t count = 0;
  char **words = spec_split(fields, ',', &count);
  const int code = read_lengths(row, words, count, spec);
  free(words);
  return code;
}

static int parse(char *text, const char *typed, domain_spec *spec)
{
  char *modifier = cut_modifier(text);
  char *fields = strchr(text, ':');
  char *end = text + strlen(text);
  if (fields)
    *fields++ = '\0';
  else
    fields = end;
  const kind_row *row = find_kind(text);
  if (!row)
    return unknown_kind(text);
  spec->kind = row->kind;
  spec->dim = row->dim;
  int code = row->can & FROM_FILE
                 ? read_file_name(row, fields, typed + (fields - text), spec)
                 : read_fields(row, fields, spec);
  while (modifier && !code) {
    char *word = modifier;
    modifier = cut_modifier(word);
    code = read_modifier(row, word, spec);
  }
  return code;
}

int domain_part_parse(const char *named, const char *text, size_t length,
                      domain_spec *spec)
{
  option = named;
  domain_spec_none(0, spec);
  spec->text = text;
  char *copy = program_copy(text, length);
  const int code = parse(copy, text, spec);
  free(copy);
  return code;
}

static void print_numbers(FILE *to, const double *v, size_t count)
{
  for (size_t i = 0; i < count; i++) {
    char text[NUMBER_TEXT];
    number_text(text, v[i]);
    fprintf(to, "%s%s", i ? "," : "", text);
  }
}

static void print_modifiers(FILE *to, const domain_spec *s)
{
  const double at[] = {s->at.x, s->at.y, s->at.z};
  if (s->periodic)
    fprintf(to, "+periodic:%s%s%s", s->periodic & PACKING_PERIODIC_X ? "x" : "",
            s->periodic & PACKING_PERIODIC_Y ? "y" : "",
            s->periodic & PACKING_PERIODIC_Z ? "z" : "");
  if (s->scale != 1) {
    fputs("+scale:", to);
    print_numbers(to, &s->scale, 1);
  }
  if (at[0] != 0 || at[1] != 0 || at[2] != 0) {
    fputs("+at:", to);
    print_numbers(to, at, (size_t)s->dim);
  }
  if (s->open_top)
    fputs("+open:top", to);
}

void domain_part_print(FILE *to, const domain_spec *s)
{
  const kind_row *row = kinds;
  while (row->kind != s->kind)
    row++;
  fprintf(to, "%s:%.*s", row->name, s->file_length, s->file ? s->file : "");
  print_numbers(to, s->size, count_fields(row));
  if ((row->can & AXIS) && s->axis != PACKING_AXIS_Z)
    fprintf(to, ",axis=%c", "xyz"[s->axis]);
  print_modifiers(to, s);
}

double *domain_spec_height(domain_spec *spec)
{
  for (size_t i = 0; i < KINDS && !spec->more; i++)
    if (kinds[i].kind == spec->kind && kinds[i].height > 0)
      return &spec->size[kinds[i].height - 1];
  return NULL;
}

static packing_status create_flat(packing_context *context, const domain_spec *spec,
                                  packing_domain **domain)
{
  if (spec->kind == DOMAIN_RECT) {
    packing_domain_rectangle_def def;
    packing_domain_rectangle_def_init(&def);
    def.size_x = spec->size[0];
    def.size_y = spec->size[1];
    def.corner = spec->at;
    def.periodic = spec->periodic;
    def.open_top = spec->open_top;
    return packing_domain_create_rectangle(context, &def, domain);
  }
  if (spec->kind == DOMAIN_CIRCLE) {
    packing_domain_circle_def def;
    packing_domain_circle_def_init(&def);
    def.radius = spec->size[0];
    def.centre = spec->at;
    return packing_domain_create_circle(context, &def, domain);
  }
  packing_domain_annulus_def def;
  packing_domain_annulus_def_init(&def);
  def.inner_radius = spec->size[0];
  def.outer_radius = spec->size[1];
  def.centre = spec->at;
  return packing_domain_create_annulus(context, &def, domain);
}

static packing_status create_box(packing_context *context, const domain_spec *spec,
                                 packing_domain **domain)
{
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size = (packing_vec3){spec->size[0], spec->size[1], spec->size[2]};
  def.corner = spec->at;
  def.periodic = spec->periodic;
  def.open_top = spec->open_top;
  return packing_domain_create_box(context, &def, domain);
}

static packing_status create_cylinder(packing_context *context, const domain_spec *spec,
                                      packing_domain **domain)
{
  packing_domain_cylinder_def def;
  packing_domain_cylinder_def_init(&def);
  def.radius = spec->size[0];
  def.height = spec->size[1];
  def.base = spec->at;
  def.axis = spec->axis;
  def.open_top = spec->open_top;
  return packing_domain_create_cylinder(context, &def, domain);
}

static packing_status create_tube(packing_context *context, const domain_spec *spec,
                                  packing_domain **domain)
{
  packing_domain_tube_def def;
  packing_domain_tube_def_init(&def);
  def.inner_radius = spec->size[0];
  def.outer_radius = spec->size[1];
  def.height = spec->size[2];
  def.base = spec->at;
  def.axis = spec->axis;
  def.open_top = spec->open_top;
  return packing_domain_create_tube(context, &def, domain);
}

static packing_status create_cone(packing_context *context, const domain_spec *spec,
                                  packing_domain **domain)
{
  packing_domain_cone_def def;
  packing_domain_cone_def_init(&def);
  def.bottom_radius = spec->size[0];
  def.top_radius = spec->size[1];
  def.height = spec->size[2];
  def.base = spec->at;
  def.axis = spec->axis;
  def.open_top = spec->open_top;
  return packing_domain_create_cone(context, &def, domain);
}

static packing_status create_silo(packing_context *context, const domain_spec *spec,
                                  packing_domain **domain)
{
  packing_domain_silo_def def;
  packing_domain_silo_def_init(&def);
  def.radius = spec->size[0];
  def.height = spec->size[1];
  def.outlet_radius = spec->size[2];
  def.hopper_height = spec->size[3];
  def.base = spec->at;
  def.axis = spec->axis;
  def.open_top = spec->open_top;
  return packing_domain_create_silo(context, &def, domain);
}

static packing_status create_sphere(packing_context *context, const domain_spec *spec,
                                    packing_domain **domain)
{
  packing_domain_sphere_def def;
  packing_domain_sphere_def_init(&def);
  def.radius = spec->size[0];
  def.centre = spec->at;
  return packing_domain_create_sphere(context, &def, domain);
}

typedef packing_status (*file_reader)(packing_context *context, const domain_spec *spec,
                                      const packing_stream *stream,
                                      packing_domain **domain);

static packing_status read_polygon(packing_context *context, const domain_spec *spec,
                                   const packing_stream *stream, packing_domain **domain)
{
  packing_read_polygon_def def;
  packing_read_polygon_def_init(&def);
  def.scale = spec->scale;
  def.offset = spec->at;
  return packing_read_polygon(context, &def, stream, domain);
}

static packing_status read_mesh(packing_context *context, const domain_spec *spec,
                                const packing_stream *stream, packing_domain **domain)
{
  packing_read_mesh_def def;
  packing_domain_mesh_def walls;
  packing_read_mesh_def_init(&def);
  packing_domain_mesh_def_init(&walls);
  def.scale = spec->scale;
  def.shift = spec->at;
  packing_status status = packing_read_mesh(context, &def, stream, &walls.mesh);
  if (status == PACKING_OK)
    status = packing_domain_create_mesh(context, &walls, domain);
  packing_mesh_destroy(walls.mesh);
  return status;
}

static int create_from_file(packing_context *context, const domain_spec *spec,
                            file_reader reader, input_files *files,
                            packing_domain **domain)
{
  char where[512];
  packing_file *file = NULL;
  char *path = program_copy(spec->file, (size_t)spec->file_length);
  snprintf(where, sizeof where, "%s: %s", option, path);
  packing_status status = packing_file_open(context, path, &file);
  if (status == PACKING_OK) {
    tap t;
    tap_open(&t, packing_file_stream(file));
    status = reader(context, spec, &t.stream, domain);
    if (status == PACKING_OK && files)
      tap_note(&t, files, path);
    packing_file_close(file);
  } else {
    snprintf(where, sizeof where, "%s", option);
  }
  free(path);
  return status == PACKING_OK ? 0 : program_status(context, status, where);
}

int domain_part_create(packing_context *context, const domain_spec *spec,
                       input_files *files, packing_domain **domain)
{
  static packing_status (*const create[])(packing_context *, const domain_spec *,
                                          packing_domain **) = {
      [DOMAIN_BOX] = create_box,           [DOMAIN_RECT] = create_flat,
      [DOMAIN_CYLINDER] = create_cylinder, [DOMAIN_TUBE] = create_tube,
      [DOMAIN_CONE] = create_cone,         [DOMAIN_SILO] = create_silo,
      [DOMAIN_SPHERE] = create_sphere,     [DOMAIN_CIRCLE] = create_flat,
      [DOMAIN_ANNULUS] = create_flat};
  if (spec->kind == DOMAIN_POLYGON)
    return create_from_file(context, spec, read_polygon, files, domain);
  if (spec->kind == DOMAIN_MESH)
    return create_from_file(context, spec, read_mesh, files, domain);
  const packing_status status = create[spec->kind](context, spec, domain);
  return status == PACKING_OK ? 0 : program_status(context, status, option);
}
