/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "program.h"
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "progress.h"

static int quiet;

static void print_line(const char *format, va_list arguments)
{
  progress_clear();
  fprintf(stderr, "%s: ", program_invocation_short_name);
  vfprintf(stderr, format, arguments);
  fputc('\n', stderr);
}

int program_fail(int code, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  print_line(format, arguments);
  va_end(arguments);
  return code;
}

void program_remark(const char *format, ...)
{
  va_list arguments;
  if (quiet)
    return;
  va_start(arguments, format);
  print_line(format, arguments);
  va_end(arguments);
}

void program_quiet(void)
{
  quiet = 1;
}

int program_interrupted(void)
{
  return program_fail(PROGRAM_INTERRUPTED, "interrupted, nothing written");
}

static int exit_code(packing_status status)
{
  switch (status) {
  case PACKING_ERR_NOMEM:
  case PACKING_ERR_IO:
  case PACKING_ERR_ABI:
  case PACKING_ERR_INTERNAL:
    return PROGRAM_SYSTEM;
  default:
    return PROGRAM_BAD_INPUT;
  }
}

int program_status(const packing_context *context, packing_status status,
                   const char *what)
{
  const char *message = packing_context_message(context);
  return program_fail(exit_code(status), "%s: %s", what,
                      *message ? message : packing_status_string(status));
}

/* "slip_velocity" as "--slip-velocity", unless a row says otherwise; free it. */
static char *option_of(const char *field, size_t length, const program_field *rows)
{
  for (; rows && rows->field; rows++)
    if (strlen(rows->field) == length && strncmp(rows->field, field, length) == 0)
      return program_copy(rows->option, strlen(rows->option));
  char *option = program_take(length + 3, 1);
  memcpy(option, "--", 2);
  for (size_t i = 0; i < length; i++)
    option[i + 2] = field[i] == '_' ? '-' : field[i];
  return option;
}

int program_field_status(const packing_context *context, packing_status status,
                         const char *what, const program_field *rows)
{
  const char *message = packing_context_message(context);
  const size_t field = strcspn(message, ":[ ");
  if (exit_code(status) != PROGRAM_BAD_INPUT ||
      (message[field] != ':' && message[field] != '['))
    return program_status(context, status, what);
  char *option = option_of(message, field, rows);
  const int code = program_fail(PROGRAM_BAD_INPUT, "%s%s", option, message + field);
  free(option);
  return code;
}

void *program_take_more(void *block, size_t count, size_t size)
{
  void *grown = reallocarray(block, count ? count : 1, size);
  if (!grown)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  return grown;
}

void *program_take(size_t count, size_t size)
{
  void *block = program_take_more(NULL, count, size);
  memset(block, 0, (count ? count : 1) * size);
  return block;
}

char *program_copy(const char *text, size_t length)
{
  char *copy = program_take(length + 1, 1);
  memcpy(copy, text, length);
  return copy;
}

double program_seconds(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Quotes a word for the shell if it has to be. */
static void print_word(FILE *to, const char *word)
{
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789_-+=:,./@%";
  if (*word && strspn(word, plain) == strlen(word)) {
    fputs(word, to);
    return;
  }
  fputc('\'', to);
  for (; *word; word++)
    if (*word == '\'')
      fputs("'\\''", to);
    else
      fputc(*word, to);
  fputc('\'', to);
}

char *program_command_line(int argc, char **argv)
{
  char *line = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&line, &size);
  if (!to)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  fputs(program_invocation_short_name, to);
  for (int i = 1; i < argc; i++) {
    fputc(' ', to);
    print_word(to, argv[i]);
  }
  /* Closing alone forgets the writes that found no memory. */
  const int failed = ferror(to);
  if (fclose(to) != 0 || failed || line == NULL)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  return line;
}
