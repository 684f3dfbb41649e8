/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"

static packing_status buffer_read(void *user, void *out, size_t capacity, size_t *count)
{
  test_buffer *b = user;
  size_t n = b->size - b->read_at;
  if (n > capacity)
    n = capacity;
  if (b->chunk != 0 && n > b->chunk)
    n = b->chunk;
  if (n > 0)
    memcpy(out, b->data + b->read_at, n);
  b->read_at += n;
  *count = n;
  return PACKING_OK;
}

static packing_status buffer_write(void *user, const void *data, size_t count)
{
  test_buffer *b = user;
  if (b->limit != 0 && b->size + count > b->limit)
    return PACKING_ERR_IO;
  char *grown = realloc(b->data, b->size + count + 1);
  if (grown == NULL)
    return PACKING_ERR_NOMEM;
  b->data = grown;
  memcpy(b->data + b->size, data, count);
  b->size += count;
  b->data[b->size] = '\0';
  return PACKING_OK;
}

packing_stream test_buffer_stream(test_buffer *buffer)
{
  packing_stream stream = {buffer_read, buffer_write, buffer};
  return stream;
}

void test_buffer_text(test_buffer *buffer, const char *text)
{
  memset(buffer, 0, sizeof *buffer);
  buffer->size = strlen(text);
  buffer->data = malloc(buffer->size + 1);
  assert_non_null(buffer->data);
  memcpy(buffer->data, text, buffer->size + 1);
}

void test_buffer_free(test_buffer *buffer)
{
  free(buffer->data);
  memset(buffer, 0, sizeof *buffer);
}
