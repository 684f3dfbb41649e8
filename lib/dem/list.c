/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of pairs that may touch before it is made again (Verlet): centres nearer than an
 * interaction distance and a skin. The list of a slab holds its pairs with itself and with the
 * next slab, sorted by i. Each pair is found once: among one class by the lower index, between
 * classes of a slab by the finer one, between slabs by the one in the lower slab. */
#include "stepper_internal.h"

/* Cells [lo, lo + count) of n around an axis. */
typedef struct span {
  int lo, count;
} span;

/* A search around particle i. */
typedef struct search {
  const packing_dem *dem;
  size_t i;
  const double *at; /* its record */
  double center[3]; /* along the cut's axes, from the cut's lo */
  packing_i_slab *slab;
  uint32_t *list_i, *list_j;
} search;

static span open_span(double x, double range, double inverse, int n)
{
  const int lo = packing_i_dem_cell(x - range, inverse, n);
  return (span){lo, packing_i_dem_cell(x + range, inverse, n) - lo + 1};
}

static span ring_span(double x, double range, double inverse, int n)
{
  const double lo = floor((x - range) * inverse), hi = floor((x + range) * inverse);
  if (hi - lo + 1 >= n)
    return (span){0, n};
  const int first = (int)lo;
  return (span){first < 0    ? first + n
                : first >= n ? first - n
                             : first,
                (int)(hi - lo) + 1};
}

/* The span along axis k of the cut, k >= 1. */
static span across(const search *f, const packing_i_class *class, int k, double range)
{
  const packing_i_cut *cut = &f->dem->cut;
  const int ring = isfinite(f->dem->images.period[cut->axis[k]]);
  return (ring ? ring_span : open_span)(f->center[k], range, class->inverse[k],
                                        class->cells[k]);
}

/* Planes of a slab. */
static span planes(const search *f, const packing_i_class *class, double x, double range)
{
  const packing_i_cut *cut = &f->dem->cut;
  const int alone = cut->slabs == 1 && isfinite(f->dem->images.period[cut->axis[0]]);
  return (alone ? ring_span : open_span)(x, range, class->inverse[0], class->cells[0]);
}

static void add_pair(search *f, size_t j)
{
  packing_i_slab *slab = f->slab;
  if (slab->list_count < slab->list_room) {
    f->list_i[slab->list_count] = (uint32_t)f->i;
    f->list_j[slab->list_count] = (uint32_t)j;
  }
  slab->list_count++;
}

/* Particles [first, end). */
static void visit_run(search *f, size_t first, size_t end)
{
  const packing_dem *dem = f->dem;
  const packing_i_images *images = &dem->images;
  const double *a = f->at;
  for (size_t j = first; j < end; j++) {
    const double *b = dem->position + PACKING_I_POSITION * j;
    double d2 = 0;
    for (int k = 0; k < 3; k++) {
      double d = b[k] - a[k];
      if (images->any)
        d = packing_i_dem_image(d, images->period[k], images->half[k]);
      d2 += d * d;
    }
    const double range = packing_i_dem_range(dem, a[3], b[3]);
    if (d2 < range * range)
      add_pair(f, j);
  }
}

/* Columns of one row of cells. */
static void visit_row(search *f, const uint32_t *start, span columns, int n, size_t least)
{
  const int end = columns.lo + columns.count, split = end < n ? end : n;
  const size_t first = start[columns.lo];
  visit_run(f, first > least ? first : least, start[split]);
  if (end > n)
    visit_run(f, start[0] > least ? start[0] : least, start[end - n]);
}

/* Particles of class m in slab t, from index `least` on, around x along axis 0 of slab t. */
static void visit_slab(search *f, int t, int m, double x, size_t least)
{
  const packing_dem *dem = f->dem;
  const packing_i_cut *cut = &dem->cut;
  const packing_i_class *class = &cut->of[m];
  const double range = packing_i_dem_range(dem, f->at[3], class->r_max);
  if (x + range < 0)
    return;
  const span plane = planes(f, class, x, range);
  const span row = across(f, class, 1, range), column = across(f, class, 2, range);
  const uint32_t *cells =
      dem->cell_start + (size_t)t * cut->cells_of_slab + class->offset;
  for (int p = 0; p < plane.count; p++)
    for (int q = 0; q < row.count; q++) {
      const size_t a = (size_t)((plane.lo + p) % class->cells[0]);
      const size_t b = (size_t)((row.lo + q) % class->cells[1]);
      const uint32_t *start =
          cells + (a * (size_t) class->cells[1] + b) * (size_t) class->cells[2];
      visit_row(f, start, column, class->cells[2], least);
    }
}

/* All pairs of particle i, of class c in slab s. */
static void visit(search *f, int s, int c)
{
  const packing_i_cut *cut = &f->dem->cut;
  const double x = f->center[0] - s * cut->thickness;
  for (int m = 0; m <= c; m++)
    visit_slab(f, s, m, x, m == c ? f->i + 1 : 0);
  const int last = s + 1 == cut->slabs;
  if (last && !cut->ring)
    return;
  for (int m = 0; m < cut->classes; m++)
    visit_slab(f, last ? 0 : s + 1, m, x - cut->thickness, 0);
}

static void list_slab(void *arg, size_t s)
{
  packing_dem *dem = arg;
  const packing_i_cut *cut = &dem->cut;
  packing_i_slab *slab = &dem->slab[s];
  slab->list_count = 0;
  search f = {.dem = dem,
              .slab = slab,
              .list_i = dem->list_i + slab->list_first,
              .list_j = dem->list_j + slab->list_first};
  for (int c = 0; c < cut->classes; c++) {
    const uint32_t *start = dem->cell_start + s * cut->cells_of_slab + cut->of[c].offset;
    for (f.i = start[0]; f.i < start[cut->of[c].cells_of_slab]; f.i++) {
      f.at = dem->position + PACKING_I_POSITION * f.i;
      for (int k = 0; k < 3; k++)
        f.center[k] = f.at[cut->axis[k]] - cut->lo[k];
      visit(&f, (int)s, c);
    }
  }
  /* Kernels load whole vectors of indices. */
  for (size_t k = slab->list_count;
       k < slab->list_count + PACKING_I_LIST_SLACK && slab->list_count <= slab->list_room;
       k++)
    f.list_i[k] = f.list_j[k] = 0;
}

/* Room for each slab's pairs, by its particles. */
static void set_rooms(packing_dem *dem)
{
  for (int s = 0; s < dem->cut.slabs; s++)
    dem->slab[s].list_room = dem->slab[s].count * dem->list_share;
}

/* Cuts the list into the slabs' parts. */
static packing_status share_list(packing_dem *dem)
{
  size_t total = 0;
  for (int s = 0; s < dem->cut.slabs; s++) {
    packing_i_slab *slab = &dem->slab[s];
    slab->list_first = total;
    total += slab->list_room + PACKING_I_LIST_SLACK;
  }
  return total <= dem->list_capacity ? PACKING_OK : packing_i_dem_grow_list(dem, total);
}

/* Whether all pairs found room; else more is set aside, from now on for every slab, unless that
 * would be far more than there are pairs: a large particle alone in its slab has many. */
static int list_fits(packing_dem *dem)
{
  size_t share = 0, pairs = 0;
  for (int s = 0; s < dem->cut.slabs; s++) {
    packing_i_slab *slab = &dem->slab[s];
    pairs += slab->list_count;
    if (slab->list_count <= slab->list_room)
      continue;
    slab->list_room = slab->list_count;
    if (slab->list_count / slab->count >= share)
      share = slab->list_count / slab->count + 1;
  }
  if (share == 0)
    return 1;
  const size_t most = 4 * (pairs / dem->count + 2);
  share += share / 4;
  share = share < most ? share : most;
  dem->list_share = share > dem->list_share ? share : dem->list_share;
  for (int s = 0; s < dem->cut.slabs; s++) {
    packing_i_slab *slab = &dem->slab[s];
    const size_t room = slab->count * dem->list_share;
    slab->list_room = slab->list_room > room ? slab->list_room : room;
  }
  return 0;
}

/* Particles that may come to a wall before the list is made again. */
static void list_walls(void *arg, size_t s)
{
  packing_dem *dem = arg;
  packing_i_slab *slab = &dem->slab[s];
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  slab->wall_count = 0;
  for (size_t p = slab->first; p < slab->first + slab->count; p++) {
    const double *at = dem->position + PACKING_I_POSITION * p;
    const packing_vec3 x = packing_i_vec(at[0], at[1], at[2]);
    if (packing_i_domain_near_walls(dem->domain, &x, at[3] + dem->skin, near) > 0)
      dem->near_wall[slab->first + slab->wall_count++] = (uint32_t)p;
  }
}

packing_status packing_i_dem_list(packing_dem *dem)
{
  set_rooms(dem);
  do {
    PACKING_I_TRY(share_list(dem));
    packing_i_dem_run(dem, (size_t)dem->cut.slabs, list_slab, dem);
  } while (!list_fits(dem));
  packing_i_dem_run(dem, (size_t)dem->cut.slabs, list_walls, dem);
  return PACKING_OK;
}
