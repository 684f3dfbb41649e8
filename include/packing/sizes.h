/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_SIZES_H
#define PACKING_SIZES_H

/** \file packing/sizes.h
 *  Sizes asked against sizes placed, in detail: curves and sieves by number and by mass, errors
 *  between curves, the Kolmogorov-Smirnov and chi-square tests with their p-values, and the
 *  components of a mixture one by one. packing_measure_sizes() gives the summary.
 *
 *  A particle weighs r^3, in two dimensions r^2; densities are equal. Only the radii of a view
 *  matter, centres may be anything. Results depend neither on the order of the particles nor on
 *  threads; scaling all lengths by a power of two changes no bit of them. Thread-safe with a
 *  context for each thread. */

#include <packing/measure.h>

PACKING_BEGIN_DECLS

/** Options of packing_measure_size_curve(). */
typedef struct packing_size_curve_def {
  size_t struct_size; /**< set by packing_size_curve_def_init() */
  packing_by by;      /**< what the curves count; default number */
  int dim; /**< 3: a particle weighs r^3; 2: r^2; 0 (default): as the distribution says,
       3 without one */
} packing_size_curve_def;

/** Writes the defaults; called through packing_size_curve_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_size_curve_def_fill(packing_size_curve_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_size_curve_def_init(packing_size_curve_def *def)
{
  packing_size_curve_def_fill(def, sizeof *def);
}

/** The cumulative curves of sizes at given radii: the share of the particles, or of their mass,
 *  with a radius up to each. Curves of two packs at the same radii can be compared with
 *  packing_measure_curve_errors().
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param psd what was asked; NULL: nothing (then `asked` must be NULL)
 *  \param view the pack, at least one particle: finite radii > 0
 *  \param count radii to look at
 *  \param r the radii, `count` entries in any order: finite, > 0 [L]
 *  \param[out] asked the curve of the distribution, `count` entries from 0 to 1; NULL: not
 *         wanted
 *  \param[out] placed the curve of the pack, `count` entries from 0 to 1; NULL: not wanted
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. N log N */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_measure_size_curve(packing_context *context, const packing_size_curve_def *def,
                           packing_psd *psd, const packing_view *view, size_t count,
                           const double *r, double *asked, double *placed);

/** Options of packing_measure_sieves(). */
typedef struct packing_sieves_def {
  size_t struct_size; /**< set by packing_sieves_def_init() */
  size_t count;       /**< sieves, at least 1 */
  const double *
      opening_d; /**< their openings, diameters, the coarsest first, each finer than the one
       before [L] */
  int dim; /**< 3: a particle weighs r^3; 2: r^2; 0 (default): as the distribution says,
       3 without one */
} packing_sieves_def;

/** Writes the defaults; called through packing_sieves_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_sieves_def_fill(packing_sieves_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_sieves_def_init(packing_sieves_def *def)
{
  packing_sieves_def_fill(def, sizeof *def);
}

/** One sieve of a stack, or the pan under it. The members will stay as they are. */
typedef struct packing_sieve {
  double opening_d;       /**< diameter of the opening; 0: the pan [L] */
  double asked_retained;  /**< mass that should lie on it, per cent; NaN: nothing asked */
  double asked_passing;   /**< mass that should have passed it, per cent; NaN the same */
  double placed_retained; /**< mass that lies on it, per cent */
  double placed_passing;  /**< mass that has passed it, per cent */
} packing_sieve;

/** Sieves a pack: the masses on each sieve and through it, asked and placed. A particle passes
 *  an opening of its own diameter. Masses retained sum to 100.
 *  \param context NULL is fine
 *  \param def the sieves
 *  \param psd what was asked; NULL: nothing
 *  \param view the pack, at least one particle: finite radii > 0
 *  \param[out] sieves `def->count` + 1 entries: the sieves in their order, then the pan
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. N log N */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_measure_sieves(packing_context *context, const packing_sieves_def *def,
                       packing_psd *psd, const packing_view *view, packing_sieve *sieves);

/** What packing_measure_curve_errors() found. The error of a point is asked - placed. */
typedef struct packing_curve_errors_report {
  size_t struct_size; /**< set by packing_curve_errors_report_init() */
  double mae;         /**< mean of |error|, in the unit of the curves */
  double mse;         /**< mean of error^2, in the square of that */
  double rmae;        /**< mean of |error| / asked [1]; NaN where no point has one */
  double mre; /**< mean of error / asked [1]: negative where too much is placed; NaN where
       no point has one */
  size_t relative_count; /**< points in the two relative means: those with asked > 0 */
} packing_curve_errors_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_curve_errors_report_init(packing_curve_errors_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** The errors between two curves, of shares, per cent, or anything not negative, point by point:
 *  mean absolute (MAE), mean squared (MSE), relative mean absolute (RMAE) and mean relative
 *  error (MRE). Each mean is over the points that it sums; points with nothing asked have no
 *  relative error.
 *  \param context NULL is fine
 *  \param count points, at least 1
 *  \param asked the curve to reach, `count` entries: finite, >= 0
 *  \param placed the curve reached, `count` entries: finite, >= 0
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_measure_curve_errors(packing_context *context, size_t count, const double *asked,
                             const double *placed, packing_curve_errors_report *report);

/** The largest sample for which packing_kolmogorov_p() is always exact. */
#define PACKING_KOLMOGOROV_EXACT 5000

/** The p-value of a Kolmogorov-Smirnov distance: the chance that `count` numbers drawn from a
 *  continuous law lie at least so far from it. (Where the law has atoms the chance is smaller.)
 *  Up to ::PACKING_KOLMOGOROV_EXACT numbers by the matrix of Marsaglia, Tsang and Wang (J. Stat.
 *  Softw. 8(18), 2003), with an error below 1e-13; beyond by the expansion of Pelz and Good
 *  (J. R. Stat. Soc. B 38, 1976), with an error below 3e-9. Where count distance^2 >= 6 (a p
 *  below 1.3e-5) it is twice the exact chance of one side, for any count up to 1e6 to 1e-11 of
 *  itself, beyond by the limit of that, to (count distance^2)^2 / count of itself.
 *  \param context NULL is fine; lends memory
 *  \param count numbers, at least 1
 *  \param distance from 0 to 1 [1]
 *  \param[out] p from 0 to 1 [1]
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, NULL); PACKING_ERR_RANGE (count 0, a distance
 *          beyond 0 to 1); PACKING_ERR_NOMEM. At most about a second, for count 5000; mostly
 *          milliseconds */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_kolmogorov_p(packing_context *context, size_t count, double distance, double *p);

/** The most bins of a chi-square test. */
#define PACKING_SIZE_TESTS_BINS 10000

/** Options of packing_measure_size_tests(). */
typedef struct packing_size_tests_def {
  size_t struct_size; /**< set by packing_size_tests_def_init() */
  size_t
      bins; /**< of the chi-square test, from 2 to ::PACKING_SIZE_TESTS_BINS; 0 (default):
       2 N^(2/5) of N particles (Mann and Wald), as long as that leaves 5 to expect in each */
} packing_size_tests_def;

/** Writes the defaults; called through packing_size_tests_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_size_tests_def_fill(packing_size_tests_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_size_tests_def_init(packing_size_tests_def *def)
{
  packing_size_tests_def_fill(def, sizeof *def);
}

/** What packing_measure_size_tests() found. */
typedef struct packing_size_tests_report {
  size_t struct_size; /**< set by packing_size_tests_report_init() */
  size_t count;       /**< particles */
  double ks;          /**< Kolmogorov-Smirnov distance by number [1] */
  double ks_p;        /**< its p-value, see packing_kolmogorov_p() [1] */
  double chi_square;  /**< sum over the bins of (placed - expected)^2 / expected; NaN of a
        single bin [1] */
  size_t bins; /**< of the chi-square test: as asked, fewer where the law has atoms */
  double
      chi_square_p; /**< chance of at least that with bins - 1 degrees of freedom; NaN of a
        single bin [1] */
} packing_size_tests_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_size_tests_report_init(packing_size_tests_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Tests whether the radii of a pack can be a sample of a distribution: Kolmogorov-Smirnov,
 *  and chi-square in bins that the distribution fills alike, both by number. Bins end at
 *  quantiles of the law; a size that has a share of its own may fill several, which are one
 *  then. Sizes beyond the law's ends count in the first and last bin.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param psd what was asked
 *  \param view the pack, at least one particle: finite radii > 0
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. N log N, and see packing_kolmogorov_p() */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_size_tests(
    packing_context *context, const packing_size_tests_def *def, packing_psd *psd,
    const packing_view *view, packing_size_tests_report *report);

/** One component of a mixture. The members will stay as they are. */
typedef struct packing_size_component {
  size_t count;         /**< particles of it */
  double number_asked;  /**< share by number that was asked [1] */
  double number_placed; /**< share by number there is [1] */
  double
      number_sd; /**< standard deviation of that share in a sample as large as the pack,
           sqrt(asked (1 - asked) / N) [1] */
  double mass_asked;  /**< share by mass that was asked [1] */
  double mass_placed; /**< share by mass there is [1] */
  double ks;   /**< distance of its radii from its own distribution by number; NaN without
       particles [1] */
  double ks_p; /**< the p-value of that; NaN without particles [1] */
} packing_size_component;

/** Compares a mixture with what was placed, component by component, as the column `component`
 *  of the view says, which may be absent where there is one component only.
 *  \param context NULL is fine
 *  \param psd what was asked
 *  \param view the pack, at least one particle: finite radii > 0, components known to the
 *         distribution
 *  \param[out] components packing_psd_components() entries
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM. N log N, and
 *          see packing_kolmogorov_p() */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_measure_components(packing_context *context, packing_psd *psd,
                           const packing_view *view, packing_size_component *components);

PACKING_END_DECLS

#endif
