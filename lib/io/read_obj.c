/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wavefront OBJ: `v x y z` and `f` with indices from 1 on, or from -1 back; of `a/b/c` the first
 * counts. Faces of more corners are fans. What gives shape and is not read (curves, surfaces) is
 * refused, what gives looks is passed over, as are points and lines. A backslash at the end joins
 * lines of faces. Reference: Wavefront Technologies, Advanced Visualizer, appendix B1. */
#include "mesh_file_internal.h"
#include <string.h>

static packing_status read_vertex(packing_i_mesh_file *file, packing_i_words *words)
{
  double x[3];
  PACKING_I_TRY(packing_i_words_doubles(&file->read, words, "v", 3, x));
  return packing_i_mesh_file_vertex(file, x); /* a weight or colours may follow */
}

/* "7", "7/1", "7//3", "7/1/3", "-1". */
static packing_status read_corner(packing_i_mesh_file *file, packing_i_words word,
                                  uint32_t *corner)
{
  char quote[PACKING_I_QUOTE_SIZE];
  const char *slash = memchr(word.at, '/', (size_t)(word.end - word.at));
  packing_i_words number = {word.at, slash == NULL ? word.end : slash};
  const char *p = number.at;
  int64_t i = 0;
  if (packing_i_parse_int(&p, &i) != PACKING_I_NUMBER_OK || p != number.end)
    return packing_i_mesh_file_fail(file, "f: %s is no vertex",
                                    packing_i_quote(word.at, word.end, quote));
  const int64_t count = (int64_t)file->vertices;
  if (i == 0 || i > count || i < -count)
    return packing_i_mesh_file_fail(file, "f: vertex %lld of %zu read so far",
                                    (long long)i, file->vertices);
  *corner = (uint32_t)(i > 0 ? i - 1 : count + i);
  return PACKING_OK;
}

/* Takes the next word of a face; at NULL: no more. */
static packing_status next_corner(packing_i_mesh_file *file, packing_i_words *words,
                                  packing_i_words *word)
{
  *word = packing_i_words_take(words);
  while (word->end - word->at == 1 && *word->at == '\\' && packing_i_words_ended(words)) {
    PACKING_I_TRY(packing_i_read_needed(&file->read, "the rest of a face", words));
    *word = packing_i_words_take(words);
  }
  if (word->at == word->end)
    word->at = NULL;
  return PACKING_OK;
}

static packing_status read_face(packing_i_mesh_file *file, packing_i_words *words)
{
  uint32_t v[3] = {0, 0, 0};
  unsigned corners = 0;
  for (;; corners++) {
    packing_i_words word;
    PACKING_I_TRY(next_corner(file, words, &word));
    if (word.at == NULL)
      break;
    if (corners >= 3)
      v[1] = v[2];
    PACKING_I_TRY(read_corner(file, word, &v[corners < 2 ? corners : 2]));
    if (corners >= 2)
      PACKING_I_TRY(packing_i_mesh_file_triangle(file, v));
  }
  return corners >= 3 ? PACKING_OK
                      : packing_i_mesh_file_fail(file, "a face of %u corners", corners);
}

static int is_one_of(packing_i_words word, const char *const *names)
{
  for (; *names != NULL; names++)
    if (packing_i_word_is(word, *names))
      return 1;
  return 0;
}

static packing_status read_statement(packing_i_mesh_file *file, packing_i_words words)
{
  static const char *const looks[] = {
      "vt",       "vn",       "g",          "o",         "s",      "mg",  "usemtl",
      "mtllib",   "l",        "p",          "usemap",    "maplib", "lod", "bevel",
      "c_interp", "d_interp", "shadow_obj", "trace_obj", NULL};
  static const char *const shapes[] = {
      "vp",   "curv", "curv2", "surf", "cstype", "deg",  "bmat", "step",  "parm",  "trim",
      "hole", "scrv", "sp",    "end",  "con",    "call", "csh",  "ctech", "stech", NULL};
  char quote[PACKING_I_QUOTE_SIZE];
  const packing_i_words head = packing_i_words_take(&words);
  if (packing_i_word_is(head, "v"))
    return read_vertex(file, &words);
  if (packing_i_word_is(head, "f") || packing_i_word_is(head, "fo"))
    return read_face(file, &words);
  if (is_one_of(head, looks))
    return PACKING_OK;
  packing_i_quote(head.at, head.end, quote);
  if (is_one_of(head, shapes))
    return packing_i_read_fail(&file->read, PACKING_ERR_UNSUPPORTED,
                               "%s: curves and surfaces are not read", quote);
  return packing_i_mesh_file_fail(file, "%s begins no line of STL, OBJ or PLY", quote);
}

packing_status packing_i_read_obj(packing_i_mesh_file *file)
{
  packing_i_words words;
  file->read.lines.skip_blank = 1;
  for (;;) {
    PACKING_I_TRY(packing_i_read_line(&file->read, &words));
    if (words.at == NULL)
      return PACKING_OK;
    (void)packing_i_words_cut(&words);
    if (!packing_i_words_ended(&words))
      PACKING_I_TRY(read_statement(file, words));
  }
}
