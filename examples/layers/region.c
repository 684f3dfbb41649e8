/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The space that a layer is laid into: the container between two heights. An upright box,
 * rectangle, cylinder or tube is cut into one of its own kind, whose volume is exact and whose
 * saturation is quickly proved; others are cut by the smaller of two distances. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "layers.h"

typedef struct slab {
  packing_domain *container; /* kept */
  double lo, hi;
  int dim;
} slab;

static double slab_distance(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  const slab *s = user;
  const double at = s->dim == 2 ? point->y : point->z;
  const double distance = packing_domain_signed_distance(s->container, point, normal);
  const double below = at - s->lo, above = s->hi - at;
  const double nearest = fmin(below, above);
  if (nearest >= distance)
    return distance;
  if (normal) {
    const double up = below <= above ? 1 : -1;
    *normal = s->dim == 2 ? (packing_vec3){0, up, 0} : (packing_vec3){0, 0, up};
  }
  return nearest;
}

static void slab_release(void *user)
{
  slab *s = user;
  packing_domain_destroy(s->container);
  free(s);
}

/* It decides how many particles are asked for, no more. */
static const double VOLUME_TOLERANCE = 1e-3;

static packing_status create_slab(const layers_job *job, double lo, double hi,
                                  packing_domain **region)
{
  packing_domain_custom_def def;
  slab *s = malloc(sizeof *s);
  if (!s)
    return PACKING_ERR_NOMEM;
  *s = (slab){packing_domain_retain(job->domain), lo, hi, job->spec.dim};
  packing_domain_custom_def_init(&def);
  def.dim = s->dim;
  def.signed_distance = slab_distance;
  def.volume_tolerance = VOLUME_TOLERANCE;
  def.user = s;
  def.release = slab_release;
  packing_domain_bounds(job->domain, &def.bounds);
  if (s->dim == 2) {
    def.bounds.lo.y = lo;
    def.bounds.hi.y = hi;
  } else {
    def.bounds.lo.z = lo;
    def.bounds.hi.z = hi;
  }
  const packing_status status = packing_domain_create_custom(job->context, &def, region);
  if (status != PACKING_OK)
    slab_release(s);
  return status;
}

static int is_prism(const layers_job *job)
{
  const domain_kind kind = job->spec.kind;
  return !job->closed && (kind == DOMAIN_BOX || kind == DOMAIN_RECT ||
                          kind == DOMAIN_CYLINDER || kind == DOMAIN_TUBE);
}

static int create_prism(const layers_job *job, double lo, double hi,
                        packing_domain **region)
{
  domain_spec spec = job->spec;
  *(spec.dim == 2 ? &spec.at.y : &spec.at.z) = lo;
  *domain_spec_height(&spec) = hi - lo;
  spec.open_top = 0;
  return domain_spec_create(job->context, &spec, region);
}

int layers_region(const layers_job *job, double base, packing_domain **region)
{
  double end = base + job->asked->layer_height;
  *region = NULL;
  if (job->closed) { /* the last space is the highest, with the bed in the way */
    end = fmin(end, job->top);
    base = fmax(job->floor, fmin(base, job->top - job->asked->layer_height));
  }
  if (end - base < 2 * packing_psd_min_r(job->psd))
    return 0;
  if (is_prism(job))
    return create_prism(job, base, end, region);
  const packing_status status = create_slab(job, base, end, region);
  if (status == PACKING_ERR_GEOMETRY)
    return 0;
  return status == PACKING_OK ? 0
                              : program_status(job->context, status, "--layer-height");
}
