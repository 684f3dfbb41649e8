/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_OUTLINE_H
#define EXAMPLES_OUTLINE_H

/* The edges of a container as short straight pieces, with the silhouette that a viewer in
 * direction `toward` sees of curved walls. */

#include "spec.h"

typedef void (*outline_piece)(void *user, packing_vec3 from, packing_vec3 to);

void outline_trace(const domain_spec *spec, packing_vec3 toward, outline_piece piece,
                   void *user);

#endif
