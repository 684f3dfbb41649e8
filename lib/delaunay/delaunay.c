/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The triangulation from its first cell to its last: scales and orders the points, starts with a
 * simplex that is not flat, inserts the rest, and puts real cells before those with the ghost.
 *
 * Coordinates are scaled by a power of two to at most 1 and rounded to multiples of 2^-199 of
 * that: then no product that the predicates form, of five factors at most, leaves the range of
 * doubles, and all they say is exact. */
#include "delaunay/builder.h"
#include "delaunay/hilbert.h"
#include <math.h>
#include <string.h>

/* Cells are numbered below 2^30, so a facet's number, 4 cell + k, fits 32 bits. */
static const uint32_t MOST_CELLS = UINT32_C(1) << 30;
static const double GRAIN = 0x1.8p-147; /* adding it rounds to its last bit, 2^-199 */

static double rounded(double v, double scale)
{
  v *= scale;
  return fabs(v) < 0x1p-147 ? (v + GRAIN) - GRAIN : v;
}

static double largest(const double *v, size_t count, double so_far)
{
  for (size_t i = 0; v != NULL && i < count; i++)
    so_far = fabs(v[i]) > so_far ? fabs(v[i]) : so_far;
  return so_far;
}

/* The power of two that takes all to [-1, 1]. */
static double scale_of(const packing_i_delaunay_source *s)
{
  int exponent;
  double most = largest(s->x, s->count, 0);
  most = largest(s->y, s->count, most);
  most = largest(s->dim == 3 ? s->z : NULL, s->count, most);
  most = largest(s->r, s->count, most);
  (void)frexp(most, &exponent);
  return ldexp(1.0, exponent < -1000 ? 1000 : exponent > 1000 ? -1000 : -exponent);
}

static packing_i_delaunay_point scaled_point(const packing_i_delaunay_source *s, size_t i,
                                             double scale)
{
  const packing_i_delaunay_point p = {{rounded(s->x[i], scale), rounded(s->y[i], scale),
                                       s->dim == 3 ? rounded(s->z[i], scale) : 0},
                                      s->r == NULL ? 0 : rounded(s->r[i], scale)};
  return p;
}

/* Points in the order of their insertion. */
static packing_status take_points(packing_context *context, packing_i_delaunay *t,
                                  const packing_i_delaunay_source *s)
{
  packing_i_delaunay_point *points =
      packing_i_alloc(&t->allocator, s->count, sizeof *points);
  if (points == NULL)
    return packing_i_nomem(context);
  for (size_t i = 0; i < s->count; i++)
    points[i] = scaled_point(s, i, t->scale);
  const packing_status status =
      packing_i_delaunay_order(context, t->dim, points, t->count, t->input);
  for (uint32_t k = 0; status == PACKING_OK && k < t->count; k++) {
    t->point[k] = points[t->input[k]];
    t->where[k] = PACKING_I_DELAUNAY_NONE;
  }
  packing_i_free(&t->allocator, points);
  return status;
}

packing_status packing_i_delaunay_reserve(packing_i_delaunay_builder *b, uint32_t more)
{
  packing_i_delaunay *t = b->t;
  const size_t need = (size_t)t->cells + more;
  if (need <= b->room)
    return PACKING_OK;
  if (need > MOST_CELLS)
    return packing_i_fail(b->context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "%lu spheres have more than %lu cells", (unsigned long)t->count,
                          (unsigned long)MOST_CELLS);
  size_t room = (size_t)b->room + b->room / 2 + 64;
  room = room < need ? need : room > MOST_CELLS ? MOST_CELLS : room;
  packing_i_delaunay_cell *cell =
      packing_i_regrow(&t->allocator, t->cell, t->cells, room, sizeof *cell);
  if (cell == NULL)
    return packing_i_nomem(b->context);
  t->cell = cell;
  unsigned char *mark = packing_i_regrow(&t->allocator, b->mark, t->cells, room, 1);
  if (mark == NULL)
    return packing_i_nomem(b->context);
  b->mark = mark;
  b->room = (uint32_t)room;
  return PACKING_OK;
}

/* Whether three points stand on a line: in all three projections. */
static int is_collinear(const packing_i_delaunay_point *const p[3])
{
  for (int axis = 0; axis < 3; axis++) {
    packing_i_delaunay_point flat[3];
    for (int i = 0; i < 3; i++) {
      flat[i] = *p[i];
      flat[i].x[axis] = p[i]->x[2];
      flat[i].x[2] = 0;
    }
    const packing_i_delaunay_point *const f[4] = {&flat[0], &flat[1], &flat[2], &flat[2]};
    if (packing_i_delaunay_orient(2, f) != 0)
      return 0;
  }
  return 1;
}

/* Whether point `n` of a simplex lies in the affine hull of the n before. */
static int is_dependent(int dim, int n, const packing_i_delaunay_point *const p[4])
{
  if (n == dim)
    return packing_i_delaunay_orient(dim, p) == 0;
  if (n == 2)
    return is_collinear(p);
  return n == 1 && p[0]->x[0] == p[1]->x[0] && p[0]->x[1] == p[1]->x[1] &&
         p[0]->x[2] == p[1]->x[2];
}

/* The first points that span the space; returns how many there are. */
static int find_simplex(const packing_i_delaunay *t, uint32_t v[4])
{
  const packing_i_delaunay_point *p[4] = {NULL, NULL, NULL, NULL};
  int n = 0;
  for (uint32_t i = 0; i < t->count && n <= t->dim; i++) {
    p[n] = &t->point[i];
    if (!is_dependent(t->dim, n, p))
      v[n++] = i;
  }
  return n;
}

static void link_pair(packing_i_delaunay *t, uint32_t a, int k, uint32_t b, int m)
{
  t->cell[a].n[k] = b;
  t->cell[b].n[m] = a;
}

static int place_of(const packing_i_delaunay *t, uint32_t cell, uint32_t v)
{
  int k = 0;
  while (t->cell[cell].v[k] != v)
    k++;
  return k;
}

/* One real cell, and a ghost cell at each of its facets: cell k + 1 at the one opposite to k. */
static void start(packing_i_delaunay *t, const uint32_t simplex[4])
{
  const packing_i_delaunay_point *p[4];
  packing_i_delaunay_cell first = {{simplex[0], simplex[1], simplex[2], simplex[3]}, {0}};
  for (int k = 0; k <= t->dim; k++) {
    p[k] = &t->point[simplex[k]];
    t->where[simplex[k]] = 0;
  }
  if (packing_i_delaunay_orient(t->dim, p) < 0) {
    first.v[0] = simplex[1];
    first.v[1] = simplex[0];
  }
  t->cell[0] = first;
  t->cells = (uint32_t)t->dim + 2;
  for (int k = 0; k <= t->dim; k++) {
    const int a = (k + 1) % (t->dim + 1), b = (k + 2) % (t->dim + 1);
    packing_i_delaunay_cell *c = &t->cell[k + 1];
    *c = first;
    c->v[k] = PACKING_I_DELAUNAY_NONE;
    c->v[a] = first.v[b]; /* turned round: the ghost is on the other side */
    c->v[b] = first.v[a];
  }
  for (int k = 0; k <= t->dim; k++) {
    const uint32_t ghost = (uint32_t)k + 1;
    link_pair(t, 0, k, ghost, k);
    for (int m = 0; m < k;
         m++) /* the ghost cells of facets k and m lack each other's corner */
      link_pair(t, ghost, place_of(t, ghost, first.v[m]), (uint32_t)m + 1,
                place_of(t, (uint32_t)m + 1, first.v[k]));
  }
}

static int has_ghost(const packing_i_delaunay *t, uint32_t cell)
{
  for (int k = 0; k <= t->dim; k++)
    if (t->cell[cell].v[k] == PACKING_I_DELAUNAY_NONE)
      return 1;
  return 0;
}

/* Leaves out cells no longer in use, and puts those with the ghost last. */
static packing_status tidy(packing_i_delaunay_builder *b)
{
  packing_i_delaunay *t = b->t;
  const uint32_t used = t->cells - b->free.count;
  uint32_t *to = packing_i_calloc(&t->allocator, t->cells, sizeof *to);
  packing_i_delaunay_cell *cell = packing_i_alloc(&t->allocator, used, sizeof *cell);
  if (to == NULL || cell == NULL) {
    packing_i_free(&t->allocator, to);
    packing_i_free(&t->allocator, cell);
    return packing_i_nomem(b->context);
  }
  for (uint32_t i = 0; i < b->free.count; i++)
    to[b->free.entry[i]] = PACKING_I_DELAUNAY_NONE;
  uint32_t next = 0;
  for (int ghosts = 0; ghosts < 2; ghosts++) {
    for (uint32_t i = 0; i < t->cells; i++)
      if (to[i] != PACKING_I_DELAUNAY_NONE && has_ghost(t, i) == ghosts)
        cell[next++] = t->cell[i];
    t->real = ghosts == 0 ? next : t->real;
  }
  next = 0;
  for (int ghosts = 0; ghosts < 2; ghosts++)
    for (uint32_t i = 0; i < t->cells; i++)
      if (to[i] != PACKING_I_DELAUNAY_NONE && has_ghost(t, i) == ghosts)
        to[i] = next++;
  for (uint32_t i = 0; i < used; i++)
    for (int k = 0; k <= t->dim; k++)
      cell[i].n[k] = to[cell[i].n[k]];
  for (uint32_t i = 0; i < t->count; i++)
    if (t->where[i] != PACKING_I_DELAUNAY_NONE)
      t->where[i] = to[t->where[i]];
  packing_i_free(&t->allocator, t->cell);
  packing_i_free(&t->allocator, to);
  t->cell = cell;
  t->cells = used;
  return PACKING_OK;
}

static packing_status insert_all(packing_i_delaunay_builder *b)
{
  packing_i_delaunay *t = b->t;
  uint32_t simplex[4] = {0};
  t->spanned = find_simplex(t, simplex) - 1;
  if (t->spanned < t->dim)
    return PACKING_OK;
  PACKING_I_TRY(packing_i_delaunay_reserve(
      b, t->count < MOST_CELLS / 8 ? (t->dim == 3 ? 7 : 2) * t->count + 64 : MOST_CELLS));
  start(t, simplex);
  memset(b->mark, 0, t->cells);
  for (uint32_t v = 0; v < t->count; v++)
    if (v != simplex[0] && v != simplex[1] && v != simplex[2] &&
        (t->dim == 2 || v != simplex[3]))
      PACKING_I_TRY(packing_i_delaunay_insert(b, v));
  return tidy(b);
}

static packing_status triangulate(packing_context *context, packing_i_delaunay *t)
{
  packing_i_delaunay_builder b = {0};
  b.context = context;
  b.t = t;
  packing_status status = packing_i_exact_create(context, &b.exact);
  if (status == PACKING_OK)
    status = insert_all(&b);
  packing_i_free(&t->allocator, b.exact.room);
  packing_i_free(&t->allocator, b.mark);
  packing_i_free(&t->allocator, b.conflicts.entry);
  packing_i_free(&t->allocator, b.spared.entry);
  packing_i_free(&t->allocator, b.facets.entry);
  packing_i_free(&t->allocator, b.free.entry);
  return status;
}

packing_status packing_i_delaunay_create(packing_context *context,
                                         const packing_i_delaunay_source *source,
                                         packing_i_delaunay **triangulation)
{
  if (source->count >= MOST_CELLS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "%zu spheres have more than %lu cells", source->count,
                          (unsigned long)MOST_CELLS);
  packing_i_delaunay *t = packing_i_calloc(packing_i_allocator(context), 1, sizeof *t);
  if (t == NULL)
    return packing_i_nomem(context);
  t->allocator = *packing_i_allocator(context);
  t->dim = source->dim;
  t->count = (uint32_t)source->count;
  t->scale = scale_of(source);
  t->point = packing_i_alloc(&t->allocator, t->count, sizeof *t->point);
  t->input = packing_i_alloc(&t->allocator, t->count, sizeof *t->input);
  t->where = packing_i_alloc(&t->allocator, t->count, sizeof *t->where);
  packing_status status = PACKING_OK;
  if (t->point == NULL || t->input == NULL || t->where == NULL)
    status = packing_i_nomem(context);
  if (status == PACKING_OK)
    status = take_points(context, t, source);
  if (status == PACKING_OK)
    status = triangulate(context, t);
  if (status != PACKING_OK) {
    packing_i_delaunay_destroy(t);
    return status;
  }
  *triangulation = t;
  return PACKING_OK;
}

void packing_i_delaunay_destroy(packing_i_delaunay *t)
{
  if (t == NULL)
    return;
  const packing_allocator allocator = t->allocator;
  packing_i_free(&allocator, t->point);
  packing_i_free(&allocator, t->input);
  packing_i_free(&allocator, t->where);
  packing_i_free(&allocator, t->cell);
  packing_i_free(&allocator, t);
}
