/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Batches made ready for laws, and laws at work on them. */
#include "stepper_internal.h"

void packing_i_batch_repeat(double *const *columns, size_t width, size_t count)
{
  for (size_t c = 0; c < width; c++)
    for (size_t k = count; k % 8 != 0; k++)
      columns[c][k] = columns[c][count - 1];
}

void packing_i_dem_apply(const packing_dem *dem, const packing_law *only,
                         const packing_pair_material *table, double *history,
                         packing_i_batch *b)
{
  packing_contact_batch batch = {
      .struct_size = sizeof batch,
      .count = b->count,
      .dt = dem->dt,
      .nx = b->dx,
      .ny = b->dy,
      .nz = b->dz,
      .distance = b->distance,
      .overlap = b->overlap,
      .reduced_r = b->reduced_r,
      .reduced_m = b->reduced_m,
      .approach = b->approach,
      .ux = b->ux,
      .uy = b->uy,
      .uz = b->uz,
      .pair = dem->one_material ? NULL : b->pair,
      .materials = table,
      .normal = b->normal,
      .fx = b->fx,
      .fy = b->fy,
      .fz = b->fz,
      .stride = PACKING_I_ROOM,
  };
  for (size_t l = 0; l < dem->law_count; l++) {
    const packing_law *law = dem->laws[l];
    if (only == NULL ? law->reach > 0 : law != only)
      continue;
    batch.history =
        law->history_size > 0 ? history + dem->history.offset[l] * PACKING_I_ROOM : NULL;
    dem->work[l](law->user, &batch);
  }
}
