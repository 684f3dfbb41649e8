/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Filling a pocket: the centre is computed anew from the bodies themselves, made tangent to
 * rounding, and tested against everything near it before it counts. */
#include "front_pockets.h"

/* ---- the centre ---- */

/* A body of the pocket about its owner, seen from c. */
static int body_now(const packing_i_pockets *p, const packing_vec3 *owner, double owner_r,
                    uint32_t *number, packing_vec3 c, double touching,
                    packing_i_front_body *body)
{
  const uint32_t id = *number;
  if (id & PACKING_I_FRONT_WALL)
    return packing_i_front_wall_body(p, owner, c, touching, number, body);
  double r;
  const packing_vec3 at = packing_i_front_centre(&p->grid, id, &r);
  *body = packing_i_front_sphere(packing_i_sub(at, *owner), r, owner_r);
  return 1;
}

/* The centre about the owner at radius r, by Newton's method from the pocket's curve; curved
 * walls follow it. 0: none. */
static int find_centre(const packing_i_pockets *p, packing_i_pocket *pocket,
                       const packing_vec3 *owner, double owner_r, double r,
                       packing_vec3 *c)
{
  if (!packing_i_front_curve_at(&pocket->curve, r, c))
    return 0;
  const int moving = p->curved && (packing_i_front_is_wall(pocket->j) ||
                                   packing_i_front_is_wall(pocket->k));
  for (int turn = 0; turn < (moving ? 20 : 1); turn++) {
    packing_i_front_body j, k;
    if (!body_now(p, owner, owner_r, &pocket->j, *c, r, &j) ||
        !body_now(p, owner, owner_r, &pocket->k, *c, r, &k))
      return 0;
    const packing_vec3 before = *c;
    *c = packing_i_front_polish(owner_r, &j, &k, r, *c);
    const packing_vec3 step = packing_i_sub(*c, before);
    if (packing_i_dot(step, step) <= r * r * 1e-30)
      break;
  }
  return packing_i_vec_finite(*c);
}

/* ---- whether it is free ---- */

static int free_of_spheres(const packing_i_pockets *p, const packing_i_front_halo *halo,
                           double r)
{
  for (size_t t = 0; t < halo->count; t++) {
    const double d2 =
        halo->x[t] * halo->x[t] + halo->y[t] * halo->y[t] + halo->z[t] * halo->z[t];
    const double least = r + halo->r[t] - p->touch;
    if (d2 < least * least)
      return 0;
  }
  return 1;
}

int packing_i_front_has_room(const packing_i_front_lane *lane, size_t images)
{
  return lane->free_pockets >= PACKING_I_POCKETS_SPARE && lane->free_bins >= images &&
         lane->outbox_count + PACKING_I_POCKETS_SPARE <= lane->outbox_room &&
         lane->placed_count + images <= lane->placed_room;
}

/* ---- images ---- */

/* One image of a sphere: its pockets and those it changes. The halo holds what is around it. */
static void settle(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile,
                   const packing_vec3 *centre, double r, uint32_t place)
{
  packing_i_pockets_shrink(p, lane, r);
  packing_i_pockets_born(p, lane, tile, place, centre, r);
}

/* The spheres whose surface is within `reach` of a centre, into the halo. 0: starved. */
static int look(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile,
                const packing_vec3 *centre, double reach)
{
  lane->halo.count = 0;
  if (packing_i_front_grid_gather(&p->grid, p->kernels, tile, centre, reach, p->body_r,
                                  &lane->halo) &&
      lane->halo.count + PACKING_I_NEAR_WALLS + 2 <= lane->halo.capacity)
    return 1; /* with room for the plane and the walls */
  lane->starved = 2;
  return 0;
}

/* How far a sphere of radius r looks when it comes. */
static double sight(const packing_i_pockets *p, double r)
{
  return r + 2 * packing_i_front_most(p, r);
}

static uint32_t insert(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t *tile,
                       const packing_vec3 *centre, double r)
{
  const uint32_t bin = lane->free_bin;
  const uint32_t place =
      packing_i_front_grid_insert(&p->grid, tile, centre, r, &lane->free_bin);
  lane->free_bins -= bin != lane->free_bin;
  return place;
}

static void note(packing_i_front_lane *lane, const packing_vec3 *centre, double r,
                 size_t component, uint32_t place, uint32_t tile, int image)
{
  packing_i_front_placed *q = lane->placed + lane->placed_count++;
  q->centre = *centre;
  q->r = r;
  q->component = component;
  q->place = place;
  q->tile = tile;
  q->image = image;
}

/* All images of a sphere; the halo of the first is there already. */
static void put(packing_i_pockets *p, packing_i_front_lane *lane,
                const packing_i_front_image *image, size_t images, double r,
                size_t component)
{
  for (size_t n = 0; n < images; n++) {
    /* Without a halo an image is an obstacle only. */
    if (n > 0 && !look(p, lane, image[n].tile, &image[n].centre, sight(p, r)))
      lane->halo.count = 0;
    uint32_t tile = image[n].tile;
    const uint32_t place = insert(p, lane, &tile, &image[n].centre, r);
    note(lane, &image[n].centre, r, component, place, tile, n > 0);
    settle(p, lane, image[n].tile, &image[n].centre, r, place);
  }
  lane->particles++;
  lane->volume += packing_i_ball_volume(p->dim, r);
}

int packing_i_front_put(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile,
                        const packing_vec3 *centre, double r, size_t component)
{
  packing_i_front_image image[PACKING_I_FRONT_IMAGES];
  const size_t images = packing_i_front_images(p, tile, centre, image);
  if (!packing_i_front_has_room(lane, images)) {
    lane->starved = 1;
    return 0;
  }
  if (!look(p, lane, image[0].tile, &image[0].centre, sight(p, r)))
    return 0;
  put(p, lane, image, images, r, component);
  return 1;
}

/* ---- filling ---- */

static void halo_move(packing_i_front_halo *halo, size_t to, size_t from)
{
  halo->x[to] = halo->x[from];
  halo->y[to] = halo->y[from];
  halo->z[to] = halo->z[from];
  halo->a[to] = halo->a[from];
  halo->b[to] = halo->b[from];
  halo->r[to] = halo->r[from];
  halo->id[to] = halo->id[from];
}

/* On curved walls the interval is that of the planes where the pocket was made, and among very
 * different sizes it may miss bodies that came or were far: it is found anew where the particle
 * would be. 0: there is no pocket any more. */
static int renew(packing_i_pockets *p, packing_i_front_lane *lane,
                 packing_i_pocket *pocket, uint32_t tile, packing_vec3 c, double r)
{
  double owner_r;
  const packing_vec3 owner = packing_i_front_centre(&p->grid, pocket->owner, &owner_r);
  packing_i_front_body j, k;
  packing_i_front_halo *halo = &lane->halo;
  packing_i_front_interval interval;
  const double most = packing_i_pocket_most(p, pocket);
  if (pocket->tries++ >= PACKING_I_POCKET_TRIES ||
      !look(p, lane, tile, &owner, owner_r + 2 * most) ||
      !body_now(p, &owner, owner_r, &pocket->j, c, r, &j) ||
      !body_now(p, &owner, owner_r, &pocket->k, c, r, &k) || pocket->j == pocket->k ||
      !packing_i_front_curve_init(owner_r, &j, &k, pocket->side, &pocket->curve))
    return 0;
  p->kernels->bodies(halo, halo->count, owner_r);
  packing_i_front_walls_gather(p, &owner, c, 2 * most, halo);
  size_t own[2] = {halo->count, halo->count}, kept = 0;
  for (size_t t = 0; t < halo->count; t++) {
    if (halo->id[t] == pocket->j)
      own[0] = kept;
    if (halo->id[t] == pocket->k)
      own[1] = kept;
    if (halo->id[t] == pocket->owner)
      continue;
    halo_move(halo, kept++, t);
  }
  halo->count = kept;
  const double start = packing_i_front_curve_start(&pocket->curve, p->min_r);
  if (!(start <= most))
    return 0;
  p->kernels->interval(&pocket->curve, halo, own[0], own[1], start, p->cap * most,
                       p->slack, &interval);
  interval.exit[0] = fmin(interval.exit[0], p->most_r);
  pocket->lo = interval.lo;
  memcpy(pocket->exit, interval.exit, sizeof pocket->exit);
  packing_i_pocket_measure(p, pocket);
  return interval.exit[0] >= interval.lo && interval.exit[0] >= p->min_r &&
         interval.lo <= most;
}

/* Whether c is close enough to the tile for the lane to work there. */
static int within(const packing_i_pockets *p, uint32_t tile, const packing_vec3 *c)
{
  const packing_i_front_tile *t = p->grid.tile + tile;
  const packing_vec3 e = p->grid.edge;
  const double far = 2 * p->max_r;
  return c->x > t->lo.x - far && c->x < t->lo.x + e.x + far && c->y > t->lo.y - far &&
         c->y < t->lo.y + e.y + far && c->z > t->lo.z - far && c->z < t->lo.z + e.z + far;
}

/* Whether a sphere may stand there. The halo is filled on the way. -1: the lane is starved. */
static int is_free(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile,
                   const packing_vec3 *centre, double r)
{
  if (!look(p, lane, tile, centre, sight(p, r)))
    return -1;
  return free_of_spheres(p, &lane->halo, r) &&
         (p->grid.tile[tile].clear || packing_i_front_holds(p, centre, r));
}

int packing_i_pocket_fill(packing_i_pockets *p, packing_i_front_lane *lane, uint32_t tile,
                          uint32_t id, size_t index)
{
  packing_i_pocket *pocket = packing_i_pocket_at(p, id);
  const double r = packing_i_source_stock(lane->source, pocket->zone)->r[index];
  double owner_r;
  const packing_vec3 owner = packing_i_front_centre(&p->grid, pocket->owner, &owner_r);
  packing_vec3 c;
  lane->attempts++;
  if (!find_centre(p, pocket, &owner, owner_r, r, &c)) {
    packing_i_pocket_kill(p, id);
    return 1;
  }
  packing_vec3 centre = packing_i_add(owner, c);
  if (p->dim == 2)
    centre.z = 0;
  /* The zone is that of the reference radius; another has other sizes. */
  if (!within(p, tile, &centre) ||
      packing_i_source_zone(lane->source, &centre) != pocket->zone) {
    packing_i_pocket_kill(p, id);
    return 1;
  }
  packing_i_front_image image[PACKING_I_FRONT_IMAGES];
  const size_t images = packing_i_front_images(p, tile, &centre, image);
  if (!packing_i_front_has_room(lane, images)) {
    lane->starved = 1;
    return 0;
  }
  const int free = is_free(p, lane, image[0].tile, &image[0].centre, r);
  if (free < 0)
    return 0;
  if (!free) {
    if (((pocket->walls && p->curved) || p->wide) && renew(p, lane, pocket, tile, c, r))
      packing_i_pocket_offer(p, lane, id);
    else if (lane->starved == 0)
      packing_i_pocket_kill(p, id);
    return lane->starved == 0;
  }
  double taken;
  size_t component;
  packing_i_source_take(lane->source, pocket->zone, index, &taken, &component);
  packing_i_pocket_kill(p, id);
  put(p, lane, image, images, taken, component);
  return 1;
}
