/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_READ_VTK_INTERNAL_H
#define PACKING_READ_VTK_INTERNAL_H

/* VTK's XML files in memory: tags, the arrays that they tell of, their values. */

#include "read_internal.h"

/* Tags (read_vtk_xml.c): elements and attributes, comments and processing instructions passed
 * over. No entities, no document types: VTK writes none where they would matter. */
enum { PACKING_I_XML_DEPTH = 16 };

typedef enum packing_i_xml_event {
  PACKING_I_XML_START,
  PACKING_I_XML_END, /* also behind the start of an element <LIKE/> */
  PACKING_I_XML_LAST /* the text has ended */
} packing_i_xml_event;

typedef struct packing_i_xml {
  packing_i_read *read;
  const char *first, *at, *end; /* a zero byte stands at `end` */
  packing_i_words
      names[PACKING_I_XML_DEPTH]; /* of the open elements; last: the one of the event */
  unsigned depth;
  packing_i_words attributes; /* of the start tag */
  int empty;                  /* the start tag was <LIKE/> */
} packing_i_xml;

/* *event: the last one, PACKING_I_XML_START at first; then the next. */
packing_status packing_i_xml_next(packing_i_xml *xml, packing_i_xml_event *event);
/* Whether the innermost open element, or the `up`-th around it, is `name`. */
int packing_i_xml_is(const packing_i_xml *xml, unsigned up, const char *name);
/* An attribute of the start tag; at NULL where it is absent. */
packing_i_words packing_i_xml_attribute(const packing_i_xml *xml, const char *name);
/* One that is a whole number; `absent` where it is absent. */
packing_status packing_i_xml_count(const packing_i_xml *xml, const char *name,
                                   uint64_t absent, uint64_t *v);

/* How numbers stand in the file. */
typedef enum packing_i_read_vtk_kind {
  PACKING_I_READ_VTK_INT8,
  PACKING_I_READ_VTK_UINT8,
  PACKING_I_READ_VTK_INT16,
  PACKING_I_READ_VTK_UINT16,
  PACKING_I_READ_VTK_INT32,
  PACKING_I_READ_VTK_UINT32,
  PACKING_I_READ_VTK_INT64,
  PACKING_I_READ_VTK_UINT64,
  PACKING_I_READ_VTK_FLOAT32,
  PACKING_I_READ_VTK_FLOAT64,
  PACKING_I_READ_VTK_KINDS
} packing_i_read_vtk_kind;

typedef enum packing_i_read_vtk_form {
  PACKING_I_READ_VTK_ASCII,
  PACKING_I_READ_VTK_BINARY, /* base64, in the element */
  PACKING_I_READ_VTK_APPENDED
} packing_i_read_vtk_form;

/* What the file's first tag and its appended data say. */
typedef struct packing_i_read_vtk_file {
  packing_i_read *read;
  const unsigned char *data; /* with a zero byte behind */
  size_t size;
  int big_endian, wide_header, compressed;
  const unsigned char *appended; /* NULL: none */
  size_t appended_size;
  int appended_base64;
} packing_i_read_vtk_file;

/* One DataArray. */
typedef struct packing_i_read_vtk_array {
  const char *tag; /* where its tag begins; NULL: no such array */
  packing_i_read_vtk_kind kind;
  packing_i_read_vtk_form form;
  uint64_t components;
  uint64_t offset;         /* of appended data */
  packing_i_words content; /* of the element */
} packing_i_read_vtk_array;

/* Its values (read_vtk_data.c), in the file's own bytes or in bytes held. */
typedef struct packing_i_read_vtk_values {
  const unsigned char *bytes;
  unsigned char *held; /* to free, or NULL */
  size_t appended;     /* how many appended bytes they took */
  packing_i_read_vtk_kind kind;
  int big_endian;
} packing_i_read_vtk_values;

packing_status packing_i_read_vtk_decode(const packing_i_read_vtk_file *file,
                                         const packing_i_read_vtk_array *array,
                                         uint64_t tuples,
                                         packing_i_read_vtk_values *values);
void packing_i_read_vtk_release(const packing_i_read_vtk_file *file,
                                packing_i_read_vtk_values *values);
double packing_i_read_vtk_double(const packing_i_read_vtk_values *values, size_t i);
/* 0 where the value is not a whole number that fits. */
int packing_i_read_vtk_int(const packing_i_read_vtk_values *values, size_t i, int64_t *v);

/* Where the bytes of an array come from: as they are, or as base64. */
typedef struct packing_i_read_vtk_source {
  const packing_i_read_vtk_file *file;
  const unsigned char *at, *end;
  int base64;
  unsigned char group[3]; /* decoded, not yet taken */
  unsigned used, held;
} packing_i_read_vtk_source;

/* At most so many bytes can come. */
uint64_t packing_i_read_vtk_left(const packing_i_read_vtk_source *source);
packing_status packing_i_read_vtk_take(packing_i_read_vtk_source *source,
                                       unsigned char *out, size_t count);
/* A number of a header. */
packing_status packing_i_read_vtk_take_size(packing_i_read_vtk_source *source,
                                            uint64_t *v);
/* Inflates `bytes` bytes (read_vtk_inflate.c). */
packing_status packing_i_read_vtk_inflate(packing_i_read_vtk_source *source,
                                          uint64_t bytes,
                                          packing_i_read_vtk_values *values);

/* Notes a failure at a place of the file. */
packing_status packing_i_read_vtk_fail(const packing_i_read_vtk_file *file,
                                       const void *at, packing_status status,
                                       const char *what);

#endif
