/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The store of particles: creation, room, single particles. */
#include "particles_internal.h"
#include <math.h>
#include <string.h>

enum { ALL_COLUMNS = 63, FIRST_CAPACITY = 16 };

void packing_particles_def_fill(packing_particles_def *def, size_t size)
{
  packing_particles_def defaults = {0};
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_def(packing_context *context, const packing_particles_def *d)
{
  if (d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2 or 3", d->dim);
  if (d->columns > ALL_COLUMNS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "columns", PACKING_NO_INDEX,
                          "%u is not a sum of PACKING_COLUMN_", d->columns);
  if (d->capacity > SIZE_MAX / sizeof(double) / PACKING_FIELD_END)
    return packing_i_fail(context, PACKING_ERR_RANGE, "capacity", PACKING_NO_INDEX,
                          "%zu particles exceed the address space", d->capacity);
  return PACKING_OK;
}

static int is_present(const packing_particles *p, int field)
{
  const unsigned flag = packing_i_fields[field].flag;
  return flag == 0 || (p->columns & flag) != 0;
}

void packing_i_particles_refresh(packing_particles *p)
{
  p->x = p->column[PACKING_FIELD_X];
  p->y = p->column[PACKING_FIELD_Y];
  p->z = p->column[PACKING_FIELD_Z];
  p->r = p->column[PACKING_FIELD_R];
  p->component = p->column[PACKING_FIELD_COMPONENT];
}

/* Copies the first `count` entries into new blocks of `capacity`; all columns or none. */
static packing_status grow_to(packing_particles *p, size_t capacity)
{
  const size_t blocks = PACKING_FIELD_END + p->users;
  void **fresh = packing_i_calloc(p->allocator, blocks, sizeof *fresh);
  packing_status status = PACKING_OK;
  if (fresh == NULL)
    return packing_i_nomem(p->context);
  for (size_t b = 0; b < blocks && status == PACKING_OK; b++) {
    if (b < PACKING_FIELD_END && !is_present(p, (int)b))
      continue;
    const size_t size = b < PACKING_FIELD_END ? packing_i_fields[b].size : sizeof(double);
    const void *old =
        b < PACKING_FIELD_END ? p->column[b] : p->user[b - PACKING_FIELD_END].values;
    fresh[b] = packing_i_alloc(p->allocator, capacity, size);
    if (fresh[b] == NULL)
      status = packing_i_nomem(p->context);
    else if (p->count > 0)
      memcpy(fresh[b], old, p->count * size);
  }
  for (size_t b = 0; b < blocks && status == PACKING_OK; b++) {
    void *old = NULL;
    if (b < PACKING_FIELD_END) {
      old = p->column[b];
      p->column[b] = fresh[b];
    } else {
      old = p->user[b - PACKING_FIELD_END].values;
      p->user[b - PACKING_FIELD_END].values = fresh[b];
    }
    fresh[b] = old;
  }
  for (size_t b = 0; b < blocks; b++)
    packing_i_free(p->allocator, fresh[b]);
  packing_i_free(p->allocator, fresh);
  if (status == PACKING_OK) {
    p->capacity = capacity;
    packing_i_particles_refresh(p);
  }
  return status;
}

packing_status packing_i_particles_grow(packing_particles *p, size_t least)
{
  if (least <= p->capacity)
    return PACKING_OK;
  size_t capacity = p->capacity > SIZE_MAX / 2 ? SIZE_MAX : p->capacity * 2;
  if (capacity < FIRST_CAPACITY)
    capacity = FIRST_CAPACITY;
  return grow_to(p, capacity < least ? least : capacity);
}

packing_status packing_particles_create(packing_context *context,
                                        const packing_particles_def *def,
                                        packing_particles **particles)
{
  packing_particles_def d;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_particles, capacity, def, &d));
  PACKING_I_TRY(check_def(context, &d));
  if (particles == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "particles", PACKING_NO_INDEX,
                          "NULL");
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_particles *p = packing_i_calloc(allocator, 1, sizeof *p);
  if (p == NULL)
    return packing_i_nomem(context);
  p->context = packing_i_context_hold(context);
  p->allocator = allocator;
  p->dim = d.dim;
  p->columns = d.columns;
  if (d.capacity > 0) {
    const packing_status status = grow_to(p, d.capacity);
    if (status != PACKING_OK) {
      packing_particles_destroy(p);
      return status;
    }
  }
  *particles = p;
  return PACKING_OK;
}

void packing_particles_destroy(packing_particles *particles)
{
  if (particles == NULL)
    return;
  packing_context *context = particles->context;
  const packing_allocator *allocator = particles->allocator;
  for (int f = 0; f < PACKING_FIELD_END; f++)
    packing_i_free(allocator, particles->column[f]);
  for (size_t u = 0; u < particles->users; u++)
    packing_i_free(allocator, particles->user[u].values);
  packing_i_free(allocator, particles->user);
  packing_i_free(allocator, particles);
  packing_context_destroy(context);
}

size_t packing_particles_count(const packing_particles *particles)
{
  return particles == NULL ? 0 : particles->count;
}

int packing_particles_dim(const packing_particles *particles)
{
  return particles == NULL ? 0 : particles->dim;
}

unsigned packing_particles_columns(const packing_particles *particles)
{
  return particles == NULL ? 0 : particles->columns;
}

packing_status packing_particles_reserve(packing_particles *particles, size_t capacity)
{
  if (particles == NULL)
    return PACKING_ERR_INVALID;
  return capacity <= particles->capacity ? PACKING_OK : grow_to(particles, capacity);
}

packing_status packing_particles_add(packing_particles *particles, packing_vec3 centre,
                                     double r, size_t *index)
{
  if (particles == NULL)
    return PACKING_ERR_INVALID;
  packing_context *context = particles->context;
  PACKING_I_TRY(packing_i_check_finite(context, "centre.x", centre.x));
  PACKING_I_TRY(packing_i_check_finite(context, "centre.y", centre.y));
  PACKING_I_TRY(packing_i_check_finite(context, "centre.z", centre.z));
  if (particles->dim == 2 && centre.z != 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "centre.z", PACKING_NO_INDEX,
                          "%g, must be 0 in two dimensions", centre.z);
  PACKING_I_TRY(packing_i_check_positive(context, "r", r));
  PACKING_I_TRY(packing_i_particles_push(particles, centre.x, centre.y, centre.z, r));
  if (index != NULL)
    *index = particles->count - 1;
  return PACKING_OK;
}

void packing_particles_truncate(packing_particles *particles, size_t count)
{
  if (particles != NULL && count < particles->count)
    particles->count = count;
}

size_t packing_particles_bytes(const packing_particles *particles)
{
  if (particles == NULL)
    return 0;
  size_t each = particles->users * sizeof(double);
  for (int f = 0; f < PACKING_FIELD_END; f++)
    each += is_present(particles, f) ? packing_i_fields[f].size : 0;
  return sizeof *particles + particles->users * sizeof *particles->user +
         particles->capacity * each;
}
