/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STL, text and binary: facets of their own three corners each, which packing_mesh_create()
 * merges. Normals are left out, since the order of the corners says the same. Of text several
 * solids are one mesh. Binary: 80 bytes, the number of facets, 50 bytes each. Reference:
 * StereoLithography Interface Specification, 3D Systems, 1989. */
#include "mesh_file_internal.h"
#include <string.h>

enum { HEADER = 80, FACET = 50, FACETS = 256 /* read at once */ };

/* The next line, which must begin with `head`. */
static packing_status take_head(packing_i_mesh_file *file, const char *head,
                                packing_i_words *words)
{
  char quote[PACKING_I_QUOTE_SIZE];
  PACKING_I_TRY(packing_i_read_needed(&file->read, head, words));
  const packing_i_words found = *words;
  if (packing_i_words_begin(words, head))
    return PACKING_OK;
  return packing_i_mesh_file_fail(file, "%s stands where \"%s\" should",
                                  packing_i_quote(found.at, found.end, quote), head);
}

static packing_status read_facet(packing_i_mesh_file *file)
{
  packing_i_words words;
  PACKING_I_TRY(take_head(file, "outer loop", &words));
  for (int i = 0; i < 3; i++) {
    double x[3];
    PACKING_I_TRY(take_head(file, "vertex", &words));
    PACKING_I_TRY(packing_i_words_doubles(&file->read, &words, "vertex", 3, x));
    PACKING_I_TRY(packing_i_words_done(&file->read, &words));
    PACKING_I_TRY(packing_i_mesh_file_vertex(file, x));
  }
  PACKING_I_TRY(take_head(file, "endloop", &words));
  return take_head(file, "endfacet", &words);
}

packing_status packing_i_read_stl_text(packing_i_mesh_file *file)
{
  packing_i_words words;
  char quote[PACKING_I_QUOTE_SIZE];
  int within = 0;
  file->soup = 1;
  file->read.lines.skip_blank = 1;
  for (;;) {
    PACKING_I_TRY(packing_i_read_line(&file->read, &words));
    if (words.at == NULL)
      break;
    packing_i_words rest = words;
    const packing_i_words head = packing_i_words_take(&rest);
    if (within && packing_i_word_is(head, "facet"))
      PACKING_I_TRY(read_facet(file));
    else if (within && packing_i_word_is(head, "endsolid"))
      within = 0;
    else if (!within && packing_i_word_is(head, "solid"))
      within = 1;
    else
      return packing_i_mesh_file_fail(file, "%s stands where \"%s\" should",
                                      packing_i_quote(words.at, words.end, quote),
                                      within ? "facet" : "solid");
  }
  return within ? packing_i_mesh_file_fail(file, "the file ends before endsolid")
                : PACKING_OK;
}

static uint32_t word_at(const unsigned char *bytes)
{
  return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
         (uint32_t)bytes[3] << 24;
}

/* 12 bytes of normal, three corners, two bytes of attributes. */
static packing_status take_facet(packing_i_mesh_file *file, const unsigned char *bytes)
{
  for (size_t i = 0; i < 3; i++) {
    double x[3];
    for (size_t k = 0; k < 3; k++) {
      const uint32_t bits = word_at(bytes + 12 + 12 * i + 4 * k);
      float single;
      memcpy(&single, &bits, sizeof single);
      x[k] = (double)single;
    }
    PACKING_I_TRY(packing_i_mesh_file_vertex(file, x));
  }
  file->read.byte += FACET;
  return PACKING_OK;
}

packing_status packing_i_read_stl_binary(packing_i_mesh_file *file)
{
  unsigned char bytes[FACETS * FACET];
  size_t more;
  file->soup = 1;
  PACKING_I_TRY(packing_i_mesh_file_bytes(file, bytes, HEADER + 4, "the header"));
  for (uint32_t left = word_at(bytes + HEADER); left > 0;) {
    const uint32_t count = left < FACETS ? left : FACETS;
    PACKING_I_TRY(
        packing_i_lines_bytes(&file->read.lines, bytes, (size_t)count * FACET, &more));
    for (size_t at = 0; at + FACET <= more; at += FACET, left--)
      PACKING_I_TRY(take_facet(file, bytes + at));
    if (more < (size_t)count * FACET)
      return packing_i_mesh_file_fail(
          file, "the file ends, and %lu triangles are missing", (unsigned long)left);
  }
  PACKING_I_TRY(packing_i_lines_bytes(&file->read.lines, bytes, 1, &more));
  return more == 0
             ? PACKING_OK
             : packing_i_mesh_file_fail(file, "more stands behind the last triangle");
}
