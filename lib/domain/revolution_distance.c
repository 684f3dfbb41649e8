/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distance to a body of revolution. The nearest point of a surface of revolution lies in the
 * half plane of the point, so the distance is that to a convex polygon there: inside the least
 * of the distances to its lines, outside the least of the distances to the faces that look at
 * the point. At most four walls. */
#include "domain_kinds.h"
#include <math.h>

void packing_i_revolution_local(const packing_i_revolution *p, const packing_vec3 *point,
                                double *rho, double *h, packing_vec3 *radial)
{
  const packing_vec3 v = packing_i_sub(*point, p->base);
  packing_vec3 across = v;
  packing_i_set_component(&across, p->axis, 0);
  *h = packing_i_component(v, p->axis);
  *rho = packing_i_norm(across);
  if (radial == NULL)
    return;
  *radial = packing_i_vec(0, 0, 0);
  if (*rho > 0)
    *radial = packing_i_vec(across.x / *rho, across.y / *rho, across.z / *rho);
  else
    packing_i_set_component(radial, (p->axis + 1) % 3, 1);
}

int packing_i_domain_axis(const packing_domain *domain)
{
  return domain->body.ops->signed_distance == packing_i_revolution_signed_distance
             ? domain->body.as.revolution.axis
             : -1;
}

static double to_line(const packing_i_wall *w, double rho, double h)
{
  return w->a * rho + w->b * h + w->c;
}

/* From a point on the wrong side of the line to the face: the distance, negative, and its
 * gradient in the half plane. */
static double to_face(const packing_i_wall *w, double rho, double h, double gradient[2])
{
  const double t = w->a * h - w->b * rho;
  gradient[0] = w->a;
  gradient[1] = w->b;
  if (t >= w->from && t <= w->to)
    return to_line(w, rho, h);
  const double end = t < w->from ? w->from : w->to;
  const double over_rho = -w->c * w->a - end * w->b - rho;
  const double over_h = -w->c * w->b + end * w->a - h;
  const double distance = sqrt(over_rho * over_rho + over_h * over_h);
  if (distance > 0) {
    gradient[0] = over_rho / distance;
    gradient[1] = over_h / distance;
  }
  return -distance;
}

static double profile_distance(const packing_i_revolution *p, double rho, double h,
                               double gradient[2])
{
  double inside = HUGE_VAL, outside = -HUGE_VAL;
  for (int i = 0; i < p->walls; i++) {
    const packing_i_wall *w = &p->wall[i];
    const double d = to_line(w, rho, h);
    double g[2] = {w->a, w->b};
    if (d < 0) {
      const double reached = to_face(w, rho, h, g);
      inside = -1;
      if (!(reached > outside))
        continue;
      outside = reached;
    } else if (d < inside) {
      inside = d;
    } else {
      continue;
    }
    gradient[0] = g[0];
    gradient[1] = g[1];
  }
  return inside < 0 ? outside : inside;
}

double packing_i_revolution_signed_distance(const packing_i_domain_body *body,
                                            const packing_vec3 *point,
                                            packing_vec3 *normal)
{
  const packing_i_revolution *p = &body->as.revolution;
  packing_vec3 radial;
  double rho, h, gradient[2] = {0, 0};
  packing_i_revolution_local(p, point, &rho, &h, normal == NULL ? NULL : &radial);
  const double distance = profile_distance(p, rho, h, gradient);
  if (normal != NULL) {
    *normal = packing_i_scale(radial, gradient[0]);
    packing_i_set_component(normal, p->axis, gradient[1]);
  }
  return distance;
}

int packing_i_revolution_near_walls(const packing_i_domain_body *body,
                                    const packing_vec3 *point, double reach,
                                    packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_i_revolution *p = &body->as.revolution;
  packing_vec3 radial;
  double rho, h;
  int count = 0;
  packing_i_revolution_local(p, point, &rho, &h, &radial);
  for (int i = 0; i < p->walls; i++) {
    const packing_i_wall *w = &p->wall[i];
    const double distance = to_line(w, rho, h);
    if (distance < reach) {
      packing_vec3 normal = packing_i_scale(radial, w->a);
      packing_i_set_component(&normal, p->axis, w->b);
      near[count++] = (packing_i_near_wall){distance, normal, i};
    }
  }
  return count;
}

int packing_i_revolution_holds(const packing_i_domain_body *body,
                               const packing_vec3 *centre, double r)
{
  const packing_i_revolution *p = &body->as.revolution;
  double rho, h;
  packing_i_revolution_local(p, centre, &rho, &h, NULL);
  for (int i = 0; i < p->walls; i++)
    if (!(to_line(&p->wall[i], rho, h) >= r))
      return 0;
  return 1;
}
