/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_CONTACTS_H
#define PACKING_CONTACTS_H

/** \file packing/contacts.h
 *  The contact network of a pack: who touches whom and which walls, and what follows from it:
 *  coordination, stability classes, fabric, the histogram of normals, the list of bonds. Found
 *  once, asked as often as one likes. In a periodic cell every image counts: a pair may touch
 *  several times and a particle itself, so a unit cell has the contacts of the crystal. All
 *  results are the same bytes for any number of threads. */

#include <packing/measure.h>

PACKING_BEGIN_DECLS

/** The contacts of a pack. It has its own copy of centres and radii, keeps the container, and is
 *  immutable: asking it is thread-safe, but for the message of a failure. */
typedef struct packing_contacts packing_contacts;

/** Options of packing_contacts_create(). */
typedef struct packing_contacts_def {
  size_t struct_size; /**< set by packing_contacts_def_init() */
  double tolerance;   /**< two particles touch when their surfaces are at most
         tolerance * (r_i + r_j) + gap apart, a particle a wall when
         they are at most tolerance * r + gap apart [1]; default 1e-9 */
  double gap;         /**< see `tolerance`; for bonds [L]; default 0 */
  int walls;          /**< 1 (default): contacts with walls are found too; 0: not */
  int dim; /**< 2 or 3; 0 (default): that of the container, 3 without one. 2 without
         one: z is ignored */
} packing_contacts_def;

/** Writes the defaults; called through packing_contacts_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_contacts_def_fill(packing_contacts_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_contacts_def_init(packing_contacts_def *def)
{
  packing_contacts_def_fill(def, sizeof *def);
}

/** Finds all contacts.
 *  \param context NULL is fine; kept
 *  \param def options, or NULL for the defaults
 *  \param domain the container: its walls and periodic directions; NULL: neither; kept
 *  \param view the pack: finite, radii > 0, fewer than 2^32 particles
 *  \param[out] contacts the network
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time; 48 bytes a particle, 4 a contact (10 in cells no wider
 *          than two reaches) and 4 a particle at a wall; while it is made up to 88 a particle */
PACKING_API PACKING_WARN_UNUSED packing_status packing_contacts_create(
    packing_context *context, const packing_contacts_def *def, packing_domain *domain,
    const packing_view *view, packing_contacts **contacts);

/** Destroys a network.
 *  \param contacts NULL is fine */
PACKING_API void packing_contacts_destroy(packing_contacts *contacts);

/** One contact. */
typedef struct packing_contact {
  size_t i; /**< index in the view */
  size_t j; /**< at least i; i: an image of itself; #PACKING_NO_INDEX: a wall */
  packing_vec3 normal; /**< unit, from i outwards; 0 where two centres are one [1] */
  double gap;          /**< distance of the surfaces, below 0 where they overlap [L] */
  int32_t image[3];    /**< periods that j is moved by, when both centres are wrapped as
          packing_domain_wrap() does; 0 for a wall */
  int32_t wall;        /**< number of the wall, -1 for a particle: of box and rectangle
          2 k for the low and 2 k + 1 for the high side of axis k; of sphere, circle and annulus
          0 for the outer and 1 for the inner wall; of a custom container 0; of the other kinds
          any, but always the same */
} packing_contact;

/** The number of particles.
 *  \param contacts the network
 *  \return that of the view. Thread-safe */
PACKING_API size_t packing_contacts_particles(const packing_contacts *contacts);

/** The number of contacts between particles.
 *  \param contacts the network
 *  \return each pair once for every image in contact. Thread-safe */
PACKING_API size_t packing_contacts_count(const packing_contacts *contacts);

/** The number of contacts with walls.
 *  \param contacts the network
 *  \return one for every particle and wall of it that touch. Thread-safe */
PACKING_API size_t packing_contacts_wall_count(const packing_contacts *contacts);

/** Lists contacts: those between particles sorted by (i, j, image), then those with walls sorted
 *  by (i, wall).
 *  \param contacts the network
 *  \param first where in that order to begin
 *  \param capacity room in `list`
 *  \param[out] list contacts `first`, `first` + 1 ...; may be NULL when `capacity` is 0
 *  \param[out] count how many were written
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_NOMEM. Linear time in the whole
 *          network for each call: ask for many */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_contacts_list(const packing_contacts *contacts, size_t first, size_t capacity,
                      packing_contact *list, size_t *count);

/** The number of contacts of each particle.
 *  \param contacts the network
 *  \param[out] degrees contacts with particles, an own image counts on both sides; NULL is fine
 *  \param[out] walls contacts with walls; NULL is fine. Both of packing_contacts_particles()
 *         entries, in the order of the view
 *  \return PACKING_OK; PACKING_ERR_INVALID. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_contacts_degrees(
    const packing_contacts *contacts, size_t *degrees, size_t *walls);

/** Measures coordination, as packing_measure_coordination() does: walls do not count.
 *  \param contacts the network; its `dim` decides who is a rattler
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_contacts_coordination(
    const packing_contacts *contacts, packing_coordination_report *report);

/** Options of packing_contacts_classes(). */
typedef struct packing_classes_def {
  size_t struct_size; /**< set by packing_classes_def_init() */
  packing_vec3 up; /**< against gravity, any length; 0 (default): +z, in the plane +y */
  int walls;       /**< 1 (default): contacts with walls count; 0: they do not */
} packing_classes_def;

/** Writes the defaults; called through packing_classes_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_classes_def_fill(packing_classes_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_classes_def_init(packing_classes_def *def)
{
  packing_classes_def_fill(def, sizeof *def);
}

/** What packing_contacts_classes() found: Figure 1 of the trilateration paper. The three classes
 *  share out all particles. */
typedef struct packing_classes_report {
  size_t struct_size; /**< set by packing_classes_report_init() */
  size_t degree[5];   /**< particles with 0, 1, 2, 3, and with 4 or more contacts */
  size_t supported;   /**< of those with `dim` contacts: the line from the centre along
              gravity meets the triangle of the contacts (in the plane: the segment), below the
              centre and not on its border */
  size_t non_stable;  /**< fewer than `dim` contacts, or `dim` without support */
  size_t stable;      /**< `dim` contacts with support; the same as `supported` */
  size_t firm;        /**< more than `dim` contacts */
  double non_stable_share; /**< of all particles; NaN of none [1] */
  double stable_share;     /**< of all particles; NaN of none [1] */
  double firm_share;       /**< of all particles; NaN of none [1] */
} packing_classes_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_classes_report_init(packing_classes_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Counts non stable, stable and firm particles.
 *  \param contacts the network
 *  \param def options, or NULL for the defaults
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID (also `up` along z in the plane); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_contacts_classes(const packing_contacts *contacts, const packing_classes_def *def,
                         packing_classes_report *report);

/** Which contacts are meant. */
typedef enum packing_contacts_of {
  PACKING_CONTACTS_OF_PAIRS = 0, /**< those between particles */
  PACKING_CONTACTS_OF_WALLS = 1, /**< those with walls */
  PACKING_CONTACTS_OF_ALL = 2    /**< both */
} packing_contacts_of;

/** Options of packing_contacts_fabric(). */
typedef struct packing_fabric_def {
  size_t struct_size;     /**< set by packing_fabric_def_init() */
  packing_contacts_of of; /**< default ::PACKING_CONTACTS_OF_PAIRS */
} packing_fabric_def;

/** Writes the defaults; called through packing_fabric_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_fabric_def_fill(packing_fabric_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_fabric_def_init(packing_fabric_def *def)
{
  packing_fabric_def_fill(def, sizeof *def);
}

/** A fabric tensor F = (1 / count) sum of n n^T, trace 1, isotropic 1 / dim. NaN of none. In the
 *  plane the third row and column, eigenvalue and eigenvector are those of z: 0, and (0, 0, 1). */
typedef struct packing_fabric_report {
  size_t struct_size;    /**< set by packing_fabric_report_init() */
  size_t count;          /**< directions in the sum; n and -n are one */
  int dim;               /**< 2 or 3 */
  double tensor[3][3];   /**< F [1] */
  double eigenvalues[3]; /**< falling [1] */
  double eigenvectors[3]
                     [3]; /**< row k belongs to eigenvalue k; unit, the largest component
           positive [1] */
  double sd;              /**< of the `dim` eigenvalues, with dim - 1 [1] */
  double noise_floor;     /**< sd of a diagonal term when the directions are random:
                 sqrt(4 / (45 count)), in the plane sqrt(1 / (8 count)) [1] */
} packing_fabric_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_fabric_report_init(packing_fabric_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures the fabric of the contact normals. Each contact counts once; those whose two centres
 *  are one have no normal and are left out.
 *  \param contacts the network
 *  \param def options, or NULL for the defaults
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (`of`); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_contacts_fabric(const packing_contacts *contacts, const packing_fabric_def *def,
                        packing_fabric_report *report);

/** Options of packing_measure_orientations(). */
typedef struct packing_orientations_def {
  size_t struct_size; /**< set by packing_orientations_def_init() */
  packing_vec3
      axis; /**< of the particle before it is turned, any length; 0 (default): z, in
       the plane x */
  int dim;  /**< 3 (default) or 2: directions are taken in the plane */
} packing_orientations_def;

/** Writes the defaults; called through packing_orientations_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_orientations_def_fill(packing_orientations_def *def,
                                               size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_orientations_def_init(packing_orientations_def *def)
{
  packing_orientations_def_fill(def, sizeof *def);
}

/** Measures the fabric of the particles' orientations: of one axis of each, turned by its
 *  quaternion, whose length does not matter.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param view the pack, with qw, qx, qy and qz
 *  \param[out] report what was found
 *  \return PACKING_OK; PACKING_ERR_INVALID (a column is absent; a quaternion is 0 or not finite
 *          or, in the plane, turns the axis along z); PACKING_ERR_RANGE (`dim`);
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_orientations(
    packing_context *context, const packing_orientations_def *def,
    const packing_view *view, packing_fabric_report *report);

/** Options of packing_contacts_normals() and packing_normals_layout(). */
typedef struct packing_normals_def {
  size_t struct_size;     /**< set by packing_normals_def_init() */
  packing_contacts_of of; /**< default ::PACKING_CONTACTS_OF_PAIRS */
  int bands;   /**< bands of latitude from pole to pole, 2 to 1000; default 18 */
  int sectors; /**< in the plane: equal sectors, even, 2 to 10000; default 36 */
} packing_normals_def;

/** Writes the defaults; called through packing_normals_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_normals_def_fill(packing_normals_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_normals_def_init(packing_normals_def *def)
{
  packing_normals_def_fill(def, sizeof *def);
}

/** A bin of directions n: z_lo <= n.z < z_hi (the last band: <= 1), azimuth_lo <= azimuth <
 *  azimuth_hi, where azimuth is the angle of (n.x, n.y) from x towards y, from 0 to 2 pi. Bins
 *  are equal in area: each has 4 pi (in the plane 2 pi) / number of bins. On a border rounding
 *  decides. */
typedef struct packing_normals_bin {
  double z_lo;       /**< from -1 [1]; in the plane 0 */
  double z_hi;       /**< to 1 [1]; in the plane 0 */
  double azimuth_lo; /**< from 0 [rad] */
  double azimuth_hi; /**< to 2 pi [rad] */
} packing_normals_bin;

/** Tells the bins of a histogram of normals: bands from z = -1 to z = 1, the two at the poles
 *  whole, in each of the others as many sectors as make bins about as wide as high; in the plane
 *  one band. Opposite to sector s of the m in a band is sector (s + m / 2) modulo m of the band as
 *  far from the other pole.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param dim 3 or 2
 *  \param[out] bins the first `capacity` of them; may be NULL when that is 0
 *  \param capacity room in `bins`
 *  \param[out] count how many there are, even when they did not all fit
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_normals_layout(packing_context *context, const packing_normals_def *def, int dim,
                       packing_normals_bin *bins, size_t capacity, size_t *count);

/** Counts normals in bins of equal area, so that an isotropic pack gives a flat histogram. Each
 *  contact counts twice, in the bin of n and in that of -n, so the whole sphere is filled
 *  (contacts whose two centres are one not at all). Isotropic: each bin has 2 contacts / bins.
 *  \param contacts the network, whose `dim` decides between sphere and circle
 *  \param def options, or NULL for the defaults
 *  \param[out] counts of the bins in the order of packing_normals_layout(), the first `capacity`
 *         of them; may be NULL when that is 0
 *  \param capacity room in `counts`
 *  \param[out] count how many bins there are, even when they did not all fit
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_contacts_normals(const packing_contacts *contacts, const packing_normals_def *def,
                         size_t *counts, size_t capacity, size_t *count);

PACKING_END_DECLS

#endif
