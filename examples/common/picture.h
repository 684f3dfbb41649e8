/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_PICTURE_H
#define EXAMPLES_PICTURE_H

/* Pictures through cairo: packs, and cumulative size curves. */

#include "pack.h"

packing_status picture_write_png(const pack *p, const packing_stream *stream);
packing_status picture_write_svg(const pack *p, const packing_stream *stream);
packing_status picture_write_sizes_png(const pack *p, const packing_stream *stream);
packing_status picture_write_sizes_svg(const pack *p, const packing_stream *stream);

#endif
