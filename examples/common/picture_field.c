/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pack as shaded spheres or discs in its container. PNG shades pixel by pixel; SVG draws the
 * visible particles as circles, unless they are so many that the pixels are the smaller file. */
#include "picture_field.h"
#include <math.h>
#include <stdlib.h>
#include "outline.h"
#include "raster.h"

/* Pixels of the raster a pixel of the sheet, each way. */
enum { FINE = 2 };

static const rgb WHITE = {1, 1, 1}, BLACK = {0.03, 0.04, 0.09};

typedef struct drawing {
  const pack *p;
  const colours *colours;
  canvas *sheet;
  camera camera;
  int width, height; /* pixels */
  circle *circles;
  raster raster;
} drawing;

/* ---- layout ---- */

/* What has to be seen, unscaled. */
typedef struct extent {
  const camera *camera;
  double lo[2], hi[2];
} extent;

static void widen(extent *e, packing_vec3 point, double r)
{
  const spot s = camera_project(e->camera, point);
  e->lo[0] = fmin(e->lo[0], s.x - r);
  e->hi[0] = fmax(e->hi[0], s.x + r);
  e->lo[1] = fmin(e->lo[1], s.y - r);
  e->hi[1] = fmax(e->hi[1], s.y + r);
}

static void widen_piece(void *user, packing_vec3 from, packing_vec3 to)
{
  (void)to;
  widen(user, from, 0);
}

void picture_frame_init(picture_frame *f, const pack *packs, size_t count, int longest)
{
  extent e = {.camera = &f->camera,
              .lo = {(double)INFINITY, (double)INFINITY},
              .hi = {-(double)INFINITY, -(double)INFINITY}};
  camera_init(&f->camera, packs->spec->dim);
  outline_trace(packs->spec, f->camera.toward, widen_piece, &e);
  for (const pack *p = packs; p < packs + count; p++)
    for (size_t i = 0; i < p->view.count; i++)
      widen(&e, pack_centre(p, i), pack_radius(p, i));
  if (!(e.hi[0] > e.lo[0])) /* neither a container nor a particle */
    e = (extent){.camera = &f->camera, .hi = {1, 1}};
  const double w = e.hi[0] - e.lo[0], h = e.hi[1] - e.lo[1];
  f->camera.scale = longest / fmax(w, h);
  f->width = (int)ceil(w * f->camera.scale) + 4;
  f->height = (int)ceil(h * f->camera.scale) + 4;
  f->camera.x = 2 - e.lo[0] * f->camera.scale;
  f->camera.y = 2 - e.lo[1] * f->camera.scale;
}

static packing_status rasterise(drawing *d)
{
  const size_t count = d->p->view.count;
  const int flat = d->p->spec->dim == 2;
  d->circles = malloc((count ? count : 1) * sizeof *d->circles);
  if (!d->circles)
    return PACKING_ERR_NOMEM;
  for (size_t i = 0; i < count; i++) {
    const spot s = camera_project(&d->camera, pack_centre(d->p, i));
    d->circles[i] = (circle){.x = FINE * s.x,
                             .y = FINE * s.y,
                             .r = FINE * d->camera.scale * pack_radius(d->p, i),
                             .depth = FINE * s.depth,
                             .index = i};
  }
  packing_status status = raster_create(&d->raster, FINE * d->width, FINE * d->height,
                                        d->circles, count, flat);
  if (status == PACKING_OK && !flat)
    status = raster_darken(
        &d->raster,
        (d->raster.width > d->raster.height ? d->raster.width : d->raster.height) / 30);
  return status;
}

/* ---- pixels ---- */

/* Light from above left, as the eye expects it, with a soft highlight. */
static rgb shade(rgb colour, double nx, double ny, double nz, double darkening)
{
  const double light = fmax(0, -0.42 * nx + 0.62 * ny + 0.66 * nz);
  const double half = fmax(0, -0.23 * nx + 0.34 * ny + 0.91 * nz);
  const double gloss = 0.28 * pow(half, 40);
  rgb lit = rgb_mix(BLACK, colour, fmin(1, 0.46 + 0.6 * light));
  lit = rgb_mix(lit, WHITE, gloss);
  return rgb_mix(lit, BLACK, 0.72 * darkening);
}

static rgb shade_pixel(const drawing *d, int x, int y)
{
  const raster *r = &d->raster;
  const size_t at = (size_t)y * (size_t)r->width + (size_t)x;
  if (r->owner[at] == RASTER_FREE)
    return WHITE;
  const circle *c = &d->circles[r->owner[at]];
  const rgb colour = colours_of(d->colours, d->p, c->index);
  const double nx = (x + 0.5 - c->x) / c->r, ny = (c->y - y - 0.5) / c->r;
  const double out = sqrt(nx * nx + ny * ny);
  if (d->p->spec->dim == 2)
    return (1 - out) * c->r < fmin(1.5 * FINE, 0.3 * c->r) ? rgb_mix(colour, BLACK, 0.55)
                                                           : colour;
  return shade(colour, nx, ny, sqrt(fmax(0, 1 - out * out)), (double)r->darkening[at]);
}

static uint32_t mean_pixel(const drawing *d, int x, int y)
{
  double sum[3] = {0, 0, 0};
  for (int j = 0; j < FINE; j++)
    for (int i = 0; i < FINE; i++) {
      const rgb one = shade_pixel(d, FINE * x + i, FINE * y + j);
      sum[0] += one.r;
      sum[1] += one.g;
      sum[2] += one.b;
    }
  const double full = 255.0 / (FINE * FINE);
  return (uint32_t)(sum[0] * full + 0.5) << 16 | (uint32_t)(sum[1] * full + 0.5) << 8 |
         (uint32_t)(sum[2] * full + 0.5);
}

static void paint_pixels(drawing *d)
{
  cairo_surface_t *image =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, d->width, d->height);
  unsigned char *data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int y = 0; data && y < d->height; y++) {
    uint32_t *row = (uint32_t *)(void *)(data + (ptrdiff_t)y * stride);
    for (int x = 0; x < d->width; x++)
      row[x] = mean_pixel(d, x, y);
  }
  cairo_surface_mark_dirty(image);
  cairo_set_source_surface(d->sheet->cr, image, 0, 0);
  cairo_paint(d->sheet->cr);
  cairo_surface_destroy(image);
}

/* ---- circles ---- */

/* What is seen of a circle: pixels, and the mean darkening over them. */
typedef struct seen {
  uint32_t pixels;
  float darkening;
} seen;

static size_t look(const drawing *d, seen *all)
{
  const size_t pixels = (size_t)d->raster.width * (size_t)d->raster.height;
  size_t visible = 0;
  for (size_t i = 0; i < pixels; i++) {
    const uint32_t owner = d->raster.owner[i];
    if (owner == RASTER_FREE)
      continue;
    visible += all[owner].pixels++ == 0;
    all[owner].darkening += d->raster.darkening[i];
  }
  return visible;
}

static void draw_disc(cairo_t *cr, rgb colour, double r)
{
  const rgb rim = rgb_mix(colour, BLACK, 0.55);
  cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
  cairo_fill_preserve(cr);
  cairo_set_source_rgb(cr, rim.r, rim.g, rim.b);
  cairo_set_line_width(cr, fmin(1, 0.3 * r));
  cairo_stroke(cr);
}

static void draw_ball(cairo_t *cr, rgb colour, double x, double y, double r,
                      double darkening)
{
  static const struct {
    double at, nx, ny, nz;
  } stops[] = {{0, -0.36, 0.48, 0.8}, {0.5, -0.05, 0.07, 0.99}, {1, 0.5, -0.7, 0.5}};
  cairo_pattern_t *shine =
      cairo_pattern_create_radial(x - 0.36 * r, y - 0.46 * r, 0.05 * r, x, y, 1.02 * r);
  for (int k = 0; k < 3; k++) {
    const rgb c = shade(colour, stops[k].nx, stops[k].ny, stops[k].nz, darkening);
    cairo_pattern_add_color_stop_rgb(shine, stops[k].at, c.r, c.g, c.b);
  }
  cairo_set_source(cr, shine);
  cairo_fill(cr);
  cairo_pattern_destroy(shine);
}

/* Back to front; what no pixel shows is left out. */
static void draw_circles(drawing *d, const seen *all)
{
  cairo_t *cr = d->sheet->cr;
  for (size_t i = d->p->view.count; i-- > 0;) {
    const circle *c = &d->circles[i];
    const double x = c->x / FINE, y = c->y / FINE, r = c->r / FINE;
    if (all[i].pixels == 0)
      continue;
    const rgb colour = colours_of(d->colours, d->p, c->index);
    cairo_new_path(cr);
    cairo_arc(cr, x, y, r, 0, 2 * M_PI);
    if (d->p->spec->dim == 2)
      draw_disc(cr, colour, r);
    else
      draw_ball(cr, colour, x, y, r, (double)all[i].darkening / all[i].pixels);
  }
}

static packing_status paint_pack(drawing *d, size_t most_circles)
{
  const size_t count = d->p->view.count;
  if (!d->sheet->svg) {
    paint_pixels(d);
    return PACKING_OK;
  }
  seen *all = calloc(count ? count : 1, sizeof *all);
  if (!all)
    return PACKING_ERR_NOMEM;
  if (look(d, all) <= most_circles)
    draw_circles(d, all);
  else
    paint_pixels(d);
  free(all);
  return PACKING_OK;
}

/* ---- around it ---- */

/* Whether something stands before a point of the outline. */
static int hidden(const drawing *d, spot s)
{
  const int x = (int)(FINE * s.x), y = (int)(FINE * s.y);
  if (d->p->spec->dim == 2 || x < 0 || y < 0 || x >= d->raster.width ||
      y >= d->raster.height)
    return 0;
  return (double)d->raster.depth[(size_t)y * (size_t)d->raster.width + (size_t)x] >
         FINE * s.depth;
}

static void draw_piece(void *user, packing_vec3 from, packing_vec3 to)
{
  drawing *d = user;
  const spot a = camera_project(&d->camera, from), b = camera_project(&d->camera, to);
  if (hidden(d, a) || hidden(d, b))
    return;
  cairo_move_to(d->sheet->cr, a.x, a.y);
  cairo_line_to(d->sheet->cr, b.x, b.y);
}

static void draw_outline(drawing *d)
{
  cairo_set_line_cap(d->sheet->cr, CAIRO_LINE_CAP_ROUND);
  outline_trace(d->p->spec, d->camera.toward, draw_piece, d);
  /* A pale seam keeps the line visible on dark particles. */
  cairo_set_source_rgba(d->sheet->cr, 1, 1, 1, 0.5);
  cairo_set_line_width(d->sheet->cr, 3.2);
  cairo_stroke_preserve(d->sheet->cr);
  cairo_set_source_rgba(d->sheet->cr, 0.12, 0.14, 0.2, 0.9);
  cairo_set_line_width(d->sheet->cr, 1.3);
  cairo_stroke(d->sheet->cr);
}

packing_status picture_draw_field(canvas *sheet, const picture_frame *frame,
                                  const pack *p, const colours *c, size_t most_circles)
{
  drawing d = {.p = p,
               .colours = c,
               .sheet = sheet,
               .camera = frame->camera,
               .width = frame->width,
               .height = frame->height};
  packing_status status = rasterise(&d);
  if (status == PACKING_OK)
    status = paint_pack(&d, most_circles);
  if (status == PACKING_OK)
    draw_outline(&d);
  raster_destroy(&d.raster);
  free(d.circles);
  return status;
}
