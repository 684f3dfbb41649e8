/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slabs and cells. Particles are sorted by slab, size class (an octave of radii each), plane, row
 * and column by counting, so that neighbours in space are neighbours in memory and a row of cells
 * is one run of particles. Linear time; memory by particles, never by volume: cells widen where
 * space is sparse. */
#include "stepper_internal.h"
#include <string.h>

/* Fewer particles than this do not make a slab of their own. */
enum { SLAB_PARTICLES = 48 };

/* Particles of a block of parallel work. */
enum { BLOCK = 4096 };

/* No axis needs more cells; the product of three is finite, however far a particle has flown. */
#define MOST_WANTED 0x1p300

static double coordinate(const packing_dem *dem, size_t p, int axis)
{
  return dem->position[PACKING_I_POSITION * p + (size_t)axis];
}

/* The extent of the centres, or the cell along periodic directions. */
static void measure(const packing_dem *dem, double lo[3], double extent[3])
{
  packing_bounds b;
  packing_domain_bounds(dem->domain, &b);
  for (int k = 0; k < 3; k++) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t p = 0; p < dem->count; p++) {
      const double x = coordinate(dem, p, k);
      least = x < least ? x : least;
      most = x > most ? x : most;
    }
    const int periodic = isfinite(dem->images.period[k]);
    lo[k] = periodic ? packing_i_component(b.lo, k) : least;
    extent[k] = periodic ? dem->images.period[k] : most - least;
  }
}

/* Axes by extent, the longest first; ties by their number. */
static void order_axes(const double extent[3], int axis[3])
{
  for (int k = 0; k < 3; k++) {
    int before = 0;
    for (int l = 0; l < 3; l++)
      before += extent[l] > extent[k] || (!(extent[l] < extent[k]) && l < k);
    axis[before] = k;
  }
}

static int whole(double share, int most)
{
  return share < 1 ? 1 : share < most ? (int)share : most;
}

/* As many slabs as are thick enough. A ring takes an even number, four at least: then no two of
 * one colour are neighbours and no pair meets across two borders. */
static void cut_slabs(const packing_dem *dem, packing_i_cut *cut)
{
  const double range = packing_i_dem_range(dem, dem->r_max, dem->r_max);
  int most = (int)(dem->count / SLAB_PARTICLES) + 1;
  if (most > PACKING_I_SLABS || dem->count / SLAB_PARTICLES > PACKING_I_SLABS)
    most = PACKING_I_SLABS;
  cut->slabs = whole(cut->extent[0] / range, most);
  cut->ring = isfinite(dem->images.period[cut->axis[0]]) && cut->slabs >= 4;
  if (cut->ring)
    cut->slabs &= ~1;
  else if (isfinite(dem->images.period[cut->axis[0]]))
    cut->slabs = 1;
  cut->thickness = cut->extent[0] / cut->slabs;
  cut->inverse_thickness = cut->thickness > 0 ? 1 / cut->thickness : 0;
}

static int class_of(const packing_dem *dem, double r)
{
  if (dem->reach > 0)
    return 0;
  int c = 0;
  double least = 0.5 * dem->r_max;
  while (r <= least && c < PACKING_I_CLASSES - 1) {
    least *= 0.5;
    c++;
  }
  return c;
}

/* Cells of a class: as wide as its particles interact, but not many more than particles. */
static void cut_cells(const packing_dem *dem, packing_i_cut *cut, packing_i_class *class,
                      size_t particles)
{
  const double edge = packing_i_dem_range(dem, class->r_max, class->r_max);
  const double extent[3] = {cut->thickness, cut->extent[1], cut->extent[2]};
  const size_t most = (2 * particles + 64) / (size_t)cut->slabs + 8;
  double want[3], product = 1;
  for (int k = 0; k < 3; k++) {
    want[k] = fmin(fmax(1, extent[k] / edge), MOST_WANTED);
    product *= want[k];
  }
  while (product > (double)most) {
    int widest = 0;
    for (int k = 1; k < 3; k++)
      widest = want[k] > want[widest] ? k : widest;
    want[widest] *= 0.5;
    product *= 0.5;
  }
  for (int k = 0; k < 3; k++) {
    class->cells[k] = whole(want[k], (int)most);
    class->inverse[k] = extent[k] > 0 ? class->cells[k] / extent[k] : 0;
  }
  class->cells_of_slab =
      (size_t) class->cells[0] * (size_t) class->cells[1] * (size_t) class->cells[2];
  class->offset = cut->cells_of_slab;
  cut->cells_of_slab += class->cells_of_slab;
}

/* The classes that have particles; number[c] tells where class c went. */
static void cut_classes(const packing_dem *dem, packing_i_cut *cut,
                        int number[PACKING_I_CLASSES])
{
  size_t particles[PACKING_I_CLASSES] = {0};
  double r_max[PACKING_I_CLASSES] = {0};
  for (size_t p = 0; p < dem->count; p++) {
    const double r = coordinate(dem, p, 3);
    const int c = class_of(dem, r);
    particles[c]++;
    r_max[c] = r > r_max[c] ? r : r_max[c];
  }
  cut->classes = 0;
  cut->cells_of_slab = 0;
  for (int c = 0; c < PACKING_I_CLASSES; c++) {
    number[c] = cut->classes;
    if (particles[c] == 0)
      continue;
    cut->of[cut->classes].r_max = r_max[c];
    cut_cells(dem, cut, &cut->of[cut->classes], particles[c]);
    cut->classes++;
  }
}

static packing_status make_room(packing_dem *dem, size_t cells)
{
  if (cells <= dem->cell_capacity)
    return PACKING_OK;
  const size_t capacity = cells + cells / 4;
  dem->cell_capacity = 0; /* should it be refused */
  PACKING_I_TRY(
      packing_i_dem_renew(dem, &dem->cell_start, capacity, sizeof *dem->cell_start));
  dem->cell_capacity = capacity;
  return PACKING_OK;
}

/* What blocks of particles share while they are sorted. */
typedef struct sorting {
  packing_dem *dem;
  const int *number; /* where each class went */
} sorting;

static size_t block_end(const packing_dem *dem, size_t block)
{
  const size_t end = (block + 1) * BLOCK;
  return end < dem->count ? end : dem->count;
}

/* Work on particles one by one, whose order does not matter. */
static void run_blocks(packing_dem *dem, const int *number, packing_block_function fn)
{
  sorting s = {dem, number};
  packing_i_dem_run(dem, (dem->count + BLOCK - 1) / BLOCK, fn, &s);
}

static size_t cell_of(const packing_dem *dem, const int *number, size_t p)
{
  const packing_i_cut *cut = &dem->cut;
  const packing_i_class *class = &cut->of[number[class_of(dem, coordinate(dem, p, 3))]];
  const double along = coordinate(dem, p, cut->axis[0]) - cut->lo[0];
  const int slab = packing_i_dem_cell(along, cut->inverse_thickness, cut->slabs);
  const int plane = packing_i_dem_cell(along - slab * cut->thickness, class->inverse[0],
                                       class->cells[0]);
  const int row = packing_i_dem_cell(coordinate(dem, p, cut->axis[1]) - cut->lo[1],
                                     class->inverse[1], class->cells[1]);
  const int column = packing_i_dem_cell(coordinate(dem, p, cut->axis[2]) - cut->lo[2],
                                        class->inverse[2], class->cells[2]);
  return (size_t)slab * cut->cells_of_slab + class->offset +
         ((size_t)plane * (size_t) class->cells[1] + (size_t)row) *
             (size_t) class->cells[2] +
         (size_t)column;
}

/* Which cell of which slab each particle stands in. */
static void assign_block(void *arg, size_t block)
{
  const sorting *s = arg;
  for (size_t p = block * BLOCK; p < block_end(s->dem, block); p++)
    s->dem->cell[p] = (uint32_t)cell_of(s->dem, s->number, p);
}

/* Starts of the cells, and where each particle goes (into dem->cell). */
static void count_cells(packing_dem *dem, size_t cells)
{
  uint32_t *start = dem->cell_start;
  memset(start, 0, (cells + 1) * sizeof *start);
  for (size_t p = 0; p < dem->count; p++)
    start[dem->cell[p] + 1]++;
  for (size_t c = 0; c < cells; c++)
    start[c + 1] += start[c];
  for (size_t p = 0; p < dem->count; p++)
    dem->cell[p] = start[dem->cell[p]]++;
  memmove(start + 1, start, cells * sizeof *start); /* each had moved to its end */
  start[0] = 0;
}

/* Every record to its place; its old place is read by nobody else. */
static void move_block(void *arg, size_t block)
{
  packing_dem *dem = ((const sorting *)arg)->dem;
  for (size_t p = block * BLOCK; p < block_end(dem, block); p++) {
    const size_t to = dem->cell[p];
    memcpy(dem->built + PACKING_I_POSITION * to, dem->position + PACKING_I_POSITION * p,
           PACKING_I_POSITION * sizeof(double));
    memcpy(dem->spare + PACKING_I_MOTION * to, dem->motion + PACKING_I_MOTION * p,
           PACKING_I_MOTION * sizeof(double));
  }
}

static void move_indices(packing_dem *dem, uint32_t **column)
{
  uint32_t *to = dem->spare_index;
  for (size_t p = 0; p < dem->count; p++)
    to[dem->cell[p]] = (*column)[p];
  dem->spare_index = *column;
  *column = to;
}

static void move_particles(packing_dem *dem)
{
  run_blocks(dem, NULL, move_block);
  double *swap = dem->position;
  dem->position = dem->built;
  dem->built = swap;
  swap = dem->motion;
  dem->motion = dem->spare;
  dem->spare = swap;
  move_indices(dem, &dem->id);
  move_indices(dem, &dem->material);
}

/* Where the list was made; and, since forces are zero whenever particles are sorted, the inverse
 * masses anew: only they would travel. */
static void settle_block(void *arg, size_t block)
{
  packing_dem *dem = ((const sorting *)arg)->dem;
  const double j = packing_i_dem_inertia(dem);
  for (size_t p = block * BLOCK; p < block_end(dem, block); p++) {
    const double m = dem->motion[PACKING_I_MOTION * p + 3], r = coordinate(dem, p, 3);
    double *force = dem->force + PACKING_I_FORCE * p;
    memcpy(dem->built + PACKING_I_POSITION * p, dem->position + PACKING_I_POSITION * p,
           PACKING_I_POSITION * sizeof(double));
    memset(force, 0, PACKING_I_FORCE * sizeof *force);
    force[3] = 1 / m;
    force[7] = 1 / (j * m * r * r);
  }
}

packing_status packing_i_dem_sort(packing_dem *dem)
{
  packing_i_cut *cut = &dem->cut;
  double lo[3], extent[3];
  int number[PACKING_I_CLASSES];
  measure(dem, lo, extent);
  order_axes(extent, cut->axis);
  for (int k = 0; k < 3; k++) {
    cut->lo[k] = lo[cut->axis[k]];
    cut->extent[k] = extent[cut->axis[k]];
  }
  cut_slabs(dem, cut);
  cut_classes(dem, cut, number);
  const size_t cells = (size_t)cut->slabs * cut->cells_of_slab;
  PACKING_I_TRY(make_room(dem, cells + 1));
  run_blocks(dem, number, assign_block);
  count_cells(dem, cells);
  move_particles(dem);
  run_blocks(dem, NULL, settle_block);
  for (int s = 0; s < cut->slabs; s++) {
    packing_i_slab *slab = &dem->slab[s];
    slab->first = dem->cell_start[(size_t)s * cut->cells_of_slab];
    slab->count = dem->cell_start[(size_t)(s + 1) * cut->cells_of_slab] - slab->first;
  }
  return PACKING_OK;
}
