/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The point farthest from the walls: closed forms, ties, symmetric containers, refusals. */
#include "solids.h"

static void expect(packing_domain *d, double tolerance, double x, double y, double z,
                   double distance, double within)
{
  packing_vec3 p = {9, 9, 9};
  double found = -1;
  assert_ok(packing_domain_innermost(NULL, d, tolerance, &p, &found));
  assert_near(p.x, x, within);
  assert_near(p.y, y, within);
  assert_near(p.z, z, within);
  if (isinf(distance))
    assert_true(isinf(found) && found > 0);
  else
    assert_near(found, distance, within);
  packing_domain_destroy(d);
}

static packing_domain *box_of(double lx, double ly, double lz, unsigned periodic,
                              int open)
{
  packing_domain *d = NULL;
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size = (packing_vec3){lx, ly, lz};
  def.periodic = periodic;
  def.open_top = open;
  assert_ok(packing_domain_create_box(NULL, &def, &d));
  return d;
}

/* Of a whole plane or line of points the lowest in z, y, x; along periodic ones the middle. */
static void boxes_give_the_lowest_point(void **state)
{
  (void)state;
  expect(box_of(4, 4, 2, 0, 0), 1, 1, 1, 1, 1, 0);
  expect(box_of(2, 4, 6, 0, 0), 1, 1, 1, 1, 1, 0);
  expect(box_of(4, 6, 2, 3, 0), 1, 2, 3, 1, 1, 0);
  expect(box_of(4, 6, 8, 7, 0), 1, 2, 3, 4, HUGE_VAL, 0);
  expect(box_of(4, 4, 1, 0, 1), 1, 1, 1, 1, 1, 0);
  expect(box_of(4, 4, 9, 0, 1), 1, 2, 2, 2, 2, 0);
  expect(box_of(1e7, 1, 1, 0, 0), 1e-3, 0.5, 0.5, 0.5, 0.5, 0);
  expect(test_rectangle(3, 1, 0), 1, 0.5, 0.5, 0, 0.5, 0);
}

static void round_ones_give_their_centre(void **state)
{
  (void)state;
  packing_domain *ring = NULL;
  packing_domain_annulus_def def;
  packing_domain_annulus_def_init(&def);
  def.inner_radius = 1;
  def.outer_radius = 2;
  assert_ok(packing_domain_create_annulus(NULL, &def, &ring));
  expect(ring, 1, 0, -1.5, 0, 0.5, 0);
  expect(solid_sphere(2, 1, 2, 3), 1, 1, 2, 3, 2, 0);
  expect(solid_circle(2, 1, 2), 1, 1, 2, 0, 2, 0);
}

static void bodies_of_revolution_give_their_axis(void **state)
{
  (void)state;
  expect(solid_cylinder(1, 6, PACKING_AXIS_Z, 1, 2, 3), 1, 1, 2, 4, 1, 1e-15);
  expect(solid_cylinder(1, 6, PACKING_AXIS_X, 1, 2, 3), 1, 2, 2, 3, 1, 1e-15);
  expect(solid_cylinder(4, 2, PACKING_AXIS_Z, 0, 0, 0), 1, 0, -3, 1, 1, 1e-15);
  packing_domain *d = NULL;
  packing_domain_cone_def cone;
  packing_domain_cone_def_init(&cone);
  cone.bottom_radius = 3;
  cone.top_radius = 0;
  cone.height = 4;
  assert_ok(packing_domain_create_cone(NULL, &cone, &d));
  expect(d, 1, 0, 0, 1.5, 1.5, 1e-14); /* in circle of the triangle 6, 5, 5 */
  packing_domain_tube_def tube;
  packing_domain_tube_def_init(&tube);
  tube.inner_radius = 1;
  tube.outer_radius = 2;
  tube.height = 5;
  assert_ok(packing_domain_create_tube(NULL, &tube, &d));
  expect(d, 1, 0, -1.5, 0.5, 0.5, 1e-15);
  packing_domain_silo_def silo;
  packing_domain_silo_def_init(&silo);
  silo.radius = 1;
  silo.height = 0.5;
  silo.hopper_height = 0.25;
  silo.open_top = 1;
  assert_ok(packing_domain_create_silo(NULL, &silo, &d));
  /* Open: at the top of the region, over the cone. */
  expect(d, 1, 0, 0, 0.5, 0.5 * 1 / hypot(1, 0.25), 1e-14);
}

static double ball_distance(void *user, const packing_vec3 *p, packing_vec3 *normal)
{
  (void)user;
  const double rho = sqrt(p->x * p->x + p->y * p->y + p->z * p->z);
  if (normal != NULL)
    *normal = (packing_vec3){rho > 0 ? -p->x / rho : 1, rho > 0 ? -p->y / rho : 0,
                             rho > 0 ? -p->z / rho : 0};
  return 1 - rho;
}

static packing_domain *custom_ball(double margin)
{
  packing_domain *d = NULL;
  packing_domain_custom_def def;
  packing_domain_custom_def_init(&def);
  def.signed_distance = ball_distance;
  def.bounds = (packing_bounds){{-1 - margin, -1, -1}, {1, 1 + margin, 1}};
  def.volume = 4;
  assert_ok(packing_domain_create_custom(NULL, &def, &d));
  return d;
}

static void other_kinds_are_searched(void **state)
{
  (void)state;
  uint64_t seed = 3;
  expect(custom_ball(0), 1e-6, 0, 0, 0, 1, 0); /* the middle of the bounds */
  expect(custom_ball(0.37), 1e-6, 0, 0, 0, 1, 1e-6);
  const test_rings l = rings_l();
  test_rings solid = l;
  solid.rings = 1;
  solid.count = 6;
  const double x = 2 * sqrt(2) / (1 + sqrt(2));
  expect(rings_domain(&solid), 1e-7, x, x, 0, x, 2e-7);
  /* Against a fine net over a polygon with many holes. */
  const test_rings many = rings_many(&seed);
  packing_domain *d = rings_domain(&many);
  packing_vec3 p;
  double found, most = 0;
  assert_ok(packing_domain_innermost(NULL, d, 1e-4, &p, &found));
  for (int i = 0; i < 200; i++)
    for (int k = 0; k < 200; k++)
      most = fmax(most, solid_distance(d, 0.06 * (i - 100), 0.06 * (k - 100), 0));
  assert_true(found >= most - 1e-4 && found <= most + 0.06);
  packing_domain_destroy(d);
}

/* A symmetric container gives its centre line; two chambers give the lower one. */
static void combinations_keep_their_symmetry(void **state)
{
  (void)state;
  packing_domain *d =
      solid_of(PACKING_DIFFERENCE, solid_cylinder(1, 6, PACKING_AXIS_Z, 0, 0, 0),
               solid_box(4, 4, 1, -2, -2, 2.5));
  packing_vec3 p;
  double found;
  assert_ok(packing_domain_innermost(NULL, d, 1e-6, &p, &found));
  assert_true(p.x == 0 && p.y == 0 && p.z < 2.5);
  assert_near(found, 1, 1e-6);
  packing_domain_destroy(d);
  d = solid_of(PACKING_UNION, solid_sphere(1, 0, 0, 0), solid_sphere(1, 0, 0, 3));
  assert_ok(packing_domain_innermost(NULL, d, 1e-5, &p, &found));
  assert_true(p.x == 0 && p.y == 0 && fabs(p.z) < 1e-5);
  packing_domain_destroy(d);
}

static void lengths_scale_by_powers_of_two(void **state)
{
  (void)state;
  uint64_t seed = 17;
  const test_rings r = rings_many(&seed);
  test_rings scaled = r;
  packing_vec3 p, q;
  double a, b;
  for (size_t i = 0; i < r.count; i++) {
    scaled.x[i] = ldexp(r.x[i], 21);
    scaled.y[i] = ldexp(r.y[i], 21);
  }
  packing_domain *d = rings_domain(&r), *e = rings_domain(&scaled);
  assert_ok(packing_domain_innermost(NULL, d, 0.001, &p, &a));
  assert_ok(packing_domain_innermost(NULL, e, ldexp(0.001, 21), &q, &b));
  assert_true(q.x == ldexp(p.x, 21) && q.y == ldexp(p.y, 21) && b == ldexp(a, 21));
  packing_domain_destroy(d);
  packing_domain_destroy(e);
}

static double channel(void *user, const packing_vec3 *p, packing_vec3 *normal)
{
  (void)user;
  const double wave = 0.125 * sin(p->x); /* slope at most 1/8: 0.9 keeps it 1-Lipschitz */
  if (normal != NULL)
    *normal = (packing_vec3){0, p->y > 0 ? -1 : 1, 0};
  return 0.9 * (1 + wave - fabs(p->y));
}

static int warnings;

static void count_warnings(void *user, const packing_log_record *record)
{
  (void)user;
  warnings += record->level == PACKING_LOG_WARNING;
}

/* A channel 1e7 long ends with the best that was met, and says so. */
static void a_long_one_ends_with_a_warning(void **state)
{
  (void)state;
  packing_context_def context_def;
  packing_context *context = NULL;
  packing_domain *d = NULL;
  packing_domain_custom_def def;
  packing_context_def_init(&context_def);
  context_def.log = count_warnings;
  assert_ok(packing_context_create(&context_def, &context));
  packing_domain_custom_def_init(&def);
  def.dim = 2;
  def.signed_distance = channel;
  def.bounds = (packing_bounds){{0, -1.25, 0}, {1e7, 1.25, 0}};
  def.volume = 2e7;
  assert_ok(packing_domain_create_custom(context, &def, &d));
  packing_vec3 p;
  double found;
  warnings = 0;
  assert_ok(packing_domain_innermost(context, d, 1e-3, &p, &found));
  assert_int_equal(warnings, 1);
  assert_true(found > 1 && found <= 0.9 * 1.125);
  packing_domain_destroy(d);
  packing_context_destroy(context);
}

static double gone(void *user, const packing_vec3 *p, packing_vec3 *normal)
{
  (void)p;
  if (normal != NULL)
    *normal = (packing_vec3){1, 0, 0};
  return *(const double *)user;
}

static void refusals(void **state)
{
  (void)state;
  packing_context *context = NULL;
  packing_domain *d = solid_box(1, 1, 1, 0, 0, 0), *empty = NULL;
  packing_vec3 p = {7, 7, 7};
  double found = 7, value = -1;
  assert_ok(packing_context_create(NULL, &context));
  assert_fails(context, packing_domain_innermost(context, NULL, 1, &p, &found),
               PACKING_ERR_INVALID, "domain");
  assert_fails(context, packing_domain_innermost(context, d, 1, NULL, &found),
               PACKING_ERR_INVALID, "point");
  assert_fails(context, packing_domain_innermost(context, d, 0, &p, &found),
               PACKING_ERR_RANGE, "tolerance");
  assert_fails(context, packing_domain_innermost(context, d, (double)NAN, &p, &found),
               PACKING_ERR_INVALID, "tolerance");
  packing_domain_custom_def def;
  packing_domain_custom_def_init(&def);
  def.signed_distance = gone;
  def.user = &value;
  def.bounds = (packing_bounds){{0, 0, 0}, {1, 1, 1}};
  def.volume = 1;
  assert_ok(packing_domain_create_custom(NULL, &def, &empty));
  assert_fails(context, packing_domain_innermost(context, empty, 0.1, &p, &found),
               PACKING_ERR_GEOMETRY, "domain");
  value = (double)NAN;
  assert_fails(context, packing_domain_innermost(context, empty, 0.1, &p, &found),
               PACKING_ERR_GEOMETRY, "domain");
  assert_true(p.x == 7 && found == 7);
  assert_ok(packing_domain_innermost(context, d, 1, &p, NULL));
  packing_domain_destroy(empty);
  packing_domain_destroy(d);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boxes_give_the_lowest_point),
      cmocka_unit_test(round_ones_give_their_centre),
      cmocka_unit_test(bodies_of_revolution_give_their_axis),
      cmocka_unit_test(other_kinds_are_searched),
      cmocka_unit_test(combinations_keep_their_symmetry),
      cmocka_unit_test(lengths_scale_by_powers_of_two),
      cmocka_unit_test(a_long_one_ends_with_a_warning),
      cmocka_unit_test(refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
