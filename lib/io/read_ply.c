/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PLY 1.0: elements row by row as the header says (read_ply_header.c), as text or binary of either
 * order of bytes. A value is read as a double, which holds all types. Faces of more corners are
 * fans. Reference: G. Turk, The PLY polygon file format (1994). */
#include "mesh_file_internal.h"
#include <math.h>
#include <string.h>

typedef struct source {
  packing_i_mesh_file *file;
  const packing_i_ply *ply;
  packing_i_words words; /* of text: what is left of a row */
} source;

static size_t size_of(packing_i_ply_type type)
{
  static const size_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[type];
}

static double real_of(packing_i_ply_type type, uint64_t bits)
{
  if (type == PACKING_I_PLY_DOUBLE) {
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
  }
  const uint32_t word = (uint32_t)bits;
  float single;
  memcpy(&single, &word, sizeof single);
  return (double)single;
}

static double value_of(packing_i_ply_type type, const unsigned char *bytes, int big)
{
  const size_t size = size_of(type);
  uint64_t bits = 0;
  for (size_t i = 0; i < size; i++)
    bits = bits << 8 | bytes[big ? i : size - 1 - i];
  if (type >= PACKING_I_PLY_FLOAT)
    return real_of(type, bits);
  const double top = ldexp(1.0, (int)(8 * size - 1));
  const int is_signed = type == PACKING_I_PLY_INT8 || type == PACKING_I_PLY_INT16 ||
                        type == PACKING_I_PLY_INT32;
  const double v = (double)bits;
  return is_signed && v >= top ? v - 2 * top : v;
}

static packing_status read_value(source *s, packing_i_ply_type type, double *v)
{
  unsigned char bytes[8];
  if (s->ply->format == PACKING_I_PLY_ASCII)
    return packing_i_words_double(&s->file->read, &s->words, "value", v);
  PACKING_I_TRY(packing_i_mesh_file_bytes(s->file, bytes, size_of(type), "an element"));
  *v = value_of(type, bytes, s->ply->format == PACKING_I_PLY_BIG);
  return PACKING_OK;
}

static packing_status read_length(source *s, packing_i_ply_type type, uint32_t *length)
{
  double v;
  PACKING_I_TRY(read_value(s, type, &v));
  if (!(v >= 0 && v <= UINT32_MAX && v == floor(v)))
    return packing_i_mesh_file_fail(s->file, "a list of %g entries", v);
  *length = (uint32_t)v;
  return PACKING_OK;
}

static packing_status read_corner(source *s, packing_i_ply_type type, uint32_t *corner)
{
  double v;
  PACKING_I_TRY(read_value(s, type, &v));
  if (!(v >= 0 && v < (double)s->file->vertices && v == floor(v)))
    return packing_i_mesh_file_fail(s->file, "vertex %g of a face, of %zu", v,
                                    s->file->vertices);
  *corner = (uint32_t)v;
  return PACKING_OK;
}

static packing_status read_face(source *s, const packing_i_ply_property *p)
{
  uint32_t length = 0, v[3] = {0, 0, 0};
  PACKING_I_TRY(read_length(s, p->count, &length));
  if (length < 3)
    return packing_i_mesh_file_fail(s->file, "a face of %lu corners",
                                    (unsigned long)length);
  for (uint32_t i = 0; i < length; i++) {
    if (i >= 3)
      v[1] = v[2];
    PACKING_I_TRY(read_corner(s, p->type, &v[i < 2 ? i : 2]));
    if (i >= 2)
      PACKING_I_TRY(packing_i_mesh_file_triangle(s->file, v));
  }
  return PACKING_OK;
}

static packing_status skip_list(source *s, const packing_i_ply_property *p)
{
  uint32_t length = 0;
  double v;
  PACKING_I_TRY(read_length(s, p->count, &length));
  for (uint32_t i = 0; i < length; i++)
    PACKING_I_TRY(read_value(s, p->type, &v));
  return PACKING_OK;
}

static packing_status read_row(source *s, const packing_i_ply_element *e)
{
  double x[3] = {0, 0, 0}, other;
  for (unsigned k = e->first; k < e->first + e->properties; k++) {
    const packing_i_ply_property *p = &s->ply->property[k];
    if (p->corners)
      PACKING_I_TRY(read_face(s, p));
    else if (p->count != PACKING_I_PLY_NONE)
      PACKING_I_TRY(skip_list(s, p));
    else
      PACKING_I_TRY(read_value(s, p->type, p->axis >= 0 ? &x[p->axis] : &other));
  }
  return e->kind == PACKING_I_PLY_VERTEX ? packing_i_mesh_file_vertex(s->file, x)
                                         : PACKING_OK;
}

static packing_status read_element(source *s, const packing_i_ply_element *e)
{
  const int text = s->ply->format == PACKING_I_PLY_ASCII;
  for (uint64_t i = 0; i < e->count; i++) {
    if (text)
      PACKING_I_TRY(packing_i_read_needed(&s->file->read, "the last element", &s->words));
    PACKING_I_TRY(read_row(s, e));
    if (text)
      PACKING_I_TRY(packing_i_words_done(&s->file->read, &s->words));
  }
  return PACKING_OK;
}

/* Text may end with blank lines, binary with nothing. */
static packing_status read_end(source *s)
{
  unsigned char byte;
  size_t more = 0;
  if (s->ply->format == PACKING_I_PLY_ASCII) {
    PACKING_I_TRY(packing_i_read_line(&s->file->read, &s->words));
    more = s->words.at != NULL;
  } else {
    PACKING_I_TRY(packing_i_lines_bytes(&s->file->read.lines, &byte, 1, &more));
  }
  return more == 0
             ? PACKING_OK
             : packing_i_mesh_file_fail(s->file, "more stands behind the last element");
}

packing_status packing_i_read_ply(packing_i_mesh_file *file)
{
  /* the reader of its binary elements names bytes */
  static const packing_i_reader binary = {
      {"ply", ".ply", "G. Turk, The PLY polygon file format", "vertices and faces"},
      PACKING_I_READS_BYTES,
      NULL};
  packing_i_ply ply;
  source s = {file, &ply, {NULL, NULL}};
  file->read.lines.skip_blank = 1;
  file->read.lines.keep_comments = 1;
  PACKING_I_TRY(packing_i_read_ply_header(file, &ply));
  if (ply.format != PACKING_I_PLY_ASCII) {
    file->read.reader = &binary;
    file->read.byte = 0;
  }
  for (unsigned i = 0; i < ply.elements; i++)
    PACKING_I_TRY(read_element(&s, &ply.element[i]));
  return read_end(&s);
}
