/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Directional distance from the gap alone, by conservative advancement: the gap changes
 * by no more than the way gone, so that a body at a gap of g can go on by g (B. Mirtich,
 * Impulse-based dynamic simulation, 1996; J. C. Hart's sphere tracing, Vis. Comput. 12,
 * 527, 1996). Towards a contact that comes in at a slant the steps shrink for ever; so no
 * step is shorter than 2^-16 of the body's radius, and where one steps into an overlap,
 * bisection goes back to its begin. What is passed unseen is an overlap shorter than one
 * such step, and as deep as half of it at most; of smooth bodies as large as the mobile
 * one, 3e-11 of the radius.
 *
 * Cost: some 10 to 100 gaps; at worst, sliding along, 65536 for each radius of way. */
#include "shape_internal.h"
#include <float.h>

typedef struct way {
  const packing_body *a, *b;
  packing_vec3 direction;
} way;

static double gap_at(const way *w, double t)
{
  packing_body moved = *w->a;
  moved.centre = packing_i_add(moved.centre, packing_i_scale(w->direction, t));
  return packing_body_gap(&moved, w->b);
}

/* Rounding of a gap. */
static double noise_of(const way *w, double to)
{
  double size = packing_i_norm(w->a->centre) + w->a->r + to;
  if (w->b->domain == NULL)
    size += packing_i_norm(w->b->centre) + w->b->r;
  return 8 * DBL_EPSILON * size;
}

/* The begin of the overlap in (lo, hi], from its free side. */
static double begin(const way *w, double lo, double hi, double noise)
{
  while (hi - lo > noise) {
    const double middle = lo + 0.5 * (hi - lo);
    if (!(middle > lo && middle < hi))
      break;
    if (gap_at(w, middle) < 0)
      hi = middle;
    else
      lo = middle;
  }
  return lo;
}

double packing_i_march(const packing_body *a, const packing_body *b,
                       const packing_vec3 *direction, double from, double to)
{
  const way w = {a, b, *direction};
  const double noise = noise_of(&w, isfinite(to) ? to : 0);
  const double least = a->r * 0x1p-16;
  double t = from, gap = gap_at(&w, t);
  /* Bodies that overlap already touch if they go on into each other; else they are let
   * out. */
  int out = !(gap < -noise);
  if (!out && !(gap_at(&w, t + least) > gap))
    return t;
  while (t < to) {
    const double step = fabs(gap) > least ? fabs(gap) : least;
    const double next = t + step;
    gap = gap_at(&w, next);
    if (out && gap < -noise)
      return begin(&w, t, next, 0.125 * noise);
    out = out || !(gap < -noise);
    t = next;
  }
  return HUGE_VAL;
}
