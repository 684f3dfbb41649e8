/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists pores and constrictions of a network, sums them up, and hands them out. */
#include "measure/pores_result.h"
#include "vec.h"
#include <gsl/gsl_sort.h>

/* Moves a point, relative to the origin, into the periodic cell, to absolute coordinates; returns
 * the image of it that stood there before. */
static int32_t settle(const packing_i_pore_network *n, packing_vec3 *p)
{
  double *const at[3] = {&p->x, &p->y, &p->z};
  int image[3] = {0, 0, 0};
  for (int axis = 0; axis < 3; axis++) {
    const double period = n->period[axis], lo = packing_i_component(n->box.lo, axis);
    if (!(n->periodic >> axis & 1U))
      continue;
    image[axis] = (int)floor(*at[axis] / period);
    *at[axis] = lo + fmax(*at[axis] - image[axis] * period, 0);
    if (*at[axis] >= packing_i_component(n->box.hi, axis)) {
      image[axis]++;
      *at[axis] = lo;
    }
  }
  return packing_i_image_code(image);
}

static packing_pore list_pore(const packing_i_pore_network *n,
                              const packing_i_pore_node *node, int32_t *image)
{
  packing_pore p = {0};
  p.centre = node->centre;
  *image = settle(n, &p.centre);
  p.radius = node->radius;
  p.limit = node->limit;
  for (int k = 0; k < 4; k++)
    p.particles[k] = k <= n->dim ? n->cell[node->cell].touch[k] : PACKING_NO_INDEX;
  return p;
}

/* Where each node's pore stands in the list, and the image of it that the node's frame holds. */
typedef struct places {
  uint32_t *index;
  int32_t *image;
} places;

static size_t list_pores(const packing_i_pore_network *n, packing_pore *list, places *at)
{
  size_t count = 0;
  for (uint32_t i = 0; i < n->nodes; i++)
    if (n->node[i].owner == i) {
      at->index[i] = (uint32_t)count;
      list[count++] = list_pore(n, &n->node[i], &at->image[i]);
    }
  for (uint32_t i = 0; i < n->nodes; i++)
    list[at->index[n->node[i].owner]].cells += n->node[i].cells;
  return count;
}

static packing_constriction list_constriction(const packing_i_pore_network *n,
                                              const packing_i_pore_edge *e,
                                              const places *at)
{
  packing_constriction c = {0};
  c.a = at->index[e->a];
  c.b = at->index[e->b];
  packing_i_image_decode(e->image + at->image[e->b] - at->image[e->a], c.image);
  c.centre = e->centre;
  (void)settle(n, &c.centre);
  c.radius = e->radius;
  c.limit = e->limit;
  for (int k = 0; k < 3; k++)
    c.particles[k] = k < n->dim ? e->particle[k] : PACKING_NO_INDEX;
  return c;
}

static void list_constrictions(const packing_i_pore_network *n, packing_pores *p,
                               const places *at)
{
  for (size_t i = 0; i < n->edges; i++) {
    const packing_constriction c = list_constriction(n, &n->edge[i], at);
    p->constriction[i] = c;
    p->pore[c.a].coordination++;
    p->pore[c.b].coordination++;
  }
}

static double mean_of(const double *sorted, size_t count)
{
  packing_i_sum sum = {0, 0};
  for (size_t i = 0; i < count; i++)
    packing_i_sum_add(&sum, sorted[i] / sorted[count - 1]);
  return packing_i_sum_value(&sum) / (double)count * sorted[count - 1];
}

static void sum_up_sizes(packing_pores *p)
{
  packing_pores_report *r = &p->report;
  double *const least[2] = {&r->min_r, &r->min_constriction_r};
  double *const mean[2] = {&r->mean_r, &r->mean_constriction_r};
  double *const most[2] = {&r->max_r, &r->max_constriction_r};
  for (size_t i = 0; i < r->pores; i++)
    if (p->pore[i].limit == PACKING_PORE_FREE)
      p->radii[0][p->free[0]++] = p->pore[i].radius;
  for (size_t i = 0; i < r->constrictions; i++)
    if (p->constriction[i].limit == PACKING_PORE_FREE)
      p->radii[1][p->free[1]++] = p->constriction[i].radius;
  for (int k = 0; k < 2; k++) {
    const size_t count = p->free[k];
    gsl_sort(p->radii[k], 1, count);
    *least[k] = count > 0 ? p->radii[k][0] : (double)NAN;
    *mean[k] = count > 0 ? mean_of(p->radii[k], count) : (double)NAN;
    *most[k] = count > 0 ? p->radii[k][count - 1] : (double)NAN;
  }
}

static void sum_up(const packing_i_pore_network *n, packing_pores *p)
{
  packing_pores_report *r = &p->report;
  r->dim = n->dim;
  r->cells = n->cells;
  r->hidden = n->hidden;
  r->closed_constrictions = n->closed_edges;
  for (uint32_t i = 0; i < n->cells; i++) {
    r->flat_cells += n->cell[i].state == PACKING_I_PORE_FLAT;
    r->outside += n->cell[i].state == PACKING_I_PORE_OUTSIDE;
    r->closed += n->cell[i].state == PACKING_I_PORE_CLOSED;
  }
  for (size_t i = 0; i < r->pores; i++) {
    r->blocked += p->pore[i].limit == PACKING_PORE_BY_PARTICLE;
    r->cut += p->pore[i].limit == PACKING_PORE_BY_WALL;
  }
  for (size_t i = 0; i < r->constrictions; i++) {
    const packing_pore_limit limit = p->constriction[i].limit;
    r->open_constrictions += limit == PACKING_PORE_OPEN;
    r->blocked_constrictions += limit != PACKING_PORE_OPEN && limit != PACKING_PORE_FREE;
  }
  r->mean_coordination =
      r->pores > 0 ? 2.0 * (double)r->constrictions / (double)r->pores : (double)NAN;
  sum_up_sizes(p);
}

static packing_status make_room(const packing_i_pore_network *n, packing_pores *p,
                                places *at)
{
  p->pore = packing_i_alloc(n->allocator, n->nodes, sizeof *p->pore);
  p->constriction = packing_i_alloc(n->allocator, n->edges, sizeof *p->constriction);
  p->radii[0] = packing_i_alloc(n->allocator, n->nodes, sizeof(double));
  p->radii[1] = packing_i_alloc(n->allocator, n->edges, sizeof(double));
  at->index = packing_i_calloc(n->allocator, n->nodes, sizeof *at->index);
  at->image = packing_i_calloc(n->allocator, n->nodes, sizeof *at->image);
  return p->pore == NULL || p->constriction == NULL || p->radii[0] == NULL ||
                 p->radii[1] == NULL || at->index == NULL || at->image == NULL
             ? packing_i_nomem(n->context)
             : PACKING_OK;
}

packing_status packing_i_pores_list_result(const packing_i_pore_network *n,
                                           packing_pores **pores)
{
  places at = {NULL, NULL};
  packing_pores *p = packing_i_calloc(n->allocator, 1, sizeof *p);
  if (p == NULL)
    return packing_i_nomem(n->context);
  p->context = packing_i_context_hold(n->context);
  p->allocator = n->allocator;
  packing_pores_report_init(&p->report);
  const packing_status status = make_room(n, p, &at);
  if (status == PACKING_OK) {
    p->report.pores = list_pores(n, p->pore, &at);
    p->report.constrictions = n->edges;
    list_constrictions(n, p, &at);
    sum_up(n, p);
  }
  packing_i_free(n->allocator, at.index);
  packing_i_free(n->allocator, at.image);
  if (status == PACKING_OK)
    *pores = p;
  else
    packing_pores_destroy(p);
  return status;
}

void packing_pores_destroy(packing_pores *pores)
{
  if (pores == NULL)
    return;
  packing_context *context = pores->context;
  packing_i_free(pores->allocator, pores->pore);
  packing_i_free(pores->allocator, pores->constriction);
  packing_i_free(pores->allocator, pores->radii[0]);
  packing_i_free(pores->allocator, pores->radii[1]);
  packing_i_free(pores->allocator, pores);
  packing_context_destroy(context);
}

packing_status packing_pores_summary(const packing_pores *pores,
                                     packing_pores_report *report)
{
  if (pores == NULL)
    return PACKING_ERR_INVALID;
  return packing_i_report_write(pores->context, report, &pores->report,
                                sizeof pores->report);
}

/* Entries [first, first + capacity) of a list of `total`, as far as there are. */
static packing_status hand_out(packing_context *context, const void *from, size_t size,
                               size_t total, size_t first, size_t capacity, void *list,
                               size_t *count)
{
  if (list == NULL && capacity > 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "list", PACKING_NO_INDEX, "NULL");
  PACKING_I_TRY(packing_i_check_given(context, "count", count));
  *count = total;
  if (first >= total || capacity == 0)
    return PACKING_OK;
  const size_t some = capacity < total - first ? capacity : total - first;
  memcpy(list, (const char *)from + first * size, some * size);
  return PACKING_OK;
}

packing_status packing_pores_list(const packing_pores *pores, size_t first,
                                  size_t capacity, packing_pore *list, size_t *count)
{
  if (pores == NULL)
    return PACKING_ERR_INVALID;
  return hand_out(pores->context, pores->pore, sizeof *list, pores->report.pores, first,
                  capacity, list, count);
}

packing_status packing_pores_constrictions(const packing_pores *pores, size_t first,
                                           size_t capacity, packing_constriction *list,
                                           size_t *count)
{
  if (pores == NULL)
    return PACKING_ERR_INVALID;
  return hand_out(pores->context, pores->constriction, sizeof *list,
                  pores->report.constrictions, first, capacity, list, count);
}
