/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_SHA256_H
#define EXAMPLES_SHA256_H

/* SHA-256 (FIPS 180-4), so that a report names its input files as sha256sum does. */

#include <stdint.h>
#include <stddef.h>

typedef struct sha256 {
  uint32_t state[8];
  uint64_t length; /* bytes taken */
  unsigned char block[64];
} sha256;

void sha256_start(sha256 *hash);
void sha256_add(sha256 *hash, const void *data, size_t size);

/* 64 hexadecimal digits and a zero byte. */
void sha256_finish(sha256 *hash, char text[65]);

#endif
