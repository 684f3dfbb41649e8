/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiles and cells of the pocket front. See the header. A look around a sphere reads some fifty
 * cells of the 27 tiles around its own. */
#include "front_grid.h"

enum { FIRST_SLOTS = 64 };

/* Of a cell's entry: its bin has a next. So bins that have none are not read to learn that. */
#define MORE UINT32_C(0x80000000)

void packing_i_front_grid_init(packing_i_front_grid *grid,
                               const packing_allocator *allocator, packing_vec3 origin,
                               packing_vec3 edge, const int n[3])
{
  memset(grid, 0, sizeof *grid);
  grid->allocator = allocator;
  grid->origin = origin;
  grid->edge = edge;
  memcpy(grid->n, n, sizeof grid->n);
  grid->per_edge = packing_i_vec(n[0] / edge.x, n[1] / edge.y, n[2] / edge.z);
  grid->tiles = grid->lists = 1;
}

void packing_i_front_grid_release(packing_i_front_grid *grid)
{
  for (size_t t = 1; t < grid->tiles; t++)
    packing_i_free(grid->allocator, grid->tile[t].cell);
  packing_i_free(grid->allocator, grid->tile);
  packing_i_free(grid->allocator, grid->standing);
  packing_i_free(grid->allocator, grid->slot);
  for (size_t c = 0; c < grid->chunks; c++)
    packing_i_free(grid->allocator, grid->chunk[c]);
  packing_i_free(grid->allocator, grid->chunk);
  packing_i_free(grid->allocator, grid->list);
}

void packing_i_front_grid_at(const packing_i_front_grid *grid, const packing_vec3 *p,
                             int64_t at[3])
{
  at[0] = (int64_t)floor((p->x - grid->origin.x) / grid->edge.x);
  at[1] = (int64_t)floor((p->y - grid->origin.y) / grid->edge.y);
  at[2] = (int64_t)floor((p->z - grid->origin.z) / grid->edge.z);
}

/* ---- tiles ---- */

static size_t hash_of(const int64_t at[3])
{
  uint64_t h = 0;
  for (int k = 0; k < 3; k++) {
    h = (h ^ (uint64_t)at[k]) * UINT64_C(0x9E3779B97F4A7C15);
    h ^= h >> 29;
  }
  return (size_t)h;
}

static uint32_t *slot_of(const packing_i_front_grid *grid, const int64_t at[3])
{
  size_t s = hash_of(at) & (grid->slots - 1);
  while (grid->slot[s] != 0 &&
         memcmp(grid->tile[grid->slot[s]].at, at, sizeof grid->tile->at) != 0)
    s = (s + 1) & (grid->slots - 1);
  return grid->slot + s;
}

/* The table is at most half full. */
static int grow_table(packing_i_front_grid *grid)
{
  if (2 * (grid->tiles + 1) <= grid->slots)
    return 1;
  const size_t slots = grid->slots == 0 ? FIRST_SLOTS : 2 * grid->slots;
  uint32_t *table = packing_i_calloc(grid->allocator, slots, sizeof *table);
  if (table == NULL)
    return 0;
  packing_i_free(grid->allocator, grid->slot);
  grid->slot = table;
  grid->slots = slots;
  for (size_t t = 1; t < grid->tiles; t++)
    *slot_of(grid, grid->tile[t].at) = (uint32_t)t;
  return 1;
}

/* Room for one more entry of an array that is made as needed. */
static int grow(const packing_allocator *allocator, void **array, size_t count,
                size_t *room, size_t more, size_t size)
{
  if (*array != NULL && count + more <= *room)
    return 1;
  size_t next = *room + *room / 2;
  if (next < count + more)
    next = count + more;
  if (next < 16)
    next = 16;
  void *grown =
      packing_i_regrow(allocator, *array, *array == NULL ? 0 : count, next, size);
  if (grown == NULL)
    return 0;
  *array = grown;
  *room = next;
  return 1;
}

static uint32_t make_tile(packing_i_front_grid *grid, const int64_t at[3])
{
  if (grid->tiles >= UINT32_MAX || !grow_table(grid) ||
      !grow(grid->allocator, (void **)&grid->tile, grid->tiles, &grid->tile_room, 1,
            sizeof *grid->tile))
    return 0;
  const uint32_t t = (uint32_t)grid->tiles++;
  packing_i_front_tile *tile = grid->tile + t;
  memset(tile, 0, sizeof *tile);
  memcpy(tile->at, at, sizeof tile->at);
  tile->lo = packing_i_vec(grid->origin.x + (double)at[0] * grid->edge.x,
                           grid->origin.y + (double)at[1] * grid->edge.y,
                           grid->origin.z + (double)at[2] * grid->edge.z);
  tile->around[PACKING_I_TILE_ITSELF] = t;
  tile->next_key = HUGE_VAL;
  *slot_of(grid, at) = t;
  return t;
}

uint32_t packing_i_front_tile_find(const packing_i_front_grid *grid, const int64_t at[3])
{
  return grid->slots == 0 ? 0 : *slot_of(grid, at);
}

uint32_t packing_i_front_tile_at(packing_i_front_grid *grid, const int64_t at[3])
{
  const uint32_t t = packing_i_front_tile_find(grid, at);
  return t != 0 ? t : make_tile(grid, at);
}

packing_status packing_i_front_tile_surround(packing_i_front_grid *grid, uint32_t tile)
{
  if (grid->tile[tile].surrounded)
    return PACKING_OK;
  for (int n = 0; n < PACKING_I_TILE_AROUND; n++) {
    const packing_i_front_tile *t = grid->tile + tile;
    if (t->around[n] != 0)
      continue;
    const int64_t at[3] = {t->at[0] + n % 3 - 1, t->at[1] + n / 3 % 3 - 1,
                           t->at[2] + n / 9 - 1};
    const uint32_t other = packing_i_front_tile_at(grid, at);
    if (other == 0)
      return PACKING_ERR_NOMEM;
    grid->tile[tile].around[n] = other;
    grid->tile[other].around[PACKING_I_TILE_AROUND - 1 - n] = tile;
  }
  grid->tile[tile].surrounded = 1;
  return PACKING_OK;
}

packing_status packing_i_front_tile_note(packing_i_front_grid *grid, uint32_t tile,
                                         uint32_t index)
{
  packing_i_front_tile *t = grid->tile + tile;
  if (t->list == 0 || grid->list[t->list].count == PACKING_I_LIST_LENGTH) {
    if (!grow(grid->allocator, (void **)&grid->list, grid->lists, &grid->list_room, 1,
              sizeof *grid->list))
      return PACKING_ERR_NOMEM;
    const uint32_t n = (uint32_t)grid->lists++;
    grid->list[n].next = t->list;
    grid->list[n].count = 0;
    t->list = n;
  }
  packing_i_front_list *list = grid->list + t->list;
  list->index[list->count++] = index;
  return PACKING_OK;
}

void packing_i_front_tile_forget(packing_i_front_grid *grid, uint32_t tile)
{
  grid->list[grid->tile[tile].list].count--;
}

/* ---- cells ---- */

int packing_i_front_grid_reserve_bins(packing_i_front_grid *grid)
{
  enum { BINS = PACKING_I_BIN_CHUNK };
  if (grid->chunks >= MORE / PACKING_I_FRONT_WIDTH / BINS ||
      !grow(grid->allocator, (void **)&grid->chunk, grid->chunks, &grid->chunk_room, 1,
            sizeof *grid->chunk))
    return 0;
  packing_i_front_bin *bin = packing_i_alloc(grid->allocator, BINS, sizeof *bin);
  if (bin == NULL)
    return 0;
  grid->chunk[grid->chunks] = bin;
  const uint32_t first = (uint32_t)grid->chunks++ * BINS;
  for (uint32_t k = BINS; k-- > 0;) {
    if (first + k == 0)
      continue; /* none */
    bin[k].next = grid->free_bin;
    grid->free_bin = first + k;
  }
  return 1;
}

static void clear_bin(packing_i_front_bin *bin)
{
  memset(bin, 0, sizeof *bin);
  for (int k = 0; k < PACKING_I_FRONT_WIDTH; k++)
    bin->x[k] = HUGE_VAL;
}

/* Cells counted from the lowest corner of a tile with n cells along an edge; those of its
 * neighbours are negative or beyond its edge, down to -n and below 2 n. A conversion instead of
 * floor(), which old instruction sets lack. */
static inline int cell_along(double p, double lo, double per_edge, int n)
{
  const double c = (p - lo) * per_edge + n;
  return (c < 0 ? 0 : c >= 3 * n ? 3 * n - 1 : (int)c) - n;
}

static inline int part(int c, int n)
{
  return c < 0 ? 0 : c < n ? 1 : 2;
}

static inline uint32_t tile_at(const packing_i_front_grid *grid, uint32_t tile, int x,
                               int y, int z)
{
  const int *n = grid->n;
  return grid->tile[tile].around[(part(z, n[2]) * 3 + part(y, n[1])) * 3 + part(x, n[0])];
}

static inline uint32_t *cell_at(const packing_i_front_grid *grid, uint32_t tile, int x,
                                int y, int z)
{
  const int *n = grid->n;
  const int cx = x - (part(x, n[0]) - 1) * n[0], cy = y - (part(y, n[1]) - 1) * n[1],
            cz = z - (part(z, n[2]) - 1) * n[2];
  return grid->tile[tile_at(grid, tile, x, y, z)].cell + ((cz * n[1] + cy) * n[0] + cx);
}

static uint32_t add_to_cell(packing_i_front_grid *grid, uint32_t *cell,
                            const packing_vec3 *p, double r, uint32_t *free_bin)
{
  uint32_t b = *cell & ~MORE;
  if (b == 0 || packing_i_front_bin_at(grid, b)->count == PACKING_I_FRONT_WIDTH) {
    const uint32_t first = b;
    b = *free_bin;
    *free_bin = packing_i_front_bin_at(grid, b)->next;
    clear_bin(packing_i_front_bin_at(grid, b));
    packing_i_front_bin_at(grid, b)->next = first;
    *cell = first == 0 ? b : b | MORE;
  }
  packing_i_front_bin *bin = packing_i_front_bin_at(grid, b);
  const uint32_t k = bin->count++;
  bin->x[k] = p->x;
  bin->y[k] = p->y;
  bin->z[k] = p->z;
  bin->r[k] = r;
  return b * PACKING_I_FRONT_WIDTH + k;
}

uint32_t packing_i_front_grid_insert(packing_i_front_grid *grid, uint32_t *tile,
                                     const packing_vec3 *p, double r, uint32_t *free_bin)
{
  const packing_vec3 lo = grid->tile[*tile].lo;
  const int x = cell_along(p->x, lo.x, grid->per_edge.x, grid->n[0]),
            y = cell_along(p->y, lo.y, grid->per_edge.y, grid->n[1]),
            z = cell_along(p->z, lo.z, grid->per_edge.z, grid->n[2]);
  uint32_t *cell = cell_at(grid, *tile, x, y, z);
  *tile = tile_at(grid, *tile, x, y, z);
  return add_to_cell(grid, cell, p, r, free_bin);
}

static int cell_inside(double p, double lo, double per_edge, int n)
{
  const int c = cell_along(p, lo, per_edge, n);
  return c < 0 ? 0 : c < n ? c : n - 1;
}

packing_status packing_i_front_tile_fill(packing_i_front_grid *grid, uint32_t tile,
                                         const packing_particles *store)
{
  const int *n = grid->n;
  const packing_vec3 lo = grid->tile[tile].lo, per = grid->per_edge;
  if (!grow(grid->allocator, (void **)&grid->standing, grid->standings,
            &grid->standing_room, 1, sizeof *grid->standing))
    return PACKING_ERR_NOMEM;
  const size_t count = (size_t)n[0] * (size_t)n[1] * (size_t)n[2];
  uint32_t *cells = packing_i_calloc(grid->allocator, count, sizeof *cells);
  if (cells == NULL)
    return PACKING_ERR_NOMEM;
  grid->standing[grid->standings++] = tile;
  grid->tile[tile].cell = cells;
  for (uint32_t l = grid->tile[tile].list; l != 0; l = grid->list[l].next)
    for (uint32_t m = 0; m < grid->list[l].count; m++) {
      const uint32_t i = grid->list[l].index[m];
      const packing_vec3 p =
          packing_i_vec(store->x[i], store->y[i], store->dim == 2 ? 0 : store->z[i]);
      if (grid->free_bin == 0 && !packing_i_front_grid_reserve_bins(grid))
        return PACKING_ERR_NOMEM;
      const int x = cell_inside(p.x, lo.x, per.x, n[0]),
                y = cell_inside(p.y, lo.y, per.y, n[1]),
                z = cell_inside(p.z, lo.z, per.z, n[2]);
      const uint32_t place = add_to_cell(grid, cells + ((z * n[1] + y) * n[0] + x), &p,
                                         store->r[i], &grid->free_bin);
      packing_i_front_bin_at(grid, place / PACKING_I_FRONT_WIDTH)
          ->index[place % PACKING_I_FRONT_WIDTH] = i;
    }
  return PACKING_OK;
}

void packing_i_front_tile_empty(packing_i_front_grid *grid, uint32_t tile)
{
  packing_i_front_tile *t = grid->tile + tile;
  const int cells = grid->n[0] * grid->n[1] * grid->n[2];
  for (int c = 0; t->cell != NULL && c < cells; c++)
    for (uint32_t b = t->cell[c] & ~MORE, next; b != 0; b = next) {
      packing_i_front_bin *bin = packing_i_front_bin_at(grid, b);
      next = bin->next;
      bin->next = grid->free_bin;
      grid->free_bin = b;
    }
  packing_i_free(grid->allocator, t->cell);
  t->cell = NULL;
}

/* Square of the distance of a coordinate from cell c. */
static inline double beyond2(double p, double lo, double cell, int c)
{
  const double left = lo + c * cell - p, right = p - (lo + (c + 1) * cell);
  const double far = left > right ? left : right;
  const double d = far > 0 ? far : 0;
  return d * d;
}

/* A look around a centre: bins are listed and asked for ahead, then read. */
enum { AHEAD = 256 };
typedef struct look {
  const packing_i_front_grid *grid;
  const packing_i_front_kernels *kernels;
  const packing_vec3 *centre;
  double reach;
  packing_i_front_halo *halo;
  size_t count;
  const packing_i_front_bin *bin[AHEAD];
  uint32_t place[AHEAD];
} look;

static int read_bins(look *l)
{
  const size_t count = l->count;
  l->count = 0;
  return l->kernels->gather(l->bin, l->place, count, l->centre, l->reach, l->halo);
}

static inline const packing_i_front_bin *list_bin(look *l, uint32_t b)
{
  const packing_i_front_bin *bin = packing_i_front_bin_at(l->grid, b);
  __builtin_prefetch(bin->x);
  __builtin_prefetch(bin->y);
  __builtin_prefetch(bin->z);
  __builtin_prefetch(bin->r);
  l->bin[l->count] = bin;
  l->place[l->count] = b * PACKING_I_FRONT_WIDTH;
  return bin;
}

/* The bins of a cell after its first. */
static int list_more(look *l, uint32_t b)
{
  for (b = packing_i_front_bin_at(l->grid, b)->next; b != 0;) {
    if (l->count + PACKING_I_TILE_MOST >= AHEAD && !read_bins(l))
      return 0;
    b = list_bin(l, b)->next;
    l->count++;
  }
  return 1;
}

/* The cells of a row from x0 to x1, which may lie in three tiles. */
static int list_row(look *l, uint32_t tile, int y, int z, int x0, int x1)
{
  for (int x = x0; x <= x1;) {
    const int n = l->grid->n[0];
    const int last = x1 < part(x, n) * n - 1 ? x1 : part(x, n) * n - 1;
    const uint32_t *cell = cell_at(l->grid, tile, x, y, z);
    if (l->count + PACKING_I_TILE_MOST >= AHEAD && !read_bins(l))
      return 0;
    for (; x <= last; x++, cell++) {
      list_bin(
          l,
          *cell & ~MORE); /* bin 0 is there, and which cells are empty is hard to guess */
      l->count += *cell != 0;
      if ((*cell & MORE) && !list_more(l, *cell & ~MORE))
        return 0;
    }
  }
  return 1;
}

int packing_i_front_grid_gather(const packing_i_front_grid *grid,
                                const packing_i_front_kernels *kernels, uint32_t tile,
                                const packing_vec3 *centre, double reach, double max_r,
                                packing_i_front_halo *halo)
{
  const packing_vec3 lo = grid->tile[tile].lo, per = grid->per_edge;
  const double far = reach + max_r;
  const double far2 = far * far;
  look l;                /* its arrays need no zeros */
  if (grid->chunks == 0) /* no sphere yet, nor bin 0 */
    return 1;
  l.grid = grid;
  l.kernels = kernels;
  l.centre = centre;
  l.reach = reach;
  l.halo = halo;
  l.count = 0;
  const int y0 = cell_along(centre->y - far, lo.y, per.y, grid->n[1]),
            y1 = cell_along(centre->y + far, lo.y, per.y, grid->n[1]),
            z0 = cell_along(centre->z - far, lo.z, per.z, grid->n[2]),
            z1 = cell_along(centre->z + far, lo.z, per.z, grid->n[2]);
  for (int z = z0; z <= z1; z++) {
    const double dz2 = beyond2(centre->z, lo.z, 1 / per.z, z);
    for (int y = y0; y <= y1; y++) {
      const double left2 = far2 - dz2 - beyond2(centre->y, lo.y, 1 / per.y, y);
      if (left2 < 0)
        continue;
      const double half = sqrt(left2);
      const int first = cell_along(centre->x - half, lo.x, per.x, grid->n[0]),
                last = cell_along(centre->x + half, lo.x, per.x, grid->n[0]);
      if (!list_row(&l, tile, y, z, first, last))
        return 0;
    }
  }
  return read_bins(&l);
}
