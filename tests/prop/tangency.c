/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random tasks for the four contact methods: discs, spheres, clusters, sizes up to
 * 1:1000. Each is held against another way to the same answer. */
#include "touching.h"

static const char *const names[] = {"wrappers", "potential", "binary", "direct"};

static int place(int method, const packing_contact_task *task, packing_vec3 centre[2])
{
  const int count =
      packing_contact_place(packing_contact_method_named(names[method]), task, centre);
  assert_in_range(count, 0, 2);
  return count;
}

static packing_vec3 along(packing_vec3 a, double t, packing_vec3 v)
{
  const packing_vec3 p = {a.x + t * v.x, a.y + t * v.y, a.z + t * v.z};
  return p;
}

static double dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  const packing_vec3 c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                          a.x * b.y - a.y * b.x};
  return c;
}

static packing_vec3 unit(packing_vec3 a)
{
  const packing_vec3 zero = {0, 0, 0};
  return along(zero, 1 / sqrt(dot(a, a)), a);
}

/* The circle of the places that touch all bodies but the last. */
typedef struct ring {
  packing_vec3 centre, u, v;
  double r;
} ring;

/* Returns 0 where no place touches both of the first two spheres. */
static int ring_of(const packing_contact_task *task, ring *c)
{
  const packing_vec3 x = {1, 0, 0}, y = {0, 1, 0};
  c->centre = task->fixed[0].centre;
  c->r = task->fixed[0].r + task->mobile.r;
  c->u = x;
  c->v = y;
  if (task->dim == 2)
    return 1;
  const packing_vec3 w = along(task->fixed[1].centre, -1, c->centre);
  const double d = sqrt(dot(w, w)), other = task->fixed[1].r + task->mobile.r;
  const double h = (d * d + c->r * c->r - other * other) / (2 * d);
  if (!(c->r > fabs(h)))
    return 0;
  const packing_vec3 n = unit(w);
  c->centre = along(c->centre, h, n);
  c->r = sqrt(c->r * c->r - h * h);
  c->u = unit(cross(n, fabs(n.x) < 0.5 ? x : y));
  c->v = cross(n, c->u);
  return 1;
}

static packing_vec3 on_ring(const ring *c, double angle)
{
  return along(along(c->centre, c->r * cos(angle), c->u), c->r * sin(angle), c->v);
}

/* Signs of the last gap around the ring, each change halved 60 times. Returns how many
 * there are; `clear`: how near to 0 the gap comes without changing its sign. */
static int oracle(const packing_contact_task *task, packing_vec3 place_at[2],
                  double *clear)
{
  enum { STEPS = 1440 };
  ring c;
  int count = 0;
  *clear = HUGE_VAL;
  if (!ring_of(task, &c))
    return 0;
  const int last = task->dim - 1;
  double before = touching_gap(task, on_ring(&c, 0), last), lowest = before,
         highest = before;
  for (int i = 1; i <= STEPS; i++) {
    double lo = 2 * TEST_PI * (i - 1) / STEPS, hi = 2 * TEST_PI * i / STEPS;
    const double now = touching_gap(task, on_ring(&c, hi), last);
    lowest = fmin(lowest, now);
    highest = fmax(highest, now);
    if ((before > 0) != (now > 0)) {
      for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (lo + hi);
        if ((touching_gap(task, on_ring(&c, middle), last) > 0) == (before > 0))
          lo = middle;
        else
          hi = middle;
      }
      assert_true(count < 2);
      place_at[count++] = on_ring(&c, lo);
    }
    before = now;
  }
  *clear = fmin(fabs(lowest), fabs(highest));
  return count;
}

/* Wrappers, potential and the oracle have the same places. */
static void exact_methods_agree(void **state)
{
  (void)state;
  uint64_t random = 21;
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < 1500; i++) {
    packing_contact_task task =
        touching_random(&random, 2 + i % 2, 3, i % 4 == 0 ? 3 : 0.9);
    packing_vec3 a[2], b[2], c[2];
    double clear;
    const int known = oracle(&task, c, &clear);
    if (clear < 1e-3)
      continue;
    const int count = place(0, &task, a);
    assert_int_equal(count, known);
    assert_int_equal(place(1, &task, b), known);
    counts[count]++;
    for (int k = 0; k < count; k++) {
      assert_near(touching_worst(&task, a[k]), 0.0, 1e-15 * touching_extent(&task));
      assert_near(touching_worst(&task, b[k]), 0.0, 1e-12 * task.mobile.r);
      assert_near(touching_apart(a[k], b[k]), 0.0, 1e-9);
      assert_near(fmin(touching_apart(a[k], c[0]), touching_apart(a[k], c[1])), 0.0,
                  1e-9);
    }
  }
  assert_true(counts[0] > 300 && counts[1] == 0 && counts[2] > 700);
}

/* Sizes from 1 to 1000: rounding is that of the largest. */
static void sizes_far_apart(void **state)
{
  (void)state;
  uint64_t random = 22;
  int found = 0;
  for (int i = 0; i < 3000; i++) {
    packing_contact_task task = touching_random(&random, 2 + i % 2, 1000, 0.4);
    packing_vec3 a[2], b[2];
    const int count = place(0, &task, a);
    const double limit = 4 * 2.2e-16 * touching_extent(&task);
    for (int k = 0; k < count; k++)
      assert_near(touching_worst(&task, a[k]), 0.0, limit);
    /* Where two places all but meet the potential may take them for
     * one, or none for one. */
    if (count == 2 && touching_apart(a[0], a[1]) < 1e-2 * task.mobile.r)
      continue;
    found += count;
    const int other = place(1, &task, b);
    if (count > 0)
      assert_int_equal(other, count);
    for (int k = 0; k < other; k++) {
      assert_near(touching_worst(&task, b[k]), 0.0,
                  fmax(1e-12 * task.mobile.r, 2 * limit));
      if (count > 0)
        assert_near(touching_apart(a[k], b[k]), 0.0, 1e-6 * task.mobile.r);
    }
  }
  assert_true(found > 2000);
}

/* F8's closed form: t* = max of s_i / (2 R), s_i^2 = (r + r_i)^2 - |c_m - c_i|^2. */
static int approach(const packing_contact_task *task, packing_vec3 *mean, double *s)
{
  const packing_vec3 zero = {0, 0, 0};
  *mean = zero;
  *s = -1;
  for (int i = 0; i < task->dim; i++)
    *mean = along(*mean, 1.0 / task->dim, task->fixed[i].centre);
  for (int i = 0; i < task->dim; i++) {
    const double d = touching_apart(*mean, task->fixed[i].centre);
    const double reach = task->mobile.r + task->fixed[i].r;
    if (reach > d)
      *s = fmax(*s, sqrt((reach - d) * (reach + d)));
  }
  return *s > 0 ? 2 : 0;
}

static void approximate_methods_agree(void **state)
{
  (void)state;
  uint64_t random = 23;
  int none = 0;
  for (int i = 0; i < 4000; i++) {
    const double ratio = i % 3 == 0 ? 1000 : 2, loose = i % 5 == 0 ? 3 : 0.4;
    packing_contact_task task = touching_random(&random, 2 + i % 2, ratio, loose);
    packing_vec3 a[2], b[2], mean;
    double s;
    const int count = approach(&task, &mean, &s);
    assert_int_equal(place(2, &task, a), count);
    assert_int_equal(place(3, &task, b), count);
    none += count == 0;
    const double limit =
        1e-12 * task.mobile.r +
        1e-15 * touching_extent(&task) * (1 + touching_extent(&task) / (count ? s : 1));
    for (int k = 0; k < count; k++) {
      assert_near(touching_apart(a[k], mean), s, limit);
      assert_near(touching_apart(a[k], b[k]), 0.0, limit);
      for (int j = 0; j < task.dim; j++)
        assert_int_equal(
            packing_body_overlap(
                &(packing_body){.centre = a[k], .r = task.mobile.r, .wall = -1},
                &task.fixed[j]),
            0);
    }
    if (count == 2)
      assert_true(dot(along(a[0], -1, mean), along(a[1], -1, mean)) < 0);
  }
  assert_true(none > 20);
}

/* A task whose mobile body and whose fixed ones are clusters, or some of them. */
static packing_contact_task cluster_task(uint64_t *random, int dim,
                                         const packing_shape *shape)
{
  packing_contact_task task = touching_random(random, dim, 2, 0.2);
  for (int i = -1; i < dim; i++) {
    packing_body *body = i < 0 ? &task.mobile : &task.fixed[i];
    if (i >= 0 && scene_random(random) < 0.3)
      continue;
    const double half = 3 * scene_random(random);
    body->shape = shape;
    body->orientation[0] = cos(half);
    body->orientation[3] = dim == 3 ? 0.6 * sin(half) : sin(half);
    body->orientation[2] = dim == 3 ? 0.8 * sin(half) : 0;
  }
  return task;
}

/* Three methods on the test shape: never more than two places, all in contact, none
 * overlapping; the bisection ends where the ray cast does. */
static void clusters(void **state)
{
  (void)state;
  uint64_t random = 24;
  packing_shape *shape = test_cluster(0.65, 1), *plain = test_cluster(0.65, 0);
  int exact = 0, approximate = 0;
  for (int i = 0; i < 400; i++) {
    packing_contact_task task = cluster_task(&random, 2 + i % 2, shape);
    packing_vec3 a[2], b[2];
    assert_int_equal(place(0, &task, a), 0);
    int count = place(1, &task, a);
    exact += count;
    for (int k = 0; k < count; k++)
      assert_near(touching_worst(&task, a[k]), 0.0, 1e-12 * task.mobile.r);
    count = place(2, &task, a);
    approximate += count;
    for (int k = 0; k < count; k++) {
      const double least = touching_least(&task, a[k]);
      assert_true(least >= 0 && least <= 2e-12 * task.mobile.r);
    }
    /* The ray may find a contact that the steps of the bisection pass by. */
    const int cast = place(3, &task, b);
    for (int k = 0; k < cast; k++)
      assert_near(touching_least(&task, b[k]), 0.0, 1e-14 * touching_extent(&task));
    for (int k = 0; k < cast && cast == count; k++)
      assert_near(touching_apart(a[k], b[k]), 0.0, 2e-12);
    if (i < 100) {
      for (int k = -1; k < task.dim; k++) {
        packing_body *body = k < 0 ? &task.mobile : &task.fixed[k];
        body->shape = body->shape == NULL ? NULL : plain;
      }
      assert_int_equal(place(3, &task, a), cast);
      for (int k = 0; k < cast; k++)
        assert_near(touching_apart(a[k], b[k]), 0.0, 1e-12);
    }
  }
  assert_true(exact > 250 && approximate > 600);
  packing_shape_destroy(shape);
  packing_shape_destroy(plain);
}

static packing_body scaled(packing_body body, double by, const packing_domain *domain)
{
  body.centre.x *= by;
  body.centre.y *= by;
  body.centre.z *= by;
  body.r *= by;
  if (body.domain != NULL)
    body.domain = domain;
  return body;
}

/* Lengths times a power of two: every bit of the places stays. */
static void power_of_two(void **state)
{
  (void)state;
  static const double by[] = {0x1p-60, 0x1p-7, 0x1p33};
  uint64_t random = 25;
  packing_shape *shape = test_cluster(0.65, 1);
  const scene s = {.kind = SCENE_CYLINDER, .a = 5, .b = 9, .at = {-2, -1, -3}, .axis = 2};
  packing_domain *domain = scene_make(&s);
  for (int i = 0; i < 600; i++) {
    packing_contact_task task = i % 3 == 2 ? cluster_task(&random, 2 + i % 2, shape)
                                           : touching_random(&random, 2 + i % 2, 3, 0.5);
    if (task.dim == 3 && i % 3 == 1)
      task.fixed[i % 9 / 3] = touching_wall(domain, i % 2);
    const scene t = scene_scaled(s, by[i % 7 % 3]);
    packing_domain *other = scene_make(&t);
    packing_contact_task grown = task;
    grown.mobile = scaled(task.mobile, by[i % 7 % 3], other);
    for (int k = 0; k < task.dim; k++)
      grown.fixed[k] = scaled(task.fixed[k], by[i % 7 % 3], other);
    for (int m = 0; m < 4; m++) {
      packing_vec3 a[2], b[2];
      const int count = place(m, &task, a);
      assert_int_equal(place(m, &grown, b), count);
      for (int k = 0; k < count; k++) {
        const packing_body want =
            scaled(packing_body_sphere(a[k], 1), by[i % 7 % 3], NULL);
        assert_memory_equal(&want.centre, &b[k], sizeof b[k]);
      }
    }
    packing_domain_destroy(other);
  }
  packing_domain_destroy(domain);
  packing_shape_destroy(shape);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exact_methods_agree),
      cmocka_unit_test(sizes_far_apart),
      cmocka_unit_test(approximate_methods_agree),
      cmocka_unit_test(clusters),
      cmocka_unit_test(power_of_two),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
