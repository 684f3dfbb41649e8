/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was asked becomes numbers and handles. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
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
  const int code = domain_spec_create_noting(job->context, &job->spec, &job->input, &job->domain);
  if (code)
    return code;
  packing_domain_bounds(job->domain, &bounds);
  job->floor = job->spec.dim == 2 ? bounds.lo.y : bounds.lo.z;
  job->top = job->spec.dim == 2 ? bounds.hi.y : bounds.hi.z;
  job->asked->height = job->top - job->floor;
  return 0;
}

/* ---- numbers ---- */

static int read_list(const char *option, const char *form, const char *text, double *list,
                     size_t count)
{
  size_t found = 0;
  char *copy = program_copy(text, strlen(text));
  char **words = spec_split(copy, ',', &found);
  int code = found == count ? 0 : BAD("%s: '%s' is not %s", option, text, form);
  for (size_t i = 0; i < count && !code; i++)
    code = number_real(option, words[i], &list[i]);
  free(words);
  free(copy);
  return code;
}

static int read_gravity_vector(layers_job *job)
{
  const int dim = job->spec.dim;
  double g[3] = {0, 0, 0};
  const int code = read_list("--gravity", dim == 2 ? "G or GX,GY" : "G or GX,GY,GZ",
                             job->asked->gravity, g, (size_t)dim);
  job->gravity = (packing_vec3){g[0], g[1], g[2]};
  job->down = -g[dim - 1];
  if (!code && !(job->down > 0))
    return BAD("--gravity: %s does not point downwards (along -%c), so no layer settles",
               job->asked->gravity, dim == 2 ? 'y' : 'z');
  return code;
}

static int choose_gravity(layers_job *job)
{
  const char *text = job->asked->gravity;
  job->down = 2;
  if (text && strchr(text, ','))
    return read_gravity_vector(job);
  const int code = text ? number_positive("--gravity", text, &job->down) : 0;
  if (job->spec.dim == 2)
    job->gravity.y = -job->down;
  else
    job->gravity.z = -job->down;
  return code;
}

/* Without a wall in the way particles would slide for ever. */
static int check_tilt(const layers_job *job)
{
  const packing_vec3 g = job->gravity;
  const unsigned tilted = (fabs(g.x) > 0 ? PACKING_PERIODIC_X : 0u) |
                          (fabs(g.y) > 0 ? PACKING_PERIODIC_Y : 0u);
  return tilted & job->spec.periodic ? BAD("--gravity: %s has a part along a periodic "
                                           "direction: no layer settles",
                                           job->asked->gravity)
                                     : 0;
}

static int choose_near_field(layers_job *job)
{
  const char *text = job->asked->near_field;
  const int code =
      text ? read_list("--near-field", "A1,B1,A2,B2,CUTOFF", text, job->near_field, 5)
           : 0;
  if (!code && text && !(job->near_field[4] > 0))
    return BAD("--near-field: a cutoff of %.9g is not above 0", job->near_field[4]);
  return code;
}

static double size_of(packing_vec3 v)
{
  return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/* What was not given; lengths and times in proportion to the container and the particles. */
static void fill_in(layers_job *job)
{
  layers_options *o = job->asked;
  const int paper = o->example != NULL;
  /* 2.5 diameters are what example 5.3 has; thinner layers hold little. */
  const double least = paper ? 0 : 5 * packing_psd_max_r(job->psd);
  o->layer_height = given(o->layer_height, fmax(0.2 * o->height, least));
  o->layer_density = given(o->layer_density, job->spec.dim == 2 ? 0.4 : 0.25);
  o->layer_time =
      given(o->layer_time, paper ? EXAMPLE_TIME : sqrt(20 * o->layer_height / job->down));
  o->layer_time_max = given(o->layer_time_max, 10 * o->layer_time);
  o->rest_tolerance = given(o->rest_tolerance, 1e-4);
  o->young = given(o->young, 1e8);
  o->poisson = given(o->poisson, 0.25);
  o->damping = given(o->damping, 0.1);
  o->friction = given(o->friction, 0.2);
  o->drag = given(o->drag, paper ? EXAMPLE_DRAG : 0);
  o->slip_velocity =
      given(o->slip_velocity, 0.001 * sqrt(size_of(job->gravity) * job->mean_r));
  o->dt = given(o->dt, paper ? EXAMPLE_DT : 0);
}

/* More are taken for a slip of the pen: they would take weeks. */
static const double STEPS_MOST = 1e9, PARTICLES_MOST = 1e9;

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
  if (!isfinite(o->slip_velocity))
    return BAD("--gravity: %.9g is beyond what can be computed", size_of(job->gravity));
  if (o->layer_time_max < o->layer_time)
    return BAD("--layer-time-max: %.9g is less than --layer-time %.9g", o->layer_time_max,
               o->layer_time);
  if (o->layer_time_max < o->dt)
    return BAD("--dt: %.9g is more than --layer-time-max %.9g", o->dt, o->layer_time_max);
  if (o->dt > 0 && o->layer_time_max / o->dt > STEPS_MOST)
    return BAD("--dt: %.9g makes more than %.0e steps in --layer-time-max %.9g", o->dt,
               STEPS_MOST, o->layer_time_max);
  if (o->common.stream >= streams)
    return BAD("--stream: %llu is not below %llu", (unsigned long long)o->common.stream,
               (unsigned long long)streams);
  if (o->disc_mass && job->spec.dim == 3)
    return BAD("--disc-mass: spheres weigh as spheres");
  return 0;
}

/* ---- materials and laws ---- */

static packing_status create_material(layers_job *job)
{
  const layers_options *o = job->asked;
  packing_material_def def;
  packing_material_def_init(&def);
  def.density = o->common.density;
  def.young = o->young;
  def.poisson = o->poisson;
  def.damping = o->damping;
  def.friction = o->friction;
  const packing_status status = packing_materials_create(job->context, &job->materials);
  return status == PACKING_OK ? packing_materials_add(job->materials, &def, NULL)
                              : status;
}

static packing_status add_near_field(layers_job *job)
{
  packing_law_near_field_def def;
  packing_law_near_field_def_init(&def);
  def.attraction = job->near_field[0];
  def.attraction_exponent = job->near_field[1];
  def.repulsion = job->near_field[2];
  def.repulsion_exponent = job->near_field[3];
  def.cutoff = job->near_field[4];
  return packing_law_create_near_field(job->context, &def, &job->laws[job->law_count++]);
}

/* Friction reads what the law before it pushed. */
static packing_status create_laws(layers_job *job)
{
  packing_law_hertz_def hertz;
  packing_law_sliding_def sliding;
  packing_law_hertz_def_init(&hertz);
  packing_law_sliding_def_init(&sliding);
  hertz.pull = job->asked->pull;
  sliding.slip_velocity = job->asked->slip_velocity;
  packing_status status =
      packing_law_create_hertz(job->context, &hertz, &job->laws[job->law_count++]);
  if (status == PACKING_OK && job->asked->friction > 0)
    status =
        packing_law_create_sliding(job->context, &sliding, &job->laws[job->law_count++]);
  if (status == PACKING_OK && job->asked->near_field)
    status = add_near_field(job);
  return status;
}

static int create_model(layers_job *job)
{
  packing_status status = create_material(job);
  if (status == PACKING_OK)
    status = create_laws(job);
  if (status == PACKING_OK)
    return 0;
  /* The library's fields have the options' names, with another hyphen. */
  char *line = format("--%s", packing_context_message(job->context));
  for (char *c = line; *c && *c != ':'; c++)
    *c = *c == '_' ? '-' : *c;
  const int code = status == PACKING_ERR_NOMEM
                       ? program_status(job->context, status, "forces")
                       : BAD("%s", line);
  free(line);
  return code;
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
    code = choose_gravity(job);
  if (!code)
    code = check_tilt(job);
  if (!code)
    code = choose_near_field(job);
  if (!code)
    code = options_context(&job->asked->common, &job->context);
  if (!code)
    code = create_container(job);
  if (!code)
    code = psd_spec_create(job->context, job->psd_text, job->spec.dim, &job->psd,
                           &job->input);
  if (!code)
    code = look_at_sizes(job);
  if (code)
    return code;
  fill_in(job);
  code = check_numbers(job);
  if (!code)
    code = create_model(job);
  if (!code)
    code = check_outputs(job);
  return code ? code : columns_create(&job->columns, job->domain, job->top, job->mean_r);
}

void layers_clean_up(layers_job *job)
{
  columns_free(&job->columns);
  for (size_t i = 0; i < job->law_count; i++)
    packing_law_destroy(job->laws[i]);
  packing_materials_destroy(job->materials);
  packing_psd_destroy(job->psd);
  packing_domain_destroy(job->domain);
  packing_context_destroy(job->context);
  input_files_free(&job->input);
  free(job->psd_text);
  free(job->domain_text);
}
