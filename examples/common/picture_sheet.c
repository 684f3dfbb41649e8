/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All packs of a run on one sheet, each with its number and volume fraction, as in the figures
 * 4 to 11 of Campello and Cassares (Lat. Am. J. Solids Struct. 13, 23, 2016). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "moments.h"
#include "picture.h"
#include "picture_field.h"
#include "program.h"

enum {
  WIDTH = 1500, /* of the sheet, pixels */
  MARGIN = 36,
  GAP = 28,
  TITLE = 84,
  CAPTION = 30,
  CIRCLES = 30000 /* most circles that an SVG draws one by one, all packs together */
};

typedef struct sheet_layout {
  picture_frame frame;
  size_t columns, rows;
  int height;
} sheet_layout;

static int field_edge(size_t columns, double longer_share)
{
  const double across = (WIDTH - 2.0 * MARGIN + GAP) / (double)columns - GAP;
  return (int)(across * longer_share);
}

static int sheet_height(const picture_frame *f, size_t rows)
{
  return TITLE + (int)rows * (f->height + CAPTION + GAP) - GAP + MARGIN;
}

/* As many columns as bring the sheet nearest to a page, three wide and four high. */
static void lay_out(sheet_layout *l, const pack *packs, size_t count)
{
  picture_frame wide;
  double best = (double)INFINITY;
  picture_frame_init(&wide, packs, count, 1000);
  const double share = wide.width >= wide.height ? 1 : (double)wide.height / wide.width;
  for (size_t columns = 1; columns <= count; columns++) {
    const size_t rows = (count + columns - 1) / columns;
    const int edge = field_edge(columns, share);
    const double tall = (double)edge * wide.height / fmax(wide.width, wide.height);
    const double height = TITLE + MARGIN + (double)rows * (tall + CAPTION + GAP);
    const double off = fabs(log(height / WIDTH * 3 / 4));
    if (off < best && edge > 40) {
      best = off;
      l->columns = columns;
      l->rows = rows;
    }
  }
  picture_frame_init(&l->frame, packs, count, field_edge(l->columns, share));
  l->height = sheet_height(&l->frame, l->rows);
}

static void draw_title(canvas *sheet, const pack *packs, size_t count)
{
  char line[160];
  double *fractions = program_take(count, sizeof(double));
  for (size_t i = 0; i < count; i++)
    fractions[i] = packs[i].volume_fraction;
  const moments found = moments_of(fractions, count);
  free(fractions);
  if (packs[0].title)
    snprintf(line, sizeof line, "%s", packs[0].title);
  else if (count > 1)
    snprintf(line, sizeof line, "%zu packs, volume fraction %.4f, deviation %.4f", count,
             found.mean, found.sd);
  else
    picture_caption(line, sizeof line, packs);
  cairo_set_source_rgb(sheet->cr, 0.1, 0.1, 0.12);
  canvas_text(sheet, MARGIN, 40, 24, 1, ALIGN_LEFT, line);
  picture_draw_asked(sheet, packs, MARGIN, 66, WIDTH - 2 * MARGIN);
}

static packing_status draw_pack(canvas *sheet, const sheet_layout *l, const pack *packs,
                                size_t count, size_t i)
{
  colours meaning;
  char line[80];
  const double step = (WIDTH - 2.0 * MARGIN + GAP) / (double)l->columns;
  const double x = MARGIN + step * (double)(i % l->columns);
  const double y = TITLE + (double)(i / l->columns) * (l->frame.height + CAPTION + GAP);
  colours_init(&meaning, &packs[i]);
  cairo_save(sheet->cr);
  cairo_translate(sheet->cr, x, y);
  const packing_status status =
      picture_draw_field(sheet, &l->frame, &packs[i], &meaning, CIRCLES / count);
  cairo_restore(sheet->cr);
  if (packs[i].title)
    picture_caption(line, sizeof line, &packs[i]);
  else
    snprintf(line, sizeof line, "%zu: %.4f", i + 1, packs[i].volume_fraction);
  cairo_set_source_rgb(sheet->cr, 0.2, 0.2, 0.2);
  canvas_text(sheet, x + 0.5 * l->frame.width, y + l->frame.height + 22, 18, 0,
              ALIGN_MIDDLE, line);
  return status;
}

static packing_status write_sheet(const pack *packs, size_t count,
                                  const packing_stream *stream, int svg)
{
  sheet_layout l = {.columns = count, .rows = 1};
  canvas sheet;
  lay_out(&l, packs, count);
  packing_status status = canvas_open(&sheet, stream, svg, WIDTH, l.height);
  draw_title(&sheet, packs, count);
  for (size_t i = 0; i < count && status == PACKING_OK; i++)
    status = draw_pack(&sheet, &l, packs, count, i);
  const packing_status closed = canvas_close(&sheet);
  return status != PACKING_OK ? status : closed;
}

packing_status picture_write_sheet_png(const pack *packs, size_t count,
                                       const packing_stream *stream)
{
  return write_sheet(packs, count, stream, 0);
}

packing_status picture_write_sheet_svg(const pack *packs, size_t count,
                                       const packing_stream *stream)
{
  return write_sheet(packs, count, stream, 1);
}
