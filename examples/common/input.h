/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_INPUT_H
#define EXAMPLES_INPUT_H

/* --in [FORMAT:]FILE: a pack from anyone, and the container that its file tells. Functions
 * return 0, or an exit code after one line on standard error. */

#include "options.h"

typedef struct input {
  const char *text;     /* as typed; NULL: not given */
  const char *path;     /* the file's name in it */
  char format[16];      /* one that the library reads */
  const char *radius;   /* --radius-array; NULL: not given */
  const char *diameter; /* --diameter-array; NULL: not given */
  int64_t frame;        /* PACKING_FRAME_LAST or from 0 */
  int sort;             /* 1: by id */
  int dim;              /* 0: as the file says */
  packing_particles *particles;
  packing_bonds *bonds;
  packing_read_info info;
  size_t note;       /* which of the files it is */
  char *domain_note; /* what a table says of its container; NULL: nothing */
  int notes_hidden;  /* 1: the table is compressed, so what it says was not seen */
} input;

void input_init(input *in);
void input_free(input *in);

/* --in, --frame, --sort and what else says how to read; its input is an `input`. */
extern const struct argp input_argp;

/* Whether there is something to read. */
int input_check(const input *in);

/* Notes the file before it is read, so that no output takes its place. */
void input_announce(input *in, input_files *files);

/* Reads it; the note gets its hash. */
int input_read(input *in, packing_context *context, input_files *files);

/* The container: `asked`, or else what the file tells, or else none. The text of `spec` is `*text`;
 * free it. */
int input_domain(const input *in, const char *asked, domain_spec *spec, char **text);

/* After the work: says what the file told of the container, where it was not asked. */
void input_tell_domain(const input *in, const char *asked, const char *text);

/* The SPEC of a box; free it. */
char *input_box_text(int dim, const packing_bounds *box, unsigned periodic);

/* Adds how it was read to the options of a report. */
void input_report(cJSON *all, const input *in);

#endif
