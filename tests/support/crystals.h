/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_CRYSTALS_H
#define PACKING_TEST_CRYSTALS_H

/* Crystals with known answers, in periodic cells of any number of unit cells. */

#include "test.h"

typedef struct test_crystal {
  const char *name;
  int dim;
  double edge[3]; /* of the unit cell, in diameters */
  int count;      /* particles in it */
  double at[4][3];
  size_t contacts; /* of each particle */
  double fraction; /* volume fraction (2D: area) */
  double fabric[3];
} test_crystal;

enum { TEST_CRYSTALS = 7 };

const test_crystal *test_crystal_of(int k);

/* `nx` ny nz unit cells of particles of diameter d. The arrays are freed by
 * test_crystal_free(). */
typedef struct test_crystal_pack {
  double *numbers;
  packing_view view;
  packing_domain *cell;
} test_crystal_pack;

test_crystal_pack test_crystal_make(const test_crystal *crystal, const int cells[3],
                                    double d);
void test_crystal_free(test_crystal_pack *pack);

#endif
