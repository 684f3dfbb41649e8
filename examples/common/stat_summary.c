/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include "moments.h"
#include "stat.h"

stat_summary stat_summarise(const double *values, size_t count)
{
  const moments m = moments_of(values, count);
  const stat_summary s = {(double)count, m.mean, m.sd};
  return s;
}

double stat_standard_error(const stat_summary *s)
{
  return s->sd / sqrt(s->n);
}

double stat_confidence95(const stat_summary *s)
{
  if (!(s->n > 1))
    return (double)NAN;
  return gsl_cdf_tdist_Pinv(0.975, s->n - 1) * stat_standard_error(s);
}

double stat_median(const double *sorted, size_t count)
{
  const size_t half = count / 2;
  return count % 2 ? sorted[half] : sorted[half - 1] / 2 + sorted[half] / 2;
}

void stat_sort(double *values, size_t count)
{
  gsl_sort(values, 1, count);
}
