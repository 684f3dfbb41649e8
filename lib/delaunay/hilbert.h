/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_HILBERT_H
#define PACKING_HILBERT_H

/* In which order points are inserted. */

#include "delaunay/delaunay_internal.h"

/* order[k] is the point that comes k-th; `points` lie in [-1, 1]. */
packing_status packing_i_delaunay_order(packing_context *context, int dim,
                                        const packing_i_delaunay_point *points,
                                        uint32_t count, uint32_t *order);

#endif
