/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Placing in contact with walls of every kind of container: tasks made round a particle
 * that touches all their bodies, which the exact methods must find again; the approximate
 * ones come to a free place in contact with something. */
#include "touching.h"

enum { TASKS = 400, TRIES = 400 };

static const scene scenes[] = {
    {.kind = SCENE_BOX, .a = 9, .b = 8, .c = 7, .at = {1, 2, 3}, .axis = 2},
    {.kind = SCENE_CYLINDER, .a = 5, .b = 9, .at = {1, 2, 3}, .axis = 0},
    {.kind = SCENE_TUBE, .a = 3, .b = 8, .c = 9, .axis = 1},
    {.kind = SCENE_CONE, .a = 3, .b = 8, .c = 9, .at = {1, 2, 3}, .axis = 2},
    {.kind = SCENE_CONE, .a = 9, .b = 2, .c = 9, .axis = 1},
    {.kind = SCENE_SILO, .a = 7, .b = 14, .c = 2, .d = 5, .axis = 2},
    {.kind = SCENE_SPHERE, .a = 6, .at = {1, 2, 3}, .axis = 2},
    {.kind = SCENE_RECTANGLE, .a = 9, .b = 8, .axis = 1},
    {.kind = SCENE_CIRCLE, .a = 6, .at = {1, 2, 0}, .axis = 1},
    {.kind = SCENE_ANNULUS, .a = 3, .b = 8, .axis = 1},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* Brings the particle into touch with walls. Returns whether it touches them and is
 * inside. */
static int against(packing_body *mobile, const packing_domain *domain, int walls,
                   const int wall[2])
{
  for (int step = 0; step < 60; step++)
    for (int k = 0; k < walls; k++) {
      packing_vec3 n;
      const double gap = packing_body_wall_gap(mobile, domain, wall[k], &n);
      if (!isfinite(gap))
        return 0;
      mobile->centre.x -= gap * n.x;
      mobile->centre.y -= gap * n.y;
      mobile->centre.z -= gap * n.z;
    }
  for (int k = 0; k < walls; k++)
    if (fabs(packing_body_wall_gap(mobile, domain, wall[k], NULL)) > 1e-14)
      return 0;
  return packing_body_clearance(mobile, domain, NULL) > -1e-13;
}

/* A task round a particle, its bodies in any order; 0: this try was none. */
static int make(uint64_t *random, packing_domain *domain, int walls,
                packing_contact_task *task)
{
  const int dim = packing_domain_dim(domain);
  *task = touching_task(dim, 0.4 + 0.6 * scene_random(random));
  packing_body *mobile = &task->mobile;
  mobile->centre = scene_random_point(random, domain, 0);
  if (dim == 2)
    mobile->centre.z = 0;
  const int wall[2] = {(int)(6 * scene_random(random)), (int)(6 * scene_random(random))};
  if ((walls == 2 && wall[0] == wall[1]) || !against(mobile, domain, walls, wall))
    return 0;
  const int turn = (int)(dim * scene_random(random));
  for (int i = 0; i < dim; i++) {
    packing_body *body = &task->fixed[(i + turn) % dim];
    if (i < walls) {
      *body = touching_wall(domain, wall[i]);
      continue;
    }
    const packing_vec3 v = touching_direction(random, dim);
    const double r = 0.4 + 0.6 * scene_random(random), away = r + mobile->r;
    *body = touching_sphere(mobile->centre.x + away * v.x, mobile->centre.y + away * v.y,
                            mobile->centre.z + away * v.z, r);
    if (packing_body_clearance(body, domain, NULL) < 0)
      return 0;
    for (int j = 0; j < i; j++) {
      const packing_body *other = &task->fixed[(j + turn) % dim];
      if (other->domain == NULL && packing_body_overlap(body, other))
        return 0;
    }
  }
  return 1;
}

/* The volume of the three directions of contact: where it is 0 two places meet. */
static double spread(const packing_contact_task *task)
{
  packing_vec3 n[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  for (int i = 0; i < task->dim; i++) {
    const packing_body *body = &task->fixed[i];
    if (body->domain != NULL) {
      packing_body_wall_gap(&task->mobile, body->domain, body->wall, &n[i]);
      continue;
    }
    const double d = body->r + task->mobile.r;
    n[i].x = (task->mobile.centre.x - body->centre.x) / d;
    n[i].y = (task->mobile.centre.y - body->centre.y) / d;
    n[i].z = (task->mobile.centre.z - body->centre.z) / d;
  }
  return fabs(n[0].x * (n[1].y * n[2].z - n[1].z * n[2].y) +
              n[0].y * (n[1].z * n[2].x - n[1].x * n[2].z) +
              n[0].z * (n[1].x * n[2].y - n[1].y * n[2].x));
}

/* Whether the place the task was made round is among those found; *places grows by how
 * many are. */
static int finds(const packing_contact_method *method, const packing_contact_task *task,
                 int *places)
{
  packing_vec3 centre[2];
  const int count = packing_contact_place(method, task, centre);
  *places += count;
  const double limit = 1e-15 * touching_extent(task);
  int found = 0;
  assert_in_range(count, 0, 2);
  for (int i = 0; i < count; i++) {
    assert_near(touching_worst(task, centre[i]), 0.0,
                method == packing_contact_wrappers() ? limit : 1e-12 * task->mobile.r);
    found = found || touching_apart(centre[i], task->mobile.centre) < 1e-9;
  }
  return found;
}

static void exact_methods(void **state)
{
  (void)state;
  uint64_t random = 3;
  for (int s = 0; s < SCENES; s++) {
    packing_domain *domain = scene_make(&scenes[s]);
    int made = 0, by_wrappers = 0, by_potential = 0, places = 0, others = 0;
    for (int t = 0; t < TASKS * TRIES && made < TASKS; t++) {
      packing_contact_task task;
      const int walls = 1 + (t % 4 == 0 && packing_domain_dim(domain) == 3);
      if (!make(&random, domain, walls, &task) || spread(&task) < 1e-2)
        continue;
      made++;
      by_wrappers += finds(packing_contact_wrappers(), &task, &places);
      by_potential += finds(packing_contact_potential(), &task, &others);
    }
    assert_int_equal(made, TASKS);
    assert_int_equal(by_wrappers, made);
    assert_true(by_potential >= 0.99 * made);
    assert_true(places >= others);
    packing_domain_destroy(domain);
  }
}

/* Free, inside, in contact with something; the two agree. */
static void approximate_methods(void **state)
{
  (void)state;
  uint64_t random = 4;
  for (int s = 0; s < SCENES; s++) {
    packing_domain *domain = scene_make(&scenes[s]);
    int made = 0, places = 0;
    for (int t = 0; t < TASKS * TRIES && made < TASKS; t++) {
      packing_contact_task task;
      packing_vec3 a[2], b[2];
      const int walls = 1 + (t % 4 == 0 && packing_domain_dim(domain) == 3);
      if (!make(&random, domain, walls, &task))
        continue;
      made++;
      const int count = packing_contact_place(packing_contact_binary(), &task, a);
      assert_int_equal(packing_contact_place(packing_contact_direct(), &task, b), count);
      places += count;
      for (int i = 0; i < count; i++) {
        assert_near(touching_apart(a[i], b[i]), 0.0, 3e-12);
        double nearest = HUGE_VAL;
        for (int k = 0; k < task.dim; k++) {
          assert_true(touching_gap(&task, a[i], k) >= 0);
          nearest = fmin(nearest, touching_gap(&task, a[i], k));
        }
        assert_true(nearest <= 2e-12);
      }
    }
    /* In the narrow ends of cones and silos no line may be found. */
    assert_true(places >= 0.9 * 2 * TASKS);
    packing_domain_destroy(domain);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exact_methods),
      cmocka_unit_test(approximate_methods),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
