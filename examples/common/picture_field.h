/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_PICTURE_FIELD_H
#define EXAMPLES_PICTURE_FIELD_H

/* The part of a picture that shows a pack. */

#include "camera.h"
#include "canvas.h"
#include "colours.h"
#include "pack.h"

/* The view: everything in it, `longest` pixels its longer edge. */
typedef struct picture_frame {
  camera camera;
  int width, height; /* pixels */
} picture_frame;

/* One view for all packs, which stand in like containers. */
void picture_frame_init(picture_frame *f, const pack *packs, size_t count, int longest);

/* Draws a pack with the upper left corner of its frame at the origin of the sheet. SVG draws
 * up to `most_circles` particles one by one. */
packing_status picture_draw_field(canvas *sheet, const picture_frame *frame,
                                  const pack *p, const colours *c, size_t most_circles);

/* "1 280 particles, volume fraction 0.8612" */
void picture_caption(char *line, size_t size, const pack *p);

/* What was asked, below the caption: container and sizes. */
void picture_draw_asked(canvas *sheet, const pack *p, double x, double y, double width);

#endif
