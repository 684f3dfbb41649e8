/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles that touch three bodies, as curves in their radius: tangency, where a curve begins, and
 * what bounds it, against bisection and Soddy's spheres. */
#include "test.h"

#include "place/front_curve.h"

typedef struct triple {
  double sphere_r;
  packing_i_front_body body[2];
  packing_vec3 p[2]; /* centre of a sphere, normal of a wall */
  double r[2];       /* of a sphere; distance of a wall */
  int kind[2];       /* 0 sphere, 1 wall, 2 plane of discs */
} triple;

static packing_rng *rng;

static double between(double a, double b)
{
  return a + (b - a) * packing_rng_uniform(rng);
}

static packing_vec3 unit(void)
{
  for (;;) {
    const packing_vec3 v = packing_i_vec(between(-1, 1), between(-1, 1), between(-1, 1));
    const double n = packing_i_norm(v);
    if (n > 0.1 && n < 1)
      return packing_i_scale(v, 1 / n);
  }
}

/* Radii over `decades` decades, bodies that a particle of the mean radius may touch. */
static triple random_triple(double decades)
{
  triple t;
  t.sphere_r = pow(10, -decades * packing_rng_uniform(rng));
  for (int k = 0; k < 2; k++) {
    t.kind[k] = (int)(3.999 * packing_rng_uniform(rng)) - 1;
    if (t.kind[k] < 0)
      t.kind[k] = 0;
    if (t.kind[k] == 2 && (k == 0 || t.kind[0] == 2))
      t.kind[k] = 0;
    t.p[k] = unit();
    if (t.kind[k] == 0) {
      t.r[k] = pow(10, -decades * packing_rng_uniform(rng));
      t.p[k] = packing_i_scale(t.p[k], (t.sphere_r + t.r[k]) * between(1, 1.8));
      t.body[k] = packing_i_front_sphere(t.p[k], t.r[k], t.sphere_r);
    } else if (t.kind[k] == 1) {
      t.r[k] = t.sphere_r * between(1, 2);
      t.body[k] = packing_i_front_wall(t.p[k], t.r[k]);
    } else {
      t.body[k] = packing_i_front_plane();
    }
  }
  return t;
}

static packing_vec3 cross(packing_vec3 a, packing_vec3 b)
{
  return packing_i_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                       a.x * b.y - a.y * b.x);
}

/* How far a particle is from touching all three, in units of its radius. */
static double miss(const triple *t, packing_vec3 c, double r)
{
  double most = fabs(packing_i_norm(c) - t->sphere_r - r);
  for (int k = 0; k < 2; k++) {
    double gap = c.z;
    if (t->kind[k] == 0)
      gap = packing_i_norm(packing_i_sub(c, t->p[k])) - t->r[k] - r;
    if (t->kind[k] == 1)
      gap = packing_i_dot(c, t->p[k]) + t->r[k] - r;
    most = fmax(most, fabs(gap));
  }
  return most / r;
}

/* The sine of the angle at which the three constraints meet, at its least. */
static double sharpness(const triple *t, packing_vec3 c)
{
  packing_vec3 a = packing_i_scale(c, 1 / packing_i_norm(c));
  packing_vec3 n[2];
  for (int k = 0; k < 2; k++)
    n[k] = packing_i_scale(t->body[k].p, 1 / packing_i_norm(t->body[k].p));
  const packing_vec3 jk = cross(n[0], n[1]);
  return fabs(packing_i_dot(a, jk));
}

/* On the curve the particle touches to 1e-9 of its radius for sizes within 1:1000 and constraints
 * that meet at more than a grazing angle; polished, to a few roundings. */
static void particles_touch_all_three(void **state)
{
  (void)state;
  size_t seen = 0;
  for (int n = 0; n < 200000; n++) {
    const triple t = random_triple(n % 2 ? 0.3 : 3);
    packing_i_front_curve curve;
    packing_vec3 c;
    const int side = n % 4 < 2 ? 1 : -1;
    if (!packing_i_front_curve_init(t.sphere_r, &t.body[0], &t.body[1], side, &curve))
      continue;
    const double r = pow(10, -(n % 2 ? 0.3 : 3) * packing_rng_uniform(rng));
    if (!packing_i_front_curve_at(&curve, r, &c) || sharpness(&t, c) < 0.1)
      continue;
    seen++;
    const double scale =
        (t.sphere_r + fmax(t.kind[0] == 2 ? 0 : t.r[0], t.kind[1] == 2 ? 0 : t.r[1]) +
         r) /
        r;
    assert_true(miss(&t, c, r) <= 1e-9 * scale);
    c = packing_i_front_polish(t.sphere_r, &t.body[0], &t.body[1], r, c);
    assert_true(miss(&t, c, r) <= 1e-14 * scale * scale);
    /* The side is the one asked for. */
    assert_true(packing_i_dot(c, curve.side) >= -1e-9 * scale * r);
    const packing_vec3 axis = cross(t.body[0].p, t.body[1].p);
    assert_true(side * packing_i_dot(curve.side, axis) > 0);
  }
  assert_true(seen > 20000);
}

/* The first radius with a solution, by stepping and 200 bisections of s^2. */
static void a_curve_begins_where_its_square_turns_positive(void **state)
{
  (void)state;
  size_t later = 0, never = 0;
  for (int n = 0; n < 100000; n++) {
    const triple t = random_triple(1);
    packing_i_front_curve curve;
    if (!packing_i_front_curve_init(t.sphere_r, &t.body[0], &t.body[1], 1, &curve))
      continue;
    const double r = 0.05;
    const double start = packing_i_front_curve_start(&curve, r);
    packing_vec3 c;
    if (packing_i_front_curve_at(&curve, r, &c)) {
      assert_true(start == r);
      continue;
    }
    if (!(start < HUGE_VAL)) {
      never++;
      for (double x = r; x < 50; x *= 1.05)
        assert_false(packing_i_front_curve_at(&curve, x, &c));
      continue;
    }
    later++;
    assert_true(packing_i_front_curve_at(&curve, start, &c));
    for (int k = 1; k < 40; k++) /* none before */
      assert_false(
          packing_i_front_curve_at(&curve, r + (start * (1 - 1e-9) - r) * k / 40, &c));
    double lo = r, hi = start * (1 + 1e-6);
    if (!packing_i_front_curve_at(&curve, hi, &c))
      continue; /* a touch in one point */
    for (int k = 0; k < 200; k++) {
      const double mid = 0.5 * (lo + hi);
      if (packing_i_front_curve_at(&curve, mid, &c))
        hi = mid;
      else
        lo = mid;
    }
    assert_close(start, hi, 1e-7);
  }
  assert_true(later > 500 && never > 500);
}

static double room_at(const packing_i_front_curve *curve,
                      const packing_i_front_body *body, double r)
{
  packing_vec3 c;
  return packing_i_front_curve_at(curve, r, &c) ? packing_i_front_room(body, c, r)
                                                : (double)NAN;
}

/* The radii at which a fourth body is met are the sign changes of the room, found by bisection. */
static void bounds_are_the_roots_of_the_room(void **state)
{
  (void)state;
  size_t met = 0, twice = 0;
  for (int n = 0; n < 100000; n++) {
    const triple t = random_triple(0.7);
    const triple other = random_triple(0.7);
    packing_i_front_body body = other.body[0];
    if (other.kind[0] == 0)
      body = packing_i_front_sphere(other.p[0], other.r[0], t.sphere_r);
    packing_i_front_curve curve;
    if (!packing_i_front_curve_init(t.sphere_r, &t.body[0], &t.body[1], 1, &curve))
      continue;
    double r = packing_i_front_curve_start(&curve, 0.1);
    if (!(r < 2))
      continue;
    r *= 1.001;
    const double here = room_at(&curve, &body, r);
    if (isnan(here))
      continue;
    const packing_i_front_bound bound = packing_i_front_curve_bound(&curve, &body, r);
    assert_near(bound.room, here, 1e-9 * (1 + fabs(here)));
    assert_true(bound.first <= bound.second || bound.first == HUGE_VAL);
    double last = r, before = here, root[2] = {HUGE_VAL, HUGE_VAL};
    int found = 0;
    for (double x = r * 1.004; x < 8 && found < 2; last = x, x *= 1.004) {
      const double now = room_at(&curve, &body, x);
      if (isnan(now))
        break;
      if ((now < 0) != (before < 0)) {
        double lo = last, hi = x;
        for (int k = 0; k < 200; k++) {
          const double mid = 0.5 * (lo + hi);
          if ((room_at(&curve, &body, mid) < 0) == (before < 0))
            lo = mid;
          else
            hi = mid;
        }
        root[found++] = hi;
      }
      before = now;
    }
    if (found == 0)
      continue;
    met++;
    twice += found == 2;
    /* Two roots within a step of the search are not seen by it. */
    if (bound.second / bound.first < 1.01)
      continue;
    assert_close(bound.first, root[0], 1e-6);
    if (found == 2)
      assert_close(bound.second, root[1], 1e-6);
  }
  assert_true(met > 5000 && twice > 20);
}

/* Four spheres that touch one another: the fifth between three and the fourth is Soddy's,
 * k = k1 + k2 + k3 + k4 over 2 + ..., from Descartes' theorem: (sum k)^2 = 3 sum k^2. */
static void soddy(void **state)
{
  (void)state;
  for (int n = 0; n < 20000; n++) {
    double r[4];
    for (int k = 0; k < 4; k++)
      r[k] = between(0.5, 1.2);
    const packing_vec3 one = packing_i_scale(unit(), r[0] + r[1]);
    packing_i_front_body j = packing_i_front_sphere(one, r[1], r[0]), plane;
    packing_vec3 across = unit();
    plane.p = across;
    plane.a = plane.b = 0;
    packing_i_front_curve curve;
    packing_vec3 two, three;
    if (!packing_i_front_curve_init(r[0], &j, &plane, 1, &curve) ||
        !packing_i_front_curve_at(&curve, r[2], &two))
      continue;
    two = packing_i_front_polish(r[0], &j, &plane, r[2], two);
    const packing_i_front_body k = packing_i_front_sphere(two, r[2], r[0]);
    assert_true(packing_i_front_curve_init(r[0], &j, &k, 1, &curve));
    if (!packing_i_front_curve_at(&curve, r[3], &three))
      continue;
    three = packing_i_front_polish(r[0], &j, &k, r[3], three);
    const packing_i_front_body fourth = packing_i_front_sphere(three, r[3], r[0]);
    double sum = 0, squares = 0;
    for (int m = 0; m < 4; m++) {
      sum += 1 / r[m];
      squares += 1 / (r[m] * r[m]);
    }
    /* (sum + k)^2 = 3 (squares + k^2): the larger root lies in the hole. */
    const double root = sqrt(fmax(0, 3 * (sum * sum - 2 * squares)));
    const double inner = 1 / (0.5 * (sum + root));
    const double start = packing_i_front_curve_start(&curve, 1e-3);
    assert_true(start < inner);
    const packing_i_front_bound bound =
        packing_i_front_curve_bound(&curve, &fourth, start * (1 + 1e-9));
    assert_close(bound.first, inner, 1e-9);
  }
}

/* Parallel bodies have no curve; what is wrong gives 0, not rubbish. */
static void parallel_bodies_have_none(void **state)
{
  (void)state;
  for (int n = 0; n < 1000; n++) {
    packing_i_front_curve curve;
    const packing_vec3 d = unit();
    const packing_i_front_body j = packing_i_front_sphere(packing_i_scale(d, 2.1), 1, 1);
    const double other[] = {2.5, -2.2, 4.1};
    for (int k = 0; k < 3; k++) {
      const packing_i_front_body p =
          packing_i_front_sphere(packing_i_scale(d, other[k]), 1, 1);
      assert_false(packing_i_front_curve_init(1, &j, &p, 1, &curve));
    }
    const packing_i_front_body w = packing_i_front_wall(d, 1.3);
    assert_false(packing_i_front_curve_init(1, &j, &w, 1, &curve));
    assert_false(packing_i_front_curve_init(1, &j, &j, -1, &curve));
  }
}

static int begin(void **state)
{
  (void)state;
  return packing_rng_create(NULL, 11, PACKING_PURPOSE_USER, 0, &rng) != PACKING_OK;
}

static int end(void **state)
{
  (void)state;
  packing_rng_destroy(rng);
  return 0;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(particles_touch_all_three),
      cmocka_unit_test(a_curve_begins_where_its_square_turns_positive),
      cmocka_unit_test(bounds_are_the_roots_of_the_room),
      cmocka_unit_test(soddy),
      cmocka_unit_test(parallel_bodies_have_none),
  };
  return cmocka_run_group_tests(tests, begin, end);
}
