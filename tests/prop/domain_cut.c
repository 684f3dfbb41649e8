/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumes of balls cut by containers, against the slow way: the sum over many lines along the
 * container's axis of the common length. */
#include "domain_scenes.h"

static double common_length(const scene *s, double u, double v, double mid, double half)
{
  scene_piece piece[2];
  const int n = scene_pieces(s, u, v, piece);
  double sum = 0;
  for (int i = 0; i < n; i++) {
    const double lo = fmax(piece[i].lo, mid - half), hi = fmin(piece[i].hi, mid + half);
    if (hi > lo)
      sum += piece[i].sign * (hi - lo);
  }
  return sum;
}

/* Lines u = u0 + r sin(t) cos(f) ... with equal weights in the substituted variables: the ends
 * of the ball cost nothing. */
static double slow_volume(const scene *s, packing_vec3 centre, double r, int n)
{
  const double mid = scene_coordinate(centre, s->axis);
  const double u = scene_coordinate(centre, (s->axis + 1) % 3);
  const double v = scene_coordinate(centre, (s->axis + 2) % 3);
  double sum = 0;
  if (scene_dim(s) == 2) {
    const int lines = n * n;
    for (int i = 0; i < lines; i++) {
      const double t = TEST_PI * ((i + 0.5) / lines - 0.5);
      const double half = r * cos(t);
      sum += common_length(s, 0, v + r * sin(t), mid, half) * half;
    }
    return sum * TEST_PI / lines;
  }
  for (int i = 0; i < n; i++) {
    const double t = 0.5 * TEST_PI * (i + 0.5) / n;
    const double rho = r * sin(t), half = r * cos(t);
    double ring = 0;
    for (int j = 0; j < 2 * n; j++) {
      const double f = TEST_PI * (j + 0.5) / n;
      ring += common_length(s, u + rho * cos(f), v + rho * sin(f), mid, half);
    }
    sum += ring * rho * half;
  }
  return sum * (TEST_PI / n) * (0.5 * TEST_PI / n);
}

static double whole(const scene *s, double r)
{
  return scene_dim(s) == 2 ? TEST_PI * r * r : 4.0 / 3.0 * TEST_PI * r * r * r;
}

static double cut(const packing_domain *domain, packing_vec3 centre, double r,
                  double tolerance, double *error)
{
  double volume = -1;
  assert_ok(packing_domain_sphere_volume(domain, &centre, r, tolerance, &volume, error));
  return volume;
}

/* Tiny, middling and huge balls everywhere round a container. */
static void hold_against_slow(const scene *s, uint64_t seed, int balls)
{
  packing_domain *domain = scene_make(s);
  uint64_t state = seed;
  for (int i = 0; i < balls; i++) {
    const packing_vec3 p = scene_random_point(&state, domain, 0.4);
    const double r = pow(10, -1.5 + 2.2 * scene_random(&state));
    double error = -1;
    const double v = cut(domain, p, r, 1e-10, &error);
    assert_true(error >= 0 && error <= 1e-10 * whole(s, r));
    assert_near(v, slow_volume(s, p, r, 300), 3e-4 * whole(s, r));
    /* A coarser answer keeps its promise. */
    const double coarse = cut(domain, p, r, 1e-3, &error);
    assert_near(coarse, v, error + 1e-10 * whole(s, r));
    assert_true(error <= 1e-3 * whole(s, r));
    assert_true(s->periodic || v <= packing_domain_volume(domain) * (1 + 1e-14));
  }
  packing_domain_destroy(domain);
}

static void cuts_agree_with_lines(void **state)
{
  (void)state;
  for (int kind = 0; kind < SCENE_END; kind++) {
    scene s = scene_of((enum scene_kind)kind);
    hold_against_slow(&s, 11 + (uint64_t)kind, 20);
  }
}

static void cuts_agree_with_lines_in_unusual_shapes(void **state)
{
  (void)state;
  const scene unusual[] = {
      {SCENE_BOX, 1.3, 0.9, 1.7, 0, {0.2, -0.4, 0.1}, 2, 1, 1},
      {SCENE_BOX, 1.3, 0.9, 1.7, 0, {0.2, -0.4, 0.1}, 2, 0, 6},
      {SCENE_RECTANGLE, 1.3, 0.9, 0, 0, {0.2, -0.4, 0}, 1, 1, 1},
      {SCENE_CYLINDER, 0.83, 1.7, 0, 0, {0.2, -0.4, 0.1}, 0, 1, 0},
      {SCENE_TUBE, 0.41, 0.47, 1.2, 0, {0.2, -0.4, 0.1}, 1, 1, 0},
      {SCENE_CONE, 1.1, 0, 0.8, 0, {0.2, -0.4, 0.1}, 1, 0, 0},
      {SCENE_CONE, 0, 1.1, 0.3, 0, {0.2, -0.4, 0.1}, 0, 1, 0},
      {SCENE_CONE, 0.7, 0.7, 1.1, 0, {0.2, -0.4, 0.1}, 2, 0, 0},
      {SCENE_SILO, 0.93, 2.1, 0, 1.9, {0.2, -0.4, 0.1}, 0, 1, 0},
      {SCENE_SILO, 0.93, 2.1, 0.9, 0.01, {0.2, -0.4, 0.1}, 1, 0, 0},
  };
  for (size_t i = 0; i < sizeof unusual / sizeof *unusual; i++)
    hold_against_slow(&unusual[i], 101 + i, 12);
}

/* Boxes that fill space share a ball out among them without loss. */
static void boxes_share_a_ball_out(void **state)
{
  (void)state;
  uint64_t random = 5;
  for (int trial = 0; trial < 20; trial++) {
    const double r = pow(10, -1 + 1.5 * scene_random(&random));
    const packing_vec3 p = {scene_random(&random), scene_random(&random),
                            scene_random(&random)};
    double sum = 0;
    for (int i = 0; i < 27; i++) {
      const double lo[] = {-9, 0, 0.7}, size[] = {9, 0.7, 12};
      scene s = {SCENE_BOX,   size[i % 3], size[i / 3 % 3],
                 size[i / 9], 0,           {lo[i % 3], lo[i / 3 % 3], lo[i / 9]},
                 2,           0,           0};
      packing_domain *domain = scene_make(&s);
      sum += cut(domain, p, r, 1e-9, NULL);
      packing_domain_destroy(domain);
    }
    assert_close(sum, 4.0 / 3.0 * TEST_PI * r * r * r, 1e-13);
  }
}

static void rectangles_share_a_disc_out(void **state)
{
  (void)state;
  uint64_t random = 6;
  for (int trial = 0; trial < 50; trial++) {
    const double r = pow(10, -1 + 1.5 * scene_random(&random));
    const packing_vec3 p = {scene_random(&random), scene_random(&random), 0};
    double sum = 0;
    for (int i = 0; i < 9; i++) {
      const double lo[] = {-9, 0, 0.7}, size[] = {9, 0.7, 12};
      scene s = {SCENE_RECTANGLE,           size[i % 3], size[i / 3], 0, 0,
                 {lo[i % 3], lo[i / 3], 0}, 1,           0,           0};
      packing_domain *domain = scene_make(&s);
      sum += cut(domain, p, r, 1e-9, NULL);
      packing_domain_destroy(domain);
    }
    assert_close(sum, TEST_PI * r * r, 1e-13);
  }
}

static double cut_scene(scene s, packing_vec3 p, double r)
{
  packing_domain *domain = scene_make(&s);
  const double v = cut(domain, p, r, 1e-13, NULL);
  packing_domain_destroy(domain);
  return v;
}

/* Containers that are sums and differences of others. */
static void quadratures_add_up(void **state)
{
  (void)state;
  uint64_t random = 7;
  const packing_vec3 at = {0, 0, 0}, above = {0, 0, 0.8};
  for (int trial = 0; trial < 200; trial++) {
    const double r = pow(10, -1.5 + 2 * scene_random(&random));
    const packing_vec3 p = {2 * scene_random(&random) - 1, 2 * scene_random(&random) - 1,
                            2.4 * scene_random(&random) - 0.2};
    const double ball = 4.0 / 3.0 * TEST_PI * r * r * r;
    const double wide =
        cut_scene((scene){SCENE_CYLINDER, 0.9, 2, 0, 0, at, 2, 0, 0}, p, r);
    const double thin =
        cut_scene((scene){SCENE_CYLINDER, 0.4, 2, 0, 0, at, 2, 0, 0}, p, r);
    const double tube = cut_scene((scene){SCENE_TUBE, 0.4, 0.9, 2, 0, at, 2, 0, 0}, p, r);
    assert_near(tube, wide - thin, 1e-12 * ball);
    const double silo =
        cut_scene((scene){SCENE_SILO, 0.9, 2, 0.3, 0.8, at, 2, 0, 0}, p, r);
    const double cone =
        cut_scene((scene){SCENE_CONE, 0.3, 0.9, 0.8, 0, at, 2, 0, 0}, p, r);
    const double upper =
        cut_scene((scene){SCENE_CYLINDER, 0.9, 1.2, 0, 0, above, 2, 0, 0}, p, r);
    assert_near(silo, cone + upper, 1e-12 * ball);
  }
}

/* Balls whose centre lies on the axis, where the formulas are old. */
static void quadratures_meet_closed_forms(void **state)
{
  (void)state;
  const packing_vec3 origin = {0, 0, 0}, low = {0, 0, -50};
  const double r = 1.37;
  const double ball = 4.0 / 3.0 * TEST_PI * r * r * r;
  /* Coaxial cylinder: the ball less its napkin ring. */
  assert_near(cut_scene((scene){SCENE_CYLINDER, 0.9, 100, 0, 0, low, 2, 0, 0}, origin, r),
              ball - 4.0 / 3.0 * TEST_PI * pow(r * r - 0.81, 1.5), 1e-13 * ball);
  /* Apex at the centre: a cone and its cap, 2/3 pi r^3 (1 - cos(angle)). */
  assert_near(cut_scene((scene){SCENE_CONE, 0, 30, 40, 0, origin, 2, 0, 0}, origin, r),
              2.0 / 3.0 * TEST_PI * r * r * r * (1 - 0.8), 1e-13 * ball);
  /* Viviani: a cylinder through the centre, half as wide as the ball, touches it inside. */
  assert_near(cut_scene((scene){SCENE_CYLINDER, 0.5, 100, 0, 0, low, 2, 0, 0},
                        (packing_vec3){0.5, 0, 0}, 1),
              2.0 / 3.0 * (TEST_PI - 4.0 / 3.0), 1e-13 * ball);
}

static void numbers_of_the_literature(void **state)
{
  (void)state;
  packing_domain *box = test_box(1, 1, 1, 0);
  packing_domain *rectangle = test_rectangle(1, 1, 0);
  const packing_vec3 ball = {0.5, 0.5, 1 - 0.005}, disc = {0.5, 1 - 0.004, 0};
  /* Sphere r .02 cut .005 above the centre, disc r .01 cut .004 above. */
  assert_close(cut(box, ball, 0.02, 1e-9, NULL), 2.290744643243e-5, 1e-12);
  assert_close(cut(rectangle, disc, 0.01, 1e-9, NULL), 2.348919228459e-4, 1e-12);
  const packing_vec3 corner = {0, 1, 1}, edge = {0, 1, 0.5}, face = {0, 0.5, 0.5};
  const double volume = 4.0 / 3.0 * TEST_PI * 0.3 * 0.3 * 0.3;
  assert_close(cut(box, corner, 0.3, 1e-9, NULL), volume / 8, 1e-14);
  assert_close(cut(box, edge, 0.3, 1e-9, NULL), volume / 4, 1e-14);
  assert_close(cut(box, face, 0.3, 1e-9, NULL), volume / 2, 1e-14);
  const packing_vec3 quarter = {1, 0, 0};
  assert_close(cut(rectangle, quarter, 0.3, 1e-9, NULL), TEST_PI * 0.09 / 4, 1e-14);
  packing_domain_destroy(box);
  packing_domain_destroy(rectangle);
}

/* Caps so thin that a difference of volumes would lose them: pi h^2 (3 r - h) / 3. */
static void thin_caps_keep_their_digits(void **state)
{
  (void)state;
  packing_domain *box = test_box(4, 4, 4, 0);
  for (int k = 2; k <= 30; k++) {
    const double h = ldexp(1, -k);
    const packing_vec3 p = {2, 2, h - 1}; /* radius 1: h above the floor */
    assert_close(cut(box, p, 1, 1e-9, NULL), TEST_PI * h * h * (3 - h) / 3, 1e-14);
  }
  packing_domain_destroy(box);
}

/* Whole, nothing, and a container within the ball: no rounding at all. */
static void extremes_are_exact(void **state)
{
  (void)state;
  for (int kind = 0; kind < SCENE_END; kind++) {
    const scene s = scene_of((enum scene_kind)kind);
    packing_domain *domain = scene_make(&s);
    uint64_t random = 3;
    int inside = 0;
    for (int i = 0; i < 300; i++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.1);
      const double d = packing_domain_signed_distance(domain, &p, NULL);
      double error = -1;
      if (d > 0) {
        assert_close(cut(domain, p, d, 1e-9, &error), whole(&s, d), 1e-15);
        assert_true(error == 0);
        inside++;
      } else if (d < 0) {
        assert_near(cut(domain, p, -d * (1 - 1e-12), 1e-9, &error), 0, 1e-30);
      }
      assert_close(cut(domain, p, 50, 1e-9, NULL), packing_domain_volume(domain), 1e-9);
    }
    assert_true(inside > 30);
    packing_domain_destroy(domain);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cuts_agree_with_lines),
      cmocka_unit_test(cuts_agree_with_lines_in_unusual_shapes),
      cmocka_unit_test(boxes_share_a_ball_out),
      cmocka_unit_test(rectangles_share_a_disc_out),
      cmocka_unit_test(quadratures_add_up),
      cmocka_unit_test(quadratures_meet_closed_forms),
      cmocka_unit_test(numbers_of_the_literature),
      cmocka_unit_test(thin_caps_keep_their_digits),
      cmocka_unit_test(extremes_are_exact),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
