/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the pocket front begins: with what stands in the store, else with particles at the
 * innermost point (seed paper, section 3.2): three discs, four spheres, tangent to one another,
 * the mean of their centres there. Where they find no room, in thin containers, one particle is
 * placed and then such that touch one or two others, until walls and particles make pockets. */
#include "front_pockets.h"

enum { DIRECTIONS = 128 };

static packing_status tile_for(packing_i_pockets *p, const packing_vec3 *c,
                               uint32_t *tile)
{
  int64_t at[3];
  packing_vec3 wrapped = *c;
  packing_domain_wrap(p->domain, &wrapped);
  packing_i_front_grid_at(&p->grid, &wrapped, at);
  *tile = packing_i_front_tile_at(&p->grid, at);
  if (*tile == 0)
    return packing_i_nomem(p->placer->context);
  return packing_i_front_prepare(p, *tile);
}

/* Puts one sphere; `stored` as packing_i_front_collect() takes it. */
static packing_status put_one(packing_i_pockets *p, const packing_vec3 *c, double r,
                              size_t component, size_t stored)
{
  packing_i_front_lane *lane = p->lane;
  uint32_t tile;
  PACKING_I_TRY(tile_for(p, c, &tile));
  for (;;) {
    PACKING_I_TRY(packing_i_lane_stock_up(p, lane));
    lane->starved = 0;
    if (packing_i_front_put(p, lane, tile, c, r, component))
      return packing_i_front_collect(p, lane, stored);
    p->halo_room *= 2;
    for (size_t l = 0; l < p->lanes; l++)
      PACKING_I_TRY(packing_i_lane_init(p, p->lane + l, p->halo_room));
  }
}

packing_status packing_i_front_enter_store(packing_i_pockets *p)
{
  const packing_particles *store = p->placer->particles;
  const size_t count = store->count;
  for (size_t i = 0; i < count; i++) {
    packing_vec3 c =
        packing_i_vec(store->x[i], store->y[i], p->dim == 2 ? 0 : store->z[i]);
    PACKING_I_TRY(put_one(p, &c, store->r[i], 0, i + 1));
  }
  return PACKING_OK;
}

/* ---- where nothing stands ---- */

packing_status packing_i_front_is_free(packing_i_pockets *p, const packing_vec3 *c,
                                       double r, int *free)
{
  packing_i_front_lane *lane = p->lane;
  uint32_t tile;
  PACKING_I_TRY(tile_for(p, c, &tile));
  packing_i_front_image image[PACKING_I_FRONT_IMAGES];
  packing_i_front_images(p, tile, c, image);
  lane->halo.count = 0;
  *free = packing_i_front_holds(p, c, r) &&
          packing_i_front_grid_gather(&p->grid, p->kernels, image[0].tile,
                                      &image[0].centre, r, p->body_r, &lane->halo);
  for (size_t t = 0; *free && t < lane->halo.count; t++) {
    const packing_vec3 d =
        packing_i_vec(lane->halo.x[t], lane->halo.y[t], lane->halo.z[t]);
    *free = packing_i_norm(d) >= r + lane->halo.r[t] - p->touch;
  }
  return PACKING_OK;
}

/* Takes a radius of the stock and puts it at c. */
static packing_status take_and_put(packing_i_pockets *p, const packing_vec3 *c,
                                   size_t zone, size_t index)
{
  double r;
  size_t component;
  packing_i_source_take(p->front.source, zone, index, &r, &component);
  return put_one(p, c, r, component, 0);
}

/* Their radii are those in the middle of the stock. */
packing_status packing_i_front_seed_group(packing_i_pockets *p, int *placed)
{
  const packing_vec3 middle = p->front.innermost;
  const size_t zone = packing_i_source_zone(p->front.source, &middle);
  const packing_i_stock *stock = packing_i_source_stock(p->front.source, zone);
  const size_t members = p->dim == 2 ? 3 : 4;
  *placed = 0;
  if (stock->count < members || (p->front.count != 0 && p->front.count < members))
    return PACKING_OK;
  size_t index[4];
  double r[4];
  packing_vec3 c[4];
  for (size_t n = 0; n < members; n++) {
    index[n] = stock->count / 2 - 2 + n;
    if (stock->count < 8)
      index[n] = n;
    r[n] = stock->r[index[n]];
  }
  c[0] = packing_i_vec(0, 0, 0);
  c[1] = packing_i_vec(r[0] + r[1], 0, 0);
  packing_i_front_body one = packing_i_front_sphere(c[1], r[1], r[0]),
                       two = packing_i_front_plane();
  packing_i_front_curve curve;
  if (!packing_i_front_curve_init(r[0], &one, &two, -1, &curve) ||
      !packing_i_front_curve_at(&curve, r[2], c + 2))
    return PACKING_OK;
  c[2] = packing_i_front_polish(r[0], &one, &two, r[2], c[2]);
  two = packing_i_front_sphere(c[2], r[2], r[0]);
  if (members == 4) {
    if (!packing_i_front_curve_init(r[0], &one, &two, 1, &curve) ||
        !packing_i_front_curve_at(&curve, r[3], c + 3))
      return PACKING_OK;
    c[3] = packing_i_front_polish(r[0], &one, &two, r[3], c[3]);
  }
  packing_vec3 mean = packing_i_vec(0, 0, 0);
  for (size_t n = 0; n < members; n++)
    mean = packing_i_add(mean, packing_i_scale(c[n], 1.0 / (double)members));
  double solid = 0;
  for (size_t n = 0; n < members; n++) {
    int free;
    c[n] = packing_i_add(middle, packing_i_sub(c[n], mean));
    PACKING_I_TRY(packing_i_front_is_free(p, c + n, r[n], &free));
    solid += packing_i_ball_volume(p->dim, r[n]);
    if (!free)
      return PACKING_OK;
  }
  if (p->front.solid_volume > 0 && solid > p->front.solid_volume)
    return PACKING_OK;
  for (int axis = 0; axis < 3; axis++) /* a group must not meet its own image */
    if ((p->periodic >> axis & 1U) && packing_i_component(p->period, axis) < 6 * p->max_r)
      return PACKING_OK;
  *placed = 1;
  for (size_t n = members; n-- > 0;) /* the highest index first: the stock closes up */
    PACKING_I_TRY(take_and_put(p, c + n, zone, index[n]));
  return PACKING_OK;
}

/* Unit vectors spread evenly over the sphere, in two dimensions the circle. */
static packing_vec3 direction(const packing_i_pockets *p, int n)
{
  const double golden = 2.39996322972865332;
  if (p->dim == 2)
    return packing_i_vec(cos(golden * n), sin(golden * n), 0);
  const double z = 1 - (2 * n + 1.0) / DIRECTIONS;
  const double rho = sqrt(1 - z * z);
  return packing_i_vec(rho * cos(golden * n), rho * sin(golden * n), z);
}

packing_status packing_i_front_seed_at(packing_i_pockets *p, const packing_vec3 *c,
                                       double r, size_t zone, size_t index, int *placed)
{
  int free;
  PACKING_I_TRY(packing_i_front_is_free(p, c, r, &free));
  if (!free)
    return PACKING_OK;
  *placed = 1;
  return take_and_put(p, c, zone, index);
}

/* One particle at the innermost point, or one that touches particle `touched` of the store. */
static packing_status start_one(packing_i_pockets *p, size_t touched, int *placed)
{
  const packing_particles *store = p->placer->particles;
  *placed = 0;
  for (int n = 0; n < (touched == SIZE_MAX ? 1 : DIRECTIONS) && !*placed; n++) {
    packing_vec3 c = p->front.innermost;
    size_t zone = packing_i_source_zone(p->front.source, &c);
    const packing_i_stock *stock = packing_i_source_stock(p->front.source, zone);
    if (stock->count == 0)
      return PACKING_OK;
    const size_t some[3] = {stock->count - 1, stock->count / 2, 0};
    for (int k = 0; k < 3 && !*placed; k++) {
      const double r = stock->r[some[k]];
      if (touched != SIZE_MAX) {
        const packing_vec3 from = packing_i_vec(store->x[touched], store->y[touched],
                                                p->dim == 2 ? 0 : store->z[touched]);
        c = packing_i_add(from, packing_i_scale(direction(p, n), store->r[touched] + r));
        if (packing_i_source_zone(p->front.source, &c) != zone)
          continue;
      }
      PACKING_I_TRY(packing_i_front_seed_at(p, &c, r, zone, some[k], placed));
    }
  }
  return PACKING_OK;
}

packing_status packing_i_front_seed_beside(packing_i_pockets *p)
{
  for (int n = 0; n < 8 && p->live_count == 0; n++) {
    int placed;
    if (p->front.count != 0 && p->placer->tally.placed >= p->front.count)
      break;
    PACKING_I_TRY(start_one(p, p->placer->particles->count - 1, &placed));
  }
  return PACKING_OK;
}

packing_status packing_i_front_seed(packing_i_pockets *p)
{
  const size_t stood = p->placer->particles->count;
  packing_i_front_search_begin(p, p->inward && stood == 0);
  int placed = 0;
  if (p->search.at_walls)
    return PACKING_OK;
  PACKING_I_TRY(packing_i_front_seed_group(p, &placed));
  if (!placed && stood == 0)
    PACKING_I_TRY(start_one(p, SIZE_MAX, &placed));
  return placed || stood > 0 ? packing_i_front_seed_beside(p) : PACKING_OK;
}
