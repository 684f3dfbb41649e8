/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --list: exactly these particles. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "../common/text_file.h"
#include "front.h"

#define BAD(...) program_fail(PROGRAM_BAD_INPUT, __VA_ARGS__)

/* What a column holds. */
typedef enum column { RADIUS, DIAMETER, COUNT, MASS, COLUMNS } column;

static const char *const names[COLUMNS] = {"radius", "diameter", "count", "mass"};

typedef struct reader {
  front_job *job;
  size_t line; /* at hand, from 1 */
  column columns[2];
  int headed;       /* 1: the header was read */
  char where[4300]; /* "--list: FILE: line N" */
} reader;

static int find_column(const reader *at, const char *word, column *found)
{
  for (int i = 0; i < COLUMNS; i++)
    if (strcmp(word, names[i]) == 0) {
      *found = (column)i;
      return 0;
    }
  return BAD("%s: column '%s' is none of radius, diameter, count, mass", at->where, word);
}

static int read_header(reader *at, char **words, size_t count)
{
  int code = count == 2 ? 0
                        : BAD("%s: %zu columns, where radius (or diameter) and count (or "
                              "mass) are wanted",
                              at->where, count);
  for (size_t i = 0; i < count && !code; i++)
    code = find_column(at, words[i], &at->columns[i]);
  if (!code && (at->columns[0] <= DIAMETER) == (at->columns[1] <= DIAMETER))
    code = BAD("%s: radius (or diameter) and count (or mass) are wanted", at->where);
  at->headed = 1;
  return code;
}

/* Whole particles for a mass. */
static int count_of_mass(const reader *at, double mass, double r, double *count)
{
  const double ball = at->job->spec.dim == 2 ? M_PI * r * r : 4 * M_PI / 3 * r * r * r;
  *count = floor(mass / (at->job->asked->common.density * ball) + 0.5);
  return *count >= 1 ? 0
                     : BAD("%s: mass %.9g is less than half a particle of radius %.9g at "
                           "density %.9g",
                           at->where, mass, r, at->job->asked->common.density);
}

static int read_whole(const reader *at, const char *word, double *count)
{
  uint64_t value = 0;
  char where[4400];
  snprintf(where, sizeof where, "%s: count", at->where);
  const int code = number_whole(where, word, 1, UINT32_MAX, &value);
  *count = (double)value;
  return code;
}

static int read_field(const reader *at, const char *word, column kind, double *value)
{
  char where[4400];
  if (kind == COUNT)
    return read_whole(at, word, value);
  snprintf(where, sizeof where, "%s: %s", at->where, names[kind]);
  return number_positive(where, word, value);
}

static void add_class(front_list *list, double r, double count)
{
  list->classes =
      program_take_more(list->classes, list->count + 1, sizeof *list->classes);
  list->classes[list->count++] = (packing_front_class){r, (size_t)count};
}

static int read_row(reader *at, char **words, size_t count)
{
  double value[COLUMNS] = {0};
  int code = count == 2 ? 0 : BAD("%s: %zu fields instead of 2", at->where, count);
  for (size_t i = 0; i < 2 && !code; i++)
    code = read_field(at, words[i], at->columns[i], &value[at->columns[i]]);
  if (code)
    return code;
  const double r = value[RADIUS] > 0 ? value[RADIUS] : value[DIAMETER] / 2;
  if (value[MASS] > 0)
    code = count_of_mass(at, value[MASS], r, &value[COUNT]);
  if (!code && value[COUNT] > (double)UINT32_MAX)
    code = BAD("%s: %.9g particles are more than can be", at->where, value[COUNT]);
  if (!code)
    add_class(&at->job->list, r, value[COUNT]);
  return code;
}

static int read_line(reader *at, char *line)
{
  size_t count = 0, length = strcspn(line, "#");
  while (length > 0 && strchr(" \t\r", line[length - 1]))
    length--;
  line[length] = '\0';
  if (length == 0)
    return 0;
  snprintf(at->where, sizeof at->where, "--list: %s: line %zu", at->job->asked->list,
           at->line);
  char **words = spec_split(line, ',', &count);
  const int code =
      at->headed ? read_row(at, words, count) : read_header(at, words, count);
  free(words);
  return code;
}

int front_list_read(front_job *job)
{
  reader at = {.job = job};
  const char *path = job->asked->list;
  char *text = NULL;
  size_t length = 0;
  int code = text_file_read(job->context, &job->input, "--list", path, &text, &length);
  if (!code && strlen(text) < length)
    code = BAD("--list: %s: is no text", path);
  for (char *line = text; line && !code;) {
    char *end = strchr(line, '\n');
    if (end)
      *end++ = '\0';
    at.line++;
    code = read_line(&at, line);
    line = end;
  }
  free(text);
  if (!code && job->list.count == 0)
    code = BAD("--list: %s: no particles in it", path);
  if (!code)
    job->list.left = program_take(job->list.count, sizeof *job->list.left);
  return code;
}
