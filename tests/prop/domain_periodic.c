/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Periodic images, against a search over all of them. */
#include "domain_scenes.h"

static packing_domain *cell(unsigned periodic)
{
  const scene s = {SCENE_BOX, 1.3, 0.9, 1.7, 0, {0.21, -0.43, 0.11}, 2, 0, periodic};
  return scene_make(&s);
}

static packing_vec3 anywhere(uint64_t *state, double spread)
{
  return (packing_vec3){spread * (scene_random(state) - 0.5),
                        spread * (scene_random(state) - 0.5),
                        spread * (scene_random(state) - 0.5)};
}

static packing_vec3 period_of(const packing_domain *domain)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  return (packing_vec3){b.hi.x - b.lo.x, b.hi.y - b.lo.y, b.hi.z - b.lo.z};
}

static double length(packing_vec3 v)
{
  return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static void separations_are_the_shortest_of_all_images(void **state)
{
  (void)state;
  for (unsigned periodic = 0; periodic < 8; periodic++) {
    packing_domain *domain = cell(periodic);
    const packing_vec3 period = period_of(domain);
    uint64_t random = 67 + periodic;
    for (int k = 0; k < 300; k++) {
      const packing_vec3 a = anywhere(&random, 5), b = anywhere(&random, 5);
      const packing_vec3 s = packing_domain_separation(domain, &a, &b);
      const packing_vec3 t = packing_domain_separation(domain, &b, &a);
      double shortest = HUGE_VAL;
      const int reach[] = {periodic & 1 ? 6 : 0, periodic & 2 ? 6 : 0,
                           periodic & 4 ? 6 : 0};
      for (int x = -reach[0]; x <= reach[0]; x++)
        for (int y = -reach[1]; y <= reach[1]; y++)
          for (int z = -reach[2]; z <= reach[2]; z++) {
            const packing_vec3 image = {b.x - a.x + x * period.x,
                                        b.y - a.y + y * period.y,
                                        b.z - a.z + z * period.z};
            shortest = fmin(shortest, length(image));
          }
      assert_close(length(s), shortest, 1e-14);
      assert_true(s.x == -t.x && s.y == -t.y && s.z == -t.z);
    }
    packing_domain_destroy(domain);
  }
}

/* Half a period apart: the direct way, which swapping turns round. */
static void ties_go_the_direct_way(void **state)
{
  (void)state;
  packing_domain *domain = test_box(1, 1, 1, 7);
  const packing_vec3 a = {0.25, 0.75, 0}, b = {0.75, 0.25, 1};
  const packing_vec3 s = packing_domain_separation(domain, &a, &b);
  assert_true(s.x == 0.5 && s.y == -0.5 && s.z == 0);
  packing_domain_destroy(domain);
}

static void wrapped_points_are_in_the_cell(void **state)
{
  (void)state;
  for (unsigned periodic = 0; periodic < 8; periodic++) {
    packing_domain *domain = cell(periodic);
    packing_bounds b;
    packing_domain_bounds(domain, &b);
    const packing_vec3 period = period_of(domain);
    uint64_t random = 71 + periodic;
    for (int k = 0; k < 2000; k++) {
      const packing_vec3 p = anywhere(&random, k % 2 ? 9 : 4000);
      packing_vec3 w = p;
      packing_domain_wrap(domain, &w);
      for (int axis = 0; axis < 3; axis++) {
        const double from = scene_coordinate(p, axis), to = scene_coordinate(w, axis);
        if (!(periodic >> axis & 1)) {
          assert_true(to == from);
          continue;
        }
        assert_true(to >= scene_coordinate(b.lo, axis) &&
                    to < scene_coordinate(b.hi, axis));
        const double cells = (from - to) / scene_coordinate(period, axis);
        assert_near(cells, nearbyint(cells), 1e-11);
      }
      packing_vec3 again = w;
      packing_domain_wrap(domain, &again);
      assert_memory_equal(&again, &w, sizeof w);
    }
    packing_domain_destroy(domain);
  }
}

/* Points a rounding error from the borders. */
static void borders_wrap_into_the_cell(void **state)
{
  (void)state;
  packing_domain *domain = cell(7);
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const double lo = b.lo.x, hi = b.hi.x;
  const double at[] = {lo,
                       nextafter(lo, -9),
                       nextafter(lo, 9),
                       hi,
                       nextafter(hi, -9),
                       nextafter(hi, 9),
                       lo - 1e-17,
                       -1e-17,
                       0,
                       -0.0,
                       lo - (hi - lo),
                       hi + (hi - lo),
                       1e17,
                       -1e17,
                       1e300,
                       5e-324};
  for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
    packing_vec3 p = {at[i], 0, 0.5};
    packing_domain_wrap(domain, &p);
    assert_true(p.x >= lo && p.x < hi);
  }
  packing_domain_destroy(domain);
  domain = test_box(1, 1, 1, 7);
  packing_vec3 p = {-1e-17, 1, -5e-324};
  packing_domain_wrap(domain, &p);
  assert_true(p.x == 0 && p.y == 0 && p.z == 0);
  packing_domain_destroy(domain);
}

/* Any image of a point is as far from the walls that there are. */
static void distances_know_no_images(void **state)
{
  (void)state;
  packing_domain *domain = cell(PACKING_PERIODIC_X | PACKING_PERIODIC_Z);
  const packing_vec3 p = {0.7, 0.1, 0.9}, image = {0.7 + 13, 0.1, 0.9 - 17};
  assert_true(packing_domain_signed_distance(domain, &p, NULL) ==
              packing_domain_signed_distance(domain, &image, NULL));
  double v, w;
  assert_ok(packing_domain_sphere_volume(domain, &p, 0.6, 1e-9, &v, NULL));
  assert_ok(packing_domain_sphere_volume(domain, &image, 0.6, 1e-9, &w, NULL));
  assert_true(v == w && v < 4.0 / 3.0 * TEST_PI * 0.216);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(separations_are_the_shortest_of_all_images),
      cmocka_unit_test(ties_go_the_direct_way),
      cmocka_unit_test(wrapped_points_are_in_the_cell),
      cmocka_unit_test(borders_wrap_into_the_cell),
      cmocka_unit_test(distances_know_no_images),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
