/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether rings make a polygon: none crosses or touches itself or another.
 *
 * Two edges are apart when their boxes are, or when the ends of one lie on one side of the line
 * through the other by more than rounding could (the bound of Shewchuk's orient2d). What cannot
 * be told from touching touches. Each edge asks the tree for those whose box it meets and that do
 * not lie on one side of its line: n log n for drawings; for long needles side by side across the
 * axes, whose boxes all meet, up to n^2 (1e5 of them: some ten seconds). */
#include "polygon_internal.h"
#include <float.h>

/* On which side of the line through a and b a point lies: -1, 1, or 0 where rounding decides. */
static int side(const packing_i_edge *e, double x, double y)
{
  const double left = (e->bx - e->ax) * (y - e->ay);
  const double right = (e->by - e->ay) * (x - e->ax);
  const double blur = 4 * DBL_EPSILON * (fabs(left) + fabs(right));
  return left - right > blur ? 1 : left - right < -blur ? -1 : 0;
}

static int boxes_apart(const packing_i_edge *e, const packing_i_rect *b)
{
  return fmin(e->ax, e->bx) > b->hi[0] || fmax(e->ax, e->bx) < b->lo[0] ||
         fmin(e->ay, e->by) > b->hi[1] || fmax(e->ay, e->by) < b->lo[1];
}

/* Whether the line through the edge leaves the whole box on one side. */
static int line_misses(const packing_i_edge *e, const packing_i_rect *b)
{
  const int first = side(e, b->lo[0], b->lo[1]);
  return first != 0 && side(e, b->hi[0], b->lo[1]) == first &&
         side(e, b->lo[0], b->hi[1]) == first && side(e, b->hi[0], b->hi[1]) == first;
}

static int on_one_side(const packing_i_edge *e, const packing_i_edge *f)
{
  const int first = side(e, f->ax, f->ay);
  return first != 0 && side(e, f->bx, f->by) == first;
}

/* Whether the edge that follows runs back over this one. */
static int folds(const packing_i_edge *e, const packing_i_edge *f)
{
  return side(e, f->bx, f->by) == 0 &&
         (e->ax - e->bx) * (f->bx - e->bx) + (e->ay - e->by) * (f->by - e->by) > 0;
}

static int clash(const packing_i_edge *e, const packing_i_edge *f)
{
  const packing_i_rect b = {{fmin(f->ax, f->bx), fmin(f->ay, f->by)},
                            {fmax(f->ax, f->bx), fmax(f->ay, f->by)}};
  if (e->next == f->id)
    return folds(e, f);
  if (f->next == e->id)
    return folds(f, e);
  return !boxes_apart(e, &b) && !on_one_side(e, f) && !on_one_side(f, e);
}

/* The edge of the lowest number above `e` that it must not meet; NULL: none. */
static const packing_i_edge *first_clash(const packing_i_polygon_data *data,
                                         const packing_i_edge *e)
{
  packing_i_node stack[PACKING_I_TREE_DEPTH] = {{1, 0, data->count}};
  const packing_i_edge *found = NULL;
  for (int waiting = 1; waiting > 0;) {
    const packing_i_node n = stack[--waiting];
    if (boxes_apart(e, &data->box[n.node]) || line_misses(e, &data->box[n.node]))
      continue;
    if (!packing_i_is_leaf(n)) {
      stack[waiting++] = packing_i_child(n, 1);
      stack[waiting++] = packing_i_child(n, 0);
      continue;
    }
    for (int i = n.from; i < n.to; i++) {
      const packing_i_edge *f = &data->edge[i];
      if (f->id > e->id && (found == NULL || f->id < found->id) && clash(e, f))
        found = f;
    }
  }
  return found;
}

/* Vertices of a ring are numbered from 1 in messages. */
static int within_ring(const packing_i_polygon_data *data, int vertex)
{
  int first = vertex;
  while (first > 0 && data->ring[first - 1] == data->ring[vertex])
    first--;
  return vertex - first + 1;
}

/* A vertex of *f that stands where one of *e does, or -1. */
static int repeated(const packing_i_edge *e, const packing_i_edge *f, int *other)
{
  for (int k = 0; k < 4; k++) {
    const double x = k & 1 ? e->bx : e->ax, y = k & 1 ? e->by : e->ay;
    *other = k & 1 ? e->next : e->id;
    if (x == (k & 2 ? f->bx : f->ax) && y == (k & 2 ? f->by : f->ay))
      return k & 2 ? f->next : f->id;
  }
  return -1;
}

static packing_status refuse(packing_context *context, const packing_i_polygon_data *data,
                             const packing_i_edge *e, const packing_i_edge *f)
{
  int first;
  const int again = repeated(e, f, &first);
  if (again >= 0 && again != first)
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "rings", (size_t)again,
                          "vertex %d of ring %d repeats vertex %d of ring %d, at %g, %g",
                          within_ring(data, again), data->ring[again] + 1,
                          within_ring(data, first), data->ring[first] + 1,
                          data->edge[data->place[again]].ax,
                          data->edge[data->place[again]].ay);
  return packing_i_fail(
      context, PACKING_ERR_GEOMETRY, "rings", (size_t)f->id,
      "the edge of ring %d from vertex %d, at %g, %g, crosses or touches "
      "that of ring %d from vertex %d, at %g, %g",
      data->ring[f->id] + 1, within_ring(data, f->id), f->ax, f->ay,
      data->ring[e->id] + 1, within_ring(data, e->id), e->ax, e->ay);
}

packing_status packing_i_polygon_check(packing_context *context,
                                       const packing_i_polygon_data *data)
{
  for (int i = 0; i < data->count; i++) {
    const packing_i_edge *e = &data->edge[data->place[i]];
    const packing_i_edge *f = first_clash(data, e);
    if (f != NULL)
      return refuse(context, data, e, f);
  }
  return PACKING_OK;
}

/* Whether an edge of another ring crosses the line from a point along x. */
static int crosses(const packing_i_edge *e, double x, double y)
{
  if ((e->ay > y) == (e->by > y))
    return 0;
  return side(e, x, y) == (e->by > e->ay ? 1 : -1);
}

int packing_i_polygon_within(const packing_i_polygon_data *data, int vertex)
{
  packing_i_node stack[PACKING_I_TREE_DEPTH] = {{1, 0, data->count}};
  const packing_i_edge *own = &data->edge[data->place[vertex]];
  int odd = 0;
  for (int waiting = 1; waiting > 0;) {
    const packing_i_node n = stack[--waiting];
    const packing_i_rect *b = &data->box[n.node];
    if (b->hi[0] < own->ax || b->lo[1] > own->ay || b->hi[1] < own->ay)
      continue;
    if (!packing_i_is_leaf(n)) {
      stack[waiting++] = packing_i_child(n, 1);
      stack[waiting++] = packing_i_child(n, 0);
      continue;
    }
    for (int i = n.from; i < n.to; i++)
      if (data->ring[data->edge[i].id] != data->ring[vertex])
        odd ^= crosses(&data->edge[i], own->ax, own->ay);
  }
  return odd;
}
