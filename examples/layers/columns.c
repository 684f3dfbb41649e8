/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How high a bed stands everywhere: the cross-section is cut into cells of two mean diameters'
 * width (a little more, so that they fill it), and each cell's column ends where the highest
 * particle does whose centre is inside. Columns that the walls leave less than half of for
 * centres do not count, for there none may ever come to lie. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "layers.h"

/* Points a column and direction where room is looked for. */
enum { PROBES = 5 };

static size_t cells(double width, double mean_r)
{
  const double count = floor(width / (4 * mean_r));
  return count >= 1 ? (size_t)fmin(count, 1e4) : 1;
}

/* Whether a mean particle that ends at the full height has at least half the column. */
static int has_room(const columns *c, const packing_domain *domain, double top,
                    double mean_r, size_t column)
{
  const int dim = packing_domain_dim(domain);
  const int deep = dim == 2 ? 1 : PROBES;
  const double x = c->x + c->dx * (double)(column % c->across);
  const double y = c->y + c->dy * (double)(column / c->across);
  int room = 0;
  for (int k = 0; k < PROBES * deep; k++) {
    packing_vec3 at = {x + c->dx * (k % PROBES + 0.5) / PROBES, top - mean_r, 0};
    if (dim == 3)
      at = (packing_vec3){at.x, y + c->dy * (k / PROBES + 0.5) / PROBES, top - mean_r};
    room += packing_domain_holds(domain, &at, mean_r);
  }
  return 2 * room >= PROBES * deep;
}

int columns_create(columns *c, const packing_domain *domain, double top, double mean_r)
{
  packing_bounds b;
  const int flat = packing_domain_dim(domain) == 2;
  packing_domain_bounds(domain, &b);
  c->across = cells(b.hi.x - b.lo.x, mean_r);
  c->deep = flat ? 1 : cells(b.hi.y - b.lo.y, mean_r);
  c->x = b.lo.x;
  c->y = b.lo.y;
  c->dx = (b.hi.x - b.lo.x) / (double)c->across;
  c->dy = (b.hi.y - b.lo.y) / (double)c->deep;
  const size_t count = c->across * c->deep;
  c->top = program_take(count, sizeof *c->top);
  c->counts = program_take(count, sizeof *c->counts);
  for (size_t k = 0; k < count; k++) {
    c->counts[k] = (unsigned char)has_room(c, domain, top, mean_r, k);
    c->counted += c->counts[k];
  }
  return 0;
}

void columns_free(columns *c)
{
  free(c->counts);
  free(c->top);
}

static size_t cell_of(double from_lowest, double width, size_t count)
{
  const double at = floor(from_lowest / width);
  return at <= 0 ? 0 : at >= (double)count ? count - 1 : (size_t)at;
}

static void raise_column(columns *c, packing_vec3 centre, int dim, double end)
{
  const size_t i = cell_of(centre.x - c->x, c->dx, c->across);
  const size_t j = dim == 2 ? 0 : cell_of(centre.y - c->y, c->dy, c->deep);
  double *top = &c->top[j * c->across + i];
  *top = fmax(*top, end);
}

double columns_measure(columns *c, const packing_view *view, int dim, double floor_height,
                       double *highest)
{
  const size_t count = c->across * c->deep;
  const pack p = {.view = *view};
  double lowest = (double)INFINITY;
  *highest = floor_height;
  for (size_t k = 0; k < count; k++)
    c->top[k] = floor_height;
  for (size_t i = 0; i < view->count; i++) {
    const packing_vec3 centre = pack_centre(&p, i);
    const double end = (dim == 2 ? centre.y : centre.z) + pack_radius(&p, i);
    raise_column(c, centre, dim, end);
    *highest = fmax(*highest, end);
  }
  for (size_t k = 0; k < count; k++)
    if (c->counts[k])
      lowest = fmin(lowest, c->top[k]);
  return c->counted > 0 ? lowest : *highest;
}
