/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_READ_INTERNAL_H
#define PACKING_READ_INTERNAL_H

/* What the readers of packs share. A reader is one file that leans on these and stands as one
 * line in the table of read_pack.c. It takes rows one at a time, which go to the store in
 * batches, so nothing is set aside for what a file merely claims. */

#include "io_internal.h"
#include "particles/particles_internal.h"
#include <packing/readers.h>

typedef struct packing_i_reader packing_i_reader;

/* One particle on its way to the store. */
typedef struct packing_i_row {
  double x, y, z, r;
  double v[3], w[3], q[4];
  int64_t id;
  int32_t type, component;
} packing_i_row;

/* One reading. */
typedef struct packing_i_read {
  packing_context *context;
  const packing_i_reader *reader;
  const packing_stream *stream;
  packing_particles *particles;
  packing_read_def def;
  packing_read_info info;
  packing_i_lines lines; /* of text */
  uint64_t byte;         /* of binary parts: what a failure names */
  packing_i_row *rows;   /* a batch */
  size_t used;
} packing_i_read;

enum { PACKING_I_READ_BATCH = 256 /* rows; 128 bytes each */ };

struct packing_i_reader {
  packing_i_format format;
  enum {
    PACKING_I_READS_LINES, /* the lines of packing_i_read; may be compressed */
    PACKING_I_READS_TABLE, /* lines of its own; may be compressed */
    PACKING_I_READS_BYTES
  } what;
  packing_status (*read)(packing_i_read *read);
};

extern const packing_i_reader packing_i_reader_csv;
extern const packing_i_reader packing_i_reader_vtp;
extern const packing_i_reader packing_i_reader_vtu;
extern const packing_i_reader packing_i_reader_lammps;
extern const packing_i_reader packing_i_reader_liggghts;
extern const packing_i_reader packing_i_reader_dump;
extern const packing_i_reader packing_i_reader_yade;
extern const packing_i_reader packing_i_reader_yade_pack;
extern const packing_i_reader packing_i_reader_geo;
extern const packing_i_reader packing_i_reader_xyz;
extern const packing_i_reader packing_i_reader_xyzd;

/* Notes "line N: ..." or "byte N: ...". */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
packing_status
packing_i_read_fail(const packing_i_read *read, packing_status status, const char *format,
                    ...);
#if defined(__clang_analyzer__)
#define packing_i_read_fail(read, status, ...) (status)
#endif

/* The row to fill next, all 0 but for an upright orientation. */
packing_i_row *packing_i_read_row(packing_i_read *read);
/* Takes that row over, checked. */
packing_status packing_i_read_take(packing_i_read *read);
/* Puts what was taken into the store. */
packing_status packing_i_read_flush(packing_i_read *read);
/* Drops all, for another frame. */
void packing_i_read_restart(packing_i_read *read);
packing_status packing_i_read_columns(packing_i_read *read, unsigned columns);
/* Whether frame `frame` is wanted; the last one is, as long as no other follows. */
int packing_i_read_wants(const packing_i_read *read, size_t frame);
/* A box as the file tells it, checked. */
packing_status packing_i_read_box(packing_i_read *read, const double lo[3],
                                  const double hi[3]);

/* Lines as words between blanks (read_words.c). */
typedef struct packing_i_words {
  const char *at, *end; /* at NULL: behind the last line */
} packing_i_words;

packing_status packing_i_read_line(packing_i_read *read, packing_i_words *words);
/* The same; the file must not end here. `what` is missing if it does. */
packing_status packing_i_read_needed(packing_i_read *read, const char *what,
                                     packing_i_words *words);
/* Cuts at a #. Returns what stands behind it, nothing where there is none. */
packing_i_words packing_i_words_cut(packing_i_words *words);
/* Whether there are no more. */
int packing_i_words_ended(packing_i_words *words);
unsigned packing_i_words_count(packing_i_words words);
/* Takes one; it is empty at the end. */
packing_i_words packing_i_words_take(packing_i_words *words);
/* Whether all that is left is these words, or begins with them: then they are taken. */
int packing_i_words_are(packing_i_words words, const char *these);
int packing_i_words_begin(packing_i_words *words, const char *these);
/* Whether one word is this text. */
int packing_i_word_is(packing_i_words word, const char *text);
/* Take a number. */
packing_status packing_i_words_double(const packing_i_read *read, packing_i_words *words,
                                      const char *name, double *v);
packing_status packing_i_words_int(const packing_i_read *read, packing_i_words *words,
                                   const char *name, int64_t least, int64_t most,
                                   int64_t *v);
packing_status packing_i_words_int32(const packing_i_read *read, packing_i_words *words,
                                     const char *name, int32_t least, int32_t most,
                                     int32_t *v);
/* `count` numbers of one name. */
packing_status packing_i_words_doubles(const packing_i_read *read, packing_i_words *words,
                                       const char *name, unsigned count, double *v);
/* Refuses what is left. */
packing_status packing_i_words_done(const packing_i_read *read, packing_i_words *words);

/* Which particle an id is (read_ids.c): sorted pairs, 16 bytes a particle, as much again while
 * they are sorted. An id that stands twice is refused. */
typedef struct packing_i_id_pair {
  int64_t id;
  size_t index;
} packing_i_id_pair;

typedef struct packing_i_ids {
  packing_i_id_pair *pairs;
  size_t count;
} packing_i_ids;

packing_status packing_i_ids_begin(packing_i_read *read, packing_i_ids *ids);
void packing_i_ids_end(packing_i_read *read, packing_i_ids *ids);
/* PACKING_NO_INDEX: nobody's. */
size_t packing_i_ids_find(const packing_i_ids *ids, int64_t id);
/* Orders particles and bonds by id. */
packing_status packing_i_read_sort(packing_i_read *read);

/* Bonds (bonds.c). */
struct packing_bonds {
  packing_context *context;
  packing_bond *list;
  size_t count, capacity;
};

packing_status packing_i_bonds_add(packing_bonds *bonds, const packing_bond *bond);
/* Takes the bond of two ids for the caller's list, or only counts it. */
packing_status packing_i_read_bond(packing_i_read *read, const packing_i_ids *ids,
                                   const int64_t ends[2], int32_t type);

/* A stream that inflates another where that begins as gzip does (gunzip.c). */
typedef struct packing_i_gunzip packing_i_gunzip;

packing_status packing_i_gunzip_create(packing_context *context,
                                       const packing_i_format *format,
                                       const packing_stream *stream,
                                       packing_i_gunzip **gunzip);
void packing_i_gunzip_destroy(packing_i_gunzip *gunzip);
const packing_stream *packing_i_gunzip_stream(packing_i_gunzip *gunzip);

#endif
