/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_PARTICLES_H
#define PACKING_PARTICLES_H

/** \file packing/particles.h
 *  The pack: a structure-of-arrays store. Particle i is entry i of every column; indices
 *  are dense and change only in packing_particles_remove() and packing_particles_truncate().
 *  One owner: a store is used by one thread at a time, const calls by any while nobody
 *  changes it. x, y, z and r take 32 bytes a particle; each optional column its own. Adding
 *  takes constant time a particle on average, what copies or removes linear time. */

#include <packing/types.h>

PACKING_BEGIN_DECLS

/** A store of particles. */
typedef struct packing_particles packing_particles;

/** Optional columns, as a sum. */
enum {
  PACKING_COLUMN_ID = 1,          /**< int64_t id; new particles get their index */
  PACKING_COLUMN_TYPE = 2,        /**< int32_t type; new particles get 1 */
  PACKING_COLUMN_COMPONENT = 4,   /**< int32_t part of a mixture; new particles get 0 */
  PACKING_COLUMN_VELOCITY = 8,    /**< vx, vy, vz; new particles get 0 [L T^-1] */
  PACKING_COLUMN_SPIN = 16,       /**< wx, wy, wz; new particles get 0 [T^-1] */
  PACKING_COLUMN_ORIENTATION = 32 /**< qw, qx, qy, qz; new particles get (1, 0, 0, 0) */
};

/** One column. Integers are int64_t (id) and int32_t (type, component), the rest double. */
typedef enum packing_field {
  PACKING_FIELD_X = 0,         /**< centre [L] */
  PACKING_FIELD_Y = 1,         /**< centre [L] */
  PACKING_FIELD_Z = 2,         /**< centre [L] */
  PACKING_FIELD_R = 3,         /**< bounding radius [L], > 0 */
  PACKING_FIELD_ID = 4,        /**< int64_t, the host's name */
  PACKING_FIELD_TYPE = 5,      /**< int32_t */
  PACKING_FIELD_COMPONENT = 6, /**< int32_t */
  PACKING_FIELD_VX = 7,        /**< velocity [L T^-1] */
  PACKING_FIELD_VY = 8,        /**< velocity [L T^-1] */
  PACKING_FIELD_VZ = 9,        /**< velocity [L T^-1] */
  PACKING_FIELD_WX = 10,       /**< spin [T^-1] */
  PACKING_FIELD_WY = 11,       /**< spin [T^-1] */
  PACKING_FIELD_WZ = 12,       /**< spin [T^-1] */
  PACKING_FIELD_QW = 13,       /**< orientation, real part [1] */
  PACKING_FIELD_QX = 14,       /**< orientation [1] */
  PACKING_FIELD_QY = 15,       /**< orientation [1] */
  PACKING_FIELD_QZ = 16,       /**< orientation [1] */
  PACKING_FIELD_END = 17       /**< one past the last field */
} packing_field;

/** Options of packing_particles_create(). */
typedef struct packing_particles_def {
  size_t struct_size; /**< set by packing_particles_def_init() */
  int dim;            /**< 3 (default) or 2: then z is always 0 */
  unsigned columns;   /**< sum of PACKING_COLUMN_; default none */
  size_t capacity;    /**< particles to make room for at once; default 0 */
} packing_particles_def;

/** Writes the defaults; called through packing_particles_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_particles_def_fill(packing_particles_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_particles_def_init(packing_particles_def *def)
{
  packing_particles_def_fill(def, sizeof *def);
}

/** Makes an empty store.
 *  \param context NULL is fine
 *  \param def options, or NULL for the defaults
 *  \param[out] particles the store
 *  \return PACKING_OK; PACKING_ERR_RANGE (dim, columns, capacity); PACKING_ERR_NOMEM;
 *          PACKING_ERR_ABI */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_particles_create(packing_context *context, const packing_particles_def *def,
                         packing_particles **particles);

/** Destroys a store.
 *  \param particles NULL is fine */
PACKING_API void packing_particles_destroy(packing_particles *particles);

/** The number of particles.
 *  \param particles the store
 *  \return count */
PACKING_API size_t packing_particles_count(const packing_particles *particles);

/** The dimension.
 *  \param particles the store
 *  \return 2 or 3 */
PACKING_API int packing_particles_dim(const packing_particles *particles);

/** The optional columns there are.
 *  \param particles the store
 *  \return a sum of PACKING_COLUMN_ */
PACKING_API unsigned packing_particles_columns(const packing_particles *particles);

/** Adds optional columns with their default values.
 *  \param particles the store
 *  \param columns sum of PACKING_COLUMN_; those present are left alone
 *  \return PACKING_OK; PACKING_ERR_RANGE; PACKING_ERR_NOMEM (the store is as before) */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_particles_add_columns(packing_particles *particles, unsigned columns);

/** Makes room, so that no call allocates until `capacity` particles are reached.
 *  \param particles the store
 *  \param capacity total particles
 *  \return PACKING_OK; PACKING_ERR_NOMEM (the store is as before) */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_particles_reserve(packing_particles *particles, size_t capacity);

/** Adds one particle; optional columns get their defaults.
 *  \param particles the store
 *  \param centre [L], finite; in two dimensions z must be 0
 *  \param r bounding radius [L], > 0
 *  \param[out] index of the particle; NULL is fine
 *  \return PACKING_OK; PACKING_ERR_INVALID; PACKING_ERR_RANGE (r);
 *          PACKING_ERR_NOMEM. Amortised constant time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_particles_add(
    packing_particles *particles, packing_vec3 centre, double r, size_t *index);

/** Adds all particles of a view; columns that the view lacks get defaults, those that the
 *  store lacks are dropped.
 *  \param particles the store, left as before on failure
 *  \param view the particles, not of this store
 *  \return PACKING_OK; PACKING_ERR_INVALID, PACKING_ERR_RANGE (message and log name the
 *          entry); PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_particles_append(packing_particles *particles, const packing_view *view);

/** Replaces all particles by those of a view, as packing_particles_append() would.
 *  \param particles the store, left as before on failure
 *  \param view the particles, not of this store
 *  \return as packing_particles_append() */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_particles_assign(packing_particles *particles, const packing_view *view);

/** Copies a column out.
 *  \param particles the store
 *  \param field which column; it must be present
 *  \param[out] out entry i goes to `(char *)out + i * stride`, for i < count
 *  \param stride bytes, at least the size of an entry
 *  \return PACKING_OK; PACKING_ERR_RANGE (field, stride); PACKING_ERR_INVALID (absent) */
PACKING_API PACKING_WARN_UNUSED packing_status packing_particles_extract(
    const packing_particles *particles, packing_field field, void *out, size_t stride);

/** Overwrites a column.
 *  \param particles the store, left as before on failure
 *  \param field which column; it must be present
 *  \param in entry i stands at `(const char *)in + i * stride`, for i < count
 *  \param stride bytes, at least the size of an entry
 *  \return PACKING_OK; PACKING_ERR_RANGE (field, stride, a radius); PACKING_ERR_INVALID
 *          (absent; a number that is not finite) */
PACKING_API PACKING_WARN_UNUSED packing_status packing_particles_set(
    packing_particles *particles, packing_field field, const void *in, size_t stride);

/** Shows the store as a view, without a copy.
 *  \param particles the store
 *  \param[out] view valid until the store is next changed or destroyed */
PACKING_API void packing_particles_view(const packing_particles *particles,
                                        packing_view *view);

/** Removes particles; the rest keep their order and move up.
 *  \param particles the store, left as before on failure
 *  \param indices `count` indices, strictly rising
 *  \param count how many
 *  \return PACKING_OK; PACKING_ERR_RANGE (an index too large or out of order). Linear time */
PACKING_API PACKING_WARN_UNUSED packing_status packing_particles_remove(
    packing_particles *particles, const size_t *indices, size_t count);

/** Drops the last particles; memory is kept.
 *  \param particles the store
 *  \param count particles to keep; more than there are: nothing happens */
PACKING_API void packing_particles_truncate(packing_particles *particles, size_t count);

/** Adds a column of doubles of the user's own; new particles get 0.
 *  \param particles the store
 *  \param name 1 to 31 bytes, not yet used by a user column
 *  \return PACKING_OK; PACKING_ERR_INVALID (name); PACKING_ERR_NOMEM */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_particles_add_user_column(packing_particles *particles, const char *name);

/** The values of a user column, to read and write.
 *  \param particles the store
 *  \param name as added
 *  \param[out] values `count` doubles, valid until the store is next changed
 *  \return PACKING_OK; PACKING_ERR_INVALID (no such column) */
PACKING_API PACKING_WARN_UNUSED packing_status packing_particles_user_column(
    packing_particles *particles, const char *name, double **values);

/** Memory held.
 *  \param particles the store
 *  \return bytes, room for growth included */
PACKING_API size_t packing_particles_bytes(const packing_particles *particles);

PACKING_END_DECLS

#endif
