/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The start of an outward front (section 3.2): three discs or four spheres that touch one another,
 * the mean of their centres at the innermost point, turned at random.
 *
 * Four spheres of any sizes cannot always touch one another: the smallest may slip through between
 * the others. It then touches two of them. Fewer are placed where fewer are asked for. Where the
 * group has no room, 64 turns being tried, the walls are begun with as in an inward front; without
 * walls, with one particle at the innermost point. Bodies of other shapes come one after the other
 * from random directions. */
#include "front_paper.h"

enum { TURNS = 64, WORK_A_TURN = 400 };

/* Two spheres that touch spheres a and b, themselves touching, in the plane of e and f. */
static packing_vec3 beside_two(double r_a, double r_b, double r)
{
  const double d = r_a + r_b, along = r_a + r, across = r_b + r;
  const double x = 0.5 * (d + (along - across) * (along + across) / d);
  const double y2 = (along - x) * (along + x);
  return packing_i_vec(x, y2 > 0 ? sqrt(y2) : 0, 0);
}

/* The fourth, above the plane of the three; below it (touching the first two) where it slips
 * through. */
static packing_vec3 beside_three(const packing_vec3 c[3], const double r[4])
{
  const double a = r[0] + r[3], b = r[1] + r[3], d = r[2] + r[3];
  const double x = 0.5 * (c[1].x + (a - b) * (a + b) / c[1].x);
  const double y =
      0.5 * (packing_i_dot(c[2], c[2]) + (a - d) * (a + d) - 2 * x * c[2].x) / c[2].y;
  const double z2 = (a - x) * (a + x) - y * y;
  if (z2 > 0)
    return packing_i_vec(x, y, sqrt(z2));
  const packing_vec3 two = beside_two(r[0], r[1], r[3]);
  return packing_i_vec(two.x, -two.y, 0);
}

/* Centres of up to four touching spheres; the largest first, so that only the last can slip. */
static void group(const double r[4], size_t count, packing_vec3 c[4])
{
  c[0] = packing_i_vec(0, 0, 0);
  c[1] = packing_i_vec(r[0] + r[1], 0, 0);
  if (count > 2)
    c[2] = beside_two(r[0], r[1], r[2]);
  if (count > 3)
    c[3] = beside_three(c, r);
}

static void turned_group(packing_i_paper *paper, int dim, packing_vec3 c[4])
{
  double r[4] = {0};
  for (size_t n = 0; n < paper->firsts; n++)
    r[n] = paper->first[n].r;
  group(r, paper->firsts, c);
  packing_i_front_turn_points(&paper->turns, dim, c, paper->firsts);
}

static packing_body first_body(const packing_i_paper *paper, size_t n,
                               packing_vec3 centre)
{
  packing_body body = packing_body_sphere(centre, paper->first[n].r);
  body.shape = paper->shape;
  for (int k = 0; k < 4 && paper->shape != NULL; k++)
    body.orientation[k] = paper->first[n].orientation[k];
  return body;
}

/* Body n comes from a random direction until it touches one of those before; 0: it misses. */
static int arrive(packing_i_paper *paper, int dim, size_t n, packing_vec3 c[4])
{
  const packing_vec3 from = packing_i_front_direction(&paper->turns, dim);
  const packing_vec3 back = packing_i_scale(from, -1);
  double far = 0, least = HUGE_VAL;
  for (size_t m = 0; m <= n; m++)
    far += 2 * paper->first[m].r;
  const packing_body mobile = first_body(paper, n, packing_i_scale(from, 2 * far));
  for (size_t m = 0; m < n; m++) {
    const packing_body body = first_body(paper, m, c[m]);
    least = fmin(least, packing_body_distance(&mobile, &body, &back));
  }
  c[n] = packing_i_add(mobile.centre, packing_i_scale(back, least));
  return isfinite(least);
}

static int gathered_group(packing_i_paper *paper, int dim, packing_vec3 c[4])
{
  c[0] = packing_i_vec(0, 0, 0);
  for (size_t n = 1; n < paper->firsts; n++)
    if (!arrive(paper, dim, n, c))
      return 0;
  return 1;
}

/* Moves the mean of the centres to a point. */
static void shift(const packing_i_paper *paper, packing_vec3 at, packing_vec3 c[4])
{
  const double share = 1.0 / (double)paper->firsts;
  packing_vec3 sum = {0, 0, 0};
  for (size_t n = 0; n < paper->firsts; n++)
    sum = packing_i_add(sum, c[n]);
  const packing_vec3 mean = packing_i_scale(sum, share);
  for (size_t n = 0; n < paper->firsts; n++)
    c[n] = packing_i_add(at, packing_i_sub(c[n], mean));
}

/* Whether the bodies of the group keep off each other's periodic images too. */
static int is_apart(const packing_placer *placer, const packing_vec3 c[4])
{
  const packing_i_paper *paper = placer->method;
  for (size_t n = 0; n < paper->firsts; n++)
    for (size_t m = 0; m < n; m++) {
      const packing_body a = first_body(paper, n, c[n]);
      const packing_body b = first_body(
          paper, m,
          packing_i_add(c[n], packing_domain_separation(placer->domain, &c[n], &c[m])));
      if (!(packing_body_gap(&a, &b) >= -packing_i_paper_slack(paper, a.r, b.r)))
        return 0;
    }
  return 1;
}

static packing_status has_room(const packing_placer *placer, const packing_vec3 c[4],
                               int *room)
{
  packing_i_paper *paper = placer->method;
  *room = 0;
  for (size_t n = 0; n < paper->firsts; n++) {
    const packing_body body = first_body(paper, n, c[n]);
    int is_free;
    if (packing_i_paper_meets_itself(placer, body.r) ||
        !packing_i_paper_inside(placer, &body, paper->first_zone))
      return PACKING_OK;
    PACKING_I_TRY(packing_i_paper_free(placer, &body, &paper->scan.near, &is_free));
    if (!is_free)
      return PACKING_OK;
  }
  *room = is_apart(placer, c);
  return PACKING_OK;
}

static void add_first(packing_i_paper *paper, const packing_i_paper_pending *drawn)
{
  size_t n = paper->firsts++;
  for (; n > 0 && paper->first[n - 1].r < drawn->r; n--)
    paper->first[n] = paper->first[n - 1];
  paper->first[n] = *drawn;
}

/* Draws the first particles, the largest first, with the one that is pending; fewer where fewer are
 * asked for. */
static void draw_first(packing_placer *placer, packing_vec3 at)
{
  packing_i_paper *paper = placer->method;
  const size_t most = (size_t)placer->particles->dim + 1;
  packing_placer_report tally = placer->tally;
  paper->firsts = 0;
  paper->first_zone = packing_i_source_zone(paper->front.source, &at);
  packing_i_paper_pending drawn = paper->pending[paper->first_zone];
  while (
      paper->firsts < most &&
      (drawn.r > 0 || packing_i_paper_draw(placer, paper->first_zone, &tally, &drawn))) {
    tally.placed++;
    tally.solid_volume += drawn.volume;
    add_first(paper, &drawn);
    drawn.r = 0;
  }
}

/* The group found no place: what was drawn goes back, the largest to be the next; the pending
 * particle, the first of those of its size, stays so. */
static void give_back(packing_i_paper *paper)
{
  const double waiting = paper->pending[paper->first_zone].r;
  for (size_t n = paper->firsts; n-- > 0;) {
    const packing_i_paper_pending *first = &paper->first[n];
    if (first->r != waiting || (n > 0 && first[-1].r == waiting))
      packing_i_source_return(paper->front.source, paper->first_zone, first->r,
                              first->component);
  }
}

static void place(packing_placer *placer, const packing_vec3 c[4])
{
  packing_i_paper *paper = placer->method;
  for (size_t n = 0; n < paper->firsts; n++) {
    paper->pending[paper->first_zone] = paper->first[n];
    packing_i_paper_put(placer, c[n], paper->first_zone);
  }
}

/* Places the group where one of the turns has room for it. */
static packing_status place_group(packing_placer *placer, packing_vec3 at, int *room)
{
  packing_i_paper *paper = placer->method;
  const int dim = placer->particles->dim;
  for (size_t n = 0; n < paper->firsts; n++)
    PACKING_I_TRY(packing_i_paper_reserve(placer, paper->firsts, paper->first[n].r));
  for (int k = 0; k < TURNS && !*room && paper->firsts > 0; k++) {
    packing_vec3 c[4] = {{0, 0, 0}};
    paper->work += WORK_A_TURN;
    if (paper->shape == NULL)
      turned_group(paper, dim, c);
    else if (!gathered_group(paper, dim, c))
      continue;
    shift(paper, at, c);
    PACKING_I_TRY(has_room(placer, c, room));
    if (*room)
      place(placer, c);
  }
  return PACKING_OK;
}

packing_status packing_i_paper_start_at(packing_placer *placer, packing_vec3 at,
                                        int *room)
{
  packing_i_paper *paper = placer->method;
  const packing_i_stream before = paper->turns;
  *room = 0;
  draw_first(placer, at);
  const packing_status status = place_group(placer, at, room);
  if (!*room)
    give_back(paper);
  if (status != PACKING_OK)
    paper->turns = before;
  return status;
}

/* One particle at the innermost point. */
static packing_status place_one(packing_placer *placer)
{
  packing_i_paper *paper = placer->method;
  const packing_vec3 at = paper->front.innermost;
  const size_t zone = packing_i_source_zone(paper->front.source, &at);
  packing_i_paper_pending *pending = packing_i_paper_next(placer, zone);
  if (pending == NULL || packing_i_paper_meets_itself(placer, pending->r))
    return PACKING_OK;
  const packing_body body = packing_i_paper_mobile(paper, zone, at);
  int is_free;
  const packing_status status =
      packing_i_paper_free(placer, &body, &paper->scan.near, &is_free);
  if (status == PACKING_OK && is_free) {
    packing_i_paper_put(placer, at, zone);
  } else if (status != PACKING_OK) {
    packing_i_source_return(paper->front.source, zone, pending->r, pending->component);
    pending->r = 0;
  }
  return status;
}

packing_status packing_i_paper_start_outward(packing_placer *placer, int *started)
{
  packing_i_paper *paper = placer->method;
  const packing_i_stream before = paper->turns;
  int room;
  PACKING_I_TRY(packing_i_paper_start_at(placer, paper->front.innermost, &room));
  *started = room || paper->before > 0 || !isfinite(paper->front.room);
  if (room || isfinite(paper->front.room))
    return PACKING_OK;
  const packing_status status = place_one(placer);
  if (status != PACKING_OK)
    paper->turns = before;
  return status;
}
