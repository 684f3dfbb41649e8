/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cut laws against independent quadrature (GSL's adaptive Gauss-Kronrod on the density of r, as
 * written in a textbook) and against closed forms, to the 1e-12 that the header states. */
#include "test.h"
#include "psd/psd_internal.h"
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_gamma.h>

/* A law, its parameters and its cut: a copy of what the def says. */
typedef struct textbook {
  char kind; /* n l w g e u */
  double a, b, min_r, max_r;
  packing_by by;
  int dim;
} textbook;

static double density(const textbook *t, double r)
{
  switch (t->kind) {
  case 'n':
    return exp(-.5 * (r - t->a) / t->b * ((r - t->a) / t->b));
  case 'l':
    return exp(-.5 * pow(log(r / t->a) / t->b, 2)) / r;
  case 'w':
    return pow(r / t->a, t->b - 1) * exp(-pow(r / t->a, t->b));
  case 'g':
    return pow(r / t->a, t->b - 1) * exp(-r / t->a);
  case 'e':
    return exp(-r / t->a);
  default:
    return 1;
  }
}

#define CREATE(noun, set)                                                                \
  do {                                                                                   \
    packing_psd_##noun##_def def;                                                        \
    packing_psd_##noun##_def_init(&def);                                                 \
    def.min_r = t->min_r;                                                                \
    def.max_r = t->max_r;                                                                \
    def.by = t->by;                                                                      \
    def.dim = t->dim;                                                                    \
    set;                                                                                 \
    assert_ok(packing_psd_create_##noun(NULL, &def, &psd));                              \
  } while (0)

static packing_psd *make(const textbook *t)
{
  packing_psd *psd = NULL;
  switch (t->kind) {
  case 'n':
    CREATE(normal, (def.mean_r = t->a, def.sd_r = t->b));
    break;
  case 'l':
    CREATE(lognormal, (def.median_r = t->a, def.sigma = t->b));
    break;
  case 'w':
    CREATE(weibull, (def.scale_r = t->a, def.shape = t->b));
    break;
  case 'g':
    CREATE(gamma, (def.scale_r = t->a, def.shape = t->b));
    break;
  case 'e':
    CREATE(exponential, def.scale_r = t->a);
    break;
  default:
    CREATE(uniform, (void)0);
  }
  return psd;
}

typedef struct integrand {
  const textbook *law;
  int power;
} integrand;

/* In log r: the laws may span decades. */
static double weighted(double u, void *parameters)
{
  const integrand *f = parameters;
  const double r = exp(u);
  return density(f->law, r) * gsl_pow_int(r, f->power + 1);
}

static double integral(const textbook *t, double lo, double hi, int power)
{
  gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(2000);
  integrand f = {t, power};
  const gsl_function function = {weighted, &f};
  double result = 0, error;
  const int pieces = 16; /* so that a narrow law is not overlooked */
  for (int i = 0; i < pieces; i++) {
    double part = 0;
    const double from = log(lo) + log(hi / lo) * i / pieces;
    const double to = log(lo) + log(hi / lo) * (i + 1) / pieces;
    gsl_integration_qag(&function, from, to, 0, 1e-13, 2000, GSL_INTEG_GAUSS31, workspace,
                        &part, &error);
    result += part;
  }
  gsl_integration_workspace_free(workspace);
  return result;
}

static const textbook laws[] = {
    {'n', 1, .1, .7, 1.3, PACKING_BY_NUMBER, 3},
    {'n', 1, .3, .4, 1.9, PACKING_BY_MASS, 3},
    {'n', 1, .25, 1.5, 3, PACKING_BY_NUMBER, 3},    /* the upper tail, from 2 sd on */
    {'n', 3, .5, .02, 1.2, PACKING_BY_NUMBER, 3},   /* the lower tail */
    {'n', 1, .15, .001, 2, PACKING_BY_MASS, 3},     /* by number most lies at the cut */
    {'n', -1, 1, .1, 5, PACKING_BY_NUMBER, 2},      /* mean below 0 */
    {'l', 1, .6, .2, 6, PACKING_BY_NUMBER, 3},      /* */
    {'l', 1, 1, 1e-3, 1e3, PACKING_BY_MASS, 3},     /* six decades */
    {'l', 1, 2.5, 1e-5, 1e5, PACKING_BY_NUMBER, 3}, /* mass lies at the upper cut */
    {'l', 2, .02, 1, 4, PACKING_BY_NUMBER, 2},      /* narrow in a wide cut */
    {'w', 1, 2.2, .1, 3, PACKING_BY_NUMBER, 3},
    {'w', 1, .5, 1e-4, 30, PACKING_BY_MASS, 3},
    {'w', 1, 12, .5, 1.5, PACKING_BY_MASS, 2},
    {'g', .5, .7, .05, 5, PACKING_BY_NUMBER, 3},
    {'g', .5, 4, .05, 15, PACKING_BY_MASS, 3},
    {'g', .01, 100, .5, 2, PACKING_BY_NUMBER, 3},
    {'e', 1, 0, .01, 12, PACKING_BY_NUMBER, 3},
    {'e', 1, 0, .3, 7, PACKING_BY_MASS, 2},
    {'u', 0, 0, 1, 3, PACKING_BY_MASS, 3},
    {'u', 0, 0, 1e-3, 10, PACKING_BY_MASS, 2},
};
enum { LAWS = sizeof laws / sizeof *laws };

/* The power of r that the density by number or by mass has over the law's own. */
static int exponent(const textbook *t, packing_by by)
{
  return (t->by == PACKING_BY_MASS ? -t->dim : 0) + (by == PACKING_BY_MASS ? t->dim : 0);
}

static void moments_agree_with_quadrature(void **state)
{
  (void)state;
  for (size_t i = 0; i < LAWS; i++) {
    const textbook *t = &laws[i];
    packing_psd *psd = make(t);
    for (int b = 0; b < 2; b++) {
      const int e = exponent(t, (packing_by)b);
      const double all = integral(t, t->min_r, t->max_r, e);
      for (int n = -6; n <= 6; n++) {
        double moment = nan("");
        assert_ok(packing_psd_moment(psd, (packing_by)b, n, &moment));
        assert_close(moment, integral(t, t->min_r, t->max_r, e + n) / all, 1e-12);
      }
    }
    packing_psd_destroy(psd);
  }
}

static void cdf_agrees_with_quadrature(void **state)
{
  (void)state;
  for (size_t i = 0; i < LAWS; i++) {
    const textbook *t = &laws[i];
    packing_psd *psd = make(t);
    for (int b = 0; b < 2; b++) {
      const int e = exponent(t, (packing_by)b);
      const double all = integral(t, t->min_r, t->max_r, e);
      for (int k = 1; k < 20; k++) {
        const double r = t->min_r * pow(t->max_r / t->min_r, k / 20.0);
        assert_near(packing_psd_cdf(psd, (packing_by)b, r),
                    integral(t, t->min_r, r, e) / all, 1e-12);
      }
    }
    packing_psd_destroy(psd);
  }
}

/* r -> p -> r, judged by p where the density is small, and p -> r -> p. */
static void quantile_inverts_cdf(void **state)
{
  (void)state;
  for (size_t i = 0; i < LAWS; i++) {
    packing_psd *psd = make(&laws[i]);
    for (int b = 0; b < 2; b++) {
      double before = 0;
      for (int k = 1; k < 2000; k++) {
        const double p = k / 2000.0;
        const double r = packing_psd_quantile(psd, (packing_by)b, p);
        const double step = r * 1e-15; /* the cdf over some units of r's last place */
        const double slack = packing_psd_cdf(psd, (packing_by)b, r + step) -
                             packing_psd_cdf(psd, (packing_by)b, r - step);
        assert_near(packing_psd_cdf(psd, (packing_by)b, r), p, 4e-15 + slack);
        assert_true(r >= before);
        before = r;
      }
    }
    packing_psd_destroy(psd);
  }
}

static void cdf_never_falls(void **state)
{
  (void)state;
  for (size_t i = 0; i < LAWS; i++) {
    const textbook *t = &laws[i];
    packing_psd *psd = make(t);
    for (int b = 0; b < 2; b++) {
      double before = 0;
      for (int k = 0; k <= 5000; k++) {
        const double r = t->min_r * pow(t->max_r / t->min_r, k / 5000.0);
        const double p = packing_psd_cdf(psd, (packing_by)b, r);
        assert_true(p >= before - 1e-15);
        before = p;
      }
    }
    packing_psd_destroy(psd);
  }
}

/* The closed forms: shifted lognormals, incomplete gamma functions. */
static void closed_forms_hold(void **state)
{
  (void)state;
  double m = nan("");
  const textbook l = {'l', 2, .5, 1e-4, 1e4, PACKING_BY_NUMBER, 3};
  packing_psd *psd = make(&l);
  for (int n = -6; n <= 6; n++) { /* the cut is 17 sigma away */
    assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, n, &m));
    assert_close(m, pow(2, n) * exp(n * n * .125), 1e-13);
    assert_ok(packing_psd_moment(psd, PACKING_BY_MASS, n, &m));
    assert_close(m, pow(2, n) * exp((n * n + 6 * n) * .125), 1e-13);
  }
  assert_near(packing_psd_cdf(psd, PACKING_BY_MASS, 3),
              gsl_cdf_ugaussian_P((log(1.5) - 3 * .25) / .5), 1e-14);
  packing_psd_destroy(psd);
  const textbook g = {'g', 1, 2.5, 1e-9, 200, PACKING_BY_NUMBER, 3};
  psd = make(&g);
  for (int n = -2; n <= 6; n++) {
    assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, n, &m));
    if (n >= 0) /* below, the lower cut shows */
      assert_close(m, gsl_sf_gamma(2.5 + n) / gsl_sf_gamma(2.5), 1e-13);
  }
  assert_near(packing_psd_cdf(psd, PACKING_BY_NUMBER, 2), gsl_cdf_gamma_P(2, 2.5, 1),
              1e-14);
  assert_near(packing_psd_cdf(psd, PACKING_BY_MASS, 6), gsl_cdf_gamma_P(6, 5.5, 1),
              1e-14);
  packing_psd_destroy(psd);
  const textbook w = {'w', 1, 3, .5, 1.5, PACKING_BY_NUMBER, 3};
  psd = make(&w);
  const double q0 = exp(-.125), q1 = exp(-3.375);
  for (double r = .6; r < 1.5; r += .1)
    assert_near(packing_psd_cdf(psd, PACKING_BY_NUMBER, r),
                (q0 - exp(-r * r * r)) / (q0 - q1), 1e-14);
  assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, .3),
               cbrt(-log(q0 - .3 * (q0 - q1))), 1e-14);
  packing_psd_destroy(psd);
  const textbook e = {'e', 1, 0, 1, 30, PACKING_BY_NUMBER, 3};
  psd = make(&e);
  assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, 1, &m));
  assert_close(m, (2 - 31 * exp(-29.0)) / (1 - exp(-29.0)), 1e-12);
  assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, .5),
               1 - log(1 - .5 * (1 - exp(-29.0))), 1e-14);
  packing_psd_destroy(psd);
}

/* Laws as narrow as accepted, in a cut a billion times as wide, are found and are right. */
static void needles_are_found(void **state)
{
  (void)state;
  const textbook needles[] = {{'n', 1.1, 1e-8, .01, 5, PACKING_BY_NUMBER, 3},
                              {'l', 1.1, 1e-8, 1e-10, 1e10, PACKING_BY_MASS, 3},
                              {'w', 1.1, 1e8, 1e-10, 1e10, PACKING_BY_NUMBER, 3},
                              {'g', 1.1e-9, 1e9, 1e-3, 1e3, PACKING_BY_MASS, 2}};
  for (size_t i = 0; i < 4; i++) {
    double mean = nan(""), square = nan("");
    packing_psd *psd = make(&needles[i]);
    assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, 1, &mean));
    assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, 2, &square));
    assert_close(mean, 1.1, 2e-8);
    assert_close(square, mean * mean, 1e-8);
    assert_close(packing_psd_quantile(psd, PACKING_BY_MASS, .01), 1.1, 2e-4);
    assert_close(packing_psd_quantile(psd, PACKING_BY_MASS, .99), 1.1, 2e-4);
    /* the outermost draws, where the panels are empty */
    assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, 0x1p-53), 1.1, 1e-3);
    assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, 1 - 0x1p-53), 1.1, 1e-3);
    assert_near(packing_psd_cdf(psd, PACKING_BY_NUMBER,
                                packing_psd_quantile(psd, PACKING_BY_NUMBER, .3)),
                .3, 1e-6);
    packing_psd_destroy(psd);
  }
}

/* A law so wide that its cut is a power of r. */
static void wide_laws_become_powers(void **state)
{
  (void)state;
  const textbook l = {'l', 1, 1000, .1, 10, PACKING_BY_NUMBER, 3}; /* 1 / r */
  packing_psd *psd = make(&l);
  assert_close(packing_psd_quantile(psd, PACKING_BY_NUMBER, .25), pow(10, -.5), 1e-5);
  packing_psd_destroy(psd);
  const textbook g = {'g', 1e6, 3, .1, 10, PACKING_BY_NUMBER, 3}; /* r^2, kept 1e-15 */
  packing_psd *none = NULL;
  packing_psd_gamma_def def;
  packing_psd_gamma_def_init(&def);
  def.scale_r = g.a;
  def.shape = g.b;
  def.min_r = g.min_r;
  def.max_r = g.max_r;
  assert_status(packing_psd_create_gamma(NULL, &def, &none), PACKING_ERR_RANGE);
  def.scale_r = 1e4; /* kept 2e-10 */
  assert_ok(packing_psd_create_gamma(NULL, &def, &none));
  assert_near(packing_psd_cdf(none, PACKING_BY_NUMBER, 5), .125, 1e-3);
  packing_psd_destroy(none);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(moments_agree_with_quadrature),
      cmocka_unit_test(cdf_agrees_with_quadrature),
      cmocka_unit_test(quantile_inverts_cdf),
      cmocka_unit_test(cdf_never_falls),
      cmocka_unit_test(closed_forms_hold),
      cmocka_unit_test(needles_are_found),
      cmocka_unit_test(wide_laws_become_powers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
