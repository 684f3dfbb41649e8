/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How dense and how disordered the packs of the front's dense and fast modes are. The seeds are
 * fixed: a failure is a change of the code, not chance. */
#include "pocket_scenes.h"

static packing_particles *cube(packing_front_mode mode, double edge, packing_psd *psd,
                               packing_domain **domain)
{
  packing_particles *store = test_store(3);
  const packing_front_def def = pocket_def(mode);
  *domain = test_box(edge, edge, edge, 0);
  pocket_pack(NULL, &def, *domain, psd, store);
  return store;
}

static double inner_fraction(packing_domain *domain, packing_particles *store)
{
  packing_view v;
  packing_volume_report report;
  packing_particles_view(store, &v);
  packing_volume_report_init(&report);
  assert_ok(packing_measure_volume(NULL, NULL, domain, &v, &report));
  return report.inner_fraction;
}

/* Radii uniform in [0.7, 1.3], some 6e4 spheres: random close packing. */
static void spheres_of_uniform_sizes(void **state)
{
  (void)state;
  static const double least[2] = {0.640, 0.605}, most[2] = {0.660, 0.650};
  for (int mode = 0; mode < 2; mode++) {
    packing_domain *domain = NULL;
    packing_psd *psd = test_uniform(0.7, 1.3);
    packing_particles *store = cube(pocket_modes[mode], 78, psd, &domain);
    const double fraction = inner_fraction(domain, store);
    print_message("# %s %zu: %.4f\n", packing_front_mode_name(pocket_modes[mode]),
                  packing_particles_count(store), fraction);
    assert_true(fraction >= least[mode] && fraction <= most[mode]);
    packing_particles_destroy(store);
    packing_psd_destroy(psd);
    packing_domain_destroy(domain);
  }
}

/* Equal spheres stay disordered: Q6 of all bonds is that of chance, 1 / sqrt(bonds), where crystals
 * have 0.57. */
static void equal_spheres(void **state)
{
  (void)state;
  packing_domain *domain = NULL;
  packing_psd *psd = test_mono(1);
  packing_particles *store = cube(PACKING_FRONT_DENSE, 60, psd, &domain);
  const double fraction = inner_fraction(domain, store);
  packing_view v;
  packing_neighbours *bonds = NULL;
  packing_neighbours_def near;
  packing_bond_order_def six;
  packing_bond_order_report order;
  packing_particles_view(store, &v);
  packing_neighbours_def_init(&near);
  packing_bond_order_def_init(&six);
  packing_bond_order_report_init(&order);
  near.factor = 1.4;
  near.margin = 6;
  assert_ok(packing_neighbours_create(NULL, &near, domain, &v, &bonds));
  assert_ok(packing_measure_bond_order(NULL, &six, bonds, NULL, 0, &order));
  packing_neighbours_destroy(bonds);
  print_message("# equal %zu: %.4f, Q6 %.4f\n", packing_particles_count(store), fraction,
                order.whole);
  assert_true(fraction >= 0.60);
  assert_true(order.whole <= 0.05);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(spheres_of_uniform_sizes),
      cmocka_unit_test(equal_spheres),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
