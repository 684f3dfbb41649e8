/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_COLOURS_H
#define EXAMPLES_COLOURS_H

/* What the colours of a pack mean, and the bar that says so. */

#include "axis.h"
#include "canvas.h"
#include "pack.h"

typedef struct rgb {
  double r, g, b; /* 0 to 1 */
} rgb;

typedef struct colours {
  colour_by by;
  axis_range scale;  /* radius and height */
  int equal;         /* 1: all radii are the same, */
  double only;       /* this one */
  size_t components; /* component */
} colours;

void colours_init(colours *c, const pack *p);

/* The colour of particle i; marked packs have two. */
rgb colours_of(const colours *c, const pack *p, size_t i);

/* The bar (or the swatches) in a column of `height` pixels. */
void colours_draw_bar(const colours *c, canvas *sheet, double x, double y, double height);

/* The colour of a component; they come again after eight. */
rgb colours_category(size_t component);

/* A value from 0 to 1 on the scale of the pictures, from dark to light. */
rgb colours_scale(double t);

/* That scale as a bar with its ticks. */
void colours_draw_scale(const axis_range *scale, canvas *sheet, double x, double y,
                        double height);

/* A mixture, t = 0: a, t = 1: b. */
rgb rgb_mix(rgb a, rgb b, double t);

#endif
