/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An input script for LAMMPS (tried with lmp 29Sep2021u2): loads the pack, puts a wall for each of
 * the container's, and runs. Planes are fix wall/gran, round walls regions open at their ends under
 * fix wall/gran/region. Bonds are carried along without a force (bond_style zero): what they
 * should do is not in a pack. */
#include "vec.h"
#include "writers_internal.h"

static void put_law(packing_i_writer *w, const packing_deck_def *d)
{
  const double stiffness[] = {d->youngs_modulus, d->restitution, d->poisson_ratio};
  packing_i_put_text(w, "hertz/material");
  packing_i_put_doubles(w, ' ', stiffness, 3);
  packing_i_put_text(w, " tangential mindlin NULL 1.0");
  packing_i_put_doubles(w, ' ', &d->friction, 1);
  packing_i_put_text(w, " damping tsuji");
}

static void put_fix(packing_i_writer *w, int wall, const char *style,
                    const packing_deck_def *d)
{
  packing_i_put_text(w, "fix             wall");
  packing_i_put_int(w, wall);
  packing_i_put_text(w, " all ");
  packing_i_put_text(w, style);
  packing_i_put_text(w, " granular ");
  put_law(w, d);
}

static void put_plane(packing_i_writer *w, const packing_i_surface *s)
{
  static const char *const styles[] = {" xplane ", " yplane ", " zplane "};
  packing_i_put_text(w, styles[s->axis]);
  if (s->outside)
    packing_i_put_text(w, "NULL ");
  packing_i_put_double(w, s->position);
  packing_i_put_text(w, s->outside ? "\n" : " NULL\n");
}

/* The two coordinates across the axis, in LAMMPS's order: y z, x z, x y. */
static void put_across(packing_i_writer *w, const packing_i_surface *s)
{
  const double across[] = {s->axis == 0 ? s->centre.y : s->centre.x,
                           s->axis == 2 ? s->centre.y : s->centre.z};
  packing_i_put_doubles(w, ' ', across, 2);
}

static void put_region(packing_i_writer *w, const packing_i_surface *s, int wall)
{
  static const char *const axes[] = {" x", " y", " z"};
  packing_i_put_text(w, "region          wall");
  packing_i_put_int(w, wall);
  if (s->kind == PACKING_I_SURFACE_SPHERE) {
    packing_i_put_text(w, " sphere ");
    packing_i_put_vec(w, ' ', s->centre);
    packing_i_put_doubles(w, ' ', s->radius, 1);
    packing_i_put_char(w, '\n');
    return;
  }
  packing_i_put_text(w, s->kind == PACKING_I_SURFACE_CONE ? " cone" : " cylinder");
  packing_i_put_text(w, axes[s->axis]);
  put_across(w, s);
  packing_i_put_doubles(w, ' ', s->radius, s->kind == PACKING_I_SURFACE_CONE ? 2 : 1);
  packing_i_put_doubles(w, ' ', s->height, 2);
  packing_i_put_text(w, " open 1 open 2");
  packing_i_put_text(w, s->outside ? " side out\n" : "\n");
}

static void put_wall(packing_i_writer *w, const packing_deck_def *d,
                     const packing_i_surface *s, int wall)
{
  if (s->kind == PACKING_I_SURFACE_PLANE) {
    put_fix(w, wall, "wall/gran", d);
    put_plane(w, s);
    return;
  }
  put_region(w, s, wall);
  put_fix(w, wall, "wall/gran/region", d);
  packing_i_put_text(w, " region wall");
  packing_i_put_int(w, wall);
  packing_i_put_char(w, '\n');
}

static void put_load(packing_i_writer *w, const packing_i_pack *pack)
{
  const double skin = 0.25 * packing_i_view_largest_r(&pack->view);
  packing_i_put_text(w, "comm_modify     vel yes\nread_data       ");
  packing_i_put_text(w, pack->deck.data_name);
  if (pack->def.bond_count > 0)
    packing_i_put_text(w, "\nbond_style      zero nocoeff\nbond_coeff      *\n"
                          "special_bonds   lj/coul 1 1 1");
  packing_i_put_text(w, "\n\nneighbor       ");
  packing_i_put_doubles(w, ' ', &skin, 1);
  packing_i_put_text(w, " bin\nneigh_modify    delay 0 every 1 check yes\n"
                        "pair_style      granular\npair_coeff      * * ");
  put_law(w, &pack->deck);
  packing_i_put_text(w, "\n\nfix             move all nve/sphere");
  packing_i_put_text(w, pack->def.dim == 2 ? " disc\n" : "\n");
}

static packing_status write_deck(packing_context *context, const packing_i_pack *pack,
                                 const packing_stream *stream)
{
  packing_i_surface surfaces[PACKING_I_SURFACES];
  packing_i_writer w;
  int count;
  PACKING_I_TRY(packing_i_surfaces(
      context, pack, 2 * packing_i_view_largest_r(&pack->view), surfaces, &count));
  PACKING_I_TRY(packing_i_writer_open(&w, context, "lammps-deck", stream));
  packing_i_put_deck_head(&w, pack, "lmp",
                          pack->def.bond_count > 0 ? "hybrid sphere bond" : "sphere");
  put_load(&w, pack);
  packing_i_put_deck_gravity(&w, pack);
  for (int i = 0; i < count; i++)
    put_wall(&w, &pack->deck, &surfaces[i], i);
  packing_i_put_deck_run(&w, pack);
  packing_i_put_text(&w, "float %.17g\nrun             ${steps}\n");
  return packing_i_writer_end(&w);
}

const packing_i_write_format packing_i_write_lammps_deck = {
    {sizeof(packing_write_format), "lammps-deck", "",
     "an input script: loads the lammps file, walls, gravity, run",
     "LAMMPS 29Sep2021 with its packages GRANULAR and RIGID", 1},
    PACKING_I_NEEDS_BOX | PACKING_I_NEEDS_DECK,
    write_deck};
