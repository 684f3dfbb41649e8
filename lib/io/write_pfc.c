/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A data file for PFC 6 and 7, from Itasca's manual (`ball create`); not tried. PFC takes no ball
 * with a radius of a quarter of the domain's smallest side or more. */
#include "vec.h"
#include "writers_internal.h"

static packing_status check_radii(packing_context *context, const packing_i_pack *pack)
{
  const packing_vec3 size = packing_i_sub(pack->box.hi, pack->box.lo);
  const double flat = fmin(size.x, size.y);
  const double least = pack->def.dim == 2 ? flat : fmin(flat, size.z);
  for (size_t i = 0; i < pack->view.count; i++)
    if (!(4 * packing_i_view_r(&pack->view, i) < least))
      return packing_i_fail(context, PACKING_ERR_RANGE, "box", i,
                            "%g wide, and PFC takes particle %zu of radius %g in four of "
                            "these and more",
                            least, i, packing_i_view_r(&pack->view, i));
  return PACKING_OK;
}

static void put_domain(packing_i_writer *w, const packing_i_pack *pack)
{
  const packing_bounds *b = &pack->box;
  const double extent[] = {b->lo.x, b->hi.x, b->lo.y, b->hi.y, b->lo.z, b->hi.z};
  packing_i_put_text(w, "; ");
  packing_i_put_title(w, pack);
  packing_i_put_text(w, "\nmodel new\nmodel domain extent");
  packing_i_put_doubles(w, ' ', extent, pack->def.dim == 2 ? 4 : 6);
  if (pack->def.periodic != 0) {
    packing_i_put_text(w, " condition");
    for (unsigned k = 0; k < (unsigned)pack->def.dim; k++)
      packing_i_put_text(w,
                         (pack->def.periodic & 1u << k) != 0 ? " periodic" : " destroy");
  }
  packing_i_put_char(w, '\n');
}

static void put_ball(packing_i_writer *w, const packing_i_pack *pack, size_t i)
{
  const packing_vec3 p = packing_i_view_centre(&pack->view, i);
  const double r = packing_i_view_r(&pack->view, i), centre[] = {p.x, p.y, p.z};
  packing_i_put_text(w, "ball create id ");
  packing_i_put_int(w, packing_i_view_id(&pack->view, i));
  packing_i_put_text(w, " position");
  packing_i_put_doubles(w, ' ', centre, pack->def.dim == 2 ? 2 : 3);
  packing_i_put_text(w, " radius");
  packing_i_put_doubles(w, ' ', &r, 1);
  packing_i_put_text(w, " group 'type");
  packing_i_put_int(w, packing_i_view_int(&pack->view.type, i, 1));
  packing_i_put_text(w, "'\n");
}

static packing_status write_pfc(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  packing_i_writer w;
  PACKING_I_TRY(packing_i_check_ids(context, &pack->view, 1));
  PACKING_I_TRY(check_radii(context, pack));
  PACKING_I_TRY(packing_i_writer_open(&w, context, "pfc", stream));
  put_domain(&w, pack);
  for (size_t i = 0; i < pack->view.count && w.status == PACKING_OK; i++)
    put_ball(&w, pack, i);
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_pfc = {
    {sizeof(packing_write_format), "pfc", "",
     "centre, radius, id, type as group, box, periodic directions",
     "PFC 6 and 7, by the manual: not verified", 0},
    PACKING_I_NEEDS_BOX,
    write_pfc};
