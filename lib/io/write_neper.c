/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The two files of a Laguerre tessellation by Neper, from its manual; not tried:
 *   neper -T -n N -domain ... -morpho voronoi
 *         -morphooptiini "coo:file(COO),weight:file(WEIGHT)"
 * Rows of coordinates, rows of radii, in one order. */
#include "vec.h"
#include "writers_internal.h"

static packing_status write_coo(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  packing_i_writer w;
  PACKING_I_TRY(packing_i_writer_open(&w, context, "neper-coo", stream));
  for (size_t i = 0; i < pack->view.count && w.status == PACKING_OK; i++) {
    const packing_vec3 p = packing_i_view_centre(&pack->view, i);
    const double rest[] = {p.y, p.z};
    packing_i_put_double(&w, p.x);
    packing_i_put_doubles(&w, ' ', rest, pack->def.dim == 2 ? 1 : 2);
    packing_i_put_char(&w, '\n');
  }
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_neper_coo = {
    {sizeof(packing_write_format), "neper-coo", "", "centre; neper-weight has the radii",
     "Neper, by the manual: not verified", 0},
    PACKING_I_NEEDS_NOTHING,
    write_coo};

static packing_status write_weight(packing_context *context, const packing_i_pack *pack,
                                   const packing_stream *stream)
{
  packing_i_writer w;
  PACKING_I_TRY(packing_i_writer_open(&w, context, "neper-weight", stream));
  for (size_t i = 0; i < pack->view.count && w.status == PACKING_OK; i++) {
    packing_i_put_double(&w, packing_i_view_r(&pack->view, i));
    packing_i_put_char(&w, '\n');
  }
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_neper_weight = {
    {sizeof(packing_write_format), "neper-weight", "",
     "radius; neper-coo has the centres", "Neper, by the manual: not verified", 0},
    PACKING_I_NEEDS_NOTHING,
    write_weight};
