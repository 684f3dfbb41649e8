/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_DEM_H
#define PACKING_DEM_H

/** \file packing/dem.h
 *  The discrete-element stepper: spheres or discs that push, rub and fall. Describe the
 *  materials, make the laws, make a stepper over a store of particles, call packing_dem_step()
 *  as long as you like. The caller owns the loop, the progress bar, cancelling and stopping.
 *
 *  The walls are those of the domain; its periodic directions are periodic. Positions,
 *  velocities and spins stand in the store whenever packing_dem_step() returns. The same start
 *  gives the same bytes for any number of threads and any instruction set, and any division of
 *  the steps among calls. Two dimensions: particles move in the plane and spin about z.
 *
 *  The model is that of Campello and Cassares (Lat. Am. J. Solids Struct. 13, 23, 2016),
 *  sections 3 and 4; doc/methods/dem.md tells where the printed formulas cannot be meant. */

#include <packing/domain.h>
#include <packing/particles.h>

PACKING_BEGIN_DECLS

/** What particles are made of: a table, filled before a stepper is made from it. One owner. */
typedef struct packing_materials packing_materials;

/** A force law: immutable, reference-counted, shareable between threads and contexts. */
typedef struct packing_law packing_law;

/** A stepper; one owner, used by one thread at a time. */
typedef struct packing_dem packing_dem;

/** \name Materials */
/**@{*/

/** The material of walls that do not give way. */
#define PACKING_MATERIAL_RIGID SIZE_MAX

/** One material. Density and young have no default. */
typedef struct packing_material_def {
  size_t struct_size; /**< set by packing_material_def_init() */
  double density;     /**< > 0 [M L^-3], discs weighed as discs [M L^-2] */
  double young;       /**< Young's modulus, > 0 [M L^-1 T^-2] */
  double poisson;     /**< Poisson's ratio, in (-1, 0.5] [1]; default 0.25 */
  double damping;     /**< damping rate xi of contacts, >= 0 [1]; default 0.1. See
       packing_hertz_restitution() */
  double friction;    /**< coefficient of friction, >= 0 [1]; default 0.2 */
} packing_material_def;

/** Writes the defaults; called through packing_material_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_material_def_fill(packing_material_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_material_def_init(packing_material_def *def)
{
  packing_material_def_fill(def, sizeof *def);
}

/** Makes an empty table.
 *  \param context NULL is fine
 *  \param[out] materials the table
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_materials_create(packing_context *context, packing_materials **materials);

/** Destroys a table; steppers made from it keep a copy.
 *  \param materials NULL is fine */
PACKING_API void packing_materials_destroy(packing_materials *materials);

/** Adds a material, at most 64. Particles of type t (1 where the store has no types) are made
 *  of material t - 1.
 *  \param materials the table
 *  \param def the material
 *  \param[out] index of the material; NULL is fine
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_materials_add(
    packing_materials *materials, const packing_material_def *def, size_t *index);

/** Sets damping and friction between two materials; where not set, the mean of both holds.
 *  \param materials the table
 *  \param a,b indices; they may be equal, and either may be #PACKING_MATERIAL_RIGID, whose
 *         contacts have the other material's damping and friction where not set
 *  \param damping damping rate xi, >= 0 [1]
 *  \param friction coefficient of friction, >= 0 [1]
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE */
PACKING_API PACKING_WARN_UNUSED packing_status packing_materials_set_pair(
    packing_materials *materials, size_t a, size_t b, double damping, double friction);

/** The coefficient of restitution of two Hertz spheres with the damping of Campello and
 *  Cassares, equation 10. It does not depend on speed, sizes or stiffness: with
 *  zeta = xi sqrt(6/5) and s = sqrt(1 - zeta^2), exp(-pi zeta / s) where the pull at
 *  separation is kept, exp(-(zeta / s) (pi - atan2(2 zeta s, 1 - 2 zeta^2))) where it is cut
 *  off (Antypov and Elliott, EPL 94, 50004, 2011); from critical damping, zeta = 1, on the one
 *  is 0, the other exp(-2 zeta acosh(zeta) / sqrt(zeta^2 - 1)), which begins at exp(-2).
 *  \param damping damping rate xi, >= 0 [1]
 *  \param pull not 0: the force may pull; 0: it is cut off at 0
 *  \return in [0, 1]; NaN for a bad damping. Thread-safe */
PACKING_API double packing_hertz_restitution(double damping, int pull);

/** The damping rate that gives a restitution: the inverse of packing_hertz_restitution().
 *  \param restitution in (0, 1] [1]
 *  \param pull as there
 *  \return the rate to a relative 1e-12 [1]; NaN for a bad restitution. Thread-safe */
PACKING_API double packing_hertz_damping(double restitution, int pull);

/**@}*/

/** \name Laws */
/**@{*/

/** What two materials are to each other. */
typedef struct packing_pair_material {
  double young;    /**< E*, 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j [M L^-1 T^-2] */
  double damping;  /**< xi [1] */
  double friction; /**< mu [1] */
} packing_pair_material;

/** Pairs of particles, or of a particle and a wall, for a law to work on. Arrays have `count`
 *  entries, are aligned to 64 bytes and may be read and written up to the next multiple of 8
 *  entries, where numbers are harmless. For a wall, j is the wall, its distance is that of i's
 *  centre, reduced_r is r_i and reduced_m is m_i. */
typedef struct packing_contact_batch {
  size_t struct_size;      /**< bytes that the library filled */
  size_t count;            /**< pairs */
  double dt;               /**< length of the step [T] */
  const double *nx;        /**< unit normal from i to j [1] */
  const double *ny;        /**< unit normal from i to j [1] */
  const double *nz;        /**< unit normal from i to j [1] */
  const double *distance;  /**< of the centres [L] */
  const double *overlap;   /**< r_i + r_j - distance [L]; > 0 for laws of contacts */
  const double *reduced_r; /**< r_i r_j / (r_i + r_j) [L] */
  const double *reduced_m; /**< m_i m_j / (m_i + m_j) [M] */
  const double *approach;  /**< (v_i - v_j) . n [L T^-1] */
  const double *ux; /**< velocity of j's contact point relative to i's, without its part
       along n [L T^-1] */
  const double *uy; /**< like ux */
  const double *uz; /**< like ux */
  const uint32_t *pair; /**< entry of `materials` for each; NULL: entry 0 for all */
  const packing_pair_material *materials; /**< a table */
  double *history; /**< `history_size` doubles a pair: number h of pair k at
       history[h * stride + k]; NULL where the law has none. Zero when a contact begins */
  size_t stride;   /**< of history */
  double *normal;  /**< force on i along -n, repulsive > 0 [M L T^-2]: laws add to it */
  double
      *fx; /**< force on i at the contact, beside `normal` [M L T^-2]: laws add to it */
  double *fy; /**< like fx */
  double *fz; /**< like fx */
} packing_contact_batch;

/** A law's work: adds the forces of a batch. Called from several threads at once. */
typedef void (*packing_law_function)(void *user, const packing_contact_batch *batch);

/** Options of packing_law_create_hertz(). */
typedef struct packing_law_hertz_def {
  size_t struct_size; /**< set by packing_law_hertz_def_init() */
  int pull; /**< 1: the whole of equation 7, which pulls at separation; 0 (default): the force
       is cut off at 0 */
} packing_law_hertz_def;

/** Writes the defaults; called through packing_law_hertz_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_law_hertz_def_fill(packing_law_hertz_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_law_hertz_def_init(packing_law_hertz_def *def)
{
  packing_law_hertz_def_fill(def, sizeof *def);
}

/** Makes the law of Hertz with damping (Campello and Cassares, equations 7 to 11):
 *  normal = (4/3) sqrt(r*) E* delta^(3/2) + c ddelta/dt,
 *  c = 2 xi sqrt(2 E* m* sqrt(r*)) delta^(1/4).
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param[out] law the law
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_law_create_hertz(
    packing_context *context, const packing_law_hertz_def *def, packing_law **law);

/** Options of packing_law_create_sliding(). */
typedef struct packing_law_sliding_def {
  size_t struct_size;   /**< set by packing_law_sliding_def_init() */
  double slip_velocity; /**< v0, > 0, no default [L T^-1]: friction rises with the sliding
       velocity u as u / sqrt(u^2 + v0^2) */
} packing_law_sliding_def;

/** Writes the defaults; called through packing_law_sliding_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_law_sliding_def_fill(packing_law_sliding_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_law_sliding_def_init(packing_law_sliding_def *def)
{
  packing_law_sliding_def_fill(def, sizeof *def);
}

/** Makes the law of continuous sliding (Campello and Cassares, equations 12 to 15):
 *  f = mu |normal| u / sqrt(u^2 + v0^2) against the sliding of the contact points. It reads
 *  `normal`, so it comes after the laws that push.
 *  \param context NULL is fine
 *  \param def options
 *  \param[out] law the law
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_law_create_sliding(
    packing_context *context, const packing_law_sliding_def *def, packing_law **law);

/** Options of packing_law_create_near_field(). */
typedef struct packing_law_near_field_def {
  size_t struct_size;         /**< set by packing_law_near_field_def_init() */
  double attraction;          /**< alpha_1: > 0 attracts; default 0 */
  double attraction_exponent; /**< beta_1 [1]; default 0 */
  double repulsion;           /**< alpha_2: > 0 repels; default 0 */
  double repulsion_exponent;  /**< beta_2 [1]; default 0 */
  double
      cutoff; /**< no force from this distance of the centres on, > 0, no default [L] */
} packing_law_near_field_def;

/** Writes the defaults; called through packing_law_near_field_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_law_near_field_def_fill(packing_law_near_field_def *def,
                                                 size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_law_near_field_def_init(packing_law_near_field_def *def)
{
  packing_law_near_field_def_fill(def, sizeof *def);
}

/** Makes the force between particles near each other, touching or not (Campello and Cassares,
 *  equation 5): normal = alpha_2 d^-beta_2 - alpha_1 d^-beta_1, d the distance of the centres.
 *  Walls have none. The powers are those of the C library: the same bytes on one machine.
 *  \param context NULL is fine
 *  \param def options
 *  \param[out] law the law
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_law_create_near_field(
    packing_context *context, const packing_law_near_field_def *def, packing_law **law);

/** Options of packing_law_create_custom(). */
typedef struct packing_law_custom_def {
  size_t struct_size;            /**< set by packing_law_custom_def_init() */
  packing_law_function evaluate; /**< the work; no default */
  void *user;                    /**< passed to the functions */
  double reach; /**< 0 (default): a law of contacts, particles and walls; > 0: a law of
       particles whose centres are less than this apart, touching or not [L] */
  size_t history_size; /**< doubles kept for each contact, at most 16; default 0. Laws of
       contacts only */
  unsigned
      history_even; /**< bit h set: history h stays when i and j swap their roles, which
       happens now and then; not set: it changes its sign */
  /** Called once, when the law is gone, never when making it failed; NULL is fine. */
  void (*release)(void *user);
} packing_law_custom_def;

/** Writes the defaults; called through packing_law_custom_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_law_custom_def_fill(packing_law_custom_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_law_custom_def_init(packing_law_custom_def *def)
{
  packing_law_custom_def_fill(def, sizeof *def);
}

/** Makes a law from the user's function.
 *  \param context NULL is fine
 *  \param def options
 *  \param[out] law the law
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE; PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status packing_law_create_custom(
    packing_context *context, const packing_law_custom_def *def, packing_law **law);

/** Lets go of a law; steppers made with it keep it.
 *  \param law NULL is fine. Thread-safe */
PACKING_API void packing_law_destroy(packing_law *law);

/** The name of a law, as in "hertz".
 *  \param law the law
 *  \return a constant string. Thread-safe */
PACKING_API const char *packing_law_name(const packing_law *law);

/** Where a law is from: paper and equations.
 *  \param law the law
 *  \return a constant string. Thread-safe */
PACKING_API const char *packing_law_reference(const packing_law *law);

/**@}*/

/** \name The stepper */
/**@{*/

/** Where the arm of a force at a contact ends. */
typedef enum packing_arm {
  PACKING_ARM_CONTACT =
      0,                 /**< in one point for both, which shares the overlap by stiffness
       (r_i - delta/2 for equal ones), so that angular momentum is conserved */
  PACKING_ARM_RADIUS = 1 /**< at r_i and r_j (Campello and Cassares, equation 15) */
} packing_arm;

/** Options of packing_dem_create(). */
typedef struct packing_dem_def {
  size_t struct_size;   /**< set by packing_dem_def_init() */
  double dt;            /**< length of a step [T]; 0 (default): the advised one */
  packing_vec3 gravity; /**< acceleration [L T^-2]; default 0 */
  double drag; /**< force per velocity relative to the fluid, >= 0 [M T^-1]; default 0 */
  packing_vec3 fluid_velocity; /**< [L T^-1]; default 0 */
  /** Velocity of the fluid in place of fluid_velocity, at a point (in a periodic cell sometimes
   *  a little outside it) and a time; called from several threads at once. NULL (default):
   *  fluid_velocity holds everywhere. */
  packing_vec3 (*fluid)(void *user, const packing_vec3 *point, double time);
  void *fluid_user; /**< passed to `fluid` */
  int rotations; /**< 1 (default): particles spin; 0: they never do, spins stay as given */
  packing_arm arm; /**< default contact */
  int disc_mass; /**< 2D, 1: particles weigh as discs (pi r^2, m r^2 / 2); 0 (default): as
       spheres that move in a plane (4/3 pi r^3, 2/5 m r^2) */
  size_t wall_material;   /**< index, default #PACKING_MATERIAL_RIGID */
  double impact_velocity; /**< relative velocity of the hardest collisions, for the advice
       [L T^-1]; 0 (default): that of a fall through the container along gravity, or twice the
       largest speed at the start where that is more */
  double
      max_start_overlap; /**< a start with more is refused, relative to the smaller radius
       [1]; default 0.01 */
} packing_dem_def;

/** Writes the defaults; called through packing_dem_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_dem_def_fill(packing_dem_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_dem_def_init(packing_dem_def *def)
{
  packing_dem_def_fill(def, sizeof *def);
}

/** Makes a stepper. Columns for velocities and spins are added to the store where absent, even
 *  when the rest fails.
 *
 *  Semi-implicit Euler: v += dt f(x, v) / m, then x += dt v, which is what Campello and
 *  Cassares' Algorithm 2 prints (their equation 21 with theta = 0 gains energy).
 *  The step is refused where even two of the smallest particles (or one and a wall) at an
 *  overlap of 1 % of their radius would be unstable: omega dt >= 2 (sqrt(1 + xi^2) - xi), with
 *  omega^2 = 2 E* sqrt(r* delta) / m*, or drag dt / m >= 2. A step above the advised one, a
 *  fifth of Hertz's collision time (their equation 23), gives one warning in the log. Limit and
 *  advice look at the smallest particle of each material, against its like and against a wall.
 *
 *  Walls act all at once, each where a particle touches it; a custom domain acts with its
 *  nearest wall only.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain the container; kept
 *  \param materials at least one; copied
 *  \param laws `law_count` laws, at most 16, in the order in which they add their forces; kept
 *  \param law_count may be 0
 *  \param particles the store, of the domain's dimension; borrowed: it must outlive the stepper
 *  \param[out] dem the stepper
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (a field; the message of an
 *          overlapping start names the pair, that of a type without a material the particle);
 *          PACKING_ERR_UNSTABLE (dt: the message gives the advised step); PACKING_ERR_GEOMETRY
 *          (a periodic direction narrower than two interaction distances; a centre outside the
 *          walls); PACKING_ERR_NOMEM; PACKING_ERR_ABI. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_dem_create(
    packing_context *context, const packing_dem_def *def, packing_domain *domain,
    const packing_materials *materials, packing_law *const *laws, size_t law_count,
    packing_particles *particles, packing_dem **dem);

/** Destroys a stepper; the particles stay.
 *  \param dem NULL is fine */
PACKING_API void packing_dem_destroy(packing_dem *dem);

/** What a stepper has come to. */
typedef struct packing_dem_report {
  size_t struct_size;     /**< set by packing_dem_report_init() */
  uint64_t steps;         /**< made since creation */
  double time;            /**< simulated since creation [T] */
  double dt;              /**< length of a step [T] */
  size_t particles;       /**< how many */
  double kinetic_energy;  /**< of motion and spin [M L^2 T^-2] */
  double kinetic_per_mgr; /**< kinetic energy over the sum of m |g| r: small at rest; NaN
       without gravity or particles [1] */
  double max_speed;       /**< [L T^-1] */
  size_t contacts;        /**< pairs of particles that touched in the last step */
  size_t wall_contacts;   /**< contacts with walls in the last step */
  double
      max_overlap; /**< of two particles in the last step, relative to the smaller radius
       [1] */
  uint64_t rebuilds; /**< of the neighbour list since creation */
} packing_dem_report;

/** Makes an empty report.
 *  \param[out] report zeroed, its size noted: the library fills no more than that */
static inline void packing_dem_report_init(packing_dem_report *report)
{
  memset(report, 0, sizeof *report);
  report->struct_size = sizeof *report;
}

/** Makes steps.
 *  \param dem the stepper
 *  \param steps how many, >= 1
 *  \param[out] report where it stands; NULL is fine
 *  \return PACKING_OK; PACKING_ERR_INVALID (dem NULL; the store has changed its number of
 *          particles: see packing_dem_reload()); PACKING_ERR_RANGE (steps 0);
 *          PACKING_ERR_UNSTABLE (a particle's position or velocity is no longer finite: message
 *          and log name it and the step; the store stays as it was before the call, and the
 *          stepper can be reloaded); PACKING_ERR_NOMEM (likewise); PACKING_ERR_ABI. Linear time a
 *          step; nothing is allocated once the list of neighbours has found its size */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_dem_step(packing_dem *dem, uint64_t steps, packing_dem_report *report);

/** Takes over what was changed in the store: particles added, moved or removed, velocities,
 *  types. The count of steps goes on; what laws remembered of contacts is forgotten.
 *  \param dem the stepper
 *  \return as packing_dem_create() for the start; after a failure the stepper refuses to step
 *          until a reload succeeds */
PACKING_API PACKING_WARN_UNUSED packing_status packing_dem_reload(packing_dem *dem);

/** What is known of the step. */
typedef struct packing_dem_advice {
  size_t struct_size;     /**< set by packing_dem_advice_init() */
  double impact_velocity; /**< what the advice is for [L T^-1] */
  double collision_time;  /**< t_c = 2.868 (m*^2 / (r* E*^2 v))^(1/5) of the two smallest
       particles; +infinity without a velocity (Campello and Cassares, equation 23) [T] */
  double advised;         /**< t_c / 5, or where it is less half the limit [T] */
  double limit;           /**< steps of this length and more are refused [T] */
} packing_dem_advice;

/** Makes an empty advice.
 *  \param[out] advice zeroed, its size noted: the library fills no more than that */
static inline void packing_dem_advice_init(packing_dem_advice *advice)
{
  memset(advice, 0, sizeof *advice);
  advice->struct_size = sizeof *advice;
}

/** Tells the advised step.
 *  \param dem the stepper
 *  \param[out] advice filled
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_ABI. Thread-safe */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_dem_advise(const packing_dem *dem, packing_dem_advice *advice);

/** Memory held, beside the store.
 *  \param dem the stepper
 *  \return bytes */
PACKING_API size_t packing_dem_bytes(const packing_dem *dem);

/**@}*/

PACKING_END_DECLS

#endif
