/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_POROSITY_H
#define PACKING_POROSITY_H

/** \file packing/porosity.h
 *  Where the void is: porosity profiles along an axis and along a radius, local porosity on a
 *  grid of cells, planar sections and their images. All volumes and areas are those of
 *  particles cut exactly at the container, as in packing_measure_volume(); each particle
 *  counts alone, so overlaps count twice (an image, being a picture, shows their union). In
 *  periodic directions nothing ends and nothing cuts: every image counts. The results are the
 *  same bytes for any number of threads. Thread-safe with a context for each thread. */

#include <packing/domain.h>

PACKING_BEGIN_DECLS

/** Across what a profile is taken. */
typedef enum packing_profile_kind {
  PACKING_PROFILE_SLABS = 0, /**< slabs across an axis; the profile goes along it */
  PACKING_PROFILE_CYLINDERS =
      1, /**< cylindrical shells round a line along an axis; in two
       dimensions rings */
  PACKING_PROFILE_SPHERES =
      2 /**< spherical shells round a point; in two dimensions rings */
} packing_profile_kind;

/** Options of packing_measure_profile(). */
typedef struct packing_profile_def {
  size_t struct_size;        /**< set by packing_profile_def_init() */
  packing_profile_kind kind; /**< default slabs */
  packing_axis axis;   /**< of slabs and cylinders; default z. In two dimensions slabs
       need x or y, and rings have no axis */
  int own_centre;      /**< 1: `centre` holds; 0 (default): the middle of the container's
       bounds */
  packing_vec3 centre; /**< of shells: the point, or any point of the line [L] */
  double from;         /**< where the first bin begins: a coordinate along the axis or a
       radius >= 0 [L]; default 0 */
  double to;        /**< where the last bin ends [L], > from. Default 0, as is `from`: the
       whole container; for shells from 0 to its farthest point (in periodic directions to half
       the cell) */
  size_t bins;      /**< of equal width, >= 1; default 50 */
  double tolerance; /**< error allowed for the part of a particle in a bin, relative to
       the particle [1]; default 1e-10 */
} packing_profile_def;

/** Writes the defaults; called through packing_profile_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_profile_def_fill(packing_profile_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_profile_def_init(packing_profile_def *def)
{
  packing_profile_def_fill(def, sizeof *def);
}

/** A slab or shell. In two dimensions volumes are areas. */
typedef struct packing_profile_bin {
  double from;     /**< coordinate or radius where it begins [L] */
  double to;       /**< where it ends, and the next begins [L] */
  double volume;   /**< of the container within it [L^3] */
  double solid;    /**< of the particles within it [L^3] */
  double porosity; /**< 1 - solid / volume; NaN where volume is 0 [1] */
} packing_profile_bin;

/** What packing_measure_profile() found on the whole. */
typedef struct packing_profile_report {
  size_t struct_size;  /**< set by packing_profile_report_init() */
  double from;         /**< where the first bin begins [L] */
  double to;           /**< where the last bin ends [L] */
  packing_vec3 centre; /**< of shells [L] */
  double volume;       /**< of the container in all bins [L^3] */
  double solid;        /**< of the particles in all bins [L^3] */
  double porosity;     /**< 1 - solid / volume; NaN where volume is 0 [1] */
  double error;        /**< bound or estimate of the error of `solid` / `volume` [1] */
} packing_profile_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_profile_report_init(packing_profile_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures porosity in slabs or shells, each with the exact volume of the container and of the
 *  particles in it. A container periodic along the axis of slabs or cylinders counts for one
 *  period; a periodic direction that shells grow into counts as far as they reach.
 *  Closed forms (caps, lenses, elliptic integrals) for particles that no wall cuts, for slabs of
 *  boxes and in two dimensions; one-dimensional quadrature to `tolerance` else; custom
 *  containers go no further than 1e-4 of a particle that their wall cuts. In a periodic cell
 *  the bins may reach over 1e6 images at most.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container
 *  \param view the pack: finite, radii > 0
 *  \param[out] bins from the first, at most `capacity` of them; may be NULL when that is 0
 *  \param capacity room in `bins`
 *  \param[out] count how many there are: `bins` of the options
 *  \param[out] report the whole
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_GEOMETRY (a custom
 *          container answers NaN); PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear in the particles
 *          times the bins that each meets. Source: de Klerk, AIChE J. 49, 2003, 2022 for what
 *          a radial profile shows */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_profile(
    packing_context *context, const packing_profile_def *def, packing_domain *domain,
    const packing_view *view, packing_profile_bin *bins, size_t capacity, size_t *count,
    packing_profile_report *report);

/** Options of packing_measure_porosity_map(). */
typedef struct packing_porosity_map_def {
  size_t struct_size; /**< set by packing_porosity_map_def_init() */
  packing_bounds
      bounds; /**< the box of all cells [L]; default all 0: the container's bounds */
  size_t nx;  /**< cells along x, >= 1; default 10 */
  size_t ny;  /**< cells along y, >= 1; default 10 */
  size_t nz;  /**< cells along z, >= 1; default 10; in two dimensions it counts as 1 */
  double
      tolerance; /**< error allowed for the part of a particle in a cell where there is no
       closed form, relative to the particle [1]; default 1e-12 */
} packing_porosity_map_def;

/** Writes the defaults; called through packing_porosity_map_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_porosity_map_def_fill(packing_porosity_map_def *def,
                                               size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_porosity_map_def_init(packing_porosity_map_def *def)
{
  packing_porosity_map_def_fill(def, sizeof *def);
}

/** A cell of the map. In two dimensions volumes are areas. */
typedef struct packing_porosity_cell {
  double volume;   /**< of the container within it [L^3] */
  double solid;    /**< of the particles within it [L^3] */
  double porosity; /**< 1 - solid / volume; NaN where volume is 0 [1] */
} packing_porosity_cell;

/** What packing_measure_porosity_map() found on the whole. */
typedef struct packing_porosity_map_report {
  size_t struct_size;    /**< set by packing_porosity_map_report_init() */
  packing_bounds bounds; /**< of all cells [L] */
  size_t nx;             /**< cells along x */
  size_t ny;             /**< cells along y */
  size_t nz;             /**< cells along z; 1 in two dimensions */
  double volume;         /**< of the container in all cells [L^3] */
  double solid;          /**< of the particles in all cells [L^3] */
  double mean;           /**< porosity of cells, each weighing as its volume does [1] */
  double sd;             /**< standard deviation about it, weighed likewise [1] */
  double error;          /**< bound or estimate of the error of `solid` / `volume` [1] */
} packing_porosity_map_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_porosity_map_report_init(packing_porosity_map_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures the local porosity: the exact solid in each cell of a grid.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container
 *  \param view the pack: finite, radii > 0
 *  \param[out] cells cell (ix, iy, iz) is number ix + nx (iy + ny iz); the first `capacity` of
 *         them are written; may be NULL when that is 0
 *  \param capacity room in `cells`
 *  \param[out] count how many there are, nx ny nz
 *  \param[out] report the whole
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_GEOMETRY (a custom
 *          container answers NaN); PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear in the cells and
 *          in the particles times the cells that each touches */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_porosity_map(
    packing_context *context, const packing_porosity_map_def *def, packing_domain *domain,
    const packing_view *view, packing_porosity_cell *cells, size_t capacity,
    size_t *count, packing_porosity_map_report *report);

/** A plane through a container of three dimensions. */
typedef struct packing_section_def {
  size_t struct_size;  /**< set by packing_section_def_init() */
  packing_vec3 point;  /**< of the plane [L]; default 0 */
  packing_vec3 normal; /**< of the plane, of any length > 0; default z */
  double
      tolerance; /**< error allowed for an area that has no closed form, relative to the
       disc or the container's section [1]; default 1e-10 */
} packing_section_def;

/** Writes the defaults; called through packing_section_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_section_def_fill(packing_section_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_section_def_init(packing_section_def *def)
{
  packing_section_def_fill(def, sizeof *def);
}

/** Puts the plane across an axis.
 *  \param[in,out] def the options, initialised
 *  \param along the axis that is the normal
 *  \param height coordinate of the plane along it [L] */
static inline void packing_section_def_across(packing_section_def *def,
                                              packing_axis along, double height)
{
  const packing_vec3 zero = {0, 0, 0};
  def->point = def->normal = zero;
  *(along == PACKING_AXIS_X   ? &def->point.x
    : along == PACKING_AXIS_Y ? &def->point.y
                              : &def->point.z) = height;
  *(along == PACKING_AXIS_X   ? &def->normal.x
    : along == PACKING_AXIS_Y ? &def->normal.y
                              : &def->normal.z) = 1;
}

/** A disc that the plane cuts out of a particle. */
typedef struct packing_section_disc {
  double u;    /**< centre in the plane [L] */
  double v;    /**< centre in the plane [L] */
  double r;    /**< radius [L] */
  double area; /**< of its part inside the container [L^2] */
  size_t i;    /**< the particle */
} packing_section_disc;

/** What packing_measure_section() found. A point of the plane is
 *  origin + u u_axis + v v_axis. */
typedef struct packing_section_report {
  size_t struct_size; /**< set by packing_section_report_init() */
  packing_vec3
      origin; /**< where u = v = 0: the point of the plane that is nearest to 0, across
       an axis thus (u, v) are the two other coordinates [L] */
  packing_vec3 u_axis; /**< unit vector; across x, y, z: that of y, z, x */
  packing_vec3 v_axis; /**< unit vector; across x, y, z: that of z, x, y */
  packing_vec3 normal; /**< unit vector, u_axis x v_axis */
  double lo_u; /**< where a rectangle that holds the container's section begins [L] */
  double lo_v; /**< the same along v [L] */
  double hi_u; /**< where it ends; lo = hi = 0 where the plane misses the container [L] */
  double hi_v; /**< the same along v [L] */
  double container_area; /**< of the container's section [L^2] */
  double solid_area;     /**< of the discs within it [L^2] */
  double porosity; /**< 1 - solid_area / container_area, the areal porosity, which is
       void / (void + solid): the binary occupation ratio with black for void; NaN where the
       plane misses the container [1] */
  double error; /**< bound or estimate of the error of solid_area / container_area [1] */
} packing_section_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_section_report_init(packing_section_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Cuts a pack with a plane. In a periodic cell the plane is cut at the cell's borders, and
 *  every image of a particle that reaches its section is a disc. Areas have closed forms where
 *  the section is a rectangle, a circle or a ring; a one-dimensional quadrature to `tolerance`
 *  does the others, a subdivision to 1e-4 those of custom containers.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container, of three dimensions
 *  \param view the pack: finite, radii > 0
 *  \param[out] discs those that reach the container's section, in the order of the particles,
 *         the first `capacity` of them; may be NULL when that is 0
 *  \param capacity room in `discs`
 *  \param[out] count how many there are, even when they did not all fit
 *  \param[out] report the whole
 *  \return PACKING_OK, also when the plane misses the container; PACKING_ERR_INVALID;
 *          PACKING_ERR_RANGE; PACKING_ERR_UNSUPPORTED (a domain of two dimensions);
 *          PACKING_ERR_GEOMETRY (a custom container answers NaN); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI. Linear time. Source: seed 001, equation 12 */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_section(
    packing_context *context, const packing_section_def *def, packing_domain *domain,
    const packing_view *view, packing_section_disc *discs, size_t capacity, size_t *count,
    packing_section_report *report);

/** Options of packing_measure_sections(). */
typedef struct packing_sections_def {
  size_t struct_size; /**< set by packing_sections_def_init() */
  packing_axis axis;  /**< across which the planes lie; default z */
  size_t
      sections; /**< how many, >= 1; default 5. They lie in the middles of as many equal
       parts of the range */
  double from;  /**< where the range begins, a coordinate [L]; default 0 */
  double to;    /**< where it ends [L]; default 0, as is `from`: the whole container */
  double tolerance; /**< as in packing_section_def [1]; default 1e-10 */
} packing_sections_def;

/** Writes the defaults; called through packing_sections_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_sections_def_fill(packing_sections_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_sections_def_init(packing_sections_def *def)
{
  packing_sections_def_fill(def, sizeof *def);
}

/** One of several parallel sections. */
typedef struct packing_section_entry {
  double height;         /**< coordinate of the plane along the axis [L] */
  double container_area; /**< of the container's section [L^2] */
  double solid_area;     /**< of the discs within it [L^2] */
  double porosity;       /**< 1 - solid_area / container_area; NaN where that is 0 [1] */
} packing_section_entry;

/** What packing_measure_sections() found on the whole. */
typedef struct packing_sections_report {
  size_t struct_size; /**< set by packing_sections_report_init() */
  double from;        /**< where the range begins [L] */
  double to;          /**< where the range ends [L] */
  size_t sections;    /**< sections that meet the container; only they count below */
  double mean;        /**< of their porosities; NaN of none [1] */
  double sd;          /**< of their porosities, divided by n - 1; NaN below 2 [1] */
  double
      porosity; /**< 1 - sum of solid areas / sum of the container's areas: what tends to
       the pack's porosity as sections are added [1] */
  double error; /**< largest error of a porosity [1] */
} packing_sections_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_sections_report_init(packing_sections_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Measures parallel sections: their binary occupation ratios and the mean over them.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container, of three dimensions
 *  \param view the pack: finite, radii > 0
 *  \param[out] entries from the lowest, at most `capacity` of them; may be NULL when that is 0
 *  \param capacity room in `entries`
 *  \param[out] count how many there are: `sections` of the options
 *  \param[out] report the whole
 *  \return as packing_measure_section(). Linear in the particles times the sections */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_sections(
    packing_context *context, const packing_sections_def *def, packing_domain *domain,
    const packing_view *view, packing_section_entry *entries, size_t capacity,
    size_t *count, packing_sections_report *report);

/** Values of pixels. */
enum {
  PACKING_PIXEL_SOLID = 0,  /**< in a particle (white) */
  PACKING_PIXEL_VOID = 1,   /**< between the particles (black) */
  PACKING_PIXEL_OUTSIDE = 2 /**< outside the container */
};

/** Options of packing_measure_section_image(). */
typedef struct packing_section_image_def {
  size_t struct_size; /**< set by packing_section_image_def_init() */
  size_t rows;        /**< pixels along v, >= 1; default 500 */
  size_t columns;     /**< pixels along u, >= 1; default 500 */
  double lo_u;        /**< where the window begins along u [L]; default 0 */
  double lo_v;        /**< the same along v [L]; default 0 */
  double hi_u; /**< where it ends along u [L]; default all four 0: the rectangle that
       packing_measure_section() reports */
  double hi_v; /**< the same along v [L]; default 0 */
} packing_section_image_def;

/** Writes the defaults; called through packing_section_image_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_section_image_def_fill(packing_section_image_def *def,
                                                size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_section_image_def_init(packing_section_image_def *def)
{
  packing_section_image_def_fill(def, sizeof *def);
}

/** What packing_measure_section_image() found. */
typedef struct packing_section_image_report {
  size_t struct_size; /**< set by packing_section_image_report_init() */
  size_t rows;        /**< pixels along v */
  size_t columns;     /**< pixels along u */
  double lo_u;        /**< where the window begins along u [L] */
  double lo_v;        /**< the same along v [L] */
  double hi_u;        /**< where it ends along u [L] */
  double hi_v;        /**< the same along v [L] */
  size_t black;       /**< pixels of void */
  size_t white;       /**< pixels of particles */
  size_t outside;     /**< pixels outside the container */
  double
      occupation; /**< black / (black + white), the binary occupation ratio of the image;
       NaN of none [1] */
} packing_section_image_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_section_image_report_init(packing_section_image_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Draws a section: what lies at the centre of each pixel. Where particles overlap their union
 *  shows, so that the image has less white than the areas say.
 *  \param context NULL is fine
 *  \param section the plane, or NULL for the defaults
 *  \param def options of the image, or NULL for the defaults
 *  \param domain the container, of three dimensions
 *  \param view the pack: finite, radii > 0
 *  \param[out] pixels row after row from the top (high v), each from low to high u:
 *         PACKING_PIXEL_ values; all or none: `capacity` must be 0 or at least rows * columns;
 *         may be NULL when it is 0
 *  \param capacity room in `pixels`
 *  \param[out] count how many there are, rows * columns
 *  \param[out] report the whole
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (also too little room, or a
 *          plane that misses the container and no window given);
 *          PACKING_ERR_UNSUPPORTED (a domain of two dimensions); PACKING_ERR_GEOMETRY (a custom
 *          container answers NaN); PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear in the particles
 *          and the pixels; every 16 rows look at all discs once more */
PACKING_API PACKING_WARN_UNUSED packing_status packing_measure_section_image(
    packing_context *context, const packing_section_def *section,
    const packing_section_image_def *def, packing_domain *domain,
    const packing_view *view, unsigned char *pixels, size_t capacity, size_t *count,
    packing_section_image_report *report);

PACKING_END_DECLS

#endif
