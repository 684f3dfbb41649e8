/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_SOLIDS_H
#define PACKING_TEST_SOLIDS_H

/* Polygons and combinations for tests, and the slow obvious way to measure polygons. */

#include "domain_scenes.h"

typedef struct test_rings {
  size_t count, rings;
  double x[512], y[512];
  size_t sizes[40];
} test_rings;

static inline void rings_add(test_rings *r, size_t count, const double (*at)[2])
{
  for (size_t i = 0; i < count; i++) {
    r->x[r->count] = at[i][0];
    r->y[r->count++] = at[i][1];
  }
  r->sizes[r->rings++] = count;
}

static inline packing_status rings_create(packing_context *context, const test_rings *r,
                                          packing_domain **domain)
{
  packing_domain_polygon_def def;
  packing_domain_polygon_def_init(&def);
  def.count = r->count;
  def.x = r->x;
  def.y = r->y;
  def.rings = r->rings;
  def.sizes = r->sizes;
  return packing_domain_create_polygon(context, &def, domain);
}

static inline packing_domain *rings_domain(const test_rings *r)
{
  packing_domain *domain = NULL;
  packing_context *context = NULL;
  assert_ok(packing_context_create(NULL, &context));
  test_status(rings_create(context, r, &domain), PACKING_OK, context, "polygon", __FILE__,
              __LINE__);
  packing_context_destroy(context);
  return domain;
}

/* An L of two arms of width 2 with a square hole. */
static inline test_rings rings_l(void)
{
  static const double outer[][2] = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 5}, {0, 5}};
  static const double hole[][2] = {{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}};
  test_rings r = {0};
  rings_add(&r, 6, outer);
  rings_add(&r, 4, hole);
  return r;
}

/* A ring round (x, y) with `n` corners at random radii from `least` to `most`. */
static inline void rings_add_star(test_rings *r, uint64_t *seed, size_t n, double x,
                                  double y, double least, double most, int clockwise)
{
  double at[256][2];
  for (size_t i = 0; i < n; i++) {
    const double angle = (clockwise ? -2 : 2) * TEST_PI * (double)i / (double)n;
    const double rho = least + (most - least) * scene_random(seed);
    at[i][0] = x + rho * cos(angle);
    at[i][1] = y + rho * sin(angle);
  }
  rings_add(r, n, (const double(*)[2])at);
}

/* A star with nine star-shaped holes in rows, one of them with an island. */
static inline test_rings rings_many(uint64_t *seed)
{
  test_rings r = {0};
  rings_add_star(&r, seed, 90, 0, 0, 4, 6, 0);
  for (int i = 0; i < 9; i++)
    rings_add_star(&r, seed, 12, 1.6 * (i % 3 - 1), 1.6 * (i / 3 - 1), 0.4, 0.7, i & 1);
  rings_add_star(&r, seed, 7, 0, 0, 0.1, 0.25, 0);
  return r;
}

/* A comb: `teeth` of width 1 and of the given length at intervals of 2. */
static inline test_rings rings_comb(int teeth, double length)
{
  test_rings r = {0};
  double at[256][2];
  size_t n = 0;
  at[n][0] = 2 * teeth - 1, at[n++][1] = -1;
  for (int i = teeth - 1; i >= 0; i--) {
    at[n][0] = 2 * i + 1, at[n++][1] = i + 1 < teeth ? 0 : length;
    if (i + 1 < teeth)
      at[n][0] = 2 * i + 1, at[n++][1] = length;
    at[n][0] = 2 * i, at[n++][1] = length;
    if (i > 0)
      at[n][0] = 2 * i, at[n++][1] = 0;
  }
  at[n][0] = 0, at[n++][1] = -1;
  rings_add(&r, n, (const double(*)[2])at);
  return r;
}

/* The vertex behind vertex i. */
static inline size_t rings_next(const test_rings *r, size_t i)
{
  size_t end = 0;
  for (size_t k = 0; k < r->rings; k++) {
    const size_t from = end;
    end += r->sizes[k];
    if (i < end)
      return i + 1 < end ? i + 1 : from;
  }
  return 0;
}

/* The distance to the nearest edge, all of them, its sign by crossings of a ray. */
static inline double rings_distance(const test_rings *r, double x, double y)
{
  double least = HUGE_VAL;
  int odd = 0;
  for (size_t i = 0; i < r->count; i++) {
    const size_t k = rings_next(r, i);
    const double ax = r->x[i], ay = r->y[i], ux = r->x[k] - ax, uy = r->y[k] - ay;
    double t = ((x - ax) * ux + (y - ay) * uy) / (ux * ux + uy * uy);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    least = fmin(least, hypot(x - ax - t * ux, y - ay - t * uy));
    if ((ay > y) != (r->y[k] > y) && x < ax + (y - ay) / uy * ux)
      odd ^= 1;
  }
  return odd ? least : -least;
}

/* The part of the triangle (0, a, b) that the disc round 0 holds, with its sign. */
static inline double rings_wedge(double r, double ax, double ay, double bx, double by)
{
  const double ux = bx - ax, uy = by - ay, l2 = ux * ux + uy * uy;
  const double middle = -(ax * ux + ay * uy) / l2;
  const double high2 = (ax * uy - ay * ux) * (ax * uy - ay * ux) / l2;
  const double half = r * r > high2 ? sqrt((r * r - high2) / l2) : 0;
  const double s = fmin(fmax(middle - half, 0), 1), t = fmin(fmax(middle + half, 0), 1);
  const double px = ax + s * ux, py = ay + s * uy, qx = ax + t * ux, qy = ay + t * uy;
  double area = 0.5 * (px * qy - py * qx);
  area += 0.5 * r * r * atan2(ax * py - ay * px, ax * px + ay * py);
  area += 0.5 * r * r * atan2(qx * by - qy * bx, qx * bx + qy * by);
  return area;
}

/* The disc's part in the polygon, edge by edge. */
static inline double rings_disc(const test_rings *r, double x, double y, double radius)
{
  double total = 0;
  size_t from = 0;
  for (size_t k = 0; k < r->rings; k++) {
    double area = 0, inside = 0;
    for (size_t i = from; i < from + r->sizes[k]; i++) {
      const size_t n = rings_next(r, i);
      area += r->x[i] * r->y[n] - r->x[n] * r->y[i];
      inside += rings_wedge(radius, r->x[i] - x, r->y[i] - y, r->x[n] - x, r->y[n] - y);
    }
    /* Depth: in how many other rings its first vertex lies. */
    test_rings others = *r;
    int depth = 0;
    size_t at = 0;
    for (size_t m = 0; m < r->rings; m++) {
      test_rings one = {.count = r->sizes[m], .rings = 1, .sizes = {r->sizes[m]}};
      memcpy(one.x, r->x + at, r->sizes[m] * sizeof *one.x);
      memcpy(one.y, r->y + at, r->sizes[m] * sizeof *one.y);
      at += r->sizes[m];
      depth += m != k && rings_distance(&one, others.x[from], others.y[from]) > 0;
    }
    total += (depth % 2 ? -1 : 1) * (area > 0 ? inside : -inside);
    from += r->sizes[k];
  }
  return total;
}

/* ---- combinations ---- */

static inline packing_domain *solid_box(double lx, double ly, double lz, double x,
                                        double y, double z)
{
  packing_domain *domain = NULL;
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size = (packing_vec3){lx, ly, lz};
  def.corner = (packing_vec3){x, y, z};
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  return domain;
}

static inline packing_domain *solid_sphere(double r, double x, double y, double z)
{
  packing_domain *domain = NULL;
  packing_domain_sphere_def def;
  packing_domain_sphere_def_init(&def);
  def.radius = r;
  def.centre = (packing_vec3){x, y, z};
  assert_ok(packing_domain_create_sphere(NULL, &def, &domain));
  return domain;
}

static inline packing_domain *solid_cylinder(double r, double h, packing_axis axis,
                                             double x, double y, double z)
{
  packing_domain *domain = NULL;
  packing_domain_cylinder_def def;
  packing_domain_cylinder_def_init(&def);
  def.radius = r;
  def.height = h;
  def.axis = axis;
  def.base = (packing_vec3){x, y, z};
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  return domain;
}

static inline packing_domain *solid_circle(double r, double x, double y)
{
  packing_domain *domain = NULL;
  packing_domain_circle_def def;
  packing_domain_circle_def_init(&def);
  def.radius = r;
  def.centre = (packing_vec3){x, y, 0};
  assert_ok(packing_domain_create_circle(NULL, &def, &domain));
  return domain;
}

static inline packing_domain *solid_rectangle(double lx, double ly, double x, double y)
{
  packing_domain *domain = NULL;
  packing_domain_rectangle_def def;
  packing_domain_rectangle_def_init(&def);
  def.size_x = lx;
  def.size_y = ly;
  def.corner = (packing_vec3){x, y, 0};
  assert_ok(packing_domain_create_rectangle(NULL, &def, &domain));
  return domain;
}

static inline packing_status solid_try(packing_context *context,
                                       packing_operation operation, packing_domain *a,
                                       packing_domain *b, packing_domain **domain)
{
  packing_domain_combination_def def;
  packing_domain_combination_def_init(&def);
  def.operation = operation;
  def.a = a;
  def.b = b;
  return packing_domain_create_combination(context, &def, domain);
}

/* Takes over both. */
static inline packing_domain *solid_of(packing_operation operation, packing_domain *a,
                                       packing_domain *b)
{
  packing_domain *domain = NULL;
  assert_ok(solid_try(NULL, operation, a, b, &domain));
  packing_domain_destroy(a);
  packing_domain_destroy(b);
  return domain;
}

static inline double solid_distance(const packing_domain *d, double x, double y, double z)
{
  const packing_vec3 p = {x, y, z};
  return packing_domain_signed_distance(d, &p, NULL);
}

#endif
