/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LAMMPS data for `atom_style sphere`; LIGGGHTS reads the same file (atom_style sphere or
 * granular). Tried with lmp 29Sep2021u2 and liggghts 3.8.0: the first line must exist, ids
 * need not be in a row, a centre at or beyond the upper faces of the box is lost. With bonds it
 * is data for `atom_style hybrid sphere bond`, where particles that hold together are one
 * molecule. Linear in the particles; memory only where ids are not rising or bonds are there. */
#include "io_internal.h"
#include "view.h"
#include <float.h>

const packing_i_format packing_i_format_lammps = {
    "lammps", ".data", "LAMMPS 29Sep2021, read_data, atom_style sphere",
    "centre, diameter, one density, type, id, velocity, spin, box, bonds"};

void packing_lammps_def_fill(packing_lammps_def *def, size_t size)
{
  packing_lammps_def defaults = {0};
  defaults.dim = 3;
  defaults.density = 1000;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_def(packing_context *context, const packing_lammps_def *d)
{
  if (d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_INVALID, "dim", PACKING_NO_INDEX,
                          "%d is neither 2 nor 3", d->dim);
  PACKING_I_TRY(packing_i_check_positive(context, "density", d->density));
  if (d->title != NULL && strpbrk(d->title, "\r\n") != NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "title", PACKING_NO_INDEX,
                          "it holds a newline");
  return PACKING_OK;
}

static void put_side(packing_i_writer *w, double lo, double hi, const char *names)
{
  packing_i_put_double(w, lo);
  packing_i_put_doubles(w, ' ', &hi, 1);
  packing_i_put_text(w, names);
}

static void put_count(packing_i_writer *w, size_t count, const char *what)
{
  packing_i_put_int(w, (int64_t)count);
  packing_i_put_text(w, what);
}

/* What was found out about a pack before writing. */
typedef struct found {
  packing_bounds box;
  int32_t types, bond_types;
  uint32_t *molecules; /* of each particle, with bonds only */
} found;

static void put_header(packing_i_writer *w, const packing_lammps_def *d, size_t count,
                       const found *f)
{
  packing_i_put_text(w, d->title == NULL ? "pack written by libpacking" : d->title);
  packing_i_put_text(w, "\n\n");
  put_count(w, count, " atoms\n");
  put_count(w, (size_t)f->types, " atom types\n");
  if (d->bond_count > 0) {
    put_count(w, d->bond_count, " bonds\n");
    put_count(w, (size_t)f->bond_types, " bond types\n");
  }
  packing_i_put_char(w, '\n');
  put_side(w, f->box.lo.x, f->box.hi.x, " xlo xhi\n");
  put_side(w, f->box.lo.y, f->box.hi.y, " ylo yhi\n");
  put_side(w, f->box.lo.z, f->box.hi.z, " zlo zhi\n");
}

static void put_name(packing_i_writer *w, const packing_view *v, size_t i)
{
  packing_i_put_int(w, packing_i_view_id(v, i));
  packing_i_put_char(w, ' ');
  packing_i_put_int(w, packing_i_view_int(&v->type, i, 1));
}

static void put_atoms(packing_i_writer *w, const packing_view *v, double density)
{
  packing_i_put_text(w, "\nAtoms # sphere\n\n");
  for (size_t i = 0; i < v->count && w->status == PACKING_OK; i++) {
    const packing_vec3 p = packing_i_view_centre(v, i);
    const double row[] = {2 * packing_i_view_r(v, i), density, p.x, p.y, p.z};
    put_name(w, v, i);
    packing_i_put_doubles(w, ' ', row, 5);
    packing_i_put_char(w, '\n');
  }
}

/* The columns of `atom_style hybrid sphere bond`. */
static void put_bonded_atoms(packing_i_writer *w, const packing_view *v, double density,
                             const uint32_t *molecules)
{
  packing_i_put_text(w, "\nAtoms # hybrid\n\n");
  for (size_t i = 0; i < v->count && w->status == PACKING_OK; i++) {
    const packing_vec3 p = packing_i_view_centre(v, i);
    const double row[] = {p.x, p.y, p.z, 2 * packing_i_view_r(v, i), density};
    put_name(w, v, i);
    packing_i_put_doubles(w, ' ', row, 5);
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, molecules[i]);
    packing_i_put_char(w, '\n');
  }
}

static void put_velocities(packing_i_writer *w, const packing_view *v)
{
  packing_i_put_text(w, "\nVelocities\n\n");
  for (size_t i = 0; i < v->count && w->status == PACKING_OK; i++) {
    const double row[] = {
        packing_i_view_number(&v->vx, i), packing_i_view_number(&v->vy, i),
        packing_i_view_number(&v->vz, i), packing_i_view_number(&v->wx, i),
        packing_i_view_number(&v->wy, i), packing_i_view_number(&v->wz, i)};
    packing_i_put_int(w, packing_i_view_id(v, i));
    packing_i_put_doubles(w, ' ', row, 6);
    packing_i_put_char(w, '\n');
  }
}

static void put_bonds(packing_i_writer *w, const packing_view *v,
                      const packing_bond *bonds, size_t count)
{
  packing_i_put_text(w, "\nBonds\n\n");
  for (size_t k = 0; k < count && w->status == PACKING_OK; k++) {
    packing_i_put_int(w, (int64_t)k + 1);
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, bonds[k].type);
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, packing_i_view_id(v, bonds[k].i));
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, packing_i_view_id(v, bonds[k].j));
    packing_i_put_char(w, '\n');
  }
}

static packing_status check_diameters(packing_context *context, const packing_view *v)
{
  for (size_t i = 0; i < v->count; i++)
    if (packing_i_view_r(v, i) > DBL_MAX / 2)
      return packing_i_fail(context, PACKING_ERR_RANGE, "r", i,
                            "particle %zu: no diameter of %g", i, packing_i_view_r(v, i));
  return PACKING_OK;
}

/* f->molecules is the caller's to free. */
static packing_status look(packing_context *context, const packing_lammps_def *d,
                           const packing_view *v, found *f)
{
  PACKING_I_TRY(packing_i_io_box(context, v, &d->box, d->dim == 2, &f->box));
  PACKING_I_TRY(packing_i_check_inside(context, v, &f->box));
  PACKING_I_TRY(check_diameters(context, v));
  PACKING_I_TRY(packing_i_check_ids(context, v, 1));
  PACKING_I_TRY(packing_i_check_types(context, v, &f->types));
  PACKING_I_TRY(packing_i_check_bonds(context, v->count, d->bonds, d->bond_count));
  PACKING_I_TRY(packing_i_bond_types(context, d->bonds, d->bond_count, &f->bond_types));
  if (d->bond_count == 0)
    return PACKING_OK;
  return packing_i_bond_groups(context, v->count, d->bonds, d->bond_count, &f->molecules);
}

static packing_status write_found(packing_context *context, const packing_lammps_def *d,
                                  const packing_view *v, const found *f,
                                  const packing_stream *stream)
{
  packing_i_writer w;
  PACKING_I_TRY(packing_i_writer_begin(&w, context, &packing_i_format_lammps, stream));
  put_header(&w, d, v->count, f);
  if (d->bond_count > 0)
    put_bonded_atoms(&w, v, d->density, f->molecules);
  else
    put_atoms(&w, v, d->density);
  if (v->count > 0 && (packing_i_view_has_velocity(v) || packing_i_view_has_spin(v)))
    put_velocities(&w, v);
  if (d->bond_count > 0)
    put_bonds(&w, v, d->bonds, d->bond_count);
  return packing_i_writer_end(&w);
}

packing_status packing_write_lammps(packing_context *context,
                                    const packing_lammps_def *def,
                                    const packing_view *view,
                                    const packing_stream *stream)
{
  packing_lammps_def d;
  packing_view v;
  found f = {.molecules = NULL};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_lammps, title, def, &d));
  PACKING_I_TRY(check_def(context, &d));
  if (view != NULL && view->count > INT32_MAX)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "%zu particles, LAMMPS takes 2^31 - 1", view->count);
  PACKING_I_TRY(packing_i_io_view(context, view, d.dim, &v));
  packing_status status = look(context, &d, &v, &f);
  if (status == PACKING_OK)
    status = write_found(context, &d, &v, &f, stream);
  packing_i_free(packing_i_allocator(context), f.molecules);
  return status;
}
