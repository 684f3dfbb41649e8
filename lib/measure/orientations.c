/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fabric tensor of orientations: as that of contact normals (fabric.c), of one axis a of each
 * particle turned by its quaternion q = (w, v):
 * n ~ (w^2 - v.v) a + 2 (v.a) v + 2 w (v x a), homogeneous in q, so its length does not matter.
 * Linear. */
#include "measure/contacts_internal.h"
#include "view.h"

typedef struct turning {
  const packing_view *view;
  packing_vec3 axis;
  int dim;
  packing_i_fabric *parts; /* of each block */
} turning;

void packing_orientations_def_fill(packing_orientations_def *def, size_t size)
{
  packing_orientations_def defaults = {0};
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* The largest size of `count` numbers; infinite when one is not finite. */
static double greatest(const double *v, int count)
{
  double most = 0;
  for (int k = 0; k < count; k++)
    most = isfinite(v[k]) ? fmax(most, fabs(v[k])) : (double)INFINITY;
  return most;
}

/* Of any length; 0 where there is none. */
static packing_vec3 direction_of(const turning *t, size_t i)
{
  const packing_view *view = t->view;
  const packing_vec3 none = {0, 0, 0}, a = t->axis;
  double q[4] = {
      packing_i_column_double(&view->qw, i), packing_i_column_double(&view->qx, i),
      packing_i_column_double(&view->qy, i), packing_i_column_double(&view->qz, i)};
  const double most = greatest(q, 4);
  if (most == 0 || isinf(most))
    return none;
  for (int k = 0; k < 4; k++)
    q[k] /= most;
  const packing_vec3 v = {q[1], q[2], q[3]};
  packing_vec3 n =
      packing_i_add(packing_i_add(packing_i_scale(a, q[0] * q[0] - packing_i_dot(v, v)),
                                  packing_i_scale(v, 2 * packing_i_dot(v, a))),
                    packing_i_scale(packing_i_cross(v, a), 2 * q[0]));
  if (t->dim == 2)
    n.z = 0;
  return n;
}

static void turn_block(void *arg, size_t block)
{
  const turning *t = arg;
  const size_t end = packing_i_measure_block_end(block, t->view->count);
  packing_i_fabric part = {{{0, 0}}, 0};
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++) {
    double sum[6] = {0, 0, 0, 0, 0, 0};
    const size_t count = packing_i_fabric_direct(sum, direction_of(t, i));
    packing_i_fabric_add(&part, sum, count);
  }
  t->parts[block] = part;
}

static packing_status check_columns(packing_context *context, const packing_view *v)
{
  const packing_column columns[4] = {v->qw, v->qx, v->qy, v->qz};
  static const char *const names[4] = {"qw", "qx", "qy", "qz"};
  for (int k = 0; k < 4 && v->count > 0; k++)
    if (columns[k].data == NULL)
      return packing_i_fail(context, PACKING_ERR_INVALID, names[k], PACKING_NO_INDEX,
                            "the view has no such column");
  return PACKING_OK;
}

static packing_status read_axis(packing_context *context, int dim, packing_vec3 *axis)
{
  static const char *const fields[3] = {"axis.x", "axis.y", "axis.z"};
  PACKING_I_TRY(packing_i_check_point(context, fields, axis));
  const double a[3] = {axis->x, axis->y, axis->z}, most = greatest(a, 3);
  if (most == 0)
    *axis = dim == 2 ? packing_i_vec(1, 0, 0) : packing_i_vec(0, 0, 1);
  else
    *axis = packing_i_vec(a[0] / most, a[1] / most, a[2] / most);
  return PACKING_OK;
}

/* Names the first particle without a direction. */
static packing_status blame(packing_context *context, const turning *t)
{
  for (size_t i = 0; i < t->view->count; i++) {
    const packing_vec3 n = direction_of(t, i);
    if (!(packing_i_dot(n, n) > 0))
      return packing_i_fail(context, PACKING_ERR_INVALID, "qw", i,
                            "the quaternion of particle %zu is 0 or not finite, or turns "
                            "the axis out of the plane",
                            i);
  }
  return PACKING_ERR_INTERNAL;
}

packing_status packing_measure_orientations(packing_context *context,
                                            const packing_orientations_def *def,
                                            const packing_view *view,
                                            packing_fabric_report *report)
{
  packing_orientations_def d;
  packing_view v;
  packing_fabric_report found;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_orientations, dim, def, &d));
  if (d.dim != 2 && d.dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2 or 3", d.dim);
  PACKING_I_TRY(read_axis(context, d.dim, &d.axis));
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  PACKING_I_TRY(check_columns(context, &v));
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t blocks = packing_i_measure_blocks(v.count);
  turning t = {&v, d.axis, d.dim, NULL};
  t.parts = packing_i_alloc(allocator, blocks, sizeof *t.parts);
  if (t.parts == NULL)
    return packing_i_nomem(context);
  packing_i_parallel(context, blocks, turn_block, &t);
  packing_fabric_report_init(&found);
  packing_i_fabric_report(t.parts, blocks, d.dim, &found);
  packing_i_free(allocator, t.parts);
  if (found.count != v.count)
    return blame(context, &t);
  return packing_i_report_write(context, report, &found, sizeof found);
}
