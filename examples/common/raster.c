/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int front_first(const void *a, const void *b)
{
  const circle *p = a, *q = b;
  if (p->depth != q->depth)
    return p->depth > q->depth ? -1 : 1;
  return p->index < q->index ? -1 : p->index > q->index;
}

/* The first free pixel of a row at or after x; the path is halved on the way. */
static uint32_t next_free(uint32_t *next, uint32_t x)
{
  while (next[x] != x) {
    next[x] = next[next[x]];
    x = next[x];
  }
  return x;
}

/* Pixels of a span of one circle that are still free. */
static void lay_row(raster *r, const circle *c, uint32_t name, int y, int flat)
{
  const double dy = y + 0.5 - c->y, left = c->r * c->r - dy * dy;
  if (!(left > 0))
    return;
  const double half = sqrt(left);
  const double from = fmax(ceil(c->x - half - 0.5), 0);
  const double to = fmin(floor(c->x + half - 0.5), r->width - 1);
  if (!(from <= to))
    return;
  uint32_t *next = r->next + (size_t)y * ((size_t)r->width + 1);
  uint32_t *owner = r->owner + (size_t)y * (size_t)r->width;
  float *depth = r->depth + (size_t)y * (size_t)r->width;
  for (uint32_t x = next_free(next, (uint32_t)from); x <= (uint32_t)to;
       x = next_free(next, x)) {
    const double dx = x + 0.5 - c->x;
    owner[x] = name;
    depth[x] = (float)(c->depth + (flat ? 0 : sqrt(fmax(left - dx * dx, 0))));
    next[x] = x + 1;
  }
}

static void lay(raster *r, const circle *c, uint32_t name, int flat)
{
  const double from = fmax(ceil(c->y - c->r - 0.5), 0);
  const double to = fmin(floor(c->y + c->r - 0.5), r->height - 1);
  for (int y = (int)from; y <= to; y++)
    lay_row(r, c, name, y, flat);
}

static void clear(raster *r)
{
  const size_t pixels = (size_t)r->width * (size_t)r->height;
  const size_t stride = (size_t)r->width + 1;
  for (size_t i = 0; i < pixels; i++) {
    r->owner[i] = RASTER_FREE;
    r->depth[i] = -INFINITY;
  }
  for (size_t i = 0; i < stride * (size_t)r->height; i++)
    r->next[i] = (uint32_t)(i % stride);
}

packing_status raster_create(raster *out, int width, int height, circle *circles,
                             size_t count, int flat)
{
  const size_t pixels = (size_t)width * (size_t)height;
  raster r = {.width = width, .height = height};
  r.owner = malloc(pixels * sizeof *r.owner);
  r.next = malloc((pixels + (size_t)height) * sizeof *r.next);
  r.depth = malloc(pixels * sizeof *r.depth);
  r.darkening = calloc(pixels, sizeof *r.darkening);
  *out = r;
  if (!r.owner || !r.next || !r.depth || !r.darkening) {
    raster_destroy(out);
    return PACKING_ERR_NOMEM;
  }
  qsort(circles, count, sizeof *circles, front_first);
  clear(&r);
  for (size_t i = 0; i < count; i++)
    lay(&r, &circles[i], (uint32_t)i, flat);
  return PACKING_OK;
}

void raster_destroy(raster *r)
{
  free(r->owner);
  free(r->next);
  free(r->depth);
  free(r->darkening);
  memset(r, 0, sizeof *r);
}

/* The raster at a quarter of its resolution: sums over 4 by 4 pixels. */
enum { COARSE = 4 };

typedef struct coarse {
  int width, height;
  double *sum;   /* of depths */
  double *count; /* of pixels taken */
  double *line;  /* a row or a column while it is blurred */
} coarse;

static void fill_coarse(const raster *r, coarse *c)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++) {
      const size_t from = (size_t)y * (size_t)r->width + (size_t)x;
      const size_t to = (size_t)(y / COARSE) * (size_t)c->width + (size_t)(x / COARSE);
      if (r->owner[from] == RASTER_FREE)
        continue;
      c->sum[to] += (double)r->depth[from];
      c->count[to] += 1;
    }
}

/* A running sum over 2 reach + 1 entries of a line, in place. */
static void blur_line(double *data, size_t stride, int length, int reach, double *line)
{
  double sum = 0;
  for (int i = 0; i < length; i++)
    line[i] = data[(size_t)i * stride];
  for (int i = 0; i < reach && i < length; i++)
    sum += line[i];
  for (int i = 0; i < length; i++) {
    sum += i + reach < length ? line[i + reach] : 0;
    sum -= i - reach - 1 >= 0 ? line[i - reach - 1] : 0;
    data[(size_t)i * stride] = sum;
  }
}

/* Two passes of a box: nearly a Gaussian. */
static void blur(const coarse *c, double *data, int reach)
{
  for (int pass = 0; pass < 2; pass++) {
    for (int y = 0; y < c->height; y++)
      blur_line(data + (size_t)y * (size_t)c->width, 1, c->width, reach, c->line);
    for (int x = 0; x < c->width; x++)
      blur_line(data + x, (size_t)c->width, c->height, reach, c->line);
  }
}

static void compare_depths(raster *r, const coarse *c, double scale)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++) {
      const size_t at = (size_t)y * (size_t)r->width + (size_t)x;
      const size_t from = (size_t)(y / COARSE) * (size_t)c->width + (size_t)(x / COARSE);
      if (r->owner[at] == RASTER_FREE)
        continue;
      const double mean = c->sum[from] / c->count[from];
      const double below = (mean - (double)r->depth[at]) / scale;
      r->darkening[at] = (float)fmin(fmax(below, 0), 1);
    }
}

packing_status raster_darken(raster *r, int reach)
{
  coarse c = {.width = r->width / COARSE + 1, .height = r->height / COARSE + 1};
  const size_t cells = (size_t)c.width * (size_t)c.height;
  c.sum = calloc(cells, sizeof *c.sum);
  c.count = calloc(cells, sizeof *c.count);
  c.line = calloc((size_t)c.width + (size_t)c.height, sizeof *c.line);
  if (c.sum && c.count && c.line) {
    const int cell_reach = reach / COARSE > 1 ? reach / COARSE : 1;
    fill_coarse(r, &c);
    blur(&c, c.sum, cell_reach);
    blur(&c, c.count, cell_reach);
    compare_depths(r, &c, 3.0 * COARSE * cell_reach);
  }
  const int done = c.sum && c.count && c.line;
  free(c.line);
  free(c.count);
  free(c.sum);
  return done ? PACKING_OK : PACKING_ERR_NOMEM;
}
