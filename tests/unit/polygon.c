/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polygons with holes: exact areas and distances, discs in corners, and every refusal. */
#include "solids.h"

static void the_l_has_its_area_and_bounds(void **state)
{
  (void)state;
  const test_rings r = rings_l();
  packing_domain *d = rings_domain(&r);
  packing_bounds b;
  packing_domain_bounds(d, &b);
  assert_string_equal(packing_domain_kind(d), "polygon");
  assert_int_equal(packing_domain_dim(d), 2);
  assert_true(packing_domain_volume(d) == 13);
  assert_true(b.lo.x == 0 && b.lo.y == 0 && b.lo.z == 0);
  assert_true(b.hi.x == 4 && b.hi.y == 5 && b.hi.z == 0);
  packing_domain_destroy(d);
}

static void distances_and_normals_are_exact(void **state)
{
  (void)state;
  static const double at[][5] = {/* x, y, distance, normal */
                                 {3, 0.75, 0.75, 0, 1},     {3, 1.75, 0.25, 0, -1},
                                 {1, 1, -0.5, 0, 0},        {5, 1, -1, -1, 0},
                                 {1, 4.5, 0.5, 0, -1},      {1.75, 1, 0.25, 1, 0},
                                 {2.75, 2.25, -0.25, 0, -1}};
  const test_rings r = rings_l();
  packing_domain *d = rings_domain(&r);
  for (size_t i = 0; i < sizeof at / sizeof at[0]; i++) {
    const packing_vec3 p = {at[i][0], at[i][1], 0};
    packing_vec3 n;
    assert_near(packing_domain_signed_distance(d, &p, &n), at[i][2], 1e-15);
    if (at[i][3] != 0 || at[i][4] != 0)
      assert_true(n.x == at[i][3] && n.y == at[i][4] && n.z == 0);
  }
  /* The corner that bends in, from inside, and one from outside. */
  const packing_vec3 p = {1.7, 1.9, 0}, q = {-3, -4, 0};
  packing_vec3 n;
  assert_near(packing_domain_signed_distance(d, &p, &n), hypot(0.3, 0.1), 1e-15);
  assert_near(n.x, -0.3 / hypot(0.3, 0.1), 1e-15);
  assert_true(packing_domain_signed_distance(d, &q, &n) == -5);
  assert_near(n.x, 0.6, 1e-15);
  packing_domain_destroy(d);
}

static void rings_may_run_either_way(void **state)
{
  (void)state;
  uint64_t seed = 5;
  const test_rings r = rings_l();
  test_rings back = {0};
  size_t from = 0;
  for (size_t k = 0; k < r.rings; k++) {
    double at[16][2];
    for (size_t i = 0; i < r.sizes[k]; i++) {
      at[i][0] = r.x[from + r.sizes[k] - 1 - i];
      at[i][1] = r.y[from + r.sizes[k] - 1 - i];
    }
    rings_add(&back, r.sizes[k], (const double(*)[2])at);
    from += r.sizes[k];
  }
  packing_domain *a = rings_domain(&r), *b = rings_domain(&back);
  assert_true(packing_domain_volume(a) == packing_domain_volume(b));
  for (int i = 0; i < 500; i++) {
    const packing_vec3 p = scene_random_point(&seed, a, 0.5);
    assert_near(packing_domain_signed_distance(a, &p, NULL),
                packing_domain_signed_distance(b, &p, NULL), 1e-14);
  }
  packing_domain_destroy(a);
  packing_domain_destroy(b);
}

static double disc(const packing_domain *d, double x, double y, double r)
{
  double v = -1, error = -1;
  const packing_vec3 p = {x, y, 0};
  assert_ok(packing_domain_sphere_volume(d, &p, r, 1e-9, &v, &error));
  assert_true(error >= 0);
  return v;
}

static void discs_are_cut_exactly(void **state)
{
  (void)state;
  const test_rings r = rings_l();
  packing_domain *d = rings_domain(&r);
  assert_close(disc(d, 0, 0, 0.4), TEST_PI * 0.16 / 4, 1e-13); /* a corner */
  assert_close(disc(d, 2, 2, 0.4), 3 * TEST_PI * 0.16 / 4,
               1e-13);                                         /* the one that bends in */
  assert_close(disc(d, 3, 0, 0.5), TEST_PI * 0.25 / 2, 1e-13); /* an edge */
  assert_close(disc(d, 0.5, 0.5, 0.3), 3 * TEST_PI * 0.09 / 4, 1e-13); /* of the hole */
  assert_close(disc(d, 1, 1, 20), 13.0, 1e-13);                        /* all of it */
  assert_near(disc(d, 1, 1, 0.4), 0, 1e-15);                           /* in the hole */
  assert_near(disc(d, 1, 1, 0.5), 0, 1e-15);                           /* touching it */
  assert_close(disc(d, 1, 1, 0.7), disc(d, 1, 1, 0.7), 1e-15);
  assert_close(disc(d, 3, 1, 1), TEST_PI, 1e-13);
  assert_near(disc(d, 30, 1, 2), 0, 1e-15);
  packing_domain_destroy(d);
}

static void insets_take_their_distance_off(void **state)
{
  (void)state;
  const test_rings r = rings_l();
  packing_domain *d = rings_domain(&r), *in = NULL;
  assert_ok(packing_domain_create_inset(NULL, d, 0.125, &in));
  packing_domain_destroy(d);
  /* Edges move, the corner that bends in and those of the hole become quarters of a circle. */
  const double area = 3.75 * 1.75 + 1.75 * 3 + (1 - TEST_PI / 4) * 0.125 * 0.125 -
                      (1 + 4 * 0.125 + TEST_PI * 0.125 * 0.125);
  assert_close(packing_domain_volume(in), area, 2e-4);
  assert_near(solid_distance(in, 3, 0.75, 0), 0.625, 1e-15);
  assert_true(packing_domain_holds(in, &(packing_vec3){3, 1, 0}, 0.875));
  assert_close(disc(in, 3, 0.125, 0.5), TEST_PI * 0.25 / 2, 2e-3);
  assert_status(packing_domain_create_inset(NULL, in, 3, &d), PACKING_ERR_GEOMETRY);
  packing_domain_destroy(in);
}

static void lengths_scale_by_powers_of_two(void **state)
{
  (void)state;
  uint64_t seed = 11;
  const test_rings r = rings_many(&seed);
  for (int power = -40; power <= 40; power += 20) {
    const double by = ldexp(1, power);
    test_rings scaled = r;
    for (size_t i = 0; i < r.count; i++) {
      scaled.x[i] *= by;
      scaled.y[i] *= by;
    }
    packing_domain *a = rings_domain(&r), *b = rings_domain(&scaled);
    assert_true(packing_domain_volume(b) == packing_domain_volume(a) * by * by);
    for (int i = 0; i < 50; i++) {
      const packing_vec3 p = scene_random_point(&seed, a, 0.1);
      assert_true(solid_distance(b, p.x * by, p.y * by, 0) ==
                  solid_distance(a, p.x, p.y, 0) * by);
      assert_true(disc(b, p.x * by, p.y * by, 0.7 * by) ==
                  disc(a, p.x, p.y, 0.7) * by * by);
    }
    packing_domain_destroy(a);
    packing_domain_destroy(b);
  }
}

/* ---- refusals ---- */

static void refuse(const test_rings *r, packing_status status, const char *words)
{
  packing_context *context = NULL;
  packing_domain *d = NULL;
  assert_ok(packing_context_create(NULL, &context));
  test_status(rings_create(context, r, &d), status, context, words, __FILE__, __LINE__);
  if (strstr(packing_context_message(context), words) == NULL)
    fail_msg("'%s' does not say '%s'", packing_context_message(context), words);
  assert_null(d);
  packing_context_destroy(context);
}

static void refuse_ring(size_t n, const double (*at)[2], const char *words)
{
  test_rings r = {0};
  rings_add(&r, n, at);
  refuse(&r, PACKING_ERR_GEOMETRY, words);
}

static void rings_that_cross_are_refused(void **state)
{
  (void)state;
  static const double bow[][2] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  static const double flat[][2] = {{0, 0}, {1, 1}, {3, 3}};
  static const double twice[][2] = {{0, 0}, {2, 0}, {2, 0}, {0, 2}};
  static const double pinch[][2] = {{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}};
  static const double spike[][2] = {{0, 0}, {2, 0}, {2, 2}, {2, 1}};
  static const double on_edge[][2] = {{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}};
  static const double closed[][2] = {{0, 0}, {2, 0}, {0, 2}, {0, 0}};
  refuse_ring(4, bow, "crosses or touches");
  refuse_ring(3, flat, "touches");
  refuse_ring(4, twice, "vertices 2 and 3 of ring 1 are one point, 2, 0");
  refuse_ring(6, pinch, "vertex 6 of ring 1 repeats vertex 3 of ring 1, at 1, 1");
  refuse_ring(4, spike, "touches");
  refuse_ring(5, on_edge, "touches");
  refuse_ring(4, closed, "one point");
}

static void rings_that_meet_are_refused(void **state)
{
  (void)state;
  static const double square[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  static const double across[][2] = {{3, 1}, {5, 1}, {5, 2}, {3, 2}};
  static const double touching[][2] = {{1, 1}, {4, 2}, {1, 3}};
  static const double shared[][2] = {{4, 1}, {5, 1}, {5, 3}, {4, 3}};
  const double(*const second[])[2] = {across, touching, shared};
  static const size_t sizes[] = {4, 3, 4};
  for (int i = 0; i < 3; i++) {
    test_rings r = {0};
    rings_add(&r, 4, square);
    rings_add(&r, sizes[i], second[i]);
    refuse(&r, PACKING_ERR_GEOMETRY, "ring 2");
  }
}

static packing_domain_polygon_def square_def(void)
{
  static const double x[] = {0, 4, 4, 0, 1, 2, 2, 1}, y[] = {0, 0, 4, 4, 1, 1, 2, 2};
  static const size_t sizes[] = {4, 4};
  packing_domain_polygon_def def;
  packing_domain_polygon_def_init(&def);
  def.count = 8;
  def.x = x;
  def.y = y;
  def.rings = 2;
  def.sizes = sizes;
  return def;
}

static void fields_are_checked(void **state)
{
  (void)state;
  static const double bad[] = {0, 4, 4, (double)NAN, 1, 2, 2, 1};
  static const double big[] = {0, 1e200, 1e200, 0, 1, 2, 2, 1};
  static const size_t few[] = {6, 2}, more[] = {4, 5}, huge[] = {4, SIZE_MAX - 2};
  static const int right[] = {0, 1}, wrong[] = {0, 0}, odd[] = {0, 2}, outer[] = {1, 1};
  packing_context *context = NULL;
  packing_domain *d = NULL;
  assert_ok(packing_context_create(NULL, &context));
#define REFUSED(change, status, field)                                                   \
  do {                                                                                   \
    packing_domain_polygon_def def = square_def();                                       \
    change;                                                                              \
    assert_fails(context, packing_domain_create_polygon(context, &def, &d), status,      \
                 field);                                                                 \
    assert_null(d);                                                                      \
  } while (0)
  REFUSED(def.count = 2, PACKING_ERR_RANGE, "count");
  REFUSED(def.count = SIZE_MAX, PACKING_ERR_RANGE, "count");
  REFUSED(def.x = NULL, PACKING_ERR_INVALID, "x");
  REFUSED(def.y = NULL, PACKING_ERR_INVALID, "y");
  REFUSED(def.x = bad, PACKING_ERR_INVALID, "x");
  REFUSED(def.y = bad, PACKING_ERR_INVALID, "y");
  REFUSED((def.x = big, def.y = big), PACKING_ERR_RANGE, "x");
  REFUSED(def.rings = 0, PACKING_ERR_RANGE, "rings");
  REFUSED(def.rings = 9, PACKING_ERR_RANGE, "rings");
  REFUSED(def.sizes = NULL, PACKING_ERR_INVALID, "sizes");
  REFUSED(def.sizes = few, PACKING_ERR_RANGE, "sizes");
  REFUSED(def.sizes = more, PACKING_ERR_RANGE, "sizes");
  REFUSED(def.sizes = huge, PACKING_ERR_RANGE, "sizes");
  REFUSED(def.holes = odd, PACKING_ERR_RANGE, "holes");
  REFUSED(def.holes = wrong, PACKING_ERR_GEOMETRY, "holes");
  REFUSED(def.holes = outer, PACKING_ERR_GEOMETRY, "holes");
  REFUSED(def.struct_size = 3, PACKING_ERR_ABI, "struct_size");
#undef REFUSED
  packing_domain_polygon_def def = square_def();
  def.holes = right;
  assert_fails(context, packing_domain_create_polygon(context, &def, NULL),
               PACKING_ERR_INVALID, "domain");
  assert_fails(context, packing_domain_create_polygon(context, NULL, &d),
               PACKING_ERR_INVALID, "def");
  assert_ok(packing_domain_create_polygon(context, &def, &d));
  assert_true(packing_domain_volume(d) == 15);
  packing_domain_destroy(d);
  packing_context_destroy(context);
}

/* A hole said to be one lies outside. */
static void a_hole_outside_is_refused(void **state)
{
  (void)state;
  static const double x[] = {0, 4, 4, 0, 5, 6, 5}, y[] = {0, 0, 4, 4, 1, 1, 2};
  static const size_t sizes[] = {4, 3};
  static const int holes[] = {0, 1};
  packing_context *context = NULL;
  packing_domain *d = NULL;
  packing_domain_polygon_def def = square_def();
  assert_ok(packing_context_create(NULL, &context));
  def.count = 7;
  def.x = x;
  def.y = y;
  def.sizes = sizes;
  def.holes = holes;
  assert_fails(context, packing_domain_create_polygon(context, &def, &d),
               PACKING_ERR_GEOMETRY, "holes");
  assert_non_null(strstr(packing_context_message(context), "ring 2, from 5, 1"));
  def.holes = NULL;
  assert_ok(packing_domain_create_polygon(context, &def, &d));
  assert_true(packing_domain_volume(d) == 16.5);
  packing_domain_destroy(d);
  packing_context_destroy(context);
}

/* ---- the reader ---- */

static packing_status read(packing_context *context, const packing_read_polygon_def *def,
                           const char *text, packing_domain **d)
{
  test_buffer buffer = {0};
  test_buffer_text(&buffer, text);
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_read_polygon(context, def, &stream, d);
  test_buffer_free(&buffer);
  return status;
}

static void files_tell_rings_in_three_ways(void **state)
{
  (void)state;
  static const char *const texts[] = {
      "x,y\n0,0\n4,0\n4,4\n0,4\n\n1,1\n2,1\n2,2\n1,2\n",
      "# a "
      "comment\ny,ring,x\n0,7,0\n0,7,4\n4,7,4\n4,7,0\n0,7,0\n1,3,1\n1,3,2\n2,3,2\n2,3,1",
      "x,y,hole\r\n0,0,0\r\n4,0,0\r\n4,4,0\r\n0,4,0\r\n\r\n\r\n1,1,1\r\n2,1,1\r\n2,2,"
      "1\r\n1,2,1\r\n\r\n",
  };
  for (int i = 0; i < 3; i++) {
    packing_domain *d = NULL;
    assert_ok(read(NULL, NULL, texts[i], &d));
    assert_true(packing_domain_volume(d) == 15);
    packing_domain_destroy(d);
  }
}

static void files_are_scaled_and_moved(void **state)
{
  (void)state;
  packing_read_polygon_def def;
  packing_domain *d = NULL;
  packing_bounds b;
  packing_read_polygon_def_init(&def);
  def.scale = 0.5;
  def.offset = (packing_vec3){1, -2, 0};
  assert_ok(read(NULL, &def, "x,y\n0,0\n4,0\n4,6\n", &d));
  packing_domain_bounds(d, &b);
  assert_true(b.lo.x == 1 && b.hi.x == 3 && b.lo.y == -2 && b.hi.y == 1);
  packing_domain_destroy(d);
}

static void bad_files_are_refused(void **state)
{
  (void)state;
  static const struct {
    const char *text, *words;
    packing_status status;
  } bad[] = {
      {"", "no header", PACKING_ERR_FORMAT},
      {"x,z\n", "unknown column", PACKING_ERR_FORMAT},
      {"x,ring\n1,1\n", "must name x and y", PACKING_ERR_FORMAT},
      {"x,y\n", "truncated", PACKING_ERR_FORMAT},
      {"x,y\n0,0\n1,0\n", "ring 1 ends with 2 vertices", PACKING_ERR_FORMAT},
      {"x,y\n0,0\n1,0\n\n0,1\n", "line 4", PACKING_ERR_FORMAT},
      {"x,y\n0,0\n1,nan\n", "line 3", PACKING_ERR_FORMAT},
      {"x,y\n0,0\n1\n", "1 column, the header has 2", PACKING_ERR_FORMAT},
      {"x,y,hole\n0,0,2\n", "hole: 2 must be 0 or 1", PACKING_ERR_FORMAT},
      {"x,y,hole\n0,0,0\n1,0,1\n", "its ring began with 0", PACKING_ERR_FORMAT},
      {"x,y\n0,0\n2,2\n2,0\n0,2\n", "crosses", PACKING_ERR_GEOMETRY},
      {"x,y\n0,0\n2,0\n2,0\n0,2\n", "one point", PACKING_ERR_GEOMETRY},
  };
  packing_context *context = NULL;
  packing_domain *d = NULL;
  assert_ok(packing_context_create(NULL, &context));
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    test_status(read(context, NULL, bad[i].text, &d), bad[i].status, context, bad[i].text,
                __FILE__, __LINE__);
    if (strstr(packing_context_message(context), bad[i].words) == NULL)
      fail_msg("'%s' does not say '%s'", packing_context_message(context), bad[i].words);
    assert_null(d);
  }
  packing_read_polygon_def def;
  packing_read_polygon_def_init(&def);
  def.scale = 1e308;
  assert_status(read(context, &def, "x,y\n0,0\n20,0\n0,2\n", &d), PACKING_ERR_RANGE);
  def.scale = 0;
  assert_fails(context, read(context, &def, "", &d), PACKING_ERR_RANGE, "scale");
  def.scale = 1;
  def.offset.x = (double)INFINITY;
  assert_fails(context, read(context, &def, "", &d), PACKING_ERR_INVALID, "offset.x");
  def.offset = (packing_vec3){0, 0, 1};
  assert_fails(context, read(context, &def, "", &d), PACKING_ERR_RANGE, "offset.z");
  assert_fails(context, read(context, NULL, "", NULL), PACKING_ERR_INVALID, "domain");
  assert_null(d);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_l_has_its_area_and_bounds),
      cmocka_unit_test(distances_and_normals_are_exact),
      cmocka_unit_test(rings_may_run_either_way),
      cmocka_unit_test(discs_are_cut_exactly),
      cmocka_unit_test(insets_take_their_distance_off),
      cmocka_unit_test(lengths_scale_by_powers_of_two),
      cmocka_unit_test(rings_that_cross_are_refused),
      cmocka_unit_test(rings_that_meet_are_refused),
      cmocka_unit_test(fields_are_checked),
      cmocka_unit_test(a_hole_outside_is_refused),
      cmocka_unit_test(files_tell_rings_in_three_ways),
      cmocka_unit_test(files_are_scaled_and_moved),
      cmocka_unit_test(bad_files_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
