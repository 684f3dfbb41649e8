/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the decks of LAMMPS and LIGGGHTS share: their def, the head, gravity, the run. Contacts are
 * Hertz and Mindlin's with friction and damping of a given restitution; the time step is a fifth of
 * Rayleigh's time of the smallest particle, pi r sqrt(density / G) / (.1631 nu + .8766), G the shear
 * modulus (Y. Li, Y. Xu, C. Thornton, "A comparison of discrete element simulations and experiments
 * for 'sandpiles' composed of spherical particles", Powder Technology 160, 2005). */
#include "vec.h"
#include "writers_internal.h"

static const double rayleigh_share = 0.2;

void packing_deck_def_fill(packing_deck_def *def, size_t size)
{
  packing_deck_def defaults = {.data_name = "pack.data",
                               .mesh_name = "container.stl",
                               .dump_name = "run.dump",
                               .youngs_modulus = 1e7,
                               .poisson_ratio = 0.3,
                               .friction = 0.5,
                               .restitution = 0.5,
                               .gravity = 9.81,
                               .steps = 10000};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* A word of a script: nothing that it would take for more than a name. */
static packing_status check_name(packing_context *context, const char *field,
                                 const char *name)
{
  static const char letters[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/+=,@~:";
  PACKING_I_TRY(packing_i_check_given(context, field, name));
  if (*name == '\0' || name[strspn(name, letters)] != '\0')
    return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX,
                          "a script takes letters, digits and ._-/+=,@~: in a name");
  return PACKING_OK;
}

static packing_status check_range(packing_context *context, const char *field, double v,
                                  double lo, double hi, int closed)
{
  PACKING_I_TRY(packing_i_check_finite(context, field, v));
  if (v < lo || v > hi || (!closed && v == hi))
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "%g is not in [%g, %g%c", v, lo, hi, closed ? ']' : ')');
  return PACKING_OK;
}

packing_status packing_i_deck_read(packing_context *context, packing_i_pack *pack)
{
  packing_deck_def *d = &pack->deck;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_deck, steps, pack->def.deck, d));
  PACKING_I_TRY(check_name(context, "deck.data_name", d->data_name));
  PACKING_I_TRY(check_name(context, "deck.mesh_name", d->mesh_name));
  PACKING_I_TRY(check_name(context, "deck.dump_name", d->dump_name));
  PACKING_I_TRY(
      packing_i_check_positive(context, "deck.youngs_modulus", d->youngs_modulus));
  PACKING_I_TRY(check_range(context, "deck.poisson_ratio", d->poisson_ratio, 0, 0.5, 0));
  PACKING_I_TRY(packing_i_check_not_negative(context, "deck.friction", d->friction));
  PACKING_I_TRY(check_range(context, "deck.restitution", d->restitution, 0.05, 1, 1));
  PACKING_I_TRY(packing_i_check_not_negative(context, "deck.gravity", d->gravity));
  PACKING_I_TRY(packing_i_check_not_negative(context, "deck.timestep", d->timestep));
  if (d->steps > INT64_MAX)
    return packing_i_fail(context, PACKING_ERR_RANGE, "deck.steps", PACKING_NO_INDEX,
                          "%llu is above 2^63 - 1", (unsigned long long)d->steps);
  if (pack->view.count == 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "view", PACKING_NO_INDEX,
                          "no particles, and a deck runs some");
  return PACKING_OK;
}

int32_t packing_i_largest_type(const packing_view *view)
{
  int32_t largest = 1;
  for (size_t i = 0; i < view->count; i++) {
    const int32_t type = packing_i_view_int(&view->type, i, 1);
    largest = type > largest ? type : largest;
  }
  return largest;
}

double packing_i_deck_timestep(const packing_i_pack *pack)
{
  const packing_deck_def *d = &pack->deck;
  if (d->timestep > 0)
    return d->timestep;
  double r = packing_i_view_r(&pack->view, 0);
  for (size_t i = 1; i < pack->view.count; i++)
    r = fmin(r, packing_i_view_r(&pack->view, i));
  const double shear = d->youngs_modulus / (2 * (1 + d->poisson_ratio));
  return rayleigh_share * PACKING_I_PI * r * sqrt(pack->def.density / shear) /
         (0.1631 * d->poisson_ratio + 0.8766);
}

static void put_variable(packing_i_writer *w, const char *name)
{
  packing_i_put_text(w, "variable        ");
  packing_i_put_text(w, name);
  packing_i_put_text(w, " index ");
}

static void put_boundary(packing_i_writer *w, const packing_i_pack *pack)
{
  packing_i_put_text(w, "\nboundary       ");
  for (int k = 0; k < 3; k++) {
    const int around = (pack->def.periodic & 1u << k) != 0 || k >= pack->def.dim;
    packing_i_put_text(w, around ? " p" : " m");
  }
}

void packing_i_put_deck_head(packing_i_writer *w, const packing_i_pack *pack,
                             const char *command, const char *atom_style)
{
  packing_i_put_text(w, "# ");
  packing_i_put_text(w, command);
  packing_i_put_text(w, " -in THIS [-var steps N] [-var every N] [-var gravity G]\n");
  put_variable(w, "steps");
  packing_i_put_int(w, (int64_t)pack->deck.steps);
  packing_i_put_char(w, '\n');
  put_variable(w, "every");
  packing_i_put_text(w, "1000\n");
  put_variable(w, "gravity");
  packing_i_put_double(w, pack->deck.gravity);
  packing_i_put_text(w, "\n\nunits           si\ndimension       ");
  packing_i_put_int(w, pack->def.dim);
  put_boundary(w, pack);
  packing_i_put_text(w, "\natom_style      ");
  packing_i_put_text(w, atom_style);
  packing_i_put_text(w, "\natom_modify     map array\nnewton          off\n");
}

void packing_i_put_deck_gravity(packing_i_writer *w, const packing_i_pack *pack)
{
  packing_i_put_text(w, "fix             weight all gravity ${gravity} vector ");
  packing_i_put_vec(w, ' ', pack->deck.down);
  packing_i_put_char(w, '\n');
  if (pack->def.dim == 2)
    packing_i_put_text(w, "fix             flat all enforce2d\n");
}

void packing_i_put_deck_run(packing_i_writer *w, const packing_i_pack *pack)
{
  packing_i_put_text(w, "\ntimestep        ");
  packing_i_put_double(w, packing_i_deck_timestep(pack));
  packing_i_put_text(w, "\nthermo          ${every}\n"
                        "thermo_style    custom step atoms ke\n"
                        "thermo_modify   lost error\n"
                        "dump            frames all custom ${every} ");
  packing_i_put_text(w, pack->deck.dump_name);
  packing_i_put_text(w, " id type radius x y z vx vy vz omegax omegay omegaz\n"
                        "dump_modify     frames sort id format ");
}
