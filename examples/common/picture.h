/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_PICTURE_H
#define EXAMPLES_PICTURE_H

/* Pictures through cairo: packs, sheets of packs, and cumulative size curves. */

#include "pack.h"

packing_status picture_write_png(const pack *p, const packing_stream *stream);
packing_status picture_write_svg(const pack *p, const packing_stream *stream);
packing_status picture_write_sheet_png(const pack *packs, size_t count,
                                       const packing_stream *stream);
packing_status picture_write_sheet_svg(const pack *packs, size_t count,
                                       const packing_stream *stream);
packing_status picture_write_sizes_png(const pack *p, const packing_stream *stream);
packing_status picture_write_sizes_svg(const pack *p, const packing_stream *stream);

#endif
