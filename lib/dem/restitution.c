/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Restitution of Hertz contacts with the damping of Campello and Cassares (Lat. Am. J. Solids
 * Struct. 13, 23, 2016, equation 10), after Y. Antypov and J. A. Elliott (EPL 94, 50004, 2011).
 *
 * With w = delta^(5/4) in place of the overlap, and a time s that runs as dw = v ds, the equation
 * of a collision is that of a damped spring, dv/ds = -(w + 2 zeta v) in proper units, with
 * zeta = xi sqrt(6/5): neither speed nor size nor stiffness is left. From w = 0, v = 1:
 *
 * - The force pulls to the end: separation where w = 0 again, e = exp(-pi zeta / s),
 *   s = sqrt(1 - zeta^2); from zeta = 1 on that never comes, e = 0.
 * - The force is cut off at 0: separation where dv/ds = 0. With zeta = cos(phi) the turn until
 *   then is 2 phi, e = exp(-2 zeta acos(zeta) / s). Beyond zeta = 1, with q = sqrt(zeta^2 - 1)
 *   and the ratio R = (zeta + q)^2 of the two decay rates, v is least at R^(-(R+1)/(R-1)), so
 *   e = exp(-2 zeta acosh(zeta) / q): the same function, going through exp(-2) at zeta = 1 and
 *   like 1 / (4 zeta^2) in the end.
 *
 * The inverse: closed for the force that pulls; for the other a bisection of what stands in the
 * exponent, which rises with zeta. Some microseconds. */
#include <float.h>
#include <math.h>
#include <packing/dem.h>

#define PI 3.14159265358979323846

/* zeta = xi sqrt(6/5) */
static const double zeta_per_damping = 1.0954451150103322;

/* acos(zeta) / sqrt(1 - zeta^2) and its continuation, 1 at zeta = 1. */
static double angle_over_sine(double zeta)
{
  if (zeta < 1)
    return acos(zeta) / sqrt((1 - zeta) * (1 + zeta));
  return zeta > 1 ? acosh(zeta) / (sqrt(zeta - 1) * sqrt(zeta + 1)) : 1;
}

/* -ln(e), the force cut off at 0: between 2 zeta and pi zeta up to zeta = 1, above 2 ln(zeta)
 * beyond. */
static double decay(double zeta)
{
  return 2 * zeta * angle_over_sine(zeta);
}

double packing_hertz_restitution(double damping, int pull)
{
  if (!(damping >= 0) || isinf(damping))
    return (double)NAN;
  const double zeta = fmin(damping * zeta_per_damping, DBL_MAX);
  if (!pull)
    return exp(-decay(zeta));
  return zeta < 1 ? exp(-PI * zeta / sqrt((1 - zeta) * (1 + zeta))) : 0;
}

/* The zeta that decays by `wanted` > 0, halved out of the bracket that the bounds of decay()
 * give, in the logarithm while it is wide, until no double is left within. */
static double zeta_of(double wanted)
{
  double low = wanted / PI * (1 - 4 * DBL_EPSILON);
  double high = (wanted <= 2 ? wanted / 2 : exp(wanted / 2)) * (1 + 4 * DBL_EPSILON);
  for (;;) {
    const double middle =
        high > 2 * low ? sqrt(low) * sqrt(high) : low + (high - low) / 2;
    if (!(low < middle && middle < high))
      return high;
    if (decay(middle) < wanted)
      low = middle;
    else
      high = middle;
  }
}

double packing_hertz_damping(double restitution, int pull)
{
  if (!(restitution > 0 && restitution <= 1))
    return (double)NAN;
  if (restitution == 1)
    return 0;
  const double wanted = -log(restitution);
  const double zeta = pull ? wanted / sqrt(PI * PI + wanted * wanted) : zeta_of(wanted);
  return zeta / zeta_per_damping;
}
