/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "forces.h"
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "options.h"
#include "program.h"
#include "report.h"
#include "spec.h"

#define BAD(...) program_fail(PROGRAM_BAD_INPUT, __VA_ARGS__)

/* ---- options ---- */

enum {
  KEY_GRAVITY = 0x400,
  KEY_ROTATIONS,
  KEY_FRICTION,
  KEY_SLIP_VELOCITY,
  KEY_YOUNG,
  KEY_POISSON,
  KEY_DAMPING,
  KEY_PULL,
  KEY_DRAG,
  KEY_NEAR_FIELD,
  KEY_DISC_MASS,
  KEY_ARM,
  KEY_WALLS,
  KEY_DT
};

static const struct argp_option table[] = {
    {NULL, 0, NULL, 0, "Forces:", 4},
    {"gravity", KEY_GRAVITY, "G|GX,GY,GZ", 0,
     "what jams the particles: downwards (default 2), or a vector (two dimensions: "
     "GX,GY) "
     "that points downwards in part",
     4},
    {"rotations", KEY_ROTATIONS, "on|off", 0, "whether particles spin (default on)", 4},
    {"friction", KEY_FRICTION, "MU", 0, "coefficient of friction (default 0.2)", 4},
    {"slip-velocity", KEY_SLIP_VELOCITY, "V0", 0,
     "friction grows with the sliding velocity u as u / sqrt(u^2 + V0^2) (default 0.001 "
     "of "
     "sqrt(g r), r the mean radius)",
     4},
    {"young", KEY_YOUNG, "E", 0, "Young's modulus (default 1e8)", 4},
    {"poisson", KEY_POISSON, "NU", 0, "Poisson's ratio (default 0.25)", 4},
    {"damping", KEY_DAMPING, "XI", 0, "damping rate of contacts (default 0.1)", 4},
    {"pull", KEY_PULL, "on|off", 0,
     "on: contacts pull at separation, as printed by Campello and Cassares (default off)",
     4},
    {"drag", KEY_DRAG, "C", 0, "force per velocity of the fluid (default 0)", 4},
    {"near-field", KEY_NEAR_FIELD, "A1,B1,A2,B2,CUTOFF", 0,
     "force between centres at distance d below CUTOFF: attraction A1 d^-B1, repulsion "
     "A2 "
     "d^-B2 (default none)",
     4},
    {"disc-mass", KEY_DISC_MASS, "on|off", 0,
     "two dimensions: on, particles weigh as discs (--density by area); off (default), "
     "as "
     "spheres",
     4},
    {"arm", KEY_ARM, "contact|radius", 0,
     "where friction turns a particle: at the common contact point (default), or at its "
     "radius as in that paper",
     4},
    {"walls", KEY_WALLS, "rigid|material", 0,
     "walls that do not give way (default), or of the particles' material", 4},
    {"dt", KEY_DT, "DT", 0,
     "length of a step (default: advised for the smallest particle and the fall)", 4},
    {NULL, 0, NULL, 0, NULL, 0},
};

static const char *const arm_names[] = {"contact", "radius", NULL};
static const char *const wall_names[] = {"rigid", "material", NULL};
static const char *const switch_names[] = {"off", "on", NULL};

static int read_poisson(const char *where, const char *text, double *value)
{
  const int code = number_real(where, text, value);
  return !code && !(*value > -1 && *value <= 0.5)
             ? BAD("%s: %s is not above -1 and up to 0.5", where, text)
             : code;
}

static const struct {
  int key;
  const char *option;
  size_t place;
  int (*read)(const char *where, const char *text, double *value);
} reals[] = {
    {KEY_FRICTION, "--friction", offsetof(forces_options, friction), number_not_negative},
    {KEY_SLIP_VELOCITY, "--slip-velocity", offsetof(forces_options, slip_velocity),
     number_positive},
    {KEY_YOUNG, "--young", offsetof(forces_options, young), number_positive},
    {KEY_POISSON, "--poisson", offsetof(forces_options, poisson), read_poisson},
    {KEY_DAMPING, "--damping", offsetof(forces_options, damping), number_not_negative},
    {KEY_DRAG, "--drag", offsetof(forces_options, drag), number_not_negative},
    {KEY_DT, "--dt", offsetof(forces_options, dt), number_positive},
};
enum { REALS = sizeof reals / sizeof reals[0] };

static double *real_at(forces_options *o, size_t row)
{
  return (double *)(void *)((char *)o + reals[row].place);
}

static int read_arm(const char *text, forces_options *o)
{
  int choice = 0;
  const int code = options_choice("--arm", text, arm_names, &choice);
  o->arm = (packing_arm)choice;
  return code;
}

/* The exit code of reading one option; -1 for keys that are none of ours. */
static int read_option(int key, const char *text, forces_options *o)
{
  for (size_t i = 0; i < REALS; i++)
    if (reals[i].key == key)
      return reals[i].read(reals[i].option, text, real_at(o, i));
  switch (key) {
  case KEY_ARM:
    return read_arm(text, o);
  case KEY_ROTATIONS:
    return options_choice("--rotations", text, switch_names, &o->rotations);
  case KEY_PULL:
    return options_choice("--pull", text, switch_names, &o->pull);
  case KEY_DISC_MASS:
    return options_choice("--disc-mass", text, switch_names, &o->disc_mass);
  case KEY_WALLS:
    return options_choice("--walls", text, wall_names, &o->material_walls);
  case KEY_GRAVITY:
    o->gravity = text;
    return 0;
  case KEY_NEAR_FIELD:
    o->near_field = text;
    return 0;
  default:
    return -1;
  }
}

static void note_given(int key, forces_options *o)
{
  for (const struct argp_option *row = table; !o->given && (row->key || row->doc); row++)
    if (row->key == key)
      o->given = row->name;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
  const int code = read_option(key, argument, state->input);
  if (code > 0)
    exit(code);
  if (code < 0)
    return ARGP_ERR_UNKNOWN;
  note_given(key, state->input);
  return 0;
}

const struct argp forces_argp = {.options = table, .parser = parse};

void forces_options_init(forces_options *o)
{
  memset(o, 0, sizeof *o);
  for (size_t i = 0; i < REALS; i++)
    *real_at(o, i) = (double)NAN;
  o->rotations = 1;
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

static int read_gravity_vector(forces *f, const char *settled)
{
  const char *text = f->asked->gravity;
  double g[3] = {0, 0, 0};
  const int code = read_list("--gravity", f->dim == 2 ? "G or GX,GY" : "G or GX,GY,GZ",
                             text, g, (size_t)f->dim);
  f->gravity = (packing_vec3){g[0], g[1], g[2]};
  f->down = -g[f->dim - 1];
  if (!code && !(f->down > 0))
    return BAD("--gravity: %s does not point downwards (along -%c), so no %s settles",
               text, f->dim == 2 ? 'y' : 'z', settled);
  return code;
}

static int read_gravity(forces *f, const char *settled)
{
  const char *text = f->asked->gravity;
  f->down = 2;
  if (text && strchr(text, ','))
    return read_gravity_vector(f, settled);
  const int code = text ? number_positive("--gravity", text, &f->down) : 0;
  f->gravity =
      f->dim == 2 ? (packing_vec3){0, -f->down, 0} : (packing_vec3){0, 0, -f->down};
  return code;
}

/* Without a wall in the way particles would slide for ever. */
static int check_tilt(const forces *f, unsigned periodic, const char *settled)
{
  const packing_vec3 g = f->gravity;
  const unsigned tilted = (fabs(g.x) > 0 ? PACKING_PERIODIC_X : 0u) |
                          (fabs(g.y) > 0 ? PACKING_PERIODIC_Y : 0u) |
                          (fabs(g.z) > 0 ? PACKING_PERIODIC_Z : 0u);
  return tilted & periodic ? BAD("--gravity: %s has a part along a periodic direction: "
                                 "no %s settles",
                                 f->asked->gravity ? f->asked->gravity : "2", settled)
                           : 0;
}

static int read_near_field(forces *f)
{
  const char *text = f->asked->near_field;
  const int code =
      text ? read_list("--near-field", "A1,B1,A2,B2,CUTOFF", text, f->near_field, 5) : 0;
  if (!code && text && !(f->near_field[4] > 0))
    return BAD("--near-field: a cutoff of %.9g is not above 0", f->near_field[4]);
  return code;
}

int forces_read(forces *f, forces_options *asked, int dim, unsigned periodic,
                const char *settled)
{
  f->asked = asked;
  f->dim = dim;
  int code = read_gravity(f, settled);
  if (!code)
    code = check_tilt(f, periodic, settled);
  if (!code)
    code = read_near_field(f);
  if (!code && asked->disc_mass && dim == 3)
    code = BAD("--disc-mass: spheres weigh as spheres");
  return code;
}

static void fall_back(double *value, double otherwise)
{
  if (isnan(*value))
    *value = otherwise;
}

static double length_of(packing_vec3 v)
{
  return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

int forces_fill_in(forces *f, double mean_r, double drag, double dt)
{
  forces_options *o = f->asked;
  const double g = length_of(f->gravity);
  fall_back(&o->young, 1e8);
  fall_back(&o->poisson, 0.25);
  fall_back(&o->damping, 0.1);
  fall_back(&o->friction, 0.2);
  fall_back(&o->drag, drag);
  fall_back(&o->slip_velocity, 0.001 * sqrt(g * mean_r));
  fall_back(&o->dt, dt);
  return isfinite(o->slip_velocity)
             ? 0
             : BAD("--gravity: %.9g is beyond what can be computed", g);
}

/* ---- handles ---- */

static packing_status create_material(forces *f, double density)
{
  packing_material_def def;
  packing_material_def_init(&def);
  def.density = density;
  def.young = f->asked->young;
  def.poisson = f->asked->poisson;
  def.damping = f->asked->damping;
  def.friction = f->asked->friction;
  const packing_status status = packing_materials_create(f->context, &f->materials);
  return status == PACKING_OK ? packing_materials_add(f->materials, &def, NULL) : status;
}

static packing_status add_near_field(forces *f)
{
  packing_law_near_field_def def;
  packing_law_near_field_def_init(&def);
  def.attraction = f->near_field[0];
  def.attraction_exponent = f->near_field[1];
  def.repulsion = f->near_field[2];
  def.repulsion_exponent = f->near_field[3];
  def.cutoff = f->near_field[4];
  return packing_law_create_near_field(f->context, &def, &f->laws[f->law_count++]);
}

/* Friction reads what the law before it pushed. */
static packing_status create_laws(forces *f)
{
  packing_law_hertz_def hertz;
  packing_law_sliding_def sliding;
  packing_law_hertz_def_init(&hertz);
  packing_law_sliding_def_init(&sliding);
  hertz.pull = f->asked->pull;
  sliding.slip_velocity = f->asked->slip_velocity;
  packing_status status =
      packing_law_create_hertz(f->context, &hertz, &f->laws[f->law_count++]);
  if (status == PACKING_OK && f->asked->friction > 0)
    status = packing_law_create_sliding(f->context, &sliding, &f->laws[f->law_count++]);
  if (status == PACKING_OK && f->asked->near_field)
    status = add_near_field(f);
  return status;
}

int forces_create(forces *f, packing_context *context, double density)
{
  f->context = context;
  f->density = density;
  packing_status status = create_material(f, density);
  if (status == PACKING_OK)
    status = create_laws(f);
  return status == PACKING_OK ? 0 : program_field_status(context, status, "forces", NULL);
}

void forces_free(forces *f)
{
  for (size_t i = 0; i < f->law_count; i++)
    packing_law_destroy(f->laws[i]);
  packing_materials_destroy(f->materials);
}

void forces_tell(const forces *f, packing_dem_def *def)
{
  const forces_options *o = f->asked;
  def->dt = o->dt;
  def->gravity = f->gravity;
  def->drag = o->drag;
  def->rotations = o->rotations;
  def->arm = o->arm;
  def->disc_mass = o->disc_mass;
  if (o->material_walls)
    def->wall_material = 0;
}

int forces_status(const forces *f, packing_status status)
{
  if (status == PACKING_ERR_UNSTABLE)
    return program_status(f->context, status, "--dt");
  return program_status(f->context, status,
                        status == PACKING_ERR_GEOMETRY ? "--domain" : "stepper");
}

/* ---- report ---- */

void forces_report(cJSON *all, const forces *f)
{
  const forces_options *o = f->asked;
  const double g[3] = {f->gravity.x, f->gravity.y, f->gravity.z};
  report_add_reals(all, "gravity", g, (size_t)f->dim);
  report_add_flag(all, "rotations", o->rotations);
  report_add_real(all, "density", f->density);
  report_add_real(all, "friction", o->friction);
  report_add_real(all, "slip_velocity", o->slip_velocity);
  report_add_real(all, "young", o->young);
  report_add_real(all, "poisson", o->poisson);
  report_add_real(all, "damping", o->damping);
  report_add_flag(all, "pull", o->pull);
  report_add_real(all, "drag", o->drag);
  if (o->near_field)
    report_add_reals(all, "near_field", f->near_field, 5);
  else
    report_add_text(all, "near_field", NULL);
  report_add_flag(all, "disc_mass", o->disc_mass);
  report_add_text(all, "arm", arm_names[o->arm]);
  report_add_text(all, "walls", wall_names[o->material_walls]);
  report_add_real(all, "dt", o->dt > 0 ? o->dt : (double)NAN);
}
