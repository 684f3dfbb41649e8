/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bad distributions: each refused with its status, the field (and row) in the message, the index
 * in the record, and nothing made. */
#include "psds.h"

typedef struct fixture {
  packing_context *context;
  packing_log_record last;
} fixture;

static void keep(void *user, const packing_log_record *record)
{
  *(packing_log_record *)user = *record;
}

static int make_fixture(void **state)
{
  static fixture f;
  packing_context_def def;
  packing_context_def_init(&def);
  def.log = keep;
  def.log_user = &f.last;
  *state = &f;
  return packing_context_create(&def, &f.context) == PACKING_OK ? 0 : -1;
}

static int drop_fixture(void **state)
{
  fixture *f = *state;
  packing_context_destroy(f->context);
  return 0;
}

/* Sets one field of a good def, and expects the refusal. */
#define REFUSED(noun, good, change, status, name)                                        \
  do {                                                                                   \
    packing_psd_##noun##_def def = good;                                                 \
    packing_psd *psd = NULL;                                                             \
    change;                                                                              \
    assert_fails(f->context, packing_psd_create_##noun(f->context, &def, &psd), status,  \
                 name ": ");                                                             \
    assert_string_equal(f->last.field, name);                                            \
    assert_null(psd);                                                                    \
  } while (0)

/* What every kind with a cut refuses. */
#define CUT_REFUSED(noun, good)                                                          \
  do {                                                                                   \
    REFUSED(noun, good, def.min_r = 0, PACKING_ERR_RANGE, "min_r");                      \
    REFUSED(noun, good, def.min_r = -1, PACKING_ERR_RANGE, "min_r");                     \
    REFUSED(noun, good, def.min_r = nan(""), PACKING_ERR_INVALID, "min_r");              \
    REFUSED(noun, good, def.max_r = HUGE_VAL, PACKING_ERR_INVALID, "max_r");             \
    REFUSED(noun, good, def.max_r = def.min_r, PACKING_ERR_RANGE, "max_r");              \
    REFUSED(noun, good, def.max_r = def.min_r / 2, PACKING_ERR_RANGE, "max_r");          \
    REFUSED(noun, good, def.min_r = 1e-300, PACKING_ERR_RANGE, "min_r");                 \
    REFUSED(noun, good, def.min_r = def.max_r * 1e-31, PACKING_ERR_RANGE, "min_r");      \
    REFUSED(noun, good, def.dim = 1, PACKING_ERR_RANGE, "dim");                          \
    REFUSED(noun, good, def.dim = 4, PACKING_ERR_RANGE, "dim");                          \
    REFUSED(noun, good, def.by = (packing_by)2, PACKING_ERR_RANGE, "by");                \
    REFUSED(noun, good, def.struct_size = 7, PACKING_ERR_ABI, "struct_size");            \
  } while (0)

static void mono_refuses(void **state)
{
  fixture *f = *state;
  packing_psd_mono_def good;
  packing_psd_mono_def_init(&good);
  REFUSED(mono, good, (void)0, PACKING_ERR_RANGE, "r"); /* lengths have no default */
  REFUSED(mono, good, def.r = -1, PACKING_ERR_RANGE, "r");
  REFUSED(mono, good, def.r = nan(""), PACKING_ERR_INVALID, "r");
  REFUSED(mono, good, def.r = HUGE_VAL, PACKING_ERR_INVALID, "r");
  REFUSED(mono, good, def.r = 1e201, PACKING_ERR_RANGE, "r");
  good.r = 1;
  REFUSED(mono, good, def.dim = 0, PACKING_ERR_RANGE, "dim");
  REFUSED(mono, good, def.by = (packing_by)-1, PACKING_ERR_RANGE, "by");
  packing_psd *psd = NULL;
  assert_fails(f->context, packing_psd_create_mono(f->context, NULL, &psd),
               PACKING_ERR_INVALID, "def");
  assert_fails(f->context, packing_psd_create_mono(f->context, &good, NULL),
               PACKING_ERR_INVALID, "psd");
  assert_status(packing_psd_create_mono(NULL, NULL, NULL), PACKING_ERR_INVALID);
}

static void uniform_refuses(void **state)
{
  fixture *f = *state;
  packing_psd_uniform_def good;
  packing_psd_uniform_def_init(&good);
  good.min_r = 1;
  good.max_r = 2;
  CUT_REFUSED(uniform, good);
}

static void normal_refuses(void **state)
{
  fixture *f = *state;
  packing_psd_normal_def good;
  packing_psd_normal_def_init(&good);
  good.mean_r = 1;
  good.sd_r = .1;
  good.min_r = .5;
  good.max_r = 2;
  CUT_REFUSED(normal, good);
  REFUSED(normal, good, def.mean_r = nan(""), PACKING_ERR_INVALID, "mean_r");
  REFUSED(normal, good, def.sd_r = 0, PACKING_ERR_RANGE, "sd_r");
  REFUSED(normal, good, def.sd_r = -.1, PACKING_ERR_RANGE, "sd_r");
  REFUSED(normal, good, def.sd_r = 1e-12, PACKING_ERR_RANGE, "sd_r");
  REFUSED(normal, good, def.sd_r = HUGE_VAL, PACKING_ERR_INVALID, "sd_r");
  /* 9 sd away 1e-19 of the law is left, 1e6 sd away nothing that a double can hold. */
  REFUSED(normal, good, def.mean_r = .5 - .9, PACKING_ERR_RANGE, "min_r");
  REFUSED(normal, good, def.mean_r = 2.9, PACKING_ERR_RANGE, "min_r");
  REFUSED(normal, good, def.mean_r = 1e5, PACKING_ERR_RANGE, "min_r");
  REFUSED(normal, good, def.mean_r = -1e300, PACKING_ERR_RANGE, "min_r");
}

static void lognormal_refuses(void **state)
{
  fixture *f = *state;
  packing_psd_lognormal_def good;
  packing_psd_lognormal_def_init(&good);
  good.median_r = 1;
  good.sigma = .3;
  good.min_r = .5;
  good.max_r = 2;
  CUT_REFUSED(lognormal, good);
  REFUSED(lognormal, good, def.median_r = 0, PACKING_ERR_RANGE, "median_r");
  REFUSED(lognormal, good, def.median_r = nan(""), PACKING_ERR_INVALID, "median_r");
  REFUSED(lognormal, good, def.median_r = 1e6, PACKING_ERR_RANGE, "min_r");
  REFUSED(lognormal, good, def.sigma = 0, PACKING_ERR_RANGE, "sigma");
  REFUSED(lognormal, good, def.sigma = 1e-10, PACKING_ERR_RANGE, "sigma");
  REFUSED(lognormal, good, def.sigma = -HUGE_VAL, PACKING_ERR_INVALID, "sigma");
}

static void weibull_refuses(void **state)
{
  fixture *f = *state;
  packing_psd_weibull_def good;
  packing_psd_weibull_def_init(&good);
  good.scale_r = 1;
  good.shape = 2;
  good.min_r = .1;
  good.max_r = 3;
  CUT_REFUSED(weibull, good);
  REFUSED(weibull, good, def.scale_r = -1, PACKING_ERR_RANGE, "scale_r");
  REFUSED(weibull, good, def.scale_r = 1e-3, PACKING_ERR_RANGE, "min_r");
  REFUSED(weibull, good, def.scale_r = 1e300, PACKING_ERR_RANGE, "min_r");
  REFUSED(weibull, good, def.shape = 0, PACKING_ERR_RANGE, "shape");
  REFUSED(weibull, good, def.shape = nan(""), PACKING_ERR_INVALID, "shape");
}

static void gamma_refuses(void **state)
{
  fixture *f = *state;
  packing_psd_gamma_def good;
  packing_psd_gamma_def_init(&good);
  good.scale_r = 1;
  good.shape = .7;
  good.min_r = .1;
  good.max_r = 9;
  CUT_REFUSED(gamma, good);
  REFUSED(gamma, good, def.scale_r = 0, PACKING_ERR_RANGE, "scale_r");
  REFUSED(gamma, good, def.scale_r = 1e-3, PACKING_ERR_RANGE, "min_r");
  REFUSED(gamma, good, def.shape = 1e10, PACKING_ERR_RANGE, "shape");
  REFUSED(gamma, good, def.shape = HUGE_VAL, PACKING_ERR_INVALID, "shape");
}

static void exponential_refuses(void **state)
{
  fixture *f = *state;
  packing_psd_exponential_def good;
  packing_psd_exponential_def_init(&good);
  good.scale_r = 1;
  good.min_r = .1;
  good.max_r = 9;
  CUT_REFUSED(exponential, good);
  REFUSED(exponential, good, def.scale_r = nan(""), PACKING_ERR_INVALID, "scale_r");
  REFUSED(exponential, good, def.scale_r = 0, PACKING_ERR_RANGE, "scale_r");
  REFUSED(exponential, good, def.scale_r = 1e-3, PACKING_ERR_RANGE, "min_r");
}

/* The last failure was of row `index`, and says its number. */
static void assert_row(const fixture *f, size_t index)
{
  char row[32];
  snprintf(row, sizeof row, "row %zu:", index + 1);
  assert_int_equal(f->last.index, index);
  assert_non_null(strstr(packing_context_message(f->context), row));
}

static void discrete_refuses(void **state)
{
  fixture *f = *state;
  const double r[] = {1, 2, 3}, share[] = {1, 1, 1};
  const double nan_r[] = {1, nan(""), 3}, zero_r[] = {0, 2, 3}, equal_r[] = {1, 2, 2};
  const double no_share[] = {1, 0, 1}, inf_share[] = {1, 1, HUGE_VAL};
  const double far_r[] = {1e-31, 1, 2};
  packing_psd_discrete_def good;
  packing_psd_discrete_def_init(&good);
  good.count = 3;
  good.r = r;
  good.share = share;
  REFUSED(discrete, good, def.count = 0, PACKING_ERR_RANGE, "count");
  REFUSED(discrete, good, def.r = NULL, PACKING_ERR_INVALID, "r");
  REFUSED(discrete, good, def.share = NULL, PACKING_ERR_INVALID, "share");
  REFUSED(discrete, good, def.r = nan_r, PACKING_ERR_INVALID, "r");
  assert_row(f, 1);
  REFUSED(discrete, good, def.r = zero_r, PACKING_ERR_RANGE, "r");
  assert_row(f, 0);
  REFUSED(discrete, good, def.r = equal_r, PACKING_ERR_RANGE, "r");
  assert_row(f, 2);
  REFUSED(discrete, good, def.r = far_r, PACKING_ERR_RANGE, "r");
  REFUSED(discrete, good, def.share = no_share, PACKING_ERR_RANGE, "share");
  assert_row(f, 1);
  REFUSED(discrete, good, def.share = inf_share, PACKING_ERR_INVALID, "share");
  assert_row(f, 2);
  REFUSED(discrete, good, def.dim = 5, PACKING_ERR_RANGE, "dim");
  REFUSED(discrete, good, def.struct_size = 8, PACKING_ERR_ABI, "struct_size");
}

static void curve_refuses(void **state)
{
  fixture *f = *state;
  const double d[] = {1, 2, 4, 8}, p[] = {0, .2, .7, 1};
  const double falling_d[] = {1, 2, 1.5, 8}, equal_d[] = {1, 1, 2, 3};
  const double nan_d[] = {1, 2, nan(""), 8}, negative_d[] = {-1, 2, 3, 4};
  const double falling_p[] = {0, .7, .2, 1}, starts_p[] = {.1, .2, .7, 1};
  const double truncated_p[] = {0, .2, .7, .9}, above_p[] = {0, .2, 1.1, 1.2};
  const double nan_p[] = {0, nan(""), .7, 1}, percent_p[] = {0, 20, 70, 100};
  packing_psd_curve_def good;
  packing_psd_curve_def_init(&good);
  good.count = 4;
  good.diameter_d = d;
  good.passing = p;
  REFUSED(curve, good, def.count = 1, PACKING_ERR_RANGE, "count");
  REFUSED(curve, good, def.diameter_d = NULL, PACKING_ERR_INVALID, "diameter_d");
  REFUSED(curve, good, def.passing = NULL, PACKING_ERR_INVALID, "passing");
  REFUSED(curve, good, def.diameter_d = falling_d, PACKING_ERR_RANGE, "diameter_d");
  assert_row(f, 2);
  REFUSED(curve, good, def.diameter_d = equal_d, PACKING_ERR_RANGE, "diameter_d");
  assert_row(f, 1);
  REFUSED(curve, good, def.diameter_d = nan_d, PACKING_ERR_INVALID, "diameter_d");
  assert_row(f, 2);
  REFUSED(curve, good, def.diameter_d = negative_d, PACKING_ERR_RANGE, "diameter_d");
  assert_row(f, 0);
  REFUSED(curve, good, def.passing = falling_p, PACKING_ERR_RANGE, "passing");
  assert_row(f, 2);
  REFUSED(curve, good, def.passing = starts_p, PACKING_ERR_RANGE, "passing");
  assert_row(f, 0);
  REFUSED(curve, good, def.passing = truncated_p, PACKING_ERR_RANGE, "passing");
  assert_row(f, 3);
  REFUSED(curve, good, def.passing = above_p, PACKING_ERR_RANGE, "passing");
  assert_row(f, 2);
  REFUSED(curve, good, def.passing = percent_p, PACKING_ERR_RANGE, "passing");
  assert_row(f, 1);
  REFUSED(curve, good, def.passing = nan_p, PACKING_ERR_INVALID, "passing");
  assert_row(f, 1);
  REFUSED(curve, good, def.logarithmic = 2, PACKING_ERR_RANGE, "logarithmic");
  REFUSED(curve, good, def.dim = 1, PACKING_ERR_RANGE, "dim");
}

static void sample_refuses(void **state)
{
  fixture *f = *state;
  const double r[] = {2, 1, 3}, bad[] = {2, 1, -3}, nan_r[] = {nan(""), 1, 3};
  packing_psd_sample_def good;
  packing_psd_sample_def_init(&good);
  good.count = 3;
  good.r = r;
  REFUSED(sample, good, def.count = 0, PACKING_ERR_RANGE, "count");
  REFUSED(sample, good, def.r = NULL, PACKING_ERR_INVALID, "r");
  REFUSED(sample, good, def.r = bad, PACKING_ERR_RANGE, "r");
  assert_row(f, 2);
  REFUSED(sample, good, def.r = nan_r, PACKING_ERR_INVALID, "r");
  assert_row(f, 0);
  REFUSED(sample, good, def.bandwidth = -.1, PACKING_ERR_RANGE, "bandwidth");
  REFUSED(sample, good, def.bandwidth = nan(""), PACKING_ERR_INVALID, "bandwidth");
  REFUSED(sample, good, def.bandwidth = 1e-12, PACKING_ERR_RANGE, "bandwidth");
  REFUSED(sample, good, def.bandwidth = 11, PACKING_ERR_RANGE, "bandwidth");
  REFUSED(sample, good, def.by = (packing_by)9, PACKING_ERR_RANGE, "by");
}

static void mixture_refuses(void **state)
{
  fixture *f = *state;
  packing_psd *mono = test_mono(1), *flat = test_psd(TEST_PSD_MONO, 1, 0, 2);
  packing_psd *parts[] = {mono, mono}, *mixed[] = {mono, flat}, *hole[] = {mono, NULL};
  const double share[] = {1, 2}, zero[] = {0, 1}, nan_share[] = {1, nan("")};
  packing_psd_mixture_def good;
  packing_psd_mixture_def_init(&good);
  good.count = 2;
  good.parts = parts;
  good.share = share;
  REFUSED(mixture, good, def.count = 0, PACKING_ERR_RANGE, "count");
  REFUSED(mixture, good, def.parts = NULL, PACKING_ERR_INVALID, "parts");
  REFUSED(mixture, good, def.parts = hole, PACKING_ERR_INVALID, "parts");
  assert_int_equal(f->last.index, 1);
  REFUSED(mixture, good, def.parts = mixed, PACKING_ERR_INVALID, "parts");
  assert_int_equal(f->last.index, 1);
  REFUSED(mixture, good, def.share = NULL, PACKING_ERR_INVALID, "share");
  REFUSED(mixture, good, def.share = zero, PACKING_ERR_RANGE, "share");
  assert_row(f, 0);
  REFUSED(mixture, good, def.share = nan_share, PACKING_ERR_INVALID, "share");
  assert_row(f, 1);
  REFUSED(mixture, good, def.dim = 2, PACKING_ERR_INVALID, "parts");
  packing_psd_destroy(mono);
  packing_psd_destroy(flat);
}

/* A struct that grew: tomorrow's caller is served unless it sets what we do not know. */
static void newer_callers_are_served(void **state)
{
  fixture *f = *state;
  struct {
    packing_psd_normal_def def;
    double of_tomorrow;
  } newer;
  packing_psd *psd = NULL;
  packing_psd_normal_def_fill(&newer.def, sizeof newer);
  assert_int_equal(newer.def.struct_size, sizeof newer);
  assert_int_equal(newer.def.dim, 3);
  newer.def.mean_r = 1;
  newer.def.sd_r = .1;
  newer.def.min_r = .5;
  newer.def.max_r = 2;
  assert_ok(packing_psd_create_normal(f->context, &newer.def, &psd));
  packing_psd_destroy(psd);
  psd = NULL;
  newer.of_tomorrow = 1;
  assert_fails(f->context, packing_psd_create_normal(f->context, &newer.def, &psd),
               PACKING_ERR_ABI, "struct_size");
  assert_null(psd);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mono_refuses),        cmocka_unit_test(uniform_refuses),
      cmocka_unit_test(normal_refuses),      cmocka_unit_test(lognormal_refuses),
      cmocka_unit_test(weibull_refuses),     cmocka_unit_test(gamma_refuses),
      cmocka_unit_test(exponential_refuses), cmocka_unit_test(discrete_refuses),
      cmocka_unit_test(curve_refuses),       cmocka_unit_test(sample_refuses),
      cmocka_unit_test(mixture_refuses),     cmocka_unit_test(newer_callers_are_served),
  };
  return cmocka_run_group_tests(tests, make_fixture, drop_fixture);
}
