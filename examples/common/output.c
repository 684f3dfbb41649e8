/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output.h"
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include "picture.h"
#include "program.h"

enum { REASON_SIZE = 512 };

const char output_help[] =
    "write the pack; may be repeated. Formats: csv vtp lammps liggghts yade xyz png svg; "
    "without FORMAT by extension: .csv .vtp .data .xyz .png .svg";

static packing_status write_csv(const pack *p, const packing_stream *stream)
{
  packing_csv_def def;
  packing_csv_def_init(&def);
  def.dim = p->spec->dim;
  def.note_count = p->notes.count;
  def.keys = p->notes.keys;
  def.values = (const char *const *)p->notes.values;
  return packing_write_csv(p->context, &def, &p->view, stream);
}

static packing_status write_vtp(const pack *p, const packing_stream *stream)
{
  return packing_write_vtp(p->context, NULL, &p->view, stream);
}

/* The coordinate along which an open top is open. */
static double *upward(const pack *p, packing_vec3 *v)
{
  if (p->spec->axis == PACKING_AXIS_X)
    return &v->x;
  return p->spec->dim == 2 || p->spec->axis == PACKING_AXIS_Y ? &v->y : &v->z;
}

/* The container's box, and above an open top as far as particles stand out. */
static packing_bounds file_box(const pack *p)
{
  packing_bounds box;
  packing_domain_bounds(p->domain, &box);
  double *end = upward(p, &box.hi);
  for (size_t i = 0; p->spec->open_top && i < p->view.count; i++) {
    packing_vec3 centre = pack_centre(p, i);
    *end = fmax(*end, *upward(p, &centre) + pack_radius(p, i));
  }
  return box;
}

static packing_status write_lammps(const pack *p, const packing_stream *stream)
{
  packing_lammps_def def;
  packing_lammps_def_init(&def);
  def.dim = p->spec->dim;
  def.density = p->density;
  def.box = file_box(p);
  return packing_write_lammps(p->context, &def, &p->view, stream);
}

static packing_status write_yade(const pack *p, const packing_stream *stream)
{
  return packing_write_yade(p->context, NULL, &p->view, stream);
}

static packing_status write_xyz(const pack *p, const packing_stream *stream)
{
  packing_xyz_def def;
  packing_xyz_def_init(&def);
  def.periodic = packing_domain_periodic(p->domain);
  def.box = file_box(p);
  return packing_write_xyz(p->context, &def, &p->view, stream);
}

static packing_status write_report(const pack *p, const packing_stream *stream)
{
  return stream->write(stream->user, p->report, strlen(p->report));
}

typedef struct format {
  const char *name;
  const char *extension; /* NULL: by name only */
  pack_writer write;
} format;

static const format pack_formats[] = {
    {"csv", ".csv", write_csv},
    {"vtp", ".vtp", write_vtp},
    {"lammps", ".data", write_lammps},
    {"liggghts", NULL, write_lammps},
    {"yade", NULL, write_yade},
    {"xyz", ".xyz", write_xyz},
    {"png", ".png", picture_write_png},
    {"svg", ".svg", picture_write_svg},
    {NULL, NULL, NULL},
};

static const format sizes_formats[] = {
    {"png", ".png", picture_write_sizes_png},
    {"svg", ".svg", picture_write_sizes_svg},
    {NULL, NULL, NULL},
};

output *outputs_add(outputs *all, const char *option, const char *text, const char *path)
{
  struct stat there;
  all->items = program_take_more(all->items, all->count + 1, sizeof *all->items);
  output *made = &all->items[all->count++];
  *made = (output){
      .option = option,
      .text = text,
      .path = program_copy(path, strlen(path)),
      .in_place = stat(path, &there) == 0 && !S_ISREG(there.st_mode),
  };
  return made;
}

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
  char known[256] = "";
  for (const format *f = pack_formats; f->name; f++)
    spec_list(known, sizeof known, f->name);
  return program_fail(PROGRAM_BAD_INPUT, "%s: unknown format '%.*s'; known are %s",
                      option, (int)length, text, known);
}

static int add_by_name(outputs *all, const char *option, const char *text)
{
  const size_t length = prefix_length(text);
  for (const format *f = pack_formats; f->name; f++)
    if (strlen(f->name) == length && strncmp(f->name, text, length) == 0) {
      if (!text[length + 1])
        return program_fail(PROGRAM_BAD_INPUT, "%s: a file name is missing after '%s'",
                            option, text);
      outputs_add(all, option, text, text + length + 1)->write = f->write;
      return 0;
    }
  return unknown_format(option, text, length);
}

/* The format of a path, NULL after a line about what is wrong with it. */
static const format *format_of(const char *option, const char *path,
                               const format *formats, const char *known)
{
  for (const format *f = formats; f->name; f++)
    if (f->extension && has_extension(path, f->extension))
      return f;
  program_fail(PROGRAM_BAD_INPUT, "%s: '%s' has none of the extensions %s", option, path,
               known);
  return NULL;
}

int outputs_add_pack(outputs *all, const char *option, const char *text)
{
  if (prefix_length(text))
    return add_by_name(all, option, text);
  const format *f =
      format_of(option, text, pack_formats,
                ".csv .vtp .data .xyz .png .svg, and no FORMAT: is before it");
  if (!f)
    return PROGRAM_BAD_INPUT;
  outputs_add(all, option, text, text)->write = f->write;
  return 0;
}

int outputs_add_sizes(outputs *all, const char *option, const char *path)
{
  const format *f = format_of(option, path, sizes_formats, ".png .svg");
  if (!f)
    return PROGRAM_BAD_INPUT;
  outputs_add(all, option, path, path)->write = f->write;
  return 0;
}

int outputs_add_sheet(outputs *all, const char *option, const char *path)
{
  static const format formats[] = {
      {"png", ".png", NULL}, {"svg", ".svg", NULL}, {NULL, NULL, NULL}};
  const format *f = format_of(option, path, formats, ".png .svg");
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

/* "a.csv" becomes "a-2-3.csv" for set 2, pack 3; without a set "a-3.csv". */
static char *numbered(const char *path, size_t set, size_t number)
{
  const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
  const char *name = slash ? slash + 1 : path;
  const size_t stem = dot && dot > name ? (size_t)(dot - path) : strlen(path);
  char *made = NULL;
  const int length =
      set ? asprintf(&made, "%.*s-%zu-%zu%s", (int)stem, path, set, number, path + stem)
          : asprintf(&made, "%.*s-%zu%s", (int)stem, path, number, path + stem);
  if (length < 0)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  return made;
}

/* All files of a run are open until they appear. */
static void allow_many_files(void)
{
  struct rlimit limit;
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0)
    return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

static int number_one(outputs *to, const output *one, size_t sets, size_t packs)
{
  if (one->in_place)
    return program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is one place for %zu packs",
                        one->option, one->path, sets * packs);
  for (size_t i = 0; i < sets * packs; i++) {
    char *path = numbered(one->path, sets > 1 ? i / packs + 1 : 0, i % packs + 1);
    output *made = outputs_add(to, one->option, one->text, path);
    made->write = one->write;
    made->pack = i;
    free(path);
  }
  return 0;
}

int outputs_number(outputs *all, size_t sets, size_t packs)
{
  outputs typed = *all;
  int code = 0;
  if (sets * packs == 1)
    return 0;
  allow_many_files();
  *all = (outputs){NULL, 0};
  for (size_t i = 0; i < typed.count && !code; i++) {
    output *one = &typed.items[i];
    if (!one->shared) {
      code = number_one(all, one, sets, packs);
      continue;
    }
    output *kept = outputs_add(all, one->option, one->text, one->path);
    kept->write = one->write;
    kept->write_all = one->write_all;
    kept->shared = 1;
  }
  outputs_free(&typed);
  return code;
}

/* One name for a file that may not be there yet: its folder's real path and its own name. */
static char *real_name(const char *path)
{
  char *whole = realpath(path, NULL);
  if (whole)
    return whole;
  char *folder_text = program_copy(path, strlen(path));
  char *name_text = program_copy(path, strlen(path));
  char *folder = realpath(dirname(folder_text), NULL);
  if (folder && asprintf(&whole, "%s/%s", folder, basename(name_text)) < 0)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  free(folder);
  free(name_text);
  free(folder_text);
  return whole;
}

static int same_name(const char *a, const char *b)
{
  return a && b && strcmp(a, b) == 0;
}

static int check_names(const outputs *all, size_t i, const input_files *inputs)
{
  output *out = &all->items[i];
  if (out->in_place)
    return 0;
  out->real = real_name(out->path);
  for (size_t k = 0; k < i; k++)
    if (same_name(out->real, all->items[k].real))
      return program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is written twice (%s '%s')",
                          out->option, out->path, all->items[k].option,
                          all->items[k].path);
  for (size_t k = 0; k < inputs->count; k++) {
    char *input = real_name(inputs->items[k].path);
    const int same = same_name(out->real, input);
    free(input);
    if (same)
      return program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is an input", out->option,
                          out->path);
  }
  return 0;
}

/* Starting a file beside its place and throwing it away shows that it can be written; a
 * device or a pipe is only asked, since opening it may wait for its other end. */
static int check_place(const output *out, packing_context *context)
{
  struct stat there;
  packing_file *file = NULL;
  if (out->in_place) {
    if (stat(out->path, &there) == 0 && S_ISDIR(there.st_mode))
      return program_fail(PROGRAM_SYSTEM, "%s: '%s' is a directory", out->option,
                          out->path);
    if (access(out->path, W_OK) != 0)
      return program_fail(PROGRAM_SYSTEM, "%s: '%s': %s", out->option, out->path,
                          strerror(errno));
    return 0;
  }
  const packing_status status = packing_file_create(context, out->path, &file);
  if (status != PACKING_OK)
    return program_status(context, status, out->option);
  packing_file_close(file);
  return 0;
}

int outputs_check(const outputs *all, packing_context *context, const input_files *inputs)
{
  int code = 0;
  for (size_t i = 0; i < all->count && !code; i++) {
    code = check_names(all, i, inputs);
    if (!code)
      code = check_place(&all->items[i], context);
  }
  return code;
}

typedef struct passage {
  const packing_context *context;
  const packing_stream *inner;
  char reason[REASON_SIZE]; /* of the file; the writer's own would stand over it */
} passage;

/* Passes writes through until the program is told to stop. */
static packing_status write_on(void *user, const void *data, size_t count)
{
  passage *way = user;
  if (interrupted())
    return PACKING_ERR_IO;
  const packing_status status = way->inner->write(way->inner->user, data, count);
  if (status != PACKING_OK && !*way->reason)
    snprintf(way->reason, sizeof way->reason, "%s",
             packing_context_message(way->context));
  return status;
}

/* The failure of a file; its line begins with the file's name. */
static int file_status(const output *out, const pack *p, packing_status status)
{
  return interrupted() ? program_interrupted()
                       : program_status(p->context, status, out->option);
}

/* The failure of what is written into a file. */
static int output_status(const output *out, const pack *p, packing_status status,
                         const char *reason)
{
  char where[PATH_MAX + 64];
  if (interrupted())
    return program_interrupted();
  if (*reason)
    return program_fail(PROGRAM_SYSTEM, "%s: %s", out->option, reason);
  snprintf(where, sizeof where, "%s: %s", out->option, out->path);
  return program_status(p->context, status, where);
}

/* Opening a pipe waits for its reader without end; here the wait ends when the program is told
 * to stop. Returns a descriptor that keeps the pipe open, else -1. */
static int await_reader(const output *out)
{
  static const struct timespec while_waiting = {.tv_nsec = 20000000};
  struct stat there;
  int fd;
  if (!out->in_place || stat(out->path, &there) != 0 || !S_ISFIFO(there.st_mode))
    return -1;
  while ((fd = open(out->path, O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) < 0 &&
         errno == ENXIO && !interrupted())
    nanosleep(&while_waiting, NULL);
  return fd;
}

static int write_one(output *out, const pack *packs, size_t count)
{
  const pack *p = &packs[out->pack];
  const int fd = await_reader(out);
  if (interrupted())
    return program_interrupted();
  packing_status status = packing_file_create(p->context, out->path, &out->file);
  if (fd >= 0)
    close(fd);
  if (status != PACKING_OK)
    return file_status(out, p, status);
  passage way = {.context = p->context, .inner = packing_file_stream(out->file)};
  const packing_stream stream = {.write = write_on, .user = &way};
  status =
      out->write_all ? out->write_all(packs, count, &stream) : out->write(p, &stream);
  return status == PACKING_OK ? 0 : output_status(out, p, status, way.reason);
}

static int commit(outputs *all, const pack *p, int in_place)
{
  for (size_t i = 0; i < all->count; i++) {
    output *out = &all->items[i];
    if (out->in_place != in_place)
      continue;
    packing_file *file = out->file;
    out->file = NULL;
    const packing_status status = packing_file_commit(file);
    if (status != PACKING_OK)
      return file_status(out, p, status);
  }
  return 0;
}

static int print_standard_output(const char *text)
{
  if (text && (fputs(text, stdout) == EOF || fflush(stdout) != 0))
    return program_fail(PROGRAM_SYSTEM, "--report: standard output: %s", strerror(errno));
  return 0;
}

int outputs_write(outputs *all, const pack *packs, size_t count,
                  const char *standard_output)
{
  int code = interrupted() ? program_interrupted() : 0;
  for (size_t i = 0; i < all->count && !code; i++)
    code = write_one(&all->items[i], packs, count);
  /* What cannot be taken back comes first, so that its failure leaves no other file. */
  if (!code)
    code = commit(all, packs, 1);
  if (!code)
    code = print_standard_output(standard_output);
  if (!code)
    code = commit(all, packs, 0);
  for (size_t i = 0; i < all->count; i++) {
    packing_file_close(all->items[i].file);
    all->items[i].file = NULL;
  }
  return code;
}

void outputs_free(outputs *all)
{
  for (size_t i = 0; i < all->count; i++) {
    free(all->items[i].path);
    free(all->items[i].real);
  }
  free(all->items);
  all->items = NULL;
  all->count = 0;
}
