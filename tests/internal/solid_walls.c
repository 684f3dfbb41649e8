/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walls near points of polygons and combinations: their numbers, order, feet; and what is
 * told of a point of one is true of its insets. */
#include "solids.h"
#include "domain/domain_internal.h"

static int walls_at(const packing_domain *d, double x, double y, double z, double reach,
                    packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_vec3 p = {x, y, z};
  const int count = packing_i_domain_near_walls(d, &p, reach, near);
  assert_in_range(count, 0, PACKING_I_NEAR_WALLS);
  for (int i = 0; i < count; i++) {
    assert_in_range(near[i].wall, 0, d->body.walls - 1);
    assert_true(near[i].distance < reach);
    assert_near(packing_i_norm(near[i].normal), 1, 1e-9);
    assert_true(i == 0 || near[i].distance >= near[i - 1].distance);
    for (int k = 0; k < i; k++)
      assert_true(near[k].wall != near[i].wall);
  }
  return count;
}

static void edges_and_corners_have_their_numbers(void **state)
{
  (void)state;
  const test_rings r = rings_l();
  packing_domain *d = rings_domain(&r);
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  /* Between the hole's edge 7 (x = 1.5) and the corner (2, 2), vertex 3 of 10. */
  assert_int_equal(walls_at(d, 1.75, 1.5 - 0.25, 0, 0.3, near), 1);
  assert_int_equal(near[0].wall, 7);
  assert_true(near[0].normal.x == 1 && near[0].distance == 0.25);
  assert_int_equal(walls_at(d, 1.875, 1.9, 0, 0.3, near), 1);
  assert_int_equal(near[0].wall, 10 + 3);
  assert_near(near[0].distance, hypot(0.125, 0.1), 1e-15);
  assert_near(near[0].normal.x, -0.125 / hypot(0.125, 0.1), 1e-15);
  /* A corner of the container shows both its edges, nearest first. */
  assert_int_equal(walls_at(d, 0.3, 4.9, 0, 0.5, near), 2);
  assert_int_equal(near[0].wall, 4);
  assert_int_equal(near[1].wall, 5);
  /* Outside the nearest alone; the same numbers in an inset. */
  assert_int_equal(walls_at(d, 4.25, 1, 0, 0.5, near), 1);
  assert_int_equal(near[0].wall, 1);
  assert_true(near[0].distance == -0.25);
  packing_domain *in = NULL;
  assert_ok(packing_domain_create_inset(NULL, d, 0.0625, &in));
  assert_int_equal(walls_at(in, 1.875, 1.9, 0, 0.3, near), 1);
  assert_int_equal(near[0].wall, 10 + 3);
  assert_near(near[0].distance, hypot(0.125, 0.1) - 0.0625, 1e-15);
  packing_domain_destroy(in);
  packing_domain_destroy(d);
}

/* Inside, the nearest wall is the distance and each foot is on the border. */
static void feet_are_on_the_border(void **state)
{
  (void)state;
  uint64_t seed = 2;
  packing_domain *all[5];
  const test_rings many = rings_many(&seed), comb = rings_comb(7, 5);
  all[0] = rings_domain(&many);
  all[1] = rings_domain(&comb);
  all[2] =
      solid_of(PACKING_UNION, solid_box(2, 1, 1, 0, 0, 0), solid_sphere(0.8, 1, 1, 1));
  all[3] = solid_of(PACKING_DIFFERENCE, solid_cylinder(1, 3, PACKING_AXIS_X, 0, 0, 0),
                    solid_box(1, 1, 1, 1, 0, -0.5));
  all[4] = solid_of(PACKING_DIFFERENCE, solid_circle(9, 0, 0), rings_domain(&many));
  for (int k = 0; k < 5; k++) {
    for (int i = 0; i < 300; i++) {
      packing_i_near_wall near[PACKING_I_NEAR_WALLS];
      const packing_vec3 p = scene_random_point(&seed, all[k], 0);
      const double distance = packing_domain_signed_distance(all[k], &p, NULL);
      if (!(distance > 1e-3))
        continue;
      const int count = walls_at(all[k], p.x, p.y, p.z, distance + 0.3, near);
      assert_true(count > 0);
      assert_close(near[0].distance, distance, 1e-3);
      for (int m = 0; m < count; m++) {
        const packing_vec3 n = near[m].normal;
        const double w = near[m].distance;
        const double at =
            solid_distance(all[k], p.x - w * n.x, p.y - w * n.y, p.z - w * n.z);
        assert_near(at, 0, 1e-3 * w);
      }
      assert_int_equal(walls_at(all[k], p.x, p.y, p.z, distance * (1 - 1e-3), near), 0);
    }
    packing_domain_destroy(all[k]);
  }
}

/* The walls of the first container come first, then those of the second, then the seam. */
static void walls_of_combinations_keep_their_numbers(void **state)
{
  (void)state;
  packing_domain *d =
      solid_of(PACKING_UNION, solid_box(2, 1, 1, 0, 0, 0), solid_box(1, 2, 1, 0, 0, 0));
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  assert_int_equal(d->body.walls, 13);
  assert_int_equal(walls_at(d, 1.8, 0.5, 0.5, 0.3, near), 1);
  assert_int_equal(near[0].wall, 1); /* x high of the first */
  assert_int_equal(walls_at(d, 0.5, 1.8, 0.5, 0.3, near), 1);
  assert_int_equal(near[0].wall, 6 + 3); /* y high of the second */
  assert_int_equal(walls_at(d, 0.9, 0.9, 0.5, 0.3, near), 1);
  assert_int_equal(near[0].wall, 12); /* the seam at (1, 1) */
  assert_near(near[0].distance, hypot(0.1, 0.1), 1e-9);
  assert_near(near[0].normal.x, -sqrt(0.5), 1e-6);
  packing_domain_destroy(d);
  d = solid_of(PACKING_DIFFERENCE, solid_box(4, 4, 4, 0, 0, 0),
               solid_box(1, 1, 1, 1, 1, 1));
  assert_int_equal(walls_at(d, 2.25, 1.5, 1.5, 0.3, near), 1);
  assert_int_equal(near[0].wall, 6 + 1);
  assert_true(near[0].normal.x == 1 && near[0].distance == 0.25);
  assert_int_equal(walls_at(d, 2.1, 2.1, 1.5, 0.3, near), 1); /* its edge */
  assert_near(near[0].distance, hypot(0.1, 0.1), 1e-12);
  packing_domain_destroy(d);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edges_and_corners_have_their_numbers),
      cmocka_unit_test(feet_are_on_the_border),
      cmocka_unit_test(walls_of_combinations_keep_their_numbers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
