/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "place_index.h"

void packing_i_index_init(packing_i_index *index, packing_context *context,
                          const packing_domain *domain, double top_r, size_t expected)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const unsigned periodic = packing_domain_periodic(domain);
  *index = (packing_i_index){0};
  index->context = context;
  index->lo = b.lo;
  index->width = packing_i_sub(b.hi, b.lo);
  index->period = packing_i_vec(periodic & PACKING_PERIODIC_X ? index->width.x : 0,
                                periodic & PACKING_PERIODIC_Y ? index->width.y : 0,
                                periodic & PACKING_PERIODIC_Z ? index->width.z : 0);
  index->top_r = top_r;
  index->expected = expected;
}

void packing_i_index_release(packing_i_index *index)
{
  const packing_allocator *allocator = packing_i_allocator(index->context);
  for (int l = 0; l < PACKING_I_INDEX_LEVELS; l++)
    packing_i_free(allocator, index->level[l].head);
  packing_i_free(allocator, index->entry);
}

/* Level l holds top_r / 2^(l+1) < r <= top_r / 2^l; the last one all that is smaller. */
static int level_of(const packing_i_index *index, double r)
{
  int level = 0;
  for (double half = index->top_r / 2; r <= half && level < PACKING_I_INDEX_LEVELS - 1;
       half /= 2)
    level++;
  return level;
}

static double cells_along(double width, double edge)
{
  const double n = floor(width / edge);
  return n < 1 ? 1 : n;
}

/* Sets up the cells of a level when its first particle comes. */
static packing_status level_start(packing_i_index *index, int l)
{
  packing_i_index_level *level = &index->level[l];
  const size_t expected = index->expected > index->count ? index->expected : index->count;
  const double most = 8.0 * (double)expected + 4096.0;
  const double w[3] = {index->width.x, index->width.y, index->width.z};
  double n[3], edge = ldexp(2 * index->top_r, -l);
  for (;; edge *= 1.25) {
    for (int axis = 0; axis < 3; axis++)
      n[axis] = cells_along(w[axis], edge);
    if (n[0] * n[1] * n[2] <= most)
      break;
  }
  uint32_t *head = packing_i_calloc(packing_i_allocator(index->context),
                                    (size_t)(n[0] * n[1] * n[2]), sizeof *head);
  if (head == NULL)
    return packing_i_nomem(index->context);
  double per[3];
  for (int axis = 0; axis < 3; axis++) {
    level->n[axis] = (size_t)n[axis];
    per[axis] = w[axis] > 0 ? n[axis] / w[axis] : 0;
  }
  level->per_edge = packing_i_vec(per[0], per[1], per[2]);
  level->head = head;
  return PACKING_OK;
}

packing_status packing_i_index_reserve(packing_i_index *index, double r)
{
  const int l = level_of(index, r);
  if (index->level[l].head == NULL)
    PACKING_I_TRY(level_start(index, l));
  if (index->count < index->capacity)
    return PACKING_OK;
  size_t grown = index->capacity + index->capacity / 2 + 256;
  if (grown < index->expected)
    grown = index->expected; /* at once: growing copies all that is there */
  if (grown > UINT32_MAX - 1)
    return packing_i_nomem(index->context);
  packing_i_index_entry *entry =
      packing_i_regrow(packing_i_allocator(index->context), index->entry, index->count,
                       grown, sizeof *entry);
  if (entry == NULL)
    return packing_i_nomem(index->context);
  index->entry = entry;
  index->capacity = grown;
  return PACKING_OK;
}

/* The cell of a coordinate, the nearest for those outside. */
static size_t cell_along(double x, double lo, double per_edge, size_t n)
{
  const double at = (x - lo) * per_edge;
  if (!(at > 0))
    return 0;
  return at < (double)n ? (size_t)at : n - 1;
}

void packing_i_index_insert(packing_i_index *index, packing_vec3 p, double r)
{
  packing_i_index_level *level = &index->level[level_of(index, r)];
  const size_t ix = cell_along(p.x, index->lo.x, level->per_edge.x, level->n[0]);
  const size_t iy = cell_along(p.y, index->lo.y, level->per_edge.y, level->n[1]);
  const size_t iz = cell_along(p.z, index->lo.z, level->per_edge.z, level->n[2]);
  uint32_t *head = &level->head[(iz * level->n[1] + iy) * level->n[0] + ix];
  index->entry[index->count] = (packing_i_index_entry){p.x, p.y, p.z, r, *head};
  *head = (uint32_t)++index->count;
  level->count++;
  if (r > level->largest_r)
    level->largest_r = r;
}

static int chain_free(const packing_i_index *index, uint32_t at, packing_vec3 p, double r)
{
  while (at != 0) {
    const packing_i_index_entry *q = &index->entry[at - 1];
    const double dx = q->x - p.x, dy = q->y - p.y, dz = q->z - p.z, touch = q->r + r;
    if (dx * dx + dy * dy + dz * dz < touch * touch)
      return 0;
    at = q->next;
  }
  return 1;
}

/* The images of a coordinate along one axis that can be within reach of the bounds. */
static int images(double x, double lo, double width, double period, double reach,
                  double out[3])
{
  int count = 0;
  out[count++] = x;
  if (period > 0 && x - lo < reach)
    out[count++] = x + period;
  if (period > 0 && lo + width - x < reach)
    out[count++] = x - period;
  return count;
}

static int level_free(const packing_i_index *index, const packing_i_index_level *level,
                      packing_vec3 p, double r)
{
  const double reach = r + level->largest_r;
  size_t from[3], to[3];
  const double at[3] = {p.x, p.y, p.z}, lo[3] = {index->lo.x, index->lo.y, index->lo.z};
  const double per[3] = {level->per_edge.x, level->per_edge.y, level->per_edge.z};
  for (int axis = 0; axis < 3; axis++) {
    from[axis] = cell_along(at[axis] - reach, lo[axis], per[axis], level->n[axis]);
    to[axis] = cell_along(at[axis] + reach, lo[axis], per[axis], level->n[axis]);
  }
  for (size_t k = from[2]; k <= to[2]; k++)
    for (size_t j = from[1]; j <= to[1]; j++) {
      const uint32_t *head = &level->head[(k * level->n[1] + j) * level->n[0]];
      for (size_t i = from[0]; i <= to[0]; i++)
        if (!chain_free(index, head[i], p, r))
          return 0;
    }
  return 1;
}

int packing_i_index_free(const packing_i_index *index, packing_vec3 p, double r)
{
  for (int l = 0; l < PACKING_I_INDEX_LEVELS; l++) {
    const packing_i_index_level *level = &index->level[l];
    if (level->count == 0)
      continue;
    const double reach = r + level->largest_r;
    double x[3], y[3], z[3];
    const int nx = images(p.x, index->lo.x, index->width.x, index->period.x, reach, x);
    const int ny = images(p.y, index->lo.y, index->width.y, index->period.y, reach, y);
    const int nz = images(p.z, index->lo.z, index->width.z, index->period.z, reach, z);
    for (int k = 0; k < nz; k++)
      for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++)
          if (!level_free(index, level, packing_i_vec(x[i], y[j], z[k]), r))
            return 0;
  }
  return 1;
}

packing_status packing_i_index_add_store(packing_i_index *index,
                                         const packing_domain *domain,
                                         const packing_particles *store)
{
  for (size_t i = 0; i < store->count; i++) {
    packing_vec3 p = {store->x[i], store->y[i], store->z[i]};
    packing_domain_wrap(domain, &p);
    PACKING_I_TRY(packing_i_index_reserve(index, store->r[i]));
    packing_i_index_insert(index, p, store->r[i]);
  }
  return PACKING_OK;
}
