/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the stepper into the store. */
#include "stepper_internal.h"

void packing_i_dem_save(const packing_dem *dem)
{
  packing_particles *p = dem->particles;
  for (size_t s = 0; s < dem->count; s++) {
    const size_t i = dem->id[s];
    const double *x = dem->position + PACKING_I_POSITION * s;
    const double *v = dem->motion + PACKING_I_MOTION * s;
    packing_vec3 at = packing_i_vec(x[0], x[1], x[2]);
    packing_domain_wrap(dem->domain, &at);
    p->x[i] = at.x;
    p->y[i] = at.y;
    p->z[i] = at.z;
    for (int k = 0; k < 3; k++) {
      ((double *)p->column[PACKING_FIELD_VX + k])[i] = v[k];
      ((double *)p->column[PACKING_FIELD_WX + k])[i] = v[4 + k];
    }
  }
}
