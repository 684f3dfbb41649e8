/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random rotations and directions, of + - * / and sqrt. */
#include "front_paper.h"

/* A point of the unit disc; its squared radius. */
static double disc(packing_i_stream *stream, double *x, double *y)
{
  double s;
  do {
    *x = 2 * packing_i_stream_uniform(stream) - 1;
    *y = 2 * packing_i_stream_uniform(stream) - 1;
    s = *x * *x + *y * *y;
  } while (!(s > 0 && s < 1));
  return s;
}

/* G. Marsaglia, Ann. Math. Stat. 43, 645 (1972). */
void packing_i_paper_turn(packing_i_stream *stream, int dim, double q[4])
{
  double x, y, s = disc(stream, &x, &y);
  const double scale = dim == 2 ? 1 / sqrt(s) : 1;
  q[0] = x * scale;
  q[3] = y * scale;
  q[1] = q[2] = 0;
  if (dim == 2)
    return;
  const double rest = 1 - s;
  s = disc(stream, &x, &y);
  q[1] = x * sqrt(rest / s);
  q[2] = y * sqrt(rest / s);
}

packing_vec3 packing_i_paper_direction(packing_i_stream *stream, int dim)
{
  double x, y;
  const double s = disc(stream, &x, &y);
  if (dim == 2)
    return packing_i_vec(x / sqrt(s), y / sqrt(s), 0);
  const double w = 2 * sqrt(1 - s);
  return packing_i_vec(x * w, y * w, 1 - 2 * s);
}
