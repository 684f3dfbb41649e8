/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_NETWORK_TEXT_H
#define EXAMPLES_NETWORK_TEXT_H

/* What the writers of networks share. */

#include <packing/packing.h>

enum { NETWORK_TEXT_SIZE = 65536 };

/* Lines on their way to a stream. */
typedef struct network_text {
  const packing_stream *stream;
  packing_status status;
  size_t used;
  char bytes[NETWORK_TEXT_SIZE];
} network_text;

network_text *network_text_begin(const packing_stream *stream);
/* A line, or a part of one, of at most 1023 bytes. */
__attribute__((format(printf, 2, 3))) void network_put(network_text *t,
                                                       const char *format, ...);
/* Sends what is left, frees, and returns the first failure of the stream. */
packing_status network_text_end(network_text *t);

/* The lists of a network. */
typedef struct network {
  packing_pore *pore;
  packing_constriction *way;
  size_t pores, ways;
} network;

/* Drop it in any case. */
packing_status network_take(const packing_pores *pores, network *n);
void network_drop(network *n);

/* Whether a way ends at an image. */
int network_leaves(const packing_constriction *c);

#endif
