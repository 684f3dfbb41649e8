/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Local porosity: the exact solid in each cell of a grid.
 *
 * Cells are boxes, so a ball that no wall cuts is shared out in closed form (caps, wedges and
 * corners: domain/cut_planes.c); where a round wall passes through it quadrature does the rest
 * (domain/cut_cell.c). Particles, with their periodic images, are listed by the layer of cells
 * that they touch; each layer sums its own cells in the order of the particles, so that threads
 * change nothing. Linear in the cells and in the particles times the cells that each touches;
 * 16 bytes for each particle and layer, 32 for each cell. */
#include "measure/porosity_internal.h"

/* An image of a particle in a layer. */
typedef struct entry {
  size_t i;
  size_t copy;
} entry;

typedef struct map {
  const packing_domain *domain;
  const packing_view *view;
  packing_bounds bounds;
  double tolerance;
  size_t n[3];   /* cells along each axis */
  int across;    /* the axis of the layers: the last */
  size_t *start; /* of each layer in the list, and the end */
  entry *list;
  packing_i_sum *solid; /* of each cell */
  double *volume;       /* of each cell */
  packing_i_sum *error; /* of each layer */
  int *broken;          /* of each layer */
} map;

void packing_porosity_map_def_fill(packing_porosity_map_def *def, size_t size)
{
  packing_porosity_map_def defaults = {0};
  defaults.nx = defaults.ny = defaults.nz = 10;
  defaults.tolerance = 1e-12;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static double border(const map *m, int axis, size_t k)
{
  const double lo = packing_i_component(m->bounds.lo, axis);
  const double hi = packing_i_component(m->bounds.hi, axis);
  return k == m->n[axis] ? hi : lo + (hi - lo) * ((double)k / (double)m->n[axis]);
}

/* The cells along an axis that [lo, hi] reaches: from *first to before *end. */
static void reach(const map *m, int axis, double lo, double hi, size_t *first,
                  size_t *end)
{
  const double from = packing_i_component(m->bounds.lo, axis);
  const double to = packing_i_component(m->bounds.hi, axis);
  const double n = (double)m->n[axis];
  const double low = floor((lo - from) / (to - from) * n);
  const double high = floor((hi - from) / (to - from) * n);
  *first = *end = 0;
  if (!(hi > from && lo < to))
    return;
  *first = low > 0 ? (low < n ? (size_t)low : m->n[axis] - 1) : 0;
  *end = high >= 0 ? (high < n ? (size_t)high + 1 : m->n[axis]) : 1;
}

static packing_i_copies copies_of(const map *m, size_t i)
{
  const packing_vec3 at = packing_i_measure_centre(m->domain, m->view, i);
  return packing_i_copies_of(m->domain, 7, &m->bounds, at, packing_i_view_r(m->view, i));
}

static void layers_of(const map *m, packing_vec3 at, double r, size_t *first, size_t *end)
{
  const double x = packing_i_component(at, m->across);
  reach(m, m->across, x - r, x + r, first, end);
}

/* Counts the images in each layer, or lists them; start[] moves on to the next free place. */
static void go_through(map *m, int listing)
{
  for (size_t i = 0; i < m->view->count; i++) {
    const packing_i_copies copies = copies_of(m, i);
    for (size_t n = 0; n < packing_i_copies_count(&copies); n++) {
      size_t first, end;
      layers_of(m, packing_i_copy(&copies, n), packing_i_view_r(m->view, i), &first,
                &end);
      for (size_t layer = first; layer < end; layer++) {
        const size_t place = m->start[layer]++;
        if (listing)
          m->list[place] = (entry){i, n};
      }
    }
  }
}

/* Turns counts into starts; returns the sum. */
static size_t accumulate(map *m)
{
  size_t sum = 0;
  for (size_t layer = 0; layer < m->n[m->across]; layer++) {
    const size_t count = m->start[layer];
    m->start[layer] = sum;
    sum += count;
  }
  return sum;
}

static packing_status list_particles(packing_context *context, map *m)
{
  go_through(m, 0);
  const size_t count = accumulate(m);
  m->list = packing_i_alloc(packing_i_allocator(context), count, sizeof *m->list);
  if (m->list == NULL)
    return packing_i_nomem(context);
  go_through(m, 1); /* start[layer] is now the start of the next layer */
  for (size_t layer = m->n[m->across]; layer > 0; layer--)
    m->start[layer] = m->start[layer - 1];
  m->start[0] = 0;
  return PACKING_OK;
}

static packing_i_cell cell_at(const map *m, size_t ix, size_t iy, size_t iz)
{
  packing_i_cell cell = packing_i_porosity_cell();
  cell.box.lo = packing_i_vec(border(m, 0, ix), border(m, 1, iy), cell.box.lo.z);
  cell.box.hi = packing_i_vec(border(m, 0, ix + 1), border(m, 1, iy + 1), cell.box.hi.z);
  if (m->domain->body.dim == 3) {
    cell.box.lo.z = border(m, 2, iz);
    cell.box.hi.z = border(m, 2, iz + 1);
  }
  return cell;
}

static size_t number_of(const map *m, size_t ix, size_t iy, size_t iz)
{
  return ix + m->n[0] * (iy + m->n[1] * iz);
}

/* The range of cells of a layer, or of what of it a ball can touch. */
typedef struct range {
  size_t first[3], end[3];
} range;

static range range_of(const map *m, size_t layer, packing_vec3 at, double r)
{
  range g = {{0, 0, 0}, {1, 1, 1}};
  for (int k = 0; k < m->across; k++) {
    const double x = packing_i_component(at, k);
    reach(m, k, x - r, x + r, &g.first[k], &g.end[k]);
  }
  g.first[m->across] = layer;
  g.end[m->across] = layer + 1;
  return g;
}

static void add_ball(const map *m, size_t layer, packing_vec3 at, double r)
{
  const range g = range_of(m, layer, at, r);
  double volume, error, largest = 0;
  for (size_t z = g.first[2]; z < g.end[2]; z++)
    for (size_t y = g.first[1]; y < g.end[1]; y++)
      for (size_t x = g.first[0]; x < g.end[0]; x++) {
        const packing_i_cell cell = cell_at(m, x, y, z);
        if (packing_i_domain_cell_volume(m->domain, &cell, &at, r, m->tolerance, &volume,
                                         &error))
          m->broken[layer] = 1;
        else
          packing_i_sum_add(&m->solid[number_of(m, x, y, z)], volume);
        largest += error;
      }
  packing_i_sum_add(&m->error[layer], largest);
}

static void measure_cells(const map *m, size_t layer)
{
  const packing_vec3 middle = packing_i_scale(packing_i_add(m->bounds.lo, m->bounds.hi),
                                              0.5); /* with all cells in reach */
  const range g = range_of(m, layer, middle, HUGE_VAL);
  double error;
  for (size_t z = g.first[2]; z < g.end[2]; z++)
    for (size_t y = g.first[1]; y < g.end[1]; y++)
      for (size_t x = g.first[0]; x < g.end[0]; x++) {
        const packing_i_cell cell = cell_at(m, x, y, z);
        if (packing_i_domain_cell_volume(m->domain, &cell, &cell.centre, 0, m->tolerance,
                                         &m->volume[number_of(m, x, y, z)], &error))
          m->broken[layer] = 1;
      }
}

static void measure_layer(void *arg, size_t layer)
{
  const map *m = arg;
  measure_cells(m, layer);
  for (size_t k = m->start[layer]; k < m->start[layer + 1]; k++) {
    const packing_i_copies copies = copies_of(m, m->list[k].i);
    add_ball(m, layer, packing_i_copy(&copies, m->list[k].copy),
             packing_i_view_r(m->view, m->list[k].i));
  }
}

static double porosity_of(double solid, double volume)
{
  return volume > 0 ? 1 - solid / volume : (double)NAN;
}

/* Mean and deviation of the cells' porosities, weighed by volume; mean = 1 - solid / volume. */
static void write(const map *m, packing_porosity_cell *cells, size_t capacity,
                  packing_porosity_map_report *report)
{
  const size_t count = m->n[0] * m->n[1] * m->n[2];
  packing_i_sum solid = {0, 0}, volume = {0, 0}, error = {0, 0}, squares = {0, 0};
  for (size_t c = 0; c < count; c++) {
    const double s = packing_i_sum_value(&m->solid[c]);
    packing_i_sum_add(&solid, s);
    packing_i_sum_add(&volume, m->volume[c]);
    if (c < capacity)
      cells[c] = (packing_porosity_cell){m->volume[c], s, porosity_of(s, m->volume[c])};
  }
  for (size_t layer = 0; layer < m->n[m->across]; layer++)
    packing_i_sum_add(&error, packing_i_sum_value(&m->error[layer]));
  report->volume = packing_i_sum_value(&volume);
  report->solid = packing_i_sum_value(&solid);
  report->mean = porosity_of(report->solid, report->volume);
  report->error = packing_i_sum_value(&error) / report->volume;
  for (size_t c = 0; c < count; c++)
    if (m->volume[c] > 0) {
      const double d =
          1 - packing_i_sum_value(&m->solid[c]) / m->volume[c] - report->mean;
      packing_i_sum_add(&squares, m->volume[c] * d * d);
    }
  report->sd = sqrt(packing_i_sum_value(&squares) / report->volume);
}

static packing_status run(packing_context *context, map *m)
{
  const size_t layers = m->n[m->across];
  PACKING_I_TRY(list_particles(context, m));
  packing_i_parallel(context, layers, measure_layer, m);
  for (size_t layer = 0; layer < layers; layer++)
    if (m->broken[layer])
      return packing_i_porosity_misbehaves(context);
  return PACKING_OK;
}

static packing_status measure(packing_context *context, map *m,
                              packing_porosity_cell *cells, size_t capacity,
                              packing_porosity_map_report *report)
{
  const packing_allocator *a = packing_i_allocator(context);
  const size_t layers = m->n[m->across], count = m->n[0] * m->n[1] * m->n[2];
  packing_status status = PACKING_ERR_NOMEM;
  m->start = packing_i_calloc(a, layers + 1, sizeof *m->start);
  m->solid = packing_i_calloc(a, count, sizeof *m->solid);
  m->volume = packing_i_calloc(a, count, sizeof *m->volume);
  m->error = packing_i_calloc(a, layers, sizeof *m->error);
  m->broken = packing_i_calloc(a, layers, sizeof *m->broken);
  if (m->start == NULL || m->solid == NULL || m->volume == NULL || m->error == NULL ||
      m->broken == NULL)
    status = packing_i_nomem(context);
  else
    status = run(context, m);
  if (status == PACKING_OK)
    write(m, cells, capacity, report);
  packing_i_free(a, m->start);
  packing_i_free(a, m->solid);
  packing_i_free(a, m->volume);
  packing_i_free(a, m->error);
  packing_i_free(a, m->broken);
  packing_i_free(a, m->list);
  return status;
}

static packing_status check_bounds(packing_context *context, const packing_bounds *b,
                                   int dim)
{
  static const char *const lo[] = {"bounds.lo.x", "bounds.lo.y", "bounds.lo.z"};
  static const char *const hi[] = {"bounds.hi.x", "bounds.hi.y", "bounds.hi.z"};
  PACKING_I_TRY(packing_i_check_point(context, lo, &b->lo));
  PACKING_I_TRY(packing_i_check_point(context, hi, &b->hi));
  for (int k = 0; k < dim; k++) {
    const double low = packing_i_component(b->lo, k),
                 high = packing_i_component(b->hi, k);
    if (!(low < high) || !isfinite(high - low))
      return packing_i_fail(context, PACKING_ERR_RANGE, hi[k], PACKING_NO_INDEX,
                            "%g must be above %s, %g", high, lo[k], low);
  }
  return PACKING_OK;
}

static packing_status check_counts(packing_context *context, const size_t n[3])
{
  static const char *const field[] = {"nx", "ny", "nz"};
  size_t most = SIZE_MAX / sizeof(packing_i_sum);
  for (int k = 0; k < 3; k++) {
    if (n[k] == 0)
      return packing_i_fail(context, PACKING_ERR_RANGE, field[k], PACKING_NO_INDEX,
                            "0, at least 1 is needed");
    if (n[k] > most)
      return packing_i_fail(context, PACKING_ERR_RANGE, field[k], PACKING_NO_INDEX,
                            "%zu makes more cells than can be counted", n[k]);
    most /= n[k];
  }
  return PACKING_OK;
}

static int is_left_out(const packing_bounds *b)
{
  return b->lo.x == 0 && b->lo.y == 0 && b->lo.z == 0 && b->hi.x == 0 && b->hi.y == 0 &&
         b->hi.z == 0;
}

packing_status packing_measure_porosity_map(
    packing_context *context, const packing_porosity_map_def *def, packing_domain *domain,
    const packing_view *view, packing_porosity_cell *cells, size_t capacity,
    size_t *count, packing_porosity_map_report *report)
{
  packing_porosity_map_def d;
  packing_view v;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_porosity_map, tolerance, def, &d));
  PACKING_I_TRY(packing_i_porosity_begin(context, d.tolerance, domain, view, &v));
  PACKING_I_TRY(
      packing_i_porosity_list(context, "cells", cells, capacity, count, report));
  const int dim = packing_domain_dim(domain);
  map m = {.domain = domain, .view = &v, .tolerance = d.tolerance, .across = dim - 1};
  m.bounds = is_left_out(&d.bounds) ? domain->body.bounds : d.bounds;
  m.n[0] = d.nx;
  m.n[1] = d.ny;
  m.n[2] = dim == 2 ? 1 : d.nz;
  PACKING_I_TRY(check_bounds(context, &m.bounds, dim));
  PACKING_I_TRY(check_counts(context, m.n));
  PACKING_I_TRY(packing_i_porosity_images(context, "bounds", domain, 7, &m.bounds));
  packing_porosity_map_report found;
  packing_porosity_map_report_init(&found);
  found.bounds = m.bounds;
  found.nx = m.n[0];
  found.ny = m.n[1];
  found.nz = m.n[2];
  PACKING_I_TRY(measure(context, &m, cells, capacity, &found));
  *count = m.n[0] * m.n[1] * m.n[2];
  return packing_i_report_write(context, report, &found, sizeof found);
}
