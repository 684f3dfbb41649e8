/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PLACER_H
#define PACKING_PLACER_H

/** \file packing/placer.h
 *  Constructive placers: one interface, one constructor and one def per method. Make a
 *  placer, call packing_placer_step() until the state is no longer RUNNING, destroy it. The
 *  caller owns the loop, the progress bar, cancelling and stopping; between steps the store
 *  holds a valid pack.
 *
 *  Particles that stand in the store already are obstacles. The store is borrowed: it must
 *  outlive the placer, and be changed by nobody else meanwhile. Domain and distribution are
 *  kept. One seed, stream and input give the same bytes for any threads and instruction
 *  set. A placer and its store are used by one thread at a time; the work inside runs on the
 *  threads of the context. */

#include <packing/domain.h>
#include <packing/particles.h>
#include <packing/psd.h>

PACKING_BEGIN_DECLS

/** A placer at work; one owner. */
typedef struct packing_placer packing_placer;

/** How far a placer has come. */
typedef enum packing_placer_state {
  PACKING_PLACER_RUNNING = 0, /**< step again */
  PACKING_PLACER_DONE = 1,    /**< all that was asked is placed */
  PACKING_PLACER_SATURATED =
      2, /**< no further particle fits (`rsa`: proved) or no site is left
       (`lattice`); less than asked */
  PACKING_PLACER_GAVE_UP = 3 /**< a stated number of failures in a row; less than asked */
} packing_placer_state;

/** The name of a state, as in "saturated".
 *  \param state any value
 *  \return a constant string. Thread-safe */
PACKING_API const char *packing_placer_state_name(packing_placer_state state);

/** What a placer has done so far. */
typedef struct packing_placer_report {
  size_t struct_size;         /**< set by packing_placer_report_init() */
  packing_placer_state state; /**< whether to go on */
  size_t placed;              /**< particles added to the store */
  size_t unplaced;            /**< particles drawn that found no place */
  uint64_t attempts;          /**< positions tried */
  double solid_volume;        /**< of the particles placed [L^3], 2D [L^2] */
  double volume_fraction;     /**< solid_volume over the volume of the domain [1] */
  double progress;            /**< 0 to 1, of what was asked; an estimate */
} packing_placer_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_placer_report_init(packing_placer_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Works on for a while.
 *  \param placer the placer
 *  \param budget how much work, >= 1; one unit takes a few milliseconds at most
 *  \param[out] report what has been done; NULL is fine
 *  \return PACKING_OK, also once it has ended (then nothing happens); PACKING_ERR_NOMEM (the
 *          pack is valid, the step can be repeated); PACKING_ERR_INVALID (placer NULL);
 *          PACKING_ERR_RANGE (budget 0); PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_placer_step(packing_placer *placer, size_t budget, packing_placer_report *report);

/** Destroys a placer; the pack stays.
 *  \param placer NULL is fine */
PACKING_API void packing_placer_destroy(packing_placer *placer);

/** In which order drawn radii are placed. */
typedef enum packing_order {
  PACKING_ORDER_DRAWN = 0,     /**< as they come */
  PACKING_ORDER_DESCENDING = 1 /**< all are drawn first, the largest is placed first */
} packing_order;

/** Options of packing_rsa_create(). */
typedef struct packing_rsa_def {
  size_t struct_size; /**< set by packing_rsa_def_init() */
  uint64_t seed;      /**< default 1 */
  uint64_t stream;    /**< which pack of that seed; default 0 */
  size_t count;       /**< particles to add; 0 (default): no limit */
  double
      volume_fraction; /**< stop when the particles added reach this share of the domain's
       volume, to half a particle [1]; 0 (default): no limit */
  packing_order
      order; /**< default drawn; descending needs a count or a volume fraction */
  uint64_t
      max_failures; /**< give up after so many refusals of one radius; default 1000000.
       Not used for equal sizes, which end in proved saturation */
} packing_rsa_def;

/** Writes the defaults; called through packing_rsa_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_rsa_def_fill(packing_rsa_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_rsa_def_init(packing_rsa_def *def)
{
  packing_rsa_def_fill(def, sizeof *def);
}

/** Makes a placer by random sequential addition: a centre uniform where the particle lies
 *  inside the domain, refused when it overlaps a particle. A drawn radius is kept until it
 *  is placed, so the sizes are those of the distribution. Without count and volume fraction
 *  it runs to saturation.
 *
 *  Equal sizes: cells for the first darts, then a list of the voxels not covered by one
 *  exclusion sphere, split and culled until none is left, which proves saturation (Zhang and
 *  Torquato, Phys. Rev. E 88, 053312, 2013; Ebeida et al., Comput. Graph. Forum 31, 785,
 *  2012). Saturation in a periodic cell: 0.3841 (3D), 0.5471 (2D).
 *  Other sizes: a grid with one level per octave of radii.
 *  Campello and Cassares (Lat. Am. J. Solids Struct. 13, 23, 2016), section 2, step 2.
 *  Cost: linear in the particles up to saturation for equal sizes; else each dart looks into
 *  some 27 cells an octave of radii, and darts a particle grow as the free share falls.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container; kept
 *  \param psd radii; kept
 *  \param particles the store, of the domain's dimension; a component column is filled
 *  \param[out] placer the placer
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (volume_fraction: negative, or
 *          above what equal sizes reach in a periodic cell; count: beyond that and the scatter of
 *          a small cell; dimensions that differ);
 *          PACKING_ERR_GEOMETRY (the largest particle fits nowhere); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_rsa_create(
    packing_context *context, const packing_rsa_def *def, packing_domain *domain,
    packing_psd *psd, packing_particles *particles, packing_placer **placer);

/** Arrangements of packing_lattice_create(). */
typedef enum packing_lattice_kind {
  PACKING_LATTICE_CELLS = 0, /**< a random point in each reference cell */
  PACKING_LATTICE_SC = 1,    /**< simple cubic, 3D */
  PACKING_LATTICE_BCC = 2,   /**< body-centred cubic, 3D */
  PACKING_LATTICE_FCC = 3,   /**< face-centred cubic, 3D */
  PACKING_LATTICE_HCP = 4,   /**< hexagonal close packing, 3D, layers along z */
  PACKING_LATTICE_SIMPLE_HEXAGONAL = 5, /**< hexagonal layers above one another, 3D */
  PACKING_LATTICE_HEXAGONAL = 6,        /**< hexagonal (triangular), 2D */
  PACKING_LATTICE_SQUARE = 7,           /**< square, 2D */
  PACKING_LATTICE_END = 8               /**< one past the last kind */
} packing_lattice_kind;

/** The name of an arrangement, as in "simple-hexagonal".
 *  \param kind any value
 *  \return a constant string, NULL for other values. Thread-safe */
PACKING_API const char *packing_lattice_kind_name(packing_lattice_kind kind);

/** Options of packing_lattice_create(). */
typedef struct packing_lattice_def {
  size_t struct_size;        /**< set by packing_lattice_def_init() */
  packing_lattice_kind kind; /**< default cells */
  uint64_t seed;             /**< default 1 */
  uint64_t stream;           /**< which pack of that seed; default 0 */
  size_t count;     /**< particles to add; 0 (default): all that fit; needed by cells */
  double spacing_r; /**< radius for which the lattice is drawn: neighbours are
       2 spacing_r apart [L]; 0 (default): the largest of the distribution */
  double cell;      /**< cells: edge l of a reference cell [L]; 0 (default): the largest
       with which `count` particles fit under the container's height */
} packing_lattice_def;

/** Writes the defaults; called through packing_lattice_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_lattice_def_fill(packing_lattice_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_lattice_def_init(packing_lattice_def *def)
{
  packing_lattice_def_fill(def, sizeof *def);
}

/** Makes a placer that fills a lattice, bottom first (z, then y, then x). A lattice starts at
 *  the lower bounds of the container, one radius inside, and is cut to it: only whole
 *  particles inside, free of those in the store. In periodic directions the cell must hold a
 *  whole number of lattice periods to 1e-9 relative; then the lattice is stretched to fit
 *  exactly.
 *
 *  Cells (Liu and You, Adv. Mech. Eng. 2013, 284693, equations 1 to 4): a cuboid of k x k cells a layer stands in the container
 *  (in a cylinder: in the square inscribed in its circle), k = floor(width / l); each cell
 *  takes one particle, its centre uniform in [r, l - r] of the cell, so that nothing
 *  overlaps. For box, rectangle and cylinder along z. Cost: linear in the sites.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container; kept
 *  \param psd radii, none above spacing_r; kept
 *  \param particles the store, of the domain's dimension
 *  \param[out] placer the placer
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (kind, dimensions, spacing_r,
 *          cell; `count` particles need more height than there is: the message says how much);
 *          PACKING_ERR_GEOMETRY (a periodic cell that the lattice does not tile, nothing fits);
 *          PACKING_ERR_UNSUPPORTED (cells in another container); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_lattice_create(
    packing_context *context, const packing_lattice_def *def, packing_domain *domain,
    packing_psd *psd, packing_particles *particles, packing_placer **placer);

PACKING_END_DECLS

#endif
