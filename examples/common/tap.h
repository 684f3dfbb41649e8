/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_TAP_H
#define EXAMPLES_TAP_H

/* A stream for reading that hashes what passes through, keeps how it begins, and fails once the
 * program is told to stop. */

#include "sha256.h"
#include "spec.h"

enum { TAP_HEAD = 8192 };

typedef struct tap {
  packing_stream stream; /* what a reader is given */
  packing_stream *inner;
  sha256 hash;
  size_t head_length;
  char head[TAP_HEAD + 1]; /* ends with a zero byte */
} tap;

/* `t` stays where it is while its stream is used. */
void tap_open(tap *t, packing_stream *inner);

/* Reads what the reader left, and tells the hash of all. */
void tap_finish(tap *t, char digits[65]);

/* Notes a file without its hash; and after reading it, with it. */
void tap_announce(input_files *files, const char *path);
void tap_note(tap *t, input_files *files, const char *path);

#endif
