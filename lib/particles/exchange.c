/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The store and the arrays of others: views out, views in, removal. */
#include "particles_internal.h"
#include "view.h"

static const packing_column *column_of(const packing_view *view, int field)
{
  return (const packing_column *)(const void *)((const char *)view +
                                                packing_i_fields[field].view_offset);
}

/* Whether a column lies in the store's own memory, which growing would take away. */
static int is_own(const packing_particles *p, const packing_column *c)
{
  const uintptr_t at = (uintptr_t)c->data;
  for (int f = 0; f < PACKING_FIELD_END; f++) {
    const uintptr_t from = (uintptr_t)p->column[f];
    if (from != 0 && at >= from && at < from + p->capacity * packing_i_fields[f].size)
      return 1;
  }
  return 0;
}

/* What a view must be before any of it is copied. */
static packing_status check_view(const packing_particles *p, const packing_view *view,
                                 packing_view *v)
{
  if (!packing_i_view_read(view, v))
    return packing_i_fail(p->context, PACKING_ERR_INVALID, "view", PACKING_NO_INDEX,
                          "NULL, not initialised, or x, y or r is missing");
  for (int f = 0; f < PACKING_FIELD_END; f++) {
    const packing_column *c = column_of(v, f);
    const unsigned flag = packing_i_fields[f].flag;
    if (v->count > 0 && is_own(p, c))
      return packing_i_fail(p->context, PACKING_ERR_INVALID, "view", PACKING_NO_INDEX,
                            "shows this very store");
    if (c->data != NULL && (flag == 0 || (p->columns & flag) != 0))
      PACKING_I_TRY(
          packing_i_particles_check(p, (packing_field)f, c->data, c->stride, v->count));
  }
  return PACKING_OK;
}

/* Writes the view over entries from `first` on; there is room. */
static void copy_in(packing_particles *p, const packing_view *v, size_t first)
{
  packing_i_particles_fill(p, first, first + v->count);
  if (v->z.data == NULL)
    for (size_t i = 0; i < v->count; i++)
      p->z[first + i] = 0.0;
  for (int f = 0; f < PACKING_FIELD_END; f++) {
    const packing_column *c = column_of(v, f);
    if (c->data == NULL || p->column[f] == NULL)
      continue;
    const size_t size = packing_i_fields[f].size;
    char *to = (char *)p->column[f] + first * size;
    for (size_t i = 0; i < v->count; i++)
      memcpy(to + i * size, (const char *)c->data + i * c->stride, size);
  }
}

/* Keeps the first `keep` particles and puts those of the view behind them. */
static packing_status take(packing_particles *p, const packing_view *view, size_t keep)
{
  packing_view v;
  PACKING_I_TRY(check_view(p, view, &v));
  if (v.count > SIZE_MAX - keep)
    return packing_i_nomem(p->context);
  PACKING_I_TRY(packing_i_particles_grow(p, keep + v.count));
  if (v.count > 0)
    copy_in(p, &v, keep);
  p->count = keep + v.count;
  return PACKING_OK;
}

packing_status packing_particles_append(packing_particles *particles,
                                        const packing_view *view)
{
  return particles == NULL ? PACKING_ERR_INVALID
                           : take(particles, view, particles->count);
}

packing_status packing_particles_assign(packing_particles *particles,
                                        const packing_view *view)
{
  return particles == NULL ? PACKING_ERR_INVALID : take(particles, view, 0);
}

void packing_particles_view(const packing_particles *particles, packing_view *view)
{
  packing_view_init(view);
  if (particles == NULL)
    return;
  view->count = particles->count;
  for (int f = 0; f < PACKING_FIELD_END; f++) {
    const packing_column c = {particles->column[f], packing_i_fields[f].size};
    if (c.data != NULL)
      memcpy((char *)view + packing_i_fields[f].view_offset, &c, sizeof c);
  }
}

/* Moves the entries that stay to the front. */
static void close_gaps(void *block, size_t size, size_t count, const size_t *gaps,
                       size_t gap_count)
{
  char *bytes = block;
  size_t to = gaps[0];
  for (size_t g = 0; g < gap_count; g++) {
    const size_t from = gaps[g] + 1;
    const size_t end = g + 1 < gap_count ? gaps[g + 1] : count;
    memmove(bytes + to * size, bytes + from * size, (end - from) * size);
    to += end - from;
  }
}

packing_status packing_particles_remove(packing_particles *particles,
                                        const size_t *indices, size_t count)
{
  if (particles == NULL)
    return PACKING_ERR_INVALID;
  if (count == 0)
    return PACKING_OK;
  if (indices == NULL)
    return packing_i_fail(particles->context, PACKING_ERR_INVALID, "indices",
                          PACKING_NO_INDEX, "NULL");
  for (size_t k = 0; k < count; k++)
    if (indices[k] >= particles->count || (k > 0 && indices[k] <= indices[k - 1]))
      return packing_i_fail(particles->context, PACKING_ERR_RANGE, "indices", k,
                            "entry %zu is %zu: must rise and stay below %zu", k,
                            indices[k], particles->count);
  for (int f = 0; f < PACKING_FIELD_END; f++)
    if (particles->column[f] != NULL)
      close_gaps(particles->column[f], packing_i_fields[f].size, particles->count,
                 indices, count);
  for (size_t u = 0; u < particles->users; u++)
    close_gaps(particles->user[u].values, sizeof(double), particles->count, indices,
               count);
  particles->count -= count;
  return PACKING_OK;
}
