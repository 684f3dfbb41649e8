/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the pocket front begins: with what stands in the store, else with particles at the
 * innermost point (seed paper, section 3.2): three discs, four spheres, tangent to one another,
 * the mean of their centres there; inward, beside a wall. Where they find no room, in thin
 * containers or between what stands, one particle is placed and then such that touch another, until
 * walls and particles make pockets; and where the pockets come to their end, it is tried once more
 * whether some particle finds a place beside another. */
#include "front_pockets.h"

enum {
  DIRECTIONS = 128,
  FIRST_TRIES = 8, /* particles in a row before there are pockets */
  LAST_TRIES = 8,  /* particles in a row that nothing fits beside */
  MARCH = 64,
  SLIDE = 12
};

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
  if (*tile == p->ready)
    return PACKING_OK;
  PACKING_I_TRY(packing_i_front_prepare(p, *tile));
  p->ready = *tile;
  return PACKING_OK;
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
    if (packing_i_front_put(p, lane, tile, c, r, component)) {
      p->owed = 1;
      PACKING_I_TRY(packing_i_front_collect(p, lane, stored));
      p->owed = 0;
      return PACKING_OK;
    }
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
  *free = r <= p->most_r && packing_i_front_holds(p, c, r);
  if (!*free)
    return PACKING_OK;
  PACKING_I_TRY(tile_for(p, c, &tile));
  packing_i_front_image image[PACKING_I_FRONT_IMAGES];
  packing_i_front_images(p, tile, c, image);
  lane->halo.count = 0;
  *free = packing_i_front_grid_gather(&p->grid, p->kernels, image[0].tile,
                                      &image[0].centre, r, p->body_r, &lane->halo);
  for (size_t t = 0; *free && t < lane->halo.count; t++) {
    const packing_vec3 d =
        packing_i_vec(lane->halo.x[t], lane->halo.y[t], lane->halo.z[t]);
    *free = packing_i_norm(d) >= r + lane->halo.r[t] - p->touch;
  }
  return PACKING_OK;
}

/* Takes a radius that the stock holds and puts it at c. Its place in the stock is looked for:
 * whatever was taken before has moved it. */
static packing_status take_and_put(packing_i_pockets *p, const packing_vec3 *c,
                                   size_t zone, double r)
{
  const packing_i_stock *stock = packing_i_source_stock(p->front.source, zone);
  double taken;
  size_t component;
  uint32_t tile;
  PACKING_I_TRY(tile_for(p, c, &tile)); /* what can fail, before the radius is gone */
  PACKING_I_TRY(packing_i_lane_stock_up(p, p->lane));
  packing_i_source_take(p->front.source, zone, packing_i_stock_below(stock, r) - 1,
                        &taken, &component);
  return put_one(p, c, taken, component, 0);
}

/* ---- places to begin ---- */

/* Unit vectors spread evenly over the sphere, in two dimensions the circle: steps of the golden
 * angle about the axis, by its cosine and sine. */
static packing_vec3 direction(const packing_i_pockets *p, int n)
{
  const double cosine = -0.73736887807831985597, sine = 0.67549029426152362721;
  double x = 1, y = 0;
  for (int k = 0; k < n; k++) {
    const double next = x * cosine - y * sine;
    y = x * sine + y * cosine;
    x = next;
  }
  if (p->dim == 2)
    return packing_i_vec(x, y, 0);
  const double z = 1 - (2 * n + 1.0) / DIRECTIONS;
  const double rho = sqrt(1 - z * z);
  return packing_i_vec(rho * x, rho * y, z);
}

/* The point at which a ball of this radius that leaves the innermost point in a direction touches a
 * wall. 0: it does not come there, or starts in one. */
static int march(const packing_i_pockets *p, packing_vec3 along, double radius,
                 packing_vec3 *c)
{
  *c = p->front.innermost;
  for (int turn = 0; turn < MARCH; turn++) {
    const double gap = packing_domain_signed_distance(p->domain, c, NULL) - radius;
    if (!(gap >= -p->touch && gap < HUGE_VAL))
      return 0;
    if (gap <= 1e-6 * radius)
      return 1;
    *c = packing_i_add(*c, packing_i_scale(along, gap));
  }
  return 0;
}

/* Moves a ball that touches the one at `from` (so far away) out of the walls, and back in touch,
 * until it needs no more. 0: it cannot. */
static int slide(const packing_i_pockets *p, const packing_vec3 *from, double away,
                 double r, packing_vec3 *c)
{
  for (int turn = 0; turn < SLIDE; turn++) {
    packing_i_near_wall near[PACKING_I_NEAR_WALLS];
    const int walls = packing_i_domain_near_walls(p->domain, c, r, near);
    int moved = 0;
    for (int n = 0; n < walls; n++) {
      const double depth = r - near[n].distance;
      if (!(depth > 0.5 * p->touch))
        continue;
      *c = packing_i_add(*c, packing_i_scale(near[n].normal, depth));
      moved = 1;
    }
    if (!moved)
      return 1;
    const packing_vec3 d = packing_i_sub(*c, *from);
    const double distance = packing_i_norm(d);
    if (!(distance > 0))
      return 0;
    *c = packing_i_add(*from, packing_i_scale(d, away / distance));
  }
  return 0;
}

/* ---- the group ---- */

/* Centres of three discs or four spheres that touch one another, about their mean. 0: there are
 * none. */
static int group(const double r[4], size_t members, packing_vec3 c[4])
{
  c[0] = packing_i_vec(0, 0, 0);
  c[1] = packing_i_vec(r[0] + r[1], 0, 0);
  packing_i_front_body one = packing_i_front_sphere(c[1], r[1], r[0]),
                       two = packing_i_front_plane();
  packing_i_front_curve curve;
  if (!packing_i_front_curve_init(r[0], &one, &two, -1, &curve) ||
      !packing_i_front_curve_at(&curve, r[2], c + 2))
    return 0;
  c[2] = packing_i_front_polish(r[0], &one, &two, r[2], c[2]);
  if (members == 4) {
    two = packing_i_front_sphere(c[2], r[2], r[0]);
    if (!packing_i_front_curve_init(r[0], &one, &two, 1, &curve) ||
        !packing_i_front_curve_at(&curve, r[3], c + 3))
      return 0;
    c[3] = packing_i_front_polish(r[0], &one, &two, r[3], c[3]);
  }
  packing_vec3 mean = packing_i_vec(0, 0, 0);
  for (size_t n = 0; n < members; n++)
    mean = packing_i_add(mean, packing_i_scale(c[n], 1.0 / (double)members));
  for (size_t n = 0; n < members; n++)
    c[n] = packing_i_sub(c[n], mean);
  return 1;
}

/* Whether the goals leave room for so many particles, the first of which is the last to be put, and
 * the cell for them beside their own images. */
static int group_wanted(const packing_i_pockets *p, const double r[4], size_t members)
{
  const packing_placer_report *tally = &p->placer->tally;
  double solid = tally->solid_volume - 0.5 * packing_i_ball_volume(p->dim, r[0]);
  for (size_t n = 0; n < members; n++)
    solid += packing_i_ball_volume(p->dim, r[n]);
  if (p->front.solid_volume > 0 && solid > p->front.solid_volume)
    return 0;
  for (int axis = 0; axis < 3; axis++)
    if ((p->periodic >> axis & 1U) && packing_i_component(p->period, axis) < 6 * p->max_r)
      return 0;
  return p->front.count == 0 || p->front.count - tally->placed >= members;
}

/* The group with its mean at `middle`. *placed tells whether it found room. */
static packing_status group_at(packing_i_pockets *p, const packing_vec3 *middle,
                               const double r[4], size_t members,
                               const packing_vec3 about[4], int *placed)
{
  const size_t zone = packing_i_source_zone(p->front.source, middle);
  packing_vec3 c[4];
  for (size_t n = 0; n < members; n++) {
    int free;
    c[n] = packing_i_add(*middle, about[n]);
    PACKING_I_TRY(packing_i_front_is_free(p, c + n, r[n], &free));
    if (!free || packing_i_source_zone(p->front.source, c + n) != zone)
      return PACKING_OK;
  }
  *placed = 1;
  for (size_t n = members; n-- > 0;)
    PACKING_I_TRY(take_and_put(p, c + n, zone, r[n]));
  return PACKING_OK;
}

/* Three discs or four spheres at the innermost point, inward at a wall, of the radii in the middle
 * of the stock, turned at random: of equal sizes nothing else differs by the seed. *placed tells
 * whether they found room. */
packing_status packing_i_front_seed_group(packing_i_pockets *p, int *placed)
{
  packing_vec3 middle = p->front.innermost, about[4];
  const size_t zone = packing_i_source_zone(p->front.source, &middle);
  const packing_i_stock *stock = packing_i_source_stock(p->front.source, zone);
  const size_t members = p->dim == 2 ? 3 : 4;
  double r[4], reach = 0;
  *placed = 0;
  if (stock->count < members)
    return PACKING_OK;
  const size_t first = stock->count < 8 ? 0 : stock->count / 2 - 2;
  memcpy(r, stock->r + first, members * sizeof *r);
  if (!group_wanted(p, r, members) || !group(r, members, about))
    return PACKING_OK;
  packing_i_front_turn_points(&p->turns, p->dim, about, members);
  for (size_t n = 0; n < members; n++)
    reach = fmax(reach, packing_i_norm(about[n]) + r[n]);
  for (int n = 0; p->inward && n < DIRECTIONS && !*placed; n++)
    if (march(p, direction(p, n), reach, &middle) &&
        packing_i_source_zone(p->front.source, &middle) == zone)
      PACKING_I_TRY(group_at(p, &middle, r, members, about, placed));
  if (*placed)
    return PACKING_OK;
  middle = p->front.innermost;
  return group_at(p, &middle, r, members, about, placed);
}

/* ---- one by one ---- */

/* The place of the n-th direction for a particle of radius r: in touch with particle `touched` of the
 * store; with SIZE_MAX: at a wall, at last the innermost point. 0: none. */
static int place_of(const packing_i_pockets *p, size_t touched, int n, double r,
                    packing_vec3 *c)
{
  const packing_particles *store = p->placer->particles;
  const packing_vec3 along = direction(p, n);
  if (touched == SIZE_MAX) {
    if (n + 1 < DIRECTIONS)
      return march(p, along, r, c);
    *c = p->front.innermost;
    return 1;
  }
  const packing_vec3 from = packing_i_vec(store->x[touched], store->y[touched],
                                          p->dim == 2 ? 0 : store->z[touched]);
  const double away = store->r[touched] + r;
  *c = packing_i_add(from, packing_i_scale(along, away));
  return slide(p, &from, away, r, c);
}

/* Radius k of three, the smallest, a middle one and the largest, of the stock of a zone, and its place
 * from a direction; *zone is that of the place, which may be another and have other sizes. 0: none. */
static int candidate(packing_i_pockets *p, size_t touched, int n, int k, size_t *zone,
                     double *r, packing_vec3 *c)
{
  for (int turn = 0; turn < 2; turn++) {
    const packing_i_stock *stock = packing_i_source_stock(p->front.source, *zone);
    if (stock->count == 0)
      return 0;
    *r = stock->r[(stock->count - 1) * (size_t)k / 2];
    if (!place_of(p, touched, n, *r, c))
      return 0;
    const size_t there = packing_i_source_zone(p->front.source, c);
    if (there == *zone)
      return packing_i_front_wants(&p->front, &p->placer->tally,
                                   packing_i_ball_volume(p->dim, *r));
    *zone = there;
  }
  return 0;
}

/* One particle, as large as may be, from direction `from` on. */
static packing_status place_one(packing_i_pockets *p, size_t touched, int from,
                                int *placed)
{
  const size_t zone_here = packing_i_source_zone(p->front.source, &p->front.innermost);
  *placed = 0;
  for (int n = 0; n < DIRECTIONS; n++)
    for (int k = 2; k >= (p->equal ? 2 : 0); k--) {
      packing_vec3 c;
      size_t zone = zone_here;
      double r;
      int free;
      if (!candidate(p, touched, (n + from) % DIRECTIONS, k, &zone, &r, &c))
        continue;
      PACKING_I_TRY(packing_i_front_is_free(p, &c, r, &free));
      if (!free)
        continue;
      *placed = 1;
      return take_and_put(p, &c, zone, r);
    }
  return PACKING_OK;
}

packing_status packing_i_front_seed_at(packing_i_pockets *p, const packing_vec3 *c,
                                       double r, size_t zone, int *placed)
{
  int free;
  PACKING_I_TRY(packing_i_front_is_free(p, c, r, &free));
  if (!free)
    return PACKING_OK;
  *placed = 1;
  return take_and_put(p, c, zone, r);
}

packing_status packing_i_front_seed_beside(packing_i_pockets *p)
{
  const packing_particles *store = p->placer->particles;
  int placed = 1;
  for (int n = 1; n < FIRST_TRIES && placed && p->live_count == 0 && store->count > 0;
       n++)
    PACKING_I_TRY(place_one(p, store->count - 1, 41 * n, &placed));
  return PACKING_OK;
}

packing_status packing_i_front_seed(packing_i_pockets *p)
{
  const size_t stood = p->placer->particles->count;
  int placed = 0;
  packing_i_front_search_begin(p, p->inward && stood == 0);
  PACKING_I_TRY(packing_i_front_seed_group(p, &placed));
  if (!placed && stood == 0)
    PACKING_I_TRY(place_one(p, SIZE_MAX, 0, &placed));
  return packing_i_front_seed_beside(p);
}

packing_status packing_i_front_reseed(packing_i_pockets *p, int *go_on)
{
  const size_t count = p->placer->particles->count;
  int placed = 0;
  *go_on = 0;
  if (count == 0 || (p->reseeds >= LAST_TRIES && p->placer->tally.placed > 0))
    return PACKING_OK;
  /* The youngest, then all from the oldest on. */
  const int youngest = p->youngest != count;
  if (!youngest && p->oldest >= count)
    return PACKING_OK;
  PACKING_I_TRY(place_one(p, youngest ? count - 1 : p->oldest,
                          (int)(41 * (count % DIRECTIONS)), &placed));
  *go_on = 1;
  if (youngest)
    p->youngest = count;
  else if (!placed)
    p->oldest++;
  p->reseeds = placed ? 0 : p->reseeds + 1;
  return PACKING_OK;
}
