/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_GRID_INTERNAL_H
#define PACKING_GRID_INTERNAL_H

/* The neighbour grid: levels of rows. doc/methods/grid.md tells the method.
 *
 * One axis is swept (the longest extent of the pack), the two others, b and c, are cut into
 * cells; a row is what stands over one cell (b, c), sorted along the swept axis. Levels halve:
 * a cell of level l holds exactly four of level l + 1, so a row finds its neighbours on a
 * coarser level by shifting its cell's indices. */

#include "base_internal.h"
#include <packing/grid.h>

enum {
  PACKING_I_GRID_LEVELS = 32,
  PACKING_I_GRID_BLOCK = 4096 /* particles of a parallel block */
};

/* Cells are numbered below 2^42 along an axis: then rounding moves a particle by less than
 * 1/1024 cell (1/256 of a quarter cell), and particles beyond, which no container holds, share
 * the outermost cells. */
#define PACKING_I_GRID_REACH 41

/* One row; that of the last ends where the sentinel starts. 24 bytes. */
typedef struct packing_i_grid_row {
  uint64_t b;   /* cell along the second axis */
  uint64_t c;   /* cell along the third axis */
  size_t start; /* its first particle */
} packing_i_grid_row;

typedef struct packing_i_grid_level {
  int octave;       /* cells are width * 2^-octave */
  double r_max;     /* largest radius of the level */
  size_t first_row; /* rows [first_row, end_row), sorted by (c, b) */
  size_t end_row;
} packing_i_grid_level;

/* Per coordinate. An open axis has period 0 and half infinite. */
typedef struct packing_i_grid_axis {
  double lo;      /* of the periodic cell; 0 */
  double hi;      /* of the periodic cell */
  double period;  /* its length */
  double half;    /* half of it */
  double width;   /* of a cell of octave 0 */
  uint64_t cells; /* of octave 0 around a period; 0 where open */
} packing_i_grid_axis;

/* 40 bytes a particle, 24 a row. */
struct packing_grid {
  packing_context *context;
  const packing_allocator *allocator;
  size_t count;
  double *x; /* particles sorted by (level, c, b, swept coordinate, index) */
  double *y;
  double *z;
  double *r;
  size_t *index; /* of each in the view */
  packing_i_grid_row *rows;
  packing_i_grid_level level[PACKING_I_GRID_LEVELS]; /* coarse to fine */
  int levels;
  int flat;     /* z is ignored */
  int deepest;  /* largest octave that may occur */
  int order[3]; /* coordinate that is swept, b, c */
  packing_i_grid_axis axis[3];
};

/* Rows [lo, hi] along an axis; a periodic range may fall into two. */
typedef struct packing_i_grid_range {
  uint64_t lo[2];
  uint64_t hi[2];
  int parts;
} packing_i_grid_range;

/* A pair within reach; `own` and `other` are places in the grid's arrays. */
typedef struct packing_i_grid_pair {
  size_t own; /* in the block that is visited */
  size_t other;
  packing_vec3 d; /* from own to this image of other */
  double distance;
  int image[3]; /* periods that other is moved by, both centres wrapped into the cell */
} packing_i_grid_pair;

typedef void (*packing_i_pair_function)(void *arg, const packing_i_grid_pair *pair);

/* Pairs with d <= (r_i + r_j) * factor + gap, where factor >= 0. */
typedef struct packing_i_grid_reach {
  double factor;
  double gap;
  int all_images; /* 1: every image within reach, also of the particle itself (then the first
       of image[] that is not 0 is above 0); 0: the nearest image, no particle with itself */
} packing_i_grid_reach;

/* As packing_grid_create(), of the `count` particles view[selection[k]]; selection NULL: all of the
 * view. Its cells suit visits of that reach; NULL: of touching particles. */
packing_status packing_i_grid_build(packing_context *context, int levels,
                                    const packing_domain *domain,
                                    const packing_view *view, const size_t *selection,
                                    size_t count, const packing_i_grid_reach *reach,
                                    packing_grid **grid);

/* Every pair is met in exactly one block, whose borders depend on the particles only. */
size_t packing_i_grid_blocks(const packing_grid *grid);

/* Calls fn for every pair of a block within reach, in an order that depends on the particles
 * only, and now and then for one that misses it by a few units in the last place: fn decides.
 * Allocates nothing; blocks may run on any threads. */
void packing_i_grid_visit(const packing_grid *grid, const packing_i_grid_reach *reach,
                          size_t block, packing_i_pair_function fn, void *arg);

/* A particle near a point: its index in the view, the vector from the point to (the nearest image
 * of) its centre, and the length of that. */
typedef void (*packing_i_near_function)(void *arg, size_t index, packing_vec3 d,
                                        double distance);

/* Calls fn for every particle with distance <= r + reach, in an order that depends on particles
 * and point only. Thread-safe, allocates nothing. */
void packing_i_grid_near_visit(const packing_grid *grid, const packing_vec3 *point,
                               double reach, packing_i_near_function fn, void *arg);

/* Cell of a coordinate (inside the periodic cell) at an octave. */
uint64_t packing_i_grid_cell(const packing_grid *grid, const packing_i_grid_axis *axis,
                             double v, int octave);

/* Cells of `octave` that hold whatever is within `reach` of a cell of the same octave or, when
 * `finer` octaves are given, of the cell `cell` of octave + finer. */
void packing_i_grid_around(const packing_i_grid_axis *axis, uint64_t cell, int octave,
                           int finer, double reach, packing_i_grid_range *range);

/* The same for the image of the axis that is moved by `periods`. `parts` may be 0. */
void packing_i_grid_around_image(const packing_i_grid_axis *axis, uint64_t cell,
                                 int octave, int finer, double reach, int periods,
                                 packing_i_grid_range *range);

/* The first row from `row` on, and before `end`, inside the rectangle; `end` when there is
 * none. */
size_t packing_i_grid_next_row(const packing_grid *grid, size_t row, size_t end,
                               uint64_t b_lo, uint64_t b_hi, uint64_t c_lo,
                               uint64_t c_hi);

/* A cell of octave l measures width * 2^-l. */
double packing_i_grid_width(const packing_i_grid_axis *axis, int octave);

/* A point into the periodic cell; onto the plane where the grid is flat. */
packing_vec3 packing_i_grid_wrap(const packing_grid *grid, packing_vec3 p);

/* The swept coordinate of all particles. */
static inline const double *packing_i_grid_swept(const packing_grid *grid)
{
  return grid->order[0] == 0 ? grid->x : grid->order[0] == 1 ? grid->y : grid->z;
}

/* The particles of a pair as indices in the view. */
static inline packing_pair packing_i_grid_ends(const packing_grid *grid,
                                               const packing_i_grid_pair *pair)
{
  const size_t a = grid->index[pair->own], b = grid->index[pair->other];
  const packing_pair ends = {a < b ? a : b, a < b ? b : a};
  return ends;
}

/* The difference of two coordinates inside the cell, to the nearest image. */
static inline double packing_i_grid_nearest(const packing_i_grid_axis *axis, double d)
{
  return d > axis->half ? d - axis->period : d < -axis->half ? d + axis->period : d;
}

/* How far apart along the swept axis things may be when `reach` matters, and by which shifts
 * images are met: one pass over everything when the period is too short to tell them apart. */
typedef struct packing_i_grid_sweep {
  double reach;    /* of a pass */
  double shift[3]; /* of each pass */
  int passes;
} packing_i_grid_sweep;

/* Whether more than one image of a particle may be within reach along an axis; true a little
 * early. */
static inline int packing_i_grid_is_narrow(const packing_i_grid_axis *axis, double reach)
{
  return axis->cells > 0 && reach > 0.49 * axis->period;
}

void packing_i_grid_sweep_init(const packing_grid *grid, double reach,
                               packing_i_grid_sweep *sweep);

/* Keeps the `capacity` smallest of the values offered, as a heap; *held tells how many. */
void packing_i_heap_offer(size_t *heap, size_t capacity, size_t *held, size_t value);

/* Turns the heap into a rising list. */
void packing_i_heap_sort(size_t *heap, size_t held);

/* What a grid is built from. */
typedef struct packing_i_grid_source {
  const packing_view *view;
  const size_t *selection; /* NULL: all of the view */
  size_t count;
  double r_min;
  double r_max;
  packing_vec3 lo; /* extent of the centres, wrapped */
  packing_vec3 hi;
} packing_i_grid_source;

static inline size_t packing_i_grid_pick(const packing_i_grid_source *source, size_t k)
{
  return source->selection == NULL ? k : source->selection[k];
}

/* Allocates the arrays of a grid whose axes are set, and sorts the particles into them. What is
 * allocated on failure goes with the grid. */
packing_status packing_i_grid_fill(packing_grid *grid,
                                   const packing_i_grid_source *source);

/* Records for sorting particles into rows. 24 bytes. */
typedef struct packing_i_grid_record {
  union {
    uint64_t b; /* at first */
    double s;   /* swept coordinate, once rows are known */
  } key;
  uint64_t c;
  size_t index; /* in the view */
} packing_i_grid_record;

/* Sorts records by (c, b), stably; `spare` has room for as many. */
void packing_i_grid_sort_cells(packing_i_grid_record *records,
                               packing_i_grid_record *spare, size_t count);

/* Sorts records by s, stably; `spare` has room for as many. */
void packing_i_grid_sort_row(packing_i_grid_record *records, packing_i_grid_record *spare,
                             size_t count);

#endif
