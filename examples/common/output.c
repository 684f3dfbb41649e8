/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output.h"
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include "program.h"

enum { REASON_SIZE = 512 };

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
    made->format = one->format;
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
      code = output_check_format(all, &all->items[i]);
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

static int write_one(const outputs *all, output *out, const pack *packs, size_t count)
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
  status = out->write_all ? out->write_all(packs, count, &stream)
           : out->format  ? output_write_format(all, out, p, &stream)
                          : out->write(p, &stream);
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
    code = write_one(all, &all->items[i], packs, count);
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
