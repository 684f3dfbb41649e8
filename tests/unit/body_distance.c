/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Directional distances (F9): the four cases of Figure 8, rays among spheres, clusters
 * and walls against a dense scan and bisection of the gap. */
#include "cluster.h"
#include "domain_scenes.h"

static packing_body sphere(double x, double y, double z, double r)
{
  const packing_vec3 centre = {x, y, z};
  return packing_body_sphere(centre, r);
}

static double distance(packing_body a, packing_body b, double x, double y, double z)
{
  const packing_vec3 direction = {x, y, z};
  return packing_body_distance(&a, &b, &direction);
}

/* Figure 8: towards and hit, towards and missed, away (twice). Only the first is a
 * contact. */
static void figure_8(void **state)
{
  (void)state;
  const packing_body fixed = sphere(0, 0, 0, 2);
  /* Radii add up to 5; coming in 3 beside the centre they meet 4 before it. */
  assert_near(distance(sphere(-10, 3, 0, 3), fixed, 1, 0, 0), 6.0, 2e-15);
  assert_true(distance(sphere(-10, 5.5, 0, 3), fixed, 1, 0, 0) == HUGE_VAL);
  assert_true(distance(sphere(10, 3, 0, 3), fixed, 1, 0, 0) == HUGE_VAL);
  assert_true(distance(sphere(10, 5.5, 0, 3), fixed, 1, 0, 0) == HUGE_VAL);
}

static void borders(void **state)
{
  (void)state;
  const packing_body fixed = sphere(0, 0, 0, 2);
  /* Grazing counts: the discriminant is 0. */
  assert_near(distance(sphere(-10, 5, 0, 3), fixed, 1, 0, 0), 10.0, 4e-15);
  assert_true(distance(sphere(-10, nextafter(5, 6), 0, 3), fixed, 1, 0, 0) == HUGE_VAL);
  /* Touching: going in, along, out. */
  assert_true(distance(sphere(-5, 0, 0, 3), fixed, 1, 0, 0) == 0);
  assert_true(distance(sphere(-5, 0, 0, 3), fixed, 0.6, 0.8, 0) == 0);
  assert_true(distance(sphere(-5, 0, 0, 3), fixed, 0, 1, 0) == HUGE_VAL);
  assert_true(distance(sphere(-5, 0, 0, 3), fixed, -1, 0, 0) == HUGE_VAL);
  /* Overlapping by rounding is touching. */
  assert_true(distance(sphere(nextafter(-5, 0), 0, 0, 3), fixed, 1, 0, 0) == 0);
  assert_true(distance(sphere(nextafter(-5, 0), 0, 0, 3), fixed, -1, 0, 0) == HUGE_VAL);
}

/* From far away nothing cancels: 1e8 radii off the contact is met to
 * rounding of the way. */
static void far_away(void **state)
{
  (void)state;
  const packing_body fixed = sphere(0, 0, 0, 1);
  const double way = distance(sphere(-0x1p27, 1, 0, 1), fixed, 1, 0, 0);
  assert_near(way, 0x1p27 - sqrt(3), 0x1p-25);
  assert_true(distance(sphere(-0x1p27, 2.000001, 0, 1), fixed, 1, 0, 0) == HUGE_VAL);
}

static packing_vec3 random_direction(uint64_t *random, int dim)
{
  for (;;) {
    packing_vec3 v = {scene_random(random) - 0.5, scene_random(random) - 0.5,
                      dim == 3 ? scene_random(random) - 0.5 : 0};
    const double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    if (length < 0.5 && length > 0.1) {
      v.x /= length;
      v.y /= length;
      v.z /= length;
      return v;
    }
  }
}

static double gap_after(packing_body a, const packing_body *b, packing_vec3 v, double t)
{
  a.centre.x += t * v.x;
  a.centre.y += t * v.y;
  a.centre.z += t * v.z;
  return packing_body_gap(&a, b);
}

/* Free all the way, to `depth` of overlap, and in contact at its end. */
static void check_way(packing_body a, const packing_body *b, packing_vec3 v, double way,
                      double to, double depth)
{
  enum { LOOKS = 300 };
  const double end = isfinite(way) ? way : to;
  for (int k = 0; k < LOOKS; k++)
    assert_true(gap_after(a, b, v, end * k / LOOKS) >= -depth);
  if (!isfinite(way))
    return;
  assert_near(gap_after(a, b, v, way), 0.0, 4e-15 * (10 + way));
}

static packing_body random_body(uint64_t *random, const packing_shape *shape, int dim)
{
  packing_body body =
      sphere(4 * scene_random(random), 4 * scene_random(random),
             dim == 3 ? 4 * scene_random(random) : 0, 0.3 + scene_random(random));
  const double half = 3 * scene_random(random);
  body.shape = shape;
  body.orientation[0] = cos(half);
  body.orientation[3] = dim == 3 ? 0.6 * sin(half) : sin(half);
  body.orientation[1] = dim == 3 ? 0.8 * sin(half) : 0;
  return body;
}

/* Spheres and clusters; the library's own way from the gap finds the cluster's exact
 * distance. */
static void among_particles(void **state)
{
  (void)state;
  uint64_t random = 5;
  packing_shape *exact = test_cluster(0.6, 1), *plain = test_cluster(0.6, 0);
  int hits = 0, misses = 0;
  for (int i = 0; i < 5000; i++) {
    const int dim = 2 + i % 2;
    const int turned = i % 3;
    packing_body a = random_body(&random, turned != 0 ? exact : NULL, dim),
                 b = random_body(&random, turned == 2 ? exact : NULL, dim);
    const packing_vec3 v = random_direction(&random, dim);
    if (packing_body_gap(&a, &b) <= 0)
      continue;
    const double way = packing_body_distance(&a, &b, &v);
    check_way(a, &b, v, way, 20, 2e-15);
    hits += isfinite(way);
    misses += !isfinite(way);
    a.shape = turned != 0 ? plain : NULL;
    b.shape = turned == 2 ? plain : NULL;
    const double found = packing_body_distance(&a, &b, &v);
    assert_int_equal(isfinite(found), isfinite(way));
    if (isfinite(way))
      assert_near(found, way, 1e-12);
  }
  assert_true(hits > 300 && misses > 300);
  packing_shape_destroy(exact);
  packing_shape_destroy(plain);
}

/* Without a function of its own: touching at the start, and let out of an overlap. */
static void from_the_gap(void **state)
{
  (void)state;
  packing_shape *plain = test_cluster(0.5, 0);
  const packing_body fixed = sphere(0, 0, 0, 1);
  packing_body a = sphere(-2, 0, 0, 1);
  a.orientation[0] = 1;
  a.shape = plain;
  assert_near(distance(a, fixed, 1, 0, 0), 0, 1e-14);
  assert_true(distance(a, fixed, -1, 0, 0) == HUGE_VAL);
  assert_true(distance(a, fixed, 0, 1, 0) == HUGE_VAL);
  a.centre.x = -1.75;
  assert_true(distance(a, fixed, 1, 0, 0) == 0);
  assert_true(distance(a, fixed, -1, 0, 0) == HUGE_VAL);
  /* Upright from the side: the near sphere's radius is half. */
  a.centre.x = -5;
  a.orientation[0] = a.orientation[2] = sqrt(0.5);
  assert_near(distance(a, fixed, 1, 0, 0), 5 - sqrt(1.5 * 1.5 - 0.25), 1e-14);
  packing_shape_destroy(plain);

  /* All but grazing: an overlap of 1e-6 on a way of 4e-3. */
  packing_shape *round = test_cluster(1, 0);
  packing_body b = sphere(-5, 2 - 1e-6, 0, 1);
  const double way = distance(b, fixed, 1, 0, 0);
  b.shape = round;
  b.orientation[0] = 1;
  assert_near(way, 5 - 2e-3, 1e-8);
  assert_near(distance(b, fixed, 1, 0, 0), way, 1e-11);
  packing_shape_destroy(round);
}

static packing_body wall(const packing_domain *domain, int number)
{
  packing_body body;
  memset(&body, 0, sizeof body);
  body.domain = domain;
  body.wall = number;
  return body;
}

static double custom_distance(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  return packing_domain_signed_distance(user, point, normal);
}

/* A container of the user's with the distances of another one: no closed form is
 * known. */
static packing_domain *disguised(packing_domain *domain)
{
  packing_domain_custom_def def;
  packing_domain *custom = NULL;
  packing_domain_custom_def_init(&def);
  def.dim = packing_domain_dim(domain);
  def.signed_distance = custom_distance;
  def.user = domain;
  packing_domain_bounds(domain, &def.bounds);
  def.volume = packing_domain_volume(domain);
  assert_ok(packing_domain_create_custom(NULL, &def, &custom));
  return custom;
}

/* A sphere or cluster from inside a container, to each wall and to all. */
static void check_walls(const scene *s, uint64_t *random, const packing_shape *shape)
{
  packing_domain *domain = scene_make(s);
  packing_domain *custom = disguised(domain);
  const int dim = packing_domain_dim(domain);
  for (int i = 0; i < 60; i++) {
    packing_body a = random_body(random, shape, dim);
    a.r *= 0.2;
    a.centre = scene_random_point(random, domain, 0);
    if (dim == 2)
      a.centre.z = 0;
    if (packing_body_clearance(&a, domain, NULL) <= 1e-3)
      continue;
    const packing_vec3 v = random_direction(random, dim);
    double least = HUGE_VAL;
    for (int k = 0; k < 6; k++) {
      const packing_body b = wall(domain, k);
      const double way = packing_body_distance(&a, &b, &v);
      if (isfinite(packing_body_gap(&a, &b)))
        check_way(a, &b, v, way, 30, 1e-14);
      else
        assert_true(way == HUGE_VAL);
      least = fmin(least, way);
    }
    const packing_body all = wall(domain, -1), hidden = wall(custom, -1);
    const double way = packing_body_distance(&a, &all, &v);
    check_way(a, &all, v, way, 0, 1e-14);
    if (!s->open) {
      assert_true(isfinite(way));
      assert_near(way, least, 1e-11);
      /* What grazes may be passed by so much. */
      assert_near(packing_body_distance(&a, &hidden, &v), way, 1e-9);
    }
  }
  packing_domain_destroy(custom);
  packing_domain_destroy(domain);
}

static const scene scenes[] = {
    {.kind = SCENE_BOX, .a = 5, .b = 4, .c = 3, .at = {1, 2, 3}, .axis = 2},
    {.kind = SCENE_BOX, .a = 5, .b = 4, .c = 3, .axis = 2, .open = 1},
    {.kind = SCENE_CYLINDER, .a = 2, .b = 5, .at = {1, 2, 3}, .axis = 0},
    {.kind = SCENE_TUBE, .a = 1, .b = 3, .c = 4, .axis = 1},
    {.kind = SCENE_CONE, .a = 1, .b = 3, .c = 4, .at = {1, 2, 3}, .axis = 2},
    {.kind = SCENE_CONE, .a = 3, .b = 0, .c = 2, .axis = 1},
    {.kind = SCENE_SILO, .a = 3, .b = 6, .c = 1, .d = 2, .axis = 2},
    {.kind = SCENE_SPHERE, .a = 3, .at = {1, 2, 3}, .axis = 2},
    {.kind = SCENE_RECTANGLE, .a = 5, .b = 4, .axis = 1},
    {.kind = SCENE_CIRCLE, .a = 3, .at = {1, 2, 0}, .axis = 1},
    {.kind = SCENE_ANNULUS, .a = 1, .b = 3, .axis = 1},
};

static void to_walls(void **state)
{
  (void)state;
  uint64_t random = 7;
  packing_shape *shape = test_cluster(0.6, 0);
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
    check_walls(&scenes[i], &random, NULL);
    check_walls(&scenes[i], &random, shape);
  }
  packing_shape_destroy(shape);
}

/* In touch with a curved wall: along the chord to the other side of the same wall. */
static void across_a_cylinder(void **state)
{
  (void)state;
  const scene s = {.kind = SCENE_CYLINDER, .a = 5, .b = 20, .axis = 2};
  packing_domain *domain = scene_make(&s);
  const packing_body all = wall(domain, -1);
  const packing_body a = sphere(4, 0, 10, 1);
  assert_near(distance(a, all, -1, 0, 0), 8, 1e-14);
  assert_near(distance(a, all, -0.6, 0.8, 0), 4.8, 1e-14);
  assert_true(distance(a, all, 0.6, 0.8, 0) == 0);
  /* Protruding: touching when it goes on, let out when it comes back. */
  assert_true(distance(sphere(4.5, 0, 10, 1), all, 1, 0, 0) == 0);
  assert_near(distance(sphere(4.5, 0, 10, 1), all, -1, 0, 0), 8.5, 1e-14);
  packing_domain_destroy(domain);
}

/* Past the tip of a cone, outside: the cone's other half is no wall. */
static void past_a_tip(void **state)
{
  (void)state;
  const scene s = {.kind = SCENE_CONE, .a = 3, .b = 0, .c = 2, .axis = 2};
  packing_domain *domain = scene_make(&s);
  for (int k = 0; k < 3; k++)
    assert_true(distance(sphere(-1, 0, 2.5, 0.1), wall(domain, k), 1, 0, 0) == HUGE_VAL);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(figure_8),          cmocka_unit_test(borders),
      cmocka_unit_test(far_away),          cmocka_unit_test(among_particles),
      cmocka_unit_test(from_the_gap),      cmocka_unit_test(to_walls),
      cmocka_unit_test(across_a_cylinder), cmocka_unit_test(past_a_tip),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
