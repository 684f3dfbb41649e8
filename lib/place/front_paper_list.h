/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_PAPER_LIST_H
#define PACKING_FRONT_PAPER_LIST_H

/* The particles of the front, in one of the three orders of section 3.3: any of them, the oldest
 * or the youngest. 4 bytes a member; adding, choosing and dropping take constant time. */

#include "base_internal.h"
#include "rng/rng_internal.h"
#include <packing/front.h>

typedef struct packing_i_front_list {
  packing_front_select select;
  uint32_t *member; /* the oldest first, but for random selection */
  size_t first;     /* members before it are gone */
  size_t end;
  size_t capacity;
} packing_i_front_list;

/* Makes room for `count` more members. */
packing_status packing_i_front_list_reserve(packing_i_front_list *list,
                                            packing_context *context, size_t count);

/* Adds a member; room was reserved. */
void packing_i_front_list_add(packing_i_front_list *list, size_t particle);

static inline size_t packing_i_front_list_count(const packing_i_front_list *list)
{
  return list->end - list->first;
}

/* Where the member to be taken now stands; there must be one. */
size_t packing_i_front_list_select(const packing_i_front_list *list,
                                   packing_i_stream *stream);

/* Drops the member that was selected. */
void packing_i_front_list_drop(packing_i_front_list *list, size_t at);

/* packing_front_members() of particles [0, particles). */
packing_status packing_i_front_list_rising(const packing_i_front_list *list,
                                           packing_context *context, size_t particles,
                                           size_t capacity, size_t *index, size_t *count);

#endif
