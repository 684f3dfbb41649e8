/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Periodic cells: a sphere near a border of the cell stands in the grid with all its images that
 * can touch something in the cell, and each image makes and changes pockets. A pocket counts only
 * where its centre lies inside the cell, so it is there once. */
#include "front_pockets.h"

/* Levels for which a tile stays filled after an image might have come: no pocket is near to many of
 * them, and the tile across the cell that is at work asks for them each time. */
enum { STAYS = 16 };

/* Spheres farther than this from the cell touch no pocket in it. */
static double margin(const packing_i_pockets *p)
{
  return 2 * p->max_r + 2 * p->body_r;
}

/* How many periods away an image can matter, along an axis. */
static int far_along(const packing_i_pockets *p, int axis)
{
  if (!(p->periodic >> axis & 1U))
    return 0;
  const double n = ceil(margin(p) / packing_i_component(p->period, axis));
  return n < 2 ? (int)n : 2;
}

static packing_vec3 shifted(const packing_i_pockets *p, const packing_vec3 *c, int x,
                            int y, int z)
{
  return packing_i_vec(x == 0 ? c->x : c->x + x * p->period.x,
                       y == 0 ? c->y : c->y + y * p->period.y,
                       z == 0 ? c->z : c->z + z * p->period.z);
}

static int along_matters(const packing_i_pockets *p, int axis, double lo, double hi)
{
  if (!(p->periodic >> axis & 1U))
    return 1;
  const double far = margin(p);
  return hi >= packing_i_component(p->bounds.lo, axis) - far &&
         lo <= packing_i_component(p->bounds.hi, axis) + far;
}

/* Whether the box from lo to hi comes near the cell. */
static int matters(const packing_i_pockets *p, const packing_vec3 *lo,
                   const packing_vec3 *hi)
{
  return along_matters(p, 0, lo->x, hi->x) && along_matters(p, 1, lo->y, hi->y) &&
         along_matters(p, 2, lo->z, hi->z);
}

static int is_same(const packing_vec3 *a, const packing_vec3 *b)
{
  return a->x == b->x && a->y == b->y && a->z == b->z;
}

/* A sphere that was not wrapped keeps the tile it is near, which is prepared. */
size_t packing_i_front_images(const packing_i_pockets *p, uint32_t tile,
                              const packing_vec3 *centre,
                              packing_i_front_image image[PACKING_I_FRONT_IMAGES])
{
  image[0].centre = *centre;
  image[0].tile = tile;
  if (p->periodic == 0)
    return 1;
  packing_domain_wrap(p->domain, &image[0].centre);
  size_t count = 1;
  const int fx = far_along(p, 0), fy = far_along(p, 1), fz = far_along(p, 2);
  for (int z = -fz; z <= fz; z++)
    for (int y = -fy; y <= fy; y++)
      for (int x = -fx; x <= fx; x++) {
        const packing_vec3 c = shifted(p, &image[0].centre, x, y, z);
        if ((x != 0 || y != 0 || z != 0) && matters(p, &c, &c))
          image[count++].centre = c;
      }
  for (size_t n = is_same(centre, &image[0].centre) ? 1 : 0; n < count; n++) {
    int64_t at[3];
    packing_i_front_grid_at(&p->grid, &image[n].centre, at);
    image[n].tile = packing_i_front_tile_find(&p->grid, at);
  }
  return count;
}

/* All tiles that a box touches, and those around them; of the box what is near enough to the
 * cell for images. */
static packing_status prepare_box(packing_i_pockets *p, packing_vec3 lo, packing_vec3 hi)
{
  int64_t first[3], last[3], at[3];
  for (int axis = 0; axis < 3; axis++) {
    if (!(p->periodic >> axis & 1U))
      continue;
    packing_i_set_component(&lo, axis,
                            fmax(packing_i_component(lo, axis),
                                 packing_i_component(p->bounds.lo, axis) - margin(p)));
    packing_i_set_component(&hi, axis,
                            fmin(packing_i_component(hi, axis),
                                 packing_i_component(p->bounds.hi, axis) + margin(p)));
  }
  packing_i_front_grid_at(&p->grid, &lo, first);
  packing_i_front_grid_at(&p->grid, &hi, last);
  for (at[2] = first[2]; at[2] <= last[2]; at[2]++)
    for (at[1] = first[1]; at[1] <= last[1]; at[1]++)
      for (at[0] = first[0]; at[0] <= last[0]; at[0]++) {
        const uint32_t tile = packing_i_front_tile_at(&p->grid, at);
        if (tile == 0)
          return packing_i_nomem(p->placer->context);
        PACKING_I_TRY(packing_i_front_prepare_tile(p, tile));
        for (int n = 0; n < PACKING_I_TILE_AROUND; n++)
          p->grid.tile[p->grid.tile[tile].around[n]].stays = STAYS;
      }
  return PACKING_OK;
}

/* A sphere that is wrapped leaves an image where it came from, beyond the cell. */
static packing_status prepare_beyond(packing_i_pockets *p, const packing_vec3 *lo,
                                     const packing_vec3 *hi)
{
  for (int axis = 0; axis < 3; axis++) {
    const double from = packing_i_component(p->bounds.lo, axis);
    const double to = packing_i_component(p->bounds.hi, axis);
    packing_vec3 end = *hi, begin = *lo;
    packing_i_set_component(&end, axis, from);
    packing_i_set_component(&begin, axis, to);
    if (!(p->periodic >> axis & 1U))
      continue;
    if (packing_i_component(*lo, axis) <= from)
      PACKING_I_TRY(prepare_box(p, *lo, end));
    if (packing_i_component(*hi, axis) >= to)
      PACKING_I_TRY(prepare_box(p, begin, *hi));
  }
  return PACKING_OK;
}

packing_status packing_i_front_prepare_images(packing_i_pockets *p, uint32_t tile)
{
  const double far = 2 * p->max_r;
  const packing_i_front_tile *t = p->grid.tile + tile;
  const packing_vec3 grow = packing_i_vec(far, far, far);
  const packing_vec3 lo = packing_i_sub(t->lo, grow),
                     hi = packing_i_add(packing_i_add(t->lo, p->grid.edge), grow);
  const int fx = far_along(p, 0), fy = far_along(p, 1), fz = far_along(p, 2);
  for (int z = -fz; z <= fz; z++)
    for (int y = -fy; y <= fy; y++)
      for (int x = -fx; x <= fx; x++) {
        const packing_vec3 a = shifted(p, &lo, x, y, z), b = shifted(p, &hi, x, y, z);
        if ((x != 0 || y != 0 || z != 0) && matters(p, &a, &b))
          PACKING_I_TRY(prepare_box(p, a, b));
      }
  return prepare_beyond(p, &lo, &hi);
}
