/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compressed text: the input is put behind the first bytes of a gzip file. */
#include "fuzz_read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static const uint8_t magic[] = {0x1f, 0x8b, 8};
  uint8_t *whole = malloc(size + sizeof magic);
  fuzz_require(whole != NULL);
  memcpy(whole, magic, sizeof magic);
  if (size > 0)
    memcpy(whole + sizeof magic, data, size);
  const int result = fuzz_read_pack("yade", whole, size + sizeof magic);
  free(whole);
  return result;
}
