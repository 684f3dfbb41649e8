/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_PANEL_H
#define EXAMPLES_PANEL_H

/* A diagram on a sheet: two axes with their ticks, and what is drawn between them. */

#include "axis.h"
#include "canvas.h"
#include "colours.h"

typedef struct panel {
  canvas *sheet;
  axis_range x, y;
  double left, right, top, bottom; /* of the frame, pixels */
} panel;

/* Two strong colours that stand well side by side. */
extern const rgb PANEL_BLUE, PANEL_ORANGE;

/* Pixels of a value. */
double panel_x(const panel *g, double value);
double panel_y(const panel *g, double value);

/* The lines at the ticks, their numbers, and what the axes are (NULL: nothing said). */
void panel_grid(const panel *g, const char *x_title, const char *y_title);

/* The frame, drawn last. */
void panel_frame(const panel *g);

/* What is drawn between the two stays inside the frame. */
void panel_clip(const panel *g);
void panel_unclip(const panel *g);

/* A line through the points; a point that is not finite parts it. */
void panel_curve(const panel *g, const double *x, const double *y, size_t count,
                 rgb colour, double width);

/* A filled bar, from `lo` to `hi` high, over [from, to] less a hairline. */
void panel_bar(const panel *g, double from, double to, double lo, double hi, rgb colour);

/* A dashed line across at a height, and one upright. */
void panel_level(const panel *g, double y, rgb colour);
void panel_upright(const panel *g, double x, rgb colour);

/* A line of the legend: a stroke (or, of width above 12, a swatch) and its meaning; returns the
 * x behind it. */
double panel_legend(canvas *sheet, double x, double y, rgb colour, double width,
                    const char *text);

/* The title of a sheet, and a grey line below it. */
void panel_title(canvas *sheet, double x, double y, double width, const char *title,
                 const char *below);

#endif
