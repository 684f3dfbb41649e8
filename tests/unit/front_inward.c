/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The advancing front in paper mode, inward: the corner first, the whole boundary closed before the
 * inside, in exact contact with plane and curved walls. */
#include "cluster.h"
#include "front_scenes.h"
#include "mesh_scenes.h"

/* A wall counts as touched. */
static int touches(packing_domain *domain, packing_particles *store, size_t i)
{
  return fabs(front_wall_gap(domain, store, i)) <= 1e-12;
}

/* How many particles at the head of the store touch the boundary; none after them does. */
static size_t boundary_layer(packing_domain *domain, packing_particles *store)
{
  const size_t count = packing_particles_count(store);
  size_t layer = 0;
  while (layer < count && touches(domain, store, layer))
    layer++;
  for (size_t i = layer; i < count; i++)
    assert_true(front_wall_gap(domain, store, i) > 1e-9);
  return layer;
}

/* Moves a point to where a sphere of radius r touches the nearest wall; 0: it does not get there. */
static int to_wall(packing_domain *domain, double r, packing_vec3 *p)
{
  for (int k = 0; k < 60; k++) {
    packing_vec3 n;
    const double d = packing_domain_signed_distance(domain, p, &n) - r;
    if (fabs(d) < 1e-12)
      return 1;
    p->x -= d * n.x;
    p->y -= d * n.y;
    p->z -= d * n.z;
  }
  return 0;
}

/* Random spheres in contact with the boundary: each meets one of the layer. Equal spheres alone
 * close the boundary strictly: a place that was too small stays so. */
static void no_gap_in_the_layer(packing_domain *domain, packing_particles *store,
                                size_t layer, double r)
{
  packing_rng *rng = NULL;
  packing_bounds b;
  size_t tried = 0;
  packing_domain_bounds(domain, &b);
  const int flat = packing_domain_dim(domain) == 2;
  assert_ok(packing_rng_create(NULL, 8, PACKING_PURPOSE_USER, 0, &rng));
  while (tried < 1000) {
    packing_vec3 p = {b.lo.x + (b.hi.x - b.lo.x) * packing_rng_uniform(rng),
                      b.lo.y + (b.hi.y - b.lo.y) * packing_rng_uniform(rng),
                      flat ? 0 : b.lo.z + (b.hi.z - b.lo.z) * packing_rng_uniform(rng)};
    if (!to_wall(domain, r, &p) || (!flat && p.z > b.hi.z - r))
      continue; /* nothing stands in an open top */
    tried++;
    double least = INFINITY;
    for (size_t i = 0; i < layer; i++) {
      const packing_vec3 c = front_centre(store, i);
      const packing_vec3 s = packing_domain_separation(domain, &p, &c);
      least = fmin(least,
                   sqrt(s.x * s.x + s.y * s.y + s.z * s.z) - r - front_radius(store, i));
    }
    assert_true(least < 1e-9);
  }
  packing_rng_destroy(rng);
}

static packing_particles *inward(packing_domain *domain, packing_psd *psd, int select,
                                 const char *contact, packing_placer_report *report)
{
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_front_def def = front_paper();
  def.direction = PACKING_FRONT_INWARD;
  def.select_particle = (packing_front_select)(select / 3);
  def.select_neighbours = (packing_front_select)(select % 3);
  def.contact = packing_contact_method_named(contact);
  *report = front_pack(&def, domain, psd, store);
  assert_int_equal(report->state, PACKING_PLACER_SATURATED);
  return store;
}

static void the_boundary_is_closed_first(void **state)
{
  (void)state;
  packing_psd *equal = test_mono(1), *mixed = test_uniform(0.7, 1.3);
  for (size_t k = 0; k < FRONT_ROOMS; k++) {
    packing_domain *domain = scene_make(&front_rooms[k]);
    for (int select = 0; select < 9 && has_walls(domain); select += 4) {
      packing_placer_report report;
      packing_particles *store = inward(domain, equal, select, "wrappers", &report);
      size_t layer = boundary_layer(domain, store);
      assert_true(layer > 10);
      no_gap_in_the_layer(domain, store, layer, 1);
      packing_particles_destroy(store);
      store = inward(domain, mixed, select, "wrappers", &report);
      layer = boundary_layer(domain, store);
      assert_true(layer > 10);
      packing_particles_destroy(store);
    }
    packing_domain_destroy(domain);
  }
  packing_psd_destroy(equal);
  packing_psd_destroy(mixed);
}

/* Both walls of an annulus and a tube, which hang together nowhere or at the ends only. */
static void every_part_of_the_boundary(void **state)
{
  (void)state;
  const scene ring = {SCENE_ANNULUS, 6.3, 14.7, 0, 0, {0, 0, 0}, 1, 0, 0};
  packing_domain *domain = scene_make(&ring);
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_placer_report report;
  packing_particles *store = inward(domain, psd, 0, "wrappers", &report);
  const size_t layer = boundary_layer(domain, store);
  size_t inner = 0;
  for (size_t i = 0; i < layer; i++) {
    const packing_vec3 p = front_centre(store, i);
    inner += hypot(p.x, p.y) < 10;
  }
  assert_true(inner > 15 && layer - inner > 30);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* How many walls of a container the first particle touches. */
static void the_first_stands_in_a_corner(void **state)
{
  (void)state;
  const int walls[FRONT_ROOMS] = {3, 1, 0, 3, 2, 2, 2, 2, 1, 2, 0, 1, 1};
  packing_psd *psd = test_uniform(0.7, 1.3);
  for (size_t k = 0; k < FRONT_ROOMS; k++) {
    packing_domain *domain = scene_make(&front_rooms[k]);
    if (has_walls(domain)) {
      packing_particles *store = test_store(packing_domain_dim(domain));
      packing_front_def def = front_paper();
      def.direction = PACKING_FRONT_INWARD;
      def.count = 1;
      front_pack(&def, domain, psd, store);
      packing_body body =
          packing_body_sphere(front_centre(store, 0), front_radius(store, 0));
      int touched = 0;
      for (int w = 0; w < 6; w++)
        touched += fabs(packing_body_wall_gap(&body, domain, w, NULL)) <= 1e-14 * 20;
      assert_int_equal(touched, walls[k]);
      packing_particles_destroy(store);
    }
    packing_domain_destroy(domain);
  }
  packing_psd_destroy(psd);
}

/* In space each of the boundary touches two bodies beside a wall, in the plane one: whichever
 * method is asked for, of walls an exact one is taken. */
static void contacts_at_the_boundary(void **state)
{
  (void)state;
  const char *const names[] = {"wrappers", "potential", "binary", "direct"};
  packing_psd *psd = test_uniform(0.7, 1.3);
  for (size_t k = 4; k < FRONT_ROOMS; k += 4)
    for (int m = 0; m < 4; m++) {
      packing_domain *domain = scene_make(&front_rooms[k]);
      const size_t dim = (size_t)packing_domain_dim(domain);
      packing_placer_report report;
      packing_particles *store = inward(domain, psd, 0, names[m], &report);
      const size_t layer = boundary_layer(domain, store);
      size_t short_of = 0;
      for (size_t i = 0; i < layer; i++) {
        size_t touched = 0;
        const packing_body body =
            packing_body_sphere(front_centre(store, i), front_radius(store, i));
        for (int w = 0; w < 6; w++)
          touched += fabs(packing_body_wall_gap(&body, domain, w, NULL)) <= 1e-12;
        for (size_t j = 0; j < i; j++)
          touched += fabs(front_gap(domain, store, i, j)) <= 1e-11;
        short_of += touched < dim;
      }
      /* But for the first ones, and those set where the front did not come. */
      assert_true(short_of <= 3 + layer / 10);
      packing_particles_destroy(store);
      packing_domain_destroy(domain);
    }
  packing_psd_destroy(psd);
}

/* A container of the user's: a ball without a smaller one off its centre, two walls in one
 * distance. */
static double hollow(void *user, const packing_vec3 *p, packing_vec3 *normal)
{
  (void)user;
  const double outer = sqrt(p->x * p->x + p->y * p->y + p->z * p->z);
  const packing_vec3 q = {p->x - 1.5, p->y, p->z};
  const double inner = sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  if (8 - outer < inner - 3) {
    if (normal != NULL && outer > 0)
      *normal = (packing_vec3){-p->x / outer, -p->y / outer, -p->z / outer};
    return 8 - outer;
  }
  if (normal != NULL && inner > 0)
    *normal = (packing_vec3){q.x / inner, q.y / inner, q.z / inner};
  return inner - 3;
}

static void a_container_of_the_users(void **state)
{
  (void)state;
  packing_domain_custom_def def;
  packing_domain *domain = NULL;
  packing_domain_custom_def_init(&def);
  def.signed_distance = hollow;
  def.bounds.lo = (packing_vec3){-8, -8, -8};
  def.bounds.hi = (packing_vec3){8, 8, 8};
  def.volume = 4.0 / 3 * TEST_PI * (512 - 27);
  assert_ok(packing_domain_create_custom(NULL, &def, &domain));
  packing_psd *psd = test_mono(0.9);
  packing_placer_report report;
  packing_particles *store = inward(domain, psd, 0, "wrappers", &report);
  const size_t layer = boundary_layer(domain, store);
  no_gap_in_the_layer(domain, store, layer, 0.9);
  size_t inner = 0;
  for (size_t i = 0; i < layer; i++) {
    const packing_vec3 p = front_centre(store, i);
    inner += hypot(hypot(p.x - 1.5, p.y), p.z) < 4;
  }
  assert_true(inner > 10 && layer - inner > 80);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* A polygon with a reflex corner and a hole. */
static void a_polygon(void **state)
{
  (void)state;
  const double x[] = {0, 25, 25, 12, 11, 0, 4, 9, 8},
               y[] = {0, 1, 24, 23, 12, 13, 4, 5, 8};
  const size_t sizes[] = {6, 3};
  packing_domain_polygon_def def;
  packing_domain *domain = NULL;
  packing_domain_polygon_def_init(&def);
  def.count = 9;
  def.x = x;
  def.y = y;
  def.rings = 2;
  def.sizes = sizes;
  assert_ok(packing_domain_create_polygon(NULL, &def, &domain));
  packing_psd *psd = test_mono(0.7);
  packing_placer_report report;
  packing_particles *store = inward(domain, psd, 0, "wrappers", &report);
  const size_t layer = boundary_layer(domain, store);
  no_gap_in_the_layer(domain, store, layer, 0.7);
  assert_true(report.volume_fraction > 0.6);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* Closed meshes: a tetrahedron, and a ring whose inner edges bend into it. The boundary is closed and
 * touched exactly. */
static void meshes(void **state)
{
  (void)state;
  for (int kind = 0; kind < 2; kind++) {
    shape *s = shape_new();
    if (kind == 0)
      shape_tetrahedron(s);
    else
      shape_torus(s, 1.3, 0.5, 16, 8);
    packing_domain *domain = shape_domain(s, kind == 0 ? 7 : 6);
    packing_psd *psd = test_mono(0.9);
    packing_placer_report report;
    packing_particles *store = inward(domain, psd, 0, "wrappers", &report);
    const size_t layer = boundary_layer(domain, store);
    no_gap_in_the_layer(domain, store, layer, 0.9);
    assert_true(layer > 40);
    packing_particles_destroy(store);
    packing_psd_destroy(psd);
    packing_domain_destroy(domain);
    free(s);
  }
}

/* Clusters cover the boundary too. */
static void clusters_at_the_wall(void **state)
{
  (void)state;
  packing_domain *domain = test_rectangle(17, 15, 0);
  packing_psd *psd = test_mono(1);
  packing_particles *store = test_store(2);
  packing_shape *pair = test_cluster(0.6, 1);
  packing_front_def def = front_paper();
  def.direction = PACKING_FRONT_INWARD;
  def.contact = packing_contact_potential();
  def.shape = pair;
  const packing_placer_report report = front_pack(&def, domain, psd, store);
  packing_view v;
  packing_particles_view(store, &v);
  size_t layer = 0;
  for (size_t i = 0; i < report.placed; i++) {
    const double q[4] = {((const double *)v.qw.data)[i], 0, 0,
                         ((const double *)v.qz.data)[i]};
    const packing_body body = test_cluster_body(pair, front_centre(store, i), 1, q);
    const double clear = packing_body_clearance(&body, domain, NULL);
    if (fabs(clear) > 1e-11)
      break;
    layer++;
  }
  assert_true(layer > 15 && layer < report.placed);
  packing_shape_destroy(pair);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* What stands in the store takes part. */
static void among_what_stands(void **state)
{
  (void)state;
  packing_domain *domain = test_box(12, 12, 12, 0);
  packing_psd *psd = test_mono(0.9);
  packing_particles *store = test_store(3);
  const packing_vec3 corner = {1.5, 1.5, 1.5};
  assert_ok(packing_particles_add(store, corner, 1.5, NULL));
  packing_front_def def = front_paper();
  def.direction = PACKING_FRONT_INWARD;
  front_pack(&def, domain, psd, store);
  assert_true(front_radius(store, 0) == 1.5);
  no_gap_in_the_layer(domain, store, boundary_layer(domain, store), 0.9);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_boundary_is_closed_first),
      cmocka_unit_test(every_part_of_the_boundary),
      cmocka_unit_test(the_first_stands_in_a_corner),
      cmocka_unit_test(contacts_at_the_boundary),
      cmocka_unit_test(a_container_of_the_users),
      cmocka_unit_test(a_polygon),
      cmocka_unit_test(meshes),
      cmocka_unit_test(clusters_at_the_wall),
      cmocka_unit_test(among_what_stands),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
