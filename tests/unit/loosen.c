/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loosening: the fraction is met, what goes is a fair sample of sizes and of places. */
#include "psds.h"

static packing_loosen_def options(packing_loosen_how how, double fraction, uint64_t seed)
{
  packing_loosen_def def;
  packing_loosen_def_init(&def);
  assert_int_equal(def.how, PACKING_LOOSEN_SHRINK);
  assert_true(def.volume_fraction == 0 && def.seed == 1 && def.stream == 0);
  def.how = how;
  def.volume_fraction = fraction;
  def.seed = seed;
  return def;
}

static double ball(int dim, double r)
{
  return dim == 2 ? acos(-1) * r * r : 4 * acos(-1) / 3 * r * r * r;
}

static double radius(const packing_particles *store, size_t i)
{
  packing_view v;
  packing_particles_view(store, &v);
  return *(const double *)((const char *)v.r.data + i * v.r.stride);
}

static double fraction_of(const packing_domain *domain, const packing_particles *store)
{
  double sum = 0;
  for (size_t i = 0; i < packing_particles_count(store); i++)
    sum += ball(packing_particles_dim(store), radius(store, i));
  return sum / packing_domain_volume(domain);
}

/* `count` particles anywhere, of any law; their ids are their indices. */
static packing_particles *anywhere(packing_psd *psd, int dim, size_t count)
{
  packing_particles_def def;
  packing_particles *store = NULL;
  packing_rng *rng = NULL;
  packing_particles_def_init(&def);
  def.dim = dim;
  def.columns = PACKING_COLUMN_ID;
  assert_ok(packing_particles_create(NULL, &def, &store));
  assert_ok(packing_rng_create(NULL, 5, PACKING_PURPOSE_USER, 0, &rng));
  for (size_t i = 0; i < count; i++) {
    const packing_vec3 centre = {packing_rng_uniform(rng), packing_rng_uniform(rng), 0};
    const double r = packing_psd_draw(psd, rng, NULL);
    assert_ok(packing_particles_add(store, centre, r, NULL));
  }
  packing_rng_destroy(rng);
  return store;
}

static packing_particles *copy(const packing_particles *store)
{
  packing_particles_def def;
  packing_particles *other = NULL;
  packing_view view;
  packing_particles_def_init(&def);
  def.dim = packing_particles_dim(store);
  def.columns = packing_particles_columns(store);
  assert_ok(packing_particles_create(NULL, &def, &other));
  packing_particles_view(store, &view);
  assert_ok(packing_particles_assign(other, &view));
  return other;
}

/* gone[id] = 1 for particles that `after` lacks; the rest are in order and unchanged. */
static size_t find_gone(const packing_particles *before, const packing_particles *after,
                        unsigned char *gone)
{
  packing_view a, b;
  packing_particles_view(before, &a);
  packing_particles_view(after, &b);
  memset(gone, 1, a.count);
  int64_t last = -1;
  for (size_t i = 0; i < b.count; i++) {
    const int64_t id = *(const int64_t *)((const char *)b.id.data + i * b.id.stride);
    assert_true(id > last);
    last = id;
    gone[id] = 0;
    assert_true(radius(before, (size_t)id) == radius(after, i));
  }
  return a.count - b.count;
}

/* Random sequential addition stands for a pack; 5 %, 2.3 % and 1.2 % solids. */
static void figure_12(void **state)
{
  (void)state;
  static const double fractions[] = {0.05, 0.023, 0.012};
  packing_domain *domain = test_box(30, 30, 30, 0);
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_particles *pack = test_store(3);
  packing_placer *placer = NULL;
  packing_rsa_def rsa;
  packing_rsa_def_init(&rsa);
  rsa.volume_fraction = 0.25;
  assert_ok(packing_particles_add_columns(pack, PACKING_COLUMN_ID));
  assert_ok(packing_rsa_create(NULL, &rsa, domain, psd, pack, &placer));
  assert_int_equal(test_run(placer).state, PACKING_PLACER_DONE);
  packing_placer_destroy(placer);
  for (size_t k = 0; k < 3; k++)
    for (int how = 0; how < 2; how++) {
      packing_particles *store = copy(pack);
      const packing_loosen_def def =
          options((packing_loosen_how)how, fractions[k], 1 + k);
      double reached = -1;
      assert_ok(packing_loosen(NULL, &def, domain, store, &reached));
      assert_close(reached, fraction_of(domain, store), 1e-13);
      if (how == PACKING_LOOSEN_SHRINK) {
        assert_close(reached, fractions[k], 1e-14);
        assert_int_equal(packing_particles_count(store), packing_particles_count(pack));
      } else {
        assert_near(reached, fractions[k], ball(3, 0.7) / 2 / 27000);
        const double share = (double)packing_particles_count(store) /
                             (double)packing_particles_count(pack);
        assert_close(share, fractions[k] / 0.25, 0.1);
      }
      packing_view view;
      packing_particles_view(store, &view);
      assert_true(test_brute_overlap(NULL, &view) <= 0);
      packing_particles_destroy(store);
    }
  packing_particles_destroy(pack);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void shrinking_keeps_all_but_the_radii(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    packing_psd *psd = test_psd(TEST_PSD_LOGNORMAL, 0.01, PACKING_BY_NUMBER, dim);
    packing_domain *domain = dim == 2 ? test_rectangle(1, 1, 0) : test_box(1, 1, 1, 0);
    packing_particles *before = anywhere(psd, dim, 500), *after = copy(before);
    const double wanted = 0.37 * fraction_of(domain, before);
    const packing_loosen_def def = options(PACKING_LOOSEN_SHRINK, wanted, 1);
    double reached = 0;
    assert_ok(packing_loosen(NULL, &def, domain, after, &reached));
    assert_close(reached, wanted, 1e-14);
    packing_view a, b;
    packing_particles_view(before, &a);
    packing_particles_view(after, &b);
    assert_int_equal(a.count, b.count);
    assert_memory_equal(a.x.data, b.x.data, a.count * sizeof(double));
    assert_memory_equal(a.y.data, b.y.data, a.count * sizeof(double));
    assert_memory_equal(a.id.data, b.id.data, a.count * sizeof(int64_t));
    for (size_t i = 0; i < a.count; i++)
      assert_close(radius(after, i), radius(before, i) * pow(0.37, 1. / dim), 1e-14);
    packing_particles_destroy(before);
    packing_particles_destroy(after);
    packing_psd_destroy(psd);
    packing_domain_destroy(domain);
  }
}

static int rising(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The most by which the number gone up to any radius differs from the share of those there. */
static double unfairness(const packing_particles *store, const unsigned char *gone)
{
  const size_t n = packing_particles_count(store);
  struct {
    double r;
    size_t index;
  } *sorted = malloc(n * sizeof *sorted);
  assert_non_null(sorted);
  double all = 0, sum = 0, worst = 0;
  for (size_t i = 0; i < n; i++) {
    sorted[i].r = radius(store, i);
    sorted[i].index = i;
    all += gone[i];
  }
  qsort(sorted, n, sizeof *sorted, rising);
  for (size_t i = 0; i < n; i++) {
    sum += gone[sorted[i].index];
    if (i + 1 == n || sorted[i + 1].r > sorted[i].r)
      worst = fmax(worst, fabs(sum - all * (double)(i + 1) / (double)n));
  }
  free(sorted);
  return worst;
}

/* The bounds hold for every seed. A sample by chance would be out by about sqrt(N) / 4 = 35. */
static void removing_keeps_the_distribution(void **state)
{
  (void)state;
  enum { N = 20000 };
  static unsigned char gone[N];
  static const double shares[] = {0.97, 0.5, 0.31, 0.04};
  packing_domain *domain = test_box(1, 1, 1, 0);
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++) {
    packing_psd *psd = test_psd(kind, 0.01, PACKING_BY_NUMBER, 3);
    packing_particles *before = anywhere(psd, 3, N);
    const int smooth = packing_psd_min_r(psd) < packing_psd_max_r(psd) &&
                       kind != TEST_PSD_DISCRETE && kind != TEST_PSD_SAMPLE;
    for (size_t k = 0; k < 4; k++) {
      packing_particles *after = copy(before);
      const double wanted = shares[k] * fraction_of(domain, before);
      const packing_loosen_def def = options(PACKING_LOOSEN_REMOVE, wanted, 3);
      double reached = 0;
      assert_ok(packing_loosen(NULL, &def, domain, after, &reached));
      find_gone(before, after, gone);
      const double r = smooth ? packing_psd_min_r(psd) * 1.2 : packing_psd_max_r(psd);
      assert_near(reached, wanted, ball(3, r) * 0.5000001);
      const double worst = unfairness(before, gone);
      if (worst > (smooth ? 5 : 18))
        fail_msg("%s, %g: %g", test_psd_name(kind), shares[k], worst);
      packing_particles_destroy(after);
    }
    packing_particles_destroy(before);
    packing_psd_destroy(psd);
  }
  packing_domain_destroy(domain);
}

/* Equal spheres on a cubic lattice, 3 in 10 removed: halves lose alike, and neighbours are both
 * gone as often as chance has it. 4.5 standard deviations: seven in a million, 14 tests a seed. */
static void removing_is_even_in_space(void **state)
{
  (void)state;
  enum { EDGE = 16, N = EDGE * EDGE * EDGE };
  static unsigned char gone[N];
  packing_domain *domain = test_box(EDGE, EDGE, EDGE, 0);
  packing_particles *before = test_store(3);
  assert_ok(packing_particles_add_columns(before, PACKING_COLUMN_ID));
  for (int i = 0; i < N; i++) {
    const packing_vec3 centre = {i % EDGE + .5, i / EDGE % EDGE + .5,
                                 (double)(i / EDGE / EDGE) + .5};
    assert_ok(packing_particles_add(before, centre, 0.5, NULL));
  }
  for (uint64_t seed = 1; seed <= 4; seed++) {
    packing_particles *after = copy(before);
    const packing_loosen_def def =
        options(PACKING_LOOSEN_REMOVE, 0.7 * fraction_of(domain, before), seed);
    assert_ok(packing_loosen(NULL, &def, domain, after, NULL));
    const double n = (double)find_gone(before, after, gone), p = n / N;
    assert_near(n, 0.3 * N, 1);
    for (int bit = 0; bit < 12; bit++) { /* halves of x, y, z: coarse to every other */
      double half = 0;
      for (int i = 0; i < N; i++)
        half += gone[i] * (i >> bit & 1);
      assert_near(half, n / 2, 4.5 * sqrt(n * (1 - p) / 4));
    }
    double both = 0;
    for (int i = 0; i + 1 < N; i++)
      both += gone[i] && gone[i + 1];
    assert_near(both, p * p * N, 4.5 * sqrt(N) * p * (1 - p));
    double rows = 0;
    for (int i = 0; i + EDGE < N; i++)
      rows += gone[i] && gone[i + EDGE];
    assert_near(rows, p * p * (N - EDGE), 4.5 * sqrt(N) * p * (1 - p));
    packing_particles_destroy(after);
  }
  packing_particles_destroy(before);
  packing_domain_destroy(domain);
}

/* Packs of a few particles of very different sizes: the fraction is never out by more than the
 * largest. */
static void the_largest_bounds_the_error(void **state)
{
  (void)state;
  packing_domain *domain = test_box(10, 10, 10, 0);
  packing_psd *psds[3] = {test_psd(TEST_PSD_DISCRETE, 1, PACKING_BY_MASS, 3),
                          test_psd(TEST_PSD_GAMMA, 1, PACKING_BY_NUMBER, 3),
                          test_mono(1)};
  for (size_t n = 1; n < 60; n++)
    for (uint64_t seed = 0; seed < 30; seed++) {
      packing_particles *store = anywhere(psds[seed % 3], 3, n);
      double largest = 0;
      for (size_t i = 0; i < n; i++)
        largest = fmax(largest, ball(3, radius(store, i)));
      const double wanted = fraction_of(domain, store) * (double)(seed + 1) / 31.0000001;
      const packing_loosen_def def = options(PACKING_LOOSEN_REMOVE, wanted, seed);
      double reached = -1;
      assert_ok(packing_loosen(NULL, &def, domain, store, &reached));
      assert_near(reached, wanted, largest / 1000 * (seed % 3 == 2 ? 0.5000001 : 1));
      packing_particles_destroy(store);
    }
  for (size_t k = 0; k < 3; k++)
    packing_psd_destroy(psds[k]);
  packing_domain_destroy(domain);
}

static void seeds_and_streams(void **state)
{
  (void)state;
  enum { N = 300 };
  packing_domain *domain = test_box(1, 1, 1, 0);
  packing_psd *psd = test_uniform(0.01, 0.02);
  packing_particles *before = anywhere(psd, 3, N);
  uint64_t hash[4];
  for (uint64_t k = 0; k < 4; k++) {
    packing_particles *after = copy(before);
    packing_loosen_def def =
        options(PACKING_LOOSEN_REMOVE, 0.5 * fraction_of(domain, before), 1 + (k == 1));
    def.stream = k == 2;
    assert_ok(packing_loosen(NULL, &def, domain, after, NULL));
    hash[k] = test_hash_particles(after);
    packing_particles_destroy(after);
  }
  assert_true(hash[0] == hash[3]);
  assert_true(hash[0] != hash[1] && hash[1] != hash[2] && hash[2] != hash[0]);
  packing_particles_destroy(before);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void columns_are_kept(void **state)
{
  (void)state;
  packing_domain *domain = test_box(1, 1, 1, 0);
  packing_psd *psd = test_uniform(0.01, 0.02);
  packing_particles *store = anywhere(psd, 3, 200);
  double *mine = NULL;
  assert_ok(packing_particles_add_user_column(store, "mine"));
  assert_ok(packing_particles_user_column(store, "mine", &mine));
  for (size_t i = 0; i < 200; i++)
    mine[i] = 2.5 * (double)i;
  const packing_loosen_def def =
      options(PACKING_LOOSEN_REMOVE, 0.4 * fraction_of(domain, store), 1);
  assert_ok(packing_loosen(NULL, &def, domain, store, NULL));
  assert_ok(packing_particles_user_column(store, "mine", &mine));
  int64_t id[200];
  assert_ok(packing_particles_extract(store, PACKING_FIELD_ID, id, sizeof *id));
  assert_in_range(packing_particles_count(store), 60, 100);
  for (size_t i = 0; i < packing_particles_count(store); i++)
    assert_true(mine[i] == 2.5 * (double)id[i]);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

/* The pack's own fraction, as somebody else added it up, leaves it as it is. */
static void nothing_to_do(void **state)
{
  (void)state;
  packing_domain *domain = test_box(1, 1, 1, 0);
  packing_psd *psd = test_uniform(0.01, 0.02);
  packing_particles *store = anywhere(psd, 3, 200);
  const uint64_t hash = test_hash_particles(store);
  for (int how = 0; how < 2; how++) {
    const packing_loosen_def def =
        options((packing_loosen_how)how, fraction_of(domain, store) * (1 + 1e-13), 1);
    double reached = 0;
    assert_ok(packing_loosen(NULL, &def, domain, store, &reached));
    assert_close(reached, def.volume_fraction, 2e-13);
    assert_true(test_hash_particles(store) == hash);
  }
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
}

static void scaling_by_powers_of_two_changes_no_bit(void **state)
{
  (void)state;
  enum { N = 400 };
  static double r[2][N];
  for (int how = 0; how < 2; how++) {
    size_t count[2];
    for (int k = 0; k < 2; k++) {
      const double unit = k == 0 ? 1 : 0x1p-60;
      packing_domain *domain = test_box(unit, unit, unit, 0);
      packing_psd *psd = test_psd(TEST_PSD_WEIBULL, 0.01 * unit, PACKING_BY_NUMBER, 3);
      packing_particles *store = anywhere(psd, 3, N);
      const packing_loosen_def def = options((packing_loosen_how)how, 1e-4, 1);
      double reached = 0;
      assert_ok(packing_loosen(NULL, &def, domain, store, &reached));
      count[k] = packing_particles_count(store);
      for (size_t i = 0; i < count[k]; i++)
        r[k][i] = radius(store, i) / unit;
      packing_particles_destroy(store);
      packing_psd_destroy(psd);
      packing_domain_destroy(domain);
    }
    assert_int_equal(count[0], count[1]);
    assert_memory_equal(r[0], r[1], count[0] * sizeof(double));
  }
}

/* Each refusal names its field, and neither the pack nor the result changes. */
static void refusals(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = test_box(1, 1, 1, 0), *flat = test_rectangle(1, 1, 0);
  packing_psd *psd = test_uniform(0.01, 0.02);
  packing_particles *store = anywhere(psd, 3, 50), *empty = test_store(3);
  const uint64_t hash = test_hash_particles(store);
  const double have = fraction_of(domain, store);
  const struct {
    int how;
    double fraction;
    packing_status status;
    const char *field;
  } bad[] = {
      {0, 0, PACKING_ERR_RANGE, "volume_fraction"},
      {1, -0.1, PACKING_ERR_RANGE, "volume_fraction"},
      {0, NAN, PACKING_ERR_INVALID, "volume_fraction"},
      {1, INFINITY, PACKING_ERR_INVALID, "volume_fraction"},
      {0, have * 1.001, PACKING_ERR_RANGE, "volume_fraction"},
      {1, have * 1.001, PACKING_ERR_RANGE, "volume_fraction"},
      {2, have / 2, PACKING_ERR_RANGE, "how"},
      {-1, have / 2, PACKING_ERR_RANGE, "how"},
  };
  double reached = 7;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    const packing_loosen_def def =
        options((packing_loosen_how)bad[i].how, bad[i].fraction, 1);
    assert_fails(c, packing_loosen(c, &def, domain, store, &reached), bad[i].status,
                 bad[i].field);
    assert_status(packing_loosen(NULL, &def, domain, store, NULL), bad[i].status);
  }
  packing_loosen_def def = options(PACKING_LOOSEN_REMOVE, have / 2, 1);
  assert_fails(c, packing_loosen(c, NULL, domain, store, &reached), PACKING_ERR_INVALID,
               "def");
  assert_fails(c, packing_loosen(c, &def, NULL, store, &reached), PACKING_ERR_INVALID,
               "domain");
  assert_fails(c, packing_loosen(c, &def, domain, NULL, &reached), PACKING_ERR_INVALID,
               "particles");
  assert_fails(c, packing_loosen(c, &def, flat, store, &reached), PACKING_ERR_RANGE,
               "particles");
  assert_fails(c, packing_loosen(c, &def, domain, empty, &reached), PACKING_ERR_RANGE,
               "volume_fraction");
  def.struct_size = 3;
  assert_status(packing_loosen(c, &def, domain, store, &reached), PACKING_ERR_ABI);
  assert_true(test_hash_particles(store) == hash);
  assert_true(reached == 7);
  packing_particles_destroy(store);
  packing_particles_destroy(empty);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  packing_domain_destroy(flat);
  packing_context_destroy(c);
}

/* A radius that would no longer be a normal number. */
static void a_radius_must_not_vanish(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = test_box(1, 1, 1, 0);
  packing_particles *store = test_store(3);
  const packing_vec3 centre = {0.5, 0.5, 0.5};
  assert_ok(packing_particles_add(store, centre, 0.1, NULL));
  assert_ok(packing_particles_add(store, centre, 1e-280, NULL));
  packing_loosen_def def = options(PACKING_LOOSEN_SHRINK, 1e-90, 1);
  assert_fails(c, packing_loosen(c, &def, domain, store, NULL), PACKING_ERR_RANGE,
               "volume_fraction");
  assert_true(radius(store, 0) == 0.1 && radius(store, 1) == 1e-280);
  packing_particles_destroy(store);
  packing_domain_destroy(domain);
  packing_context_destroy(c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(figure_12),
      cmocka_unit_test(shrinking_keeps_all_but_the_radii),
      cmocka_unit_test(removing_keeps_the_distribution),
      cmocka_unit_test(removing_is_even_in_space),
      cmocka_unit_test(the_largest_bounds_the_error),
      cmocka_unit_test(seeds_and_streams),
      cmocka_unit_test(columns_are_kept),
      cmocka_unit_test(nothing_to_do),
      cmocka_unit_test(scaling_by_powers_of_two_changes_no_bit),
      cmocka_unit_test(refusals),
      cmocka_unit_test(a_radius_must_not_vanish),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
