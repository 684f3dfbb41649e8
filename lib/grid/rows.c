/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells and rows: which cell a coordinate falls into, which rows are in reach of a cell. */
#include "grid/grid_internal.h"
#include <math.h>

double packing_i_grid_width(const packing_i_grid_axis *axis, int octave)
{
  return ldexp(axis->width, -octave);
}

/* floor(u 2^octave) with u in cells of octave 0, so cells of one octave nest in those of a
 * coarser one: the product is exact. Open axes start at -2^41 cells of the deepest octave. */
uint64_t packing_i_grid_cell(const packing_grid *grid, const packing_i_grid_axis *axis,
                             double v, int octave)
{
  const double scale = (double)(UINT64_C(1) << octave);
  const double u = (v - axis->lo) / axis->width;
  if (axis->cells > 0) {
    const uint64_t cells = axis->cells << octave;
    const double k = u * scale;
    const uint64_t cell = k > 0 ? (uint64_t)k : 0;
    return cell < cells ? cell : cells - 1;
  }
  const int64_t most = INT64_C(1) << (PACKING_I_GRID_REACH - grid->deepest);
  const double limit = (double)most;
  const double clamped = u < -limit ? -limit : u > limit ? limit : u;
  return (uint64_t)((int64_t)floor(clamped * scale) + (most << octave));
}

/* Two cells whose numbers differ by more than this hold nothing within reach of each other; each
 * end may be off by 1/256 cell. */
static uint64_t cells_within(const packing_i_grid_axis *axis, int octave, double reach)
{
  const double cells =
      floor(reach / packing_i_grid_width(axis, octave) + 1.0 / 128) + 1.0;
  const double most = ldexp(1.0, PACKING_I_GRID_REACH + 3);
  return cells < most ? (uint64_t)cells : (uint64_t)most;
}

void packing_i_grid_around(const packing_i_grid_axis *axis, uint64_t cell, int octave,
                           int finer, double reach, packing_i_grid_range *range)
{
  const uint64_t n = cells_within(axis, octave + finer, reach);
  const uint64_t around = axis->cells << (octave + finer);
  range->parts = 1;
  if (around == 0) {
    range->lo[0] = (cell > n ? cell - n : 0) >> finer;
    range->hi[0] = (cell + n) >> finer;
    return;
  }
  range->lo[0] = 0;
  range->hi[0] = (axis->cells << octave) - 1;
  if (2 * n + 1 >= around)
    return;
  if (cell >= n && cell + n < around) {
    range->lo[0] = (cell - n) >> finer;
    range->hi[0] = (cell + n) >> finer;
    return;
  }
  const uint64_t last = (cell + n) % around, first = (cell + around - n) % around;
  if (first >> finer <= last >> finer)
    return; /* both ends lie in one coarser cell */
  range->parts = 2;
  range->lo[1] = first >> finer;
  range->hi[1] = range->hi[0];
  range->hi[0] = last >> finer;
}

void packing_i_grid_around_image(const packing_i_grid_axis *axis, uint64_t cell,
                                 int octave, int finer, double reach, int periods,
                                 packing_i_grid_range *range)
{
  const int64_t n = (int64_t)cells_within(axis, octave + finer, reach);
  const int64_t around = (int64_t)(axis->cells << (octave + finer));
  const int64_t at = (int64_t)cell - periods * around;
  const int64_t lo = at > n ? at - n : 0, hi = at + n < around ? at + n : around - 1;
  range->parts = lo <= hi;
  if (range->parts == 0)
    return;
  range->lo[0] = (uint64_t)lo >> finer;
  range->hi[0] = (uint64_t)hi >> finer;
}

static int is_before(const packing_i_grid_row *row, uint64_t b, uint64_t c)
{
  return row->c < c || (row->c == c && row->b < b);
}

/* The first row of [row, end) not before (b, c): steps that double, then halves. */
static size_t seek(const packing_grid *grid, size_t row, size_t end, uint64_t b,
                   uint64_t c)
{
  const packing_i_grid_row *rows = grid->rows;
  size_t step = 1;
  while (row < end && is_before(&rows[row], b, c)) {
    const size_t left = end - row;
    if (step < left && is_before(&rows[row + step], b, c)) {
      row += step;
      step *= 2;
      continue;
    }
    size_t high = step < left ? row + step : end;
    row++;
    while (row < high) {
      const size_t middle = row + (high - row) / 2;
      if (is_before(&rows[middle], b, c))
        row = middle + 1;
      else
        high = middle;
    }
    return row;
  }
  return row;
}

size_t packing_i_grid_next_row(const packing_grid *grid, size_t row, size_t end,
                               uint64_t b_lo, uint64_t b_hi, uint64_t c_lo, uint64_t c_hi)
{
  while (row < end) {
    const packing_i_grid_row at = grid->rows[row];
    if (at.c > c_hi)
      return end;
    if (at.c < c_lo)
      row = seek(grid, row, end, b_lo, c_lo);
    else if (at.b < b_lo)
      row = seek(grid, row, end, b_lo, at.c);
    else if (at.b > b_hi)
      row = seek(grid, row, end, b_lo, at.c + 1);
    else
      return row;
  }
  return end;
}

static double wrap(const packing_i_grid_axis *axis, double v)
{
  if (axis->cells == 0 || (v >= axis->lo && v < axis->hi))
    return v;
  const double w = v - axis->period * floor((v - axis->lo) / axis->period);
  return w >= axis->lo && w < axis->hi ? w : axis->lo; /* rounded onto a border */
}

packing_vec3 packing_i_grid_wrap(const packing_grid *grid, packing_vec3 p)
{
  const packing_vec3 wrapped = {wrap(&grid->axis[0], p.x), wrap(&grid->axis[1], p.y),
                                grid->flat ? 0.0 : wrap(&grid->axis[2], p.z)};
  return wrapped;
}

void packing_i_grid_sweep_init(const packing_grid *grid, double reach,
                               packing_i_grid_sweep *sweep)
{
  const packing_i_grid_axis *axis = &grid->axis[grid->order[0]];
  sweep->reach = reach;
  sweep->shift[0] = 0.0;
  sweep->shift[1] = -axis->period;
  sweep->shift[2] = axis->period;
  sweep->passes = axis->cells > 0 ? 3 : 1;
  /* With less than a period between the ends of a pass no particle is met twice. */
  if (packing_i_grid_is_narrow(axis, reach)) {
    sweep->passes = 1;
    sweep->reach = (double)INFINITY;
  }
}
