/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tiles of the pocket front against a loop over all spheres: a look around a point finds those
 * whose surface is in reach, each once, wherever tiles and cells end, before and after tiles gave
 * their cells up. Spheres overlap here: the grid does not mind. */
#include "test.h"

#include "place/front_grid.h"

enum { MOST = 3000, ROOM = MOST + PACKING_I_FRONT_WIDTH };

static packing_rng *rng;

static void restart(uint64_t seed)
{
  packing_rng_destroy(rng);
  assert_ok(packing_rng_create(NULL, seed, PACKING_PURPOSE_USER, 0, &rng));
}

static double between(double a, double b)
{
  return a + (b - a) * packing_rng_uniform(rng);
}

static packing_vec3 point(int dim, double far)
{
  return packing_i_vec(between(-far, far), between(-far, far),
                       dim == 2 ? 0 : between(-far, far));
}

/* ---- scenes ---- */

typedef struct column {
  double value[ROOM] __attribute__((aligned(64)));
} column;

/* A grid, the store its tiles fill from, and room for what a look finds. */
typedef struct scene {
  packing_context *context; /* may be NULL */
  packing_i_front_grid grid;
  packing_particles *store;
  double max_r;
  packing_i_front_halo halo;
  column *halo_column;
  uint32_t halo_id[ROOM];
  size_t refused; /* how often memory was */
} scene;

/* Tiles of n cells of length `cell` along an edge; the origin is that of no tile's centre. */
static scene *scene_create(packing_context *context, int dim, int n, double cell,
                           double max_r)
{
  scene *s = calloc(1, sizeof *s);
  assert_non_null(s);
  s->halo_column = aligned_alloc(64, 6 * sizeof *s->halo_column);
  assert_non_null(s->halo_column);
  double *c[6];
  for (size_t k = 0; k < 6; k++)
    c[k] = s->halo_column[k].value;
  const packing_i_front_halo halo = {c[0], c[1],       c[2], c[3], c[4],
                                     c[5], s->halo_id, 0,    ROOM};
  const int cells[3] = {n, n, dim == 2 ? 1 : n};
  const double edge = n * cell;
  s->context = context;
  s->max_r = max_r;
  s->halo = halo;
  s->store = test_store(dim);
  packing_i_front_grid_init(
      &s->grid, packing_i_allocator(context),
      packing_i_vec(0.13 * cell, -2.9 * cell, dim == 2 ? -0.5 * edge : 0.7 * cell),
      packing_i_vec(edge, edge, edge), cells);
  return s;
}

static void scene_destroy(scene *s)
{
  packing_i_front_grid_release(&s->grid);
  packing_particles_destroy(s->store);
  free(s->halo_column);
  free(s);
}

static packing_status fill_around(scene *s, uint32_t tile)
{
  PACKING_I_TRY(packing_i_front_tile_surround(&s->grid, tile));
  for (int n = 0; n < PACKING_I_TILE_AROUND; n++) {
    const uint32_t t = s->grid.tile[tile].around[n];
    if (s->grid.tile[t].cell != NULL)
      continue;
    const packing_status status = packing_i_front_tile_fill(&s->grid, t, s->store);
    if (status != PACKING_OK) {
      packing_i_front_tile_empty(&s->grid, t);
      return status;
    }
  }
  return PACKING_OK;
}

/* The tile of a point with the cells around it; asks once more where memory was refused. */
static uint32_t tile_for(scene *s, const packing_vec3 *p)
{
  int64_t at[3];
  packing_i_front_grid_at(&s->grid, p, at);
  uint32_t tile = packing_i_front_tile_at(&s->grid, at);
  if (tile == 0) {
    s->refused++;
    tile = packing_i_front_tile_at(&s->grid, at);
  }
  assert_int_not_equal(tile, 0);
  if (fill_around(s, tile) != PACKING_OK) {
    s->refused++;
    assert_ok(fill_around(s, tile));
  }
  return tile;
}

static void put(scene *s, const packing_vec3 *p, double r)
{
  packing_i_front_grid *grid = &s->grid;
  uint32_t tile = tile_for(s, p);
  const uint32_t index = (uint32_t)packing_particles_count(s->store);
  if (grid->free_bin == 0 && !packing_i_front_grid_reserve_bins(grid)) {
    s->refused++;
    assert_true(packing_i_front_grid_reserve_bins(grid));
  }
  const uint32_t place = packing_i_front_grid_insert(grid, &tile, p, r, &grid->free_bin);
  unsigned k;
  packing_i_front_bin_of(grid, place, &k)->index[k] = index;
  double r_there;
  const packing_vec3 there = packing_i_front_centre(grid, place, &r_there);
  assert_true(there.x == p->x && there.y == p->y && there.z == p->z && r_there == r);
  if (packing_i_front_tile_note(grid, tile, index) != PACKING_OK) {
    s->refused++;
    assert_ok(packing_i_front_tile_note(grid, tile, index));
  }
  assert_ok(packing_particles_add(s->store, *p, r, NULL));
}

/* Radii over two decades, a third of them the largest; in a cube of half the side `far` about the
 * origin. */
static void put_many(scene *s, size_t count, double far)
{
  const int dim = packing_particles_dim(s->store);
  for (size_t i = 0; i < count; i++) {
    const packing_vec3 p = point(dim, far);
    const double decade = between(-2, 1);
    put(s, &p, s->max_r * (decade < 0 ? pow(10, decade) : 1));
  }
}

/* Tiles give their cells up, as behind the front. */
static void empty_all(scene *s)
{
  for (uint32_t t = 1; t < s->grid.tiles; t++)
    packing_i_front_tile_empty(&s->grid, t);
  s->grid.standings = 0;
}

/* ---- the twin ---- */

static int look(scene *s, const packing_i_front_kernels *kernels,
                const packing_vec3 *centre, double reach)
{
  s->halo.count = 0;
  return packing_i_front_grid_gather(&s->grid, kernels, tile_for(s, centre), centre,
                                     reach, s->max_r, &s->halo);
}

/* Which of the store's spheres a look found; none twice, and each where it stands. */
static void found(const scene *s, const packing_vec3 *centre, unsigned char *seen)
{
  const packing_i_front_halo *h = &s->halo;
  memset(seen, 0, MOST);
  for (size_t t = 0; t < h->count; t++) {
    unsigned k;
    const packing_i_front_bin *bin = packing_i_front_bin_of(&s->grid, h->id[t], &k);
    assert_true(k < bin->count);
    const uint32_t i = bin->index[k];
    assert_true(i < packing_particles_count(s->store) && !seen[i]);
    seen[i] = 1;
    const packing_vec3 p = packing_i_vec(s->store->x[i], s->store->y[i],
                                         s->store->dim == 2 ? 0 : s->store->z[i]);
    assert_true(h->x[t] == p.x - centre->x && h->y[t] == p.y - centre->y &&
                h->z[t] == p.z - centre->z && h->r[t] == s->store->r[i]);
  }
}

/* Those in reach were seen, others not; rounding decides at the very edge. */
static void compare(const scene *s, const packing_vec3 *centre, double reach,
                    const unsigned char *seen)
{
  const double slack = 1e-12 * (reach + s->max_r + packing_i_norm(*centre));
  for (size_t i = 0; i < packing_particles_count(s->store); i++) {
    const packing_vec3 p = packing_i_vec(s->store->x[i], s->store->y[i],
                                         s->store->dim == 2 ? 0 : s->store->z[i]);
    const double gap = packing_i_norm(packing_i_sub(p, *centre)) - s->store->r[i] - reach;
    if (fabs(gap) > slack)
      assert_int_equal(seen[i], gap < 0);
  }
}

/* With all sets of instructions. Returns how many were found. */
static size_t check(scene *s, const packing_vec3 *centre, double reach)
{
  static const packing_isa all[] = {PACKING_ISA_BASELINE, PACKING_ISA_AVX2,
                                    PACKING_ISA_AVX512};
  static unsigned char seen[MOST];
  for (size_t k = 0; k < 3; k++) {
    if (!packing_isa_available(all[k]))
      continue;
    assert_true(look(s, packing_i_front_kernels_for(all[k]), centre, reach));
    found(s, centre, seen);
    compare(s, centre, reach, seen);
  }
  return s->halo.count;
}

static double edge_of(const scene *s)
{
  return s->grid.edge.x;
}

/* Looks around anything, as far as the tiles around allow. */
static size_t check_many(scene *s, int looks, double far)
{
  size_t sum = 0;
  for (int n = 0; n < looks; n++) {
    const packing_vec3 centre = point(packing_particles_dim(s->store), far);
    sum += check(s, &centre, between(0, edge_of(s) - s->max_r));
  }
  return sum;
}

/* ---- tests ---- */

/* Over 5 tiles a side, of 3 to 11 cells, radii to half a cell and to half a tile. */
static void finds_what_is_in_reach(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (int n = 3; n <= 11; n += 4) {
      const double cell = 0.37, edge = n * cell;
      const double max_r = n == 7 ? 0.5 * cell : 0.5 * edge;
      scene *s = scene_create(NULL, dim, n, cell, max_r);
      put_many(s, 1000, 2.5 * edge);
      assert_true(check_many(s, 200, 2.4 * edge) > 200);
      empty_all(s);
      assert_true(check_many(s, 200, 2.4 * edge) > 200);
      put_many(s, 300, 2.5 * edge);
      assert_true(check_many(s, 200, 2.4 * edge) > 200);
      scene_destroy(s);
    }
}

/* So many in few tiles that lists of indices, chunks of bins and the list of bins of a look go on;
 * and so many in one cell. */
static void finds_them_in_a_crowd(void **state)
{
  (void)state;
  scene *s = scene_create(NULL, 3, 8, 0.11, 0.05);
  put_many(s, MOST - 200, 1.2);
  assert_true(s->grid.chunks > 1);
  const packing_vec3 at = {0.21, -0.17, 0.32};
  for (int n = 0; n < 200; n++)
    put(s, &at, 0.04);
  assert_true(check(s, &at, edge_of(s) - s->max_r) > 600);
  check_many(s, 30, 1.2);
  empty_all(s);
  assert_true(check(s, &at, edge_of(s) - s->max_r) > 600);
  check_many(s, 30, 1.2);
  scene_destroy(s);
}

/* The next number down, itself, or the next up. */
static double beside(double a, int side)
{
  return side == 0 ? a : nextafter(a, side * HUGE_VAL);
}

static packing_vec3 beside_point(int dim, packing_vec3 p, int side)
{
  return packing_i_vec(beside(p.x, side), beside(p.y, side),
                       dim == 2 ? 0 : beside(p.z, side));
}

/* Centres on the corners of cells and of tiles and right beside; looks from there. */
static void finds_them_on_borders(void **state)
{
  (void)state;
  enum { N = 5 };
  for (int dim = 2; dim <= 3; dim++) {
    const double cell = 0.27; /* x falls on both sides of borders by rounding */
    scene *s = scene_create(NULL, dim, N, cell, 0.4 * cell);
    const packing_vec3 o = s->grid.origin, e = s->grid.edge;
    for (int n = 0; n < (dim == 2 ? 11 * 11 : 11 * 11 * 11); n++) {
      const int x = n % 11 - N, y = n / 11 % 11 - N, z = n / 121 - N;
      const packing_vec3 p = {o.x + x / 5.0 * e.x, o.y + y / 5.0 * e.y,
                              dim == 2 ? 0 : o.z + z / 5.0 * e.z};
      const packing_vec3 q = beside_point(dim, p, n % 3 - 1);
      put(s, &q, between(0.1, 0.4) * cell);
    }
    for (int n = -150; n <= 150; n++) { /* a row of borders of tiles */
      const packing_vec3 p = {o.x + n / 3 * e.x, o.y + 0.3 * cell,
                              dim == 2 ? 0 : o.z + 0.3 * cell};
      put(s, &(packing_vec3){beside(p.x, n % 3), p.y, p.z}, 0.2 * cell);
    }
    for (int again = 0; again < 2; again++) {
      for (size_t i = 0; i < packing_particles_count(s->store); i += 7) {
        const packing_vec3 p = {s->store->x[i], s->store->y[i],
                                dim == 2 ? 0 : s->store->z[i]};
        for (int side = -1; side <= 1; side++) {
          const packing_vec3 q = beside_point(dim, p, side);
          /* Nowhere the sum of a radius and a distance of corners. */
          assert_true(check(s, &q, 1.4563 * cell) > 0);
        }
      }
      empty_all(s);
    }
    scene_destroy(s);
  }
}

/* A tile is one whoever asks, has 26 others around, and they have it; far ones are found too. */
static void tiles(void **state)
{
  (void)state;
  scene *s = scene_create(NULL, 3, 4, 0.25, 0.1);
  packing_i_front_grid *grid = &s->grid;
  const int64_t far = INT64_C(1) << 40;
  const int64_t place[][3] = {{0, 0, 0}, {-3, 2, -1}, {far, -far, 7}, {-1, -1, -1}};
  assert_int_equal(packing_i_front_tile_find(grid, place[0]), 0);
  for (size_t n = 0; n < sizeof place / sizeof *place; n++) {
    const uint32_t t = packing_i_front_tile_at(grid, place[n]);
    assert_int_not_equal(t, 0);
    assert_ok(packing_i_front_tile_surround(grid, t));
    assert_int_equal(packing_i_front_tile_at(grid, place[n]), t);
  }
  const int64_t nobody[3] = {-9, 2, -1};
  assert_int_equal(packing_i_front_tile_find(grid, nobody), 0);
  for (uint32_t t = 1; t < grid->tiles; t++) {
    assert_int_equal(packing_i_front_tile_find(grid, grid->tile[t].at), t);
    for (int n = 0; n < PACKING_I_TILE_AROUND; n++) {
      const uint32_t other = grid->tile[t].around[n];
      if (other == 0)
        continue;
      const int step[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      for (int k = 0; k < 3; k++)
        assert_int_equal(grid->tile[other].at[k] - grid->tile[t].at[k], step[k]);
    }
  }
  scene_destroy(s);
}

/* A note taken back does not come again with the cells. */
static void forgets(void **state)
{
  (void)state;
  scene *s = scene_create(NULL, 3, 4, 0.25, 0.1);
  const packing_vec3 p = {0.2, 0.1, 0.3};
  enum { NOTES = PACKING_I_LIST_LENGTH + 1 }; /* the last has a list to itself */
  for (int n = 0; n < NOTES; n++)
    put(s, &p, 0.07);
  packing_i_front_tile_forget(&s->grid, tile_for(s, &p));
  empty_all(s);
  assert_true(look(s, &packing_i_front_kernels_baseline, &p, 0.1));
  assert_int_equal(s->halo.count, NOTES - 1);
  for (size_t t = 0; t < s->halo.count; t++) {
    unsigned k;
    const packing_i_front_bin *bin = packing_i_front_bin_of(&s->grid, s->halo.id[t], &k);
    assert_int_not_equal(bin->index[k], NOTES - 1);
  }
  scene_destroy(s);
}

/* No room in the halo is said, and nothing is written beyond it. */
static void says_when_the_halo_is_full(void **state)
{
  (void)state;
  scene *s = scene_create(NULL, 3, 8, 0.11, 0.05);
  put_many(s, 600, 0.5);
  const packing_vec3 centre = {0, 0, 0};
  const size_t all = check(s, &centre, 0.6);
  assert_true(all > 64);
  s->halo.capacity = 64;
  s->halo_id[64] = 4711;
  assert_false(look(s, &packing_i_front_kernels_baseline, &centre, 0.6));
  assert_true(s->halo.count <= 64 && s->halo_id[64] == 4711);
  s->halo.capacity = all + PACKING_I_FRONT_WIDTH;
  assert_true(look(s, &packing_i_front_kernels_baseline, &centre, 0.6));
  assert_int_equal(s->halo.count, all);
  scene_destroy(s);
}

/* The same spheres in the same order when all lengths are multiplied by a power of two. */
static void scales(void **state)
{
  (void)state;
  uint64_t want = 0;
  for (int power = -60; power <= 60; power += 60) {
    const double unit = ldexp(1, power);
    uint64_t hash = TEST_HASH_START;
    restart(5);
    scene *s = scene_create(NULL, 3, 6, 0.31 * unit, 0.4 * unit);
    put_many(s, 400, 3 * unit);
    for (int n = 0; n < 20; n++) {
      const packing_vec3 centre = point(3, 3 * unit);
      assert_true(look(s, &packing_i_front_kernels_baseline, &centre, 1.2 * unit));
      hash = test_hash(hash, s->halo.id, s->halo.count * sizeof *s->halo.id);
    }
    assert_true(power == -60 || hash == want);
    want = hash;
    scene_destroy(s);
  }
}

/* ---- refused memory ---- */

/* A part of everything that asks for memory; hash of what looks find. */
static uint64_t fill_and_look(packing_context *context, size_t *refused)
{
  uint64_t hash = TEST_HASH_START;
  restart(7);
  scene *s = scene_create(context, 3, 4, 0.25, 0.2);
  put_many(s, 150, 0.8);
  empty_all(s);
  for (int n = 0; n < 5; n++) {
    const packing_vec3 centre = point(3, 0.8);
    hash += check(s, &centre, 0.6);
    for (size_t t = 0; t < s->halo.count; t++)
      hash += test_hash(TEST_HASH_START, &s->halo.x[t], sizeof *s->halo.x);
  }
  *refused = s->refused;
  scene_destroy(s);
  return hash;
}

/* Each request refused once: the caller hears of it, asks again, and nothing is lost or doubled. */
static void can_be_asked_again(void **state)
{
  (void)state;
  uint64_t want = 0;
  size_t k, refused = 1;
  for (k = 0; refused > 0 || k < 2; k++) {
    test_allocator a = {0};
    packing_context *context = test_allocator_context(&a);
    a.fail_at = k == 0 ? 0 : a.requests + k;
    const uint64_t hash = fill_and_look(context, &refused);
    assert_true(refused <= 1 && (k > 0 || refused == 0));
    assert_true(k == 0 || hash == want);
    want = hash;
    packing_context_destroy(context);
    assert_int_equal(a.live, 0);
  }
  assert_true(k > 100); /* cells of more than a hundred tiles */
}

static int begin(void **state)
{
  (void)state;
  return packing_rng_create(NULL, 13, PACKING_PURPOSE_USER, 0, &rng) != PACKING_OK;
}

static int end(void **state)
{
  (void)state;
  packing_rng_destroy(rng);
  return 0;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(finds_what_is_in_reach),
      cmocka_unit_test(finds_them_in_a_crowd),
      cmocka_unit_test(finds_them_on_borders),
      cmocka_unit_test(tiles),
      cmocka_unit_test(forgets),
      cmocka_unit_test(says_when_the_halo_is_full),
      cmocka_unit_test(scales),
      cmocka_unit_test(can_be_asked_again),
  };
  return cmocka_run_group_tests(tests, begin, end);
}
