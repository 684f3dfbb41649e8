/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "text_file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "sha256.h"

static void note_input(input_files *files, const char *path, const char *text,
                       size_t length)
{
  sha256 hash;
  files->items = program_take_more(files->items, files->count + 1, sizeof *files->items);
  input_file *file = &files->items[files->count++];
  file->path = program_copy(path, strlen(path));
  sha256_start(&hash);
  sha256_add(&hash, text, length);
  sha256_finish(&hash, file->sha256);
}

static packing_status read_all(const packing_stream *stream, char **text, size_t *length)
{
  size_t capacity = 1 << 16, got = 1;
  packing_status status = PACKING_OK;
  *text = program_take(capacity, 1);
  while (got > 0 && status == PACKING_OK && !interrupted()) {
    if (capacity - *length < 2) {
      capacity *= 2;
      *text = program_take_more(*text, capacity, 1);
    }
    status = stream->read(stream->user, *text + *length, capacity - *length - 1, &got);
    *length += status == PACKING_OK ? got : 0;
  }
  (*text)[*length] = '\0';
  return status;
}

int text_file_read(packing_context *context, input_files *files, const char *option,
                   const char *path, char **text, size_t *length)
{
  packing_file *file = NULL;
  char where[4200];
  *text = NULL;
  *length = 0;
  packing_status status = packing_file_open(context, path, &file);
  if (status != PACKING_OK)
    return program_status(context, status, option);
  status = read_all(packing_file_stream(file), text, length);
  packing_file_close(file);
  if (interrupted())
    return program_interrupted();
  if (status != PACKING_OK) {
    snprintf(where, sizeof where, "%s: %s", option, path);
    return program_status(context, status, where);
  }
  note_input(files, path, *text, *length);
  return 0;
}
