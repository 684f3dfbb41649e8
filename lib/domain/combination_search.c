/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distance to the outside of a combination, where the least of the distances to its parts
 * would be too small: near seams of unions.
 *
 * Branch and bound over cubes, the nearest first. What of a cube may lie outside (see
 * combination_cell.c) bounds the distance from below; the foot of the point on it, moved by
 * Newton's method onto the walls (each step linearises them at the foot and projects the point
 * again), bounds it from above once it is found to lie outside. Cubes that hold nothing of the
 * outside go. The search ends when the nearest cube is no nearer than the foot, up to 1e-9 of it;
 * the answer is that cube's bound, which holds whatever the foot is worth. Beside flat and smooth
 * walls the bounds are of second order, so some tens to hundreds of cubes do; beside walls of
 * custom containers and meshes they are of first order and the number of cubes ends the search.
 * Nothing is allocated. Ties go to the cube made first. */
#include "combination_internal.h"
#include <math.h>

enum { PRECISE_CELLS = 300, CELLS_TO_DOUBLE = 50, HEAP = 4096, NEWTON_STEPS = 12 };
static const double precise = 1e-9; /* relative */

typedef struct cell {
  packing_vec3 centre;
  double half, bound;
  int made;
} cell;

typedef struct search {
  const packing_i_combination_data *data;
  int dim, count, made, found;
  packing_vec3 point, foot;
  double upper;
  packing_i_cell_view view;
  cell heap[HEAP];
} search;

static int before(const cell *a, const cell *b)
{
  return a->bound < b->bound || (a->bound == b->bound && a->made < b->made);
}

static void push(search *s, cell c)
{
  int i = s->count++;
  for (; i > 0 && before(&c, &s->heap[(i - 1) / 2]); i = (i - 1) / 2)
    s->heap[i] = s->heap[(i - 1) / 2];
  s->heap[i] = c;
}

static cell pop(search *s)
{
  const cell top = s->heap[0], last = s->heap[--s->count];
  int i = 0;
  for (int child = 1; child < s->count; child = 2 * i + 1) {
    if (child + 1 < s->count && before(&s->heap[child + 1], &s->heap[child]))
      child++;
    if (!before(&s->heap[child], &last))
      break;
    s->heap[i] = s->heap[child];
    i = child;
  }
  s->heap[i] = last;
  return top;
}

static double to_cube(const search *s, const packing_vec3 *point, const cell *c)
{
  double sum = 0;
  for (int k = 0; k < s->dim; k++) {
    const double x = packing_i_component(*point, k) - packing_i_component(c->centre, k);
    const double gap = fmax(fabs(x) - c->half, 0);
    sum += gap * gap;
  }
  return sqrt(sum);
}

/* The bound of a cell, infinite where nothing of it lies outside; its nearest term. What a term
 * holds is convex, so a point of it that lies in the cell, off its foot, is farther by
 * Pythagoras at least. */
static double view(search *s, cell *c, int *nearest)
{
  packing_vec3 foot;
  double least = HUGE_VAL;
  packing_i_view_cell(s->data, s->dim, &c->centre, c->half, &s->view);
  for (int i = 0; i < s->view.terms; i++) {
    const double d =
        packing_i_term_distance(&s->view, &s->view.term[i], &s->point, &foot);
    const double off = to_cube(s, &foot, c);
    const double bound = off > 0 ? sqrt(d * d + off * off) : d;
    if (bound < least) {
      least = bound;
      *nearest = i;
    }
  }
  return least < HUGE_VAL ? fmax(least, to_cube(s, &s->point, c)) : least;
}

static void offer(search *s, const packing_vec3 *foot)
{
  const double d = packing_i_norm(packing_i_sub(s->point, *foot));
  if (!(d < s->upper))
    return;
  s->upper = d;
  s->foot = *foot;
  s->found = 1;
}

/* Whether a point that lies on the walls of a term is outside, but for what is left of Newton's
 * method. */
static int is_outside(const search *s, const packing_vec3 *foot, double distance)
{
  double d[PACKING_I_PARTS];
  int part;
  packing_i_part_distances(s->data, foot, d);
  return packing_i_formula(s->data, d, &part) <= s->data->blur + 1e-12 * distance;
}

static int is_in_cube(const search *s, const cell *c, const packing_vec3 *point)
{
  const double half = c->half * (1 + 1e-6) + s->data->blur;
  for (int k = 0; k < s->dim; k++)
    if (fabs(packing_i_component(*point, k) - packing_i_component(c->centre, k)) > half)
      return 0;
  return 1;
}

/* The foot of the nearest term, on the walls themselves. A foot beyond the cell is not meant by
 * it. */
static void improve(search *s, const cell *c, const packing_i_term *term)
{
  packing_vec3 foot, next;
  double d = packing_i_term_distance(&s->view, term, &s->point, &foot);
  if (term->count == 0)
    return;
  for (int i = 0; i < NEWTON_STEPS; i++) {
    if (!packing_i_move_bounds(s->data, &foot, &s->view, term))
      return;
    d = packing_i_term_distance(&s->view, term, &s->point, &next);
    const double step = packing_i_norm(packing_i_sub(next, foot));
    if (!(d < HUGE_VAL))
      return;
    foot = next;
    if (step <= 1e-13 * d)
      break;
  }
  if (is_in_cube(s, c, &foot) && is_outside(s, &foot, d))
    offer(s, &foot);
}

/* What may be left open after so many cells, relative. */
static double enough(int cells)
{
  const int over = cells - PRECISE_CELLS;
  return over < CELLS_TO_DOUBLE ? precise : ldexp(precise, over / CELLS_TO_DOUBLE);
}

static void split(search *s, const cell *c)
{
  int nearest = 0;
  for (int i = 0; i < 1 << s->dim; i++) {
    cell child = {c->centre, 0.5 * c->half, 0, s->made++};
    child.centre.x += i & 1 ? child.half : -child.half;
    child.centre.y += i & 2 ? child.half : -child.half;
    if (s->dim == 3)
      child.centre.z += i & 4 ? child.half : -child.half;
    child.bound = fmax(view(s, &child, &nearest), c->bound);
    if (s->view.sides < -s->data->blur)
      offer(s, &child.centre);
    if (child.bound < s->upper)
      push(s, child);
  }
}

/* Whether a search that has come to a cell at `bound` need not go on. The bounds of cells grow and
 * the upper one shrinks, so it would end on the same side of the limit. */
static int is_decided(const search *s, double bound, double limit)
{
  return s->found && limit < HUGE_VAL &&
         (bound >= limit || s->upper < (1 - precise) * limit);
}

int packing_i_search(const packing_i_combination_data *data, int dim,
                     const packing_vec3 *point, double half, double known, double limit,
                     double *distance, packing_vec3 *foot)
{
  search s;
  double reached = 0;
  s.data = data;
  s.dim = dim;
  s.count = 0;
  s.found = known < HUGE_VAL;
  s.made = 1;
  s.point = *point;
  s.upper = known;
  s.foot = *foot;
  push(&s, (cell){*point, half, 0, 0});
  *distance = HUGE_VAL;
  for (int cells = 0; s.count > 0; cells++) {
    int nearest = 0;
    cell c = pop(&s);
    *distance = c.bound;
    if (c.bound >= (1 - enough(cells)) * s.upper)
      break;
    if (view(&s, &c, &nearest) < HUGE_VAL)
      improve(&s, &c, &s.view.term[nearest]);
    if (c.bound >= (1 - enough(cells)) * s.upper || s.count + (1 << dim) > HEAP ||
        !(c.half > data->blur) || is_decided(&s, c.bound, limit))
      break;
    reached = c.bound;
    split(&s, &c);
    *distance = HUGE_VAL;
  }
  /* Where rounding puts the foot nearer than what cells have shown, those count. */
  *distance = fmax(fmin(*distance, s.upper), reached);
  *foot = s.foot;
  return s.found;
}
