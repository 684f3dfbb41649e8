/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows on their way into the store, in batches. */
#include "read_internal.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#undef packing_i_read_fail /* the analyzer's */

packing_status packing_i_read_fail(const packing_i_read *read, packing_status status,
                                   const char *format, ...)
{
  char text[320];
  va_list arguments;
  va_start(arguments, format);
  if (vsnprintf(text, sizeof text, format, arguments) < 0)
    text[0] = '\0';
  va_end(arguments);
  if (read->reader->what == PACKING_I_READS_LINES)
    return packing_i_lines_fail(&read->lines, status, "%s", text);
  return packing_i_fail(read->context, status, NULL, (size_t)read->byte, "byte %llu: %s",
                        (unsigned long long)read->byte, text);
}

packing_i_row *packing_i_read_row(packing_i_read *read)
{
  packing_i_row *row = &read->rows[read->used];
  memset(row, 0, sizeof *row);
  row->q[0] = 1;
  row->type = 1;
  return row;
}

/* Text holds finite numbers only, binary parts any. */
static int all_finite(const double *v, int count)
{
  int finite = 1;
  for (int k = 0; k < count; k++)
    finite &= isfinite(v[k]) != 0;
  return finite;
}

packing_status packing_i_read_take(packing_i_read *read)
{
  const packing_i_row *row = &read->rows[read->used];
  if (!all_finite(row->v, 3) || !all_finite(row->w, 3) || !all_finite(row->q, 4))
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "a velocity, spin or orientation is not finite");
  if (!isfinite(row->x) || !isfinite(row->y) || !isfinite(row->z))
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "the centre (%g, %g, %g) is not finite", row->x, row->y,
                               row->z);
  if (!(row->r > 0 && isfinite(row->r)))
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "the radius %g must be above 0 and finite", row->r);
  if (row->z != 0 && packing_particles_dim(read->particles) == 2)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "z is %g, the store has two dimensions", row->z);
  read->used++;
  return read->used < PACKING_I_READ_BATCH ? PACKING_OK : packing_i_read_flush(read);
}

static packing_column column(const packing_i_read *read, const void *first)
{
  const packing_column c = {first, sizeof read->rows[0]};
  return c;
}

static void show(const packing_i_read *read, packing_view *view)
{
  const packing_i_row *row = read->rows;
  packing_view_init(view);
  view->count = read->used;
  view->x = column(read, &row->x);
  view->y = column(read, &row->y);
  view->z = column(read, &row->z);
  view->r = column(read, &row->r);
  view->id = column(read, &row->id);
  view->type = column(read, &row->type);
  view->component = column(read, &row->component);
  view->vx = column(read, &row->v[0]);
  view->vy = column(read, &row->v[1]);
  view->vz = column(read, &row->v[2]);
  view->wx = column(read, &row->w[0]);
  view->wy = column(read, &row->w[1]);
  view->wz = column(read, &row->w[2]);
  view->qw = column(read, &row->q[0]);
  view->qx = column(read, &row->q[1]);
  view->qy = column(read, &row->q[2]);
  view->qz = column(read, &row->q[3]);
}

packing_status packing_i_read_flush(packing_i_read *read)
{
  packing_view view;
  if (read->used == 0)
    return PACKING_OK;
  show(read, &view);
  read->used = 0;
  return packing_particles_append(read->particles, &view);
}

void packing_i_read_restart(packing_i_read *read)
{
  read->used = 0;
  packing_particles_truncate(read->particles, 0);
}

packing_status packing_i_read_columns(packing_i_read *read, unsigned columns)
{
  return packing_particles_add_columns(read->particles, columns);
}

int packing_i_read_wants(const packing_i_read *read, size_t frame)
{
  return read->def.frame < 0 || (uint64_t)read->def.frame == frame;
}

packing_status packing_i_read_box(packing_i_read *read, const double lo[3],
                                  const double hi[3])
{
  packing_bounds *box = &read->info.box;
  for (int k = 0; k < 3; k++)
    if (!(lo[k] <= hi[k] && isfinite(lo[k]) && isfinite(hi[k])))
      return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                                 "the box goes from %g to %g along %c", lo[k], hi[k],
                                 "xyz"[k]);
  box->lo.x = lo[0];
  box->lo.y = lo[1];
  box->lo.z = lo[2];
  box->hi.x = hi[0];
  box->hi.y = hi[1];
  box->hi.z = hi[2];
  read->info.has_box = 1;
  return PACKING_OK;
}
