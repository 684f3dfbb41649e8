/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A random point in each reference cell (Liu and You, equations 1 to 4; formula F18 of
 * doc/methods/place.md): a cuboid of k x k cubic cells of edge l a layer stands on the bottom of
 * the container, on its axis; in a cylinder it is the square inscribed in the circle, k =
 * floor(sqrt 2 R / l); in a box a x a, k = floor(a / l). Cells are filled bottom first, one
 * particle each, its centre uniform in [r, l - r] along each axis: nothing overlaps. N particles
 * take ceil(N / k^2) layers.
 *
 * Departures: a box need not be square (kx x ky cells a layer), and rectangles do the same with
 * rows. */
#include "lattice_internal.h"
#include <string.h>

/* Quotients this close below a whole number are that number: l = a / k gives k back. */
static const double whole = 1e-12;

/* Width along x and y, height, and where the cuboid's axis and bottom are. */
typedef struct room {
  double width[2];
  double height;
  packing_vec3 foot; /* axis at the bottom */
  int dim;
} free_room;

/* Box, rectangle, and cylinder along z. */
static packing_status find_room(const packing_placer *placer, free_room *out)
{
  const packing_domain *domain = placer->domain;
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  const int dim = packing_domain_dim(domain);
  const int cylinder = strcmp(packing_domain_kind(domain), "cylinder") == 0 &&
                       packing_i_domain_axis(domain) == PACKING_AXIS_Z;
  if (packing_i_domain_planar(domain) == NULL && !cylinder)
    return packing_i_fail(placer->context, PACKING_ERR_UNSUPPORTED, "kind",
                          PACKING_NO_INDEX,
                          "cells go into a box, a rectangle or a cylinder along z");
  const double share = cylinder ? 0.70710678118654752 : 1;
  out->dim = dim;
  out->width[0] = (b.hi.x - b.lo.x) * share;
  out->width[1] = dim == 2 ? 0 : (b.hi.y - b.lo.y) * share;
  out->height = dim == 2 ? b.hi.y - b.lo.y : b.hi.z - b.lo.z;
  out->foot = packing_i_vec(0.5 * (b.lo.x + b.hi.x),
                            dim == 2 ? b.lo.y : 0.5 * (b.lo.y + b.hi.y), b.lo.z);
  return PACKING_OK;
}

static double cells_across(double width, double l)
{
  return floor(width / l * (1 + whole));
}

/* Cells of edge l a layer. */
static double cells_a_layer(const free_room *room, double l)
{
  const double kx = cells_across(room->width[0], l);
  return room->dim == 2 ? kx : kx * cells_across(room->width[1], l);
}

/* The largest l with at least `cells` cells a layer. */
static double edge_for(const free_room *room, double cells)
{
  double i = 1, j = 1;
  if (room->dim == 2)
    return room->width[0] / cells;
  /* The edge shrinks until one more cell fits along x or along y. */
  for (;;) {
    const double lx = room->width[0] / i, ly = room->width[1] / j;
    const double l = lx < ly ? lx : ly;
    if (cells_a_layer(room, l) >= cells)
      return l;
    if (room->width[0] / (i + 1) > room->width[1] / (j + 1))
      i = cells_across(room->width[0], l) + 1;
    else
      j = cells_across(room->width[1], l) + 1;
  }
}

/* The largest l with which `count` cells fit under the height: with m layers it is the smaller
 * of height / m (falling in m) and edge_for(count / m) (rising in m). */
static double largest_edge(const free_room *room, double count)
{
  double few = 1, many = count, best = 0;
  while (few <= many) {
    const double m = floor(0.5 * (few + many));
    const double by_height = room->height / m;
    const double by_width = edge_for(room, ceil(count / m));
    const double l = by_height < by_width ? by_height : by_width;
    if (l > best)
      best = l;
    if (by_height > by_width)
      few = m + 1;
    else
      many = m - 1;
  }
  return best;
}

packing_status packing_i_cells_start(packing_placer *placer, packing_i_lattice *lattice,
                                     double edge)
{
  packing_context *context = placer->context;
  const double least = 2 * packing_psd_max_r(placer->psd);
  const double count = (double)lattice->count;
  free_room in = {{0, 0}, 0, {0, 0, 0}, 0};
  PACKING_I_TRY(find_room(placer, &in));
  if (lattice->count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "0: cells need the number of particles");
  if (edge != 0 && edge < least)
    return packing_i_fail(context, PACKING_ERR_RANGE, "cell", PACKING_NO_INDEX,
                          "%g is smaller than the largest diameter %g", edge, least);
  double l = edge != 0 ? edge : largest_edge(&in, count);
  if (l < least)
    l = least; /* too many: for the height that they need */
  const double a_layer = cells_a_layer(&in, l);
  if (a_layer < 1)
    return packing_i_fail(context, edge != 0 ? PACKING_ERR_RANGE : PACKING_ERR_GEOMETRY,
                          edge != 0 ? "cell" : "psd", PACKING_NO_INDEX,
                          "no cell of edge %g fits across the container", l);
  const double height = l * ceil(count / a_layer);
  if (height > in.height * (1 + whole))
    return packing_i_fail(
        context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
        "%zu particles in cells of edge %g need a height of %g, there is %g",
        lattice->count, l, height, in.height);
  packing_i_cells *cells = &lattice->cells;
  cells->edge = l;
  cells->k[0] = (size_t)cells_across(in.width[0], l);
  cells->k[1] = in.dim == 2 ? 1 : (size_t)cells_across(in.width[1], l);
  cells->origin = in.foot;
  cells->origin.x -= 0.5 * l * (double)cells->k[0];
  if (in.dim == 3)
    cells->origin.y -= 0.5 * l * (double)cells->k[1];
  lattice->sites = lattice->count;
  return PACKING_OK;
}

packing_vec3 packing_i_cells_site(packing_i_lattice *lattice, size_t i, double r, int dim)
{
  const packing_i_cells *cells = &lattice->cells;
  const double l = cells->edge;
  const size_t ix = i % cells->k[0], iy = i / cells->k[0] % cells->k[1];
  const size_t layer = i / cells->k[0] / cells->k[1];
  const double x = r + packing_i_stream_uniform(&lattice->positions) * (l - 2 * r);
  const double y = r + packing_i_stream_uniform(&lattice->positions) * (l - 2 * r);
  if (dim == 2)
    return packing_i_vec(cells->origin.x + (double)ix * l + x,
                         cells->origin.y + (double)layer * l + y, cells->origin.z);
  const double z = r + packing_i_stream_uniform(&lattice->positions) * (l - 2 * r);
  return packing_i_vec(cells->origin.x + (double)ix * l + x,
                       cells->origin.y + (double)iy * l + y,
                       cells->origin.z + (double)layer * l + z);
}
