/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions to a table of panels; see smooth_internal.h. */
#include "smooth_internal.h"
#include <math.h>

enum { MOST_STEPS = 100 };

/* P_(k+1) = a_k t P_k - b_k P_(k-1), with a_k = (2 k + 1) / (k + 1), b_k = k / (k + 1). */
static const double recur_a[PACKING_I_TERMS] = {
    1,         3.0 / 2,   5.0 / 3,   7.0 / 4,   9.0 / 5,   11.0 / 6,
    13.0 / 7,  15.0 / 8,  17.0 / 9,  19.0 / 10, 21.0 / 11, 23.0 / 12,
    25.0 / 13, 27.0 / 14, 29.0 / 15, 31.0 / 16};
static const double recur_b[PACKING_I_TERMS] = {
    0,       1.0 / 2,  2.0 / 3,   3.0 / 4,   4.0 / 5,   5.0 / 6,   6.0 / 7,   7.0 / 8,
    8.0 / 9, 9.0 / 10, 10.0 / 11, 11.0 / 12, 12.0 / 13, 13.0 / 14, 14.0 / 15, 15.0 / 16};

/* The integral of the series from -1 to t, and the series at t: the integral of (2 k + 1) P_k is
 * P_(k+1) - P_(k-1), that of P_0 is t + 1. */
static double integrate(const double *term, double t, double *density)
{
  double before = 1, p = t; /* P_(k-1), P_k */
  double share = term[0] * (t + 1), sum = term[0];
  for (int k = 1; k < PACKING_I_TERMS; k++) {
    const double after = recur_a[k] * t * p - recur_b[k] * before;
    share += term[k] * (after - before);
    sum += (2 * k + 1) * term[k] * p;
    before = p;
    p = after;
  }
  *density = sum;
  return share;
}

/* Newton's method held in a bracket: t with integral `share`. */
static double invert(const double *term, double share, double all)
{
  double lo = -1, hi = 1, t = 2 * share / all - 1;
  for (int step = 0; step < MOST_STEPS; step++) {
    double density;
    const double excess = integrate(term, t, &density) - share;
    if (excess < 0)
      lo = t;
    else
      hi = t;
    double next = t - excess / density;
    if (!(next >= lo && next <= hi))
      next = lo + (hi - lo) / 2;
    const double move = fabs(next - t);
    t = next;
    if (move < 1e-10) /* the error is of the order of its square */
      break;
  }
  return t;
}

double packing_i_smooth_cdf(const packing_psd *psd, packing_by by, double x)
{
  const packing_i_smooth *s = (const packing_i_smooth *)psd;
  const int b = by == PACKING_BY_MASS;
  size_t lo = 0, hi = s->count;
  while (hi - lo > 1) {
    const size_t middle = lo + (hi - lo) / 2;
    if (s->panel[middle].x <= x)
      lo = middle;
    else
      hi = middle;
  }
  const packing_i_panel *panel = &s->panel[lo];
  double density;
  const double t = log1p((x - panel->x) / panel->x) / panel->half - 1;
  const double share = integrate(panel->term[b], fmin(t, 1), &density);
  return panel->below[b] + fmin(fmax(share, 0), panel->share[b]);
}

/* In the last panel that begins below p; none is empty there but at the very end. */
double packing_i_smooth_quantile(const packing_psd *psd, packing_by by, double p)
{
  const packing_i_smooth *s = (const packing_i_smooth *)psd;
  const int b = by == PACKING_BY_MASS;
  size_t lo = 0, hi = s->count;
  while (hi - lo > 1) {
    const size_t middle = lo + (hi - lo) / 2;
    if (s->panel[middle].below[b] < p)
      lo = middle;
    else
      hi = middle;
  }
  while (lo > 0 && s->panel[lo].share[b] == 0)
    lo--;
  const packing_i_panel *panel = &s->panel[lo];
  const double share = fmin(p - panel->below[b], panel->share[b]);
  const double t = invert(panel->term[b], share, panel->share[b]);
  return panel->x + panel->x * expm1(panel->half * (t + 1));
}

void packing_i_smooth_finish(packing_psd *psd)
{
  packing_i_smooth *s = (packing_i_smooth *)psd;
  packing_i_free(&psd->allocator, s->panel);
}
