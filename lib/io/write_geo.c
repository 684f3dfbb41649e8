/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ESyS-Particle's geometry (.geo), as GenGeo writes it and sim.readGeometry() reads it (tried with
 * 2.3.5): particles with tags, connections of ids. YADE's ymport.gengeoFile() takes the count from the
 * seventh line, so the lines keep their places. */
#include "writers_internal.h"

static void put_head(packing_i_writer *w, const packing_i_pack *pack)
{
  packing_i_put_text(w, "LSMGeometry 1.2\nBoundingBox ");
  packing_i_put_vec(w, ' ', pack->box.lo);
  packing_i_put_char(w, ' ');
  packing_i_put_vec(w, ' ', pack->box.hi);
  packing_i_put_text(w, "\nPeriodicBoundaries");
  for (unsigned k = 0; k < 3; k++)
    packing_i_put_text(w, (pack->def.periodic & 1u << k) != 0 ? " 1" : " 0");
  packing_i_put_text(w, pack->def.dim == 2 ? "\nDimension 2D\n" : "\nDimension 3D\n");
}

static void put_particles(packing_i_writer *w, const packing_view *v)
{
  packing_i_put_text(w, "BeginParticles\nSimple\n");
  packing_i_put_int(w, (int64_t)v->count);
  packing_i_put_char(w, '\n');
  for (size_t i = 0; i < v->count && w->status == PACKING_OK; i++) {
    packing_i_put_sphere(w, ' ', v, i);
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, packing_i_id_from(v, i, 0));
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, packing_i_view_int(&v->type, i, 1));
    packing_i_put_char(w, '\n');
  }
  packing_i_put_text(w, "EndParticles\n");
}

static void put_connections(packing_i_writer *w, const packing_write_def *d,
                            const packing_view *v)
{
  packing_i_put_text(w, "BeginConnect\n");
  packing_i_put_int(w, (int64_t)d->bond_count);
  packing_i_put_char(w, '\n');
  for (size_t k = 0; k < d->bond_count && w->status == PACKING_OK; k++) {
    const packing_bond *b = &d->bonds[k];
    packing_i_put_int(w, packing_i_id_from(v, b->i, 0));
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, packing_i_id_from(v, b->j, 0));
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, b->type);
    packing_i_put_char(w, '\n');
  }
  packing_i_put_text(w, "EndConnect\n");
}

static packing_status write_geo(packing_context *context, const packing_i_pack *pack,
                                const packing_stream *stream)
{
  packing_i_writer w;
  PACKING_I_TRY(packing_i_writer_open(&w, context, "geo", stream));
  put_head(&w, pack);
  put_particles(&w, &pack->view);
  put_connections(&w, &pack->def, &pack->view);
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_geo = {
    {sizeof(packing_write_format), "geo", ".geo",
     "centre, radius, id, type as tag, box, periodic directions, bonds",
     "ESyS-Particle 2.3.5, YADE 2023.02a", 1},
    PACKING_I_NEEDS_BOX | PACKING_I_NEEDS_IDS,
    write_geo};
