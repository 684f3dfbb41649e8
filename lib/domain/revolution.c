/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies of revolution: cylinder, tube, cone, silo. Each is a convex polygon in the half plane
 * (rho, h) turned about an axis, so its walls are lines and "at least d from every wall" is the
 * same lines moved by d. This file keeps the lines and what follows from them: which part of a
 * line is a face, at which heights the region bends, its volume and bounds. All of it in
 * constant time.
 *
 * An open top is no line. The faces beside it go on above it along their own line (upright in
 * cylinder, tube and silo), and only the region ends there. */
#include "domain_kinds.h"
#include <math.h>

/* Leaves of the face of *w what lies where a rho + b h + c >= 0. */
static void clip(packing_i_wall *w, double a, double b, double c)
{
  const double start = c - w->c * (a * w->a + b * w->b);
  const double slope = b * w->a - a * w->b;
  const double t = -start / slope;
  if (slope > 0) {
    if (t > w->from)
      w->from = t;
  } else if (slope < 0) {
    if (t < w->to)
      w->to = t;
  } else if (start < 0) {
    w->to = -HUGE_VAL;
  }
}

/* The face of line `w` among all walls and the axis; *p need not hold w. */
static packing_i_wall face(const packing_i_revolution *p, packing_i_wall w)
{
  w.from = -HUGE_VAL;
  w.to = HUGE_VAL;
  clip(&w, 1, 0, 0);
  for (int i = 0; i < p->walls; i++) {
    const packing_i_wall *v = &p->wall[i];
    if (v->a != w.a || v->b != w.b || v->c != w.c)
      clip(&w, v->a, v->b, v->c);
  }
  return w;
}

/* Walls whose face has vanished go: their lines pass outside. */
static void find_faces(packing_i_revolution *p)
{
  packing_i_revolution kept = *p;
  kept.walls = 0;
  for (int i = 0; i < p->walls; i++) {
    const packing_i_wall w = face(p, p->wall[i]);
    if (w.from < w.to)
      kept.wall[kept.walls++] = w;
  }
  *p = kept;
}

/* Adds a height unless it is there already, up to rounding. */
static void add_knot(packing_i_revolution *p, double h)
{
  double size = fabs(h);
  for (int i = 0; i < p->walls; i++)
    size = fmax(size, fabs(p->wall[i].c));
  for (int i = 0; i < p->knots; i++)
    if (fabs(p->knot[i] - h) <= 1e-13 * size)
      return;
  int at = p->knots++;
  for (; at > 0 && p->knot[at - 1] > h; at--)
    p->knot[at] = p->knot[at - 1];
  p->knot[at] = h;
}

static void add_ends(packing_i_revolution *p, const packing_i_wall *w)
{
  if (!(w->from < w->to))
    return;
  add_knot(p, -w->c * w->b + w->from * w->a);
  add_knot(p, -w->c * w->b + w->to * w->a);
}

/* Level faces first: their height is exact, and the others' ends are dropped in its favour. */
static void find_knots(packing_i_revolution *p)
{
  const packing_i_wall top = {.a = 0, .b = -1, .c = p->open_height};
  p->knots = 0;
  if (isfinite(p->open_height)) {
    const packing_i_wall lid = face(p, top);
    add_ends(p, &lid);
  }
  for (int slanted = 0; slanted < 2; slanted++)
    for (int i = 0; i < p->walls; i++) {
      packing_i_wall w = p->wall[i];
      if ((w.a != 0) != slanted)
        continue;
      if (isfinite(p->open_height))
        clip(&w, top.a, top.b, top.c);
      add_ends(p, &w);
    }
}

double packing_i_revolution_outer(const packing_i_revolution *p, double h)
{
  double least = HUGE_VAL;
  for (int i = 0; i < p->walls; i++)
    if (p->wall[i].a < 0)
      least = fmin(least, (p->wall[i].b * h + p->wall[i].c) / -p->wall[i].a);
  return least > 0 ? least : 0;
}

double packing_i_revolution_inner(const packing_i_revolution *p, double h)
{
  double most = 0;
  for (int i = 0; i < p->walls; i++)
    if (p->wall[i].a > 0)
      most = fmax(most, -(p->wall[i].b * h + p->wall[i].c) / p->wall[i].a);
  return most;
}

static double slice(const packing_i_revolution *p, double h)
{
  const double outer = packing_i_revolution_outer(p, h);
  const double inner = packing_i_revolution_inner(p, h);
  return outer > inner ? PACKING_I_PI * (outer - inner) * (outer + inner) : 0;
}

/* Simpson's rule is exact for frusta. */
static double volume(const packing_i_revolution *p)
{
  double sum = 0;
  for (int i = 0; i + 1 < p->knots; i++) {
    const double low = p->knot[i], high = p->knot[i + 1];
    sum += (high - low) / 6 *
           (slice(p, low) + 4 * slice(p, 0.5 * (low + high)) + slice(p, high));
  }
  return sum;
}

static void set_bounds(packing_i_domain_body *body)
{
  const packing_i_revolution *p = &body->as.revolution;
  double widest = 0;
  for (int i = 0; i < p->knots; i++)
    widest = fmax(widest, packing_i_revolution_outer(p, p->knot[i]));
  for (int k = 0; k < 3; k++) {
    const double base = packing_i_component(p->base, k);
    const double low = k == p->axis ? p->knot[0] : -widest;
    const double high = k == p->axis ? p->knot[p->knots - 1] : widest;
    packing_i_set_component(&body->bounds.lo, k, base + low);
    packing_i_set_component(&body->bounds.hi, k, base + high);
  }
}

/* All that follows from the lines. */
static void derive(packing_i_domain_body *body)
{
  packing_i_revolution *p = &body->as.revolution;
  find_faces(p);
  find_knots(p);
  body->volume = p->knots < 2 ? 0 : volume(p);
  if (body->volume > 0)
    set_bounds(body);
}

packing_status packing_i_revolution_inset(packing_context *context,
                                          packing_i_domain_body *body, double d)
{
  (void)context;
  for (int i = 0; i < body->as.revolution.walls; i++)
    body->as.revolution.wall[i].c -= d;
  derive(body);
  return PACKING_OK;
}

/* The line from one corner to the next, the inside on its left. */
static packing_i_wall line(const packing_i_revolution_def *def, int corner)
{
  const double rho = def->rho[corner], h = def->h[corner];
  const double along_rho = def->rho[corner + 1] - rho, along_h = def->h[corner + 1] - h;
  const double length = sqrt(along_rho * along_rho + along_h * along_h);
  packing_i_wall w = {.a = -along_h / length, .b = along_rho / length};
  w.c = -(w.a * rho + w.b * h);
  return w;
}

static void set_walls(packing_i_revolution *p, const packing_i_revolution_def *def)
{
  for (int i = 0; i + 1 < def->corners; i++) {
    const int is_point = def->rho[i] == def->rho[i + 1] && def->h[i] == def->h[i + 1];
    const int is_top = def->h[i] == def->height && def->h[i + 1] == def->height;
    if (!is_point && !(is_top && def->open_top))
      p->wall[p->walls++] = line(def, i);
  }
}

static packing_status check(packing_context *context, const packing_i_revolution_def *def)
{
  static const char *const base[] = {"base.x", "base.y", "base.z"};
  PACKING_I_TRY(packing_i_check_point(context, base, &def->base));
  if ((int)def->axis < PACKING_AXIS_X || (int)def->axis > PACKING_AXIS_Z)
    return packing_i_fail(context, PACKING_ERR_RANGE, "axis", PACKING_NO_INDEX,
                          "%d is none of x, y, z (0, 1, 2)", (int)def->axis);
  return packing_i_check_switch(context, "open_top", def->open_top);
}

packing_status packing_i_revolution_create(packing_context *context,
                                           const packing_i_domain_ops *ops,
                                           const packing_i_revolution_def *def,
                                           packing_domain **domain)
{
  PACKING_I_TRY(check(context, def));
  packing_i_domain_body body = packing_i_domain_body_new(ops, 3);
  packing_i_revolution *p = &body.as.revolution;
  *p = (packing_i_revolution){.axis = (int)def->axis, .base = def->base};
  p->open_height = def->open_top ? def->height : HUGE_VAL;
  body.open_axis = def->open_top ? p->axis : -1;
  set_walls(p, def);
  derive(&body);
  return packing_i_domain_finish(context, &body, "base", domain);
}
