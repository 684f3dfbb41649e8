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
  bar->unit = "";
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

static void format_rate(char *text, size_t size, double rate, const char *unit)
{
  const char *thousands = rate < 1e4 ? "" : rate < 1e7 ? "k" : "M";
  const double shown = rate < 1e4 ? rate : rate < 1e7 ? rate / 1e3 : rate / 1e6;
  snprintf(text, size, "%.0f%s%s%s/s", shown, thousands, *unit ? " " : "", unit);
}

void progress_show(progress *bar, double share, size_t count)
{
  progress_show_work(bar, share, count, (double)count);
}

void progress_show_work(progress *bar, double share, size_t count, double work)
{
  const double now = program_seconds(), spent = now - bar->start;
  char left[32] = "?", rate[64], cells[WIDTH + 1];
  if (dark || now - bar->shown < PERIOD)
    return;
  bar->shown = now;
  share = share > 1 ? 1 : share > 0 ? share : 0;
  const size_t full = (size_t)(share * WIDTH);
  memset(cells, '.', WIDTH);
  memset(cells, '#', full);
  cells[WIDTH] = '\0';
  format_rate(rate, sizeof rate, work / spent, bar->unit);
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
