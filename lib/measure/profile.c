/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Porosity profiles: slabs across an axis, shells round a line or a point.
 *
 * What a particle has in a bin is the difference of what it has below its two borders, each
 * exact (domain/cut_cell.c): caps of a ball for slabs, the lens of two balls for spherical
 * shells, a quadrature of lenses for cylinders, all three cut by the container where its wall
 * is in reach. Of a container the same is asked without a particle. So the parts of a particle
 * add up to all of it whatever the borders are. The radial profile is that of de Klerk
 * (AIChE J. 49, 2003, 2022), with shells of finite width for his averages over areas. Blocks of
 * particles sum into bins of their own, which are combined in order. Linear in the particles
 * times the bins that each meets. */
#include "measure/porosity_internal.h"

enum { MOST_BLOCKS = 32 };

/* Errors allowed for the container's volume, relative to it. */
static const double container_tolerance = 1e-13;

typedef struct profile {
  const packing_profile_def *def;
  const packing_domain *domain;
  const packing_view *view;
  packing_bounds box; /* that the bins reach into */
  unsigned periodic;  /* directions that they grow into */
  size_t block;       /* particles of one */
  size_t blocks;
  packing_i_sum *sums;   /* of each block, of each bin */
  packing_i_sum *errors; /* of each block */
  int *broken;           /* of each block, and of each bin: a container that misbehaves */
  double *volumes;       /* of the container in each bin, or below its end */
} profile;

void packing_profile_def_fill(packing_profile_def *def, size_t size)
{
  packing_profile_def defaults = {0};
  defaults.axis = PACKING_AXIS_Z;
  defaults.bins = 50;
  defaults.tolerance = 1e-10;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static double border(const packing_profile_def *d, size_t k)
{
  return k == d->bins ? d->to
                      : d->from + (d->to - d->from) * ((double)k / (double)d->bins);
}

/* All that lies below a border. */
static packing_i_cell below(const packing_profile_def *d, double at)
{
  packing_i_cell cell = packing_i_porosity_cell();
  if (d->kind == PACKING_PROFILE_SLABS) {
    double *hi[3] = {&cell.box.hi.x, &cell.box.hi.y, &cell.box.hi.z};
    *hi[d->axis] = at;
    return cell;
  }
  cell.kind = d->kind == PACKING_PROFILE_CYLINDERS ? PACKING_I_CELL_CYLINDER
                                                   : PACKING_I_CELL_BALL;
  cell.axis = (int)d->axis;
  cell.centre = d->centre;
  cell.radius = at;
  return cell;
}

/* Where a point lies in the profile. */
static double place_of(const profile *p, packing_vec3 at)
{
  const packing_profile_def *d = p->def;
  if (d->kind == PACKING_PROFILE_SLABS)
    return packing_i_component(at, (int)d->axis);
  packing_vec3 v = packing_i_sub(at, d->centre);
  if (p->domain->body.dim == 2)
    v.z = 0;
  else if (d->kind == PACKING_PROFILE_CYLINDERS)
    *(d->axis == PACKING_AXIS_X ? &v.x : d->axis == PACKING_AXIS_Y ? &v.y : &v.z) = 0;
  return packing_i_norm(v);
}

/* The bin that holds a place; the first or last where it is outside. */
static size_t bin_of(const packing_profile_def *d, double place)
{
  const double k = floor((place - d->from) / (d->to - d->from) * (double)d->bins);
  if (!(k > 0))
    return 0;
  return k < (double)d->bins ? (size_t)k : d->bins - 1;
}

/* The share of an image below a border. */
static int share(const profile *p, packing_vec3 at, double r, double border_at,
                 double *volume, double *error)
{
  const packing_i_cell cell = below(p->def, border_at);
  return packing_i_domain_cell_volume(p->domain, &cell, &at, r, p->def->tolerance, volume,
                                      error);
}

/* Adds the parts of an image to the bins it meets. Where rounding, or a custom container, has
 * less below a border than below the one before, the bin between gets nothing. */
static int add_image(const profile *p, packing_vec3 at, double r, packing_i_sum *bins,
                     packing_i_sum *errors)
{
  const packing_profile_def *d = p->def;
  const double place = place_of(p, at);
  if (place + r <= d->from || place - r >= d->to)
    return 0;
  double before = 0, now = 0, error = 0, largest = 0;
  const double low = d->kind == PACKING_PROFILE_SLABS ? place - r : fmax(place - r, 0);
  const size_t first = bin_of(d, low);
  if (border(d, first) > low && share(p, at, r, border(d, first), &before, &largest))
    return -1;
  for (size_t k = first; k < d->bins; k++) {
    if (share(p, at, r, border(d, k + 1), &now, &error))
      return -1;
    largest = fmax(largest, error);
    if (now > before) {
      packing_i_sum_add(&bins[k], now - before);
      before = now;
    }
    if (border(d, k + 1) >= place + r)
      break;
  }
  packing_i_sum_add(errors, largest);
  return 0;
}

static void sum_block(void *arg, size_t block)
{
  const profile *p = arg;
  packing_i_sum *bins = &p->sums[block * p->def->bins];
  const size_t first = block * p->block;
  for (size_t i = first; i < first + p->block && i < p->view->count; i++) {
    const double r = packing_i_view_r(p->view, i);
    const packing_i_copies copies =
        packing_i_copies_of(p->domain, p->periodic, &p->box,
                            packing_i_measure_centre(p->domain, p->view, i), r);
    for (size_t n = 0; n < packing_i_copies_count(&copies); n++)
      if (add_image(p, packing_i_copy(&copies, n), r, bins, &p->errors[block]))
        p->broken[block] = 1;
  }
}

/* The container in a slab, or within the outer border of a shell. */
static void measure_bin(void *arg, size_t k)
{
  const profile *p = arg;
  const packing_profile_def *d = p->def;
  packing_i_cell cell = below(d, border(d, k + 1));
  double *lo[3] = {&cell.box.lo.x, &cell.box.lo.y, &cell.box.lo.z};
  double *hi[3] = {&cell.box.hi.x, &cell.box.hi.y, &cell.box.hi.z};
  const packing_bounds *b = &p->domain->body.bounds;
  double error;
  for (int axis = 0; axis < 3; axis++)
    if (p->domain->body.periodic & ~p->periodic & 1u << axis) {
      *lo[axis] = packing_i_component(b->lo, axis);
      *hi[axis] = packing_i_component(b->hi, axis);
    }
  if (d->kind == PACKING_PROFILE_SLABS) {
    *lo[d->axis] = border(d, k);
    *hi[d->axis] = border(d, k + 1);
  }
  p->broken[p->blocks + k] = packing_i_domain_cell_volume(
      p->domain, &cell, &cell.centre, 0, container_tolerance, &p->volumes[k], &error);
}

/* Within the first border, which begins at 0 or further out. */
static int measure_core(const profile *p, double *volume)
{
  profile core = *p;
  packing_profile_def d = *p->def;
  int broken = 0;
  *volume = 0;
  if (d.kind == PACKING_PROFILE_SLABS || d.from == 0)
    return 0;
  d.bins = 1;
  d.to = d.from;
  core.def = &d;
  core.blocks = 0;
  core.broken = &broken;
  core.volumes = volume;
  measure_bin(&core, 0);
  return broken;
}

/* From volumes within to volumes between. */
static int take_differences(const profile *p)
{
  double before;
  if (measure_core(p, &before))
    return -1;
  for (size_t k = 0; k < p->def->bins && p->def->kind != PACKING_PROFILE_SLABS; k++) {
    const double now = p->volumes[k];
    p->volumes[k] = now > before ? now - before : 0;
    before = fmax(now, before);
  }
  return 0;
}

static double porosity_of(double solid, double volume)
{
  return volume > 0 ? 1 - solid / volume : (double)NAN;
}

static void write(const profile *p, packing_profile_bin *bins, size_t capacity,
                  packing_profile_report *report)
{
  const packing_profile_def *d = p->def;
  packing_i_sum solid = {0, 0}, volume = {0, 0}, error = {0, 0};
  for (size_t k = 0; k < d->bins; k++) {
    packing_i_sum sum = {0, 0};
    for (size_t b = 0; b < p->blocks; b++)
      packing_i_sum_add(&sum, packing_i_sum_value(&p->sums[b * d->bins + k]));
    packing_i_sum_add(&solid, packing_i_sum_value(&sum));
    packing_i_sum_add(&volume, p->volumes[k]);
    if (k < capacity)
      bins[k] = (packing_profile_bin){
          border(d, k), border(d, k + 1), p->volumes[k], packing_i_sum_value(&sum),
          porosity_of(packing_i_sum_value(&sum), p->volumes[k])};
  }
  for (size_t b = 0; b < p->blocks; b++)
    packing_i_sum_add(&error, packing_i_sum_value(&p->errors[b]));
  report->from = d->from;
  report->to = d->to;
  report->centre = d->centre;
  report->volume = packing_i_sum_value(&volume);
  report->solid = packing_i_sum_value(&solid);
  report->porosity = porosity_of(report->solid, report->volume);
  report->error = packing_i_sum_value(&error) / report->volume;
}

static packing_status run(packing_context *context, profile *p)
{
  const size_t bins = p->def->bins;
  packing_i_parallel(context, p->blocks, sum_block, p);
  packing_i_parallel(context, bins, measure_bin, p);
  for (size_t k = 0; k < p->blocks + bins; k++)
    if (p->broken[k])
      return packing_i_porosity_misbehaves(context);
  return take_differences(p) ? packing_i_porosity_misbehaves(context) : PACKING_OK;
}

static packing_status measure(packing_context *context, profile *p,
                              packing_profile_bin *bins, size_t capacity,
                              packing_profile_report *report)
{
  const packing_allocator *a = packing_i_allocator(context);
  packing_status status;
  p->block = p->view->count / MOST_BLOCKS + 1;
  if (p->block < PACKING_I_MEASURE_BLOCK)
    p->block = PACKING_I_MEASURE_BLOCK;
  p->blocks = (p->view->count + p->block - 1) / p->block;
  p->sums = packing_i_calloc(a, p->def->bins, (p->blocks + 1) * sizeof *p->sums);
  p->errors = packing_i_calloc(a, p->blocks, sizeof *p->errors);
  p->volumes = packing_i_calloc(a, p->def->bins, sizeof *p->volumes);
  p->broken = NULL;
  if (p->sums != NULL && p->errors != NULL && p->volumes != NULL)
    p->broken = packing_i_calloc(a, p->blocks + p->def->bins, sizeof *p->broken);
  status = p->broken == NULL ? packing_i_nomem(context) : run(context, p);
  if (status == PACKING_OK)
    write(p, bins, capacity, report);
  packing_i_free(a, p->sums);
  packing_i_free(a, p->errors);
  packing_i_free(a, p->volumes);
  packing_i_free(a, p->broken);
  return status;
}

static packing_status check(packing_context *context, const packing_profile_def *d,
                            int dim)
{
  static const char *const centre[] = {"centre.x", "centre.y", "centre.z"};
  if ((int)d->kind < PACKING_PROFILE_SLABS || (int)d->kind > PACKING_PROFILE_SPHERES)
    return packing_i_fail(context, PACKING_ERR_RANGE, "kind", PACKING_NO_INDEX,
                          "%d is no kind of profile", (int)d->kind);
  PACKING_I_TRY(packing_i_porosity_axis(context, d->axis,
                                        d->kind == PACKING_PROFILE_SLABS ? dim : 3));
  PACKING_I_TRY(packing_i_check_switch(context, "own_centre", d->own_centre));
  PACKING_I_TRY(packing_i_check_point(context, centre, &d->centre));
  PACKING_I_TRY(packing_i_porosity_range(context, d->from, d->to));
  if (d->kind != PACKING_PROFILE_SLABS && d->from < 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "from", PACKING_NO_INDEX,
                          "the radius %g is negative", d->from);
  if (d->bins == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "bins", PACKING_NO_INDEX,
                          "0, at least 1 is needed");
  return PACKING_OK;
}

/* Puts the container's in the place of what was left to it. */
static void settle(packing_profile_def *d, const packing_domain *domain)
{
  const packing_bounds *b = &domain->body.bounds;
  if (!d->own_centre)
    d->centre = packing_i_scale(packing_i_add(b->lo, b->hi), 0.5);
  if (domain->body.dim == 2)
    d->centre.z = 0;
  if (d->from != 0 || d->to != 0)
    return;
  if (d->kind == PACKING_PROFILE_SLABS) {
    d->from = packing_i_component(b->lo, (int)d->axis);
    d->to = packing_i_component(b->hi, (int)d->axis);
  } else {
    const packing_i_cell cell = below(d, 1);
    d->to = packing_i_domain_reach(domain, &cell);
  }
}

/* Where the bins reach: along the axis, or round the centre. */
static void find_box(profile *p)
{
  const packing_profile_def *d = p->def;
  const double lo = d->kind == PACKING_PROFILE_SLABS ? d->from : -d->to;
  const packing_vec3 from = {lo, lo, lo}, to = {d->to, d->to, d->to};
  const int slabs = d->kind == PACKING_PROFILE_SLABS;
  p->box.lo = slabs ? from : packing_i_add(d->centre, from);
  p->box.hi = slabs ? to : packing_i_add(d->centre, to);
  p->periodic = 7;
  if (slabs)
    p->periodic = 1u << d->axis;
  else if (d->kind == PACKING_PROFILE_CYLINDERS && p->domain->body.dim == 3)
    p->periodic &= ~(1u << d->axis);
}

packing_status packing_measure_profile(packing_context *context,
                                       const packing_profile_def *def,
                                       packing_domain *domain, const packing_view *view,
                                       packing_profile_bin *bins, size_t capacity,
                                       size_t *count, packing_profile_report *report)
{
  packing_profile_def d;
  packing_view v;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_profile, tolerance, def, &d));
  PACKING_I_TRY(packing_i_porosity_begin(context, d.tolerance, domain, view, &v));
  PACKING_I_TRY(packing_i_porosity_list(context, "bins", bins, capacity, count, report));
  PACKING_I_TRY(check(context, &d, packing_domain_dim(domain)));
  settle(&d, domain);
  profile p = {.def = &d, .domain = domain, .view = &v};
  packing_profile_report found;
  packing_profile_report_init(&found);
  find_box(&p);
  PACKING_I_TRY(packing_i_porosity_images(context, "to", domain, p.periodic, &p.box));
  PACKING_I_TRY(measure(context, &p, bins, capacity, &found));
  *count = d.bins;
  return packing_i_report_write(context, report, &found, sizeof found);
}
