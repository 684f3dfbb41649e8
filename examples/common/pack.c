/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pack.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include "program.h"

void notes_add(notes *all, const char *key, const char *format, ...)
{
  va_list arguments;
  char *value = NULL;
  va_start(arguments, format);
  const int length = vasprintf(&value, format, arguments);
  va_end(arguments);
  if (length < 0)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  all->keys = program_take_more(all->keys, all->count + 1, sizeof *all->keys);
  all->values = program_take_more(all->values, all->count + 1, sizeof *all->values);
  all->keys[all->count] = key;
  all->values[all->count++] = value;
}

void notes_free(notes *all)
{
  for (size_t i = 0; i < all->count; i++)
    free(all->values[i]);
  free(all->values);
  free(all->keys);
}
