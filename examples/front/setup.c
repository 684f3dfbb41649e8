/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was asked becomes handles. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "front.h"

const char front_program[] = "packing-front";

#define BAD(...) program_fail(PROGRAM_BAD_INPUT, __VA_ARGS__)

int front_status(const front_job *job, packing_status status)
{
  static const program_field rows[] = {{"volume_fraction", "--target-porosity"},
                                       {"select_particle", "--select"},
                                       {"select_neighbours", "--select"},
                                       {"classes", "--list"},
                                       {"regions", "--grade"},
                                       {"particles", "--in"},
                                       {NULL, NULL}};
  return program_field_status(job->context, status, "front", rows);
}

/* ---- container and sizes ---- */

static int read_container(front_job *job)
{
  const front_options *o = job->asked;
  if (o->in.text)
    return input_domain(&o->in, o->common.domain, &job->spec, &job->domain_text);
  job->domain_text = program_copy(o->common.domain, strlen(o->common.domain));
  return domain_spec_parse(job->domain_text, &job->spec);
}

static int create_container(front_job *job)
{
  int code = read_container(job);
  if (!code && job->spec.kind == DOMAIN_NONE)
    code = BAD("--domain is missing: %s tells none", job->asked->in.path);
  return code ? code
              : domain_spec_create_noting(job->context, &job->spec, &job->input,
                                          &job->domain);
}

/* SIZES@CONTAINER: a file's name may have the sign too, a container's modifiers have not. */
static int split_grade(front_grade *g)
{
  const char *at = strrchr(g->text, '@');
  if (!at || at == g->text || !at[1])
    return BAD("--grade: '%s' is not SIZES@CONTAINER", g->text);
  g->sizes = program_copy(g->text, (size_t)(at - g->text));
  g->where = program_copy(at + 1, strlen(at + 1));
  return 0;
}

static int create_grade(front_job *job, front_grade *g)
{
  int code = split_grade(g);
  if (!code)
    code = domain_spec_parse_as("--grade", g->where, &g->spec);
  if (!code && g->spec.dim != job->spec.dim)
    code = BAD("--grade: %s has %d dimensions, the container %d", g->where, g->spec.dim,
               job->spec.dim);
  if (!code)
    code = domain_spec_create_noting(job->context, &g->spec, &job->input, &g->domain);
  return code ? code
              : psd_spec_create(job->context, g->sizes, job->spec.dim, &g->psd,
                                &job->input);
}

int front_grades_create(front_job *job)
{
  const front_options *o = job->asked;
  int code = 0;
  job->grades = program_take(o->grade_count, sizeof *job->grades);
  for (size_t i = 0; i < o->grade_count && !code; i++) {
    job->grades[i].text = o->grades[i];
    job->grades[i].ks = job->grades[i].ks_limit = (double)NAN;
    code = create_grade(job, &job->grades[i]);
  }
  return code;
}

/* What stands in captions and notes. */
static void tell_sizes(front_job *job)
{
  const front_options *o = job->asked;
  char *all = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&all, &size);
  if (!to)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  fprintf(to, "%s%s", o->list ? "list:" : "", o->list ? o->list : o->common.psd);
  for (size_t i = 0; i < o->grade_count; i++)
    fprintf(to, "; %s", o->grades[i]);
  const int failed = ferror(to);
  if (fclose(to) != 0 || failed || !all)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  job->psd_text = all;
}

static int create_sizes(front_job *job)
{
  const front_options *o = job->asked;
  int code = o->list ? front_list_read(job)
                     : psd_spec_create(job->context, o->common.psd, job->spec.dim,
                                       &job->psd, &job->input);
  if (!code)
    code = front_grades_create(job);
  if (!code)
    tell_sizes(job);
  return code;
}

/* ---- particles ---- */

static int is_mixture(const front_job *job)
{
  int mixture = job->psd && packing_psd_components(job->psd) > 1;
  for (size_t i = 0; i < job->asked->grade_count; i++)
    mixture |= packing_psd_components(job->grades[i].psd) > 1;
  return mixture;
}

static int create_store(front_job *job)
{
  packing_particles_def def;
  packing_particles_def_init(&def);
  def.dim = job->spec.dim;
  def.columns = is_mixture(job) ? PACKING_COLUMN_COMPONENT : 0;
  const packing_status status =
      packing_particles_create(job->context, &def, &job->particles);
  return status == PACKING_OK ? 0 : program_status(job->context, status, "particles");
}

/* Puts the particles of --in into the store; how much of the container they fill. */
int front_standing_read(front_job *job)
{
  packing_volume_report volume;
  packing_view view;
  if (!job->asked->in.text)
    return 0;
  packing_particles_view(job->asked->in.particles, &view);
  packing_volume_report_init(&volume);
  packing_status status = packing_particles_assign(job->particles, &view);
  if (status == PACKING_OK && view.count > 0)
    status = packing_measure_volume(job->context, NULL, job->domain, &view, &volume);
  job->standing = view.count;
  job->standing_fraction = volume.volume_fraction;
  return status == PACKING_OK ? 0 : program_status(job->context, status, "--in");
}

/* ---- the placer ---- */

/* What is to be placed, as a volume fraction; 0: not asked in that way. */
static int set_target(front_job *job)
{
  const options *o = &job->asked->common;
  const double whole = packing_domain_volume(job->domain);
  if (!isnan(o->mass))
    job->target = o->mass / o->density / whole;
  if (!isnan(o->porosity))
    job->target = 1 - o->porosity - job->standing_fraction;
  if (job->target > 1)
    return BAD("--mass: %.9g at density %.9g is a volume of %.9g, the container has %.9g",
               o->mass, o->density, o->mass / o->density, whole);
  if (!isnan(o->porosity) && !(job->target > 0))
    return BAD("--target-porosity: the particles of --in leave %.6g, less than %.6g",
               1 - job->standing_fraction, o->porosity);
  return 0;
}

static int create_placer(front_job *job)
{
  const front_options *o = job->asked;
  packing_front_region *regions = program_take(o->grade_count, sizeof *regions);
  packing_front_def def;
  packing_front_def_init(&def);
  def.mode = o->mode;
  def.seed = o->common.seed;
  def.stream = o->common.stream;
  def.count = o->common.count;
  def.volume_fraction = o->loosen_given ? 0 : job->target;
  def.direction = o->direction;
  def.select_particle = o->select[0];
  def.select_neighbours = o->select[1];
  def.contact = o->contact;
  def.stock = o->stock_count;
  def.classes = job->list.classes;
  def.class_count = job->list.count;
  for (size_t i = 0; i < o->grade_count; i++)
    regions[i] = (packing_front_region){job->grades[i].domain, job->grades[i].psd};
  def.regions = o->grade_count ? regions : NULL;
  def.region_count = o->grade_count;
  const packing_status status = packing_front_create(
      job->context, &def, job->domain, job->psd, job->particles, &job->placer);
  free(regions);
  return status == PACKING_OK ? 0 : front_status(job, status);
}

static int read_input(front_job *job)
{
  input *in = &job->asked->in;
  if (!in->text)
    return 0;
  input_announce(in, &job->input);
  return input_read(in, job->context, &job->input);
}

/* Of those that are there from the start; of a list the mean of its radii. */
static double mean_r(const front_job *job)
{
  double sum = 0, count = 0, mean = 0;
  for (size_t i = 0; i < job->list.count; i++) {
    count += (double)job->list.classes[i].count;
    sum += (double)job->list.classes[i].count * job->list.classes[i].r;
  }
  if (job->psd && packing_psd_moment(job->psd, PACKING_BY_NUMBER, 1, &mean) == PACKING_OK)
    return mean;
  return sum / count;
}

static int read_forces(front_job *job)
{
  front_options *o = job->asked;
  if (!o->settle)
    return 0;
  int code =
      forces_read(&job->forces, &o->forces, job->spec.dim, job->spec.periodic, "pack");
  if (!code)
    code = forces_fill_in(&job->forces, mean_r(job), 0, 0);
  return code ? code : forces_create(&job->forces, job->context, o->common.density);
}

int front_set_up(front_job *job)
{
  static int (*const steps[])(front_job *) = {
      read_input,   create_container,    create_sizes, read_forces,
      create_store, front_standing_read, set_target,   create_placer};
  int code = options_context(&job->asked->common, &job->context);
  for (size_t i = 0; i < sizeof steps / sizeof steps[0] && !code; i++)
    code = steps[i](job);
  return code ? code
              : outputs_check(&job->asked->common.outputs, job->context, &job->input);
}

void front_clean_up(front_job *job)
{
  front_frames_free(job);
  free(job->marks);
  free(job->components);
  packing_placer_destroy(job->placer);
  packing_particles_destroy(job->grown);
  packing_particles_destroy(job->particles);
  forces_free(&job->forces);
  for (size_t i = 0; job->grades && i < job->asked->grade_count; i++) {
    packing_psd_destroy(job->grades[i].psd);
    packing_domain_destroy(job->grades[i].domain);
    free(job->grades[i].where);
    free(job->grades[i].sizes);
  }
  free(job->grades);
  free(job->list.left);
  free(job->list.classes);
  packing_psd_destroy(job->psd);
  packing_domain_destroy(job->domain);
  packing_context_destroy(job->context);
  input_files_free(&job->input);
  free(job->psd_text);
  free(job->domain_text);
}
