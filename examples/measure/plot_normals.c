/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where contacts point: the histogram of their normals in bins of equal area. In three
 * dimensions as a rose of bars, and as an equal-area map (Lambert's) of the upper half, for n
 * and -n are one; in two as a rose of sectors. An isotropic pack gives a ball, an even map, a
 * circle. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "../common/camera.h"
#include "../common/panel.h"
#include "measure.h"

enum {
  WIDTH = 1400,
  FLAT_WIDTH = 900,
  HEIGHT = 760,
  MARGIN = 40,
  RADIUS = 250, /* of the map, and of the longest bar */
  MIDDLE = 420, /* down to both */
  MOST = 96     /* points of an outline */
};

typedef struct rose {
  const normals_found *found;
  canvas *sheet;
  camera view;
  axis_range scale; /* of the ratio to an even share */
  double longest;   /* the ratio of the longest bar */
} rose;

/* How often bin k is met, 1 being an even share. */
static double ratio_of(const rose *g, size_t k)
{
  return (double)g->found->counts[k] * (double)g->found->count / (double)g->found->sum;
}

/* Colours reach from 0 to 2, or as far as it takes. */
static void set_scale(rose *g)
{
  g->longest = 0;
  for (size_t k = 0; k < g->found->count; k++)
    g->longest = fmax(g->longest, ratio_of(g, k));
  axis_init(&g->scale, 0, fmax(2, g->longest), 0);
}

static rgb colour_of(const rose *g, double ratio)
{
  return colours_scale(axis_place(&g->scale, ratio));
}

/* ---- outlines of bins ---- */

static packing_vec3 direction(double z, double azimuth)
{
  const double r = sqrt(fmax(0, 1 - z * z));
  return (packing_vec3){r * cos(azimuth), r * sin(azimuth), z};
}

/* Steps along one arc of a bin. */
static int steps_of(const packing_normals_bin *b)
{
  const int n = (int)ceil((b->azimuth_hi - b->azimuth_lo) / 0.15);
  return n < 1 ? 1 : n > MOST / 2 - 1 ? MOST / 2 - 1 : n;
}

/* The corners of a bin round its border, as directions; a cap at a pole is its circle. */
static int outline_of(const packing_normals_bin *b, packing_vec3 *points)
{
  const int n = steps_of(b), cap = b->z_lo <= -1 || b->z_hi >= 1;
  const double z = b->z_hi >= 1 ? b->z_lo : b->z_hi;
  int count = 0;
  for (int i = 0; i <= n; i++)
    points[count++] = direction(cap ? z : b->z_lo,
                                b->azimuth_lo + (b->azimuth_hi - b->azimuth_lo) * i / n);
  for (int i = n; i >= 0 && !cap; i--)
    points[count++] =
        direction(b->z_hi, b->azimuth_lo + (b->azimuth_hi - b->azimuth_lo) * i / n);
  return count;
}

static packing_vec3 middle_of(const packing_normals_bin *b)
{
  if (b->z_hi >= 1)
    return (packing_vec3){0, 0, 1};
  if (b->z_lo <= -1)
    return (packing_vec3){0, 0, -1};
  return direction(0.5 * (b->z_lo + b->z_hi), 0.5 * (b->azimuth_lo + b->azimuth_hi));
}

static packing_vec3 times(packing_vec3 v, double s)
{
  return (packing_vec3){s * v.x, s * v.y, s * v.z};
}

/* ---- the rose of bars ---- */

typedef struct bar {
  size_t bin;
  double depth; /* toward the viewer */
} bar;

static int far_first(const void *a, const void *b)
{
  const bar *p = a, *q = b;
  if (p->depth != q->depth)
    return p->depth < q->depth ? -1 : 1;
  return p->bin < q->bin ? -1 : p->bin > q->bin;
}

static double dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Light from above left. */
static double light_on(const rose *g, packing_vec3 n)
{
  const double x = dot(n, g->view.right), y = dot(n, g->view.up);
  const double z = dot(n, g->view.toward);
  return 0.62 + 0.38 * fmax(0, -0.42 * x + 0.62 * y + 0.66 * z);
}

static void fill_face(const rose *g, const packing_vec3 *points, int count, rgb colour,
                      rgb edge)
{
  cairo_t *cr = g->sheet->cr;
  cairo_new_path(cr);
  for (int i = 0; i < count; i++) {
    const spot s = camera_project(&g->view, points[i]);
    cairo_line_to(cr, s.x, s.y);
  }
  cairo_close_path(cr);
  cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
  cairo_fill_preserve(cr);
  cairo_set_source_rgb(cr, edge.r, edge.g, edge.b);
  cairo_set_line_width(cr, 0.6);
  cairo_stroke(cr);
}

/* The sides that face the viewer, and the end of the bar. */
static void draw_bar(const rose *g, size_t k)
{
  static const rgb black = {0.03, 0.04, 0.09};
  const packing_normals_bin *b = &g->found->bins[k];
  packing_vec3 points[MOST];
  const double ratio = ratio_of(g, k), length = ratio / g->longest;
  const int count = outline_of(b, points);
  const packing_vec3 middle = middle_of(b);
  const rgb colour = colour_of(g, ratio), shadow = rgb_mix(colour, black, 0.45);
  if (!(ratio > 0))
    return;
  for (int i = 0; i < count; i++)
    points[i] = times(points[i], length);
  for (int i = 0; i < count; i++) {
    const packing_vec3 side[] = {{0, 0, 0}, points[i], points[(i + 1) % count]};
    fill_face(g, side, 3, shadow, shadow);
  }
  fill_face(g, points, count, rgb_mix(black, colour, light_on(g, middle)), shadow);
}

static void draw_axis(const rose *g, packing_vec3 along)
{
  cairo_t *cr = g->sheet->cr;
  const spot from = camera_project(&g->view, times(along, -1.12));
  const spot to = camera_project(&g->view, times(along, 1.12));
  cairo_set_source_rgb(cr, 0.55, 0.55, 0.58);
  cairo_set_line_width(cr, 1.2);
  cairo_move_to(cr, from.x, from.y);
  cairo_line_to(cr, to.x, to.y);
  cairo_stroke(cr);
}

static void name_axis(const rose *g, packing_vec3 along, const char *name)
{
  const spot label = camera_project(&g->view, times(along, 1.2));
  cairo_set_source_rgb(g->sheet->cr, 0.2, 0.2, 0.2);
  canvas_text(g->sheet, label.x, label.y + 6, 19, 1, ALIGN_MIDDLE, name);
}

static packing_status draw_bars(rose *g, double x)
{
  static const packing_vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const size_t count = g->found->count;
  bar *bars = malloc(count * sizeof *bars);
  if (!bars)
    return PACKING_ERR_NOMEM;
  camera_init(&g->view, 3);
  g->view.scale = RADIUS;
  g->view.x = x;
  g->view.y = MIDDLE;
  for (int k = 0; k < 3; k++)
    draw_axis(g, axes[k]);
  for (size_t k = 0; k < count; k++)
    bars[k] = (bar){k, dot(middle_of(&g->found->bins[k]), g->view.toward)};
  qsort(bars, count, sizeof *bars, far_first);
  for (size_t k = 0; k < count; k++)
    draw_bar(g, bars[k].bin);
  for (int k = 0; k < 3; k++)
    name_axis(g, axes[k], axis_name((packing_axis)k));
  free(bars);
  return PACKING_OK;
}

/* ---- the map ---- */

/* Lambert's azimuthal projection: equal areas stay equal; the rim is the equator. */
static void map_bin(const rose *g, size_t k, double x)
{
  const packing_normals_bin *b = &g->found->bins[k];
  const double z_lo = fmax(b->z_lo, 0);
  const double outer = RADIUS * sqrt(1 - z_lo), inner = RADIUS * sqrt(1 - b->z_hi);
  const rgb c = colour_of(g, ratio_of(g, k));
  cairo_t *cr = g->sheet->cr;
  cairo_new_path(cr);
  cairo_arc_negative(cr, x, MIDDLE, outer, -b->azimuth_lo, -b->azimuth_hi);
  if (inner > 0)
    cairo_arc(cr, x, MIDDLE, inner, -b->azimuth_hi, -b->azimuth_lo);
  cairo_close_path(cr);
  cairo_set_source_rgb(cr, c.r, c.g, c.b);
  cairo_fill_preserve(cr);
  cairo_set_line_width(cr, 0.7);
  cairo_stroke(cr);
}

static void draw_map(const rose *g, double x)
{
  cairo_t *cr = g->sheet->cr;
  for (size_t k = 0; k < g->found->count; k++)
    if (g->found->bins[k].z_hi > 1e-12)
      map_bin(g, k, x);
  cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
  cairo_set_line_width(cr, 1.2);
  cairo_new_path(cr);
  cairo_arc(cr, x, MIDDLE, RADIUS, 0, 2 * M_PI);
  cairo_stroke(cr);
  canvas_text(g->sheet, x + RADIUS + 18, MIDDLE + 6, 19, 1, ALIGN_MIDDLE, "x");
  canvas_text(g->sheet, x, MIDDLE - RADIUS - 12, 19, 1, ALIGN_MIDDLE, "y");
  canvas_text(g->sheet, x, MIDDLE + RADIUS + 34, 17, 0, ALIGN_MIDDLE,
              "seen along z: the pole in the middle, the horizon at the rim");
}

/* ---- the rose of two dimensions ---- */

static void draw_sector(const rose *g, size_t k, double x)
{
  const packing_normals_bin *b = &g->found->bins[k];
  const double ratio = ratio_of(g, k), r = RADIUS * ratio / g->longest;
  const rgb c = colour_of(g, ratio);
  cairo_t *cr = g->sheet->cr;
  cairo_new_path(cr);
  cairo_move_to(cr, x, MIDDLE);
  cairo_arc_negative(cr, x, MIDDLE, r, -b->azimuth_lo, -b->azimuth_hi);
  cairo_close_path(cr);
  cairo_set_source_rgb(cr, c.r, c.g, c.b);
  cairo_fill_preserve(cr);
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_set_line_width(cr, 1);
  cairo_stroke(cr);
}

static void draw_sectors(const rose *g, double x)
{
  static const double dashes[] = {7, 5};
  cairo_t *cr = g->sheet->cr;
  for (size_t k = 0; k < g->found->count; k++)
    draw_sector(g, k, x);
  cairo_save(cr);
  cairo_set_dash(cr, dashes, 2, 0);
  cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
  cairo_set_line_width(cr, 1.5);
  cairo_new_path(cr);
  cairo_arc(cr, x, MIDDLE, RADIUS / g->longest, 0, 2 * M_PI);
  cairo_stroke(cr);
  cairo_restore(cr);
  cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
  canvas_text(g->sheet, x + RADIUS + 22, MIDDLE + 6, 19, 1, ALIGN_MIDDLE, "x");
  canvas_text(g->sheet, x, MIDDLE - RADIUS - 14, 19, 1, ALIGN_MIDDLE, "y");
  canvas_text(g->sheet, x, MIDDLE + RADIUS + 40, 17, 0, ALIGN_MIDDLE,
              "dashed: all directions alike");
}

/* ---- the sheet ---- */

static void draw_title(const rose *g, const measure_job *job, int width)
{
  const report_fabric *f = &job->report.fabric;
  char below[240] = "no contacts", third[32] = "", count[40];
  if (job->spec.dim == 3)
    snprintf(third, sizeof third, " %.4f", f->eigenvalues[2]);
  canvas_format_count(count, sizeof count, f->count);
  if (g->found->sum > 0)
    snprintf(
        below, sizeof below,
        "%s contacts in %zu bins of equal area; fabric %.4f %.4f%s, sd %.4f (random: "
        "%.4f)",
        count, g->found->count, f->eigenvalues[0], f->eigenvalues[1], third, f->sd,
        f->noise_floor);
  panel_title(g->sheet, MARGIN, 46, width - 2 * MARGIN, "Contact normals", below);
}

static void draw_scale(const rose *g, double x)
{
  cairo_set_source_rgb(g->sheet->cr, 0.2, 0.2, 0.2);
  canvas_text(g->sheet, x, MIDDLE - RADIUS - 18, 17, 0, ALIGN_LEFT, "of an even share");
  colours_draw_scale(&g->scale, g->sheet, x, MIDDLE - RADIUS, 2 * RADIUS);
}

packing_status plot_normals(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  const int flat = job->spec.dim == 2, width = flat ? FLAT_WIDTH : WIDTH;
  canvas sheet;
  rose g = {.found = &job->normals, .sheet = &sheet};
  packing_status status = canvas_open(&sheet, stream, job->asked->svg, width, HEIGHT);
  draw_title(&g, job, width);
  if (g.found->sum > 0) {
    set_scale(&g);
    if (flat)
      draw_sectors(&g, MARGIN + 40 + RADIUS);
    else {
      status = draw_bars(&g, MARGIN + 40 + RADIUS);
      draw_map(&g, MARGIN + 120 + 3 * RADIUS);
    }
    draw_scale(&g, width - 180);
  }
  const packing_status closed = canvas_close(&sheet);
  return status != PACKING_OK ? status : closed;
}
