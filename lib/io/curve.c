/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a grading curve, as a sieve analysis gives it: diameters and the share passing. The
 * header says whether shares are percent or parts of 1. Whatever the table leaves open is
 * refused, with the line: a first row above 0 (how are the fines?), a last row below all
 * (truncated). */
#include "io_internal.h"

const packing_i_format packing_i_format_curve = {
    "curve", "", "the library's own; doc/methods/formats.md",
    "a size distribution by mass or number, over the diameter"};

enum { MOST_ROWS = 100000 };
enum { DIAMETER, PERCENT, SHARE, COLUMNS };

static const packing_i_table_spec specs[COLUMNS] = {
    {"diameter", PACKING_I_TABLE_REAL},
    {"percent_passing", PACKING_I_TABLE_REAL},
    {"passing", PACKING_I_TABLE_REAL},
};

void packing_read_curve_def_fill(packing_read_curve_def *def, size_t size)
{
  packing_read_curve_def defaults = {0};
  defaults.by = PACKING_BY_MASS;
  defaults.dim = 3;
  defaults.scale = 1;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

typedef struct curve {
  packing_i_table table;
  const packing_allocator *allocator;
  double scale;
  unsigned diameter, passing; /* which column is which */
  double whole;               /* what all passing is: 100 or 1 */
  size_t count, capacity;
  double *d, *share;
} curve;

static packing_status understand(curve *c)
{
  const uint32_t present = c->table.present;
  const unsigned passing = present >> PERCENT & 1 ? PERCENT : SHARE;
  if (c->table.columns != 2 || !(present >> DIAMETER & 1))
    return packing_i_lines_fail(
        &c->table.lines, PACKING_ERR_FORMAT,
        "the header must be diameter,percent_passing or diameter,passing");
  c->diameter = packing_i_table_column(&c->table, DIAMETER);
  c->passing = packing_i_table_column(&c->table, passing);
  c->whole = passing == PERCENT ? 100 : 1;
  return PACKING_OK;
}

static packing_status check_row(const curve *c, double d, double passing)
{
  const packing_i_lines *lines = &c->table.lines;
  const double scaled = d * c->scale;
  if (!(d > 0))
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT, "diameter %g must be above 0",
                                d);
  PACKING_I_TRY(packing_i_check_scaled(lines, "diameter", d, scaled));
  if (!(passing >= 0 && passing <= c->whole))
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT,
                                "%g passing is not within 0 to %g", passing, c->whole);
  if (c->count == 0)
    return passing == 0 ? PACKING_OK
                        : packing_i_lines_fail(lines, PACKING_ERR_FORMAT,
                                               "the first row passes %g, not 0", passing);
  if (!(scaled > c->d[c->count - 1]))
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT,
                                "diameter %g does not rise above %g", d,
                                c->d[c->count - 1] / c->scale);
  if (passing / c->whole < c->share[c->count - 1])
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT,
                                "descending: %g passing after %g", passing,
                                c->share[c->count - 1] * c->whole);
  return PACKING_OK;
}

static packing_status grow(curve *c)
{
  const size_t capacity = c->capacity == 0 ? 64 : 2 * c->capacity;
  double *both = packing_i_alloc(c->allocator, capacity, 2 * sizeof *both);
  if (both == NULL)
    return packing_i_nomem(c->table.lines.context);
  for (size_t i = 0; i < c->count; i++) {
    both[i] = c->d[i];
    both[capacity + i] = c->share[i];
  }
  packing_i_free(c->allocator, c->d);
  c->d = both;
  c->share = both + capacity;
  c->capacity = capacity;
  return PACKING_OK;
}

static packing_status read_rows(curve *c)
{
  packing_i_table_cell cells[2];
  int got;
  for (;;) {
    PACKING_I_TRY(packing_i_table_row(&c->table, cells, 1, &got));
    if (!got)
      return PACKING_OK;
    const double d = cells[c->diameter].real, passing = cells[c->passing].real;
    PACKING_I_TRY(check_row(c, d, passing));
    if (c->count == MOST_ROWS)
      return packing_i_lines_fail(&c->table.lines, PACKING_ERR_FORMAT,
                                  "more than %d rows", MOST_ROWS);
    if (c->count == c->capacity)
      PACKING_I_TRY(grow(c));
    c->d[c->count] = d * c->scale;
    c->share[c->count++] = passing / c->whole;
  }
}

static packing_status check_end(curve *c)
{
  c->table.lines.number--; /* the last line there was, not the end behind it */
  if (c->count == 0)
    return packing_i_lines_fail(&c->table.lines, PACKING_ERR_FORMAT,
                                "truncated: no row follows the header");
  if (c->share[c->count - 1] != 1)
    return packing_i_lines_fail(&c->table.lines, PACKING_ERR_FORMAT,
                                "truncated: the last row passes %g, not %g",
                                c->share[c->count - 1] * c->whole, c->whole);
  return PACKING_OK;
}

static packing_status read_curve(curve *c)
{
  PACKING_I_TRY(packing_i_table_header(&c->table));
  PACKING_I_TRY(understand(c));
  PACKING_I_TRY(read_rows(c));
  return check_end(c);
}

packing_status packing_read_curve(packing_context *context,
                                  const packing_read_curve_def *def,
                                  const packing_stream *stream, packing_psd **psd)
{
  packing_read_curve_def d;
  curve c = {0};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_read_curve, scale, def, &d));
  PACKING_I_TRY(packing_i_check_positive(context, "scale", d.scale));
  if (psd == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "psd", PACKING_NO_INDEX, "NULL");
  c.allocator = packing_i_allocator(context);
  c.scale = d.scale;
  PACKING_I_TRY(packing_i_table_begin(&c.table, context, &packing_i_format_curve, stream,
                                      specs, COLUMNS));
  packing_status status = read_curve(&c);
  if (status == PACKING_OK) {
    packing_psd_curve_def law;
    packing_psd_curve_def_init(&law);
    law.count = c.count;
    law.diameter_d = c.d;
    law.passing = c.share;
    law.by = d.by;
    law.dim = d.dim;
    status = packing_psd_create_curve(context, &law, psd);
  }
  packing_i_free(c.allocator, c.d);
  packing_i_table_end(&c.table);
  return status;
}
