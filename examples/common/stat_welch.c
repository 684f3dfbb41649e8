/* SPDX-License-Identifier: GPL-3.0-or-later */
/* t = (mean_a - mean_b) / sqrt(e_a^2 + e_b^2) with e = sd / sqrt(n), degrees of freedom
 * (e_a^2 + e_b^2)^2 / (e_a^4 / (n_a - 1) + e_b^4 / (n_b - 1)): B. L. Welch, Biometrika 34 (1947),
 * p. 28. */
#include <gsl/gsl_cdf.h>
#include <math.h>
#include "stat.h"

/* The shares of the variance keep the fourth powers in range. */
stat_welch stat_welch_test(const stat_summary *a, const stat_summary *b)
{
  const double ea = stat_standard_error(a), eb = stat_standard_error(b);
  const double error = hypot(ea, eb), sa = ea / error, sb = eb / error;
  stat_welch w = {(double)NAN, (double)NAN, (double)NAN};
  if (!(a->n > 1 && b->n > 1 && error > 0))
    return w;
  w.t = (a->mean - b->mean) / error;
  w.dof = 1 / (pow(sa, 4) / (a->n - 1) + pow(sb, 4) / (b->n - 1));
  w.p = 2 * gsl_cdf_tdist_Q(fabs(w.t), w.dof);
  return w;
}
