/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_VIEW_H
#define PACKING_VIEW_H

/* Reading a packing_view. */

#include <packing/types.h>
#include <string.h>

static inline double packing_i_column_double(const packing_column *c, size_t i)
{
  return *(const double *)(const void *)((const char *)c->data + i * c->stride);
}

/* The centre of particle i; z is 0 where the view has none. */
static inline packing_vec3 packing_i_view_centre(const packing_view *v, size_t i)
{
  packing_vec3 p = {packing_i_column_double(&v->x, i), packing_i_column_double(&v->y, i),
                    v->z.data == NULL ? 0.0 : packing_i_column_double(&v->z, i)};
  return p;
}

static inline double packing_i_view_r(const packing_view *v, size_t i)
{
  return packing_i_column_double(&v->r, i);
}

/* A view of any age as today's. 0 when its size is not set or a needed column is absent. */
static inline int packing_i_view_read(const packing_view *from, packing_view *to)
{
  packing_view_init(to);
  if (from == NULL || from->struct_size < offsetof(packing_view, id))
    return 0;
  const size_t size = from->struct_size < sizeof *to ? from->struct_size : sizeof *to;
  memcpy(to, from, size);
  to->struct_size = sizeof *to;
  return to->count == 0 ||
         (to->x.data != NULL && to->y.data != NULL && to->r.data != NULL);
}

#endif
