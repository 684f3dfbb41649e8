/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_RASTER_H
#define EXAMPLES_RASTER_H

/* Which particle a pixel shows. Spheres that do not overlap hide one another in the order of
 * their centres' depths (on a line of sight the middles of two disjoint chords are those
 * depths), so they are laid front first and each pixel is taken once: links to the next free
 * pixel of a row jump over what is taken, and a million spheres cost about as much as their
 * rows. */

#include <packing/packing.h>

/* A projected particle, in pixels of the raster. */
typedef struct circle {
  double x, y, r, depth;
  size_t index; /* the particle */
} circle;

#define RASTER_FREE UINT32_MAX

typedef struct raster {
  int width, height;
  uint32_t *owner;  /* circle of a pixel, or RASTER_FREE */
  uint32_t *next;   /* free pixel at or after this one, a row being width + 1 long */
  float *depth;     /* of the sphere's surface; -infinity where free */
  float *darkening; /* 0 in the open, to 1 deep between others */
} raster;

/* Sorts the circles front first and lays them; flat: as discs. */
packing_status raster_create(raster *out, int width, int height, circle *circles,
                             size_t count, int flat);
void raster_destroy(raster *r);

/* How deep each pixel lies below its neighbourhood of `reach` pixels (Luft, Colditz, Deussen,
 * ACM Trans. Graph. 25, 1206, 2006: unsharp masking of the depth). */
packing_status raster_darken(raster *r, int reach);

#endif
