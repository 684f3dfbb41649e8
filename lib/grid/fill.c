/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Filling a grid: particles sorted into levels, rows, and along the rows. */
#include "grid/grid_internal.h"
#include "vec.h"
#include "view.h"
#include <math.h>

enum { PARALLEL_ROWS = 16, AHEAD = 16 };

static int octave_of(const packing_grid *g, const packing_i_grid_source *s, double r)
{
  const int octave = ilogb(s->r_max / r);
  return octave < g->deepest ? octave : g->deepest;
}

/* Lists the particles by octave, coarse first; start[o] .. start[o + 1] are those of o. */
static void sort_octaves(const packing_grid *g, const packing_i_grid_source *s,
                         packing_i_grid_record *records, size_t *start)
{
  size_t next[PACKING_I_GRID_LEVELS] = {0};
  for (size_t k = 0; k < s->count; k++)
    next[octave_of(g, s, packing_i_view_r(s->view, packing_i_grid_pick(s, k)))]++;
  start[0] = 0;
  for (int o = 0; o < PACKING_I_GRID_LEVELS; o++) {
    start[o + 1] = start[o] + next[o];
    next[o] = start[o];
  }
  for (size_t k = 0; k < s->count; k++) {
    const size_t i = packing_i_grid_pick(s, k);
    const int o = octave_of(g, s, packing_i_view_r(s->view, i));
    const packing_vec3 p = packing_i_grid_wrap(g, packing_i_view_centre(s->view, i));
    packing_i_grid_record *record = &records[next[o]++];
    record->index = i;
    record->key.b = packing_i_grid_cell(g, &g->axis[g->order[1]],
                                        packing_i_component(p, g->order[1]), o);
    record->c = packing_i_grid_cell(g, &g->axis[g->order[2]],
                                    packing_i_component(p, g->order[2]), o);
  }
}

static int begins_row(const packing_i_grid_record *records, size_t i)
{
  return i == 0 || records[i].key.b != records[i - 1].key.b ||
         records[i].c != records[i - 1].c;
}

static size_t count_rows(const packing_i_grid_record *records, const size_t *start)
{
  size_t rows = 0;
  for (int o = 0; o < PACKING_I_GRID_LEVELS; o++)
    for (size_t i = start[o]; i < start[o + 1]; i++)
      rows += (size_t)(i == start[o] || begins_row(records, i));
  return rows;
}

static void note_rows(packing_grid *g, const packing_i_grid_record *records,
                      const size_t *start)
{
  size_t row = 0;
  for (int o = 0; o < PACKING_I_GRID_LEVELS; o++) {
    if (start[o] == start[o + 1])
      continue;
    packing_i_grid_level *level = &g->level[g->levels++];
    level->octave = o;
    level->first_row = row;
    for (size_t i = start[o]; i < start[o + 1]; i++)
      if (i == start[o] || begins_row(records, i)) {
        g->rows[row].b = records[i].key.b;
        g->rows[row].c = records[i].c;
        g->rows[row++].start = i;
      }
    level->end_row = row;
  }
  g->rows[row].start = g->count;
}

/* Sorts rows along the swept axis and takes the particles over. */
typedef struct takeover {
  packing_grid *grid;
  const packing_i_grid_source *source;
  packing_i_grid_record *records;
  packing_i_grid_record *spare;
  size_t rows;
} takeover;

/* Asks for a particle that is read some turns later: its place in memory is random. */
static void call_up(const packing_view *v, size_t i)
{
#if defined(__GNUC__)
  __builtin_prefetch((const char *)v->x.data + i * v->x.stride);
  __builtin_prefetch((const char *)v->y.data + i * v->y.stride);
  __builtin_prefetch((const char *)v->r.data + i * v->r.stride);
  if (v->z.data != NULL)
    __builtin_prefetch((const char *)v->z.data + i * v->z.stride);
#else
  (void)v;
  (void)i;
#endif
}

static void take_rows(void *arg, size_t block)
{
  const takeover *t = arg;
  packing_grid *g = t->grid;
  const packing_view *view = t->source->view;
  const size_t first = block * PARALLEL_ROWS;
  const size_t end = t->rows - first < PARALLEL_ROWS ? t->rows : first + PARALLEL_ROWS;
  const size_t from = g->rows[first].start, to = g->rows[end].start;
  for (size_t i = from; i < to; i++) {
    if (i + AHEAD < to)
      call_up(view, t->records[i + AHEAD].index);
    const packing_vec3 p =
        packing_i_grid_wrap(g, packing_i_view_centre(view, t->records[i].index));
    t->records[i].key.s = packing_i_component(p, g->order[0]);
  }
  for (size_t row = first; row < end; row++) {
    const size_t start = g->rows[row].start;
    packing_i_grid_sort_row(t->records + start, t->spare + start,
                            g->rows[row + 1].start - start);
  }
  for (size_t i = from; i < to; i++) {
    const size_t index = t->records[i].index;
    const packing_vec3 p = packing_i_grid_wrap(g, packing_i_view_centre(view, index));
    g->x[i] = p.x;
    g->y[i] = p.y;
    g->z[i] = p.z;
    g->r[i] = packing_i_view_r(view, index);
    g->index[i] = index;
  }
}

static void note_largest(packing_grid *g)
{
  for (int l = 0; l < g->levels; l++) {
    packing_i_grid_level *level = &g->level[l];
    const size_t end = g->rows[level->end_row].start;
    for (size_t i = g->rows[level->first_row].start; i < end; i++)
      level->r_max = g->r[i] > level->r_max ? g->r[i] : level->r_max;
  }
}

packing_status packing_i_grid_fill(packing_grid *g, const packing_i_grid_source *s)
{
  packing_status status = PACKING_OK;
  size_t start[PACKING_I_GRID_LEVELS + 1];
  const size_t count = s->count;
  takeover t = {g, s, NULL, NULL, 0};
  t.records = packing_i_alloc(g->allocator, count, sizeof *t.records);
  t.spare = packing_i_alloc(g->allocator, count, sizeof *t.spare);
  if (t.records == NULL || t.spare == NULL) {
    status = packing_i_nomem(g->context);
    goto out;
  }
  sort_octaves(g, s, t.records, start);
  for (int o = 0; o < PACKING_I_GRID_LEVELS; o++)
    packing_i_grid_sort_cells(t.records + start[o], t.spare + start[o],
                              start[o + 1] - start[o]);
  t.rows = count_rows(t.records, start);
  g->rows = packing_i_alloc(g->allocator, t.rows + 1, sizeof *g->rows);
  g->x = packing_i_alloc(g->allocator, count, sizeof *g->x);
  g->y = packing_i_alloc(g->allocator, count, sizeof *g->y);
  g->z = packing_i_alloc(g->allocator, count, sizeof *g->z);
  g->r = packing_i_alloc(g->allocator, count, sizeof *g->r);
  g->index = packing_i_alloc(g->allocator, count, sizeof *g->index);
  if (g->rows == NULL || g->x == NULL || g->y == NULL || g->z == NULL || g->r == NULL ||
      g->index == NULL) {
    status = packing_i_nomem(g->context);
    goto out;
  }
  g->count = count;
  note_rows(g, t.records, start);
  packing_i_parallel(g->context, (t.rows + PARALLEL_ROWS - 1) / PARALLEL_ROWS, take_rows,
                     &t);
  note_largest(g);
out:
  packing_i_free(g->allocator, t.records);
  packing_i_free(g->allocator, t.spare);
  return status;
}
