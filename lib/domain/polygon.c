/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A polygon with holes in the plane z = 0: rings under the even-odd rule. Its edges keep the
 * numbers that the user gave them and know their inner side; a tree over them answers for
 * distances (polygon_tree.c) and parts of discs (polygon_cut.c), rings that cross are refused
 * (polygon_check.c). An inset takes its distance off and holds the domain it was made from, which
 * alone releases the edges. 72 bytes a vertex, and those of the boxes: 16 to 32. */
#include "polygon_internal.h"
#include <float.h>
#include <limits.h>

enum { MOST_VERTICES = INT_MAX / 4 };
/* Relative error of the area of an inset. */
static const double inset_tolerance = 1e-4;

static double signed_distance(const packing_i_domain_body *body,
                              const packing_vec3 *point, packing_vec3 *normal)
{
  const packing_i_polygon *p = &body->as.polygon;
  return packing_i_polygon_distance(p->data, point->x, point->y, normal) - p->inset;
}

/* The edge where the foot of the point lies within it, on its inner side; the vertex it starts
 * from where the point sees it between the feet of both its edges, from inside. */
static void look_at(const packing_i_polygon *p, const packing_i_edge *e, int side,
                    const packing_vec3 *point, double reach,
                    packing_i_near_wall near[PACKING_I_NEAR_WALLS], int *count)
{
  double distance2, other2;
  const packing_i_foot foot = packing_i_edge_foot(e, point->x, point->y, &distance2);
  const packing_vec3 from = {point->x - e->ax, point->y - e->ay, 0};
  packing_i_near_wall wall = {.wall = e->id};
  if (foot == PACKING_I_FOOT_EDGE) {
    wall.normal = packing_i_vec(side * e->nx, side * e->ny, 0);
    wall.distance = packing_i_dot(from, wall.normal);
    if (wall.distance < 0)
      return;
  } else {
    const packing_i_edge *f = &p->data->edge[p->data->place[p->data->before[e->id]]];
    if (foot == PACKING_I_FOOT_B || distance2 == 0 ||
        packing_i_edge_foot(f, point->x, point->y, &other2) != PACKING_I_FOOT_B ||
        packing_i_polygon_is_reflex(p->data, e->id) != (side > 0))
      return;
    wall.wall += p->data->count;
    wall.distance = sqrt(distance2);
    wall.normal = packing_i_scale(from, 1 / wall.distance);
  }
  wall.distance -= p->inset;
  if (wall.distance < reach)
    packing_i_keep_nearest(near, count, wall);
}

/* Outside the nearest wall is that of the distance, whichever it is. */
static int near_outside(const packing_i_domain_body *body, const packing_vec3 *point,
                        packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_i_polygon *p = &body->as.polygon;
  near[0].distance = signed_distance(body, point, &near[0].normal);
  near[0].wall = packing_i_polygon_nearest(p->data, point->x, point->y);
  return 1;
}

int packing_i_polygon_near_walls(const packing_i_polygon *p, int side,
                                 const packing_vec3 *point, double reach,
                                 packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  packing_i_node stack[PACKING_I_TREE_DEPTH] = {{1, 0, p->data->count}};
  const double within = reach + p->inset;
  int count = 0;
  for (int waiting = 1; waiting > 0;) {
    const packing_i_node n = stack[--waiting];
    if (packing_i_rect_distance2(&p->data->box[n.node], point->x, point->y) >
        within * within)
      continue;
    if (!packing_i_is_leaf(n)) {
      stack[waiting++] = packing_i_child(n, 1);
      stack[waiting++] = packing_i_child(n, 0);
      continue;
    }
    for (int i = n.from; i < n.to; i++)
      look_at(p, &p->data->edge[i], side, point, reach, near, &count);
  }
  return count;
}

static int near_walls(const packing_i_domain_body *body, const packing_vec3 *point,
                      double reach, packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_i_polygon *p = &body->as.polygon;
  const double distance = signed_distance(body, point, NULL);
  if (!(distance < reach))
    return 0;
  if (distance + p->inset < 0)
    return near_outside(body, point, near);
  return packing_i_polygon_near_walls(p, 1, point, reach, near);
}

static packing_status inset(packing_context *context, packing_i_domain_body *body,
                            double d)
{
  body->as.polygon.inset += d;
  return packing_i_custom_inset(context, body, d, inset_tolerance);
}

static int sphere_volume(const packing_i_domain_body *body, const packing_vec3 *centre,
                         double r, double tolerance, double *volume, double *error)
{
  const packing_i_polygon *p = &body->as.polygon;
  const double disc = packing_i_ball_volume(2, r);
  if (p->inset > 0) {
    const packing_i_tolerance enough = {fmax(tolerance, 1e-4) * disc, 0};
    return packing_i_subdivide(body, centre, r, enough, PACKING_I_CALLS_FOR_BALL, volume,
                               error);
  }
  *volume = packing_i_polygon_disc(p->data, centre->x, centre->y, r);
  *error = 64 * DBL_EPSILON * disc;
  return 0;
}

static void inherit(packing_i_domain_body *body, packing_domain *from)
{
  packing_domain *root = from->body.as.polygon.root;
  body->as.polygon.root = packing_domain_retain(root == NULL ? from : root);
}

static void free_data(packing_i_polygon_data *data)
{
  if (data == NULL)
    return;
  const packing_allocator allocator = data->allocator;
  packing_i_free(&allocator, data->edge);
  packing_i_free(&allocator, data->place);
  packing_i_free(&allocator, data->before);
  packing_i_free(&allocator, data->ring);
  packing_i_free(&allocator, data->box);
  packing_i_free(&allocator, data);
}

static void release(const packing_i_domain_body *body)
{
  const packing_i_polygon *p = &body->as.polygon;
  if (p->root != NULL)
    packing_domain_destroy(p->root);
  else
    free_data((packing_i_polygon_data *)(uintptr_t)p->data);
}

static const packing_i_domain_ops polygon_ops = {
    .name = "polygon",
    .reference = "rings under the even-odd rule; cut areas by Green's theorem",
    .signed_distance = signed_distance,
    .near_walls = near_walls,
    .inset = inset,
    .sphere_volume = sphere_volume,
    .inherit = inherit,
    .release = release,
};

const packing_i_polygon *packing_i_domain_polygon(const packing_i_domain_body *body)
{
  return body->ops == &polygon_ops ? &body->as.polygon : NULL;
}

void packing_domain_polygon_def_fill(packing_domain_polygon_def *def, size_t size)
{
  packing_domain_polygon_def defaults = {.rings = 1};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static size_t ring_size(const packing_domain_polygon_def *d, size_t ring)
{
  return d->sizes == NULL ? d->count : d->sizes[ring];
}

static packing_status check_rings(packing_context *context,
                                  const packing_domain_polygon_def *d)
{
  size_t sum = 0;
  if (d->rings < 1 || d->rings > d->count)
    return packing_i_fail(context, PACKING_ERR_RANGE, "rings", PACKING_NO_INDEX,
                          "%zu must be 1 to count, %zu", d->rings, d->count);
  if (d->sizes == NULL && d->rings > 1)
    return packing_i_fail(context, PACKING_ERR_INVALID, "sizes", PACKING_NO_INDEX,
                          "NULL with %zu rings", d->rings);
  for (size_t i = 0; i < d->rings; i++) {
    const size_t size = ring_size(d, i);
    if (size < 3)
      return packing_i_fail(context, PACKING_ERR_RANGE, "sizes", i,
                            "ring %zu has %zu vertices, at least 3 are needed", i + 1,
                            size);
    if (d->holes != NULL && d->holes[i] != 0 && d->holes[i] != 1)
      return packing_i_fail(context, PACKING_ERR_RANGE, "holes", i,
                            "%d of ring %zu must be 0 or 1", d->holes[i], i + 1);
    sum = size > d->count - sum ? d->count + 1 : sum + size;
    if (sum > d->count)
      break;
  }
  if (sum != d->count)
    return packing_i_fail(context, PACKING_ERR_RANGE, "sizes", PACKING_NO_INDEX,
                          "the sizes of the rings do not add up to count, %zu", d->count);
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_domain_polygon_def *d)
{
  if (d->count < 3 || d->count > MOST_VERTICES)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "%zu vertices, 3 to %d are needed", d->count,
                          (int)MOST_VERTICES);
  PACKING_I_TRY(packing_i_check_given(context, "x", d->x));
  PACKING_I_TRY(packing_i_check_given(context, "y", d->y));
  PACKING_I_TRY(check_rings(context, d));
  for (size_t i = 0; i < d->count; i++)
    if (!isfinite(d->x[i]) || !isfinite(d->y[i]))
      return packing_i_fail(context, PACKING_ERR_INVALID, isfinite(d->x[i]) ? "y" : "x",
                            i, "%g of vertex %zu is not finite",
                            isfinite(d->x[i]) ? d->y[i] : d->x[i], i + 1);
  return PACKING_OK;
}

static packing_status allocate(packing_context *context, size_t count,
                               packing_i_polygon_data **made)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_i_polygon_data *data = packing_i_calloc(allocator, 1, sizeof *data);
  if (data == NULL)
    return packing_i_nomem(context);
  data->allocator = *allocator;
  data->count = (int)count;
  data->edge = packing_i_alloc(allocator, count, sizeof *data->edge);
  data->place = packing_i_alloc(allocator, count, sizeof *data->place);
  data->before = packing_i_alloc(allocator, count, sizeof *data->before);
  data->ring = packing_i_alloc(allocator, count, sizeof *data->ring);
  data->box =
      packing_i_alloc(allocator, packing_i_polygon_nodes(data->count), sizeof *data->box);
  if (data->edge == NULL || data->place == NULL || data->before == NULL ||
      data->ring == NULL || data->box == NULL) {
    free_data(data);
    return packing_i_nomem(context);
  }
  *made = data;
  return PACKING_OK;
}

/* The edges of ring `ring`, vertices [from, to), their normals to the left. */
static packing_status add_ring(packing_context *context,
                               const packing_domain_polygon_def *d, size_t ring,
                               size_t from, size_t to, packing_i_polygon_data *data)
{
  for (size_t i = from; i < to; i++) {
    const size_t next = i + 1 < to ? i + 1 : from;
    const double ux = d->x[next] - d->x[i], uy = d->y[next] - d->y[i];
    const double length = sqrt(ux * ux + uy * uy);
    if (ux == 0 && uy == 0)
      return packing_i_fail(context, PACKING_ERR_GEOMETRY, "rings", next,
                            "vertices %zu and %zu of ring %zu are one point, %g, %g",
                            i - from + 1, next - from + 1, ring + 1, d->x[i], d->y[i]);
    if (!isnormal(length))
      return packing_i_fail(context, PACKING_ERR_RANGE, "x", i,
                            "the edge of ring %zu from vertex %zu has a length of %g",
                            ring + 1, i - from + 1, length);
    data->edge[i] = (packing_i_edge){d->x[i],      d->y[i],     d->x[next], d->y[next],
                                     -uy / length, ux / length, (int)i,     (int)next};
    data->before[next] = (int)i;
    data->ring[i] = (int)ring;
  }
  return PACKING_OK;
}

static packing_status fill(packing_context *context, const packing_domain_polygon_def *d,
                           packing_i_polygon_data *data)
{
  size_t from = 0;
  for (size_t i = 0; i < d->rings; i++) {
    const size_t to = from + ring_size(d, i);
    PACKING_I_TRY(add_ring(context, d, i, from, to, data));
    from = to;
  }
  packing_i_polygon_build(data);
  return packing_i_polygon_check(context, data);
}

/* Twice the area, positive when the ring runs counter-clockwise, and what rounding leaves open. */
static double doubled_area(const packing_domain_polygon_def *d, size_t from, size_t to,
                           double *blur)
{
  double sum = 0, rounded = 0;
  *blur = 0;
  for (size_t i = from + 1; i + 1 < to; i++) {
    const double left = (d->x[i] - d->x[from]) * (d->y[i + 1] - d->y[from]);
    const double right = (d->y[i] - d->y[from]) * (d->x[i + 1] - d->x[from]);
    /* Kahan's sum */
    const double term = (left - right) - rounded, grown = sum + term;
    rounded = (grown - sum) - term;
    sum = grown;
    *blur += 4 * DBL_EPSILON * (fabs(left) + fabs(right));
  }
  return sum;
}

/* Turns the normals of the ring to the inside and adds its area. */
static packing_status settle_ring(packing_context *context,
                                  const packing_domain_polygon_def *d, size_t ring,
                                  size_t from, size_t to, packing_i_polygon_data *data,
                                  double *volume)
{
  double blur;
  const double area = doubled_area(d, from, to, &blur);
  const int is_hole = packing_i_polygon_within(data, (int)from);
  if (!(fabs(area) > blur) || !isfinite(area))
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "rings", from,
                          "ring %zu, from %g, %g, has an area of %g, which is none",
                          ring + 1, d->x[from], d->y[from], 0.5 * area);
  if (d->holes != NULL && d->holes[ring] != is_hole)
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "holes", from,
                          "ring %zu, from %g, %g, is said to be %s and lies %s", ring + 1,
                          d->x[from], d->y[from], is_hole ? "an outer ring" : "a hole",
                          is_hole ? "inside" : "outside");
  *volume += is_hole ? -0.5 * fabs(area) : 0.5 * fabs(area);
  for (size_t i = from; i < to && (area < 0) != is_hole; i++) {
    packing_i_edge *e = &data->edge[data->place[i]];
    e->nx = -e->nx;
    e->ny = -e->ny;
  }
  return PACKING_OK;
}

static packing_status settle(packing_context *context,
                             const packing_domain_polygon_def *d,
                             packing_i_polygon_data *data, double *volume)
{
  size_t from = 0;
  *volume = 0;
  for (size_t i = 0; i < d->rings; i++) {
    const size_t to = from + ring_size(d, i);
    PACKING_I_TRY(settle_ring(context, d, i, from, to, data, volume));
    from = to;
  }
  return PACKING_OK;
}

packing_status packing_domain_create_polygon(packing_context *context,
                                             const packing_domain_polygon_def *def,
                                             packing_domain **domain)
{
  packing_domain_polygon_def d;
  packing_i_polygon_data *data = NULL;
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_polygon, holes, def, &d));
  PACKING_I_TRY(check(context, &d));
  PACKING_I_TRY(allocate(context, d.count, &data));
  packing_i_domain_body body = packing_i_domain_body_new(&polygon_ops, 2);
  packing_status status = fill(context, &d, data);
  if (status == PACKING_OK)
    status = settle(context, &d, data, &body.volume);
  if (status == PACKING_OK) {
    const packing_i_rect *all = &data->box[1];
    body.bounds.lo = packing_i_vec(all->lo[0], all->lo[1], 0);
    body.bounds.hi = packing_i_vec(all->hi[0], all->hi[1], 0);
    body.walls = 2 * data->count;
    body.as.polygon.data = data;
    status = packing_i_domain_finish(context, &body, "x", domain);
  }
  if (status != PACKING_OK)
    free_data(data);
  return status;
}
