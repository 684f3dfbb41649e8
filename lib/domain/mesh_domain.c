/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a closed triangle mesh (lib/mesh): distances by its tree with the sign of
 * angle-weighted normals (J. A. Baerentzen, H. Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005)
 * 243), the volume by the divergence theorem, balls by cones over the triangles (mesh/ball.c). An
 * inset takes its distance off, as that of a custom container does, and has its volumes by
 * subdivision; it holds the domain that it was made from, which alone owns the surface. A query
 * costs the logarithm of the triangles, deep inside and far outside less (mesh/depth.c). */
#include "domain_kinds.h"
#include "mesh/surface_internal.h"

/* Of an inset: distances asked for at most (seconds, of fine meshes), what is tried for, what will do. */
enum { CALLS_FOR_VOLUME = 1 << 20, CALLS_FOR_BALL = 1 << 14 };
static const double VOLUME_TOLERANCE = 1e-4, MOST_TOLERANCE = 1e-2;
static const double INSET_TOLERANCE = 1e-3; /* of balls in an inset */

static double signed_distance(const packing_i_domain_body *body,
                              const packing_vec3 *point, packing_vec3 *normal)
{
  const packing_i_meshed *m = &body->as.mesh;
  const double most = packing_i_surface_most_depth(m->surface, point);
  packing_i_nearest nearest =
      packing_i_surface_nearest(m->surface, point, most * most, 0);
  if (nearest.facet ==
      PACKING_I_MESH_NONE) /* far from the origin the bound may be rounded off */
    nearest = packing_i_surface_nearest(m->surface, point, HUGE_VAL, 0);
  if (nearest.facet == PACKING_I_MESH_NONE) { /* out of range */
    if (normal != NULL)
      *normal = packing_i_vec(0, 0, 0);
    return -HUGE_VAL;
  }
  const double distance = sqrt(nearest.square);
  if (normal != NULL)
    *normal = packing_i_surface_gradient(m->surface, &nearest);
  return (packing_i_surface_is_inside(m->surface, &nearest) ? distance : -distance) -
         m->inset;
}

/* What the grid knows where that tells the side, else the distance. */
static double side(const packing_i_domain_body *body, const packing_vec3 *point,
                   packing_vec3 *normal)
{
  const packing_i_meshed *m = &body->as.mesh;
  const double depth = packing_i_surface_depth(m->surface, point);
  if (normal == NULL && (depth < 0 || depth > m->inset))
    return depth - m->inset;
  if (normal == NULL && m->inset > 0) { /* too near the surface, on whichever side */
    const double most = packing_i_surface_most_depth(m->surface, point);
    if (most < m->inset)
      return most - m->inset;
  }
  return signed_distance(body, point, normal);
}

static int clear(const packing_i_domain_body *body, const packing_vec3 *point, double r)
{
  const packing_i_meshed *m = &body->as.mesh;
  const double depth = packing_i_surface_depth(m->surface, point);
  return depth > 0 && depth - m->inset >= r;
}

/* Where the side is known from the grid, the first triangle that is too near decides. */
static int holds(const packing_i_domain_body *body, const packing_vec3 *centre, double r)
{
  const packing_i_meshed *m = &body->as.mesh;
  const double depth = packing_i_surface_depth(m->surface, centre);
  if (!(depth > 0))
    return !(depth < 0) && signed_distance(body, centre, NULL) >= r;
  if (depth - m->inset >= r)
    return 1;
  const double wanted = (r + m->inset) * (1 + 1e-15);
  const double less = (r + m->inset) * (1 - 1e-15);
  const packing_i_nearest nearest =
      packing_i_surface_nearest(m->surface, centre, wanted * wanted, less * less);
  return nearest.facet == PACKING_I_MESH_NONE || sqrt(nearest.square) - m->inset >= r;
}

static int near_walls(const packing_i_domain_body *body, const packing_vec3 *point,
                      double reach, packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  packing_i_near_feature found[PACKING_I_NEAR_FEATURES];
  const packing_i_meshed *m = &body->as.mesh;
  const int count = packing_i_surface_near(m->surface, point, reach + m->inset, found);
  for (int i = 0; i < count; i++)
    near[i] = (packing_i_near_wall){found[i].distance - m->inset, found[i].normal,
                                    (int)found[i].wall};
  return count;
}

/* The bounds of what is left; 0: nothing is. */
static int shrink(packing_bounds *bounds, double d)
{
  for (int k = 0; k < 3; k++) {
    const double lo = packing_i_component(bounds->lo, k) + d;
    const double hi = packing_i_component(bounds->hi, k) - d;
    if (!(lo < hi))
      return 0;
    packing_i_set_component(&bounds->lo, k, lo);
    packing_i_set_component(&bounds->hi, k, hi);
  }
  return 1;
}

static packing_status inset(packing_context *context, packing_i_domain_body *body,
                            double d)
{
  const packing_vec3 nowhere = {0, 0, 0};
  const packing_i_tolerance enough = {0, VOLUME_TOLERANCE};
  double error;
  body->as.mesh.inset += d;
  body->volume = 0;
  if (!shrink(&body->bounds, d) ||
      packing_i_subdivide_sides(body, &nowhere, 0, enough, CALLS_FOR_VOLUME,
                                &body->volume, &error) != 0)
    return PACKING_OK;
  if (error > MOST_TOLERANCE * body->volume)
    return packing_i_fail(
        context, PACKING_ERR_RANGE, "distance", PACKING_NO_INDEX,
        "what is left of the mesh at %g from its walls is too little to "
        "tell its volume, some %g",
        d, body->volume);
  return PACKING_OK;
}

/* A ball in an inset: most are cut by one smooth wall; else by subdivision. */
static int volume_in_inset(const packing_i_domain_body *body, const packing_vec3 *centre,
                           double r, double tolerance, double *volume, double *error)
{
  const double ball = packing_i_ball_volume(3, r);
  const double enough = fmax(tolerance, INSET_TOLERANCE) * ball;
  packing_vec3 normal;
  const double d = signed_distance(body, centre, &normal);
  if (d <= -r || d >= r) {
    *volume = d > 0 ? ball : 0;
    *error = 0;
    return 0;
  }
  if (packing_i_cut_columns(body, centre, r, d, normal, enough, volume, error))
    return 0;
  return packing_i_subdivide_sides(body, centre, r, (packing_i_tolerance){enough, 0},
                                   CALLS_FOR_BALL, volume, error);
}

static int sphere_volume(const packing_i_domain_body *body, const packing_vec3 *centre,
                         double r, double tolerance, double *volume, double *error)
{
  if (body->as.mesh.inset > 0)
    return volume_in_inset(body, centre, r, tolerance, volume, error);
  *volume = packing_i_surface_ball(body->as.mesh.surface, centre, r, error);
  return 0;
}

static void inherit(packing_i_domain_body *body, packing_domain *from)
{
  packing_domain *root = from->body.as.mesh.root;
  body->as.mesh.root = packing_domain_retain(root == NULL ? from : root);
}

static void release(const packing_i_domain_body *body)
{
  const packing_i_meshed *m = &body->as.mesh;
  if (m->root != NULL)
    packing_domain_destroy(m->root);
  else
    packing_i_surface_destroy(m->surface);
}

static const packing_i_domain_ops mesh_ops = {
    .name = "mesh",
    .reference = "triangles; signs: Baerentzen and Aanaes (2005)",
    .signed_distance = signed_distance,
    .side = side,
    .holds = holds,
    .clear = clear,
    .near_walls = near_walls,
    .inset = inset,
    .sphere_volume = sphere_volume,
    .inherit = inherit,
    .release = release,
};

const packing_mesh *packing_i_domain_mesh(const packing_domain *domain)
{
  const packing_i_domain_body *body = &domain->body;
  return body->ops == &mesh_ops && body->as.mesh.root == NULL
             ? body->as.mesh.surface->mesh
             : NULL;
}

void packing_domain_mesh_def_fill(packing_domain_mesh_def *def, size_t size)
{
  packing_domain_mesh_def defaults = {.mesh = NULL};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status refuse(packing_context *context, const packing_mesh_report *r)
{
  const char *what = packing_mesh_defect_string(r->defect);
  if (r->other == PACKING_NO_INDEX)
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "mesh", r->triangle,
                          "%s, at %g, %g, %g (triangle %zu; %zu such)", what, r->point.x,
                          r->point.y, r->point.z, r->triangle, r->count);
  return packing_i_fail(context, PACKING_ERR_GEOMETRY, "mesh", r->triangle,
                        "%s, at %g, %g, %g (triangles %zu and %zu; %zu such)", what,
                        r->point.x, r->point.y, r->point.z, r->triangle, r->other,
                        r->count);
}

packing_status packing_domain_create_mesh(packing_context *context,
                                          const packing_domain_mesh_def *def,
                                          packing_domain **domain)
{
  packing_domain_mesh_def d;
  packing_mesh_report report;
  packing_i_domain_body body = packing_i_domain_body_new(&mesh_ops, 3);
  PACKING_I_TRY(packing_i_domain_begin(context, def, domain));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_domain_mesh, mesh, def, &d));
  PACKING_I_TRY(packing_i_check_given(context, "mesh", d.mesh));
  packing_mesh_report_init(&report);
  PACKING_I_TRY(packing_mesh_check(context, d.mesh, &report));
  if (report.defect != PACKING_MESH_SOUND)
    return refuse(context, &report);
  PACKING_I_TRY(packing_i_surface_create(context, d.mesh, &body.as.mesh.surface));
  body.walls = (int)packing_i_surface_walls(body.as.mesh.surface);
  body.volume = packing_mesh_volume(d.mesh);
  packing_mesh_bounds(d.mesh, &body.bounds);
  const packing_status status = packing_i_domain_finish(context, &body, "mesh", domain);
  if (status != PACKING_OK)
    packing_i_surface_destroy(body.as.mesh.surface);
  return status;
}
