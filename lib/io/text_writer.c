/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small pieces of output gathered into large ones. */
#include "io_internal.h"
#include <string.h>

enum { CAPACITY = 1 << 18, LARGEST_ROOM = 1 << 16 };

packing_status packing_i_stream_failed(packing_context *context,
                                       const packing_stream *stream,
                                       const packing_i_format *format,
                                       packing_status status)
{
  if (packing_i_is_gunzip(stream) || packing_i_stream_reports_to(stream, context))
    return status;
  return packing_i_fail(context, status, "stream", PACKING_NO_INDEX,
                        "%s, with the stream of a %s file", packing_status_string(status),
                        format->name);
}

packing_status packing_i_writer_begin(packing_i_writer *writer, packing_context *context,
                                      const packing_i_format *format,
                                      const packing_stream *stream)
{
  return packing_i_writer_open(writer, context, format->name, stream);
}

packing_status packing_i_writer_open(packing_i_writer *writer, packing_context *context,
                                     const char *name, const packing_stream *stream)
{
  memset(writer, 0, sizeof *writer);
  if (stream == NULL || stream->write == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "stream", PACKING_NO_INDEX,
                          "it cannot be written to");
  writer->context = context;
  writer->stream = stream;
  writer->name = name;
  writer->capacity = CAPACITY;
  writer->buffer = packing_i_alloc(packing_i_allocator(context), CAPACITY, 1);
  return writer->buffer == NULL ? packing_i_nomem(context) : PACKING_OK;
}

static void send(packing_i_writer *w, const void *data, size_t count)
{
  if (w->status == PACKING_OK && count > 0)
    w->status = w->stream->write(w->stream->user, data, count);
}

static void flush(packing_i_writer *w)
{
  send(w, w->buffer, w->used);
  w->used = 0;
}

packing_status packing_i_writer_end(packing_i_writer *w)
{
  flush(w);
  packing_i_free(packing_i_allocator(w->context), w->buffer);
  w->buffer = NULL;
  if (w->status == PACKING_OK)
    return PACKING_OK;
  const packing_i_format format = {.name = w->name};
  return packing_i_stream_failed(w->context, w->stream, &format, w->status);
}

char *packing_i_room(packing_i_writer *w, size_t count)
{
  if (w->capacity - w->used < count)
    flush(w);
  return w->buffer + w->used;
}

void packing_i_wrote(packing_i_writer *w, size_t count)
{
  w->used += count;
}

void packing_i_put_bytes(packing_i_writer *w, const void *data, size_t count)
{
  if (count > LARGEST_ROOM) {
    flush(w);
    send(w, data, count);
    return;
  }
  memcpy(packing_i_room(w, count), data, count);
  packing_i_wrote(w, count);
}

void packing_i_put_text(packing_i_writer *w, const char *text)
{
  packing_i_put_bytes(w, text, strlen(text));
}

void packing_i_put_char(packing_i_writer *w, char c)
{
  *packing_i_room(w, 1) = c;
  packing_i_wrote(w, 1);
}

void packing_i_put_double(packing_i_writer *w, double v)
{
  packing_i_wrote(w,
                  packing_i_format_double(v, packing_i_room(w, PACKING_I_DOUBLE_SIZE)));
}

void packing_i_put_int(packing_i_writer *w, int64_t v)
{
  packing_i_wrote(w, packing_i_format_int(v, packing_i_room(w, PACKING_I_DOUBLE_SIZE)));
}

void packing_i_put_doubles(packing_i_writer *w, char separator, const double *v,
                           size_t count)
{
  for (size_t i = 0; i < count; i++) {
    packing_i_put_char(w, separator);
    packing_i_put_double(w, v[i]);
  }
}
