/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "axis.h"
#include <math.h>

static void add_tick(axis_range *a, double value)
{
  const double slack = 1e-9 * (a->hi - a->lo);
  if (a->count < AXIS_TICKS && value >= a->lo - slack && value <= a->hi + slack)
    a->tick[a->count++] = value;
}

/* 1, 2 or 5 times a power of ten, four to nine ticks. */
static void add_linear_ticks(axis_range *a)
{
  const double rough = (a->hi - a->lo) / 5, unit = pow(10, floor(log10(rough)));
  const double lead = rough / unit;
  const double step = unit * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  const double first = ceil(a->lo / step - 1e-9);
  for (int i = 0; i < AXIS_TICKS; i++)
    add_tick(a, (first + i) * step + 0.0); /* never -0 */
}

/* 1, 2, 5 in each decade; over more than four decades the powers of ten alone. */
static void add_logarithmic_ticks(axis_range *a)
{
  static const double leads[] = {1, 2, 5};
  const int all = log10(a->hi / a->lo) <= 4;
  const int first = (int)floor(log10(a->lo)), last = (int)ceil(log10(a->hi));
  for (int k = first; k <= last; k++)
    for (int i = 0; i < (all ? 3 : 1); i++)
      add_tick(a, leads[i] * pow(10, k));
}

void axis_init(axis_range *a, double lo, double hi, int may_be_logarithmic)
{
  if (!(hi > lo * (1 + 1e-12))) {
    const double middle = lo;
    lo = middle > 0 ? 0.5 * middle : middle - 1;
    hi = middle > 0 ? 1.5 * middle : middle + 1;
    may_be_logarithmic = 0;
  }
  a->lo = lo;
  a->hi = hi;
  a->count = 0;
  a->logarithmic = may_be_logarithmic && lo > 0 && hi / lo > 3;
  if (a->logarithmic)
    add_logarithmic_ticks(a);
  else
    add_linear_ticks(a);
}

void axis_thin(axis_range *a)
{
  /* Of 1, 2, 5 the ones stay; of even steps every second, the first among them. */
  size_t kept = 0;
  for (size_t k = 0; k < a->count; k++) {
    const double lead = a->tick[k] / pow(10, floor(log10(a->tick[k]) + 1e-9));
    if (a->count > 6 && (a->logarithmic ? lead < 1.5 : k % 2 == 0))
      a->tick[kept++] = a->tick[k];
    else if (a->count <= 6)
      kept++;
  }
  a->count = kept;
}

double axis_place(const axis_range *a, double value)
{
  return a->logarithmic ? log(value / a->lo) / log(a->hi / a->lo)
                        : (value - a->lo) / (a->hi - a->lo);
}

double axis_value(const axis_range *a, double place)
{
  return a->logarithmic ? a->lo * pow(a->hi / a->lo, place)
                        : a->lo + place * (a->hi - a->lo);
}
