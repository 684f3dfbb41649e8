/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cumulative size curves over the diameter, asked and placed, by mass and by number. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "axis.h"
#include "canvas.h"
#include "colours.h"
#include "picture.h"

enum {
  WIDTH = 1000,
  HEIGHT = 640,
  LEFT = 92,
  RIGHT = 30,
  TOP = 66,
  BOTTOM = 78,
  POINTS = 500 /* of each curve */
};

static const rgb MASS = {0.000, 0.447, 0.698}, NUMBER = {0.835, 0.369, 0.000};

typedef struct plot {
  const pack *p;
  canvas sheet;
  axis x, y;
  double *r;    /* radii placed, rising */
  double *mass; /* of the particles up to each */
} plot;

static double across(const plot *g, double diameter)
{
  return LEFT + (WIDTH - LEFT - RIGHT) * axis_place(&g->x, diameter);
}

static double upward(const plot *g, double percent)
{
  return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * axis_place(&g->y, percent);
}

static int rising(const void *a, const void *b)
{
  const double p = *(const double *)a, q = *(const double *)b;
  return p < q ? -1 : p > q;
}

static packing_status sort_radii(plot *g)
{
  const size_t count = g->p->view.count;
  g->r = malloc((count + 1) * sizeof *g->r);
  g->mass = malloc((count + 1) * sizeof *g->mass);
  if (!g->r || !g->mass)
    return PACKING_ERR_NOMEM;
  for (size_t i = 0; i < count; i++)
    g->r[i] = pack_radius(g->p, i);
  qsort(g->r, count, sizeof *g->r, rising);
  double sum = 0;
  for (size_t i = 0; i < count; i++) {
    sum += pow(g->r[i], g->p->spec->dim);
    g->mass[i] = sum;
  }
  return PACKING_OK;
}

/* The share of the particles placed with radius up to r. */
static double placed(const plot *g, packing_by by, double r)
{
  size_t lo = 0, hi = g->p->view.count;
  const double all = (double)hi;
  if (hi == 0)
    return 0;
  while (lo < hi) {
    const size_t middle = lo + (hi - lo) / 2;
    if (g->r[middle] <= r)
      lo = middle + 1;
    else
      hi = middle;
  }
  if (by == PACKING_BY_NUMBER || lo == 0)
    return (double)lo / all;
  return g->mass[lo - 1] / g->mass[g->p->view.count - 1];
}

static void trace(plot *g, packing_by by, int asked)
{
  for (int k = 0; k <= POINTS; k++) {
    const double d = axis_value(&g->x, (double)k / POINTS);
    const double share =
        asked ? packing_psd_cdf(g->p->psd, by, 0.5 * d) : placed(g, by, 0.5 * d);
    cairo_line_to(g->sheet.cr, across(g, d), upward(g, 100 * share));
  }
}

/* Asked: a broad pale line; placed: a thin strong one upon it. */
static void style(plot *g, packing_by by, int asked)
{
  rgb colour = by == PACKING_BY_MASS ? MASS : NUMBER;
  if (asked)
    colour = rgb_mix(colour, (rgb){1, 1, 1}, 0.6);
  cairo_set_source_rgb(g->sheet.cr, colour.r, colour.g, colour.b);
  cairo_set_line_width(g->sheet.cr, asked ? 8 : 2);
  cairo_set_line_join(g->sheet.cr, CAIRO_LINE_JOIN_ROUND);
}

static void draw_curves(plot *g)
{
  cairo_save(g->sheet.cr);
  cairo_rectangle(g->sheet.cr, LEFT, TOP - 4, WIDTH - LEFT - RIGHT,
                  HEIGHT - TOP - BOTTOM + 8);
  cairo_clip(g->sheet.cr);
  for (int asked = 1; asked >= 0; asked--)
    for (int by = PACKING_BY_NUMBER; by <= PACKING_BY_MASS; by++) {
      cairo_new_path(g->sheet.cr);
      style(g, (packing_by)by, asked);
      trace(g, (packing_by)by, asked);
      cairo_stroke(g->sheet.cr);
    }
  cairo_restore(g->sheet.cr);
}

static void grey(plot *g, double level)
{
  cairo_set_source_rgb(g->sheet.cr, level, level, level);
}

static void line(plot *g, double x0, double y0, double x1, double y1)
{
  cairo_move_to(g->sheet.cr, x0, y0);
  cairo_line_to(g->sheet.cr, x1, y1);
  cairo_stroke(g->sheet.cr);
}

static void draw_x_axis(plot *g)
{
  for (size_t k = 0; k < g->x.count; k++) {
    char label[32];
    const double at = floor(across(g, g->x.tick[k])) + 0.5;
    grey(g, 0.88);
    line(g, at, TOP, at, HEIGHT - BOTTOM);
    grey(g, 0.2);
    snprintf(label, sizeof label, "%.6g", g->x.tick[k]);
    canvas_text(&g->sheet, at, HEIGHT - BOTTOM + 26, 17, 0, ALIGN_MIDDLE, label);
  }
  canvas_text(&g->sheet, 0.5 * (LEFT + WIDTH - RIGHT), HEIGHT - 18, 18, 0, ALIGN_MIDDLE,
              "diameter");
}

static void draw_y_axis(plot *g)
{
  for (size_t k = 0; k < g->y.count; k++) {
    char label[32];
    const double at = floor(upward(g, g->y.tick[k])) + 0.5;
    grey(g, 0.88);
    line(g, LEFT, at, WIDTH - RIGHT, at);
    grey(g, 0.2);
    snprintf(label, sizeof label, "%.6g", g->y.tick[k]);
    canvas_text(&g->sheet, LEFT - 10, at + 6, 17, 0, ALIGN_RIGHT, label);
  }
  cairo_save(g->sheet.cr);
  cairo_translate(g->sheet.cr, 28, 0.5 * (TOP + HEIGHT - BOTTOM));
  cairo_rotate(g->sheet.cr, -M_PI / 2);
  canvas_text(&g->sheet, 0, 0, 18, 0, ALIGN_MIDDLE, "smaller, %");
  cairo_restore(g->sheet.cr);
}

static void draw_frame(plot *g)
{
  grey(g, 0.2);
  cairo_set_line_width(g->sheet.cr, 1);
  cairo_rectangle(g->sheet.cr, LEFT + 0.5, TOP + 0.5, WIDTH - LEFT - RIGHT,
                  HEIGHT - TOP - BOTTOM);
  cairo_stroke(g->sheet.cr);
}

static void draw_legend(plot *g)
{
  static const struct {
    const char *text;
    packing_by by;
    int asked;
  } rows[] = {{"by mass, asked", PACKING_BY_MASS, 1},
              {"by mass, placed", PACKING_BY_MASS, 0},
              {"by number, asked", PACKING_BY_NUMBER, 1},
              {"by number, placed", PACKING_BY_NUMBER, 0}};
  for (int k = 0; k < 4; k++) {
    const double x = LEFT + 4 + 218 * k, y = TOP - 24;
    style(g, rows[k].by, rows[k].asked);
    line(g, x, y - 5, x + 36, y - 5);
    grey(g, 0.2);
    canvas_text(&g->sheet, x + 46, y, 17, 0, ALIGN_LEFT, rows[k].text);
  }
}

/* The ends of the law and of what stands in the pack, a little wider. */
static void set_axes(plot *g)
{
  double lo = packing_psd_min_r(g->p->psd), hi = packing_psd_max_r(g->p->psd);
  if (g->p->view.count > 0) {
    lo = fmin(lo, g->r[0]);
    hi = fmax(hi, g->r[g->p->view.count - 1]);
  }
  const double room = hi > lo ? pow(hi / lo, 0.03) : 1;
  axis_init(&g->x, 2 * lo / room, 2 * hi * room, 1);
  axis_init(&g->y, 0, 100, 0);
}

static packing_status draw(plot *g, const packing_stream *stream, int svg)
{
  const packing_status status = canvas_open(&g->sheet, stream, svg, WIDTH, HEIGHT);
  cairo_set_line_width(g->sheet.cr, 1);
  draw_x_axis(g);
  draw_y_axis(g);
  draw_curves(g);
  draw_frame(g);
  draw_legend(g);
  const packing_status closed = canvas_close(&g->sheet);
  return status != PACKING_OK ? status : closed;
}

static packing_status write_plot(const pack *p, const packing_stream *stream, int svg)
{
  plot g = {.p = p};
  packing_status status = sort_radii(&g);
  if (status == PACKING_OK) {
    set_axes(&g);
    status = draw(&g, stream, svg);
  }
  free(g.mass);
  free(g.r);
  return status;
}

packing_status picture_write_sizes_png(const pack *p, const packing_stream *stream)
{
  return write_plot(p, stream, 0);
}

packing_status picture_write_sizes_svg(const pack *p, const packing_stream *stream)
{
  return write_plot(p, stream, 1);
}
