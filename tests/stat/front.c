/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes of the front's paper mode. */
#include "front_scenes.h"

/* A pending particle stays until it is placed, so the sizes are those asked. Of independent draws
 * D sqrt N exceeds 2.23 with probability 1e-4; these, drawn by strata, are closer still. The seeds
 * are fixed: a failure is a change of the code. */
static void sizes_are_those_asked(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (int direction = 0; direction < 2; direction++)
      for (int select = 0; select < 3; select++) {
        packing_domain *domain =
            dim == 2 ? test_rectangle(130, 120, 0) : test_box(28, 30, 27, 0);
        packing_psd *psd = test_uniform(0.7, 1.3);
        packing_particles *store = test_store(dim);
        packing_front_def def = front_paper();
        def.direction = (packing_front_direction)direction;
        def.select_particle = (packing_front_select)select;
        def.seed = 40 + (uint64_t)select;
        front_pack(&def, domain, psd, store);
        packing_view v;
        packing_sizes_report sizes;
        packing_particles_view(store, &v);
        packing_sizes_report_init(&sizes);
        assert_true(v.count > 300);
        assert_ok(packing_measure_sizes(NULL, psd, &v, &sizes));
        assert_true(sizes.ks * sqrt((double)v.count) < 2.23);
        packing_particles_destroy(store);
        packing_psd_destroy(psd);
        packing_domain_destroy(domain);
      }
}

/* The orders at random of P_j, P_k and the place give what going through the triples in a random
 * order one after the other gives: mean volume fraction of both ways. A contact method makes the
 * engine go through the triples; |z| < 4 fails by chance with 6e-5. */
static void rings_have_the_law_of_triples(void **state)
{
  (void)state;
  const packing_contact_method triples = {"triples", "", 1,
                                          packing_contact_wrappers()->place, NULL};
  double sum[2] = {0, 0}, square[2] = {0, 0};
  const int packs = 60;
  packing_domain *domain = test_box(9, 9, 9, 7);
  packing_psd *psd = test_uniform(0.7, 1.1);
  for (int pack = 0; pack < packs; pack++)
    for (int way = 0; way < 2; way++) {
      packing_particles *store = test_store(3);
      packing_front_def def = front_paper();
      def.seed = 1000 + (uint64_t)pack;
      def.contact = way == 0 ? NULL : &triples;
      const double v = front_pack(&def, domain, psd, store).volume_fraction;
      sum[way] += v;
      square[way] += v * v;
      packing_particles_destroy(store);
    }
  double variance = 0;
  for (int way = 0; way < 2; way++)
    variance += (square[way] / packs - sum[way] * sum[way] / packs / packs) / (packs - 1);
  assert_true(fabs(sum[0] - sum[1]) / packs < 4 * sqrt(variance));
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sizes_are_those_asked),
      cmocka_unit_test(rings_have_the_law_of_triples),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
