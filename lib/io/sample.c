/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a list of measured radii, one a line. */
#include "io_internal.h"

const packing_i_format packing_i_format_sample = {
    "sample", "", "the library's own; doc/methods/formats.md",
    "radii, as a size distribution"};

enum { MOST_RADII = 100000000 };

static const packing_i_table_spec radius[] = {{"r", PACKING_I_TABLE_REAL}};

void packing_read_sample_def_fill(packing_read_sample_def *def, size_t size)
{
  packing_read_sample_def defaults = {0};
  defaults.by = PACKING_BY_NUMBER;
  defaults.dim = 3;
  defaults.scale = 1;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

typedef struct sample {
  packing_i_table table;
  const packing_allocator *allocator;
  size_t count, capacity;
  double *r;
} sample;

static packing_status add(sample *s, double r, double scale)
{
  const packing_i_lines *lines = &s->table.lines;
  if (!(r > 0))
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT, "r: %g must be above 0", r);
  PACKING_I_TRY(packing_i_check_scaled(lines, "r", r, r * scale));
  if (s->count == MOST_RADII)
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT, "more than %d radii",
                                MOST_RADII);
  if (s->count == s->capacity) {
    const size_t capacity = s->capacity == 0 ? 1024 : 2 * s->capacity;
    double *grown =
        packing_i_regrow(s->allocator, s->r, s->count, capacity, sizeof *grown);
    if (grown == NULL)
      return packing_i_nomem(lines->context);
    s->r = grown;
    s->capacity = capacity;
  }
  s->r[s->count++] = r * scale;
  return PACKING_OK;
}

static packing_status read_radii(sample *s, double scale)
{
  packing_i_table_cell cell;
  int got;
  for (;;) {
    PACKING_I_TRY(packing_i_table_row(&s->table, &cell, 1, &got));
    if (!got)
      break;
    PACKING_I_TRY(add(s, cell.real, scale));
  }
  if (s->count > 0)
    return PACKING_OK;
  return packing_i_lines_fail(&s->table.lines, PACKING_ERR_FORMAT, "no radius");
}

packing_status packing_read_sample(packing_context *context,
                                   const packing_read_sample_def *def,
                                   const packing_stream *stream, packing_psd **psd)
{
  packing_read_sample_def d;
  sample s = {0};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_read_sample, scale, def, &d));
  PACKING_I_TRY(packing_i_check_positive(context, "scale", d.scale));
  if (psd == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "psd", PACKING_NO_INDEX, "NULL");
  s.allocator = packing_i_allocator(context);
  PACKING_I_TRY(packing_i_table_begin(&s.table, context, &packing_i_format_sample, stream,
                                      radius, 1));
  s.table.columns = 1; /* there is no header */
  s.table.lines.skip_blank = 1;
  packing_status status = read_radii(&s, d.scale);
  if (status == PACKING_OK) {
    packing_psd_sample_def law;
    packing_psd_sample_def_init(&law);
    law.count = s.count;
    law.r = s.r;
    law.bandwidth = d.bandwidth;
    law.by = d.by;
    law.dim = d.dim;
    status = packing_psd_create_sample(context, &law, psd);
  }
  packing_i_free(s.allocator, s.r);
  packing_i_table_end(&s.table);
  return status;
}
