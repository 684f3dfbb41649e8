/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_ZLIB_MEMORY_H
#define PACKING_ZLIB_MEMORY_H

/* Lets zlib take its memory from an allocator of ours, which must outlive the stream. */

#include "base_internal.h"
#include <zlib.h>

static inline void *packing_i_zlib_alloc(void *user, unsigned items, unsigned size)
{
  return packing_i_calloc(user, items, size);
}

static inline void packing_i_zlib_free(void *user, void *block)
{
  packing_i_free(user, block);
}

static inline void packing_i_zlib_use(z_stream *z, const packing_allocator *allocator)
{
  union { /* zlib's user pointer is not const */
    const packing_allocator *in;
    void *out;
  } pointer = {allocator};
  z->zalloc = packing_i_zlib_alloc;
  z->zfree = packing_i_zlib_free;
  z->opaque = pointer.out;
}

#endif
