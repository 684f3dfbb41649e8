/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "panel.h"
#include <math.h>
#include <stdio.h>

const rgb PANEL_BLUE = {0.000, 0.447, 0.698}, PANEL_ORANGE = {0.835, 0.369, 0.000};

/* Above this a legend's stroke is a swatch. */
static const double THICK = 12;

double panel_x(const panel *g, double value)
{
  return g->left + (g->right - g->left) * axis_place(&g->x, value);
}

double panel_y(const panel *g, double value)
{
  return g->bottom - (g->bottom - g->top) * axis_place(&g->y, value);
}

static void grey(const panel *g, double level)
{
  cairo_set_source_rgb(g->sheet->cr, level, level, level);
}

static void line(const panel *g, double x0, double y0, double x1, double y1)
{
  cairo_move_to(g->sheet->cr, x0, y0);
  cairo_line_to(g->sheet->cr, x1, y1);
  cairo_stroke(g->sheet->cr);
}

static void draw_x_ticks(const panel *g)
{
  for (size_t k = 0; k < g->x.count; k++) {
    char label[32];
    const double at = floor(panel_x(g, g->x.tick[k])) + 0.5;
    grey(g, 0.88);
    line(g, at, g->top, at, g->bottom);
    grey(g, 0.2);
    snprintf(label, sizeof label, "%.6g", g->x.tick[k]);
    canvas_text(g->sheet, at, g->bottom + 26, 17, 0, ALIGN_MIDDLE, label);
  }
}

static void draw_y_ticks(const panel *g)
{
  for (size_t k = 0; k < g->y.count; k++) {
    char label[32];
    const double at = floor(panel_y(g, g->y.tick[k])) + 0.5;
    grey(g, 0.88);
    line(g, g->left, at, g->right, at);
    grey(g, 0.2);
    snprintf(label, sizeof label, "%.6g", g->y.tick[k]);
    canvas_text(g->sheet, g->left - 10, at + 6, 17, 0, ALIGN_RIGHT, label);
  }
}

void panel_grid(const panel *g, const char *x_title, const char *y_title)
{
  cairo_t *cr = g->sheet->cr;
  cairo_set_line_width(cr, 1);
  draw_x_ticks(g);
  draw_y_ticks(g);
  if (x_title)
    canvas_text(g->sheet, 0.5 * (g->left + g->right), g->bottom + 56, 18, 0, ALIGN_MIDDLE,
                x_title);
  if (!y_title)
    return;
  cairo_save(cr);
  cairo_translate(cr, g->left - 66, 0.5 * (g->top + g->bottom));
  cairo_rotate(cr, -M_PI / 2);
  canvas_text(g->sheet, 0, 0, 18, 0, ALIGN_MIDDLE, y_title);
  cairo_restore(cr);
}

void panel_frame(const panel *g)
{
  grey(g, 0.2);
  cairo_set_line_width(g->sheet->cr, 1);
  cairo_rectangle(g->sheet->cr, floor(g->left) + 0.5, floor(g->top) + 0.5,
                  floor(g->right - g->left), floor(g->bottom - g->top));
  cairo_stroke(g->sheet->cr);
}

void panel_clip(const panel *g)
{
  cairo_save(g->sheet->cr);
  cairo_rectangle(g->sheet->cr, g->left, g->top - 4, g->right - g->left,
                  g->bottom - g->top + 8);
  cairo_clip(g->sheet->cr);
}

void panel_unclip(const panel *g)
{
  cairo_restore(g->sheet->cr);
}

void panel_curve(const panel *g, const double *x, const double *y, size_t count,
                 rgb colour, double width)
{
  cairo_t *cr = g->sheet->cr;
  cairo_new_path(cr);
  for (size_t i = 0; i < count; i++)
    if (isfinite(x[i]) && isfinite(y[i]))
      cairo_line_to(cr, panel_x(g, x[i]), panel_y(g, y[i]));
    else
      cairo_new_sub_path(cr);
  cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
  cairo_set_line_width(cr, width);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(cr);
}

void panel_bar(const panel *g, double from, double to, double lo, double hi, rgb colour)
{
  const double x0 = panel_x(g, from), x1 = panel_x(g, to);
  const double y0 = panel_y(g, lo), y1 = panel_y(g, hi);
  const double gap = fmin(1, 0.1 * (x1 - x0));
  cairo_set_source_rgb(g->sheet->cr, colour.r, colour.g, colour.b);
  cairo_rectangle(g->sheet->cr, x0 + gap, y1, x1 - x0 - 2 * gap, y0 - y1);
  cairo_fill(g->sheet->cr);
}

static void dashed(const panel *g, double x0, double y0, double x1, double y1, rgb colour)
{
  static const double dashes[] = {7, 5};
  cairo_t *cr = g->sheet->cr;
  cairo_save(cr);
  cairo_set_dash(cr, dashes, 2, 0);
  cairo_set_line_width(cr, 1.5);
  cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
  line(g, x0, y0, x1, y1);
  cairo_restore(cr);
}

void panel_level(const panel *g, double y, rgb colour)
{
  const double at = panel_y(g, y);
  dashed(g, g->left, at, g->right, at, colour);
}

void panel_upright(const panel *g, double x, rgb colour)
{
  const double at = panel_x(g, x);
  dashed(g, at, g->bottom, at, g->top, colour);
}

double panel_legend(canvas *sheet, double x, double y, rgb colour, double width,
                    const char *text)
{
  cairo_text_extents_t extents;
  cairo_t *cr = sheet->cr;
  const double long_side = width > THICK ? 20 : 36;
  cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
  cairo_set_line_width(cr, width > THICK ? 16 : width);
  cairo_move_to(cr, x, y - 6);
  cairo_line_to(cr, x + long_side, y - 6);
  cairo_stroke(cr);
  cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
  canvas_text(sheet, x + long_side + 10, y, 17, 0, ALIGN_LEFT, text);
  cairo_text_extents(cr, text, &extents);
  return x + long_side + 10 + extents.x_advance + 26;
}

void panel_title(canvas *sheet, double x, double y, double width, const char *title,
                 const char *below)
{
  cairo_set_source_rgb(sheet->cr, 0.1, 0.1, 0.12);
  canvas_text(sheet, x, y, 22, 1, ALIGN_LEFT, title);
  cairo_set_source_rgb(sheet->cr, 0.4, 0.4, 0.43);
  canvas_text_fit(sheet, x, y + 26, 16, width, below);
}
