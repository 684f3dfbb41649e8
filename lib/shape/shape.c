/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes: life, names, volume and inertia. The sphere (disc) is the shape NULL; its
 * volume is that of lib/math, its moments of inertia are 2/5 m r^2 (sphere) and m r^2 / 2
 * (disc). */
#include "shape_internal.h"
#include <string.h>

void packing_shape_def_fill(packing_shape_def *def, size_t size)
{
  packing_shape_def defaults;
  memset(&defaults, 0, sizeof defaults);
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status refuse_null(packing_context *context, const char *field)
{
  return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX, "NULL");
}

static packing_status check(packing_context *context, const packing_shape_def *def)
{
  PACKING_I_TRY(packing_i_check_given(context, "name", def->name));
  if (def->gap == NULL)
    return refuse_null(context, "gap");
  if (def->clearance == NULL)
    return refuse_null(context, "clearance");
  if (def->volume == NULL)
    return refuse_null(context, "volume");
  return PACKING_OK;
}

packing_status packing_shape_create_custom(packing_context *context,
                                           const packing_shape_def *def,
                                           packing_shape **shape)
{
  packing_shape_def d;
  PACKING_I_TRY(packing_i_check_given(context, "def", def));
  PACKING_I_TRY(packing_i_check_given(context, "shape", shape));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_shape, release, def, &d));
  PACKING_I_TRY(check(context, &d));
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t length = strlen(d.name) + 1;
  packing_shape *made = packing_i_alloc(allocator, 1, sizeof *made + length);
  if (made == NULL)
    return packing_i_nomem(context);
  atomic_init(&made->holds, 1);
  made->allocator = *allocator;
  memcpy(made->name, d.name, length);
  made->def = d;
  made->def.name = made->name;
  *shape = made;
  return PACKING_OK;
}

packing_shape *packing_shape_retain(packing_shape *shape)
{
  if (shape != NULL)
    atomic_fetch_add_explicit(&shape->holds, 1, memory_order_relaxed);
  return shape;
}

void packing_shape_destroy(packing_shape *shape)
{
  if (shape == NULL ||
      atomic_fetch_sub_explicit(&shape->holds, 1, memory_order_acq_rel) != 1)
    return;
  if (shape->def.release != NULL)
    shape->def.release(shape->def.user);
  const packing_allocator allocator = shape->allocator;
  packing_i_free(&allocator, shape);
}

const char *packing_shape_name(const packing_shape *shape)
{
  return shape == NULL ? "sphere" : shape->name;
}

double packing_shape_volume(const packing_shape *shape, double r, int dim)
{
  if (shape != NULL)
    return shape->def.volume(shape->def.user, r, dim);
  return packing_i_ball_volume(dim, r);
}

int packing_shape_inertia(const packing_shape *shape, double r, int dim,
                          double moments[3])
{
  if (shape != NULL && shape->def.inertia == NULL)
    return 0;
  moments[0] = moments[1] = moments[2] = 0;
  if (shape != NULL) {
    shape->def.inertia(shape->def.user, r, dim, moments);
    return 1;
  }
  const double mass = packing_i_ball_volume(dim, r);
  if (dim == 2)
    moments[2] = 0.5 * mass * r * r;
  else
    moments[0] = moments[1] = moments[2] = 0.4 * mass * r * r;
  return 1;
}
