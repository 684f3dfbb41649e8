/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rsa_cells.h"

/* The region of centres along one axis: the bounds of the domain, less a radius at walls. */
static void region(const packing_domain *domain, double r, packing_vec3 *lo,
                   packing_vec3 *width, packing_vec3 *period)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const unsigned periodic = packing_domain_periodic(domain);
  const int dim = packing_domain_dim(domain);
  double from[3], wide[3], again[3];
  for (int axis = 0; axis < 3; axis++) {
    const double low = packing_i_component(b.lo, axis);
    const double length = packing_i_component(b.hi, axis) - low;
    const int wrapped = (int)(periodic >> axis & 1U);
    const int flat = axis == 2 && dim == 2;
    from[axis] = wrapped || flat ? low : low + r;
    wide[axis] = flat ? 0 : wrapped ? length : length - 2 * r;
    again[axis] = wrapped ? length : 0;
    if (wide[axis] < 0) { /* in the middle, so that both walls are as near */
      from[axis] = low + 0.5 * length;
      wide[axis] = 0;
    }
  }
  *lo = packing_i_vec(from[0], from[1], from[2]);
  *width = packing_i_vec(wide[0], wide[1], wide[2]);
  *period = packing_i_vec(again[0], again[1], again[2]);
}

/* The most cells of edge at least `edge` along `width`; 1 where it is shorter. No more than there
 * can be indices for: beyond 2^53 one less would be no other number. */
static double cells_along(double width, double edge)
{
  double n = fmin(floor(width / edge), 4294967296.0);
  while (n > 1 && width / n < edge)
    n -= 1;
  return n < 1 ? 1 : n;
}

/* Cells no smaller than a diameter, and no more than some for each particle expected. */
static packing_status choose_cells(packing_i_rsa_cells *cells, packing_context *context,
                                   size_t expected)
{
  const double w[3] = {cells->width.x, cells->width.y, cells->width.z};
  const double most = expected == 0 ? 4294967295.0 : 8.0 * (double)expected + 64.0;
  double edge = cells->diameter, n[3], total;
  for (;; edge *= 1.25) {
    for (int axis = 0; axis < 3; axis++)
      n[axis] = cells_along(w[axis], edge);
    total = n[0] * n[1] * n[2];
    if (expected == 0 || total <= most)
      break;
  }
  if (total > 4294967294.0)
    return packing_i_nomem(context);
  double e[3], per[3];
  for (int axis = 0; axis < 3; axis++) {
    cells->n[axis] = (uint32_t)n[axis];
    e[axis] = w[axis] / n[axis];
    per[axis] = w[axis] > 0 ? n[axis] / w[axis] : 0;
  }
  cells->per_layer = 1 / n[1];
  cells->edge = packing_i_vec(e[0], e[1], e[2]);
  cells->per_edge = packing_i_vec(per[0], per[1], per[2]);
  cells->head =
      packing_i_calloc(packing_i_allocator(context), (size_t)total, sizeof *cells->head);
  return cells->head == NULL ? packing_i_nomem(context) : PACKING_OK;
}

packing_status packing_i_rsa_cells_init(packing_i_rsa_cells *cells,
                                        packing_context *context,
                                        const packing_domain *domain, double r,
                                        size_t expected)
{
  region(domain, r, &cells->lo, &cells->width, &cells->period);
  cells->diameter = 2 * r;
  cells->diameter2 = cells->diameter * cells->diameter;
  return choose_cells(cells, context, expected);
}

void packing_i_rsa_cells_release(packing_i_rsa_cells *cells, packing_context *context)
{
  packing_i_free(packing_i_allocator(context), cells->head);
  packing_i_free(packing_i_allocator(context), cells->record);
}

packing_status packing_i_rsa_cells_reserve(packing_i_rsa_cells *cells,
                                           packing_context *context, size_t capacity)
{
  if (capacity <= cells->capacity)
    return PACKING_OK;
  if (capacity > UINT32_MAX - 1)
    return packing_i_nomem(context);
  size_t grown = cells->capacity + cells->capacity / 2 + 256;
  if (grown < capacity)
    grown = capacity;
  packing_i_rsa_record *record = packing_i_regrow(
      packing_i_allocator(context), cells->record, cells->count, grown, sizeof *record);
  if (record == NULL)
    return packing_i_nomem(context);
  cells->record = record;
  cells->capacity = grown;
  return PACKING_OK;
}

void packing_i_rsa_cells_insert(packing_i_rsa_cells *cells, packing_vec3 p)
{
  const uint32_t cell = packing_i_rsa_cell_of(cells, p);
  packing_i_rsa_record *record = &cells->record[cells->count];
  record->x = p.x;
  record->y = p.y;
  record->z = p.z;
  record->next = cells->head[cell];
  record->cell = cell;
  cells->head[cell] = (uint32_t)++cells->count;
}

static int chain_free(const packing_i_rsa_cells *c, uint32_t head, packing_vec3 p)
{
  for (uint32_t at = head; at != 0; at = c->record[at - 1].next) {
    const packing_i_rsa_record *q = &c->record[at - 1];
    const double dx = q->x - p.x, dy = q->y - p.y, dz = q->z - p.z;
    if (dx * dx + dy * dy + dz * dz < c->diameter2)
      return 0;
  }
  return 1;
}

/* The indices i - 1, i, i + 1 along an axis, wrapped, with their shifts; `i` first. */
static size_t along(uint32_t i, uint32_t n, double period, uint32_t at[3],
                    double shift[3])
{
  size_t count = 1;
  at[0] = i;
  shift[0] = 0;
  if (i > 0 || period > 0) {
    at[count] = i > 0 ? i - 1 : n - 1;
    shift[count++] = i > 0 ? 0 : -period;
  }
  if (i + 1 < n || period > 0) {
    at[count] = i + 1 < n ? i + 1 : 0;
    shift[count++] = i + 1 < n ? 0 : period;
  }
  return count;
}

size_t packing_i_rsa_cells_around(const packing_i_rsa_cells *cells, uint32_t cell,
                                  packing_i_rsa_near around[27])
{
  const uint32_t nx = cells->n[0], ny = cells->n[1];
  uint32_t at[3][3];
  double shift[3][3];
  const size_t cx = along(cell % nx, nx, cells->period.x, at[0], shift[0]);
  const size_t cy = along(cell / nx % ny, ny, cells->period.y, at[1], shift[1]);
  const size_t cz = along(cell / nx / ny, cells->n[2], cells->period.z, at[2], shift[2]);
  size_t count = 0;
  for (size_t k = 0; k < cz; k++)
    for (size_t j = 0; j < cy; j++)
      for (size_t i = 0; i < cx; i++) {
        around[count].cell = (at[2][k] * ny + at[1][j]) * nx + at[0][i];
        around[count++].shift = packing_i_vec(shift[0][i], shift[1][j], shift[2][k]);
      }
  return count;
}

int packing_i_rsa_cells_free(const packing_i_rsa_cells *c, packing_vec3 p)
{
  uint32_t at[3];
  packing_i_rsa_cells_locate(c, p, at);
  const uint32_t cell = packing_i_rsa_cell_at(c, at);
  if (packing_i_rsa_cells_is_inner(c, at)) {
    uint32_t list[28];
    if (!chain_free(c, c->head[cell], p))
      return 0; /* the likeliest place by far */
    const size_t count = packing_i_rsa_cells_heads(c, cell, 0, list);
    for (size_t i = 0; i < count; i++)
      if (!chain_free(c, list[i], p))
        return 0;
    return 1;
  }
  packing_i_rsa_near around[27];
  const size_t count = packing_i_rsa_cells_around(c, cell, around);
  for (size_t i = 0; i < count; i++)
    if (!chain_free(c, c->head[around[i].cell], packing_i_sub(p, around[i].shift)))
      return 0;
  return 1;
}
