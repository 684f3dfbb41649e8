/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "network_text.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include "program.h"

enum { LONGEST_LINE = 1024 };
static void flush(network_text *t)
{
  if (t->status == PACKING_OK && t->used > 0)
    t->status = t->stream->write(t->stream->user, t->bytes, t->used);
  t->used = 0;
}

void network_put(network_text *t, const char *format, ...)
{
  va_list arguments;
  if (t->used > NETWORK_TEXT_SIZE - LONGEST_LINE)
    flush(t);
  va_start(arguments, format);
  const int length = vsnprintf(t->bytes + t->used, LONGEST_LINE, format, arguments);
  va_end(arguments);
  t->used += length < 0 ? 0 : (size_t)length;
}

packing_status network_text_end(network_text *t)
{
  flush(t);
  const packing_status status = t->status;
  free(t);
  return status;
}

network_text *network_text_begin(const packing_stream *stream)
{
  network_text *t = program_take(1, sizeof *t);
  t->stream = stream;
  t->status = PACKING_OK;
  t->used = 0;
  return t;
}

packing_status network_take(const packing_pores *pores, network *n)
{
  packing_status status = packing_pores_list(pores, 0, 0, NULL, &n->pores);
  if (status == PACKING_OK)
    status = packing_pores_constrictions(pores, 0, 0, NULL, &n->ways);
  if (status != PACKING_OK)
    return status;
  n->pore = program_take(n->pores + 1, sizeof *n->pore);
  n->way = program_take(n->ways + 1, sizeof *n->way);
  status = packing_pores_list(pores, 0, n->pores, n->pore, &n->pores);
  if (status == PACKING_OK)
    status = packing_pores_constrictions(pores, 0, n->ways, n->way, &n->ways);
  return status;
}

void network_drop(network *n)
{
  free(n->pore);
  free(n->way);
}

int network_leaves(const packing_constriction *c)
{
  return c->image[0] != 0 || c->image[1] != 0 || c->image[2] != 0;
}
