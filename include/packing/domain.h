/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_DOMAIN_H
#define PACKING_DOMAIN_H

/** \file packing/domain.h
 *  Containers. A domain is immutable, reference-counted and can be shared by threads and
 *  contexts. Two-dimensional ones lie in the plane z = 0: there z is ignored, "volume" is an
 *  area [L^2] and a "sphere" a disc.
 *
 *  The distance to the wall is positive inside. Periodic directions have no walls. An open top
 *  is no wall, yet it bounds the region whose volume counts: the walls beside it go on above it
 *  along their own line (upright in box, rectangle, cylinder, tube and silo, along the cone in
 *  a cone), and distances are those to the walls so continued. */

#include <packing/mesh.h>

PACKING_BEGIN_DECLS

/** A container. */
typedef struct packing_domain packing_domain;

/** Lets go of a domain; what was made from it keeps it.
 *  \param domain NULL is fine. Thread-safe */
PACKING_API void packing_domain_destroy(packing_domain *domain);

/** Takes one more hold of a domain; each needs its packing_domain_destroy().
 *  \param domain the domain
 *  \return domain. Thread-safe */
PACKING_API packing_domain *packing_domain_retain(packing_domain *domain);

/** Options of packing_domain_create_box(). */
typedef struct packing_domain_box_def {
  size_t struct_size;  /**< set by packing_domain_box_def_init() */
  packing_vec3 size;   /**< edges [L], > 0 */
  packing_vec3 corner; /**< its lowest corner [L]; default 0 */
  unsigned periodic;   /**< sum of PACKING_PERIODIC_; default none */
  int open_top;        /**< 1: no wall at the top (high z), which must not be periodic */
} packing_domain_box_def;

/** Writes the defaults; called through packing_domain_box_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_box_def_fill(packing_domain_box_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_box_def_init(packing_domain_box_def *def)
{
  packing_domain_box_def_fill(def, sizeof *def);
}

/** Makes a box.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_box(
    packing_context *context, const packing_domain_box_def *def, packing_domain **domain);

/** Options of packing_domain_create_rectangle(). */
typedef struct packing_domain_rectangle_def {
  size_t struct_size;  /**< set by packing_domain_rectangle_def_init() */
  double size_x;       /**< edge along x [L], > 0 */
  double size_y;       /**< edge along y [L], > 0 */
  packing_vec3 corner; /**< its lowest corner [L], z = 0; default 0 */
  unsigned periodic;   /**< sum of PACKING_PERIODIC_X and _Y; default none */
  int open_top;        /**< 1: no wall at the top (high y), which must not be periodic */
} packing_domain_rectangle_def;

/** Writes the defaults; called through packing_domain_rectangle_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_rectangle_def_fill(packing_domain_rectangle_def *def,
                                                   size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_rectangle_def_init(packing_domain_rectangle_def *def)
{
  packing_domain_rectangle_def_fill(def, sizeof *def);
}

/** Makes a rectangle in the plane z = 0.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_rectangle(
    packing_context *context, const packing_domain_rectangle_def *def,
    packing_domain **domain);

/** Options of packing_domain_create_cylinder(). */
typedef struct packing_domain_cylinder_def {
  size_t struct_size; /**< set by packing_domain_cylinder_def_init() */
  double radius;      /**< [L], > 0 */
  double height;      /**< [L], > 0 */
  packing_vec3 base;  /**< centre of the base [L]; default 0 */
  packing_axis axis;  /**< direction from base to top; default z */
  int open_top;       /**< 1: no wall at the top */
} packing_domain_cylinder_def;

/** Writes the defaults; called through packing_domain_cylinder_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_cylinder_def_fill(packing_domain_cylinder_def *def,
                                                  size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_cylinder_def_init(packing_domain_cylinder_def *def)
{
  packing_domain_cylinder_def_fill(def, sizeof *def);
}

/** Makes a circular cylinder.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_cylinder(
    packing_context *context, const packing_domain_cylinder_def *def,
    packing_domain **domain);

/** Options of packing_domain_create_tube(). */
typedef struct packing_domain_tube_def {
  size_t struct_size;  /**< set by packing_domain_tube_def_init() */
  double inner_radius; /**< [L], > 0 */
  double outer_radius; /**< [L], > inner_radius */
  double height;       /**< [L], > 0 */
  packing_vec3 base;   /**< centre of the base [L]; default 0 */
  packing_axis axis;   /**< direction from base to top; default z */
  int open_top;        /**< 1: no wall at the top */
} packing_domain_tube_def;

/** Writes the defaults; called through packing_domain_tube_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_tube_def_fill(packing_domain_tube_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_tube_def_init(packing_domain_tube_def *def)
{
  packing_domain_tube_def_fill(def, sizeof *def);
}

/** Makes the space between two coaxial cylinders.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_domain_create_tube(packing_context *context, const packing_domain_tube_def *def,
                           packing_domain **domain);

/** Options of packing_domain_create_cone(). */
typedef struct packing_domain_cone_def {
  size_t struct_size;   /**< set by packing_domain_cone_def_init() */
  double bottom_radius; /**< at the base [L], >= 0 */
  double top_radius;    /**< at the top [L], >= 0, not both 0 */
  double height;        /**< [L], > 0 */
  packing_vec3 base;    /**< centre of the base [L]; default 0 */
  packing_axis axis;    /**< direction from base to top; default z */
  int open_top;         /**< 1: no wall at the top */
} packing_domain_cone_def;

/** Writes the defaults; called through packing_domain_cone_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_cone_def_fill(packing_domain_cone_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_cone_def_init(packing_domain_cone_def *def)
{
  packing_domain_cone_def_fill(def, sizeof *def);
}

/** Makes a truncated cone (or a cone: one radius may be 0).
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_domain_create_cone(packing_context *context, const packing_domain_cone_def *def,
                           packing_domain **domain);

/** Options of packing_domain_create_silo(). */
typedef struct packing_domain_silo_def {
  size_t struct_size;   /**< set by packing_domain_silo_def_init() */
  double radius;        /**< of the cylinder [L], > 0 */
  double height;        /**< of the whole [L], > hopper_height */
  double outlet_radius; /**< at the base [L], >= 0, < radius; the outlet is a wall */
  double hopper_height; /**< [L], > 0 */
  packing_vec3 base;    /**< centre of the base [L]; default 0 */
  packing_axis axis;    /**< direction from base to top; default z */
  int open_top;         /**< 1: no wall at the top */
} packing_domain_silo_def;

/** Writes the defaults; called through packing_domain_silo_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_silo_def_fill(packing_domain_silo_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_silo_def_init(packing_domain_silo_def *def)
{
  packing_domain_silo_def_fill(def, sizeof *def);
}

/** Makes a silo: a cylinder on a conical hopper with a flat outlet at the base.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_domain_create_silo(packing_context *context, const packing_domain_silo_def *def,
                           packing_domain **domain);

/** Options of packing_domain_create_sphere(). */
typedef struct packing_domain_sphere_def {
  size_t struct_size;  /**< set by packing_domain_sphere_def_init() */
  double radius;       /**< [L], > 0 */
  packing_vec3 centre; /**< [L]; default 0 */
} packing_domain_sphere_def;

/** Writes the defaults; called through packing_domain_sphere_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_sphere_def_fill(packing_domain_sphere_def *def,
                                                size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_sphere_def_init(packing_domain_sphere_def *def)
{
  packing_domain_sphere_def_fill(def, sizeof *def);
}

/** Makes the inside of a sphere.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_sphere(
    packing_context *context, const packing_domain_sphere_def *def,
    packing_domain **domain);

/** Options of packing_domain_create_circle(). */
typedef struct packing_domain_circle_def {
  size_t struct_size;  /**< set by packing_domain_circle_def_init() */
  double radius;       /**< [L], > 0 */
  packing_vec3 centre; /**< [L], z = 0; default 0 */
} packing_domain_circle_def;

/** Writes the defaults; called through packing_domain_circle_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_circle_def_fill(packing_domain_circle_def *def,
                                                size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_circle_def_init(packing_domain_circle_def *def)
{
  packing_domain_circle_def_fill(def, sizeof *def);
}

/** Makes the inside of a circle in the plane z = 0.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_circle(
    packing_context *context, const packing_domain_circle_def *def,
    packing_domain **domain);

/** Options of packing_domain_create_annulus(). */
typedef struct packing_domain_annulus_def {
  size_t struct_size;  /**< set by packing_domain_annulus_def_init() */
  double inner_radius; /**< [L], > 0 */
  double outer_radius; /**< [L], > inner_radius */
  packing_vec3 centre; /**< [L], z = 0; default 0 */
} packing_domain_annulus_def;

/** Writes the defaults; called through packing_domain_annulus_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_annulus_def_fill(packing_domain_annulus_def *def,
                                                 size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_annulus_def_init(packing_domain_annulus_def *def)
{
  packing_domain_annulus_def_fill(def, sizeof *def);
}

/** Makes the ring between two circles in the plane z = 0.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_annulus(
    packing_context *context, const packing_domain_annulus_def *def,
    packing_domain **domain);

/** Options of packing_domain_create_custom(). */
typedef struct packing_domain_custom_def {
  size_t struct_size; /**< set by packing_domain_custom_def_init() */
  int dim;            /**< 2 or 3 (default) */
  /** Distance to the wall [L], positive inside and exact there, never too large in size
   *  outside (1-Lipschitz). `normal` (may be NULL) is its unit gradient. In two dimensions
   *  point->z is 0. */
  double (*signed_distance)(void *user, const packing_vec3 *point, packing_vec3 *normal);
  packing_bounds bounds; /**< a box that holds the container [L] */
  double volume;         /**< [L^3] or [L^2]; 0 (default): computed to volume_tolerance */
  double volume_tolerance; /**< relative error of a computed volume [1], default 1e-4 */
  void *user;              /**< passed to the functions */
  /** Called once, when the domain and all its insets are gone, never when making it failed;
   *  NULL is fine. */
  void (*release)(void *user);
} packing_domain_custom_def;

/** Writes the defaults; called through packing_domain_custom_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_custom_def_fill(packing_domain_custom_def *def,
                                                size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_custom_def_init(packing_domain_custom_def *def)
{
  packing_domain_custom_def_fill(def, sizeof *def);
}

/** Makes a container from the user's functions, which must be thread-safe. A volume to be
 *  computed takes up to some 1e7 distances (a few seconds); `volume_tolerance` 1e-4 takes some
 *  1e6 in three dimensions.
 *  \param context NULL is fine
 *  \param def options; the sizes have no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_INVALID (NaN, infinite, NULL); PACKING_ERR_RANGE (also
 *          when a computed volume misses volume_tolerance); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI; PACKING_ERR_GEOMETRY (a computed volume of 0, a distance that is
 *          NaN) */
PACKING_API PACKING_WARN_UNUSED packing_status packing_domain_create_custom(
    packing_context *context, const packing_domain_custom_def *def,
    packing_domain **domain);

/** Options of packing_domain_create_mesh(). */
typedef struct packing_domain_mesh_def {
  size_t struct_size; /**< set by packing_domain_mesh_def_init() */
  packing_mesh *mesh; /**< the walls; the domain takes a hold of its own */
} packing_domain_mesh_def;

/** Writes the defaults; called through packing_domain_mesh_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_domain_mesh_def_fill(packing_domain_mesh_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_domain_mesh_def_init(packing_domain_mesh_def *def)
{
  packing_domain_mesh_def_fill(def, sizeof *def);
}

/** Makes the inside of a closed surface. Its distance is exact, that of points far outside too; a
 *  query takes O(log N) time. Its volume is exact; that of an inset comes by subdivision, to 1e-4
 *  where some 5e5 distances are enough for that, to 1e-2 at the worst.
 *  \param context NULL is fine; its threads share the check
 *  \param def options; the mesh has no default
 *  \param[out] domain the container
 *  \return PACKING_OK; PACKING_ERR_GEOMETRY (packing_mesh_check() finds a defect: the message says
 *          which, how many and where); PACKING_ERR_INVALID (NULL); PACKING_ERR_RANGE;
 *          PACKING_ERR_NOMEM; PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_domain_create_mesh(packing_context *context, const packing_domain_mesh_def *def,
                           packing_domain **domain);

/** Makes the part of a domain at least `distance` from every wall (an open top is none): the
 *  same kind of container, smaller. Inside it distances to the walls are those of the domain
 *  less `distance`. Faces may vanish. A distance of 0 gives the domain itself.
 *  \param context NULL is fine
 *  \param domain the container
 *  \param distance >= 0 [L]
 *  \param[out] inset the smaller container
 *  \return PACKING_OK; PACKING_ERR_GEOMETRY (nothing with a volume is left);
 *          PACKING_ERR_INVALID; PACKING_ERR_RANGE (a negative distance; custom: the volume left
 *          misses volume_tolerance; mesh: too little is left to tell its volume); PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_domain_create_inset(packing_context *context, packing_domain *domain,
                            double distance, packing_domain **inset);

/** The name of the kind, as in "cylinder".
 *  \param domain the container
 *  \return a constant string. Thread-safe */
PACKING_API const char *packing_domain_kind(const packing_domain *domain);

/** The dimension.
 *  \param domain the container
 *  \return 2 or 3. Thread-safe */
PACKING_API int packing_domain_dim(const packing_domain *domain);

/** The periodic directions.
 *  \param domain the container
 *  \return a sum of PACKING_PERIODIC_. Thread-safe */
PACKING_API unsigned packing_domain_periodic(const packing_domain *domain);

/** The volume of the region.
 *  \param domain the container
 *  \return exact where the kind has a formula (all but custom, see combinations) [L^3], 2D [L^2]. Thread-safe */
PACKING_API double packing_domain_volume(const packing_domain *domain);

/** A box around the container; the tightest one for all kinds but custom ones and combinations. It is the cell of
 *  periodic directions.
 *  \param domain the container
 *  \param[out] bounds [L]; 2D: z from 0 to 0. Thread-safe */
PACKING_API void packing_domain_bounds(const packing_domain *domain,
                                       packing_bounds *bounds);

/** The distance from a point to the nearest wall.
 *  \param domain the container
 *  \param point any point [L]; in periodic directions any image
 *  \param[out] normal unit gradient of the distance (away from the nearest wall when inside);
 *         on ties one of them, always the same; 0 where there is no wall; NULL is fine
 *  \return positive inside, negative outside, +infinity where there is no wall [L]; exact for
 *          all built-in kinds. Thread-safe, constant time */
PACKING_API double packing_domain_signed_distance(const packing_domain *domain,
                                                  const packing_vec3 *point,
                                                  packing_vec3 *normal);

/** Whether a whole sphere (disc) lies inside, touching allowed: the signed distance is at
 *  least r, without a tolerance.
 *  \param domain the container
 *  \param centre [L]
 *  \param r radius, >= 0 [L]
 *  \return 1 or 0. Thread-safe, constant time */
PACKING_API int packing_domain_holds(const packing_domain *domain,
                                     const packing_vec3 *centre, double r);

/** Moves a point into the cell along periodic directions, to lo <= x < hi of the bounds. A
 *  point a rounding error below lo goes to lo.
 *  \param domain the container
 *  \param[in,out] point changed along periodic directions only. Thread-safe */
PACKING_API void packing_domain_wrap(const packing_domain *domain, packing_vec3 *point);

/** The vector b - a to the nearest image of b. Swapping a and b changes the sign and nothing
 *  else; half a period apart, for two points of the cell, it is b - a itself.
 *  \param domain the container
 *  \param a,b points [L]
 *  \return the shortest of all images' vectors [L]. Thread-safe */
PACKING_API packing_vec3 packing_domain_separation(const packing_domain *domain,
                                                   const packing_vec3 *a,
                                                   const packing_vec3 *b);

/** The volume of the part of a sphere (area of the part of a disc) inside the region, whose
 *  open top cuts too. In periodic directions nothing cuts. Closed forms for box, rectangle,
 *  sphere, circle, annulus and polygon; one-dimensional quadrature for cylinder, tube, cone and
 *  silo; subdivision for custom, for insets of polygons and for what the containers of a
 *  combination share.
 *  \param domain the container
 *  \param centre [L]
 *  \param r radius, > 0 [L]
 *  \param tolerance error allowed, relative to the whole sphere [1], e.g. 1e-9; custom domains
 *         go no further than 1e-4, the others than 1e-13
 *  \param[out] volume [L^3], 2D [L^2]
 *  \param[out] error bound (closed forms) or estimate of the error of `volume`, same
 *         dimension; NULL is fine
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (r <= 0, tolerance not in
 *          (0, 1)); PACKING_ERR_GEOMETRY (custom: a distance that is NaN). Thread-safe */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_domain_sphere_volume(const packing_domain *domain, const packing_vec3 *centre,
                             double r, double tolerance, double *volume, double *error);

PACKING_END_DECLS

#endif
