/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grid at its limits: extreme extents and sizes, crowds, memory, every error. */
#include "test.h"

enum { MOST = 20000 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
} pack;

static pack *new_pack(size_t count)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  packing_view_init_arrays(&p->view, count, p->x, p->y, p->z, p->r);
  return p;
}

/* Spheres of one radius in a cube with its corner at (at, at, at). */
static void fill(pack *p, size_t first, size_t end, double at, double edge, double r)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 7, PACKING_PURPOSE_USER, 0, &rng));
  for (size_t i = first; i < end; i++) {
    p->x[i] = at + edge * packing_rng_uniform(rng);
    p->y[i] = at + edge * packing_rng_uniform(rng);
    p->z[i] = at + edge * packing_rng_uniform(rng);
    p->r[i] = r;
  }
  packing_rng_destroy(rng);
}

static size_t count_pairs(packing_context *context, const pack *p, packing_domain *domain)
{
  packing_grid *grid = NULL;
  size_t count = 0;
  assert_ok(packing_grid_create(context, NULL, domain, &p->view, &grid));
  assert_ok(packing_grid_pairs(grid, 0, NULL, 0, &count));
  packing_grid_destroy(grid);
  return count;
}

/* Two clusters 1e7 radii apart: the pairs of both, and memory that knows nothing of the void. */
static void far_clusters_cost_what_near_ones_do(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  pack *p = new_pack(MOST / 2);
  fill(p, 0, MOST / 2, 0, 32, 0.5);
  const size_t one = count_pairs(context, p, NULL);
  fill(p, MOST / 2, MOST, 5e6, 32, 0.5);
  p->view.count = MOST;
  a.peak = a.bytes;
  assert_int_equal(count_pairs(context, p, NULL), 2 * one);
  assert_true(one > MOST / 10);
  assert_true(a.peak < 160 * MOST);
  packing_context_destroy(context);
  free(p);
}

/* A particle that has left for good does not spoil the cells of those that stay. */
static void a_runaway_is_found_alone(void **state)
{
  (void)state;
  for (double far = 1e9; far < 1e150; far *= 1e20) {
    pack *p = new_pack(MOST - 1);
    fill(p, 0, MOST - 1, -16, 32, 0.5);
    const size_t count = count_pairs(NULL, p, NULL);
    p->x[MOST - 1] = -2 * far;
    p->y[MOST - 1] = far;
    p->z[MOST - 1] = -far;
    p->r[MOST - 1] = 0.5;
    p->view.count = MOST;
    assert_int_equal(count_pairs(NULL, p, NULL), count);
    packing_grid *grid = NULL;
    const packing_vec3 there = {-2 * far, far, -far};
    size_t found[2] = {0, 0}, near = 0;
    assert_ok(packing_grid_create(NULL, NULL, NULL, &p->view, &grid));
    assert_ok(packing_grid_near(grid, &there, 0, found, 2, &near));
    assert_int_equal(near, 1);
    assert_int_equal(found[0], MOST - 1);
    packing_grid_destroy(grid);
    free(p);
  }
}

static void a_crowd_in_one_spot_meets_itself(void **state)
{
  (void)state;
  packing_domain *box = test_box(1, 1, 1, 7);
  pack *p = new_pack(300);
  for (size_t i = 0; i < 300; i++) {
    p->x[i] = p->y[i] = 0.7;
    p->r[i] = i % 2 == 0 ? 0.25 : 1e-4;
  }
  assert_int_equal(count_pairs(NULL, p, NULL), 300 * 299 / 2);
  assert_int_equal(count_pairs(NULL, p, box), 300 * 299 / 2);
  packing_domain_destroy(box);
  free(p);
}

/* One sphere a thousand times larger than the rest touches exactly those around it. */
static void a_giant_among_dwarfs_meets_each_once(void **state)
{
  (void)state;
  pack *p = new_pack(MOST);
  fill(p, 1, MOST, 0, 3, 1e-3);
  p->x[0] = p->y[0] = p->z[0] = 1.5;
  p->r[0] = 1;
  size_t expected = 0, found[MOST], count = 0;
  for (size_t i = 1; i < MOST; i++) {
    const double dx = p->x[i] - 1.5, dy = p->y[i] - 1.5, dz = p->z[i] - 1.5;
    expected += (size_t)(sqrt(dx * dx + dy * dy + dz * dz) <= 1 + 1e-3);
  }
  packing_grid *grid = NULL;
  assert_ok(packing_grid_create(NULL, NULL, NULL, &p->view, &grid));
  packing_pair *pairs = calloc(MOST, sizeof *pairs);
  assert_non_null(pairs);
  assert_ok(packing_grid_pairs(grid, 0, pairs, MOST, &count));
  size_t with_giant = 0;
  while (with_giant < count && pairs[with_giant].i == 0)
    with_giant++;
  assert_int_equal(with_giant, expected);
  const packing_vec3 centre = {1.5, 1.5, 1.5};
  assert_ok(packing_grid_near(grid, &centre, 1, found, MOST, &count));
  assert_int_equal(count, expected + 1);
  for (size_t k = 0; k < with_giant; k++)
    assert_int_equal(found[k + 1], pairs[k].j);
  packing_grid_destroy(grid);
  free(pairs);
  free(p);
}

static void queries_allocate_nothing(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  pack *p = new_pack(2000);
  packing_grid *grid = NULL;
  fill(p, 0, 2000, 0, 12, 0.5);
  assert_ok(packing_grid_create(context, NULL, NULL, &p->view, &grid));
  const size_t requests = a.requests;
  size_t found[64], count = 0;
  for (size_t i = 0; i < 2000; i++) {
    const packing_vec3 at = {p->x[i], p->y[i], p->z[i]};
    assert_ok(packing_grid_near(grid, &at, 0.5, found, 64, &count));
    assert_true(count >= 1);
  }
  assert_int_equal(a.requests, requests);
  packing_grid_destroy(grid);
  packing_context_destroy(context);
  assert_int_equal(a.live, 0);
  free(p);
}

/* The grid owns what it needs. */
static void a_grid_outlives_what_it_was_made_from(void **state)
{
  (void)state;
  packing_context *context = test_context(2, PACKING_ISA_AUTO);
  packing_domain *box = test_box(4, 4, 4, 7);
  pack *p = new_pack(100);
  packing_grid *grid = NULL;
  size_t before = 0, after = 0;
  fill(p, 0, 100, 0, 4, 0.5);
  assert_ok(packing_grid_create(context, NULL, box, &p->view, &grid));
  assert_ok(packing_grid_pairs(grid, 0, NULL, 0, &before));
  packing_context_destroy(context);
  packing_domain_destroy(box);
  free(p);
  assert_ok(packing_grid_pairs(grid, 0, NULL, 0, &after));
  assert_true(before > 0 && before == after);
  packing_grid_destroy(grid);
}

static void creation_refuses_bad_input(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  pack *p = new_pack(10);
  packing_grid_def def;
  packing_grid *grid = NULL;
  fill(p, 0, 10, 0, 4, 0.5);
  packing_grid_def_init(&def);
  def.levels = 0;
  assert_fails(context, packing_grid_create(context, &def, NULL, &p->view, &grid),
               PACKING_ERR_RANGE, "levels");
  def.levels = 33;
  assert_fails(context, packing_grid_create(context, &def, NULL, &p->view, &grid),
               PACKING_ERR_RANGE, "levels");
  def.struct_size = 2;
  assert_fails(context, packing_grid_create(context, &def, NULL, &p->view, &grid),
               PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_grid_create(context, NULL, NULL, NULL, &grid),
               PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_grid_create(context, NULL, NULL, &p->view, NULL),
               PACKING_ERR_INVALID, "grid");
  const struct {
    double *where;
    double value;
    packing_status status;
    const char *field;
  } bad[] = {
      {&p->x[3], (double)NAN, PACKING_ERR_INVALID, "x"},
      {&p->y[3], (double)INFINITY, PACKING_ERR_INVALID, "y"},
      {&p->z[3], -(double)INFINITY, PACKING_ERR_INVALID, "z"},
      {&p->z[3], 1e200, PACKING_ERR_RANGE, "z"},
      {&p->r[3], (double)NAN, PACKING_ERR_INVALID, "r"},
      {&p->r[3], (double)INFINITY, PACKING_ERR_INVALID, "r"},
      {&p->r[3], 0, PACKING_ERR_RANGE, "r"},
      {&p->r[3], -1, PACKING_ERR_RANGE, "r"},
      {&p->r[3], 1e200, PACKING_ERR_RANGE, "r"},
  };
  for (size_t b = 0; b < sizeof bad / sizeof bad[0]; b++) {
    const double kept = *bad[b].where;
    *bad[b].where = bad[b].value;
    assert_fails(context, packing_grid_create(context, NULL, NULL, &p->view, &grid),
                 bad[b].status, bad[b].field);
    assert_non_null(strstr(packing_context_message(context), "particle 3"));
    *bad[b].where = kept;
  }
  assert_null(grid);
  free(p);
  packing_context_destroy(context);
}

static void queries_refuse_bad_input(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  pack *p = new_pack(10);
  packing_grid *grid = NULL;
  packing_vec3 at = {0, 0, 0};
  size_t count = 5;
  fill(p, 0, 10, 0, 4, 0.5);
  assert_ok(packing_grid_create(context, NULL, NULL, &p->view, &grid));
  assert_fails(context, packing_grid_near(grid, NULL, 0, NULL, 0, &count),
               PACKING_ERR_INVALID, "point");
  assert_fails(context, packing_grid_near(grid, &at, -1, NULL, 0, &count),
               PACKING_ERR_INVALID, "reach");
  assert_fails(context, packing_grid_near(grid, &at, (double)NAN, NULL, 0, &count),
               PACKING_ERR_INVALID, "reach");
  assert_fails(context, packing_grid_near(grid, &at, 0, NULL, 1, &count),
               PACKING_ERR_INVALID, "indices");
  assert_fails(context, packing_grid_near(grid, &at, 0, NULL, 0, NULL),
               PACKING_ERR_INVALID, "count");
  at.y = (double)NAN;
  assert_fails(context, packing_grid_near(grid, &at, 0, NULL, 0, &count),
               PACKING_ERR_INVALID, "point");
  assert_fails(context, packing_grid_pairs(grid, (double)INFINITY, NULL, 0, &count),
               PACKING_ERR_INVALID, "gap");
  assert_fails(context, packing_grid_pairs(grid, 0, NULL, 3, &count), PACKING_ERR_INVALID,
               "pairs");
  assert_fails(context, packing_grid_pairs(grid, 0, NULL, 0, NULL), PACKING_ERR_INVALID,
               "count");
  assert_int_equal(count, 5);
  packing_grid_destroy(grid);
  free(p);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(far_clusters_cost_what_near_ones_do),
      cmocka_unit_test(a_runaway_is_found_alone),
      cmocka_unit_test(a_crowd_in_one_spot_meets_itself),
      cmocka_unit_test(a_giant_among_dwarfs_meets_each_once),
      cmocka_unit_test(queries_allocate_nothing),
      cmocka_unit_test(a_grid_outlives_what_it_was_made_from),
      cmocka_unit_test(creation_refuses_bad_input),
      cmocka_unit_test(queries_refuse_bad_input),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
