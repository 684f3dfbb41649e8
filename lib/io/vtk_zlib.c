/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK's compressed arrays: a header of 64-bit numbers (blocks, bytes of a block, bytes of a
 * partial last block or 0, compressed bytes of each), then the blocks, each a zlib stream.
 * Blocks are cut by the number of tuples alone and compressed side by side, so the bytes do
 * not depend on the threads. zlib's memory comes from the context, before the threads start. */
#include "vtk_internal.h"

#if PACKING_I_HAVE_ZLIB

#include "zlib_memory.h"

enum { MOST_SLOTS = 16, MOST_TUPLE = 32, BLOCK_BYTES = PACKING_I_VTK_BLOCK * MOST_TUPLE };

/* One block in flight. */
typedef struct slot {
  z_stream z;
  int ready; /* z holds memory */
  int failed;
  unsigned char *raw, *packed;
  size_t packed_size;
} slot;

typedef struct zlib_deflater {
  packing_i_deflater base;
  packing_context *context;
  const packing_allocator *allocator;
  unsigned slot_count;
  size_t capacity; /* of `packed` */
  slot slots[MOST_SLOTS];
  const packing_i_vtk_array *array; /* being compressed, from block `first` on */
  size_t first;
  uint64_t *sizes; /* of all blocks of all arrays, packed, as measured */
  size_t measured, written;
} zlib_deflater;

static packing_status slot_begin(zlib_deflater *d, slot *s, int level)
{
  packing_i_zlib_use(&s->z, d->allocator);
  s->raw = packing_i_alloc(d->allocator, BLOCK_BYTES, 1);
  s->packed = packing_i_alloc(d->allocator, d->capacity, 1);
  s->ready = deflateInit(&s->z, level) == Z_OK;
  return s->raw != NULL && s->packed != NULL && s->ready ? PACKING_OK
                                                         : packing_i_nomem(d->context);
}

/* One block into its slot; nothing is allocated here. */
static void compress_block(void *user, size_t i)
{
  zlib_deflater *d = user;
  slot *s = &d->slots[i];
  const size_t begin = (d->first + i) * PACKING_I_VTK_BLOCK;
  const size_t left = d->array->tuples - begin;
  const size_t tuples = left < PACKING_I_VTK_BLOCK ? left : PACKING_I_VTK_BLOCK;
  packing_i_vtk_gather(d->array, begin, tuples, s->raw);
  s->failed = deflateReset(&s->z) != Z_OK;
  s->z.next_in = s->raw;
  s->z.avail_in = (unsigned)(tuples * packing_i_vtk_tuple_size(d->array));
  s->z.next_out = s->packed;
  s->z.avail_out = (unsigned)d->capacity;
  s->failed |= deflate(&s->z, Z_FINISH) != Z_STREAM_END;
  s->packed_size = d->capacity - s->z.avail_out;
}

static size_t block_count(const packing_i_vtk_array *a)
{
  return a->tuples / PACKING_I_VTK_BLOCK + (a->tuples % PACKING_I_VTK_BLOCK != 0);
}

/* Compresses the blocks from `first` on; *count is how many were done. */
static packing_status compress_batch(zlib_deflater *d, const packing_i_vtk_array *a,
                                     size_t first, size_t *count)
{
  const size_t left = block_count(a) - first;
  *count = left < d->slot_count ? left : d->slot_count;
  d->array = a;
  d->first = first;
  packing_i_parallel(d->context, *count, compress_block, d);
  for (size_t i = 0; i < *count; i++)
    if (d->slots[i].failed)
      return packing_i_fail(d->context, PACKING_ERR_INTERNAL, a->name, PACKING_NO_INDEX,
                            "zlib failed");
  return PACKING_OK;
}

static packing_status measure(packing_i_deflater *base, const packing_i_vtk_array *a,
                              uint64_t *bytes)
{
  zlib_deflater *d = (zlib_deflater *)base;
  const size_t blocks = block_count(a);
  size_t done;
  uint64_t sum = (3 + blocks) * sizeof(uint64_t);
  for (size_t first = 0; first < blocks; first += done) {
    PACKING_I_TRY(compress_batch(d, a, first, &done));
    for (size_t i = 0; i < done; i++)
      sum += d->sizes[d->measured++] = d->slots[i].packed_size;
  }
  *bytes = sum;
  return PACKING_OK;
}

static packing_status put_block(zlib_deflater *d, const slot *s, packing_i_writer *w)
{
  if (s->packed_size != d->sizes[d->written++])
    return packing_i_fail(d->context, PACKING_ERR_INVALID, "view", PACKING_NO_INDEX,
                          "the particles changed while they were written");
  packing_i_put_bytes(w, s->packed, s->packed_size);
  return PACKING_OK;
}

static packing_status write_array(packing_i_deflater *base, const packing_i_vtk_array *a,
                                  packing_i_writer *w)
{
  zlib_deflater *d = (zlib_deflater *)base;
  const size_t blocks = block_count(a), size = packing_i_vtk_tuple_size(a);
  const uint64_t head[] = {blocks, PACKING_I_VTK_BLOCK * size,
                           a->tuples % PACKING_I_VTK_BLOCK * size};
  size_t done;
  packing_i_put_bytes(w, head, sizeof head);
  for (size_t b = 0; b < blocks; b++)
    packing_i_put_bytes(w, &d->sizes[d->written + b], sizeof d->sizes[0]);
  for (size_t first = 0; first < blocks && w->status == PACKING_OK; first += done) {
    PACKING_I_TRY(compress_batch(d, a, first, &done));
    for (size_t i = 0; i < done; i++)
      PACKING_I_TRY(put_block(d, &d->slots[i], w));
  }
  return PACKING_OK;
}

static void destroy(packing_i_deflater *base)
{
  zlib_deflater *d = (zlib_deflater *)base;
  for (unsigned i = 0; i < d->slot_count; i++) {
    if (d->slots[i].ready)
      deflateEnd(&d->slots[i].z);
    packing_i_free(d->allocator, d->slots[i].raw);
    packing_i_free(d->allocator, d->slots[i].packed);
  }
  packing_i_free(d->allocator, d->sizes);
  packing_i_free(d->allocator, d);
}

packing_status packing_i_deflater_create(packing_context *context, int level,
                                         size_t arrays, size_t tuples,
                                         packing_i_deflater **deflater)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const packing_i_deflater base = {measure, write_array, destroy};
  zlib_deflater *d = packing_i_calloc(allocator, 1, sizeof *d);
  packing_status status = PACKING_OK;
  if (d == NULL)
    return packing_i_nomem(context);
  d->base = base;
  d->context = context;
  d->allocator = allocator;
  d->capacity = compressBound(BLOCK_BYTES);
  d->slot_count = packing_context_threads(context) > 1 ? MOST_SLOTS : 1;
  d->sizes = packing_i_alloc(allocator, arrays * (tuples / PACKING_I_VTK_BLOCK + 1),
                             sizeof *d->sizes);
  if (d->sizes == NULL)
    status = packing_i_nomem(context);
  for (unsigned i = 0; i < d->slot_count && status == PACKING_OK; i++)
    status = slot_begin(d, &d->slots[i], level);
  if (status == PACKING_OK)
    *deflater = &d->base;
  else
    destroy(&d->base);
  return status;
}

#else

packing_status packing_i_deflater_create(packing_context *context, int level,
                                         size_t arrays, size_t tuples,
                                         packing_i_deflater **deflater)
{
  (void)level;
  (void)arrays;
  (void)tuples;
  (void)deflater;
  return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "compression", PACKING_NO_INDEX,
                        "the library was built without zlib");
}
#endif
