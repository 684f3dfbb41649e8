/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_MEASURE_H
#define PACKING_MEASURE_H

/** \file packing/measure.h
 *  What can be shown about a pack. All take a packing_view, so a host measures its own arrays
 *  without a copy, and share nothing with the placers but the grid. The results are the same
 *  bytes for any number of threads. Thread-safe with a context for each thread; all take
 *  linear time (sizes: N log N). */

#include <packing/domain.h>
#include <packing/psd.h>

PACKING_BEGIN_DECLS

/** Options of packing_audit(). */
typedef struct packing_audit_def {
  size_t struct_size; /**< set by packing_audit_def_init() */
  double limit; /**< largest overlap and protrusion that pass, relative to the (smaller)
       radius [1]; default 1e-9 (packs of the stepper: 0.01) */
} packing_audit_def;

/** Writes the defaults; called through packing_audit_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_audit_def_fill(packing_audit_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_audit_def_init(packing_audit_def *def)
{
  packing_audit_def_fill(def, sizeof *def);
}

/** What packing_audit() found. */
typedef struct packing_audit_report {
  size_t struct_size; /**< set by packing_audit_report_init() */
  int passed;         /**< 1: no number is bad and nothing exceeds the limit */
  double
      max_overlap; /**< largest (r_i + r_j - distance) / min(r_i, r_j), at least 0 [1] */
  size_t
      overlap_i; /**< the pair of max_overlap, or #PACKING_NO_INDEX; twice the same where
       a particle overlaps its own periodic image */
  size_t overlap_j;      /**< the pair of max_overlap, or #PACKING_NO_INDEX */
  double max_protrusion; /**< largest (r - distance to the wall) / r, at least 0 [1] */
  size_t protrusion_i;   /**< the particle of max_protrusion, or #PACKING_NO_INDEX */
  size_t overlaps;       /**< pairs that overlap by more than the limit */
  size_t protrusions;    /**< particles that protrude by more than the limit */
  size_t duplicates;     /**< pairs with one centre */
  size_t
      bad_numbers; /**< particles with NaN, infinity or r <= 0; they are left out above */
  size_t bad_number_i; /**< the first of them, or #PACKING_NO_INDEX */
  double min_gap; /**< smallest (distance - r_i - r_j) / min(r_i, r_j), nearest and own
            images included; -max_overlap where there is one; +infinity where there is no pair
            [1] */
  size_t gap_i;   /**< the pair of min_gap, or #PACKING_NO_INDEX */
  size_t gap_j;   /**< the pair of min_gap, or #PACKING_NO_INDEX */
} packing_audit_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_audit_report_init(packing_audit_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Checks a pack: overlaps, the smallest gap, protrusion from the container, duplicates, bad
 *  numbers. A pair is judged by its nearest image. Ties go to the lowest index.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container; NULL: no walls, not periodic
 *  \param view the pack
 *  \param[out] report what was found
 *  \return PACKING_OK, also when the audit fails; PACKING_ERR_INVALID; PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_audit(
    packing_context *context, const packing_audit_def *def, packing_domain *domain,
    const packing_view *view, packing_audit_report *report);

/** Options of packing_measure_volume(). */
typedef struct packing_volume_def {
  size_t struct_size; /**< set by packing_volume_def_init() */
  double
      inner_margin; /**< distance of the inner region from every wall, in largest radii [1];
       default 3 */
  double
      tolerance; /**< error allowed for a cut particle, relative to it [1]; default 1e-9 */
} packing_volume_def;

/** Writes the defaults; called through packing_volume_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_volume_def_fill(packing_volume_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_volume_def_init(packing_volume_def *def)
{
  packing_volume_def_fill(def, sizeof *def);
}

/** What packing_measure_volume() found. Volumes are areas in two dimensions. */
typedef struct packing_volume_report {
  size_t struct_size;     /**< set by packing_volume_report_init() */
  double domain_volume;   /**< of the container [L^3] */
  double solid_volume;    /**< of the particles, cut exactly at the container [L^3] */
  double volume_fraction; /**< solid_volume / domain_volume [1] */
  double inner_volume;    /**< of the inner region; 0 where empty [L^3] */
  double inner_solid;     /**< of the particles cut at the inner region [L^3] */
  double inner_fraction;  /**< inner_solid / inner_volume; NaN where empty [1] */
  double error;           /**< bound or estimate of the error of both fractions [1] */
} packing_volume_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_volume_report_init(packing_volume_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures the volume fraction, whole and inner, with particles cut exactly at the borders.
 *  Particles may overlap; each counts alone. Periodic directions have no walls, so a cell
 *  periodic in all is its own inner region.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container
 *  \param view the pack: finite, radii > 0
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_volume(
    packing_context *context, const packing_volume_def *def, packing_domain *domain,
    const packing_view *view, packing_volume_report *report);

/** Bins of a coordination histogram; the last counts "so many or more". */
#define PACKING_COORDINATION_BINS 65

/** Options of packing_measure_coordination(). */
typedef struct packing_coordination_def {
  size_t struct_size; /**< set by packing_coordination_def_init() */
  double
      tolerance; /**< a contact is a gap up to tolerance * (r_i + r_j) [1]; default 1e-9 */
  int dim; /**< 3 (default) or 2: a rattler has fewer than dim + 1 contacts; 2 without a
       container: z is ignored */
} packing_coordination_def;

/** Writes the defaults; called through packing_coordination_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_coordination_def_fill(packing_coordination_def *def,
                                               size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_coordination_def_init(packing_coordination_def *def)
{
  packing_coordination_def_fill(def, sizeof *def);
}

/** What packing_measure_coordination() found. Walls do not count as contacts. */
typedef struct packing_coordination_report {
  size_t struct_size; /**< set by packing_coordination_report_init() */
  size_t contacts;    /**< pairs in contact */
  double mean;        /**< contacts a particle, 2 contacts / count; NaN of none [1] */
  double mean_no_rattlers; /**< the same among the rest once rattlers are
       removed over and over; NaN where none is left [1] */
  size_t rattlers;         /**< particles removed */
  size_t histogram
      [PACKING_COORDINATION_BINS]; /**< particles with k contacts; sums to count */
} packing_coordination_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_coordination_report_init(packing_coordination_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Counts contacts: packing_contacts_create() without walls and packing_contacts_coordination()
 *  in one. In a periodic cell every image counts, also a particle's own (on both sides of it).
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain gives the periodic directions; NULL: none
 *  \param view the pack: finite, radii > 0, fewer than 2^32 particles
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_coordination(
    packing_context *context, const packing_coordination_def *def, packing_domain *domain,
    const packing_view *view, packing_coordination_report *report);

/** What packing_measure_sizes() found. */
typedef struct packing_sizes_report {
  size_t struct_size; /**< set by packing_sizes_report_init() */
  double ks;          /**< Kolmogorov-Smirnov distance by number [1] */
  double ks_limit;    /**< 1.36 / sqrt(count): 5 % of true samples exceed it [1] */
  double ks_mass;     /**< largest difference of the curves by mass [1] */
  double
      mean_relative_error; /**< mean over the quantiles 0.05, 0.10 ... 0.95 by number of
       (placed - asked) / asked [1] */
  double min_r;            /**< smallest radius there is [L] */
  double max_r;            /**< largest radius there is [L] */
  double mean_r;           /**< mean radius [L] */
} packing_sizes_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_sizes_report_init(packing_sizes_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Compares the radii of a pack with a distribution.
 *  \param context NULL is fine
 *  \param psd what was asked
 *  \param view the pack, at least one particle: finite, radii > 0
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (no particles);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. N log N */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_measure_sizes(packing_context *context, packing_psd *psd,
                      const packing_view *view, packing_sizes_report *report);

PACKING_END_DECLS

#endif
