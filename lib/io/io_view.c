/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pack that a writer is given: checked once, read through strides. */
#include "io_internal.h"
#include "view.h"
#include <math.h>

int packing_i_view_has_velocity(const packing_view *v)
{
  return v->vx.data != NULL || v->vy.data != NULL || v->vz.data != NULL;
}

int packing_i_view_has_spin(const packing_view *v)
{
  return v->wx.data != NULL || v->wy.data != NULL || v->wz.data != NULL;
}

int packing_i_view_has_orientation(const packing_view *v)
{
  return v->qw.data != NULL && v->qx.data != NULL && v->qy.data != NULL &&
         v->qz.data != NULL;
}

double packing_i_view_number(const packing_column *column, size_t i)
{
  return column->data == NULL ? 0.0 : packing_i_column_double(column, i);
}

/* Integers may stand anywhere in the host's records. */
int64_t packing_i_view_id(const packing_view *view, size_t i)
{
  int64_t id = (int64_t)i + 1;
  if (view->id.data != NULL)
    memcpy(&id, (const char *)view->id.data + i * view->id.stride, sizeof id);
  return id;
}

int32_t packing_i_view_int(const packing_column *column, size_t i, int32_t absent)
{
  int32_t n = absent;
  if (column->data != NULL)
    memcpy(&n, (const char *)column->data + i * column->stride, sizeof n);
  return n;
}

double packing_i_view_largest_r(const packing_view *view)
{
  double r = 0;
  for (size_t i = 0; i < view->count; i++)
    if (packing_i_view_r(view, i) > r)
      r = packing_i_view_r(view, i);
  return r;
}

static packing_status check_column(packing_context *context, const char *name,
                                   const packing_column *c, size_t count)
{
  if (c->data == NULL)
    return PACKING_OK;
  if (((uintptr_t)c->data | c->stride) % sizeof(double) != 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, name, PACKING_NO_INDEX,
                          "its numbers are not aligned as doubles");
  for (size_t i = 0; i < count; i++)
    if (!isfinite(packing_i_column_double(c, i)))
      return packing_i_fail(context, PACKING_ERR_INVALID, name, i,
                            "particle %zu: %g is not a finite number", i,
                            packing_i_column_double(c, i));
  return PACKING_OK;
}

static packing_status check_radii(packing_context *context, const packing_view *v)
{
  for (size_t i = 0; i < v->count; i++)
    if (!(packing_i_view_r(v, i) > 0))
      return packing_i_fail(context, PACKING_ERR_INVALID, "r", i,
                            "particle %zu: %g must be above 0", i,
                            packing_i_view_r(v, i));
  return PACKING_OK;
}

static packing_status check_dim(packing_context *context, const packing_view *v, int dim)
{
  if (dim == 3 && v->z.data == NULL && v->count > 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "z", PACKING_NO_INDEX,
                          "absent, and needed in three dimensions");
  for (size_t i = 0; dim == 2 && v->z.data != NULL && i < v->count; i++)
    if (packing_i_column_double(&v->z, i) != 0)
      return packing_i_fail(context, PACKING_ERR_INVALID, "z", i,
                            "particle %zu: %g, and 0 is needed in two dimensions", i,
                            packing_i_column_double(&v->z, i));
  return PACKING_OK;
}

packing_status packing_i_io_view(packing_context *context, const packing_view *from,
                                 int dim, packing_view *to)
{
  if (!packing_i_view_read(from, to))
    return packing_i_fail(context, PACKING_ERR_INVALID, "view", PACKING_NO_INDEX,
                          "NULL, not initialised, or without x, y and r");
  const struct {
    const char *name;
    const packing_column *column;
  } columns[] = {{"x", &to->x},   {"y", &to->y},   {"z", &to->z},   {"r", &to->r},
                 {"vx", &to->vx}, {"vy", &to->vy}, {"vz", &to->vz}, {"wx", &to->wx},
                 {"wy", &to->wy}, {"wz", &to->wz}, {"qw", &to->qw}, {"qx", &to->qx},
                 {"qy", &to->qy}, {"qz", &to->qz}};
  for (size_t c = 0; c < sizeof columns / sizeof columns[0]; c++)
    PACKING_I_TRY(check_column(context, columns[c].name, columns[c].column, to->count));
  if (!packing_i_view_has_orientation(to) &&
      (to->qw.data != NULL || to->qx.data != NULL || to->qy.data != NULL ||
       to->qz.data != NULL))
    return packing_i_fail(context, PACKING_ERR_INVALID, "orientation", PACKING_NO_INDEX,
                          "qw, qx, qy and qz come together");
  PACKING_I_TRY(check_radii(context, to));
  return check_dim(context, to, dim);
}

int packing_i_io_box_unset(const packing_bounds *b)
{
  return b->lo.x == 0 && b->lo.y == 0 && b->lo.z == 0 && b->hi.x == 0 && b->hi.y == 0 &&
         b->hi.z == 0;
}

/* Widens [*lo, *hi] by a particle; the upper end stays above the centre however small the
 * radius is beside it. */
static void widen(double *lo, double *hi, double centre, double r)
{
  const double below = centre - r;
  const double above = centre + r > centre ? centre + r : nextafter(centre, HUGE_VAL);
  *lo = below < *lo ? below : *lo;
  *hi = above > *hi ? above : *hi;
}

packing_bounds packing_i_io_around(const packing_view *v)
{
  packing_bounds b = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  for (size_t i = 0; i < v->count; i++) {
    const packing_vec3 p = packing_i_view_centre(v, i);
    const double r = packing_i_view_r(v, i);
    widen(&b.lo.x, &b.hi.x, p.x, r);
    widen(&b.lo.y, &b.hi.y, p.y, r);
    widen(&b.lo.z, &b.hi.z, p.z, r);
  }
  return b;
}

static packing_status check_side(packing_context *context, double lo, double hi,
                                 char axis)
{
  if (!isfinite(lo) || !isfinite(hi) || !isfinite(hi - lo))
    return packing_i_fail(context, PACKING_ERR_INVALID, "box", PACKING_NO_INDEX,
                          "not finite along %c", axis);
  if (!(lo < hi))
    return packing_i_fail(context, PACKING_ERR_RANGE, "box", PACKING_NO_INDEX,
                          "empty along %c: from %g to %g", axis, lo, hi);
  return PACKING_OK;
}

packing_status packing_i_io_box(packing_context *context, const packing_view *view,
                                const packing_bounds *given, int flat,
                                packing_bounds *box)
{
  if (packing_i_io_box_unset(given) && view->count == 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "box", PACKING_NO_INDEX,
                          "no particles to go around: a box is needed");
  *box = packing_i_io_box_unset(given) ? packing_i_io_around(view) : *given;
  if (flat && (view->count > 0 || box->lo.z == box->hi.z)) {
    box->hi.z = view->count > 0
                    ? packing_i_view_largest_r(view)
                    : 0.5 * fmin(box->hi.x - box->lo.x, box->hi.y - box->lo.y);
    box->lo.z = -box->hi.z;
  }
  PACKING_I_TRY(check_side(context, box->lo.x, box->hi.x, 'x'));
  PACKING_I_TRY(check_side(context, box->lo.y, box->hi.y, 'y'));
  return check_side(context, box->lo.z, box->hi.z, 'z');
}

packing_status packing_i_check_inside(packing_context *context, const packing_view *v,
                                      const packing_bounds *box)
{
  for (size_t i = 0; i < v->count; i++) {
    const packing_vec3 p = packing_i_view_centre(v, i);
    if (!(p.x >= box->lo.x && p.x < box->hi.x && p.y >= box->lo.y && p.y < box->hi.y &&
          p.z >= box->lo.z && p.z < box->hi.z))
      return packing_i_fail(context, PACKING_ERR_RANGE, "box", i,
                            "the centre of particle %zu (%g, %g, %g) lies outside", i,
                            p.x, p.y, p.z);
  }
  return PACKING_OK;
}
