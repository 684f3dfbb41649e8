/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All pairs within reach, block by block. A block owns particles that follow each other in the
 * sorted order; it meets each with what stands later on its own level and with all of the
 * coarser levels, and where that is asked for with their periodic images. */
#include "grid/grid_internal.h"
#include <float.h>
#include <math.h>

typedef struct visit {
  const packing_grid *grid;
  const double *swept;
  packing_i_grid_reach reach;
  packing_i_pair_function fn;
  void *arg;
  packing_i_grid_axis axis[3]; /* half infinite where images are met one by one */
  double shift[3];             /* of the image that is met: */
  int image[3];                /* by so many periods */
} visit;

/* Particles [first, end) of one row. */
typedef struct run {
  size_t row;
  size_t first;
  size_t end;
} run;

size_t packing_i_grid_blocks(const packing_grid *grid)
{
  return (grid->count + PACKING_I_GRID_BLOCK - 1) / PACKING_I_GRID_BLOCK;
}

/* One coordinate of i less that of the image of j. */
static double apart(const visit *v, int k, double i, double j)
{
  return packing_i_grid_nearest(&v->axis[k], i - j - v->shift[k]);
}

static int image_of(const visit *v, int k, double i, double j)
{
  const double d = i - j - v->shift[k];
  return v->image[k] + (d > v->axis[k].half) - (d < -v->axis[k].half);
}

/* Particle j with [first, end). The screen compares squares, a little generously. */
static void meet(const visit *v, size_t j, size_t first, size_t end)
{
  const packing_grid *g = v->grid;
  const double xj = g->x[j], yj = g->y[j], zj = g->z[j], rj = g->r[j];
  const double factor = v->reach.factor, gap = v->reach.gap;
  for (size_t i = first; i < end; i++) {
    const double dx = apart(v, 0, g->x[i], xj);
    const double dy = apart(v, 1, g->y[i], yj);
    const double dz = apart(v, 2, g->z[i], zj);
    const double t = (g->r[i] + rj) * factor + gap;
    const double d2 = dx * dx + dy * dy + dz * dz;
    if (!(d2 <= t * t * (1.0 + 8.0 * DBL_EPSILON)) || t < 0)
      continue;
    const packing_i_grid_pair pair = {i,
                                      j,
                                      {0.0 - dx, 0.0 - dy, 0.0 - dz},
                                      sqrt(d2),
                                      {image_of(v, 0, g->x[i], xj),
                                       image_of(v, 1, g->y[i], yj),
                                       image_of(v, 2, g->z[i], zj)}};
    v->fn(v->arg, &pair);
  }
}

/* Swept distance from j, moved by shift, to i; falls as j rises and rises with i. */
static double ahead(const visit *v, size_t i, size_t j, double shift)
{
  return v->swept[i] - v->swept[j] - shift;
}

/* The first of row particles [first, end) not farther than reach behind particle i. */
static size_t first_in_reach(const visit *v, size_t i, size_t first, size_t end,
                             double shift, double reach)
{
  while (first < end) {
    const size_t middle = first + (end - first) / 2;
    if (ahead(v, i, middle, shift) > reach)
      first = middle + 1;
    else
      end = middle;
  }
  return first;
}

static int is_moved(const visit *v)
{
  return v->image[0] != 0 || v->image[1] != 0 || v->image[2] != 0;
}

/* One run with one row: as j moves along the row, so does the window of the run. In its own row
 * a particle meets those before it, and all images of all. */
static void sweep_row(const visit *v, const run *a, size_t row,
                      const packing_i_grid_sweep *s, int pass)
{
  const packing_i_grid_row *rows = v->grid->rows;
  const int own = row == a->row && !is_moved(v);
  const double shift = s->shift[pass], reach = s->reach;
  const size_t end = rows[row + 1].start;
  size_t lo = a->first, hi = a->first;
  size_t j =
      first_in_reach(v, lo, own ? a->first + 1 : rows[row].start, end, shift, reach);
  if (j == end || ahead(v, a->end - 1, j, shift) < -reach)
    return;
  for (; j < end; j++) {
    const size_t stop = own && j < a->end ? j : a->end;
    while (lo < a->end && ahead(v, lo, j, shift) < -reach)
      lo++;
    if (lo == a->end)
      return;
    hi = hi < lo ? lo : hi;
    while (hi < stop && ahead(v, hi, j, shift) <= reach)
      hi++;
    meet(v, j, lo, hi);
  }
}

/* Rows of a level in reach of a run along axis k. */
static void find_around(const visit *v, int k, uint64_t cell,
                        const packing_i_grid_level *from, const packing_i_grid_level *to,
                        double reach, packing_i_grid_range *range)
{
  const packing_i_grid_axis *axis = &v->axis[k];
  const int finer = from->octave - to->octave;
  if (axis->cells > 0 && isinf(axis->half))
    packing_i_grid_around_image(axis, cell, to->octave, finer, reach, v->image[k], range);
  else
    packing_i_grid_around(axis, cell, to->octave, finer, reach, range);
}

static void find_sweep(const visit *v, double reach, packing_i_grid_sweep *s)
{
  const int k = v->grid->order[0];
  packing_i_grid_sweep_init(v->grid, reach, s);
  if (v->axis[k].cells > 0 && isinf(v->axis[k].half)) {
    s->reach = reach;
    s->shift[0] = v->shift[k];
    s->passes = 1;
  }
}

/* One run with all rows of a level that are in reach: on its own level with itself and those
 * behind it, or, for an image, with all. */
static void sweep_image(const visit *v, const run *a, const packing_i_grid_level *from,
                        const packing_i_grid_level *to, double reach)
{
  const packing_grid *g = v->grid;
  packing_i_grid_range b, c;
  packing_i_grid_sweep s;
  find_around(v, g->order[1], g->rows[a->row].b, from, to, reach, &b);
  find_around(v, g->order[2], g->rows[a->row].c, from, to, reach, &c);
  find_sweep(v, reach, &s);
  const size_t first = from == to && !is_moved(v) ? a->row : to->first_row,
               end = to->end_row;
  for (int q = 0; q < b.parts * c.parts; q++) {
    const int qb = q % b.parts, qc = q / b.parts;
    size_t row = first;
    while ((row = packing_i_grid_next_row(g, row, end, b.lo[qb], b.hi[qb], c.lo[qc],
                                          c.hi[qc])) < end) {
      for (int pass = 0; pass < s.passes; pass++)
        sweep_row(v, a, row, &s, pass);
      row++;
    }
  }
}

static void move_image(visit *v, int k, int periods)
{
  v->image[k] = periods;
  v->shift[k] = periods * v->axis[k].period;
}

/* Whether the first component that is not 0 is below 0. */
static int is_backward(const int image[3])
{
  for (int k = 0; k < 3; k++)
    if (image[k] != 0)
      return image[k] < 0;
  return 0;
}

/* One run with a level, image by image along the axes too narrow for the nearest one to be the
 * only one in reach. Centres are less than a period apart, so a reach of n periods and a bit
 * meets images up to n + 1. An image of a pair of one level is that, backwards, of the swapped
 * pair. */
static void sweep_level(visit *v, const run *a, const packing_i_grid_level *from,
                        const packing_i_grid_level *to)
{
  const packing_grid *g = v->grid;
  const double reach = (from->r_max + to->r_max) * v->reach.factor + v->reach.gap;
  int most[3] = {0, 0, 0};
  if (!(reach >= 0))
    return;
  for (int k = 0; k < 3; k++) {
    v->axis[k].half = g->axis[k].half;
    if (!v->reach.all_images || !packing_i_grid_is_narrow(&g->axis[k], reach))
      continue;
    v->axis[k].half = (double)INFINITY;
    most[k] = (int)(reach / g->axis[k].period) + 1;
  }
  for (int x = -most[0]; x <= most[0]; x++)
    for (int y = -most[1]; y <= most[1]; y++)
      for (int z = -most[2]; z <= most[2]; z++) {
        move_image(v, 0, x);
        move_image(v, 1, y);
        move_image(v, 2, z);
        if (from != to || !is_backward(v->image))
          sweep_image(v, a, from, to, reach);
      }
}

/* The row that holds a particle. */
static size_t row_of(const packing_grid *g, size_t particle)
{
  size_t low = 0, high = g->level[g->levels - 1].end_row;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    if (g->rows[middle].start <= particle)
      low = middle;
    else
      high = middle;
  }
  return low;
}

void packing_i_grid_visit(const packing_grid *grid, const packing_i_grid_reach *reach,
                          size_t block, packing_i_pair_function fn, void *arg)
{
  visit v = {grid,      packing_i_grid_swept(grid),
             *reach,    fn,
             arg,       {grid->axis[0], grid->axis[1], grid->axis[2]},
             {0, 0, 0}, {0, 0, 0}};
  const size_t first = block * PACKING_I_GRID_BLOCK;
  const size_t end = grid->count - first < PACKING_I_GRID_BLOCK
                         ? grid->count
                         : first + PACKING_I_GRID_BLOCK;
  run a = {row_of(grid, first), first, first};
  for (int level = 0; a.first < end; a.row++, a.first = a.end) {
    const size_t row_end = grid->rows[a.row + 1].start;
    a.end = row_end < end ? row_end : end;
    while (a.row >= grid->level[level].end_row)
      level++;
    for (int coarser = 0; coarser <= level; coarser++)
      sweep_level(&v, &a, &grid->level[level], &grid->level[coarser]);
  }
}
