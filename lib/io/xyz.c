/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Extended XYZ, as ASE and OVITO read it: the count, a line that names cell and columns, rows
 * `X x y z r id`, then the view's type, velocity, spin and orientation under OVITO's names, the
 * real part of the quaternion last. The species is X, the one that ASE takes for no element. */
#include "io_internal.h"
#include "view.h"

const packing_i_format packing_i_format_xyz = {
    "xyz", ".xyz .extxyz", "extended XYZ, github.com/libAtoms/extxyz; read by ASE, OVITO",
    "centre, radius, id, type, velocity, spin, orientation, cell, periodic directions, "
    "time"};

void packing_xyz_def_fill(packing_xyz_def *def, size_t size)
{
  packing_xyz_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* A diagonal cell: three rows of three. */
static void put_lattice(packing_i_writer *w, const packing_bounds *box)
{
  const double zeros[] = {0, 0, 0};
  packing_i_put_text(w, "Lattice=\"");
  packing_i_put_double(w, box->hi.x - box->lo.x);
  packing_i_put_doubles(w, ' ', zeros, 3);
  packing_i_put_char(w, ' ');
  packing_i_put_double(w, box->hi.y - box->lo.y);
  packing_i_put_doubles(w, ' ', zeros, 3);
  packing_i_put_char(w, ' ');
  packing_i_put_double(w, box->hi.z - box->lo.z);
  packing_i_put_text(w, "\" Origin=\"");
  packing_i_put_double(w, box->lo.x);
  packing_i_put_char(w, ' ');
  packing_i_put_double(w, box->lo.y);
  packing_i_put_char(w, ' ');
  packing_i_put_double(w, box->lo.z);
  packing_i_put_char(w, '"');
}

static void put_periodic(packing_i_writer *w, unsigned periodic)
{
  packing_i_put_text(w, " pbc=\"");
  packing_i_put_text(w, periodic & PACKING_PERIODIC_X ? "T " : "F ");
  packing_i_put_text(w, periodic & PACKING_PERIODIC_Y ? "T " : "F ");
  packing_i_put_text(w, periodic & PACKING_PERIODIC_Z ? "T\"" : "F\"");
}

static void put_columns(packing_i_writer *w, const packing_view *v)
{
  packing_i_put_text(w, " Properties=species:S:1:pos:R:3:radius:R:1:id:I:1");
  if (v->type.data != NULL)
    packing_i_put_text(w, ":type:I:1");
  if (packing_i_view_has_velocity(v))
    packing_i_put_text(w, ":velo:R:3");
  if (packing_i_view_has_spin(v))
    packing_i_put_text(w, ":angular_velocity:R:3");
  if (packing_i_view_has_orientation(v))
    packing_i_put_text(w, ":orientation:R:4");
}

static void put_numbers(packing_i_writer *w, size_t i, unsigned count,
                        const packing_column *const *columns)
{
  for (unsigned k = 0; k < count; k++) {
    const double v = packing_i_view_number(columns[k], i);
    packing_i_put_doubles(w, ' ', &v, 1);
  }
}

static void put_rest(packing_i_writer *w, const packing_view *v, size_t i)
{
  const packing_column *const velocity[] = {&v->vx, &v->vy, &v->vz};
  const packing_column *const spin[] = {&v->wx, &v->wy, &v->wz};
  const packing_column *const orientation[] = {&v->qx, &v->qy, &v->qz, &v->qw};
  if (v->type.data != NULL) {
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, packing_i_view_int(&v->type, i, 1));
  }
  if (packing_i_view_has_velocity(v))
    put_numbers(w, i, 3, velocity);
  if (packing_i_view_has_spin(v))
    put_numbers(w, i, 3, spin);
  if (packing_i_view_has_orientation(v))
    put_numbers(w, i, 4, orientation);
}

static void put_row(packing_i_writer *w, const packing_view *v, size_t i)
{
  const packing_vec3 p = packing_i_view_centre(v, i);
  const double row[] = {p.x, p.y, p.z, packing_i_view_r(v, i)};
  packing_i_put_char(w, 'X');
  packing_i_put_doubles(w, ' ', row, 4);
  packing_i_put_char(w, ' ');
  packing_i_put_int(w, packing_i_view_id(v, i));
  put_rest(w, v, i);
  packing_i_put_char(w, '\n');
}

packing_status packing_write_xyz(packing_context *context, const packing_xyz_def *def,
                                 const packing_view *view, const packing_stream *stream)
{
  const unsigned all = PACKING_PERIODIC_X | PACKING_PERIODIC_Y | PACKING_PERIODIC_Z;
  packing_xyz_def d;
  packing_view v;
  packing_bounds box;
  packing_i_writer w;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_xyz, periodic, def, &d));
  if ((d.periodic & ~all) != 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "periodic", PACKING_NO_INDEX,
                          "%u is no sum of directions", d.periodic);
  PACKING_I_TRY(packing_i_check_finite(context, "time", d.time));
  const int flat = d.box.lo.z == d.box.hi.z && d.box.lo.x != d.box.hi.x;
  PACKING_I_TRY(packing_i_io_view(context, view, flat ? 2 : 0, &v));
  PACKING_I_TRY(packing_i_io_box(context, &v, &d.box, flat, &box));
  PACKING_I_TRY(packing_i_writer_begin(&w, context, &packing_i_format_xyz, stream));
  packing_i_put_int(&w, (int64_t)v.count);
  packing_i_put_char(&w, '\n');
  put_lattice(&w, &box);
  put_columns(&w, &v);
  put_periodic(&w, d.periodic);
  packing_i_put_text(&w, " Time=");
  packing_i_put_double(&w, d.time);
  packing_i_put_char(&w, '\n');
  for (size_t i = 0; i < v.count && w.status == PACKING_OK; i++)
    put_row(&w, &v, i);
  return packing_i_writer_end(&w);
}
