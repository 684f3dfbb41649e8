/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The four ways to place a particle in contact, where the answer is known by hand, and
 * what they refuse. */
#include "touching.h"

static const char *const names[] = {"wrappers", "potential", "binary", "direct"};

static int place(const char *name, const packing_contact_task *task,
                 packing_vec3 centre[2])
{
  return packing_contact_place(packing_contact_method_named(name), task, centre);
}

/* Radii a, b, c of spheres that touch one another: the first at the origin, the second on
 * the x axis, the third in the plane z = 0. */
static packing_contact_task triple(double a, double b, double c, double r)
{
  packing_contact_task task = touching_task(3, r);
  const double x =
      ((a + b) * (a + b) + (a + c) * (a + c) - (b + c) * (b + c)) / (2 * (a + b));
  task.fixed[0] = touching_sphere(0, 0, 0, a);
  task.fixed[1] = touching_sphere(a + b, 0, 0, b);
  task.fixed[2] = touching_sphere(x, sqrt((a + c) * (a + c) - x * x), 0, c);
  return task;
}

/* F8's closed form: the way above the mean of the centres at which the first is met. */
static double approach(const packing_contact_task *task, packing_vec3 *mean)
{
  double most = -1;
  *mean = packing_body_sphere((packing_vec3){0, 0, 0}, 1).centre;
  for (int i = 0; i < task->dim; i++) {
    mean->x += task->fixed[i].centre.x / task->dim;
    mean->y += task->fixed[i].centre.y / task->dim;
    mean->z += task->fixed[i].centre.z / task->dim;
  }
  for (int i = 0; i < task->dim; i++) {
    const double d = touching_apart(*mean, task->fixed[i].centre);
    const double reach = task->mobile.r + task->fixed[i].r;
    if (reach > d)
      most = fmax(most, sqrt(reach * reach - d * d));
  }
  return most;
}

/* Three unit spheres and r = 1: all four methods at the height sqrt(8/3), above and
 * below. */
static void unit_spheres(void **state)
{
  (void)state;
  const packing_contact_task task = triple(1, 1, 1, 1);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2];
    assert_int_equal(place(names[m], &task, centre), 2);
    for (int i = 0; i < 2; i++) {
      assert_near(centre[i].x, 1.0, 1e-12);
      assert_near(centre[i].y, sqrt(1.0 / 3), 1e-12);
      assert_near(centre[i].z, (i == 0 ? 1 : -1) * 1.63299316185545, 1e-11);
    }
  }
}

/* Exact places in the local frame; the approximate ones above the mean. */
static void known_triples(void **state)
{
  (void)state;
  static const double known[][7] = {
      {1, 2, 3, 1.5, .5, .25, 2.43669858620224},
      {3, 2, 1, .5, 3.1, 1.28333333333333, .996521728591783},
      {1000, 1000, 1000, 160, 1000, 577.350269189626, 110.754984838908},
  };
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
    const double *v = known[k];
    const packing_contact_task task = triple(v[0], v[1], v[2], v[3]);
    for (int m = 0; m < 4; m++) {
      packing_vec3 centre[2], mean;
      const double height = approach(&task, &mean);
      assert_int_equal(place(names[m], &task, centre), 2);
      for (int i = 0; i < 2; i++) {
        assert_near(centre[i].x, m < 2 ? v[4] : mean.x, 1e-11 * v[0]);
        assert_near(centre[i].y, m < 2 ? v[5] : mean.y, 1e-11 * v[0]);
        assert_near(centre[i].z, (i == 0 ? 1 : -1) * (m < 2 ? v[6] : height),
                    1e-11 * v[0]);
        if (m < 2)
          assert_near(touching_worst(&task, centre[i]), 0.0, 4e-16 * v[0]);
      }
    }
  }
}

/* Too small to touch all: it slips through. Too far apart. In a row. */
static void no_place(void **state)
{
  (void)state;
  packing_contact_task small = triple(1, 1, 1, 0.15), apart = triple(1, 1, 1, 1),
                       row = triple(1, 1, 1, 1);
  apart.fixed[2] = touching_sphere(1, 40, 0, 1);
  row.fixed[2] = touching_sphere(4, 0, 0, 1);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2] = {{7, 7, 7}, {7, 7, 7}};
    assert_int_equal(place(names[m], &small, centre), 0);
    assert_int_equal(place(names[m], &row, centre), 0);
    assert_int_equal(place(names[m], &apart, centre), 0);
    assert_true(centre[0].x == 7 && centre[1].z == 7);
  }
}

/* Figure 5 (b): a particle that just fits the hole has one place. */
static void one_place(void **state)
{
  (void)state;
  packing_vec3 centre[2];
  const packing_contact_task exact = triple(1, 1, 1, 2 / sqrt(3) - 1);
  assert_int_equal(place("wrappers", &exact, centre), 1);
  assert_near(touching_worst(&exact, centre[0]), 0.0, 1e-15);
  const int count = place("potential", &exact, centre);
  assert_int_equal(count, 1);
  assert_near(touching_worst(&exact, centre[0]), 0.0, 1e-12);

  packing_contact_task discs = touching_task(2, 0.75);
  discs.fixed[0] = touching_sphere(0, 0, 0, 1);
  discs.fixed[1] = touching_sphere(3, 0, 0, 0.5);
  for (int m = 0; m < 2; m++) {
    assert_int_equal(place(names[m], &discs, centre), 1);
    assert_near(centre[0].x, 1.75, 1e-12);
    assert_near(centre[0].y, 0.0, 1e-6);
  }
}

/* Discs: 3-4-5, and the side of each place. */
static void discs(void **state)
{
  (void)state;
  packing_contact_task task = touching_task(2, 2);
  task.fixed[0] = touching_sphere(0, 0, 0, 3);
  task.fixed[1] = touching_sphere(6, 0, 0, 3);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2];
    assert_int_equal(place(names[m], &task, centre), 2);
    for (int i = 0; i < 2; i++) {
      assert_near(centre[i].x, 3.0, 1e-12);
      assert_near(centre[i].y, i == 0 ? -4.0 : 4.0, 1e-11);
      assert_true(centre[i].z == 0);
    }
  }
  task.mobile.r = 1;
  task.fixed[1] = touching_sphere(0, -19.5, 0, 15);
  packing_vec3 centre[2];
  assert_int_equal(place("wrappers", &task, centre), 2);
  assert_true(centre[0].x < 0 && centre[1].x > 0);
}

/* Two unit spheres in touch on the floor: the third makes the triangle. */
static void on_the_floor(void **state)
{
  (void)state;
  packing_domain *box = test_box(10, 8, 6, 0);
  packing_contact_task task = touching_task(3, 1);
  task.fixed[0] = touching_sphere(4, 4, 1, 1);
  task.fixed[1] = touching_wall(box, 4);
  task.fixed[2] = touching_sphere(6, 4, 1, 1);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2];
    assert_int_equal(place(names[m], &task, centre), 2);
    for (int i = 0; i < 2; i++) {
      assert_near(centre[i].x, 5.0, 1e-11);
      assert_near(centre[i].y, 4 + (i == 0 ? -1 : 1) * sqrt(3), 1e-11);
      assert_near(centre[i].z, 1.0, 1e-11);
      if (m < 2)
        assert_near(touching_worst(&task, centre[i]), 0.0, 1e-15);
      else
        assert_true(touching_least(&task, centre[i]) >= -2e-15);
    }
  }
  packing_domain_destroy(box);
}

/* One sphere and two walls: along the edge. */
static void in_the_edge(void **state)
{
  (void)state;
  packing_domain *box = test_box(10, 8, 6, 0);
  packing_contact_task task = touching_task(3, 0.5);
  task.fixed[0] = touching_wall(box, 0);
  task.fixed[1] = touching_wall(box, 4);
  task.fixed[2] = touching_sphere(1, 4, 1, 1);
  const double way = sqrt(1.5 * 1.5 - 0.5);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2];
    assert_int_equal(place(names[m], &task, centre), 2);
    for (int i = 0; i < 2; i++) {
      assert_near(centre[i].x, 0.5, 1e-11);
      assert_near(fabs(centre[i].y - 4), way, 1e-11);
      assert_near(centre[i].z, 0.5, 1e-11);
    }
    assert_true(centre[0].y < centre[1].y);
  }
  /* Opposite walls leave no line, and no particle touches both. */
  task.fixed[1] = touching_wall(box, 1);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2];
    assert_int_equal(place(names[m], &task, centre), 0);
  }
  packing_domain_destroy(box);
}

/* A disc and a wall of a rectangle, and of a circle from within. */
static void discs_at_walls(void **state)
{
  (void)state;
  packing_domain *rectangle = test_rectangle(10, 8, 0);
  packing_contact_task task = touching_task(2, 1);
  task.fixed[0] = touching_sphere(5, 1, 0, 1);
  task.fixed[1] = touching_wall(rectangle, 2);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2];
    assert_int_equal(place(names[m], &task, centre), 2);
    assert_near(centre[0].x, 3.0, 1e-11);
    assert_near(centre[1].x, 7.0, 1e-11);
    assert_near(centre[0].y, 1.0, 1e-11);
  }
  const scene s = {.kind = SCENE_CIRCLE, .a = 5, .at = {1, 2, 0}};
  packing_domain *circle = scene_make(&s);
  task.fixed[0] = touching_sphere(5, 2, 0, 1);
  task.fixed[1] = touching_wall(circle, 0);
  const double turn = 2 * asin(0.25);
  for (int m = 0; m < 4; m++) {
    packing_vec3 centre[2];
    assert_int_equal(place(names[m], &task, centre), 2);
    for (int i = 0; i < 2; i++) {
      assert_true(touching_least(&task, centre[i]) >= -2e-15);
      assert_near(touching_gap(&task, centre[i], 0), 0.0, 2e-12);
      if (m > 1)
        continue;
      assert_near(touching_worst(&task, centre[i]), 0.0, 1e-15);
      assert_near(centre[i].x, 1 + 4 * cos(turn), 1e-12);
      assert_near(centre[i].y, 2 + (i == 0 ? -4 : 4) * sin(turn), 1e-12);
    }
  }
  packing_domain_destroy(circle);
  packing_domain_destroy(rectangle);
}

/* On the floor of a cylinder, in touch with its side; and with the inside of a ball. */
static void at_curved_walls(void **state)
{
  (void)state;
  const scene s = {.kind = SCENE_CYLINDER, .a = 5, .b = 20, .axis = 2};
  packing_domain *cylinder = scene_make(&s);
  packing_contact_task task = touching_task(3, 1);
  packing_vec3 centre[2];
  task.fixed[0] = touching_sphere(4, 0, 1, 1);
  /* Whatever their numbers are: the floor is the one 0 below. */
  int floor = -1, side = -1;
  for (int k = 0; k < 3; k++) {
    const packing_body wall = touching_wall(cylinder, k),
                       probe = touching_sphere(0.5, 0, 3, 1);
    const double gap = packing_body_gap(&probe, &wall);
    floor = fabs(gap - 2) < 1e-9 ? k : floor;
    side = fabs(gap - 3.5) < 1e-9 ? k : side;
  }
  assert_true(floor >= 0 && side >= 0);
  task.fixed[1] = touching_wall(cylinder, floor);
  task.fixed[2] = touching_wall(cylinder, side);
  const double turn = 2 * asin(0.25);
  for (int m = 0; m < 4; m++) {
    assert_int_equal(place(names[m], &task, centre), 2);
    for (int i = 0; i < 2; i++) {
      assert_true(touching_least(&task, centre[i]) >= -2e-15);
      if (m > 1)
        continue;
      assert_near(touching_worst(&task, centre[i]), 0.0, 1e-15);
      assert_near(centre[i].x, 4 * cos(turn), 1e-12);
      assert_near(fabs(centre[i].y), 4 * sin(turn), 1e-12);
      assert_near(centre[i].z, 1.0, 1e-12);
    }
  }
  packing_domain_destroy(cylinder);

  const scene ball = {.kind = SCENE_SPHERE, .a = 5};
  packing_domain *inside = scene_make(&ball);
  task.fixed[0] = touching_sphere(4 * cos(turn / 2), 4 * sin(turn / 2), 0, 1);
  task.fixed[1] = touching_sphere(4 * cos(turn / 2), -4 * sin(turn / 2), 0, 1);
  task.fixed[2] = touching_wall(inside, -1);
  for (int m = 0; m < 2; m++) {
    assert_int_equal(place(names[m], &task, centre), 2);
    for (int i = 0; i < 2; i++) {
      const packing_vec3 zero = {0, 0, 0};
      assert_near(touching_worst(&task, centre[i]), 0.0, 1e-15);
      assert_near(touching_apart(centre[i], zero), 4.0, 1e-14);
      assert_near(centre[i].y, 0.0, 1e-14);
    }
    assert_true(centre[0].z * centre[1].z < 0);
  }
  packing_domain_destroy(inside);
}

/* A cluster goes through three methods; wrappers are of spheres. */
static void clusters(void **state)
{
  (void)state;
  static const double upright[4] = {1, 0, 0, 0};
  packing_shape *shape = test_cluster(0.6, 1);
  packing_vec3 centre[2], direct[2];
  packing_contact_task task = triple(1, 1.1, 1.2, 1);
  assert_int_equal(place("wrappers", &task, centre), 2);
  task.mobile = test_cluster_body(shape, task.mobile.centre, 1, upright);
  assert_int_equal(place("wrappers", &task, centre), 0);
  assert_int_equal(place("potential", &task, centre), 2);
  for (int i = 0; i < 2; i++) {
    assert_near(touching_worst(&task, centre[i]), 0.0, 1e-12);
    assert_true(i == 0 ? centre[i].z > 0 : centre[i].z < 0);
  }
  assert_int_equal(place("binary", &task, centre), 2);
  assert_int_equal(place("direct", &task, direct), 2);
  for (int i = 0; i < 2; i++) {
    assert_near(touching_apart(centre[i], direct[i]), 0.0, 1e-11);
    assert_true(touching_least(&task, centre[i]) >= 0);
  }
  task = triple(1, 1.1, 1.2, 1);
  task.fixed[1].shape = shape;
  assert_int_equal(place("wrappers", &task, centre), 0);
  packing_shape_destroy(shape);
}

static void by_name(void **state)
{
  (void)state;
  for (int m = 0; m < 4; m++) {
    const packing_contact_method *method = packing_contact_method_named(names[m]);
    assert_string_equal(method->name, names[m]);
    assert_true(strlen(method->reference) > 10);
    assert_int_equal(method->exact, m < 2);
  }
  assert_ptr_equal(packing_contact_method_named("wrappers"), packing_contact_wrappers());
  assert_ptr_equal(packing_contact_method_named("direct"), packing_contact_direct());
  assert_null(packing_contact_method_named("Wrappers"));
  assert_null(packing_contact_method_named(""));
  assert_null(packing_contact_method_named(NULL));
}

static int at_seven(void *user, const packing_contact_task *task, packing_vec3 centre[2])
{
  (void)task;
  centre[0].x = *(double *)user;
  return 1;
}

/* A method of the host's own; and tasks that make no sense have no places, whatever the
 * method. */
static void tasks_without_sense(void **state)
{
  (void)state;
  double seven = 7;
  packing_contact_method own = {.name = "own", .place = at_seven, .user = &seven};
  packing_vec3 centre[2] = {{0, 0, 0}, {0, 0, 0}};
  const packing_contact_task good = triple(1, 1, 1, 1);
  packing_domain *box = test_box(10, 8, 6, 0);
  assert_int_equal(packing_contact_place(&own, &good, centre), 1);
  assert_true(centre[0].x == 7);
  assert_int_equal(packing_contact_place(NULL, &good, centre), 0);
  assert_int_equal(packing_contact_place(&own, NULL, centre), 0);
  assert_int_equal(packing_contact_place(&own, &good, NULL), 0);
#define SENSELESS(change)                                                                \
  do {                                                                                   \
    packing_contact_task bad = good;                                                     \
    change;                                                                              \
    assert_int_equal(packing_contact_place(&own, &bad, centre), 0);                      \
  } while (0)
  SENSELESS(bad.struct_size = 3);
  SENSELESS(bad.dim = 1);
  SENSELESS(bad.dim = 4);
  SENSELESS(bad.mobile.r = 0);
  SENSELESS(bad.mobile.r = -1);
  SENSELESS(bad.mobile.r = (double)NAN);
  SENSELESS(bad.mobile.r = HUGE_VAL);
  SENSELESS(bad.mobile = touching_wall(box, 0));
  SENSELESS(bad.fixed[1].r = 0);
  SENSELESS(bad.fixed[1].r = (double)NAN);
  SENSELESS(bad.fixed[2].r = HUGE_VAL);
  SENSELESS(bad.fixed[2].centre.y = (double)NAN);
  SENSELESS(for (int i = 0; i < 3; i++) bad.fixed[i] = touching_wall(box, 2 * i));
  own.place = NULL;
  assert_int_equal(packing_contact_place(&own, &good, centre), 0);
  /* A wall that is not there. */
  packing_contact_task missing = good;
  missing.fixed[1] = touching_wall(box, 9);
  for (int m = 0; m < 4; m++)
    assert_int_equal(place(names[m], &missing, centre), 0);
  packing_domain_destroy(box);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(unit_spheres),    cmocka_unit_test(known_triples),
      cmocka_unit_test(no_place),        cmocka_unit_test(one_place),
      cmocka_unit_test(discs),           cmocka_unit_test(on_the_floor),
      cmocka_unit_test(in_the_edge),     cmocka_unit_test(discs_at_walls),
      cmocka_unit_test(at_curved_walls), cmocka_unit_test(clusters),
      cmocka_unit_test(by_name),         cmocka_unit_test(tasks_without_sense),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
