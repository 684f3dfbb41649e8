/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text of YADE, as ymport.text and pack.SpherePack().load of YADE 2023.02a take it. The first
 * skips # lines, follows a line `#format NAME`, and fails on a blank line; the second knows no
 * comments, only `##PERIODIC:: Lx Ly Lz` in front. Linear in the bytes. */
#include "read_internal.h"

/* What stands in a row, in order. */
typedef struct layout {
  const char *name;
  int id, material, attributes;
} layout;

static const layout layouts[] = {
    {"x_y_z_r", 0, 0, 0},
    {"x_y_z_r_matId", 0, 1, 0},
    {"id_x_y_z_r_matId", 1, 1, 0},
    {"x_y_z_r_attrs", 0, 0, 1},
};

enum { LAYOUTS = sizeof layouts / sizeof layouts[0] };

static int has_rows(const packing_i_read *read)
{
  return packing_particles_count(read->particles) + read->used > 0;
}

static packing_status switch_layout(packing_i_read *read, packing_i_words words,
                                    const layout **now)
{
  char quote[PACKING_I_QUOTE_SIZE];
  const packing_i_words name = packing_i_words_take(&words);
  const layout *found = NULL;
  for (size_t i = 0; i < LAYOUTS; i++)
    if (packing_i_word_is(name, layouts[i].name))
      found = &layouts[i];
  if (found == NULL)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT, "#format: %s is not known",
                               packing_i_quote(name.at, name.end, quote));
  /* YADE would leave out the ids of some particles */
  if (has_rows(read) && (found->id != (*now)->id || found->material != (*now)->material))
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "#format: %s behind rows with other columns", found->name);
  *now = found;
  return PACKING_OK;
}

static packing_status read_ball(packing_i_read *read, packing_i_words *words,
                                packing_i_row *row)
{
  PACKING_I_TRY(packing_i_words_double(read, words, "x", &row->x));
  PACKING_I_TRY(packing_i_words_double(read, words, "y", &row->y));
  PACKING_I_TRY(packing_i_words_double(read, words, "z", &row->z));
  return packing_i_words_double(read, words, "r", &row->r);
}

static packing_status read_row(packing_i_read *read, packing_i_words *words,
                               const layout *now)
{
  packing_i_row *row = packing_i_read_row(read);
  if (!has_rows(read)) /* those of a #format that another follows are not wanted */
    PACKING_I_TRY(
        packing_i_read_columns(read, (now->id ? PACKING_COLUMN_ID : 0U) |
                                         (now->material ? PACKING_COLUMN_TYPE : 0U)));
  if (now->id)
    PACKING_I_TRY(packing_i_words_int(read, words, "id", INT64_MIN, INT64_MAX, &row->id));
  PACKING_I_TRY(read_ball(read, words, row));
  if (now->material)
    PACKING_I_TRY(
        packing_i_words_int32(read, words, "matId", INT32_MIN, INT32_MAX, &row->type));
  if (!now->attributes)
    PACKING_I_TRY(packing_i_words_done(read, words));
  return packing_i_read_take(read);
}

static packing_status read_text(packing_i_read *read)
{
  packing_i_words words;
  const layout *now = &layouts[0];
  read->lines.keep_comments = 1;
  for (;;) {
    PACKING_I_TRY(packing_i_read_line(read, &words));
    if (words.at == NULL)
      return packing_i_read_flush(read);
    if (packing_i_words_ended(&words))
      return packing_i_read_fail(read, PACKING_ERR_FORMAT, "a blank line");
    if (packing_i_words_begin(&words, "#format"))
      PACKING_I_TRY(switch_layout(read, words, &now));
    else if (*words.at != '#')
      PACKING_I_TRY(read_row(read, &words, now));
  }
}

/* The cell of SpherePack: its corner is the origin. */
static packing_status read_cell(packing_i_read *read, packing_i_words *words)
{
  static const double origin[3] = {0, 0, 0};
  double sides[3];
  PACKING_I_TRY(packing_i_words_doubles(read, words, "the cell", 3, sides));
  PACKING_I_TRY(packing_i_words_done(read, words));
  PACKING_I_TRY(packing_i_read_box(read, origin, sides));
  read->info.has_periodic = 1;
  read->info.periodic = PACKING_PERIODIC_X | PACKING_PERIODIC_Y | PACKING_PERIODIC_Z;
  return PACKING_OK;
}

static packing_status read_sphere(packing_i_read *read, packing_i_words *words)
{
  int32_t clump = -1;
  PACKING_I_TRY(read_ball(read, words, packing_i_read_row(read)));
  if (!packing_i_words_ended(words))
    PACKING_I_TRY(
        packing_i_words_int32(read, words, "clumpId", INT32_MIN, INT32_MAX, &clump));
  PACKING_I_TRY(packing_i_words_done(read, words));
  if (clump >= 0)
    return packing_i_read_fail(read, PACKING_ERR_UNSUPPORTED,
                               "a sphere of clump %ld: clumps are not read", (long)clump);
  return packing_i_read_take(read);
}

static packing_status read_spheres(packing_i_read *read)
{
  packing_i_words words;
  read->lines.keep_comments = 1;
  for (;;) {
    PACKING_I_TRY(packing_i_read_line(read, &words));
    if (words.at == NULL)
      return packing_i_read_flush(read);
    if (packing_i_words_ended(&words))
      return packing_i_read_fail(read, PACKING_ERR_FORMAT, "a blank line");
    if (read->lines.number == 1 && packing_i_words_begin(&words, "##PERIODIC::"))
      PACKING_I_TRY(read_cell(read, &words));
    else
      PACKING_I_TRY(read_sphere(read, &words));
  }
}

const packing_i_reader packing_i_reader_yade = {{"yade", ".txt",
                                                 "YADE 2023.02a, ymport.text",
                                                 "centre, radius, id, material as type"},
                                                PACKING_I_READS_LINES,
                                                read_text};

const packing_i_reader packing_i_reader_yade_pack = {
    {"yade-pack", "", "YADE 2023.02a, pack.SpherePack", "centre, radius, periodic cell"},
    PACKING_I_READS_LINES,
    read_spheres};
