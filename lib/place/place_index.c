/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "place_index.h"
#include <assert.h>

/* More cells than this along an axis need not be told apart: a coordinate cannot do it. */
static const double MOST_ALONG = 0x1p50;

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
    packing_i_free(allocator, index->level[l].full);
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

/* Halves the longest axis until the cells are few enough; those that are left are shared. */
static void limit_cells(double most, double n[3])
{
  while (n[0] * n[1] * n[2] > most) {
    const int longest = n[0] >= n[1] && n[0] >= n[2] ? 0 : n[1] >= n[2] ? 1 : 2;
    n[longest] = ceil(0.5 * n[longest]);
  }
}

/* Sets up the cells of a level when its first particle comes. */
static packing_status level_start(packing_i_index *index, int l)
{
  packing_i_index_level *level = &index->level[l];
  const size_t expected = index->expected > index->count ? index->expected : index->count;
  const double edge = ldexp(2 * index->top_r, -l);
  const double w[3] = {index->width.x, index->width.y, index->width.z};
  double n[3], per[3];
  for (int axis = 0; axis < 3; axis++) {
    n[axis] = fmin(cells_along(w[axis], edge), MOST_ALONG);
    level->whole[axis] = (size_t)n[axis];
    per[axis] = w[axis] > 0 ? n[axis] / w[axis] : 0;
  }
  limit_cells(8.0 * (double)expected + 4096.0, n);
  const size_t words = (size_t)ceil(n[0] / 64), rows = (size_t)(n[1] * n[2]);
  const size_t heads = ((size_t)n[0] * rows + 1) / 2; /* two a word */
  uint64_t *full = packing_i_calloc(packing_i_allocator(index->context),
                                    words * rows + heads, sizeof *full);
  if (full == NULL)
    return packing_i_nomem(index->context);
  for (int axis = 0; axis < 3; axis++)
    level->n[axis] = (size_t)n[axis];
  level->per_edge = packing_i_vec(per[0], per[1], per[2]);
  level->full = full;
  level->words = words;
  level->head = (void *)(full + words * rows);
  return PACKING_OK;
}

packing_status packing_i_index_reserve(packing_i_index *index, size_t more, double r)
{
  const int l = level_of(index, r);
  if (index->level[l].head == NULL)
    PACKING_I_TRY(level_start(index, l));
  if (more <= index->capacity - index->count)
    return PACKING_OK;
  size_t grown = index->capacity + index->capacity / 2 + more + 255;
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
static size_t cell_along(double x, double lo, double per_edge, size_t whole)
{
  const double at = (x - lo) * per_edge;
  if (!(at > 0))
    return 0;
  return at < (double)whole ? (size_t)at : whole - 1;
}

/* The same, as one of those held. */
static size_t held_along(double x, double lo, double per_edge, size_t whole, size_t n)
{
  assert(n > 0); /* level_start() made one at least, which the analyzer does not see */
  const size_t cell = cell_along(x, lo, per_edge, whole);
  return cell < n ? cell : cell % n;
}

void packing_i_index_insert(packing_i_index *index, packing_vec3 p, double r)
{
  packing_i_index_level *level = &index->level[level_of(index, r)];
  const size_t *whole = level->whole, *n = level->n;
  const size_t ix = held_along(p.x, index->lo.x, level->per_edge.x, whole[0], n[0]);
  const size_t iy = held_along(p.y, index->lo.y, level->per_edge.y, whole[1], n[1]);
  const size_t iz = held_along(p.z, index->lo.z, level->per_edge.z, whole[2], n[2]);
  const size_t row = iz * n[1] + iy;
  uint32_t *head = &level->head[row * n[0] + ix];
  level->full[row * level->words + ix / 64] |= UINT64_C(1) << (ix % 64);
  index->entry[index->count] = (packing_i_index_entry){p.x, p.y, p.z, r, *head};
  *head = (uint32_t)++index->count;
  level->count++;
  if (r > level->largest_r)
    level->largest_r = r;
}

/* The cells of a level that a ball may meet: the first along each axis, and how many from there,
 * round the torus. */
typedef struct span {
  size_t first[3], count[3];
} span;

static span level_span(const packing_i_index *index, const packing_i_index_level *level,
                       packing_vec3 p, double reach)
{
  const double at[3] = {p.x, p.y, p.z}, lo[3] = {index->lo.x, index->lo.y, index->lo.z};
  const double per[3] = {level->per_edge.x, level->per_edge.y, level->per_edge.z};
  span s;
  for (int axis = 0; axis < 3; axis++) {
    const size_t whole = level->whole[axis], n = level->n[axis];
    assert(n > 0); /* as above: levels with nothing in them are not asked */
    const size_t from = cell_along(at[axis] - reach, lo[axis], per[axis], whole);
    const size_t to = cell_along(at[axis] + reach, lo[axis], per[axis], whole);
    s.first[axis] = from < n ? from : from % n;
    s.count[axis] = to - from < n ? to - from + 1 : n;
  }
  return s;
}

/* The next cell round the torus. */
static size_t next_along(size_t i, size_t n)
{
  return i + 1 < n ? i + 1 : 0;
}

/* The first cell of a row, from x on and before `end`, that is not empty; `end`: none. */
static inline size_t next_full(const uint64_t *full, size_t x, size_t end)
{
  if (x >= end)
    return end;
  size_t word = x / 64;
  uint64_t rest = full[word] >> (x % 64) << (x % 64);
  while (rest == 0 && ++word * 64 < end)
    rest = full[word];
  if (rest == 0)
    return end;
  x = 64 * word + (size_t)__builtin_ctzll(rest);
  return x < end ? x : end;
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

/* Row y, z of a level; its cells from x on that a ball meets, round the torus, are in up to two
 * runs. */
typedef struct row_walk {
  const uint64_t *full;
  const uint32_t *head;
  size_t x, end; /* of this run */
  size_t left;   /* cells of the next */
} row_walk;

static row_walk row_begin(const packing_i_index_level *level, const span *s, size_t y,
                          size_t z)
{
  const size_t row = z * level->n[1] + y, n = level->n[0], first = s->first[0];
  const size_t end = s->count[0] < n - first ? first + s->count[0] : n;
  return (row_walk){level->full + row * level->words, level->head + row * n, first, end,
                    s->count[0] - (end - first)};
}

/* The next chain of the row; 0: there is none. */
static inline uint32_t row_next(row_walk *row)
{
  size_t x = next_full(row->full, row->x, row->end);
  if (x == row->end && row->left > 0) {
    row->end = row->left;
    row->left = 0;
    x = next_full(row->full, 0, row->end);
  }
  row->x = x + 1;
  return x < row->end ? row->head[x] : 0;
}

static int level_free(const packing_i_index *index, const packing_i_index_level *level,
                      packing_vec3 p, double r)
{
  const span s = level_span(index, level, p, r + level->largest_r);
  const size_t *n = level->n;
  size_t z = s.first[2];
  for (size_t k = 0; k < s.count[2]; k++, z = next_along(z, n[2])) {
    size_t y = s.first[1];
    for (size_t j = 0; j < s.count[1]; j++, y = next_along(y, n[1])) {
      row_walk row = row_begin(level, &s, y, z);
      for (uint32_t at = row_next(&row); at != 0; at = row_next(&row))
        if (!chain_free(index, at, p, r))
          return 0;
    }
  }
  return 1;
}

/* The images of a point that may lie within reach of the bounds: along each axis a period apart,
 * from number `first` on. */
typedef struct image_span {
  double first[3];
  int count[3];
} image_span;

static image_span images_within(const packing_i_index *index, packing_vec3 p,
                                double reach)
{
  const double at[3] = {p.x, p.y, p.z}, lo[3] = {index->lo.x, index->lo.y, index->lo.z};
  const double width[3] = {index->width.x, index->width.y, index->width.z};
  const double period[3] = {index->period.x, index->period.y, index->period.z};
  image_span s = {{0, 0, 0}, {1, 1, 1}};
  for (int axis = 0; axis < 3; axis++)
    if (period[axis] > 0) {
      const double below = at[axis] - lo[axis];
      s.first[axis] = ceil((-reach - below) / period[axis]);
      const double last = floor((width[axis] + reach - below) / period[axis]);
      s.count[axis] = (int)(last - s.first[axis]) + 1;
    }
  return s;
}

static packing_vec3 image_of(const packing_i_index *index, const image_span *s,
                             packing_vec3 p, int i, int j, int k)
{
  return packing_i_vec(p.x + (s->first[0] + i) * index->period.x,
                       p.y + (s->first[1] + j) * index->period.y,
                       p.z + (s->first[2] + k) * index->period.z);
}

int packing_i_index_free(const packing_i_index *index, packing_vec3 p, double r)
{
  for (int l = 0; l < PACKING_I_INDEX_LEVELS; l++) {
    const packing_i_index_level *level = &index->level[l];
    if (level->count == 0)
      continue;
    const image_span s = images_within(index, p, r + level->largest_r);
    for (int k = 0; k < s.count[2]; k++)
      for (int j = 0; j < s.count[1]; j++)
        for (int i = 0; i < s.count[0]; i++)
          if (!level_free(index, level, image_of(index, &s, p, i, j, k), r))
            return 0;
  }
  return 1;
}

static packing_status chain_near(const packing_i_index *index, uint32_t at,
                                 packing_vec3 p, double distance,
                                 packing_i_index_images *images)
{
  while (at != 0) {
    const packing_i_index_entry *q = &index->entry[at - 1];
    const packing_vec3 d = packing_i_vec(q->x - p.x, q->y - p.y, q->z - p.z);
    const double reach = q->r + distance;
    if (packing_i_dot(d, d) < reach * reach) {
      if (images->count == images->capacity) {
        const size_t grown = images->capacity + images->capacity / 2 + 64;
        packing_i_index_image *list =
            packing_i_regrow(packing_i_allocator(index->context), images->at,
                             images->count, grown, sizeof *list);
        if (list == NULL)
          return packing_i_nomem(index->context);
        images->at = list;
        images->capacity = grown;
      }
      images->at[images->count++] = (packing_i_index_image){d, q->r, at - 1};
    }
    at = q->next;
  }
  return PACKING_OK;
}

/* Chains are on their way from memory while those before are gone through. */
typedef struct chain_queue {
  uint32_t at[32];
  size_t count;
} chain_queue;

static packing_status queue_flush(const packing_i_index *index, chain_queue *queue,
                                  packing_vec3 p, double distance,
                                  packing_i_index_images *images)
{
  const size_t count = queue->count;
  queue->count = 0;
  for (size_t k = 0; k < count; k++)
    PACKING_I_TRY(chain_near(index, queue->at[k], p, distance, images));
  return PACKING_OK;
}

static packing_status level_near(const packing_i_index *index,
                                 const packing_i_index_level *level, packing_vec3 p,
                                 double distance, packing_i_index_images *images)
{
  const span s = level_span(index, level, p, distance + level->largest_r);
  const size_t *n = level->n;
  chain_queue queue;
  queue.count = 0;
  size_t z = s.first[2];
  for (size_t k = 0; k < s.count[2]; k++, z = next_along(z, n[2])) {
    size_t y = s.first[1];
    for (size_t j = 0; j < s.count[1]; j++, y = next_along(y, n[1])) {
      row_walk row = row_begin(level, &s, y, z);
      for (uint32_t at = row_next(&row); at != 0; at = row_next(&row)) {
        __builtin_prefetch(&index->entry[at - 1]);
        queue.at[queue.count++] = at;
        if (queue.count == sizeof queue.at / sizeof *queue.at)
          PACKING_I_TRY(queue_flush(index, &queue, p, distance, images));
      }
    }
  }
  return queue_flush(index, &queue, p, distance, images);
}

packing_status packing_i_index_near(const packing_i_index *index, packing_vec3 p,
                                    double distance, packing_i_index_images *images)
{
  images->count = 0;
  for (int l = 0; l < PACKING_I_INDEX_LEVELS; l++) {
    const packing_i_index_level *level = &index->level[l];
    if (level->count == 0)
      continue;
    const image_span s = images_within(index, p, distance + level->largest_r);
    for (int k = 0; k < s.count[2]; k++)
      for (int j = 0; j < s.count[1]; j++)
        for (int i = 0; i < s.count[0]; i++)
          PACKING_I_TRY(level_near(index, level, image_of(index, &s, p, i, j, k),
                                   distance, images));
  }
  return PACKING_OK;
}

packing_status packing_i_index_add_store(packing_i_index *index,
                                         const packing_domain *domain,
                                         const packing_particles *store)
{
  for (size_t i = 0; i < store->count; i++) {
    packing_vec3 p = {store->x[i], store->y[i], store->z[i]};
    packing_domain_wrap(domain, &p);
    PACKING_I_TRY(packing_i_index_reserve(index, 1, store->r[i]));
    packing_i_index_insert(index, p, store->r[i]);
  }
  return PACKING_OK;
}
