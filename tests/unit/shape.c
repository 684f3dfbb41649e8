/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes as handles, their volumes and moments; gaps and overlaps of bodies (F6), also of
 * the two-sphere cluster; walls and clearance. */
#include "cluster.h"
#include "domain_scenes.h"

static const double upright[4] = {1, 0, 0, 0};

static packing_body sphere(double x, double y, double z, double r)
{
  const packing_vec3 centre = {x, y, z};
  return packing_body_sphere(centre, r);
}

static void handles(void **state)
{
  (void)state;
  packing_shape *shape = test_cluster(0.7, 1);
  assert_int_equal(test_clusters_alive(), 1);
  assert_ptr_equal(packing_shape_retain(shape), shape);
  packing_shape_destroy(shape);
  assert_int_equal(test_clusters_alive(), 1);
  assert_string_equal(packing_shape_name(shape), "two-sphere cluster");
  packing_shape_destroy(shape);
  assert_int_equal(test_clusters_alive(), 0);
  packing_shape_destroy(NULL);
  assert_null(packing_shape_retain(NULL));
  assert_string_equal(packing_shape_name(NULL), "sphere");
}

/* The context and the caller's name may be gone before the shape is. */
static void outlives_its_context(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  packing_shape *shape = NULL;
  assert_ok(test_cluster_create(context, 0.6, 0, &shape));
  packing_context_destroy(context);
  assert_true(a.live > 0);
  assert_string_equal(packing_shape_name(shape), "two-sphere cluster");
  packing_shape_destroy(shape);
  assert_int_equal(a.live, 0);
}

static double any_gap(void *user, const packing_body *a, const packing_body *b)
{
  (void)user, (void)a, (void)b;
  return 1;
}

static double any_clearance(void *user, const packing_body *a,
                            const packing_domain *domain, int wall, packing_vec3 *normal)
{
  (void)user, (void)a, (void)domain, (void)wall, (void)normal;
  return 1;
}

static double any_volume(void *user, double r, int dim)
{
  (void)user, (void)dim;
  return 2.5 * r;
}

static int never_overlaps(void *user, const packing_body *a, const packing_body *b)
{
  (void)user, (void)a, (void)b;
  return 0;
}

static packing_shape_def least_def(void)
{
  packing_shape_def def;
  packing_shape_def_init(&def);
  def.name = "nut";
  def.gap = any_gap;
  def.clearance = any_clearance;
  def.volume = any_volume;
  return def;
}

#define REFUSE(member, value, status, field)                                             \
  do {                                                                                   \
    packing_shape_def bad = least_def();                                                 \
    bad.member = (value);                                                                \
    assert_fails(context, packing_shape_create_custom(context, &bad, &shape), (status),  \
                 (field));                                                               \
    assert_null(shape);                                                                  \
  } while (0)

static void refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_shape *shape = NULL;
  const packing_shape_def good = least_def();
  REFUSE(name, NULL, PACKING_ERR_INVALID, "name");
  REFUSE(gap, NULL, PACKING_ERR_INVALID, "gap");
  REFUSE(clearance, NULL, PACKING_ERR_INVALID, "clearance");
  REFUSE(volume, NULL, PACKING_ERR_INVALID, "volume");
  REFUSE(struct_size, 3, PACKING_ERR_ABI, "struct_size");
  assert_fails(context, packing_shape_create_custom(context, NULL, &shape),
               PACKING_ERR_INVALID, "def");
  assert_fails(context, packing_shape_create_custom(context, &good, NULL),
               PACKING_ERR_INVALID, "shape");
  packing_context_destroy(context);
}

/* Only what has no default; the overlap is the gap's sign where none is given. */
static void least_shape(void **state)
{
  (void)state;
  packing_shape_def def = least_def();
  packing_shape *shape = NULL;
  double moments[3] = {7, 8, 9};
  assert_ok(packing_shape_create_custom(NULL, &def, &shape));
  assert_int_equal(packing_shape_inertia(shape, 1, 3, moments), 0);
  assert_true(moments[0] == 7 && moments[1] == 8 && moments[2] == 9);
  assert_true(packing_shape_volume(shape, 2, 3) == 5);
  packing_shape_destroy(shape);

  shape = test_cluster(0.5, 1);
  const packing_vec3 origin = {0, 0, 0};
  const packing_body a = test_cluster_body(shape, origin, 1, upright);
  packing_body b = sphere(0, 0.9, 0, 0.25);
  /* The spheres lie at x = +-0.5: sqrt(.25 + .81) = 1.0296 is more than 0.75. */
  assert_close(packing_body_gap(&a, &b), sqrt(1.06) - 0.75, 1e-15);
  assert_int_equal(packing_body_overlap(&a, &b), 0);
  b.centre.y = 0.5;
  assert_int_equal(packing_body_overlap(&a, &b), 1);
  packing_shape_destroy(shape);

  def.overlap = never_overlaps;
  assert_ok(packing_shape_create_custom(NULL, &def, &shape));
  const packing_body c = test_cluster_body(shape, origin, 1, upright);
  assert_int_equal(packing_body_overlap(&c, &b), 0);
  packing_shape_destroy(shape);
}

static void volumes_of_spheres(void **state)
{
  (void)state;
  double m[3];
  assert_close(packing_shape_volume(NULL, 2, 3), 32 * TEST_PI / 3, 1e-15);
  assert_close(packing_shape_volume(NULL, 2, 2), 4 * TEST_PI, 1e-15);
  assert_int_equal(packing_shape_inertia(NULL, 2, 3, m), 1);
  for (int k = 0; k < 3; k++)
    assert_close(m[k], 8 * TEST_PI / 15 * 32, 1e-15);
  assert_int_equal(packing_shape_inertia(NULL, 2, 2, m), 1);
  assert_true(m[0] == 0 && m[1] == 0);
  assert_close(m[2], 8 * TEST_PI, 1e-15);
}

/* Two spheres that just touch, and one that is a sphere; between, against slices. */
static void volumes_of_clusters(void **state)
{
  (void)state;
  double m[3], n[3];
  packing_shape *apart = test_cluster(0.5, 1), *same = test_cluster(1, 1);
  assert_close(packing_shape_volume(apart, 2, 3), 8 * TEST_PI / 3, 1e-14);
  assert_close(packing_shape_volume(apart, 2, 2), 2 * TEST_PI, 1e-14);
  assert_int_equal(packing_shape_inertia(apart, 2, 3, m), 1);
  assert_close(m[0], 2 * 8 * TEST_PI / 15, 1e-14);
  assert_close(m[1], 2 * 8 * TEST_PI / 15 + 8 * TEST_PI / 3, 1e-14);
  packing_shape_inertia(apart, 2, 2, m);
  assert_close(m[2], 2 * (0.5 * TEST_PI + TEST_PI), 1e-9);
  for (int dim = 2; dim <= 3; dim++) {
    assert_close(packing_shape_volume(same, 1.7, dim),
                 packing_shape_volume(NULL, 1.7, dim), 1e-14);
    packing_shape_inertia(same, 1.7, dim, m);
    packing_shape_inertia(NULL, 1.7, dim, n);
    assert_close(m[2], n[2], 1e-9);
  }
  packing_shape_destroy(apart);
  packing_shape_destroy(same);

  packing_shape *shape = test_cluster(0.7, 1);
  enum { SLICES = 20000 };
  double volume = 0, area = 0;
  for (int i = 0; i < SLICES; i++) {
    const double y = (i + 0.5) / SLICES - 0.3, h2 = 0.49 - y * y;
    if (y < 0.7) {
      volume += 2 * TEST_PI * h2 / SLICES;
      area += 4 * sqrt(h2) / SLICES;
    }
  }
  assert_close(packing_shape_volume(shape, 1, 3), volume, 1e-6);
  assert_close(packing_shape_volume(shape, 1, 2), area, 1e-5);
  packing_shape_destroy(shape);
}

/* F6: |c1 - c2| - r1 - r2. */
static void gaps_of_spheres(void **state)
{
  (void)state;
  const packing_body a = sphere(1, 2, 3, 1.5);
  packing_body b = sphere(3, 5, 9, 2.5);
  assert_true(packing_body_gap(&a, &b) == 3 && packing_body_gap(&b, &a) == 3);
  assert_int_equal(packing_body_overlap(&a, &b), 0);
  b.r = 5.5;
  assert_true(packing_body_gap(&a, &b) == 0);
  assert_int_equal(packing_body_overlap(&a, &b), 0);
  b.r = nextafter(5.5, 6);
  assert_true(packing_body_gap(&a, &b) < 0);
  assert_int_equal(packing_body_overlap(&a, &b), 1);
  assert_true(packing_body_gap(&a, &a) == -3);
}

static packing_body random_body(uint64_t *random, const packing_shape *shape, int dim)
{
  const packing_vec3 centre = {4 * scene_random(random), 4 * scene_random(random),
                               dim == 3 ? 4 * scene_random(random) : 0};
  double q[4], length = 0;
  for (int k = 0; k < 4; k++) {
    q[k] = dim == 3 || k == 0 || k == 3 ? scene_random(random) - 0.5 : 0;
    length += q[k] * q[k];
  }
  for (int k = 0; k < 4; k++)
    q[k] /= sqrt(length);
  return test_cluster_body(shape, centre, 0.3 + scene_random(random), q);
}

/* Whether a point is inside a body: it overlaps a sphere of no size there. */
static int holds(const packing_body *body, packing_vec3 p)
{
  const packing_body point = packing_body_sphere(p, 0);
  return packing_body_gap(body, &point) < 0;
}

/* Random pairs: swapped they have the same gap; it changes by no more than the way gone;
 * where it is positive no point lies in both, where it is negative one does. */
static void gaps_of_random_pairs(void **state)
{
  (void)state;
  uint64_t random = 11;
  packing_shape *cluster = test_cluster(0.65, 1);
  for (int i = 0; i < 4000; i++) {
    const int dim = 2 + i % 2;
    const packing_body a = random_body(&random, i % 4 < 2 ? cluster : NULL, dim),
                       b = random_body(&random, i % 8 < 4 ? cluster : NULL, dim);
    const double gap = packing_body_gap(&a, &b);
    assert_true(gap == packing_body_gap(&b, &a));
    assert_int_equal(packing_body_overlap(&a, &b), gap < 0);
    packing_body moved = a;
    const double step = 0x1p-10 * scene_random(&random);
    moved.centre.x += step;
    assert_true(fabs(packing_body_gap(&moved, &b) - gap) <= step * (1 + 1e-9));
    int shared = 0;
    for (int k = 0; k < 40; k++) {
      const double t = scene_random(&random);
      const packing_vec3 p = {a.centre.x + t * (b.centre.x - a.centre.x),
                              a.centre.y + t * (b.centre.y - a.centre.y),
                              a.centre.z + t * (b.centre.z - a.centre.z)};
      shared += holds(&a, p) && holds(&b, p);
    }
    if (gap > 0)
      assert_int_equal(shared, 0);
    if (gap < -0.2 && a.shape == NULL && b.shape == NULL)
      assert_true(shared > 0);
  }
  packing_shape_destroy(cluster);
}

static packing_body wall(const packing_domain *domain, int number)
{
  packing_body body;
  memset(&body, 0, sizeof body);
  body.domain = domain;
  body.wall = number;
  return body;
}

static double wall_gap(const scene *s, int number, packing_body a)
{
  packing_domain *domain = scene_make(s);
  const packing_body b = wall(domain, number);
  packing_vec3 normal;
  const double gap = packing_body_gap(&a, &b);
  assert_true(packing_body_gap(&b, &a) == gap);
  assert_true(packing_body_wall_gap(&a, domain, number, &normal) == gap);
  assert_int_equal(packing_body_overlap(&a, &b), gap < 0);
  if (isfinite(gap))
    assert_close(sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z),
                 1.0, 1e-15);
  packing_domain_destroy(domain);
  return gap;
}

/* One wall at a time, by hand. */
static void gaps_of_walls(void **state)
{
  (void)state;
  const scene box = {.kind = SCENE_BOX, .a = 10, .b = 8, .c = 6, .open = 1};
  assert_true(wall_gap(&box, 0, sphere(3, 2, 1, 0.5)) == 2.5);
  assert_true(wall_gap(&box, 1, sphere(3, 2, 1, 0.5)) == 6.5);
  assert_true(wall_gap(&box, 3, sphere(3, 2, 1, 0.5)) == 5.5);
  assert_true(wall_gap(&box, 4, sphere(3, 2, 1, 2)) == -1);
  assert_true(wall_gap(&box, 5, sphere(3, 2, 1, 0.5)) == HUGE_VAL);
  assert_true(wall_gap(&box, 17, sphere(3, 2, 1, 0.5)) == HUGE_VAL);
  assert_true(wall_gap(&box, -1, sphere(3, 2, 1, 0.5)) == 0.5);
  const scene ball = {.kind = SCENE_SPHERE, .a = 10, .at = {1, 1, 1}};
  assert_true(wall_gap(&ball, 0, sphere(3, 4, 7, 1.5)) == 1.5);
  assert_true(wall_gap(&ball, 1, sphere(3, 4, 7, 1.5)) == HUGE_VAL);
  const scene ring = {.kind = SCENE_ANNULUS, .a = 2, .b = 9};
  assert_true(wall_gap(&ring, 0, sphere(3, 4, 0, 1)) == 3);
  assert_true(wall_gap(&ring, 1, sphere(3, 4, 0, 1)) == 2);
  /* The cone rho = 1 + 3 h / 4 above the origin: 0.8 of the gap across. */
  const scene cone = {.kind = SCENE_CONE, .a = 1, .b = 4, .c = 4, .axis = 2};
  double least = HUGE_VAL;
  for (int k = 0; k < 4; k++) {
    const double gap = wall_gap(&cone, k, sphere(1.2, 1.6, 2, 0.25));
    least = fabs(gap - 0.15) < fabs(least - 0.15) ? gap : least;
  }
  assert_near(least, 0.8 * 0.5 - 0.25, 1e-15);
}

/* Clearance: all walls together, of spheres and clusters. */
static void clearance(void **state)
{
  (void)state;
  packing_domain *box = test_box(10, 8, 6, 0);
  packing_shape *shape = test_cluster(0.5, 1);
  packing_vec3 normal;
  const packing_body ball = sphere(3, 2, 5.5, 1);
  assert_true(packing_body_clearance(&ball, box, &normal) == -0.5);
  assert_true(normal.x == 0 && normal.y == 0 && normal.z == -1);
  assert_true(packing_body_clearance(&ball, box, NULL) == -0.5);
  const packing_body lying = test_cluster_body(shape, ball.centre, 1, upright);
  assert_true(packing_body_clearance(&lying, box, &normal) == 0);
  /* A quarter turn about y. */
  const double half = sqrt(0.5), turned[4] = {half, 0, half, 0};
  const packing_body standing = test_cluster_body(shape, ball.centre, 1, turned);
  assert_near(packing_body_clearance(&standing, box, &normal), -0.5, 1e-15);
  assert_true(normal.z == -1);
  const packing_body side = wall(box, 1);
  assert_true(packing_body_gap(&lying, &side) == 6);
  assert_near(packing_body_gap(&standing, &side), 6.5, 1e-15);
  packing_shape_destroy(shape);
  packing_domain_destroy(box);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(handles),
      cmocka_unit_test(outlives_its_context),
      cmocka_unit_test(refuses),
      cmocka_unit_test(least_shape),
      cmocka_unit_test(volumes_of_spheres),
      cmocka_unit_test(volumes_of_clusters),
      cmocka_unit_test(gaps_of_spheres),
      cmocka_unit_test(gaps_of_random_pairs),
      cmocka_unit_test(gaps_of_walls),
      cmocka_unit_test(clearance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
