/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grid against the slow obvious search, over packs of every kind. */
#include "test.h"

/* A pack drawn from its description. */
typedef struct scene {
  const char *name;
  int dim;
  size_t count;
  double size[3];
  double min_r, max_r; /* log-uniform between */
  double spill;        /* how far beyond the box centres may lie, in edges */
} scene;

static const scene scenes[] = {
    {"none", 3, 0, {1, 1, 1}, 1, 1, 0},
    {"one", 3, 1, {1, 1, 1}, .1, .1, 0},
    {"two", 3, 2, {1, 1, 1}, .3, .3, 0},
    {"equal", 3, 385, {10, 9, 8}, .4, .4, 0},
    {"equal, dense rows", 3, 495, {100, 1, 1}, .2, .2, 0},
    {"long along y", 3, 275, {1, 70, 2}, .3, .3, 0},
    {"long along z", 3, 275, {2, 1, 70}, .1, .3, 0},
    {"within an octave", 3, 330, {10, 10, 10}, .3, .5, 0},
    {"1:50", 3, 440, {10, 10, 10}, .05, 2.5, 0},
    {"1:1000", 3, 440, {10, 10, 10}, .003, 3, 0},
    {"larger than the cell", 3, 60, {1, 2, 3}, .2, 4, 0},
    {"a cell of one diameter", 3, 60, {1, 1, 1}, .5, .5, 0},
    {"cells of 2 and 3 diameters", 3, 110, {2.1, 3.2, 2.9}, .5, .5, 0},
    {"thin", 3, 220, {20, 20, .1}, .3, .6, 0},
    {"discs", 2, 330, {10, 14, 0}, .05, .6, 0},
    {"discs in a small cell", 2, 60, {1.5, 1, 0}, .2, .4, 0},
    {"spilled", 3, 275, {6, 7, 8}, .1, .8, 2},
    {"spilled discs", 2, 165, {6, 7, 0}, .1, .8, 1.5},
};

enum { SCENES = sizeof scenes / sizeof scenes[0], MOST = 1000 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  size_t count;
  packing_domain *domain;
} pack;

static void draw(const scene *s, unsigned periodic, uint64_t seed, pack *p)
{
  double *c[3] = {p->x, p->y, p->z};
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, seed, PACKING_PURPOSE_USER, 0, &rng));
  p->count = s->count;
  for (size_t i = 0; i < s->count; i++) {
    for (int k = 0; k < 3; k++)
      c[k][i] = s->size[k] * (packing_rng_uniform(rng) * (1 + 2 * s->spill) - s->spill);
    p->r[i] = s->min_r * pow(s->max_r / s->min_r, packing_rng_uniform(rng));
  }
  packing_rng_destroy(rng);
  p->domain = s->dim == 2 ? test_rectangle(s->size[0], s->size[1], periodic & 3)
                          : test_box(s->size[0], s->size[1], s->size[2], periodic);
}

/* Distance of two coordinates to the nearest image. */
static double apart(double a, double b, double size, unsigned periodic)
{
  double d = fabs(a - b);
  if (periodic) {
    d = fmod(d, size);
    d = d > size - d ? size - d : d;
  }
  return d;
}

static double distance(const scene *s, unsigned periodic, const double *a,
                       const double *b)
{
  double sum = 0;
  for (int k = 0; k < s->dim; k++) {
    const double d = apart(a[k], b[k], s->size[k], periodic >> k & 1);
    sum += d * d;
  }
  return sqrt(sum);
}

static packing_grid *build(const pack *p, int levels)
{
  packing_grid_def def;
  packing_grid *grid = NULL;
  packing_view v;
  packing_grid_def_init(&def);
  def.levels = levels;
  packing_view_init_arrays(&v, p->count, p->x, p->y, p->z, p->r);
  assert_ok(packing_grid_create(NULL, &def, p->domain, &v, &grid));
  return grid;
}

/* The twin wraps in another way: no random pair is so near a decision that rounding counts. */
static void check_pairs(const scene *s, unsigned periodic, const pack *p,
                        const packing_grid *grid, double gap)
{
  size_t count = 0, expected = 0, again = 0;
  assert_ok(packing_grid_pairs(grid, gap, NULL, 0, &count));
  packing_pair *pairs = calloc(count + 1, sizeof *pairs);
  assert_non_null(pairs);
  assert_ok(packing_grid_pairs(grid, gap, pairs, count, &again));
  assert_int_equal(count, again);
  for (size_t i = 0; i < p->count; i++)
    for (size_t j = i + 1; j < p->count; j++) {
      const double a[3] = {p->x[i], p->y[i], p->z[i]};
      const double b[3] = {p->x[j], p->y[j], p->z[j]};
      if (distance(s, periodic, a, b) > p->r[i] + p->r[j] + gap)
        continue;
      if (expected >= count || pairs[expected].i != i || pairs[expected].j != j) {
        print_error("%s, periodic %u, gap %g: pair %zu (%zu, %zu) is missing\n", s->name,
                    periodic, gap, expected, i, j);
        fail();
      }
      expected++;
    }
  assert_int_equal(expected, count);
  /* too little room: the first ones */
  packing_pair few[3] = {{0, 0}, {0, 0}, {0, 0}};
  assert_ok(packing_grid_pairs(grid, gap, few, 3, &again));
  assert_int_equal(count, again);
  assert_memory_equal(few, pairs, (count < 3 ? count : 3) * sizeof *few);
  free(pairs);
}

static void check_near(const scene *s, unsigned periodic, const pack *p,
                       const packing_grid *grid, uint64_t seed)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, seed, PACKING_PURPOSE_USER, 1, &rng));
  for (int q = 0; q < 25; q++) {
    double at[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++)
      at[k] = s->size[k] * (3 * packing_rng_uniform(rng) - 1);
    const double reach =
        q % 5 == 0 ? 0 : 2 * s->max_r * packing_rng_uniform(rng) * (q % 3);
    const packing_vec3 point = {at[0], at[1], at[2]};
    size_t found[MOST], few[4], count = 99, again = 99, expected = 0;
    assert_ok(packing_grid_near(grid, &point, reach, found, MOST, &count));
    for (size_t i = 0; i < p->count; i++) {
      const double b[3] = {p->x[i], p->y[i], p->z[i]};
      if (distance(s, periodic, at, b) > p->r[i] + reach)
        continue;
      if (expected >= count || found[expected] != i) {
        print_error("%s, periodic %u, query %d: particle %zu is missing\n", s->name,
                    periodic, q, i);
        fail();
      }
      expected++;
    }
    assert_int_equal(count, expected);
    assert_ok(packing_grid_near(grid, &point, reach, few, 4, &again));
    assert_int_equal(again, count);
    assert_memory_equal(few, found, (count < 4 ? count : 4) * sizeof few[0]);
  }
  packing_rng_destroy(rng);
}

static void grid_finds_what_brute_force_finds(void **state)
{
  (void)state;
  pack *p = malloc(sizeof *p);
  assert_non_null(p);
  for (int k = 0; k < SCENES; k++)
    for (unsigned periodic = 0; periodic < 8; periodic++) {
      const scene *s = &scenes[k];
      if (s->dim == 2 && periodic > 3)
        continue;
      draw(s, periodic, 1000 * (uint64_t)k + periodic, p);
      for (int levels = 1; levels <= 32; levels = levels == 1   ? 3
                                                  : levels == 3 ? 32
                                                                : 33) {
        packing_grid *grid = build(p, levels);
        check_pairs(s, periodic, p, grid, 0);
        check_pairs(s, periodic, p, grid, 0.7 * s->max_r);
        check_pairs(s, periodic, p, grid, -0.3 * s->min_r);
        if (levels != 3)
          check_pairs(s, periodic, p, grid, 4.1 * s->max_r);
        check_near(s, periodic, p, grid, 7 * (uint64_t)k + periodic);
        packing_grid_destroy(grid);
      }
      packing_domain_destroy(p->domain);
    }
  free(p);
}

/* The grid of a scaled pack finds the same. */
static void scaling_by_powers_of_two_changes_nothing(void **state)
{
  (void)state;
  pack *p = malloc(sizeof *p), *q = malloc(sizeof *q);
  assert_true(p != NULL && q != NULL);
  for (int e = -40; e <= 40; e += 20)
    for (int k = 0; k < SCENES; k++) {
      scene s = scenes[k];
      draw(&s, 3, 5, p);
      for (int c = 0; c < 3; c++)
        s.size[c] = ldexp(s.size[c], e);
      s.min_r = ldexp(s.min_r, e);
      s.max_r = ldexp(s.max_r, e);
      draw(&s, 3, 5, q);
      packing_grid *a = build(p, 32), *b = build(q, 32);
      packing_pair pairs_a[5000], pairs_b[5000];
      size_t count_a = 0, count_b = 0;
      assert_ok(packing_grid_pairs(a, 0.125, pairs_a, 5000, &count_a));
      assert_ok(packing_grid_pairs(b, ldexp(0.125, e), pairs_b, 5000, &count_b));
      assert_int_equal(count_a, count_b);
      assert_memory_equal(pairs_a, pairs_b,
                          (count_a < 5000 ? count_a : 5000) * sizeof pairs_a[0]);
      packing_grid_destroy(a);
      packing_grid_destroy(b);
      packing_domain_destroy(p->domain);
      packing_domain_destroy(q->domain);
    }
  free(p);
  free(q);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(grid_finds_what_brute_force_finds),
      cmocka_unit_test(scaling_by_powers_of_two_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
