/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cluster.h"

#define CLUSTER_PI 3.14159265358979323846

typedef struct cluster {
  double share;
} cluster;

static int alive;

int test_clusters_alive(void)
{
  return alive;
}

/* The body's spheres; returns how many. Bodies of other shapes are spheres. */
static int members(const cluster *shape, const packing_body *body, packing_body member[2])
{
  if (body->shape == NULL) {
    member[0] = *body;
    return 1;
  }
  const double *q = body->orientation;
  const double r = shape->share * body->r, arm = body->r - r;
  /* Where the rotation takes the x axis. */
  const packing_vec3 axis = {1 - 2 * (q[2] * q[2] + q[3] * q[3]),
                             2 * (q[1] * q[2] + q[0] * q[3]),
                             2 * (q[1] * q[3] - q[0] * q[2])};
  for (int i = 0; i < 2; i++) {
    const double at = i == 0 ? arm : -arm;
    const packing_vec3 centre = {body->centre.x + at * axis.x,
                                 body->centre.y + at * axis.y,
                                 body->centre.z + at * axis.z};
    member[i] = packing_body_sphere(centre, r);
  }
  return 2;
}

/* The least of what the library says of pairs of members. */
static double least(const cluster *shape, const packing_body *a, const packing_body *b,
                    const packing_vec3 *direction)
{
  packing_body of_a[2], of_b[2];
  const int na = members(shape, a, of_a), nb = members(shape, b, of_b);
  double value = HUGE_VAL;
  for (int i = 0; i < na; i++)
    for (int j = 0; j < nb; j++)
      value = fmin(value, direction == NULL
                              ? packing_body_gap(&of_a[i], &of_b[j])
                              : packing_body_distance(&of_a[i], &of_b[j], direction));
  return value;
}

static double gap(void *user, const packing_body *a, const packing_body *b)
{
  return least(user, a, b, NULL);
}

static double distance(void *user, const packing_body *a, const packing_body *b,
                       const packing_vec3 *direction)
{
  return least(user, a, b, direction);
}

static double clearance(void *user, const packing_body *a, const packing_domain *domain,
                        int wall, packing_vec3 *normal)
{
  packing_body member[2];
  packing_vec3 way[2];
  members(user, a, member);
  const double one = packing_body_wall_gap(&member[0], domain, wall, &way[0]);
  const double two = packing_body_wall_gap(&member[1], domain, wall, &way[1]);
  if (normal != NULL)
    *normal = way[two < one];
  return fmin(one, two);
}

/* What two equal balls at a distance of 2 arm share is a lens. */
static double volume(void *user, double size, int dim)
{
  const double r = ((cluster *)user)->share * size, arm = size - r;
  if (dim == 3)
    return 8 * CLUSTER_PI / 3 * r * r * r -
           2 * CLUSTER_PI / 3 * (r - arm) * (r - arm) * (2 * r + arm);
  return 2 * CLUSTER_PI * r * r -
         (2 * r * r * acos(arm / r) - 2 * arm * sqrt(r * r - arm * arm));
}

/* Integral over y in [lo, hi] of (r^2 - y^2)^2. */
static double fourth(double r, double lo, double hi)
{
  const double a = r * r;
  return a * a * (hi - lo) - 2 * a * (hi * hi * hi - lo * lo * lo) / 3 +
         (pow(hi, 5) - pow(lo, 5)) / 5;
}

/* Integral over y in [lo, hi] of (r^2 - y^2) (y + arm)^2. */
static double second(double r, double arm, double lo, double hi)
{
  const double a = r * r, b = arm * arm;
  return a * b * (hi - lo) + a * arm * (hi * hi - lo * lo) +
         (a - b) * (pow(hi, 3) - pow(lo, 3)) / 3 - arm * (pow(hi, 4) - pow(lo, 4)) / 2 -
         (pow(hi, 5) - pow(lo, 5)) / 5;
}

/* Slices across the long axis, of one half; principal axes are the body's. */
static void inertia(void *user, double size, int dim, double moments[3])
{
  const double r = ((cluster *)user)->share * size, arm = size - r;
  if (dim == 3) {
    const double ring = CLUSTER_PI * fourth(r, -arm, r);
    moments[0] = ring;
    moments[1] = moments[2] = 0.5 * ring + 2 * CLUSTER_PI * second(r, arm, -arm, r);
    return;
  }
  /* Strips of height 2 r cos(t) at y = r sin(t), by Simpson's rule. */
  enum { PARTS = 512 };
  const double from = -asin(arm / r), step = (0.5 * CLUSTER_PI - from) / PARTS;
  double sum = 0;
  for (int i = 0; i <= PARTS; i++) {
    const double t = from + i * step, half = r * cos(t), x = r * sin(t) + arm;
    const double weight = i == 0 || i == PARTS ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * half * (2 * half * x * x + 2 * half * half * half / 3);
  }
  moments[2] = 2 * sum * step / 3;
}

static void release(void *user)
{
  alive--;
  free(user);
}

packing_status test_cluster_create(packing_context *context, double share,
                                   int with_distance, packing_shape **shape)
{
  packing_shape_def def;
  packing_shape_def_init(&def);
  cluster *made = malloc(sizeof *made);
  assert_non_null(made);
  made->share = share;
  def.name = "two-sphere cluster";
  def.gap = gap;
  def.distance = with_distance ? distance : NULL;
  def.clearance = clearance;
  def.volume = volume;
  def.inertia = inertia;
  def.release = release;
  def.user = made;
  const packing_status status = packing_shape_create_custom(context, &def, shape);
  if (status == PACKING_OK)
    alive++;
  else
    free(made);
  return status;
}

packing_shape *test_cluster(double share, int with_distance)
{
  packing_shape *shape = NULL;
  assert_ok(test_cluster_create(NULL, share, with_distance, &shape));
  return shape;
}

packing_body test_cluster_body(const packing_shape *shape, packing_vec3 centre, double r,
                               const double orientation[4])
{
  packing_body body = packing_body_sphere(centre, r);
  body.shape = shape;
  memcpy(body.orientation, orientation, sizeof body.orientation);
  return body;
}
