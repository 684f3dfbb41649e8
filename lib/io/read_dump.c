/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text dumps of LAMMPS and LIGGGHTS (dump custom, docs.lammps.org): frames of items, columns by
 * name, rows in any order. Positions stand as x, unwrapped as xu, scaled as xs, or both as xsu;
 * the bounds of a tilted box are those of its corners. Frames that are not wanted are passed
 * over line by line, the others read, so that the last one needs no second pass. Linear in the
 * bytes, in constant memory. */
#include "read_internal.h"

enum { MOST_COLUMNS = 256 };

typedef enum field {
  NOTHING,
  ID,
  TYPE,
  RADIUS,
  DIAMETER,
  VX,
  VY,
  VZ,
  WX,
  WY,
  WZ,
  X,
  Y,
  Z,
  XU,
  YU,
  ZU,
  XS,
  YS,
  ZS,
  XSU,
  YSU,
  ZSU,
  FIELDS
} field;

static const char *const names[FIELDS] = {
    [ID] = "id",     [TYPE] = "type", [RADIUS] = "radius", [DIAMETER] = "diameter",
    [VX] = "vx",     [VY] = "vy",     [VZ] = "vz",         [WX] = "omegax",
    [WY] = "omegay", [WZ] = "omegaz", [X] = "x",           [Y] = "y",
    [Z] = "z",       [XU] = "xu",     [YU] = "yu",         [ZU] = "zu",
    [XS] = "xs",     [YS] = "ys",     [ZS] = "zs",         [XSU] = "xsu",
    [YSU] = "ysu",   [ZSU] = "zsu"};

typedef struct dump {
  packing_i_read *read;
  size_t frame; /* the one at hand */
  int64_t count;
  int has_step, has_time, has_count, has_box; /* of this frame */
  double lo[3], side[3], tilt[3];             /* tilt: xy xz yz */
  unsigned columns;
  uint8_t fields[MOST_COLUMNS];
  uint32_t present;            /* bit f: field f has a column */
  field centre;                /* X, XU, XS or XSU: where positions are taken from */
  unsigned store, first_store; /* PACKING_COLUMN_ of this and of the first frame */
} dump;

static int has(const dump *d, field f)
{
  return (int)(d->present >> f & 1);
}

static packing_status read_number_line(dump *d, const char *what, double *v)
{
  packing_i_words words;
  PACKING_I_TRY(packing_i_read_needed(d->read, what, &words));
  PACKING_I_TRY(packing_i_words_double(d->read, &words, what, v));
  return packing_i_words_done(d->read, &words);
}

/* A time goes before the number of a step, in whatever order they stand. */
static packing_status read_time(dump *d, const char *what, int is_step)
{
  packing_read_info *info = &d->read->info;
  double v;
  PACKING_I_TRY(read_number_line(d, what, &v));
  if (!packing_i_read_wants(d->read, d->frame) || (is_step && d->has_time))
    return PACKING_OK;
  d->has_time = !is_step;
  info->time = v;
  info->has_time = 1;
  return PACKING_OK;
}

static packing_status read_count(dump *d)
{
  packing_i_words words;
  PACKING_I_TRY(packing_i_read_needed(d->read, "the number of atoms", &words));
  PACKING_I_TRY(
      packing_i_words_int(d->read, &words, "number of atoms", 0, INT64_MAX, &d->count));
  d->has_count = 1;
  return packing_i_words_done(d->read, &words);
}

/* The edges, `pp pp ff` and the like, if they are named; two letters of p f s m each. */
static packing_status read_edges(dump *d, packing_i_words *words)
{
  packing_read_info *info = &d->read->info;
  info->has_periodic = 0;
  info->periodic = 0;
  if (packing_i_words_ended(words))
    return PACKING_OK;
  for (unsigned k = 0; k < 3; k++) {
    const packing_i_words edge = packing_i_words_take(words);
    if (edge.end - edge.at != 2 || strchr("pfsm", edge.at[0]) == NULL ||
        strchr("pfsm", edge.at[1]) == NULL || edge.at[0] == '\0' || edge.at[1] == '\0')
      return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                                 "BOX BOUNDS names no edges along %c", "xyz"[k]);
    if (edge.at[0] == 'p' && edge.at[1] == 'p')
      info->periodic |= 1U << k;
  }
  info->has_periodic = 1;
  return packing_i_words_done(d->read, words);
}

static double least(double a, double b)
{
  return a < b ? a : b;
}

/* From the bounds of all corners to those of the box (docs.lammps.org, Howto_triclinic). */
static void take_off_tilt(const dump *d, double lo[3], double hi[3])
{
  const double xy = d->tilt[0], xz = d->tilt[1], yz = d->tilt[2];
  lo[0] -= least(least(0, xy), least(xz, xy + xz));
  hi[0] += least(least(0, -xy), least(-xz, -(xy + xz)));
  lo[1] -= least(0, yz);
  hi[1] += least(0, -yz);
}

static packing_status skip_box(dump *d)
{
  packing_i_words words;
  for (int k = 0; k < 3; k++)
    PACKING_I_TRY(packing_i_read_needed(d->read, "the bounds of the box", &words));
  return PACKING_OK;
}

static packing_status read_box(dump *d, packing_i_words words)
{
  packing_i_read *r = d->read;
  double lo[3], hi[3];
  const int tilted = packing_i_words_begin(&words, "xy xz yz");
  d->has_box = 1;
  if (!packing_i_read_wants(r, d->frame))
    return skip_box(d);
  PACKING_I_TRY(read_edges(d, &words));
  for (int k = 0; k < 3; k++) {
    PACKING_I_TRY(packing_i_read_needed(r, "the bounds of the box", &words));
    PACKING_I_TRY(packing_i_words_double(r, &words, "lower bound", &lo[k]));
    PACKING_I_TRY(packing_i_words_double(r, &words, "upper bound", &hi[k]));
    d->tilt[k] = 0;
    if (tilted)
      PACKING_I_TRY(packing_i_words_double(r, &words, "tilt", &d->tilt[k]));
    PACKING_I_TRY(packing_i_words_done(r, &words));
  }
  take_off_tilt(d, lo, hi);
  PACKING_I_TRY(packing_i_read_box(r, lo, hi));
  const packing_vec3 tilt = {d->tilt[0], d->tilt[1], d->tilt[2]};
  r->info.tilt = tilt;
  for (int k = 0; k < 3; k++) {
    d->lo[k] = lo[k];
    d->side[k] = hi[k] - lo[k];
  }
  return PACKING_OK;
}

/* A vector comes whole, or not at all. */
static packing_status check_vector(dump *d, field first, unsigned column)
{
  const uint32_t whole = UINT32_C(7) << first;
  if ((d->present & whole) == 0)
    return PACKING_OK;
  for (field f = first; f < first + 3; f++)
    if (!has(d, f))
      return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "column %s is missing",
                                 names[f]);
  d->store |= column;
  return PACKING_OK;
}

/* Positions of the first kind that is there whole; z may be missing in two dimensions. */
static packing_status choose_centre(dump *d)
{
  static const field kinds[] = {X, XU, XS, XSU};
  for (unsigned needed = 3; needed >= 2; needed--)
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
      if ((d->present >> kinds[k] & ((1U << needed) - 1)) == (1U << needed) - 1) {
        d->centre = kinds[k];
        if (needed == 2)
          d->read->info.dim = 2;
        return PACKING_OK;
      }
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                             "no columns x y z, xu yu zu, xs ys zs or xsu ysu zsu");
}

static packing_status understand(dump *d)
{
  d->store = 0;
  if (has(d, ID))
    d->store |= PACKING_COLUMN_ID;
  if (has(d, TYPE))
    d->store |= PACKING_COLUMN_TYPE;
  PACKING_I_TRY(check_vector(d, VX, PACKING_COLUMN_VELOCITY));
  PACKING_I_TRY(check_vector(d, WX, PACKING_COLUMN_SPIN));
  if (!has(d, RADIUS) && !has(d, DIAMETER))
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                               "no column radius or diameter");
  d->read->info.dim = 0;
  return choose_centre(d);
}

static packing_status read_names(dump *d, packing_i_words words)
{
  d->present = 0;
  for (d->columns = 0; !packing_i_words_ended(&words); d->columns++) {
    const packing_i_words name = packing_i_words_take(&words);
    if (d->columns == MOST_COLUMNS)
      return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "more than %d columns",
                                 (int)MOST_COLUMNS);
    field f = FIELDS;
    while (--f != NOTHING && !packing_i_word_is(name, names[f]))
      ;
    if (f != NOTHING && has(d, f))
      return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "column %s stands twice",
                                 names[f]);
    d->fields[d->columns] = (uint8_t)f;
    d->present |= UINT32_C(1) << f;
  }
  return understand(d);
}

static packing_status read_cells(dump *d, packing_i_words *words, packing_i_row *row,
                                 double *cells)
{
  char quote[PACKING_I_QUOTE_SIZE];
  for (unsigned c = 0; c < d->columns; c++) {
    const field f = (field)d->fields[c];
    if (f == ID)
      PACKING_I_TRY(
          packing_i_words_int(d->read, words, "id", INT64_MIN, INT64_MAX, &row->id));
    else if (f == TYPE)
      PACKING_I_TRY(packing_i_words_int32(d->read, words, "type", INT32_MIN, INT32_MAX,
                                          &row->type));
    else if (f != NOTHING)
      PACKING_I_TRY(packing_i_words_double(d->read, words, names[f], &cells[f]));
    else if (packing_i_words_ended(words))
      return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                                 "%u words, the columns are %u", c, d->columns);
    else
      (void)packing_i_words_take(words);
  }
  if (packing_i_words_ended(words))
    return PACKING_OK;
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "%s behind the %u columns",
                             packing_i_quote(words->at, words->end, quote), d->columns);
}

static void place(const dump *d, const double *cells, packing_i_row *row)
{
  const double x = cells[d->centre], y = cells[d->centre + 1], z = cells[d->centre + 2];
  if (d->centre == XS || d->centre == XSU) {
    row->x = d->lo[0] + x * d->side[0] + y * d->tilt[0] + z * d->tilt[1];
    row->y = d->lo[1] + y * d->side[1] + z * d->tilt[2];
    row->z = d->read->info.dim == 2 ? 0 : d->lo[2] + z * d->side[2];
  } else {
    row->x = x;
    row->y = y;
    row->z = z;
  }
}

static packing_status read_row(dump *d, packing_i_words *words)
{
  packing_i_row *row = packing_i_read_row(d->read);
  double cells[FIELDS] = {0};
  PACKING_I_TRY(read_cells(d, words, row, cells));
  place(d, cells, row);
  row->r = has(d, RADIUS) ? cells[RADIUS] : cells[DIAMETER] / 2;
  for (int k = 0; k < 3; k++) {
    row->v[k] = cells[VX + k];
    row->w[k] = cells[WX + k];
  }
  return packing_i_read_take(d->read);
}

/* The store cannot lose columns that an earlier frame brought. */
static packing_status take_columns(dump *d)
{
  if (d->frame == 0 || d->read->def.frame >= 0)
    d->first_store = d->store;
  if (d->store != d->first_store)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                               "other columns than in the first frame");
  return packing_i_read_columns(d->read, d->store);
}

static packing_status read_rows(dump *d, packing_i_words words)
{
  const int wanted = packing_i_read_wants(d->read, d->frame);
  if (!d->has_step || !d->has_count || !d->has_box)
    return packing_i_read_fail(d->read, PACKING_ERR_FORMAT,
                               "ATOMS before TIMESTEP, NUMBER OF ATOMS or BOX BOUNDS");
  if (wanted) {
    packing_i_read_restart(d->read);
    PACKING_I_TRY(read_names(d, words));
    PACKING_I_TRY(take_columns(d));
  }
  for (int64_t i = 0; i < d->count; i++) {
    PACKING_I_TRY(packing_i_read_needed(d->read, "the last atom", &words));
    if (wanted)
      PACKING_I_TRY(read_row(d, &words));
  }
  d->has_step = d->has_time = d->has_count = d->has_box = 0;
  d->read->info.frames = ++d->frame;
  return wanted ? packing_i_read_flush(d->read) : PACKING_OK;
}

static packing_status read_item(dump *d, packing_i_words words)
{
  char quote[PACKING_I_QUOTE_SIZE];
  packing_i_words line = words;
  if (packing_i_words_are(words, "ITEM: TIMESTEP")) {
    PACKING_I_TRY(read_time(d, "time step", 1));
    d->has_step = 1;
    return PACKING_OK;
  }
  if (packing_i_words_are(words, "ITEM: TIME"))
    return read_time(d, "time", 0);
  if (packing_i_words_are(words, "ITEM: UNITS"))
    return packing_i_read_needed(d->read, "units", &words);
  if (packing_i_words_are(words, "ITEM: NUMBER OF ATOMS"))
    return read_count(d);
  if (packing_i_words_begin(&words, "ITEM: BOX BOUNDS"))
    return read_box(d, words);
  if (packing_i_words_begin(&words, "ITEM: ATOMS"))
    return read_rows(d, words);
  return packing_i_read_fail(d->read, PACKING_ERR_FORMAT, "%s is no item of a dump",
                             packing_i_quote(line.at, line.end, quote));
}

static packing_status read_dump(packing_i_read *read)
{
  packing_i_words words;
  dump d = {0};
  d.read = read;
  read->lines.keep_comments = 1;
  PACKING_I_TRY(packing_i_read_needed(read, "its first item", &words));
  while (words.at != NULL) {
    PACKING_I_TRY(read_item(&d, words));
    PACKING_I_TRY(packing_i_read_line(read, &words));
  }
  if (d.frame == 0 || d.has_step || d.has_count || d.has_box)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "the file ends before the atoms of frame %zu", d.frame);
  return PACKING_OK;
}

const packing_i_reader packing_i_reader_dump = {
    {"dump", ".dump .lammpstrj", "LAMMPS and LIGGGHTS, dump custom (text)",
     "centre, radius or diameter, id, type, velocity, spin, box, edges, frames"},
    PACKING_I_READS_LINES,
    read_dump};
