/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walls near a point, against the signed distance and finite differences. */
#include "domain_scenes.h"
#include "domain/domain_internal.h"

enum { POINTS = 3000 };

static packing_vec3 moved(packing_vec3 p, packing_vec3 n, double by)
{
  return packing_i_add(p, packing_i_scale(n, by));
}

static int walls_at(const packing_domain *domain, packing_vec3 p, double reach,
                    packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const int count = packing_i_domain_near_walls(domain, &p, reach, near);
  assert_in_range(count, 0, PACKING_I_NEAR_WALLS);
  for (int i = 1; i < count; i++)
    assert_true(near[i].wall > near[i - 1].wall);
  return count;
}

static packing_i_near_wall one_wall(const packing_domain *domain, packing_vec3 p,
                                    int wall)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const int count = walls_at(domain, p, 1e9, near);
  for (int i = 0; i < count; i++)
    if (near[i].wall == wall)
      return near[i];
  fail_msg("wall %d is gone", wall);
  return near[0];
}

static packing_vec3 random_point(uint64_t *random, const packing_domain *domain)
{
  packing_vec3 p = scene_random_point(random, domain, 0.3);
  if (packing_domain_dim(domain) == 2)
    p.z = 0;
  return p;
}

/* Inside: the nearest of all walls is the signed distance, to the bit. Outside: never more than
 * it, in absolute value, since walls go on beyond their edges. */
static void check_least(const packing_domain *domain, packing_vec3 p)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  packing_vec3 normal;
  const int count = walls_at(domain, p, HUGE_VAL, near);
  const double distance = packing_domain_signed_distance(domain, &p, &normal);
  int least = 0;
  for (int i = 1; i < count; i++)
    if (near[i].distance < near[least].distance)
      least = i;
  assert_true(count > 0);
  if (distance >= 0) {
    assert_true(near[least].distance == distance);
    assert_true(near[least].normal.x == normal.x && near[least].normal.y == normal.y &&
                near[least].normal.z == normal.z);
  } else {
    assert_true(near[least].distance < 0 && near[least].distance >= distance - 1e-15);
  }
}

/* Only those in reach, the same ones. */
static void check_reach(const packing_domain *domain, packing_vec3 p, double reach)
{
  packing_i_near_wall all[PACKING_I_NEAR_WALLS], near[PACKING_I_NEAR_WALLS];
  const int of_all = walls_at(domain, p, HUGE_VAL, all);
  const int count = walls_at(domain, p, reach, near);
  int k = 0;
  for (int i = 0; i < of_all; i++)
    if (all[i].distance < reach) {
      assert_true(k < count);
      assert_true(near[k].wall == all[i].wall && near[k].distance == all[i].distance);
      k++;
    }
  assert_int_equal(k, count);
}

/* Unit normals along which the distance grows, whether the point is inside or not. */
static void check_normals(const packing_domain *domain, packing_vec3 p)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const int count = walls_at(domain, p, 1e9, near);
  const double h = 0x1p-10;
  for (int i = 0; i < count; i++) {
    const packing_vec3 n = near[i].normal;
    assert_near(packing_i_norm(n), 1, 4e-16);
    if (packing_domain_dim(domain) == 2)
      assert_true(n.z == 0);
    const packing_i_near_wall in = one_wall(domain, moved(p, n, h), near[i].wall);
    assert_near(in.distance - near[i].distance, h, 1e-15);
    /* Across it the distance stands still. */
    const packing_vec3 across = packing_i_vec(n.y, -n.x, 0);
    const double e = 0x1p-20;
    const double ahead = one_wall(domain, moved(p, across, e), near[i].wall).distance;
    const double behind = one_wall(domain, moved(p, across, -e), near[i].wall).distance;
    assert_near((ahead - behind) / (2 * e), 0, 1e-4);
  }
}

static void check_domain(const packing_domain *domain, uint64_t seed)
{
  uint64_t random = seed;
  for (int k = 0; k < POINTS; k++) {
    const packing_vec3 p = random_point(&random, domain);
    check_least(domain, p);
    check_reach(domain, p, 0.5 * scene_random(&random));
    check_normals(domain, p);
  }
}

static void all_kinds(void **state)
{
  (void)state;
  for (int k = 0; k < SCENE_END; k++)
    for (int open = 0; open < 2; open++)
      for (int axis = 0; axis < 3; axis++) {
        scene s = scene_of((enum scene_kind)k);
        if (s.kind >= SCENE_CYLINDER && s.kind <= SCENE_SILO)
          s.axis = axis;
        else if (axis > 0)
          continue;
        s.open = open;
        packing_domain *domain = scene_make(&s), *inset = NULL;
        check_domain(domain, (uint64_t)(100 * k + 10 * open + axis));
        assert_ok(packing_domain_create_inset(NULL, domain, 0.0625, &inset));
        check_domain(inset, (uint64_t)(100 * k + 10 * open + axis + 5));
        packing_domain_destroy(inset);
        packing_domain_destroy(domain);
      }
}

/* Which walls, as a sum of powers of two. */
static unsigned set_of(const packing_domain *domain, double x, double y, double z,
                       double reach)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const int count = walls_at(domain, packing_i_vec(x, y, z), reach, near);
  unsigned set = 0;
  for (int i = 0; i < count; i++)
    set |= 1u << near[i].wall;
  return set;
}

static void boxes_number_their_walls(void **state)
{
  (void)state;
  scene s = {SCENE_BOX, 1, 2, 4, 0, {0, 0, 0}, 2, 0, 0};
  packing_domain *box = scene_make(&s);
  assert_int_equal(set_of(box, 0.5, 1, 2, 0.1), 0);
  assert_int_equal(set_of(box, 0.5, 1, 0.05, 0.1), 1 << 4);
  assert_int_equal(set_of(box, 0.5, 1, 0.1, 0.1), 0); /* less than reach */
  assert_int_equal(set_of(box, 0.95, 1, 0.05, 0.1), 1 << 1 | 1 << 4);
  assert_int_equal(set_of(box, 0.05, 1.95, 3.95, 0.1), 1 << 0 | 1 << 3 | 1 << 5);
  assert_int_equal(set_of(box, 1.05, 2.05, -0.05, 0.1), 1 << 1 | 1 << 3 | 1 << 4);
  assert_int_equal(set_of(box, 0.5, 1, 2, 9), 63);
  packing_domain_destroy(box);
  s.open = 1;
  s.periodic = PACKING_PERIODIC_X;
  box = scene_make(&s);
  assert_int_equal(set_of(box, 0.5, 1, 2, 9), 1 << 2 | 1 << 3 | 1 << 4);
  assert_int_equal(set_of(box, -3, 1, 7, 1), 0);
  packing_domain_destroy(box);
  s = (scene){SCENE_RECTANGLE, 1, 2, 0, 0, {0, 0, 0}, 1, 0, 0};
  box = scene_make(&s);
  assert_int_equal(set_of(box, 0.5, 1, 0, 9), 15);
  packing_domain_destroy(box);
}

static int count_at(enum scene_kind kind, double rho, double h, double reach)
{
  const scene s = scene_of(kind);
  packing_domain *domain = scene_make(&s);
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 p = {s.at.x + 0.6 * rho, s.at.y - 0.8 * rho,
                          s.at.z + (scene_dim(&s) == 3 ? h : 0)};
  const int count = walls_at(domain, p, reach, near);
  packing_domain_destroy(domain);
  return count;
}

static void round_containers_count_their_walls(void **state)
{
  (void)state;
  /* In the middle, at one wall, in an edge, and all. */
  assert_int_equal(count_at(SCENE_CYLINDER, 0, 0.8, 0.1), 0);
  assert_int_equal(count_at(SCENE_CYLINDER, 0.8, 0.8, 0.1), 1);
  assert_int_equal(count_at(SCENE_CYLINDER, 0.8, 0.05, 0.1), 2);
  assert_int_equal(count_at(SCENE_CYLINDER, 0.3, 0.8, 9), 3);
  assert_int_equal(count_at(SCENE_TUBE, 0.45, 0.6, 0.1), 1);
  assert_int_equal(count_at(SCENE_TUBE, 0.45, 1.15, 0.1), 2);
  assert_int_equal(count_at(SCENE_TUBE, 0.8, 0.6, 9), 4);
  assert_int_equal(count_at(SCENE_CONE, 0.37, 0.05, 0.1), 2);
  assert_int_equal(count_at(SCENE_CONE, 0.1, 0.05, 0.1), 1);
  assert_int_equal(count_at(SCENE_CONE, 0.3, 0.7, 9), 3);
  /* The bend between hopper and bin, .71 above the outlet. */
  assert_int_equal(count_at(SCENE_SILO, 0.9, 0.75, 0.1), 2);
  assert_int_equal(count_at(SCENE_SILO, 0.9, 1.4, 0.1), 1);
  assert_int_equal(count_at(SCENE_SILO, 0.1, 1.4, 9), 4);
  assert_int_equal(count_at(SCENE_SPHERE, 1, 0, 0.1), 1);
  assert_int_equal(count_at(SCENE_SPHERE, 0.9, 0, 0.1), 0);
  assert_int_equal(count_at(SCENE_CIRCLE, 1.05, 0, 0.1), 1);
  assert_int_equal(count_at(SCENE_ANNULUS, 0.75, 0, 0.1), 0);
  assert_int_equal(count_at(SCENE_ANNULUS, 0.75, 0, 0.5), 2);
}

/* On the axis or in the centre, one direction stands for all. */
static void the_middle_has_a_direction(void **state)
{
  (void)state;
  for (int k = 0; k < SCENE_END; k++) {
    const scene s = scene_of((enum scene_kind)k);
    packing_domain *domain = scene_make(&s);
    check_least(domain, packing_i_vec(s.at.x, s.at.y, s.at.z));
    packing_i_near_wall near[PACKING_I_NEAR_WALLS];
    const int count = walls_at(domain, s.at, HUGE_VAL, near);
    for (int i = 0; i < count; i++)
      assert_near(packing_i_norm(near[i].normal), 1, 4e-16);
    packing_domain_destroy(domain);
  }
}

static double slab(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  if (normal != NULL)
    *normal = packing_i_vec(0, 0, point->z < 0.5 ? 1 : -1);
  return point->z < 0.5 ? point->z : 1 - point->z;
}

static void custom_containers_have_one_wall(void **state)
{
  (void)state;
  packing_domain_custom_def def;
  packing_domain *domain = NULL, *inset = NULL;
  packing_domain_custom_def_init(&def);
  def.signed_distance = slab;
  def.bounds.hi = packing_i_vec(1, 1, 1);
  def.volume = 1;
  assert_ok(packing_domain_create_custom(NULL, &def, &domain));
  assert_ok(packing_domain_create_inset(NULL, domain, 0.25, &inset));
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 high = {0.5, 0.5, 0.875}, out = {0.5, 0.5, -0.125};
  assert_int_equal(walls_at(domain, high, 0.125, near), 0);
  assert_int_equal(walls_at(domain, high, 0.25, near), 1);
  assert_true(near[0].distance == 0.125 && near[0].normal.z == -1 && near[0].wall == 0);
  assert_int_equal(walls_at(domain, out, 0.25, near), 1);
  assert_true(near[0].distance == -0.125 && near[0].normal.z == 1);
  assert_int_equal(walls_at(inset, high, 0.25, near), 1);
  assert_true(near[0].distance == -0.125 && near[0].normal.z == -1);
  packing_domain_destroy(inset);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_kinds),
      cmocka_unit_test(boxes_number_their_walls),
      cmocka_unit_test(round_containers_count_their_walls),
      cmocka_unit_test(the_middle_has_a_direction),
      cmocka_unit_test(custom_containers_have_one_wall),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
