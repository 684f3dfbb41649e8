/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the table of csv.c into a store: columns by name, in any order; rows go over in
 * batches, so memory beside the store is constant. Linear in the bytes. */
#include "read_internal.h"
#include <string.h>

enum { BATCH = 1024 };

/* In the order of packing_field, so that a field is a bit of packing_i_table.present. */
static const packing_i_table_spec specs[PACKING_FIELD_END] = {
    {"x", PACKING_I_TABLE_REAL},          {"y", PACKING_I_TABLE_REAL},
    {"z", PACKING_I_TABLE_REAL},          {"r", PACKING_I_TABLE_REAL},
    {"id", PACKING_I_TABLE_INT64},        {"type", PACKING_I_TABLE_INT32},
    {"component", PACKING_I_TABLE_INT32}, {"vx", PACKING_I_TABLE_REAL},
    {"vy", PACKING_I_TABLE_REAL},         {"vz", PACKING_I_TABLE_REAL},
    {"wx", PACKING_I_TABLE_REAL},         {"wy", PACKING_I_TABLE_REAL},
    {"wz", PACKING_I_TABLE_REAL},         {"qw", PACKING_I_TABLE_REAL},
    {"qx", PACKING_I_TABLE_REAL},         {"qy", PACKING_I_TABLE_REAL},
    {"qz", PACKING_I_TABLE_REAL},
};

#define BIT(field) (UINT32_C(1) << PACKING_FIELD_##field)

/* Fields that stand for one optional column of the store: where one is there, so must the
 * needed ones be. A disc moves in its plane and spins about z. */
static const struct {
  unsigned column;
  uint32_t any, needed_3d, needed_2d;
} groups[] = {
    {PACKING_COLUMN_ID, BIT(ID), BIT(ID), BIT(ID)},
    {PACKING_COLUMN_TYPE, BIT(TYPE), BIT(TYPE), BIT(TYPE)},
    {PACKING_COLUMN_COMPONENT, BIT(COMPONENT), BIT(COMPONENT), BIT(COMPONENT)},
    {PACKING_COLUMN_VELOCITY, BIT(VX) | BIT(VY) | BIT(VZ), BIT(VX) | BIT(VY) | BIT(VZ),
     BIT(VX) | BIT(VY)},
    {PACKING_COLUMN_SPIN, BIT(WX) | BIT(WY) | BIT(WZ), BIT(WX) | BIT(WY) | BIT(WZ),
     BIT(WZ)},
    {PACKING_COLUMN_ORIENTATION, BIT(QW) | BIT(QX) | BIT(QY) | BIT(QZ),
     BIT(QW) | BIT(QX) | BIT(QY) | BIT(QZ), BIT(QW) | BIT(QX) | BIT(QY) | BIT(QZ)},
};

static packing_status need(const packing_i_table *t, uint32_t fields)
{
  for (unsigned s = 0; s < PACKING_FIELD_END; s++)
    if (fields >> s & ~t->present >> s & 1)
      return packing_i_lines_fail(&t->lines, PACKING_ERR_FORMAT, "column %s is missing",
                                  specs[s].name);
  return PACKING_OK;
}

/* What the header asks of the store. */
static packing_status understand(const packing_i_table *t, int *dim, unsigned *columns)
{
  PACKING_I_TRY(need(t, BIT(X) | BIT(Y) | BIT(R)));
  *dim = t->present & BIT(Z) ? 3 : 2;
  *columns = 0;
  for (size_t g = 0; g < sizeof groups / sizeof groups[0]; g++)
    if (t->present & groups[g].any) {
      PACKING_I_TRY(need(t, *dim == 3 ? groups[g].needed_3d : groups[g].needed_2d));
      *columns |= groups[g].column;
    }
  return PACKING_OK;
}

static packing_status check_row(const packing_i_table *t,
                                const packing_i_table_cell *cells, unsigned r)
{
  if (cells[(size_t)r * BATCH].real > 0)
    return PACKING_OK;
  return packing_i_lines_fail(&t->lines, PACKING_ERR_FORMAT, "r: %g must be above 0",
                              cells[(size_t)r * BATCH].real);
}

/* Shows the cells of a batch as a view. */
static void show(const packing_i_table *t, const packing_i_table_cell *cells,
                 packing_view *view)
{
  packing_view_init(view);
  packing_column *const columns[PACKING_FIELD_END] = {
      &view->x,         &view->y,  &view->z,  &view->r,  &view->id, &view->type,
      &view->component, &view->vx, &view->vy, &view->vz, &view->wx, &view->wy,
      &view->wz,        &view->qw, &view->qx, &view->qy, &view->qz};
  for (unsigned c = 0; c < t->columns; c++) {
    packing_column *column = columns[t->spec_of[c]];
    column->data = cells + (size_t)c * BATCH;
    column->stride = sizeof(packing_i_table_cell);
  }
}

static packing_status read_rows(packing_i_table *t, packing_i_table_cell *cells,
                                packing_particles *particles)
{
  const unsigned r = packing_i_table_column(t, PACKING_FIELD_R);
  packing_view batch;
  int got = 1;
  show(t, cells, &batch);
  while (got) {
    for (batch.count = 0; batch.count < BATCH; batch.count++) {
      PACKING_I_TRY(packing_i_table_row(t, cells + batch.count, BATCH, &got));
      if (!got)
        break;
      PACKING_I_TRY(check_row(t, cells + batch.count, r));
    }
    if (batch.count > 0)
      PACKING_I_TRY(packing_particles_append(particles, &batch));
  }
  return PACKING_OK;
}

/* A table without z may go to a store of three dimensions where `widen` says so. */
static packing_status read_table(packing_context *context, packing_i_table *t, int widen,
                                 packing_particles *particles, int *dim)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  unsigned columns;
  PACKING_I_TRY(packing_i_table_header(t));
  PACKING_I_TRY(understand(t, dim, &columns));
  if (*dim != packing_particles_dim(particles) && !(widen && *dim == 2))
    return packing_i_fail(context, PACKING_ERR_RANGE, "particles", PACKING_NO_INDEX,
                          "the table has dimension %d, the store %d", *dim,
                          packing_particles_dim(particles));
  PACKING_I_TRY(packing_particles_add_columns(particles, columns));
  packing_i_table_cell *cells =
      packing_i_alloc(allocator, (size_t)t->columns * BATCH, sizeof *cells);
  if (cells == NULL)
    return packing_i_nomem(context);
  const packing_status status = read_rows(t, cells, particles);
  packing_i_free(allocator, cells);
  return status;
}

static packing_status read_csv(packing_context *context, const packing_stream *stream,
                               int widen, packing_particles *particles, int *dim)
{
  packing_i_table table;
  PACKING_I_TRY(packing_i_table_begin(&table, context, &packing_i_format_csv, stream,
                                      specs, PACKING_FIELD_END));
  const packing_status status = read_table(context, &table, widen, particles, dim);
  packing_i_table_end(&table);
  return status;
}

static packing_status read_pack(packing_i_read *read)
{
  return read_csv(read->context, read->stream, 1, read->particles, &read->info.dim);
}

const packing_i_reader packing_i_reader_csv = {
    {"csv", ".csv", "libpacking, a table with a header", "all columns of a pack"},
    PACKING_I_READS_TABLE,
    read_pack};

packing_status packing_read_csv(packing_context *context, const packing_stream *stream,
                                packing_particles *particles)
{
  int dim;
  if (particles == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "particles", PACKING_NO_INDEX,
                          "NULL");
  if (packing_particles_count(particles) != 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "particles", PACKING_NO_INDEX,
                          "the store holds %zu particles, an empty one is needed",
                          packing_particles_count(particles));
  const packing_status status = read_csv(context, stream, 0, particles, &dim);
  if (status != PACKING_OK)
    packing_particles_truncate(particles, 0);
  return status;
}
