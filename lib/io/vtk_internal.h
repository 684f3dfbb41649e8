/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_VTK_INTERNAL_H
#define PACKING_VTK_INTERNAL_H

/* What VTK's XML files share: arrays, their compressed form, the file around them. */

#include "io_internal.h"

enum {
  PACKING_I_VTK_BLOCK = 1 << 14, /* tuples gathered, or compressed, at once */
  PACKING_I_VTK_ARRAYS = 13      /* eight of points, Points, cells of two kinds, types */
};

typedef enum packing_i_vtk_kind {
  PACKING_I_VTK_FLOAT64,      /* from double columns, 0 where one is absent */
  PACKING_I_VTK_INT64,        /* from the id column */
  PACKING_I_VTK_INT32,        /* from an int32_t column */
  PACKING_I_VTK_CONNECTIVITY, /* the points of cells, one after the other */
  PACKING_I_VTK_OFFSETS,      /* where in them each cell ends */
  PACKING_I_VTK_CELL_TYPES,   /* VTK_VERTEX or VTK_LINE */
  PACKING_I_VTK_BOND_TYPES    /* of bonds, 0 for a vertex */
} packing_i_vtk_kind;

/* Cells: points 0 .. vertices - 1, then bonds. */
typedef struct packing_i_vtk_cells {
  size_t vertices;
  const packing_bond *bonds;
  size_t bond_count;
} packing_i_vtk_cells;

/* One DataArray. */
typedef struct packing_i_vtk_array {
  const char *name;
  packing_i_vtk_kind kind;
  unsigned components;
  packing_column columns[4];
  packing_i_vtk_cells cells;
  size_t tuples;
} packing_i_vtk_array;

size_t packing_i_vtk_tuple_size(const packing_i_vtk_array *array);
/* Writes tuples first .. first + count - 1 as they stand in the file. */
void packing_i_vtk_gather(const packing_i_vtk_array *array, size_t first, size_t count,
                          void *out);

/* The arrays of a file: point data first, then Points, then what the dialect adds. */
typedef struct packing_i_vtk_file {
  packing_i_vtk_array arrays[PACKING_I_VTK_ARRAYS];
  uint64_t bytes[PACKING_I_VTK_ARRAYS]; /* in the file, header included */
  size_t count;
  size_t points_at; /* index of Points */
} packing_i_vtk_file;

void packing_i_vtk_add_cells(packing_i_vtk_file *file, const char *name,
                             packing_i_vtk_kind kind, packing_i_vtk_cells cells);
/* The XML of arrays begin .. end - 1 between `open` and `close`. */
void packing_i_vtk_put_arrays(packing_i_writer *w, const packing_i_vtk_file *file,
                              const char *open, size_t begin, size_t end,
                              const char *close);

/* What differs between PolyData and UnstructuredGrid. */
typedef struct packing_i_vtk_dialect {
  const char *name;    /* for messages */
  const char *element; /* of the data set */
  void (*lay_out)(packing_i_vtk_file *file, packing_i_vtk_cells cells);
  void (*put_counts)(packing_i_writer *w, packing_i_vtk_cells cells);
  void (*put_cells)(packing_i_writer *w, const packing_i_vtk_file *file);
} packing_i_vtk_dialect;

/* Writes a checked view and checked bonds. */
packing_status packing_i_vtk_write(packing_context *context,
                                   const packing_i_vtk_dialect *dialect, int compression,
                                   const packing_view *view, const packing_bond *bonds,
                                   size_t bond_count, const packing_stream *stream);

/* Writes arrays as zlib blocks. The sizes of an array's blocks stand before the first, and its
 * place stands in the XML before all: so arrays are compressed once to be measured, all of
 * them, and once more to be written, in the same order; memory is bounded. */
typedef struct packing_i_deflater packing_i_deflater;
struct packing_i_deflater {
  /* The bytes that an array takes in the file, its header included. */
  packing_status (*measure)(packing_i_deflater *deflater,
                            const packing_i_vtk_array *array, uint64_t *bytes);
  packing_status (*write)(packing_i_deflater *deflater, const packing_i_vtk_array *array,
                          packing_i_writer *writer);
  void (*destroy)(packing_i_deflater *deflater);
};

/* For up to `arrays` arrays of `tuples` tuples each. */
packing_status packing_i_deflater_create(packing_context *context, int level,
                                         size_t arrays, size_t tuples,
                                         packing_i_deflater **deflater);

#endif
