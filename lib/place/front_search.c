/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the front did not come: other chambers of the container, walls that an inward front has not
 * met. When the front has ended (an inward one: when the layer at the walls it began with has), the
 * container is gone through tile by tile; in each cell of a tile in which no particle stands a few
 * points are moved off the walls and tried, and where a particle has room the front begins anew.
 * What is full stays full, so one walk does for all chambers.
 *
 * The bounds are halved down to tiles, parts that the container does not reach are left out.
 * Memory: the stack of that. Cost: a look at each particle, and some distances. */
#include "front_pockets.h"

enum {
  TILES_A_ROUND = 4,
  POINTS = 3, /* along each edge of a cell */
  MOVES = 4,
  CLIMB = 64
};

/* What is looked into. */
typedef struct spot {
  packing_i_pockets *p;
  uint32_t tile; /* 0: not made */
  unsigned char taken[PACKING_I_TILE_MOST * PACKING_I_TILE_MOST * PACKING_I_TILE_MOST];
} spot;

void packing_i_front_search_begin(packing_i_pockets *p, int at_walls)
{
  packing_i_front_search *s = &p->search;
  packing_i_front_block *root = s->block;
  packing_i_front_grid_at(&p->grid, &p->bounds.lo, s->first);
  packing_i_front_grid_at(&p->grid, &p->bounds.hi, s->last);
  memcpy(root->at, s->first, sizeof root->at);
  root->level = 0;
  for (int axis = 0; axis < 3; axis++)
    while (root->level < PACKING_I_SEARCH_LEVELS &&
           (INT64_C(1) << root->level) <= s->last[axis] - s->first[axis])
      root->level++;
  s->blocks = 1;
  s->cell = 0;
  s->at_walls = at_walls;
}

/* Whether a point is farther than that from a periodic cell: what stands there stands in it too. */
static int is_beyond(const packing_i_pockets *p, const packing_vec3 *c, double far)
{
  for (int axis = 0; axis < 3; axis++)
    if ((p->periodic >> axis & 1U) &&
        (packing_i_component(*c, axis) + far < packing_i_component(p->bounds.lo, axis) ||
         packing_i_component(*c, axis) - far > packing_i_component(p->bounds.hi, axis)))
      return 1;
  return 0;
}

/* Whether a box about c, of that half diagonal, can hold a place to look for. */
static int has_places(const packing_i_pockets *p, packing_vec3 c, double half)
{
  if (is_beyond(p, &c, half))
    return 0;
  if (p->search.at_walls && packing_i_domain_clear(p->domain, &c, p->max_r + half))
    return 0;
  const double least = p->min_r - half;
  return packing_i_domain_clear(p->domain, &c, least) ||
         packing_domain_signed_distance(p->domain, &c, NULL) >= least;
}

static double half_diagonal(const packing_i_pockets *p, packing_vec3 edge)
{
  return 0.5 * (p->dim == 2 ? hypot(edge.x, edge.y) : packing_i_norm(edge));
}

static packing_vec3 corner_of(const packing_i_pockets *p, const int64_t at[3])
{
  const packing_i_front_grid *g = &p->grid;
  return packing_i_vec(g->origin.x + (double)at[0] * g->edge.x,
                       g->origin.y + (double)at[1] * g->edge.y,
                       g->origin.z + (double)at[2] * g->edge.z);
}

static packing_vec3 middle_of(const packing_i_pockets *p, packing_vec3 lo,
                              packing_vec3 edge)
{
  packing_vec3 c = packing_i_add(lo, packing_i_scale(edge, 0.5));
  if (p->dim == 2)
    c.z = 0;
  return c;
}

/* Whether a block of tiles is worth a look. */
static int is_worth(const packing_i_pockets *p, const packing_i_front_block *block)
{
  for (int axis = 0; axis < 3; axis++)
    if (block->at[axis] > p->search.last[axis])
      return 0;
  const packing_vec3 edge =
      packing_i_scale(p->grid.edge, (double)(INT64_C(1) << block->level));
  return has_places(p, middle_of(p, corner_of(p, block->at), edge),
                    half_diagonal(p, edge));
}

/* Puts the eight parts of the last block in its place, the lowest on top. */
static void divide(packing_i_front_search *s)
{
  const packing_i_front_block whole = s->block[--s->blocks];
  const int64_t half = INT64_C(1) << (whole.level - 1);
  for (int part = 7; part >= 0; part--) {
    packing_i_front_block *b = s->block + s->blocks++;
    b->level = whole.level - 1;
    for (int axis = 0; axis < 3; axis++)
      b->at[axis] = whole.at[axis] + (part >> axis & 1 ? half : 0);
  }
}

/* ---- in a tile ---- */

static int along(double x, double lo, double per, int cells)
{
  const int n = (int)((x - lo) * per);
  return n < 0 ? 0 : n < cells ? n : cells - 1;
}

static uint32_t first_list(const spot *s)
{
  return s->tile == 0 ? 0 : s->p->grid.tile[s->tile].list;
}

/* Marks the cells in which particles stand. */
static void mark(spot *s, packing_vec3 lo)
{
  const packing_i_front_grid *grid = &s->p->grid;
  const packing_particles *store = s->p->placer->particles;
  const packing_vec3 per = grid->per_edge;
  memset(s->taken, 0, sizeof s->taken);
  for (uint32_t l = first_list(s); l != 0; l = grid->list[l].next)
    for (uint32_t n = 0; n < grid->list[l].count; n++) {
      const uint32_t i = grid->list[l].index[n];
      const double z = store->dim == 2 ? 0 : store->z[i];
      const int x = along(store->x[i], lo.x, per.x, grid->n[0]),
                y = along(store->y[i], lo.y, per.y, grid->n[1]),
                w = along(z, lo.z, per.z, grid->n[2]);
      s->taken[(w * grid->n[1] + y) * grid->n[0] + x] = 1;
    }
}

/* Whether a sphere meets a particle of the tile: most places fall here, without the cells. */
static int meets(const spot *s, const packing_vec3 *c, double r)
{
  const packing_i_front_grid *grid = &s->p->grid;
  const packing_particles *store = s->p->placer->particles;
  for (uint32_t l = first_list(s); l != 0; l = grid->list[l].next)
    for (uint32_t n = 0; n < grid->list[l].count; n++) {
      const uint32_t i = grid->list[l].index[n];
      const double x = store->x[i] - c->x, y = store->y[i] - c->y,
                   z = store->dim == 2 ? 0 : store->z[i] - c->z,
                   least = r + store->r[i] - s->p->touch;
      if (x * x + y * y + z * z < least * least)
        return 1;
    }
  return 0;
}

/* Moves a point to where a sphere of radius r keeps off the walls, or touches them; 0: it is
 * not near. */
static int move_off(const packing_i_pockets *p, double r, double half, packing_vec3 *c)
{
  const packing_vec3 from = *c;
  for (int n = 0; n < MOVES; n++) {
    packing_vec3 normal;
    const double d = packing_domain_signed_distance(p->domain, c, &normal);
    if (!p->search.at_walls && d >= r)
      break;
    if (!packing_i_vec_finite(normal) || !isfinite(d))
      return 0;
    *c = packing_i_add(*c, packing_i_scale(normal, r - d));
    if (packing_i_norm(packing_i_sub(*c, from)) > half + r)
      return 0;
  }
  return packing_i_front_holds(p, c, r);
}

/* Goes from the walls as far as it goes: the middle of the chamber. */
static packing_vec3 climb(const packing_i_pockets *p, packing_vec3 c)
{
  packing_vec3 normal;
  double d = packing_domain_signed_distance(p->domain, &c, &normal);
  double step = 2 * p->max_r;
  for (int n = 0; n < CLIMB && packing_i_vec_finite(normal); n++) {
    packing_vec3 other;
    const packing_vec3 at = packing_i_add(c, packing_i_scale(normal, step));
    const double there = packing_domain_signed_distance(p->domain, &at, &other);
    if (there > d && packing_i_front_holds(p, &at, p->max_r)) {
      d = there;
      c = at;
      normal = other;
    } else {
      step *= 0.5;
    }
  }
  return c;
}

static packing_status begin_there(packing_i_pockets *p, packing_vec3 c, double r,
                                  size_t zone, int *placed)
{
  int free;
  PACKING_I_TRY(packing_i_front_is_free(p, &c, r, &free));
  if (!free)
    return PACKING_OK;
  if (p->inward) {
    if (p->placer->tally.placed == 0)
      packing_i_front_move_to_corner(p->domain, p->touch, r, &c);
  } else {
    const packing_vec3 before = p->front.innermost;
    p->front.innermost = climb(p, c);
    PACKING_I_TRY(packing_i_front_seed_group(p, placed));
    if (*placed)
      return PACKING_OK;
    p->front.innermost = before;
  }
  PACKING_I_TRY(packing_i_front_seed_at(p, &c, r, zone, placed));
  if (*placed && !p->inward)
    p->front.innermost = c;
  return PACKING_OK;
}

/* Begins anew at c if a particle of radius r has room there. Refused memory leaves no trace: the
 * step may be repeated. */
static packing_status begin_at(packing_i_pockets *p, packing_vec3 c, double r,
                               size_t zone, int *placed)
{
  const packing_i_stream turns = p->turns;
  const packing_vec3 innermost = p->front.innermost;
  const packing_status status = begin_there(p, c, r, zone, placed);
  if (status != PACKING_OK) {
    p->turns = turns;
    p->front.innermost = innermost;
  }
  return status;
}

static packing_status try_point(spot *s, packing_vec3 point, double half, int *placed)
{
  packing_i_pockets *p = s->p;
  const size_t zone = packing_i_source_zone(p->front.source, &point);
  const packing_i_stock *stock = packing_i_source_stock(p->front.source, zone);
  const size_t some[2] = {stock->count / 2, 0};
  for (int k = 0; k < 2 && stock->count > 0 && !*placed; k++) {
    const double r = stock->r[some[k]];
    packing_vec3 c = point;
    if (!packing_i_front_wants(&p->front, &p->placer->tally,
                               packing_i_ball_volume(p->dim, r)) ||
        !move_off(p, r, half, &c) || meets(s, &c, r) ||
        packing_i_source_zone(p->front.source, &c) != zone)
      continue;
    PACKING_I_TRY(begin_at(p, c, r, zone, placed));
  }
  return PACKING_OK;
}

static packing_status try_cell(spot *s, packing_vec3 lo, packing_vec3 edge, int *placed)
{
  packing_i_pockets *p = s->p;
  const packing_vec3 part = packing_i_scale(edge, 1.0 / POINTS);
  const double half = half_diagonal(p, part);
  const int deep = p->dim == 2 ? 1 : POINTS;
  for (int z = 0; z < deep; z++)
    for (int y = 0; y < POINTS; y++)
      for (int x = 0; x < POINTS && !*placed; x++) {
        const packing_vec3 at =
            packing_i_vec(lo.x + x * part.x, lo.y + y * part.y, lo.z + z * part.z);
        const packing_vec3 c = middle_of(p, at, part);
        if (has_places(p, c, half))
          PACKING_I_TRY(try_point(s, c, half, placed));
      }
  return PACKING_OK;
}

static packing_vec3 cell_edge(const packing_i_front_grid *g)
{
  return packing_i_vec(g->edge.x / g->n[0], g->edge.y / g->n[1], g->edge.z / g->n[2]);
}

/* Goes on in the tile on top of the stack. */
static packing_status try_tile(packing_i_pockets *p, int *placed)
{
  const packing_i_front_block *block = p->search.block + p->search.blocks - 1;
  const packing_vec3 lo = corner_of(p, block->at), edge = cell_edge(&p->grid);
  const double half = half_diagonal(p, edge);
  spot s;
  s.p = p;
  s.tile = packing_i_front_tile_find(&p->grid, block->at);
  mark(&s, lo);
  const int *cells = p->grid.n;
  while (p->search.cell < cells[0] * cells[1] * cells[2] && !*placed) {
    const int n = p->search.cell;
    const int x = n % cells[0], y = n / cells[0] % cells[1],
              z = n / (cells[0] * cells[1]);
    const packing_vec3 at =
        packing_i_vec(lo.x + x * edge.x, lo.y + y * edge.y, lo.z + z * edge.z);
    if (!s.taken[n] && has_places(p, middle_of(p, at, edge), half))
      PACKING_I_TRY(try_cell(&s, at, edge, placed));
    if (!*placed)
      p->search.cell++;
  }
  return PACKING_OK;
}

packing_status packing_i_front_search_on(packing_i_pockets *p, int *placed)
{
  packing_i_front_search *s = &p->search;
  *placed = 0;
  for (int n = 0; n < TILES_A_ROUND && s->blocks > 0; n++) {
    const packing_i_front_block *top = s->block + s->blocks - 1;
    if (s->cell == 0 && !is_worth(p, top)) {
      s->blocks--;
      continue;
    }
    if (top->level > 0) {
      divide(s);
      continue;
    }
    PACKING_I_TRY(try_tile(p, placed));
    if (*placed)
      return packing_i_front_seed_beside(p);
    s->cell = 0;
    s->blocks--;
  }
  return PACKING_OK;
}
