/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_CANVAS_H
#define EXAMPLES_CANVAS_H

/* A cairo surface, PNG or SVG, that ends in a packing_stream. */

#include <cairo.h>
#include <packing/packing.h>

typedef struct canvas {
  cairo_surface_t *surface;
  cairo_t *cr;
  const packing_stream *stream;
  packing_status status; /* of the stream */
  int svg;
} canvas;

/* A white sheet of `width` by `height` pixels (SVG: points). */
packing_status canvas_open(canvas *c, const packing_stream *stream, int svg, int width,
                           int height);

/* Sends it off and frees it. */
packing_status canvas_close(canvas *c);

/* How text stands to its point. */
typedef enum canvas_align { ALIGN_LEFT, ALIGN_MIDDLE, ALIGN_RIGHT } canvas_align;

/* Text of `size` pixels on the base line y. */
void canvas_text(canvas *c, double x, double y, double size, int bold, canvas_align align,
                 const char *text);

/* The same, cut with "..." to fit `width`. */
void canvas_text_fit(canvas *c, double x, double y, double size, double width,
                     const char *text);

/* 1234567 as "1 234 567". */
void canvas_format_count(char *out, size_t size, size_t count);

#endif
