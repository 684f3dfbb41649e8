/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_OUTPUT_H
#define EXAMPLES_OUTPUT_H

/* --out [FORMAT:]FILE and its like: which writer, whether the place can be written, and all
 * files of a run appearing together or not at all. */

#include "pack.h"
#include "spec.h"

/* Writes a pack, or all packs of a run, somewhere. */
typedef packing_status (*pack_writer)(const pack *p, const packing_stream *stream);
typedef packing_status (*sheet_writer)(const pack *packs, size_t count,
                                       const packing_stream *stream);

typedef struct output {
  const char *option; /* for messages: "--out" */
  const char *text;   /* as typed */
  char *path;
  char *real; /* one name for the place, however it is typed; NULL: not yet known */
  const char *format; /* of the library; NULL: none of its, then: */
  pack_writer write;
  sheet_writer write_all; /* in place of `write` */
  int shared;             /* one for all packs, as the report is */
  size_t pack;            /* which one it shows */
  int in_place;           /* a device or a pipe: written as it stands */
  packing_file *file;     /* while being written */
} output;

typedef struct outputs {
  output *items;
  size_t count;
} outputs;

/* Adds an output whose format comes from `FORMAT:` or the extension. Functions return 0, or
 * an exit code after one line on standard error. */
int outputs_add_pack(outputs *all, const char *option, const char *text);

/* Adds a file of a program's own making. `option` and `text` say what was typed. */
output *outputs_add(outputs *all, const char *option, const char *text, const char *path);

/* Adds the plot of sizes, by extension .png or .svg. */
int outputs_add_sizes(outputs *all, const char *option, const char *path);

/* Adds the report. */
int outputs_add_report(outputs *all, const char *option, const char *path);

/* Adds the picture of all packs, by extension .png or .svg. */
int outputs_add_sheet(outputs *all, const char *option, const char *path);

/* Gives each pack files of its own, with its number (and that of its set, where there are
 * several) before the extension: a.csv becomes a-1.csv, a-2.csv ... or a-1-1.csv ... A single
 * pack keeps the names as they are. */
int outputs_number(outputs *all, size_t sets, size_t packs);

/* Before the work: every place can be written, none is named twice or is an input, and what a
 * deck loads is written beside it. */
int outputs_check(const outputs *all, packing_context *context,
                  const input_files *inputs);

/* After the work: writes all `packs` (as many as were numbered) beside their places, sends `standard_output` (may be NULL) to
 * standard output, and lets the files appear. On failure none does. */
int outputs_write(outputs *all, const pack *packs, size_t count,
                  const char *standard_output);

/* Of one output, for these: whether its format has all it needs, and writing it. */
int output_check_format(const outputs *all, const output *out);
packing_status output_write_format(const outputs *all, const output *out, const pack *p,
                                   const packing_stream *stream);

void outputs_free(outputs *all);

/* What --help says of --out. */
extern const char output_help[];

#endif
