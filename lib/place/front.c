/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The advancing front: options, goals, and the choice of engine.
 * I. Perez Morales, R. Rosello Valera, C. Recarey and others, sections 3 to 3.4. */
#include "front_internal.h"
#include <float.h>
#include <packing/solids.h>
#include <string.h>

/* The innermost point is found to this share of the mean radius. */
static const double innermost_share = 1e-3;

/* About what an advancing front fills, to guess how long it still takes. */
static const double fraction_2d = 0.84, fraction_3d = 0.62;

/* Of the volume placed: as much as the stock may hold if all of it were as large as can be. */
static const double stock_volume = 0.03;
enum { STOCK_LEAST = 16, STOCK_FAST = 64, STOCK_DENSE = 256 };

const char *packing_front_mode_name(packing_front_mode mode)
{
  switch (mode) {
  case PACKING_FRONT_DENSE:
    return "dense";
  case PACKING_FRONT_FAST:
    return "fast";
  case PACKING_FRONT_PAPER:
    return "paper";
  }
  return NULL;
}

const char *packing_front_direction_name(packing_front_direction direction)
{
  switch (direction) {
  case PACKING_FRONT_OUTWARD:
    return "outward";
  case PACKING_FRONT_INWARD:
    return "inward";
  }
  return NULL;
}

const char *packing_front_select_name(packing_front_select select)
{
  switch (select) {
  case PACKING_FRONT_RANDOM:
    return "random";
  case PACKING_FRONT_FIFO:
    return "fifo";
  case PACKING_FRONT_LIFO:
    return "lifo";
  }
  return NULL;
}

void packing_front_def_fill(packing_front_def *def, size_t size)
{
  packing_front_def defaults = {0};
  defaults.seed = 1;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

int packing_i_front_wants(const packing_i_front *front,
                          const packing_placer_report *tally, double next)
{
  if (front->count != 0 && tally->placed >= front->count)
    return 0;
  return front->solid_volume == 0 ||
         tally->solid_volume + 0.5 * next <= front->solid_volume;
}

double packing_i_front_progress(const packing_i_front *front,
                                const packing_placer *placer)
{
  const packing_placer_report *tally = &placer->tally;
  const double most = placer->particles->dim == 2 ? fraction_2d : fraction_3d;
  double progress = tally->volume_fraction / most;
  if (front->count != 0)
    progress = fmax(progress, (double)tally->placed / (double)front->count);
  if (front->solid_volume != 0)
    progress = fmax(progress, tally->solid_volume / front->solid_volume);
  return fmin(progress, 1);
}

static packing_status check_names(packing_context *context, const packing_front_def *d)
{
  const struct {
    const char *field, *name;
    int value;
  } names[] = {
      {"mode", packing_front_mode_name(d->mode), (int)d->mode},
      {"direction", packing_front_direction_name(d->direction), (int)d->direction},
      {"select_particle", packing_front_select_name(d->select_particle),
       (int)d->select_particle},
      {"select_neighbours", packing_front_select_name(d->select_neighbours),
       (int)d->select_neighbours},
  };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (names[i].name == NULL)
      return packing_i_fail(context, PACKING_ERR_RANGE, names[i].field, PACKING_NO_INDEX,
                            "%d is none of its values", names[i].value);
  return PACKING_OK;
}

/* Options that the mode does not know. */
static packing_status check_mode(packing_context *context, const packing_front_def *d)
{
  const int paper = d->mode == PACKING_FRONT_PAPER;
  const char *field = NULL;
  if (paper && d->stock != 0)
    field = "stock";
  if (!paper && d->select_particle != PACKING_FRONT_RANDOM)
    field = "select_particle";
  if (!paper && d->select_neighbours != PACKING_FRONT_RANDOM)
    field = "select_neighbours";
  if (!paper && d->contact != NULL)
    field = "contact";
  if (!paper && d->shape != NULL)
    field = "shape";
  if (field != NULL)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "not an option of the mode %s",
                          packing_front_mode_name(d->mode));
  if (d->stock > PACKING_I_STOCK_MOST)
    return packing_i_fail(context, PACKING_ERR_RANGE, "stock", PACKING_NO_INDEX,
                          "%zu must be at most %d", d->stock, PACKING_I_STOCK_MOST);
  return PACKING_OK;
}

static packing_status check_contact(packing_context *context, const packing_front_def *d)
{
  if (d->contact != NULL && d->contact->place == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "contact", PACKING_NO_INDEX,
                          "a method without the function place");
  const int wrappers = d->contact == NULL || d->contact == packing_contact_wrappers();
  if (d->shape != NULL && wrappers)
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "contact", PACKING_NO_INDEX,
                          "wrappers place spheres and discs, not the shape %s",
                          packing_shape_name(d->shape));
  return PACKING_OK;
}

static packing_status check_array(packing_context *context, const char *field,
                                  const void *array, size_t count)
{
  if (array == NULL && count > 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX,
                          "NULL, %zu are announced", count);
  if (array != NULL && count == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                          "0 entries, at least 1 is needed");
  return PACKING_OK;
}

static packing_status check_classes(packing_context *context, const packing_front_def *d,
                                    const packing_psd *psd)
{
  PACKING_I_TRY(check_array(context, "classes", d->classes, d->class_count));
  if (d->classes != NULL && psd != NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "psd", PACKING_NO_INDEX,
                          "must be NULL with an exact list");
  if (d->classes != NULL && d->regions != NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "regions", PACKING_NO_INDEX,
                          "an exact list is one for the whole container");
  size_t sum = 0;
  for (size_t i = 0; i < d->class_count; i++) {
    const packing_front_class *c = &d->classes[i];
    if (!isfinite(c->r) || !(c->r > 0))
      return packing_i_fail(
          context, isfinite(c->r) ? PACKING_ERR_RANGE : PACKING_ERR_INVALID, "classes", i,
          "the radius %g of class %zu must be finite and above 0", c->r, i + 1);
    if (c->count == 0 || c->count > SIZE_MAX - sum)
      return packing_i_fail(context, PACKING_ERR_RANGE, "classes", i,
                            "%zu particles in class %zu", c->count, i + 1);
    sum += c->count;
  }
  return PACKING_OK;
}

static packing_status check_regions(packing_context *context, const packing_front_def *d,
                                    const packing_domain *domain)
{
  PACKING_I_TRY(check_array(context, "regions", d->regions, d->region_count));
  if (d->choose != NULL && d->regions == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "choose", PACKING_NO_INDEX,
                          "there are no regions to choose from");
  for (size_t i = 0; i < d->region_count; i++) {
    const packing_front_region *region = &d->regions[i];
    if (region->psd == NULL || (region->domain == NULL && d->choose == NULL))
      return packing_i_fail(context, PACKING_ERR_INVALID, "regions", i,
                            "region %zu has no %s", i + 1,
                            region->psd == NULL ? "psd" : "domain");
    if (d->choose == NULL &&
        packing_domain_dim(region->domain) != packing_domain_dim(domain))
      return packing_i_fail(context, PACKING_ERR_RANGE, "regions", i,
                            "region %zu has %d dimensions, the domain %d", i + 1,
                            packing_domain_dim(region->domain),
                            packing_domain_dim(domain));
  }
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_front_def *d,
                            const packing_domain *domain, const packing_psd *psd,
                            const packing_particles *particles)
{
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  PACKING_I_TRY(packing_i_check_given(context, "particles", particles));
  PACKING_I_TRY(check_names(context, d));
  PACKING_I_TRY(
      packing_i_check_not_negative(context, "volume_fraction", d->volume_fraction));
  if (d->volume_fraction >= 1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "volume_fraction", PACKING_NO_INDEX,
                          "%g must be below 1", d->volume_fraction);
  PACKING_I_TRY(check_mode(context, d));
  PACKING_I_TRY(check_contact(context, d));
  PACKING_I_TRY(check_classes(context, d, psd));
  if (d->classes == NULL)
    PACKING_I_TRY(packing_i_check_given(context, "psd", psd));
  return check_regions(context, d, domain);
}

/* How many particles are to be expected, roughly. */
static double expected(const packing_front_def *d, const packing_domain *domain,
                       const packing_psd *psd)
{
  double n = 0, moment;
  for (size_t i = 0; i < d->class_count; i++)
    n += (double)d->classes[i].count;
  if (n > 0)
    return d->count != 0 ? fmin(n, (double)d->count) : n;
  const int dim = packing_domain_dim(domain);
  if (packing_psd_moment(psd, PACKING_BY_NUMBER, dim, &moment) != PACKING_OK)
    return 0;
  const double most = dim == 2 ? fraction_2d : fraction_3d;
  const double fraction = d->volume_fraction > 0 ? fmin(most, d->volume_fraction) : most;
  n = fraction * packing_domain_volume(domain) / (packing_i_ball_volume(dim, 1) * moment);
  return d->count != 0 ? fmin(n, (double)d->count) : n;
}

/* The mean volume over the largest. */
static double mean_in_largest(const packing_psd *psd, int dim)
{
  const double r = packing_psd_max_r(psd);
  double moment;
  if (packing_psd_moment(psd, PACKING_BY_NUMBER, dim, &moment) != PACKING_OK)
    return 0;
  return moment / (dim == 2 ? r * r : r * r * r);
}

/* What stands in the stock at the end was not placed, and will be the sizes that fit worst: so it
 * stays below what a test of the sizes (1.36 / sqrt(n)) would notice, and, were all of it of the
 * largest size, below a small share of the volume. */
static size_t stock_of(const packing_front_def *d, const packing_domain *domain,
                       const packing_psd *psd)
{
  const double n = expected(d, domain, psd);
  const double most = d->mode == PACKING_FRONT_FAST ? STOCK_FAST : STOCK_DENSE;
  double share = (packing_domain_dim(domain) == 2 ? 0.6 : 1) * sqrt(n);
  if (d->mode == PACKING_FRONT_PAPER)
    return 1;
  if (d->stock != 0)
    return d->stock;
  if (psd != NULL)
    share =
        fmin(share, stock_volume * n * mean_in_largest(psd, packing_domain_dim(domain)));
  return share < STOCK_LEAST ? STOCK_LEAST : (size_t)fmin(share, most);
}

/* Goals, and the innermost point, which must hold the smallest particle. */
static packing_status set_head(const packing_placer *placer, const packing_front_def *d,
                               packing_i_front *head)
{
  const double least = packing_i_source_min_r(head->source);
  const double mean = packing_i_source_moment(head->source, 1);
  head->count = d->count;
  head->solid_volume = d->volume_fraction * placer->domain_volume;
  if (d->volume_fraction > 0 && !(head->solid_volume > 0))
    head->solid_volume = DBL_MIN; /* the product underflows; 0 would be no limit */
  PACKING_I_TRY(packing_domain_innermost(placer->context, placer->domain,
                                         innermost_share * mean, &head->innermost,
                                         &head->room));
  /* Only without periods does the room decide alone, and the point is not quite the best. */
  if (packing_domain_periodic(placer->domain) == 0 && head->room >= least)
    return PACKING_OK;
  return packing_i_placer_check_room_of(placer, least);
}

/* Hands over to the engine of the mode. */
static packing_status start(packing_placer *placer, const packing_front_def *d,
                            const packing_i_front *head)
{
  if (d->mode == PACKING_FRONT_PAPER)
    return packing_i_front_paper_start(placer, d, head);
  return packing_i_front_pockets_start(placer, d, head);
}

packing_status packing_front_create(packing_context *context,
                                    const packing_front_def *def, packing_domain *domain,
                                    packing_psd *psd, packing_particles *particles,
                                    packing_placer **placer)
{
  packing_front_def d;
  packing_placer *p = NULL;
  packing_i_front head = {0};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_front, user, def, &d));
  PACKING_I_TRY(packing_i_check_given(context, "placer", placer));
  PACKING_I_TRY(check(context, &d, domain, psd, particles));
  packing_status status =
      packing_i_source_create(context, &d, psd, stock_of(&d, domain, psd), &head.source);
  if (status == PACKING_OK)
    status = packing_i_placer_create(context, &packing_i_front_paper_ops, domain,
                                     packing_i_source_psd(head.source), particles, &p);
  if (status == PACKING_OK)
    status = set_head(p, &d, &head);
  if (status == PACKING_OK)
    status = start(p, &d, &head);
  if (status != PACKING_OK) {
    packing_placer_destroy(p);
    packing_i_source_destroy(head.source);
    return status;
  }
  *placer = p;
  return PACKING_OK;
}

/* The common head of a front; NULL for another placer. */
static const packing_i_front *front_of(const packing_placer *placer)
{
  if (placer == NULL || strcmp(placer->ops->name, "front") != 0)
    return NULL;
  return placer->method;
}

static packing_status no_front(const packing_placer *placer)
{
  return packing_i_fail(placer == NULL ? NULL : placer->context, PACKING_ERR_INVALID,
                        "placer", PACKING_NO_INDEX,
                        placer == NULL ? "NULL" : "not an advancing front");
}

packing_status packing_front_members(const packing_placer *placer, size_t capacity,
                                     size_t *index, size_t *count)
{
  const packing_i_front *front = front_of(placer);
  if (front == NULL)
    return no_front(placer);
  PACKING_I_TRY(packing_i_check_given(placer->context, "count", count));
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(placer->context, "index", index));
  return front->members(placer, capacity, index, count);
}

packing_status packing_front_unplaced(const packing_placer *placer, size_t *counts)
{
  const packing_i_front *front = front_of(placer);
  if (front == NULL)
    return no_front(placer);
  PACKING_I_TRY(packing_i_check_given(placer->context, "counts", counts));
  if (!packing_i_source_listed(front->source))
    return packing_i_fail(placer->context, PACKING_ERR_INVALID, "placer",
                          PACKING_NO_INDEX, "it has no exact list");
  packing_i_source_left(front->source, counts);
  return PACKING_OK;
}
