/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The .geo of ESyS-Particle 2.3.5 and DEMGenGeo (sim.readGeometry): particles and bonds. The
 * lines stand in one order, since YADE's reader takes the count from the seventh. Linear in
 * the bytes; 32 bytes a particle where there are bonds. */
#include "read_internal.h"

/* The next line that is not blank, which must begin with `head`. */
static packing_status take_head(packing_i_read *read, const char *head,
                                packing_i_words *words)
{
  char quote[PACKING_I_QUOTE_SIZE];
  PACKING_I_TRY(packing_i_read_needed(read, head, words));
  packing_i_words found = *words;
  if (packing_i_words_begin(words, head))
    return PACKING_OK;
  return packing_i_read_fail(read, PACKING_ERR_FORMAT, "%s stands where %s should",
                             packing_i_quote(found.at, found.end, quote), head);
}

/* A line that is `head` and nothing else. */
static packing_status take_line(packing_i_read *read, const char *head)
{
  packing_i_words words;
  PACKING_I_TRY(take_head(read, head, &words));
  return packing_i_words_done(read, &words);
}

static packing_status read_bounding_box(packing_i_read *read)
{
  packing_i_words words;
  double ends[6];
  PACKING_I_TRY(take_head(read, "BoundingBox", &words));
  PACKING_I_TRY(packing_i_words_doubles(read, &words, "BoundingBox", 6, ends));
  PACKING_I_TRY(packing_i_words_done(read, &words));
  return packing_i_read_box(read, ends, ends + 3);
}

static packing_status read_boundaries(packing_i_read *read)
{
  packing_i_words words;
  PACKING_I_TRY(take_head(read, "PeriodicBoundaries", &words));
  for (unsigned k = 0; k < 3; k++) {
    int64_t periodic;
    PACKING_I_TRY(
        packing_i_words_int(read, &words, "PeriodicBoundaries", 0, 1, &periodic));
    read->info.periodic |= periodic ? 1U << k : 0;
  }
  read->info.has_periodic = 1;
  return packing_i_words_done(read, &words);
}

static packing_status read_dimension(packing_i_read *read)
{
  packing_i_words words;
  PACKING_I_TRY(take_head(read, "Dimension", &words));
  if (packing_i_words_are(words, "2D"))
    read->info.dim = 2;
  else if (!packing_i_words_are(words, "3D"))
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "Dimension is neither 2D nor 3D");
  return PACKING_OK;
}

static packing_status read_header(packing_i_read *read)
{
  packing_i_words words;
  PACKING_I_TRY(take_head(read, "LSMGeometry", &words));
  if (!packing_i_words_are(words, "1.2"))
    return packing_i_read_fail(read, PACKING_ERR_FORMAT, "not version 1.2");
  PACKING_I_TRY(read_bounding_box(read));
  PACKING_I_TRY(read_boundaries(read));
  return read_dimension(read);
}

static packing_status read_count(packing_i_read *read, int64_t *count)
{
  packing_i_words words;
  PACKING_I_TRY(packing_i_read_needed(read, "a count", &words));
  PACKING_I_TRY(packing_i_words_int(read, &words, "count", 0, INT64_MAX, count));
  return packing_i_words_done(read, &words);
}

static packing_status read_particle(packing_i_read *read, packing_i_words *words)
{
  packing_i_row *row = packing_i_read_row(read);
  PACKING_I_TRY(packing_i_words_double(read, words, "x", &row->x));
  PACKING_I_TRY(packing_i_words_double(read, words, "y", &row->y));
  PACKING_I_TRY(packing_i_words_double(read, words, "z", &row->z));
  PACKING_I_TRY(packing_i_words_double(read, words, "r", &row->r));
  PACKING_I_TRY(packing_i_words_int(read, words, "id", INT64_MIN, INT64_MAX, &row->id));
  PACKING_I_TRY(
      packing_i_words_int32(read, words, "tag", INT32_MIN, INT32_MAX, &row->type));
  PACKING_I_TRY(packing_i_words_done(read, words));
  if (read->info.dim == 2 && row->z != 0)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT, "z is %g in two dimensions",
                               row->z);
  return packing_i_read_take(read);
}

static packing_status read_particles(packing_i_read *read)
{
  packing_i_words words;
  int64_t count;
  PACKING_I_TRY(take_line(read, "BeginParticles"));
  PACKING_I_TRY(take_line(read, "Simple"));
  PACKING_I_TRY(read_count(read, &count));
  PACKING_I_TRY(packing_i_read_columns(read, PACKING_COLUMN_ID | PACKING_COLUMN_TYPE));
  for (int64_t i = 0; i < count; i++) {
    PACKING_I_TRY(packing_i_read_needed(read, "the last particle", &words));
    PACKING_I_TRY(read_particle(read, &words));
  }
  PACKING_I_TRY(packing_i_read_flush(read));
  return take_line(read, "EndParticles");
}

static packing_status read_connection(packing_i_read *read, const packing_i_ids *ids)
{
  packing_i_words words;
  int64_t ends[2];
  int32_t tag;
  PACKING_I_TRY(packing_i_read_needed(read, "the last connection", &words));
  for (int k = 0; k < 2; k++)
    PACKING_I_TRY(
        packing_i_words_int(read, &words, "id", INT64_MIN, INT64_MAX, &ends[k]));
  PACKING_I_TRY(packing_i_words_int32(read, &words, "tag", INT32_MIN, INT32_MAX, &tag));
  PACKING_I_TRY(packing_i_words_done(read, &words));
  return packing_i_read_bond(read, ids, ends, tag);
}

static packing_status read_connections(packing_i_read *read)
{
  packing_i_ids ids;
  int64_t count;
  PACKING_I_TRY(take_line(read, "BeginConnect"));
  PACKING_I_TRY(read_count(read, &count));
  PACKING_I_TRY(packing_i_ids_begin(read, &ids));
  packing_status status = PACKING_OK;
  for (int64_t b = 0; b < count && status == PACKING_OK; b++)
    status = read_connection(read, &ids);
  packing_i_ids_end(read, &ids);
  PACKING_I_TRY(status);
  return take_line(read, "EndConnect");
}

static packing_status read_geo(packing_i_read *read)
{
  packing_i_words words;
  read->lines.skip_blank = 1;
  read->lines.keep_comments = 1;
  PACKING_I_TRY(read_header(read));
  PACKING_I_TRY(read_particles(read));
  PACKING_I_TRY(read_connections(read));
  PACKING_I_TRY(packing_i_read_line(read, &words));
  return words.at == NULL ? PACKING_OK : packing_i_words_done(read, &words);
}

const packing_i_reader packing_i_reader_geo = {
    {"geo", ".geo", "ESyS-Particle 2.3.5, sim.readGeometry",
     "centre, radius, id, tag as type, bonds, box, periodic directions"},
    PACKING_I_READS_LINES,
    read_geo};
