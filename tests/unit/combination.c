/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Unions, intersections and differences: closed forms, seams, and every refusal. */
#include "solids.h"

static void boxes_combine_exactly(void **state)
{
  (void)state;
  static const struct {
    packing_operation operation;
    const char *kind;
    double volume;
  } known[] = {{PACKING_UNION, "union", 3},
               {PACKING_INTERSECTION, "intersection", 1},
               {PACKING_DIFFERENCE, "difference", 1}};
  for (int i = 0; i < 3; i++) {
    packing_domain *d = solid_of(known[i].operation, solid_box(2, 1, 1, 0, 0, 0),
                                 solid_box(1, 2, 1, 0, 0, 0));
    assert_string_equal(packing_domain_kind(d), known[i].kind);
    assert_true(packing_domain_volume(d) == known[i].volume);
    assert_int_equal(packing_domain_dim(d), 3);
    packing_domain_destroy(d);
  }
}

static double lens(double p, double q, double d)
{
  const double h = (q - d + p) * (q + d - p) / (2 * d),
               k = (p - d + q) * (p + d - q) / (2 * d);
  return TEST_PI / 3 * (h * h * (3 * p - h) + k * k * (3 * q - k));
}

static void round_containers_combine_exactly(void **state)
{
  (void)state;
  const double ball = 4 * TEST_PI / 3;
  packing_domain *d =
      solid_of(PACKING_UNION, solid_sphere(1, 0, 0, 0), solid_sphere(0.8, 1, 0, 0));
  assert_close(packing_domain_volume(d), ball * (1 + 0.512) - lens(1, 0.8, 1), 1e-13);
  packing_domain_destroy(d);
  d = solid_of(PACKING_DIFFERENCE, solid_cylinder(1, 3, PACKING_AXIS_Z, 0, 0, -1),
               solid_box(4, 4, 1, -2, -2, 0));
  assert_close(packing_domain_volume(d), 2 * TEST_PI, 1e-12);
  packing_domain_destroy(d);
  /* Steinmetz: two cylinders across share 16 r^3 / 3. */
  d = solid_of(PACKING_INTERSECTION, solid_cylinder(0.75, 4, PACKING_AXIS_Z, 0, 0, -2),
               solid_cylinder(0.75, 4, PACKING_AXIS_X, -2, 0, 0));
  assert_close(packing_domain_volume(d), 16 * 0.421875 / 3, 1e-9);
  packing_domain_destroy(d);
  d = solid_of(PACKING_DIFFERENCE, solid_rectangle(4, 2, 0, 0), solid_circle(0.5, 0, 0));
  assert_close(packing_domain_volume(d), 8 - TEST_PI / 16, 1e-13);
  packing_domain_destroy(d);
}

/* Two boxes that touch are one: the face between them is no wall, nor is a gap of a rounding. */
static void touching_boxes_are_one(void **state)
{
  (void)state;
  for (int gap = 0; gap < 2; gap++) {
    packing_domain *d = solid_of(PACKING_UNION, solid_box(1, 1, 1, 0, 0, 0),
                                 solid_box(1, 1, 1, gap ? nextafter(1, 2) : 1, 0, 0));
    assert_near(packing_domain_volume(d), 2, 1e-15);
    assert_near(solid_distance(d, 1, 0.5, 0.5), 0.5, 1e-9);
    assert_near(solid_distance(d, 1.001, 0.4, 0.5), 0.4, 1e-9);
    assert_near(solid_distance(d, 0.98, 0.5, 0.7), 0.3, 1e-9);
    assert_true(packing_domain_holds(d, &(packing_vec3){1, 0.5, 0.5}, 0.499999999));
    assert_false(packing_domain_holds(d, &(packing_vec3){1, 0.5, 0.5}, 0.500000001));
    packing_domain_destroy(d);
  }
  /* Beside a step the seam is a wall: the edge at (1, 1). */
  packing_domain *d =
      solid_of(PACKING_UNION, solid_box(1, 1, 3, 0, 0, 0), solid_box(1, 2, 3, 1, 0, 0));
  assert_near(solid_distance(d, 1.25, 0.75, 1.5), hypot(0.25, 0.25), 1e-9);
  assert_near(solid_distance(d, 1, 0.75, 1.5), 0.25, 1e-9);
  packing_domain_destroy(d);
}

/* A ball that neither container holds, and their union does. */
static void seams_are_straddled(void **state)
{
  (void)state;
  packing_domain *a = solid_sphere(1, -0.5, 0, 0), *b = solid_sphere(1, 0.5, 0, 0);
  packing_domain *d = NULL;
  const packing_vec3 middle = {0, 0, 0}, off = {0.1, 0.2, -0.1};
  assert_ok(solid_try(NULL, PACKING_UNION, a, b, &d));
  /* The seam is a circle of radius sqrt(3)/2 round the middle. */
  const double seam = sqrt(0.75);
  assert_false(packing_domain_holds(a, &middle, 0.8));
  assert_true(packing_domain_holds(d, &middle, 0.8));
  assert_close(packing_domain_signed_distance(d, &middle, NULL), seam, 1e-3);
  assert_true(packing_domain_signed_distance(d, &middle, NULL) <= seam * (1 + 1e-12));
  const double rho = hypot(off.y, off.z);
  packing_vec3 n;
  assert_close(packing_domain_signed_distance(d, &off, &n), hypot(0.1, seam - rho), 1e-8);
  assert_near(n.x, 0.1 / hypot(0.1, seam - rho), 1e-6);
  packing_domain_destroy(a);
  packing_domain_destroy(b);
  packing_domain_destroy(d);
}

static void nested_ones_take_from_ones_taken(void **state)
{
  (void)state;
  /* A box without what a box and a ball share: its own edge at the shared part's rim. */
  packing_domain *shared = solid_of(PACKING_INTERSECTION, solid_sphere(0.5, 0, 0, 0),
                                    solid_box(2, 2, 2, 0, -1, -1));
  assert_close(packing_domain_volume(shared), TEST_PI / 12, 1e-12);
  packing_domain *d =
      solid_of(PACKING_DIFFERENCE, solid_box(4, 4, 4, -2, -2, -2), shared);
  assert_close(packing_domain_volume(d), 64 - TEST_PI / 12, 1e-4);
  assert_near(solid_distance(d, -0.5, 0.1, 0), 0.5, 1e-9);
  assert_near(solid_distance(d, 1, 0, 0), 0.5, 1e-9);
  /* From beyond the rim of the half ball, a circle of radius 0.5 in the plane x = 0. */
  assert_close(solid_distance(d, -0.3, 0.9, 0), hypot(0.3, 0.4), 1e-8);
  packing_domain_destroy(d);
}

static void combinations_keep_what_they_are_made_of(void **state)
{
  (void)state;
  test_allocator allocator = {0};
  packing_context *context = test_allocator_context(&allocator);
  packing_domain *d = solid_of(PACKING_UNION, solid_box(1, 1, 1, 0, 0, 0),
                               solid_box(1, 1, 1, 0.5, 0.5, 0));
  packing_domain *in = NULL;
  assert_ok(packing_domain_create_inset(context, d, 0.25, &in));
  packing_domain_destroy(d);
  assert_near(solid_distance(in, 0.75, 0.75, 0.5), hypot(0.25, 0.25) - 0.25, 1e-9);
  assert_true(packing_domain_volume(in) > 2 * 0.125 && packing_domain_volume(in) < 0.5);
  packing_domain_destroy(in);
  packing_context_destroy(context);
  assert_int_equal(allocator.live, 0);
}

static void balls_are_cut_by_parts(void **state)
{
  (void)state;
  packing_domain *d =
      solid_of(PACKING_UNION, solid_box(1, 1, 1, 0, 0, 0), solid_box(1, 1, 1, 1, 0, 0));
  double v, error;
  const packing_vec3 at = {1, 0, 0.5};
  assert_ok(packing_domain_sphere_volume(d, &at, 0.25, 1e-9, &v, &error));
  assert_close(v, 2 * TEST_PI / 3 * 0.015625, 1e-12);
  packing_domain_destroy(d);
  d = solid_of(PACKING_DIFFERENCE, solid_box(2, 2, 2, 0, 0, 0),
               solid_sphere(0.5, 1, 1, 1));
  const packing_vec3 on = {1.5, 1, 1};
  assert_ok(packing_domain_sphere_volume(d, &on, 0.25, 1e-6, &v, &error));
  assert_near(v, 4 * TEST_PI / 3 * 0.015625 - lens(0.5, 0.25, 0.5), 2e-4 * 0.0655);
  packing_domain_destroy(d);
}

/* ---- refusals ---- */

static void refuse(packing_operation operation, packing_domain *a, packing_domain *b,
                   packing_status status, const char *field)
{
  packing_context *context = NULL;
  packing_domain *d = NULL;
  assert_ok(packing_context_create(NULL, &context));
  assert_fails(context, solid_try(context, operation, a, b, &d), status, field);
  assert_null(d);
  packing_domain_destroy(a);
  packing_domain_destroy(b);
  packing_context_destroy(context);
}

static packing_domain *open_box(void)
{
  packing_domain *d = NULL;
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size = (packing_vec3){1, 1, 1};
  def.open_top = 1;
  assert_ok(packing_domain_create_box(NULL, &def, &d));
  return d;
}

static void what_cannot_be_combined_is_refused(void **state)
{
  (void)state;
  refuse((packing_operation)3, solid_box(1, 1, 1, 0, 0, 0), solid_box(1, 1, 1, 0, 0, 0),
         PACKING_ERR_RANGE, "operation");
  refuse(PACKING_UNION, NULL, solid_box(1, 1, 1, 0, 0, 0), PACKING_ERR_INVALID, "a");
  refuse(PACKING_UNION, solid_box(1, 1, 1, 0, 0, 0), NULL, PACKING_ERR_INVALID, "b");
  refuse(PACKING_UNION, solid_box(1, 1, 1, 0, 0, 0), solid_circle(1, 0, 0),
         PACKING_ERR_INVALID, "b");
  refuse(PACKING_UNION, test_box(1, 1, 1, PACKING_PERIODIC_X), solid_sphere(1, 0, 0, 0),
         PACKING_ERR_UNSUPPORTED, "a");
  refuse(PACKING_UNION, solid_sphere(1, 0, 0, 0), open_box(), PACKING_ERR_UNSUPPORTED,
         "b");
}

static void empty_ones_are_refused(void **state)
{
  (void)state;
  refuse(PACKING_INTERSECTION, solid_box(1, 1, 1, 0, 0, 0), solid_box(1, 1, 1, 2, 0, 0),
         PACKING_ERR_GEOMETRY, "b");
  refuse(PACKING_INTERSECTION, solid_box(1, 1, 1, 0, 0, 0), solid_box(1, 1, 1, 1, 0, 0),
         PACKING_ERR_GEOMETRY, "b");
  refuse(PACKING_DIFFERENCE, solid_sphere(1, 0, 0, 0), solid_sphere(1, 0, 0, 0),
         PACKING_ERR_GEOMETRY, "b");
  refuse(PACKING_DIFFERENCE, solid_sphere(1, 0, 0, 0), solid_box(3, 3, 3, -1, -1, -1),
         PACKING_ERR_GEOMETRY, "b");
  /* Bounds meet, the spheres do not. */
  refuse(PACKING_INTERSECTION, solid_sphere(1, 0, 0, 0), solid_sphere(1, 1.5, 1.5, 0),
         PACKING_ERR_GEOMETRY, "b");
}

static double nowhere(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  if (normal != NULL)
    *normal = (packing_vec3){1, 0, 0};
  return point->x > 0.75 ? (double)NAN : 0.5 - fabs(point->x);
}

static void options_are_checked(void **state)
{
  (void)state;
  packing_context *context = NULL;
  packing_domain *d = NULL, *custom = NULL;
  packing_domain *a = solid_box(1, 1, 1, 0, 0, 0), *b = solid_box(1, 1, 1, 0.5, 0, 0);
  assert_ok(packing_context_create(NULL, &context));
  packing_domain_custom_def user;
  packing_domain_custom_def_init(&user);
  user.signed_distance = nowhere;
  user.bounds = (packing_bounds){{-1, -1, -1}, {1, 1, 1}};
  user.volume = 4;
  assert_ok(packing_domain_create_custom(NULL, &user, &custom));
#define REFUSED(change, status, field)                                                   \
  do {                                                                                   \
    packing_domain_combination_def def;                                                  \
    packing_domain_combination_def_init(&def);                                           \
    def.a = a;                                                                           \
    def.b = b;                                                                           \
    change;                                                                              \
    assert_fails(context, packing_domain_create_combination(context, &def, &d), status,  \
                 field);                                                                 \
    assert_null(d);                                                                      \
  } while (0)
  REFUSED(def.volume = -1, PACKING_ERR_RANGE, "volume");
  REFUSED(def.volume = (double)NAN, PACKING_ERR_INVALID, "volume");
  REFUSED(def.volume_tolerance = 0, PACKING_ERR_RANGE, "volume_tolerance");
  REFUSED(def.volume_tolerance = 1, PACKING_ERR_RANGE, "volume_tolerance");
  REFUSED(def.struct_size = 1, PACKING_ERR_ABI, "struct_size");
  REFUSED(def.b = custom, PACKING_ERR_GEOMETRY, "signed_distance");
#undef REFUSED
  packing_domain_combination_def def;
  packing_domain_combination_def_init(&def);
  def.a = a;
  def.b = b;
  assert_fails(context, packing_domain_create_combination(context, &def, NULL),
               PACKING_ERR_INVALID, "domain");
  assert_fails(context, packing_domain_create_combination(context, NULL, &d),
               PACKING_ERR_INVALID, "def");
  def.volume = 1.25;
  assert_ok(packing_domain_create_combination(context, &def, &d));
  assert_true(packing_domain_volume(d) == 1.25);
  packing_domain_destroy(d);
  packing_domain_destroy(a);
  packing_domain_destroy(b);
  packing_domain_destroy(custom);
  packing_context_destroy(context);
}

/* At most 64 of them; a chain of boxes that touch is one long box. */
static void sixty_four_are_the_most(void **state)
{
  (void)state;
  packing_domain *d = solid_box(1, 1, 1, 0, 0, 0), *more = NULL;
  for (int i = 1; i < 64; i++)
    d = solid_of(PACKING_UNION, d, solid_box(1, 1, 1, i, 0, 0));
  assert_true(packing_domain_volume(d) == 64);
  assert_near(solid_distance(d, 31, 0.5, 0.5), 0.5, 1e-9);
  packing_domain *last = solid_box(1, 1, 1, 64, 0, 0);
  assert_status(solid_try(NULL, PACKING_UNION, d, last, &more), PACKING_ERR_UNSUPPORTED);
  packing_domain_destroy(last);
  packing_domain_destroy(d);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boxes_combine_exactly),
      cmocka_unit_test(round_containers_combine_exactly),
      cmocka_unit_test(touching_boxes_are_one),
      cmocka_unit_test(seams_are_straddled),
      cmocka_unit_test(nested_ones_take_from_ones_taken),
      cmocka_unit_test(combinations_keep_what_they_are_made_of),
      cmocka_unit_test(balls_are_cut_by_parts),
      cmocka_unit_test(what_cannot_be_combined_is_refused),
      cmocka_unit_test(empty_ones_are_refused),
      cmocka_unit_test(options_are_checked),
      cmocka_unit_test(sixty_four_are_the_most),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
