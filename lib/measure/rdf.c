/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Radial distribution: g = partners in a shell / (centres * density of partners * volume of the
 * shell) (J.-P. Hansen, I. R. McDonald, Theory of Simple Liquids, 2013, equation 2.5.8; by exact
 * volumes of shells, and with the density N / V also where N is small). Walls are dealt with by
 * taking only centres so far inside that no shell meets one. Counts are whole numbers, so the
 * order of adding does not matter; they go to a few lanes of bins, not to one set a block.
 * Linear in pairs; memory goes with particles and bins. */
#include "measure/images.h"
#include "measure/order_internal.h"
#include "view.h"

#define DEFAULT_REACH 5.0 /* mean diameters */
#define SMALLEST_REACH 1e-140
#define LARGEST_REACH 1e140
#define MOST_PERIODS 30000 /* packing_i_image counts no more */

enum {
  LANES = 64,
  LANE_BINS = 1 << 20, /* of all lanes together, unless a single one has more */
  MOST_BINS = 1 << 24
};

enum { CENTRE = 1, PARTNER = 2 /* count_pair() leans on the values */ };

typedef struct rdf {
  const packing_domain *domain;
  const packing_view *view;
  packing_rdf_def def;
  int dim;
  int walled;    /* whether the centres are a part of the particles */
  double unit;   /* of the bins' radii: 1 or the mean diameter */
  double width;  /* of a bin, in units */
  double r_max;  /* [L] */
  double step;   /* width of a bin [L] */
  double margin; /* [L] */
  double mean_d;
  unsigned char *role;   /* of each particle: sum of CENTRE and PARTNER */
  unsigned char *placed; /* the same, in the order of the grid */
  const packing_grid *grid;
  const packing_i_grid_reach *reach;
  size_t blocks;
  size_t lanes;
  uint64_t *counts; /* of each lane, its bins */
} rdf;

typedef struct lane {
  const rdf *rdf;
  uint64_t *counts;
} lane;

void packing_rdf_def_fill(packing_rdf_def *def, size_t size)
{
  packing_rdf_def defaults = {0};
  defaults.r_max = DEFAULT_REACH;
  defaults.bins = 100;
  defaults.in_diameters = 1;
  defaults.margin = -1;
  defaults.by = PACKING_RDF_ALL;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_def(packing_context *context, const packing_rdf_def *d)
{
  PACKING_I_TRY(packing_i_check_positive(context, "r_max", d->r_max));
  PACKING_I_TRY(packing_i_check_switch(context, "in_diameters", d->in_diameters));
  if (d->bins < 1 || d->bins > MOST_BINS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "bins", PACKING_NO_INDEX,
                          "%zu, must be 1 to %d", d->bins, MOST_BINS);
  if (d->margin != -1)
    PACKING_I_TRY(packing_i_check_not_negative(context, "margin", d->margin));
  if ((int)d->by < PACKING_RDF_ALL || (int)d->by > PACKING_RDF_TYPE)
    return packing_i_fail(context, PACKING_ERR_RANGE, "by", PACKING_NO_INDEX,
                          "%d tells no particles apart", (int)d->by);
  return PACKING_OK;
}

static packing_status check_arguments(packing_context *context, const packing_rdf_def *d,
                                      const packing_domain *domain,
                                      const packing_view *view,
                                      const packing_rdf_bin *bins, size_t capacity,
                                      const packing_rdf_report *report)
{
  PACKING_I_TRY(check_def(context, d));
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(context, "bins", bins));
  PACKING_I_TRY(packing_i_report_check(context, report));
  if (d->by == PACKING_RDF_COMPONENT && view->component.data == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "component", PACKING_NO_INDEX,
                          "the view has no such column");
  return packing_i_measure_check(context, view, packing_domain_dim(domain) == 2);
}

static int is_walled(const packing_domain *domain)
{
  const unsigned all = packing_domain_dim(domain) == 2 ? 3 : 7;
  return packing_domain_periodic(domain) != all;
}

/* Lengths, from the mean diameter where they are in that. */
static packing_status take_measures(packing_context *context, rdf *f)
{
  double sum = 0, largest = 0;
  for (size_t i = 0; i < f->view->count; i++) {
    const double r = packing_i_view_r(f->view, i);
    sum += 2 * r;
    largest = fmax(largest, r);
  }
  f->mean_d = sum / (double)f->view->count;
  f->unit = f->def.in_diameters && f->view->count > 0 ? f->mean_d : 1;
  f->width = f->def.r_max / (double)f->def.bins;
  f->r_max = f->def.r_max * f->unit;
  f->step = f->width * f->unit;
  f->walled = is_walled(f->domain);
  f->margin = !f->walled           ? 0
              : f->def.margin >= 0 ? f->def.margin * f->unit
                                   : f->r_max + largest;
  if (!(f->r_max >= SMALLEST_REACH && f->r_max <= LARGEST_REACH))
    return packing_i_fail(context, PACKING_ERR_RANGE, "r_max", PACKING_NO_INDEX,
                          "%g is not within %g and %g", f->r_max, SMALLEST_REACH,
                          LARGEST_REACH);
  const packing_vec3 period = f->domain->body.period;
  const double least = fmin(fmin(period.x, period.y), period.z);
  if (f->r_max > MOST_PERIODS * least)
    return packing_i_fail(context, PACKING_ERR_RANGE, "r_max", PACKING_NO_INDEX,
                          "%g is more than %d periods of %g", f->r_max, MOST_PERIODS,
                          least);
  return PACKING_OK;
}

static int kind_of(const rdf *f, size_t i)
{
  const packing_column *c =
      f->def.by == PACKING_RDF_TYPE ? &f->view->type : &f->view->component;
  return c->data == NULL
             ? 1
             : *(const int32_t *)(const void *)((const char *)c->data + i * c->stride);
}

static unsigned char role_of(const rdf *f, size_t i)
{
  if (f->def.by == PACKING_RDF_ALL)
    return CENTRE | PARTNER;
  const int kind = kind_of(f, i);
  const int role =
      (kind == f->def.centres ? CENTRE : 0) | (kind == f->def.partners ? PARTNER : 0);
  return (unsigned char)role;
}

/* Roles, and how many partners stand in the region that gives the density: at least the margin
 * from the walls, under the open top. Centres keep the margin from that too. */
static size_t give_roles(rdf *f, packing_rdf_report *report)
{
  size_t inner = 0;
  for (size_t i = 0; i < f->view->count; i++) {
    unsigned char role = role_of(f, i);
    int inside = 1, deep = 1;
    if (f->walled) {
      packing_vec3 p = packing_i_view_centre(f->view, i);
      if (f->dim == 2)
        p.z = 0;
      const double depth = packing_i_measure_depth(f->domain, p);
      deep = depth >= f->margin;
      inside =
          depth >= 0 && packing_domain_signed_distance(f->domain, &p, NULL) >= f->margin;
    }
    if (!deep)
      role = (unsigned char)(role & ~CENTRE);
    report->centres += (size_t)((role & CENTRE) != 0);
    report->partners += (size_t)((role & PARTNER) != 0);
    inner += (size_t)((role & PARTNER) != 0 && inside);
    f->role[i] = role;
  }
  return inner;
}

/* The density of partners; where the margin leaves no region there are no centres. */
static packing_status find_density(packing_context *context, rdf *f,
                                   packing_domain *domain, packing_rdf_report *report)
{
  packing_domain *inner = NULL;
  const size_t count = give_roles(f, report);
  PACKING_I_TRY(packing_i_measure_inner(context, "margin", domain, f->margin, &inner));
  report->density =
      inner == NULL ? (double)NAN : (double)count / packing_domain_volume(inner);
  packing_domain_destroy(inner);
  return PACKING_OK;
}

/* The borders of bin k are k and k + 1 steps; what division rounds is put right. */
static size_t bin_of(const rdf *f, double distance)
{
  size_t k = (size_t)(distance / f->step);
  if (distance < (double)k * f->step)
    k--;
  if (distance >= (double)(k + 1) * f->step)
    k++;
  return k;
}

/* By the grid's places: there are many pairs, and what is near stands near there. */
static void count_pair(void *arg, const packing_i_grid_pair *p)
{
  const lane *l = arg;
  const unsigned a = l->rdf->placed[p->own], b = l->rdf->placed[p->other];
  const unsigned met = ((a & b >> 1) & 1) + ((b & a >> 1) & 1);
  if (met == 0 || !(p->distance <= l->rdf->r_max))
    return;
  const size_t k = bin_of(l->rdf, p->distance);
  if (k < l->rdf->def.bins)
    l->counts[k] += met;
}

static void count_lane(void *arg, size_t k)
{
  const rdf *f = arg;
  lane l = {f, f->counts + k * f->def.bins};
  for (size_t block = k; block < f->blocks; block += f->lanes)
    packing_i_grid_visit(f->grid, f->reach, block, count_pair, &l);
}

static void merge_lanes(rdf *f)
{
  for (size_t at = f->def.bins; at < f->lanes * f->def.bins; at++)
    f->counts[at % f->def.bins] += f->counts[at];
}

static packing_status count_placed(packing_context *context, rdf *f)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t fit = LANE_BINS / f->def.bins, most = fit < LANES ? fit : LANES;
  f->blocks = packing_i_grid_blocks(f->grid);
  f->lanes = f->blocks < most ? f->blocks : most;
  f->lanes = f->lanes > 0 ? f->lanes : 1;
  f->placed = packing_i_alloc(allocator, f->view->count, 1);
  f->counts = packing_i_calloc(allocator, f->lanes * f->def.bins, sizeof *f->counts);
  if (f->placed == NULL || f->counts == NULL)
    return packing_i_nomem(context);
  for (size_t k = 0; k < f->view->count; k++)
    f->placed[k] = f->role[f->grid->index[k]];
  packing_i_parallel(context, f->lanes, count_lane, f);
  merge_lanes(f);
  return PACKING_OK;
}

static packing_status count_all(packing_context *context, rdf *f)
{
  packing_i_images *images = NULL;
  PACKING_I_TRY(
      packing_i_images_create(context, f->domain, f->view, 0, f->r_max, &images));
  f->grid = packing_i_images_grid(images);
  f->reach = packing_i_images_reach(images);
  const packing_status status = count_placed(context, f);
  packing_i_images_destroy(images);
  return status;
}

/* Without a centre or partner 0 / 0 is the NaN of what is not known. */
static void conclude(const rdf *f, packing_rdf_bin *bins, size_t capacity,
                     packing_rdf_report *report)
{
  const double centres = (double)report->centres;
  double most = 0, inside = 0;
  report->peak = PACKING_NO_INDEX;
  for (size_t k = 0; k < f->def.bins; k++) {
    packing_rdf_bin b = {(double)k * f->width, (double)(k + 1) * f->width, f->counts[k],
                         0, 0};
    const double ball = packing_i_ball_volume(f->dim, b.hi * f->unit);
    report->pairs += b.count;
    b.g = (double)b.count / (centres * report->density * (ball - inside));
    b.cumulative = (double)report->pairs / centres;
    inside = ball;
    if (b.g > most) {
      most = b.g;
      report->peak = k;
    }
    if (k < capacity)
      bins[k] = b;
  }
  report->bins = f->def.bins;
  report->mean_d = f->mean_d;
  report->margin = f->margin / f->unit;
}

packing_status packing_measure_rdf(packing_context *context, const packing_rdf_def *def,
                                   packing_domain *domain, const packing_view *view,
                                   packing_rdf_bin *bins, size_t capacity,
                                   packing_rdf_report *report)
{
  rdf f = {0};
  packing_view v;
  packing_rdf_report found;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_rdf, partners, def, &f.def));
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  PACKING_I_TRY(check_arguments(context, &f.def, domain, &v, bins, capacity, report));
  f.domain = domain;
  f.view = &v;
  f.dim = packing_domain_dim(domain);
  packing_rdf_report_init(&found);
  PACKING_I_TRY(take_measures(context, &f));
  const packing_allocator *allocator = packing_i_allocator(context);
  f.role = packing_i_alloc(allocator, v.count, 1);
  packing_status status = f.role == NULL ? packing_i_nomem(context)
                                         : find_density(context, &f, domain, &found);
  if (status == PACKING_OK)
    status = count_all(context, &f);
  if (status == PACKING_OK) {
    conclude(&f, bins, capacity, &found);
    status = packing_i_report_write(context, report, &found, sizeof found);
  }
  packing_i_free(allocator, f.role);
  packing_i_free(allocator, f.placed);
  packing_i_free(allocator, f.counts);
  return status;
}
