/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All pairs within reach, block by block. A block owns particles that follow each other in the
 * sorted order; it meets each with what stands later on its own level and with all of the
 * coarser levels. */
#include "grid/grid_internal.h"
#include <float.h>
#include <math.h>

typedef struct visit {
  const packing_grid *grid;
  const double *swept;
  packing_i_grid_reach reach;
  packing_i_pair_function fn;
  void *arg;
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

/* Particle j with [first, end). The screen compares squares, a little generously. */
static void meet(const visit *v, size_t j, size_t first, size_t end)
{
  const packing_grid *g = v->grid;
  const double xj = g->x[j], yj = g->y[j], zj = g->z[j], rj = g->r[j];
  const double factor = v->reach.factor, gap = v->reach.gap;
  for (size_t i = first; i < end; i++) {
    const double dx = packing_i_grid_nearest(&g->axis[0], g->x[i] - xj);
    const double dy = packing_i_grid_nearest(&g->axis[1], g->y[i] - yj);
    const double dz = packing_i_grid_nearest(&g->axis[2], g->z[i] - zj);
    const double t = (g->r[i] + rj) * factor + gap;
    const double d2 = dx * dx + dy * dy + dz * dz;
    if (!(d2 <= t * t * (1.0 + 8.0 * DBL_EPSILON)) || t < 0)
      continue;
    const size_t a = g->index[i], b = g->index[j];
    if (a < b)
      v->fn(v->arg, a, b, sqrt(d2), g->r[i], rj);
    else
      v->fn(v->arg, b, a, sqrt(d2), rj, g->r[i]);
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

/* One run with one row: as j moves along the row, so does the window of the run. In its own row
 * a particle meets those before it. */
static void sweep_row(const visit *v, const run *a, size_t row,
                      const packing_i_grid_sweep *s, int pass)
{
  const packing_i_grid_row *rows = v->grid->rows;
  const int own = row == a->row;
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

/* One run with all rows of a level that are in reach: on its own level with itself and those
 * behind it. */
static void sweep_level(const visit *v, const run *a, const packing_i_grid_level *from,
                        const packing_i_grid_level *to)
{
  const packing_grid *g = v->grid;
  const double reach = (from->r_max + to->r_max) * v->reach.factor + v->reach.gap;
  packing_i_grid_range b, c;
  packing_i_grid_sweep s;
  if (!(reach >= 0))
    return;
  const int finer = from->octave - to->octave;
  packing_i_grid_around(&g->axis[g->order[1]], g->rows[a->row].b, to->octave, finer,
                        reach, &b);
  packing_i_grid_around(&g->axis[g->order[2]], g->rows[a->row].c, to->octave, finer,
                        reach, &c);
  packing_i_grid_sweep_init(g, reach, &s);
  const size_t first = from == to ? a->row : to->first_row, end = to->end_row;
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
  const visit v = {grid, packing_i_grid_swept(grid), *reach, fn, arg};
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
