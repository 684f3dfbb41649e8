/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Insertion of a point (A. Bowyer, Comput. J. 24, 1981, 162; D. F. Watson, ibid. 167): the cells
 * whose orthogonal sphere it enters are removed, and what they leave is filled with cells from the
 * point to the facets around. A point that does not enter the sphere of the cell it lies in is
 * hidden by others; a vertex left without a cell has become so.
 *
 * Ties. The weights are thought moved by infinitesimals, the first point by position by the most
 * (O. Devillers, M. Teillaud, Comput. Geom. 44, 2011, 160): what moves is the height |p|^2 - r^2 of
 * a point, upwards. Where a determinant vanishes, the first point in that order whose height
 * changes it decides. A ghost cell is in conflict with what stands outside its facet and, in the
 * facet's plane, with what enters the sphere of the cell on the other side. */
#include "delaunay/builder.h"

enum { MARK_NONE = 0, MARK_CONFLICT = 1, MARK_SPARED = 2 };

static packing_status append(packing_i_delaunay_builder *b, packing_i_delaunay_list *list,
                             uint32_t entry)
{
  if (list->count == list->room) {
    const uint32_t room = list->room < 64 ? 64 : 2 * list->room;
    uint32_t *block = packing_i_regrow(packing_i_allocator(b->context), list->entry,
                                       list->count, room, sizeof *block);
    if (block == NULL)
      return packing_i_nomem(b->context);
    list->entry = block;
    list->room = room;
  }
  list->entry[list->count++] = entry;
  return PACKING_OK;
}

/* By position, then radius, then number. */
static int precedes(const packing_i_delaunay *t, const packing_i_delaunay_point *a,
                    const packing_i_delaunay_point *b)
{
  for (int k = 0; k < 3; k++)
    if (a->x[k] != b->x[k])
      return a->x[k] < b->x[k];
  if (a->r != b->r)
    return a->r < b->r;
  return t->input[a - t->point] < t->input[b - t->point];
}

/* Whether q is in conflict with a real cell whose orthogonal sphere it just touches. */
static int breaks_tie(const packing_i_delaunay *t, const packing_i_delaunay_point *p[4],
                      const packing_i_delaunay_point *q)
{
  int order[4];
  for (int k = 0; k <= t->dim; k++) {
    int at = k;
    for (; at > 0 && precedes(t, p[k], p[order[at - 1]]); at--)
      order[at] = order[at - 1];
    order[at] = k;
  }
  for (int k = 0; k <= t->dim; k++) {
    const packing_i_delaunay_point **corner = &p[order[k]], *const kept = *corner;
    if (precedes(t, q, kept))
      return 0; /* its own height rises by more than all that follow */
    *corner = q;
    const int turn = packing_i_delaunay_orient(t->dim, p);
    *corner = kept;
    if (turn != 0)
      return turn > 0;
  }
  return 0;
}

static int is_conflict(const packing_i_delaunay_builder *b, uint32_t cell,
                       const packing_i_delaunay_point *q)
{
  const packing_i_delaunay *t = b->t;
  const packing_i_delaunay_point *p[4];
  const int ghost = packing_i_delaunay_corners(t, cell, q, p);
  if (ghost >= 0) {
    const int turn = packing_i_delaunay_orient(t->dim, p);
    if (turn != 0)
      return turn > 0;
    (void)packing_i_delaunay_corners(t, t->cell[cell].n[ghost], q, p);
  }
  const int side = packing_i_delaunay_side(&b->exact, t->dim, p, q);
  return side != 0 ? side > 0 : breaks_tie(t, p, q);
}

/* Looks at the neighbours of a cell in conflict. */
static packing_status spread(packing_i_delaunay_builder *b, uint32_t cell,
                             const packing_i_delaunay_point *q)
{
  for (uint32_t k = 0; k <= (uint32_t)b->t->dim; k++) {
    const uint32_t n = b->t->cell[cell].n[k];
    if (b->mark[n] == MARK_NONE) {
      const int conflict = is_conflict(b, n, q);
      b->mark[n] = conflict ? MARK_CONFLICT : MARK_SPARED;
      PACKING_I_TRY(append(b, conflict ? &b->conflicts : &b->spared, n));
    }
    if (b->mark[n] == MARK_SPARED)
      PACKING_I_TRY(append(b, &b->facets, 4 * cell + k));
  }
  return PACKING_OK;
}

static packing_status find_conflicts(packing_i_delaunay_builder *b, uint32_t cell,
                                     const packing_i_delaunay_point *q)
{
  b->conflicts.count = b->spared.count = b->facets.count = 0;
  b->mark[cell] = MARK_CONFLICT;
  PACKING_I_TRY(append(b, &b->conflicts, cell));
  for (uint32_t i = 0; i < b->conflicts.count; i++)
    PACKING_I_TRY(spread(b, b->conflicts.entry[i], q));
  return PACKING_OK;
}

static uint32_t take_cell(packing_i_delaunay_builder *b)
{
  const uint32_t cell =
      b->free.count > 0 ? b->free.entry[--b->free.count] : b->t->cells++;
  b->mark[cell] = MARK_NONE;
  return cell;
}

/* The cell from the point to a facet, in the place of the one in conflict behind that facet: seen
 * from there the point is on the side of the corner it replaces. */
static void make_cell(packing_i_delaunay_builder *b, uint32_t facet, uint32_t v)
{
  packing_i_delaunay *t = b->t;
  const uint32_t old = facet / 4, k = facet % 4, cell = take_cell(b);
  const uint32_t outer = t->cell[old].n[k];
  t->cell[outer].n[packing_i_delaunay_mirror(t, old, (int)k)] = cell;
  t->cell[cell] = t->cell[old];
  t->cell[cell].v[k] = v;
  t->cell[old].n[k] = cell;
  for (int i = 0; i <= t->dim; i++)
    if (t->cell[cell].v[i] != PACKING_I_DELAUNAY_NONE)
      t->where[t->cell[cell].v[i]] = cell;
}

static int index_of(const uint32_t *list, uint32_t entry)
{
  int k = 0;
  while (list[k] != entry)
    k++;
  return k;
}

/* Joins the new cell behind facet k of a cell in conflict to the others: around each ridge of the
 * facet, through cells in conflict, until a new one comes. */
static void join_cell(packing_i_delaunay_builder *b, uint32_t facet)
{
  packing_i_delaunay *t = b->t;
  const uint32_t old = facet / 4;
  const int k = (int)(facet % 4);
  const uint32_t cell = t->cell[old].n[k], pivot = t->cell[old].v[k];
  for (int i = 0; i <= t->dim; i++) {
    if (i == k)
      continue;
    uint32_t at = old, keep = pivot; /* the ridge with `keep` is the facet just crossed */
    int through = i;
    uint32_t next = t->cell[at].n[through];
    while (b->mark[next] == MARK_CONFLICT) {
      const uint32_t entered = t->cell[next].v[packing_i_delaunay_mirror(t, at, through)];
      through = index_of(t->cell[next].v, keep);
      keep = entered;
      at = next;
      next = t->cell[at].n[through];
    }
    t->cell[cell].n[i] = next;
  }
}

static void forget(packing_i_delaunay_builder *b)
{
  for (uint32_t i = 0; i < b->spared.count; i++)
    b->mark[b->spared.entry[i]] = MARK_NONE;
}

static void replace_conflicts(packing_i_delaunay_builder *b, uint32_t v)
{
  packing_i_delaunay *t = b->t;
  for (uint32_t i = 0; i < b->conflicts.count; i++)
    for (int k = 0; k <= t->dim; k++) {
      const uint32_t corner = t->cell[b->conflicts.entry[i]].v[k];
      if (corner != PACKING_I_DELAUNAY_NONE)
        t->where[corner] = PACKING_I_DELAUNAY_NONE;
    }
  for (uint32_t i = 0; i < b->facets.count; i++)
    make_cell(b, b->facets.entry[i], v);
  for (uint32_t i = 0; i < b->facets.count; i++)
    join_cell(b, b->facets.entry[i]);
}

packing_status packing_i_delaunay_insert(packing_i_delaunay_builder *b, uint32_t v)
{
  const packing_i_delaunay_point *q = &b->t->point[v];
  const uint32_t cell = packing_i_delaunay_walk(b->t, b->hint, q);
  b->hint = cell;
  if (!is_conflict(b, cell, q))
    return PACKING_OK;
  PACKING_I_TRY(find_conflicts(b, cell, q));
  PACKING_I_TRY(packing_i_delaunay_reserve(b, b->facets.count));
  replace_conflicts(b, v);
  for (uint32_t i = 0; i < b->conflicts.count; i++)
    PACKING_I_TRY(append(b, &b->free, b->conflicts.entry[i]));
  forget(b);
  b->hint = b->t->where[v];
  return PACKING_OK;
}
