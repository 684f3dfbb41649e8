/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "canvas.h"
#include <cairo-svg.h>
#include <stdio.h>
#include <string.h>

static cairo_status_t write_on(void *user, const unsigned char *data, unsigned int length)
{
  canvas *c = user;
  if (c->status == PACKING_OK)
    c->status = c->stream->write(c->stream->user, data, length);
  return c->status == PACKING_OK ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static packing_status status_of(cairo_status_t status)
{
  switch (status) {
  case CAIRO_STATUS_SUCCESS:
    return PACKING_OK;
  case CAIRO_STATUS_NO_MEMORY:
    return PACKING_ERR_NOMEM;
  case CAIRO_STATUS_WRITE_ERROR:
    return PACKING_ERR_IO;
  default:
    return PACKING_ERR_INTERNAL;
  }
}

packing_status canvas_open(canvas *c, const packing_stream *stream, int svg, int width,
                           int height)
{
  c->stream = stream;
  c->status = PACKING_OK;
  c->svg = svg;
  c->surface = svg ? cairo_svg_surface_create_for_stream(write_on, c, width, height)
                   : cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  c->cr = cairo_create(c->surface);
  cairo_set_source_rgb(c->cr, 1, 1, 1);
  cairo_paint(c->cr);
  return status_of(cairo_status(c->cr));
}

packing_status canvas_close(canvas *c)
{
  cairo_status_t status = cairo_status(c->cr);
  cairo_destroy(c->cr);
  if (status == CAIRO_STATUS_SUCCESS && !c->svg)
    status = cairo_surface_write_to_png_stream(c->surface, write_on, c);
  cairo_surface_finish(c->surface);
  if (status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_status(c->surface);
  cairo_surface_destroy(c->surface);
  return c->status != PACKING_OK ? c->status : status_of(status);
}

void canvas_text(canvas *c, double x, double y, double size, int bold, canvas_align align,
                 const char *text)
{
  cairo_text_extents_t extents;
  cairo_select_font_face(c->cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c->cr, size);
  cairo_text_extents(c->cr, text, &extents);
  if (align != ALIGN_LEFT)
    x -= extents.x_advance * (align == ALIGN_RIGHT ? 1 : 0.5);
  cairo_move_to(c->cr, x, y);
  cairo_show_text(c->cr, text);
}

void canvas_text_fit(canvas *c, double x, double y, double size, double width,
                     const char *text)
{
  cairo_text_extents_t extents;
  char line[256];
  size_t length = strlen(text);
  cairo_select_font_face(c->cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c->cr, size);
  if (length >= sizeof line)
    length = sizeof line - 1;
  memcpy(line, text, length);
  line[length] = '\0';
  cairo_text_extents(c->cr, line, &extents);
  while (extents.x_advance > width && length > 4) {
    memcpy(line + --length - 3, "...", 4);
    cairo_text_extents(c->cr, line, &extents);
  }
  cairo_move_to(c->cr, x, y);
  cairo_show_text(c->cr, line);
}

void canvas_format_count(char *out, size_t size, size_t count)
{
  char digits[32];
  const size_t length = (size_t)snprintf(digits, sizeof digits, "%zu", count);
  size_t at = 0;
  for (size_t i = 0; i < length && at + 2 < size; i++) {
    if (i > 0 && (length - i) % 3 == 0)
      out[at++] = ' ';
    out[at++] = digits[i];
  }
  out[at] = '\0';
}
