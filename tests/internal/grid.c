/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grid's own tools: sorting into rows, along rows, and keeping the smallest. */
#include "test.h"
#include "grid/grid_internal.h"

enum { COUNT = 3000 };

static uint64_t bits(packing_rng *rng, int width)
{
  return width == 0 ? 0 : packing_rng_bits(rng) >> (64 - width);
}

/* Keys of 0 to 44 bits: from no pass to four; equal keys keep their order. */
static void cells_sort_stably_whatever_their_spread(void **state)
{
  (void)state;
  static packing_i_grid_record records[COUNT], spare[COUNT];
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 3, PACKING_PURPOSE_USER, 0, &rng));
  for (int width_b = 0; width_b <= 44; width_b += 4)
    for (int width_c = 0; width_c <= 44; width_c += 11) {
      for (size_t i = 0; i < COUNT; i++) {
        records[i].key.b = bits(rng, width_b) + 5;
        records[i].c = bits(rng, width_c) + (UINT64_C(1) << 43);
        records[i].index = i;
      }
      packing_i_grid_sort_cells(records, spare, COUNT);
      for (size_t i = 1; i < COUNT; i++) {
        const packing_i_grid_record *a = &records[i - 1], *b = &records[i];
        assert_true(a->c < b->c ||
                    (a->c == b->c && (a->key.b < b->key.b ||
                                      (a->key.b == b->key.b && a->index < b->index))));
      }
    }
  packing_rng_destroy(rng);
}

static void rows_sort_stably_whatever_their_length(void **state)
{
  (void)state;
  static packing_i_grid_record records[COUNT], spare[COUNT];
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 4, PACKING_PURPOSE_USER, 0, &rng));
  for (size_t count = 0; count <= COUNT; count = count < 100 ? count + 1 : count * 3) {
    for (size_t i = 0; i < count; i++) {
      records[i].key.s = -2 + (double)packing_rng_below(rng, 1 + count / 2) / 7;
      records[i].index = i;
    }
    packing_i_grid_sort_row(records, spare, count);
    for (size_t i = 1; i < count; i++) {
      const packing_i_grid_record *a = &records[i - 1], *b = &records[i];
      assert_true(a->key.s < b->key.s || (a->key.s == b->key.s && a->index < b->index));
    }
  }
  packing_rng_destroy(rng);
}

static void the_heap_keeps_the_smallest(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 5, PACKING_PURPOSE_USER, 0, &rng));
  for (size_t capacity = 0; capacity < 40; capacity++) {
    size_t heap[40], held = 0;
    char offered[200] = {0};
    for (int k = 0; k < 60; k++) {
      const size_t value = (size_t)packing_rng_below(rng, 200);
      if (offered[value])
        continue;
      offered[value] = 1;
      packing_i_heap_offer(heap, capacity, &held, value);
    }
    packing_i_heap_sort(heap, held);
    size_t next = 0;
    for (size_t value = 0; value < 200 && next < held; value++)
      if (offered[value])
        assert_int_equal(heap[next++], value);
    assert_int_equal(held, next);
  }
  packing_rng_destroy(rng);
}

/* Cells of an octave nest in those of a coarser one, on open and on periodic axes, at their
 * borders and beyond them. */
static void cells_nest(void **state)
{
  (void)state;
  packing_grid grid = {.deepest = 20};
  packing_i_grid_axis open = {.half = (double)INFINITY, .width = 0.7};
  packing_i_grid_axis ring = {
      .lo = -1, .hi = 2, .period = 3, .half = 1.5, .width = 0.6, .cells = 5};
  const double at[] = {-1e300,
                       -1e9,
                       -1.7,
                       -1,
                       -0.7,
                       -0.0,
                       0.35,
                       0.6999999999999999,
                       0.7,
                       1.4,
                       1.9999999999999998,
                       5e6,
                       1e12,
                       1e300};
  for (size_t k = 0; k < sizeof at / sizeof at[0]; k++)
    for (int octave = 1; octave <= 20; octave++)
      for (int coarser = 0; coarser < octave; coarser++) {
        assert_int_equal(packing_i_grid_cell(&grid, &open, at[k], octave) >>
                             (octave - coarser),
                         packing_i_grid_cell(&grid, &open, at[k], coarser));
        if (at[k] >= -1 && at[k] < 2)
          assert_int_equal(packing_i_grid_cell(&grid, &ring, at[k], octave) >>
                               (octave - coarser),
                           packing_i_grid_cell(&grid, &ring, at[k], coarser));
      }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cells_sort_stably_whatever_their_spread),
      cmocka_unit_test(rows_sort_stably_whatever_their_length),
      cmocka_unit_test(the_heap_keeps_the_smallest),
      cmocka_unit_test(cells_nest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
