/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A container as triangles, their corners counter-clockwise seen from outside. A box has two a
 * face. The others are a profile in the half plane (rho, h) turned about an axis in steps of 2 pi / n:
 * where the wall is an outer one, the corners stand at rho / cos(pi / n), so that the flat pieces
 * touch the round wall from behind; at an inner wall they stand at rho. A sphere's profile is a
 * polygon round the half circle for the same reason. Corners are computed from (ring, step) alone,
 * so that neighbours share them to the last bit. A mesh is its own triangles. Pieces longer than 32 widths are cut: mesh readers
 * refuse needles. */
#include "domain/domain_internal.h"
#include "writers_internal.h"

enum { LONGEST = 32, MOST_FACETS = 4096, MOST_PIECES = 1024 };

/* A corner of the profile. */
typedef struct ring {
  double rho, h;
} ring;

typedef struct turn {
  packing_vec3 base;
  int axis;
  unsigned facets;
  packing_i_triangle_function visit;
  void *user;
} turn;

static int is_custom(const packing_domain *domain)
{
  return packing_i_domain_planar(domain) == NULL && packing_i_domain_axis(domain) < 0 &&
         packing_i_domain_round(domain) == NULL && packing_i_domain_mesh(domain) == NULL;
}

static int is_periodic_everywhere(const packing_domain *domain)
{
  return packing_domain_periodic(domain) ==
         (PACKING_PERIODIC_X | PACKING_PERIODIC_Y | PACKING_PERIODIC_Z);
}

int packing_i_mesh_exists(const packing_domain *domain)
{
  return packing_domain_dim(domain) == 3 && !is_custom(domain) &&
         !is_periodic_everywhere(domain);
}

packing_status packing_i_mesh_check_facets(packing_context *context, unsigned facets)
{
  if (facets < 3 || facets > MOST_FACETS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "facets", PACKING_NO_INDEX,
                          "%u is not in 3 .. %d", facets, MOST_FACETS);
  return PACKING_OK;
}

packing_status packing_i_mesh_check(packing_context *context,
                                    const packing_domain *domain, unsigned facets)
{
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  PACKING_I_TRY(packing_i_mesh_check_facets(context, facets));
  if (!packing_i_mesh_exists(domain))
    return packing_i_fail(context, PACKING_ERR_UNSUPPORTED, "domain", PACKING_NO_INDEX,
                          is_periodic_everywhere(domain)
                              ? "a %s, periodic in all directions, has no walls"
                              : "no mesh of a container of kind %s",
                          packing_domain_kind(domain));
  return PACKING_OK;
}

/* cos and sin of step / facets of a full turn, exact at the quarters. */
static void direction(unsigned step, unsigned facets, double *c, double *s)
{
  const unsigned quarter = 4 * step / facets, rest = 4 * step - quarter * facets;
  const int late = 2 * rest > facets;
  const double angle = 0.5 * PACKING_I_PI * (late ? facets - rest : rest) / facets;
  const double a = late ? sin(angle) : cos(angle), b = late ? cos(angle) : sin(angle);
  *c = quarter == 0 ? a : quarter == 1 ? -b : quarter == 2 ? -a : b;
  *s = quarter == 0 ? b : quarter == 1 ? a : quarter == 2 ? -b : -a;
}

static packing_vec3 corner(const turn *t, ring p, unsigned step)
{
  double c, s;
  direction(step % t->facets, t->facets, &c, &s);
  const double u = p.rho == 0 ? 0 : p.rho * c, v = p.rho == 0 ? 0 : p.rho * s;
  const packing_vec3 local = t->axis == 2   ? packing_i_vec(u, v, p.h)
                             : t->axis == 0 ? packing_i_vec(p.h, u, v)
                                            : packing_i_vec(v, p.h, u);
  return packing_i_add(t->base, local);
}

/* Between two rings of the profile, the inside on the left of the way from a to b. */
static void strip(const turn *t, ring a, ring b)
{
  for (unsigned k = 0; k < t->facets; k++) {
    const packing_vec3 low = corner(t, a, k), low_next = corner(t, a, k + 1);
    const packing_vec3 high = corner(t, b, k), high_next = corner(t, b, k + 1);
    const packing_vec3 first[] = {low, low_next, high_next};
    const packing_vec3 second[] = {low, high_next, high};
    if (a.rho > 0)
      t->visit(t->user, first);
    if (b.rho > 0)
      t->visit(t->user, second);
  }
}

static void segment(const turn *t, ring a, ring b)
{
  const double along = b.rho - a.rho, up = b.h - a.h;
  const double width = 2 * PACKING_I_PI * fmax(a.rho, b.rho) / t->facets;
  if ((a.rho == 0 && b.rho == 0) || (along == 0 && up == 0))
    return;
  const double wanted = sqrt(along * along + up * up) / (LONGEST * width);
  const int pieces = wanted < MOST_PIECES ? 1 + (int)wanted : MOST_PIECES;
  ring from = a;
  for (int i = 1; i <= pieces; i++) {
    const double s = (double)i / pieces;
    const ring to = {i == pieces ? b.rho : a.rho + s * along,
                     i == pieces ? b.h : a.h + s * up};
    strip(t, from, to);
    from = to;
  }
}

static void visit_revolution(turn *t, const packing_i_revolution *p)
{
  const double wider = 1 / cos(PACKING_I_PI / t->facets);
  ring outer[PACKING_I_KNOTS] = {{0, 0}}, inner[PACKING_I_KNOTS] = {{0, 0}};
  const int last = p->knots - 1;
  for (int i = 0; i <= last; i++) {
    outer[i] = (ring){packing_i_revolution_outer(p, p->knot[i]) * wider, p->knot[i]};
    inner[i] = (ring){packing_i_revolution_inner(p, p->knot[i]), p->knot[i]};
  }
  t->base = p->base;
  t->axis = p->axis;
  segment(t, inner[0], outer[0]);
  for (int i = 0; i < last; i++)
    segment(t, outer[i], outer[i + 1]);
  if (isinf(p->open_height))
    segment(t, outer[last], inner[last]);
  for (int i = last; i > 0; i--)
    segment(t, inner[i], inner[i - 1]);
}

static void visit_sphere(turn *t, const packing_i_round *s)
{
  const unsigned bands = t->facets < 6 ? 3 : t->facets / 2;
  const double half = 0.5 * PACKING_I_PI / bands;
  const double radius = s->outer / cos(half);
  const double wider = radius / cos(PACKING_I_PI / t->facets);
  ring from = {0, -radius};
  t->base = s->centre;
  t->axis = PACKING_AXIS_Z;
  for (unsigned i = 1; i <= bands; i++) {
    double c, sine;
    direction(i, 2 * bands, &c, &sine);
    const ring to = {i == bands ? 0 : wider * sine, -radius * c};
    strip(t, from, to);
    from = to;
  }
}

/* One face of a box, seen from outside: the low or high side of an axis. */
static void face(const turn *t, const packing_bounds *b, int axis, int high)
{
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  packing_vec3 at[4];
  for (int i = 0; i < 4; i++) {
    double x[3];
    const int along_u = i == 1 || i == 2, along_v = i >= 2;
    x[axis] = packing_i_component(high ? b->hi : b->lo, axis);
    x[u] = packing_i_component(along_u ? b->hi : b->lo, u);
    x[v] = packing_i_component(along_v ? b->hi : b->lo, v);
    at[high ? i : 3 - i] = packing_i_vec(x[0], x[1], x[2]);
  }
  const packing_vec3 first[] = {at[0], at[1], at[2]}, second[] = {at[0], at[2], at[3]};
  t->visit(t->user, first);
  t->visit(t->user, second);
}

static void visit_box(const turn *t, const packing_domain *domain,
                      const packing_i_planar *p)
{
  packing_bounds bounds;
  packing_domain_bounds(domain, &bounds);
  for (int k = 0; k < 3; k++) {
    if (isfinite(p->wall_lo[k]))
      face(t, &bounds, k, 0);
    if (isfinite(p->wall_hi[k]))
      face(t, &bounds, k, 1);
  }
}

static void visit_mesh(const turn *t, const packing_mesh *mesh)
{
  packing_mesh_view v;
  packing_mesh_view_init(&v);
  if (packing_mesh_arrays(NULL, mesh, &v) != PACKING_OK)
    return;
  for (size_t i = 0; i < v.triangle_count; i++) {
    packing_vec3 at[3];
    for (size_t k = 0; k < 3; k++) {
      const double *x = &v.vertices[3 * (size_t)v.triangles[3 * i + k]];
      at[k] = packing_i_vec(x[0], x[1], x[2]);
    }
    t->visit(t->user, at);
  }
}

void packing_i_mesh_visit(const packing_domain *domain, unsigned facets,
                          packing_i_triangle_function visit, void *user)
{
  turn t = {.facets = facets, .visit = visit, .user = user};
  const packing_i_planar *planar = packing_i_domain_planar(domain);
  if (planar != NULL)
    visit_box(&t, domain, planar);
  else if (packing_i_domain_mesh(domain) != NULL)
    visit_mesh(&t, packing_i_domain_mesh(domain));
  else if (packing_i_domain_axis(domain) >= 0)
    visit_revolution(&t, &domain->body.as.revolution);
  else
    visit_sphere(&t, packing_i_domain_round(domain));
}
