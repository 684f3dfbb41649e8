/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text for YADE: rows `x y z r`. Without the first line both ymport.text() and
 * pack.SpherePack().load() take it; neither takes a blank line, and the latter no comment
 * (tried with yade 2023.02a). */
#include "io_internal.h"
#include "view.h"

const packing_i_format packing_i_format_yade = {
    "yade", ".txt", "YADE 2023.02a, ymport.text and pack.SpherePack",
    "centre and radius"};

void packing_yade_def_fill(packing_yade_def *def, size_t size)
{
  packing_yade_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_write_yade(packing_context *context, const packing_yade_def *def,
                                  const packing_view *view, const packing_stream *stream)
{
  packing_yade_def d;
  packing_view v;
  packing_i_writer w;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_yade, header, def, &d));
  PACKING_I_TRY(packing_i_io_view(context, view, 0, &v));
  PACKING_I_TRY(packing_i_writer_begin(&w, context, &packing_i_format_yade, stream));
  if (d.header)
    packing_i_put_text(&w, "#format x_y_z_r\n");
  for (size_t i = 0; i < v.count && w.status == PACKING_OK; i++) {
    const packing_vec3 p = packing_i_view_centre(&v, i);
    const double rest[] = {p.y, p.z, packing_i_view_r(&v, i)};
    packing_i_put_double(&w, p.x);
    packing_i_put_doubles(&w, '\t', rest, 3);
    packing_i_put_char(&w, '\n');
  }
  return packing_i_writer_end(&w);
}
