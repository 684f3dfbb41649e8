/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crop, scale, shift: particles, bonds and container together. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/pack.h"
#include "../common/program.h"
#include "convert.h"

static const packing_field place_fields[] = {PACKING_FIELD_X, PACKING_FIELD_Y,
                                             PACKING_FIELD_Z};

int convert_failed(const convert_job *job, const change *c, packing_status status)
{
  char where[32];
  snprintf(where, sizeof where, "--%s", change_names[c->kind]);
  return program_status(job->context, status, where);
}

double *convert_take_numbers(size_t count)
{
  double *made = malloc((count ? count : 1) * sizeof *made);
  if (!made)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  return made;
}

/* ---- the container ---- */

int convert_set_domain(convert_job *job, const char *option, char *text)
{
  free(job->domain_text);
  packing_domain_destroy(job->domain);
  job->domain_text = text;
  job->domain = NULL;
  const int code = domain_spec_parse_as(option, text, &job->spec);
  return code ? code : domain_spec_create(job->context, &job->spec, &job->domain);
}

/* The container of a changed spec. */
static int set_spec(convert_job *job, const char *option, const domain_spec *spec)
{
  return job->domain ? convert_set_domain(job, option, domain_spec_text(spec)) : 0;
}

/* ---- scale and shift ---- */

/* A column becomes factor * (column) + term. */
static packing_status map_column(packing_particles *particles, packing_field field,
                                 double factor, double term)
{
  const size_t count = packing_particles_count(particles);
  double *numbers = convert_take_numbers(count);
  packing_status status =
      packing_particles_extract(particles, field, numbers, sizeof *numbers);
  for (size_t i = 0; i < count; i++)
    numbers[i] = factor * numbers[i] + term;
  if (status == PACKING_OK)
    status = packing_particles_set(particles, field, numbers, sizeof *numbers);
  free(numbers);
  return status;
}

static int scale(convert_job *job, const change *c)
{
  static const packing_field fields[] = {
      PACKING_FIELD_X,  PACKING_FIELD_Y,  PACKING_FIELD_Z, PACKING_FIELD_R,
      PACKING_FIELD_VX, PACKING_FIELD_VY, PACKING_FIELD_VZ};
  packing_particles *particles = job->asked->in.particles;
  const int moving =
      (packing_particles_columns(particles) & PACKING_COLUMN_VELOCITY) != 0;
  packing_status status = PACKING_OK;
  for (int k = 0; k < (moving ? 7 : 4) && status == PACKING_OK; k++)
    status = map_column(particles, fields[k], c->factor, 0);
  if (status != PACKING_OK)
    return convert_failed(job, c, status);
  domain_spec spec = job->spec;
  domain_spec_scale(&spec, c->factor);
  return set_spec(job, "--scale", &spec);
}

static int shift(convert_job *job, const change *c)
{
  const double by[] = {c->by.x, c->by.y, c->by.z};
  packing_status status = PACKING_OK;
  if (job->spec.dim == 2 && c->by.z != 0)
    return program_fail(PROGRAM_BAD_INPUT, "--shift: Z must be 0 in two dimensions");
  if (job->spec.dim == 3 && c->numbers < 3)
    return program_fail(PROGRAM_BAD_INPUT, "--shift: '%s' is not X,Y,Z", c->text);
  for (int k = 0; k < job->spec.dim && status == PACKING_OK; k++)
    status = map_column(job->asked->in.particles, place_fields[k], 1, by[k]);
  if (status != PACKING_OK)
    return convert_failed(job, c, status);
  domain_spec spec = job->spec;
  domain_spec_shift(&spec, c->by);
  return set_spec(job, "--shift", &spec);
}

/* ---- crop ---- */

/* Bonds of what is kept; `place` has each particle's index among these, or PACKING_NO_INDEX. */
static void crop_bonds(convert_job *job, const size_t *place)
{
  size_t kept = 0;
  for (size_t k = 0; k < job->bond_count; k++) {
    packing_bond b = job->bonds[k];
    b.i = place[b.i];
    b.j = place[b.j];
    if (b.i != PACKING_NO_INDEX && b.j != PACKING_NO_INDEX)
      job->bonds[kept++] = b;
  }
  job->bond_count = kept;
}

static packing_status keep_inside(convert_job *job, const packing_domain *keep)
{
  packing_particles *particles = job->asked->in.particles;
  const size_t count = packing_particles_count(particles);
  size_t *place = program_take(count, sizeof *place);
  size_t *gone = program_take(count, sizeof *gone);
  size_t left = 0, kept = 0;
  pack p = {.view = {0}};
  packing_particles_view(particles, &p.view);
  for (size_t i = 0; i < count; i++) {
    const packing_vec3 centre = pack_centre(&p, i);
    const double r = job->asked->by_centres ? 0 : pack_radius(&p, i);
    if (packing_domain_holds(keep, &centre, r)) {
      place[i] = kept++;
    } else {
      place[i] = PACKING_NO_INDEX;
      gone[left++] = i;
    }
  }
  const packing_status status = packing_particles_remove(particles, gone, left);
  if (status == PACKING_OK)
    crop_bonds(job, place);
  free(gone);
  free(place);
  return status;
}

static int crop(convert_job *job, const change *c)
{
  if (c->keep.dim != job->spec.dim)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--crop: %s has %d dimensions, the pack has %d", c->text,
                        c->keep.dim, job->spec.dim);
  const int code =
      convert_set_domain(job, "--crop", program_copy(c->text, strlen(c->text)));
  if (code)
    return code;
  const packing_status status = keep_inside(job, job->domain);
  return status == PACKING_OK ? 0 : convert_failed(job, c, status);
}

/* ---- ids ---- */

packing_status convert_number_ids(packing_particles *particles)
{
  const size_t count = packing_particles_count(particles);
  int64_t *ids = program_take(count, sizeof *ids);
  for (size_t i = 0; i < count; i++)
    ids[i] = (int64_t)i + 1;
  const packing_status status =
      packing_particles_set(particles, PACKING_FIELD_ID, ids, sizeof *ids);
  free(ids);
  return status;
}

static int renumber(convert_job *job, const change *c)
{
  packing_particles *particles = job->asked->in.particles;
  packing_status status = packing_particles_add_columns(particles, PACKING_COLUMN_ID);
  if (status == PACKING_OK)
    status = convert_number_ids(particles);
  return status == PACKING_OK ? 0 : convert_failed(job, c, status);
}

/* ---- all of them ---- */

typedef int (*changer)(convert_job *job, const change *c);

int convert_change(convert_job *job)
{
  static const changer changers[] = {
      [CHANGE_CROP] = crop,         [CHANGE_SCALE] = scale,
      [CHANGE_SHIFT] = shift,       [CHANGE_REPLICATE] = convert_replicate,
      [CHANGE_BOND] = convert_bond, [CHANGE_RENUMBER] = renumber,
  };
  const convert_options *o = job->asked;
  int code = 0;
  for (size_t i = 0; i < o->change_count && !code; i++)
    code = interrupted() ? program_interrupted()
                         : changers[o->changes[i].kind](job, &o->changes[i]);
  return code;
}
