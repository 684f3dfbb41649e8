/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes as containers against all triangles one by one: distances and their signs, the grid of
 * depths, walls near a point, balls, cells and sections. */
#include "mesh_scenes.h"
#include "domain/domain_internal.h"
#include "mesh/mesh_internal.h"
#include "mesh/surface_internal.h"

enum { POINTS = 400 };

static packing_vec3 any_point(uint64_t *random, const shape *s,
                              const packing_domain *domain, int i)
{
  return i % 2 ? shape_point(random, domain)
               : shape_close_point(random, s, i % 4 ? 0.05 : 1e-4);
}

static void test_distances(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    uint64_t random = 11 + (uint64_t)kind;
    shape *s = shape_of(kind);
    packing_domain *domain = shape_domain(s, 1);
    for (int i = 0; i < POINTS; i++) {
      packing_vec3 normal;
      const packing_vec3 p = any_point(&random, s, domain, i);
      const double d = packing_domain_signed_distance(domain, &p, &normal);
      assert_near(d, shape_distance(s, p), 1e-13);
      assert_near(shape_norm(normal), 1, 1e-12);
      /* the wall is where the normal says */
      double least = HUGE_VAL;
      const packing_vec3 x = shape_plus(p, normal, -d);
      for (size_t t = 0; t < s->triangles; t++)
        least = fmin(least, shape_norm(shape_minus(shape_nearest(s, t, x), x)));
      assert_near(least, 0, 1e-13);
    }
    packing_domain_destroy(domain);
    free(s);
  }
}

/* Corners and edges of every kind: a hair inside and outside along the way out. */
static void test_signs_at_features(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    uint64_t random = 5 + (uint64_t)kind;
    shape *s = shape_of(kind);
    packing_domain *domain = shape_domain(s, 1);
    for (int i = 0; i < POINTS; i++) {
      const packing_vec3 p = shape_close_point(&random, s, 1e-6);
      const double winding = shape_winding(s, p);
      const double d = packing_domain_signed_distance(domain, &p, NULL);
      if (fabs(d) > 1e-9)
        assert_true((d > 0) == (winding > 0.5));
    }
    packing_domain_destroy(domain);
    free(s);
  }
}

static void test_holds(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    uint64_t random = 17 + (uint64_t)kind;
    shape *s = shape_of(kind);
    packing_domain *domain = shape_domain(s, 1);
    for (int i = 0; i < 4 * POINTS; i++) {
      const packing_vec3 p = any_point(&random, s, domain, i);
      const double d = packing_domain_signed_distance(domain, &p, NULL);
      const double r[] = {0, 0.3 * shape_random(&random), fabs(d), nextafter(fabs(d), 9),
                          nextafter(fabs(d), 0)};
      for (int k = 0; k < 5; k++) {
        assert_int_equal(packing_domain_holds(domain, &p, r[k]), d >= r[k]);
        if (packing_i_domain_clear(domain, &p, r[k]))
          assert_true(d >= r[k]);
      }
    }
    packing_domain_destroy(domain);
    free(s);
  }
}

/* The grid's bounds hold everywhere, and tell the distance to some cells' width. */
static void test_depths(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    uint64_t random = 19 + (uint64_t)kind;
    shape *s = shape_of(kind);
    packing_domain *domain = shape_domain(s, 1);
    const packing_i_surface *surface = domain->body.as.mesh.surface;
    for (int i = 0; i < POINTS; i++) {
      const packing_vec3 p = any_point(&random, s, domain, i);
      const double d = shape_distance(s, p);
      const double least = packing_i_surface_depth(surface, &p);
      const double most = packing_i_surface_most_depth(surface, &p);
      assert_true(most >= fabs(d));
      assert_true(least == 0 || (least > 0 ? d >= least : d <= least));
      if (isfinite(most))
        assert_true(most <= fabs(d) + 16 * surface->depth.edge);
    }
    packing_domain_destroy(domain);
    free(s);
  }
}

/* Most of a thick body is told without the tree. */
static void test_clear_deep_inside(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_SPHERE);
  packing_domain *domain = shape_domain(s, 1);
  uint64_t random = 3;
  int deep = 0, clear = 0;
  for (int i = 0; i < 10000; i++) {
    const packing_vec3 p = shape_point(&random, domain);
    deep += packing_domain_signed_distance(domain, &p, NULL) >= 0.3;
    clear += packing_i_domain_clear(domain, &p, 0.3 - 0.15);
  }
  assert_true(deep > 500 && clear >= deep);
  packing_domain_destroy(domain);
  free(s);
}

/* A feature the slow way: the nearest points of triangles that no triangle through them beats,
 * which is the same since triangles are convex. */
typedef struct minimum {
  packing_vec3 at;
  double distance;
} minimum;

enum { MOST_MINIMA = 4096 };

static int beaten(const shape *s, packing_vec3 p, packing_vec3 x)
{
  const double d = shape_norm(shape_minus(x, p));
  for (size_t t = 0; t < s->triangles; t++)
    if (shape_norm(shape_minus(shape_nearest(s, t, x), x)) < 1e-9 &&
        shape_norm(shape_minus(shape_nearest(s, t, p), p)) < d - 1e-10)
      return 1;
  return 0;
}

static size_t slow_minima(const shape *s, packing_vec3 p, double reach, minimum *found)
{
  const int inside = shape_winding(s, p) > 0.5;
  size_t count = 0;
  for (size_t t = 0; t < s->triangles; t++) {
    const packing_vec3 x = shape_nearest(s, t, p), way = shape_minus(p, x);
    const double d = shape_norm(way);
    int known = 0;
    for (size_t i = 0; i < count; i++)
      known |= shape_norm(shape_minus(found[i].at, x)) < 1e-9;
    if (known || d >= reach || beaten(s, p, x))
      continue;
    if ((shape_winding(s, shape_plus(x, way, 1e-8 / d)) > 0.5) != inside)
      continue;
    assert_true(count < MOST_MINIMA);
    found[count++] = (minimum){x, inside ? d : -d};
  }
  return count;
}

static const minimum *nearest_of(const minimum *list, size_t count, packing_vec3 x)
{
  for (size_t i = 0; i < count; i++)
    if (shape_norm(shape_minus(list[i].at, x)) < 1e-8)
      return &list[i];
  return NULL;
}

static void check_near(const shape *s, const packing_domain *domain, packing_vec3 p,
                       double reach)
{
  static minimum slow[MOST_MINIMA];
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const int count = packing_i_domain_near_walls(domain, &p, reach, near);
  const size_t wanted = slow_minima(s, p, reach, slow);
  double farthest = 0;
  for (int i = 0; i < count; i++) {
    assert_near(shape_norm(near[i].normal), 1, 1e-12);
    assert_true(i == 0 || fabs(near[i].distance) >= fabs(near[i - 1].distance));
    assert_in_range(near[i].wall, 0, domain->body.walls - 1);
    const packing_vec3 x = shape_plus(p, near[i].normal, -near[i].distance);
    const minimum *m = nearest_of(slow, wanted, x);
    if (near[i].distance < 0 && -near[i].distance >= reach)
      return; /* far outside: the nearest alone */
    assert_non_null(m);
    assert_near(near[i].distance, m->distance, 1e-12);
    farthest = fmax(farthest, fabs(near[i].distance));
  }
  assert_int_equal(count, wanted < PACKING_I_NEAR_WALLS ? wanted : PACKING_I_NEAR_WALLS);
  if (wanted <= PACKING_I_NEAR_WALLS)
    return;
  size_t nearer = 0;
  for (size_t i = 0; i < wanted; i++)
    nearer += fabs(slow[i].distance) < farthest - 1e-9;
  assert_true(nearer < PACKING_I_NEAR_WALLS);
}

static void test_near_walls(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    uint64_t random = 23 + (uint64_t)kind;
    shape *s = shape_of(kind);
    packing_domain *domain = shape_domain(s, 1);
    for (int i = 0; i < (s->triangles > 100 ? 60 : 300); i++) {
      const packing_vec3 p =
          i % 2 ? shape_point(&random, domain) : shape_close_point(&random, s, 0.02);
      check_near(s, domain, p, 0.02 + 0.4 * shape_random(&random));
    }
    packing_domain_destroy(domain);
    free(s);
  }
}

/* A solver that runs away asks for the walls near no point at all. */
static void test_points_out_of_range(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_STAR);
  packing_domain *domain = shape_domain(s, 15);
  const packing_vec3 points[] = {{NAN, 0, 0}, {0, HUGE_VAL, 0}, {1e200, -1e200, 1e200}};
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
    assert_int_equal(packing_i_domain_near_walls(domain, &points[i], 1, near), 0);
    assert_false(packing_domain_signed_distance(domain, &points[i], NULL) >= 0);
    assert_false(packing_domain_holds(domain, &points[i], 1));
  }
  packing_domain_destroy(domain);
  free(s);
}

/* Two triangles a side are one wall, wherever the point is, on the diagonals too. */
static void test_near_walls_of_a_cube(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  packing_domain *domain = shape_domain(s, 1);
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 points[] = {
      {0.5, 0.5, 0.5}, {0.3, 0.4, 0.6}, {0.25, 0.25, 0.25}, {0.125, 0.875, 0.5}};
  int walls[6] = {0};
  for (int i = 0; i < 4; i++) {
    assert_int_equal(packing_i_domain_near_walls(domain, &points[i], 2, near), 6);
    double sum = 0;
    for (int k = 0; k < 6; k++) {
      int known = i == 0;
      walls[k] = i == 0 ? near[k].wall : walls[k];
      for (int j = 0; j < 6; j++)
        known |= near[k].wall == walls[j];
      assert_true(known);
      sum += near[k].distance;
    }
    assert_near(sum, 3, 1e-15);
  }
  /* a corner from within: three walls at distance 0; from beyond: the corner */
  const packing_vec3 corner = {1, 1, 1}, beyond = {1.25, 1.5, 1.125};
  assert_int_equal(packing_i_domain_near_walls(domain, &corner, 0.5, near), 3);
  for (int k = 0; k < 3; k++)
    assert_true(near[k].distance == 0);
  assert_int_equal(packing_i_domain_near_walls(domain, &beyond, 0.1, near), 1);
  assert_near(near[0].distance, -sqrt(0.25 * 0.25 + 0.5 * 0.5 + 0.125 * 0.125), 1e-15);
  assert_true(near[0].wall >= 12 + 18);
  packing_domain_destroy(domain);
  free(s);
}

/* The edge that looks into an angle piece is a wall of its own; those that look out are none. */
static void test_near_walls_of_an_angle(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_ANGLE);
  packing_domain *domain = shape_domain(s, 1);
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 p = {0.875, 0.75, 0.5};
  int found = 0;
  const int count = packing_i_domain_near_walls(domain, &p, 0.4, near);
  for (int i = 0; i < count; i++)
    if (near[i].normal.x < 0 && near[i].normal.y < 0) {
      found++;
      assert_near(near[i].distance, sqrt(0.125 * 0.125 + 0.25 * 0.25), 1e-15);
      assert_true(near[i].wall >= (int)s->triangles);
    }
  assert_int_equal(found, 1);
  assert_int_equal(count, 1);
  packing_domain_destroy(domain);
  free(s);
}

static void test_winding(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    uint64_t random = 29 + (uint64_t)kind;
    shape *s = shape_of(kind);
    packing_mesh *mesh = shape_mesh(s);
    packing_domain *domain = shape_domain(s, 1);
    for (int i = 0; i < POINTS; i++) {
      const packing_vec3 p = any_point(&random, s, domain, i);
      const double x[3] = {p.x, p.y, p.z};
      assert_int_equal(packing_i_mesh_winding(mesh, x, NULL, 0),
                       packing_domain_signed_distance(domain, &p, NULL) > 0);
    }
    packing_domain_destroy(domain);
    packing_mesh_destroy(mesh);
    free(s);
  }
}

/* Lengths times 2^k: all answers times 2^k, to the bit. */
static void check_scaled(const shape *s, int k)
{
  const double scale = ldexp(1, k);
  packing_domain *one = shape_domain(s, 1), *other = shape_domain(s, scale);
  uint64_t random = 31;
  assert_true(packing_domain_volume(other) ==
              packing_domain_volume(one) * ldexp(1, 3 * k));
  for (int i = 0; i < 100; i++) {
    const packing_vec3 p = any_point(&random, s, one, i);
    const packing_vec3 q = {p.x * scale, p.y * scale, p.z * scale};
    packing_vec3 m, n;
    packing_i_near_wall a[PACKING_I_NEAR_WALLS], b[PACKING_I_NEAR_WALLS];
    double v, w;
    assert_true(packing_domain_signed_distance(other, &q, &n) ==
                packing_domain_signed_distance(one, &p, &m) * scale);
    assert_true(m.x == n.x && m.y == n.y && m.z == n.z);
    const int count = packing_i_domain_near_walls(one, &p, 0.3, a);
    assert_int_equal(packing_i_domain_near_walls(other, &q, 0.3 * scale, b), count);
    for (int j = 0; j < count; j++)
      assert_true(a[j].wall == b[j].wall && a[j].distance * scale == b[j].distance);
    assert_int_equal(packing_i_domain_clear(one, &p, 0.1),
                     packing_i_domain_clear(other, &q, 0.1 * scale));
    assert_ok(packing_domain_sphere_volume(one, &p, 0.2, 1e-6, &v, NULL));
    assert_ok(packing_domain_sphere_volume(other, &q, 0.2 * scale, 1e-6, &w, NULL));
    assert_true(v * ldexp(1, 3 * k) == w);
  }
  packing_domain_destroy(one);
  packing_domain_destroy(other);
}

static void test_scaling(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    shape *s = shape_of(kind);
    check_scaled(s, 30);
    check_scaled(s, -41);
    free(s);
  }
}

/* Balls anywhere in a box of triangles, on its faces, edges and corners, against the box. */
static void test_balls_in_a_box(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  packing_domain *mesh = shape_domain(s, 1), *box = test_box(1, 1, 1, 0);
  uint64_t random = 37;
  for (int i = 0; i < 3000; i++) {
    packing_vec3 p = shape_point(&random, mesh);
    const double r = 0.02 + 0.8 * shape_random(&random);
    double v, w, error;
    if (i % 3 == 0)
      p.x = 0;
    if (i % 6 == 0)
      p.y = 1;
    if (i % 12 == 0)
      p.z = 1;
    assert_ok(packing_domain_sphere_volume(mesh, &p, r, 1e-9, &v, &error));
    assert_ok(packing_domain_sphere_volume(box, &p, r, 1e-9, &w, NULL));
    const int is_close = i % 3 == 0;
    assert_near(v, w, (is_close ? 1e-7 : 1e-13) * r * r * r);
    assert_true(error <= (is_close ? 1e-5 : 1e-12) * r * r * r);
  }
  packing_domain_destroy(mesh);
  packing_domain_destroy(box);
  free(s);
}

/* The same container as the user's function, whose balls come by subdivision. */
static double distance_of(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  return packing_domain_signed_distance(user, point, normal);
}

static packing_domain *as_custom(packing_domain *mesh)
{
  packing_domain_custom_def def;
  packing_domain *custom = NULL;
  packing_domain_custom_def_init(&def);
  def.signed_distance = distance_of;
  def.user = mesh;
  packing_domain_bounds(mesh, &def.bounds);
  def.volume = packing_domain_volume(mesh);
  assert_ok(packing_domain_create_custom(NULL, &def, &custom));
  return custom;
}

static void test_balls_by_subdivision(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    uint64_t random = 41 + (uint64_t)kind;
    shape *s = shape_of(kind);
    packing_domain *mesh = shape_domain(s, 1), *custom = as_custom(mesh);
    for (int i = 0; i < 6; i++) {
      const packing_vec3 p = shape_close_point(&random, s, 0.1);
      const double r = 0.1 + 0.3 * shape_random(&random);
      double v, w, error;
      assert_ok(packing_domain_sphere_volume(mesh, &p, r, 1e-6, &v, NULL));
      assert_ok(packing_domain_sphere_volume(custom, &p, r, 3e-3, &w, &error));
      assert_near(v, w, fmax(0.02 * r * r * r, 3 * error));
    }
    packing_domain_destroy(mesh);
    packing_domain_destroy(custom);
    free(s);
  }
}

/* Cells and sections of a cube of triangles are those of the box. */
static void test_cells_and_sections(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  packing_domain *mesh = shape_domain(s, 1), *box = test_box(1, 1, 1, 0);
  const packing_i_cell cell = {.kind = PACKING_I_CELL_BOX,
                               .box = {{0.2, -HUGE_VAL, 0.3}, {0.7, 0.4, HUGE_VAL}}};
  const packing_vec3 p = {0.25, 0.1, 0.9};
  const packing_i_plane plane = {
      {0.4, 0.3, 0.5}, {0.6, 0.8, 0}, {0, 0, 1}, {0.8, -0.6, 0}};
  double v, w, error, lo[2], hi[2];
  assert_int_equal(packing_i_domain_cell_volume(mesh, &cell, &p, 0, 1e-4, &v, &error), 0);
  assert_near(v, 0.5 * 0.4 * 0.7, 1e-4);
  assert_int_equal(packing_i_domain_cell_volume(mesh, &cell, &p, 0.3, 1e-4, &v, &error),
                   0);
  assert_int_equal(packing_i_domain_cell_volume(box, &cell, &p, 0.3, 1e-4, &w, &error),
                   0);
  assert_near(v, w, 1e-4);
  assert_true(packing_i_domain_section_window(mesh, &plane, lo, hi));
  assert_int_equal(packing_i_domain_section_area(mesh, &plane, 0, 0, 0, 1e-4, &v, &error),
                   0);
  assert_int_equal(packing_i_domain_section_area(box, &plane, 0, 0, 0, 1e-4, &w, &error),
                   0);
  assert_near(v, w, 1e-3);
  packing_domain_destroy(mesh);
  packing_domain_destroy(box);
  free(s);
}

static void test_inset(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_ANGLE);
  packing_domain *mesh = shape_domain(s, 1), *inset = NULL, *again = NULL;
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 p = {0.4, 0.6, 0.5};
  assert_ok(packing_domain_create_inset(NULL, mesh, 0.125, &inset));
  assert_ok(packing_domain_create_inset(NULL, inset, 0.125, &again));
  const double d = packing_domain_signed_distance(mesh, &p, NULL);
  packing_domain_destroy(mesh);
  packing_domain_destroy(inset);
  assert_true(packing_domain_signed_distance(again, &p, NULL) == d - 0.25);
  assert_true(packing_domain_holds(again, &p, d - 0.25));
  assert_false(packing_domain_holds(again, &p, nextafter(d - 0.25, 1)));
  assert_true(packing_i_domain_near_walls(again, &p, 0.4, near) > 0);
  /* two arms of 1.5 x 0.5 with a square in common; the edge that looks in becomes round */
  const double across = 2 * 0.75 - 0.25 + (1 - MESH_PI / 4) * 0.0625;
  assert_near(packing_domain_volume(again), across * 0.5, 3e-4);
  packing_domain_destroy(again);
  free(s);
}

/* Balls in an inset against balls in the smaller box that it is. */
static void test_balls_in_an_inset(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  packing_domain *mesh = shape_domain(s, 1), *box = test_box(1, 1, 1, 0);
  packing_domain *in_mesh = NULL, *in_box = NULL;
  uint64_t random = 43;
  assert_ok(packing_domain_create_inset(NULL, mesh, 0.25, &in_mesh));
  assert_ok(packing_domain_create_inset(NULL, box, 0.25, &in_box));
  assert_near(packing_domain_volume(in_mesh), packing_domain_volume(in_box), 1e-5);
  for (int i = 0; i < 300; i++) {
    const packing_vec3 p = shape_point(&random, mesh);
    const double r = 0.02 + 0.2 * shape_random(&random);
    double v, w, error;
    assert_ok(packing_domain_sphere_volume(in_mesh, &p, r, 1e-3, &v, &error));
    assert_ok(packing_domain_sphere_volume(in_box, &p, r, 1e-9, &w, NULL));
    assert_near(v, w, 1e-2 * r * r * r);
  }
  packing_domain_destroy(in_mesh);
  packing_domain_destroy(in_box);
  packing_domain_destroy(mesh);
  packing_domain_destroy(box);
  free(s);
}

/* The audit of balls in a mesh tells the farthest, deep ones or not. */
static void test_audit(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_SPHERE);
  packing_domain *domain = shape_domain(s, 1);
  enum { COUNT = 400 };
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT], most = 0;
  uint64_t random = 47;
  size_t out = 0;
  for (int i = 0; i < COUNT; i++) {
    const packing_vec3 p = shape_point(&random, domain);
    x[i] = p.x;
    y[i] = p.y;
    z[i] = p.z;
    r[i] = 0.05 + 0.1 * shape_random(&random);
    const double by = (r[i] - shape_distance(s, p)) / r[i];
    most = fmax(most, by);
    out += by > 1e-9;
  }
  packing_view view;
  packing_audit_report report;
  packing_view_init_arrays(&view, COUNT, x, y, z, r);
  packing_audit_report_init(&report);
  assert_ok(packing_audit(NULL, NULL, domain, &view, &report));
  assert_near(report.max_protrusion, most, 1e-12 * most);
  assert_int_equal(report.protrusions, out);
  packing_domain_destroy(domain);
  free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_distances),
      cmocka_unit_test(test_signs_at_features),
      cmocka_unit_test(test_holds),
      cmocka_unit_test(test_depths),
      cmocka_unit_test(test_clear_deep_inside),
      cmocka_unit_test(test_near_walls),
      cmocka_unit_test(test_points_out_of_range),
      cmocka_unit_test(test_near_walls_of_a_cube),
      cmocka_unit_test(test_near_walls_of_an_angle),
      cmocka_unit_test(test_winding),
      cmocka_unit_test(test_scaling),
      cmocka_unit_test(test_balls_in_a_box),
      cmocka_unit_test(test_balls_by_subdivision),
      cmocka_unit_test(test_cells_and_sections),
      cmocka_unit_test(test_inset),
      cmocka_unit_test(test_audit),
      cmocka_unit_test(test_balls_in_an_inset),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
