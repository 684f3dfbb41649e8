/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "colours.h"
#include <math.h>
#include <stdio.h>

/* Samples of viridis (S. van der Walt, N. Smith, 2015, CC0), even steps. */
static const rgb viridis[] = {
    {0.267, 0.005, 0.329}, {0.283, 0.141, 0.458}, {0.254, 0.265, 0.530},
    {0.207, 0.372, 0.553}, {0.164, 0.471, 0.558}, {0.128, 0.567, 0.551},
    {0.135, 0.659, 0.518}, {0.267, 0.749, 0.441}, {0.478, 0.821, 0.318},
    {0.741, 0.873, 0.150}, {0.993, 0.906, 0.144},
};
enum { LAST = sizeof viridis / sizeof viridis[0] - 1 };

/* Okabe and Ito's colours, told apart by colour-blind readers. */
static const rgb categories[] = {
    {0.902, 0.624, 0.000}, {0.337, 0.706, 0.914}, {0.000, 0.620, 0.451},
    {0.941, 0.894, 0.259}, {0.000, 0.447, 0.698}, {0.835, 0.369, 0.000},
    {0.800, 0.475, 0.655}, {0.600, 0.600, 0.600},
};
enum { CATEGORIES = sizeof categories / sizeof categories[0] };

rgb rgb_mix(rgb a, rgb b, double t)
{
  return (rgb){a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

rgb colours_category(size_t component)
{
  return categories[component % CATEGORIES];
}

/* The darkest end is left out: shading needs room below. */
static const double DARKEST = 0.1, ONLY = 0.55;

rgb colours_scale(double t)
{
  const double at = (DARKEST + (1 - DARKEST) * fmin(fmax(t, 0), 1)) * LAST;
  const int below = at < LAST ? (int)at : LAST - 1;
  return rgb_mix(viridis[below], viridis[below + 1], at - below);
}

static double height_of(const pack *p, size_t i)
{
  const packing_vec3 c = pack_centre(p, i);
  return p->spec->dim == 2 ? c.y : c.z;
}

static double value_of(const colours *c, const pack *p, size_t i)
{
  return c->by == COLOUR_HEIGHT ? height_of(p, i) : pack_radius(p, i);
}

void colours_init(colours *c, const pack *p)
{
  packing_bounds bounds;
  c->by = p->colour;
  c->equal = 0;
  c->components = pack_components(p);
  if (c->by == COLOUR_HEIGHT) {
    pack_bounds(p, &bounds);
    if (p->spec->dim == 2)
      axis_init(&c->scale, bounds.lo.y, bounds.hi.y, 0);
    else
      axis_init(&c->scale, bounds.lo.z, bounds.hi.z, 0);
    return;
  }
  double lo, hi;
  pack_radii(p, &lo, &hi);
  c->equal = lo == hi;
  c->only = lo;
  axis_init(&c->scale, lo, hi, 1);
}

static const rgb MARKED = {0.84, 0.15, 0.12}, UNMARKED = {0.72, 0.76, 0.80};

rgb colours_of(const colours *c, const pack *p, size_t i)
{
  if (p->marked)
    return p->marked[i] ? MARKED : UNMARKED;
  if (c->by == COLOUR_COMPONENT)
    return colours_category(pack_component(p, i));
  return colours_scale(c->equal ? ONLY : axis_place(&c->scale, value_of(c, p, i)));
}

static void draw_swatch(canvas *sheet, double x, double y, rgb colour, const char *label)
{
  cairo_set_source_rgb(sheet->cr, colour.r, colour.g, colour.b);
  cairo_rectangle(sheet->cr, x, y, 20, 20);
  cairo_fill(sheet->cr);
  cairo_set_source_rgb(sheet->cr, 0.2, 0.2, 0.2);
  canvas_text(sheet, x + 30, y + 16, 17, 0, ALIGN_LEFT, label);
}

static void draw_swatches(const colours *c, canvas *sheet, double x, double y)
{
  for (size_t k = 0; k < c->components && k < CATEGORIES; k++) {
    char label[32];
    snprintf(label, sizeof label, "%zu", k);
    draw_swatch(sheet, x, y + 30 * (double)k, categories[k], label);
  }
}

enum { STOPS = 20 };

static void draw_ramp(canvas *sheet, double x, double y, double height)
{
  cairo_pattern_t *ramp = cairo_pattern_create_linear(0, y + height, 0, y);
  for (int k = 0; k <= STOPS; k++) {
    const rgb colour = colours_scale((double)k / STOPS);
    cairo_pattern_add_color_stop_rgb(ramp, (double)k / STOPS, colour.r, colour.g,
                                     colour.b);
  }
  cairo_set_source(sheet->cr, ramp);
  cairo_rectangle(sheet->cr, x, y, 20, height);
  cairo_fill(sheet->cr);
  cairo_pattern_destroy(ramp);
}

static void draw_ticks(const axis_range *scale, canvas *sheet, double x, double y,
                       double height)
{
  cairo_set_source_rgb(sheet->cr, 0.2, 0.2, 0.2);
  cairo_set_line_width(sheet->cr, 1);
  for (size_t k = 0; k < scale->count; k++) {
    char label[32];
    const double at = y + height * (1 - axis_place(scale, scale->tick[k]));
    cairo_move_to(sheet->cr, x + 20, at);
    cairo_line_to(sheet->cr, x + 25, at);
    cairo_stroke(sheet->cr);
    snprintf(label, sizeof label, "%.6g", scale->tick[k]);
    canvas_text(sheet, x + 30, at + 6, 17, 0, ALIGN_LEFT, label);
  }
}

void colours_draw_scale(const axis_range *scale, canvas *sheet, double x, double y,
                        double height)
{
  draw_ramp(sheet, x, y, height);
  draw_ticks(scale, sheet, x, y, height);
}

void colours_draw_bar(const colours *c, canvas *sheet, double x, double y, double height)
{
  static const char *const titles[] = {"radius", "component", "height"};
  cairo_set_source_rgb(sheet->cr, 0.2, 0.2, 0.2);
  canvas_text(sheet, x, y, 17, 0, ALIGN_LEFT, titles[c->by]);
  y += 18;
  height -= 18;
  if (c->by == COLOUR_COMPONENT) {
    draw_swatches(c, sheet, x, y);
    return;
  }
  if (c->equal) {
    char label[32];
    snprintf(label, sizeof label, "%.6g", c->only);
    draw_swatch(sheet, x, y, colours_scale(ONLY), label);
    return;
  }
  colours_draw_scale(&c->scale, sheet, x, y, height);
}
