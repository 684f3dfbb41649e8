/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Building a table of panels; see smooth_internal.h. */
#include "smooth_internal.h"
#include "vec.h"
#include <float.h>
#include <gsl/gsl_math.h>
#include <string.h>

enum { FIRST_CAPACITY = 32, MOST_HALVINGS = 64 };

/* A panel whose density is below exp(-45) = 3e-20 of the largest, for every moment, is empty. */
static const double negligible_log = -45;

static void legendre_row(double t, double *row)
{
  row[0] = 1;
  row[1] = t;
  for (int k = 1; k + 1 < PACKING_I_TERMS; k++)
    row[k + 1] = ((2 * k + 1) * t * row[k] - k * row[k - 1]) / (k + 1);
}

/* Gauss points: zeros of P_16 by Newton's method, from Chebyshev's guess. */
static void gauss_rule(packing_i_smooth_builder *b)
{
  const int n = PACKING_I_TERMS;
  for (int i = 0; i < n; i++) {
    double t = -cos(PACKING_I_PI * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 8; step++) {
      legendre_row(t, b->legendre[i]);
      const double *p = b->legendre[i];
      const double last = ((2 * n - 1) * t * p[n - 1] - (n - 1) * p[n - 2]) / n;
      slope = n * (p[n - 1] - t * last) / (1 - t * t);
      t -= last / slope;
    }
    legendre_row(t, b->legendre[i]);
    b->point[i] = t;
    b->weight[i] = 2 / ((1 - t * t) * slope * slope);
  }
}

packing_status packing_i_smooth_begin(packing_i_smooth_builder *builder,
                                      packing_context *context,
                                      const packing_i_psd_ops *ops, packing_by by,
                                      int dim, double min_r, double max_r)
{
  memset(builder, 0, sizeof *builder);
  builder->context = context;
  builder->smooth = (packing_i_smooth *)packing_i_psd_new(
      context, ops, sizeof *builder->smooth, by, dim, min_r, max_r);
  if (builder->smooth == NULL)
    return PACKING_ERR_NOMEM;
  gauss_rule(builder);
  return PACKING_OK;
}

/* The values of a density at the Gauss points, by number and by mass. */
typedef struct values {
  double x[PACKING_I_TERMS];
  double f[2][PACKING_I_TERMS];
  double largest; /* of the density as it is given */
} values;

static void sample(const packing_i_smooth_builder *b, const packing_i_density *density,
                   double lo, double hi, double half, values *v)
{
  const packing_psd *psd = &b->smooth->base;
  const int e = packing_i_psd_number_exponent(psd->by, psd->dim);
  v->largest = 0;
  for (int i = 0; i < PACKING_I_TERMS; i++) {
    const double x = fmin(lo + lo * expm1(half * (b->point[i] + 1)), hi);
    const double f = density->at(density->law, x);
    v->x[i] = x;
    v->largest = fmax(v->largest, f);
    v->f[0][i] = f * gsl_pow_int(x, e);
    v->f[1][i] = v->f[0][i] * gsl_pow_int(x, psd->dim);
  }
}

static void fit(const packing_i_smooth_builder *b, const double *f, double *term)
{
  for (int k = 0; k < PACKING_I_TERMS; k++) {
    double sum = 0;
    for (int i = 0; i < PACKING_I_TERMS; i++)
      sum += b->weight[i] * f[i] * b->legendre[i][k];
    term[k] = sum / 2;
  }
}

/* Whether the series stands for the density. `log_largest` is -infinity where nothing is known
 * of the panel; else the density may also not fall by more than a factor 30, for Newton's sake. */
static int resolved(const packing_i_smooth_builder *b, const double *f,
                    const double *term, double half, double log_largest,
                    double given_largest)
{
  double largest = f[0], least = f[0], slope = 0;
  for (int i = 1; i < PACKING_I_TERMS; i++) {
    largest = fmax(largest, f[i]);
    least = fmin(least, f[i]);
    slope = fmax(slope, fabs(f[i] - f[i - 1]) / (b->point[i] - b->point[i - 1]));
  }
  if (isfinite(log_largest) && log(largest) < log_largest - 1)
    return 0; /* the largest lies between the points */
  if (largest < DBL_MIN || given_largest < DBL_MIN)
    return 1; /* denormals have no digits left to resolve */
  if (isfinite(log_largest) && least < 0.03 * largest)
    return 0;
  const int last = PACKING_I_TERMS - 1;
  const double tail = (2 * last + 1) * (fabs(term[last]) + fabs(term[last - 1]));
  return largest - least <= 1e-3 * largest ||
         tail <= 1e-13 * largest + 4 * DBL_EPSILON * slope / half;
}

static double log_largest(const packing_i_smooth_builder *b,
                          const packing_i_density *density, double lo, double hi, int n)
{
  if (density->log_largest == NULL)
    return -HUGE_VAL;
  const packing_psd *psd = &b->smooth->base;
  const int e = packing_i_psd_number_exponent(psd->by, psd->dim);
  return density->log_largest(density->law, lo, hi, e + n);
}

static int negligible(const packing_i_smooth_builder *b, const packing_i_density *density,
                      double lo, double hi)
{
  if (density->log_largest == NULL)
    return 0;
  const packing_psd *psd = &b->smooth->base;
  for (int i = 0; i < PACKING_I_PSD_MOMENTS; i++) {
    const int n = i + PACKING_I_PSD_LEAST_POWER;
    if (log_largest(b, density, lo, hi, n) >
        log_largest(b, density, psd->min_x, psd->max_x, n) + negligible_log)
      return 0;
  }
  return 1;
}

static packing_status append(packing_i_smooth_builder *b, const packing_i_panel *panel)
{
  packing_i_smooth *s = b->smooth;
  if (s->count == s->capacity) {
    const size_t capacity = s->capacity == 0 ? FIRST_CAPACITY : 2 * s->capacity;
    packing_i_panel *grown =
        packing_i_regrow(&s->base.allocator, s->panel, s->count, capacity, sizeof *grown);
    if (grown == NULL)
      return packing_i_nomem(b->context);
    s->panel = grown;
    s->capacity = capacity;
  }
  s->panel[s->count++] = *panel;
  return PACKING_OK;
}

static void add_totals(packing_i_smooth_builder *b, const values *v, double half)
{
  for (int i = 0; i < PACKING_I_TERMS; i++)
    for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
      b->total[n] += half * b->weight[i] * v->f[0][i] *
                     gsl_pow_int(v->x[i], n + PACKING_I_PSD_LEAST_POWER);
}

/* Makes the panel [lo, hi]; 0: it must be halved. */
static int make_panel(packing_i_smooth_builder *b, const packing_i_density *density,
                      double lo, double hi, int may_halve, packing_i_panel *panel)
{
  values v;
  memset(panel, 0, sizeof *panel);
  panel->x = lo;
  panel->half = log1p((hi - lo) / lo) / 2;
  if (negligible(b, density, lo, hi))
    return 1;
  if (may_halve && panel->half > 0.5)
    return 0;
  sample(b, density, lo, hi, panel->half, &v);
  for (int by = 0; by < 2; by++) {
    const int n = by == 0 ? 0 : b->smooth->base.dim;
    fit(b, v.f[by], panel->term[by]);
    if (may_halve && !resolved(b, v.f[by], panel->term[by], panel->half,
                               log_largest(b, density, lo, hi, n), v.largest))
      return 0;
  }
  add_totals(b, &v, panel->half);
  return 1;
}

packing_status packing_i_smooth_interval(packing_i_smooth_builder *builder,
                                         const packing_i_density *density, double lo,
                                         double hi)
{
  double later[MOST_HALVINGS]; /* upper ends of what waits to the right */
  size_t waiting = 0;
  for (;;) {
    packing_i_panel panel;
    const double middle = sqrt(lo * hi);
    const int may_halve = waiting < MOST_HALVINGS && lo < middle && middle < hi;
    if (!make_panel(builder, density, lo, hi, may_halve, &panel)) {
      later[waiting++] = hi;
      hi = middle;
      continue;
    }
    PACKING_I_TRY(append(builder, &panel));
    if (waiting == 0)
      return PACKING_OK;
    lo = hi;
    hi = later[--waiting];
  }
}

/* From densities of u to shares of the whole. */
void packing_i_smooth_end(packing_i_smooth_builder *builder)
{
  packing_i_smooth *s = builder->smooth;
  const double *whole = &builder->total[-PACKING_I_PSD_LEAST_POWER];
  for (int by = 0; by < 2; by++) {
    double total = 0, below = 0;
    for (size_t i = 0; i < s->count; i++)
      total += s->panel[i].half * 2 * s->panel[i].term[by][0];
    for (size_t i = 0; i < s->count; i++) {
      packing_i_panel *panel = &s->panel[i];
      for (int k = 0; k < PACKING_I_TERMS; k++)
        panel->term[by][k] *= panel->half / total;
      panel->below[by] = below;
      panel->share[by] = 2 * panel->term[by][0];
      below += panel->share[by];
    }
  }
  for (int n = 0; n < PACKING_I_PSD_MOMENTS; n++)
    s->base.moment[n] = builder->total[n] / *whole;
}
