/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A container's walls as planes, cylinders, cones and spheres, for programs that have such walls.
 * All built-in containers are cut out by them: each wall can go on beyond its face without
 * entering the container. Constant time. */
#include "domain/domain_internal.h"
#include "writers_internal.h"

static packing_i_surface plane(int axis, int outside, double position)
{
  return (packing_i_surface){.kind = PACKING_I_SURFACE_PLANE,
                             .axis = axis,
                             .outside = outside,
                             .position = position};
}

static int planes_of_box(const packing_i_pack *pack, packing_i_surface *to)
{
  int count = 0;
  for (int k = 0; k < pack->def.dim; k++) {
    if ((pack->def.periodic & 1u << k) != 0)
      continue;
    to[count++] = plane(k, 0, packing_i_component(pack->box.lo, k));
    to[count++] = plane(k, 1, packing_i_component(pack->box.hi, k));
  }
  return count;
}

static int planar_walls(const packing_i_planar *p, packing_i_surface *to)
{
  int count = 0;
  for (int k = 0; k < 3; k++) {
    if (isfinite(p->wall_lo[k]))
      to[count++] = plane(k, 0, p->wall_lo[k]);
    if (isfinite(p->wall_hi[k]))
      to[count++] = plane(k, 1, p->wall_hi[k]);
  }
  return count;
}

/* A cone as far as the container and the margin go, or to its tip. */
static void set_cone(packing_i_surface *s, const packing_i_wall *w)
{
  const double tip = -w->c / w->b;
  const int opens_up = -w->b / w->a > 0;
  s->kind = PACKING_I_SURFACE_CONE;
  if (opens_up && s->height[0] < tip)
    s->height[0] = tip;
  if (!opens_up && s->height[1] > tip)
    s->height[1] = tip;
  for (int k = 0; k < 2; k++)
    s->radius[k] =
        s->height[k] == tip ? 0 : fmax(0, -(w->b * s->height[k] + w->c) / w->a);
}

static packing_i_surface wall_of_revolution(const packing_i_revolution *p,
                                            const packing_i_wall *w, double margin)
{
  const double base = packing_i_component(p->base, p->axis);
  packing_i_surface s = {.kind = PACKING_I_SURFACE_CYLINDER,
                         .axis = p->axis,
                         .outside = w->a > 0,
                         .centre = p->base,
                         .height = {p->knot[0] - margin, p->knot[p->knots - 1] + margin}};
  if (w->a == 0)
    return plane(p->axis, w->b < 0, base + (w->b < 0 ? w->c : -w->c));
  if (w->b == 0)
    s.radius[0] = s.radius[1] = fabs(w->c);
  else
    set_cone(&s, w);
  s.height[0] += base;
  s.height[1] += base;
  return s;
}

static int round_walls(const packing_i_round *p, const packing_i_pack *pack,
                       double margin, packing_i_surface *to)
{
  packing_i_surface s = {.kind = PACKING_I_SURFACE_SPHERE,
                         .centre = p->centre,
                         .radius = {p->outer, p->outer}};
  if (pack->def.dim == 3) {
    to[0] = s;
    return 1;
  }
  s.kind = PACKING_I_SURFACE_CYLINDER;
  s.axis = PACKING_AXIS_Z;
  s.height[0] = pack->box.lo.z - margin;
  s.height[1] = pack->box.hi.z + margin;
  to[0] = s;
  if (p->inner == 0)
    return 1;
  s.outside = 1;
  s.radius[0] = s.radius[1] = p->inner;
  to[1] = s;
  return 2;
}

packing_status packing_i_surfaces(packing_context *context, const packing_i_pack *pack,
                                  double margin,
                                  packing_i_surface surfaces[PACKING_I_SURFACES],
                                  int *count)
{
  const packing_domain *domain = pack->def.domain;
  *count = 0;
  if (domain == NULL) {
    *count = planes_of_box(pack, surfaces);
  } else if (packing_i_domain_planar(domain) != NULL) {
    *count = planar_walls(packing_i_domain_planar(domain), surfaces);
  } else if (packing_i_domain_axis(domain) >= 0) {
    const packing_i_revolution *p = &domain->body.as.revolution;
    for (; *count < p->walls; ++*count)
      surfaces[*count] = wall_of_revolution(p, &p->wall[*count], margin);
  } else if (packing_i_domain_round(domain) != NULL) {
    *count = round_walls(packing_i_domain_round(domain), pack, margin, surfaces);
  } else {
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "domain", PACKING_NO_INDEX,
                          "no walls of a container of kind %s",
                          packing_domain_kind(domain));
  }
  return PACKING_OK;
}
