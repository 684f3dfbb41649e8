/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volume (area) that two balls (discs) share, in closed form: two caps.
 *
 * Balls of radii p and q at distance d meet in a plane that cuts caps of the heights
 * (q - d + p)(q - p + d) / (2 d) off the first and (p - d + q)(p + d - q) / (2 d) off the
 * second: products, so that a thin lens loses nothing but what d - p - q lost,
 * and nearly equal balls nothing at all. */
#include "domain_kinds.h"
#include <math.h>

/* Below 1.5 by its series, x^3/3! - x^5/5! + ... x^25/25!. */
double packing_i_minus_sin(double x)
{
  if (x > 1.5)
    return x - sin(x);
  double sum = 1;
  for (int n = 24; n >= 4; n -= 2)
    sum = 1 - x * x / (n * (n + 1)) * sum;
  return x * x * x / 6 * sum;
}

double packing_i_cap(int dim, double r, double h)
{
  if (h <= 0)
    return 0;
  if (h >= 2 * r)
    return packing_i_ball_volume(dim, r);
  if (dim == 3)
    return PACKING_I_PI / 3 * h * h * (3 * r - h);
  return 0.5 * r * r * packing_i_minus_sin(4 * atan(sqrt(h / (2 * r - h))));
}

double packing_i_lens(int dim, double p, double q, double d)
{
  if (d >= p + q)
    return 0;
  if (d <= fabs(p - q))
    return packing_i_ball_volume(dim, p < q ? p : q);
  const double h = (q - d + p) * ((q - p) + d) / (2 * d);
  const double k = (p - d + q) * ((p - q) + d) / (2 * d);
  return packing_i_cap(dim, p, h) + packing_i_cap(dim, q, k);
}
