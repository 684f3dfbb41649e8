/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text for YADE: rows `x y z r`. Without the first line both ymport.text() and
 * pack.SpherePack().load() take it; neither takes a blank line, and the latter no comment but a
 * first line with the period of its cell (tried with yade 2023.02a). */
#include "io_internal.h"
#include "vec.h"
#include "view.h"

const packing_i_format packing_i_format_yade = {
    "yade", ".txt", "YADE 2023.02a, ymport.text and pack.SpherePack",
    "centre and radius"};

void packing_yade_def_fill(packing_yade_def *def, size_t size)
{
  packing_yade_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_period(packing_context *context, const packing_yade_def *d,
                                   int *periodic)
{
  static const char *const fields[] = {"period.x", "period.y", "period.z"};
  *periodic = d->period.x != 0 || d->period.y != 0 || d->period.z != 0;
  if (!*periodic)
    return PACKING_OK;
  for (int k = 0; k < 3; k++)
    PACKING_I_TRY(
        packing_i_check_positive(context, fields[k], packing_i_component(d->period, k)));
  if (d->header)
    return packing_i_fail(context, PACKING_ERR_INVALID, "header", PACKING_NO_INDEX,
                          "SpherePack, which has a period, takes none");
  return PACKING_OK;
}

packing_status packing_write_yade(packing_context *context, const packing_yade_def *def,
                                  const packing_view *view, const packing_stream *stream)
{
  packing_yade_def d;
  packing_view v;
  packing_i_writer w;
  int periodic;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_yade, header, def, &d));
  PACKING_I_TRY(check_period(context, &d, &periodic));
  PACKING_I_TRY(packing_i_io_view(context, view, 0, &v));
  PACKING_I_TRY(packing_i_writer_begin(&w, context, &packing_i_format_yade, stream));
  if (d.header)
    packing_i_put_text(&w, "#format x_y_z_r\n");
  if (periodic) {
    const double sides[] = {d.period.x, d.period.y, d.period.z};
    packing_i_put_text(&w, "##PERIODIC::");
    packing_i_put_doubles(&w, ' ', sides, 3);
    packing_i_put_char(&w, '\n');
  }
  for (size_t i = 0; i < v.count && w.status == PACKING_OK; i++) {
    const packing_vec3 p = packing_i_view_centre(&v, i);
    const double rest[] = {p.y, p.z, packing_i_view_r(&v, i)};
    packing_i_put_double(&w, p.x);
    packing_i_put_doubles(&w, '\t', rest, 3);
    packing_i_put_char(&w, '\n');
  }
  return packing_i_writer_end(&w);
}
