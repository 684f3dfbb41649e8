/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PSD_H
#define PACKING_PSD_H

/** \file packing/psd.h
 *  Particle-size distributions. A distribution is immutable, reference-counted and can be
 *  shared by threads and contexts. Radii everywhere; only sieve tables hold diameters, and
 *  say so in the name (`_d`).
 *
 *  `by` tells what the shares of the law count: particles, or mass (then a particle weighs
 *  r^dim, so `dim` is 2 for discs). Whatever the law counts, moments, cdf and quantile can
 *  be asked by number and by mass. The law must lie on 0 < min_r <= r <= max_r < infinity;
 *  radii from 1e-200 to 1e200 spanning at most 1:1e30 are accepted. A cut must keep at least
 *  1e-15 of its law, and laws narrower than 1e-9 of their mean are to be made mono.
 *
 *  Scaling every length of a def by a power of two scales each draw bit for bit. */

#include <packing/rng.h>
#include <packing/types.h>

PACKING_BEGIN_DECLS

/** A particle-size distribution. */
typedef struct packing_psd packing_psd;

/** Lets go of a distribution; what was made from it keeps it.
 *  \param psd NULL is fine. Thread-safe */
PACKING_API void packing_psd_destroy(packing_psd *psd);

/** Takes one more hold of a distribution; each needs its packing_psd_destroy().
 *  \param psd the distribution
 *  \return psd. Thread-safe */
PACKING_API packing_psd *packing_psd_retain(packing_psd *psd);

/** Options of packing_psd_create_mono(). */
typedef struct packing_psd_mono_def {
  size_t struct_size; /**< set by packing_psd_mono_def_init() */
  double r;           /**< the radius [L], > 0 */
  packing_by by;      /**< what the law counts; default number */
  int dim;            /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_mono_def;

/** Writes the defaults; called through packing_psd_mono_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_mono_def_fill(packing_psd_mono_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_mono_def_init(packing_psd_mono_def *def)
{
  packing_psd_mono_def_fill(def, sizeof *def);
}

/** Makes equal particles.
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_mono(
    packing_context *context, const packing_psd_mono_def *def, packing_psd **psd);

/** Options of packing_psd_create_uniform(). */
typedef struct packing_psd_uniform_def {
  size_t struct_size; /**< set by packing_psd_uniform_def_init() */
  double min_r;       /**< smallest radius [L], > 0 */
  double max_r;       /**< largest radius [L], > min_r */
  packing_by by;      /**< what the law counts; default number */
  int dim;            /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_uniform_def;

/** Writes the defaults; called through packing_psd_uniform_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_uniform_def_fill(packing_psd_uniform_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_uniform_def_init(packing_psd_uniform_def *def)
{
  packing_psd_uniform_def_fill(def, sizeof *def);
}

/** Makes radii uniform in [min_r, max_r].
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_uniform(
    packing_context *context, const packing_psd_uniform_def *def, packing_psd **psd);

/** Options of packing_psd_create_normal(). */
typedef struct packing_psd_normal_def {
  size_t struct_size; /**< set by packing_psd_normal_def_init() */
  double mean_r;      /**< mean before the cut [L] */
  double sd_r;        /**< standard deviation before the cut [L], > 0 */
  double min_r;       /**< smallest radius [L], > 0 */
  double max_r;       /**< largest radius [L], > min_r */
  packing_by by;      /**< what the law counts; default number */
  int dim;            /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_normal_def;

/** Writes the defaults; called through packing_psd_normal_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_normal_def_fill(packing_psd_normal_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_normal_def_init(packing_psd_normal_def *def)
{
  packing_psd_normal_def_fill(def, sizeof *def);
}

/** Makes a normal law cut to [min_r, max_r].
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_normal(
    packing_context *context, const packing_psd_normal_def *def, packing_psd **psd);

/** Options of packing_psd_create_lognormal(). */
typedef struct packing_psd_lognormal_def {
  size_t struct_size; /**< set by packing_psd_lognormal_def_init() */
  double median_r;    /**< median before the cut [L], > 0 */
  double sigma;       /**< standard deviation of log r before the cut [1], > 0 */
  double min_r;       /**< smallest radius [L], > 0 */
  double max_r;       /**< largest radius [L], > min_r */
  packing_by by;      /**< what the law counts; default number */
  int dim;            /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_lognormal_def;

/** Writes the defaults; called through packing_psd_lognormal_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_lognormal_def_fill(packing_psd_lognormal_def *def,
                                                size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_lognormal_def_init(packing_psd_lognormal_def *def)
{
  packing_psd_lognormal_def_fill(def, sizeof *def);
}

/** Makes a lognormal law cut to [min_r, max_r].
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_lognormal(
    packing_context *context, const packing_psd_lognormal_def *def, packing_psd **psd);

/** Options of packing_psd_create_weibull(). */
typedef struct packing_psd_weibull_def {
  size_t struct_size; /**< set by packing_psd_weibull_def_init() */
  double scale_r;     /**< scale [L], > 0 */
  double shape;       /**< shape [1], > 0 */
  double min_r;       /**< smallest radius [L], > 0 */
  double max_r;       /**< largest radius [L], > min_r */
  packing_by by;      /**< what the law counts; default number */
  int dim;            /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_weibull_def;

/** Writes the defaults; called through packing_psd_weibull_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_weibull_def_fill(packing_psd_weibull_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_weibull_def_init(packing_psd_weibull_def *def)
{
  packing_psd_weibull_def_fill(def, sizeof *def);
}

/** Makes a Weibull law cut to [min_r, max_r]: F = 1 - exp(-(r / scale_r)^shape).
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_weibull(
    packing_context *context, const packing_psd_weibull_def *def, packing_psd **psd);

/** Options of packing_psd_create_gamma(). */
typedef struct packing_psd_gamma_def {
  size_t struct_size; /**< set by packing_psd_gamma_def_init() */
  double scale_r;     /**< scale [L], > 0 */
  double shape;       /**< shape [1], > 0 */
  double min_r;       /**< smallest radius [L], > 0 */
  double max_r;       /**< largest radius [L], > min_r */
  packing_by by;      /**< what the law counts; default number */
  int dim;            /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_gamma_def;

/** Writes the defaults; called through packing_psd_gamma_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_gamma_def_fill(packing_psd_gamma_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_gamma_def_init(packing_psd_gamma_def *def)
{
  packing_psd_gamma_def_fill(def, sizeof *def);
}

/** Makes a gamma law cut to [min_r, max_r]: density ~ r^(shape-1) exp(-r / scale_r).
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_gamma(
    packing_context *context, const packing_psd_gamma_def *def, packing_psd **psd);

/** Options of packing_psd_create_exponential(). */
typedef struct packing_psd_exponential_def {
  size_t struct_size; /**< set by packing_psd_exponential_def_init() */
  double scale_r;     /**< mean before the cut [L], > 0 */
  double min_r;       /**< smallest radius [L], > 0 */
  double max_r;       /**< largest radius [L], > min_r */
  packing_by by;      /**< what the law counts; default number */
  int dim;            /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_exponential_def;

/** Writes the defaults; called through packing_psd_exponential_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_exponential_def_fill(packing_psd_exponential_def *def,
                                                  size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_exponential_def_init(packing_psd_exponential_def *def)
{
  packing_psd_exponential_def_fill(def, sizeof *def);
}

/** Makes an exponential law cut to [min_r, max_r]: density ~ exp(-r / scale_r).
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_exponential(
    packing_context *context, const packing_psd_exponential_def *def, packing_psd **psd);

/** Options of packing_psd_create_discrete(). */
typedef struct packing_psd_discrete_def {
  size_t struct_size;  /**< set by packing_psd_discrete_def_init() */
  size_t count;        /**< entries, at least 1 */
  const double *r;     /**< radii [L], rising, borrowed for the call */
  const double *share; /**< shares, > 0; only their ratios matter */
  packing_by by;       /**< what the law counts; default mass */
  int dim;             /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_discrete_def;

/** Writes the defaults; called through packing_psd_discrete_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_discrete_def_fill(packing_psd_discrete_def *def,
                                               size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_discrete_def_init(packing_psd_discrete_def *def)
{
  packing_psd_discrete_def_fill(def, sizeof *def);
}

/** Makes a choice between given radii.
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_discrete(
    packing_context *context, const packing_psd_discrete_def *def, packing_psd **psd);

/** Options of packing_psd_create_curve(). */
typedef struct packing_psd_curve_def {
  size_t struct_size;       /**< set by packing_psd_curve_def_init() */
  size_t count;             /**< rows, at least 2 */
  const double *diameter_d; /**< sieve diameters [L], strictly rising, > 0 */
  const double *passing;    /**< share passing, never falling, from 0 to 1 */
  int logarithmic; /**< 1: interpolate over log diameter (default); 0: over diameter */
  packing_by by;   /**< what the law counts; default mass */
  int dim;         /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_curve_def;

/** Writes the defaults; called through packing_psd_curve_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_curve_def_fill(packing_psd_curve_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_curve_def_init(packing_psd_curve_def *def)
{
  packing_psd_curve_def_fill(def, sizeof *def);
}

/** Makes a grading curve by monotone interpolation (Steffen 1990) of the share passing over
 *  the diameter; nothing lies below the first row, which passes 0.
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI.
 *          A descending or truncated curve: PACKING_ERR_RANGE with the row in the message */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_curve(
    packing_context *context, const packing_psd_curve_def *def, packing_psd **psd);

/** Options of packing_psd_create_sample(). */
typedef struct packing_psd_sample_def {
  size_t struct_size; /**< set by packing_psd_sample_def_init() */
  size_t count;       /**< radii, at least 1 */
  const double *r;    /**< measured radii [L], any order */
  /** 0 (default): resample; from 1e-9 to 10: each radius stands for r exp(bandwidth z), z
   *  standard normal cut to [-3, 3] [1]; cdf then costs O(count), quantile 60 times that */
  double bandwidth;
  packing_by by; /**< what the law counts; default number */
  int dim;       /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_sample_def;

/** Writes the defaults; called through packing_psd_sample_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_sample_def_fill(packing_psd_sample_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_sample_def_init(packing_psd_sample_def *def)
{
  packing_psd_sample_def_fill(def, sizeof *def);
}

/** Makes a distribution from measured radii: resampled, or smoothed by a kernel.
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_sample(
    packing_context *context, const packing_psd_sample_def *def, packing_psd **psd);

/** Options of packing_psd_create_mixture(). */
typedef struct packing_psd_mixture_def {
  size_t struct_size;        /**< set by packing_psd_mixture_def_init() */
  size_t count;              /**< parts, at least 1 */
  packing_psd *const *parts; /**< distributions; the mixture keeps them; all of one dim */
  const double *share;       /**< shares, > 0; only their ratios matter */
  packing_by by;             /**< what the law counts; default mass */
  int dim;                   /**< 3: mass goes as r^3 (default); 2: as r^2 */
} packing_psd_mixture_def;

/** Writes the defaults; called through packing_psd_mixture_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_psd_mixture_def_fill(packing_psd_mixture_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_psd_mixture_def_init(packing_psd_mixture_def *def)
{
  packing_psd_mixture_def_fill(def, sizeof *def);
}

/** Makes a mixture; each draw tells which part it came from.
 *  \param context NULL is fine
 *  \param def options; the lengths have no default
 *  \param[out] psd the distribution
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_create_mixture(
    packing_context *context, const packing_psd_mixture_def *def, packing_psd **psd);

/** The smallest radius that can be drawn.
 *  \param psd the distribution
 *  \return [L]. Thread-safe, constant time */
PACKING_API double packing_psd_min_r(const packing_psd *psd);

/** The largest radius that can be drawn.
 *  \param psd the distribution
 *  \return [L]. Thread-safe, constant time */
PACKING_API double packing_psd_max_r(const packing_psd *psd);

/** The name of the law, as in "lognormal".
 *  \param psd the distribution
 *  \return a constant string. Thread-safe */
PACKING_API const char *packing_psd_kind(const packing_psd *psd);

/** The number of parts that a draw can come from.
 *  \param psd the distribution
 *  \return 1, or the count of a mixture. Thread-safe */
PACKING_API size_t packing_psd_components(const packing_psd *psd);

/** A mean of r^power over the cut law.
 *  \param psd the distribution
 *  \param by weigh particles alike, or by mass
 *  \param power from -6 to 6
 *  \param[out] moment E[r^power] [L^power]; closed forms where there are, else quadrature to
 *         1e-12 relative
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL); PACKING_ERR_RANGE (power, or a moment
 *          beyond the range of doubles). Thread-safe */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_moment(const packing_psd *psd,
                                                                  packing_by by,
                                                                  int power,
                                                                  double *moment);

/** The share of particles, or of mass, with radius up to r.
 *  \param psd the distribution
 *  \param by number or mass
 *  \param r any value [L]; NaN gives NaN
 *  \return from 0 to 1, never falling in r but for rounding. Thread-safe */
PACKING_API double packing_psd_cdf(const packing_psd *psd, packing_by by, double r);

/** The smallest radius with cdf at least p.
 *  \param psd the distribution
 *  \param by number or mass
 *  \param p from 0 to 1; beyond, the ends; NaN gives NaN
 *  \return [L], in [min_r, max_r], never falling in p but for rounding. Thread-safe */
PACKING_API double packing_psd_quantile(const packing_psd *psd, packing_by by, double p);

/** Draws one radius, by number. A mixture and a smoothed sample take two numbers of the
 *  stream, the rest one.
 *  \param psd the distribution
 *  \param rng the stream
 *  \param[out] component index of the part of a mixture, else 0; NULL is fine
 *  \return a radius [L]. Thread-safe (the stream is the caller's) */
PACKING_API double packing_psd_draw(const packing_psd *psd, packing_rng *rng,
                                    size_t *component);

/** The volume fraction of the densest random packing of spheres of these sizes, by the
 *  one-dimensional theory of Farr and Groot (J. Chem. Phys. 131, 244104, 2009): spheres
 *  become rods (chords of the cut pack), rods are laid largest first into the largest gap,
 *  neighbours keep 0.7654 of the shorter rod apart. Equal spheres come out at 0.6435; packs
 *  agree to about 0.01. The numerical error is below 1e-4.
 *  \param context NULL is fine; lends memory
 *  \param psd the distribution, of dim 3
 *  \param[out] volume_fraction [1]
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL); PACKING_ERR_UNSUPPORTED (dim 2);
 *          PACKING_ERR_NOMEM. Thread-safe.
 *          About 0.02 s */
PACKING_API PACKING_WARN_UNUSED packing_status packing_psd_dense_limit(
    packing_context *context, const packing_psd *psd, double *volume_fraction);

PACKING_END_DECLS

#endif
