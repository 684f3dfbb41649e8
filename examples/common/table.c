/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "table.h"
#include <stdarg.h>
#include <stdio.h>

enum { LINE = 1001 };

void table_open(table *t, const packing_stream *stream)
{
  t->stream = stream;
  t->status = PACKING_OK;
  t->used = 0;
}

static void send(table *t)
{
  if (t->status == PACKING_OK && t->used > 0)
    t->status = t->stream->write(t->stream->user, t->buffer, t->used);
  t->used = 0;
}

void table_print(table *t, const char *format, ...)
{
  va_list arguments;
  if (t->used + LINE > sizeof t->buffer)
    send(t);
  va_start(arguments, format);
  const int length = vsnprintf(t->buffer + t->used, LINE, format, arguments);
  va_end(arguments);
  if (length < 0 || length >= LINE)
    t->status = PACKING_ERR_INTERNAL;
  else
    t->used += (size_t)length;
}

packing_status table_close(table *t)
{
  send(t);
  return t->status;
}
