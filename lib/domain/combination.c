/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Unions, intersections and differences of containers.
 *
 * With distances positive inside, those of the combination are bounded from below by max(a, b),
 * min(a, b) and min(a, -b). Such a bound is the distance itself when the point of the wall that
 * it names is a wall of the combination too: always in intersections and differences of plain
 * containers, in unions away from the seams. Else the distance is searched for
 * (combination_search.c). Outside the bound is given. Volumes, and parts of balls, need only know
 * which side a point is on; of two containers with closed forms for what they share (cut_cell.c)
 * the volume is exact, by inclusion and exclusion.
 *
 * The combination keeps both containers. An inset takes its distance off and holds the domain it
 * was made from, as that of a custom container. */
#include "combination_internal.h"
#include "polygon_internal.h"
#include <math.h>

enum { NEWTON_STEPS = 12 };
/* Relative error of the volume of an inset, at best. */
static const double inset_tolerance = 1e-3;

static double half_of_cube(const packing_i_domain_body *body, const packing_vec3 *point,
                           double inset)
{
  double half = HUGE_VAL;
  for (int k = 0; k < body->dim; k++) {
    const double x = packing_i_component(*point, k);
    half = fmin(half, fmin(x - packing_i_component(body->bounds.lo, k),
                           packing_i_component(body->bounds.hi, k) - x));
  }
  return (fmax(half, 0) + inset) * (1 + 1e-6);
}

/* The bound, positive inside, and the part and the normal that it comes from. */
static double bound(const packing_i_combination_data *data, const packing_vec3 *point,
                    packing_vec3 *normal, int *part)
{
  double distance[PACKING_I_PARTS];
  packing_i_part_distances(data, point, distance);
  const double d = packing_i_formula(data, distance, part);
  if (normal != NULL) {
    const packing_i_domain_body *body = data->part[*part];
    body->ops->signed_distance(body, point, normal);
    if (data->is_taken[*part])
      *normal = packing_i_scale(*normal, -1);
  }
  return d;
}

/* A wall of a part as a half space round a point: outside is where normal . (x - at) + value <= 0. */
typedef struct half_space {
  packing_vec3 normal;
  double value;
} half_space;

static half_space half_space_at(const packing_i_combination_data *data, int part,
                                const packing_vec3 *at)
{
  half_space h;
  const packing_i_domain_body *body = data->part[part];
  const double sign = data->is_taken[part] ? -1 : 1;
  h.value = sign * body->ops->signed_distance(body, at, &h.normal);
  h.normal = packing_i_scale(h.normal, sign);
  return h;
}

/* The foot of p on the seam of two parts, by Newton's method from `foot`. 0: they are parallel. */
static int find_seam(const packing_i_combination_data *data, const int part[2],
                     const packing_vec3 *p, packing_vec3 *foot)
{
  for (int i = 0; i < NEWTON_STEPS; i++) {
    const half_space a = half_space_at(data, part[0], foot);
    const half_space b = half_space_at(data, part[1], foot);
    const packing_vec3 way = packing_i_sub(*p, *foot);
    const double v = packing_i_dot(a.normal, way) + a.value;
    const double w = packing_i_dot(b.normal, way) + b.value;
    const double k = packing_i_dot(a.normal, b.normal), sine2 = (1 - k) * (1 + k);
    if (!(sine2 > 1e-6))
      return 0;
    const packing_vec3 next =
        packing_i_sub(*p, packing_i_add(packing_i_scale(a.normal, (v - k * w) / sine2),
                                        packing_i_scale(b.normal, (w - k * v) / sine2)));
    const double step = packing_i_norm(packing_i_sub(next, *foot));
    *foot = next;
    if (step <= 1e-12 * packing_i_norm(way))
      return 1;
  }
  return 1;
}

/* A point outside that is near p, whose bound comes from `part` with its foot at *foot: on the
 * seam with the part that the foot lies in. 0: there is none so simple. */
static int find_outside(const packing_i_combination_data *data, const packing_vec3 *p,
                        int part, packing_vec3 *foot, double *distance)
{
  int both[2] = {part, 0};
  packing_vec3 q = *foot;
  bound(data, &q, NULL, &both[1]);
  if (both[0] == both[1] || !find_seam(data, both, p, &q))
    return 0;
  *distance = packing_i_norm(packing_i_sub(*p, q));
  if (!packing_i_vec_finite(q) ||
      bound(data, &q, NULL, &both[1]) > data->blur + 1e-10 * *distance)
    return 0;
  *foot = q;
  return 1;
}

/* Of an inset, for volumes alone: near seams that found by Newton's method is taken for the
 * nearest, without a search that proves it. */
static double side_of_inset(const packing_i_combination *c, const packing_vec3 *p,
                            packing_vec3 *normal)
{
  packing_vec3 away;
  double distance = HUGE_VAL;
  int part;
  const double d = bound(c->data, p, &away, &part);
  packing_vec3 foot = packing_i_sub(*p, packing_i_scale(away, d));
  if (normal != NULL)
    *normal = away;
  if (d >= c->inset || !(d > 0) || !c->data->has_seams ||
      packing_i_is_wall_at(c->data, part, &foot))
    return d - c->inset;
  if (!find_outside(c->data, p, part, &foot, &distance))
    return d - c->inset;
  if (normal != NULL && distance > 0)
    *normal = packing_i_scale(packing_i_sub(*p, foot), 1 / distance);
  return distance - c->inset;
}

/* The formula of the parts' sides. */
static double side_of_parts(const packing_i_combination_data *data, const packing_vec3 *p,
                            packing_vec3 *normal)
{
  double distance[PACKING_I_PARTS];
  int part;
  packing_i_part_sides(data, p, distance);
  const double d = packing_i_formula(data, distance, &part);
  if (normal != NULL) {
    const packing_i_domain_body *body = data->part[part];
    (body->ops->side != NULL ? body->ops->side : body->ops->signed_distance)(body, p,
                                                                             normal);
    *normal = packing_i_scale(*normal, data->is_taken[part] ? -1 : 1);
  }
  return d;
}

static double side(const packing_i_domain_body *body, const packing_vec3 *point,
                   packing_vec3 *normal)
{
  const packing_i_combination *c = &body->as.combination;
  packing_vec3 p = *point;
  if (body->dim == 2)
    p.z = 0;
  return c->inset > 0 ? side_of_inset(c, &p, normal) : side_of_parts(c->data, &p, normal);
}

/* The distance from the walls of the combination itself; *foot is where. With a finite `limit` it
 * need only show on which side of that it is: the value is as far as the search went, and on the
 * side on which the search without a limit ends. Without `proof` the seam that Newton's method
 * finds is taken for the nearest, and else no farther than `limit` searched. */
static double distance_within(const packing_i_domain_body *body,
                              const packing_vec3 *point, double limit, int proof,
                              packing_vec3 *normal, packing_vec3 *foot)
{
  const packing_i_combination *c = &body->as.combination;
  const packing_i_combination_data *data = c->data;
  packing_vec3 away, p = *point;
  double searched;
  int part;
  if (body->dim == 2)
    p.z = 0;
  const double d = bound(data, &p, &away, &part);
  if (normal != NULL)
    *normal = away;
  *foot = packing_i_sub(p, packing_i_scale(away, d));
  if (!data->has_seams || !(d > -data->blur) || d >= limit ||
      packing_i_is_wall_at(data, part, foot))
    return d;
  packing_vec3 found = *foot;
  const double whole = half_of_cube(body, &p, c->inset);
  const double half = proof ? whole : fmin(whole, limit * (1 + 1e-6));
  double known = HUGE_VAL;
  const int outside = find_outside(data, &p, part, &found, &known);
  if (outside && !proof) {
    searched = known;
  } else if (!packing_i_search(data, body->dim, &p, half, outside ? known : HUGE_VAL,
                               limit, &searched, &found)) {
    /* Nothing of the cube lies outside. */
    return half < whole && !isfinite(searched) ? fmax(d, limit) : d;
  }
  if (!(searched > d) || !isfinite(searched))
    return d;
  const packing_vec3 way = packing_i_sub(p, found);
  const double length = packing_i_norm(way);
  *foot = found;
  if (normal != NULL && length > 0)
    *normal = packing_i_scale(way, 1 / length);
  return searched;
}

static double signed_distance(const packing_i_domain_body *body,
                              const packing_vec3 *point, packing_vec3 *normal)
{
  packing_vec3 foot;
  return distance_within(body, point, HUGE_VAL, 1, normal, &foot) -
         body->as.combination.inset;
}

static int holds(const packing_i_domain_body *body, const packing_vec3 *centre, double r)
{
  const packing_i_combination *c = &body->as.combination;
  const double limit =
      (r + c->inset) * (1 + 1e-15); /* no less without the inset than r */
  packing_vec3 foot;
  return distance_within(body, centre, limit, 1, NULL, &foot) - c->inset >= r;
}

/* The walls of part `part`, as seen from inside the combination. */
static int walls_of(const packing_i_combination_data *data, int part,
                    const packing_vec3 *point, double reach,
                    packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_i_domain_body *body = data->part[part];
  const packing_i_polygon *polygon = packing_i_domain_polygon(body);
  if (!data->is_taken[part])
    return body->ops->near_walls(body, point, reach, near);
  if (polygon != NULL && polygon->inset == 0)
    return packing_i_polygon_near_walls(polygon, -1, point, reach, near);
  /* From outside a part shows one wall, the nearest point of it. */
  packing_i_near_wall nearest = {.wall = 0}, walls[PACKING_I_NEAR_WALLS];
  nearest.distance = -body->ops->signed_distance(body, point, &nearest.normal);
  nearest.normal = packing_i_scale(nearest.normal, -1);
  if (!(nearest.distance < reach))
    return 0;
  const int count = body->ops->near_walls(body, point, HUGE_VAL, walls);
  double least = HUGE_VAL;
  for (int i = 0; i < count; i++)
    if (walls[i].distance < least) {
      least = walls[i].distance;
      nearest.wall = walls[i].wall;
    }
  near[0] = nearest;
  return 1;
}

/* Adds the walls of one part that are walls of the combination too. */
static void add_walls(const packing_i_combination_data *data, int part,
                      const packing_vec3 *point, double reach,
                      packing_i_near_wall near[PACKING_I_NEAR_WALLS], int *count)
{
  packing_i_near_wall walls[PACKING_I_NEAR_WALLS];
  const packing_i_domain_body *body = data->part[part];
  const int found = walls_of(data, part, point, reach, walls);
  for (int i = 0; i < found; i++) {
    packing_i_near_wall w = walls[i];
    const packing_vec3 foot =
        packing_i_sub(*point, packing_i_scale(w.normal, w.distance));
    const double off = body->ops->signed_distance(body, &foot, NULL);
    if (w.distance < 0 || fabs(off) > data->blur + 1e-9 * w.distance ||
        !packing_i_is_wall_at(data, part, &foot))
      continue;
    w.wall += data->first_wall[part];
    packing_i_keep_nearest(near, count, w);
  }
}

static int near_walls(const packing_i_domain_body *body, const packing_vec3 *point,
                      double reach, packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_i_combination *c = &body->as.combination;
  const double within = reach + c->inset;
  packing_vec3 p = *point, foot;
  packing_i_near_wall nearest = {.wall = c->data->walls - 1};
  int count = 0;
  if (body->dim == 2)
    p.z = 0;
  nearest.distance = distance_within(body, &p, within, 0, &nearest.normal, &foot);
  if (!(nearest.distance < within))
    return 0;
  for (int i = 0; i < c->data->parts && nearest.distance >= 0; i++)
    add_walls(c->data, i, &p, within, near, &count);
  /* A seam, where no wall is as near. */
  if (count == 0 || near[0].distance > nearest.distance * (1 + 1e-6) + c->data->blur) {
    if (count == PACKING_I_NEAR_WALLS)
      count--;
    packing_i_keep_nearest(near, &count, nearest);
  }
  for (int i = 0; i < count; i++)
    near[i].distance -= c->inset;
  return count;
}

static packing_status inset(packing_context *context, packing_i_domain_body *body,
                            double d)
{
  packing_i_combination *c = &body->as.combination;
  c->inset += d;
  return packing_i_custom_inset(context, body, d,
                                fmax(c->volume_tolerance, inset_tolerance));
}

int packing_i_by_parts(const packing_domain *domain, packing_i_measure measure,
                       const void *arg, double *value, double *error)
{
  const packing_i_combination_data *data = domain->body.as.combination.data;
  packing_i_combination_data work;
  packing_domain shared;
  double b = 0, b_error = 0, both = 0, both_error = 0;
  if (measure(data->a, arg, value, error) ||
      (data->operation == PACKING_UNION && measure(data->b, arg, &b, &b_error)))
    return -1;
  if (data->meet && *value > 0 && (data->operation != PACKING_UNION || b > 0)) {
    packing_i_shared_part(data->a, data->b, &work, &shared);
    if (measure(&shared, arg, &both, &both_error))
      return -1;
  }
  *value = fmax(*value + (b - both), 0);
  *error += b_error + both_error;
  return 0;
}

int packing_i_has_parts(const packing_i_domain_body *body)
{
  const packing_i_combination *c = packing_i_domain_combination(body);
  return c != NULL && c->inset == 0 && c->data->operation != PACKING_INTERSECTION &&
         c->data->a != NULL;
}

/* A ball. */
typedef struct ball {
  packing_vec3 centre;
  double r, tolerance;
} ball;

static int ball_in(const packing_domain *domain, const void *arg, double *volume,
                   double *error)
{
  const ball *b = arg;
  return packing_domain_sphere_volume(domain, &b->centre, b->r, b->tolerance, volume,
                                      error) != PACKING_OK;
}

static int sphere_volume(const packing_i_domain_body *body, const packing_vec3 *centre,
                         double r, double tolerance, double *volume, double *error)
{
  const double whole = packing_i_ball_volume(body->dim, r);
  const packing_i_tolerance enough = {fmax(tolerance, 1e-4) * whole, 0};
  if (packing_i_has_parts(body)) {
    const ball b = {*centre, r, tolerance};
    packing_domain domain = {.body = *body};
    return packing_i_by_parts(&domain, ball_in, &b, volume, error);
  }
  return packing_i_subdivide_sides(body, centre, r, enough, PACKING_I_CALLS_FOR_BALL,
                                   volume, error);
}

static void inherit(packing_i_domain_body *body, packing_domain *from)
{
  packing_domain *root = from->body.as.combination.root;
  body->as.combination.root = packing_domain_retain(root == NULL ? from : root);
}

static void free_data(packing_i_combination_data *data)
{
  const packing_allocator allocator = data->allocator;
  packing_domain_destroy(data->a);
  packing_domain_destroy(data->b);
  packing_i_free(&allocator, data);
}

static void release(const packing_i_domain_body *body)
{
  const packing_i_combination *c = &body->as.combination;
  if (c->root != NULL)
    packing_domain_destroy(c->root);
  else
    free_data((packing_i_combination_data *)(uintptr_t)c->data);
}

#define COMBINATION(NAME, REFERENCE)                                                     \
  {                                                                                      \
    .name = (NAME), .reference = (REFERENCE), .signed_distance = signed_distance,        \
    .side = side, .holds = holds, .near_walls = near_walls, .inset = inset,              \
    .sphere_volume = sphere_volume, .inherit = inherit, .release = release               \
  }

static const packing_i_domain_ops operations[] = {
    [PACKING_UNION] = COMBINATION("union", "the greater distance; seams by search"),
    [PACKING_INTERSECTION] = COMBINATION("intersection", "the lesser distance"),
    [PACKING_DIFFERENCE] = COMBINATION("difference", "the lesser of one distance and "
                                                     "the other's opposite"),
};

const packing_i_combination *
packing_i_domain_combination(const packing_i_domain_body *body)
{
  return body->ops->signed_distance == signed_distance ? &body->as.combination : NULL;
}

const packing_i_domain_ops *packing_i_combination_ops(packing_operation operation)
{
  return &operations[operation];
}
