/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An input script for LIGGGHTS (tried with 3.8.0): loads the pack, puts the walls, and runs. Planes and
 * cylinders are its primitive walls; a container with any other wall is one mesh, from STL. */
#include "vec.h"
#include "writers_internal.h"

static const char model[] = "model hertz tangential history";

static int is_primitive(const packing_i_surface *s, int dim)
{
  return s->kind == PACKING_I_SURFACE_PLANE ||
         (s->kind == PACKING_I_SURFACE_CYLINDER && (dim == 2 || !s->outside));
}

/* The centre of a cylinder is y z, z x or x y. */
static void put_primitive(packing_i_writer *w, const packing_i_surface *s, int wall)
{
  static const char axes[] = "xyz";
  packing_i_put_text(w, "fix             wall");
  packing_i_put_int(w, wall);
  packing_i_put_text(w, " all wall/gran ");
  packing_i_put_text(w, model);
  packing_i_put_text(w, " primitive type 1 ");
  packing_i_put_char(w, axes[s->axis]);
  if (s->kind == PACKING_I_SURFACE_PLANE) {
    packing_i_put_text(w, "plane");
    packing_i_put_doubles(w, ' ', &s->position, 1);
  } else {
    const double numbers[] = {s->radius[0],
                              packing_i_component(s->centre, (s->axis + 1) % 3),
                              packing_i_component(s->centre, (s->axis + 2) % 3)};
    packing_i_put_text(w, "cylinder");
    packing_i_put_doubles(w, ' ', numbers, 3);
  }
  packing_i_put_char(w, '\n');
}

static void put_mesh(packing_i_writer *w, const packing_deck_def *d)
{
  packing_i_put_text(w, "fix             container all mesh/surface file ");
  packing_i_put_text(w, d->mesh_name);
  packing_i_put_text(w, " type 1\nfix             walls all wall/gran ");
  packing_i_put_text(w, model);
  packing_i_put_text(w, " mesh n_meshes 1 meshes container\n");
}

static void put_walls(packing_i_writer *w, const packing_i_pack *pack,
                      const packing_i_surface *surfaces, int count)
{
  int primitive = 1;
  for (int i = 0; i < count; i++)
    primitive &= is_primitive(&surfaces[i], pack->def.dim);
  if (!primitive)
    put_mesh(w, &pack->deck);
  for (int i = 0; primitive && i < count; i++)
    put_primitive(w, &surfaces[i], i);
}

/* A property, the same for all types or pairs of types. */
static void put_property(packing_i_writer *w, const char *name, double v, int32_t types,
                         int pairs)
{
  packing_i_put_text(w, "fix             ");
  packing_i_put_text(w, name);
  packing_i_put_text(w, " all property/global ");
  packing_i_put_text(w, name);
  packing_i_put_text(w, pairs ? " peratomtypepair " : " peratomtype");
  if (pairs)
    packing_i_put_int(w, types);
  const int64_t count = pairs ? (int64_t)types * types : types;
  for (int64_t i = 0; i < count && w->status == PACKING_OK; i++)
    packing_i_put_doubles(w, ' ', &v, 1);
  packing_i_put_char(w, '\n');
}

static void put_material(packing_i_writer *w, const packing_i_pack *pack, int32_t types)
{
  const packing_deck_def *d = &pack->deck;
  put_property(w, "youngsModulus", d->youngs_modulus, types, 0);
  put_property(w, "poissonsRatio", d->poisson_ratio, types, 0);
  put_property(w, "coefficientRestitution", d->restitution, types, 1);
  put_property(w, "coefficientFriction", d->friction, types, 1);
}

static void put_load(packing_i_writer *w, const packing_i_pack *pack, int32_t types)
{
  static const double softest = 5e6; /* the least modulus that it takes unasked */
  const double skin = 0.25 * packing_i_view_largest_r(&pack->view);
  packing_i_put_text(w, "communicate     single vel yes\n");
  if (pack->deck.youngs_modulus < softest)
    packing_i_put_text(w, "soft_particles  yes\n");
  packing_i_put_text(w, "read_data       ");
  packing_i_put_text(w, pack->deck.data_name);
  packing_i_put_text(w, "\n\nneighbor       ");
  packing_i_put_doubles(w, ' ', &skin, 1);
  packing_i_put_text(w, " bin\nneigh_modify    delay 0\n");
  put_material(w, pack, types);
  packing_i_put_text(w, "pair_style      gran ");
  packing_i_put_text(w, model);
  packing_i_put_text(w, "\npair_coeff      * *\n\n"
                        "fix             move all nve/sphere\n");
}

static packing_status write_deck(packing_context *context, const packing_i_pack *pack,
                                 const packing_stream *stream)
{
  enum { MOST_TYPES = 100 }; /* properties are tables of types by types */
  const int32_t types = packing_i_largest_type(&pack->view);
  packing_i_surface surfaces[PACKING_I_SURFACES];
  packing_i_writer w;
  int count;
  if (types > MOST_TYPES)
    return packing_i_fail(context, PACKING_ERR_RANGE, "type", PACKING_NO_INDEX,
                          "%ld, at most %d in a deck", (long)types, MOST_TYPES);
  PACKING_I_TRY(packing_i_surfaces(
      context, pack, 2 * packing_i_view_largest_r(&pack->view), surfaces, &count));
  PACKING_I_TRY(packing_i_writer_open(&w, context, "liggghts-deck", stream));
  packing_i_put_deck_head(&w, pack, "liggghts", "granular");
  put_load(&w, pack, types);
  packing_i_put_deck_gravity(&w, pack);
  put_walls(&w, pack, surfaces, count);
  packing_i_put_deck_run(&w, pack);
  packing_i_put_text(&w, "\"%d %d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g "
                         "%.17g\"\nrun             ${steps}\n");
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_liggghts_deck = {
    {sizeof(packing_write_format), "liggghts-deck", "",
     "an input script: loads the liggghts file, walls (of an STL file where they are not "
     "planes and cylinders), gravity, run",
     "LIGGGHTS 3.8.0", 1},
    PACKING_I_NEEDS_BOX | PACKING_I_NEEDS_DECK,
    write_deck};
