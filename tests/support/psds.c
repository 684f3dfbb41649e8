/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One size distribution of each kind. */
#include "psds.h"

const char *test_psd_name(int kind)
{
  static const char *const names[] = {
      "mono",   "uniform",         "normal",   "lognormal", "weibull",
      "gamma",  "exponential",     "discrete", "curve",     "linear curve",
      "sample", "smoothed sample", "mixture"};
  return names[kind];
}

/* Makes noun with the cut [from, to]; `set` are the fields of its own. */
#define CREATE_CUT(noun, from, to, set)                                                  \
  packing_psd_##noun##_def def;                                                          \
  packing_psd_##noun##_def_init(&def);                                                   \
  def.min_r = (from)*unit;                                                               \
  def.max_r = (to)*unit;                                                                 \
  def.by = by;                                                                           \
  def.dim = dim;                                                                         \
  set;                                                                                   \
  return packing_psd_create_##noun(context, &def, psd)

static packing_status create_mono(packing_context *context, double unit, packing_by by,
                                  int dim, packing_psd **psd)
{
  packing_psd_mono_def def;
  packing_psd_mono_def_init(&def);
  def.r = 1.7 * unit;
  def.by = by;
  def.dim = dim;
  return packing_psd_create_mono(context, &def, psd);
}

static packing_status create_uniform(packing_context *context, double unit, packing_by by,
                                     int dim, packing_psd **psd)
{
  CREATE_CUT(uniform, .5, 1.5, (void)0);
}

static packing_status create_normal(packing_context *context, double unit, packing_by by,
                                    int dim, packing_psd **psd)
{
  CREATE_CUT(normal, .4, 1.9, (def.mean_r = 1 * unit, def.sd_r = .3 * unit));
}

static packing_status create_lognormal(packing_context *context, double unit,
                                       packing_by by, int dim, packing_psd **psd)
{
  CREATE_CUT(lognormal, .2, 6, (def.median_r = 1 * unit, def.sigma = .6));
}

static packing_status create_weibull(packing_context *context, double unit, packing_by by,
                                     int dim, packing_psd **psd)
{
  CREATE_CUT(weibull, .1, 3, (def.scale_r = 1 * unit, def.shape = 2.2));
}

static packing_status create_gamma(packing_context *context, double unit, packing_by by,
                                   int dim, packing_psd **psd)
{
  CREATE_CUT(gamma, .05, 5, (def.scale_r = .5 * unit, def.shape = .7));
}

static packing_status create_exponential(packing_context *context, double unit,
                                         packing_by by, int dim, packing_psd **psd)
{
  CREATE_CUT(exponential, .3, 7, def.scale_r = 1.3 * unit);
}

static packing_status create_discrete(packing_context *context, double unit,
                                      packing_by by, int dim, packing_psd **psd)
{
  const double r[] = {.5 * unit, 1 * unit, 1.25 * unit, 3 * unit};
  const double share[] = {.1, .4, .2, .3};
  packing_psd_discrete_def def;
  packing_psd_discrete_def_init(&def);
  def.count = 4;
  def.r = r;
  def.share = share;
  def.by = by;
  def.dim = dim;
  return packing_psd_create_discrete(context, &def, psd);
}

static packing_status create_curve(packing_context *context, double unit, packing_by by,
                                   int dim, int logarithmic, packing_psd **psd)
{
  const double diameter[] = {.1 * unit, .2 * unit, .25 * unit, .5 * unit,
                             .6 * unit, 1 * unit,  2 * unit,   2.5 * unit};
  const double passing[] = {0, 0, .02, .03, .5, .5, .95, 1};
  packing_psd_curve_def def;
  packing_psd_curve_def_init(&def);
  def.count = 8;
  def.diameter_d = diameter;
  def.passing = passing;
  def.logarithmic = logarithmic;
  def.by = by;
  def.dim = dim;
  return packing_psd_create_curve(context, &def, psd);
}

static packing_status create_sample(packing_context *context, double unit, packing_by by,
                                    int dim, double bandwidth, packing_psd **psd)
{
  const double r[] = {1.5 * unit, .5 * unit, .75 * unit, .5 * unit, 1 * unit};
  packing_psd_sample_def def;
  packing_psd_sample_def_init(&def);
  def.count = 5;
  def.r = r;
  def.bandwidth = bandwidth;
  def.by = by;
  def.dim = dim;
  return packing_psd_create_sample(context, &def, psd);
}

static packing_status create_mixture(packing_context *context, double unit, packing_by by,
                                     int dim, packing_psd **psd)
{
  packing_psd *parts[3] = {NULL, NULL, NULL};
  const double share[] = {.5, .3, .2};
  packing_psd_mixture_def def;
  packing_psd_mixture_def_init(&def);
  def.count = 3;
  def.parts = parts;
  def.share = share;
  def.by = by;
  def.dim = dim;
  packing_status status =
      create_uniform(context, unit, PACKING_BY_NUMBER, dim, &parts[0]);
  if (status == PACKING_OK)
    status = create_sample(context, unit * 2, PACKING_BY_NUMBER, dim, .1, &parts[1]);
  if (status == PACKING_OK)
    status = create_discrete(context, unit, PACKING_BY_MASS, dim, &parts[2]);
  if (status == PACKING_OK)
    status = packing_psd_create_mixture(context, &def, psd);
  for (size_t i = 0; i < 3; i++)
    packing_psd_destroy(parts[i]);
  return status;
}

packing_status test_psd_create(packing_context *context, int kind, double unit,
                               packing_by by, int dim, packing_psd **psd)
{
  switch (kind) {
  case TEST_PSD_MONO:
    return create_mono(context, unit, by, dim, psd);
  case TEST_PSD_UNIFORM:
    return create_uniform(context, unit, by, dim, psd);
  case TEST_PSD_NORMAL:
    return create_normal(context, unit, by, dim, psd);
  case TEST_PSD_LOGNORMAL:
    return create_lognormal(context, unit, by, dim, psd);
  case TEST_PSD_WEIBULL:
    return create_weibull(context, unit, by, dim, psd);
  case TEST_PSD_GAMMA:
    return create_gamma(context, unit, by, dim, psd);
  case TEST_PSD_EXPONENTIAL:
    return create_exponential(context, unit, by, dim, psd);
  case TEST_PSD_DISCRETE:
    return create_discrete(context, unit, by, dim, psd);
  case TEST_PSD_CURVE:
    return create_curve(context, unit, by, dim, 1, psd);
  case TEST_PSD_CURVE_LINEAR:
    return create_curve(context, unit, by, dim, 0, psd);
  case TEST_PSD_SAMPLE:
    return create_sample(context, unit, by, dim, 0, psd);
  case TEST_PSD_SMOOTHED:
    return create_sample(context, unit, by, dim, .1, psd);
  default:
    return create_mixture(context, unit, by, dim, psd);
  }
}

packing_psd *test_psd(int kind, double unit, packing_by by, int dim)
{
  packing_psd *psd = NULL;
  assert_ok(test_psd_create(NULL, kind, unit, by, dim, &psd));
  return psd;
}

double test_psd_moment(const packing_psd *psd, packing_by by, int power)
{
  double m = nan("");
  assert_ok(packing_psd_moment(psd, by, power, &m));
  return m;
}
