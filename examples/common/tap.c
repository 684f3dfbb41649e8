/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tap.h"
#include <string.h>
#include "program.h"

static void keep_head(tap *t, const char *data, size_t count)
{
  const size_t room = TAP_HEAD - t->head_length, taken = count < room ? count : room;
  memcpy(t->head + t->head_length, data, taken);
  t->head_length += taken;
}

static packing_status tap_read(void *user, void *buffer, size_t capacity, size_t *count)
{
  tap *t = user;
  if (interrupted())
    return PACKING_ERR_IO;
  const packing_status status = t->inner->read(t->inner->user, buffer, capacity, count);
  if (status != PACKING_OK)
    return status;
  sha256_add(&t->hash, buffer, *count);
  keep_head(t, buffer, *count);
  return PACKING_OK;
}

void tap_open(tap *t, packing_stream *inner)
{
  memset(t, 0, sizeof *t);
  t->stream.read = tap_read;
  t->stream.user = t;
  t->inner = inner;
  sha256_start(&t->hash);
}

void tap_finish(tap *t, char digits[65])
{
  char rest[4096];
  size_t got = 1;
  while (got && tap_read(t, rest, sizeof rest, &got) == PACKING_OK)
    ;
  sha256_finish(&t->hash, digits);
}

void tap_announce(input_files *files, const char *path)
{
  files->items = program_take_more(files->items, files->count + 1, sizeof *files->items);
  input_file *file = &files->items[files->count++];
  file->path = program_copy(path, strlen(path));
  file->sha256[0] = '\0';
}

void tap_note(tap *t, input_files *files, const char *path)
{
  tap_announce(files, path);
  tap_finish(t, files->items[files->count - 1].sha256);
}
