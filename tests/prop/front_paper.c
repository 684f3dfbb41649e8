/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds of every pack of the front's paper mode: it scales with the lengths bit for bit, and is
 * a pack in whatever container, order and contact. */
#include "cluster.h"
#include "front_scenes.h"

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
        packing_particles *store = run(&set, 1, (uint64_t)(100 + select));
        assert_true(packing_particles_count(store) > 4);
        packing_particles_destroy(store);
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
      cmocka_unit_test(steps_of_any_size),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
