/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_PROGRESS_H
#define EXAMPLES_PROGRESS_H

/* One line on standard error with a bar, the rate and the time left; nothing unless that is
 * a terminal. */

#include <stddef.h>

typedef struct progress {
  const char *label; /* what is being done; may change */
  const char *unit;  /* of the rate, as in "particle-steps"; "" after progress_start() */
  double start;      /* [s] */
  double shown;      /* when last drawn [s] */
} progress;

/* `enabled` 0 keeps it dark. */
void progress_start(progress *bar, const char *label, int enabled);

/* `share` 0 to 1 of the work; `count` things done. Draws ten times a second at most. */
void progress_show(progress *bar, double share, size_t count);

/* The same, the rate being that of `work` since the start. */
void progress_show_work(progress *bar, double share, size_t count, double work);

/* Wipes the line, if one is drawn. */
void progress_clear(void);

#endif
