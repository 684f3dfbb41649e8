/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The point of a container that is farthest from its walls.
 *
 * Boxes and round containers say it at once. For a body of revolution it is a linear programme in
 * the half plane (rho, h): the largest t with a rho + b h + c >= t for all walls, rho >= 0, below
 * the open top. With at most four walls all vertices are tried.
 *
 * Else branch and bound: the distance changes no faster than the point moves, so a cell's centre
 * bounds it on the whole cell; cells are cut in three across their longest side, which keeps the
 * middle of what is symmetric among the centres. The cell of the largest bound goes first, of equal
 * ones the lowest in z, y, x; no bound exceeds half the least width of the bounds. Beside a
 * single maximum the number of cells grows with the logarithm of 1 / tolerance; along a ridge
 * with its length over the tolerance, and a cap ends it. */
#include "domain_kinds.h"
#include <packing/solids.h>

enum { MOST_CALLS = 1 << 20, MOST_CALLS_SEAMS = 1 << 17, FIRST_CELLS = 1024 };

static int lower(packing_vec3 a, packing_vec3 b)
{
  return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
}

static void of_planar(const packing_i_domain_body *body, packing_vec3 *point)
{
  const packing_i_planar *p = &body->as.planar;
  double t = HUGE_VAL;
  for (int k = 0; k < body->dim; k++) {
    const double width = p->cut_hi[k] - p->wall_lo[k];
    t = fmin(t, isfinite(p->wall_hi[k]) ? 0.5 * width : width);
  }
  *point = packing_i_vec(0, 0, 0);
  for (int k = 0; k < body->dim; k++) {
    const double lo = packing_i_component(body->bounds.lo, k);
    const double hi = packing_i_component(body->bounds.hi, k);
    const int is_walled = isfinite(p->wall_lo[k]);
    const int is_narrowest = isfinite(p->wall_hi[k]) && 0.5 * (hi - lo) <= t;
    packing_i_set_component(point, k,
                            is_walled && !is_narrowest ? lo + t : lo + 0.5 * (hi - lo));
  }
}

static void of_round(const packing_i_domain_body *body, packing_vec3 *point)
{
  const packing_i_round *s = &body->as.round;
  *point = s->centre;
  if (s->inner > 0)
    point->y -= s->inner + 0.5 * (s->outer - s->inner);
}

/* a rho + b h + c >= w t */
typedef struct row {
  double a, b, c, w;
} row;

enum { MOST_ROWS = PACKING_I_WALLS + 2 };

typedef struct programme {
  int rows;
  row row[MOST_ROWS];
  double size;
} programme;

static double determinant(double m[3][3])
{
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The vertex (rho, h, t) of three rows. */
static int solve(const row *const r[3], double x[3])
{
  double m[3][3];
  for (int i = 0; i < 3; i++) {
    m[i][0] = r[i]->a;
    m[i][1] = r[i]->b;
    m[i][2] = -r[i]->w;
  }
  const double whole = determinant(m);
  if (fabs(whole) < 1e-12)
    return 0;
  for (int k = 0; k < 3; k++) {
    double n[3][3];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        n[i][j] = j == k ? -r[i]->c : m[i][j];
    x[k] = determinant(n) / whole;
  }
  return 1;
}

static int is_feasible(const programme *p, const double x[3])
{
  for (int i = 0; i < p->rows; i++) {
    const row *r = &p->row[i];
    if (r->a * x[0] + r->b * x[1] + r->c - r->w * x[2] < -1e-13 * p->size)
      return 0;
  }
  return 1;
}

/* rho stands for the direction that is lowest. */
static packing_vec3 at(const packing_i_revolution *p, const double x[3])
{
  packing_vec3 point = p->base;
  const int across = p->axis == PACKING_AXIS_Z ? PACKING_AXIS_Y : PACKING_AXIS_Z;
  packing_i_set_component(&point, across,
                          packing_i_component(point, across) - fmax(x[0], 0));
  packing_i_set_component(&point, p->axis, packing_i_component(point, p->axis) + x[1]);
  return point;
}

static void of_revolution(const packing_i_domain_body *body, packing_vec3 *point)
{
  const packing_i_revolution *s = &body->as.revolution;
  programme p = {.rows = 0};
  double best = -HUGE_VAL;
  for (int i = 0; i < s->walls; i++)
    p.row[p.rows++] = (row){s->wall[i].a, s->wall[i].b, s->wall[i].c, 1};
  p.row[p.rows++] = (row){1, 0, 0, 0};
  if (isfinite(s->open_height))
    p.row[p.rows++] = (row){0, -1, s->open_height, 0};
  for (int k = 0; k < 3; k++)
    p.size = fmax(p.size, packing_i_component(body->bounds.hi, k) -
                              packing_i_component(body->bounds.lo, k));
  for (int i = 0; i < p.rows; i++)
    for (int j = i + 1; j < p.rows; j++)
      for (int k = j + 1; k < p.rows; k++) {
        const row *const three[3] = {&p.row[i], &p.row[j], &p.row[k]};
        double x[3];
        if (!solve(three, x) || !is_feasible(&p, x) || x[2] < best - 1e-12 * p.size)
          continue;
        const packing_vec3 candidate = at(s, x);
        if (x[2] > best + 1e-12 * p.size || lower(candidate, *point)) {
          *point = candidate;
          best = fmax(best, x[2]);
        }
      }
}

typedef struct cell {
  packing_vec3 centre, half;
  double upper;
} cell;

typedef struct search {
  packing_context *context;
  const packing_domain *domain;
  double tolerance, limit; /* no distance is larger than the limit */
  size_t calls, most_calls;
  cell *heap;
  size_t count, capacity;
  packing_vec3 point;
  double best;
} search;

static int goes_first(const cell *a, const cell *b)
{
  return a->upper != b->upper ? a->upper > b->upper : lower(a->centre, b->centre);
}

static packing_status push(search *s, const cell *c)
{
  if (s->count == s->capacity) {
    const size_t capacity = s->capacity == 0 ? FIRST_CELLS : 2 * s->capacity;
    cell *grown = packing_i_regrow(packing_i_allocator(s->context), s->heap, s->count,
                                   capacity, sizeof *grown);
    if (grown == NULL)
      return packing_i_nomem(s->context);
    s->heap = grown;
    s->capacity = capacity;
  }
  size_t i = s->count++;
  for (; i > 0 && goes_first(c, &s->heap[(i - 1) / 2]); i = (i - 1) / 2)
    s->heap[i] = s->heap[(i - 1) / 2];
  s->heap[i] = *c;
  return PACKING_OK;
}

static cell pop(search *s)
{
  const cell top = s->heap[0], last = s->heap[--s->count];
  size_t i = 0;
  for (size_t child = 1; child < s->count; child = 2 * i + 1) {
    if (child + 1 < s->count && goes_first(&s->heap[child + 1], &s->heap[child]))
      child++;
    if (!goes_first(&s->heap[child], &last))
      break;
    s->heap[i] = s->heap[child];
    i = child;
  }
  s->heap[i] = last;
  return top;
}

/* Asks at the centre and keeps the cell if it may hold something better. */
static packing_status consider(search *s, cell *c)
{
  const double d = packing_domain_signed_distance(s->domain, &c->centre, NULL);
  s->calls++;
  if (isnan(d))
    return packing_i_fail(s->context, PACKING_ERR_GEOMETRY, "domain", PACKING_NO_INDEX,
                          "a distance is no number, at %g, %g, %g", c->centre.x,
                          c->centre.y, c->centre.z);
  if (d > s->best || (d == s->best && lower(c->centre, s->point))) {
    s->best = d;
    s->point = c->centre;
  }
  c->upper = fmin(d + packing_i_norm(c->half), s->limit);
  return c->upper > s->best + s->tolerance ? push(s, c) : PACKING_OK;
}

static packing_status split(search *s, const cell *c)
{
  int longest = 0;
  for (int k = 1; k < 3; k++)
    if (packing_i_component(c->half, k) > packing_i_component(c->half, longest))
      longest = k;
  const double third = packing_i_component(c->half, longest) / 3;
  for (int i = -1; i <= 1; i++) {
    cell part = *c;
    packing_i_set_component(&part.half, longest, third);
    packing_i_set_component(&part.centre, longest,
                            packing_i_component(c->centre, longest) + 2 * i * third);
    PACKING_I_TRY(consider(s, &part));
  }
  return PACKING_OK;
}

static packing_status run(search *s)
{
  const packing_i_domain_body *body = &s->domain->body;
  cell c = {.upper = HUGE_VAL};
  for (int k = 0; k < body->dim; k++) {
    const double lo = packing_i_component(body->bounds.lo, k);
    const double half = 0.5 * (packing_i_component(body->bounds.hi, k) - lo);
    packing_i_set_component(&c.half, k, half);
    packing_i_set_component(&c.centre, k, lo + half);
    s->limit = fmin(s->limit, half);
  }
  PACKING_I_TRY(consider(s, &c));
  while (s->count > 0) {
    c = pop(s);
    if (!(c.upper > s->best + s->tolerance))
      break;
    if (s->calls >= s->most_calls) {
      packing_i_warn(
          s->context, "tolerance",
          "the innermost point at a distance of %g: after %zu distances others "
          "may be as far as %g",
          s->best, s->calls, c.upper);
      break;
    }
    PACKING_I_TRY(split(s, &c));
  }
  if (s->best > 0)
    return PACKING_OK;
  return packing_i_fail(s->context, PACKING_ERR_GEOMETRY, "domain", PACKING_NO_INDEX,
                        "no point inside the %s was found", body->ops->name);
}

static packing_status by_search(packing_context *context, const packing_domain *domain,
                                double tolerance, packing_vec3 *point)
{
  const int has_seams = packing_i_domain_combination(&domain->body) != NULL;
  search s = {.context = context,
              .domain = domain,
              .tolerance = tolerance,
              .limit = HUGE_VAL,
              .most_calls = has_seams ? MOST_CALLS_SEAMS : MOST_CALLS,
              .best = -HUGE_VAL};
  const packing_status status = run(&s);
  packing_i_free(packing_i_allocator(context), s.heap);
  if (status == PACKING_OK)
    *point = s.point;
  return status;
}

static packing_status find(packing_context *context, const packing_domain *domain,
                           double tolerance, packing_vec3 *point)
{
  if (packing_i_domain_planar(domain) != NULL)
    of_planar(&domain->body, point);
  else if (packing_i_domain_round(domain) != NULL)
    of_round(&domain->body, point);
  else if (packing_i_domain_axis(domain) >= 0)
    of_revolution(&domain->body, point);
  else
    return by_search(context, domain, tolerance, point);
  return PACKING_OK;
}

packing_status packing_domain_innermost(packing_context *context,
                                        const packing_domain *domain, double tolerance,
                                        packing_vec3 *point, double *distance)
{
  packing_vec3 found = {0, 0, 0};
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  PACKING_I_TRY(packing_i_check_given(context, "point", point));
  PACKING_I_TRY(packing_i_check_positive(context, "tolerance", tolerance));
  PACKING_I_TRY(find(context, domain, tolerance, &found));
  *point = found;
  if (distance != NULL)
    *distance = packing_domain_signed_distance(domain, &found, NULL);
  return PACKING_OK;
}
