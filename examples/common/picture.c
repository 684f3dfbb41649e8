/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One pack with a title and a colour bar. */
#include "picture.h"
#include <math.h>
#include <stdio.h>
#include "picture_field.h"

enum {
  FIELD = 1080, /* longest edge of the drawing, pixels */
  MARGIN = 36,
  TITLE = 84,
  BAR = 150,
  SHORTEST = 420, /* the bar needs some height */
  CIRCLES = 10000 /* most circles that an SVG draws one by one */
};

void picture_caption(char *line, size_t size, const pack *p)
{
  char count[40], fraction[40] = "";
  canvas_format_count(count, sizeof count, p->view.count);
  if (p->domain)
    snprintf(fraction, sizeof fraction, ", volume fraction %.4f",
             isnan(p->volume_fraction) ? 0 : p->volume_fraction);
  snprintf(line, size, "%s %s%s", count, p->view.count == 1 ? "particle" : "particles",
           fraction);
}

void picture_draw_asked(canvas *sheet, const pack *p, double x, double y, double width)
{
  char line[320];
  snprintf(line, sizeof line, "%s   %s", p->spec->text ? p->spec->text : "",
           p->psd_text ? p->psd_text : "");
  cairo_set_source_rgb(sheet->cr, 0.4, 0.4, 0.43);
  canvas_text_fit(sheet, x, y, 16, width, line);
}

static void draw_title(canvas *sheet, const pack *p, int width)
{
  char line[160];
  picture_caption(line, sizeof line, p);
  cairo_set_source_rgb(sheet->cr, 0.1, 0.1, 0.12);
  canvas_text(sheet, MARGIN, 40, 24, 1, ALIGN_LEFT, line);
  picture_draw_asked(sheet, p, MARGIN, 66, width - 2 * MARGIN);
}

static packing_status write_picture(const pack *p, const packing_stream *stream, int svg)
{
  picture_frame frame;
  colours meaning;
  canvas sheet;
  picture_frame_init(&frame, p, 1, FIELD);
  colours_init(&meaning, p);
  const int field = frame.height > SHORTEST ? frame.height : SHORTEST;
  const int least = 640, across = frame.width + BAR + 3 * MARGIN;
  const int width = across > least ? across : least, height = TITLE + field + MARGIN;
  packing_status status = canvas_open(&sheet, stream, svg, width, height);
  cairo_save(sheet.cr);
  cairo_translate(sheet.cr, MARGIN, TITLE + 0.5 * (field - frame.height));
  if (status == PACKING_OK)
    status = picture_draw_field(&sheet, &frame, p, &meaning, CIRCLES);
  cairo_restore(sheet.cr);
  draw_title(&sheet, p, width);
  colours_draw_bar(&meaning, &sheet, MARGIN * 2 + frame.width, TITLE + 0.12 * field,
                   0.7 * field);
  const packing_status closed = canvas_close(&sheet);
  return status != PACKING_OK ? status : closed;
}

packing_status picture_write_png(const pack *p, const packing_stream *stream)
{
  return write_picture(p, stream, 0);
}

packing_status picture_write_svg(const pack *p, const packing_stream *stream)
{
  return write_picture(p, stream, 1);
}
