/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The header of PLY: a format, and elements with their properties. Reference: G. Turk, The PLY
 * polygon file format (1994). */
#include "mesh_file_internal.h"

static packing_status read_format(packing_i_mesh_file *file, packing_i_words words,
                                  packing_i_ply *ply)
{
  if (packing_i_words_are(words, "ascii 1.0"))
    ply->format = PACKING_I_PLY_ASCII;
  else if (packing_i_words_are(words, "binary_little_endian 1.0"))
    ply->format = PACKING_I_PLY_LITTLE;
  else if (packing_i_words_are(words, "binary_big_endian 1.0"))
    ply->format = PACKING_I_PLY_BIG;
  else
    return packing_i_mesh_file_fail(
        file,
        "the format is none of ascii, binary_little_endian and binary_big_endian 1.0");
  return PACKING_OK;
}

static packing_status read_type(packing_i_mesh_file *file, packing_i_words *words,
                                packing_i_ply_type *type)
{
  static const struct {
    const char *name;
    packing_i_ply_type type;
  } names[] = {{"char", PACKING_I_PLY_INT8},     {"int8", PACKING_I_PLY_INT8},
               {"uchar", PACKING_I_PLY_UINT8},   {"uint8", PACKING_I_PLY_UINT8},
               {"short", PACKING_I_PLY_INT16},   {"int16", PACKING_I_PLY_INT16},
               {"ushort", PACKING_I_PLY_UINT16}, {"uint16", PACKING_I_PLY_UINT16},
               {"int", PACKING_I_PLY_INT32},     {"int32", PACKING_I_PLY_INT32},
               {"uint", PACKING_I_PLY_UINT32},   {"uint32", PACKING_I_PLY_UINT32},
               {"float", PACKING_I_PLY_FLOAT},   {"float32", PACKING_I_PLY_FLOAT},
               {"double", PACKING_I_PLY_DOUBLE}, {"float64", PACKING_I_PLY_DOUBLE}};
  char quote[PACKING_I_QUOTE_SIZE];
  const packing_i_words word = packing_i_words_take(words);
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (packing_i_word_is(word, names[i].name)) {
      *type = names[i].type;
      return PACKING_OK;
    }
  return packing_i_mesh_file_fail(file, "%s is no type",
                                  packing_i_quote(word.at, word.end, quote));
}

static packing_status read_element(packing_i_mesh_file *file, packing_i_words words,
                                   packing_i_ply *ply)
{
  if (ply->elements == PACKING_I_PLY_ELEMENTS)
    return packing_i_mesh_file_fail(file, "more than %d elements",
                                    PACKING_I_PLY_ELEMENTS);
  packing_i_ply_element *e = &ply->element[ply->elements++];
  const packing_i_words name = packing_i_words_take(&words);
  int64_t count;
  PACKING_I_TRY(
      packing_i_words_int(&file->read, &words, "element", 0, INT64_MAX, &count));
  PACKING_I_TRY(packing_i_words_done(&file->read, &words));
  *e = (packing_i_ply_element){.count = (uint64_t)count, .first = ply->properties};
  e->kind = packing_i_word_is(name, "vertex") ? PACKING_I_PLY_VERTEX
            : packing_i_word_is(name, "face") ? PACKING_I_PLY_FACE
                                              : PACKING_I_PLY_OTHER;
  return PACKING_OK;
}

static int axis_of(packing_i_words name)
{
  return packing_i_word_is(name, "x")   ? 0
         : packing_i_word_is(name, "y") ? 1
         : packing_i_word_is(name, "z") ? 2
                                        : -1;
}

static packing_status read_property(packing_i_mesh_file *file, packing_i_words words,
                                    packing_i_ply *ply)
{
  if (ply->elements == 0)
    return packing_i_mesh_file_fail(file, "a property of no element");
  if (ply->properties == PACKING_I_PLY_PROPERTIES)
    return packing_i_mesh_file_fail(file, "more than %d properties",
                                    PACKING_I_PLY_PROPERTIES);
  packing_i_ply_element *e = &ply->element[ply->elements - 1];
  packing_i_ply_property p = {PACKING_I_PLY_NONE, PACKING_I_PLY_NONE, -1, 0};
  if (packing_i_words_begin(&words, "list")) {
    PACKING_I_TRY(read_type(file, &words, &p.count));
    if (p.count >= PACKING_I_PLY_FLOAT)
      return packing_i_mesh_file_fail(file, "the length of a list is no whole number");
  }
  PACKING_I_TRY(read_type(file, &words, &p.type));
  const packing_i_words name = packing_i_words_take(&words);
  PACKING_I_TRY(packing_i_words_done(&file->read, &words));
  if (e->kind == PACKING_I_PLY_VERTEX && p.count == PACKING_I_PLY_NONE)
    p.axis = axis_of(name);
  p.corners = e->kind == PACKING_I_PLY_FACE && p.count != PACKING_I_PLY_NONE &&
              (packing_i_word_is(name, "vertex_indices") ||
               packing_i_word_is(name, "vertex_index"));
  if (p.corners && p.type >= PACKING_I_PLY_FLOAT)
    return packing_i_mesh_file_fail(file, "corners of faces are no whole numbers");
  ply->property[ply->properties++] = p;
  e->properties++;
  return PACKING_OK;
}

/* What is needed is there, once, vertices before faces. */
static packing_status check(packing_i_mesh_file *file, const packing_i_ply *ply)
{
  int vertices = 0, faces = 0, axes[3] = {0, 0, 0}, corners = 0;
  for (unsigned i = 0; i < ply->elements; i++) {
    const packing_i_ply_element *e = &ply->element[i];
    vertices += e->kind == PACKING_I_PLY_VERTEX;
    faces += e->kind == PACKING_I_PLY_FACE;
    if (e->kind == PACKING_I_PLY_FACE && vertices == 0)
      return packing_i_mesh_file_fail(file, "faces stand before vertices");
    if (e->properties == 0 && e->count > 0)
      return packing_i_mesh_file_fail(file, "an element without properties");
    for (unsigned k = e->first; k < e->first + e->properties; k++) {
      corners += ply->property[k].corners;
      if (ply->property[k].axis >= 0)
        axes[ply->property[k].axis]++;
    }
  }
  if (vertices != 1 || faces != 1)
    return packing_i_mesh_file_fail(
        file, "%d elements named vertex and %d named face, one of each is needed",
        vertices, faces);
  if (axes[0] != 1 || axes[1] != 1 || axes[2] != 1)
    return packing_i_mesh_file_fail(file, "a vertex needs x, y and z once each");
  if (corners != 1)
    return packing_i_mesh_file_fail(
        file, "a face needs one list vertex_indices or vertex_index");
  return PACKING_OK;
}

packing_status packing_i_read_ply_header(packing_i_mesh_file *file, packing_i_ply *ply)
{
  packing_i_words words;
  int has_format = 0;
  char quote[PACKING_I_QUOTE_SIZE];
  PACKING_I_TRY(packing_i_read_needed(&file->read, "ply", &words));
  if (!packing_i_words_are(words, "ply"))
    return packing_i_mesh_file_fail(file, "the first line is not \"ply\"");
  ply->elements = ply->properties = 0;
  ply->format = PACKING_I_PLY_ASCII;
  for (;;) {
    PACKING_I_TRY(packing_i_read_needed(&file->read, "end_header", &words));
    const packing_i_words line = words;
    const packing_i_words head = packing_i_words_take(&words);
    if (packing_i_word_is(head, "end_header"))
      break;
    if (packing_i_word_is(head, "format")) {
      PACKING_I_TRY(read_format(file, words, ply));
      has_format = 1;
    } else if (packing_i_word_is(head, "element")) {
      PACKING_I_TRY(read_element(file, words, ply));
    } else if (packing_i_word_is(head, "property")) {
      PACKING_I_TRY(read_property(file, words, ply));
    } else if (!packing_i_word_is(head, "comment") &&
               !packing_i_word_is(head, "obj_info")) {
      return packing_i_mesh_file_fail(file, "%s does not belong into a header",
                                      packing_i_quote(line.at, line.end, quote));
    }
  }
  if (!has_format)
    return packing_i_mesh_file_fail(file, "the header names no format");
  return check(file, ply);
}
