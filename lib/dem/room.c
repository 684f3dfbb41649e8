/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper's memory: taken when particles or pairs become more, never else. */
#include "stepper_internal.h"
#include <string.h>

typedef struct array {
  void *block;    /* address of the pointer */
  size_t entries; /* a particle */
  size_t size;
} array;

enum { ARRAYS = 10 };

static void list_arrays(packing_dem *dem, array all[ARRAYS])
{
  const array arrays[ARRAYS] = {
      {&dem->position, PACKING_I_POSITION, sizeof(double)},
      {&dem->built, PACKING_I_POSITION, sizeof(double)},
      {&dem->motion, PACKING_I_MOTION, sizeof(double)},
      {&dem->spare, PACKING_I_MOTION, sizeof(double)},
      {&dem->force, PACKING_I_FORCE, sizeof(double)},
      {&dem->id, 1, sizeof(uint32_t)},
      {&dem->material, 1, sizeof(uint32_t)},
      {&dem->spare_index, 1, sizeof(uint32_t)},
      {&dem->cell, 1, sizeof(uint32_t)},
      {&dem->near_wall, 1, sizeof(uint32_t)},
  };
  memcpy(all, arrays, sizeof arrays);
}

packing_status packing_i_dem_renew(packing_dem *dem, void *block, size_t count,
                                   size_t size)
{
  void *old, *bigger = packing_i_alloc(dem->allocator, count, size);
  if (bigger == NULL)
    return packing_i_nomem(dem->context);
  memcpy(&old, block, sizeof old);
  packing_i_free(dem->allocator, old);
  memcpy(block, &bigger, sizeof bigger);
  return PACKING_OK;
}

packing_status packing_i_dem_grow(packing_dem *dem, size_t count)
{
  array all[ARRAYS];
  if (count <= dem->capacity)
    return PACKING_OK;
  const size_t capacity = count + count / 4 + 16;
  dem->capacity = 0; /* should an array be refused */
  list_arrays(dem, all);
  for (int a = 0; a < ARRAYS; a++)
    PACKING_I_TRY(
        packing_i_dem_renew(dem, all[a].block, capacity * all[a].entries, all[a].size));
  dem->capacity = capacity;
  return PACKING_OK;
}

packing_status packing_i_dem_grow_list(packing_dem *dem, size_t entries)
{
  const size_t capacity = entries + entries / 4;
  dem->list_capacity = 0;
  PACKING_I_TRY(packing_i_dem_renew(dem, &dem->list_i, capacity, sizeof *dem->list_i));
  PACKING_I_TRY(packing_i_dem_renew(dem, &dem->list_j, capacity, sizeof *dem->list_j));
  dem->list_capacity = capacity;
  return PACKING_OK;
}

void packing_i_dem_release_arrays(packing_dem *dem)
{
  array all[ARRAYS];
  list_arrays(dem, all);
  for (int a = 0; a < ARRAYS; a++) {
    void *block;
    memcpy(&block, all[a].block, sizeof block);
    packing_i_free(dem->allocator, block);
  }
  packing_i_free(dem->allocator, dem->cell_start);
  packing_i_free(dem->allocator, dem->list_i);
  packing_i_free(dem->allocator, dem->list_j);
}

size_t packing_i_dem_room_bytes(const packing_dem *dem)
{
  size_t particle = 0;
  array all[ARRAYS];
  packing_dem copy = *dem; /* to ask for the arrays' shapes only */
  list_arrays(&copy, all);
  for (int a = 0; a < ARRAYS; a++)
    particle += all[a].entries * all[a].size;
  return dem->capacity * particle + dem->cell_capacity * sizeof *dem->cell_start +
         dem->list_capacity * 2 * sizeof *dem->list_i;
}
