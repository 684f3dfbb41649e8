/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes combinations: the formula of their parts, their bounds and their volume. */
#include "combination_internal.h"
#include <float.h>
#include <limits.h>

void packing_domain_combination_def_fill(packing_domain_combination_def *def, size_t size)
{
  packing_domain_combination_def defaults = {.volume_tolerance = 1e-4};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_operand(packing_context *context, const char *field,
                                    const packing_domain *domain)
{
  PACKING_I_TRY(packing_i_check_given(context, field, domain));
  if (domain->body.periodic != 0)
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, field, PACKING_NO_INDEX,
                          "the %s is periodic; only containers with walls are combined",
                          domain->body.ops->name);
  if (domain->body.open_axis >= 0)
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, field, PACKING_NO_INDEX,
                          "the %s has an open top; only closed containers are combined",
                          domain->body.ops->name);
  return PACKING_OK;
}

static packing_status check(packing_context *context,
                            const packing_domain_combination_def *d)
{
  if ((int)d->operation < PACKING_UNION || (int)d->operation > PACKING_DIFFERENCE)
    return packing_i_fail(context, PACKING_ERR_RANGE, "operation", PACKING_NO_INDEX,
                          "%d is none of union, intersection, difference (0, 1, 2)",
                          (int)d->operation);
  PACKING_I_TRY(check_operand(context, "a", d->a));
  PACKING_I_TRY(check_operand(context, "b", d->b));
  if (d->a->body.dim != d->b->body.dim)
    return packing_i_fail(context, PACKING_ERR_INVALID, "b", PACKING_NO_INDEX,
                          "a %s has %d dimensions and a %s %d", d->a->body.ops->name,
                          d->a->body.dim, d->b->body.ops->name, d->b->body.dim);
  PACKING_I_TRY(packing_i_check_not_negative(context, "volume", d->volume));
  PACKING_I_TRY(
      packing_i_check_positive(context, "volume_tolerance", d->volume_tolerance));
  if (d->volume_tolerance >= 1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "volume_tolerance",
                          PACKING_NO_INDEX, "%g must be below 1", d->volume_tolerance);
  return PACKING_OK;
}

/* The parts of one operand, and the formula of what lies outside it. */
typedef struct operand {
  int parts, steps, depth;
  const packing_i_domain_body *part[PACKING_I_PARTS];
  packing_i_step step[PACKING_I_STEPS];
} operand;

static int depth_of(const packing_i_step *step, int steps)
{
  int used = 0, most = 0;
  for (int i = 0; i < steps; i++) {
    used +=
        step[i].kind == PACKING_I_STEP_AND || step[i].kind == PACKING_I_STEP_OR ? -1 : 1;
    most = used > most ? used : most;
  }
  return most;
}

static void read_operand(const packing_domain *domain, operand *o)
{
  const packing_i_combination *c = packing_i_domain_combination(&domain->body);
  if (c == NULL || c->inset > 0) {
    o->parts = o->steps = o->depth = 1;
    o->part[0] = &domain->body;
    o->step[0] = (packing_i_step){PACKING_I_STEP_OUTSIDE, 0};
    return;
  }
  o->parts = c->data->parts;
  o->steps = c->data->steps;
  for (int i = 0; i < o->parts; i++)
    o->part[i] = c->data->part[i];
  for (int i = 0; i < o->steps; i++)
    o->step[i] = c->data->step[i];
  o->depth = depth_of(o->step, o->steps);
}

/* By De Morgan. */
static void negate(operand *o)
{
  static const packing_i_step_kind opposite[] = {
      [PACKING_I_STEP_OUTSIDE] = PACKING_I_STEP_INSIDE,
      [PACKING_I_STEP_INSIDE] = PACKING_I_STEP_OUTSIDE,
      [PACKING_I_STEP_AND] = PACKING_I_STEP_OR,
      [PACKING_I_STEP_OR] = PACKING_I_STEP_AND,
  };
  for (int i = 0; i < o->steps; i++)
    o->step[i].kind = opposite[o->step[i].kind];
}

static void add_steps(packing_i_combination_data *data, const operand *o, int first_part)
{
  for (int i = 0; i < o->steps; i++) {
    packing_i_step s = o->step[i];
    if (s.kind == PACKING_I_STEP_OUTSIDE || s.kind == PACKING_I_STEP_INSIDE) {
      s.part += first_part;
      data->is_taken[s.part] = s.kind == PACKING_I_STEP_INSIDE;
    }
    data->has_seams = data->has_seams || s.kind == PACKING_I_STEP_AND;
    data->step[data->steps++] = s;
  }
}

/* The deeper formula first, so that the stack stays below log2 of the number of parts. */
static void join(packing_i_combination_data *data, const operand *a, const operand *b,
                 packing_operation operation)
{
  for (int i = 0; i < a->parts; i++)
    data->part[data->parts++] = a->part[i];
  for (int i = 0; i < b->parts; i++)
    data->part[data->parts++] = b->part[i];
  if (b->depth > a->depth) {
    add_steps(data, b, a->parts);
    add_steps(data, a, 0);
  } else {
    add_steps(data, a, 0);
    add_steps(data, b, a->parts);
  }
  data->step[data->steps++] = (packing_i_step){
      operation == PACKING_UNION ? PACKING_I_STEP_AND : PACKING_I_STEP_OR, -1};
  data->has_seams = data->has_seams || operation == PACKING_UNION;
}

static packing_status number_walls(packing_context *context,
                                   packing_i_combination_data *data)
{
  for (int i = 0; i < data->parts; i++) {
    data->first_wall[i] = data->walls;
    if (data->part[i]->walls >= INT_MAX - data->walls)
      return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "b", PACKING_NO_INDEX,
                            "too many walls in all");
    data->walls += data->part[i]->walls;
  }
  data->walls++; /* the seam */
  return PACKING_OK;
}

static void set_blur(packing_i_combination_data *data)
{
  double most = 0;
  for (int i = 0; i < data->parts; i++)
    for (int k = 0; k < data->part[i]->dim; k++)
      most = fmax(most, fmax(fabs(packing_i_component(data->part[i]->bounds.lo, k)),
                             fabs(packing_i_component(data->part[i]->bounds.hi, k))));
  data->blur = 32 * DBL_EPSILON * most;
}

static packing_status combine(packing_context *context,
                              const packing_domain_combination_def *d,
                              packing_i_combination_data *data)
{
  operand a, b;
  read_operand(d->a, &a);
  read_operand(d->b, &b);
  if (a.parts + b.parts > PACKING_I_PARTS)
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "b", PACKING_NO_INDEX,
                          "%d containers in all, at most %d are combined",
                          a.parts + b.parts, (int)PACKING_I_PARTS);
  if (d->operation == PACKING_DIFFERENCE)
    negate(&b);
  join(data, &a, &b, d->operation);
  set_blur(data);
  return number_walls(context, data);
}

/* 0: the bounds have nothing in common. */
static int set_bounds(packing_i_domain_body *body, packing_operation operation,
                      const packing_bounds *a, const packing_bounds *b)
{
  int meet = 1;
  body->bounds = *a;
  for (int k = 0; k < body->dim; k++) {
    const double alo = packing_i_component(a->lo, k), ahi = packing_i_component(a->hi, k);
    const double blo = packing_i_component(b->lo, k), bhi = packing_i_component(b->hi, k);
    meet = meet && fmax(alo, blo) < fmin(ahi, bhi);
    if (operation == PACKING_DIFFERENCE)
      continue;
    const int is_union = operation == PACKING_UNION;
    packing_i_set_component(&body->bounds.lo, k,
                            is_union ? fmin(alo, blo) : fmax(alo, blo));
    packing_i_set_component(&body->bounds.hi, k,
                            is_union ? fmax(ahi, bhi) : fmin(ahi, bhi));
  }
  return meet;
}

void packing_i_shared_part(const packing_domain *a, const packing_domain *b,
                           packing_i_combination_data *data, packing_domain *shared)
{
  static const packing_i_step steps[] = {
      {PACKING_I_STEP_OUTSIDE, 0}, {PACKING_I_STEP_OUTSIDE, 1}, {PACKING_I_STEP_OR, -1}};
  *data = (packing_i_combination_data){.parts = 2, .steps = 3};
  data->operation = PACKING_INTERSECTION;
  data->part[0] = &a->body;
  data->part[1] = &b->body;
  for (int i = 0; i < 3; i++)
    data->step[i] = steps[i];
  *shared = (packing_domain){.allocator = a->allocator};
  shared->body = packing_i_domain_body_new(
      packing_i_combination_ops(PACKING_INTERSECTION), a->body.dim);
  shared->body.as.combination.data = data;
  set_bounds(&shared->body, PACKING_INTERSECTION, &a->body.bounds, &b->body.bounds);
}

/* A container that is a box, a ball or a cylinder as a cell. */
static int is_cell(const packing_domain *domain, packing_i_cell *cell)
{
  const packing_i_round *round = packing_i_domain_round(domain);
  *cell = (packing_i_cell){.kind = PACKING_I_CELL_BOX, .box = domain->body.bounds};
  if (packing_i_domain_planar(domain) != NULL)
    return 1;
  if (round != NULL && round->inner == 0) {
    cell->kind = PACKING_I_CELL_BALL;
    cell->centre = round->centre;
    cell->radius = round->outer;
    return 1;
  }
  const int axis = packing_i_domain_axis(domain);
  if (axis < 0)
    return 0;
  const packing_i_revolution *p = &domain->body.as.revolution;
  const double radius = packing_i_revolution_outer(p, p->knot[0]);
  if (p->walls != 3 || packing_i_revolution_outer(p, p->knot[p->knots - 1]) != radius ||
      packing_i_revolution_inner(p, p->knot[0]) != 0)
    return 0;
  cell->kind = PACKING_I_CELL_CYLINDER;
  cell->axis = axis;
  cell->centre = p->base;
  cell->radius = radius;
  return 1;
}

static int is_plain(const packing_domain *domain)
{
  return packing_i_domain_planar(domain) != NULL ||
         packing_i_domain_round(domain) != NULL || packing_i_domain_axis(domain) >= 0;
}

/* What both have in common, and its error; -1: a distance is no number. */
static int shared_volume(const packing_domain_combination_def *d, int meet,
                         double *volume, double *error)
{
  static const packing_vec3 nowhere = {0, 0, 0};
  const double larger = fmax(d->a->body.volume, d->b->body.volume);
  packing_i_cell cell;
  *volume = *error = 0;
  if (!meet)
    return 0;
  if (is_plain(d->a) && is_cell(d->b, &cell))
    return packing_i_domain_cell_volume(d->a, &cell, &nowhere, 0, 1e-12, volume, error);
  if (is_plain(d->b) && is_cell(d->a, &cell))
    return packing_i_domain_cell_volume(d->b, &cell, &nowhere, 0, 1e-12, volume, error);
  packing_i_combination_data data;
  packing_domain both;
  packing_i_shared_part(d->a, d->b, &data, &both);
  const double part = d->operation == PACKING_INTERSECTION ? 0 : larger;
  const packing_i_tolerance enough = {0.25 * d->volume_tolerance * part,
                                      part > 0 ? 0 : d->volume_tolerance};
  return packing_i_subdivide_sides(&both.body, &nowhere, 0, enough,
                                   PACKING_I_CALLS_FOR_VOLUME, volume, error);
}

static packing_status set_volume(packing_context *context,
                                 const packing_domain_combination_def *d, int meet,
                                 packing_i_domain_body *body)
{
  const double a = d->a->body.volume, b = d->b->body.volume;
  double shared, error;
  if (shared_volume(d, meet, &shared, &error))
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "signed_distance",
                          PACKING_NO_INDEX, "a distance is no number");
  const double volume = d->operation == PACKING_UNION        ? a + (b - shared)
                        : d->operation == PACKING_DIFFERENCE ? a - shared
                                                             : shared;
  if (!(volume > error + 1e-12 * a))
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "b", PACKING_NO_INDEX,
                          "nothing is left of the %s of a %s and a %s", body->ops->name,
                          d->a->body.ops->name, d->b->body.ops->name);
  if (d->volume > 0) {
    body->volume = d->volume;
    return PACKING_OK;
  }
  if (error > d->volume_tolerance * volume)
    return packing_i_fail(context, PACKING_ERR_RANGE, "volume_tolerance",
                          PACKING_NO_INDEX,
                          "the computed volume of %g may be wrong by %g, more than is "
                          "allowed: state the volume",
                          volume, error);
  body->volume = volume;
  return PACKING_OK;
}

packing_status
packing_domain_create_combination(packing_context *context,
                                  const packing_domain_combination_def *def,
                                  packing_domain **domain)
{
  packing_domain_combination_def d;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(
      PACKING_I_DEF_READ(context, packing_domain_combination, volume_tolerance, def, &d));
  PACKING_I_TRY(check(context, &d));
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_i_combination_data *data = packing_i_calloc(allocator, 1, sizeof *data);
  if (data == NULL)
    return packing_i_nomem(context);
  data->allocator = *allocator;
  packing_i_domain_body body =
      packing_i_domain_body_new(packing_i_combination_ops(d.operation), d.a->body.dim);
  body.as.combination.data = data;
  body.as.combination.volume_tolerance = d.volume_tolerance;
  packing_status status = combine(context, &d, data);
  data->operation = d.operation;
  data->meet = set_bounds(&body, d.operation, &d.a->body.bounds, &d.b->body.bounds);
  if (status == PACKING_OK)
    status = set_volume(context, &d, data->meet, &body);
  if (status == PACKING_OK) {
    body.walls = data->walls;
    status = packing_i_domain_finish(context, &body, "a", domain);
  }
  if (status != PACKING_OK) {
    packing_i_free(allocator, data);
    return status;
  }
  data->a = packing_domain_retain(d.a);
  data->b = packing_domain_retain(d.b);
  return PACKING_OK;
}
