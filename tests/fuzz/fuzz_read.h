/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FUZZ_READ_H
#define PACKING_FUZZ_READ_H

/* packing_read_pack(): what it takes must be a pack, what it refuses must leave the store empty
 * and say why, and neither may ask for memory that the input does not account for. The size of
 * the input chooses the options. */

#include "fuzz.h"
#include <math.h>
#include <stdlib.h>

/* An input of 4096 bytes inflates to 4 MiB at most. */
enum { FUZZ_MOST_MEMORY = 8 << 20 };

static inline void *fuzz_allocate(void *user, size_t size, size_t alignment)
{
  (void)user;
  fuzz_require(size <= FUZZ_MOST_MEMORY);
  return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static inline void fuzz_release(void *user, void *block)
{
  (void)user;
  free(block);
}

static inline packing_context *fuzz_bounded_context(void)
{
  packing_context *context = NULL;
  packing_context_def def;
  packing_context_def_init(&def);
  def.threads = 1;
  def.allocator.allocate = fuzz_allocate;
  def.allocator.release = fuzz_release;
  fuzz_require(packing_context_create(&def, &context) == PACKING_OK);
  return context;
}

static inline const double *fuzz_doubles(packing_column column)
{
  return (const double *)column.data;
}

static inline void fuzz_check_pack(const packing_particles *particles,
                                   const packing_bonds *bonds,
                                   const packing_read_info *info, int sorted)
{
  packing_view v;
  packing_particles_view(particles, &v);
  fuzz_require(v.count == info->particles && info->frame < info->frames);
  fuzz_require(info->dim == 2 || info->dim == 3);
  for (size_t i = 0; i < v.count; i++) {
    fuzz_require(isfinite(fuzz_doubles(v.x)[i]) && isfinite(fuzz_doubles(v.y)[i]));
    fuzz_require(isfinite(fuzz_doubles(v.z)[i]) && isfinite(fuzz_doubles(v.r)[i]));
    fuzz_require(fuzz_doubles(v.r)[i] > 0);
    fuzz_require(info->dim == 3 || fuzz_doubles(v.z)[i] == 0);
    if (sorted && i > 0)
      fuzz_require(((const int64_t *)v.id.data)[i] > ((const int64_t *)v.id.data)[i - 1]);
  }
  fuzz_require(packing_bonds_count(bonds) == info->bonds);
  for (size_t b = 0; b < info->bonds; b++) {
    const packing_bond *bond = &packing_bonds_data(bonds)[b];
    fuzz_require(bond->i < v.count && bond->j < v.count && bond->i != bond->j);
  }
}

static inline void fuzz_check_refusal(packing_context *context, packing_status status,
                                      const packing_particles *particles,
                                      const packing_bonds *bonds)
{
  fuzz_require(status == PACKING_ERR_FORMAT || status == PACKING_ERR_RANGE ||
               status == PACKING_ERR_UNSUPPORTED);
  fuzz_require(packing_particles_count(particles) == 0 &&
               packing_bonds_count(bonds) == 0);
  fuzz_require(packing_context_message(context)[0] != '\0');
  fuzz_require(strchr(packing_context_message(context), '\n') == NULL);
}

static inline int fuzz_read_pack(const char *format, const uint8_t *data, size_t size)
{
  packing_context *context = fuzz_bounded_context();
  packing_particles *particles = NULL;
  packing_bonds *bonds = NULL;
  packing_particles_def store;
  packing_read_def def;
  packing_read_info info;
  fuzz_input in;
  const packing_stream stream = fuzz_stream(&in, data, size);
  packing_particles_def_init(&store);
  packing_read_def_init(&def);
  packing_read_info_init(&info);
  store.dim = size % 7 == 0 ? 2 : 3;
  def.frame = (int64_t)(size % 11 % 4) - 1;
  def.sort = size % 3 == 0;
  fuzz_require(packing_particles_create(context, &store, &particles) == PACKING_OK);
  fuzz_require(packing_bonds_create(context, &bonds) == PACKING_OK);
  def.bonds = bonds;
  const packing_status status =
      packing_read_pack(context, &def, format, &stream, particles, &info);
  if (status == PACKING_OK)
    fuzz_check_pack(particles, bonds, &info, def.sort);
  else
    fuzz_check_refusal(context, status, particles, bonds);
  packing_bonds_destroy(bonds);
  packing_particles_destroy(particles);
  packing_context_destroy(context);
  return 0;
}

#endif
