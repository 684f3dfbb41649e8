/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far a sphere of radius r can go until it touches a wall of a built-in container.
 * All their walls are of one form: with rho the length of the part w + t u of the way
 * across an axis (or of all of it, around a centre) and h + t k the height along the
 * axis, the sphere's gap is
 *
 *   f(t) = a |w + t u| + b (h + t k) + c - r,   a^2 + b^2 = 1,
 *
 * a plane where a = 0, a cylinder where b = 0, else a cone; with w and u in full a
 * sphere. The roots of f are those of |w + t u|^2 = (E + F t)^2 with E + F t >= 0, a
 * quadratic; the first at which f falls is the contact (a concave wall may be touched at
 * the start, left, and met again on the other side). Its last coefficient is taken as
 * (|w| - E) (|w| + E), so that little is lost next to a wall. Constant time. */
#include "domain/domain_internal.h"
#include "shape_internal.h"

enum { WALLS_MOST = 6 };

/* f(t), as above; c holds - r. */
typedef struct course {
  packing_vec3 w, u;
  double h, k, a, b, c;
} course;

static double gap_at(const course *f, double t, double *slope)
{
  const packing_vec3 across = packing_i_add(f->w, packing_i_scale(f->u, t));
  const double rho = packing_i_norm(across);
  /* Through the axis the radius grows as fast as the way across. */
  const double rate = rho > 0 ? packing_i_dot(across, f->u) / rho : packing_i_norm(f->u);
  *slope = f->a * rate + f->b * f->k;
  return f->a * rho + f->b * (f->h + f->k * t) + f->c;
}

/* The roots of |w + t u|^2 = (e + k t)^2; infinity where there are none. */
static void roots(const course *f, double t[2])
{
  const double e = -(f->c + f->b * f->h) / f->a, k = -f->b * f->k / f->a;
  const double rho = packing_i_norm(f->w);
  const double two = packing_i_dot(f->u, f->u) - k * k;
  const double one = packing_i_dot(f->w, f->u) - e * k;
  const double none = (rho - e) * (rho + e);
  const double discriminant = one * one - two * none;
  t[0] = t[1] = HUGE_VAL;
  if (!(discriminant >= 0))
    return;
  const double root = sqrt(discriminant);
  const double sum = -(one + (one >= 0 ? root : -root));
  if (two != 0)
    t[0] = sum / two;
  if (sum != 0)
    t[1] = none / sum;
}

static double first_contact(const course *f)
{
  double slope, t[2], first = HUGE_VAL;
  const double gap = gap_at(f, 0, &slope);
  if (gap <= 0 && slope < 0)
    return 0;
  if (f->a == 0)
    return slope < 0 ? gap / -slope : HUGE_VAL;
  roots(f, t);
  for (int i = 0; i < 2; i++) {
    if (!(t[i] >= 0 && t[i] < first))
      continue;
    /* The other sheet of a cone has the sign of a rho changed. */
    const double wanted = -(f->c + f->b * (f->h + f->k * t[i])) / f->a;
    gap_at(f, t[i], &slope);
    if (wanted >= 0 && slope < 0)
      first = t[i];
  }
  return first;
}

static int planar_course(const packing_i_planar *p, int wall, const packing_body *a,
                         const packing_vec3 *direction, course *f)
{
  const int axis = wall / 2, high = wall % 2;
  const double border = high ? p->wall_hi[axis] : p->wall_lo[axis];
  if (!isfinite(border))
    return 0;
  *f = (course){.h = packing_i_component(a->centre, axis) - border,
                .k = packing_i_component(*direction, axis),
                .b = high ? -1 : 1,
                .c = -a->r};
  return 1;
}

static int round_course(const packing_i_round *s, int flat, int wall,
                        const packing_body *a, const packing_vec3 *direction, course *f)
{
  if (wall == 1 && !(s->inner > 0))
    return 0;
  *f = (course){.w = packing_i_sub(a->centre, s->centre),
                .u = *direction,
                .a = wall == 0 ? -1 : 1,
                .c = (wall == 0 ? s->outer : -s->inner) - a->r};
  if (flat)
    f->w.z = f->u.z = 0;
  return 1;
}

static packing_vec3 without(packing_vec3 v, int axis)
{
  return packing_i_vec(axis == 0 ? 0 : v.x, axis == 1 ? 0 : v.y, axis == 2 ? 0 : v.z);
}

static void revolution_course(const packing_i_revolution *p, int wall,
                              const packing_body *a, const packing_vec3 *direction,
                              course *f)
{
  const packing_vec3 local = packing_i_sub(a->centre, p->base);
  const packing_i_wall *w = &p->wall[wall];
  *f = (course){.w = without(local, p->axis),
                .u = without(*direction, p->axis),
                .h = packing_i_component(local, p->axis),
                .k = packing_i_component(*direction, p->axis),
                .a = w->a,
                .b = w->b,
                .c = w->c - a->r};
}

/* The course towards one wall; 0: the container has none of that number. */
static int course_of(const packing_domain *domain, int wall, const packing_body *a,
                     const packing_vec3 *direction, course *f)
{
  const packing_i_planar *planar = packing_i_domain_planar(domain);
  if (planar != NULL)
    return wall < 6 && planar_course(planar, wall, a, direction, f);
  const packing_i_round *round = packing_i_domain_round(domain);
  if (round != NULL)
    return wall < 2 && round_course(round, domain->body.dim == 2, wall, a, direction, f);
  if (wall >= domain->body.as.revolution.walls)
    return 0;
  revolution_course(&domain->body.as.revolution, wall, a, direction, f);
  return 1;
}

int packing_i_wall_distance(const packing_body *a, const packing_body *wall,
                            const packing_vec3 *direction, double *distance)
{
  const packing_domain *domain = wall->domain;
  if (packing_i_domain_planar(domain) == NULL && packing_i_domain_round(domain) == NULL &&
      packing_i_domain_axis(domain) < 0)
    return 0;
  const int first = wall->wall < 0 ? 0 : wall->wall;
  const int last = wall->wall < 0 ? WALLS_MOST - 1 : wall->wall;
  double least = HUGE_VAL;
  for (int w = first; w <= last; w++) {
    course f;
    if (course_of(domain, w, a, direction, &f)) {
      const double t = first_contact(&f);
      least = t < least ? t : least;
    }
  }
  *distance = least;
  return 1;
}
