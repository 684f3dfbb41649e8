/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_IO_INTERNAL_H
#define PACKING_IO_INTERNAL_H

/* What the formats share: the descriptor, checked views, a buffered writer, a reader of lines,
 * a reader of tables. A format is one file (or one with a reader beside it) that leans on
 * these and stands as one line in the table of formats.c. */

#include "base_internal.h"
#include "decimal_internal.h"
#include <packing/io.h>

/* A file format. */
typedef struct packing_i_format {
  const char *name; /* as in --out NAME:FILE */
  const char
      *extensions;       /* with the dot, separated by blanks; "" where none is its own */
  const char *reference; /* who defines it, where */
  const char *holds;     /* what of a pack is in it */
} packing_i_format;

extern const packing_i_format packing_i_format_csv;
extern const packing_i_format packing_i_format_vtp;
extern const packing_i_format packing_i_format_lammps;
extern const packing_i_format packing_i_format_yade;
extern const packing_i_format packing_i_format_xyz;
extern const packing_i_format packing_i_format_curve;
extern const packing_i_format packing_i_format_sample;
extern const packing_i_format packing_i_format_polygon;

/* All of them, NULL at the end. */
extern const packing_i_format *const packing_i_formats[];

/* Checked views (io_view.c). dim 3 needs z, dim 2 needs every z to be 0, dim 0 takes what
 * there is. Numbers must be finite, radii positive, doubles aligned. */
packing_status packing_i_io_view(packing_context *context, const packing_view *from,
                                 int dim, packing_view *to);
int packing_i_view_has_velocity(const packing_view *view);
int packing_i_view_has_spin(const packing_view *view);
int packing_i_view_has_orientation(const packing_view *view);
/* An entry of a double column, 0 where it is absent. */
double packing_i_view_number(const packing_column *column, size_t i);
/* The id of particle i: index + 1 where the view has none. */
int64_t packing_i_view_id(const packing_view *view, size_t i);
/* An entry of an int32_t column, `absent` where there is none. */
int32_t packing_i_view_int(const packing_column *column, size_t i, int32_t absent);
double packing_i_view_largest_r(const packing_view *view);
/* The box around all particles, of which there is one at least. */
packing_bounds packing_i_io_around(const packing_view *view);
int packing_i_io_box_unset(const packing_bounds *box); /* all zeros */
/* The box of a cell: `given` when it is not all zeros, else around the particles. A flat
 * one is one largest diameter thick around z = 0. Refuses what is empty or not finite. */
packing_status packing_i_io_box(packing_context *context, const packing_view *view,
                                const packing_bounds *given, int flat,
                                packing_bounds *box);

/* Bonds join different particles of the view (write_bonds.c). */
packing_status packing_i_check_bonds(packing_context *context, size_t count,
                                     const packing_bond *bonds, size_t bond_count);
/* Types of bonds are 1 and above; the largest one, at least 1. */
packing_status packing_i_bond_types(packing_context *context, const packing_bond *bonds,
                                    size_t bond_count, int32_t *largest);
/* The group of each particle: those joined by bonds have one number, the groups are 1, 2, ...
 * by their first particle, a particle without a bond has 0. `groups` has `count` entries and is
 * the caller's to free. */
packing_status packing_i_bond_groups(packing_context *context, size_t count,
                                     const packing_bond *bonds, size_t bond_count,
                                     uint32_t **groups);
/* Ids are different and in lowest .. 2^31 - 1; at most 2^31 - 1 particles (write_ids.c). Those
 * of a view without ids are `lowest` and up. */
packing_status packing_i_check_ids(packing_context *context, const packing_view *view,
                                   int64_t lowest);
int64_t packing_i_id_from(const packing_view *view, size_t i, int64_t lowest);
/* Types are 1 and above; the largest one, at least 1 (write_ids.c). */
packing_status packing_i_check_types(packing_context *context, const packing_view *view,
                                     int32_t *largest);
/* Centres are inside, not on the upper faces. */
packing_status packing_i_check_inside(packing_context *context, const packing_view *view,
                                      const packing_bounds *box);

/* Passes on the failure of a stream; says so in the context unless the stream is that of a
 * file, which has said more. */
packing_status packing_i_stream_failed(packing_context *context,
                                       const packing_stream *stream,
                                       const packing_i_format *format,
                                       packing_status status);
/* What a stream that claims too much came to. */
packing_status packing_i_stream_overran(packing_context *context);
/* Whether a stream is one that inflates, and so has noted its failures (gunzip.c). */
int packing_i_is_gunzip(const packing_stream *stream);
/* Whether a stream belongs to a file whose failures are noted in `context` (file.c). */
int packing_i_stream_reports_to(const packing_stream *stream,
                                const packing_context *context);

/* The buffered writer (text_writer.c). The first failure stays, what follows is dropped. */
typedef struct packing_i_writer {
  packing_context *context;
  const packing_stream *stream;
  const char *name; /* of the format, for messages */
  packing_status status;
  char *buffer;
  size_t used, capacity;
} packing_i_writer;

packing_status packing_i_writer_begin(packing_i_writer *writer, packing_context *context,
                                      const packing_i_format *format,
                                      const packing_stream *stream);
/* The same for a format that has no descriptor of this kind. */
packing_status packing_i_writer_open(packing_i_writer *writer, packing_context *context,
                                     const char *name, const packing_stream *stream);
/* Flushes, frees and returns the first failure. */
packing_status packing_i_writer_end(packing_i_writer *writer);
void packing_i_put_bytes(packing_i_writer *writer, const void *data, size_t count);
void packing_i_put_text(packing_i_writer *writer, const char *text);
void packing_i_put_char(packing_i_writer *writer, char c);
void packing_i_put_double(packing_i_writer *writer, double v);
void packing_i_put_int(packing_i_writer *writer, int64_t v);
/* Each number behind a separator. */
void packing_i_put_doubles(packing_i_writer *writer, char separator, const double *v,
                           size_t count);
/* Room for up to `count` bytes, at most 64 KiB; tell with packing_i_wrote() how many they
 * became. */
char *packing_i_room(packing_i_writer *writer, size_t count);
void packing_i_wrote(packing_i_writer *writer, size_t count);

/* The reader of lines (line_reader.c). */
enum { PACKING_I_LINE_LENGTH = 8192 /* longest line read, in bytes, without its end */ };

typedef struct packing_i_lines {
  packing_context *context;
  const packing_stream *stream;
  const packing_i_format *format;
  size_t number; /* of the line last returned, from 1 */
  char *buffer;
  size_t begin, seen, end; /* unread text; what of it holds no end of line; its end */
  int ended;
  int skip_blank; /* blank lines are passed over like comments */
  int keep_comments;
} packing_i_lines;

packing_status packing_i_lines_begin(packing_i_lines *lines, packing_context *context,
                                     const packing_i_format *format,
                                     const packing_stream *stream);
void packing_i_lines_end(packing_i_lines *lines);
/* The next line that is no comment: from *at to *end, where a newline stands; LF or CRLF ends a
 * line, and the end of the stream. *at NULL: no more lines. A UTF-8 byte order mark before
 * the first line is skipped. */
packing_status packing_i_lines_next(packing_i_lines *lines, const char **at,
                                    const char **end);
/* Shows up to `count` unread bytes (at most 64 KiB less one), or more; fewer only at the end. */
packing_status packing_i_lines_peek(packing_i_lines *lines, size_t count, const char **at,
                                    size_t *seen);
/* Takes `count` bytes where no text is; fewer only at the end. */
packing_status packing_i_lines_bytes(packing_i_lines *lines, void *out, size_t count,
                                     size_t *taken);
/* Notes "line N: ..." as PACKING_ERR_FORMAT, or another status. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
packing_status
packing_i_lines_fail(const packing_i_lines *lines, packing_status status,
                     const char *format, ...);
/* Refuses a length that the user's scale takes out of range. */
packing_status packing_i_check_scaled(const packing_i_lines *lines, const char *name,
                                      double v, double scaled);
/* A piece of a file for a message: printable, in quotes, cut after 40 bytes. */
enum { PACKING_I_QUOTE_SIZE = 48 };
const char *packing_i_quote(const char *at, const char *end, char *out);

/* What is wrong with a number from `at` to `end`, which came to `found`. */
packing_status packing_i_number_fail(const packing_i_lines *lines, const char *name,
                                     const char *at, const char *end,
                                     packing_i_number found, const char *wanted);

/* The reader of tables (table_reader.c): comma-separated columns of numbers, blanks around
 * them ignored. */
typedef enum packing_i_table_kind {
  PACKING_I_TABLE_REAL,
  PACKING_I_TABLE_INT64,
  PACKING_I_TABLE_INT32
} packing_i_table_kind;

typedef union packing_i_table_cell {
  double real;
  int64_t int64;
  int32_t int32;
} packing_i_table_cell;

typedef struct packing_i_table_spec {
  const char *name;
  packing_i_table_kind kind;
} packing_i_table_spec;

enum { PACKING_I_TABLE_COLUMNS = 32, PACKING_I_TABLE_BLANK = 2 };

typedef struct packing_i_table {
  packing_i_lines lines;
  const packing_i_table_spec *specs; /* the columns that may stand in a table */
  unsigned spec_count;               /* at most PACKING_I_TABLE_COLUMNS */
  unsigned columns;                  /* that stand in this one */
  uint8_t spec_of[PACKING_I_TABLE_COLUMNS];
  uint32_t present; /* bit s: column of spec s */
  int takes_blanks; /* a blank line is a row of its own: *got is PACKING_I_TABLE_BLANK */
} packing_i_table;

packing_status packing_i_table_begin(packing_i_table *table, packing_context *context,
                                     const packing_i_format *format,
                                     const packing_stream *stream,
                                     const packing_i_table_spec *specs,
                                     unsigned spec_count);
void packing_i_table_end(packing_i_table *table);
packing_status packing_i_table_header(packing_i_table *table);
/* Which column of the file a spec is. */
unsigned packing_i_table_column(const packing_i_table *table, unsigned spec);
/* Reads a row: column c goes to cells[c * stride]; *got 0 at the end. */
packing_status packing_i_table_row(packing_i_table *table, packing_i_table_cell *cells,
                                   size_t stride, int *got);

#endif
