/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A grid of bounds of the distance from the surface, so that questions about points deep inside or
 * far outside need no tree. A block of 8^3 cells is asked once in its middle; where the
 * surface is half as far again as the block's corners all its cells follow from that, since distances
 * change no faster than points move; else its eight parts are asked in turn. Bounds are single
 * precision, rounded apart by more than that costs. Memory 8 bytes a cell, at most 2^20 cells;
 * time: the cells near the surface. */
#include "mesh/surface_internal.h"

enum { BLOCK = 8, LEAST_CELLS = 1 << 12, MOST_CELLS = 1 << 20, CELLS_A_TRIANGLE = 32 };
static const double HALF_DIAGONAL =
    0.8660254037844387; /* of a cell of edge 1, rounded up */
static const double LESS = 1 - 1e-6;
static const double FAR = 1.5; /* times a block's reach: not asked further */

typedef struct job {
  const packing_i_surface *surface;
  packing_i_depth *depth;
  size_t blocks[3];
} job;

/* As many cells as are allowed, cubes; the edge is a whole part of the longest one. */
static void set_shape(const packing_i_surface *s, packing_i_depth *d)
{
  const packing_bounds *b = &s->mesh->bounds;
  const double size[3] = {b->hi.x - b->lo.x, b->hi.y - b->lo.y, b->hi.z - b->lo.z};
  const double longest = fmax(fmax(size[0], size[1]), size[2]);
  size_t most = LEAST_CELLS;
  if (s->mesh->triangles * CELLS_A_TRIANGLE > most)
    most = s->mesh->triangles * CELLS_A_TRIANGLE;
  if (most > MOST_CELLS)
    most = MOST_CELLS;
  for (size_t n = most; n >= 1; n -= n / 32 + 1) {
    size_t all = 1;
    for (int k = 0; k < 3; k++) {
      d->cells[k] = (size_t)(size[k] / longest * (double)n) + 1;
      all = all > most ? all : all * d->cells[k];
    }
    d->edge = longest / (double)n;
    if (all <= most || n == 1)
      break;
  }
  d->lo[0] = b->lo.x;
  d->lo[1] = b->lo.y;
  d->lo[2] = b->lo.z;
}

/* Cells [from, to) along each axis. */
typedef struct part {
  size_t from[3], to[3];
} part;

static packing_vec3 middle_of(const packing_i_depth *d, const size_t from[3],
                              const size_t to[3])
{
  double x[3];
  for (int k = 0; k < 3; k++)
    x[k] = d->lo[k] + 0.5 * (double)(from[k] + to[k]) * d->edge;
  return packing_i_mesh_vec(x);
}

static double reach_of(const packing_i_depth *d, const part *p)
{
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    const double half = 0.5 * (double)(p->to[k] - p->from[k]) * d->edge;
    sum += half * half;
  }
  return sqrt(sum);
}

static void set_cells(const job *j, const part *p, packing_vec3 middle, double distance)
{
  packing_i_depth *d = j->depth;
  size_t at[3];
  for (at[2] = p->from[2]; at[2] < p->to[2]; at[2]++)
    for (at[1] = p->from[1]; at[1] < p->to[1]; at[1]++)
      for (at[0] = p->from[0]; at[0] < p->to[0]; at[0]++) {
        const size_t next[3] = {at[0] + 1, at[1] + 1, at[2] + 1};
        const double off = packing_i_norm(packing_i_sub(middle_of(d, at, next), middle));
        const double bound = (fabs(distance) - off) / d->edge * LESS;
        const float least = bound > 0 ? (float)bound : 0;
        const size_t cell = (at[2] * d->cells[1] + at[1]) * d->cells[0] + at[0];
        d->value[cell].least = distance < 0 ? -least : least;
        d->value[cell].most = (float)((fabs(distance) + off) / d->edge / LESS);
      }
}

/* Signed distance in the middle; no farther than `most`. */
static double ask(const packing_i_surface *s, packing_vec3 middle, double most)
{
  const packing_i_nearest n =
      packing_i_surface_nearest(s, &middle, most * most * (1 + 1e-9), 0);
  const double distance = sqrt(n.square);
  return packing_i_surface_is_inside(s, &n) ? distance : -distance;
}

static int split(const part *p, int k, int high, part *half)
{
  const size_t middle = p->from[k] + (p->to[k] - p->from[k] + 1) / 2;
  half->from[k] = high ? middle : p->from[k];
  half->to[k] = high ? p->to[k] : middle;
  return half->from[k] < half->to[k];
}

/* Recursion goes no deeper than BLOCK has powers of two. */
static void visit(const job *j, const part *p, double most)
{
  const packing_vec3 middle = middle_of(j->depth, p->from, p->to);
  const double reach = reach_of(j->depth, p);
  const double distance = ask(j->surface, middle, most);
  const int single = p->to[0] - p->from[0] == 1 && p->to[1] - p->from[1] == 1 &&
                     p->to[2] - p->from[2] == 1;
  if (single || fabs(distance) >= FAR * reach) {
    set_cells(j, p, middle, distance);
    return;
  }
  for (int child = 0; child < 8; child++) {
    part q;
    if (split(p, 0, child & 1, &q) && split(p, 1, child >> 1 & 1, &q) &&
        split(p, 2, child >> 2 & 1, &q))
      visit(j, &q, fabs(distance) + 2 * reach);
  }
}

static void visit_block(void *user, size_t block)
{
  const job *j = user;
  const size_t at[3] = {block % j->blocks[0], block / j->blocks[0] % j->blocks[1],
                        block / j->blocks[0] / j->blocks[1]};
  part p;
  for (int k = 0; k < 3; k++) {
    p.from[k] = at[k] * BLOCK;
    p.to[k] = p.from[k] + BLOCK;
    if (p.to[k] > j->depth->cells[k])
      p.to[k] = j->depth->cells[k];
  }
  visit(j, &p, HUGE_VAL);
}

packing_status packing_i_depth_create(packing_context *context,
                                      packing_i_surface *surface)
{
  packing_i_depth *d = &surface->depth;
  job j = {.surface = surface, .depth = d};
  set_shape(surface, d);
  d->value = packing_i_alloc(&surface->allocator, d->cells[0] * d->cells[1] * d->cells[2],
                             sizeof *d->value);
  if (d->value == NULL)
    return packing_i_nomem(context);
  for (int k = 0; k < 3; k++)
    j.blocks[k] = (d->cells[k] + BLOCK - 1) / BLOCK;
  packing_i_parallel(context, j.blocks[0] * j.blocks[1] * j.blocks[2], visit_block, &j);
  return PACKING_OK;
}

/* The cell of a point; NULL: none. */
static const packing_i_depth_cell *cell_of(const packing_i_depth *d,
                                           const packing_vec3 *point)
{
  const double p[3] = {point->x, point->y, point->z};
  size_t at[3];
  for (int k = 0; k < 3; k++) {
    const double x = (p[k] - d->lo[k]) / d->edge;
    if (!(x >= 0 && x < (double)d->cells[k]))
      return NULL;
    at[k] = (size_t)x;
  }
  return &d->value[(at[2] * d->cells[1] + at[1]) * d->cells[0] + at[0]];
}

double packing_i_surface_depth(const packing_i_surface *surface,
                               const packing_vec3 *point)
{
  const packing_i_depth *d = &surface->depth;
  const packing_i_depth_cell *cell = cell_of(d, point);
  if (cell == NULL)
    return 0;
  const double value = (double)cell->least;
  const double left = fabs(value) - HALF_DIAGONAL * (1 + 1e-6);
  return left <= 0 ? 0 : (value < 0 ? -left : left) * d->edge;
}

double packing_i_surface_most_depth(const packing_i_surface *surface,
                                    const packing_vec3 *point)
{
  const packing_i_depth *d = &surface->depth;
  const packing_i_depth_cell *cell = cell_of(d, point);
  return cell == NULL ? HUGE_VAL
                      : ((double)cell->most + HALF_DIAGONAL * (1 + 1e-6)) * d->edge;
}
