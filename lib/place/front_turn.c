/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random rotations and directions, of + - * / and sqrt. */
#include "front_internal.h"

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
void packing_i_front_turn(packing_i_stream *stream, int dim, double q[4])
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

packing_vec3 packing_i_front_direction(packing_i_stream *stream, int dim)
{
  double x, y;
  const double s = disc(stream, &x, &y);
  if (dim == 2)
    return packing_i_vec(x / sqrt(s), y / sqrt(s), 0);
  const double w = 2 * sqrt(1 - s);
  return packing_i_vec(x * w, y * w, 1 - 2 * s);
}

void packing_i_front_turn_points(packing_i_stream *stream, int dim, packing_vec3 *point,
                                 size_t count)
{
  double q[4];
  packing_i_front_turn(stream, dim, q);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const packing_vec3 column[3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
      {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
      {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  for (size_t n = 0; n < count; n++)
    point[n] = packing_i_add(packing_i_scale(column[0], point[n].x),
                             packing_i_add(packing_i_scale(column[1], point[n].y),
                                           packing_i_scale(column[2], point[n].z)));
}
