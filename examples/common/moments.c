/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "moments.h"
#include <math.h>

moments moments_of(const double *values, size_t count)
{
  double sum = 0, squares = 0;
  for (size_t i = 0; i < count; i++)
    sum += values[i];
  const double mean = sum / (double)count;
  for (size_t i = 0; i < count; i++)
    squares += (values[i] - mean) * (values[i] - mean);
  const moments found = {mean,
                         count > 1 ? sqrt(squares / (double)(count - 1)) : (double)NAN};
  return found;
}
