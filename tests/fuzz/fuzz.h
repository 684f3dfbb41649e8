/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FUZZ_H
#define PACKING_FUZZ_H

/* What the fuzz targets share: bytes as a stream, handed out in pieces whose size comes from
 * the input, so that every way of cutting lines is met. A broken promise traps. */

#include <packing/packing.h>
#include <string.h>

typedef struct fuzz_input {
  const uint8_t *data;
  size_t size, at, chunk;
} fuzz_input;

static inline packing_status fuzz_read(void *user, void *buffer, size_t capacity,
                                       size_t *count)
{
  fuzz_input *in = user;
  size_t n = in->size - in->at;
  n = n < capacity ? n : capacity;
  n = in->chunk != 0 && n > in->chunk ? in->chunk : n;
  if (n > 0)
    memcpy(buffer, in->data + in->at, n);
  in->at += n;
  *count = n;
  return PACKING_OK;
}

static inline packing_stream fuzz_stream(fuzz_input *in, const uint8_t *data, size_t size)
{
  const packing_stream stream = {fuzz_read, NULL, in};
  in->data = data;
  in->size = size;
  in->at = 0;
  in->chunk = size % 5;
  return stream;
}

static inline void fuzz_require(int condition)
{
  if (!condition)
    __builtin_trap();
}

static inline packing_context *fuzz_context(void)
{
  packing_context *context = NULL;
  packing_context_def def;
  packing_context_def_init(&def);
  def.threads = 1;
  fuzz_require(packing_context_create(&def, &context) == PACKING_OK);
  return context;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
