/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Containers: what they say of themselves, exact values, and every refusal. */
#include "domain_scenes.h"

static void kinds_say_what_they_are(void **state)
{
  (void)state;
  static const char *const names[] = {"box",    "cylinder",  "tube",   "cone",   "silo",
                                      "sphere", "rectangle", "circle", "annulus"};
  for (int kind = 0; kind < SCENE_END; kind++) {
    const scene s = scene_of((enum scene_kind)kind);
    packing_domain *domain = scene_make(&s);
    assert_string_equal(packing_domain_kind(domain), names[kind]);
    assert_int_equal(packing_domain_dim(domain), scene_dim(&s));
    assert_int_equal(packing_domain_periodic(domain), 0);
    packing_domain_destroy(domain);
  }
}

static double volume_of(scene s)
{
  packing_domain *domain = scene_make(&s);
  const double v = packing_domain_volume(domain);
  packing_domain_destroy(domain);
  return v;
}

static void volumes_are_exact(void **state)
{
  (void)state;
  const packing_vec3 at = {0, 0, 0};
  const double eps = 4 * 2.220446049250313e-16;
  assert_true(volume_of((scene){SCENE_BOX, 2, 3, 5, 0, at, 2, 0, 0}) == 30);
  assert_true(volume_of((scene){SCENE_RECTANGLE, 2, 3, 0, 0, at, 1, 0, 0}) == 6);
  assert_close(volume_of((scene){SCENE_CYLINDER, 2, 3, 0, 0, at, 2, 0, 0}), 12 * TEST_PI,
               eps);
  assert_close(volume_of((scene){SCENE_TUBE, 2, 3, 7, 0, at, 2, 0, 0}), 35 * TEST_PI,
               eps);
  assert_close(volume_of((scene){SCENE_CONE, 0, 3, 7, 0, at, 2, 0, 0}), 21 * TEST_PI,
               eps);
  assert_close(volume_of((scene){SCENE_CONE, 3, 0, 7, 0, at, 2, 0, 0}), 21 * TEST_PI,
               eps);
  assert_close(volume_of((scene){SCENE_CONE, 1, 2, 3, 0, at, 2, 1, 0}), 7 * TEST_PI, eps);
  assert_close(volume_of((scene){SCENE_SILO, 2, 5, 1, 3, at, 2, 0, 0}), 15 * TEST_PI,
               eps);
  /* A hopper as flat as a sheet: 2/3 of its own cylinder is missing. */
  assert_close(volume_of((scene){SCENE_SILO, 2, 5, 0, 1e-9, at, 2, 0, 0}),
               4 * TEST_PI * (5 - 2e-9 / 3), eps);
  assert_close(volume_of((scene){SCENE_SPHERE, 3, 0, 0, 0, at, 2, 0, 0}), 36 * TEST_PI,
               eps);
  assert_close(volume_of((scene){SCENE_CIRCLE, 3, 0, 0, 0, at, 1, 0, 0}), 9 * TEST_PI,
               eps);
  assert_close(volume_of((scene){SCENE_ANNULUS, 2, 3, 0, 0, at, 1, 0, 0}), 5 * TEST_PI,
               eps);
}

static void touching_is_holding(void **state)
{
  (void)state;
  packing_domain *box = test_box(1, 1, 1, 0);
  const packing_vec3 middle = {0.5, 0.5, 0.5}, lower = {0.5, 0.5, nextafter(0.5, 0)};
  assert_int_equal(packing_domain_holds(box, &middle, 0.5), 1);
  assert_int_equal(packing_domain_holds(box, &middle, nextafter(0.5, 1)), 0);
  assert_int_equal(packing_domain_holds(box, &lower, 0.5), 0);
  const packing_vec3 nowhere = {(double)NAN, 0.5, 0.5};
  packing_vec3 normal = {1, 2, 3};
  assert_int_equal(packing_domain_holds(box, &nowhere, 0.1), 0);
  assert_true(isnan(packing_domain_signed_distance(box, &nowhere, &normal)));
  assert_true(normal.x == 0 && normal.y == 0 && normal.z == 0);
  packing_domain_destroy(box);
}

/* Ties: the lowest axis, its low wall; the axis of a body: its next coordinate axis. */
static void ties_are_always_cut_the_same_way(void **state)
{
  (void)state;
  packing_vec3 n;
  packing_domain *box = test_box(1, 1, 1, 0);
  const packing_vec3 middle = {0.5, 0.5, 0.5};
  assert_true(packing_domain_signed_distance(box, &middle, &n) == 0.5);
  assert_true(n.x == 1 && n.y == 0 && n.z == 0);
  packing_domain_destroy(box);
  const scene cylinder = {SCENE_CYLINDER, 1, 8, 0, 0, {0, 0, 0}, 2, 0, 0};
  packing_domain *domain = scene_make(&cylinder);
  const packing_vec3 on_axis = {0, 0, 4};
  assert_true(packing_domain_signed_distance(domain, &on_axis, &n) == 1);
  assert_true(n.x == -1 && n.y == 0 && n.z == 0);
  packing_domain_destroy(domain);
  const scene sphere = {SCENE_SPHERE, 1, 0, 0, 0, {0, 0, 0}, 2, 0, 0};
  domain = scene_make(&sphere);
  const packing_vec3 centre = {0, 0, 0};
  assert_true(packing_domain_signed_distance(domain, &centre, &n) == 1);
  assert_true(n.x == -1 && n.y == 0 && n.z == 0);
  packing_domain_destroy(domain);
}

static void periodic_cells_have_no_walls(void **state)
{
  (void)state;
  packing_domain *cell = test_box(1, 2, 3, 7);
  const packing_vec3 p = {17, -4, 0.25};
  packing_vec3 n = {1, 1, 1};
  assert_int_equal(packing_domain_periodic(cell), 7);
  assert_true(packing_domain_signed_distance(cell, &p, &n) == HUGE_VAL);
  assert_true(n.x == 0 && n.y == 0 && n.z == 0);
  assert_int_equal(packing_domain_holds(cell, &p, 1e300), 1);
  double volume;
  assert_ok(packing_domain_sphere_volume(cell, &p, 5, 1e-9, &volume, NULL));
  assert_close(volume, 4.0 / 3.0 * TEST_PI * 125, 1e-15);
  packing_domain *inset = NULL;
  assert_ok(packing_domain_create_inset(NULL, cell, 100, &inset));
  assert_true(packing_domain_volume(inset) == 6);
  packing_domain_destroy(inset);
  packing_domain_destroy(cell);
}

/* An open top is no wall and yet cuts. */
static void open_tops_only_cut(void **state)
{
  (void)state;
  const scene open[] = {
      {SCENE_BOX, 2, 2, 2, 0, {-1, -1, 0}, 2, 1, 0},
      {SCENE_CYLINDER, 1, 2, 0, 0, {0, 0, 0}, 2, 1, 0},
      {SCENE_SILO, 1, 2, 0.5, 1, {0, 0, 0}, 2, 1, 0},
  };
  for (size_t i = 0; i < sizeof open / sizeof *open; i++) {
    packing_domain *domain = scene_make(&open[i]);
    const packing_vec3 below = {0.25, 0, 1.875}, above = {0.25, 0, 17}, top = {0, 0, 2};
    packing_vec3 n;
    double volume, error;
    assert_true(packing_domain_signed_distance(domain, &below, NULL) == 0.75);
    assert_true(packing_domain_signed_distance(domain, &above, &n) == 0.75);
    assert_true(n.x == -1 && n.y == 0 && n.z == 0);
    assert_int_equal(packing_domain_holds(domain, &above, 0.75), 1);
    assert_ok(packing_domain_sphere_volume(domain, &top, 0.5, 1e-9, &volume, &error));
    assert_close(volume, 2.0 / 3.0 * TEST_PI * 0.125, 1e-14);
    assert_ok(packing_domain_sphere_volume(domain, &above, 0.5, 1e-9, &volume, NULL));
    assert_true(volume == 0);
    packing_domain_destroy(domain);
  }
}

#define REFUSE(kind, member, value, status, field)                                       \
  do {                                                                                   \
    packing_domain_##kind##_def bad = good;                                              \
    bad.member = (value);                                                                \
    assert_fails(context, packing_domain_create_##kind(context, &bad, &domain),          \
                 (status), (field));                                                     \
    assert_null(domain);                                                                 \
  } while (0)

#define REFUSE_LENGTH(kind, member, field)                                               \
  do {                                                                                   \
    REFUSE(kind, member, (double)NAN, PACKING_ERR_INVALID, field);                       \
    REFUSE(kind, member, HUGE_VAL, PACKING_ERR_INVALID, field);                          \
    REFUSE(kind, member, -1.5, PACKING_ERR_RANGE, field);                                \
  } while (0)

#define REFUSE_POINT(kind, member)                                                       \
  do {                                                                                   \
    REFUSE(kind, member.x, (double)NAN, PACKING_ERR_INVALID, #member ".x");              \
    REFUSE(kind, member.y, HUGE_VAL, PACKING_ERR_INVALID, #member ".y");                 \
    REFUSE(kind, member.z, -HUGE_VAL, PACKING_ERR_INVALID, #member ".z");                \
  } while (0)

/* NULL, a size no struct ever had, and options of a library yet to come. */
#define REFUSE_STRUCT(kind)                                                              \
  do {                                                                                   \
    assert_fails(context, packing_domain_create_##kind(context, NULL, &domain),          \
                 PACKING_ERR_INVALID, "def");                                            \
    assert_fails(context, packing_domain_create_##kind(context, &good, NULL),            \
                 PACKING_ERR_INVALID, "domain");                                         \
    REFUSE(kind, struct_size, 8, PACKING_ERR_ABI, "struct_size");                        \
  } while (0)

static void box_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = NULL;
  packing_domain_box_def good;
  packing_domain_box_def_init(&good);
  good.size = (packing_vec3){2, 3, 4};
  REFUSE_STRUCT(box);
  REFUSE_LENGTH(box, size.x, "size.x");
  REFUSE_LENGTH(box, size.y, "size.y");
  REFUSE_LENGTH(box, size.z, "size.z");
  REFUSE(box, size.y, 0, PACKING_ERR_RANGE, "size.y");
  REFUSE_POINT(box, corner);
  REFUSE(box, corner.z, 1e30, PACKING_ERR_RANGE, "size"); /* 1e30 + 4 is 1e30 */
  REFUSE(box, periodic, 8, PACKING_ERR_RANGE, "periodic");
  REFUSE(box, open_top, 2, PACKING_ERR_RANGE, "open_top");
  good.periodic = PACKING_PERIODIC_Z;
  REFUSE(box, open_top, 1, PACKING_ERR_INVALID, "open_top");
  good.periodic = 0;
  good.size = (packing_vec3){1e-150, 1e-150, 1e-150};
  REFUSE(box, open_top, 0, PACKING_ERR_RANGE, "size");
  packing_context_destroy(context);
}

static void rectangle_refuses(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = NULL;
  packing_domain_rectangle_def good;
  packing_domain_rectangle_def_init(&good);
  good.size_x = 2;
  good.size_y = 3;
  REFUSE_STRUCT(rectangle);
  REFUSE_LENGTH(rectangle, size_x, "size_x");
  REFUSE_LENGTH(rectangle, size_y, "size_y");
  REFUSE_POINT(rectangle, corner);
  REFUSE(rectangle, corner.z, 1, PACKING_ERR_RANGE, "corner.z");
  REFUSE(rectangle, periodic, PACKING_PERIODIC_Z, PACKING_ERR_RANGE, "periodic");
  REFUSE(rectangle, open_top, -1, PACKING_ERR_RANGE, "open_top");
  good.periodic = PACKING_PERIODIC_Y;
  REFUSE(rectangle, open_top, 1, PACKING_ERR_INVALID, "open_top");
  packing_context_destroy(context);
}

#define REFUSE_BODY(kind)                                                                \
  do {                                                                                   \
    REFUSE_STRUCT(kind);                                                                 \
    REFUSE_POINT(kind, base);                                                            \
    REFUSE(kind, axis, (packing_axis)3, PACKING_ERR_RANGE, "axis");                      \
    REFUSE(kind, open_top, 5, PACKING_ERR_RANGE, "open_top");                            \
    REFUSE_LENGTH(kind, height, "height");                                               \
    REFUSE(kind, base.y, 1e30, PACKING_ERR_RANGE, "base");                               \
  } while (0)

static void bodies_of_revolution_refuse(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = NULL;
  {
    packing_domain_cylinder_def good;
    packing_domain_cylinder_def_init(&good);
    good.radius = 2;
    good.height = 3;
    REFUSE_BODY(cylinder);
    REFUSE_LENGTH(cylinder, radius, "radius");
    REFUSE(cylinder, radius, 0, PACKING_ERR_RANGE, "radius");
  }
  {
    packing_domain_tube_def good;
    packing_domain_tube_def_init(&good);
    good.inner_radius = 1;
    good.outer_radius = 2;
    good.height = 3;
    REFUSE_BODY(tube);
    REFUSE_LENGTH(tube, inner_radius, "inner_radius");
    REFUSE_LENGTH(tube, outer_radius, "outer_radius");
    REFUSE(tube, inner_radius, 0, PACKING_ERR_RANGE, "inner_radius");
    REFUSE(tube, outer_radius, 1, PACKING_ERR_RANGE, "outer_radius");
  }
  {
    packing_domain_cone_def good;
    packing_domain_cone_def_init(&good);
    good.top_radius = 2;
    good.height = 3;
    REFUSE_BODY(cone);
    REFUSE_LENGTH(cone, bottom_radius, "bottom_radius");
    REFUSE_LENGTH(cone, top_radius, "top_radius");
    REFUSE(cone, top_radius, 0, PACKING_ERR_RANGE, "top_radius");
  }
  {
    packing_domain_silo_def good;
    packing_domain_silo_def_init(&good);
    good.radius = 2;
    good.height = 5;
    good.hopper_height = 1;
    REFUSE_BODY(silo);
    REFUSE_LENGTH(silo, radius, "radius");
    REFUSE_LENGTH(silo, outlet_radius, "outlet_radius");
    REFUSE_LENGTH(silo, hopper_height, "hopper_height");
    REFUSE(silo, outlet_radius, 2, PACKING_ERR_RANGE, "outlet_radius");
    REFUSE(silo, hopper_height, 5, PACKING_ERR_RANGE, "hopper_height");
    REFUSE(silo, hopper_height, 0, PACKING_ERR_RANGE, "hopper_height");
  }
  packing_context_destroy(context);
}

static void round_containers_refuse(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = NULL;
  {
    packing_domain_sphere_def good;
    packing_domain_sphere_def_init(&good);
    good.radius = 2;
    REFUSE_STRUCT(sphere);
    REFUSE_LENGTH(sphere, radius, "radius");
    REFUSE_POINT(sphere, centre);
    REFUSE(sphere, centre.x, 1e30, PACKING_ERR_RANGE, "centre");
  }
  {
    packing_domain_circle_def good;
    packing_domain_circle_def_init(&good);
    good.radius = 2;
    REFUSE_STRUCT(circle);
    REFUSE_LENGTH(circle, radius, "radius");
    REFUSE_POINT(circle, centre);
    REFUSE(circle, centre.z, 0.5, PACKING_ERR_RANGE, "centre.z");
  }
  {
    packing_domain_annulus_def good;
    packing_domain_annulus_def_init(&good);
    good.inner_radius = 1;
    good.outer_radius = 2;
    REFUSE_STRUCT(annulus);
    REFUSE_LENGTH(annulus, inner_radius, "inner_radius");
    REFUSE_LENGTH(annulus, outer_radius, "outer_radius");
    REFUSE(annulus, outer_radius, 0.5, PACKING_ERR_RANGE, "outer_radius");
    REFUSE_POINT(annulus, centre);
    REFUSE(annulus, centre.z, 0.5, PACKING_ERR_RANGE, "centre.z");
  }
  packing_context_destroy(context);
}

static void insets_refuse(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *box = test_box(1, 1, 1, 0), *inset = NULL;
  assert_fails(context, packing_domain_create_inset(context, box, (double)NAN, &inset),
               PACKING_ERR_INVALID, "distance");
  assert_fails(context, packing_domain_create_inset(context, box, -1, &inset),
               PACKING_ERR_RANGE, "distance");
  assert_fails(context, packing_domain_create_inset(context, box, 0.5, &inset),
               PACKING_ERR_GEOMETRY, "distance");
  assert_fails(context, packing_domain_create_inset(context, NULL, 0.5, &inset),
               PACKING_ERR_INVALID, "domain");
  assert_fails(context, packing_domain_create_inset(context, box, 0.1, NULL),
               PACKING_ERR_INVALID, "inset");
  assert_null(inset);
  packing_domain_destroy(box);
  packing_context_destroy(context);
}

static void cut_volumes_refuse(void **state)
{
  (void)state;
  packing_domain *box = test_box(1, 1, 1, 0);
  const packing_vec3 p = {0, 0, 0}, bad = {0, (double)NAN, 0};
  double v = 2.385, e = 2.385;
  assert_status(packing_domain_sphere_volume(NULL, &p, 1, 1e-9, &v, &e),
                PACKING_ERR_INVALID);
  assert_status(packing_domain_sphere_volume(box, NULL, 1, 1e-9, &v, &e),
                PACKING_ERR_INVALID);
  assert_status(packing_domain_sphere_volume(box, &p, 1, 1e-9, NULL, &e),
                PACKING_ERR_INVALID);
  assert_status(packing_domain_sphere_volume(box, &bad, 1, 1e-9, &v, &e),
                PACKING_ERR_INVALID);
  assert_status(packing_domain_sphere_volume(box, &p, (double)NAN, 1e-9, &v, &e),
                PACKING_ERR_INVALID);
  assert_status(packing_domain_sphere_volume(box, &p, 1, (double)NAN, &v, &e),
                PACKING_ERR_INVALID);
  assert_status(packing_domain_sphere_volume(box, &p, 0, 1e-9, &v, &e),
                PACKING_ERR_RANGE);
  assert_status(packing_domain_sphere_volume(box, &p, 1, 0, &v, &e), PACKING_ERR_RANGE);
  assert_status(packing_domain_sphere_volume(box, &p, 1, 1, &v, &e), PACKING_ERR_RANGE);
  assert_true(v == 2.385 && e == 2.385);
  packing_domain_destroy(box);
}

static void domains_outlive_their_context(void **state)
{
  (void)state;
  test_allocator allocator = {0};
  packing_context *context = test_allocator_context(&allocator);
  packing_domain_sphere_def def;
  packing_domain *domain = NULL, *inset = NULL, *same = NULL;
  packing_domain_sphere_def_init(&def);
  def.radius = 2;
  assert_ok(packing_domain_create_sphere(context, &def, &domain));
  assert_ok(packing_domain_create_inset(context, domain, 1, &inset));
  assert_ok(packing_domain_create_inset(context, domain, 0, &same));
  assert_ptr_equal(same, domain);
  assert_ptr_equal(packing_domain_retain(inset), inset);
  assert_null(packing_domain_retain(NULL));
  packing_context_destroy(context);
  packing_domain_destroy(domain);
  packing_domain_destroy(same);
  packing_domain_destroy(inset);
  assert_close(packing_domain_volume(inset), 4.0 / 3.0 * TEST_PI, 1e-15);
  assert_int_equal(allocator.live, 1);
  packing_domain_destroy(inset);
  assert_int_equal(allocator.live, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(kinds_say_what_they_are),
      cmocka_unit_test(volumes_are_exact),
      cmocka_unit_test(touching_is_holding),
      cmocka_unit_test(ties_are_always_cut_the_same_way),
      cmocka_unit_test(periodic_cells_have_no_walls),
      cmocka_unit_test(open_tops_only_cut),
      cmocka_unit_test(box_refuses),
      cmocka_unit_test(rectangle_refuses),
      cmocka_unit_test(bodies_of_revolution_refuse),
      cmocka_unit_test(round_containers_refuse),
      cmocka_unit_test(insets_refuse),
      cmocka_unit_test(cut_volumes_refuse),
      cmocka_unit_test(domains_outlive_their_context),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
