/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PORES_H
#define PACKING_PORES_H

/** \file packing/pores.h
 *  The void between particles as a network. A pore is the empty sphere (disc) that touches the
 *  four (three) particles of one cell of the regular (power) triangulation from outside; a
 *  constriction is the narrowest place on the way from a pore to the next: the sphere, centred in
 *  their plane, that touches the three particles of the face between two cells (in two
 *  dimensions: half the gap between two). Equations 2 and 3 of the sequential trilateration method, solved in a
 *  local frame as one quadratic.
 *
 *  The triangulation is that of the centres with weights r^2, made by exact predicates. For
 *  unequal spheres it is not the diagram of distances to surfaces: where another particle reaches
 *  into a cell's sphere, the empty one beside it that touches that particle instead is taken,
 *  wherever it is found. Every sphere is held against all particles and walls, and tells what it
 *  is limited by. Results are the same bytes for any number of threads. */

#include <packing/domain.h>

PACKING_BEGIN_DECLS

/** Pores, the constrictions between them, and how they hang together. Immutable. */
typedef struct packing_pores packing_pores;

/** When neighbouring pores are one. */
typedef enum packing_pores_merge {
  PACKING_PORES_MERGE_NONE = 0, /**< one for each cell; cells that share one sphere (an
        octahedral hole is four cells) are one pore at every level */
  PACKING_PORES_MERGE_OVERLAP =
      1 /**< those that overlap a larger one by more than a share of
        their diameter belong to it (level 1 of Reboul, Vincens and Cambou, Granul. Matter 10,
        2008, 457) */
} packing_pores_merge;

/** Options of packing_pores_create(). */
typedef struct packing_pores_def {
  size_t struct_size; /**< set by packing_pores_def_init() */
  int dim; /**< 2 or 3; 0 (default): the domain's, 3 where there is none. A domain's dimension
       cannot be overruled */
  packing_pores_merge merge; /**< default ::PACKING_PORES_MERGE_NONE */
  double
      overlap; /**< with ::PACKING_PORES_MERGE_OVERLAP: share of a pore's diameter inside the
         larger one from which on it belongs to that, (R + r - d) / (2 r) for radii R >= r a
         distance d apart, in [0, 1] [1]; default 0.5 */
  double
      tolerance; /**< in (0, 0.1]; default 1e-6 [1]: neighbouring spheres whose centres and
         radii agree to this share of the radius are one; a cell is flat, without a sphere of its
         own, when the determinant of its edges is at most this share of the longest's cube
         (square); a particle intrudes when it is deeper in a sphere than this share of the
         radius; a constriction below this share of its smallest particle's radius is closed */
} packing_pores_def;

/** Writes the defaults; called through packing_pores_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_pores_def_fill(packing_pores_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_pores_def_init(packing_pores_def *def)
{
  packing_pores_def_fill(def, sizeof *def);
}

/** What gave a pore or a constriction its radius. */
typedef enum packing_pore_limit {
  PACKING_PORE_FREE = 0,        /**< it touches the particles that form it */
  PACKING_PORE_BY_PARTICLE = 1, /**< another particle reaches in, and no
        empty sphere that touches all its neighbours was found nearby: the radius is the distance to
        its surface, the centre is kept */
  PACKING_PORE_BY_WALL = 2,     /**< a wall is nearer: the radius is the distance to it */
  PACKING_PORE_OPEN = 3 /**< constrictions only: the way has no narrow place between the
            two pores, one is a shoulder of the other; radius and centre are those of the
            smaller */
} packing_pore_limit;

/** A pore. */
typedef struct packing_pore {
  packing_vec3 centre; /**< inside the cell along periodic directions [L] */
  double radius;       /**< of the empty sphere (disc), > 0 [L] */
  size_t particles
      [4];      /**< that it touches, or would if nothing limited it, rising; in 2D the
        last is #PACKING_NO_INDEX */
  size_t cells; /**< cells of the triangulation in it */
  size_t
      coordination; /**< constrictions that end here (both ends of one that leads to its own
        image) */
  packing_pore_limit limit; /**< never ::PACKING_PORE_OPEN */
} packing_pore;

/** A constriction between pores `a` and `b`. */
typedef struct packing_constriction {
  size_t a;     /**< a pore */
  size_t b;     /**< a pore, >= a */
  int image[3]; /**< periods to add to the centre of `b` to stand where the way from `a`
       leads; not all 0 where a = b */
  packing_vec3 centre; /**< inside the cell along periodic directions [L] */
  double radius;       /**< of the sphere (disc) that just passes, > 0 [L] */
  size_t particles[3]; /**< that form it, rising; in 2D the last is #PACKING_NO_INDEX */
  packing_pore_limit limit; /**< what gave the radius */
} packing_constriction;

/** Sums over a network. Spheres are discs in two dimensions. */
typedef struct packing_pores_report {
  size_t struct_size;   /**< set by packing_pores_report_init() */
  int dim;              /**< 2 or 3 */
  size_t pores;         /**< there are */
  size_t constrictions; /**< there are */
  size_t cells;         /**< of the triangulation, each of a periodic cell's once */
  size_t
      flat_cells; /**< cells too flat for a sphere of their own; they belong to a neighbour */
  size_t outside; /**< cells whose sphere is centred outside the container (without one:
        outside the box around the particles) and left out */
  size_t closed;  /**< cells without a sphere: none touches all corners from outside, or
        its centre lies in a particle */
  size_t blocked; /**< pores limited by a particle */
  size_t cut;     /**< pores limited by a wall */
  size_t closed_constrictions; /**< faces between pores that nothing passes: the particles
        overlap, another one or a wall stands in the way */
  size_t blocked_constrictions; /**< constrictions limited by a particle or a wall */
  size_t open_constrictions;    /**< constrictions ::PACKING_PORE_OPEN */
  size_t hidden; /**< particles without a cell in the power diagram: inside larger ones */
  double min_r;  /**< smallest radius of free pores; NaN where there is none [L] */
  double mean_r; /**< mean radius of free pores; NaN where there is none [L] */
  double max_r;  /**< largest radius of free pores; NaN where there is none [L] */
  double min_constriction_r;  /**< the same of free constrictions [L] */
  double mean_constriction_r; /**< the same of free constrictions [L] */
  double max_constriction_r;  /**< the same of free constrictions [L] */
  double mean_coordination;   /**< constrictions that end at a pore; NaN of none [1] */
} packing_pores_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_pores_report_init(packing_pores_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Finds the pores of a pack and the constrictions between them.
 *
 *  Spheres centred outside the container are left out, those that cross its wall shrink to the
 *  distance from it. Along periodic directions each pore and each constriction is listed once.
 *  Fewer than dim + 1 particles, or all in one plane (line), have no pores. All voids of equal
 *  spheres are found, and most where sizes differ: doc/methods/pores.md has figures.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container, whose walls and periodic directions count; NULL: none
 *  \param view the pack: finite, radii > 0
 *  \param[out] pores the network
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (also beyond 4e9 cells);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. Nearly linear; some 5 s and 5 kB a particle at 1e5
 *          spheres on one thread */
PACKING_API PACKING_WARN_UNUSED packing_status packing_pores_create(
    packing_context *context, const packing_pores_def *def, packing_domain *domain,
    const packing_view *view, packing_pores **pores);

/** Destroys a network.
 *  \param pores NULL is fine */
PACKING_API void packing_pores_destroy(packing_pores *pores);

/** Tells the sums.
 *  \param pores the network
 *  \param[out] report the sums
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL); PACKING_ERR_ABI. Thread-safe, but for the
 *          message of a failure */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_pores_summary(const packing_pores *pores, packing_pores_report *report);

/** Copies pores.
 *  \param pores the network
 *  \param first the first to copy
 *  \param capacity room in `list`
 *  \param[out] list pores [first, first + capacity), as far as there are; may be NULL when
 *         capacity is 0
 *  \param[out] count how many there are in all
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL). Thread-safe, but for the message of a
 *          failure */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_pores_list(const packing_pores *pores, size_t first, size_t capacity,
                   packing_pore *list, size_t *count);

/** Copies constrictions, sorted by (a, b, image, particles).
 *  \param pores the network
 *  \param first the first to copy
 *  \param capacity room in `list`
 *  \param[out] list constrictions [first, first + capacity), as far as there are; may be NULL
 *         when capacity is 0
 *  \param[out] count how many there are in all
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL). Thread-safe, but for the message of a
 *          failure */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_pores_constrictions(const packing_pores *pores, size_t first, size_t capacity,
                            packing_constriction *list, size_t *count);

/** What a size distribution is of. */
typedef enum packing_pores_part {
  PACKING_PORES_PORES = 0,        /**< pores */
  PACKING_PORES_CONSTRICTIONS = 1 /**< constrictions */
} packing_pores_part;

/** The size distribution of free pores or free constrictions (those that touch what forms
 *  them), as a curve to be drawn: every radius in rising order, and the share of those not
 *  larger.
 *  \param pores the network
 *  \param part of what
 *  \param by ::PACKING_BY_NUMBER: each counts alike; ::PACKING_BY_MASS: by the volume (area) of
 *         its sphere (disc), r^dim
 *  \param capacity room in `radii` and in `passing`
 *  \param[out] radii rising [L]; NULL when capacity is 0
 *  \param[out] passing cumulative share, the last one 1 [1]; may be NULL
 *  \param[out] count how many there are in all
 *  \return PACKING_OK; PACKING_ERR_INVALID (NULL, an unknown part or share). Thread-safe, but for
 *          the message of a failure. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_pores_sizes(const packing_pores *pores, packing_pores_part part, packing_by by,
                    size_t capacity, double *radii, double *passing, size_t *count);

PACKING_END_DECLS

#endif
