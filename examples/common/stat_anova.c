/* SPDX-License-Identifier: GPL-3.0-or-later */
/* F = (sum n_i (mean_i - mean)^2 / (k - 1)) / (sum (n_i - 1) sd_i^2 / (N - k)): one-way analysis
 * of variance (R. A. Fisher, Statistical Methods for Research Workers, 1925), from figures. */
#include <gsl/gsl_cdf.h>
#include <math.h>
#include "stat.h"

stat_anova stat_anova_test(const stat_summary *samples, size_t count)
{
  stat_anova a = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
  double n = 0, sum = 0, between = 0, within = 0;
  for (size_t i = 0; i < count; i++) {
    n += samples[i].n;
    sum += samples[i].n * samples[i].mean;
    within += samples[i].n > 1 ? (samples[i].n - 1) * samples[i].sd * samples[i].sd : 0;
  }
  for (size_t i = 0; i < count; i++)
    between += samples[i].n * (samples[i].mean - sum / n) * (samples[i].mean - sum / n);
  if (count < 2 || !(n > (double)count) || !(within > 0))
    return a;
  a.between = (double)count - 1;
  a.within = n - (double)count;
  a.f = between / a.between / (within / a.within);
  a.p = gsl_cdf_fdist_Q(a.f, a.between, a.within);
  return a;
}
