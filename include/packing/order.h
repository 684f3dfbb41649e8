/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_ORDER_H
#define PACKING_ORDER_H

/** \file packing/order.h
 *  How ordered a pack is: radial distribution, bond order (Q4, Q6 and their kind), hexatic order
 *  of discs, crystals told by common neighbours. In periodic cells every image counts, also in
 *  cells narrower than the distances asked for, so that one unit cell of a lattice gives the
 *  lattice's values. Results are the same bytes for any number of threads. Thread-safe with a
 *  context for each thread. */

#include <packing/domain.h>

PACKING_BEGIN_DECLS

/** Which particles packing_measure_rdf() tells apart. */
typedef enum packing_rdf_by {
  PACKING_RDF_ALL = 0,       /**< none: all pairs count */
  PACKING_RDF_COMPONENT = 1, /**< by component of a mixture */
  PACKING_RDF_TYPE = 2       /**< by type */
} packing_rdf_by;

/** Options of packing_measure_rdf(). */
typedef struct packing_rdf_def {
  size_t struct_size; /**< set by packing_rdf_def_init() */
  double r_max; /**< pairs closer than this count [L], > 0; default 5 mean diameters */
  size_t bins;  /**< shells of equal width from 0 to r_max, >= 1; default 100 */
  int in_diameters; /**< 1 (default): r_max, margin and the bins' radii are in mean diameters;
       0: they are lengths */
  double margin;     /**< centres stay this far from walls and open top, >= 0; default -1:
       r_max and the largest radius, so that no shell reaches a wall's depleted layer */
  packing_rdf_by by; /**< default all; else a partial distribution */
  int32_t centres;   /**< component or type of the centres; not used for all */
  int32_t partners;  /**< component or type of their partners; not used for all */
} packing_rdf_def;

/** Writes the defaults; called through packing_rdf_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_rdf_def_fill(packing_rdf_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_rdf_def_init(packing_rdf_def *def)
{
  packing_rdf_def_fill(def, sizeof *def);
}

/** One shell: partners at distances in [lo, hi). */
typedef struct packing_rdf_bin {
  double lo;      /**< inner radius [L], or in mean diameters */
  double hi;      /**< outer radius */
  uint64_t count; /**< partners met there, over all centres */
  double g;       /**< count / (centres * density * volume of the shell) [1] */
  double
      cumulative; /**< partners closer than hi, of one centre: a coordination number [1] */
} packing_rdf_bin;

/** What packing_measure_rdf() found beside the shells. */
typedef struct packing_rdf_report {
  size_t struct_size; /**< set by packing_rdf_report_init() */
  size_t bins;        /**< shells there are */
  size_t
      centres; /**< particles whose partners were counted; 0: the shells' g and cumulative
       are NaN */
  size_t partners; /**< particles that may be partners */
  uint64_t pairs;  /**< partners met, over all centres and shells */
  double
      density; /**< of partners, in the region that the margin leaves [L^-3], 2D [L^-2] */
  double mean_d; /**< mean diameter of all particles [L] */
  double margin; /**< as used, in the unit of the shells; 0 in a fully periodic cell */
  size_t peak;   /**< the shell of the largest g, or #PACKING_NO_INDEX */
} packing_rdf_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_rdf_report_init(packing_rdf_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures the radial distribution g(r): how many partners stand at distance r of a particle,
 *  against as many in a shell of a pack of the same density without any order. Shells are rings
 *  in two dimensions.
 *
 *  Where there are walls only particles at least `margin` inside are centres, all are their
 *  partners, and the density is the number in the region that the margin leaves over its volume.
 *  With the default margin no shell meets a wall; a smaller one has more centres and a bias. An
 *  open top bounds the centres as a wall does: close the domain at the surface of a bed. In
 *  periodic directions all images count, a particle's own too, and the density is that of the
 *  cell; g of N random points is thus 1 - 1 / N on average, and r_max may exceed the cell.
 *
 *  A distance that is a shell's border up to rounding may fall on either side: let borders miss
 *  the distances of a perfect lattice.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container
 *  \param view the pack: finite, radii > 0
 *  \param[out] bins the first `capacity` shells; may be NULL when that is 0
 *  \param capacity room in `bins`
 *  \param[out] report what was found beside the shells
 *  \return PACKING_OK, also without a centre; PACKING_ERR_INVALID (also: no domain, or no column
 *          of components); PACKING_ERR_RANGE; PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear in
 *          centres and in partners within r_max; memory goes with particles and bins, not with
 *          pairs */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_measure_rdf(packing_context *context, const packing_rdf_def *def,
                    packing_domain *domain, const packing_view *view,
                    packing_rdf_bin *bins, size_t capacity, packing_rdf_report *report);

/** Who is a neighbour. */
typedef enum packing_neighbours_kind {
  PACKING_NEIGHBOURS_WITHIN = 0, /**< centres at most factor (r_i + r_j) + gap apart */
  PACKING_NEIGHBOURS_NEAREST =
      1 /**< the `nearest` closest centres; i may be near to j and not j to i */
} packing_neighbours_kind;

/** Options of packing_neighbours_create(). */
typedef struct packing_neighbours_def {
  size_t struct_size;           /**< set by packing_neighbours_def_init() */
  packing_neighbours_kind kind; /**< default within */
  double
      factor; /**< within: share of r_i + r_j [1], > 0; default 1.2, which lies between the
       first and the second shell of close-packed lattices (1 and sqrt 2) and beyond the second
       of BCC (1.1547). Contacts: 1 + tolerance */
  double gap; /**< within: added to that [L], >= 0; default 0 */
  size_t
      nearest; /**< nearest: how many, 1 to 256; default 12. Fewer only where there are no
       more; of equally far ones the lowest index */
  double
      margin; /**< particles closer than this to a wall or open top are neighbours to others
       but count in no mean or share [L], >= 0; default 0: all count */
  int dim;    /**< without a domain: 3 (default) or 2, where z is ignored */
} packing_neighbours_def;

/** Writes the defaults; called through packing_neighbours_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_neighbours_def_fill(packing_neighbours_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_neighbours_def_init(packing_neighbours_def *def)
{
  packing_neighbours_def_fill(def, sizeof *def);
}

/** Who is whose neighbour; immutable, one owner. Copies the centres. */
typedef struct packing_neighbours packing_neighbours;

/** Finds the neighbours of all particles.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container, which gives the periodic directions and the walls of the margin;
 *         NULL: an open pack without walls
 *  \param view the pack: finite, radii > 0
 *  \param[out] neighbours the lists
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time; 49 bytes a particle and 16 a neighbour, and
 *          some 50 a particle more meanwhile */
PACKING_API PACKING_WARN_UNUSED packing_status packing_neighbours_create(
    packing_context *context, const packing_neighbours_def *def, packing_domain *domain,
    const packing_view *view, packing_neighbours **neighbours);

/** Destroys the lists.
 *  \param neighbours NULL is fine */
PACKING_API void packing_neighbours_destroy(packing_neighbours *neighbours);

/** The number of particles.
 *  \param neighbours the lists
 *  \return that of the view. Thread-safe */
PACKING_API size_t packing_neighbours_count(const packing_neighbours *neighbours);

/** A neighbour of a particle. */
typedef struct packing_neighbour {
  size_t j;       /**< index in the view */
  packing_vec3 d; /**< from the particle's centre to the neighbour's, of this image [L] */
  double distance; /**< length of d [L] */
} packing_neighbour;

/** Tells the neighbours of one particle.
 *  \param neighbours the lists
 *  \param i index in the view
 *  \param[out] list in an order that depends on the pack only, the first `capacity` of them;
 *         may be NULL when that is 0. An index comes again where several images are near
 *  \param capacity room in `list`
 *  \param[out] count how many there are, even when they did not all fit
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (i). Thread-safe, but for the
 *          message of a failure */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_neighbours_of(const packing_neighbours *neighbours, size_t i,
                      packing_neighbour *list, size_t capacity, size_t *count);

/** Options of packing_measure_bond_order(). */
typedef struct packing_bond_order_def {
  size_t struct_size; /**< set by packing_bond_order_def_init() */
  int l;              /**< degree of the harmonics, even, 2 to 12; default 6 */
} packing_bond_order_def;

/** Writes the defaults; called through packing_bond_order_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_bond_order_def_fill(packing_bond_order_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_bond_order_def_init(packing_bond_order_def *def)
{
  packing_bond_order_def_fill(def, sizeof *def);
}

/** Bond order around one particle; all 0 without neighbours. */
typedef struct packing_bond_order {
  double
      q; /**< q_l = sqrt(4 pi / (2 l + 1) sum_m abs(q_lm)^2), q_lm the mean of Y_lm over the
       particle's bonds [1] */
  double
      averaged; /**< the same of q_lm averaged over the particle and its neighbours [1] */
  double
      w; /**< w_l / (sum_m abs(q_lm)^2)^(3/2), w_l the sum of 3j q_lm q_lm' q_lm'' [1] */
} packing_bond_order;

/** What packing_measure_bond_order() found. */
typedef struct packing_bond_order_report {
  size_t struct_size;   /**< set by packing_bond_order_report_init() */
  size_t counted;       /**< particles that count: not within the margin */
  size_t isolated;      /**< of these, without neighbours */
  size_t bonds;         /**< neighbours of those that count, together */
  double mean;          /**< of q over those that count; NaN of none [1] */
  double mean_averaged; /**< of the averaged q [1] */
  double mean_w;        /**< of w over those with neighbours; NaN of none [1] */
  double whole;         /**< Q_l of all bonds of those that count; NaN of none [1] */
  double whole_w;       /**< W_l of all these bonds, normalised as w [1] */
} packing_bond_order_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_bond_order_report_init(packing_bond_order_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures bond order (Steinhardt, Nelson and Ronchetti, Phys. Rev. B 28, 784, 1983, equations
 *  1.3 to 1.6; averaged: Lechner and Dellago, J. Chem. Phys. 129, 114707, 2008, equation 6).
 *  Independent of how the pack is turned. FCC: Q4 0.190941, Q6 0.574524; HCP 0.097222, 0.484762;
 *  SC 0.763763, 0.353553; BCC of 8 neighbours 0.509175, 0.628539, of 14 0.036370, 0.510688.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param neighbours the bonds
 *  \param[out] local of each particle, the first `capacity`; may be NULL when that is 0
 *  \param capacity room in `local`
 *  \param[out] report what was found over all that count
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (l); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear in the bonds; 16 (l + 1) + 40 bytes a particle meanwhile */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_bond_order(
    packing_context *context, const packing_bond_order_def *def,
    const packing_neighbours *neighbours, packing_bond_order *local, size_t capacity,
    packing_bond_order_report *report);

/** Options of packing_measure_hexatic(). */
typedef struct packing_hexatic_def {
  size_t struct_size; /**< set by packing_hexatic_def_init() */
  int fold; /**< symmetry looked for, 2 to 12; default 6. 4: of the square lattice */
} packing_hexatic_def;

/** Writes the defaults; called through packing_hexatic_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_hexatic_def_fill(packing_hexatic_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_hexatic_def_init(packing_hexatic_def *def)
{
  packing_hexatic_def_fill(def, sizeof *def);
}

/** Hexatic order around one disc; all 0 without neighbours. */
typedef struct packing_hexatic {
  double re; /**< real part of psi_6 [1] */
  double im; /**< imaginary part; atan2(im, re) / 6 is the direction of the bonds [1] */
  double modulus;    /**< abs(psi_6), 1 in the hexagonal lattice [1] */
  size_t neighbours; /**< how many it has */
} packing_hexatic;

/** What packing_measure_hexatic() found. */
typedef struct packing_hexatic_report {
  size_t struct_size; /**< set by packing_hexatic_report_init() */
  size_t counted;     /**< discs that count: not within the margin */
  size_t isolated;    /**< of these, without neighbours */
  double mean; /**< of abs(psi_6) over those that count: how ordered the surroundings are;
       NaN of none [1] */
  double
      whole; /**< abs of the mean psi_6 over them: whether one direction prevails [1] */
  double share; /**< of them with exactly 6 neighbours [1] */
} packing_hexatic_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_hexatic_report_init(packing_hexatic_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures the hexatic order of discs: psi_6 of a disc is the mean of exp(6 i theta) over its
 *  bonds at angles theta (Halperin and Nelson, Phys. Rev. Lett. 41, 121, 1978). With another
 *  `fold`, that stands in place of the 6.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param neighbours the bonds, of a pack in two dimensions
 *  \param[out] local of each disc, the first `capacity`; may be NULL when that is 0
 *  \param capacity room in `local`
 *  \param[out] report what was found over all that count
 *  \return PACKING_OK; PACKING_ERR_INVALID (also: three dimensions); PACKING_ERR_RANGE (fold);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear in the bonds */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_measure_hexatic(packing_context *context, const packing_hexatic_def *def,
                        const packing_neighbours *neighbours, packing_hexatic *local,
                        size_t capacity, packing_hexatic_report *report);

/** What a particle and its neighbours are a piece of. */
typedef enum packing_structure {
  PACKING_STRUCTURE_OTHER = 0,       /**< none of these */
  PACKING_STRUCTURE_FCC = 1,         /**< face-centred cubic: twelve bonds 421 */
  PACKING_STRUCTURE_HCP = 2,         /**< hexagonal close-packed: six 421 and six 422 */
  PACKING_STRUCTURE_BCC = 3,         /**< body-centred cubic: eight 666 and six 444 */
  PACKING_STRUCTURE_ICOSAHEDRAL = 4, /**< the centre of an icosahedron: twelve 555 */
  PACKING_STRUCTURE_END = 5          /**< one past the last structure */
} packing_structure;

/** The name of a structure, as in "fcc".
 *  \param structure any value
 *  \return a constant string, "unknown" for other values. Thread-safe */
PACKING_API const char *packing_structure_name(packing_structure structure);

/** What packing_measure_common_neighbours() found. */
typedef struct packing_common_neighbours_report {
  size_t struct_size; /**< set by packing_common_neighbours_report_init() */
  size_t counted;     /**< particles that count: not within the margin */
  size_t number[PACKING_STRUCTURE_END]; /**< of them, of each structure */
} packing_common_neighbours_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void
packing_common_neighbours_report_init(packing_common_neighbours_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Tells crystals by common neighbours. A bond is marked by the number of neighbours that its
 *  ends share, the bonds among these, and the most bonds of a connected piece of them (Honeycutt
 *  and Andersen, J. Phys. Chem. 91, 4950, 1987, without their first digit; Faken and Jonsson,
 *  Comput. Mater. Sci. 2, 279, 1994). The default neighbours suit all structures told apart.
 *  \param context NULL is fine
 *  \param neighbours the bonds, `within`, of a pack in three dimensions
 *  \param[out] structures of each particle, the first `capacity`; may be NULL when that is 0
 *  \param capacity room in `structures`
 *  \param[out] report how many of each count
 *  \return PACKING_OK; PACKING_ERR_INVALID (also: two dimensions, `nearest`);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear in the bonds */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_common_neighbours(
    packing_context *context, const packing_neighbours *neighbours,
    packing_structure *structures, size_t capacity,
    packing_common_neighbours_report *report);

PACKING_END_DECLS

#endif
