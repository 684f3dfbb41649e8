/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns of numbers, each a set. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "../common/text_file.h"
#include "compare.h"

enum { MOST_LINE = 8192 };

typedef struct columns {
  compare_job *job;
  const char *option, *path;
  size_t line;  /* at hand, from 1 */
  size_t first; /* index of the first column's set */
  size_t count; /* 0: not yet known */
} columns;

static int bad(const columns *c, const char *why)
{
  return program_fail(PROGRAM_BAD_INPUT, "%s: %s: line %zu: %s", c->option, c->path,
                      c->line, why);
}

/* Cuts a line into words, in place: at commas where it has some, else at blanks. */
static size_t cut(char *line, char **words, size_t most)
{
  const char *apart = strchr(line, ',') ? "," : " \t";
  size_t count = 0;
  char *rest = line;
  while (rest && count < most) {
    char *word = strsep(&rest, apart);
    while (isspace((unsigned char)*word))
      word++;
    char *end = word + strlen(word);
    while (end > word && isspace((unsigned char)end[-1]))
      *--end = '\0';
    if (*word || *apart == ',')
      words[count++] = word;
  }
  return rest ? most + 1 : count;
}

static int is_number(const char *word)
{
  char *end = NULL;
  strtod(word, &end);
  return end > word;
}

/* The first line makes the sets, named by it if its first word is no number. */
static void start(columns *c, char *const *words, size_t count, int named)
{
  c->count = count;
  c->first = c->job->set_count;
  for (size_t k = 0; k < count; k++) {
    char name[32];
    snprintf(name, sizeof name, "%zu", c->first + k + 1);
    compare_new_set(c->job, named ? words[k] : name)->what = "values";
  }
}

static int add_row(columns *c, char *const *words)
{
  for (size_t k = 0; k < c->count; k++) {
    double v = 0;
    char where[4300];
    snprintf(where, sizeof where, "%s: %s: line %zu", c->option, c->path, c->line);
    const int code = number_real(where, words[k], &v);
    if (code)
      return code;
    compare_add_value(&c->job->sets[c->first + k], v);
  }
  return 0;
}

static int take_line(columns *c, char *line)
{
  char *words[COMPARE_MOST_SETS];
  line[strcspn(line, "#")] = '\0';
  if (line[strspn(line, " \t\r")] == '\0')
    return 0;
  const size_t count = cut(line, words, COMPARE_MOST_SETS);
  if (count > COMPARE_MOST_SETS)
    return bad(c, "more than 100 columns");
  if (c->count == 0) {
    const int named = !is_number(words[0]);
    start(c, words, count, named);
    if (named)
      return 0;
  }
  if (count != c->count)
    return program_fail(PROGRAM_BAD_INPUT, "%s: %s: line %zu: %zu columns, not %zu",
                        c->option, c->path, c->line, count, c->count);
  return add_row(c, words);
}

int compare_add_columns(compare_job *job, const char *option, const char *path)
{
  columns c = {job, option, path, 0, 0, 0};
  char *text = NULL;
  size_t length = 0;
  int code = text_file_read(job->context, &job->input, option, path, &text, &length);
  if (!code && memchr(text, '\0', length))
    code = program_fail(PROGRAM_BAD_INPUT, "%s: %s is no text", option, path);
  for (char *rest = text; !code && rest;) {
    char *line = strsep(&rest, "\n");
    c.line++;
    code = strlen(line) > MOST_LINE ? bad(&c, "longer than 8192 bytes")
                                    : take_line(&c, line);
  }
  if (!code && (c.count == 0 || job->sets[c.first].count == 0))
    code = program_fail(PROGRAM_BAD_INPUT, "%s: %s has no numbers", option, path);
  free(text);
  return code;
}
