/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts: how many, how they are spread, and how many are left a particle once those with
 * fewer than dim + 1 (which nothing holds in place) are taken out, over and over (as in
 * L. E. Silbert, Soft Matter 6, 2010, 2918; D. Weaire's "rattlers"). Linear in particles and
 * contacts. */
#include "grid/grid_internal.h"
#include "measure/measure_internal.h"

typedef struct contact {
  size_t i;
  size_t j;
} contact;

/* The contacts of one block: counted first, then listed from `next` on. */
typedef struct listing {
  const packing_grid *grid;
  double tolerance;
  size_t count;
  contact *next;
} listing;

typedef struct search {
  const packing_grid *grid;
  packing_i_grid_reach reach;
  packing_i_pair_function fn;
  listing *listings; /* of each block */
} search;

/* Who touches whom: partners of i are partner[start[i]] .. partner[start[i + 1] - 1]. */
typedef struct network {
  size_t count;
  size_t contacts;
  contact *list;
  size_t *degree;
  size_t *start;
  size_t *partner;
  size_t *removed; /* in order */
} network;

void packing_coordination_def_fill(packing_coordination_def *def, size_t size)
{
  packing_coordination_def defaults = {0};
  defaults.tolerance = 1e-9;
  defaults.dim = 3;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static int touches(const listing *l, const packing_i_grid_pair *p)
{
  const double r = l->grid->r[p->own] + l->grid->r[p->other];
  return p->distance - r <= l->tolerance * r;
}

static void count_contact(void *arg, const packing_i_grid_pair *p)
{
  listing *l = arg;
  l->count += (size_t)touches(l, p);
}

static void list_contact(void *arg, const packing_i_grid_pair *p)
{
  listing *l = arg;
  if (!touches(l, p))
    return;
  const packing_pair ends = packing_i_grid_ends(l->grid, p);
  l->next->i = ends.i;
  l->next->j = ends.j;
  l->next++;
}

static void search_block(void *arg, size_t block)
{
  const search *s = arg;
  packing_i_grid_visit(s->grid, &s->reach, block, s->fn, &s->listings[block]);
}

/* Finds all contacts: counts them block by block, makes room, lists them. */
static packing_status find_contacts(packing_context *context, const packing_grid *grid,
                                    double tolerance, network *n)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t blocks = packing_i_grid_blocks(grid);
  search s = {grid, {1.0 + tolerance, 0.0, 0}, count_contact, NULL};
  s.listings = packing_i_calloc(allocator, blocks, sizeof *s.listings);
  if (s.listings == NULL)
    return packing_i_nomem(context);
  for (size_t b = 0; b < blocks; b++)
    s.listings[b] = (listing){grid, tolerance, 0, NULL};
  packing_i_parallel(context, blocks, search_block, &s);
  for (size_t b = 0; b < blocks; b++)
    n->contacts += s.listings[b].count;
  n->list = packing_i_alloc(allocator, n->contacts, sizeof *n->list);
  if (n->list != NULL) {
    contact *next = n->list;
    for (size_t b = 0; b < blocks; b++) {
      s.listings[b].next = next;
      next += s.listings[b].count;
    }
    s.fn = list_contact;
    packing_i_parallel(context, blocks, search_block, &s);
  }
  packing_i_free(allocator, s.listings);
  return n->list == NULL ? packing_i_nomem(context) : PACKING_OK;
}

static void count_degrees(network *n, packing_coordination_report *report)
{
  for (size_t k = 0; k < n->contacts; k++) {
    n->degree[n->list[k].i]++;
    n->degree[n->list[k].j]++;
  }
  for (size_t i = 0; i < n->count; i++) {
    const size_t last = PACKING_COORDINATION_BINS - 1;
    report->histogram[n->degree[i] < last ? n->degree[i] : last]++;
  }
}

/* Partners of each particle; start[] is moved to the right place by filling backwards. */
static void connect(network *n)
{
  size_t end = 0;
  for (size_t i = 0; i < n->count; i++) {
    end += n->degree[i];
    n->start[i] = end;
  }
  n->start[n->count] = end;
  for (size_t k = 0; k < n->contacts; k++) {
    const contact *c = &n->list[k];
    n->partner[--n->start[c->i]] = c->j;
    n->partner[--n->start[c->j]] = c->i;
  }
}

/* Takes out whoever has fewer than `least` contacts left; returns how many. A particle stands
 * in removed[] from the moment its contacts sink below. */
static size_t remove_rattlers(network *n, size_t least)
{
  size_t removed = 0;
  for (size_t i = 0; i < n->count; i++)
    if (n->degree[i] < least)
      n->removed[removed++] = i;
  for (size_t k = 0; k < removed; k++) {
    const size_t i = n->removed[k];
    for (size_t p = n->start[i]; p < n->start[i + 1]; p++)
      if (n->degree[n->partner[p]]-- == least)
        n->removed[removed++] = n->partner[p];
  }
  return removed;
}

static packing_status find_rattlers(packing_context *context, network *n, size_t least,
                                    packing_coordination_report *report)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  n->start = packing_i_alloc(allocator, n->count + 1, sizeof *n->start);
  n->partner = packing_i_alloc(allocator, 2 * n->contacts, sizeof *n->partner);
  n->removed = packing_i_alloc(allocator, n->count, sizeof *n->removed);
  if (n->start == NULL || n->partner == NULL || n->removed == NULL)
    return packing_i_nomem(context);
  connect(n);
  report->rattlers = remove_rattlers(n, least);
  size_t ends = 0;
  for (size_t i = 0; i < n->count; i++)
    ends += n->degree[i];
  for (size_t k = 0; k < report->rattlers; k++)
    ends -= n->degree[n->removed[k]]; /* contacts with those that stay */
  report->mean_no_rattlers = n->count == report->rattlers
                                 ? (double)NAN
                                 : (double)ends / (double)(n->count - report->rattlers);
  return PACKING_OK;
}

static packing_status measure(packing_context *context, const packing_coordination_def *d,
                              const packing_grid *grid,
                              packing_coordination_report *report)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  network n = {0};
  n.count = grid->count;
  packing_status status = find_contacts(context, grid, d->tolerance, &n);
  if (status != PACKING_OK)
    goto out;
  n.degree = packing_i_calloc(allocator, n.count, sizeof *n.degree);
  if (n.degree == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  report->contacts = n.contacts;
  report->mean = n.count == 0 ? (double)NAN : 2.0 * (double)n.contacts / (double)n.count;
  count_degrees(&n, report);
  status = find_rattlers(context, &n, (size_t)d->dim + 1, report);
out:
  packing_i_free(allocator, n.list);
  packing_i_free(allocator, n.degree);
  packing_i_free(allocator, n.start);
  packing_i_free(allocator, n.partner);
  packing_i_free(allocator, n.removed);
  return status;
}

packing_status packing_measure_coordination(packing_context *context,
                                            const packing_coordination_def *def,
                                            packing_domain *domain,
                                            const packing_view *view,
                                            packing_coordination_report *report)
{
  packing_coordination_def d;
  packing_view v;
  packing_grid *grid = NULL;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_coordination, dim, def, &d));
  PACKING_I_TRY(packing_i_check_not_negative(context, "tolerance", d.tolerance));
  if (d.dim != 2 && d.dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2 or 3", d.dim);
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  packing_coordination_report found;
  packing_coordination_report_init(&found);
  PACKING_I_TRY(packing_i_grid_build(context, PACKING_I_GRID_LEVELS, domain, &v, NULL,
                                     v.count, &grid));
  const packing_status status = measure(context, &d, grid, &found);
  packing_grid_destroy(grid);
  if (status != PACKING_OK)
    return status;
  return packing_i_report_write(context, report, &found, sizeof found);
}
