/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PSD_INTERNAL_H
#define PACKING_PSD_INTERNAL_H

/* What a size distribution is inside, for the placers and for the files of the kinds.
 *
 * Every kind works on x = r / unit, where unit is the power of two with max_r in
 * [unit / 2, unit). The division is exact, so scaling all lengths by a power of two changes no
 * bit of what a kind computes, whatever functions it uses. */

#include "base_internal.h"
#include "rng/rng_internal.h"
#include <packing/psd.h>
#include <stdatomic.h>

enum {
  PACKING_I_PSD_LEAST_POWER = -6, /* of the public moments */
  PACKING_I_PSD_MOST_POWER = 6,
  /* By number, E[x^n] for n = -6 .. 9: the mean of x^k by mass is E[x^(k+dim)] / E[x^dim]. */
  PACKING_I_PSD_MOMENTS = 16
};

/* One kind. `x` and the results are in units of the distribution; the callers see to it that
 * min_x <= x < max_x and 0 < p, u, v < 1, and clamp what comes back. */
typedef struct packing_i_psd_ops {
  const char *name;
  const char *formula; /* or reference */
  double (*cdf)(const packing_psd *psd, packing_by by, double x);
  double (*quantile)(const packing_psd *psd, packing_by by, double p);
  /* Takes the unit square to the law: (u, v) uniform in it gives x of the law. Most kinds use
   * quantile(u), and `numbers` is 1. */
  double (*point)(const packing_psd *psd, packing_by by, double u, double v,
                  size_t *component);
  int numbers;
  void (*finish)(packing_psd *psd); /* releases what the kind owns; NULL: nothing */
} packing_i_psd_ops;

/* The head of each kind's struct. */
struct packing_psd {
  const packing_i_psd_ops *ops;
  packing_allocator allocator;
  atomic_size_t holds;
  packing_by by;
  int dim;
  size_t components; /* parts of a mixture, else 1 */
  int exponent;      /* unit = 2^exponent */
  double unit;
  double min_x;
  double max_x;
  double moment[PACKING_I_PSD_MOMENTS]; /* see packing_i_psd_number_moment() */
};

/* E[x^n] by number, n = -6 .. 9. */
static inline double packing_i_psd_number_moment(const packing_psd *psd, int n)
{
  return psd->moment[n - PACKING_I_PSD_LEAST_POWER];
}

/* A law that counts `by` has density ~ g(x); by number it goes as g(x) x^(this), and by mass
 * as that times x^dim. */
static inline int packing_i_psd_number_exponent(packing_by by, int dim)
{
  return by == PACKING_BY_MASS ? -dim : 0;
}

/* One radius [L], as packing_psd_draw(). `component` may be NULL. */
double packing_i_psd_draw(const packing_psd *psd, packing_i_stream *stream,
                          size_t *component);

/* The `point` of kinds that invert their cdf. */
double packing_i_psd_point(const packing_psd *psd, packing_by by, double u, double v,
                           size_t *component);

/* The radius [L] of a point of the unit square; see packing_i_psd_ops. */
double packing_i_psd_radius(const packing_psd *psd, packing_by by, double u, double v,
                            size_t *component);

/* Part i of a mixture, and its share; of any other law part 0 is itself. */
const packing_psd *packing_i_psd_part(const packing_psd *psd, size_t i);
double packing_i_psd_part_share(const packing_psd *psd, packing_by by, size_t i);

/* The smallest x with cdf at least p, by bisection down to neighbouring doubles. */
double packing_i_psd_bisect(const packing_psd *psd, packing_by by, double p);

/* Neither `def` nor `psd` is NULL. */
packing_status packing_i_psd_check_arguments(packing_context *context, const void *def,
                                             packing_psd **psd);

/* `by` and `dim` are known values. */
packing_status packing_i_psd_check_measure(packing_context *context, packing_by by,
                                           int dim);

/* Radii from `min_r` to `max_r`, both finite and > 0, are in reach: see the limits in check.c. */
packing_status packing_i_psd_check_span(packing_context *context, const char *field,
                                        double min_r, double max_r);

/* The fields min_r and max_r of a cut law. */
packing_status packing_i_psd_check_cut(packing_context *context, double min_r,
                                       double max_r);

/* At least `least` entries. */
packing_status packing_i_psd_check_count(packing_context *context, size_t count,
                                         size_t least);

/* An array of finite numbers > 0; a failure names the row, from 1, and records its index. */
packing_status packing_i_psd_check_entries(packing_context *context, const char *field,
                                           const double *v, size_t count);

/* Each entry above the one before. */
packing_status packing_i_psd_check_rising(packing_context *context, const char *field,
                                          const double *v, size_t count);

/* A number > 0 that sets how narrow a law is, within [least, most]. */
packing_status packing_i_psd_check_width(packing_context *context, const char *field,
                                         double v, double least, double most);

/* Allocates the kind's struct of `size` bytes, cleared, and fills its head but for the moments.
 * NULL: out of memory, noted in the context. */
packing_psd *packing_i_psd_new(packing_context *context, const packing_i_psd_ops *ops,
                               size_t size, packing_by by, int dim, double min_r,
                               double max_r);

#endif
