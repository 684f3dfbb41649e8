/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grading curves: the share passing over the diameter, or its log, by monotone cubic
 * interpolation (M. Steffen, Astron. Astrophys. 239, 443, 1990): slopes at the rows that keep each
 * piece between its ends, no overshoot, no wiggles. Slopes at the first and last row are one-sided
 * parabolas with the same limit, as in the paper. The density of u = log x, by number and by mass,
 * is then tabulated piece by piece (smooth_internal.h). Flat ends of the table are dropped: no
 * size lies there. */
#include "smooth_internal.h"
#include <math.h>

static const packing_i_psd_ops ops = {
    "curve", "Steffen, Astron. Astrophys. 239, 443 (1990)", PACKING_I_SMOOTH_OPS};

/* One piece of the curve: passing = ... + c (t - t0) + b (t - t0)^2 + a (t - t0)^3, where t is x or
 * log x. */
typedef struct piece {
  int logarithmic;
  double x; /* its left end */
  double a, b, c;
} piece;

/* d passing / d log x */
static double density_at(const void *law, double x)
{
  const piece *p = law;
  const double t = p->logarithmic ? log1p((x - p->x) / p->x) : x - p->x;
  const double slope = (3 * p->a * t + 2 * p->b) * t + p->c;
  return fmax(slope, 0) * (p->logarithmic ? 1 : x);
}

/* The table as the interpolation sees it. */
typedef struct table {
  const packing_psd_curve_def *def;
  double unit;
} table;

static double x_of(const table *t, size_t i)
{
  return t->def->diameter_d[i] / 2 / t->unit;
}

static double width(const table *t, size_t i)
{
  const double x = x_of(t, i), step = x_of(t, i + 1) - x;
  return t->def->logarithmic ? log1p(step / x) : step;
}

static double secant(const table *t, size_t i)
{
  return (t->def->passing[i + 1] - t->def->passing[i]) / width(t, i);
}

/* The slope at an end with secants s (of width h) and, farther in, s1 (of width h1). */
static double end_slope(double s, double h, double s1, double h1)
{
  const double p = s + (s - s1) * h / (h + h1);
  return fmin(fmax(p, 0), 2 * s);
}

/* The slope at row i. Secants are never negative here. */
static double slope_at(const table *t, size_t i)
{
  const size_t last = t->def->count - 1;
  if (last == 1)
    return secant(t, 0);
  if (i == 0)
    return end_slope(secant(t, 0), width(t, 0), secant(t, 1), width(t, 1));
  if (i == last)
    return end_slope(secant(t, i - 1), width(t, i - 1), secant(t, i - 2),
                     width(t, i - 2));
  const double h0 = width(t, i - 1), h1 = width(t, i);
  const double s0 = secant(t, i - 1), s1 = secant(t, i);
  const double p = (s0 * h1 + s1 * h0) / (h0 + h1);
  return 2 * fmin(fmin(s0, s1), p / 2);
}

static piece piece_at(const table *t, size_t i)
{
  const double h = width(t, i), s = secant(t, i);
  const double y0 = slope_at(t, i), y1 = slope_at(t, i + 1);
  const piece p = {t->def->logarithmic, x_of(t, i), (y0 + y1 - 2 * s) / (h * h),
                   (3 * s - 2 * y0 - y1) / h, y0};
  return p;
}

void packing_psd_curve_def_fill(packing_psd_curve_def *def, size_t size)
{
  packing_psd_curve_def defaults = {0};
  defaults.logarithmic = 1;
  defaults.by = PACKING_BY_MASS;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status row_fails(packing_context *context, size_t i, double v,
                                const char *what)
{
  return packing_i_fail(context, PACKING_ERR_RANGE, "passing", i, "row %zu: %g, %s",
                        i + 1, v, what);
}

static packing_status check_passing(packing_context *context, const double *passing,
                                    size_t count)
{
  if (passing == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "passing", PACKING_NO_INDEX,
                          "NULL");
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(passing[i]))
      return packing_i_fail(context, PACKING_ERR_INVALID, "passing", i,
                            "row %zu: %g is not a finite number", i + 1, passing[i]);
    if (i == 0 && passing[0] != 0)
      return row_fails(context, 0, passing[0], "the first row must pass 0");
    if (i > 0 && passing[i] < passing[i - 1])
      return row_fails(context, i, passing[i], "must not fall below the row before");
    if (passing[i] > 1)
      return row_fails(context, i, passing[i], "must not be above 1");
  }
  if (passing[count - 1] != 1)
    return row_fails(context, count - 1, passing[count - 1], "the last row must pass 1");
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_psd_curve_def *d)
{
  PACKING_I_TRY(packing_i_psd_check_measure(context, d->by, d->dim));
  if (d->logarithmic != 0 && d->logarithmic != 1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "logarithmic", PACKING_NO_INDEX,
                          "%d is neither 0 nor 1", d->logarithmic);
  PACKING_I_TRY(packing_i_psd_check_count(context, d->count, 2));
  PACKING_I_TRY(
      packing_i_psd_check_entries(context, "diameter_d", d->diameter_d, d->count));
  PACKING_I_TRY(
      packing_i_psd_check_rising(context, "diameter_d", d->diameter_d, d->count));
  PACKING_I_TRY(check_passing(context, d->passing, d->count));
  return packing_i_psd_check_span(context, "diameter_d", d->diameter_d[0] / 2,
                                  d->diameter_d[d->count - 1] / 2);
}

packing_status packing_psd_create_curve(packing_context *context,
                                        const packing_psd_curve_def *def,
                                        packing_psd **psd)
{
  packing_psd_curve_def d;
  packing_i_smooth_builder b;
  PACKING_I_TRY(packing_i_psd_check_arguments(context, def, psd));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_psd_curve, dim, def, &d));
  PACKING_I_TRY(check(context, &d));
  size_t first = 0, last = d.count - 1;
  while (d.passing[first + 1] == 0)
    first++;
  while (d.passing[last - 1] == 1)
    last--;
  PACKING_I_TRY(packing_i_smooth_begin(&b, context, &ops, d.by, d.dim,
                                       d.diameter_d[first] / 2, d.diameter_d[last] / 2));
  const table t = {&d, b.smooth->base.unit};
  for (size_t i = first; i < last; i++) {
    const piece p = piece_at(&t, i);
    const packing_i_density density = {density_at, NULL, &p};
    const packing_status status =
        packing_i_smooth_interval(&b, &density, p.x, x_of(&t, i + 1));
    if (status != PACKING_OK) {
      packing_psd_destroy(&b.smooth->base);
      return status;
    }
  }
  packing_i_smooth_end(&b);
  *psd = &b.smooth->base;
  return PACKING_OK;
}
