/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The seven crystals; lengths in diameters, so neighbours are 1 apart. */
#include "crystals.h"

#define ROOT_2 1.4142135623730950488
#define ROOT_3 1.7320508075688772935
#define ROOT_6 2.4494897427831780982
#define PI 3.14159265358979323846

static const test_crystal crystals[TEST_CRYSTALS] = {
    {"simple cubic", 3, {1, 1, 1}, 1, {{0, 0, 0}}, 6, PI / 6, {1. / 3, 1. / 3, 1. / 3}},
    {"body-centred cubic",
     3,
     {2 / ROOT_3, 2 / ROOT_3, 2 / ROOT_3},
     2,
     {{0, 0, 0}, {1 / ROOT_3, 1 / ROOT_3, 1 / ROOT_3}},
     8,
     PI *ROOT_3 / 8,
     {1. / 3, 1. / 3, 1. / 3}},
    {"face-centred cubic",
     3,
     {ROOT_2, ROOT_2, ROOT_2},
     4,
     {{0, 0, 0},
      {ROOT_2 / 2, ROOT_2 / 2, 0},
      {ROOT_2 / 2, 0, ROOT_2 / 2},
      {0, ROOT_2 / 2, ROOT_2 / 2}},
     12,
     PI / (3 * ROOT_2),
     {1. / 3, 1. / 3, 1. / 3}},
    {"hexagonal close-packed",
     3,
     {1, ROOT_3, 2 * ROOT_6 / 3},
     4,
     {{0, 0, 0},
      {0.5, ROOT_3 / 2, 0},
      {0.5, ROOT_3 / 6, ROOT_6 / 3},
      {0, 2 * ROOT_3 / 3, ROOT_6 / 3}},
     12,
     PI / (3 * ROOT_2),
     {1. / 3, 1. / 3, 1. / 3}},
    {"simple hexagonal",
     3,
     {1, ROOT_3, 1},
     2,
     {{0, 0, 0}, {0.5, ROOT_3 / 2, 0}},
     8,
     PI / (3 * ROOT_3),
     {3. / 8, 3. / 8, 1. / 4}},
    {"square", 2, {1, 1, 0}, 1, {{0, 0, 0}}, 4, PI / 4, {0.5, 0.5, 0}},
    {"hexagonal",
     2,
     {1, ROOT_3, 0},
     2,
     {{0, 0, 0}, {0.5, ROOT_3 / 2, 0}},
     6,
     PI / (2 * ROOT_3),
     {0.5, 0.5, 0}}};

const test_crystal *test_crystal_of(int k)
{
  return &crystals[k];
}

test_crystal_pack test_crystal_make(const test_crystal *crystal, const int cells[3],
                                    double d)
{
  test_crystal_pack p;
  const int nz = crystal->dim == 2 ? 1 : cells[2], all = cells[0] * cells[1] * nz;
  const size_t count = (size_t)(all * crystal->count);
  double *x = malloc(4 * count * sizeof *x);
  assert_non_null(x);
  for (size_t i = 0; i < count; i++) {
    const int cell = (int)i / crystal->count;
    const double *at = crystal->at[i % (size_t)crystal->count];
    const int k[3] = {cell % cells[0], cell / cells[0] % cells[1],
                      cell / cells[0] / cells[1]};
    for (size_t a = 0; a < 3; a++)
      x[a * count + i] = d * (at[a] + crystal->edge[a] * k[a]);
    x[3 * count + i] = d / 2;
  }
  p.numbers = x;
  packing_view_init_arrays(&p.view, count, x, x + count, x + 2 * count, x + 3 * count);
  const double edge[3] = {d * crystal->edge[0] * cells[0],
                          d * crystal->edge[1] * cells[1], d * crystal->edge[2] * nz};
  p.cell = crystal->dim == 2 ? test_rectangle(edge[0], edge[1], 3)
                             : test_box(edge[0], edge[1], edge[2], 7);
  return p;
}

void test_crystal_free(test_crystal_pack *pack)
{
  free(pack->numbers);
  packing_domain_destroy(pack->cell);
}
