/* SPDX-License-Identifier: GPL-3.0-or-later */
/* MercuryDPM's .data, from its documentation; not tried: a line with count, time and box, then rows
 * `x y z vx vy vz r q1 q2 q3 wx wy wz xi`. The angles q are 0: how they turn is not documented. xi is the
 * species, from 0. A flat pack is written in three dimensions with z = 0. */
#include "writers_internal.h"

static void put_row(packing_i_writer *w, const packing_view *v, size_t i)
{
  const packing_vec3 p = packing_i_view_centre(v, i);
  const double rest[] = {p.y,
                         p.z,
                         packing_i_view_number(&v->vx, i),
                         packing_i_view_number(&v->vy, i),
                         packing_i_view_number(&v->vz, i),
                         packing_i_view_r(v, i),
                         0,
                         0,
                         0,
                         packing_i_view_number(&v->wx, i),
                         packing_i_view_number(&v->wy, i),
                         packing_i_view_number(&v->wz, i)};
  packing_i_put_double(w, p.x);
  packing_i_put_doubles(w, ' ', rest, sizeof rest / sizeof rest[0]);
  packing_i_put_char(w, ' ');
  packing_i_put_int(w, (int64_t)packing_i_view_int(&v->type, i, 1) - 1);
  packing_i_put_char(w, '\n');
}

static packing_status write_mercury(packing_context *context, const packing_i_pack *pack,
                                    const packing_stream *stream)
{
  packing_i_writer w;
  int32_t types;
  PACKING_I_TRY(packing_i_check_types(context, &pack->view, &types));
  PACKING_I_TRY(packing_i_writer_open(&w, context, "mercury", stream));
  packing_i_put_int(&w, (int64_t)pack->view.count);
  packing_i_put_doubles(&w, ' ', &pack->def.time, 1);
  packing_i_put_char(&w, ' ');
  packing_i_put_vec(&w, ' ', pack->box.lo);
  packing_i_put_char(&w, ' ');
  packing_i_put_vec(&w, ' ', pack->box.hi);
  packing_i_put_char(&w, '\n');
  for (size_t i = 0; i < pack->view.count && w.status == PACKING_OK; i++)
    put_row(&w, &pack->view, i);
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_mercury = {
    {sizeof(packing_write_format), "mercury", "",
     "centre, radius, type, velocity, spin, box, time",
     "MercuryDPM's .data, by its documentation: not verified", 0},
    PACKING_I_NEEDS_BOX,
    write_mercury};
