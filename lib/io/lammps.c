/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LAMMPS data for `atom_style sphere`; LIGGGHTS reads the same file (atom_style sphere or
 * granular). Tried with lmp 29Sep2021u2 and liggghts 3.8.0: the first line must exist, ids
 * need not be in a row, a centre at or beyond the upper faces of the box is lost. Linear in
 * the particles; memory only where ids are not rising (two arrays, to find one used twice). */
#include "io_internal.h"
#include "view.h"
#include <float.h>

const packing_i_format packing_i_format_lammps = {
    "lammps", ".data", "LAMMPS 29Sep2021, read_data, atom_style sphere",
    "centre, diameter, one density, type, id, velocity, spin, box"};

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

static packing_status check_inside(packing_context *context, const packing_view *v,
                                   const packing_bounds *box)
{
  for (size_t i = 0; i < v->count; i++) {
    const packing_vec3 p = packing_i_view_centre(v, i);
    if (!(p.x >= box->lo.x && p.x < box->hi.x && p.y >= box->lo.y && p.y < box->hi.y &&
          p.z >= box->lo.z && p.z < box->hi.z))
      return packing_i_fail(context, PACKING_ERR_RANGE, "box", i,
                            "the centre of particle %zu (%g, %g, %g) lies outside", i,
                            p.x, p.y, p.z);
    if (packing_i_view_r(v, i) > DBL_MAX / 2)
      return packing_i_fail(context, PACKING_ERR_RANGE, "r", i,
                            "particle %zu: no diameter of %g", i, packing_i_view_r(v, i));
  }
  return PACKING_OK;
}

/* Sorts by eight bits at a time, four passes, so that the result ends in `keys`. */
static void sort_ids(uint32_t *keys, uint32_t *spare, size_t count)
{
  enum { BITS = 8, BUCKETS = 1 << BITS };
  for (unsigned shift = 0; shift < 32; shift += BITS) {
    size_t start[BUCKETS + 1] = {0};
    for (size_t i = 0; i < count; i++)
      start[(keys[i] >> shift) % BUCKETS + 1]++;
    for (size_t b = 1; b < BUCKETS; b++)
      start[b] += start[b - 1];
    for (size_t i = 0; i < count; i++)
      spare[start[(keys[i] >> shift) % BUCKETS]++] = keys[i];
    uint32_t *swapped = keys;
    keys = spare;
    spare = swapped;
  }
}

static packing_status check_unique(packing_context *context, const packing_view *v)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_status status = PACKING_OK;
  uint32_t *ids = packing_i_alloc(allocator, v->count, 2 * sizeof *ids);
  if (ids == NULL)
    return packing_i_nomem(context);
  for (size_t i = 0; i < v->count; i++)
    ids[i] = (uint32_t)packing_i_view_id(v, i);
  sort_ids(ids, ids + v->count, v->count);
  for (size_t i = 1; i < v->count && status == PACKING_OK; i++)
    if (ids[i] == ids[i - 1])
      status = packing_i_fail(context, PACKING_ERR_INVALID, "id", PACKING_NO_INDEX,
                              "%lu stands twice", (unsigned long)ids[i]);
  packing_i_free(allocator, ids);
  return status;
}

static packing_status check_ids(packing_context *context, const packing_view *v)
{
  int rising = 1;
  for (size_t i = 0; i < v->count; i++) {
    const int64_t id = packing_i_view_id(v, i);
    if (id < 1 || id > INT32_MAX)
      return packing_i_fail(context, PACKING_ERR_RANGE, "id", i,
                            "particle %zu: %lld is not in 1 .. 2^31 - 1", i,
                            (long long)id);
    rising &= i == 0 || id > packing_i_view_id(v, i - 1);
  }
  return rising ? PACKING_OK : check_unique(context, v);
}

static packing_status largest_type(packing_context *context, const packing_view *v,
                                   int32_t *largest)
{
  *largest = 1;
  for (size_t i = 0; i < v->count; i++) {
    const int32_t type = packing_i_view_int(&v->type, i, 1);
    if (type < 1)
      return packing_i_fail(context, PACKING_ERR_RANGE, "type", i,
                            "particle %zu: %ld is below 1", i, (long)type);
    *largest = type > *largest ? type : *largest;
  }
  return PACKING_OK;
}

static void put_side(packing_i_writer *w, double lo, double hi, const char *names)
{
  packing_i_put_double(w, lo);
  packing_i_put_doubles(w, ' ', &hi, 1);
  packing_i_put_text(w, names);
}

static void put_header(packing_i_writer *w, const packing_lammps_def *d, size_t count,
                       int32_t types, const packing_bounds *box)
{
  packing_i_put_text(w, d->title == NULL ? "pack written by libpacking" : d->title);
  packing_i_put_text(w, "\n\n");
  packing_i_put_int(w, (int64_t)count);
  packing_i_put_text(w, " atoms\n");
  packing_i_put_int(w, types);
  packing_i_put_text(w, " atom types\n\n");
  put_side(w, box->lo.x, box->hi.x, " xlo xhi\n");
  put_side(w, box->lo.y, box->hi.y, " ylo yhi\n");
  put_side(w, box->lo.z, box->hi.z, " zlo zhi\n");
}

static void put_atoms(packing_i_writer *w, const packing_view *v, double density)
{
  packing_i_put_text(w, "\nAtoms # sphere\n\n");
  for (size_t i = 0; i < v->count && w->status == PACKING_OK; i++) {
    const packing_vec3 p = packing_i_view_centre(v, i);
    const double row[] = {2 * packing_i_view_r(v, i), density, p.x, p.y, p.z};
    packing_i_put_int(w, packing_i_view_id(v, i));
    packing_i_put_char(w, ' ');
    packing_i_put_int(w, packing_i_view_int(&v->type, i, 1));
    packing_i_put_doubles(w, ' ', row, 5);
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

packing_status packing_write_lammps(packing_context *context,
                                    const packing_lammps_def *def,
                                    const packing_view *view,
                                    const packing_stream *stream)
{
  packing_lammps_def d;
  packing_view v;
  packing_bounds box;
  packing_i_writer w;
  int32_t types;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_lammps, title, def, &d));
  PACKING_I_TRY(check_def(context, &d));
  if (view != NULL && view->count > INT32_MAX)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "%zu particles, LAMMPS takes 2^31 - 1", view->count);
  PACKING_I_TRY(packing_i_io_view(context, view, d.dim, &v));
  PACKING_I_TRY(packing_i_io_box(context, &v, &d.box, d.dim == 2, &box));
  PACKING_I_TRY(check_inside(context, &v, &box));
  PACKING_I_TRY(check_ids(context, &v));
  PACKING_I_TRY(largest_type(context, &v, &types));
  PACKING_I_TRY(packing_i_writer_begin(&w, context, &packing_i_format_lammps, stream));
  put_header(&w, &d, v.count, types, &box);
  put_atoms(&w, &v, d.density);
  if (v.count > 0 && (packing_i_view_has_velocity(&v) || packing_i_view_has_spin(&v)))
    put_velocities(&w, &v);
  return packing_i_writer_end(&w);
}
