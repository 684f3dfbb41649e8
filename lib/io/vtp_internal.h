/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_VTP_INTERNAL_H
#define PACKING_VTP_INTERNAL_H

/* The arrays of a VTK file, and their compressed form. */

#include "io_internal.h"

enum { PACKING_I_VTP_BLOCK = 1 << 14 /* tuples gathered, or compressed, at once */ };

typedef enum packing_i_vtp_kind {
  PACKING_I_VTP_FLOAT64, /* from double columns, 0 where one is absent */
  PACKING_I_VTP_INT64,   /* from the id column */
  PACKING_I_VTP_INT32,   /* from an int32_t column */
  PACKING_I_VTP_INDEX    /* first, first + 1, ... */
} packing_i_vtp_kind;

/* One DataArray. */
typedef struct packing_i_vtp_array {
  const char *name;
  packing_i_vtp_kind kind;
  unsigned components;
  packing_column columns[4];
  int64_t first; /* of an index */
  size_t tuples;
} packing_i_vtp_array;

size_t packing_i_vtp_tuple_size(const packing_i_vtp_array *array);
/* Writes tuples first .. first + count - 1 as they stand in the file. */
void packing_i_vtp_gather(const packing_i_vtp_array *array, size_t first, size_t count,
                          void *out);

/* Writes arrays as zlib blocks. The sizes of an array's blocks stand before the first, and its
 * place stands in the XML before all: so arrays are compressed once to be measured, all of
 * them, and once more to be written, in the same order; memory is bounded. */
typedef struct packing_i_deflater packing_i_deflater;
struct packing_i_deflater {
  /* The bytes that an array takes in the file, its header included. */
  packing_status (*measure)(packing_i_deflater *deflater,
                            const packing_i_vtp_array *array, uint64_t *bytes);
  packing_status (*write)(packing_i_deflater *deflater, const packing_i_vtp_array *array,
                          packing_i_writer *writer);
  void (*destroy)(packing_i_deflater *deflater);
};

/* For up to `arrays` arrays of `tuples` tuples each. */
packing_status packing_i_deflater_create(packing_context *context, int level,
                                         size_t arrays, size_t tuples,
                                         packing_i_deflater **deflater);

#endif
