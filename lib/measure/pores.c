/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pore network as users see it: from options to lists. doc/methods/pores.md tells the method;
 * its steps are named in pores_internal.h. */
#include "measure/pores_internal.h"
#include "measure/pores_result.h"
#include "vec.h"

void packing_pores_def_fill(packing_pores_def *def, size_t size)
{
  packing_pores_def defaults = {0};
  defaults.merge = PACKING_PORES_MERGE_NONE;
  defaults.overlap = 0.5;
  defaults.tolerance = 1e-6;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_def(packing_context *context, const packing_pores_def *d,
                                const packing_domain *domain)
{
  const int merge = (int)d->merge;
  if (d->dim != 0 && d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 0, 2 or 3", d->dim);
  if (d->dim != 0 && domain != NULL && d->dim != packing_domain_dim(domain))
    return packing_i_fail(context, PACKING_ERR_INVALID, "dim", PACKING_NO_INDEX,
                          "%d, but the domain has %d", d->dim,
                          packing_domain_dim(domain));
  if (merge != PACKING_PORES_MERGE_NONE && merge != PACKING_PORES_MERGE_OVERLAP)
    return packing_i_fail(context, PACKING_ERR_INVALID, "merge", PACKING_NO_INDEX,
                          "%d is no way of merging", merge);
  PACKING_I_TRY(packing_i_check_not_negative(context, "overlap", d->overlap));
  if (d->overlap > 1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "overlap", PACKING_NO_INDEX,
                          "%g, must be at most 1", d->overlap);
  PACKING_I_TRY(packing_i_check_positive(context, "tolerance", d->tolerance));
  if (d->tolerance > 0.1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "tolerance", PACKING_NO_INDEX,
                          "%g, must be at most 0.1", d->tolerance);
  return PACKING_OK;
}

/* A box around the spheres. */
static void set_box(packing_i_pore_network *n)
{
  packing_bounds *b = &n->box;
  b->lo = packing_i_vec(INFINITY, INFINITY, INFINITY);
  b->hi = packing_i_vec(-INFINITY, -INFINITY, -INFINITY);
  for (size_t i = 0; i < n->count; i++) {
    b->lo =
        packing_i_vec(fmin(b->lo.x, n->x[i] - n->r[i]), fmin(b->lo.y, n->y[i] - n->r[i]),
                      fmin(b->lo.z, n->z[i] - n->r[i]));
    b->hi =
        packing_i_vec(fmax(b->hi.x, n->x[i] + n->r[i]), fmax(b->hi.y, n->y[i] + n->r[i]),
                      fmax(b->hi.z, n->z[i] + n->r[i]));
  }
}

static void set_domain(packing_i_pore_network *n, const packing_domain *domain)
{
  n->domain = domain;
  n->dim = domain != NULL ? packing_domain_dim(domain) : n->def.dim == 2 ? 2 : 3;
  if (domain == NULL)
    return;
  n->periodic = packing_domain_periodic(domain);
  packing_domain_bounds(domain, &n->box);
  n->origin.x = n->periodic & PACKING_PERIODIC_X ? n->box.lo.x : 0;
  n->origin.y = n->periodic & PACKING_PERIODIC_Y ? n->box.lo.y : 0;
  n->origin.z = n->periodic & PACKING_PERIODIC_Z ? n->box.lo.z : 0;
}

/* Without a domain the grid looks at what was taken in, whose z is 0 in the plane. */
static packing_status build_grid(packing_i_pore_network *n, const packing_view *view)
{
  packing_view own;
  packing_view_init_arrays(&own, n->count, n->x, n->y, n->z, n->r);
  return packing_i_grid_build(n->context, PACKING_I_GRID_LEVELS, n->domain,
                              n->domain != NULL ? view : &own, NULL, n->count, NULL,
                              &n->grid);
}

static packing_status build(packing_i_pore_network *n, const packing_view *view)
{
  PACKING_I_TRY(packing_i_pores_take(n, view));
  if (n->domain == NULL)
    set_box(n);
  PACKING_I_TRY(build_grid(n, view));
  PACKING_I_TRY(packing_i_pores_triangulate(n));
  packing_i_pores_fill_cells(n);
  PACKING_I_TRY(packing_i_pores_make_nodes(n));
  PACKING_I_TRY(packing_i_pores_make_edges(n));
  if (n->def.merge == PACKING_PORES_MERGE_OVERLAP)
    PACKING_I_TRY(packing_i_pores_merge_nodes(n));
  return PACKING_OK;
}

static void release(packing_i_pore_network *n)
{
  void *const blocks[] = {n->x,          n->y,     n->z,    n->r,
                          n->particle,   n->image, n->cell, n->node_of,
                          n->node_shift, n->node,  n->edge};
  for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++)
    packing_i_free(n->allocator, blocks[i]);
  packing_grid_destroy(n->grid);
}

packing_status packing_pores_create(packing_context *context,
                                    const packing_pores_def *def, packing_domain *domain,
                                    const packing_view *view, packing_pores **pores)
{
  packing_view v;
  packing_i_pore_network n = {0};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_pores, tolerance, def, &n.def));
  PACKING_I_TRY(check_def(context, &n.def, domain));
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  PACKING_I_TRY(packing_i_check_given(context, "pores", pores));
  n.context = context;
  n.allocator = packing_i_allocator(context);
  set_domain(&n, domain);
  PACKING_I_TRY(packing_i_measure_check(context, &v, n.dim == 2));
  packing_status status = build(&n, &v);
  if (status == PACKING_OK)
    status = packing_i_pores_list_result(&n, pores);
  release(&n);
  return status;
}
