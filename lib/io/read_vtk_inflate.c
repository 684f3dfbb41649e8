/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compressed arrays (vtkZLibDataCompressor): a header of the number of blocks, bytes of a block,
 * bytes of the last block where that is shorter (else 0), compressed bytes of each; then the
 * blocks, each a zlib stream. Deflate shrinks no more than 1032 times (zlib.net,
 * zlib_tech.html), so what is claimed beyond that is refused before room is made for it. */
#include "read_vtk_internal.h"
#include <limits.h>

#if PACKING_I_HAVE_ZLIB
#include "zlib_memory.h"

enum { MOST_SHRINKING = 1032 };

typedef struct header {
  uint64_t blocks, block, last; /* last: bytes of the last block, however told */
  uint64_t *packed;             /* bytes of each block in the file */
} header;

static packing_status bad(packing_i_read_vtk_source *s, const char *what)
{
  return packing_i_read_vtk_fail(s->file, s->at, PACKING_ERR_FORMAT, what);
}

static const packing_allocator *allocator_of(const packing_i_read_vtk_source *s)
{
  return packing_i_allocator(s->file->read->context);
}

/* The header up to the list, whose entries must be there and make `bytes`. */
static packing_status take_head(packing_i_read_vtk_source *s, uint64_t bytes, header *h)
{
  PACKING_I_TRY(packing_i_read_vtk_take_size(s, &h->blocks));
  PACKING_I_TRY(packing_i_read_vtk_take_size(s, &h->block));
  PACKING_I_TRY(packing_i_read_vtk_take_size(s, &h->last));
  if (h->last == 0)
    h->last = h->block;
  if (h->blocks == 0 || h->last == 0 || h->last > h->block || h->last > bytes ||
      (bytes - h->last) % h->block != 0 || (bytes - h->last) / h->block != h->blocks - 1)
    return bad(s, "the array has another length than its piece asks for");
  if (packing_i_read_vtk_left(s) / (s->file->wide_header ? 8 : 4) < h->blocks)
    return bad(s, "the array ends too early");
  return PACKING_OK;
}

/* The list; the blocks must be there and may be what they claim. */
static packing_status take_list(packing_i_read_vtk_source *s, header *h)
{
  uint64_t sum = 0;
  for (uint64_t b = 0; b < h->blocks; b++) {
    const uint64_t bytes = b + 1 < h->blocks ? h->block : h->last;
    PACKING_I_TRY(packing_i_read_vtk_take_size(s, &h->packed[b]));
    if (h->packed[b] > packing_i_read_vtk_left(s) || h->packed[b] > UINT_MAX ||
        bytes > UINT_MAX)
      return bad(s, "the array ends too early");
    if (bytes > h->packed[b] * MOST_SHRINKING)
      return bad(s, "more is claimed than compressed data hold");
    sum += h->packed[b];
  }
  return sum > packing_i_read_vtk_left(s) ? bad(s, "the array ends too early")
                                          : PACKING_OK;
}

static packing_status inflate_block(packing_i_read_vtk_source *s, z_stream *z,
                                    unsigned char *packed, uint64_t packed_bytes,
                                    unsigned char *out, uint64_t bytes)
{
  const unsigned char *start = s->at;
  PACKING_I_TRY(packing_i_read_vtk_take(s, packed, (size_t)packed_bytes));
  z->next_in = packed;
  z->avail_in = (uInt)packed_bytes;
  z->next_out = out;
  z->avail_out = (uInt)bytes;
  const int reset = inflateReset(z),
            result = reset == Z_OK ? inflate(z, Z_FINISH) : reset;
  if (result == Z_MEM_ERROR)
    return packing_i_nomem(s->file->read->context);
  if (result != Z_STREAM_END || z->avail_out != 0 || z->avail_in != 0)
    return packing_i_read_vtk_fail(s->file, start, PACKING_ERR_FORMAT,
                                   "a damaged block of compressed data");
  return PACKING_OK;
}

static packing_status inflate_blocks(packing_i_read_vtk_source *s, const header *h,
                                     z_stream *z, unsigned char *packed,
                                     unsigned char *out)
{
  for (uint64_t b = 0; b < h->blocks; b++)
    PACKING_I_TRY(inflate_block(s, z, packed, h->packed[b], out + b * h->block,
                                b + 1 < h->blocks ? h->block : h->last));
  return PACKING_OK;
}

static packing_status inflate_all(packing_i_read_vtk_source *s, const header *h,
                                  unsigned char *out)
{
  z_stream z;
  uint64_t most = 0;
  memset(&z, 0, sizeof z);
  for (uint64_t b = 0; b < h->blocks; b++)
    most = h->packed[b] > most ? h->packed[b] : most;
  unsigned char *packed = packing_i_alloc(allocator_of(s), (size_t)most, 1);
  if (packed == NULL)
    return packing_i_nomem(s->file->read->context);
  packing_i_zlib_use(&z, allocator_of(s));
  packing_status status = PACKING_OK;
  if (inflateInit(&z) != Z_OK)
    status = packing_i_nomem(s->file->read->context);
  if (status == PACKING_OK)
    status = inflate_blocks(s, h, &z, packed, out);
  inflateEnd(&z);
  packing_i_free(allocator_of(s), packed);
  return status;
}

packing_status packing_i_read_vtk_inflate(packing_i_read_vtk_source *source,
                                          uint64_t bytes,
                                          packing_i_read_vtk_values *values)
{
  header h = {0};
  PACKING_I_TRY(take_head(source, bytes, &h));
  h.packed = packing_i_alloc(allocator_of(source), (size_t)h.blocks, sizeof *h.packed);
  if (h.packed == NULL)
    return packing_i_nomem(source->file->read->context);
  packing_status status = take_list(source, &h);
  if (status == PACKING_OK) {
    values->held = packing_i_alloc(allocator_of(source), (size_t)bytes, 1);
    values->bytes = values->held;
    status = values->held == NULL ? packing_i_nomem(source->file->read->context)
                                  : inflate_all(source, &h, values->held);
  }
  packing_i_free(allocator_of(source), h.packed);
  return status;
}

#else

packing_status packing_i_read_vtk_inflate(packing_i_read_vtk_source *source,
                                          uint64_t bytes,
                                          packing_i_read_vtk_values *values)
{
  (void)bytes;
  (void)values;
  return packing_i_read_vtk_fail(source->file, source->at, PACKING_ERR_UNSUPPORTED,
                                 "compressed, and the library was built without zlib");
}
#endif
