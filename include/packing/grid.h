/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_GRID_H
#define PACKING_GRID_H

/** \file packing/grid.h
 *  Neighbour search among particles that stand still. A grid has one level of cells for each
 *  octave of radii, so widely spread sizes cost as little as equal ones (Krijgsman, Ogarko
 *  and Luding, Comput. Part. Mech. 1, 357, 2014); equal sizes give one uniform level. It
 *  copies the centres and radii it needs and is immutable after creation: queries are
 *  thread-safe. Memory goes with particles, not with volume. */

#include <packing/domain.h>

PACKING_BEGIN_DECLS

/** A neighbour grid. */
typedef struct packing_grid packing_grid;

/** Two particles, `i` < `j`. */
typedef struct packing_pair {
  size_t i; /**< index in the view */
  size_t j; /**< index in the view */
} packing_pair;

/** Options of packing_grid_create(). */
typedef struct packing_grid_def {
  size_t struct_size; /**< set by packing_grid_def_init() */
  int levels;         /**< most levels, 1 to 32; 1: uniform cells; default 32 */
} packing_grid_def;

/** Writes the defaults; called through packing_grid_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_grid_def_fill(packing_grid_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_grid_def_init(packing_grid_def *def)
{
  packing_grid_def_fill(def, sizeof *def);
}

/** Builds a grid.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param domain gives the periodic directions; NULL: none. A particle may be larger than
 *         half a periodic cell: each pair is met once, by its nearest image
 *  \param view the particles: finite centres, radii > 0
 *  \param[out] grid the grid
 *  \return PACKING_OK; PACKING_ERR_INVALID, PACKING_ERR_RANGE (the message names the
 *          particle); PACKING_ERR_NOMEM. Linear time; 40 bytes a particle and 24 a row of
 *          cells that is not empty */
PACKING_API PACKING_WARN_UNUSED packing_status packing_grid_create(
    packing_context *context, const packing_grid_def *def, packing_domain *domain,
    const packing_view *view, packing_grid **grid);

/** Destroys a grid.
 *  \param grid NULL is fine */
PACKING_API void packing_grid_destroy(packing_grid *grid);

/** Finds the particles whose surface is within `reach` of a point: distance to the centre
 *  at most r + reach (so a sphere of radius s at the point touches all found with reach s).
 *  \param grid the grid
 *  \param point [L]
 *  \param reach >= 0 [L]
 *  \param[out] indices in rising order, the lowest `capacity` of them; may be NULL when
 *         that is 0
 *  \param capacity room in `indices`
 *  \param[out] count how many there are, even when they did not all fit
 *  \return PACKING_OK; PACKING_ERR_INVALID. Thread-safe, but for the message of a failure.
 *          Allocates nothing */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_grid_near(const packing_grid *grid, const packing_vec3 *point, double reach,
                  size_t *indices, size_t capacity, size_t *count);

/** Finds all pairs whose surfaces are at most `gap` apart (centre distance at most
 *  r_i + r_j + gap).
 *  \param grid the grid
 *  \param gap any finite value; negative: only overlaps of that depth [L]
 *  \param[out] pairs sorted by (i, j), the first `capacity` of them; may be NULL when
 *         that is 0
 *  \param capacity room in `pairs`
 *  \param[out] count how many there are, even when they did not all fit
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_NOMEM. Thread-safe where the
 *          allocator is, but for the message of a failure. Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_grid_pairs(const packing_grid *grid, double gap, packing_pair *pairs,
                   size_t capacity, size_t *count);

PACKING_END_DECLS

#endif
