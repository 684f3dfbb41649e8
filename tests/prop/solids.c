/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polygons against all their edges one by one; combinations against dense spheres and
 * Monte-Carlo volumes. */
#include "solids.h"

static void polygon_is(const test_rings *r, uint64_t *seed, int points)
{
  packing_domain *d = rings_domain(r);
  packing_bounds b;
  packing_domain_bounds(d, &b);
  const double size = fmax(b.hi.x - b.lo.x, b.hi.y - b.lo.y);
  assert_close(packing_domain_volume(d), rings_disc(r, 0, 0, 10 * size), 1e-12);
  for (int i = 0; i < points; i++) {
    const packing_vec3 p = scene_random_point(seed, d, 0.2);
    packing_vec3 n;
    const double distance = packing_domain_signed_distance(d, &p, &n);
    assert_near(distance, rings_distance(r, p.x, p.y), 1e-13 * size);
    assert_near(hypot(n.x, n.y), 1, 1e-14);
    assert_near(rings_distance(r, p.x - distance * n.x, p.y - distance * n.y), 0,
                1e-13 * size);
    const double radius = 0.5 * size * scene_random(seed) * scene_random(seed);
    double v;
    assert_ok(packing_domain_sphere_volume(d, &p, radius, 1e-9, &v, NULL));
    assert_near(v, rings_disc(r, p.x, p.y, radius), 1e-12 * TEST_PI * radius * radius);
  }
  packing_domain_destroy(d);
}

static void polygons_agree_with_all_their_edges(void **state)
{
  (void)state;
  uint64_t seed = 1;
  for (int i = 0; i < 12; i++) {
    test_rings star = {0};
    rings_add_star(&star, &seed, 3 + 23 * (size_t)i % 200, 0.3, -0.7, 0.2, 1, i & 1);
    polygon_is(&star, &seed, 150);
    const test_rings many = rings_many(&seed), comb = rings_comb(5 + i, 3 + i);
    polygon_is(&many, &seed, 60);
    polygon_is(&comb, &seed, 60);
  }
  const test_rings l = rings_l();
  polygon_is(&l, &seed, 500);
}

/* Discs round every corner and every middle of an edge: vertices on circles. */
static void discs_at_features_are_cut_exactly(void **state)
{
  (void)state;
  const test_rings r = rings_l();
  packing_domain *d = rings_domain(&r);
  for (size_t i = 0; i < r.count; i++)
    for (size_t k = 0; k < r.count; k++) {
      const packing_vec3 p = {0.5 * (r.x[i] + r.x[k]), 0.5 * (r.y[i] + r.y[k]), 0};
      for (size_t m = 0; m < r.count; m++) {
        const double radius = hypot(r.x[m] - p.x, r.y[m] - p.y);
        double v;
        if (radius == 0)
          continue;
        assert_ok(packing_domain_sphere_volume(d, &p, radius, 1e-9, &v, NULL));
        assert_near(v, rings_disc(&r, p.x, p.y, radius), 1e-12 * radius * radius);
      }
    }
  packing_domain_destroy(d);
}

/* ---- combinations ---- */

enum { COMBINATIONS = 10 };

static packing_domain *combination_of(int k)
{
  switch (k) {
  case 0:
    return solid_of(PACKING_UNION, solid_box(2, 1, 1.1, 0, 0, 0),
                    solid_box(0.9, 2, 1, 0.3, 0.4, 0.2));
  case 1:
    return solid_of(PACKING_UNION, solid_sphere(1, 0, 0, 0),
                    solid_sphere(0.8, 1, 0.2, 0));
  case 2:
    return solid_of(PACKING_UNION, solid_cylinder(0.7, 2, PACKING_AXIS_Z, 0, 0, 0),
                    solid_sphere(1, 0.2, 0, 2));
  case 3:
    return solid_of(PACKING_UNION, solid_cylinder(0.7, 3, PACKING_AXIS_Z, 0, 0, -1.5),
                    solid_cylinder(0.6, 3, PACKING_AXIS_X, -1.5, 0, 0.1));
  case 4:
    return solid_of(PACKING_DIFFERENCE, solid_box(2, 2, 2, -1, -1, -1),
                    solid_of(PACKING_INTERSECTION, solid_sphere(0.7, 0, 0, 0),
                             solid_box(1, 1, 1, -0.2, -0.3, -0.2)));
  case 5:
    return solid_of(PACKING_INTERSECTION,
                    solid_of(PACKING_UNION, solid_box(2, 1, 1, -1, -0.5, -0.5),
                             solid_box(1, 2, 1, -0.5, -1, -0.5)),
                    solid_sphere(0.9, 0, 0, 0.1));
  case 6:
    return solid_of(PACKING_UNION, solid_circle(1, 0, 0), solid_rectangle(3, 0.5, 0, 0));
  case 7: {
    const test_rings r = rings_l();
    return solid_of(PACKING_UNION, rings_domain(&r), solid_circle(1.2, 3.1, 2.2));
  }
  case 8: {
    const test_rings r = rings_l();
    return solid_of(PACKING_DIFFERENCE, solid_rectangle(6, 7, -1, -1), rings_domain(&r));
  }
  default:
    return solid_of(PACKING_UNION,
                    solid_of(PACKING_DIFFERENCE, solid_box(2, 1, 1, 0, 0, 0),
                             solid_sphere(0.6, 1, 1, 0.5)),
                    solid_box(1, 1, 1, 0.5, 0.6, 0));
  }
}

static packing_vec3 direction(uint64_t *seed, int dim)
{
  for (;;) {
    const packing_vec3 v = {2 * scene_random(seed) - 1, 2 * scene_random(seed) - 1,
                            dim == 2 ? 0 : 2 * scene_random(seed) - 1};
    const double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    if (length > 0.1 && length <= 1)
      return (packing_vec3){v.x / length, v.y / length, v.z / length};
  }
}

/* No point of a sphere that is held lies outside, and its centre's foot is a wall. */
static void no_sphere_protrudes(void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int k = 0; k < COMBINATIONS; k++) {
    packing_domain *d = combination_of(k);
    int inside = 0;
    for (int i = 0; i < 60; i++) {
      const packing_vec3 p = scene_random_point(&seed, d, 0);
      packing_vec3 n;
      const double r = packing_domain_signed_distance(d, &p, &n);
      if (!(r > 0))
        continue;
      inside++;
      assert_true(packing_domain_holds(d, &p, r));
      assert_false(packing_domain_holds(d, &p, nextafter(r, HUGE_VAL)));
      for (int m = 0; m < 60; m++) {
        const packing_vec3 u = direction(&seed, packing_domain_dim(d));
        const double at = solid_distance(d, p.x + r * u.x, p.y + r * u.y, p.z + r * u.z);
        assert_true(at >= -1e-12 * r);
      }
      /* Its foot is a wall, but for what the search leaves open where a seam is equally far
       * all along. */
      assert_true(solid_distance(d, p.x - r * n.x, p.y - r * n.y, p.z - r * n.z) <=
                  1e-3 * r);
    }
    assert_true(inside > 5);
    packing_domain_destroy(d);
  }
}

/* Whether a sphere is held is what the signed distance says, of insets too. */
static void holds_is_the_signed_distance(void **state)
{
  (void)state;
  uint64_t seed = 8;
  for (int k = 0; k < COMBINATIONS; k++) {
    packing_domain *d = combination_of(k), *inset = NULL;
    assert_ok(packing_domain_create_inset(NULL, d, 0.0625, &inset));
    for (int i = 0; i < 60; i++) {
      const packing_domain *of = i & 1 ? inset : d;
      const packing_vec3 p = scene_random_point(&seed, of, 0);
      const double r = packing_domain_signed_distance(of, &p, NULL);
      const double tried[] = {r,
                              nextafter(r, HUGE_VAL),
                              nextafter(r, 0),
                              r * (1 - 1e-9),
                              r * (1 + 1e-9),
                              2 * r * scene_random(&seed)};
      for (int m = 0; m < 6 && r > 0; m++)
        assert_int_equal(packing_domain_holds(of, &p, tried[m]), r >= tried[m]);
    }
    packing_domain_destroy(inset);
    packing_domain_destroy(d);
  }
}

/* The side is right, and it changes no faster than the point moves (but for what the search
 * leaves open). */
static void distances_are_lipschitz(void **state)
{
  (void)state;
  uint64_t seed = 9;
  for (int k = 0; k < COMBINATIONS; k++) {
    packing_domain *d = combination_of(k);
    for (int i = 0; i < 60; i++) {
      const packing_vec3 p = scene_random_point(&seed, d, 0.2);
      const packing_vec3 q = scene_random_point(&seed, d, 0.2);
      const double way = sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) +
                              (p.z - q.z) * (p.z - q.z));
      const double a = packing_domain_signed_distance(d, &p, NULL);
      const double b = packing_domain_signed_distance(d, &q, NULL);
      assert_true(fabs(a - b) <= way * (1 + 1e-3));
    }
    packing_domain_destroy(d);
  }
}

/* Volumes within 6 standard deviations of 20000 points: false alarms 2e-9 a run each; and parts of
 * balls within 1e-3 and 6 of their own. */
static void volumes_agree_with_points(void **state)
{
  (void)state;
  uint64_t seed = 13;
  enum { POINTS = 20000 };
  for (int k = 0; k < COMBINATIONS; k++) {
    packing_domain *d = combination_of(k);
    packing_bounds b;
    packing_domain_bounds(d, &b);
    const int dim = packing_domain_dim(d);
    double box = (b.hi.x - b.lo.x) * (b.hi.y - b.lo.y);
    box *= dim == 3 ? b.hi.z - b.lo.z : 1;
    int inside = 0, both = 0;
    const packing_vec3 centre = scene_random_point(&seed, d, 0);
    const double r = 0.4;
    for (int i = 0; i < POINTS; i++) {
      const packing_vec3 p = scene_random_point(&seed, d, 0);
      const int in = packing_domain_holds(d, &p, 0);
      const double x = p.x - centre.x, y = p.y - centre.y, z = p.z - centre.z;
      inside += in;
      both += in && x * x + y * y + z * z < r * r;
    }
    const double share = packing_domain_volume(d) / box;
    assert_near(inside / (double)POINTS, share,
                6 * sqrt(share * (1 - share) / POINTS) + 1e-4);
    double v;
    assert_ok(packing_domain_sphere_volume(d, &centre, r, 1e-4, &v, NULL));
    assert_near(both / (double)POINTS, v / box,
                6 * sqrt((v / box + 1e-3) / POINTS) + 1e-3 * v / box);
    packing_domain_destroy(d);
  }
}

static packing_domain *scaled_union(double by)
{
  return solid_of(PACKING_UNION,
                  solid_of(PACKING_DIFFERENCE, solid_box(2 * by, by, by, 0, 0, 0),
                           solid_sphere(0.6 * by, by, by, 0.5 * by)),
                  solid_cylinder(0.5 * by, 2 * by, PACKING_AXIS_Y, by, 0, 0.5 * by));
}

static void lengths_scale_by_powers_of_two(void **state)
{
  (void)state;
  uint64_t seed = 21;
  packing_domain *a = scaled_union(1), *b = scaled_union(0x1p-30);
  packing_vec3 p, q;
  double s, t;
  assert_true(packing_domain_volume(b) == packing_domain_volume(a) * 0x1p-90);
  for (int i = 0; i < 60; i++) {
    p = scene_random_point(&seed, a, 0.1);
    assert_true(solid_distance(b, p.x * 0x1p-30, p.y * 0x1p-30, p.z * 0x1p-30) ==
                solid_distance(a, p.x, p.y, p.z) * 0x1p-30);
  }
  assert_ok(packing_domain_innermost(NULL, a, 0.01, &p, &s));
  assert_ok(packing_domain_innermost(NULL, b, 0.01 * 0x1p-30, &q, &t));
  assert_true(q.x == p.x * 0x1p-30 && q.y == p.y * 0x1p-30 && q.z == p.z * 0x1p-30);
  assert_true(t == s * 0x1p-30);
  packing_domain_destroy(a);
  packing_domain_destroy(b);
}

/* 1e5 vertices are no matter: a wheel of teeth against its formula. */
static void a_hundred_thousand_edges_are_fine(void **state)
{
  (void)state;
  enum { N = 100000 };
  double *x = malloc(N * sizeof *x), *y = malloc(N * sizeof *y);
  packing_domain *d = NULL;
  packing_domain_polygon_def def;
  assert_non_null(x);
  assert_non_null(y);
  for (int i = 0; i < N; i++) {
    const double rho = i & 1 ? 1 : 1.0009765625, angle = 2 * TEST_PI * i / N;
    x[i] = rho * cos(angle);
    y[i] = rho * sin(angle);
  }
  packing_domain_polygon_def_init(&def);
  def.count = N;
  def.x = x;
  def.y = y;
  assert_ok(packing_domain_create_polygon(NULL, &def, &d));
  assert_close(packing_domain_volume(d), 0.5 * 1.0009765625 * N * sin(2 * TEST_PI / N),
               1e-11);
  assert_close(solid_distance(d, 0, 0, 0), 1.0, 1e-9);
  assert_true(solid_distance(d, 0.5, 0.6, 0) > 1 - hypot(0.5, 0.6) - 1e-12);
  packing_domain_destroy(d);
  free(x);
  free(y);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(polygons_agree_with_all_their_edges),
      cmocka_unit_test(discs_at_features_are_cut_exactly),
      cmocka_unit_test(no_sphere_protrudes),
      cmocka_unit_test(holds_is_the_signed_distance),
      cmocka_unit_test(distances_are_lipschitz),
      cmocka_unit_test(volumes_agree_with_points),
      cmocka_unit_test(lengths_scale_by_powers_of_two),
      cmocka_unit_test(a_hundred_thousand_edges_are_fine),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
