/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comma-separated tables of numbers: a header of known names, rows of as many numbers. */
#include "io_internal.h"
#include <string.h>

packing_status packing_i_table_begin(packing_i_table *table, packing_context *context,
                                     const packing_i_format *format,
                                     const packing_stream *stream,
                                     const packing_i_table_spec *specs,
                                     unsigned spec_count)
{
  memset(table, 0, sizeof *table);
  table->specs = specs;
  table->spec_count = spec_count;
  return packing_i_lines_begin(&table->lines, context, format, stream);
}

void packing_i_table_end(packing_i_table *table)
{
  packing_i_lines_end(&table->lines);
}

static const char *skip_blanks(const char *p)
{
  while (*p == ' ' || *p == '\t')
    p++;
  return p;
}

/* A name of the header, from `at` to `end`. */
static packing_status take_name(packing_i_table *t, const char *at, const char *end)
{
  char quote[PACKING_I_QUOTE_SIZE];
  unsigned s = 0;
  at = skip_blanks(at);
  while (end > at && (end[-1] == ' ' || end[-1] == '\t'))
    end--;
  const size_t length = end > at ? (size_t)(end - at) : 0;
  while (s < t->spec_count && (strlen(t->specs[s].name) != length ||
                               memcmp(t->specs[s].name, at, length) != 0))
    s++;
  if (s == t->spec_count)
    return packing_i_lines_fail(&t->lines, PACKING_ERR_FORMAT, "unknown column %s",
                                packing_i_quote(at, at + length, quote));
  if (t->present >> s & 1)
    return packing_i_lines_fail(&t->lines, PACKING_ERR_FORMAT, "column %s stands twice",
                                t->specs[s].name);
  t->present |= UINT32_C(1) << s;
  t->spec_of[t->columns++] = (uint8_t)s;
  return PACKING_OK;
}

packing_status packing_i_table_header(packing_i_table *t)
{
  const char *at, *end;
  PACKING_I_TRY(packing_i_lines_next(&t->lines, &at, &end));
  if (at == NULL)
    return packing_i_lines_fail(&t->lines, PACKING_ERR_FORMAT, "no header line");
  for (;;) {
    const char *comma = memchr(at, ',', (size_t)(end - at));
    PACKING_I_TRY(take_name(t, at, comma == NULL ? end : comma));
    if (comma == NULL)
      return PACKING_OK;
    at = comma + 1;
  }
}

unsigned packing_i_table_column(const packing_i_table *t, unsigned spec)
{
  unsigned c = 0;
  while (c < t->columns && t->spec_of[c] != spec)
    c++;
  return c;
}

static packing_i_number parse_cell(packing_i_table_kind kind, const char **at,
                                   packing_i_table_cell *cell)
{
  int64_t n;
  if (kind == PACKING_I_TABLE_REAL)
    return packing_i_parse_double(at, &cell->real);
  const packing_i_number found = packing_i_parse_int(at, &n);
  if (found != PACKING_I_NUMBER_OK)
    return found;
  if (kind == PACKING_I_TABLE_INT64)
    cell->int64 = n;
  else if (n < INT32_MIN || n > INT32_MAX)
    return PACKING_I_NUMBER_LARGE;
  else
    cell->int32 = (int32_t)n;
  return PACKING_I_NUMBER_OK;
}

static unsigned count_cells(const char *at, const char *end)
{
  unsigned count = 1;
  for (; at < end; at++)
    count += *at == ',';
  return count;
}

/* What is wrong with the cell at `at`: `found` says what the number came to. */
static packing_status cell_fail(packing_i_table *t, unsigned column, const char *at,
                                const char *end, packing_i_number found)
{
  const packing_i_table_spec *spec = &t->specs[t->spec_of[column]];
  const char *comma = memchr(at, ',', (size_t)(end - at));
  return packing_i_number_fail(
      &t->lines, spec->name, at, comma == NULL ? end : comma, found,
      spec->kind == PACKING_I_TABLE_REAL ? "a finite number" : "a whole number");
}

static packing_status wrong_count(packing_i_table *t, const char *at, const char *end)
{
  const unsigned count = count_cells(at, end);
  return packing_i_lines_fail(&t->lines, PACKING_ERR_FORMAT,
                              "%u column%s, the header has %u", count,
                              count == 1 ? "" : "s", t->columns);
}

packing_status packing_i_table_row(packing_i_table *t, packing_i_table_cell *cells,
                                   size_t stride, int *got)
{
  const char *first, *end;
  PACKING_I_TRY(packing_i_lines_next(&t->lines, &first, &end));
  *got = first != NULL;
  if (!*got)
    return PACKING_OK;
  const char *p = skip_blanks(first);
  if (p == end && t->takes_blanks) {
    *got = PACKING_I_TABLE_BLANK;
    return PACKING_OK;
  }
  if (p == end)
    return packing_i_lines_fail(&t->lines, PACKING_ERR_FORMAT, "a blank line");
  for (unsigned c = 0;; c++) {
    const char *cell = p = skip_blanks(p);
    const packing_i_number found =
        parse_cell(t->specs[t->spec_of[c]].kind, &p, &cells[c * stride]);
    p = skip_blanks(p);
    if (found == PACKING_I_NUMBER_OK && *p == ',' && c + 1 < t->columns) {
      p++;
      continue;
    }
    if (found == PACKING_I_NUMBER_OK && p == end && c + 1 == t->columns)
      return PACKING_OK;
    if (count_cells(first, end) != t->columns)
      return wrong_count(t, first, end);
    return cell_fail(t, c, cell, end, found);
  }
}
