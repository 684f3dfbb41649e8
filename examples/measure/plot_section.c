/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sections: black is void, white is solid, grey is outside the container. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "../common/canvas.h"
#include "../common/panel.h"
#include "../common/program.h"
#include "measure.h"

enum { MARGIN = 36, TITLE = 92, GAP = 28, CAPTION = 34, WIDEST = 1400 };

/* A plane with what it is called. */
typedef struct tile {
  const plane_found *plane;
  packing_axis axis;
} tile;

typedef struct layout {
  tile *tiles;
  size_t count, columns;
  double width; /* of the widest image */
} layout;

/* Planes that meet the container. */
static void collect(const measure_job *job, layout *l)
{
  for (size_t i = 0; i < job->asked->section_count; i++)
    for (size_t k = 0; k < job->sections[i].count; k++) {
      const plane_found *plane = &job->sections[i].planes[k];
      if (!plane->pixels)
        continue;
      l->tiles = program_take_more(l->tiles, l->count + 1, sizeof *l->tiles);
      l->tiles[l->count++] = (tile){plane, job->asked->sections[i].axis};
      l->width = fmax(l->width, (double)plane->image.columns);
    }
  const size_t fit = (size_t)fmax(1, floor((WIDEST + GAP) / (l->width + GAP)));
  l->columns = l->count < fit ? l->count : fit;
}

/* Where the row of tile k begins, below the title; of k = count where all end. */
static double top_of(const layout *l, size_t k)
{
  double top = TITLE;
  for (size_t row = 0; row < k; row += l->columns) {
    double tallest = 0;
    if (row + l->columns > k && k < l->count)
      break;
    for (size_t i = row; i < row + l->columns && i < l->count; i++)
      tallest = fmax(tallest, (double)l->tiles[i].plane->image.rows);
    top += tallest + CAPTION + GAP;
  }
  return top;
}

static uint32_t shade_of(unsigned char pixel)
{
  return pixel == PACKING_PIXEL_VOID      ? 0x000000
         : pixel == PACKING_PIXEL_OUTSIDE ? 0xb8bcc4
                                          : 0xffffff;
}

static void paint(canvas *sheet, const plane_found *plane, double x, double y)
{
  const int width = (int)plane->image.columns, height = (int)plane->image.rows;
  cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  unsigned char *data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int j = 0; data && j < height; j++) {
    uint32_t *row = (uint32_t *)(void *)(data + (ptrdiff_t)j * stride);
    for (int i = 0; i < width; i++)
      row[i] = shade_of(plane->pixels[(size_t)j * (size_t)width + (size_t)i]);
  }
  cairo_surface_mark_dirty(image);
  cairo_set_source_surface(sheet->cr, image, x, y);
  cairo_paint(sheet->cr);
  cairo_surface_destroy(image);
  cairo_set_source_rgb(sheet->cr, 0.2, 0.2, 0.2);
  cairo_set_line_width(sheet->cr, 1);
  cairo_rectangle(sheet->cr, x - 0.5, y - 0.5, width + 1, height + 1);
  cairo_stroke(sheet->cr);
}

static void draw_tile(canvas *sheet, const layout *l, size_t k)
{
  char text[SECTION_TEXT];
  const tile *t = &l->tiles[k];
  const double x = MARGIN + (double)(k % l->columns) * (l->width + GAP);
  const double y = top_of(l, k);
  paint(sheet, t->plane, x, y);
  cairo_set_source_rgb(sheet->cr, 0.2, 0.2, 0.2);
  canvas_text_fit(sheet, x, y + (double)t->plane->image.rows + 24, 17,
                  (double)t->plane->image.columns, section_say(text, t->axis, t->plane));
}

packing_status plot_section(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  layout l = {.tiles = NULL};
  canvas sheet;
  char below[120];
  collect(job, &l);
  const double width = fmax(520, 2 * MARGIN + (double)l.columns * (l.width + GAP) - GAP);
  const double height = top_of(&l, l.count);
  const packing_status status =
      canvas_open(&sheet, stream, job->asked->svg, (int)width, (int)height);
  snprintf(below, sizeof below, "black: void, white: particles; porosity of all %.4f",
           1 - job->report.volume_fraction);
  panel_title(&sheet, MARGIN, 40, width - 2 * MARGIN,
              l.count > 1 ? "Sections" : "Section",
              l.count ? below : "no plane meets the container");
  for (size_t k = 0; k < l.count; k++)
    draw_tile(&sheet, &l, k);
  free(l.tiles);
  const packing_status closed = canvas_close(&sheet);
  return status != PACKING_OK ? status : closed;
}
