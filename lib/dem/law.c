/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all laws have in common: life and names. */
#include "dem_internal.h"

packing_status packing_i_law_create(packing_context *context,
                                    const packing_i_law_ops *ops, packing_law **law)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_law *made = packing_i_calloc(allocator, 1, sizeof *made);
  if (made == NULL)
    return packing_i_nomem(context);
  atomic_init(&made->holds, 1);
  made->allocator = *allocator;
  made->ops = ops;
  made->user = made;
  *law = made;
  return PACKING_OK;
}

packing_law *packing_i_law_retain(packing_law *law)
{
  atomic_fetch_add_explicit(&law->holds, 1, memory_order_relaxed);
  return law;
}

void packing_law_destroy(packing_law *law)
{
  if (law == NULL || atomic_fetch_sub_explicit(&law->holds, 1, memory_order_acq_rel) != 1)
    return;
  if (law->ops->release != NULL)
    law->ops->release(law);
  const packing_allocator allocator = law->allocator;
  packing_i_free(&allocator, law);
}

const char *packing_law_name(const packing_law *law)
{
  return law->ops->name;
}

const char *packing_law_reference(const packing_law *law)
{
  return law->ops->reference;
}
