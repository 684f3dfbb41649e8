/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The placers' neighbour structures against all pairs. */
#include "test.h"

#include "place/place_index.h"
#include "place/rsa_cells.h"
#include "place/rsa_children.h"
#include "place/rsa_order.h"

static int brute_free(const packing_domain *domain, const packing_particles *store,
                      packing_vec3 p, double r)
{
  for (size_t i = 0; i < store->count; i++) {
    const packing_vec3 q = {store->x[i], store->y[i], store->z[i]};
    const double touch = r + store->r[i];
    const packing_vec3 s = packing_domain_separation(domain, &p, &q);
    if (s.x * s.x + s.y * s.y + s.z * s.z < touch * touch)
      return 0;
  }
  return 1;
}

static packing_vec3 point_in(packing_rng *rng, double x, double y, double z)
{
  packing_vec3 p;
  p.x = x * packing_rng_uniform(rng);
  p.y = y * packing_rng_uniform(rng);
  p.z = z * packing_rng_uniform(rng);
  return p;
}

/* Radii over three decades, any periodic directions, growing while it is asked. */
static void index_finds_what_all_pairs_find(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 5, PACKING_PURPOSE_USER, 0, &rng));
  for (unsigned periodic = 0; periodic < 8; periodic++) {
    packing_domain *domain = test_box(7.3, 5.1, 6.2, periodic);
    packing_particles *store = test_store(3);
    packing_i_index index;
    packing_i_index_init(&index, NULL, domain, 1.2, periodic % 2 ? 500 : 0);
    size_t free_places = 0;
    for (int i = 0; i < 4000; i++) {
      const packing_vec3 p = point_in(rng, 7.3, 5.1, 6.2);
      const double r = 1.2 * pow(1e-3, packing_rng_uniform(rng));
      const int is_free = brute_free(domain, store, p, r);
      assert_int_equal(packing_i_index_free(&index, p, r), is_free);
      if (!is_free)
        continue;
      free_places++;
      assert_ok(packing_i_index_reserve(&index, 1, r));
      packing_i_index_insert(&index, p, r);
      assert_ok(packing_particles_add(store, p, r, NULL));
    }
    assert_true(free_places > 300 && free_places < 3700);
    packing_i_index_release(&index);
    packing_particles_destroy(store);
    packing_domain_destroy(domain);
  }
  packing_rng_destroy(rng);
}

/* Boxes from one cell to a few, with and without a bound on the number of cells. */
static void cells_find_what_all_pairs_find(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 6, PACKING_PURPOSE_USER, 0, &rng));
  for (unsigned periodic = 0; periodic < 8; periodic++)
    for (int size = 0; size < 4; size++) {
      const double x = 1.1 + 1.7 * size, y = 1.3 + size, z = 1.2 + 0.7 * size;
      packing_domain *domain = test_box(x, y, z, periodic);
      packing_particles *store = test_store(3);
      packing_i_rsa_cells cells = {0};
      assert_ok(packing_i_rsa_cells_init(&cells, NULL, domain, 0.5, size % 2 ? 3 : 0));
      for (int i = 0; i < 2000; i++) {
        const packing_vec3 p = point_in(rng, x, y, z);
        const int is_free = brute_free(domain, store, p, 0.5);
        assert_int_equal(packing_i_rsa_cells_free(&cells, p), is_free);
        if (!is_free)
          continue;
        assert_ok(packing_i_rsa_cells_reserve(&cells, NULL, cells.count + 1));
        packing_i_rsa_cells_insert(&cells, p);
        assert_ok(packing_particles_add(store, p, 0.5, NULL));
      }
      assert_true(packing_particles_count(store) > 0);
      packing_i_rsa_cells_release(&cells, NULL);
      packing_particles_destroy(store);
      packing_domain_destroy(domain);
    }
  packing_rng_destroy(rng);
}

/* The farthest corner of each child, one by one. */
static unsigned brute_covered(const packing_i_rsa_near_centres *near, packing_vec3 c,
                              packing_vec3 h, double reach2)
{
  unsigned covered = 0;
  for (unsigned k = 0; k < 8; k++)
    for (size_t i = 0; i < near->count; i++) {
      double farthest = 0;
      for (unsigned corner = 0; corner < 8; corner++) {
        const double x = c.x + (k & 1U ? h.x : -h.x) + (corner & 1U ? h.x : -h.x);
        const double y = c.y + (k & 2U ? h.y : -h.y) + (corner & 2U ? h.y : -h.y);
        const double z = c.z + (k & 4U ? h.z : -h.z) + (corner & 4U ? h.z : -h.z);
        const double dx = near->x[i] - x, dy = near->y[i] - y, dz = near->z[i] - z;
        farthest = fmax(farthest, dx * dx + dy * dy + dz * dz);
      }
      covered |= (unsigned)(farthest < reach2) << k;
    }
  return covered;
}

/* Every instruction set gives the bits of the plain code, which are those of all corners. */
static void children_are_covered_alike(void **state)
{
  (void)state;
  static packing_i_rsa_near_centres near;
  packing_rng *rng = NULL;
  size_t seen = 0;
  assert_ok(packing_rng_create(NULL, 8, PACKING_PURPOSE_USER, 0, &rng));
  for (int trial = 0; trial < 20000; trial++) {
    near.count = packing_rng_below(rng, 40);
    for (size_t i = 0; i < near.count; i++) {
      const packing_vec3 p = point_in(rng, 3, 3, 3);
      near.x[i] = p.x - 1;
      near.y[i] = p.y - 1;
      near.z[i] = p.z - 1;
    }
    const packing_vec3 centre = point_in(rng, 1, 1, 1);
    const double edge = pow(0.5, 1 + (int)packing_rng_below(rng, 5));
    const packing_vec3 h = {edge / 2, edge / 2.1, trial % 5 == 0 ? 0 : edge / 1.9};
    const unsigned covered =
        packing_i_rsa_children_for(PACKING_ISA_BASELINE)(&near, centre, h, 1.0, 0);
    assert_int_equal(covered, brute_covered(&near, centre, h, 1.0));
    for (int isa = PACKING_ISA_AVX2; isa < PACKING_ISA_END; isa++)
      if (packing_isa_available((packing_isa)isa))
        assert_int_equal(
            packing_i_rsa_children_for((packing_isa)isa)(&near, centre, h, 1.0, 0),
            covered);
    seen += covered != 0 && covered != 0xff;
  }
  assert_true(seen > 1000);
  packing_rng_destroy(rng);
}

/* Times with many ties, against a plain insertion sort. */
static void candidates_are_ordered_by_time(void **state)
{
  (void)state;
  packing_rng *rng = NULL;
  packing_i_rsa_candidate c[64];
  uint32_t sorted[64], order[64];
  assert_ok(packing_rng_create(NULL, 9, PACKING_PURPOSE_USER, 0, &rng));
  for (int trial = 0; trial < 2000; trial++) {
    const size_t n = 1 + packing_rng_below(rng, 64);
    for (size_t i = 0; i < n; i++) {
      c[i].time = packing_rng_below(rng, 20);
      size_t at = i;
      for (; at > 0 && c[sorted[at - 1]].time > c[i].time; at--)
        sorted[at] = sorted[at - 1];
      sorted[at] = (uint32_t)i;
      order[i] = (uint32_t)i;
    }
    const size_t first = packing_rng_below(rng, n + 1);
    packing_i_rsa_select_by_time(c, order, n, first);
    packing_i_rsa_sort_by_time(c, order, first);
    assert_memory_equal(order, sorted, first * sizeof *order);
    packing_i_rsa_sort_by_time(c, order, n);
    assert_memory_equal(order, sorted, n * sizeof *order);
  }
  packing_rng_destroy(rng);
}

/* A few particles in a huge container: memory goes with particles, not with volume. */
static void memory_goes_with_particles(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  packing_domain *domain = test_box(1e7, 1e7, 1e7, 0);
  packing_psd *psds[] = {test_mono(0.5), test_uniform(0.3, 0.5)};
  for (int k = 0; k < 2; k++) {
    packing_particles *store = NULL;
    packing_placer *placer = NULL;
    packing_rsa_def def;
    packing_rsa_def_init(&def);
    def.count = 1000;
    assert_ok(packing_particles_create(context, NULL, &store));
    assert_ok(packing_rsa_create(context, &def, domain, psds[k], store, &placer));
    assert_int_equal(test_run(placer).placed, 1000);
    assert_true(a.peak < 4 << 20);
    packing_placer_destroy(placer);
    packing_particles_destroy(store);
    packing_psd_destroy(psds[k]);
  }
  packing_domain_destroy(domain);
  packing_context_destroy(context);
  assert_int_equal(a.live, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(index_finds_what_all_pairs_find),
      cmocka_unit_test(cells_find_what_all_pairs_find),
      cmocka_unit_test(children_are_covered_alike),
      cmocka_unit_test(candidates_are_ordered_by_time),
      cmocka_unit_test(memory_goes_with_particles),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
