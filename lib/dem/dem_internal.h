/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_DEM_INTERNAL_H
#define PACKING_DEM_INTERNAL_H

/* Laws and materials as the stepper sees them. */

#include "base_internal.h"
#include <packing/dem.h>
#include <stdatomic.h>

enum {
  PACKING_I_LAWS = 16,      /* of a stepper */
  PACKING_I_HISTORY = 16,   /* doubles of a law */
  PACKING_I_MATERIALS = 64, /* of a table */
  PACKING_I_BATCH = 128     /* pairs of a batch, a multiple of 8 */
};

/* One kind of law. */
typedef struct packing_i_law_ops {
  const char *name;
  const char *reference;
  /* The work for an instruction set; `user` will be law->user. */
  packing_law_function (*kernel)(const packing_law *law, packing_isa isa);
  void (*release)(packing_law *law); /* NULL: nothing to release */
} packing_i_law_ops;

/* `user` is what the kernel gets: the law itself (whose parameters it reads) for built-in laws,
 * the user's pointer for custom ones. */
struct packing_law {
  atomic_size_t holds;
  packing_allocator allocator; /* a copy: a law outlives its context */
  const packing_i_law_ops *ops;
  void *user;
  double reach;          /* 0: a law of contacts */
  size_t history_size;   /* doubles a contact */
  unsigned history_even; /* bit h: history h stays when i and j swap */
  union {
    packing_law_hertz_def hertz;
    packing_law_sliding_def sliding;
    packing_law_near_field_def near_field;
    packing_law_custom_def custom;
  } as;
};

/* A law of a kind with nothing in it; `user` points to the law. */
packing_status packing_i_law_create(packing_context *context,
                                    const packing_i_law_ops *ops, packing_law **law);

/* One more hold. */
packing_law *packing_i_law_retain(packing_law *law);

/* All pairs of materials, for kernels and for the stepper. Entry a * (count + 1) + b is the pair
 * of particles of materials a and b; b = count stands for the rigid wall. */
typedef struct packing_i_pair_table {
  size_t count; /* materials */
  packing_pair_material pair[PACKING_I_MATERIALS * (PACKING_I_MATERIALS + 1)];
  /* Share of the overlap that i takes: (1 - nu_i^2) / E_i * E*, 1 against a rigid wall. */
  double share[PACKING_I_MATERIALS * (PACKING_I_MATERIALS + 1)];
  double density[PACKING_I_MATERIALS];
} packing_i_pair_table;

/* Fills a table; PACKING_ERR_RANGE for an empty one. */
packing_status packing_i_materials_table(packing_context *context,
                                         const packing_materials *materials,
                                         packing_i_pair_table *table);

#endif
