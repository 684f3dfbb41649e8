/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "progress.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "program.h"

enum { WIDTH = 28 };
static const double PERIOD = 0.1;

static int drawn;
static int dark = 1;

void progress_start(progress *bar, const char *label, int enabled)
{
  dark = !enabled || !isatty(STDERR_FILENO);
  bar->label = label;
  bar->start = bar->shown = program_seconds();
}

static void format_time(char *text, size_t size, double seconds)
{
  const unsigned long whole = (unsigned long)(seconds + 0.5);
  if (whole < 3600)
    snprintf(text, size, "%lu:%02lu", whole / 60, whole % 60);
  else
    snprintf(text, size, "%lu:%02lu:%02lu", whole / 3600, whole / 60 % 60, whole % 60);
}

static void format_rate(char *text, size_t size, double rate)
{
  if (rate < 1e4)
    snprintf(text, size, "%.0f/s", rate);
  else if (rate < 1e7)
    snprintf(text, size, "%.0fk/s", rate / 1e3);
  else
    snprintf(text, size, "%.0fM/s", rate / 1e6);
}

void progress_show(progress *bar, double share, size_t count)
{
  const double now = program_seconds(), spent = now - bar->start;
  char left[32] = "?", rate[32], cells[WIDTH + 1];
  if (dark || now - bar->shown < PERIOD)
    return;
  bar->shown = now;
  share = share > 1 ? 1 : share > 0 ? share : 0;
  const size_t full = (size_t)(share * WIDTH);
  memset(cells, '.', WIDTH);
  memset(cells, '#', full);
  cells[WIDTH] = '\0';
  format_rate(rate, sizeof rate, (double)count / spent);
  if (share > 0)
    format_time(left, sizeof left, spent * (1 - share) / share);
  fprintf(stderr, "\r\033[K%s [%s] %5.1f %%  %zu  %s  %s left", bar->label, cells,
          100 * share, count, rate, left);
  fflush(stderr);
  drawn = 1;
}

void progress_clear(void)
{
  if (!drawn)
    return;
  fputs("\r\033[K", stderr);
  fflush(stderr);
  drawn = 0;
}
