/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of random sequential addition. Each check fails by chance with probability below 1e-4
 * (|z| < 4 for a normal statistic); the seeds are fixed, so a failure is a change of the code. */
#include "test.h"

/* One dart after the other against all that stand: the slow obvious way. Periodic square (dim 2)
 * or cube; gives up after `patience` refusals in a row. */
static size_t naive(packing_rng *rng, int dim, double edge, size_t most, size_t patience,
                    double (*at)[3])
{
  size_t n = 0;
  for (size_t refused = 0; n < most && refused < patience;) {
    double p[3] = {0, 0, 0};
    for (int k = 0; k < dim; k++)
      p[k] = edge * packing_rng_uniform(rng);
    int hit = 1;
    for (size_t i = 0; i < n && hit; i++) {
      double d2 = 0;
      for (int k = 0; k < dim; k++) {
        double d = fabs(p[k] - at[i][k]);
        d = d > edge / 2 ? edge - d : d;
        d2 += d * d;
      }
      hit = d2 >= 1;
    }
    refused = hit ? 0 : refused + 1;
    if (hit)
      memcpy(at[n++], p, sizeof p);
  }
  return n;
}

/* Mean distance to the nearest neighbour. */
static double nearest(size_t n, int dim, double edge, double (*at)[3])
{
  double sum = 0;
  for (size_t i = 0; i < n; i++) {
    double least = INFINITY;
    for (size_t j = 0; j < n; j++) {
      double d2 = 0;
      for (int k = 0; k < dim; k++) {
        double d = fabs(at[i][k] - at[j][k]);
        d = d > edge / 2 ? edge - d : d;
        d2 += d * d;
      }
      if (i != j && d2 < least)
        least = d2;
    }
    sum += sqrt(least);
  }
  return sum / (double)n;
}

static size_t ours(uint64_t stream, int dim, double edge, size_t count, double (*at)[3])
{
  packing_domain *domain =
      dim == 2 ? test_rectangle(edge, edge, 3) : test_box(edge, edge, edge, 7);
  packing_psd *psd = test_mono(0.5);
  packing_particles *store = test_store(dim);
  packing_placer *placer = NULL;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.stream = stream;
  def.count = count;
  assert_ok(packing_rsa_create(NULL, &def, domain, psd, store, &placer));
  test_run(placer);
  const size_t n = packing_particles_count(store);
  for (int k = 0; k < 3; k++)
    assert_ok(
        packing_particles_extract(store, (packing_field)k, &at[0][k], sizeof at[0]));
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  return n;
}

typedef struct sums {
  double n, sum, squares;
} sums;

static void add(sums *s, double v)
{
  s->n += 1;
  s->sum += v;
  s->squares += v * v;
}

static double mean(const sums *s)
{
  return s->sum / s->n;
}

static double variance_of_mean(const sums *s)
{
  return (s->squares / s->n - mean(s) * mean(s)) / (s->n - 1);
}

static double z_of(const sums *a, const sums *b)
{
  return (mean(a) - mean(b)) / sqrt(variance_of_mean(a) + variance_of_mean(b));
}

/* Rounds ordered by space give the packs of darts one by one: nearest neighbours at a fixed
 * count, where rounds are settled often. */
static void rounds_have_the_law_of_single_darts(void **state)
{
  (void)state;
  static double at[400][3];
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 77, PACKING_PURPOSE_USER, 0, &rng));
  sums reference = {0}, fast = {0};
  for (uint64_t pack = 0; pack < 400; pack++) {
    size_t n = naive(rng, 3, 5.0, 55, SIZE_MAX, at);
    add(&reference, nearest(n, 3, 5.0, at));
    n = ours(pack, 3, 5.0, 55, at);
    add(&fast, nearest(n, 3, 5.0, at));
  }
  assert_true(fabs(z_of(&reference, &fast)) < 4);
  packing_rng_destroy(rng);
}

/* Counts at saturation in a small cell; the slow way gives up late enough to miss less than one
 * disc in a thousand packs. */
static void saturated_counts_have_the_law_of_single_darts(void **state)
{
  (void)state;
  static double at[400][3];
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, 78, PACKING_PURPOSE_USER, 0, &rng));
  sums reference = {0}, fast = {0}, reference_near = {0}, fast_near = {0};
  for (uint64_t pack = 0; pack < 300; pack++) {
    size_t n = naive(rng, 2, 5.0, 400, 60000, at);
    add(&reference, (double)n);
    add(&reference_near, nearest(n, 2, 5.0, at));
    n = ours(pack, 2, 5.0, 0, at);
    add(&fast, (double)n);
    add(&fast_near, nearest(n, 2, 5.0, at));
  }
  assert_true(fabs(z_of(&reference, &fast)) < 4);
  assert_true(fabs(z_of(&reference_near, &fast_near)) < 4);
  packing_rng_destroy(rng);
}

/* Zhang and Torquato 2013: 0.5470735(28) and 0.3841307(21); the scatter of a pack of N is about
 * 0.2 / sqrt N of the fraction (0.12 / sqrt N measured here), 4 sd are allowed. */
static void large_cells_saturate_at_the_known_fraction(void **state)
{
  (void)state;
  packing_psd *psd = test_mono(0.5);
  for (int dim = 2; dim <= 3; dim++) {
    packing_domain *domain =
        dim == 2 ? test_rectangle(150, 150, 3) : test_box(28, 28, 28, 7);
    packing_particles *store = test_store(dim);
    packing_placer *placer = NULL;
    assert_ok(packing_rsa_create(NULL, NULL, domain, psd, store, &placer));
    const packing_placer_report report = test_run(placer);
    const double known = dim == 2 ? 0.5470735 : 0.3841307;
    assert_int_equal(report.state, PACKING_PLACER_SATURATED);
    assert_near(report.volume_fraction, known,
                4 * 0.2 * known / sqrt((double)report.placed));
    packing_placer_destroy(placer);
    packing_particles_destroy(store);
    packing_domain_destroy(domain);
  }
  packing_psd_destroy(psd);
}

/* Close to what can be placed, the sizes are still those asked. KS: D sqrt N <
 * 2.23 (1e-4). */
static void sizes_are_those_asked(void **state)
{
  (void)state;
  packing_domain *domain = test_box(24, 24, 24, 7);
  packing_psd *psd = test_uniform(0.3, 0.7);
  for (int order = 0; order < 2; order++) {
    packing_particles *store = test_store(3);
    packing_placer *placer = NULL;
    packing_rsa_def def;
    packing_rsa_def_init(&def);
    def.volume_fraction = order == PACKING_ORDER_DRAWN ? 0.29 : 0.35;
    def.order = (packing_order)order;
    assert_ok(packing_rsa_create(NULL, &def, domain, psd, store, &placer));
    assert_int_equal(test_run(placer).state, PACKING_PLACER_DONE);
    packing_view v;
    packing_sizes_report sizes;
    packing_particles_view(store, &v);
    packing_sizes_report_init(&sizes);
    assert_ok(packing_measure_sizes(NULL, psd, &v, &sizes));
    assert_true(sizes.ks * sqrt((double)v.count) < 2.23);
    packing_placer_destroy(placer);
    packing_particles_destroy(store);
  }
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rounds_have_the_law_of_single_darts),
      cmocka_unit_test(saturated_counts_have_the_law_of_single_darts),
      cmocka_unit_test(large_cells_saturate_at_the_known_fraction),
      cmocka_unit_test(sizes_are_those_asked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
