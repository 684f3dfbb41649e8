/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nearest neighbours of each particle: a ball about it grows until it holds as many as are
 * asked for; of these the first by (distance, index, image) are kept. The grid below is open:
 * images are met by asking it about shifted points. What is kept does not depend on how the ball
 * grows. Linear in particles for packs of even density. */
#include "grid/grid_internal.h"
#include "measure/order_internal.h"
#include "view.h"

#define FIRST_REACH 1.5 /* of the ball, in mean diameters: some 12 in a dense pack */
#define GROWTH 1.5
#define ADAPTION 1.1          /* of the next particle's first ball */
#define GENEROUS (1.0 + 1e-6) /* so that rounding hides nobody on the ball's surface */

enum {
  ROOM = 256,
  MANY = 3 /* times what is wanted: the ball was too large */
};

typedef struct candidate {
  double distance;
  packing_i_bond bond;
} candidate;

typedef struct search {
  const packing_grid *grid; /* of points: its radii are all `point_r` */
  double point_r;
  double reach;    /* of the first ball */
  packing_vec3 lo; /* of the centres */
  packing_vec3 hi;
  packing_neighbours *neighbours;
  size_t wanted; /* no more than there are */
} search;

/* The best so far about one particle, in order. */
typedef struct ball {
  const packing_neighbours *neighbours;
  size_t self;
  size_t wanted;
  double reach;
  int16_t image[3]; /* of what is met now */
  size_t met;       /* within reach */
  size_t held;
  candidate list[ROOM];
} ball;

/* Ties go by index in the view, not by place. */
static int is_closer(const size_t *index, const candidate *a, const candidate *b)
{
  if (a->distance != b->distance)
    return a->distance < b->distance;
  packing_i_bond x = a->bond, y = b->bond;
  x.j = index[x.j];
  y.j = index[y.j];
  return packing_i_bond_compare(&x, &y) < 0;
}

static int is_self(const ball *b, size_t place)
{
  return place == b->self && b->image[0] == 0 && b->image[1] == 0 && b->image[2] == 0;
}

/* The distance is taken again from the bond itself, where images on either side are equally far. */
static void offer(void *arg, size_t place, packing_vec3 d, double distance)
{
  ball *b = arg;
  candidate c = {0, {place, {b->image[0], b->image[1], b->image[2]}}};
  (void)d;
  (void)distance;
  c.distance = packing_i_norm(packing_i_bond_vector(b->neighbours, b->self, &c.bond));
  if (!(c.distance <= b->reach) || is_self(b, place))
    return;
  b->met++;
  if (b->held == b->wanted && !is_closer(b->neighbours->index, &c, &b->list[b->held - 1]))
    return;
  size_t at = b->held < b->wanted ? b->held++ : b->held - 1;
  for (; at > 0 && is_closer(b->neighbours->index, &c, &b->list[at - 1]); at--)
    b->list[at] = b->list[at - 1];
  b->list[at] = c;
}

/* By how many periods the centres may be moved to come within reach of p. */
static void image_range(const search *s, packing_vec3 p, double reach, int lo[3],
                        int hi[3])
{
  for (int k = 0; k < 3; k++) {
    const double period = packing_i_component(s->neighbours->period, k);
    const double at = packing_i_component(p, k);
    lo[k] = hi[k] = 0;
    if (period == 0)
      continue;
    lo[k] = (int)ceil((at - reach - packing_i_component(s->hi, k)) / period);
    hi[k] = (int)floor((at + reach - packing_i_component(s->lo, k)) / period);
  }
}

static void meet_image(const search *s, ball *b, packing_vec3 p, const int image[3])
{
  const packing_vec3 period = s->neighbours->period;
  const packing_vec3 seen = {p.x - image[0] * period.x, p.y - image[1] * period.y,
                             p.z - image[2] * period.z};
  for (int k = 0; k < 3; k++)
    b->image[k] = (int16_t)image[k];
  packing_i_grid_near_visit(s->grid, &seen, b->reach * GENEROUS - s->point_r, offer, b);
}

static void meet_all(const search *s, ball *b)
{
  const packing_vec3 p = s->neighbours->centre[b->self];
  int lo[3], hi[3], image[3];
  image_range(s, p, b->reach * GENEROUS, lo, hi);
  b->met = b->held = 0;
  for (image[0] = lo[0]; image[0] <= hi[0]; image[0]++)
    for (image[1] = lo[1]; image[1] <= hi[1]; image[1]++)
      for (image[2] = lo[2]; image[2] <= hi[2]; image[2]++)
        meet_image(s, b, p, image);
}

static void sort_bonds(packing_i_bond *bonds, const ball *b)
{
  for (size_t k = 0; k < b->held; k++) {
    size_t at = k;
    for (; at > 0 && packing_i_bond_compare(&b->list[k].bond, &bonds[at - 1]) < 0; at--)
      bonds[at] = bonds[at - 1];
    bonds[at] = b->list[k].bond;
  }
}

/* Returns the reach for the next one to begin with: whether it is a good one is a matter of speed
 * alone. */
static double search_one(const search *s, ball *b, size_t i, double reach)
{
  b->self = i;
  b->reach = reach;
  meet_all(s, b);
  const int enough = b->met >= s->wanted;
  const int many = b->met > MANY * s->wanted;
  while (b->met < s->wanted) {
    b->reach *= GROWTH;
    meet_all(s, b);
  }
  sort_bonds(s->neighbours->bonds + s->neighbours->start[i], b);
  return many ? reach / ADAPTION : enough ? reach : reach * ADAPTION;
}

static void search_block(void *arg, size_t block)
{
  const search *s = arg;
  const size_t end = packing_i_measure_block_end(block, s->neighbours->count);
  double reach = s->reach;
  ball b = {0};
  b.neighbours = s->neighbours;
  b.wanted = s->wanted;
  for (size_t i = block * PACKING_I_MEASURE_BLOCK; i < end; i++)
    reach = search_one(s, &b, i, reach);
}

/* The extent of the centres, and lengths to begin with. */
static void survey(search *s, const packing_view *view)
{
  const packing_neighbours *n = s->neighbours;
  double sum = 0;
  s->lo = s->hi = n->centre[0];
  for (size_t i = 0; i < n->count; i++) {
    const packing_vec3 p = n->centre[i];
    s->lo = packing_i_vec(fmin(s->lo.x, p.x), fmin(s->lo.y, p.y), fmin(s->lo.z, p.z));
    s->hi = packing_i_vec(fmax(s->hi.x, p.x), fmax(s->hi.y, p.y), fmax(s->hi.z, p.z));
    sum += packing_i_view_r(view, i);
  }
  s->point_r = sum / (double)n->count;
  s->reach = FIRST_REACH * 2 * s->point_r;
  for (int k = 0; k < 3; k++) {
    const double period = packing_i_component(n->period, k);
    if (period > 0)
      s->reach = fmin(s->reach, period);
  }
}

/* All have equally many: `nearest`, but without periods no more than there are others. */
static packing_status make_room(packing_context *context, search *s, size_t nearest)
{
  packing_neighbours *n = s->neighbours;
  const packing_vec3 p = n->period;
  const int endless = p.x > 0 || p.y > 0 || p.z > 0;
  s->wanted = endless || nearest < n->count ? nearest : n->count - 1;
  for (size_t i = 0; i < n->count; i++)
    n->start[i + 1] = n->start[i] + s->wanted;
  if (n->count > SIZE_MAX / ROOM)
    return packing_i_nomem(context);
  n->bonds = packing_i_alloc(n->allocator, n->start[n->count], sizeof *n->bonds);
  return n->bonds == NULL ? packing_i_nomem(context) : PACKING_OK;
}

packing_status packing_i_neighbours_nearest(packing_context *context,
                                            packing_neighbours *n,
                                            const packing_view *view, size_t nearest)
{
  packing_grid *grid = NULL;
  search s = {0};
  s.neighbours = n;
  PACKING_I_TRY(make_room(context, &s, nearest));
  if (s.wanted == 0)
    return PACKING_OK;
  survey(&s, view);
  packing_view points = *view;
  points.r.data = &s.point_r;
  points.r.stride = 0;
  PACKING_I_TRY(
      packing_i_grid_build(context, 1, NULL, &points, NULL, n->count, NULL, &grid));
  s.grid = grid;
  packing_i_parallel(context, packing_i_measure_blocks(n->count), search_block, &s);
  packing_grid_destroy(grid);
  return PACKING_OK;
}
