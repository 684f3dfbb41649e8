/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stream cut into lines, in large reads and bounded memory. */
#include "io_internal.h"
#include <float.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { CAPACITY = 1 << 16 };

packing_status packing_i_lines_begin(packing_i_lines *lines, packing_context *context,
                                     const packing_i_format *format,
                                     const packing_stream *stream)
{
  memset(lines, 0, sizeof *lines);
  if (stream == NULL || stream->read == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "stream", PACKING_NO_INDEX,
                          "it cannot be read from");
  lines->context = context;
  lines->stream = stream;
  lines->format = format;
  lines->buffer = packing_i_alloc(packing_i_allocator(context), CAPACITY, 1);
  return lines->buffer == NULL ? packing_i_nomem(context) : PACKING_OK;
}

void packing_i_lines_end(packing_i_lines *lines)
{
  packing_i_free(packing_i_allocator(lines->context), lines->buffer);
  lines->buffer = NULL;
}

packing_status packing_i_lines_fail(const packing_i_lines *lines, packing_status status,
                                    const char *format, ...)
{
  char text[320];
  va_list arguments;
  va_start(arguments, format);
  if (vsnprintf(text, sizeof text, format, arguments) < 0)
    text[0] = '\0';
  va_end(arguments);
  return packing_i_fail(lines->context, status, NULL, lines->number, "line %zu: %s",
                        lines->number, text);
}

packing_status packing_i_check_scaled(const packing_i_lines *lines, const char *name,
                                      double v, double scaled)
{
  if (scaled > 0 && scaled <= DBL_MAX)
    return PACKING_OK;
  return packing_i_lines_fail(lines, PACKING_ERR_RANGE,
                              "%s %g times the scale is %g, which is out of range", name,
                              v, scaled);
}

const char *packing_i_quote(const char *at, const char *end, char *out)
{
  enum { MOST = 40 };
  char *to = out;
  *to++ = '"';
  for (const char *p = at; p < end && p < at + MOST; p++)
    *to++ = *p >= ' ' && *p <= '~' ? *p : '?';
  memcpy(to, end - at > MOST ? "...\"" : "\"", end - at > MOST ? 5 : 2);
  return out;
}

packing_status packing_i_number_fail(const packing_i_lines *lines, const char *name,
                                     const char *at, const char *end,
                                     packing_i_number found, const char *wanted)
{
  char quote[PACKING_I_QUOTE_SIZE];
  packing_i_quote(at, end, quote);
  if (found == PACKING_I_NUMBER_LARGE)
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT, "%s: %s is out of range", name,
                                quote);
  if (found == PACKING_I_NUMBER_LONG)
    return packing_i_lines_fail(lines, PACKING_ERR_FORMAT,
                                "%s: a number longer than %d bytes", name,
                                PACKING_I_NUMBER_LENGTH);
  return packing_i_lines_fail(lines, PACKING_ERR_FORMAT, "%s: %s is not %s", name, quote,
                              wanted);
}

packing_status packing_i_stream_overran(packing_context *context)
{
  return packing_i_fail(context, PACKING_ERR_INVALID, "stream", PACKING_NO_INDEX,
                        "its read gave more bytes than there was room for");
}

/* Reads once more behind the unread text, which moves to the front. */
static packing_status fill(packing_i_lines *l)
{
  size_t count = 0;
  memmove(l->buffer, l->buffer + l->begin, l->end - l->begin);
  l->seen -= l->begin;
  l->end -= l->begin;
  l->begin = 0;
  const size_t room = CAPACITY - 1 - l->end; /* one byte for a newline of ours */
  const packing_status status =
      l->stream->read(l->stream->user, l->buffer + l->end, room, &count);
  if (status != PACKING_OK)
    return packing_i_stream_failed(l->context, l->stream, l->format, status);
  if (count > room)
    return packing_i_stream_overran(l->context);
  l->end += count;
  l->ended = count == 0;
  return PACKING_OK;
}

static packing_status too_long(packing_i_lines *l)
{
  return packing_i_lines_fail(l, PACKING_ERR_FORMAT, "longer than %d bytes",
                              PACKING_I_LINE_LENGTH);
}

/* Where the next line ends; NULL at the end of the stream. */
static packing_status find_end(packing_i_lines *l, char **newline)
{
  l->number++;
  for (;;) {
    *newline = memchr(l->buffer + l->seen, '\n', l->end - l->seen);
    if (*newline != NULL)
      return PACKING_OK;
    l->seen = l->end;
    if (l->end - l->begin > PACKING_I_LINE_LENGTH + 1)
      return too_long(l);
    if (l->ended)
      break;
    PACKING_I_TRY(fill(l));
  }
  if (l->begin < l->end) { /* a last line without its newline */
    *newline = l->buffer + l->end;
    **newline = '\n';
    l->end++;
  }
  return PACKING_OK;
}

static packing_status next_of_any_kind(packing_i_lines *l, const char **at,
                                       const char **end)
{
  static const char mark[] = "\xEF\xBB\xBF";
  char *newline;
  *at = *end = NULL;
  PACKING_I_TRY(find_end(l, &newline));
  if (newline == NULL)
    return PACKING_OK;
  const char *first = l->buffer + l->begin;
  l->begin = l->seen = (size_t)(newline + 1 - l->buffer);
  if (l->number == 1 && newline - first >= 3 && memcmp(first, mark, 3) == 0)
    first += 3;
  if (newline > first && newline[-1] == '\r')
    *--newline = '\n';
  if (newline - first > PACKING_I_LINE_LENGTH)
    return too_long(l);
  *at = first;
  *end = newline;
  return PACKING_OK;
}

static int is_blank(const char *at, const char *end)
{
  while (at < end && (*at == ' ' || *at == '\t'))
    at++;
  return at == end;
}

packing_status packing_i_lines_next(packing_i_lines *lines, const char **at,
                                    const char **end)
{
  do
    PACKING_I_TRY(next_of_any_kind(lines, at, end));
  while (*at != NULL && ((**at == '#' && !lines->keep_comments) ||
                         (lines->skip_blank && is_blank(*at, *end))));
  return PACKING_OK;
}

packing_status packing_i_lines_peek(packing_i_lines *lines, size_t count, const char **at,
                                    size_t *seen)
{
  while (!lines->ended && lines->end - lines->begin < count)
    PACKING_I_TRY(fill(lines));
  *at = lines->buffer + lines->begin;
  *seen = lines->end - lines->begin;
  return PACKING_OK;
}

packing_status packing_i_lines_bytes(packing_i_lines *lines, void *out, size_t count,
                                     size_t *taken)
{
  const char *at;
  size_t seen;
  for (*taken = 0; *taken < count;) {
    PACKING_I_TRY(packing_i_lines_peek(lines, 1, &at, &seen));
    if (seen == 0)
      break;
    const size_t n = seen < count - *taken ? seen : count - *taken;
    memcpy((char *)out + *taken, at, n);
    *taken += n;
    lines->begin += n;
    lines->seen = lines->begin;
  }
  return PACKING_OK;
}
