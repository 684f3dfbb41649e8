/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a polygon with holes: a vertex a row, rings one after the other. */
#include "io_internal.h"
#include <math.h>
#include <packing/solids.h>

const packing_i_format packing_i_format_polygon = {
    "polygon", "", "the library's own; doc/methods/formats.md",
    "a container: rings of vertices in the plane"};

enum { MOST_VERTICES = 10000000 };
enum { X, Y, RING, HOLE, COLUMNS };

static const packing_i_table_spec specs[COLUMNS] = {
    {"x", PACKING_I_TABLE_REAL},
    {"y", PACKING_I_TABLE_REAL},
    {"ring", PACKING_I_TABLE_INT64},
    {"hole", PACKING_I_TABLE_INT32},
};

void packing_read_polygon_def_fill(packing_read_polygon_def *def, size_t size)
{
  packing_read_polygon_def defaults = {.scale = 1};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

typedef struct rings {
  packing_i_table table;
  const packing_allocator *allocator;
  packing_read_polygon_def def;
  unsigned column[COLUMNS];
  size_t count, capacity; /* vertices */
  double *x, *y;
  size_t rings, ring_capacity;
  size_t *sizes;
  int *holes;
  int64_t ring; /* as the file numbers it */
  int is_open;  /* a ring has begun */
} rings;

static packing_status understand(rings *r)
{
  const uint32_t present = r->table.present;
  if (!(present >> X & 1) || !(present >> Y & 1))
    return packing_i_lines_fail(&r->table.lines, PACKING_ERR_FORMAT,
                                "the header must name x and y");
  for (unsigned i = 0; i < COLUMNS; i++)
    r->column[i] = packing_i_table_column(&r->table, i);
  return PACKING_OK;
}

static int has(const rings *r, unsigned column)
{
  return (int)(r->table.present >> column & 1);
}

static packing_status grow(rings *r)
{
  const size_t capacity = r->capacity == 0 ? 256 : 2 * r->capacity;
  double *x = packing_i_regrow(r->allocator, r->x, r->count, capacity, sizeof *x);
  if (x != NULL)
    r->x = x;
  double *y = packing_i_regrow(r->allocator, r->y, r->count, capacity, sizeof *y);
  if (y != NULL)
    r->y = y;
  if (x == NULL || y == NULL)
    return packing_i_nomem(r->table.lines.context);
  r->capacity = capacity;
  return PACKING_OK;
}

static packing_status begin_ring(rings *r, int hole)
{
  if (r->rings == r->ring_capacity) {
    const size_t capacity = r->ring_capacity == 0 ? 16 : 2 * r->ring_capacity;
    size_t *sizes =
        packing_i_regrow(r->allocator, r->sizes, r->rings, capacity, sizeof *sizes);
    if (sizes != NULL)
      r->sizes = sizes;
    int *holes =
        packing_i_regrow(r->allocator, r->holes, r->rings, capacity, sizeof *holes);
    if (holes != NULL)
      r->holes = holes;
    if (sizes == NULL || holes == NULL)
      return packing_i_nomem(r->table.lines.context);
    r->ring_capacity = capacity;
  }
  r->sizes[r->rings] = 0;
  r->holes[r->rings++] = hole;
  r->is_open = 1;
  return PACKING_OK;
}

/* The first vertex may stand again as the last. */
static packing_status end_ring(rings *r)
{
  if (!r->is_open)
    return PACKING_OK;
  size_t *size = &r->sizes[r->rings - 1];
  const size_t first = r->count - *size, last = r->count - 1;
  if (*size > 3 && r->x[first] == r->x[last] && r->y[first] == r->y[last]) {
    r->count--;
    --*size;
  }
  r->is_open = 0;
  if (*size < 3)
    return packing_i_lines_fail(&r->table.lines, PACKING_ERR_FORMAT,
                                "ring %zu ends with %zu vertices, at least 3 are needed",
                                r->rings, *size);
  return PACKING_OK;
}

static packing_status check_hole(const rings *r, int hole)
{
  const packing_i_lines *lines = &r->table.lines;
  if (hole != 0 && hole != 1)
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT, "hole: %d must be 0 or 1",
                                hole);
  if (hole != r->holes[r->rings - 1])
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT,
                                "hole: %d, but its ring began with %d", hole,
                                r->holes[r->rings - 1]);
  return PACKING_OK;
}

static packing_status take(rings *r, const packing_i_table_cell *cells)
{
  const packing_i_lines *lines = &r->table.lines;
  const double x = cells[r->column[X]].real, y = cells[r->column[Y]].real;
  const double sx = x * r->def.scale + r->def.offset.x;
  const double sy = y * r->def.scale + r->def.offset.y;
  const int hole = has(r, HOLE) ? cells[r->column[HOLE]].int32 : 0;
  if (has(r, RING) && r->is_open && cells[r->column[RING]].int64 != r->ring)
    PACKING_I_TRY(end_ring(r));
  if (!isfinite(sx) || !isfinite(sy))
    return packing_i_lines_fail(lines, PACKING_ERR_RANGE,
                                "scale: %g, %g times %g is %g, %g", x, y, r->def.scale,
                                sx, sy);
  if (r->count == MOST_VERTICES)
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT, "more than %d vertices",
                                MOST_VERTICES);
  if (!r->is_open)
    PACKING_I_TRY(begin_ring(r, hole));
  if (has(r, RING))
    r->ring = cells[r->column[RING]].int64;
  PACKING_I_TRY(check_hole(r, hole));
  if (r->count == r->capacity)
    PACKING_I_TRY(grow(r));
  r->x[r->count] = sx;
  r->y[r->count++] = sy;
  r->sizes[r->rings - 1]++;
  return PACKING_OK;
}

static packing_status read_rings(rings *r)
{
  packing_i_table_cell cells[COLUMNS];
  int got = 1;
  PACKING_I_TRY(packing_i_table_header(&r->table));
  PACKING_I_TRY(understand(r));
  while (got) {
    PACKING_I_TRY(packing_i_table_row(&r->table, cells, 1, &got));
    if (!got)
      r->table.lines.number--; /* the last line there was, not the end behind it */
    if (got == 1)
      PACKING_I_TRY(take(r, cells));
    else
      PACKING_I_TRY(end_ring(r));
  }
  if (r->rings > 0)
    return PACKING_OK;
  return packing_i_lines_fail(&r->table.lines, PACKING_ERR_FORMAT,
                              "truncated: no row follows the header");
}

static packing_status make(packing_context *context, const rings *r,
                           packing_domain **domain)
{
  packing_domain_polygon_def def;
  packing_domain_polygon_def_init(&def);
  def.count = r->count;
  def.x = r->x;
  def.y = r->y;
  def.rings = r->rings;
  def.sizes = r->sizes;
  def.holes = has(r, HOLE) ? r->holes : NULL;
  return packing_domain_create_polygon(context, &def, domain);
}

packing_status packing_read_polygon(packing_context *context,
                                    const packing_read_polygon_def *def,
                                    const packing_stream *stream, packing_domain **domain)
{
  static const char *const offset[] = {"offset.x", "offset.y", "offset.z"};
  rings r = {.allocator = packing_i_allocator(context)};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_read_polygon, offset, def, &r.def));
  PACKING_I_TRY(packing_i_check_positive(context, "scale", r.def.scale));
  PACKING_I_TRY(packing_i_check_point(context, offset, &r.def.offset));
  if (r.def.offset.z != 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "offset.z", PACKING_NO_INDEX,
                          "%g must be 0: the container lies in the plane z = 0",
                          r.def.offset.z);
  if (domain == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "domain", PACKING_NO_INDEX,
                          "NULL");
  PACKING_I_TRY(packing_i_table_begin(&r.table, context, &packing_i_format_polygon,
                                      stream, specs, COLUMNS));
  r.table.takes_blanks = 1;
  packing_status status = read_rings(&r);
  if (status == PACKING_OK)
    status = make(context, &r, domain);
  packing_i_free(r.allocator, r.x);
  packing_i_free(r.allocator, r.y);
  packing_i_free(r.allocator, r.sizes);
  packing_i_free(r.allocator, r.holes);
  packing_i_table_end(&r.table);
  return status;
}
