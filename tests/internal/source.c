/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The front's source of radii. Draws by strata have a bound on their error that holds for every
 * seed, so that most tests here have no false alarms. */
#include "psds.h"
#include "place/source_strata.h"
#include "place/source_zone.h"

enum { DRAWS = 20000 };

static int rising(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* See source_strata.h. */
static double bound(size_t n)
{
  return PACKING_I_STRATA / 4. + 4 + 3.6 * log(1 + (double)n / PACKING_I_STRATA);
}

/* Of the draws of a law, by its parts: what two numbers make, a whole round more. */
static double bound_of(const packing_psd *psd, size_t n)
{
  const size_t parts = packing_psd_components(psd);
  if (parts > 1)
    return 3 * (double)parts * bound(n);
  return bound(n) + 1e-3 + (psd->ops->numbers > 1 ? PACKING_I_STRATA : 0);
}

static packing_i_source *make(const packing_front_def *def, packing_psd *psd,
                              size_t stock)
{
  packing_i_source *source = NULL;
  assert_ok(packing_i_source_create(NULL, def, psd, stock, &source));
  assert_non_null(source);
  return source;
}

static packing_i_source *of_psd(packing_psd *psd, size_t stock, uint64_t seed)
{
  packing_front_def def = {.seed = 1};
  def.seed = seed;
  return make(&def, psd, stock);
}

/* The most by which the number of radii up to any r differs from its share of the law. */
static double excess(const packing_psd *psd, double *r, size_t count)
{
  double worst = 0;
  const double n = (double)count;
  qsort(r, count, sizeof *r, rising);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && r[end] == r[i];)
      end++;
    const double upto = packing_psd_cdf(psd, PACKING_BY_NUMBER, r[i]);
    const double below = packing_psd_cdf(psd, PACKING_BY_NUMBER, nextafter(r[i], 0));
    worst = fmax(worst, fabs((double)end - n * upto));
    worst = fmax(worst, fabs((double)i - n * below));
  }
  return worst;
}

/* Against insertion; wide and narrow ranges, and equal radii, which keep their order. */
static void ranks_are_sorted(void **state)
{
  (void)state;
  enum { MOST = 300 };
  static const double width[] = {0, 1e-15, 0.6, 700};
  packing_i_rank got[MOST], want[MOST], spare[MOST];
  for (size_t w = 0; w < 4; w++)
    for (size_t n = 0; n <= MOST; n += 1 + n / 2) {
      for (size_t i = 0; i < n; i++) {
        got[i] = (packing_i_rank){exp(width[w] * ((double)(i * 37 % 101) / 101 - .5)), i};
        size_t k = i;
        for (; k > 0 && want[k - 1].r > got[i].r; k--)
          want[k] = want[k - 1];
        want[k] = got[i];
      }
      packing_i_ranks_sort(got, spare, n);
      for (size_t i = 0; i < n; i++)
        assert_true(got[i].r == want[i].r && got[i].index == want[i].index);
    }
}

static void strata_keep_to_their_bound(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 5; seed++) {
    static double u[DRAWS];
    packing_i_strata s;
    packing_i_strata_open(&s, seed, 0, 0);
    unsigned char seen[PACKING_I_STRATA] = {0};
    for (size_t i = 0; i < DRAWS; i++) {
      u[i] = packing_i_strata_uniform_open(&s);
      assert_true(u[i] > 0 && u[i] < 1);
      if (i < PACKING_I_STRATA)
        seen[(size_t)(u[i] * PACKING_I_STRATA)]++;
    }
    for (size_t k = 0; k < PACKING_I_STRATA; k++)
      assert_int_equal(seen[k], 1);
    static double sorted[DRAWS];
    for (size_t n = 1; n <= DRAWS; n += 1 + n / 3) {
      memcpy(sorted, u, n * sizeof *u);
      qsort(sorted, n, sizeof *sorted, rising);
      for (size_t i = 0; i < n; i++) {
        assert_true(fabs((double)(i + 1) - (double)n * sorted[i]) < bound(n));
        assert_true(fabs((double)i - (double)n * sorted[i]) < bound(n));
      }
    }
  }
}

/* The number after a number is as good as chance: over the rounds its stratum is uniform but for
 * the one just taken. Chi-squared over 8 x 8 cells, 49 degrees of freedom and a little less:
 * 95 is passed once in 10000 tests of independent numbers. */
static void neighbours_are_independent(void **state)
{
  (void)state;
  packing_i_strata s;
  packing_i_strata_open(&s, 3, 0, 0);
  double cell[8][8] = {{0}}, sum = 0;
  for (size_t i = 0; i < DRAWS; i++) {
    const size_t a = (size_t)(8 * packing_i_strata_uniform_open(&s));
    const size_t b = (size_t)(8 * packing_i_strata_uniform_open(&s));
    cell[a][b]++;
  }
  for (size_t a = 0; a < 8; a++)
    for (size_t b = 0; b < 8; b++) {
      /* 7 of the other 63 strata lie in the same eighth */
      const double want = DRAWS / 8. * (a == b ? 7 : 8) / 63;
      sum += (cell[a][b] - want) * (cell[a][b] - want) / want;
    }
  assert_true(sum < 95);
}

/* Whole, and part by part for a mixture, whatever the law counts. */
static void draws_keep_to_the_law(void **state)
{
  (void)state;
  static double r[DRAWS], part[DRAWS];
  static size_t component[DRAWS];
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++)
    for (int variant = 0; variant < 2; variant++) {
      packing_psd *psd = variant == 0 ? test_psd(kind, 1, PACKING_BY_NUMBER, 3)
                                      : test_psd(kind, 1, PACKING_BY_MASS, 2);
      packing_i_source *source = of_psd(psd, 1, 7);
      for (size_t i = 0; i < DRAWS; i++)
        assert_true(packing_i_source_next(source, 0, &r[i], &component[i]));
      const size_t parts = packing_psd_components(psd);
      for (size_t c = 0; c < parts; c++) {
        size_t count = 0;
        for (size_t i = 0; i < DRAWS; i++)
          if (component[i] == c)
            part[count++] = r[i];
        const double share = packing_i_psd_part_share(psd, PACKING_BY_NUMBER, c);
        assert_true(fabs((double)count - share * DRAWS) < 2 * bound(DRAWS));
        assert_true(excess(packing_i_psd_part(psd, c), part, count) <
                    bound(count) + 1e-3);
      }
      assert_true(excess(psd, r, DRAWS) < bound_of(psd, DRAWS));
      packing_i_source_destroy(source);
      packing_psd_destroy(psd);
    }
}

static void check_stock(const packing_i_stock *stock, double max_r)
{
  size_t held[PACKING_I_STOCK_BINS] = {0}, sum = 0;
  double due = 0, total = 0;
  for (size_t i = 0; i < stock->count; i++) {
    assert_true(i == 0 || stock->r[i - 1] <= stock->r[i]);
    held[packing_i_stock_bin(stock, stock->r[i])]++;
    assert_int_equal(packing_i_stock_below(stock, nextafter(stock->r[i], 0)) <= i, 1);
    assert_true(packing_i_stock_below(stock, stock->r[i]) > i);
  }
  for (size_t b = 0; b < PACKING_I_STOCK_BINS; b++) {
    assert_int_equal(held[b], stock->held[b]);
    assert_true(stock->due[b] == 0 || stock->due[b] >= 1. / 64);
    assert_true(stock->due[b] > 0 || stock->held[b] == 0);
    assert_true(b == 0 || stock->edge[b - 1] <= stock->edge[b]);
    sum += stock->held[b];
    due += stock->due[b];
    if (stock->due[b] > 0)
      total += stock->due[b] * packing_i_stock_excess(stock, stock->edge[b]);
  }
  assert_int_equal(sum, stock->count);
  assert_near(due, 1, 1e-14);
  if (stock->count > 0)
    assert_near(total, 0, 1e-12); /* excesses balance */
  assert_true(stock->edge[PACKING_I_STOCK_BINS - 1] == max_r);
}

/* What is taken differs from what is drawn by no more than the stock, even from one that is
 * asked for its smallest radius most of the time. */
static void takes_keep_to_the_law(void **state)
{
  (void)state;
  enum { STOCK = 64 };
  static double r[DRAWS];
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++) {
    packing_psd *psd = test_psd(kind, 1, PACKING_BY_NUMBER, 3);
    packing_i_source *source = of_psd(psd, STOCK, 2);
    const packing_i_stock *stock = packing_i_source_stock(source, 0);
    assert_int_equal(stock->count, STOCK);
    check_stock(stock, packing_psd_max_r(psd));
    for (size_t i = 0; i < DRAWS; i++) {
      const size_t index = i % 3 ? 0 : i % STOCK;
      const double want = stock->r[index];
      const size_t part = (size_t)stock->component[index];
      size_t component = 99;
      packing_i_source_take(source, 0, index, &r[i], &component);
      assert_true(r[i] == want);
      assert_int_equal(component, part);
      assert_int_equal(stock->count, STOCK);
      if (i % 97 == 0)
        check_stock(stock, packing_psd_max_r(psd));
    }
    assert_true(excess(psd, r, DRAWS) < bound_of(psd, DRAWS) + STOCK);
    packing_i_source_destroy(source);
    packing_psd_destroy(psd);
  }
}

static void bins_are_eighths(void **state)
{
  (void)state;
  packing_psd *psd = test_uniform(0.7, 1.3);
  packing_i_source *source = of_psd(psd, 4096, 1);
  const packing_i_stock *stock = packing_i_source_stock(source, 0);
  for (size_t b = 0; b < PACKING_I_STOCK_BINS; b++) {
    assert_near(stock->edge[b], 0.7 + 0.6 * (double)(b + 1) / 8, 1e-12);
    assert_near(stock->due[b], 0.125, 1e-12);
    assert_int_equal(stock->held[b], 512); /* whole rounds */
    assert_near(packing_i_stock_excess(stock, stock->edge[b]), 0, 1e-12);
    assert_int_equal(packing_i_stock_bin(stock, stock->edge[b]), b);
  }
  assert_int_equal(packing_i_stock_bin(stock, 0.1), 0);
  assert_int_equal(packing_i_stock_bin(stock, 9), PACKING_I_STOCK_BINS - 1);
  assert_near(packing_i_source_moment(source, 1), 1, 1e-12);
  assert_near(packing_i_source_moment(source, 3), 1.09, 1e-12);
  packing_i_source_destroy(source);
  packing_psd_destroy(psd);
}

/* A share of 1/100 is no bin of its own; equal radii have one. */
static void ties_fall_into_one_bin(void **state)
{
  (void)state;
  const double r[] = {1, 2, 3}, share[] = {.6, .39, .01};
  packing_psd_discrete_def def;
  packing_psd *psd = NULL, *mono = test_mono(1.7);
  packing_psd_discrete_def_init(&def);
  def.count = 3;
  def.r = r;
  def.share = share;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_discrete(NULL, &def, &psd));
  packing_i_source *source = of_psd(psd, 100, 1);
  const packing_i_stock *stock = packing_i_source_stock(source, 0);
  check_stock(stock, 3);
  const size_t small = packing_i_stock_bin(stock, 1),
               large = packing_i_stock_bin(stock, 2);
  assert_int_equal(small, 0);
  assert_true(large > small);
  assert_int_equal(packing_i_stock_bin(stock, 3), large);
  assert_near(stock->due[small], .6, 1e-15);
  assert_near(stock->due[large], .4, 1e-15);
  packing_i_source *same = of_psd(mono, 10, 1);
  check_stock(packing_i_source_stock(same, 0), 1.7);
  assert_true(packing_i_stock_excess(packing_i_source_stock(same, 0), 1.7) == 0);
  packing_i_source_destroy(source);
  packing_i_source_destroy(same);
  packing_psd_destroy(psd);
  packing_psd_destroy(mono);
}

/* Each class comes as often as the list says, and evenly from the first to the last. */
static void a_list_is_used_up(void **state)
{
  (void)state;
  const packing_front_class classes[] = {{2, 300},  {0.5, 2500}, {1, 0},
                                         {0.75, 7}, {2, 40},     {1.25, 1153}};
  enum { CLASSES = 6, ALL = 4000 };
  packing_front_def def = {.seed = 1};
  def.classes = classes;
  def.class_count = CLASSES;
  for (size_t stock = 1; stock <= 4096; stock *= 16) {
    packing_i_source *source = make(&def, NULL, stock);
    const packing_i_stock *held = packing_i_source_stock(source, 0);
    size_t got[CLASSES] = {0}, left[CLASSES];
    assert_int_equal(held->count, stock < ALL ? stock : ALL);
    assert_true(packing_i_source_min_r(source) == 0.5);
    assert_true(packing_i_source_max_r(source) == 2);
    assert_near(packing_i_source_moment(source, 1),
                (340 * 2 + 2500 * .5 + 7 * .75 + 1153 * 1.25) / ALL, 1e-12);
    for (size_t i = 0; i < ALL; i++) {
      double r = 0;
      size_t c = 99;
      assert_int_equal(packing_i_source_unplaced(source), ALL - i);
      if (i % 2)
        assert_true(packing_i_source_next(source, 0, &r, &c));
      else
        packing_i_source_take(source, 0, i % held->count, &r, &c);
      assert_true(c < CLASSES && r == classes[c].r);
      got[c]++;
      packing_i_source_left(source, left);
      for (size_t k = 0; k < CLASSES; k++) {
        assert_int_equal(left[k], classes[k].count - got[k]);
        if (stock == 1)
          assert_true(fabs((double)got[k] - (double)((i + 1) * classes[k].count) / ALL) <
                      PACKING_I_STRATA / 4.);
      }
      assert_int_equal(held->count, ALL - i - 1 < stock ? ALL - i - 1 : stock);
    }
    double r = -1;
    size_t c = 99;
    assert_false(packing_i_source_next(source, 0, &r, &c));
    assert_true(r == -1 && c == 99);
    assert_int_equal(packing_i_source_unplaced(source), 0);
    assert_true(isfinite(packing_i_stock_excess(held, 1)));
    packing_i_source_destroy(source);
  }
}

/* A class for each radius, in no order. */
static void a_list_of_single_radii(void **state)
{
  (void)state;
  enum { CLASSES = 1000 };
  static packing_front_class classes[CLASSES];
  static size_t got[CLASSES];
  packing_front_def def = {.seed = 1};
  for (size_t i = 0; i < CLASSES; i++)
    classes[i] = (packing_front_class){0.5 + (double)(i * 377 % CLASSES), 1};
  def.classes = classes;
  def.class_count = CLASSES;
  packing_i_source *source = make(&def, NULL, 32);
  for (size_t i = 0; i < CLASSES; i++) {
    double r;
    size_t c;
    assert_true(packing_i_source_next(source, 0, &r, &c));
    assert_true(r == classes[c].r);
    assert_int_equal(got[c]++, 0);
    check_stock(packing_i_source_stock(source, 0), 999.5);
  }
  packing_i_source_destroy(source);
}

static void a_radius_that_came_back_is_next(void **state)
{
  (void)state;
  packing_psd *psd = test_psd(TEST_PSD_MIXTURE, 1, PACKING_BY_NUMBER, 3);
  const packing_front_class classes[] = {{1, 3}, {2, 2}};
  packing_front_def def = {.seed = 1};
  packing_i_source *of_law = make(&def, psd, 1);
  packing_i_source *plain = make(&def, psd, 1);
  def.classes = classes;
  def.class_count = 2;
  packing_i_source *of_list = make(&def, NULL, 1);
  double r, again;
  size_t c, same, left[2];
  for (size_t i = 0; i < 100; i++) {
    assert_true(packing_i_source_next(of_law, 0, &r, &c));
    for (size_t k = 0; k < i % 3; k++) {
      packing_i_source_return(of_law, 0, r, c);
      assert_int_equal(packing_i_source_unplaced(of_law), 1);
      assert_true(packing_i_source_next(of_law, 0, &again, &same));
      assert_true(again == r && same == c);
    }
    assert_int_equal(packing_i_source_unplaced(of_law), 0);
    assert_true(packing_i_source_next(plain, 0, &again, &same));
    assert_true(again == r && same == c); /* nothing was lost by returning */
  }
  for (size_t i = 0; i < 5; i++) {
    assert_true(packing_i_source_next(of_list, 0, &r, &c));
    packing_i_source_return(of_list, 0, r, c);
    assert_int_equal(packing_i_source_unplaced(of_list), 5 - i);
    packing_i_source_left(of_list, left);
    assert_int_equal(left[0] + left[1], 5 - i);
    assert_true(packing_i_source_next(of_list, 0, &again, &same));
    assert_true(again == r && same == c);
  }
  assert_false(packing_i_source_next(of_list, 0, &r, &c));
  packing_i_source_return(of_list, 0, 2, 1);
  packing_i_source_left(of_list, left);
  assert_true(left[0] == 0 && left[1] == 1);
  packing_i_source_destroy(of_law);
  packing_i_source_destroy(plain);
  packing_i_source_destroy(of_list);
  packing_psd_destroy(psd);
}

/* Several at a time, of a distribution and of a list: the last is the first to go out again. */
static void several_come_back(void **state)
{
  (void)state;
  enum { MOST = PACKING_I_RETURNS, ALL = 12 };
  packing_psd *psd = test_uniform(1, 2);
  const packing_front_class classes[] = {{1, ALL / 2}, {2, ALL / 2}};
  packing_front_def def = {.seed = 1};
  packing_i_source *of_law = make(&def, psd, 1);
  def.classes = classes;
  def.class_count = 2;
  packing_i_source *of_list = make(&def, NULL, 1);
  packing_i_source *sources[] = {of_law, of_list};
  for (int k = 0; k < 2; k++) {
    double r[MOST], again;
    size_t c[MOST], same;
    for (size_t n = 0; n < MOST; n++)
      assert_true(packing_i_source_next(sources[k], 0, &r[n], &c[n]));
    const size_t left = packing_i_source_unplaced(sources[k]);
    assert_int_equal(left, k == 0 ? 0 : ALL - MOST);
    for (size_t n = 0; n < MOST; n++) {
      packing_i_source_return(sources[k], 0, r[n], c[n]);
      assert_int_equal(packing_i_source_unplaced(sources[k]), left + n + 1);
    }
    for (size_t n = MOST; n-- > 0;) {
      assert_true(packing_i_source_next(sources[k], 0, &again, &same));
      assert_true(again == r[n] && same == c[n]);
      assert_int_equal(packing_i_source_unplaced(sources[k]), left + n);
    }
    packing_i_source_destroy(sources[k]);
  }
  packing_psd_destroy(psd);
}

/* Thirds along x; 99 stands for a careless user. */
static size_t thirds(void *user, const packing_vec3 *centre)
{
  const double edge = *(const double *)user;
  return centre->x < edge / 3 ? 0 : centre->x < 2 * edge / 3 ? 1 : 99;
}

static void zones_have_their_own_sizes(void **state)
{
  (void)state;
  packing_psd *psd[3] = {test_mono(1), test_uniform(2, 3), test_uniform(4, 5)};
  packing_domain *boxes[2] = {test_box(2, 2, 2, 0), test_box(4, 4, 4, 0)};
  const packing_front_region regions[2] = {{boxes[0], psd[1]}, {boxes[1], psd[2]}};
  const struct {
    packing_vec3 centre;
    size_t zone;
  } where[] = {{{1, 1, 1}, 1}, {{2, 1, 1}, 1},   {{2.5, 1, 1}, 2},
               {{4, 4, 4}, 2}, {{4.5, 1, 1}, 0}, {{-.1, 1, 1}, 0}};
  packing_front_def def = {.seed = 1};
  def.regions = regions;
  def.region_count = 2;
  packing_i_source *source = make(&def, psd[0], 16);
  packing_domain_destroy(boxes[0]); /* held by the source */
  assert_int_equal(packing_i_source_zones(source), 3);
  for (size_t i = 0; i < sizeof where / sizeof *where; i++)
    assert_int_equal(packing_i_source_zone(source, &where[i].centre), where[i].zone);
  assert_true(packing_i_source_min_r(source) == 1);
  assert_true(packing_i_source_max_r(source) == 5);
  double edge = 9;
  const packing_front_region any[2] = {{NULL, psd[1]}, {NULL, psd[2]}};
  def.regions = any;
  def.choose = thirds;
  def.user = &edge;
  packing_i_source *chosen = make(&def, psd[0], 16);
  for (size_t i = 0; i < 3; i++) {
    const packing_vec3 centre = {1 + 3 * (double)i, 0, 0};
    const packing_i_stock *stock = packing_i_source_stock(source, i);
    assert_int_equal(packing_i_source_zone(chosen, &centre), i == 2 ? 0 : i);
    check_stock(stock, packing_psd_max_r(psd[i]));
    for (size_t k = 0; k < 100; k++) {
      double r;
      size_t c;
      packing_i_source_take(source, i, k % 16, &r, &c);
      assert_true(r >= packing_psd_min_r(psd[i]) && r <= packing_psd_max_r(psd[i]));
    }
  }
  packing_i_source_destroy(source);
  packing_i_source_destroy(chosen);
  packing_domain_destroy(boxes[1]);
  for (size_t i = 0; i < 3; i++)
    packing_psd_destroy(psd[i]);
}

static uint64_t hash_of(const packing_front_def *def, packing_psd *psd, double unit)
{
  packing_i_source *source = make(def, psd, 32);
  const packing_i_stock *stock = packing_i_source_stock(source, 0);
  uint64_t hash = TEST_HASH_START;
  for (size_t i = 0; i < 500; i++) {
    double r;
    size_t c;
    packing_i_source_take(source, 0, i * 7 % 32, &r, &c);
    r /= unit;
    const double e = packing_i_stock_excess(stock, unit * 0.9);
    hash = test_hash(hash, &r, sizeof r);
    hash = test_hash(hash, &c, sizeof c);
    hash = test_hash(hash, &e, sizeof e);
  }
  packing_i_source_destroy(source);
  return hash;
}

static void scaling_by_powers_of_two_changes_no_bit(void **state)
{
  (void)state;
  packing_front_def def = {.seed = 1};
  for (int kind = 0; kind < TEST_PSD_KINDS; kind++) {
    packing_psd *one = test_psd(kind, 1, PACKING_BY_MASS, 3);
    packing_psd *large = test_psd(kind, 0x1p40, PACKING_BY_MASS, 3);
    packing_psd *small = test_psd(kind, 0x1p-70, PACKING_BY_MASS, 3);
    const uint64_t hash = hash_of(&def, one, 1);
    assert_true(hash_of(&def, large, 0x1p40) == hash);
    assert_true(hash_of(&def, small, 0x1p-70) == hash);
    packing_psd_destroy(one);
    packing_psd_destroy(large);
    packing_psd_destroy(small);
  }
  packing_front_class classes[] = {{1.7, 400}, {0.3, 900}};
  def.classes = classes;
  def.class_count = 2;
  const uint64_t hash = hash_of(&def, NULL, 1);
  classes[0].r *= 0x1p-30;
  classes[1].r *= 0x1p-30;
  assert_true(hash_of(&def, NULL, 0x1p-30) == hash);
}

static void seeds_and_streams_differ(void **state)
{
  (void)state;
  packing_psd *psd = test_uniform(1, 2);
  packing_front_def def = {.seed = 1};
  const uint64_t hash = hash_of(&def, psd, 1);
  assert_true(hash_of(&def, psd, 1) == hash);
  def.stream = 1;
  const uint64_t other = hash_of(&def, psd, 1);
  def.stream = 0;
  def.seed = 2;
  const uint64_t third = hash_of(&def, psd, 1);
  assert_true(hash != other && other != third && third != hash);
  packing_psd_destroy(psd);
}

/* 1 : 1000, a rare part, and a mixture within a mixture. */
static void wide_mixtures(void **state)
{
  (void)state;
  packing_psd *parts[2] = {test_uniform(0.001, 0.002),
                           test_psd(TEST_PSD_MIXTURE, .2, PACKING_BY_NUMBER, 3)};
  const double share[] = {0.999, 0.001};
  packing_psd_mixture_def def;
  packing_psd *psd = NULL;
  packing_psd_mixture_def_init(&def);
  def.count = 2;
  def.parts = parts;
  def.share = share;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_mixture(NULL, &def, &psd));
  packing_i_source *source = of_psd(psd, 256, 4);
  const packing_i_stock *stock = packing_i_source_stock(source, 0);
  size_t rare = 0;
  for (size_t i = 0; i < DRAWS; i++) {
    double r;
    size_t c;
    packing_i_source_take(source, 0, i % 256, &r, &c);
    assert_true(r >= packing_psd_min_r(parts[c]) && r <= packing_psd_max_r(parts[c]));
    rare += c;
  }
  check_stock(stock, packing_psd_max_r(psd));
  assert_in_range(rare, 10, 30); /* 20 by shares; the bound is 16 + 25 wide */
  packing_i_source_destroy(source);
  packing_psd_destroy(psd);
  packing_psd_destroy(parts[0]);
  packing_psd_destroy(parts[1]);
}

static int listed;

static packing_status every(packing_context *context, uint64_t *hash)
{
  const packing_front_class classes[] = {{1.5, 20}, {1, 30}};
  packing_domain_box_def box;
  packing_domain *domain = NULL;
  packing_psd *psd = NULL;
  packing_i_source *source = NULL;
  packing_domain_box_def_init(&box);
  box.size.x = box.size.y = box.size.z = 1;
  packing_status status = packing_domain_create_box(context, &box, &domain);
  if (status == PACKING_OK)
    status = test_psd_create(context, TEST_PSD_MIXTURE, 1, PACKING_BY_MASS, 3, &psd);
  if (status == PACKING_OK) {
    const packing_front_region region = {domain, psd};
    packing_front_def def = {.seed = 1};
    def.classes = classes;
    def.class_count = listed ? 2 : 0;
    def.regions = &region;
    def.region_count = 1;
    status = packing_i_source_create(context, &def, listed ? NULL : psd, 16, &source);
  }
  if (status == PACKING_OK) {
    const packing_i_stock *stock = packing_i_source_stock(source, 0);
    *hash = test_hash(TEST_HASH_START, stock->r, stock->count * sizeof *stock->r);
  }
  packing_i_source_destroy(source);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  return status;
}

static void every_allocation_may_fail(void **state)
{
  (void)state;
  for (listed = 0; listed < 2; listed++)
    assert_true(test_every_allocation(every) > 20);
}

/* A class whose radius a distribution refuses is refused with its field. */
static void a_list_without_particles(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  const packing_front_class classes[] = {{1, 0}, {2, 0}};
  packing_front_def def = {.seed = 1};
  packing_i_source *source = NULL;
  def.classes = classes;
  def.class_count = 2;
  assert_fails(context, packing_i_source_create(context, &def, NULL, 4, &source),
               PACKING_ERR_RANGE, "classes");
  assert_null(source);
  packing_i_source_destroy(NULL);
  packing_context_destroy(context);
}

static void nothing_is_allocated_by_a_take(void **state)
{
  (void)state;
  test_allocator allocator = {0};
  packing_context *context = test_allocator_context(&allocator);
  packing_psd *psd = test_psd(TEST_PSD_MIXTURE, 1, PACKING_BY_MASS, 3);
  packing_front_def def = {.seed = 1};
  packing_i_source *source = NULL;
  assert_ok(packing_i_source_create(context, &def, psd, 64, &source));
  const size_t requests = allocator.requests;
  for (size_t i = 0; i < 1000; i++) {
    double r;
    size_t c;
    packing_i_source_take(source, 0, i % 64, &r, &c);
    assert_true(packing_i_source_next(source, 0, &r, &c));
  }
  assert_int_equal(allocator.requests, requests);
  packing_i_source_destroy(source);
  packing_psd_destroy(psd);
  packing_context_destroy(context);
  assert_int_equal(allocator.live, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ranks_are_sorted),
      cmocka_unit_test(strata_keep_to_their_bound),
      cmocka_unit_test(neighbours_are_independent),
      cmocka_unit_test(draws_keep_to_the_law),
      cmocka_unit_test(takes_keep_to_the_law),
      cmocka_unit_test(bins_are_eighths),
      cmocka_unit_test(ties_fall_into_one_bin),
      cmocka_unit_test(a_list_is_used_up),
      cmocka_unit_test(a_list_of_single_radii),
      cmocka_unit_test(a_radius_that_came_back_is_next),
      cmocka_unit_test(several_come_back),
      cmocka_unit_test(zones_have_their_own_sizes),
      cmocka_unit_test(scaling_by_powers_of_two_changes_no_bit),
      cmocka_unit_test(seeds_and_streams_differ),
      cmocka_unit_test(wide_mixtures),
      cmocka_unit_test(every_allocation_may_fail),
      cmocka_unit_test(a_list_without_particles),
      cmocka_unit_test(nothing_is_allocated_by_a_take),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
