/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tree of boxes over the edges of a polygon, and the questions that it answers.
 *
 * The edges are halved at the median of their middles along the longer side of their box, down to
 * four. The tree is full but for its last level, so a node needs no more than its box, and each
 * question goes down with a stack of fixed size. The distance to the nearest feature takes its
 * sign from that feature: an edge by its side, a vertex by its corner (a point whose nearest
 * feature is a vertex sees it from outside where the corner is convex, from inside where it is
 * reflex). So no ray is shot and nothing depends on rounding but the last bits of a distance.
 * Equal distances go to the lowest edge. Building takes n log n, a question log n where edges are
 * spread as in drawings. */
#include "polygon_internal.h"
#include <float.h>

size_t packing_i_polygon_nodes(int count)
{
  size_t nodes = 2;
  for (packing_i_node n = {1, 0, count}; !packing_i_is_leaf(n); n = packing_i_child(n, 1))
    nodes *= 2;
  return nodes;
}

static double key(const packing_i_edge *e, int axis)
{
  return axis == 0 ? e->ax + e->bx : e->ay + e->by;
}

static void swap(packing_i_edge *a, packing_i_edge *b)
{
  const packing_i_edge c = *a;
  *a = *b;
  *b = c;
}

static double median_of_three(double a, double b, double c)
{
  return fmax(fmin(a, b), fmin(fmax(a, b), c));
}

/* Hoare's selection: what stands before `middle` is no greater, what follows no less. */
static void select_median(packing_i_edge *e, int from, int to, int middle, int axis)
{
  for (int low = from, high = to - 1; low < high;) {
    const double pivot =
        median_of_three(key(&e[low], axis), key(&e[middle], axis), key(&e[high], axis));
    int i = low, j = high;
    while (i <= j) {
      while (key(&e[i], axis) < pivot)
        i++;
      while (key(&e[j], axis) > pivot)
        j--;
      if (i <= j)
        swap(&e[i++], &e[j--]);
    }
    if (middle <= j)
      high = j;
    else if (middle >= i)
      low = i;
    else
      return;
  }
}

static packing_i_rect box_of(const packing_i_edge *e, int from, int to)
{
  packing_i_rect b = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  for (int i = from; i < to; i++) {
    b.lo[0] = fmin(b.lo[0], fmin(e[i].ax, e[i].bx));
    b.lo[1] = fmin(b.lo[1], fmin(e[i].ay, e[i].by));
    b.hi[0] = fmax(b.hi[0], fmax(e[i].ax, e[i].bx));
    b.hi[1] = fmax(b.hi[1], fmax(e[i].ay, e[i].by));
  }
  return b;
}

void packing_i_polygon_build(packing_i_polygon_data *data)
{
  packing_i_node stack[PACKING_I_TREE_DEPTH] = {{1, 0, data->count}};
  for (int waiting = 1; waiting > 0;) {
    const packing_i_node n = stack[--waiting];
    const packing_i_rect b = box_of(data->edge, n.from, n.to);
    data->box[n.node] = b;
    if (packing_i_is_leaf(n))
      continue;
    select_median(data->edge, n.from, n.to, packing_i_child(n, 1).from,
                  b.hi[0] - b.lo[0] >= b.hi[1] - b.lo[1] ? 0 : 1);
    stack[waiting++] = packing_i_child(n, 1);
    stack[waiting++] = packing_i_child(n, 0);
  }
  for (int i = 0; i < data->count; i++)
    data->place[data->edge[i].id] = i;
}

static double height(const packing_i_edge *e, double x, double y)
{
  return (x - e->ax) * e->nx + (y - e->ay) * e->ny;
}

packing_i_foot packing_i_edge_foot(const packing_i_edge *e, double x, double y,
                                   double *distance2)
{
  const double ux = e->bx - e->ax, uy = e->by - e->ay;
  const double from_a = (x - e->ax) * ux + (y - e->ay) * uy;
  if (from_a <= 0) {
    *distance2 = (x - e->ax) * (x - e->ax) + (y - e->ay) * (y - e->ay);
    return PACKING_I_FOOT_A;
  }
  if ((x - e->bx) * ux + (y - e->by) * uy >= 0) {
    *distance2 = (x - e->bx) * (x - e->bx) + (y - e->by) * (y - e->by);
    return PACKING_I_FOOT_B;
  }
  const double h = height(e, x, y);
  *distance2 = h * h;
  return PACKING_I_FOOT_EDGE;
}

int packing_i_polygon_is_reflex(const packing_i_polygon_data *data, int vertex)
{
  const packing_i_edge *e = &data->edge[data->place[vertex]];
  const packing_i_edge *f = &data->edge[data->place[data->before[vertex]]];
  return height(f, e->bx, e->by) < 0;
}

typedef struct nearest {
  double distance2;
  int edge; /* its place; -1: none yet */
  packing_i_foot foot;
} nearest;

static void look_at(const packing_i_polygon_data *data, packing_i_node n, double x,
                    double y, nearest *found)
{
  for (int i = n.from; i < n.to; i++) {
    double distance2;
    const packing_i_foot foot = packing_i_edge_foot(&data->edge[i], x, y, &distance2);
    if (distance2 < found->distance2 ||
        (distance2 == found->distance2 && data->edge[i].id < data->edge[found->edge].id))
      *found = (nearest){distance2, i, foot};
  }
}

static nearest find_nearest(const packing_i_polygon_data *data, double x, double y)
{
  packing_i_node stack[PACKING_I_TREE_DEPTH] = {{1, 0, data->count}};
  nearest found = {HUGE_VAL, -1, PACKING_I_FOOT_EDGE};
  for (int waiting = 1; waiting > 0;) {
    const packing_i_node n = stack[--waiting];
    if (packing_i_rect_distance2(&data->box[n.node], x, y) > found.distance2)
      continue;
    if (packing_i_is_leaf(n)) {
      look_at(data, n, x, y, &found);
      continue;
    }
    const packing_i_node left = packing_i_child(n, 0), right = packing_i_child(n, 1);
    const int right_first = packing_i_rect_distance2(&data->box[right.node], x, y) <
                            packing_i_rect_distance2(&data->box[left.node], x, y);
    stack[waiting++] = right_first ? left : right;
    stack[waiting++] = right_first ? right : left;
  }
  return found;
}

double packing_i_polygon_distance(const packing_i_polygon_data *data, double x, double y,
                                  packing_vec3 *normal)
{
  const nearest found = find_nearest(data, x, y);
  if (found.edge < 0) { /* so far away that its square is infinite */
    if (normal != NULL)
      *normal = packing_i_vec(1, 0, 0);
    return -HUGE_VAL;
  }
  const packing_i_edge *e = &data->edge[found.edge];
  if (found.foot == PACKING_I_FOOT_EDGE || found.distance2 == 0) {
    if (normal != NULL)
      *normal = packing_i_vec(e->nx, e->ny, 0);
    return found.foot == PACKING_I_FOOT_EDGE ? height(e, x, y) : 0;
  }
  const int at_a = found.foot == PACKING_I_FOOT_A;
  const double distance = sqrt(found.distance2);
  const double side = packing_i_polygon_is_reflex(data, at_a ? e->id : e->next) ? 1 : -1;
  if (normal != NULL)
    *normal = packing_i_vec(side * (x - (at_a ? e->ax : e->bx)) / distance,
                            side * (y - (at_a ? e->ay : e->by)) / distance, 0);
  return side * distance;
}

int packing_i_polygon_nearest(const packing_i_polygon_data *data, double x, double y)
{
  const nearest found = find_nearest(data, x, y);
  if (found.edge < 0)
    return 0;
  const packing_i_edge *e = &data->edge[found.edge];
  return found.foot == PACKING_I_FOOT_EDGE ? e->id
         : found.foot == PACKING_I_FOOT_A  ? data->count + e->id
                                           : data->count + e->next;
}

int packing_i_polygon_edge_in(const packing_i_polygon_data *data, double x, double y,
                              double r)
{
  packing_i_node stack[PACKING_I_TREE_DEPTH] = {{1, 0, data->count}};
  int found = -1;
  for (int waiting = 1; waiting > 0;) {
    const packing_i_node n = stack[--waiting];
    if (packing_i_rect_distance2(&data->box[n.node], x, y) > r * r)
      continue;
    if (!packing_i_is_leaf(n)) {
      stack[waiting++] = packing_i_child(n, 1);
      stack[waiting++] = packing_i_child(n, 0);
      continue;
    }
    for (int i = n.from; i < n.to; i++) {
      double distance2;
      packing_i_edge_foot(&data->edge[i], x, y, &distance2);
      if (distance2 > r * r)
        continue;
      if (found >= 0)
        return -2;
      found = i;
    }
  }
  return found;
}
