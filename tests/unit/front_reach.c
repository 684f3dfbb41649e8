/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pocket front comes everywhere: chambers that nothing joins, containers whose innermost point
 * lies at an open top, both directions. */
#include "front_scenes.h"

static packing_domain *box_at(double x, double edge)
{
  packing_domain *domain = NULL;
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size = (packing_vec3){edge, edge, edge};
  def.corner = (packing_vec3){x, 0, 0};
  assert_int_equal(packing_domain_create_box(NULL, &def, &domain), PACKING_OK);
  return domain;
}

static double filled(packing_domain *domain, packing_front_direction direction,
                     packing_particles *store)
{
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_front_def def;
  packing_front_def_init(&def);
  def.direction = direction;
  const packing_placer_report report = front_pack(&def, domain, psd, store);
  packing_psd_destroy(psd);
  assert_int_equal(report.state, PACKING_PLACER_SATURATED);
  return report.volume_fraction;
}

static void both_chambers(void **state)
{
  (void)state;
  for (int direction = 0; direction < 2; direction++) {
    packing_domain_combination_def def;
    packing_domain_combination_def_init(&def);
    def.a = box_at(0, 14);
    def.b = box_at(20, 9);
    packing_domain *domain = NULL;
    assert_int_equal(packing_domain_create_combination(NULL, &def, &domain), PACKING_OK);
    packing_particles *store = test_store(3);
    /* The larger one alone would be 0.45. */
    assert_true(filled(domain, (packing_front_direction)direction, store) > 0.5);
    packing_particles_destroy(store);
    packing_domain_destroy(domain);
    packing_domain_destroy(def.a);
    packing_domain_destroy(def.b);
  }
}

static void funnel(void **state)
{
  (void)state;
  for (int direction = 0; direction < 2; direction++) {
    packing_domain_cone_def def;
    packing_domain_cone_def_init(&def);
    def.bottom_radius = 0;
    def.top_radius = 10;
    def.height = 20;
    def.open_top = 1;
    packing_domain *domain = NULL;
    assert_int_equal(packing_domain_create_cone(NULL, &def, &domain), PACKING_OK);
    packing_particles *store = test_store(3);
    assert_true(filled(domain, (packing_front_direction)direction, store) > 0.4);
    packing_particles_destroy(store);
    packing_domain_destroy(domain);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(both_chambers),
                                     cmocka_unit_test(funnel)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
