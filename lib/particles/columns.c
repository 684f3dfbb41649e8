/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns of the store, one at a time: what they are, adding, reading, writing. */
#define _POSIX_C_SOURCE 200809L
#include "particles_internal.h"
#include <math.h>
#include <string.h>

#define NUMBER(name, flag, fill)                                                         \
  {                                                                                      \
#name, flag, sizeof(double), fill, offsetof(packing_view, name)                      \
  }
#define INTEGER(name, flag, type, fill)                                                  \
  {                                                                                      \
#name, flag, sizeof(type), fill, offsetof(packing_view, name)                        \
  }

const packing_i_field_info packing_i_fields[PACKING_FIELD_END] = {
    [PACKING_FIELD_X] = NUMBER(x, 0, 0.0),
    [PACKING_FIELD_Y] = NUMBER(y, 0, 0.0),
    [PACKING_FIELD_Z] = NUMBER(z, 0, 0.0),
    [PACKING_FIELD_R] = NUMBER(r, 0, 0.0),
    [PACKING_FIELD_ID] = INTEGER(id, PACKING_COLUMN_ID, int64_t, 0.0),
    [PACKING_FIELD_TYPE] = INTEGER(type, PACKING_COLUMN_TYPE, int32_t, 1.0),
    [PACKING_FIELD_COMPONENT] =
        INTEGER(component, PACKING_COLUMN_COMPONENT, int32_t, 0.0),
    [PACKING_FIELD_VX] = NUMBER(vx, PACKING_COLUMN_VELOCITY, 0.0),
    [PACKING_FIELD_VY] = NUMBER(vy, PACKING_COLUMN_VELOCITY, 0.0),
    [PACKING_FIELD_VZ] = NUMBER(vz, PACKING_COLUMN_VELOCITY, 0.0),
    [PACKING_FIELD_WX] = NUMBER(wx, PACKING_COLUMN_SPIN, 0.0),
    [PACKING_FIELD_WY] = NUMBER(wy, PACKING_COLUMN_SPIN, 0.0),
    [PACKING_FIELD_WZ] = NUMBER(wz, PACKING_COLUMN_SPIN, 0.0),
    [PACKING_FIELD_QW] = NUMBER(qw, PACKING_COLUMN_ORIENTATION, 1.0),
    [PACKING_FIELD_QX] = NUMBER(qx, PACKING_COLUMN_ORIENTATION, 0.0),
    [PACKING_FIELD_QY] = NUMBER(qy, PACKING_COLUMN_ORIENTATION, 0.0),
    [PACKING_FIELD_QZ] = NUMBER(qz, PACKING_COLUMN_ORIENTATION, 0.0),
};

static int is_integer(packing_field field)
{
  return field == PACKING_FIELD_ID || field == PACKING_FIELD_TYPE ||
         field == PACKING_FIELD_COMPONENT;
}

static void fill_field(void *block, packing_field field, size_t first, size_t last)
{
  const double fill = packing_i_fields[field].fill;
  if (field == PACKING_FIELD_ID) {
    int64_t *ids = block;
    for (size_t i = first; i < last; i++)
      ids[i] = (int64_t)i;
  } else if (is_integer(field)) {
    int32_t *integers = block;
    for (size_t i = first; i < last; i++)
      integers[i] = (int32_t)fill;
  } else {
    double *numbers = block;
    for (size_t i = first; i < last; i++)
      numbers[i] = fill;
  }
}

void packing_i_particles_fill(packing_particles *p, size_t first, size_t last)
{
  for (int f = PACKING_FIELD_ID; f < PACKING_FIELD_END; f++)
    if (p->column[f] != NULL)
      fill_field(p->column[f], (packing_field)f, first, last);
  for (size_t u = 0; u < p->users; u++)
    for (size_t i = first; i < last; i++)
      p->user[u].values[i] = 0.0;
}

packing_status packing_particles_add_columns(packing_particles *particles,
                                             unsigned columns)
{
  void *fresh[PACKING_FIELD_END] = {NULL};
  packing_status status = PACKING_OK;
  if (particles == NULL)
    return PACKING_ERR_INVALID;
  if (columns > 2 * PACKING_COLUMN_ORIENTATION - 1)
    return packing_i_fail(particles->context, PACKING_ERR_RANGE, "columns",
                          PACKING_NO_INDEX, "%u is not a sum of PACKING_COLUMN_",
                          columns);
  const unsigned missing = columns & ~particles->columns;
  for (int f = 0; f < PACKING_FIELD_END && particles->capacity > 0; f++) {
    if ((packing_i_fields[f].flag & missing) == 0)
      continue;
    fresh[f] = packing_i_alloc(particles->allocator, particles->capacity,
                               packing_i_fields[f].size);
    if (fresh[f] == NULL) {
      status = packing_i_nomem(particles->context);
      goto out;
    }
    fill_field(fresh[f], (packing_field)f, 0, particles->count);
  }
  for (int f = 0; f < PACKING_FIELD_END; f++)
    if (fresh[f] != NULL) {
      particles->column[f] = fresh[f];
      fresh[f] = NULL;
    }
  particles->columns |= missing;
  packing_i_particles_refresh(particles);
out:
  for (int f = 0; f < PACKING_FIELD_END; f++)
    packing_i_free(particles->allocator, fresh[f]);
  return status;
}

packing_status packing_i_particles_check(const packing_particles *p, packing_field field,
                                         const void *in, size_t stride, size_t count)
{
  const char *name = packing_i_fields[field].name;
  if (is_integer(field))
    return PACKING_OK;
  for (size_t i = 0; i < count; i++) {
    double v;
    memcpy(&v, (const char *)in + i * stride, sizeof v);
    if (!isfinite(v))
      return packing_i_fail(p->context, PACKING_ERR_INVALID, name, i,
                            "%g of particle %zu is not a finite number", v, i);
    if (field == PACKING_FIELD_R && !(v > 0))
      return packing_i_fail(p->context, PACKING_ERR_RANGE, name, i,
                            "%g of particle %zu must be above 0", v, i);
    if (field == PACKING_FIELD_Z && p->dim == 2 && v != 0)
      return packing_i_fail(p->context, PACKING_ERR_INVALID, name, i,
                            "%g of particle %zu must be 0 in two dimensions", v, i);
  }
  return PACKING_OK;
}

/* Whether a column of the store can be copied to or from `memory`. */
static packing_status check_column(const packing_particles *p, packing_field field,
                                   const void *memory, size_t stride)
{
  if (p == NULL)
    return PACKING_ERR_INVALID;
  if ((int)field < 0 || field >= PACKING_FIELD_END)
    return packing_i_fail(p->context, PACKING_ERR_RANGE, "field", PACKING_NO_INDEX,
                          "%d is no column", (int)field);
  const packing_i_field_info *info = &packing_i_fields[field];
  if (info->flag != 0 && (p->columns & info->flag) == 0)
    return packing_i_fail(p->context, PACKING_ERR_INVALID, "field", PACKING_NO_INDEX,
                          "the store has no column %s", info->name);
  if (stride < info->size)
    return packing_i_fail(p->context, PACKING_ERR_RANGE, "stride", PACKING_NO_INDEX,
                          "%zu bytes, an entry of %s has %zu", stride, info->name,
                          info->size);
  if (memory == NULL && p->count > 0)
    return packing_i_fail(p->context, PACKING_ERR_INVALID, info->name, PACKING_NO_INDEX,
                          "NULL for %zu particles", p->count);
  return PACKING_OK;
}

packing_status packing_particles_extract(const packing_particles *particles,
                                         packing_field field, void *out, size_t stride)
{
  PACKING_I_TRY(check_column(particles, field, out, stride));
  const size_t size = packing_i_fields[field].size;
  const char *from = particles->column[field];
  for (size_t i = 0; i < particles->count; i++)
    memcpy((char *)out + i * stride, from + i * size, size);
  return PACKING_OK;
}

packing_status packing_particles_set(packing_particles *particles, packing_field field,
                                     const void *in, size_t stride)
{
  PACKING_I_TRY(check_column(particles, field, in, stride));
  PACKING_I_TRY(
      packing_i_particles_check(particles, field, in, stride, particles->count));
  const size_t size = packing_i_fields[field].size;
  char *to = particles->column[field];
  for (size_t i = 0; i < particles->count; i++)
    memmove(to + i * size, (const char *)in + i * stride, size);
  return PACKING_OK;
}

static packing_i_user_column *find_user(packing_particles *p, const char *name)
{
  for (size_t u = 0; u < p->users; u++)
    if (strcmp(p->user[u].name, name) == 0)
      return &p->user[u];
  return NULL;
}

packing_status packing_particles_add_user_column(packing_particles *particles,
                                                 const char *name)
{
  packing_i_user_column *user = NULL;
  double *values = NULL;
  if (particles == NULL)
    return PACKING_ERR_INVALID;
  const size_t length = name == NULL ? 0 : strnlen(name, PACKING_I_USER_NAME_SIZE);
  if (length == 0 || length == PACKING_I_USER_NAME_SIZE)
    return packing_i_fail(particles->context, PACKING_ERR_INVALID, "name",
                          PACKING_NO_INDEX, "must have 1 to %d bytes",
                          PACKING_I_USER_NAME_SIZE - 1);
  if (find_user(particles, name) != NULL)
    return packing_i_fail(particles->context, PACKING_ERR_INVALID, "name",
                          PACKING_NO_INDEX, "such a user column is there already");
  user = packing_i_calloc(particles->allocator, particles->users + 1, sizeof *user);
  values = packing_i_calloc(particles->allocator, particles->capacity, sizeof *values);
  if (user == NULL || values == NULL) {
    packing_i_free(particles->allocator, user);
    packing_i_free(particles->allocator, values);
    return packing_i_nomem(particles->context);
  }
  if (particles->users > 0)
    memcpy(user, particles->user, particles->users * sizeof *user);
  memcpy(user[particles->users].name, name, length);
  user[particles->users].values = values;
  packing_i_free(particles->allocator, particles->user);
  particles->user = user;
  particles->users++;
  return PACKING_OK;
}

packing_status packing_particles_user_column(packing_particles *particles,
                                             const char *name, double **values)
{
  if (particles == NULL)
    return PACKING_ERR_INVALID;
  if (name == NULL || values == NULL)
    return packing_i_fail(particles->context, PACKING_ERR_INVALID,
                          name == NULL ? "name" : "values", PACKING_NO_INDEX, "NULL");
  packing_i_user_column *column = find_user(particles, name);
  if (column == NULL)
    return packing_i_fail(particles->context, PACKING_ERR_INVALID, "name",
                          PACKING_NO_INDEX, "there is no such user column");
  *values = column->values;
  return PACKING_OK;
}
