/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_MESH_FILE_INTERNAL_H
#define PACKING_MESH_FILE_INTERNAL_H

/* What the readers of meshes share: one reading, whose lists grow with what was read. */

#include "read_internal.h"
#include <packing/readers.h>

typedef struct packing_i_mesh_file {
  packing_i_read read; /* context, lines, byte */
  double *vertex;      /* three numbers of each */
  size_t vertices, vertex_room;
  uint32_t *triangle; /* three vertices of each */
  size_t triangles, triangle_room;
  int soup; /* three vertices after the other are a triangle */
} packing_i_mesh_file;

packing_status packing_i_mesh_file_vertex(packing_i_mesh_file *file, const double x[3]);
packing_status packing_i_mesh_file_triangle(packing_i_mesh_file *file,
                                            const uint32_t v[3]);
/* "byte N: ..." where the content is binary. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
packing_status
packing_i_mesh_file_fail(const packing_i_mesh_file *file, const char *format, ...);

/* Exactly `count` bytes, or a failure that says `what` is cut off. */
packing_status packing_i_mesh_file_bytes(packing_i_mesh_file *file, void *out,
                                         size_t count, const char *what);

packing_status packing_i_read_stl_text(packing_i_mesh_file *file);
packing_status packing_i_read_stl_binary(packing_i_mesh_file *file);
packing_status packing_i_read_obj(packing_i_mesh_file *file);
packing_status packing_i_read_ply(packing_i_mesh_file *file);

/* The header of a PLY file (read_ply_header.c). */
typedef enum packing_i_ply_type {
  PACKING_I_PLY_NONE,
  PACKING_I_PLY_INT8,
  PACKING_I_PLY_UINT8,
  PACKING_I_PLY_INT16,
  PACKING_I_PLY_UINT16,
  PACKING_I_PLY_INT32,
  PACKING_I_PLY_UINT32,
  PACKING_I_PLY_FLOAT,
  PACKING_I_PLY_DOUBLE
} packing_i_ply_type;

enum { PACKING_I_PLY_PROPERTIES = 256, PACKING_I_PLY_ELEMENTS = 32 };

typedef struct packing_i_ply_property {
  packing_i_ply_type count; /* of lists; else NONE */
  packing_i_ply_type type;
  int axis;    /* of a vertex: 0, 1, 2 for x, y, z; else -1 */
  int corners; /* of a face: its vertices */
} packing_i_ply_property;

typedef struct packing_i_ply_element {
  enum { PACKING_I_PLY_OTHER, PACKING_I_PLY_VERTEX, PACKING_I_PLY_FACE } kind;
  uint64_t count;
  unsigned first, properties; /* in packing_i_ply.property */
} packing_i_ply_element;

typedef struct packing_i_ply {
  enum { PACKING_I_PLY_ASCII, PACKING_I_PLY_LITTLE, PACKING_I_PLY_BIG } format;
  unsigned elements, properties;
  packing_i_ply_element element[PACKING_I_PLY_ELEMENTS];
  packing_i_ply_property property[PACKING_I_PLY_PROPERTIES];
} packing_i_ply;

packing_status packing_i_read_ply_header(packing_i_mesh_file *file, packing_i_ply *ply);

#endif
