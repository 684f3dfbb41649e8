/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was asked becomes numbers and handles. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "../common/settling.h"
#include "layers.h"

const char layers_program[] = "packing-layers";

#define BAD(...) program_fail(PROGRAM_BAD_INPUT, __VA_ARGS__)

/* The data of section 5. */
typedef struct example_row {
  const char *name;
  int dim;
  const char *psd;
} example_row;

static const example_row examples[] = {
    {"5.1", 2, "mono:0.01"},
    {"5.2", 2, "normal:0.01,0.001,0.007,0.013"},
    {"5.3", 3, "mono:0.02"},
    {"5.4", 3, "normal:0.02,0.002,0.014,0.026"},
};
static const double EXAMPLE_HEIGHT = 0.5, EXAMPLE_DRAG = 0.005, EXAMPLE_DT = 1e-4;
static const double EXAMPLE_TIME = 1;

static const example_row *find_example(const char *name)
{
  for (size_t i = 0; name && i < sizeof examples / sizeof examples[0]; i++)
    if (strcmp(examples[i].name, name) == 0)
      return &examples[i];
  return NULL;
}

static double given(double value, double otherwise)
{
  return isnan(value) ? otherwise : value;
}

__attribute__((format(printf, 1, 2))) static char *format(const char *form, ...)
{
  va_list arguments;
  char *text = NULL;
  va_start(arguments, form);
  const int length = vasprintf(&text, form, arguments);
  va_end(arguments);
  if (length < 0)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  return text;
}

/* ---- the container ---- */

/* The texts that stand for --domain and --psd. */
static int choose_specs(layers_job *job)
{
  layers_options *o = job->asked;
  const example_row *row = find_example(o->example);
  const char *domain = o->common.domain, *psd = o->common.psd;
  if (!row && !domain)
    return BAD("--domain is missing (or --example); see --help");
  if (!row && !psd)
    return BAD("--psd is missing (or --example); see --help");
  if (domain)
    job->domain_text = program_copy(domain, strlen(domain));
  else {
    const double height = given(o->height, EXAMPLE_HEIGHT);
    const int dim = o->dim ? (int)o->dim : row->dim;
    job->domain_text = format(dim == 2 ? "rect:1,%.15g" : "box:1,1,%.15g", height);
  }
  if (!psd)
    psd = row->psd;
  job->psd_text = program_copy(psd, strlen(psd));
  return 0;
}

/* Puts --height into a container that was given; pictures say so. */
static int set_height(layers_job *job)
{
  domain_spec *spec = &job->spec;
  double *height = job->closed ? NULL : domain_spec_height(spec);
  if (isnan(job->asked->height) || !job->asked->common.domain)
    return 0;
  if (!height)
    return BAD("--height: '%s' has none of its own", job->domain_text);
  *height = job->asked->height;
  char *text = format("%s, height %.15g", job->domain_text, *height);
  free(job->domain_text);
  spec->text = job->domain_text = text;
  return 0;
}

static int check_periodic(const domain_spec *spec)
{
  const unsigned up = spec->dim == 2 ? PACKING_PERIODIC_Y : PACKING_PERIODIC_Z;
  if (spec->periodic & up)
    return BAD("--domain: +periodic: layers need a floor; periodic in %s only",
               spec->dim == 2 ? "x" : "xy");
  return 0;
}

/* A body of revolution on its side, a sphere, a circle or an annulus stays closed. */
static int choose_container(layers_job *job)
{
  domain_spec *spec = &job->spec;
  int code = domain_spec_parse(job->domain_text, spec);
  if (!code && job->asked->dim && (int)job->asked->dim != spec->dim)
    code = BAD("--dim: '%s' has %d dimensions", job->domain_text, spec->dim);
  if (code)
    return code;
  job->closed = !domain_spec_height(spec) || spec->axis != PACKING_AXIS_Z;
  if (job->closed && spec->open_top)
    return BAD("--domain: +open: its top is at a side, and the particles would fall out");
  spec->open_top = !job->closed;
  code = check_periodic(spec);
  return code ? code : set_height(job);
}

static int create_container(layers_job *job)
{
  packing_bounds bounds;
  const int code =
      domain_spec_create_noting(job->context, &job->spec, &job->input, &job->domain);
  if (code)
    return code;
  packing_domain_bounds(job->domain, &bounds);
  job->floor = job->spec.dim == 2 ? bounds.lo.y : bounds.lo.z;
  job->top = job->spec.dim == 2 ? bounds.hi.y : bounds.hi.z;
  job->asked->height = job->top - job->floor;
  return 0;
}

/* ---- numbers ---- */

/* What was not given; lengths and times in proportion to the container and the particles. */
static int fill_in(layers_job *job)
{
  layers_options *o = job->asked;
  const int paper = o->example != NULL;
  /* 2.5 diameters are what example 5.3 has; thinner layers hold little. */
  const double least = paper ? 0 : 5 * packing_psd_max_r(job->psd);
  o->layer_height = given(o->layer_height, fmax(0.2 * o->height, least));
  o->layer_density = given(o->layer_density, job->spec.dim == 2 ? 0.4 : 0.25);
  o->layer_time =
      given(o->layer_time,
            paper ? EXAMPLE_TIME : sqrt(20 * o->layer_height / job->forces.down));
  o->layer_time_max = given(o->layer_time_max, 10 * o->layer_time);
  o->rest_tolerance = given(o->rest_tolerance, 1e-4);
  return forces_fill_in(&job->forces, job->mean_r, paper ? EXAMPLE_DRAG : 0,
                        paper ? EXAMPLE_DT : 0);
}

/* More are taken for a slip of the pen: they would take weeks. */
static const double PARTICLES_MOST = 1e9;

static int check_numbers(const layers_job *job)
{
  const layers_options *o = job->asked;
  /* A little more than a diameter: centres need a space, not a plane. */
  const double widest = 2.002 * packing_psd_max_r(job->psd);
  const uint64_t streams = (UINT64_C(1) << 52) - PACKS_MOST * PACKS_MOST;
  if (o->layer_height < widest)
    return BAD(
        "--layer-height: %.9g (where not given, 0.2 of the height) is not more than "
        "the largest diameter %.9g",
        o->layer_height, 2 * packing_psd_max_r(job->psd));
  if (o->layer_time_max < o->layer_time)
    return BAD("--layer-time-max: %.9g is less than --layer-time %.9g", o->layer_time_max,
               o->layer_time);
  if (o->common.stream >= streams)
    return BAD("--stream: %llu is not below %llu", (unsigned long long)o->common.stream,
               (unsigned long long)streams);
  return settling_check("--layer-time-max", o->layer_time_max, o->forces.dt);
}

/* The mean radius; and whether the container holds a number of particles that can be made. */
static int look_at_sizes(layers_job *job)
{
  const int dim = job->spec.dim;
  double power = 0;
  packing_status status =
      packing_psd_moment(job->psd, PACKING_BY_NUMBER, 1, &job->mean_r);
  if (status == PACKING_OK)
    status = packing_psd_moment(job->psd, PACKING_BY_NUMBER, dim, &power);
  if (status != PACKING_OK)
    return program_status(job->context, status, "--psd");
  const double particles = packing_domain_volume(job->domain) / (4 * power);
  return particles <= PARTICLES_MOST
             ? 0
             : BAD("--psd: some %.1g particles would be needed, more than %.0e",
                   particles, PARTICLES_MOST);
}

static int check_outputs(layers_job *job)
{
  layers_options *o = job->asked;
  const int code = outputs_number(&o->common.outputs, o->sets, o->packs);
  return code ? code : outputs_check(&o->common.outputs, job->context, &job->input);
}

int layers_set_up(layers_job *job)
{
  int code = choose_specs(job);
  if (!code)
    code = choose_container(job);
  if (!code)
    code = forces_read(&job->forces, &job->asked->forces, job->spec.dim,
                       job->spec.periodic, "layer");
  if (!code)
    code = options_context(&job->asked->common, &job->context);
  if (!code)
    code = create_container(job);
  if (!code)
    code = psd_spec_create(job->context, job->psd_text, job->spec.dim, &job->psd,
                           &job->input);
  if (!code)
    code = look_at_sizes(job);
  if (!code)
    code = fill_in(job);
  if (!code)
    code = check_numbers(job);
  if (!code)
    code = forces_create(&job->forces, job->context, job->asked->common.density);
  if (!code)
    code = check_outputs(job);
  return code ? code : columns_create(&job->columns, job->domain, job->top, job->mean_r);
}

void layers_clean_up(layers_job *job)
{
  columns_free(&job->columns);
  forces_free(&job->forces);
  packing_psd_destroy(job->psd);
  packing_domain_destroy(job->domain);
  packing_context_destroy(job->context);
  input_files_free(&job->input);
  free(job->psd_text);
  free(job->domain_text);
}
