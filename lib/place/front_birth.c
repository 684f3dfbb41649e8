/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pockets that come with a new sphere: those of its triples with two bodies near it.
 *
 * Which triples: those that a particle of the reference radius, somewhat below the mean, can touch
 * without overlapping anything. Their centres are found in vectors, tested against the widest
 * caps first, and the few that are left (six or seven of some eighty) get their interval of radii
 * from all bodies around.
 *
 * On curved walls the planes are moved to where the particle would be, and the triple is solved
 * again, until that changes nothing. */
#include "front_pockets.h"

/* The bodies that a particle of the reference radius can touch beside the sphere, widest cap
 * first. In two dimensions every triple has the plane: it comes before all. */
static void choose_caps(const packing_i_pockets *p, packing_i_front_lane *lane, double r,
                        size_t plane)
{
  packing_i_front_caps *caps = &lane->caps;
  const double bent = p->curved ? p->mean_r * p->mean_r * 0.1 : p->slack;
  p->kernels->caps(&lane->halo, plane, p->reference_r, r + p->reference_r, caps);
  for (size_t n = 0; n < caps->count; n++) {
    const int wall = (lane->halo.id[caps->halo[n]] & PACKING_I_FRONT_WALL) != 0;
    caps->room[n] = caps->top[n] + (wall ? bent : p->slack);
  }
}

/* ---- one candidate ---- */

typedef struct birth {
  packing_i_pockets *p;
  packing_i_front_lane *lane;
  uint32_t tile, place;
  packing_vec3 centre; /* of the sphere */
  double r;
} birth;

static packing_i_front_body halo_body(const packing_i_front_halo *halo, size_t t)
{
  const packing_i_front_body body = {packing_i_vec(halo->x[t], halo->y[t], halo->z[t]),
                                     halo->a[t], halo->b[t]};
  return body;
}

/* Moves wall bodies to the candidate c and solves again. 0: it runs away. */
static int settle_walls(const birth *b, uint32_t id[2], packing_i_front_body body[2],
                        int side, packing_i_front_curve *curve, packing_vec3 *c)
{
  const packing_i_pockets *p = b->p;
  for (int turn = 0; turn < 20; turn++) {
    for (int n = 0; n < 2; n++)
      if ((id[n] & PACKING_I_FRONT_WALL) &&
          !packing_i_front_wall_body(p, &b->centre, *c, p->reference_r, id + n, body + n))
        return 0;
    packing_vec3 moved;
    if (id[0] == id[1] ||
        !packing_i_front_curve_init(b->r, body, body + 1, side, curve) ||
        !packing_i_front_curve_at(curve, p->reference_r, &moved))
      return 0;
    const packing_vec3 step = packing_i_sub(moved, *c);
    *c = moved;
    if (packing_i_dot(step, step) <= p->mean_r * p->mean_r * 1e-20)
      return 1;
  }
  return 0;
}

/* Whether the pocket of a centre belongs here and not to a periodic image. */
static int in_cell(const packing_i_pockets *p, const packing_vec3 *c)
{
  const packing_bounds *b = &p->bounds;
  if ((p->periodic & PACKING_PERIODIC_X) && !(c->x >= b->lo.x && c->x < b->hi.x))
    return 0;
  if ((p->periodic & PACKING_PERIODIC_Y) && !(c->y >= b->lo.y && c->y < b->hi.y))
    return 0;
  return !(p->periodic & PACKING_PERIODIC_Z) || (c->z >= b->lo.z && c->z < b->hi.z);
}

/* Before, in or behind a tile, whose edge is 1. */
static int part_along(double x)
{
  return x < 0 ? 0 : x < 1 ? 1 : 2;
}

/* The tile of a point near a tile. */
static uint32_t tile_of(const packing_i_front_grid *grid, uint32_t tile,
                        const packing_vec3 *c)
{
  const packing_i_front_tile *t = grid->tile + tile;
  const double x = (c->x - t->lo.x) / grid->edge.x, y = (c->y - t->lo.y) / grid->edge.y,
               z = (c->z - t->lo.z) / grid->edge.z;
  return t->around[(part_along(z) * 3 + part_along(y)) * 3 + part_along(x)];
}

static void keep(const birth *b, const packing_i_pocket *pocket, uint32_t home)
{
  packing_i_pockets *p = b->p;
  packing_i_front_lane *lane = b->lane;
  if (lane->free_pockets == 0 ||
      (home != lane->at_work && lane->outbox_count == lane->outbox_room))
    return;
  const uint32_t id = lane->free_pocket;
  packing_i_pocket *q = packing_i_pocket_at(p, id);
  const uint32_t version = q->version;
  lane->free_pocket = q->next;
  lane->free_pockets--;
  *q = *pocket;
  q->version = version;
  q->home = home;
  unsigned k;
  packing_i_front_bin *bin = packing_i_front_bin_of(&p->grid, b->place, &k);
  q->next = bin->pockets[k];
  bin->pockets[k] = id;
  if (home != lane->at_work) {
    lane->outbox[lane->outbox_count++] = id;
    return;
  }
  packing_i_front_tile *tile = p->grid.tile + home;
  q->home_next = tile->pockets;
  tile->pockets = id;
  if (!(q->key < p->level) && q->key < tile->next_key)
    tile->next_key = q->key;
  packing_i_pocket_offer(p, lane, id);
}

/* The walls at the end of a halo, set aside. */
typedef struct walls_aside {
  double column[6][PACKING_I_NEAR_WALLS];
  uint32_t id[PACKING_I_NEAR_WALLS];
} walls_aside;

/* Copies the bodies from `first` on out of the halo, or back into it. */
static void set_aside(packing_i_front_halo *halo, size_t first, walls_aside *aside,
                      int back)
{
  double *column[6] = {halo->x, halo->y, halo->z, halo->a, halo->b, halo->r};
  for (size_t n = 0; first + n < halo->count; n++) {
    for (int f = 0; f < 6; f++) {
      double *in = column[f] + first + n, *out = aside->column[f] + n;
      *(back ? in : out) = back ? *out : *in;
    }
    uint32_t *in = halo->id + first + n, *out = aside->id + n;
    *(back ? in : out) = back ? *out : *in;
  }
}

/* The interval on a curve beside curved walls: in the place of the halo's walls, which are those
 * near the sphere, come those near the candidate c. */
static void interval_at_walls(const birth *b, const packing_i_front_curve *curve,
                              const size_t own[2], const uint32_t id[2], packing_vec3 c,
                              double start, double most,
                              packing_i_front_interval *interval)
{
  const packing_i_pockets *p = b->p;
  packing_i_front_halo *halo = &b->lane->halo;
  size_t spheres = halo->count;
  while (spheres > 0 && packing_i_front_is_wall(halo->id[spheres - 1]))
    spheres--;
  walls_aside aside;
  set_aside(halo, spheres, &aside, 0);
  packing_i_front_halo walls = *halo;
  walls.count = spheres;
  packing_i_front_walls_gather(p, &b->centre, c, 2 * most, &walls);
  size_t mine[2];
  for (int n = 0; n < 2; n++) {
    mine[n] = own[n] < spheres ? own[n] : walls.count;
    for (size_t t = spheres; t < walls.count; t++)
      if (walls.id[t] == id[n])
        mine[n] = t;
  }
  p->kernels->interval(curve, &walls, mine[0], mine[1], start, p->cap * most, p->slack,
                       interval);
  set_aside(halo, spheres, &aside, 1);
}

/* The interval of radii on a curve; 0: none fits. */
static int find_interval(const birth *b, const packing_i_front_curve *curve,
                         const size_t own[2], const uint32_t id[2], packing_vec3 c,
                         double most, packing_i_front_interval *interval)
{
  const packing_i_pockets *p = b->p;
  const packing_i_front_halo *halo = &b->lane->halo;
  const double start = packing_i_front_curve_start(curve, p->min_r);
  const double seen = packing_i_front_most(p, b->r);
  if (!(start <= most))
    return 0;
  if (p->curved && halo->count > 0 && packing_i_front_is_wall(halo->id[halo->count - 1]))
    interval_at_walls(b, curve, own, id, c, start, most, interval);
  else
    p->kernels->interval(curve, halo, own[0], own[1], start, p->cap * most, p->slack,
                         interval);
  for (int e = 0; e < 3 && most > seen; e++)
    if (interval->exit[e] > seen) /* not all of what could be met was looked at */
      interval->exit[e] = HUGE_VAL;
  interval->exit[0] = fmin(interval->exit[0], p->most_r);
  return interval->exit[0] >= interval->lo && interval->exit[0] >= p->min_r &&
         interval->lo <= most;
}

/* The radius of a body; a wall has none. */
static double radius_of(const packing_i_front_halo *halo, size_t t)
{
  return (halo->id[t] & PACKING_I_FRONT_WALL) ? 0 : halo->r[t];
}

static void try_candidate(const birth *b, size_t n)
{
  packing_i_pockets *p = b->p;
  packing_i_front_lane *lane = b->lane;
  const packing_i_front_halo *halo = &lane->halo;
  const uint32_t pair = lane->candidates.pair[n];
  const size_t own[2] = {lane->caps.halo[pair >> 16],
                         lane->caps.halo[(pair & 0xffff) >> 1]};
  uint32_t id[2] = {halo->id[own[0]], halo->id[own[1]]};
  const int walls = ((id[0] | id[1]) & PACKING_I_FRONT_WALL) != 0;
  packing_i_front_body body[2] = {halo_body(halo, own[0]), halo_body(halo, own[1])};
  packing_vec3 c =
      packing_i_vec(lane->candidates.x[n], lane->candidates.y[n], lane->candidates.z[n]);
  packing_i_pocket pocket;
  memset(&pocket, 0, sizeof pocket);
  pocket.side = (pair & 1) ? -1 : 1;
  if (walls && p->curved) {
    if (!settle_walls(b, id, body, pocket.side, &pocket.curve, &c))
      return;
  } else if (!packing_i_front_curve_init(b->r, body, body + 1, pocket.side,
                                         &pocket.curve)) {
    return;
  }
  const packing_vec3 at = packing_i_add(b->centre, c);
  if (!in_cell(p, &at))
    return;
  packing_i_front_interval interval;
  const double most = packing_i_front_most(
      p, fmax(b->r, fmax(radius_of(halo, own[0]), radius_of(halo, own[1]))));
  pocket.most = (float)(most * p->per_unit * (1 + 1e-7)); /* not rounded down */
  if (!find_interval(b, &pocket.curve, own, id, c, most, &interval))
    return;
  pocket.lo = interval.lo;
  memcpy(pocket.exit, interval.exit, sizeof pocket.exit);
  pocket.key = packing_i_front_key(p, &at);
  pocket.owner = b->place;
  pocket.j = id[0];
  pocket.k = id[1];
  pocket.alive = 1;
  pocket.zone = (uint16_t)packing_i_source_zone(lane->source, &at);
  pocket.walls = (uint8_t)packing_i_front_is_wall(halo->id[halo->count - 1]);
  packing_i_pocket_measure(p, &pocket);
  keep(b, &pocket, tile_of(&p->grid, b->tile, &at));
}

/* Where only so many pockets of a sphere are wanted: brings the candidates that are lowest in the
 * order of growth to the front. Returns how many to try. At walls all are: the way on may be
 * narrow. */
static size_t keep_lowest(const birth *b)
{
  packing_i_front_candidates *c = &b->lane->candidates;
  const size_t wanted = b->p->litter;
  const packing_i_front_halo *halo = &b->lane->halo;
  if (c->count <= wanted || packing_i_front_is_wall(halo->id[halo->count - 1]))
    return c->count;
  double *key = b->lane->curves.room; /* not in use here */
  const size_t count = c->count < b->lane->curve_room ? c->count : b->lane->curve_room;
  for (size_t n = 0; n < count; n++) {
    const packing_vec3 at =
        packing_i_add(b->centre, packing_i_vec(c->x[n], c->y[n], c->z[n]));
    key[n] = packing_i_front_key(b->p, &at);
  }
  for (size_t n = 0; n < wanted; n++) {
    size_t least = n;
    for (size_t m = n + 1; m < count; m++)
      if (key[m] < key[least])
        least = m;
    const double k = key[n], x = c->x[n], y = c->y[n], z = c->z[n];
    const uint32_t pair = c->pair[n];
    key[n] = key[least];
    c->x[n] = c->x[least];
    c->y[n] = c->y[least];
    c->z[n] = c->z[least];
    c->pair[n] = c->pair[least];
    key[least] = k;
    c->x[least] = x;
    c->y[least] = y;
    c->z[least] = z;
    c->pair[least] = pair;
  }
  return wanted;
}

void packing_i_pockets_born(packing_i_pockets *p, packing_i_front_lane *lane,
                            uint32_t tile, uint32_t place, const packing_vec3 *centre,
                            double r)
{
  const birth b = {p, lane, tile, place, *centre, r};
  packing_i_front_halo *halo = &lane->halo;
  packing_i_front_candidates *candidates = &lane->candidates;
  const packing_vec3 zero = packing_i_vec(0, 0, 0);
  size_t at_plane = PACKING_I_FRONT_NO_BODY;
  p->kernels->bodies(halo, halo->count, r);
  if (p->dim == 2) {
    const packing_i_front_body plane = packing_i_front_plane();
    const size_t n = halo->count++;
    at_plane = n;
    halo->x[n] = halo->y[n] = 0;
    halo->z[n] = p->mean_r;
    halo->a[n] = plane.a;
    halo->b[n] = plane.b;
    halo->r[n] = HUGE_VAL;
    halo->id[n] = PACKING_I_FRONT_WALL | PACKING_I_FRONT_PLANE;
  }
  if (!p->grid.tile[tile].clear)
    packing_i_front_walls_gather(p, centre, zero, r + 2 * packing_i_front_most(p, r),
                                 halo);
  choose_caps(p, lane, r, at_plane);
  candidates->count = 0;
  p->kernels->pairs(&lane->caps, p->dim == 2 ? 1 : lane->caps.count, r + p->reference_r,
                    candidates);
  p->kernels->sieve(&lane->caps, candidates);
  const size_t kept = keep_lowest(&b);
  for (size_t n = 0; n < kept; n++)
    try_candidate(&b, n);
}
