/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper's memory: taken when particles or pairs become more, never else. */
#include "stepper_internal.h"
#include <string.h>

/* An array with so many entries a particle. */
typedef struct array {
  size_t offset; /* of its pointer */
  size_t entries;
  size_t size;
} array;

#define ARRAY(field, entries)                                                            \
  {                                                                                      \
    offsetof(packing_dem, field), (entries), sizeof *((packing_dem *)NULL)->field        \
  }

static const array arrays[] = {
    ARRAY(position, PACKING_I_POSITION),
    ARRAY(built, PACKING_I_POSITION),
    ARRAY(motion, PACKING_I_MOTION),
    ARRAY(spare, PACKING_I_MOTION),
    ARRAY(force, PACKING_I_FORCE),
    ARRAY(id, 1),
    ARRAY(material, 1),
    ARRAY(spare_index, 1),
    ARRAY(cell, 1),
    ARRAY(near_wall, 1),
};

enum { ARRAYS = sizeof arrays / sizeof *arrays };

static void *address_of(packing_dem *dem, const array *a)
{
  return (char *)dem + a->offset;
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
  if (count <= dem->capacity)
    return PACKING_OK;
  const size_t capacity = count + count / 4 + 16;
  dem->capacity = 0; /* should an array be refused */
  for (int a = 0; a < ARRAYS; a++)
    PACKING_I_TRY(packing_i_dem_renew(dem, address_of(dem, &arrays[a]),
                                      capacity * arrays[a].entries, arrays[a].size));
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
  for (int a = 0; a < ARRAYS; a++) {
    void *block;
    memcpy(&block, address_of(dem, &arrays[a]), sizeof block);
    packing_i_free(dem->allocator, block);
  }
  packing_i_free(dem->allocator, dem->cell_start);
  packing_i_free(dem->allocator, dem->list_i);
  packing_i_free(dem->allocator, dem->list_j);
}

size_t packing_i_dem_room_bytes(const packing_dem *dem)
{
  size_t particle = 0;
  for (int a = 0; a < ARRAYS; a++)
    particle += arrays[a].entries * arrays[a].size;
  return dem->capacity * particle + dem->cell_capacity * sizeof *dem->cell_start +
         dem->list_capacity * 2 * sizeof *dem->list_i;
}
