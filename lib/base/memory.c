/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory through the context's allocator. */
#define _POSIX_C_SOURCE 200809L
#include "base_internal.h"
#include <stdlib.h>
#include <string.h>

/* Cache lines and the widest vectors. */
enum { ALIGNMENT = 64 };

void *packing_i_alloc(const packing_allocator *allocator, size_t count, size_t size)
{
  if (count == 0)
    count = 1;
  if (size != 0 && count > (SIZE_MAX - ALIGNMENT) / size)
    return NULL;
  return allocator->allocate(allocator->user, count * size, ALIGNMENT);
}

void *packing_i_calloc(const packing_allocator *allocator, size_t count, size_t size)
{
  void *block = packing_i_alloc(allocator, count, size);
  if (block != NULL)
    memset(block, 0, (count == 0 ? 1 : count) * size);
  return block;
}

void *packing_i_regrow(const packing_allocator *allocator, void *old, size_t old_count,
                       size_t new_count, size_t size)
{
  void *block = packing_i_alloc(allocator, new_count, size);
  if (block == NULL)
    return NULL;
  if (old != NULL && old_count > 0)
    memcpy(block, old, old_count * size);
  packing_i_free(allocator, old);
  return block;
}

void packing_i_free(const packing_allocator *allocator, void *block)
{
  if (block != NULL)
    allocator->release(allocator->user, block);
}
