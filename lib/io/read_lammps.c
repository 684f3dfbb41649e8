/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LAMMPS data (read_data, docs.lammps.org), which LIGGGHTS shares: `atom_style sphere`, rows
 * `id type diameter density x y z [ix iy iz]`, or, where the hint behind Atoms says so, `hybrid
 * sphere bond`, rows `id type x y z diameter density molecule [ix iy iz]`. Image flags say how
 * often a particle has crossed the cell; positions are taken as they stand. Sections that tell
 * of species and potentials are passed over, those that tell of other particles refused.
 * Linear in the bytes; 32 bytes a particle where there are velocities or bonds. */
#include "read_internal.h"

/* Counts of the header. */
enum { ATOMS, ATOM_TYPES, BONDS, BOND_TYPES, OTHERS, EXTRA, COUNTS };

typedef struct data {
  packing_i_read *read;
  int64_t counts[COUNTS];
  double lo[3], hi[3];
  unsigned sides; /* bit k: side k is known */
  int has_atoms;  /* that section was read, so were its ids */
  int has_bonds, has_velocities;
  packing_i_ids ids;
  packing_i_words title; /* of the section that stands next, its hint cut */
  packing_i_words hint;
} data;

/* Lines `NUMBER WORDS`. */
static const struct {
  const char *words;
  int count;
} counted[] = {
    {"atoms", ATOMS},
    {"atom types", ATOM_TYPES},
    {"bonds", BONDS},
    {"bond types", BOND_TYPES},
    {"angles", OTHERS},
    {"dihedrals", OTHERS},
    {"impropers", OTHERS},
    {"ellipsoids", OTHERS},
    {"lines", OTHERS},
    {"triangles", OTHERS},
    {"bodies", OTHERS},
    {"angle types", EXTRA},
    {"dihedral types", EXTRA},
    {"improper types", EXTRA},
    {"extra bond per atom", EXTRA},
    {"extra angle per atom", EXTRA},
    {"extra dihedral per atom", EXTRA},
    {"extra improper per atom", EXTRA},
    {"extra special per atom", EXTRA},
};

static packing_status read_count(data *d, packing_i_words words, int *known)
{
  packing_i_words rest = words;
  (void)packing_i_words_take(&rest);
  for (size_t k = 0; k < sizeof counted / sizeof counted[0]; k++)
    if (packing_i_words_are(rest, counted[k].words)) {
      int64_t *count = &d->counts[counted[k].count];
      *known = 1;
      PACKING_I_TRY(packing_i_words_int(d->read, &words, counted[k].words, 0,
                                        counted[k].count == OTHERS ? 0 : INT64_MAX,
                                        count));
    }
  return PACKING_OK;
}

static packing_status read_side(data *d, packing_i_words words, int *known)
{
  static const char *const names[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
  packing_i_words rest = words;
  (void)packing_i_words_take(&rest);
  (void)packing_i_words_take(&rest);
  for (unsigned k = 0; k < 3; k++)
    if (packing_i_words_are(rest, names[k])) {
      *known = 1;
      PACKING_I_TRY(packing_i_words_double(d->read, &words, names[k], &d->lo[k]));
      PACKING_I_TRY(packing_i_words_double(d->read, &words, names[k], &d->hi[k]));
      d->sides |= 1U << k;
    }
  return PACKING_OK;
}

static packing_status read_tilt(data *d, packing_i_words words, int *known)
{
  packing_vec3 *tilt = &d->read->info.tilt;
  packing_i_words rest = words;
  for (int k = 0; k < 3; k++)
    (void)packing_i_words_take(&rest);
  if (!packing_i_words_are(rest, "xy xz yz"))
    return PACKING_OK;
  *known = 1;
  PACKING_I_TRY(packing_i_words_double(d->read, &words, "xy", &tilt->x));
  PACKING_I_TRY(packing_i_words_double(d->read, &words, "xz", &tilt->y));
  return packing_i_words_double(d->read, &words, "yz", &tilt->z);
}

static packing_status read_header_line(data *d, packing_i_words words)
{
  char quote[PACKING_I_QUOTE_SIZE];
  int known = 0;
  PACKING_I_TRY(read_count(d, words, &known));
  if (!known)
    PACKING_I_TRY(read_side(d, words, &known));
  if (!known)
    PACKING_I_TRY(read_tilt(d, words, &known));
  if (known)
    return PACKING_OK;
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "%s is no line of a header",
                             packing_i_quote(words.at, words.end, quote));
}

/* The next line that is neither blank nor a comment; at NULL at the end. */
static packing_status next_line(data *d, packing_i_words *words)
{
  do {
    PACKING_I_TRY(packing_i_read_line(d->read, words));
    if (words->at == NULL)
      return PACKING_OK;
    d->hint = packing_i_words_cut(words);
  } while (packing_i_words_ended(words));
  return PACKING_OK;
}

static int is_title(const packing_i_words *words)
{
  return (*words->at >= 'A' && *words->at <= 'Z') ||
         (*words->at >= 'a' && *words->at <= 'z');
}

/* Reads up to the first title. */
static packing_status read_header(data *d)
{
  packing_i_words words;
  PACKING_I_TRY(packing_i_read_needed(d->read, "its first line", &words));
  for (;;) {
    PACKING_I_TRY(next_line(d, &d->title));
    if (d->title.at == NULL || is_title(&d->title))
      break;
    PACKING_I_TRY(read_header_line(d, d->title));
  }
  for (unsigned k = 0; k < 3; k++)
    if (!(d->sides >> k & 1))
      return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                                 "the header has no line %clo %chi", "xyz"[k], "xyz"[k]);
  return packing_i_read_box(d->read, d->lo, d->hi);
}

/* LAMMPS drops the line behind a title, whatever it holds. */
static packing_status skip_blank_line(data *d)
{
  packing_i_words words;
  PACKING_I_TRY(packing_i_read_line(d->read, &words));
  if (words.at == NULL || packing_i_words_ended(&words))
    return PACKING_OK;
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                             "the line behind the name of a section must be blank");
}

/* Row `row` of `count`. */
static packing_status take_row(data *d, const char *section, int64_t row, int64_t count,
                               packing_i_words *words)
{
  PACKING_I_TRY(packing_i_read_needed(d->read, "its last row", words));
  (void)packing_i_words_cut(words);
  if (!packing_i_words_ended(words))
    return PACKING_OK;
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                             "a blank line, %lld rows of %s are missing",
                             (long long)(count - row), section);
}

/* Notes the density that all particles have, if they do. */
static void note_density(packing_read_info *info, double density, int first)
{
  if (first)
    info->density = density;
  info->has_density = first || (info->has_density && info->density == density);
}

static packing_status read_ball(data *d, packing_i_words *words, int hybrid,
                                packing_i_row *row, double *density)
{
  double size[2], centre[3];
  const packing_i_read *read = d->read;
  if (!hybrid)
    PACKING_I_TRY(packing_i_words_doubles(read, words, "diameter, density", 2, size));
  PACKING_I_TRY(packing_i_words_doubles(read, words, "x, y, z", 3, centre));
  if (hybrid)
    PACKING_I_TRY(packing_i_words_doubles(read, words, "diameter, density", 2, size));
  row->x = centre[0];
  row->y = centre[1];
  row->z = centre[2];
  row->r = size[0] / 2;
  *density = size[1];
  if (!(size[1] > 0))
    return packing_i_read_fail(read, PACKING_ERR_FORMAT, "the density %g is not above 0",
                               size[1]);
  return PACKING_OK;
}

/* The molecule of a hybrid, and image flags. */
static packing_status skip_whole_numbers(data *d, packing_i_words *words, int hybrid)
{
  int64_t unused;
  if (hybrid)
    PACKING_I_TRY(packing_i_words_int(d->read, words, "molecule", 0, INT64_MAX, &unused));
  if (packing_i_words_ended(words))
    return PACKING_OK;
  for (int k = 0; k < 3; k++)
    PACKING_I_TRY(
        packing_i_words_int(d->read, words, "image", INT32_MIN, INT32_MAX, &unused));
  return packing_i_words_done(d->read, words);
}

static packing_status read_atom(data *d, packing_i_words *words, int hybrid, int first)
{
  packing_i_row *row = packing_i_read_row(d->read);
  const int64_t types = d->counts[ATOM_TYPES];
  double density;
  PACKING_I_TRY(packing_i_words_int(d->read, words, "id", 1, INT64_MAX, &row->id));
  PACKING_I_TRY(packing_i_words_int32(d->read, words, "type", 1,
                                      types < INT32_MAX ? (int32_t)types : INT32_MAX,
                                      &row->type));
  PACKING_I_TRY(read_ball(d, words, hybrid, row, &density));
  note_density(&d->read->info, density, first);
  PACKING_I_TRY(skip_whole_numbers(d, words, hybrid));
  return packing_i_read_take(d->read);
}

/* Which columns there are, as the hint says; none: those of spheres. LAMMPS itself names the parts
 * of no hybrid; where they are named, their order is that of the columns. */
static packing_status read_hint(data *d, int *hybrid)
{
  char quote[PACKING_I_QUOTE_SIZE];
  packing_i_words words = d->hint;
  const packing_i_words style = packing_i_words_take(&words);
  *hybrid = packing_i_word_is(style, "hybrid");
  const int known =
      *hybrid ? packing_i_words_ended(&words) || packing_i_words_are(words, "sphere bond")
              : style.at == style.end || packing_i_word_is(style, "sphere") ||
                    packing_i_word_is(style, "granular");
  if (known)
    return PACKING_OK;
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                             "atoms of style %s, not sphere or hybrid sphere bond",
                             packing_i_quote(style.at, d->hint.end, quote));
}

static packing_status read_atoms(data *d)
{
  packing_i_words words;
  int hybrid;
  if (d->has_atoms)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "a second section Atoms");
  PACKING_I_TRY(read_hint(d, &hybrid));
  PACKING_I_TRY(skip_blank_line(d));
  PACKING_I_TRY(packing_i_read_columns(d->read, PACKING_COLUMN_ID | PACKING_COLUMN_TYPE));
  for (int64_t i = 0; i < d->counts[ATOMS]; i++) {
    PACKING_I_TRY(take_row(d, "Atoms", i, d->counts[ATOMS], &words));
    PACKING_I_TRY(read_atom(d, &words, hybrid, i == 0));
  }
  PACKING_I_TRY(packing_i_read_flush(d->read));
  d->has_atoms = 1;
  return packing_i_ids_begin(d->read, &d->ids);
}

/* The next particle named, each once. */
static packing_status take_id(data *d, packing_i_words *words, unsigned char *seen,
                              size_t *index)
{
  int64_t id;
  PACKING_I_TRY(packing_i_words_int(d->read, words, "id", 1, INT64_MAX, &id));
  *index = packing_i_ids_find(&d->ids, id);
  if (*index == PACKING_NO_INDEX)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "particle %lld is not there",
                               (long long)id);
  if (seen[*index])
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "particle %lld stands twice",
                               (long long)id);
  seen[*index] = 1;
  return PACKING_OK;
}

static packing_status read_velocity(data *d, packing_i_words *words, unsigned char *seen)
{
  static const char *const names[] = {"vx", "vy", "vz", "wx", "wy", "wz"};
  size_t index;
  PACKING_I_TRY(take_id(d, words, seen, &index));
  for (int k = 0; k < 6; k++) {
    double *column = d->read->particles->column[PACKING_FIELD_VX + k];
    PACKING_I_TRY(packing_i_words_double(d->read, words, names[k], &column[index]));
  }
  return packing_i_words_done(d->read, words);
}

static packing_status read_velocities(data *d)
{
  const packing_allocator *allocator = packing_i_allocator(d->read->context);
  const int64_t count = d->counts[ATOMS];
  packing_status status = PACKING_OK;
  PACKING_I_TRY(
      packing_i_read_columns(d->read, PACKING_COLUMN_VELOCITY | PACKING_COLUMN_SPIN));
  unsigned char *seen = packing_i_calloc(allocator, d->ids.count, 1);
  if (seen == NULL)
    return packing_i_nomem(d->read->context);
  for (int64_t i = 0; i < count && status == PACKING_OK; i++) {
    packing_i_words words;
    status = take_row(d, "Velocities", i, count, &words);
    if (status == PACKING_OK)
      status = read_velocity(d, &words, seen);
  }
  packing_i_free(allocator, seen);
  return status;
}

static packing_status read_bonds(data *d)
{
  const int64_t types = d->counts[BOND_TYPES];
  for (int64_t i = 0; i < d->counts[BONDS]; i++) {
    packing_i_words words;
    int64_t unused, ends[2];
    int32_t type;
    PACKING_I_TRY(take_row(d, "Bonds", i, d->counts[BONDS], &words));
    PACKING_I_TRY(packing_i_words_int(d->read, &words, "id", 1, INT64_MAX, &unused));
    PACKING_I_TRY(packing_i_words_int32(d->read, &words, "type", 1,
                                        types < INT32_MAX ? (int32_t)types : INT32_MAX,
                                        &type));
    for (int k = 0; k < 2; k++)
      PACKING_I_TRY(packing_i_words_int(d->read, &words, "id", 1, INT64_MAX, &ends[k]));
    PACKING_I_TRY(packing_i_words_done(d->read, &words));
    PACKING_I_TRY(packing_i_read_bond(d->read, &d->ids, ends, type));
  }
  return PACKING_OK;
}

/* A section that comes once, behind Atoms. */
static packing_status read_behind_atoms(data *d, const char *name, int *has,
                                        packing_status (*rows)(data *d))
{
  if (!d->has_atoms)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "%s stands before Atoms",
                               name);
  if (*has)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "a second section %s", name);
  *has = 1;
  PACKING_I_TRY(skip_blank_line(d));
  return rows(d);
}

static packing_status next_title(data *d)
{
  PACKING_I_TRY(next_line(d, &d->title));
  if (d->title.at == NULL || is_title(&d->title))
    return PACKING_OK;
  char quote[PACKING_I_QUOTE_SIZE];
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                             "%s stands where a section should begin",
                             packing_i_quote(d->title.at, d->title.end, quote));
}

/* Goes on to the title behind. */
static packing_status skip_section(data *d)
{
  do
    PACKING_I_TRY(next_line(d, &d->title));
  while (d->title.at != NULL && !is_title(&d->title));
  return PACKING_OK;
}

static packing_status read_section(data *d)
{
  static const char *const skipped[] = {"Masses", "Pair Coeffs", "PairIJ Coeffs",
                                        "Bond Coeffs"};
  char quote[PACKING_I_QUOTE_SIZE];
  for (size_t k = 0; k < sizeof skipped / sizeof skipped[0]; k++)
    if (packing_i_words_are(d->title, skipped[k]))
      return skip_section(d);
  if (packing_i_words_are(d->title, "Atoms"))
    PACKING_I_TRY(read_atoms(d));
  else if (packing_i_words_are(d->title, "Velocities"))
    PACKING_I_TRY(
        read_behind_atoms(d, "Velocities", &d->has_velocities, read_velocities));
  else if (packing_i_words_are(d->title, "Bonds"))
    PACKING_I_TRY(read_behind_atoms(d, "Bonds", &d->has_bonds, read_bonds));
  else
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                               "section %s is not one that is read",
                               packing_i_quote(d->title.at, d->title.end, quote));
  return next_title(d);
}

static packing_status read_sections(data *d)
{
  while (d->title.at != NULL)
    PACKING_I_TRY(read_section(d));
  if (d->counts[ATOMS] > 0 && !d->has_atoms)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "no section Atoms");
  if (d->counts[BONDS] > 0 && !d->has_bonds)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "no section Bonds");
  return PACKING_OK;
}

static packing_status read_data(packing_i_read *read)
{
  data d = {0};
  d.read = read;
  read->lines.keep_comments = 1;
  PACKING_I_TRY(read_header(&d));
  const packing_status status = read_sections(&d);
  packing_i_ids_end(read, &d.ids);
  return status;
}

const packing_i_reader packing_i_reader_lammps = {
    {"lammps", ".data", "LAMMPS 29Sep2021, read_data, atom_style sphere",
     "centre, diameter, id, type, velocity, spin, bonds, box, one density"},
    PACKING_I_READS_LINES,
    read_data};

const packing_i_reader packing_i_reader_liggghts = {
    {"liggghts", "", "LIGGGHTS 3.8.0, read_data, atom_style granular",
     "centre, diameter, id, type, velocity, spin, bonds, box, one density"},
    PACKING_I_READS_LINES,
    read_data};
