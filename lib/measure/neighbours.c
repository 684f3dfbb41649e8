/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of neighbours, for the measures of order. A bond names its neighbour and by how many
 * periods that is moved, so bonds of images can be compared without a tolerance. */
#include "grid/grid_internal.h"
#include "measure/order_internal.h"
#include "view.h"

enum { MOST_NEAREST = 256 };

void packing_neighbours_def_fill(packing_neighbours_def *def, size_t size)
{
  packing_neighbours_def defaults = {0};
  defaults.kind = PACKING_NEIGHBOURS_WITHIN;
  defaults.factor = 1.2;
  defaults.nearest = 12;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

int packing_i_bond_compare(const packing_i_bond *a, const packing_i_bond *b)
{
  if (a->j != b->j)
    return a->j < b->j ? -1 : 1;
  for (int k = 0; k < 3; k++)
    if (a->image[k] != b->image[k])
      return a->image[k] < b->image[k] ? -1 : 1;
  return 0;
}

double packing_i_measure_depth(const packing_domain *domain, packing_vec3 p)
{
  const double wall = packing_domain_signed_distance(domain, &p, NULL);
  const int axis = domain->body.open_axis;
  if (axis < 0)
    return wall;
  const double top = packing_i_component(domain->body.bounds.hi, axis);
  return fmin(wall, top - packing_i_component(p, axis));
}

static packing_status check_def(packing_context *context, const packing_neighbours_def *d,
                                const packing_domain *domain)
{
  if (d->kind != PACKING_NEIGHBOURS_WITHIN && d->kind != PACKING_NEIGHBOURS_NEAREST)
    return packing_i_fail(context, PACKING_ERR_RANGE, "kind", PACKING_NO_INDEX,
                          "%d is no kind of neighbours", (int)d->kind);
  PACKING_I_TRY(packing_i_check_positive(context, "factor", d->factor));
  PACKING_I_TRY(packing_i_check_not_negative(context, "gap", d->gap));
  PACKING_I_TRY(packing_i_check_not_negative(context, "margin", d->margin));
  if (d->nearest < 1 || d->nearest > MOST_NEAREST)
    return packing_i_fail(context, PACKING_ERR_RANGE, "nearest", PACKING_NO_INDEX,
                          "%zu, must be 1 to %d", d->nearest, MOST_NEAREST);
  if (domain == NULL && d->margin > 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "margin", PACKING_NO_INDEX,
                          "%g, but there is no domain to keep it from", d->margin);
  if (domain == NULL && d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2 or 3", d->dim);
  return PACKING_OK;
}

packing_status packing_i_measure_places(packing_context *context,
                                        const packing_domain *domain,
                                        const packing_view *view, size_t *index)
{
  packing_grid *grid = NULL;
  packing_view points = *view;
  double sum = 0;
  for (size_t i = 0; i < view->count; i++)
    sum += packing_i_view_r(view, i);
  const double r = sum / (double)view->count;
  points.r.data = &r;
  points.r.stride = 0;
  PACKING_I_TRY(
      packing_i_grid_build(context, 1, domain, &points, NULL, view->count, NULL, &grid));
  memcpy(index, grid->index, view->count * sizeof *index);
  packing_grid_destroy(grid);
  return PACKING_OK;
}

/* Centres into the cell and, where flat, onto the plane. */
static void copy_centres(packing_neighbours *n, const packing_domain *domain,
                         const packing_view *view)
{
  for (size_t k = 0; k < n->count; k++) {
    packing_vec3 p = packing_i_view_centre(view, n->index[k]);
    if (n->flat)
      p.z = 0;
    if (domain != NULL)
      packing_domain_wrap(domain, &p);
    n->centre[k] = p;
    n->place[n->index[k]] = k;
  }
}

static void mark_counted(packing_neighbours *n, const packing_domain *domain,
                         double margin)
{
  memset(n->counts, 1, n->count);
  if (domain == NULL || margin == 0)
    return;
  for (size_t k = 0; k < n->count; k++)
    n->counts[k] = packing_i_measure_depth(domain, n->centre[k]) >= margin;
}

static void note_periods(packing_neighbours *n, const packing_domain *domain)
{
  const unsigned periodic = domain == NULL ? 0 : packing_domain_periodic(domain);
  n->period.x = periodic & PACKING_PERIODIC_X ? domain->body.period.x : 0;
  n->period.y = periodic & PACKING_PERIODIC_Y ? domain->body.period.y : 0;
  n->period.z = periodic & PACKING_PERIODIC_Z ? domain->body.period.z : 0;
}

/* With the radii in the order of places. */
static packing_status find_bonds(packing_context *context, packing_neighbours *n,
                                 const packing_neighbours_def *d,
                                 const packing_domain *domain, const packing_view *view)
{
  packing_view places;
  packing_status status = PACKING_OK;
  double *r = packing_i_alloc(n->allocator, n->count, sizeof *r);
  if (r == NULL)
    return packing_i_nomem(context);
  for (size_t k = 0; k < n->count; k++)
    r[k] = packing_i_view_r(view, n->index[k]);
  packing_view_init_arrays(&places, n->count, &n->centre->x, &n->centre->y, &n->centre->z,
                           r);
  places.x.stride = places.y.stride = places.z.stride = sizeof *n->centre;
  status =
      d->kind == PACKING_NEIGHBOURS_NEAREST
          ? packing_i_neighbours_nearest(context, n, &places, d->nearest)
          : packing_i_neighbours_within(context, n, domain, &places, d->factor, d->gap);
  packing_i_free(n->allocator, r);
  return status;
}

static packing_status fill(packing_context *context, packing_neighbours *n,
                           const packing_neighbours_def *d, const packing_domain *domain,
                           const packing_view *view)
{
  const packing_allocator *allocator = n->allocator;
  n->index = packing_i_alloc(allocator, n->count, sizeof *n->index);
  n->place = packing_i_alloc(allocator, n->count, sizeof *n->place);
  n->centre = packing_i_alloc(allocator, n->count, sizeof *n->centre);
  n->counts = packing_i_alloc(allocator, n->count, 1);
  n->start = packing_i_calloc(allocator, n->count + 1, sizeof *n->start);
  if (n->index == NULL || n->place == NULL || n->centre == NULL || n->counts == NULL ||
      n->start == NULL)
    return packing_i_nomem(context);
  if (n->count == 0)
    return PACKING_OK;
  note_periods(n, domain);
  PACKING_I_TRY(packing_i_measure_places(context, domain, view, n->index));
  copy_centres(n, domain, view);
  mark_counted(n, domain, d->margin);
  return find_bonds(context, n, d, domain, view);
}

packing_status packing_neighbours_create(packing_context *context,
                                         const packing_neighbours_def *def,
                                         packing_domain *domain, const packing_view *view,
                                         packing_neighbours **neighbours)
{
  packing_neighbours_def d;
  packing_view v;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_neighbours, dim, def, &d));
  PACKING_I_TRY(check_def(context, &d, domain));
  PACKING_I_TRY(packing_i_check_given(context, "neighbours", neighbours));
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  const int flat = (domain == NULL ? d.dim : packing_domain_dim(domain)) == 2;
  PACKING_I_TRY(packing_i_measure_check(context, &v, flat));
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_neighbours *n = packing_i_calloc(allocator, 1, sizeof *n);
  if (n == NULL)
    return packing_i_nomem(context);
  n->context = packing_i_context_hold(context);
  n->allocator = allocator;
  n->kind = d.kind;
  n->flat = flat;
  n->count = v.count;
  const packing_status status = fill(context, n, &d, domain, &v);
  if (status == PACKING_OK)
    *neighbours = n;
  else
    packing_neighbours_destroy(n);
  return status;
}

void packing_neighbours_destroy(packing_neighbours *neighbours)
{
  if (neighbours == NULL)
    return;
  packing_context *context = neighbours->context;
  const packing_allocator *allocator = neighbours->allocator;
  packing_i_free(allocator, neighbours->index);
  packing_i_free(allocator, neighbours->place);
  packing_i_free(allocator, neighbours->centre);
  packing_i_free(allocator, neighbours->counts);
  packing_i_free(allocator, neighbours->start);
  packing_i_free(allocator, neighbours->bonds);
  packing_i_free(allocator, neighbours);
  packing_context_destroy(context);
}

size_t packing_neighbours_count(const packing_neighbours *neighbours)
{
  return neighbours->count;
}

packing_status packing_neighbours_of(const packing_neighbours *neighbours, size_t i,
                                     packing_neighbour *list, size_t capacity,
                                     size_t *count)
{
  const packing_neighbours *n = neighbours;
  if (n == NULL)
    return PACKING_ERR_INVALID;
  PACKING_I_TRY(packing_i_check_given(n->context, "count", count));
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(n->context, "list", list));
  if (i >= n->count)
    return packing_i_fail(n->context, PACKING_ERR_RANGE, "i", i,
                          "%zu, there are %zu particles", i, n->count);
  const size_t at = n->place[i], there = n->start[at + 1] - n->start[at];
  const packing_i_bond *bonds = n->bonds + n->start[at];
  for (size_t k = 0; k < there && k < capacity; k++) {
    list[k].j = n->index[bonds[k].j];
    list[k].d = packing_i_bond_vector(n, at, &bonds[k]);
    list[k].distance = packing_i_norm(list[k].d);
  }
  *count = there;
  return PACKING_OK;
}
