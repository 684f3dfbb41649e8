/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_POROSITY_INTERNAL_H
#define PACKING_POROSITY_INTERNAL_H

/* What profiles, maps and sections share. */

#include "domain/domain_internal.h"
#include "measure/measure_internal.h"
#include "vec.h"
#include "view.h"
#include <packing/porosity.h>

/* The periodic images of a particle that reach a box: x + (first + n) * period along each axis
 * with count[k] > 1 or first[k] != 0. */
typedef struct packing_i_copies {
  packing_vec3 centre;
  packing_vec3 period; /* 0 where there is one image only */
  double first[3];
  size_t count[3];
} packing_i_copies;

/* Images along the directions of `periodic`, a sum of PACKING_PERIODIC_. */
packing_i_copies packing_i_copies_of(const packing_domain *domain, unsigned periodic,
                                     const packing_bounds *box, packing_vec3 centre,
                                     double r);

static inline size_t packing_i_copies_count(const packing_i_copies *c)
{
  return c->count[0] * c->count[1] * c->count[2];
}

static inline packing_vec3 packing_i_copy(const packing_i_copies *c, size_t n)
{
  const size_t nx = n % c->count[0], ny = n / c->count[0] % c->count[1],
               nz = n / c->count[0] / c->count[1];
  return packing_i_vec(c->centre.x + (c->first[0] + (double)nx) * c->period.x,
                       c->centre.y + (c->first[1] + (double)ny) * c->period.y,
                       c->centre.z + (c->first[2] + (double)nz) * c->period.z);
}

/* The centre as the measures take it: z is 0 in the plane. */
static inline packing_vec3 packing_i_measure_centre(const packing_domain *domain,
                                                    const packing_view *view, size_t i)
{
  packing_vec3 p = packing_i_view_centre(view, i);
  if (domain->body.dim == 2)
    p.z = 0;
  return p;
}

/* Everything that all of them check: a domain, a good view, a tolerance in (0, 1). No particle
 * may reach over more images than can be counted. */
packing_status packing_i_porosity_begin(packing_context *context, double tolerance,
                                        const packing_domain *domain,
                                        const packing_view *view, packing_view *copy);

/* A list to fill: NULL only without room; a place for the count; a report that is initialised. */
packing_status packing_i_porosity_list(packing_context *context, const char *field,
                                       const void *list, size_t capacity,
                                       const size_t *count, void *report);

/* A range [from, to]; both 0 stands for a default and passes. */
packing_status packing_i_porosity_range(packing_context *context, double from, double to);

/* `axis` must be one of the domain's. */
packing_status packing_i_porosity_axis(packing_context *context, packing_axis axis,
                                       int dim);

/* A box may not reach over more periods than can be gone through; `field` is to blame. */
packing_status packing_i_porosity_images(packing_context *context, const char *field,
                                         const packing_domain *domain, unsigned periodic,
                                         const packing_bounds *box);

/* A cell without borders. */
packing_i_cell packing_i_porosity_cell(void);

/* The failure of a container that cannot cut. */
packing_status packing_i_porosity_misbehaves(packing_context *context);

#endif
