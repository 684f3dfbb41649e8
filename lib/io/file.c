/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that appear whole or not at all: bytes go to a temporary file in the same directory,
 * which is synced and renamed over the final name; then the directory is synced. What stands
 * there and is no regular file (a device, a pipe, standard output) is written in place.
 *
 * The temporary file is made with O_EXCL and mode 0666, so the umask decides the permissions
 * without being touched. */
#define _XOPEN_SOURCE 700
#include "io_internal.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { CAPACITY = 1 << 16, MOST_NAMES = 10000, REASON_SIZE = 128, SHOWN_PATH = 300 };

struct packing_file {
  packing_context *context;
  packing_stream stream;
  int fd;
  int error;   /* errno of the first failure, else 0 */
  char *path;  /* as the user gave it */
  char *final; /* where it will stand, links followed; NULL: written in place or read */
  char *temporary;
  int made;     /* `temporary` stands in the directory */
  char *buffer; /* when writing */
  size_t used;
};

static const packing_allocator *allocator_of(const packing_file *f)
{
  return packing_i_allocator(f->context);
}

/* "PATH: the system's reason", in one printable line. Of a long path the end is shown. */
static packing_status fail(packing_context *context, const char *path, int error)
{
  char reason[REASON_SIZE], shown[SHOWN_PATH + 4];
  const size_t length = strlen(path);
  const int cut = length > SHOWN_PATH;
  if (strerror_r(error, reason, sizeof reason) != 0)
    (void)snprintf(reason, sizeof reason, "error %d", error);
  (void)snprintf(shown, sizeof shown, "%s%s", cut ? "..." : "",
                 path + (cut ? length - SHOWN_PATH : 0));
  for (char *p = shown; *p != '\0'; p++)
    if ((unsigned char)*p < ' ' || *p == 127)
      *p = '?';
  return packing_i_fail(context, PACKING_ERR_IO, NULL, PACKING_NO_INDEX, "%s: %s", shown,
                        reason);
}

static packing_status remember(packing_file *f, int error)
{
  if (f->error == 0)
    f->error = error;
  return fail(f->context, f->path, f->error);
}

static int open_again(const char *path, int flags)
{
  int fd;
  do
    fd = open(path, flags | O_CLOEXEC | O_NOCTTY, 0666);
  while (fd < 0 && errno == EINTR);
  return fd;
}

static packing_status file_read(void *user, void *buffer, size_t capacity, size_t *count)
{
  packing_file *f = user;
  ssize_t n;
  do
    n = read(f->fd, buffer, capacity > SSIZE_MAX ? SSIZE_MAX : capacity);
  while (n < 0 && errno == EINTR);
  if (n < 0)
    return remember(f, errno);
  *count = (size_t)n;
  return PACKING_OK;
}

/* Writes all of it, or sets errno and returns 0. */
static int write_all(int fd, const char *data, size_t count)
{
  while (count > 0) {
    const ssize_t n = write(fd, data, count > SSIZE_MAX ? SSIZE_MAX : count);
    if (n < 0 && errno != EINTR)
      return 0;
    if (n > 0) {
      data += n;
      count -= (size_t)n;
    }
  }
  return 1;
}

static packing_status flush(packing_file *f)
{
  if (f->error != 0)
    return remember(f, f->error);
  if (!write_all(f->fd, f->buffer, f->used))
    return remember(f, errno);
  f->used = 0;
  return PACKING_OK;
}

static packing_status file_write(void *user, const void *data, size_t count)
{
  packing_file *f = user;
  if (f->error != 0)
    return remember(f, f->error);
  if (count > CAPACITY - f->used)
    PACKING_I_TRY(flush(f));
  if (count > CAPACITY)
    return write_all(f->fd, data, count) ? PACKING_OK : remember(f, errno);
  memcpy(f->buffer + f->used, data, count);
  f->used += count;
  return PACKING_OK;
}

int packing_i_stream_reports_to(const packing_stream *stream,
                                const packing_context *context)
{
  if (stream->read != file_read && stream->write != file_write)
    return 0;
  return ((const packing_file *)stream->user)->context == context;
}

packing_stream *packing_file_stream(packing_file *file)
{
  return &file->stream;
}

static char *copy(const packing_allocator *allocator, const char *text)
{
  const size_t size = strlen(text) + 1;
  char *c = packing_i_alloc(allocator, size, 1);
  return c == NULL ? NULL : memcpy(c, text, size);
}

static void release(packing_file *f)
{
  const packing_allocator *allocator = allocator_of(f);
  packing_context *context = f->context;
  packing_i_free(allocator, f->path);
  packing_i_free(allocator, f->final);
  packing_i_free(allocator, f->temporary);
  packing_i_free(allocator, f->buffer);
  packing_i_free(allocator, f);
  packing_context_destroy(context);
}

/* A file without a descriptor yet; `out` is where the caller will put it. */
static packing_status make(packing_context *context, const char *path,
                           packing_file *const *out, packing_file **file)
{
  if (path == NULL || out == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, path == NULL ? "path" : "file",
                          PACKING_NO_INDEX, "NULL");
  packing_file *f = packing_i_calloc(packing_i_allocator(context), 1, sizeof *f);
  if (f == NULL)
    return packing_i_nomem(context);
  f->context = packing_i_context_hold(context);
  f->fd = -1;
  f->stream.user = f;
  f->path = copy(allocator_of(f), path);
  if (f->path == NULL) {
    release(f);
    return packing_i_nomem(context);
  }
  *file = f;
  return PACKING_OK;
}

packing_status packing_file_open(packing_context *context, const char *path,
                                 packing_file **file)
{
  packing_file *f = NULL;
  struct stat s = {0};
  PACKING_I_TRY(make(context, path, file, &f));
  f->stream.read = file_read;
  f->fd = open_again(path, O_RDONLY);
  int error = f->fd < 0 || fstat(f->fd, &s) != 0 ? errno : 0;
  if (error == 0 && S_ISDIR(s.st_mode))
    error = EISDIR;
  if (error != 0) {
    packing_file_close(f);
    return fail(context, path, error);
  }
  *file = f;
  return PACKING_OK;
}

/* Standard output may be a regular file of the shell's: its name is a link in /proc, and a
 * rename would put a new file where the shell's other output does not go. */
static int is_in_place(const char *path)
{
  struct stat s;
  if (strncmp(path, "/proc/", 6) == 0)
    return 1;
  if (strncmp(path, "/dev/", 5) == 0 && strncmp(path, "/dev/shm/", 9) != 0)
    return 1;
  return stat(path, &s) == 0 && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode);
}

/* Opens PATH's-directory/.packing-PID-N.tmp for the first N that is free. `size` holds it. */
static int open_temporary(packing_file *f, size_t directory, size_t size)
{
  for (int n = 0; n < MOST_NAMES; n++) {
    (void)snprintf(f->temporary + directory, size - directory, ".packing-%ld-%d.tmp",
                   (long)getpid(), n);
    f->fd = open_again(f->temporary, O_WRONLY | O_CREAT | O_EXCL);
    if (f->fd >= 0 || errno != EEXIST)
      break;
  }
  f->made = f->fd >= 0;
  return f->made ? 0 : errno;
}

/* Follows links where the file exists, so that a link keeps pointing at what is replaced. */
static packing_status start_temporary(packing_file *f, int *error)
{
  enum { NAME_SIZE = 64 };
  char resolved[PATH_MAX];
  struct stat s;
  if (stat(f->path, &s) == 0 && S_ISDIR(s.st_mode)) {
    *error = EISDIR;
    return PACKING_OK;
  }
  const char *target = realpath(f->path, resolved) != NULL ? resolved : f->path;
  const char *slash = strrchr(target, '/');
  const size_t directory = slash == NULL ? 0 : (size_t)(slash + 1 - target);
  const size_t size = directory + NAME_SIZE;
  f->final = copy(allocator_of(f), target);
  f->temporary = packing_i_alloc(allocator_of(f), size, 1);
  if (f->final == NULL || f->temporary == NULL)
    return packing_i_nomem(f->context);
  memcpy(f->temporary, target, directory);
  *error = target[directory] == '\0' ? ENOENT : open_temporary(f, directory, size);
  return PACKING_OK;
}

static packing_status start(packing_file *f, int *error)
{
  f->stream.write = file_write;
  f->buffer = packing_i_alloc(allocator_of(f), CAPACITY, 1);
  if (f->buffer == NULL)
    return packing_i_nomem(f->context);
  if (!is_in_place(f->path))
    return start_temporary(f, error);
  f->fd = open_again(f->path, O_WRONLY | O_APPEND);
  *error = f->fd < 0 ? errno : 0;
  return PACKING_OK;
}

packing_status packing_file_create(packing_context *context, const char *path,
                                   packing_file **file)
{
  packing_file *f = NULL;
  int error = 0;
  PACKING_I_TRY(make(context, path, file, &f));
  packing_status status = start(f, &error);
  if (status == PACKING_OK && error == 0) {
    *file = f;
    return PACKING_OK;
  }
  packing_file_close(f);
  return status == PACKING_OK ? fail(context, path, error) : status;
}

/* What a device cannot do is no failure of the file. */
static int sync_fd(int fd)
{
  int done;
  do
    done = fsync(fd);
  while (done != 0 && errno == EINTR);
  return done == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS ? 0 : errno;
}

/* A directory that may be written but not read cannot be opened to be synced. */
static int sync_directory(char *path)
{
  char *slash = strrchr(path, '/');
  const char kept = slash == NULL ? '\0' : slash[1];
  if (slash != NULL)
    slash[1] = '\0';
  const int fd = open_again(slash == NULL ? "." : path, O_RDONLY | O_DIRECTORY);
  if (slash != NULL)
    slash[1] = kept;
  if (fd < 0)
    return errno == EACCES ? 0 : errno;
  const int error = sync_fd(fd);
  close(fd);
  return error;
}

static int close_fd(packing_file *f)
{
  const int fd = f->fd;
  f->fd = -1;
  /* after EINTR the descriptor is closed on Linux, and must not be closed again */
  return close(fd) == 0 || errno == EINTR ? 0 : errno;
}

static int finish(packing_file *f)
{
  int error = flush(f) == PACKING_OK ? 0 : f->error;
  if (error == 0)
    error = sync_fd(f->fd);
  const int closed = close_fd(f);
  if (error == 0)
    error = closed;
  if (error != 0 || f->final == NULL)
    return error;
  if (rename(f->temporary, f->final) != 0)
    return errno;
  f->made = 0;
  return sync_directory(f->final);
}

packing_status packing_file_commit(packing_file *file)
{
  packing_status status = PACKING_OK;
  if (file == NULL)
    return PACKING_ERR_INVALID;
  if (file->stream.write == NULL) {
    status = packing_i_fail(file->context, PACKING_ERR_INVALID, "file", PACKING_NO_INDEX,
                            "it was opened for reading");
  } else {
    const int error = finish(file);
    if (error != 0)
      status = fail(file->context, file->path, error);
  }
  packing_file_close(file);
  return status;
}

void packing_file_close(packing_file *file)
{
  if (file == NULL)
    return;
  if (file->fd >= 0)
    close(file->fd);
  if (file->made)
    unlink(file->temporary);
  release(file);
}
