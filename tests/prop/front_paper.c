/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds of every pack of the front's paper mode: it scales with the lengths bit for bit, and is
 * a pack in whatever container, order and contact. */
#include "cluster.h"
#include "front_scenes.h"
#include "mesh_scenes.h"
#include "solids.h"

typedef struct setting {
  int room, select, direction, mono;
  const char *contact;
} setting;

static scene scaled_room(int room, double scale)
{
  scene s = front_rooms[room];
  s.a *= scale;
  s.b *= scale;
  s.c *= scale;
  s.d *= scale;
  s.at.x *= scale;
  s.at.y *= scale;
  s.at.z *= scale;
  return s;
}

static packing_particles *run(const setting *set, double scale, uint64_t seed)
{
  const scene room = scaled_room(set->room, scale);
  packing_domain *domain = scene_make(&room);
  packing_psd *psd =
      set->mono ? test_mono(1.03 * scale) : test_uniform(0.8 * scale, 1.3 * scale);
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_front_def def = front_paper();
  def.seed = seed;
  def.direction =
      has_walls(domain) ? (packing_front_direction)set->direction : PACKING_FRONT_OUTWARD;
  def.select_particle = (packing_front_select)(set->select / 3);
  def.select_neighbours = (packing_front_select)(set->select % 3);
  def.contact = packing_contact_method_named(set->contact);
  front_pack(&def, domain, psd, store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  return store;
}

static void same_when_scaled(const setting *set, int far)
{
  const int powers[] = {-far, -1, 13, far};
  packing_particles *plain = run(set, 1, 4);
  packing_view a, b;
  packing_particles_view(plain, &a);
  for (size_t k = 0; k < sizeof powers / sizeof *powers; k++) {
    packing_particles *scaled = run(set, ldexp(1, powers[k]), 4);
    packing_particles_view(scaled, &b);
    assert_int_equal(a.count, b.count);
    const double *from[4] = {a.x.data, a.y.data, a.z.data, a.r.data};
    const double *to[4] = {b.x.data, b.y.data, b.z.data, b.r.data};
    for (size_t c = 0; c < 4; c++)
      for (size_t i = 0; i < a.count; i++)
        assert_true(ldexp(from[c][i], powers[k]) == to[c][i]);
    packing_particles_destroy(scaled);
  }
  packing_particles_destroy(plain);
}

static void lengths_scale_bit_for_bit(void **state)
{
  (void)state;
  for (int room = 0; room < FRONT_ROOMS; room++)
    for (int direction = 0; direction < 2; direction++) {
      const setting set = {room, (room + 5 * direction) % 9, direction, room % 2,
                           "wrappers"};
      same_when_scaled(&set, 290);
    }
}

static void contact_methods_scale_bit_for_bit(void **state)
{
  (void)state;
  const setting sets[] = {{8, 0, 0, 0, "binary"},
                          {4, 0, 0, 0, "direct"},
                          {11, 0, 1, 0, "potential"},
                          {9, 0, 0, 0, "potential"}};
  for (size_t k = 0; k < sizeof sets / sizeof *sets; k++)
    same_when_scaled(&sets[k], 200); /* fourth powers of lengths are taken */
}

/* front_pack() holds overlaps and protrusions against rounding. */
static void every_pack_is_one(void **state)
{
  (void)state;
  for (int room = 0; room < FRONT_ROOMS; room++)
    for (int select = 0; select < 9; select++)
      for (int mono = 0; mono < 2; mono++) {
        const setting set = {room, select, (room + select) % 2, mono, "wrappers"};
        packing_particles *store = run(&set, 1, 100 + (uint64_t)select);
        assert_true(packing_particles_count(store) > 4);
        packing_particles_destroy(store);
      }
}

enum { APART = 5, SOLIDS, BODIES = SOLIDS + 5 };

/* Containers joined, cut from one another and meshes, some 10 particles of radius 1 across. */
static packing_domain *body_of(int kind, double s)
{
  const int mesh[] = {SHAPE_OCTAHEDRON, SHAPE_SPHERE, SHAPE_TORUS, SHAPE_ANGLE,
                      SHAPE_HOLLOW};
  const double scale[] = {8, 5.5, 9, 5, 5.5};
  switch (kind) {
  case 0: /* a T of cylinders */
    return solid_of(PACKING_UNION,
                    solid_cylinder(3.3 * s, 14 * s, PACKING_AXIS_Z, 0, 0, 0),
                    solid_cylinder(3.1 * s, 15 * s, PACKING_AXIS_X, -7 * s, 0, 11 * s));
  case 1: /* a box without a ball */
    return solid_of(PACKING_DIFFERENCE,
                    solid_box(12 * s, 11 * s, 10 * s, -6 * s, -6 * s, -5 * s),
                    solid_sphere(2.3 * s, s, 0, 0));
  case 2: /* a lens */
    return solid_of(PACKING_INTERSECTION, solid_sphere(9 * s, 0, 0, 0),
                    solid_sphere(9 * s, 6 * s, 0, 0));
  case 3: /* an L without a bore */
    return solid_of(PACKING_DIFFERENCE,
                    solid_of(PACKING_UNION, solid_box(12 * s, 6 * s, 6 * s, 0, 0, 0),
                             solid_box(6 * s, 12 * s, 6 * s, 0, 0, 0)),
                    solid_cylinder(s, 20 * s, PACKING_AXIS_Z, 3 * s, 3 * s, -2 * s));
  case 4: /* in the plane: a ring with a window */
    return solid_of(PACKING_DIFFERENCE, solid_circle(12 * s, 0, 0),
                    solid_rectangle(9 * s, 8 * s, -2 * s, -4 * s));
  case APART: /* two balls */
    return solid_of(PACKING_UNION, solid_sphere(5 * s, 0, 0, 0),
                    solid_sphere(4 * s, 10 * s, 0, 0));
  default:
    break;
  }
  shape *form = shape_of(mesh[kind - SOLIDS]);
  packing_domain *domain = shape_domain(form, scale[kind - SOLIDS] * s);
  free(form);
  return domain;
}

static packing_particles *run_body(int kind, int direction, double scale)
{
  packing_domain *domain = body_of(kind, scale);
  packing_psd *psd = test_uniform(0.7 * scale, 1.1 * scale);
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_front_def def = front_paper();
  def.direction = (packing_front_direction)direction;
  def.seed = 3 + (uint64_t)kind;
  front_pack(&def, domain, psd, store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  return store;
}

/* In containers put together and meshes: outward the contacts of the law, of two packs in what hangs
 * apart, and none with walls; inward walls are touched. front_pack() holds overlaps and protrusions. */
static void combinations_and_meshes(void **state)
{
  (void)state;
  for (int kind = 0; kind < BODIES; kind++)
    for (int direction = 0; direction < 2; direction++) {
      packing_domain *domain = body_of(kind, 1);
      packing_particles *store = run_body(kind, direction, 1);
      const size_t n = packing_particles_count(store);
      const size_t dim = (size_t)packing_domain_dim(domain), start = dim == 3 ? 6 : 3;
      const size_t contacts = front_contacts(domain, store);
      size_t walls = 0;
      for (size_t i = 0; i < n; i++)
        walls += front_wall_gap(domain, store, i) <= 1e-10;
      if (direction == PACKING_FRONT_OUTWARD) {
        assert_int_equal(walls, 0);
        assert_int_equal(contacts, dim * n - start * (kind == APART ? 2 : 1));
      }
      assert_true(direction == PACKING_FRONT_OUTWARD || walls > n / 4);
      packing_particles_destroy(store);
      packing_domain_destroy(domain);
    }
}

static void combinations_and_meshes_scale(void **state)
{
  (void)state;
  for (int kind = 0; kind < BODIES; kind++) {
    packing_particles *plain = run_body(kind, kind % 2, 1);
    packing_particles *scaled = run_body(kind, kind % 2, 0x1p-40);
    packing_view a, b;
    packing_particles_view(plain, &a);
    packing_particles_view(scaled, &b);
    assert_int_equal(a.count, b.count);
    const double *from[4] = {a.x.data, a.y.data, a.z.data, a.r.data};
    const double *to[4] = {b.x.data, b.y.data, b.z.data, b.r.data};
    for (size_t c = 0; c < 4; c++)
      for (size_t i = 0; i < a.count; i++)
        assert_true(0x1p-40 * from[c][i] == to[c][i]);
    packing_particles_destroy(plain);
    packing_particles_destroy(scaled);
  }
}

/* As far as it has come, the pack does not depend on the size of the steps. */
static void steps_of_any_size(void **state)
{
  (void)state;
  packing_domain *domain = test_box(16, 16, 16, 0);
  packing_psd *psd = test_uniform(0.7, 1.3);
  uint64_t hash[2];
  for (int k = 0; k < 2; k++) {
    packing_particles *store = test_store(3);
    packing_placer *placer = NULL;
    packing_placer_report report;
    const packing_front_def def = front_paper();
    packing_placer_report_init(&report);
    assert_ok(packing_front_create(NULL, &def, domain, psd, store, &placer));
    do
      assert_ok(packing_placer_step(placer, k == 0 ? 1 : 1000, &report));
    while (report.state == PACKING_PLACER_RUNNING);
    hash[k] = test_hash_particles(store);
    packing_placer_destroy(placer);
    packing_particles_destroy(store);
  }
  assert_true(hash[0] == hash[1]);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lengths_scale_bit_for_bit),
      cmocka_unit_test(contact_methods_scale_bit_for_bit),
      cmocka_unit_test(every_pack_is_one),
      cmocka_unit_test(combinations_and_meshes),
      cmocka_unit_test(combinations_and_meshes_scale),
      cmocka_unit_test(steps_of_any_size),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
