/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The particles around a point. */
#include "grid/grid_internal.h"
#include "vec.h"

/* A point is a cell this many octaves below those of a level: fine enough to leave out rows that
 * its own whole cell would ask for. */
enum { POINT_OCTAVES = 2 };

typedef struct query {
  const packing_grid *grid;
  const double *swept;
  packing_vec3 point;
  double at; /* the point along the swept axis */
  double reach;
  packing_i_near_function fn;
  void *arg;
} query;

/* The lowest indices found. */
typedef struct harvest {
  size_t *indices;
  size_t capacity;
  size_t held;
  size_t count;
} harvest;

static void try_particle(query *q, size_t j)
{
  const packing_grid *g = q->grid;
  const packing_vec3 d = {packing_i_grid_nearest(&g->axis[0], g->x[j] - q->point.x),
                          packing_i_grid_nearest(&g->axis[1], g->y[j] - q->point.y),
                          packing_i_grid_nearest(&g->axis[2], g->z[j] - q->point.z)};
  const double distance = packing_i_norm(d);
  if (distance <= g->r[j] + q->reach)
    q->fn(q->arg, g->index[j], d, distance);
}

/* Particles of one row within a pass's reach of the point. */
static void try_row(query *q, size_t row, const packing_i_grid_sweep *s, int pass)
{
  size_t low = q->grid->rows[row].start, high = q->grid->rows[row + 1].start;
  const size_t end = high;
  while (low < high) {
    const size_t middle = low + (high - low) / 2;
    if (q->swept[middle] - q->at + s->shift[pass] < -s->reach)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < end && q->swept[low] - q->at + s->shift[pass] <= s->reach; low++)
    try_particle(q, low);
}

static uint64_t point_cell(const query *q, int axis, int octave)
{
  return packing_i_grid_cell(q->grid, &q->grid->axis[axis],
                             packing_i_component(q->point, axis), octave);
}

static void try_level(query *q, const packing_i_grid_level *level)
{
  const packing_grid *g = q->grid;
  const double reach = level->r_max + q->reach;
  const int octave = level->octave + POINT_OCTAVES;
  packing_i_grid_range b, c;
  packing_i_grid_sweep s;
  packing_i_grid_around(&g->axis[g->order[1]], point_cell(q, g->order[1], octave),
                        level->octave, POINT_OCTAVES, reach, &b);
  packing_i_grid_around(&g->axis[g->order[2]], point_cell(q, g->order[2], octave),
                        level->octave, POINT_OCTAVES, reach, &c);
  packing_i_grid_sweep_init(g, reach, &s);
  for (int p = 0; p < b.parts * c.parts; p++) {
    const int pb = p % b.parts, pc = p / b.parts;
    size_t row = level->first_row;
    while ((row = packing_i_grid_next_row(g, row, level->end_row, b.lo[pb], b.hi[pb],
                                          c.lo[pc], c.hi[pc])) < level->end_row) {
      for (int pass = 0; pass < s.passes; pass++)
        try_row(q, row, &s, pass);
      row++;
    }
  }
}

static packing_status check_query(const packing_grid *grid, const packing_vec3 *point,
                                  double reach, const size_t *indices, size_t capacity,
                                  const size_t *count)
{
  if (grid == NULL)
    return PACKING_ERR_INVALID;
  const char *null = point == NULL                     ? "point"
                     : count == NULL                   ? "count"
                     : indices == NULL && capacity > 0 ? "indices"
                                                       : NULL;
  if (null != NULL)
    return packing_i_fail(grid->context, PACKING_ERR_INVALID, null, PACKING_NO_INDEX,
                          "NULL");
  if (!packing_i_vec_finite(*point))
    return packing_i_fail(grid->context, PACKING_ERR_INVALID, "point", PACKING_NO_INDEX,
                          "(%g, %g, %g) is not finite", point->x, point->y, point->z);
  if (!isfinite(reach) || reach < 0)
    return packing_i_fail(grid->context, PACKING_ERR_INVALID, "reach", PACKING_NO_INDEX,
                          "%g must be finite and not negative", reach);
  return PACKING_OK;
}

void packing_i_grid_near_visit(const packing_grid *grid, const packing_vec3 *point,
                               double reach, packing_i_near_function fn, void *arg)
{
  query q = {0};
  q.grid = grid;
  q.swept = packing_i_grid_swept(grid);
  q.point = packing_i_grid_wrap(grid, *point);
  q.at = packing_i_component(q.point, grid->order[0]);
  q.reach = reach;
  q.fn = fn;
  q.arg = arg;
  for (int l = 0; l < grid->levels; l++)
    try_level(&q, &grid->level[l]);
}

static void keep_index(void *arg, size_t index, packing_vec3 d, double distance)
{
  harvest *c = arg;
  (void)d;
  (void)distance;
  c->count++;
  packing_i_heap_offer(c->indices, c->capacity, &c->held, index);
}

packing_status packing_grid_near(const packing_grid *grid, const packing_vec3 *point,
                                 double reach, size_t *indices, size_t capacity,
                                 size_t *count)
{
  PACKING_I_TRY(check_query(grid, point, reach, indices, capacity, count));
  harvest c = {indices, capacity, 0, 0};
  packing_i_grid_near_visit(grid, point, reach, keep_index, &c);
  packing_i_heap_sort(indices, c.held);
  *count = c.count;
  return PACKING_OK;
}
