/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The library's own table of a pack, which any spreadsheet, R or NumPy reads too: optional
 * `# key: value` lines, a header, a row a particle. Components of velocity and spin that the
 * host lacks are written as 0, so that the columns of a vector stand together, as the reader
 * (csv_reader.c) wants them. Linear in the particles, in constant memory. */
#include "io_internal.h"
#include <string.h>

const packing_i_format packing_i_format_csv = {
    "csv", ".csv", "RFC 4180, plain numbers, '#' comments; doc/methods/formats.md",
    "centre, radius, and the optional columns of the pack"};

void packing_csv_def_fill(packing_csv_def *def, size_t size)
{
  packing_csv_def defaults = {0};
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_note(packing_context *context, const char *field, size_t i,
                                 const char *text, const char *banned)
{
  if (text == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, field, i, "entry %zu is NULL", i);
  if (strpbrk(text, banned) != NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, field, i,
                          "entry %zu holds a newline%s", i,
                          strchr(banned, ':') != NULL ? " or a colon" : "");
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_csv_def *d)
{
  if (d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_INVALID, "dim", PACKING_NO_INDEX,
                          "%d is neither 2 nor 3", d->dim);
  if (d->note_count > 0 && (d->keys == NULL || d->values == NULL))
    return packing_i_fail(context, PACKING_ERR_INVALID,
                          d->keys == NULL ? "keys" : "values", PACKING_NO_INDEX, "NULL");
  for (size_t i = 0; i < d->note_count; i++) {
    PACKING_I_TRY(check_note(context, "keys", i, d->keys[i], "\r\n:"));
    PACKING_I_TRY(check_note(context, "values", i, d->values[i], "\r\n"));
  }
  return PACKING_OK;
}

static void put_notes(packing_i_writer *w, const packing_csv_def *d)
{
  for (size_t i = 0; i < d->note_count; i++) {
    packing_i_put_text(w, "# ");
    packing_i_put_text(w, d->keys[i]);
    packing_i_put_text(w, ": ");
    packing_i_put_text(w, d->values[i]);
    packing_i_put_char(w, '\n');
  }
}

/* Which of the optional columns are written. */
typedef struct shape {
  int z, id, type, component, velocity, spin, orientation;
} shape;

static shape shape_of(const packing_view *v, int dim)
{
  const shape s = {dim == 3,
                   v->id.data != NULL,
                   v->type.data != NULL,
                   v->component.data != NULL,
                   packing_i_view_has_velocity(v),
                   packing_i_view_has_spin(v),
                   packing_i_view_has_orientation(v)};
  return s;
}

static void put_header(packing_i_writer *w, const shape *s)
{
  packing_i_put_text(w, s->z ? "x,y,z,r" : "x,y,r");
  packing_i_put_text(w, s->id ? ",id" : "");
  packing_i_put_text(w, s->type ? ",type" : "");
  packing_i_put_text(w, s->component ? ",component" : "");
  packing_i_put_text(w, s->velocity ? ",vx,vy,vz" : "");
  packing_i_put_text(w, s->spin ? ",wx,wy,wz" : "");
  packing_i_put_text(w, s->orientation ? ",qw,qx,qy,qz" : "");
  packing_i_put_char(w, '\n');
}

static void put_cell(packing_i_writer *w, const packing_column *c, size_t i)
{
  packing_i_put_char(w, ',');
  packing_i_put_double(w, packing_i_view_number(c, i));
}

static void put_whole(packing_i_writer *w, int64_t n)
{
  packing_i_put_char(w, ',');
  packing_i_put_int(w, n);
}

static void put_optional(packing_i_writer *w, const shape *s, const packing_view *v,
                         size_t i)
{
  if (s->id)
    put_whole(w, packing_i_view_id(v, i));
  if (s->type)
    put_whole(w, packing_i_view_int(&v->type, i, 1));
  if (s->component)
    put_whole(w, packing_i_view_int(&v->component, i, 0));
  if (s->velocity) {
    put_cell(w, &v->vx, i);
    put_cell(w, &v->vy, i);
    put_cell(w, &v->vz, i);
  }
  if (s->spin) {
    put_cell(w, &v->wx, i);
    put_cell(w, &v->wy, i);
    put_cell(w, &v->wz, i);
  }
  if (s->orientation) {
    put_cell(w, &v->qw, i);
    put_cell(w, &v->qx, i);
    put_cell(w, &v->qy, i);
    put_cell(w, &v->qz, i);
  }
}

static void put_row(packing_i_writer *w, const shape *s, const packing_view *v, size_t i)
{
  packing_i_put_double(w, packing_i_view_number(&v->x, i));
  put_cell(w, &v->y, i);
  if (s->z)
    put_cell(w, &v->z, i);
  put_cell(w, &v->r, i);
  put_optional(w, s, v, i);
  packing_i_put_char(w, '\n');
}

packing_status packing_write_csv(packing_context *context, const packing_csv_def *def,
                                 const packing_view *view, const packing_stream *stream)
{
  packing_csv_def d;
  packing_view v;
  packing_i_writer w;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_csv, values, def, &d));
  PACKING_I_TRY(check(context, &d));
  PACKING_I_TRY(packing_i_io_view(context, view, d.dim, &v));
  PACKING_I_TRY(packing_i_writer_begin(&w, context, &packing_i_format_csv, stream));
  const shape s = shape_of(&v, d.dim);
  put_notes(&w, &d);
  put_header(&w, &s);
  for (size_t i = 0; i < v.count && w.status == PACKING_OK; i++)
    put_row(&w, &s, &v, i);
  return packing_i_writer_end(&w);
}
