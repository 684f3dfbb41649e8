/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The box again and again: particles, bonds and container. */
#include <math.h>
#include <stdlib.h>
#include "../common/pack.h"
#include "../common/program.h"
#include "convert.h"

/* The copies along each axis, and the period. */
typedef struct lattice {
  size_t times[3];
  double period[3];
  size_t count; /* particles of the pack itself */
} lattice;

static packing_vec3 offset(const lattice *l, size_t ix, size_t iy, size_t iz)
{
  return (packing_vec3){(double)ix * l->period[0], (double)iy * l->period[1],
                        (double)iz * l->period[2]};
}

/* Appends a copy of the first particles, whose columns `view` shows, moved. */
static packing_status append_copy(packing_particles *to, const packing_view *view,
                                  packing_vec3 by, double *moved)
{
  const pack p = {.view = *view};
  packing_view copy = *view;
  packing_column *places[] = {&copy.x, &copy.y, &copy.z};
  for (size_t i = 0; i < view->count; i++) {
    const packing_vec3 c = pack_centre(&p, i);
    moved[i] = c.x + by.x;
    moved[view->count + i] = c.y + by.y;
    moved[2 * view->count + i] = c.z + by.z;
  }
  for (size_t k = 0; k < 3; k++)
    *places[k] = (packing_column){moved + k * view->count, sizeof *moved};
  return packing_particles_append(to, &copy);
}

static packing_status copy_particles(const convert_job *job, const lattice *l,
                                     packing_particles *to)
{
  packing_view view;
  packing_status status = PACKING_OK;
  double *moved = convert_take_numbers(3 * l->count);
  packing_particles_view(job->asked->in.particles, &view);
  for (size_t iz = 0; iz < l->times[2]; iz++)
    for (size_t iy = 0; iy < l->times[1]; iy++)
      for (size_t ix = 0; ix < l->times[0] && status == PACKING_OK; ix++)
        status = append_copy(to, &view, offset(l, ix, iy, iz), moved);
  free(moved);
  if (status == PACKING_OK && (packing_particles_columns(to) & PACKING_COLUMN_ID))
    status = convert_number_ids(to);
  return status;
}

/* How many periods lie between the image of j that is next to i, and j itself. */
static void image_of(const convert_job *job, const lattice *l, const packing_bond *b,
                     long image[3])
{
  pack p = {.view = {0}};
  packing_particles_view(job->asked->in.particles, &p.view);
  const packing_vec3 from = pack_centre(&p, b->i), to = pack_centre(&p, b->j);
  const packing_vec3 near = packing_domain_separation(job->domain, &from, &to);
  const double across[] = {near.x - (to.x - from.x), near.y - (to.y - from.y),
                           near.z - (to.z - from.z)};
  for (int k = 0; k < 3; k++)
    image[k] = l->period[k] > 0 ? lround(across[k] / l->period[k]) : 0;
}

static size_t copy_of(const lattice *l, const long at[3])
{
  size_t place[3];
  for (int k = 0; k < 3; k++) {
    const long n = (long)l->times[k];
    place[k] = (size_t)(((at[k] % n) + n) % n);
  }
  return place[0] + l->times[0] * (place[1] + l->times[1] * place[2]);
}

static void copy_bond(const lattice *l, const packing_bond *b, const long image[3],
                      packing_bond *to)
{
  size_t made = 0;
  for (long iz = 0; iz < (long)l->times[2]; iz++)
    for (long iy = 0; iy < (long)l->times[1]; iy++)
      for (long ix = 0; ix < (long)l->times[0]; ix++) {
        const long there[3] = {ix + image[0], iy + image[1], iz + image[2]};
        to[made] = *b;
        to[made].i += l->count * made;
        to[made].j += l->count * copy_of(l, there);
        made++;
      }
}

static void copy_bonds(convert_job *job, const lattice *l)
{
  const size_t copies = l->times[0] * l->times[1] * l->times[2];
  packing_bond *bonds = program_take(job->bond_count * copies, sizeof *bonds);
  for (size_t k = 0; k < job->bond_count; k++) {
    long image[3];
    image_of(job, l, &job->bonds[k], image);
    copy_bond(l, &job->bonds[k], image, bonds + k * copies);
  }
  free(job->bonds);
  job->bonds = bonds;
  job->bond_count *= copies;
}

/* Whether the copies are few enough to be counted; says so if not. */
static int check_room(const lattice *l)
{
  const double most = (double)UINT32_MAX;
  const double all = (double)l->times[0] * (double)l->times[1] * (double)l->times[2];
  if (all * (double)(l->count ? l->count : 1) > most)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--replicate: %.0f particles are more than %.0f",
                        all * (double)l->count, most);
  return 0;
}

static int plan_copies(const convert_job *job, const change *c, lattice *l)
{
  packing_bounds cell;
  if (job->spec.kind != DOMAIN_BOX && job->spec.kind != DOMAIN_RECT)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--replicate: only a box or rect repeats, and %s",
                        job->domain ? "this container is none"
                                    : "nothing tells the container; see --domain");
  if (job->spec.open_top)
    return program_fail(PROGRAM_BAD_INPUT, "--replicate: a box with an open top does not "
                                           "repeat");
  if (job->spec.dim == 2 && c->times[2] != 1)
    return program_fail(PROGRAM_BAD_INPUT, "--replicate: NZ must be 1 in two dimensions");
  if (job->spec.dim == 3 && c->numbers < 3)
    return program_fail(PROGRAM_BAD_INPUT, "--replicate: '%s' is not NX,NY,NZ", c->text);
  packing_domain_bounds(job->domain, &cell);
  *l = (lattice){
      .times = {c->times[0], c->times[1], c->times[2]},
      .period = {cell.hi.x - cell.lo.x, cell.hi.y - cell.lo.y, cell.hi.z - cell.lo.z},
      .count = packing_particles_count(job->asked->in.particles)};
  return check_room(l);
}

static packing_status make_copies(convert_job *job, const lattice *l)
{
  packing_particles **old = &job->asked->in.particles, *made = NULL;
  packing_particles_def def;
  packing_particles_def_init(&def);
  def.dim = packing_particles_dim(*old);
  def.columns = packing_particles_columns(*old);
  def.capacity = l->count * l->times[0] * l->times[1] * l->times[2];
  packing_status status = packing_particles_create(job->context, &def, &made);
  if (status == PACKING_OK)
    status = copy_particles(job, l, made);
  if (status != PACKING_OK) {
    packing_particles_destroy(made);
    return status;
  }
  copy_bonds(job, l);
  packing_particles_destroy(*old);
  *old = made;
  return PACKING_OK;
}

int convert_replicate(convert_job *job, const change *c)
{
  lattice l = {.count = 0};
  packing_bounds cell;
  const int code = plan_copies(job, c, &l);
  if (code)
    return code;
  const packing_status status = make_copies(job, &l);
  if (status != PACKING_OK)
    return convert_failed(job, c, status);
  packing_domain_bounds(job->domain, &cell);
  cell.hi.x = cell.lo.x + (double)l.times[0] * l.period[0];
  cell.hi.y = cell.lo.y + (double)l.times[1] * l.period[1];
  cell.hi.z = cell.lo.z + (double)l.times[2] * l.period[2];
  return convert_set_domain(job, "--replicate",
                            input_box_text(job->spec.dim, &cell, job->spec.periodic));
}
