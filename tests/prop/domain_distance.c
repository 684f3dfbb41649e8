/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Signed distances and insets of every built-in kind: against dense samples of the walls, by
 * their gradients, and against containers that are smaller by hand. */
#include "domain_scenes.h"

static const scene more[] = {
    {SCENE_BOX, 1.3, 0.9, 1.7, 0, {0.2, -0.4, 0.1}, 2, 1, 1},
    {SCENE_BOX, 1.3, 0.9, 1.7, 0, {0.2, -0.4, 0.1}, 2, 0, 6},
    {SCENE_RECTANGLE, 1.3, 0.9, 0, 0, {0.2, -0.4, 0}, 1, 1, 1},
    {SCENE_CYLINDER, 0.83, 1.7, 0, 0, {0.2, -0.4, 0.1}, 0, 1, 0},
    {SCENE_TUBE, 0.41, 0.87, 1.2, 0, {0.2, -0.4, 0.1}, 1, 1, 0},
    {SCENE_CONE, 1.1, 0, 0.8, 0, {0.2, -0.4, 0.1}, 1, 0, 0},
    {SCENE_CONE, 1.1, 0.4, 0.8, 0, {0.2, -0.4, 0.1}, 1, 1, 0},
    {SCENE_CONE, 0, 1.1, 0.3, 0, {0.2, -0.4, 0.1}, 0, 1, 0},
    {SCENE_CONE, 0.7, 0.7, 1.1, 0, {0.2, -0.4, 0.1}, 2, 0, 0},
    {SCENE_SILO, 0.93, 2.1, 0, 1.9, {0.2, -0.4, 0.1}, 0, 1, 0},
    {SCENE_SILO, 0.93, 2.1, 0.9, 0.01, {0.2, -0.4, 0.1}, 1, 0, 0},
};

enum { MORE = sizeof more / sizeof *more, SCENES = SCENE_END + MORE };

static scene nth_scene(int i)
{
  return i < SCENE_END ? scene_of((enum scene_kind)i) : more[i - SCENE_END];
}

static double distance(const packing_domain *domain, packing_vec3 p)
{
  return packing_domain_signed_distance(domain, &p, NULL);
}

static double apart(packing_vec3 a, packing_vec3 b)
{
  return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
              (a.z - b.z) * (a.z - b.z));
}

/* A profile of straight walls, from corner to corner. */
typedef struct profile {
  int count;
  double rho[6], h[6];
} profile;

static void corner(profile *p, double rho, double h)
{
  p->rho[p->count] = rho;
  p->h[p->count++] = h;
}

/* The side of a cone with an open top goes on for a while, but not across the axis. */
static void slanted_top(profile *p, double rho, double h, double slope, double more_h)
{
  if (slope < 0 && more_h > -rho / slope)
    more_h = -rho / slope;
  corner(p, rho + slope * more_h, h + more_h);
}

static profile profile_of(const scene *s)
{
  profile p = {0};
  if (s->kind == SCENE_CYLINDER) {
    corner(&p, 0, 0);
    corner(&p, s->a, 0);
    corner(&p, s->a, s->open ? s->b + 3 : s->b);
  } else if (s->kind == SCENE_TUBE) {
    corner(&p, s->a, s->open ? s->c + 3 : s->c);
    corner(&p, s->a, 0);
    corner(&p, s->b, 0);
    corner(&p, s->b, s->open ? s->c + 3 : s->c);
    if (!s->open)
      corner(&p, s->a, s->c);
    return p;
  } else if (s->kind == SCENE_CONE) {
    corner(&p, 0, 0);
    corner(&p, s->a, 0);
    slanted_top(&p, s->b, s->c, (s->b - s->a) / s->c, s->open ? 3 : 0);
  } else {
    corner(&p, 0, 0);
    corner(&p, s->c, 0);
    corner(&p, s->a, s->d);
    corner(&p, s->a, s->open ? s->b + 3 : s->b);
  }
  if (!s->open)
    corner(&p, 0, p.h[p.count - 1]);
  return p;
}

/* The least distance to samples of the walls no farther than `spacing` from each other. */
static double nearest_sample(const scene *s, packing_vec3 q, double spacing)
{
  double nearest = HUGE_VAL;
  if (s->kind == SCENE_SPHERE || s->kind == SCENE_CIRCLE || s->kind == SCENE_ANNULUS) {
    const double radii[] = {s->a, s->b};
    for (int k = 0; k < (s->kind == SCENE_ANNULUS ? 2 : 1); k++) {
      const double r = radii[k];
      const int rings = s->kind == SCENE_SPHERE ? (int)(TEST_PI * r / spacing) + 1 : 0;
      for (int i = 0; i <= rings; i++) {
        const double polar = rings == 0 ? TEST_PI / 2 : TEST_PI * i / rings;
        const int steps = (int)(2 * TEST_PI * r * sin(polar) / spacing) + 1;
        for (int j = 0; j < steps; j++) {
          const double f = 2 * TEST_PI * j / steps;
          const packing_vec3 w = {s->at.x + r * sin(polar) * cos(f),
                                  s->at.y + r * sin(polar) * sin(f),
                                  s->at.z + r * cos(polar)};
          nearest = fmin(nearest, apart(w, q));
        }
      }
    }
    return nearest;
  }
  if (s->kind == SCENE_BOX || s->kind == SCENE_RECTANGLE) {
    const int dim = scene_dim(s);
    const double size[] = {s->a, s->b, s->c}, at[] = {s->at.x, s->at.y, s->at.z};
    for (int k = 0; k < dim; k++)
      for (int side = 0; side < 2; side++) {
        if (s->periodic >> k & 1 || (side == 1 && s->open && k == dim - 1))
          continue;
        const int u = (k + 1) % dim, v = (k + 2) % dim;
        const double from_u = s->periodic >> u & 1 ? -3 : 0;
        const double to_u =
            s->periodic >> u & 1 || (s->open && u == dim - 1) ? size[u] + 3 : size[u];
        const double from_v = s->periodic >> v & 1 ? -3 : 0;
        const double to_v =
            s->periodic >> v & 1 || (s->open && v == dim - 1) ? size[v] + 3 : size[v];
        const int nu = (int)((to_u - from_u) / spacing) + 1;
        const int nv = dim == 2 ? 0 : (int)((to_v - from_v) / spacing) + 1;
        for (int i = 0; i <= nu; i++)
          for (int j = 0; j <= nv; j++) {
            double w[3] = {s->at.x, s->at.y, s->at.z};
            w[k] = at[k] + side * size[k];
            w[u] = at[u] + from_u + (to_u - from_u) * i / nu;
            if (dim == 3)
              w[v] = at[v] + from_v + (to_v - from_v) * j / nv;
            nearest = fmin(nearest, apart((packing_vec3){w[0], w[1], w[2]}, q));
          }
      }
    return nearest;
  }
  const profile p = profile_of(s);
  for (int c = 0; c + 1 < p.count; c++) {
    const double length = hypot(p.rho[c + 1] - p.rho[c], p.h[c + 1] - p.h[c]);
    const int n = (int)(length / spacing) + 1;
    for (int i = 0; i <= n; i++) {
      const double rho = p.rho[c] + (p.rho[c + 1] - p.rho[c]) * i / n;
      const double h = p.h[c] + (p.h[c + 1] - p.h[c]) * i / n;
      const int steps = (int)(2 * TEST_PI * rho / spacing) + 1;
      for (int j = 0; j < steps; j++) {
        const double f = 2 * TEST_PI * j / steps;
        const packing_vec3 w =
            scene_point(s->axis, h + scene_coordinate(s->at, s->axis),
                        rho * cos(f) + scene_coordinate(s->at, (s->axis + 1) % 3),
                        rho * sin(f) + scene_coordinate(s->at, (s->axis + 2) % 3));
        nearest = fmin(nearest, apart(w, q));
      }
    }
  }
  return nearest;
}

static void distances_agree_with_samples_of_the_walls(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    const double spacing = scene_dim(&s) == 2 ? 0.001 : 0.02;
    packing_domain *domain = scene_make(&s);
    uint64_t random = 17 + (uint64_t)i;
    for (int k = 0; k < 20; k++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.3);
      const double sampled = nearest_sample(&s, p, spacing);
      const double d = fabs(distance(domain, p));
      assert_true(d <= sampled * (1 + 1e-12));
      assert_true(sampled <= d + spacing);
    }
    packing_domain_destroy(domain);
  }
}

/* Where the region is, from the plain description of it. */
static void signs_say_inside(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    packing_domain *domain = scene_make(&s);
    packing_bounds b;
    packing_domain_bounds(domain, &b);
    uint64_t random = 23 + (uint64_t)i;
    int inside = 0;
    for (int k = 0; k < 2000; k++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.2);
      int in = distance(domain, p) > 0;
      if (s.open)
        in = in && scene_coordinate(p, s.axis) < scene_coordinate(b.hi, s.axis);
      assert_int_equal(in, scene_inside(&s, p));
      inside += in;
    }
    assert_in_range(inside, 100, 2000);
    packing_domain_destroy(domain);
  }
}

/* One step along the normal ends on a wall; the normal is a unit vector, the slope 1. */
static void normals_lead_to_the_wall(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    packing_domain *domain = scene_make(&s);
    uint64_t random = 29 + (uint64_t)i;
    for (int k = 0; k < 1000; k++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.5);
      packing_vec3 n;
      const double d = packing_domain_signed_distance(domain, &p, &n);
      assert_near(n.x * n.x + n.y * n.y + n.z * n.z, 1, 1e-14);
      const packing_vec3 wall = {p.x - d * n.x, p.y - d * n.y, p.z - d * n.z};
      assert_near(distance(domain, wall), 0, 1e-14);
      const packing_vec3 on = {p.x - 0.5 * d * n.x, p.y - 0.5 * d * n.y,
                               p.z - 0.5 * d * n.z};
      assert_near(distance(domain, on), 0.5 * d, 1e-14);
    }
    packing_domain_destroy(domain);
  }
}

static void normals_are_gradients(void **state)
{
  (void)state;
  const double step = 1e-5;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    packing_domain *domain = scene_make(&s);
    uint64_t random = 31 + (uint64_t)i;
    int checked = 0;
    for (int k = 0; k < 500; k++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.5);
      packing_vec3 n;
      const double d = packing_domain_signed_distance(domain, &p, &n);
      for (int axis = 0; axis < scene_dim(&s); axis++) {
        packing_vec3 ahead = p, behind = p;
        *(axis == 0 ? &ahead.x : axis == 1 ? &ahead.y : &ahead.z) += step;
        *(axis == 0 ? &behind.x : axis == 1 ? &behind.y : &behind.z) -= step;
        const double da = distance(domain, ahead), db = distance(domain, behind);
        if (fabs(da + db - 2 * d) > 1e-8)
          continue; /* two walls equally near */
        assert_near((da - db) / (2 * step), scene_coordinate(n, axis), 2e-4);
        checked++;
      }
    }
    assert_in_range(checked, 700, 1500);
    packing_domain_destroy(domain);
  }
}

static void distances_change_no_faster_than_points(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    packing_domain *domain = scene_make(&s);
    uint64_t random = 37 + (uint64_t)i;
    for (int k = 0; k < 3000; k++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.5);
      const packing_vec3 q = scene_random_point(&random, domain, 0.5);
      assert_true(fabs(distance(domain, p) - distance(domain, q)) <=
                  apart(p, q) * (1 + 1e-13));
    }
    packing_domain_destroy(domain);
  }
}

static void holds_is_a_distance_of_r(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    packing_domain *domain = scene_make(&s);
    uint64_t random = 41 + (uint64_t)i;
    for (int k = 0; k < 2000; k++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.2);
      const double d = distance(domain, p);
      const double r = 0.4 * scene_random(&random);
      assert_int_equal(packing_domain_holds(domain, &p, r), d >= r);
      if (d > 0) {
        assert_int_equal(packing_domain_holds(domain, &p, d), 1);
        assert_int_equal(packing_domain_holds(domain, &p, nextafter(d, 9)), 0);
      }
    }
    packing_domain_destroy(domain);
  }
}

/* Volume and bounds against a count of cells. */
static void volumes_and_bounds_agree_with_counts(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    packing_domain *domain = scene_make(&s);
    const int n = scene_dim(&s) == 2 ? 1500 : 120, m = scene_dim(&s) == 2 ? 1 : n;
    packing_bounds b,
        seen = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    packing_domain_bounds(domain, &b);
    const packing_vec3 size = {b.hi.x - b.lo.x, b.hi.y - b.lo.y, b.hi.z - b.lo.z};
    size_t inside = 0;
    for (int x = 0; x < n; x++)
      for (int y = 0; y < n; y++)
        for (int z = 0; z < m; z++) {
          /* A tenth more than the bounds: nothing of the region may be there. */
          const packing_vec3 p = {b.lo.x + size.x * (1.2 * (x + 0.5) / n - 0.1),
                                  b.lo.y + size.y * (1.2 * (y + 0.5) / n - 0.1),
                                  b.lo.z + size.z * (1.2 * (z + 0.5) / m - 0.1)};
          if ((s.periodic & 1 && (p.x < b.lo.x || p.x > b.hi.x)) ||
              (s.periodic & 2 && (p.y < b.lo.y || p.y > b.hi.y)) ||
              (s.periodic & 4 && (p.z < b.lo.z || p.z > b.hi.z)) || !scene_inside(&s, p))
            continue;
          inside++;
          seen.lo.x = fmin(seen.lo.x, p.x);
          seen.lo.y = fmin(seen.lo.y, p.y);
          seen.lo.z = fmin(seen.lo.z, p.z);
          seen.hi.x = fmax(seen.hi.x, p.x);
          seen.hi.y = fmax(seen.hi.y, p.y);
          seen.hi.z = fmax(seen.hi.z, p.z);
        }
    double cells = (double)n * n * m;
    double box = size.x * size.y * 1.44;
    if (scene_dim(&s) == 3)
      box *= size.z * 1.2;
    assert_close(packing_domain_volume(domain), (double)inside / cells * box, 0.01);
    const double slack = 0.04; /* a tip a few cells long may slip through */
    assert_true(seen.lo.x >= b.lo.x && seen.lo.x <= b.lo.x + slack * size.x);
    assert_true(seen.lo.y >= b.lo.y && seen.lo.y <= b.lo.y + slack * size.y);
    assert_true(seen.hi.x <= b.hi.x && seen.hi.x >= b.hi.x - slack * size.x);
    assert_true(seen.hi.y <= b.hi.y && seen.hi.y >= b.hi.y - slack * size.y);
    if (scene_dim(&s) == 3) {
      assert_true(seen.lo.z >= b.lo.z && seen.lo.z <= b.lo.z + slack * size.z);
      assert_true(seen.hi.z <= b.hi.z && seen.hi.z >= b.hi.z - slack * size.z);
    } else {
      assert_true(b.lo.z == 0 && b.hi.z == 0);
    }
    packing_domain_destroy(domain);
  }
}

/* Every point at least d from the walls, and no other; the same distances less d inside, and
 * never more than that elsewhere. Deep insets lose faces: hoppers, outlets, tops. */
static void insets_take_their_distance_off(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = nth_scene(i);
    packing_domain *domain = scene_make(&s);
    uint64_t random = 43 + (uint64_t)i;
    double deepest = 0;
    for (int k = 0; k < 4000; k++)
      deepest = fmax(deepest, distance(domain, scene_random_point(&random, domain, 0)));
    for (int part = 1; part <= 9; part += 2) {
      const double d = 0.1 * part * deepest;
      packing_domain *inset = NULL;
      assert_ok(packing_domain_create_inset(NULL, domain, d, &inset));
      packing_bounds b, outer;
      packing_domain_bounds(inset, &b);
      packing_domain_bounds(domain, &outer);
      assert_string_equal(packing_domain_kind(inset), packing_domain_kind(domain));
      size_t inside = 0, all = 20000;
      for (size_t k = 0; k < all; k++) {
        const packing_vec3 p = scene_random_point(&random, domain, 0.05);
        const double before = distance(domain, p), after = distance(inset, p);
        assert_true(after <= before - d + 1e-14);
        if (before > d || after > 0)
          assert_near(after, before - d, 1e-14);
        if (after > 0 &&
            scene_coordinate(p, s.axis) <= scene_coordinate(outer.hi, s.axis) &&
            p.x >= b.lo.x && p.x < b.hi.x && p.y >= b.lo.y && p.y < b.hi.y)
          inside += s.periodic & 4 ? p.z >= b.lo.z && p.z < b.hi.z : 1;
      }
      /* Counted volume: 5 standard deviations of a binomial count are exceeded by one seed in
       * a million. */
      double box = (outer.hi.x - outer.lo.x) * (outer.hi.y - outer.lo.y) * 1.21;
      if (scene_dim(&s) == 3)
        box *= (outer.hi.z - outer.lo.z) * 1.1;
      const double share = packing_domain_volume(inset) / box;
      assert_near((double)inside / (double)all, share,
                  5 * sqrt(share * (1 - share) / (double)all) + 1e-12);
      packing_domain_destroy(inset);
    }
    packing_domain *nothing = NULL;
    assert_status(packing_domain_create_inset(NULL, domain, 1.4 * deepest, &nothing),
                  PACKING_ERR_GEOMETRY);
    assert_null(nothing);
    packing_domain_destroy(domain);
  }
}

static void same_container(packing_domain *a, packing_domain *b)
{
  uint64_t random = 47;
  packing_bounds ba, bb;
  packing_domain_bounds(a, &ba);
  packing_domain_bounds(b, &bb);
  assert_near(apart(ba.lo, bb.lo) + apart(ba.hi, bb.hi), 0, 1e-13);
  assert_close(packing_domain_volume(a), packing_domain_volume(b), 1e-12);
  for (int k = 0; k < 1000; k++) {
    const packing_vec3 p = scene_random_point(&random, a, 0.5);
    assert_near(distance(a, p), distance(b, p), 1e-13);
  }
  packing_domain_destroy(a);
  packing_domain_destroy(b);
}

static packing_domain *inset_of(scene s, double d)
{
  packing_domain *domain = scene_make(&s), *inset = NULL;
  assert_ok(packing_domain_create_inset(NULL, domain, d, &inset));
  packing_domain_destroy(domain); /* the inset lives on */
  return inset;
}

static void insets_are_the_kind_made_smaller(void **state)
{
  (void)state;
  const packing_vec3 at = {0.2, -0.4, 0.1}, up = {0.2, -0.4, 0.2}, in = {0.3, -0.3, 0.2};
  same_container(inset_of((scene){SCENE_BOX, 1, 2, 3, 0, at, 2, 0, 0}, 0.1),
                 scene_make(&(scene){SCENE_BOX, 0.8, 1.8, 2.8, 0, in, 2, 0, 0}));
  same_container(inset_of((scene){SCENE_BOX, 1, 2, 3, 0, at, 2, 1, 0}, 0.1),
                 scene_make(&(scene){SCENE_BOX, 0.8, 1.8, 2.9, 0, in, 2, 1, 0}));
  same_container(inset_of((scene){SCENE_CYLINDER, 1, 2, 0, 0, at, 2, 0, 0}, 0.1),
                 scene_make(&(scene){SCENE_CYLINDER, 0.9, 1.8, 0, 0, up, 2, 0, 0}));
  same_container(inset_of((scene){SCENE_TUBE, 0.5, 1, 2, 0, at, 2, 0, 0}, 0.1),
                 scene_make(&(scene){SCENE_TUBE, 0.6, 0.9, 1.8, 0, up, 2, 0, 0}));
  same_container(inset_of((scene){SCENE_SPHERE, 1, 0, 0, 0, at, 2, 0, 0}, 0.1),
                 scene_make(&(scene){SCENE_SPHERE, 0.9, 0, 0, 0, at, 2, 0, 0}));
  const packing_vec3 flat = {0.2, -0.4, 0};
  same_container(inset_of((scene){SCENE_CIRCLE, 1, 0, 0, 0, flat, 1, 0, 0}, 0.1),
                 scene_make(&(scene){SCENE_CIRCLE, 0.9, 0, 0, 0, flat, 1, 0, 0}));
  same_container(inset_of((scene){SCENE_ANNULUS, 0.5, 1, 0, 0, flat, 1, 0, 0}, 0.1),
                 scene_make(&(scene){SCENE_ANNULUS, 0.6, 0.9, 0, 0, flat, 1, 0, 0}));
  /* A slope of 3 in 4: moving the side by d moves it 5/4 d across. */
  same_container(inset_of((scene){SCENE_CONE, 0.5, 2, 2, 0, at, 2, 0, 0}, 0.1),
                 scene_make(&(scene){SCENE_CONE, 0.45, 1.8, 1.8, 0, up, 2, 0, 0}));
  /* Outlet 0.5 + 0.1 * 3/4 - 0.1 * 5/4; the side at 1.9 - 0.1 where the hopper is that wide. */
  same_container(
      inset_of((scene){SCENE_SILO, 2, 5, 0.5, 2, at, 2, 0, 0}, 0.1),
      scene_make(&(scene){SCENE_SILO, 1.9, 4.8, 0.45, (1.9 - 0.45) / 0.75, up, 2, 0, 0}));
  /* Inset of an inset. */
  packing_domain *half = inset_of((scene){SCENE_SILO, 2, 5, 0.5, 2, at, 2, 1, 0}, 0.25);
  packing_domain *twice = NULL;
  assert_ok(packing_domain_create_inset(NULL, half, 0.5, &twice));
  packing_domain_destroy(half);
  same_container(twice, inset_of((scene){SCENE_SILO, 2, 5, 0.5, 2, at, 2, 1, 0}, 0.75));
}

/* Turning a body from axis to axis turns its distances, bit for bit. */
static void axes_are_alike(void **state)
{
  (void)state;
  for (int kind = SCENE_CYLINDER; kind <= SCENE_SILO; kind++) {
    scene s = scene_of((enum scene_kind)kind);
    packing_domain *domain[3];
    for (int axis = 0; axis < 3; axis++) {
      s.axis = axis;
      s.at = scene_point(axis, 0.11, 0.21, -0.43);
      domain[axis] = scene_make(&s);
      assert_true(packing_domain_volume(domain[axis]) ==
                  packing_domain_volume(domain[0]));
    }
    uint64_t random = 53;
    for (int k = 0; k < 500; k++) {
      const double h = 4 * scene_random(&random) - 1, u = 4 * scene_random(&random) - 2;
      const double v = 4 * scene_random(&random) - 2, r = scene_random(&random);
      double d[3], cut[3];
      packing_vec3 n[3];
      for (int axis = 0; axis < 3; axis++) {
        const packing_vec3 p = scene_point(axis, h, u, v);
        d[axis] = packing_domain_signed_distance(domain[axis], &p, &n[axis]);
        assert_ok(
            packing_domain_sphere_volume(domain[axis], &p, r, 1e-9, &cut[axis], NULL));
        assert_true(d[axis] == d[0] && cut[axis] == cut[0]);
        for (int i = 0; i < 3; i++)
          assert_true(scene_coordinate(n[axis], (axis + i) % 3) ==
                      scene_coordinate(n[0], i));
      }
    }
    for (int axis = 0; axis < 3; axis++)
      packing_domain_destroy(domain[axis]);
  }
}

/* Lengths times a power of two: the same bytes but for the exponent. */
static void lengths_carry_no_hidden_scale(void **state)
{
  (void)state;
  const int powers[] = {-40, -3, 17, 64};
  for (int i = 0; i < SCENES; i++)
    for (size_t e = 0; e < sizeof powers / sizeof *powers; e++) {
      const double by = ldexp(1, powers[e]);
      const scene s = nth_scene(i), large = scene_scaled(s, by);
      const double unit = pow(by, scene_dim(&s));
      packing_domain *one = scene_make(&s), *other = scene_make(&large);
      packing_domain *one_inset = NULL, *other_inset = NULL;
      assert_ok(packing_domain_create_inset(NULL, one, 0.05, &one_inset));
      assert_ok(packing_domain_create_inset(NULL, other, 0.05 * by, &other_inset));
      assert_true(packing_domain_volume(other) == unit * packing_domain_volume(one));
      assert_true(packing_domain_volume(other_inset) ==
                  unit * packing_domain_volume(one_inset));
      uint64_t random = 59;
      for (int k = 0; k < 60; k++) {
        const packing_vec3 p = scene_random_point(&random, one, 0.3);
        const packing_vec3 q = {p.x * by, p.y * by, p.z * by};
        const double r = 0.5 * scene_random(&random) + 0.01;
        packing_vec3 n, m;
        double v, w, ve, we;
        assert_true(packing_domain_signed_distance(other, &q, &m) ==
                    by * packing_domain_signed_distance(one, &p, &n));
        assert_memory_equal(&m, &n, sizeof m);
        assert_true(distance(other_inset, q) == by * distance(one_inset, p));
        assert_ok(packing_domain_sphere_volume(one, &p, r, 1e-9, &v, &ve));
        assert_ok(packing_domain_sphere_volume(other, &q, r * by, 1e-9, &w, &we));
        assert_true(w == unit * v && we == unit * ve);
        packing_vec3 wrapped = p, large_wrapped = q;
        packing_domain_wrap(one, &wrapped);
        packing_domain_wrap(other, &large_wrapped);
        assert_true(large_wrapped.x == by * wrapped.x &&
                    large_wrapped.y == by * wrapped.y &&
                    large_wrapped.z == by * wrapped.z);
      }
      packing_domain_destroy(one);
      packing_domain_destroy(other);
      packing_domain_destroy(one_inset);
      packing_domain_destroy(other_inset);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(distances_agree_with_samples_of_the_walls),
      cmocka_unit_test(signs_say_inside),
      cmocka_unit_test(normals_lead_to_the_wall),
      cmocka_unit_test(normals_are_gradients),
      cmocka_unit_test(distances_change_no_faster_than_points),
      cmocka_unit_test(holds_is_a_distance_of_r),
      cmocka_unit_test(volumes_and_bounds_agree_with_counts),
      cmocka_unit_test(insets_take_their_distance_off),
      cmocka_unit_test(insets_are_the_kind_made_smaller),
      cmocka_unit_test(axes_are_alike),
      cmocka_unit_test(lengths_carry_no_hidden_scale),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
