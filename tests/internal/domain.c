/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed forms under the cut volumes, and what loops use without a call. */
#include "domain/domain_kinds.h"
#include "test.h"

/* Simpson's rule over the height of a cap: exact for balls, refined for discs. */
static double slow_cap(int dim, double r, double h)
{
  if (dim == 3)
    return PACKING_I_PI * h / 6 * (0 + 4 * (2 * r - h / 2) * h / 2 + (2 * r - h) * h);
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; i++) { /* y = h (1 - t^2): no root at the end */
    const double t = (i + 0.5) / n, y = h * t * t;
    sum += 2 * sqrt((2 * r - y) * y) * 2 * h * t / n;
  }
  return sum;
}

static void caps_agree_with_slices(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (double h = 1e-9; h < 2; h *= 1.7)
      assert_close(packing_i_cap(dim, 1, h), slow_cap(dim, 1, h),
                   dim == 3 ? 1e-14 : 1e-8);
  assert_true(packing_i_cap(2, 1, -1) == 0 && packing_i_cap(3, 1, 0) == 0);
  assert_close(packing_i_cap(2, 3, 3), 4.5 * PACKING_I_PI, 1e-15);
  assert_close(packing_i_cap(2, 3, 9), 9 * PACKING_I_PI, 1e-15);
  assert_close(packing_i_cap(3, 3, 9), 36 * PACKING_I_PI, 1e-15);
}

/* A thin segment is 4/3 h sqrt(2 r h) (1 - 3/20 h / r ...): far below the sector's rounding. */
static void thin_segments_keep_their_digits(void **state)
{
  (void)state;
  for (int k = 8; k < 40; k += 4) {
    const double h = pow(10, -k);
    assert_close(packing_i_cap(2, 1, h), 4.0 / 3.0 * h * sqrt(2 * h) * (1 - 0.15 * h),
                 3e-16 + h * h);
  }
}

static void lenses_are_symmetric_and_bounded(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (double d = 0; d < 4; d += 0.01) {
      const double v = packing_i_lens(dim, 1, 2, d);
      assert_close(v, packing_i_lens(dim, 2, 1, d), 1e-14);
      assert_true(v <= packing_i_ball_volume(dim, 1) * (1 + 1e-15));
      if (d >= 3)
        assert_true(v == 0);
      if (d <= 1)
        assert_true(v == packing_i_ball_volume(dim, 1));
    }
  /* Equal balls at a distance r: 5/16 of one; discs: 2/3 - sqrt(3) / (2 pi) of one. */
  assert_close(packing_i_lens(3, 2, 2, 2), 5.0 / 16.0 * packing_i_ball_volume(3, 2),
               1e-15);
  assert_close(packing_i_lens(2, 2, 2, 2),
               (2.0 / 3.0 - sqrt(3) / (2 * PACKING_I_PI)) * packing_i_ball_volume(2, 2),
               1e-15);
}

/* Planes through a ball in all octants: a corner against slices by rectangles. */
static void corners_agree_with_slices(void **state)
{
  (void)state;
  const double far = HUGE_VAL;
  for (double a = -0.9; a < 1; a += 0.45)
    for (double b = -0.8; b < 1; b += 0.4)
      for (double c = -0.7; c < 1; c += 0.35) {
        const double lo[] = {a, b, c}, hi[] = {far, far, far};
        double error, slow = 0, unused;
        const double v = packing_i_cut_planes(3, 1, lo, hi, &error);
        const int n = 2000;
        const double from = asin(c), to = 0.5 * PACKING_I_PI;
        for (int i = 0; i < n; i++) {
          const double t = from + (to - from) * (i + 0.5) / n;
          slow +=
              packing_i_cut_planes(2, cos(t), lo, hi, &unused) * cos(t) * (to - from) / n;
        }
        assert_near(v, slow, 2e-6);
        assert_true(error < 1e-13);
      }
}

static void boxes_show_their_walls(void **state)
{
  (void)state;
  packing_domain_box_def def;
  packing_domain *box = NULL;
  packing_domain_box_def_init(&def);
  def.size = (packing_vec3){1, 2, 3};
  def.periodic = PACKING_PERIODIC_Y;
  def.open_top = 1;
  assert_ok(packing_domain_create_box(NULL, &def, &box));
  const packing_i_planar *p = packing_i_domain_planar(box);
  assert_non_null(p);
  assert_true(p->wall_lo[0] == 0 && p->wall_hi[0] == 1);
  assert_true(p->wall_lo[1] == -HUGE_VAL && p->wall_hi[1] == HUGE_VAL);
  assert_true(p->wall_lo[2] == 0 && p->wall_hi[2] == HUGE_VAL);
  assert_true(p->cut_hi[2] == 3 && p->cut_hi[1] == HUGE_VAL);
  assert_int_equal(packing_i_domain_axis(box), -1);
  packing_domain_destroy(box);
  packing_domain_cone_def cone;
  packing_domain_cone_def_init(&cone);
  cone.top_radius = 1;
  cone.height = 1;
  cone.axis = PACKING_AXIS_Y;
  assert_ok(packing_domain_create_cone(NULL, &cone, &box));
  assert_null(packing_i_domain_planar(box));
  assert_int_equal(packing_i_domain_axis(box), PACKING_AXIS_Y);
  packing_domain_destroy(box);
}

/* Around a ball of radius 1: inside of it, or outside. */
static double round_distance(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  const double side = *(const double *)user, far = packing_i_norm(*point);
  if (normal != NULL)
    *normal = packing_i_scale(*point, -side / far);
  return side * (1 - far);
}

/* Both ways of bending against the lens. */
static void columns_agree_with_lenses(void **state)
{
  (void)state;
  packing_i_domain_body body = {.ops = &packing_i_custom_ops, .dim = 3};
  for (double side = -1; side < 2; side += 2)
    for (double r = 0.2; r > 0.005; r *= 0.5)
      for (double at = -0.95; at < 1; at += 0.1) {
        const double d = at * r, ball = packing_i_ball_volume(3, r);
        const packing_vec3 way = {0.48, -0.6, 0.64};
        const packing_vec3 p = packing_i_scale(way, 1 - side * d);
        const double lens = packing_i_lens(3, r, 1, 1 - side * d);
        double volume, error;
        body.as.custom =
            (packing_i_custom){.signed_distance = round_distance, .user = &side};
        assert_true(packing_i_cut_columns(&body, &p, r, d, packing_i_scale(way, -side),
                                          1e-3 * ball, &volume, &error));
        assert_true(error <= 1e-3 * ball);
        assert_near(volume / ball, (side > 0 ? lens : ball - lens) / ball, 0.06 * r * r);
      }
}

/* A second wall opposite or, with the box on its side, along the columns. */
static void columns_see_a_second_wall(void **state)
{
  (void)state;
  int refused = 0, taken = 0;
  for (double size = 0.55; size < 1.3; size += 0.05)
    for (double near = 0.02; near < 0.5 * size; near += 0.02) {
      const double r = 0.5, ball = packing_i_ball_volume(3, r), over = near + r - size;
      packing_domain *flat = test_box(8, 8, size, 0), *deep = test_box(8, 8, 8, 0);
      const packing_vec3 between = {4, 4, near}, up = {0, 0, 1},
                         edge = {4, size - near, near};
      const double lo[3] = {-HUGE_VAL, -edge.y, -edge.z},
                   far[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
      double volume, error, rounding;
      const double cut =
          packing_i_cap(3, r, r + near) - packing_i_cap(3, r, fmax(over, 0));
      if (packing_i_cut_columns(&flat->body, &between, r, near, up, 1e-3 * ball, &volume,
                                &error)) {
        assert_near(volume / ball, cut / ball, 1e-3);
        taken++;
      } else
        refused++;
      if (packing_i_cut_columns(&deep->body, &edge, r, near, up, 1e-3 * ball, &volume,
                                &error)) {
        assert_near(volume / ball, packing_i_cut_planes(3, r, lo, far, &rounding) / ball,
                    1e-3);
        taken++;
      } else
        refused++;
      packing_domain_destroy(flat);
      packing_domain_destroy(deep);
    }
  assert_true(refused > 50 && taken > 50);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(caps_agree_with_slices),
      cmocka_unit_test(thin_segments_keep_their_digits),
      cmocka_unit_test(lenses_are_symmetric_and_bounded),
      cmocka_unit_test(corners_agree_with_slices),
      cmocka_unit_test(boxes_show_their_walls),
      cmocka_unit_test(columns_agree_with_lenses),
      cmocka_unit_test(columns_see_a_second_wall),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
