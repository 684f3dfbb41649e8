/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One frame of a LAMMPS text dump, with the columns that dumps of grains have. */
#include "writers_internal.h"

static void put_side(packing_i_writer *w, double lo, double hi)
{
  packing_i_put_double(w, lo);
  packing_i_put_doubles(w, ' ', &hi, 1);
  packing_i_put_char(w, '\n');
}

static void put_head(packing_i_writer *w, const packing_i_pack *pack)
{
  const packing_view *v = &pack->view;
  packing_i_put_text(w, "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n");
  packing_i_put_int(w, (int64_t)v->count);
  packing_i_put_text(w, "\nITEM: BOX BOUNDS");
  for (unsigned k = 0; k < 3; k++)
    packing_i_put_text(w, (pack->def.periodic & 1u << k) != 0 ? " pp" : " ff");
  packing_i_put_char(w, '\n');
  put_side(w, pack->box.lo.x, pack->box.hi.x);
  put_side(w, pack->box.lo.y, pack->box.hi.y);
  put_side(w, pack->box.lo.z, pack->box.hi.z);
  packing_i_put_text(w, "ITEM: ATOMS id type radius x y z");
  if (packing_i_view_has_velocity(v))
    packing_i_put_text(w, " vx vy vz");
  if (packing_i_view_has_spin(v))
    packing_i_put_text(w, " omegax omegay omegaz");
  packing_i_put_char(w, '\n');
}

static void put_row(packing_i_writer *w, const packing_view *v, size_t i)
{
  const packing_vec3 p = packing_i_view_centre(v, i);
  const double row[] = {packing_i_view_r(v, i), p.x, p.y, p.z};
  const double velocity[] = {packing_i_view_number(&v->vx, i),
                             packing_i_view_number(&v->vy, i),
                             packing_i_view_number(&v->vz, i)};
  const double spin[] = {packing_i_view_number(&v->wx, i),
                         packing_i_view_number(&v->wy, i),
                         packing_i_view_number(&v->wz, i)};
  packing_i_put_int(w, packing_i_view_id(v, i));
  packing_i_put_char(w, ' ');
  packing_i_put_int(w, packing_i_view_int(&v->type, i, 1));
  packing_i_put_doubles(w, ' ', row, 4);
  if (packing_i_view_has_velocity(v))
    packing_i_put_doubles(w, ' ', velocity, 3);
  if (packing_i_view_has_spin(v))
    packing_i_put_doubles(w, ' ', spin, 3);
  packing_i_put_char(w, '\n');
}

static packing_status write_dump(packing_context *context, const packing_i_pack *pack,
                                 const packing_stream *stream)
{
  packing_i_writer w;
  PACKING_I_TRY(packing_i_writer_open(&w, context, "dump", stream));
  put_head(&w, pack);
  for (size_t i = 0; i < pack->view.count && w.status == PACKING_OK; i++)
    put_row(&w, &pack->view, i);
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_dump = {
    {sizeof(packing_write_format), "dump", ".dump",
     "centre, radius, id, type, velocity, spin, box, periodic directions",
     "LAMMPS 29Sep2021, read_dump", 1},
    PACKING_I_NEEDS_BOX | PACKING_I_NEEDS_IDS,
    write_dump};
