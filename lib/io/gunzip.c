/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stream in front of another: what begins with the two bytes of gzip (RFC 1952) is inflated,
 * all else handed on. Members may follow each other, as with `cat a.gz b.gz`; anything else
 * behind a member is refused. Memory is constant, whatever the data inflate to. */
#include "read_internal.h"
#include <limits.h>

#if PACKING_I_HAVE_ZLIB
#include "zlib_memory.h"
#endif

enum { CAPACITY = 1 << 16, FIRST_MAGIC = 0x1f, SECOND_MAGIC = 0x8b };

struct packing_i_gunzip {
  packing_context *context;
  const packing_i_format *format;
  const packing_stream *from;
  packing_stream stream;
  size_t begin, end; /* of what was read and not handed on */
  uint64_t consumed; /* bytes before `begin` */
  int ended;         /* the stream behind is at its end */
#if PACKING_I_HAVE_ZLIB
  z_stream z;
  int inflating;
  int between; /* a member is behind us and no other begun */
#endif
  unsigned char buffer[CAPACITY];
};

/* Reads once more; what is left moves to the front. */
static packing_status fill(packing_i_gunzip *g)
{
  size_t count = 0;
  memmove(g->buffer, g->buffer + g->begin, g->end - g->begin);
  g->end -= g->begin;
  g->begin = 0;
  const size_t room = CAPACITY - g->end;
  const packing_status status =
      g->from->read(g->from->user, g->buffer + g->end, room, &count);
  if (status != PACKING_OK)
    return packing_i_stream_failed(g->context, g->from, g->format, status);
  if (count > room)
    return packing_i_stream_overran(g->context);
  g->end += count;
  g->ended = count == 0;
  return PACKING_OK;
}

/* Has `count` bytes unread, unless the end comes before. */
static packing_status peek(packing_i_gunzip *g, size_t count)
{
  while (!g->ended && g->end - g->begin < count)
    PACKING_I_TRY(fill(g));
  return PACKING_OK;
}

static int is_magic(const packing_i_gunzip *g)
{
  return g->end - g->begin >= 2 && g->buffer[g->begin] == FIRST_MAGIC &&
         g->buffer[g->begin + 1] == SECOND_MAGIC;
}

static void advance(packing_i_gunzip *g, size_t count)
{
  g->begin += count;
  g->consumed += count;
}

/* Hands on what was peeked at, then the stream itself. */
static packing_status pass(packing_i_gunzip *g, void *buffer, size_t capacity,
                           size_t *count)
{
  size_t n = g->end - g->begin;
  if (n == 0 && !g->ended) {
    const packing_status status = g->from->read(g->from->user, buffer, capacity, count);
    if (status != PACKING_OK)
      return packing_i_stream_failed(g->context, g->from, g->format, status);
    g->ended = *count == 0;
    return PACKING_OK;
  }
  n = n < capacity ? n : capacity;
  if (n > 0)
    memcpy(buffer, g->buffer + g->begin, n);
  advance(g, n);
  *count = n;
  return PACKING_OK;
}

#if PACKING_I_HAVE_ZLIB

static packing_status bad(packing_i_gunzip *g, const char *what)
{
  return packing_i_fail(g->context, PACKING_ERR_FORMAT, NULL, (size_t)g->consumed,
                        "byte %llu of the compressed data: %s",
                        (unsigned long long)g->consumed, what);
}

static packing_status start(packing_i_gunzip *g)
{
  enum { GZIP = 16 };
  if (!is_magic(g))
    return PACKING_OK;
  packing_i_zlib_use(&g->z, packing_i_allocator(g->context));
  g->inflating = 1;
  return inflateInit2(&g->z, MAX_WBITS + GZIP) == Z_OK ? PACKING_OK
                                                       : packing_i_nomem(g->context);
}

/* Behind a member: the next, or *ended. */
static packing_status next_member(packing_i_gunzip *g, int *ended)
{
  PACKING_I_TRY(peek(g, 2));
  *ended = g->begin == g->end;
  if (*ended)
    return PACKING_OK;
  if (!is_magic(g) || inflateReset(&g->z) != Z_OK)
    return bad(g, "something else follows");
  g->between = 0;
  return PACKING_OK;
}

static packing_status inflate_some(packing_i_gunzip *g)
{
  PACKING_I_TRY(peek(g, 1));
  g->z.next_in = g->buffer + g->begin;
  g->z.avail_in = (uInt)(g->end - g->begin);
  const int result = inflate(&g->z, Z_NO_FLUSH);
  advance(g, g->end - g->begin - g->z.avail_in);
  if (result == Z_MEM_ERROR)
    return packing_i_nomem(g->context);
  if (result == Z_BUF_ERROR && g->begin == g->end && g->ended)
    return bad(g, "they end too early");
  if (result != Z_OK && result != Z_STREAM_END)
    return bad(g, "damaged");
  g->between = result == Z_STREAM_END;
  return PACKING_OK;
}

static packing_status gunzip_read(void *user, void *buffer, size_t capacity,
                                  size_t *count)
{
  packing_i_gunzip *g = user;
  int ended = 0;
  if (!g->inflating)
    return pass(g, buffer, capacity, count);
  const uInt room = capacity > UINT_MAX ? UINT_MAX : (uInt)capacity;
  g->z.next_out = buffer;
  g->z.avail_out = room;
  while (g->z.avail_out == room && !ended) {
    if (g->between)
      PACKING_I_TRY(next_member(g, &ended));
    else
      PACKING_I_TRY(inflate_some(g));
  }
  *count = room - g->z.avail_out;
  return PACKING_OK;
}

static void stop(packing_i_gunzip *g)
{
  if (g->inflating)
    inflateEnd(&g->z);
}

#else

static packing_status start(packing_i_gunzip *g)
{
  if (!is_magic(g))
    return PACKING_OK;
  return packing_i_fail(g->context, PACKING_ERR_UNSUPPORTED, "stream", PACKING_NO_INDEX,
                        "compressed, and the library was built without zlib");
}

static packing_status gunzip_read(void *user, void *buffer, size_t capacity,
                                  size_t *count)
{
  return pass(user, buffer, capacity, count);
}

static void stop(packing_i_gunzip *g)
{
  (void)g;
}
#endif

int packing_i_is_gunzip(const packing_stream *stream)
{
  return stream->read == gunzip_read;
}

packing_status packing_i_gunzip_create(packing_context *context,
                                       const packing_i_format *format,
                                       const packing_stream *stream,
                                       packing_i_gunzip **gunzip)
{
  packing_i_gunzip *g = packing_i_alloc(packing_i_allocator(context), 1, sizeof *g);
  if (g == NULL)
    return packing_i_nomem(context);
  memset(g, 0, offsetof(packing_i_gunzip, buffer));
  g->context = context;
  g->format = format;
  g->from = stream;
  g->stream.read = gunzip_read;
  g->stream.user = g;
  packing_status status = peek(g, 2);
  if (status == PACKING_OK)
    status = start(g);
  if (status == PACKING_OK)
    *gunzip = g;
  else
    packing_i_gunzip_destroy(g);
  return status;
}

void packing_i_gunzip_destroy(packing_i_gunzip *gunzip)
{
  if (gunzip == NULL)
    return;
  stop(gunzip);
  packing_i_free(packing_i_allocator(gunzip->context), gunzip);
}

const packing_stream *packing_i_gunzip_stream(packing_i_gunzip *gunzip)
{
  return &gunzip->stream;
}
