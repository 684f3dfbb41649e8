/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Neighbour grid: a hierarchy of uniform grids, one level for each octave of radii.
 *
 * D. Krijgsman, V. Ogarko, S. Luding, "Optimal parameters for a hierarchical grid data structure
 * for contact detection in arbitrarily polydisperse particle systems", Comput. Part. Mech. 1
 * (2014) 357-372; here cell sizes halve from level to level.
 * Departure: cells are cut along two axes only; along the third, rows of sorted particles are
 * swept. That needs memory for the rows there are, whatever the extent of the pack, and finds
 * 4 r of a row instead of three cells' 6 r. Cost: N log(row length) to build, N for all pairs. */
#include "grid/grid_internal.h"
#include "domain/domain_internal.h"
#include "vec.h"
#include "view.h"
#include <math.h>

/* Cells are this much wider than the largest diameter, so that pairs up to that much farther
 * apart than touching still lie in adjacent cells. */
#define CELL_SLACK (33.0 / 32.0)

#define CELLS_OF_REACH 8.0

/* Numbers beyond have squares that leave the range of doubles. */
#define LARGEST 1e150
#define SMALLEST 1e-150

void packing_grid_def_fill(packing_grid_def *def, size_t size)
{
  packing_grid_def defaults = {0};
  defaults.levels = PACKING_I_GRID_LEVELS;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_coordinate(packing_context *context, const char *field,
                                       size_t i, double v)
{
  if (!isfinite(v))
    return packing_i_fail(context, PACKING_ERR_INVALID, field, i,
                          "%g of particle %zu is not a finite number", v, i);
  if (fabs(v) > LARGEST)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, i,
                          "%g of particle %zu is beyond %g", v, i, LARGEST);
  return PACKING_OK;
}

static packing_status check_radius(packing_context *context, size_t i, double r)
{
  PACKING_I_TRY(check_coordinate(context, "r", i, r));
  if (!(r >= SMALLEST))
    return packing_i_fail(context, PACKING_ERR_RANGE, "r", i,
                          "%g of particle %zu must be above 0 and not below %g", r, i,
                          SMALLEST);
  return PACKING_OK;
}

static double lesser(double a, double b)
{
  return b < a ? b : a;
}

static double greater(double a, double b)
{
  return b > a ? b : a;
}

/* Checks the particles and finds their extent. */
static packing_status survey(const packing_grid *g, packing_i_grid_source *s)
{
  s->r_min = s->lo.x = s->lo.y = s->lo.z = (double)INFINITY;
  s->r_max = 0;
  s->hi.x = s->hi.y = s->hi.z = -(double)INFINITY;
  for (size_t k = 0; k < s->count; k++) {
    const size_t i = packing_i_grid_pick(s, k);
    const packing_vec3 raw = packing_i_view_centre(s->view, i);
    const double r = packing_i_view_r(s->view, i);
    if (!(fabs(raw.x) <= LARGEST && fabs(raw.y) <= LARGEST &&
          (g->flat || fabs(raw.z) <= LARGEST) && r >= SMALLEST && r <= LARGEST)) {
      PACKING_I_TRY(check_coordinate(g->context, "x", i, raw.x));
      PACKING_I_TRY(check_coordinate(g->context, "y", i, raw.y));
      if (!g->flat)
        PACKING_I_TRY(check_coordinate(g->context, "z", i, raw.z));
      PACKING_I_TRY(check_radius(g->context, i, r));
    }
    const packing_vec3 p = packing_i_grid_wrap(g, raw);
    s->r_min = lesser(s->r_min, r);
    s->r_max = greater(s->r_max, r);
    s->lo =
        packing_i_vec(lesser(s->lo.x, p.x), lesser(s->lo.y, p.y), lesser(s->lo.z, p.z));
    s->hi = packing_i_vec(greater(s->hi.x, p.x), greater(s->hi.y, p.y),
                          greater(s->hi.z, p.z));
  }
  return PACKING_OK;
}

static void open_axes(packing_grid *g, const packing_domain *domain)
{
  packing_bounds bounds = {{0, 0, 0}, {0, 0, 0}};
  unsigned periodic = 0;
  if (domain != NULL) {
    packing_domain_bounds(domain, &bounds);
    periodic = packing_domain_periodic(domain);
    g->flat = packing_domain_dim(domain) == 2;
  }
  for (int k = 0; k < 3; k++) {
    packing_i_grid_axis *axis = &g->axis[k];
    axis->half = (double)INFINITY;
    if ((periodic & 1u << k) == 0)
      continue;
    axis->lo = packing_i_component(bounds.lo, k);
    axis->hi = packing_i_component(bounds.hi, k);
    axis->period = packing_i_component(domain->body.period, k);
    axis->half = 0.5 * axis->period;
    axis->cells = 1;
  }
}

/* The swept axis is the longest: long rows, few of them. */
static void choose_axes(packing_grid *g, const packing_i_grid_source *s)
{
  const packing_vec3 e = packing_i_sub(s->hi, s->lo);
  int sweep = 0;
  for (int k = 1; k < 3; k++)
    if (packing_i_component(e, k) > packing_i_component(e, sweep))
      sweep = k;
  g->order[0] = sweep;
  g->order[1] = sweep == 0 ? 1 : 0;
  g->order[2] = sweep == 2 ? 1 : 2;
}

/* As wide as a diameter, or, where pairs are met farther apart, so that the reach is a whole
 * number of cells: a little more than that would take another row on each side. More than a few
 * cells offer hardly less, in more rows. The slack holds a 64th of a diameter. */
static double cell_width(const packing_i_grid_source *s,
                         const packing_i_grid_reach *reach)
{
  const double diameter = 2.0 * s->r_max;
  const double far = reach == NULL ? 0 : diameter * reach->factor + reach->gap;
  if (!(far > diameter * (1 + 1.0 / 64)))
    return diameter * CELL_SLACK;
  return far / fmin(floor(far / diameter), CELLS_OF_REACH) * CELL_SLACK;
}

/* The finest octave: that of the smallest particles, but no cells narrower than the gap, which
 * is part of every reach. */
static int finest_octave(const packing_i_grid_source *s,
                         const packing_i_grid_reach *reach, double width)
{
  const int octave = ilogb(s->r_max / s->r_min);
  if (reach == NULL || !(reach->gap > 0))
    return octave;
  const int of_gap = ilogb(fmax(width / reach->gap, 1.0));
  return of_gap < octave ? of_gap : octave;
}

static void cut_cells(packing_grid *g, double width)
{
  const double most = ldexp(1.0, PACKING_I_GRID_REACH - g->deepest);
  for (int k = 0; k < 3; k++) {
    packing_i_grid_axis *axis = &g->axis[k];
    axis->width = width;
    if (axis->cells == 0)
      continue;
    const double fit = floor(axis->period / width);
    axis->cells = fit < 1 ? 1 : fit > most ? (uint64_t)most : (uint64_t)fit;
    axis->width = axis->period / (double)axis->cells;
  }
}

packing_status packing_i_grid_build(packing_context *context, int levels,
                                    const packing_domain *domain,
                                    const packing_view *view, const size_t *selection,
                                    size_t count, const packing_i_grid_reach *reach,
                                    packing_grid **grid)
{
  packing_i_grid_source s = {0};
  packing_status status = PACKING_OK;
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_grid *g = packing_i_calloc(allocator, 1, sizeof *g);
  if (g == NULL)
    return packing_i_nomem(context);
  g->context = packing_i_context_hold(context);
  g->allocator = allocator;
  open_axes(g, domain);
  s.view = view;
  s.selection = selection;
  s.count = count;
  status = survey(g, &s);
  if (status == PACKING_OK && count > 0) {
    const double width = cell_width(&s, reach);
    const int deepest = finest_octave(&s, reach, width);
    g->deepest = deepest < levels - 1 ? deepest : levels - 1;
    choose_axes(g, &s);
    cut_cells(g, width);
    status = packing_i_grid_fill(g, &s);
  }
  if (status == PACKING_OK)
    *grid = g;
  else
    packing_grid_destroy(g);
  return status;
}

packing_status packing_grid_create(packing_context *context, const packing_grid_def *def,
                                   packing_domain *domain, const packing_view *view,
                                   packing_grid **grid)
{
  packing_grid_def d;
  packing_view v;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_grid, levels, def, &d));
  if (d.levels < 1 || d.levels > PACKING_I_GRID_LEVELS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "levels", PACKING_NO_INDEX,
                          "%d, must be 1 to %d", d.levels, PACKING_I_GRID_LEVELS);
  if (!packing_i_view_read(view, &v))
    return packing_i_fail(context, PACKING_ERR_INVALID, "view", PACKING_NO_INDEX,
                          "NULL, not initialised, or x, y or r is missing");
  if (grid == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "grid", PACKING_NO_INDEX, "NULL");
  return packing_i_grid_build(context, d.levels, domain, &v, NULL, v.count, NULL, grid);
}

void packing_grid_destroy(packing_grid *grid)
{
  if (grid == NULL)
    return;
  packing_context *context = grid->context;
  const packing_allocator *allocator = grid->allocator;
  packing_i_free(allocator, grid->x);
  packing_i_free(allocator, grid->y);
  packing_i_free(allocator, grid->z);
  packing_i_free(allocator, grid->r);
  packing_i_free(allocator, grid->index);
  packing_i_free(allocator, grid->rows);
  packing_i_free(allocator, grid);
  packing_context_destroy(context);
}
