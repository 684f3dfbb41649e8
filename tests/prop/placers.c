/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scaling every length by a power of two scales the result of every placer bit for bit: no
 * placer hides an absolute length. */
#include "test.h"

typedef packing_placer *(*scene)(packing_domain *domain, packing_psd *psd,
                                 packing_particles *store, double scale);

static packing_placer *rsa_saturated(packing_domain *domain, packing_psd *psd,
                                     packing_particles *store, double scale)
{
  (void)scale;
  packing_placer *placer = NULL;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.max_failures = 1000;
  assert_ok(packing_rsa_create(NULL, &def, domain, psd, store, &placer));
  return placer;
}

static packing_placer *rsa_filled(packing_domain *domain, packing_psd *psd,
                                  packing_particles *store, double scale)
{
  (void)scale;
  packing_placer *placer = NULL;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.volume_fraction = 0.2;
  def.order = PACKING_ORDER_DESCENDING;
  assert_ok(packing_rsa_create(NULL, &def, domain, psd, store, &placer));
  return placer;
}

static packing_placer *lattice(packing_domain *domain, packing_psd *psd,
                               packing_particles *store, double scale)
{
  packing_placer *placer = NULL;
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.kind = PACKING_LATTICE_BCC;
  def.spacing_r = 0.71 * scale;
  assert_ok(packing_lattice_create(NULL, &def, domain, psd, store, &placer));
  return placer;
}

static packing_placer *cells(packing_domain *domain, packing_psd *psd,
                             packing_particles *store, double scale)
{
  (void)scale;
  packing_placer *placer = NULL;
  packing_lattice_def def;
  packing_lattice_def_init(&def);
  def.count = 111;
  assert_ok(packing_lattice_create(NULL, &def, domain, psd, store, &placer));
  return placer;
}

typedef packing_domain *(*room)(double scale);

static packing_domain *box(double scale)
{
  return test_box(9.31 * scale, 8.27 * scale, 7.45 * scale, 0);
}

static packing_domain *cell(double scale)
{
  return test_box(9.31 * scale, 8.27 * scale, 7.45 * scale, 7);
}

static packing_domain *plane(double scale)
{
  return test_rectangle(19.31 * scale, 18.27 * scale, PACKING_PERIODIC_X);
}

static packing_domain *silo(double scale)
{
  packing_domain_silo_def def;
  packing_domain *domain = NULL;
  packing_domain_silo_def_init(&def);
  def.radius = 4.31 * scale;
  def.height = 11.3 * scale;
  def.outlet_radius = 0.9 * scale;
  def.hopper_height = 3.7 * scale;
  assert_ok(packing_domain_create_silo(NULL, &def, &domain));
  return domain;
}

static packing_particles *run(scene make, room within, double scale, double min_r,
                              double max_r)
{
  packing_domain *domain = within(scale);
  packing_psd *psd = min_r < max_r ? test_uniform(min_r * scale, max_r * scale)
                                   : test_mono(max_r * scale);
  packing_particles *store = test_store(packing_domain_dim(domain));
  packing_placer *placer = make(domain, psd, store, scale);
  test_run(placer);
  packing_placer_destroy(placer);
  packing_domain_destroy(domain);
  packing_psd_destroy(psd);
  return store;
}

static void same_when_scaled(scene make, room within, double min_r, double max_r)
{
  static const int powers[] = {-300, -41, -1, 2, 13, 300};
  packing_particles *plain = run(make, within, 1, min_r, max_r);
  packing_view a;
  packing_particles_view(plain, &a);
  for (size_t k = 0; k < sizeof powers / sizeof *powers; k++) {
    packing_particles *scaled = run(make, within, ldexp(1, powers[k]), min_r, max_r);
    packing_view b;
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

static const room rooms[] = {box, cell, plane, silo};

static void equal_sizes(void **state)
{
  (void)state;
  for (size_t i = 0; i < sizeof rooms / sizeof *rooms; i++) {
    same_when_scaled(rsa_saturated, rooms[i], 0.5, 0.5);
    same_when_scaled(rsa_filled, rooms[i], 0.5, 0.5);
  }
}

static void unequal_sizes(void **state)
{
  (void)state;
  for (size_t i = 0; i < sizeof rooms / sizeof *rooms; i++) {
    same_when_scaled(rsa_saturated, rooms[i], 0.3, 0.7);
    same_when_scaled(rsa_filled, rooms[i], 0.1, 0.7);
  }
}

static void lattices(void **state)
{
  (void)state;
  same_when_scaled(lattice, box, 0.3, 0.7);
  same_when_scaled(lattice, silo, 0.3, 0.7);
  same_when_scaled(cells, box, 0.3, 0.7);
  same_when_scaled(cells, cell, 0.3, 0.7);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equal_sizes),
      cmocka_unit_test(unequal_sizes),
      cmocka_unit_test(lattices),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
