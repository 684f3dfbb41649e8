/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_TABLE_H
#define EXAMPLES_TABLE_H

/* Lines of text into a packing_stream. */

#include <packing/packing.h>

typedef struct table {
  const packing_stream *stream;
  packing_status status; /* the first failure; nothing is written after it */
  size_t used;
  char buffer[16384];
} table;

void table_open(table *t, const packing_stream *stream);

/* printf; numbers go with %.17g. A line has 1000 bytes at most. */
__attribute__((format(printf, 2, 3))) void table_print(table *t, const char *format, ...);

/* Writes what is left; the status of all. */
packing_status table_close(table *t);

#endif
