/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The audit: largest overlap and smallest gap of two particles, farthest protrusion from the
 * container, equal centres, bad numbers. Shares nothing with the placers but the grid, whose
 * answers the tests hold against all pairs. A maximum is decided by (value, lowest indices), so
 * neither threads nor the order of visits matter. A gap is an overlap below 0: the search goes a
 * little beyond touching, and on in packs in which nothing is that close. Linear in the
 * particles. */
#include "grid/grid_internal.h"
#include "measure/measure_internal.h"
#include "vec.h"
#include "view.h"

/* How far the search goes at first, relative to r_i + r_j: cells of touching particles do. */
#define FIRST_GAP (1.0 / 64)

typedef struct overlaps {
  const packing_grid *grid;
  double limit;
  double most; /* below 0: a gap */
  size_t i;
  size_t j;
  size_t count;
  size_t duplicates;
} overlaps;

typedef struct protrusions {
  double most;
  size_t i;
  size_t count;
} protrusions;

typedef struct audit {
  const packing_domain *domain;
  const packing_view *view;
  const size_t *selection; /* the good particles; NULL: all */
  size_t count;
  double limit;
  const packing_grid *grid;
  packing_i_grid_reach reach;
  overlaps *overlaps;       /* of each block */
  protrusions *protrusions; /* of each block */
} audit;

void packing_audit_def_fill(packing_audit_def *def, size_t size)
{
  packing_audit_def defaults = {0};
  defaults.limit = 1e-9;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* Keeps the larger overlap; of equal ones that of the lower pair. */
static void keep_overlap(overlaps *o, double overlap, size_t i, size_t j)
{
  if (overlap < o->most || (overlap == o->most && (i > o->i || (i == o->i && j >= o->j))))
    return;
  o->most = overlap;
  o->i = i;
  o->j = j;
}

static void judge(overlaps *o, size_t i, size_t j, double d, double r_i, double r_j)
{
  const double overlap = (r_i + r_j - d) / (r_i < r_j ? r_i : r_j);
  o->duplicates += (size_t)(d == 0);
  o->count += (size_t)(overlap > o->limit);
  keep_overlap(o, overlap, i, j);
}

static void judge_pair(void *arg, const packing_i_grid_pair *p)
{
  overlaps *o = arg;
  const packing_grid *g = o->grid;
  const packing_pair ends = packing_i_grid_ends(g, p);
  judge(o, ends.i, ends.j, p->distance, g->r[p->own], g->r[p->other]);
}

static overlaps no_overlap(const audit *a)
{
  const overlaps none = {
      a->grid, a->limit, -(double)INFINITY, PACKING_NO_INDEX, PACKING_NO_INDEX, 0, 0};
  return none;
}

static void judge_block(void *arg, size_t block)
{
  const audit *a = arg;
  a->overlaps[block] = no_overlap(a);
  packing_i_grid_visit(a->grid, &a->reach, block, judge_pair, &a->overlaps[block]);
}

/* A container that answers NaN holds nothing. */
static double protrusion_of(const packing_domain *domain, packing_vec3 p, double r)
{
  if (packing_domain_dim(domain) == 2)
    p.z = 0;
  const double protrusion = (r - packing_domain_signed_distance(domain, &p, NULL)) / r;
  return isnan(protrusion) ? (double)INFINITY : protrusion;
}

static void protrude_block(void *arg, size_t block)
{
  const audit *a = arg;
  const packing_i_planar *walls = packing_i_domain_planar(a->domain);
  const int quick = a->domain->body.ops->clear != NULL;
  protrusions found = {0, PACKING_NO_INDEX, 0};
  const size_t end = packing_i_measure_block_end(block, a->count);
  for (size_t k = block * PACKING_I_MEASURE_BLOCK; k < end; k++) {
    const size_t i = a->selection == NULL ? k : a->selection[k];
    const packing_vec3 p = packing_i_view_centre(a->view, i);
    const double r = packing_i_view_r(a->view, i);
    if (packing_i_measure_is_clear(walls, p, r) ||
        (quick && packing_i_domain_clear(a->domain, &p, r)))
      continue;
    const double protrusion = protrusion_of(a->domain, p, r);
    found.count += (size_t)(protrusion > a->limit);
    if (protrusion > found.most) {
      found.most = protrusion;
      found.i = i;
    }
  }
  a->protrusions[block] = found;
}

/* A particle wider than a period overlaps its own image: a pair of itself. A narrower one has a
 * gap to it. */
static void judge_images(const audit *a, overlaps *all)
{
  if (a->domain == NULL || packing_domain_periodic(a->domain) == 0)
    return;
  const packing_vec3 period = a->domain->body.period;
  const double least = fmin(fmin(period.x, period.y), period.z);
  for (size_t k = 0; k < a->count; k++) {
    const size_t i = a->selection == NULL ? k : a->selection[k];
    const double r = packing_i_view_r(a->view, i);
    judge(all, i, i, least, r, r);
  }
}

/* All pairs within reach. */
static packing_status judge_all(packing_context *context, audit *a, overlaps *all)
{
  packing_grid *grid = NULL;
  PACKING_I_TRY(packing_i_grid_build(context, PACKING_I_GRID_LEVELS, a->domain, a->view,
                                     a->selection, a->count, &a->reach, &grid));
  const size_t blocks = packing_i_grid_blocks(grid);
  const packing_allocator *allocator = packing_i_allocator(context);
  a->grid = grid;
  *all = no_overlap(a);
  a->overlaps = packing_i_alloc(allocator, blocks, sizeof *a->overlaps);
  if (a->overlaps == NULL) {
    packing_grid_destroy(grid);
    return packing_i_nomem(context);
  }
  packing_i_parallel(context, blocks, judge_block, a);
  for (size_t b = 0; b < blocks; b++) {
    const overlaps *o = &a->overlaps[b];
    all->count += o->count;
    all->duplicates += o->duplicates;
    keep_overlap(all, o->most, o->i, o->j);
  }
  packing_i_free(allocator, a->overlaps);
  packing_grid_destroy(grid);
  return PACKING_OK;
}

/* A gap is relative to the smaller radius, at most half of r_i + r_j: up to twice the relative
 * reach none is missed. Until one is found the reach is made 16 times as long. */
static packing_status audit_overlaps(packing_context *context, audit *a,
                                     packing_audit_report *report)
{
  overlaps all;
  for (double gap = FIRST_GAP;; gap *= 16) {
    a->reach.factor = 1 + gap;
    PACKING_I_TRY(judge_all(context, a, &all));
    if (a->count < 2 || 0.0 - all.most <= 2 * gap)
      break;
  }
  judge_images(a, &all);
  report->overlaps = all.count;
  report->duplicates = all.duplicates;
  report->min_gap = 0.0 - all.most;
  report->gap_i = all.i;
  report->gap_j = all.j;
  if (all.most > 0) {
    report->max_overlap = all.most;
    report->overlap_i = all.i;
    report->overlap_j = all.j;
  }
  return PACKING_OK;
}

static packing_status audit_protrusions(packing_context *context, audit *a,
                                        packing_audit_report *report)
{
  if (a->domain == NULL)
    return PACKING_OK;
  const size_t blocks = packing_i_measure_blocks(a->count);
  const packing_allocator *allocator = packing_i_allocator(context);
  a->protrusions = packing_i_alloc(allocator, blocks, sizeof *a->protrusions);
  if (a->protrusions == NULL)
    return packing_i_nomem(context);
  packing_i_parallel(context, blocks, protrude_block, a);
  for (size_t b = 0; b < blocks; b++) {
    const protrusions *p = &a->protrusions[b];
    report->protrusions += p->count;
    if (p->most > report->max_protrusion) {
      report->max_protrusion = p->most;
      report->protrusion_i = p->i;
    }
  }
  packing_i_free(allocator, a->protrusions);
  return PACKING_OK;
}

/* Counts bad numbers and, if there are any, lists the rest. */
static packing_status sort_out(packing_context *context, audit *a, size_t **selection,
                               packing_audit_report *report)
{
  const packing_view *v = a->view;
  const int flat = a->domain != NULL && packing_domain_dim(a->domain) == 2;
  for (size_t i = 0; i < v->count; i++)
    if (!packing_i_measure_is_good(v, i, flat) && report->bad_numbers++ == 0)
      report->bad_number_i = i;
  a->count = v->count - report->bad_numbers;
  if (report->bad_numbers == 0)
    return PACKING_OK;
  size_t *good = packing_i_alloc(packing_i_allocator(context), a->count, sizeof *good);
  if (good == NULL)
    return packing_i_nomem(context);
  size_t count = 0;
  for (size_t i = 0; i < v->count; i++)
    if (packing_i_measure_is_good(v, i, flat))
      good[count++] = i;
  a->selection = *selection = good;
  return PACKING_OK;
}

packing_status packing_audit(packing_context *context, const packing_audit_def *def,
                             packing_domain *domain, const packing_view *view,
                             packing_audit_report *report)
{
  packing_audit_def d;
  packing_view v;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_audit, limit, def, &d));
  PACKING_I_TRY(packing_i_check_not_negative(context, "limit", d.limit));
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  packing_audit_report found;
  packing_audit_report_init(&found);
  found.overlap_i = found.overlap_j = found.gap_i = found.gap_j = PACKING_NO_INDEX;
  found.protrusion_i = found.bad_number_i = PACKING_NO_INDEX;
  size_t *selection = NULL;
  audit a = {0};
  a.domain = domain;
  a.view = &v;
  a.limit = d.limit;
  packing_status status = sort_out(context, &a, &selection, &found);
  if (status == PACKING_OK)
    status = audit_overlaps(context, &a, &found);
  if (status == PACKING_OK)
    status = audit_protrusions(context, &a, &found);
  packing_i_free(packing_i_allocator(context), selection);
  if (status != PACKING_OK)
    return status;
  found.passed = found.bad_numbers == 0 && found.max_overlap <= d.limit &&
                 found.max_protrusion <= d.limit;
  return packing_i_report_write(context, report, &found, sizeof found);
}
