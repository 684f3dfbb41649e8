/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PARTICLES_INTERNAL_H
#define PACKING_PARTICLES_INTERNAL_H

/* The store, open to the placers of this library: they push checked particles one at a time. */

#include "base_internal.h"
#include <packing/particles.h>

enum { PACKING_I_USER_NAME_SIZE = 32 };

typedef struct packing_i_user_column {
  char name[PACKING_I_USER_NAME_SIZE];
  double *values;
} packing_i_user_column;

/* 32 bytes a particle, and those of the optional columns. */
struct packing_particles {
  packing_context *context;
  const packing_allocator *allocator;
  int dim;
  unsigned columns; /* sum of PACKING_COLUMN_ */
  size_t count;
  size_t capacity; /* entries that every column has room for */
  double *x;       /* the same blocks as column[PACKING_FIELD_X] and so on */
  double *y;
  double *z;
  double *r;
  int32_t *component; /* NULL where there is no such column */
  void *column[PACKING_FIELD_END];
  packing_i_user_column *user;
  size_t users;
};

/* What is known of a column. */
typedef struct packing_i_field_info {
  const char *name;
  unsigned flag;      /* PACKING_COLUMN_, 0 for what every store has */
  size_t size;        /* bytes an entry */
  double fill;        /* value for new particles; ids get their index */
  size_t view_offset; /* of its packing_column in packing_view */
} packing_i_field_info;

extern const packing_i_field_info packing_i_fields[PACKING_FIELD_END];

/* Room for one more at least; doubles. The store is as before on failure. */
packing_status packing_i_particles_grow(packing_particles *p, size_t least);

/* Defaults in the optional columns of particles [first, last). */
void packing_i_particles_fill(packing_particles *p, size_t first, size_t last);

/* Takes over the blocks of column[] into the typed pointers. */
void packing_i_particles_refresh(packing_particles *p);

/* Whether `count` entries of one field, `stride` bytes apart, may stand in the store. */
packing_status packing_i_particles_check(const packing_particles *p, packing_field field,
                                         const void *in, size_t stride, size_t count);

/* Appends a particle whose numbers the caller answers for: finite, r > 0, z = 0 in two
 * dimensions. Allocates only when the capacity is used up. */
static inline packing_status packing_i_particles_push(packing_particles *p, double x,
                                                      double y, double z, double r)
{
  const size_t i = p->count;
  if (i == p->capacity)
    PACKING_I_TRY(packing_i_particles_grow(p, i + 1));
  p->x[i] = x;
  p->y[i] = y;
  p->z[i] = z;
  p->r[i] = r;
  if (p->columns != 0 || p->users != 0)
    packing_i_particles_fill(p, i, i + 1);
  p->count = i + 1;
  return PACKING_OK;
}

#endif
