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

static packing_particles *run(scene make, double scale, double min_r, double max_r)
{
  packing_domain *domain = test_box(9.31 * scale, 8.27 * scale, 7.45 * scale, 0);
  packing_psd *psd = min_r < max_r ? test_uniform(min_r * scale, max_r * scale)
                                   : test_mono(max_r * scale);
  packing_particles *store = test_store(3);
  packing_placer *placer = make(domain, psd, store, scale);
  test_run(placer);
  packing_placer_destroy(placer);
  packing_domain_destroy(domain);
  packing_psd_destroy(psd);
  return store;
}

static void same_when_scaled(scene make, double min_r, double max_r)
{
  static const int powers[] = {-300, -41, -1, 2, 13, 300};
  packing_particles *plain = run(make, 1, min_r, max_r);
  packing_view a;
  packing_particles_view(plain, &a);
  for (size_t k = 0; k < sizeof powers / sizeof *powers; k++) {
    packing_particles *scaled = run(make, ldexp(1, powers[k]), min_r, max_r);
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

static void equal_sizes(void **state)
{
  (void)state;
  same_when_scaled(rsa_saturated, 0.5, 0.5);
  same_when_scaled(rsa_filled, 0.5, 0.5);
}

static void unequal_sizes(void **state)
{
  (void)state;
  same_when_scaled(rsa_saturated, 0.3, 0.7);
  same_when_scaled(rsa_filled, 0.1, 0.7);
}

static void lattices(void **state)
{
  (void)state;
  same_when_scaled(lattice, 0.3, 0.7);
  same_when_scaled(cells, 0.3, 0.7);
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
