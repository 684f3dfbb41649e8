/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Extended XYZ (github.com/libAtoms/extxyz), as ASE and OVITO write it: frames of a count, a
 * line of `key=value`, and rows whose columns Properties names. Taken are pos, radius or
 * diameter, id, type, velo, angular_velocity, orientation (a quaternion, its real part last);
 * Lattice with a along x and b in the plane of x and y, Origin, pbc, Time. Linear in the bytes, in constant memory. */
#include "read_internal.h"

enum { MOST_PROPERTIES = 64 };

typedef enum kind {
  OTHER,
  POS,
  RADIUS,
  DIAMETER,
  ID,
  TYPE,
  VELO,
  SPIN,
  TURN,
  KINDS
} kind;

static const struct {
  const char *name;
  char letter; /* R: real, I: integer */
  int columns;
} known[KINDS] = {[OTHER] = {"", '\0', 0},         [POS] = {"pos", 'R', 3},
                  [RADIUS] = {"radius", 'R', 1},   [DIAMETER] = {"diameter", 'R', 1},
                  [ID] = {"id", 'I', 1},           [TYPE] = {"type", 'I', 1},
                  [VELO] = {"velo", 'R', 3},       [SPIN] = {"angular_velocity", 'R', 3},
                  [TURN] = {"orientation", 'R', 4}};

typedef struct frame {
  packing_i_read *read;
  size_t number; /* from 0 */
  unsigned properties, store, first_store;
  unsigned present; /* bit k: kind k */
  struct {
    kind kind;
    unsigned columns;
  } list[MOST_PROPERTIES];
} frame;

/* A piece of a line up to `mark`, which is passed over; the rest, if there is none. */
static packing_i_words take_to(packing_i_words *from, char mark)
{
  packing_i_words piece = *from;
  const char *found = memchr(from->at, mark, (size_t)(from->end - from->at));
  piece.end = found == NULL ? from->end : found;
  from->at = found == NULL ? from->end : found + 1;
  return piece;
}

static packing_status bad_property(const frame *f, packing_i_words name, const char *what)
{
  char quote[PACKING_I_QUOTE_SIZE];
  return packing_i_read_fail(f->read, PACKING_ERR_FORMAT, "Properties: %s %s",
                             packing_i_quote(name.at, name.end, quote), what);
}

/* One NAME:LETTER:COLUMNS. */
static packing_status read_property(frame *f, packing_i_words *text)
{
  const packing_i_words name = take_to(text, ':'), letter = take_to(text, ':'),
                        columns = take_to(text, ':');
  const char *p = columns.at;
  int64_t count;
  kind k = KINDS;
  if (letter.end - letter.at != 1 || strchr("SRIL", *letter.at) == NULL)
    return bad_property(f, name, "has no type S, R, I or L");
  if (columns.at == columns.end ||
      packing_i_parse_int(&p, &count) != PACKING_I_NUMBER_OK || p != columns.end ||
      count < 1 || count > PACKING_I_LINE_LENGTH)
    return bad_property(f, name, "has no number of columns");
  while (--k != OTHER && !packing_i_word_is(name, known[k].name))
    ;
  if (k != OTHER && (known[k].letter != *letter.at || known[k].columns != count))
    return bad_property(f, name, "has another type or number of columns than it should");
  if (k != OTHER && (f->present >> k & 1))
    return bad_property(f, name, "stands twice");
  if (f->properties == MOST_PROPERTIES)
    return bad_property(f, name, "is one too many");
  f->present |= 1U << k;
  f->list[f->properties].kind = k;
  f->list[f->properties++].columns = (unsigned)count;
  return PACKING_OK;
}

static packing_status read_properties(frame *f, packing_i_words text)
{
  while (text.at < text.end)
    PACKING_I_TRY(read_property(f, &text));
  return PACKING_OK;
}

/* Vectors a, b, c, as the edges of a box, or of a tilted one. */
static packing_status read_lattice(frame *f, packing_i_words text, double side[3])
{
  double m[9];
  packing_read_info *info = &f->read->info;
  PACKING_I_TRY(packing_i_words_doubles(f->read, &text, "Lattice", 9, m));
  PACKING_I_TRY(packing_i_words_done(f->read, &text));
  if (m[1] != 0 || m[2] != 0 || m[5] != 0)
    return packing_i_read_fail(
        f->read, PACKING_ERR_FORMAT,
        "Lattice: a does not point along x, or b out of the plane of x and y");
  for (size_t k = 0; k < 3; k++)
    side[k] = m[4 * k];
  info->tilt.x = m[3];
  info->tilt.y = m[6];
  info->tilt.z = m[7];
  info->has_box = 1;
  return PACKING_OK;
}

static packing_status read_pbc(frame *f, packing_i_words text)
{
  packing_read_info *info = &f->read->info;
  info->periodic = 0;
  for (unsigned k = 0; k < 3; k++) {
    const packing_i_words word = packing_i_words_take(&text);
    if (packing_i_word_is(word, "T") || packing_i_word_is(word, "1"))
      info->periodic |= 1U << k;
    else if (!packing_i_word_is(word, "F") && !packing_i_word_is(word, "0"))
      return packing_i_read_fail(f->read, PACKING_ERR_FORMAT,
                                 "pbc is not three of T and F");
  }
  info->has_periodic = 1;
  return packing_i_words_done(f->read, &text);
}

static packing_status read_time(frame *f, packing_i_words text)
{
  f->read->info.has_time = 1;
  PACKING_I_TRY(packing_i_words_double(f->read, &text, "Time", &f->read->info.time));
  return packing_i_words_done(f->read, &text);
}

/* What follows a key: in quotes, or up to a blank. */
static packing_status take_value(const frame *f, packing_i_words *words,
                                 packing_i_words *value)
{
  if (words->at == words->end || *words->at != '"') {
    *value = *words;
    while (words->at < words->end && *words->at != ' ' && *words->at != '\t')
      words->at++;
    value->end = words->at;
    return PACKING_OK;
  }
  words->at++;
  const int closed = memchr(words->at, '"', (size_t)(words->end - words->at)) != NULL;
  *value = take_to(words, '"');
  return closed ? PACKING_OK
                : packing_i_read_fail(f->read, PACKING_ERR_FORMAT, "an open quote");
}

/* The next `key`, `key=value` or `key="value"`. */
static packing_status take_pair(const frame *f, packing_i_words *words,
                                packing_i_words *key, packing_i_words *value)
{
  *key = *words;
  while (words->at < words->end && *words->at != '=' && *words->at != ' ' &&
         *words->at != '\t' && *words->at != '"')
    words->at++;
  key->end = words->at;
  value->at = value->end = words->at;
  if (words->at < words->end && *words->at == '=') {
    words->at++;
    return take_value(f, words, value);
  }
  if (key->at == key->end)
    return packing_i_read_fail(f->read, PACKING_ERR_FORMAT, "a quote without a key");
  return PACKING_OK;
}

static packing_status use_pair(frame *f, packing_i_words key, packing_i_words value,
                               double side[3], double origin[3])
{
  if (packing_i_word_is(key, "Properties"))
    return read_properties(f, value);
  if (packing_i_word_is(key, "Lattice"))
    return read_lattice(f, value, side);
  if (packing_i_word_is(key, "Origin")) {
    PACKING_I_TRY(packing_i_words_doubles(f->read, &value, "Origin", 3, origin));
    return packing_i_words_done(f->read, &value);
  }
  if (packing_i_word_is(key, "pbc"))
    return read_pbc(f, value);
  return packing_i_word_is(key, "Time") ? read_time(f, value) : PACKING_OK;
}

static packing_status read_keys(frame *f, packing_i_words words)
{
  double side[3] = {0, 0, 0}, origin[3] = {0, 0, 0}, end[3];
  packing_i_words key, value;
  while (!packing_i_words_ended(&words)) {
    PACKING_I_TRY(take_pair(f, &words, &key, &value));
    PACKING_I_TRY(use_pair(f, key, value, side, origin));
  }
  for (int k = 0; k < 3; k++)
    end[k] = origin[k] + side[k];
  return f->read->info.has_box ? packing_i_read_box(f->read, origin, end) : PACKING_OK;
}

/* What the properties ask of the store. */
static packing_status understand(frame *f)
{
  const unsigned p = f->present;
  if (!(p >> POS & 1))
    return packing_i_read_fail(f->read, PACKING_ERR_FORMAT, "Properties: no pos");
  if (!(p >> RADIUS & 1) && !(p >> DIAMETER & 1))
    return packing_i_read_fail(f->read, PACKING_ERR_FORMAT,
                               "Properties: no radius or diameter");
  f->store = (p >> ID & 1 ? PACKING_COLUMN_ID : 0U) |
             (p >> TYPE & 1 ? PACKING_COLUMN_TYPE : 0U) |
             (p >> VELO & 1 ? PACKING_COLUMN_VELOCITY : 0U) |
             (p >> SPIN & 1 ? PACKING_COLUMN_SPIN : 0U) |
             (p >> TURN & 1 ? PACKING_COLUMN_ORIENTATION : 0U);
  if (f->number == 0 || f->read->def.frame >= 0)
    f->first_store = f->store;
  if (f->store != f->first_store)
    return packing_i_read_fail(f->read, PACKING_ERR_FORMAT,
                               "other columns than in the first frame");
  return packing_i_read_columns(f->read, f->store);
}

/* Forgets what the frame before told. */
static packing_status start_frame(frame *f, packing_i_words words)
{
  const packing_read_info fresh = {0};
  packing_i_read_restart(f->read);
  f->read->info = fresh;
  f->properties = 0;
  f->present = 0;
  PACKING_I_TRY(read_keys(f, words));
  return understand(f);
}

/* Numbers of a property to where they belong. */
static void place(const frame *f, kind k, const double *v, packing_i_row *row)
{
  switch (k) {
  case POS:
    row->x = v[0];
    row->y = v[1];
    row->z = v[2];
    break;
  case VELO:
    memcpy(row->v, v, sizeof row->v);
    break;
  case SPIN:
    memcpy(row->w, v, sizeof row->w);
    break;
  case TURN:
    row->q[0] = v[3];
    memcpy(&row->q[1], v, 3 * sizeof *v);
    break;
  case RADIUS:
    row->r = v[0];
    break;
  default:
    if (!(f->present >> RADIUS & 1))
      row->r = v[0] / 2;
  }
}

static packing_status read_cell(const frame *f, unsigned property, packing_i_words *words,
                                packing_i_row *row)
{
  const packing_i_read *r = f->read;
  double v[4];
  const kind k = f->list[property].kind;
  if (k == ID)
    return packing_i_words_int(r, words, "id", INT64_MIN, INT64_MAX, &row->id);
  if (k == TYPE)
    return packing_i_words_int32(r, words, "type", INT32_MIN, INT32_MAX, &row->type);
  PACKING_I_TRY(
      packing_i_words_doubles(r, words, known[k].name, (unsigned)known[k].columns, v));
  place(f, k, v, row);
  return PACKING_OK;
}

static packing_status skip_cells(const frame *f, unsigned count, packing_i_words *words)
{
  for (unsigned c = 0; c < count; c++) {
    if (packing_i_words_ended(words))
      return packing_i_read_fail(f->read, PACKING_ERR_FORMAT,
                                 "fewer columns than Properties names");
    (void)packing_i_words_take(words);
  }
  return PACKING_OK;
}

static packing_status read_row(frame *f, packing_i_words *words)
{
  packing_i_row *row = packing_i_read_row(f->read);
  for (unsigned p = 0; p < f->properties; p++)
    if (f->list[p].kind == OTHER)
      PACKING_I_TRY(skip_cells(f, f->list[p].columns, words));
    else
      PACKING_I_TRY(read_cell(f, p, words, row));
  PACKING_I_TRY(packing_i_words_done(f->read, words));
  return packing_i_read_take(f->read);
}

static packing_status read_frame(frame *f, packing_i_words words)
{
  const int wanted = packing_i_read_wants(f->read, f->number);
  int64_t count;
  PACKING_I_TRY(packing_i_words_int(f->read, &words, "count", 0, INT64_MAX, &count));
  PACKING_I_TRY(packing_i_words_done(f->read, &words));
  PACKING_I_TRY(packing_i_read_needed(f->read, "the line of properties", &words));
  if (wanted)
    PACKING_I_TRY(start_frame(f, words));
  for (int64_t i = 0; i < count; i++) {
    PACKING_I_TRY(packing_i_read_needed(f->read, "its last row", &words));
    if (wanted)
      PACKING_I_TRY(read_row(f, &words));
  }
  f->number++;
  return wanted ? packing_i_read_flush(f->read) : PACKING_OK;
}

static packing_status read_xyz(packing_i_read *read)
{
  packing_i_words words;
  frame f = {0};
  f.read = read;
  read->lines.keep_comments = 1;
  PACKING_I_TRY(packing_i_read_needed(read, "its first line", &words));
  while (words.at != NULL) {
    PACKING_I_TRY(read_frame(&f, words));
    PACKING_I_TRY(packing_i_read_line(read, &words));
  }
  read->info.frames = f.number;
  return PACKING_OK;
}

const packing_i_reader packing_i_reader_xyz = {
    {"xyz", ".xyz .extxyz", "extended XYZ, github.com/libAtoms/extxyz; ASE, OVITO",
     "centre, radius or diameter, id, type, velocity, spin, orientation, cell, periodic "
     "directions, time, frames"},
    PACKING_I_READS_LINES,
    read_xyz};
