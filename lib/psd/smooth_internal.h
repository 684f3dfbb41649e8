/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SMOOTH_INTERNAL_H
#define PACKING_SMOOTH_INTERNAL_H

/* Distributions with a smooth density: cut laws, grading curves, kernels.
 *
 * [min_x, max_x] is cut into panels, in each of which the density of u = log x, by number and
 * by mass, is a Legendre series of 16 terms through the Gauss points. The series is integrated
 * term by term, so cdf, its inverse and the moments come from one table and agree with each
 * other; the density is only ever integrated forwards, nothing cancels in either tail.
 * Panels are halved until the last terms are below 1e-13 of the largest value (or the rounding
 * of x shows). Cost: a cdf some 16 x 6 flops, a quantile about 5 of these. */

#include "psd_internal.h"

enum { PACKING_I_TERMS = 16 };

typedef struct packing_i_panel {
  double x;        /* its lower end */
  double half;     /* half its width in u: u - u(x) = half (t + 1), t in [-1, 1] */
  double below[2]; /* the share below it, by number and by mass */
  double share[2]; /* the share in it */
  double term[2]
             [PACKING_I_TERMS]; /* the density of t is the sum of (2 k + 1) term_k P_k */
} packing_i_panel;

typedef struct packing_i_smooth {
  packing_psd base;
  size_t count;
  size_t capacity;
  packing_i_panel *panel;
} packing_i_smooth;

double packing_i_smooth_cdf(const packing_psd *psd, packing_by by, double x);
double packing_i_smooth_quantile(const packing_psd *psd, packing_by by, double p);
void packing_i_smooth_finish(packing_psd *psd);

/* The rest of the ops of a kind that is such a table. */
#define PACKING_I_SMOOTH_OPS                                                             \
  packing_i_smooth_cdf, packing_i_smooth_quantile, packing_i_psd_point, 1,               \
      packing_i_smooth_finish

/* A density of u, up to a factor, as the law counts. */
typedef struct packing_i_density {
  double (*at)(const void *law, double x);
  /* log of the largest density times x^s on [lo, hi]: lets nothing narrow slip between the
   * points, and drops what is negligible. NULL: the density has no narrow features. */
  double (*log_largest)(const void *law, double lo, double hi, int s);
  const void *law;
} packing_i_density;

typedef struct packing_i_smooth_builder {
  packing_context *context;
  packing_i_smooth *smooth;
  double point[PACKING_I_TERMS];
  double weight[PACKING_I_TERMS];
  double legendre[PACKING_I_TERMS][PACKING_I_TERMS]; /* of a point, by degree */
  double total[PACKING_I_PSD_MOMENTS];               /* integrals of x^n by number */
} packing_i_smooth_builder;

/* A build: begin, intervals from min_x to max_x in rising order, end. After a failure the caller
 * destroys builder.smooth->base. Begin returns PACKING_ERR_NOMEM or PACKING_OK. */
packing_status packing_i_smooth_begin(packing_i_smooth_builder *builder,
                                      packing_context *context,
                                      const packing_i_psd_ops *ops, packing_by by,
                                      int dim, double min_r, double max_r);
packing_status packing_i_smooth_interval(packing_i_smooth_builder *builder,
                                         const packing_i_density *density, double lo,
                                         double hi);
void packing_i_smooth_end(packing_i_smooth_builder *builder);

/* A law on (0, infinity) or beyond, to be cut. */
typedef struct packing_i_cut_law {
  double parameter[3]; /* lengths in units of the distribution */
  /* log of the density of log x, of integral 1 before the cut */
  double (*log_density)(const double *parameter, double x);
  /* where that density times x^s has its inner maximum; <= 0: it has none */
  double (*mode)(const double *parameter, int s);
} packing_i_cut_law;

/* The unit that a distribution up to max_r will have. */
double packing_i_psd_unit(double max_r);

/* Makes a cut law's distribution; PACKING_ERR_RANGE where the cut keeps next to nothing. */
packing_status packing_i_cut_create(packing_context *context,
                                    const packing_i_psd_ops *ops,
                                    const packing_i_cut_law *law, packing_by by, int dim,
                                    double min_r, double max_r, packing_psd **psd);

#endif
